//! The steady moment of a bearing at its speed, and whether traction can carry it.

use crate::bearing::contacts::ball_contacts;
use crate::bearing::traction::traction;
use model::auxiliary_bearing::RaceConstants;
use model::bearing::BearingConstants;
use model::system::machine::RotorMachine;
use model::system::rig::capacity::{LEAST_CAPACITY, traction_capacity};
use model::system::rig::layout::{INNER, INNER_LOAD_SUM, STEADY_MOMENT};
use model::system::rig::{Drive, Refusal, RigConstants};
use model::table::Table;
use number::Vec2;
use problem::{Code, Problem};
use scenario::{Bearing, Moment, problem_at};

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
pub(crate) struct SteadyPoint {
    /// Speed of the inner race, rad/s.
    pub speed: f64,
    /// Radial load, N.
    pub load: f64,
    /// Its direction, a unit vector.
    pub direction: Vec2<f64>,
    /// Gravity, m/s².
    pub gravity: Vec2<f64>,
}

/// Moment and traction capacity of a bearing that is pressed together at rest. None where there is no steady moment or
/// no speed.
pub(crate) fn steady(
    constants: &BearingConstants,
    bearing: &Bearing,
    race: &RaceConstants<f64>,
    at: SteadyPoint,
) -> Result<Option<SteadyFinding>, Box<Problem>> {
    let SteadyPoint { speed, load, .. } = at;
    // the rig has no bearing in space
    let in_space = matches!(constants, BearingConstants::Spatial(_));
    if bearing.moment == Moment::None || speed == 0.0 || in_space {
        return Ok(None);
    }
    // a race that runs at its speed from the start, or nearly so where the balls cannot follow a step
    let drive = match constants {
        BearingConstants::Planar(_) => Drive::step(speed),
        BearingConstants::Rolling(_) | BearingConstants::Spatial(_) => {
            Drive::Torque(Table::constant(0.0))
        }
    };
    let machine = RotorMachine::on_rig(RigConstants {
        race: *race,
        bearing: constants.clone().at_the_law(),
        drive,
        load: Table::constant(load),
        load_direction: at.direction,
        gravity: at.gravity,
        housing: None,
        warm: None,
        target_speed: speed,
    })
    .map_err(refused)?;
    let mut state = machine.start();
    state[INNER.spin()] = speed;
    let (_, probe) = machine.inspect_at(0.0, &state);
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

/// A machine that the model refuses, reported with the key that decides.
pub(crate) fn refused(refusal: Refusal) -> Box<Problem> {
    let key = match refusal {
        Refusal::InSpace => "bearing.fidelity",
        Refusal::DragToGround => "bearing.drag",
        Refusal::LossCreatesEnergy | Refusal::LossExceedsInertia => "bearing.acceleration_loss",
        Refusal::NegativeLoad => "drive.radial_load",
        Refusal::StepOfRollingBalls => "drive.acceleration",
        Refusal::MomentShare => "bearing.moment",
        Refusal::LubricantState => "bearing.lubricant_state",
        Refusal::Direction => "drive.load_direction",
        Refusal::NotPositive(_)
        | Refusal::Negative(_)
        | Refusal::LoadChanges
        | Refusal::Order(_)
        | Refusal::Action(_) => "rig",
    };
    let allowed = "a machine that can be computed is needed";
    problem_at(Code::Impossible, key, refusal.to_string(), allowed)
}
