//! Slow tests that do not have the same moment: their mean is that of none of them.

use super::fitted::{difference, fitted, speeds_up};
use super::found::Unequal;
use crate::measurement::Measurement;
use physics::rolling::RollingSet;

/// Deviations from which on two moments count as different.
const APART: f64 = 3.0;
/// Part by which they must differ: coast-downs of one bearing repeat to some per cent.
const NOTABLE: f64 = 0.02;
/// The pair that differs most, of those that speed up and of those that slow down; none where all are alike within their bands.
pub(super) fn unequal(
    tests: &[&Measurement],
    set: &RollingSet<f64>,
    viscosity: Option<f64>,
) -> Option<Unequal> {
    if tests.len() < 2 {
        return None;
    }
    let alone: Vec<_> = (tests.iter())
        .map(|test| fitted(&[*test], set, viscosity).ok())
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
