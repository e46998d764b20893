//! The steady moment of a bearing at its speed, and whether traction can carry it.

use crate::bearing::contacts::ball_contacts;
use crate::bearing::traction::traction;
use model::auxiliary_bearing::RaceConstants;
use model::bearing::BearingConstants;
use model::spatial::RowConstants;
use model::spatial::part::SpatialBearing;
use model::spatial::statics::BallEquilibrium;
use model::system::machine::RotorMachine;
use model::system::rig::capacity::{LEAST_CAPACITY, largest_coefficient, traction_capacity};
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
    if bearing.moment == Moment::None || speed == 0.0 {
        return Ok(None);
    }
    if let BearingConstants::Spatial(own) = constants {
        return Ok(in_space(own, (speed, load)));
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

/// The row of a preloaded bearing in space whose traction is the smallest share of its moment, under a radial load, N, without thrust at
/// rest; none where no preload presses it.
fn in_space(own: &SpatialBearing, (speed, load): (f64, f64)) -> Option<SteadyFinding> {
    let found = own.preloaded(load, 0.0)?;
    let of_row = |(row, balls): (&RowConstants, &Vec<BallEquilibrium>)| {
        let moment = row.moment.as_ref()?;
        let sum: f64 = balls.iter().map(|ball| ball.loads[0]).sum();
        let part = |of: &dyn Fn(&BallEquilibrium) -> f64| -> f64 {
            balls.iter().map(|ball| ball.loads[0] * of(ball)).sum()
        };
        let across = |ball: &BallEquilibrium| ball.angles[0].cos();
        let radial = part(&|ball| across(ball) * ball.azimuth.cos())
            .hypot(part(&|ball| across(ball) * ball.azimuth.sin()));
        let axial = part(&|ball| ball.angles[0].sin());
        let whole = moment.law.moment(speed.abs(), radial, axial.abs());
        let set = &own.set;
        let track = set.inner_track_radius;
        let entrainment = track * (speed.abs() - set.cage_speed(speed.abs()));
        let coefficient = largest_coefficient(&row.traction, sum / row.balls as f64, entrainment);
        Some(SteadyFinding {
            speed,
            load,
            moment: whole,
            capacity: coefficient * track * sum / whole,
        })
    };
    let rows = own.rows.iter().zip(&found.rows).filter_map(of_row);
    rows.min_by(|a, b| a.capacity.total_cmp(&b.capacity))
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
