//! From a bearing of a scenario to the constants of the model.

use crate::bearing::contacts::BallContacts;
use crate::bearing::loss;
use crate::bearing::traction::{inlet_rolling, traction};
use model::bearing::ball::BallConstants;
use model::bearing::ball_pair::BallPair;
use model::bearing::land::{Land as CageLand, LandRace};
use model::bearing::rolling::RollingBall;
use model::bearing::{
    BearingConstants, LubricantConstants, PlanarConstants, RollingConstants,
    Separation as SeparationConstants, SharedMoment, SteadyMoment,
};
use model::contact::JournalContact;
use number::Vec2;
use physics::angular_contact::{preload_interference, radial_stiffness, spin_inertia};
use problem::{Code, Problem};
use scenario::{Bearing, Fidelity, Guidance, Land, Separation, problem_at};

/// The bearing.
pub(crate) fn bearing(
    bearing: &Bearing,
    contacts: &BallContacts,
    gravity: Vec2<f64>,
) -> Result<BearingConstants, Box<Problem>> {
    let law = moment(bearing)?;
    let plane = Plane::of(bearing, contacts);
    let growth = bearing.inner_track_growth();
    Ok(match bearing.fidelity {
        // built with what it lands on: bearing::spatial
        Fidelity::Spatial => {
            let allowed = "\"planar\" is needed where the rotor does not move along its axis";
            return Err(problem_at(
                Code::NotModelled,
                "bearing.fidelity",
                "\"spatial\"",
                allowed,
            ));
        }
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
            moment: shared_moment(bearing)?,
            inlet_rolling: inlet_rolling(bearing, contacts)?,
            lubricant: lubricant_state(bearing),
            races: Some(contacts.races(bearing)),
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
            loss: loss::law(&bearing.acceleration_loss),
            lubricant: lubricant_state(bearing),
        }),
    })
}

/// The law of the steady moment.
fn moment(bearing: &Bearing) -> Result<SteadyMoment<f64>, Box<Problem>> {
    let law = bearing.moment.law(&bearing.rated()).map_err(|why| {
        let allowed = "a law that has constants for this bearing";
        problem_at(Code::NoLawData, "bearing.moment.law", why, allowed)
    })?;
    Ok(law.scaled(bearing.moment_share.scale))
}

/// The steady moment that the balls of a row share, where there is one; in space the axial load of each row is computed.
pub(crate) fn shared_moment(bearing: &Bearing) -> Result<Option<SharedMoment>, Box<Problem>> {
    let law = moment(bearing)?;
    let share = bearing.moment_share;
    Ok((law != SteadyMoment::None).then(|| SharedMoment {
        law,
        axial_load: match bearing.fidelity {
            Fidelity::Spatial => 0.0,
            Fidelity::Planar | Fidelity::Rolling => bearing.moment.axial_load(),
        },
        orbit_share: share.orbit_share,
        reference_spin: share.reference_spin,
    }))
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
