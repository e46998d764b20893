//! Means of measured signals over some time: integrals of the straight lines between their values.
//!
//! Rows lie closer where the speed bends, and balls pass in unequal times: a mean of the values would be that of the time with the
//! most of them.

use crate::series::{RunningVariance, trapezoid};
use crate::{CageTrace, Measurement};
use statistics::interpolation::held;

/// A mean of the cage speed over the part of a time that its signal covers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CageMean {
    /// Times since the engagement, s.
    pub from: f64,
    pub to: f64,
    /// rad/s.
    pub speed: f64,
    /// Its variance, (rad/s)².
    pub variance: f64,
}

/// Mean of a list over some time, and its variance; none where no value lies inside, or the list does not reach that time.
///
/// - `time`: times of the values; rising
/// - `deviation`, `age`: of their errors, the age in correlation times
/// - `from`, `to`: cut to where the list is, and returned
fn mean(
    time: &[f64],
    values: &[f64],
    deviation: &dyn Fn(f64) -> f64,
    age: &[f64],
    (from, to): (f64, f64),
) -> Option<((f64, f64), f64, f64)> {
    let inside = time.partition_point(|t| *t < from)..time.partition_point(|t| *t < to);
    let (from, to) = (from.max(*time.first()?), to.min(*time.last()?));
    if inside.is_empty() || to <= from {
        return None;
    }
    let mut knots = vec![from];
    knots.extend(time[inside].iter().filter(|t| **t > from && **t < to));
    knots.push(to);
    let (mut sum, mut variance) = (0.0, 0.0);
    let mut error = RunningVariance::default();
    for (t, weight) in knots.iter().zip(trapezoid(&knots)) {
        let share = weight / (to - from);
        sum += share * held(time, values, *t);
        variance = error.add(held(time, age, *t), share * deviation(*t));
    }
    Some(((from, to), sum, variance))
}

/// Least part of the variance of a torque that is its own: what zero and scale leave is not more certain than that.
const LEAST_OWN: f64 = 0.01;

/// Mean of the torque over some time, N m, and its variance without zero and scale; infinite without data.
///
/// - `age`: age of the noise at each time, correlation times
pub(super) fn torque_mean(
    measurement: &Measurement,
    age: &[f64],
    from: f64,
    to: f64,
) -> (f64, f64) {
    let time = &measurement.time;
    let own = |t: f64| {
        let value = held(time, &measurement.torque, t);
        let square = held(time, &measurement.torque_deviation, t).powi(2);
        let shared =
            measurement.zero_deviation.powi(2) + (measurement.scale_deviation * value).powi(2);
        (square - shared).max(LEAST_OWN * square).sqrt()
    };
    mean(time, &measurement.torque, &own, age, (from, to))
        .map_or((0.0, f64::INFINITY), |(_, torque, variance)| {
            (torque, variance)
        })
}

/// Whether the torque between two times is zero by definition, because the zero was taken there: its deviation is less than the
/// zero's, and it says nothing of how far the zero is off.
pub(super) fn zeroed(measurement: &Measurement, from: f64, to: f64) -> bool {
    let time = &measurement.time;
    let inside = time.partition_point(|t| *t < from)..time.partition_point(|t| *t < to);
    let count = inside.len() as f64;
    let square: f64 = (measurement.torque_deviation[inside].iter())
        .map(|d| d * d)
        .sum();
    square < count * measurement.zero_deviation.powi(2)
}

/// Mean of the cage speed over the part of a time that its signal covers; none without a value in it.
///
/// - `age`: of the cage's errors in correlation times
pub(super) fn cage_mean(cage: &CageTrace, age: &[f64], from: f64, to: f64) -> Option<CageMean> {
    let deviation = |t: f64| held(&cage.time, &cage.deviation, t);
    let ((from, to), speed, variance) = mean(&cage.time, &cage.speed, &deviation, age, (from, to))?;
    Some(CageMean {
        from,
        to,
        speed,
        variance,
    })
}

#[cfg(test)]
#[path = "../../tests/unit/explain_means.rs"]
mod tests;
