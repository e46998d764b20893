//! From a spin-up to the constants of the model.

use crate::bearing;
use crate::bearing::loss::table;
use crate::bearing::steady::{SteadyPoint, refused};
use crate::rig::run::RigModel;
use model::auxiliary_bearing::RaceConstants;
use model::system::machine::RotorMachine;
use model::system::rig::{Drive, RigConstants, SlidingRotor};
use model::table::Table;
use number::Vec2;
use problem::Problem;
use scenario::{Course, Drive as DriveChoice, SpeedCourse, SpinUp};

/// Builds the machine of a spin-up. The weight of the balls is left out: it is a thousandth of any load.
pub fn spin_up(spin_up: &SpinUp) -> Result<RigModel, Box<Problem>> {
    let (sine, cosine) = spin_up.load_direction.sin_cos();
    let gravity = Vec2::zero();
    let race = RaceConstants {
        mass: spin_up.bearing.inner_race_mass,
        inertia: spin_up.bearing.inner_race_inertia,
        centre_held: spin_up.bearing.inner_race_centre_held,
        torque: 0.0,
    };
    let contacts = bearing::contacts::ball_contacts(&spin_up.bearing)?;
    let bearing = bearing::build::bearing(&spin_up.bearing, &contacts, gravity)?;
    let target_speed = spin_up.target_speed();
    let at = SteadyPoint {
        speed: target_speed,
        load: spin_up.radial_load.at(spin_up.run.duration),
        direction: Vec2::new(cosine, sine),
        gravity,
    };
    let steady = bearing::steady::steady(&bearing, &spin_up.bearing, &race, at)?;
    let machine = RotorMachine::on_rig(RigConstants {
        race,
        bearing,
        drive: drive(&spin_up.drive),
        load: course(&spin_up.radial_load),
        load_direction: at.direction,
        gravity,
        housing: None,
        warm: bearing::networks::built(spin_up.warm.as_deref(), &spin_up.bearing)?,
        target_speed,
    })
    .map_err(refused)?;
    Ok(RigModel {
        machine,
        torque_rate: None,
        pressure_factors: contacts.pressure_factors(),
        steady,
    })
}

fn course(course: &Course) -> Table {
    match course {
        Course::Constant(value) => Table::constant(*value),
        Course::Table(rows) => table(rows, 1.0),
    }
}

fn drive(choice: &DriveChoice) -> Drive {
    match choice {
        DriveChoice::SlidingRotor {
            rotor_speed,
            rotor_polar_inertia,
            bore_diameter,
            friction_coefficient,
            friction_reference_speed,
        } => Drive::SlidingRotor(SlidingRotor {
            bore_radius: 0.5 * bore_diameter,
            friction: *friction_coefficient,
            inverse_reference_speed: 1.0 / friction_reference_speed,
            speed: *rotor_speed,
            // without effect where the spin is held
            polar_inertia: rotor_polar_inertia.unwrap_or(1.0),
            spin_held: rotor_polar_inertia.is_none(),
        }),
        DriveChoice::Torque { torque, .. } => Drive::Torque(course(torque)),
        DriveChoice::Speed(SpeedCourse::Step { final_speed }) => Drive::step(*final_speed),
        DriveChoice::Speed(SpeedCourse::Ramp {
            final_speed,
            acceleration,
        }) => Drive::ramp(*acceleration, *final_speed),
        DriveChoice::Speed(SpeedCourse::Table(rows)) => Drive::Speed(table(rows, 1.0)),
    }
}
