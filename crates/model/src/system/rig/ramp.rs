//! The engagement that gives a wanted acceleration.
//!
//! ```text
//!   T_c = rate (t - t_e):  I Ω̇ = T_c - drags,  peak at the locking:  Ω̇_max ≈ √(2 Ω_end rate/I)
//! ```
//! Whatever constant drag delays the start does not change the peak; what grows with speed or time does a little. So the
//! rate is found by a secant on ln Ω̇_max over ln rate, which is nearly a straight line of slope ½, on runs of the rig with
//! balls that roll: they take milliseconds.

use super::mode::Clutch;
use super::{Action, Drive, Refusal, RigConstants};
use crate::bearing::{BearingConstants, RollingConstants};
use crate::system::machine::record::Record;
use crate::system::machine::simulate::{Runs, simulate};
use crate::system::machine::{Mode, RotorMachine};
use solve::{Flow, Observer, Settings, Step, Steps, Stop};
use std::fmt;
use std::sync::atomic::AtomicBool;

/// Why there is no engagement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RampError {
    /// The program never engages the clutch.
    NoEngagement,
    /// Acceleration or speed are not positive.
    NotPositive,
    /// The rig cannot be built.
    Refused(Refusal),
    /// The clutch never locked, however quickly it engaged.
    NeverLocks,
    /// With the wanted acceleration the shaft does not come to the flywheel's speed before the test ends or the clutch is released.
    TooSlow {
        /// The smallest acceleration with which it was seen to, rad/s².
        smallest: f64,
    },
    /// The acceleration is out of reach.
    OutOfReach {
        /// The largest acceleration that was seen, or the nearest where it lies between those that were, rad/s².
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
            RampError::TooSlow { smallest } => write!(
                f,
                "the shaft does not come to the flywheel's speed before the clutch is released or the search ends; the smallest acceleration with which it was seen to is {smallest:.3e} rad/s²"
            ),
            RampError::OutOfReach { nearest } => write!(
                f,
                "no engagement gives the wanted acceleration; the nearest that was seen is {nearest:.3e} rad/s²: see the largest capacity of the clutch"
            ),
        }
    }
}

impl std::error::Error for RampError {}

/// Relative error of the acceleration that ends the search.
const FOUND: f64 = 1e-4;
/// Runs of a search.
const RUNS: usize = 25;
/// Runs without a locking, each with 20 times the rate of the one before, after which the clutch is too weak.
const TRIES: usize = 8;
/// Rates that are looked at where the search fails, each e times the one before: from below the guess to above it.
const SCAN: std::ops::RangeInclusive<i32> = -20..=4;

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
    let Drive::Clutch(clutch) = &constants.drive else {
        return Err(RampError::NoEngagement);
    };
    let actions = &clutch.program.actions;
    let engaged_at = (actions.iter())
        .find_map(|(time, action)| matches!(action, Action::Engage(_)).then_some(*time))
        .ok_or(RampError::NoEngagement)?;
    let mut rig = constants.clone();
    if let BearingConstants::Planar(bearing) = &rig.bearing {
        rig.bearing = BearingConstants::Rolling(RollingConstants::of(bearing));
    }
    let inertia = rig.race.inertia + rig.bearing.set().inner_inertia();
    let duration = 2.0 * speed / acceleration;
    // released again, it never locks later
    let released = (actions.iter())
        .filter(|(time, action)| *time > engaged_at && matches!(action, Action::Disengage))
        .map(|(time, _)| *time);
    let end = released.fold(engaged_at + 10.0 * duration + 10.0, f64::min);

    let guess = 0.5 * inertia * acceleration * acceleration / speed;
    let mut rate = guess;
    let mut last: Option<(f64, f64)> = None;
    let mut seen = Tried::default();
    for run in 0..RUNS {
        let Some(peak) = peak_acceleration(&rig, rate, end)? else {
            if seen.locked.is_empty() && run + 1 >= TRIES {
                return Err(RampError::NeverLocks);
            }
            seen.loose = seen.loose.max(rate);
            rate = match seen.slowest() {
                Some((locked, _)) => (rate * locked).sqrt(),
                None => 20.0 * rate,
            };
            last = None;
            continue;
        };
        let off = (peak / acceleration).ln();
        if off.abs() < FOUND {
            return Ok(rate);
        }
        seen.locked.push((rate, peak));
        let here = (rate.ln(), off);
        // ½ by the formula above; a secant that leads far away is none
        let slope = match last {
            Some(last) if here.0 != last.0 => ((here.1 - last.1) / (here.0 - last.0)).max(0.1),
            _ => 0.5,
        };
        last = Some(here);
        let next = (here.0 - (off / slope).clamp(-3.0, 3.0)).exp();
        // slower than what never locks there is nothing
        rate = if next > seen.loose {
            next
        } else {
            (seen.loose * rate).sqrt()
        };
    }
    if let Some((_, smallest)) = seen.slowest()
        && seen.loose > 0.0
        && acceleration < smallest
    {
        return Err(RampError::TooSlow { smallest });
    }
    for step in SCAN {
        let rate = guess * f64::from(step).exp();
        if let Some(peak) = peak_acceleration(&rig, rate, end)? {
            seen.locked.push((rate, peak));
        }
    }
    let off = |peak: f64| (peak / acceleration).ln().abs();
    let peaks = seen.locked.iter().map(|(_, peak)| *peak);
    let nearest = peaks.fold(f64::NAN, |nearest: f64, peak| {
        if off(peak) < off(nearest) || nearest.is_nan() {
            peak
        } else {
            nearest
        }
    });
    Err(RampError::OutOfReach { nearest })
}

