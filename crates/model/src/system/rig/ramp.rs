//! The engagement that gives a wanted acceleration.
//!
//! ```text
//!   T_c = rate (t - t_e):  I Ω̇ = T_c - drags,  peak at the locking:  Ω̇_max ≈ √(2 Ω_end rate/I)
//! ```
//! Whatever constant drag delays the start does not change the peak; what grows with speed or time does a little. So the
//! rate is found by a secant on ln Ω̇_max over ln rate, which is nearly a straight line of slope ½, on runs of the rig with
//! balls that roll: they take milliseconds.

use super::clutch::Clutch;
use super::record::{Keep, Record};
use super::simulate::until_locked;
use super::{Action, RigConstants, RigMachine, RigRefusal};
use crate::bearing::{BearingConstants, RollingConstants};
use solve::{Settings, Stop};
use std::fmt;

/// Why there is no engagement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RampError {
    /// The program never engages the clutch.
    NoEngagement,
    /// Acceleration or speed are not positive.
    NotPositive,
    /// The rig cannot be built.
    Refused(RigRefusal),
    /// The clutch never locked.
    NeverLocks,
    /// The acceleration is out of reach.
    OutOfReach {
        /// The acceleration that came nearest, rad/s².
        nearest: f64,
    },
}

impl fmt::Display for RampError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RampError::NoEngagement => write!(f, "the program never engages the clutch"),
            RampError::NotPositive => {
                write!(f, "the wanted acceleration and the speed must be positive")
            }
            RampError::Refused(why) => write!(f, "{why}"),
            RampError::NeverLocks => write!(
                f,
                "the clutch never locks: its capacity does not carry the shaft to the flywheel's speed"
            ),
            RampError::OutOfReach { nearest } => write!(
                f,
                "no engagement gives the wanted acceleration; the nearest is {nearest:.4e} rad/s²: see the largest capacity of the clutch"
            ),
        }
    }
}

impl std::error::Error for RampError {}

/// Relative error of the acceleration that ends the search.
const FOUND: f64 = 1e-4;
/// Runs of a search.
const RUNS: usize = 25;

/// The rise of the clutch's capacity (N m/s) with which the largest acceleration of the shaft in the test is the wanted one
/// (rad/s²), to 0.01 %, the balls rolling. The test is the program of the rig, up to the first locking; the rate of its
/// engagements is what is sought.
///
/// - `speed`: that the shaft comes to, rad/s; of its size the search only takes a guess
pub fn engagement_ramp(
    constants: &RigConstants,
    acceleration: f64,
    speed: f64,
) -> Result<f64, RampError> {
    let (acceleration, speed) = (acceleration.abs(), speed.abs());
    let sound = |value: f64| value.is_finite() && value > 0.0;
    if !(sound(acceleration) && sound(speed)) {
        return Err(RampError::NotPositive);
    }
    let engaged_at = (constants.program.actions.iter())
        .find_map(|(time, action)| matches!(action, Action::Engage(_)).then_some(*time))
        .ok_or(RampError::NoEngagement)?;
    let mut rig = constants.clone();
    if let BearingConstants::Planar(bearing) = &rig.bearing {
        rig.bearing = BearingConstants::Rolling(RollingConstants::of(bearing));
    }
    let inertia = rig.shaft.inertia + rig.bearing.set().inner_inertia();
    let duration = 2.0 * speed / acceleration;
    let end = engaged_at + 10.0 * duration + 10.0;

    let mut rate = 0.5 * inertia * acceleration * acceleration / speed;
    let mut last: Option<(f64, f64)> = None;
    let mut nearest = f64::INFINITY;
    for _ in 0..RUNS {
        let peak = peak_acceleration(&rig, rate, end)?;
        let off = (peak / acceleration).ln();
        if off.abs() < FOUND {
            return Ok(rate);
        }
        if off.abs() < (nearest / acceleration).ln().abs() {
            nearest = peak;
        }
        let here = (rate.ln(), off);
        // ½ by the formula above; a secant that leads far away is none
        let slope = match last {
            Some(last) if here.0 != last.0 => ((here.1 - last.1) / (here.0 - last.0)).max(0.1),
            _ => 0.5,
        };
        last = Some(here);
        rate = (here.0 - (off / slope).clamp(-3.0, 3.0)).exp();
    }
    Err(RampError::OutOfReach { nearest })
}

/// Largest acceleration of the shaft up to the locking, rad/s².
fn peak_acceleration(rig: &RigConstants, rate: f64, end: f64) -> Result<f64, RampError> {
    let mut rig = rig.clone();
    for (_, action) in &mut rig.program.actions {
        if let Action::Engage(by) = action {
            by.rate = rate;
        }
    }
    let machine = RigMachine::new(rig).map_err(RampError::Refused)?;
    let keep = Keep {
        end,
        interval: None,
        taps: &[],
    };
    let mut record = Record::new(&machine, &keep);
    let settings = Settings {
        start: 0.0,
        end,
        tolerance: 1e-5,
        first_step: 1e-6,
        largest_step: 1e-2,
        step_limit: 1_000_000,
    };
    let run = until_locked(&machine, &settings, &mut record);
    match run.ending.stop {
        Stop::Halted(_) if run.mode.clutch == Clutch::Locked => Ok(record.acceleration.value),
        _ => Err(RampError::NeverLocks),
    }
}
