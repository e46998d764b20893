//! From a bearing of a scenario to the constants of the model.

use super::bearing_run::PressureFactors;
use super::build_traction::{inlet_rolling, traction};
use crate::problem::{Code, Problem};
use crate::scenario::{
    AccelerationLoss as LossChoice, Bearing, Fidelity, Guidance, Land, Moment, Separation, UNNAMED,
};
use model::bearing::ball::BallConstants;
use model::bearing::cage::{Land as CageLand, LandRace};
use model::bearing::full_complement::BallPair;
use model::bearing::rolling::RollingBall;
use model::bearing::{
    AccelerationLoss, BearingConstants, LubricantConstants, PlanarConstants, RollingConstants,
    Separation as SeparationConstants, SharedMoment, SteadyMoment,
};
use model::contact::JournalContact;
use model::system::spin_up::capacity::{LEAST_CAPACITY, traction_capacity};
use model::system::spin_up::layout::{INNER, INNER_LOAD_SUM, STEADY_MOMENT};
use model::system::spin_up::{Drive, InnerRace, Refusal, SpinUpConstants, SpinUpMachine};
use model::table::Table;
use number::Vec2;
use physics::angular_contact::{preload_interference, radial_stiffness, spin_inertia};
use physics::hertz::{BallRace, Curvature, PointContact, Race};
use physics::materials::{BEARING_STEEL, contact_modulus};

/// What a problem found after reading names as its place.
pub(super) const SCENARIO: &str = UNNAMED;

/// The Hertz contacts of a ball, and its mass.
pub(super) struct BallContacts {
    pub inner: PointContact,
    pub outer: PointContact,
    /// Sums of curvatures at the inner and the outer race.
    pub curvatures: [Curvature; 2],
    /// Contact modulus E*, Pa.
    pub modulus: f64,
    inner_stiffness: f64,
    outer_stiffness: f64,
    /// Stiffness of two neighbouring balls, N/m^1.5.
    neighbour_stiffness: f64,
    /// Pressure between them per cube root of the force, Pa/N^(1/3); none where a cage keeps them apart.
    neighbour_pressure_factor: Option<f64>,
    ball_mass: f64,
}

impl BallContacts {
    pub fn pressure_factors(&self) -> PressureFactors {
        PressureFactors {
            races: [self.inner.pressure_factor, self.outer.pressure_factor],
            neighbours: self.neighbour_pressure_factor,
        }
    }
}

pub(super) fn ball_contacts(bearing: &Bearing) -> Result<BallContacts, Box<Problem>> {
    let ball = bearing.ball_material.data();
    let modulus = contact_modulus(ball, BEARING_STEEL);
    let contact = |race: Race, groove_curvature: f64| {
        let curvature = BallRace {
            ball_diameter: bearing.ball_diameter,
            pitch_diameter: bearing.pitch_diameter,
            groove_curvature,
            contact_angle: bearing.contact_angle,
            race,
        }
        .curvature();
        let contact = PointContact::new(curvature, modulus).map_err(|_| {
            Box::new(
                Problem::new(
                    Code::BearingGeometry,
                    SCENARIO,
                    format!(
                        "a groove curvature of {groove_curvature}, which gives no point contact"
                    ),
                    "a groove curvature above 0.5 and balls smaller than the pitch diameter",
                )
                .on_key("bearing"),
            )
        })?;
        Ok::<_, Box<Problem>>((contact, curvature))
    };
    let (inner, inner_curvature) = contact(Race::Inner, bearing.inner_groove_curvature)?;
    let (outer, outer_curvature) = contact(Race::Outer, bearing.outer_groove_curvature)?;
    let sphere = 4.0 / bearing.ball_diameter;
    let neighbours = PointContact::new(
        Curvature {
            axial: sphere,
            rolling: sphere,
        },
        contact_modulus(ball, ball),
    );
    Ok(BallContacts {
        // two spheres always make a point
        neighbour_stiffness: neighbours.as_ref().map_or(0.0, |contact| contact.stiffness),
        neighbour_pressure_factor: match &bearing.separation {
            Separation::Cage(_) => None,
            Separation::FullComplement(_) => neighbours.ok().map(|contact| contact.pressure_factor),
        },
        curvatures: [inner_curvature, outer_curvature],
        modulus,
        inner_stiffness: bearing.inner_contact_stiffness.unwrap_or(inner.stiffness),
        outer_stiffness: bearing.outer_contact_stiffness.unwrap_or(outer.stiffness),
        ball_mass: bearing.mass_of_ball(),
        inner,
        outer,
    })
}