/// What a search has seen.
#[derive(Default)]
struct Tried {
    /// Largest rate with which the clutch never locked, N m/s; 0 where there was none.
    loose: f64,
    /// Rates with which it did, N m/s, and the largest acceleration of each, rad/s².
    locked: Vec<(f64, f64)>,
}

impl Tried {
    fn slowest(&self) -> Option<(f64, f64)> {
        let rates = self.locked.iter().copied();
        rates.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// Largest acceleration of the shaft up to the locking, rad/s²; none where the clutch does not lock.
fn peak_acceleration(rig: &RigConstants, rate: f64, end: f64) -> Result<Option<f64>, RampError> {
    let mut rig = rig.clone();
    if let Drive::Clutch(clutch) = &mut rig.drive {
        for (_, action) in &mut clutch.program.actions {
            if let Action::Engage(by) = action {
                by.rate = rate;
            }
        }
    }
    let machine = RotorMachine::on_rig(rig).map_err(RampError::Refused)?;
    let mut first = UntilLocked(Record::with_taps(&machine, end, None, &[]));
    let settings = Settings {
        start: 0.0,
        end,
        tolerance: 1e-5,
        first_step: 1e-6,
        largest_step: 1e-2,
        step_limit: 1_000_000,
    };
    let never = AtomicBool::new(false);
    let runs = Runs {
        machines: &[&machine],
        starts: &[machine.start()],
        settings,
        steps: Steps::Explicit,
        interrupt: &never,
    };
    let endings = simulate(runs, &mut [&mut first]);
    let locked = matches!(endings[0].stop, Stop::Halted(_));
    Ok(locked.then_some(first.0.rig().acceleration.value))
}

/// A record that ends where the clutch locks.
struct UntilLocked(Record);

impl Observer<RotorMachine> for UntilLocked {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        self.0.step(step)
    }
    fn switched(
        &mut self,
        machine: &RotorMachine,
        mode: &Mode<f64>,
        time: f64,
        state: &[f64],
    ) -> Flow {
        self.0.switched(machine, mode, time, state);
        match mode.clutch.state {
            Clutch::Locked => Flow::Halt("the clutch has locked"),
            Clutch::Open | Clutch::Slipping { .. } => Flow::Continue,
        }
    }
}
