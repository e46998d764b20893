//! Speed and slip of the cage from what its balls show.

use crate::signals::request::Signal;
use crate::signals::shaft;
use measure::cage_speed::{CageSpeed, Line, QuickChange, from_pulses, from_vibration};
use measure::order::orders;
use measure::pulse::{Flank, edges};
use problem::{note, note::Note};
use scenario::{CageKind, CageSignal};
use statistics::uncertain::Uncertain;

/// Orders of the shaft that are taken out of a vibration before a line is followed.
const SHAFT_ORDERS: &[f64] = &[1.0, 2.0, 3.0];
/// Their bandwidth, Hz.
const BANDWIDTH: f64 = 2.0;
/// A ratio that is not exact shows as slip below 0.
const LOWEST_SLIP: f64 = -0.02;

/// A cage that rests further behind its rolling at speed, loaded, has not been measured; counts that are wrong look like it.
const HIGHEST_SLIP: f64 = 0.3;
/// Part of the largest speed from which on slip is looked at.
const AT_SPEED: f64 = 0.5;
/// Deviations from which on two values count as different.
const APART: f64 = 3.0;
/// Part by which a ratio may be off for its radii and contact angle.
const RATIO: f64 = 0.01;

/// The motion of the cage.
pub(crate) struct Estimate {
    /// For other estimators: where nothing is told, the speed is any of the slips that were looked for.
    pub cage: CageSpeed,
    /// As it is told: not-a-number where nothing is.
    pub told: CageSpeed,
    /// Speed of a rolling cage over that of the shaft.
    pub rolling_ratio: f64,
    pub notes: Vec<Note>,
}

impl Estimate {
    pub(super) fn of(
        signal: &Signal,
        wish: &CageSignal,
        shaft: &shaft::Estimate,
    ) -> Result<Estimate, String> {
        let engagement = shaft.speed.change.map(|change| change.engagement.0);
        let change = shaft.speed.change.map(|change| QuickChange {
            engagement: change.engagement.0,
            lock: change.end.map(|end| end.0),
        });
        let turning = shaft.shaft();
        let (balls, ratio) = (wish.ball_count, wish.rolling_ratio);
        let mut notes = Vec::new();
        let cage = match (signal, wish.kind) {
            (Signal::Stamped(stamps), _) => {
                if stamps.missing > 0 {
                    notes.push(note!(
                        "{} instants are no numbers and were left out",
                        stamps.missing
                    ));
                }
                from_pulses(&stamps.times, &turning, balls, ratio, change)
            }
            (Signal::Sampled(series), CageKind::Vibration { highest_slip }) => {
                let (first, interval) = (series.first, series.interval);
                let without = orders(
                    &series.values,
                    first,
                    interval,
                    &turning,
                    SHAFT_ORDERS,
                    BANDWIDTH,
                );
                let rest = match &without {
                    Ok(found) => {
                        notes.extend(found.notes.iter().cloned());
                        &found.rest
                    }
                    Err(why) => {
                        notes.push(note!(
                            "orders 1 to 3 of the shaft stay in the signal: {}",
                            why
                        ));
                        &series.values
                    }
                };
                let line = Line {
                    ratio,
                    order: balls as f64,
                    lowest_slip: LOWEST_SLIP,
                    highest_slip,
                    engagement,
                };
                from_vibration(first, interval, rest, &turning, &line)
            }
            (Signal::Sampled(series), _) => {
                let found = edges(series.first, series.interval, &series.values, Flank::Rising)
                    .map_err(|refusal| refusal.to_string())?;
                notes.extend(found.notes.iter().cloned());
                from_pulses(&found.times, &turning, balls, ratio, change)
            }
        }?;
        notes.extend(cage.notes.iter().cloned());
        let told = cage.clone();
        let mut cage = cage;
        let (middle, width) = match wish.kind {
            CageKind::Vibration { highest_slip } => (
                0.5 * (LOWEST_SLIP + highest_slip),
                highest_slip - LOWEST_SLIP,
            ),
            _ => (0.5, 1.0),
        };
        for (k, time) in cage.time.iter().enumerate() {
            if cage.speed[k].is_nan() || cage.deviation[k].is_nan() {
                let rolling = ratio * turning.speed_at(*time);
                cage.speed[k] = rolling * (1.0 - middle);
                // any slip of the range is as likely
                cage.deviation[k] = rolling.abs() * width / 12f64.sqrt();
            }
        }
        Ok(Estimate {
            cage,
            told,
            rolling_ratio: ratio,
            notes,
        })
    }

    /// What is odd of a slip at steady speed: no cage leads its rolling, nor stays far behind it; a wrong count does.
    ///
    /// - `marks`: marks per revolution that are stated
    pub(crate) fn doubt(
        &self,
        wish: &CageSignal,
        marks: usize,
        shaft: &shaft::Estimate,
    ) -> Option<Note> {
        let slip = self.at_speed(shaft)?;
        let apart = APART * slip.deviation;
        if slip.value > LOWEST_SLIP - apart && slip.value < HIGHEST_SLIP + apart {
            return None;
        }
        let ratio = 1.0 - slip.value;
        let near = RATIO.max(apart);
        let mut fits = Vec::new();
        let stated = wish.ball_count as f64;
        let balls = (ratio * stated).round();
        if balls >= 1.0 && balls != stated && (balls / stated - ratio).abs() <= near {
            fits.push(format!(
                "{balls} balls instead of {stated} (signals.cage.ball_count)"
            ));
        }
        let stated = marks as f64;
        let marks = (stated / ratio).round();
        let other = stated > 0.0 && marks >= 1.0 && marks != stated;
        if other && (stated / marks - ratio).abs() <= near {
            fits.push(format!(
                "{marks} marks per revolution instead of {stated} (signals.speed.marks_per_revolution)"
            ));
        }
        let fits = match fits.is_empty() {
            true => "no other count of balls or marks would: the cage slips, or signals.cage.rolling_ratio is wrong"
                .to_string(),
            false => format!("it would roll with {}", fits.join(", or with ")),
        };
        let cannot = match slip.value < 0.0 {
            true => "no cage leads its rolling",
            false => "so far behind its rolling few cages stay",
        };
        Some(note!(
            "the cage rests at a slip of {:.3} ± {:.3}, and {}; {}",
            slip.value,
            slip.deviation,
            cannot,
            fits
        ))
    }

    /// The slip behind a quick change, at speed.
    fn at_speed(&self, shaft: &shaft::Estimate) -> Option<Uncertain> {
        let change = shaft.speed.change;
        let from = change.map_or(f64::NEG_INFINITY, |change| {
            change.end.map_or(change.engagement.0, |end| end.0)
        });
        let least = AT_SPEED * shaft.fastest.speed.abs();
        let cage = &self.cage;
        let seen = cage.time.iter().zip(&cage.slip).zip(&cage.slip_deviation);
        let (slips, deviations): (Vec<f64>, Vec<f64>) = seen
            .filter(|((time, slip), deviation)| {
                let known = slip.is_finite() && deviation.is_finite();
                known && **time > from && shaft.speed.at(**time).speed.abs() > least
            })
            .map(|((_, slip), deviation)| (*slip, *deviation))
            .unzip();
        if slips.len() < 3 {
            return None;
        }
        let middle = crate::signals::request::median(&slips);
        let away: Vec<f64> = slips.iter().map(|slip| (slip - middle).abs()).collect();
        // 0.6745: the median of the size of a normal error of deviation 1
        let spread = (crate::signals::request::median(&away) / 0.6745)
            .max(crate::signals::request::median(&deviations));
        Some(Uncertain::new(middle, spread))
    }
}
