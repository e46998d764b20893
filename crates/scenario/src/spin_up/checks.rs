//! Checks of a spin-up.

use crate::bearing::kind::Fidelity;
use crate::bearing::moment::AccelerationLoss;
use crate::checks::{Check, Context};
use crate::spin_up::{Course, Drive, SpeedCourse, SpinUp};
use problem::{Code, Place};

impl Context<'_> {
    pub(crate) fn spin_up(&self, spin_up: &SpinUp) -> Check {
        let bore = match spin_up.drive {
            Drive::SlidingRotor { bore_diameter, .. } => {
                Some(("drive.bore_diameter", bore_diameter))
            }
            Drive::Torque { .. } | Drive::Speed(_) => None,
        };
        let loaded = spin_up.radial_load.largest() > 0.0;
        self.bearing(&spin_up.bearing, bore, loaded)?;
        if let Some(warm) = &spin_up.warm {
            self.warm(warm)?;
        }
        self.some_speed(spin_up)?;
        self.some_drive(spin_up)?;
        self.step(spin_up)?;
        self.braking(spin_up)?;
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
        self.refuse_value(
            Code::OutOfRange,
            path,
            "an angular speed other than 0 is needed",
        )
    }

    /// Without a force the rotor turns nothing, and no energy is there to compare anything with.
    fn some_drive(&self, spin_up: &SpinUp) -> Check {
        let end = spin_up.run.duration;
        let (course, value, history, needed) = match &spin_up.drive {
            Drive::SlidingRotor {
                friction_coefficient,
                ..
            } if *friction_coefficient == 0.0 => {
                let path = "drive.friction_coefficient";
                return self.refuse_value(
                    Code::Impossible,
                    path,
                    "a coefficient above 0 is needed: without friction the rotor turns nothing",
                );
            }
            Drive::SlidingRotor { .. } => (
                &spin_up.radial_load,
                "drive.radial_load",
                "drive.load_history",
                "a force above 0 is needed at some time of the run: the rotor turns the race by its friction, so without load nothing moves",
            ),
            Drive::Torque { torque, .. } => (
                torque,
                "drive.torque",
                "drive.torque_history",
                "a torque other than 0 is needed at some time of the run: without it nothing moves",
            ),
            Drive::Speed(_) => return Ok(()),
        };
        let (path, found) = match course {
            _ if course.largest_until(end) > 0.0 => return Ok(()),
            Course::Constant(_) => (value, self.text(value)),
            Course::Table(_) => {
                let end = self.text("run.duration");
                (history, format!("nothing but 0 until run.duration = {end}"))
            }
        };
        self.refuse(Code::Impossible, path, found, needed)
    }

    /// Balls that always roll would need an infinite torque.
    fn step(&self, spin_up: &SpinUp) -> Check {
        let Drive::Speed(course) = &spin_up.drive else {
            return Ok(());
        };
        if spin_up.bearing.fidelity == Fidelity::Planar {
            return Ok(());
        }
        let problem = match course {
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
        Err(problem)
    }

    /// A loss per acceleration that outweighs the inertia would leave a race that slows down without an answer.
    fn braking(&self, spin_up: &SpinUp) -> Check {
        let (path, largest) = match &spin_up.bearing.acceleration_loss {
            AccelerationLoss::Proportional { per_acceleration } => (
                "bearing.acceleration_loss.per_acceleration",
                *per_acceleration,
            ),
            AccelerationLoss::Affine {
                per_acceleration_over_speed,
                ..
            } => (
                "bearing.acceleration_loss.per_acceleration_over_speed",
                (per_acceleration_over_speed.iter()).fold(0.0, |most: f64, row| most.max(row[1])),
            ),
            _ => return Ok(()),
        };
        if matches!(spin_up.drive, Drive::Speed(_)) {
            return Ok(());
        }
        let set = spin_up.bearing.rolling_set();
        let most =
            (spin_up.bearing.inner_race_inertia + set.inner_inertia()) / set.pocket_friction_arm();
        if largest < most {
            return Ok(());
        }
        self.refuse(
            Code::Impossible,
            path,
            format!("{} N s^2/rad", units::number_text(largest)),
            format!(
                "less than {most:.3e} N s^2/rad is needed, the inertia of race, balls and cage over the arm of F: beyond, a race that slows down would be pushed on by its own loss"
            ),
        )
    }
}
