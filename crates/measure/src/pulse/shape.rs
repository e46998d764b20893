//! The signal in which the flanks of all pulses have one shape over the angle.
//!
//! ```text
//! steepness over the angle   S n          S: slope at the middle, per sample; n: samples from mark to mark
//! the same at every speed                 light, Hall, eddy current: the signal follows the angle
//! h S n² the same                         magnetic pickup cut off at a level: voltage = speed · f(angle) below it
//! neither                                 no shape is learnt
//! ```
//! `h`: height of a pulse before it was evened. Where flanks follow the magnetic law the signal is divided by the speed, and
//! what the cut-off has changed is left out.

use super::flank::Passing;
use super::level::Levels;
use crate::quantile::median;

/// Steepness of the quickest third of flanks over that of the slowest, and its inverse, within which they count as the same.
const SAME: f64 = 1.25;
/// Least length of a flank, in samples, at which its steepness shows.
const SHOWN: f64 = 6.0;
/// Fewest flanks that count.
const FEW: usize = 30;
/// Usual uncertainty of flanks between samples, in samples, below which their shape could add nothing.
const EXACT: f64 = 0.03;
/// Height over that of the magnetic law, below which a pulse is cut off.
const CUT: f64 = 0.8;
/// Largest distance from the middle, as a part of the height, of what a cut-off has left as it was.
const LEFT: f64 = 0.4;

/// What flanks of one kind have in common.
pub(super) enum Shape {
    /// One shape over the angle.
    Same,
    /// One shape over the angle in this signal.
    OverSpeed(OverSpeed),
    /// None that is known, or none that is needed.
    None,
}

/// A signal divided by the speed.
pub(super) struct OverSpeed {
    pub samples: Vec<f64>,
    /// Slope of the signal at the middle, times the square of the samples from mark to mark.
    steepness: f64,
}

impl OverSpeed {
    /// States what the noise leaves of places that a sample resolves: the same noise is less of a signal that is larger.
    pub fn state(&self, found: &mut [Passing], rises: bool, levels: &Levels) {
        let own: Vec<usize> = (0..found.len())
            .filter(|&k| found[k].rises == rises)
            .collect();
        for three in own.windows(3) {
            let interval = 0.5 * (found[three[2]].place - found[three[0]].place);
            let passing = &mut found[three[1]];
            if !passing.resolved && passing.spread < RESOLVED {
                let height = levels
                    .envelope()
                    .map_or(1.0, |e| e.at(passing.place as usize).1);
                let noise = levels.noise_at(passing.place as usize) * height;
                let slope = self.steepness / (interval * interval);
                passing.spread = (noise / slope).hypot(FINEST).min(passing.spread);
            }
        }
    }
}

/// Uncertainty, in samples, of a place that no sample resolves, at least; and of one that a sample resolves exactly.
const RESOLVED: f64 = 0.1;
const FINEST: f64 = 3e-4;

/// A flank whose steepness shows.
struct SteepFlank {
    /// Samples to the next flank.
    interval: f64,
    /// Slope per sample.
    slope: f64,
    /// Height before the signal was evened.
    height: f64,
}

impl Shape {
    pub fn of(samples: &[f64], found: &[Passing], rises: bool, levels: &Levels) -> Shape {
        let own: Vec<&Passing> = found.iter().filter(|f| f.rises == rises).collect();
        let hidden = own.iter().filter(|f| !f.resolved);
        if median(hidden.map(|f| f.spread)) < EXACT {
            return Shape::None;
        }
        let mut seen = steepness(samples, &own, levels);
        if seen.len() < FEW {
            return Shape::Same;
        }
        seen.sort_by(|a, b| a.interval.total_cmp(&b.interval));
        let third = seen.len() / 3;
        let (quick, slow) = (&seen[..third], &seen[seen.len() - third..]);
        let usual = |part: &[SteepFlank], value: &dyn Fn(&SteepFlank) -> f64| {
            median(part.iter().map(value))
        };
        let same = |value: &dyn Fn(&SteepFlank) -> f64| {
            (SAME.recip()..SAME).contains(&(usual(quick, value) / usual(slow, value)))
        };
        if same(&|s| s.slope * s.interval) {
            return Shape::Same;
        }
        let has_own_level = levels.envelope().is_some_and(|e| e.own_level);
        if has_own_level && same(&|s| s.height * s.slope * s.interval.powi(2)) {
            let product = usual(slow, &|s| s.height * s.interval);
            return Shape::OverSpeed(OverSpeed {
                samples: over_speed(samples, &own, levels, product),
                steepness: usual(slow, &|s| s.height * s.slope * s.interval.powi(2)),
            });
        }
        Shape::None
    }
}

fn steepness(samples: &[f64], own: &[&Passing], levels: &Levels) -> Vec<SteepFlank> {
    own.windows(2)
        .filter_map(|pair| {
            let (place, interval) = (pair[0].place, pair[1].place - pair[0].place);
            let reach = (0.02 * interval).max(1.0).min(place);
            let at = |place: f64| {
                let k = place as usize;
                let (a, b) = (*samples.get(k)?, *samples.get(k + 1)?);
                Some(a + (b - a) * place.fract())
            };
            let slope = (at(place + reach)? - at(place - reach)?).abs() / (2.0 * reach);
            (slope > 0.0 && levels.span / slope > SHOWN).then(|| SteepFlank {
                interval,
                slope,
                height: levels.envelope().map_or(1.0, |e| e.at(place as usize).1),
            })
        })
        .collect()
}

/// The signal divided by the speed, without what was cut off; `product`: height times samples from mark to mark where nothing
/// is.
fn over_speed(samples: &[f64], own: &[&Passing], levels: &Levels, product: f64) -> Vec<f64> {
    let intervals: Vec<(f64, f64)> = own
        .windows(3)
        .map(|three| (three[1].place, 0.5 * (three[2].place - three[0].place)))
        .collect();
    let interval = |sample: f64| {
        let next = intervals.partition_point(|i| i.0 < sample);
        let (left, right) = (
            intervals[next.saturating_sub(1)],
            intervals[next.min(intervals.len() - 1)],
        );
        let part = ((sample - left.0) / (right.0 - left.0)).clamp(0.0, 1.0);
        if part.is_finite() {
            left.1 + part * (right.1 - left.1)
        } else {
            left.1
        }
    };
    let height = |sample: usize| levels.envelope().map_or(1.0, |e| e.at(sample).1);
    samples
        .iter()
        .enumerate()
        .map(|(k, y)| {
            let law = height(k) * interval(k as f64) / product;
            let changed = law < CUT && y.abs() > LEFT;
            if changed { f64::NAN } else { y * law }
        })
        .collect()
}
