//! A spin-up as typed values in SI.

pub mod checks;
pub mod keys;

use crate::bearing::{Bearing, bearing};
use crate::heat::{Network, Warm};
use crate::run::Run;
use crate::section::Section;
use crate::values::Values;
use problem::words;

/// The inner race of a bearing is brought to speed while its outer race stands. All values are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct SpinUp {
    /// What turns the inner race.
    pub drive: Drive,
    /// Radial force on the inner race, N.
    pub radial_load: Course,
    /// Direction of the radial force, rad from x.
    pub load_direction: f64,
    /// The bearing.
    pub bearing: Bearing,
    /// What warms of it, where that is followed.
    pub warm: Option<Box<Warm>>,
    /// The simulation.
    pub run: Run,
}

/// A value that is constant or follows a table over time.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// Constant.
    Constant(f64),
    /// Rows of time, s, and value, straight between them and constant after the last.
    Table(Vec<[f64; 2]>),
}

words! {
    /// What turns the inner race, as a word.
    pub enum DriveKind {
        SlidingRotor = "sliding rotor",
        Torque = "torque",
        /// A given speed.
        Speed = "speed",
    }
}

words! {
    /// The spin of a sliding rotor, as a word.
    pub enum RotorSpin {
        Held = "held",
        Free = "free",
    }
}

/// What turns the inner race.
#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    /// A rotor that slides in the bore, pressed on it by the radial load.
    SlidingRotor {
        /// Spin of the rotor at time 0, rad/s.
        rotor_speed: f64,
        /// Inertia of a rotor that is free to slow down, kg m²; none where its spin is held.
        rotor_polar_inertia: Option<f64>,
        /// Diameter at which it slides, m.
        bore_diameter: f64,
        /// Coefficient of sliding friction.
        friction_coefficient: f64,
        /// Slip speed that regularises the friction, m/s.
        friction_reference_speed: f64,
    },
    /// A torque, N m.
    Torque {
        /// The torque.
        torque: Course,
        /// Speed that counts as full, rad/s.
        reference_speed: f64,
    },
    /// A drive that gives the inner race its speed, rad/s.
    Speed(SpeedCourse),
}

/// The speed that a drive gives.
#[derive(Clone, Debug, PartialEq)]
pub enum SpeedCourse {
    /// The final speed from time 0, while the balls are at rest.
    Step {
        /// Final speed, rad/s.
        final_speed: f64,
    },
    /// From rest with constant acceleration.
    Ramp {
        /// Final speed, rad/s.
        final_speed: f64,
        /// Size of the acceleration, rad/s².
        acceleration: f64,
    },
    /// Rows of time, s, and speed, rad/s, straight between them and constant after the last.
    Table(Vec<[f64; 2]>),
}

impl SpinUp {
    pub(crate) fn from_values(values: &Values) -> SpinUp {
        let section = values.section("drive");
        let radial_load = course(&section, "radial_load", "load_history");
        let run = Run::from_values(values);
        let load = radial_load.at(run.duration);
        let followed = values.chosen("heat.network") == Some(Network::On);
        let slides = section.chosen("kind") == Some(DriveKind::SlidingRotor);
        let warm = || Warm::from_values(values, load).on_rotor(!slides);
        SpinUp {
            warm: followed.then(|| Box::new(warm())),
            radial_load,
            load_direction: section.number("load_direction"),
            drive: drive(&section),
            bearing: bearing(values),
            run,
        }
    }

    /// The speed that counts as full, rad/s, of either sign: that of the rotor, the final one, or the largest of a table.
    pub fn target_speed(&self) -> f64 {
        match &self.drive {
            Drive::SlidingRotor { rotor_speed, .. } => *rotor_speed,
            // the race turns where the torque pushes it first
            Drive::Torque {
                reference_speed,
                torque,
            } => reference_speed.abs() * torque.first_sign(),
            Drive::Speed(
                SpeedCourse::Step { final_speed } | SpeedCourse::Ramp { final_speed, .. },
            ) => *final_speed,
            Drive::Speed(SpeedCourse::Table(rows)) => {
                let larger = |most: f64, row: &[f64; 2]| {
                    if row[1].abs() > most.abs() {
                        row[1]
                    } else {
                        most
                    }
                };
                rows.iter().fold(0.0, larger)
            }
        }
    }
}

