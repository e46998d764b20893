//! The torque beyond the steady moment in the two parts of a test that an engineer looks at.
//!
//! ```text
//!   settled      mean of t_O - M from 0.2 to 0.4 s after the engagement: the arm has settled, the slow change has not begun
//!   at the end   mean of t_O - M over the last 0.5 s at full speed
//! ```
//! Errors close in time are shared: a mean is no more certain than one of its values.

use super::Loss;
use crate::measurement::Measurement;
use crate::series::trapezoid;
use statistics::uncertain::Uncertain;

/// Time after the engagement from which on, and until when, the settled torque is taken, s.
const SETTLED: (f64, f64) = (0.2, 0.4);
/// Length of the end of the hold over which the last torque is taken, s.
const LAST: f64 = 0.5;
/// Deviations from which on the torque counts as off the steady moment.
const OFF: f64 = 3.0;

impl Loss {
    /// Mean of t_O - M between two times, N m; none where it is known at none of them.
    ///
    /// Formula: mean of the values over time, mean of their deviations
    ///
    /// - `from`, `to`: times, s, both included
    pub fn mean_excess(&self, from: f64, to: f64) -> Option<Uncertain> {
        // by time: rows lie closer where the speed bends
        let time: Vec<f64> = self.points.iter().map(|point| point.time).collect();
        let (mut whole, mut value, mut deviation) = (0.0, 0.0, 0.0);
        for (point, weight) in self.points.iter().zip(trapezoid(&time)) {
            if let Some(excess) = point
                .excess
                .filter(|_| point.time >= from && point.time <= to)
            {
                whole += weight;
                value += weight * excess.value;
                deviation += weight * excess.deviation;
            }
        }
        (whole > 0.0).then(|| Uncertain::new(value / whole, deviation / whole))
    }

    /// t_O - M 0.2 to 0.4 s after the engagement, N m.
    ///
    /// - `test`: the test of this loss
    pub fn settled_excess(&self, test: &Measurement) -> Option<Uncertain> {
        let begin = test.begin();
        self.mean_excess(begin + SETTLED.0, begin + SETTLED.1)
    }

    /// t_O - M over the last 0.5 s at full speed, N m.
    ///
    /// - `test`: the test of this loss
    pub fn excess_at_end(&self, test: &Measurement) -> Option<Uncertain> {
        let end = test.last_at_speed();
        self.mean_excess(end - LAST, end)
    }

    /// t_O - M at the end of the hold, or where it is not known there once settled, N m, where it is off 0 by more than three
    /// deviations: the lubricant or the sensor was in another state than in the slow tests, and what is left is not F alone.
    ///
    /// - `test`: the test of this loss
    pub fn off_the_moment(&self, test: &Measurement) -> Option<Uncertain> {
        let excess = (self.excess_at_end(test)).or_else(|| self.settled_excess(test))?;
        (excess.value.abs() > OFF * excess.deviation).then_some(excess)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/loss_excess.rs"]
mod tests;
