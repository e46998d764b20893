//! A test whose torque and cage speed are as uncertain as their prediction.
//!
//! ```text
//!   σ² = σ_t² + (M' σ_Ω)² + (J_O σ_Ω̇)²                 the torque of rolling balls, M(Ω) - J_O Ω̇, by speed and acceleration
//!      + (J_O Ω̇_peak)²                                 within a window around the largest |Ω̇|, where a clutch locks
//!   σ_c'² = σ_c² + (ρ ω_c)²                            ρ: ratio of the cage's rolling speed to the shaft's
//! ```
//! [`explain`](super::explain()) takes speed and acceleration as they are; what is not known of them counts here as an error of the
//! torque. Where a clutch locks the inertia's part of the torque jumps, which no smoothed torque follows: there it is not known.
//!
//! **Does not model**: errors of speed and acceleration that are alike at neighbouring times, other than as errors of the torque are.

use crate::{Measurement, SteadyMoment};
use physics::rolling::RollingSet;

/// How well a test can be predicted beside its own deviations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictionErrors {
    /// Time around the largest acceleration within which a jump of the torque is smeared, s.
    pub locking_window: f64,
    /// Relative standard deviation of the ratio of the cage's rolling speed to the shaft's: contact angle and radii, and a shaft's
    /// speed where its acceleration changes at once. A slip that explains a torque is ten times that.
    pub rolling_ratio_deviation: f64,
}

impl Default for PredictionErrors {
    /// 10 ms, about 1/ω_n of usual arms (16 ms at 10 Hz, 5 ms at 30 Hz); a ratio to 0.2 %: in a 6005 diameters that are off by 1 %, or a contact angle
    /// of 8° taken as none.
    fn default() -> Self {
        Self {
            locking_window: 0.01,
            rolling_ratio_deviation: 0.002,
        }
    }
}

/// The test with the errors of its prediction in its deviations.
///
/// - `test`: as measured
/// - `steady`: M(Ω) of the slow tests
/// - `set`: balls and cage
/// - `how`: how well it can be predicted
pub fn with_prediction_errors(
    test: &Measurement,
    steady: &SteadyMoment,
    set: &RollingSet<f64>,
    how: &PredictionErrors,
) -> Measurement {
    let mut test = test.clone();
    by_motion(&mut test, steady, set);
    near_locking(&mut test, set, how.locking_window);
    if let Some(cage) = &mut test.cage {
        for (speed, deviation) in cage.speed.iter().zip(&mut cage.deviation) {
            *deviation = deviation.hypot(how.rolling_ratio_deviation * speed);
        }
    }
    test
}

/// Formula: σ² + (M' σ_Ω)² + (J_O σ_Ω̇)²; below the slowest speed that was measured M falls to nothing in a straight line
fn by_motion(test: &mut Measurement, steady: &SteadyMoment, set: &RollingSet<f64>) {
    let slowest = steady.range().0;
    let near_rest = steady.at(slowest).map_or(0.0, |m| m.value / slowest);
    for (k, deviation) in test.torque_deviation.iter_mut().enumerate() {
        let slope = steady.slope(test.speed[k]).unwrap_or(near_rest);
        let by_speed = slope * test.speed_deviation[k];
        let by_inertia = set.outer_inertia() * test.acceleration_deviation[k];
        *deviation = deviation.hypot(by_speed).hypot(by_inertia);
    }
}

/// Formula: σ² + (J_O Ω̇_peak)² within the window around the largest |Ω̇|
fn near_locking(test: &mut Measurement, set: &RollingSet<f64>, window: f64) {
    let Some((at, peak)) =
        (test.acceleration.iter().enumerate()).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    else {
        return;
    };
    let jump = set.outer_inertia() * peak.abs();
    let locked = test.time[at];
    for (time, deviation) in test.time.iter().zip(&mut test.torque_deviation) {
        if (time - locked).abs() < window {
            *deviation = deviation.hypot(jump);
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/explain_prediction_errors.rs"]
mod tests;
