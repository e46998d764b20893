//! Speed and slip of the cage from what its balls show.

use super::{Signal, shaft};
use crate::scenario::{CageKind, CageSignal};
use measure::cage_speed::{CageSpeed, Line, from_pulses, from_vibration};
use measure::order::orders;
use measure::pulse::{EdgeSettings, edges};

/// Orders of the shaft that are taken out of a vibration before a line is followed.
const SHAFT_ORDERS: &[f64] = &[1.0, 2.0, 3.0];
/// Their bandwidth, Hz.
const BANDWIDTH: f64 = 2.0;
/// A ratio that is not exact shows as slip below 0.
const LOWEST_SLIP: f64 = -0.02;

/// The motion of the cage.
pub(in crate::simulate) struct Found {
    pub cage: CageSpeed,
    pub notes: Vec<String>,
}

impl Found {
    pub(super) fn of(
        signal: &Signal,
        wish: &CageSignal,
        shaft: &shaft::Found,
    ) -> Result<Found, String> {
        let engagement = shaft.speed.change.map(|change| change.engagement.0);
        let turning = shaft.shaft();
        let (balls, ratio) = (wish.ball_count, wish.rolling_ratio);
        let mut notes = Vec::new();
        let cage = match (signal, wish.kind) {
            (Signal::Stamped(stamps), _) => {
                if stamps.missing > 0 {
                    notes.push(format!(
                        "{} instants are no numbers and were left out",
                        stamps.missing
                    ));
                }
                from_pulses(&stamps.times, &turning, balls, ratio, engagement)
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
                        notes.push(format!(
                            "orders 1 to 3 of the shaft stay in the signal: {why}"
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
                let found = edges(
                    series.first,
                    series.interval,
                    &series.values,
                    &EdgeSettings::default(),
                )
                .map_err(|refusal| refusal.to_string())?;
                notes.extend(found.notes.iter().cloned());
                from_pulses(&found.times, &turning, balls, ratio, engagement)
            }
        }?;
        notes.extend(cage.notes.iter().cloned());
        Ok(Found { cage, notes })
    }
}