/// The bearing.
pub(super) fn bearing(
    bearing: &Bearing,
    contacts: &BallContacts,
    gravity: Vec2<f64>,
) -> Result<BearingConstants, Box<Problem>> {
    let law = bearing
        .moment
        .law(&bearing.rated())
        .map_err(|why| {
            Box::new(
                Problem::new(
                    Code::NoLawData,
                    SCENARIO,
                    why,
                    "a law that has constants for this bearing",
                )
                .on_key("bearing.moment.law"),
            )
        })?
        .scaled(bearing.moment_share.scale);
    let plane = Plane::of(bearing, contacts);
    let growth = bearing.inner_track_growth();
    Ok(match bearing.fidelity {
        Fidelity::Planar => BearingConstants::Planar(PlanarConstants {
            balls: bearing.ball_count,
            ball: ball_constants(bearing, contacts, &plane, gravity),
            traction: traction(bearing, contacts)?,
            separation: separation(bearing, contacts),
            cage_mass: bearing.separation.cage_mass(),
            cage_inertia: match &bearing.separation {
                Separation::Cage(cage) => cage.inertia,
                Separation::FullComplement(_) => NO_CAGE,
            },
            cage_drag: bearing.drag.cage,
            first_ball_angle: bearing.first_ball_angle,
            moment: (law != SteadyMoment::None).then(|| SharedMoment {
                law,
                axial_load: bearing.moment.axial_load(),
                orbit_share: bearing.moment_share.orbit_share,
                reference_spin: bearing.moment_share.reference_spin,
            }),
            inlet_rolling: inlet_rolling(bearing, contacts)?,
            lubricant: lubricant_state(bearing),
        }),
        Fidelity::Rolling => BearingConstants::Rolling(RollingConstants {
            balls: bearing.ball_count,
            ball: RollingBall {
                series_stiffness: in_series(plane.inner_stiffness, plane.outer_stiffness),
                load_per_radial_force: 1.0 / bearing.contact_angle.cos(),
                damping_time: bearing.contact_damping_time,
                interference: plane.inner_track + 2.0 * plane.contact_radius - plane.outer_track,
                inner_track_growth: growth,
                mass_radius: contacts.ball_mass * 0.5 * bearing.pitch_diameter,
            },
            set: bearing.rolling_set(),
            cage_mass: bearing.separation.cage_mass(),
            first_ball_angle: bearing.first_ball_angle,
            moment: law,
            axial_load: bearing.moment.axial_load(),
            loss: acceleration_loss(&bearing.acceleration_loss),
            lubricant: lubricant_state(bearing),
        }),
    })
}

/// The slow state of the lubricant, where it has one.
fn lubricant_state(bearing: &Bearing) -> Option<LubricantConstants> {
    (bearing.lubricant_state).map(|state| LubricantConstants {
        grease: state.grease,
        films: state.films,
        build_up: state.build_up,
        breakdown: state.breakdown,
    })
}

/// Inertia that stands where there is no cage, kg m²: nothing acts on it.
const NO_CAGE: f64 = 1.0;

/// What the plane of the bearing sees of balls and tracks: contacts at an angle stand nearer to the ball's centre.
struct Plane {
    contact_radius: f64,
    inner_track: f64,
    outer_track: f64,
    inner_stiffness: f64,
    outer_stiffness: f64,
}

impl Plane {
    fn of(bearing: &Bearing, contacts: &BallContacts) -> Self {
        let angle = bearing.contact_angle;
        let contact_radius = bearing.contact_radius();
        let inner_track = bearing.inner_track_radius();
        let preload = if bearing.axial_preload > 0.0 {
            let stiffness = in_series(contacts.inner_stiffness, contacts.outer_stiffness);
            preload_interference(bearing.axial_preload, bearing.ball_count, stiffness, angle)
        } else {
            0.0
        };
        // the diametral clearance is what the outer track leaves beyond inner track and two balls, on both sides
        let clearance = 0.5 * bearing.operating_diametral_clearance - preload;
        Plane {
            contact_radius,
            inner_track,
            outer_track: inner_track + 2.0 * contact_radius + clearance,
            inner_stiffness: radial_stiffness(contacts.inner_stiffness, angle),
            outer_stiffness: radial_stiffness(contacts.outer_stiffness, angle),
        }
    }
}

