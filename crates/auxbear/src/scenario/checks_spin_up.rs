//! Checks of a spin-up.

use super::bearing::Fidelity;
use super::checks::{Check, Context};
use super::spin_up::{Drive, SpeedCourse, SpinUp};
use crate::problem::{Code, Place, Problem};

impl Context<'_> {
    pub(super) fn spin_up(&self, spin_up: &SpinUp) -> Check {
        let bore = match spin_up.drive {
            Drive::SlidingRotor { bore_diameter, .. } => {
                Some(("drive.bore_diameter", bore_diameter))
            }
            Drive::Torque { .. } | Drive::Speed(_) => None,
        };
        self.bearing(&spin_up.bearing, bore)?;
        self.some_speed(spin_up)?;
        self.step(spin_up)?;
        self.output(&spin_up.run, spin_up.bearing.ball_count)
    }

    /// Scales of errors and times refer to the speed.
    fn some_speed(&self, spin_up: &SpinUp) -> Check {
        if spin_up.target_speed() != 0.0 {
            return Ok(());
        }
        let path = match spin_up.drive {
            Drive::SlidingRotor { .. } => "drive.rotor_speed",
            Drive::Torque { .. } => "drive.reference_speed",
            Drive::Speed(SpeedCourse::Table(_)) => "drive.speed_history",
            Drive::Speed(_) => "drive.final_speed",
        };
        Err(Box::new(self.problem(
            Code::OutOfRange,
            path,
            self.text(path),
            "an angular speed other than 0 is needed".to_string(),
        )))
    }

    /// Balls that always roll would need an infinite torque.
    fn step(&self, spin_up: &SpinUp) -> Check {
        let Drive::Speed(course) = &spin_up.drive else {
            return Ok(());
        };
        if spin_up.bearing.fidelity == Fidelity::Planar {
            return Ok(());
        }
        let problem: Problem = match course {
            SpeedCourse::Ramp { .. } => return Ok(()),
            SpeedCourse::Step { .. } => self
                .problem(
                    Code::Impossible,
                    "drive.acceleration",
                    "no value, so a step of speed".to_string(),
                    "an angular acceleration above 0 is needed with bearing.fidelity = \"rolling\", e.g. \"7200 rad/s^2\": balls that always roll cannot follow a step".to_string(),
                )
                .at(Place::Whole),
            SpeedCourse::Table(rows) if rows.first().is_none_or(|row| row[1] == 0.0) => {
                return Ok(());
            }
            SpeedCourse::Table(_) => self.problem(
                Code::Impossible,
                "drive.speed_history",
                "a speed other than 0 at time 0, so a step".to_string(),
                "a first row with speed 0 is needed with bearing.fidelity = \"rolling\": balls that always roll cannot follow a step".to_string(),
            ),
        };
        Err(Box::new(problem))
    }
}
