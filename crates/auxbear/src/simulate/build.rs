//! From a scenario to the constants of the model.

use crate::problem::{Code, Problem};
use crate::scenario::{
    BallMaterial, Bearing, Drop, Fidelity, Moment, MomentForm, Spin, Traction as TractionChoice,
};
use model::bearing::ball::BallConstants;
use model::bearing::rolling::RollingBall;
use model::bearing::{
    AccelerationLoss, BearingConstants, PlanarConstants, RollingConstants, SteadyMoment,
};
use model::contact::RotorContact;
use model::levitation::Levitation;
use model::mount::Mount;
use model::rotor::Rotor;
use model::system::drop::{DropConstants, MachineConstants};
use number::Vec2;
use physics::hertz::{BallRace, PointContact, Race};
use physics::materials::{BEARING_STEEL, Material, SILICON_NITRIDE, ball_mass, contact_modulus};
use physics::palmgren::Palmgren;
use physics::rolling::RollingSet;
use physics::traction::{DryTraction, FourParameterTraction, TanhTraction, Traction};

/// A drop ready to be simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct Built {
    /// Constants of the model.
    pub constants: DropConstants,
    /// Pressure of a ball/inner race contact per cube root of its load, Pa/N^(1/3).
    pub inner_pressure_factor: f64,
    /// Pressure of a ball/outer race contact per cube root of its load, Pa/N^(1/3).
    pub outer_pressure_factor: f64,
}