impl Course {
    /// Sign of the first value that is not zero; +1 where there is none.
    pub fn first_sign(&self) -> f64 {
        let first = match self {
            Course::Constant(value) => Some(*value),
            Course::Table(rows) => rows.iter().map(|row| row[1]).find(|value| *value != 0.0),
        };
        first.map_or(1.0, f64::signum)
    }

    /// The largest size of the value.
    pub fn largest(&self) -> f64 {
        match self {
            Course::Constant(value) => value.abs(),
            Course::Table(rows) => rows.iter().fold(0.0, |most, row| row[1].abs().max(most)),
        }
    }

    /// The largest size of the value from time 0 to an end.
    pub fn largest_until(&self, end: f64) -> f64 {
        let rows = match self {
            Course::Constant(_) => &[][..],
            Course::Table(rows) => rows,
        };
        let inside = rows.iter().filter(|row| row[0] <= end);
        inside.fold(self.at(end).abs(), |most, row| row[1].abs().max(most))
    }

    /// The value at a time.
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Course::Constant(value) => *value,
            Course::Table(rows) => {
                let after = rows.partition_point(|row| row[0] <= time);
                match (
                    after.checked_sub(1).and_then(|i| rows.get(i)),
                    rows.get(after),
                ) {
                    (Some(left), Some(right)) => {
                        left[1] + (right[1] - left[1]) * (time - left[0]) / (right[0] - left[0])
                    }
                    (Some(only), None) | (None, Some(only)) => only[1],
                    (None, None) => 0.0,
                }
            }
        }
    }
}

fn course(section: &Section<'_>, constant: &str, table: &str) -> Course {
    match section.rows(table) {
        Some(rows) => Course::Table(rows),
        None => Course::Constant(section.number(constant)),
    }
}

fn drive(section: &Section<'_>) -> Drive {
    match section.choice("kind") {
        DriveKind::Torque => Drive::Torque {
            torque: course(section, "torque", "torque_history"),
            reference_speed: section.number("reference_speed"),
        },
        DriveKind::Speed => Drive::Speed(
            match (section.rows("speed_history"), section.maybe("acceleration")) {
                (Some(rows), _) => SpeedCourse::Table(rows),
                (None, Some(acceleration)) => SpeedCourse::Ramp {
                    final_speed: section.number("final_speed"),
                    acceleration,
                },
                (None, None) => SpeedCourse::Step {
                    final_speed: section.number("final_speed"),
                },
            },
        ),
        DriveKind::SlidingRotor => Drive::SlidingRotor {
            rotor_speed: section.number("rotor_speed"),
            rotor_polar_inertia: section.maybe("rotor_polar_inertia"),
            bore_diameter: section.number("bore_diameter"),
            friction_coefficient: section.number("friction_coefficient"),
            friction_reference_speed: section.number("friction_reference_speed"),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_course_is_straight_between_its_rows_and_constant_outside() {
        let course = Course::Table(vec![[1.0, 10.0], [3.0, -20.0]]);
        for (time, value) in [
            (0.0, 10.0),
            (1.0, 10.0),
            (2.0, -5.0),
            (3.0, -20.0),
            (9.0, -20.0),
        ] {
            assert_eq!(course.at(time), value, "{time}");
        }
        assert_eq!(course.largest(), 20.0);
        for (end, largest) in [(0.5, 10.0), (2.0, 10.0), (2.8, 17.0), (9.0, 20.0)] {
            // one rounding of a row's slope
            assert!((course.largest_until(end) - largest).abs() < 1e-12, "{end}");
        }
    }
}