/// Stiffness of two contacts in series, N/m^1.5.
fn in_series(first: f64, second: f64) -> f64 {
    (first.powf(-2.0 / 3.0) + second.powf(-2.0 / 3.0)).powf(-1.5)
}

fn ball_constants(
    bearing: &Bearing,
    contacts: &BallContacts,
    plane: &Plane,
    gravity: Vec2<f64>,
) -> BallConstants<f64> {
    let cosine = bearing.contact_angle.cos();
    let pockets = match &bearing.separation {
        Separation::Cage(cage) => Pockets {
            gap: cage.pocket_gap,
            stiffness: if cage.pocket_contact {
                cage.pocket_stiffness
            } else {
                0.0
            },
            damping: cage.pocket_damping,
            friction: cage.pocket_friction_coefficient,
            reference_speed: cage.pocket_friction_reference_speed,
        },
        Separation::FullComplement(_) => Pockets::NONE,
    };
    BallConstants {
        radius: plane.contact_radius,
        ball_radius: 0.5 * bearing.ball_diameter,
        load_per_radial_force: 1.0 / cosine,
        mass: contacts.ball_mass,
        inverse_mass: 1.0 / contacts.ball_mass,
        inverse_inertia: 1.0 / spin_inertia(contacts.ball_mass, plane.contact_radius),
        inner_track: plane.inner_track,
        inner_track_growth: bearing.inner_track_growth(),
        outer_track: plane.outer_track,
        inner_stiffness: plane.inner_stiffness,
        outer_stiffness: plane.outer_stiffness,
        damping_time: bearing.contact_damping_time,
        pocket_radius: 0.5 * bearing.pitch_diameter,
        pocket_gap: pockets.gap,
        pocket_stiffness: pockets.stiffness,
        pocket_damping: pockets.damping,
        pocket_friction: pockets.friction * cosine,
        pocket_inverse_reference_speed: cosine / pockets.reference_speed,
        orbit_drag: bearing.drag.orbit,
        spin_drag: bearing.drag.spin,
        gravity,
    }
}

/// The pockets of a cage.
struct Pockets {
    gap: f64,
    stiffness: f64,
    damping: f64,
    friction: f64,
    reference_speed: f64,
}

impl Pockets {
    /// Where there is no cage, nothing touches.
    const NONE: Pockets = Pockets {
        gap: f64::INFINITY,
        stiffness: 0.0,
        damping: 0.0,
        friction: 0.0,
        reference_speed: 1.0,
    };
}

/// What keeps the balls apart.
fn separation(bearing: &Bearing, contacts: &BallContacts) -> SeparationConstants<f64> {
    let cage = match &bearing.separation {
        Separation::Cage(cage) => cage,
        Separation::FullComplement(row) => {
            let cosine = bearing.contact_angle.cos();
            return SeparationConstants::Neighbours(BallPair {
                radius: 0.5 * bearing.ball_diameter,
                stiffness: contacts.neighbour_stiffness,
                damping_time: bearing.contact_damping_time,
                friction: row.friction_coefficient * cosine,
                inverse_reference_speed: cosine / row.friction_reference_speed,
            });
        }
    };
    let on = |race: LandRace, land: &Land| {
        let bore = match race {
            // the cage has the bore
            LandRace::Inner => 0.5 * land.diameter + land.radial_clearance,
            LandRace::Outer => 0.5 * land.diameter,
        };
        SeparationConstants::FreeCage(Some(CageLand {
            race,
            contact: JournalContact {
                radial_clearance: land.radial_clearance,
                bore_radius: bore,
                stiffness: land.stiffness,
                exponent: 1.0,
                damping: land.damping,
                friction: land.friction_coefficient,
                inverse_reference_speed: 1.0 / land.friction_reference_speed,
            },
        }))
    };
    match &cage.guidance {
        Guidance::Centred => SeparationConstants::CentredCage,
        Guidance::Balls => SeparationConstants::FreeCage(None),
        Guidance::InnerLand(land) => on(LandRace::Inner, land),
        Guidance::OuterLand(land) => on(LandRace::Outer, land),
    }
}