/// Builds the constants of one plane of a drop: identical planes share the rotor equally.
pub fn drop(drop: &Drop) -> Result<Built, Box<Problem>> {
    let share = 1.0 / f64::from(drop.rotor.planes);
    let (sine, cosine) = drop.gravity.direction.sin_cos();
    let gravity = Vec2::new(cosine, sine) * drop.gravity.acceleration;
    let mass = drop.rotor.mass * share;
    let (brake_torque, brake_start) = match drop.rotor.spin {
        Spin::Braked { torque, start } => (torque * share, start),
        Spin::Free | Spin::Held => (0.0, f64::INFINITY),
    };
    let contacts = ball_contacts(&drop.bearing)?;
    let bearing = bearing(&drop.bearing, &contacts, gravity);
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
            contact: RotorContact {
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
    Ok(Built {
        constants,
        inner_pressure_factor: contacts.inner.pressure_factor,
        outer_pressure_factor: contacts.outer.pressure_factor,
    })
}

/// The Hertz contacts of a ball, and its mass.
struct BallContacts {
    inner: PointContact,
    outer: PointContact,
    inner_stiffness: f64,
    outer_stiffness: f64,
    ball_mass: f64,
}

/// Materials of the balls.
fn material(choice: BallMaterial) -> Material {
    match choice {
        BallMaterial::Steel => BEARING_STEEL,
        BallMaterial::SiliconNitride => SILICON_NITRIDE,
    }
}

fn ball_contacts(bearing: &Bearing) -> Result<BallContacts, Box<Problem>> {
    let ball = material(bearing.ball_material);
    let modulus = contact_modulus(ball, BEARING_STEEL);
    let contact = |race: Race, groove_curvature: f64| {
        let geometry = BallRace {
            ball_diameter: bearing.ball_diameter,
            pitch_diameter: bearing.pitch_diameter,
            groove_curvature,
            contact_angle: 0.0,
            race,
        };
        PointContact::new(geometry.curvature(), modulus).map_err(|_| {
            Box::new(
                Problem::new(
                    Code::BearingGeometry,
                    "the scenario",
                    format!(
                        "a groove curvature of {groove_curvature}, which gives no point contact"
                    ),
                    "a groove curvature above 0.5 and balls smaller than the pitch diameter",
                )
                .on_key("bearing"),
            )
        })
    };
    let inner = contact(Race::Inner, bearing.inner_groove_curvature)?;
    let outer = contact(Race::Outer, bearing.outer_groove_curvature)?;
    Ok(BallContacts {
        inner_stiffness: bearing.inner_contact_stiffness.unwrap_or(inner.stiffness),
        outer_stiffness: bearing.outer_contact_stiffness.unwrap_or(outer.stiffness),
        ball_mass: bearing
            .ball_mass
            .unwrap_or_else(|| ball_mass(bearing.ball_diameter, ball.density)),
        inner,
        outer,
    })
}

fn bearing(bearing: &Bearing, contacts: &BallContacts, gravity: Vec2<f64>) -> BearingConstants {
    let radius = 0.5 * bearing.ball_diameter;
    let inner_track = 0.5 * bearing.pitch_diameter - radius;
    // the diametral clearance is what the outer track leaves beyond inner track and two balls, on both sides
    let outer_track =
        inner_track + bearing.ball_diameter + 0.5 * bearing.operating_diametral_clearance;
    match bearing.fidelity {
        Fidelity::Planar => BearingConstants::Planar(PlanarConstants {
            balls: bearing.ball_count,
            ball: BallConstants {
                radius,
                mass: contacts.ball_mass,
                inverse_mass: 1.0 / contacts.ball_mass,
                inverse_inertia: 1.0 / (0.4 * contacts.ball_mass * radius * radius),
                inner_track,
                outer_track,
                inner_stiffness: contacts.inner_stiffness,
                outer_stiffness: contacts.outer_stiffness,
                damping_time: bearing.contact_damping_time,
                pocket_radius: 0.5 * bearing.pitch_diameter,
                pocket_gap: bearing.cage.pocket_gap,
                pocket_stiffness: if bearing.cage.pocket_contact {
                    bearing.cage.pocket_stiffness
                } else {
                    0.0
                },
                pocket_damping: bearing.cage.pocket_damping,
                pocket_friction: bearing.cage.pocket_friction_coefficient,
                pocket_inverse_reference_speed: 1.0 / bearing.cage.pocket_friction_reference_speed,
                orbit_drag: bearing.drag.orbit,
                spin_drag: bearing.drag.spin,
                gravity,
            },
            traction: traction(&bearing.traction),
            cage_mass: bearing.cage_mass,
            cage_inertia: bearing.cage_inertia,
            cage_drag: bearing.drag.cage,
            first_ball_angle: bearing.first_ball_angle,
            moment: None,
        }),
        Fidelity::Rolling => {
            let set = RollingSet {
                inner_track_radius: inner_track,
                ball_ratio: radius / inner_track,
                balls_mass: bearing.ball_count as f64 * contacts.ball_mass,
                cage_mass: bearing.cage_mass,
            };
            let softness = contacts.inner_stiffness.powf(-2.0 / 3.0)
                + contacts.outer_stiffness.powf(-2.0 / 3.0);
            BearingConstants::Rolling(RollingConstants {
                balls: bearing.ball_count,
                ball: RollingBall {
                    series_stiffness: softness.powf(-1.5),
                    damping_time: bearing.contact_damping_time,
                    interference: inner_track + bearing.ball_diameter - outer_track,
                    mass_radius: contacts.ball_mass * (inner_track + radius),
                },
                set,
                first_ball_angle: bearing.first_ball_angle,
                moment: steady_moment(bearing),
                axial_load: 0.0,
                loss: AccelerationLoss::None,
            })
        }
    }
}

fn traction(choice: &TractionChoice) -> Traction<f64> {
    match *choice {
        TractionChoice::Tanh {
            maximum,
            reference_speed,
        } => Traction::Tanh(TanhTraction {
            maximum,
            inverse_reference_speed: 1.0 / reference_speed,
        }),
        TractionChoice::FourParameter { a, b, c, d } => {
            Traction::FourParameter(FourParameterTraction { a, b, c, d })
        }
        TractionChoice::Dry {
            kinetic_coefficient,
            static_coefficient,
            decay_speed,
            reference_speed,
        } => Traction::Dry(DryTraction {
            kinetic: kinetic_coefficient,
            static_excess: static_coefficient - kinetic_coefficient,
            inverse_decay_speed: 1.0 / decay_speed,
            inverse_reference_speed: 1.0 / reference_speed,
        }),
    }
}

fn steady_moment(bearing: &Bearing) -> SteadyMoment<f64> {
    let Moment::Palmgren {
        form,
        f0,
        viscosity,
        f1_factor,
        f1_exponent,
    } = bearing.moment
    else {
        return SteadyMoment::None;
    };
    let law = Palmgren {
        viscous_factor: f0,
        viscosity,
        pitch_diameter: bearing.pitch_diameter,
        load_factor: f1_factor,
        load_exponent: f1_exponent,
        // the scenario refuses Palmgren's law without a load rating
        static_load_rating: bearing.static_load_rating.unwrap_or(f64::INFINITY),
    };
    match form {
        MomentForm::Continuous => SteadyMoment::Palmgren(law),
        MomentForm::Printed => SteadyMoment::PalmgrenPrinted(law),
    }
}
