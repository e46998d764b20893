//! Slow tests that do not have the same moment: their mean is that of none of them.

use super::{MomentSettings, difference, fitted, speeds_up};
use crate::measurement::Measurement;
use measure::uncertain::Uncertain;
use physics::rolling::RollingSet;

/// Two slow tests of one direction whose moments differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Unequal {
    /// Their names.
    pub tests: (String, String),
    /// Moment of the first minus that of the second, the mean over the speeds that both have, N m.
    pub difference: Uncertain,
    /// Moment of the first over that of the second, from the means over those speeds, 1.
    pub ratio: f64,
}

/// Deviations from which on two moments count as different.
const APART: f64 = 3.0;
/// Part by which they must differ: coast-downs of one bearing repeat to some per cent.
const NOTABLE: f64 = 0.02;
/// Part from which on their mean is the moment of no state of the bearing.
const FOREIGN: f64 = 0.05;

impl Unequal {
    /// Whether no explanation may be sought with their mean.
    pub fn forbids_comparison(&self) -> bool {
        (self.ratio - 1.0).abs() > FOREIGN
    }

    /// What is found, with the names of the tests.
    pub fn finding(&self) -> String {
        format!(
            "the slow tests {} and {} differ by {:.2} ± {:.2} N mm, a ratio of {:.3}: M is a mean over different bearings, loads, temperatures or states of the lubricant; give those of one state",
            self.tests.0,
            self.tests.1,
            1e3 * self.difference.value,
            1e3 * self.difference.deviation,
            self.ratio
        )
    }
}

/// The pair that differs most, of those that speed up and of those that slow down; none where all are alike within their bands.
pub(super) fn unequal(
    tests: &[&Measurement],
    set: &RollingSet<f64>,
    settings: &MomentSettings,
) -> Option<Unequal> {
    if tests.len() < 2 {
        return None;
    }
    let alone: Vec<_> = (tests.iter())
        .map(|test| fitted(&[*test], set, settings).ok())
        .collect();
    let mut most: Option<Unequal> = None;
    for (k, one) in tests.iter().enumerate() {
        for (other, second) in tests[..k].iter().zip(&alone) {
            let (Some(first), Some(second)) = (&alone[k], second) else {
                continue;
            };
            if speeds_up(one) != speeds_up(other) {
                continue;
            }
            let Ok(found) = difference(&first.curve, &second.curve) else {
                continue;
            };
            let mean = found.mean;
            let level: f64 = (found.speed.iter())
                .filter_map(|speed| second.curve.without_scale(*speed))
                .map(|moment| moment.value)
                .sum::<f64>()
                / found.speed.len() as f64;
            let ratio = 1.0 + mean.value / level;
            let apart = mean.value.abs() > APART * mean.deviation && (ratio - 1.0).abs() > NOTABLE;
            if apart && (most.as_ref()).is_none_or(|m| (ratio - 1.0).abs() > (m.ratio - 1.0).abs())
            {
                most = Some(Unequal {
                    tests: (one.name.clone(), other.name.clone()),
                    difference: mean,
                    ratio,
                });
            }
        }
    }
    most
}