pub(super) fn acceleration_loss(choice: &LossChoice) -> AccelerationLoss {
    match choice {
        LossChoice::None => AccelerationLoss::None,
        LossChoice::Constant { force } => AccelerationLoss::Constant { force: *force },
        LossChoice::Proportional { per_acceleration } => AccelerationLoss::Proportional {
            per_acceleration: *per_acceleration,
        },
        LossChoice::OverSpeed { force_over_speed } => AccelerationLoss::OverSpeed {
            force: table(force_over_speed),
        },
        LossChoice::Affine {
            force_over_speed,
            per_acceleration_over_speed,
        } => AccelerationLoss::Affine {
            force: table(force_over_speed),
            per_acceleration: table(per_acceleration_over_speed),
        },
    }
}

/// Rows of a scenario, which rise, as a table of the model.
pub(super) fn table(rows: &[[f64; 2]]) -> Table {
    let points = rows.iter().map(|row| (row[0], row[1])).collect();
    // the scenario holds two rows at least and refuses rows that do not rise
    Table::through(points).unwrap_or_else(|_| Table::constant(f64::NAN))
}

/// Whether traction can carry the friction moment at one speed and load.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyFinding {
    /// Speed of the inner race, rad/s.
    pub speed: f64,
    /// Radial load, N.
    pub load: f64,
    /// Moment M of the law, N m.
    pub moment: f64,
    /// Largest traction moment of the inner race over M.
    pub capacity: f64,
}

impl SteadyFinding {
    /// Whether traction does not suffice for the steady moment.
    pub fn skids(&self) -> bool {
        self.capacity < LEAST_CAPACITY
    }
}

/// The speed and load that a bearing is meant to run at.
#[derive(Clone, Copy, Debug)]
pub(super) struct SteadyPoint {
    /// Speed of the inner race, rad/s.
    pub speed: f64,
    /// Radial load, N.
    pub load: f64,
}

/// Moment and traction capacity of a bearing that is pressed together at rest. None where there is no steady moment or
/// no speed.
pub(super) fn steady(
    constants: &BearingConstants,
    bearing: &Bearing,
    race: &InnerRace<f64>,
    SteadyPoint { speed, load }: SteadyPoint,
) -> Result<Option<SteadyFinding>, Box<Problem>> {
    if bearing.moment == Moment::None || speed == 0.0 {
        return Ok(None);
    }
    // a race that runs at its speed from the start, or nearly so where the balls cannot follow a step
    let drive = match constants {
        BearingConstants::Planar(_) => Drive::step(speed),
        BearingConstants::Rolling(_) => Drive::Torque(Table::constant(0.0)),
    };
    let machine = SpinUpMachine::new(SpinUpConstants {
        race: *race,
        bearing: constants.clone().at_the_law(),
        drive,
        load: Table::constant(load),
        target_speed: speed,
    })
    .map_err(refused)?;
    let mut state = machine.start();
    state[INNER + 5] = speed;
    let (_, probe) = machine.inspect(0.0, &state);
    let moment = probe[STEADY_MOMENT];
    let traction = traction(bearing, &ball_contacts(bearing)?)?;
    let capacity = traction_capacity(&traction, constants, speed, probe[INNER_LOAD_SUM]);
    Ok(Some(SteadyFinding {
        speed,
        load,
        moment,
        capacity: capacity / moment.abs(),
    }))
}

/// A machine that the model refuses, told with the key that decides.
pub(super) fn refused(refusal: Refusal) -> Box<Problem> {
    let key = match refusal {
        Refusal::DragToGround => "bearing.drag",
        Refusal::LossCreatesEnergy | Refusal::LossExceedsInertia => "bearing.acceleration_loss",
        Refusal::NegativeLoad => "drive.radial_load",
        Refusal::StepOfRollingBalls => "drive.acceleration",
        Refusal::MomentShare => "bearing.moment",
        Refusal::LubricantState => "bearing.lubricant_state",
    };
    Box::new(
        Problem::new(
            Code::Impossible,
            SCENARIO,
            refusal.to_string(),
            "a machine that can be computed is needed",
        )
        .on_key(key),
    )
}
