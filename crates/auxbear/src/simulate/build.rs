//! From a drop to the constants of the model.

use super::bearing_run::PressureFactors;
use super::build_bearing::{self, SteadyFinding, SteadyPoint};
use crate::problem::Problem;
use crate::scenario::{Drop, Spin};
use model::bearing::BearingConstants;
use model::contact::JournalContact;
use model::levitation::Levitation;
use model::mount::Mount;
use model::rotor::Rotor;
use model::system::drop::{DropConstants, MachineConstants};
use model::system::spin_up::InnerRace;
use number::Vec2;

/// A drop ready to be simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct Built {
    /// Constants of the model.
    pub constants: DropConstants,
    /// Hertz pressure in the contacts of a ball.
    pub pressure_factors: PressureFactors,
    /// What traction can carry at full speed under the rotor's weight; none where the bearing has no steady moment.
    pub steady: Option<SteadyFinding>,
}

/// Builds the constants of one plane of a drop: identical planes share the rotor equally.
pub fn drop(drop: &Drop) -> Result<Built, Box<Problem>> {
    let gravity = gravity(drop);
    let (sine, cosine) = drop.gravity.direction.sin_cos();
    let contacts = build_bearing::ball_contacts(&drop.bearing)?;
    let bearing = build_bearing::bearing(&drop.bearing, &contacts, gravity)?;
    let steady = build_bearing::steady(
        &bearing,
        &drop.bearing,
        &InnerRace {
            mass: drop.bearing.inner_race_mass,
            inertia: drop.bearing.inner_race_inertia,
            centre_held: drop.bearing.inner_race_centre_held,
            load_direction: Vec2::new(cosine, sine),
            gravity,
        },
        SteadyPoint {
            speed: drop.rotor.speed,
            load: drop.rotor.mass / f64::from(drop.rotor.planes) * drop.gravity.acceleration,
        },
    )?;
    Ok(Built {
        constants: constants(drop, bearing),
        pressure_factors: contacts.pressure_factors(),
        steady,
    })
}

fn gravity(drop: &Drop) -> Vec2<f64> {
    let (sine, cosine) = drop.gravity.direction.sin_cos();
    Vec2::new(cosine, sine) * drop.gravity.acceleration
}

/// The constants of a drop onto a bearing that is built already.
pub fn constants(drop: &Drop, bearing: BearingConstants) -> DropConstants {
    let share = 1.0 / f64::from(drop.rotor.planes);
    let gravity = gravity(drop);
    let mass = drop.rotor.mass * share;
    let (brake_torque, brake_start) = match drop.rotor.spin {
        Spin::Braked { torque, start } => (torque * share, start),
        Spin::Free | Spin::Held => (0.0, f64::INFINITY),
    };
    let mut constants = DropConstants {
        machine: MachineConstants {
            rotor: Rotor {
                mass,
                polar_inertia: drop.rotor.polar_inertia * share,
                eccentricity: drop.rotor.unbalance_eccentricity,
                brake_torque,
                spin_held: drop.rotor.spin == Spin::Held,
            },
            levitation: Levitation {
                stiffness: drop.levitation.stiffness,
                damping: drop.levitation.damping,
                centre: Vec2::new(drop.levitation.offset_x, drop.levitation.offset_y),
                carried: -(gravity * mass),
            },
            contact: JournalContact {
                radial_clearance: drop.contact.radial_air_clearance,
                bore_radius: 0.5 * drop.contact.bore_diameter,
                stiffness: drop.contact.stiffness,
                exponent: drop.contact.exponent,
                damping: drop.contact.damping,
                friction: drop.contact.friction_coefficient,
                inverse_reference_speed: 1.0 / drop.contact.friction_reference_speed,
            },
            mount: Mount {
                stiffness: drop.mount.stiffness,
                damping: drop.mount.damping,
                free_position: Vec2::zero(),
            },
            inner_race_mass: drop.bearing.inner_race_mass,
            inner_race_inertia: drop.bearing.inner_race_inertia,
            inner_race_centre_held: drop.bearing.inner_race_centre_held,
            inner_race_torque: drop.bearing.inner_race_torque,
            outer_race_mass: drop.mount.moving_mass,
            gravity,
        },
        bearing,
        speed: drop.rotor.speed,
        unbalance_angle: drop.rotor.unbalance_angle,
        brake_start,
    };
    constants.balance_mount();
    constants
}
