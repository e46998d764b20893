//! A steady run at one speed and load: its moments, whether the balls can roll, and the scale λ of the steady moment.
//!
//! ```text
//!   t_I, t_O   mean moments on the races over a turn of the cage, once they are equal
//!   capacity   μ_max R ΣQ_i/M: the balls roll where it is above 1.2, and must skid where it is below
//!   λ = 1 - P/(M Ω)     P = t_I Ω - λ M Ω: what the run dissipates beyond the share that its pairs were given
//! ```
//! λ is found in two passes from λ = 1; with it t_I = M. P is less than the heat of creep and of balls that are sped up
//! again in the loaded zone: that heat is not added to the pairs', it is taken from it, as such balls turn more slowly
//! than rolling ones. So where only creep occurs λ stays near 1 although its heat is not zero, and where unloaded balls
//! lose their spin λ exceeds 1. Friction that has its own moment, as in the pockets, brings λ below 1.

use super::layout::{BEARING, HEATS, INNER_LOAD_SUM, STEADY_MOMENT};
use super::{Drive, InnerRace, Refusal, SpinUp, SpinUpConstants, SpinUpMachine};
use crate::bearing::{BearingConstants, PlanarConstants};
use crate::table::Table;
use physics::traction::{Traction, TractionLaw};
use solve::{Flow, Observer, Settings, Step, Stop};
use std::fmt;
use std::sync::atomic::AtomicBool;

/// A steady run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyRun {
    /// The law's moment M, N m.
    pub moment: f64,
    /// Mean moment t_I that resists the inner race, N m.
    pub inner_moment: f64,
    /// Mean moment t_O on the outer race, N m.
    pub outer_moment: f64,
    /// Largest traction moment of the inner race over M: μ_max R ΣQ_i/M.
    pub capacity: f64,
    /// Mean cage slip 1 - 2(1+s)ω_c/Ω.
    pub cage_slip: f64,
    /// Mean heat of everything but the steady moment: creep, skidding, pockets, damping, W.
    pub explicit_heat: f64,
    /// Scale λ with which this run was computed.
    pub scale: f64,
}

/// Traction capacity over M below which the balls must skid.
pub const LEAST_CAPACITY: f64 = 1.2;

impl SteadyRun {
    /// True where traction does not suffice for the steady moment: the balls skid, and t_I is less than M.
    pub fn skids(&self) -> bool {
        self.capacity < LEAST_CAPACITY
    }
}

/// Why a steady run gives no scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SteadyError {
    /// The bearing has no steady moment.
    NoMoment,
    /// What is computed explicitly dissipates more than the law says in all.
    ExplicitExceedsLaw {
        /// P, W.
        explicit: f64,
        /// What the law says, W.
        law: f64,
    },
    /// The bearing cannot be built.
    Refused(Refusal),
    /// The moments on both races, or the slip of the cage, went on changing.
    NotSteady,
    /// The integration failed.
    DidNotFinish,
}

impl fmt::Display for SteadyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SteadyError::NoMoment => write!(f, "the bearing has no steady moment"),
            SteadyError::ExplicitExceedsLaw { explicit, law } => write!(
                f,
                "slip, pockets and damping alone dissipate {explicit:.3e} W, more than the {law:.3e} W of the steady moment's law"
            ),
            SteadyError::NotSteady => {
                write!(
                    f,
                    "no steady run within {MOST_TURNS} turns of the cage or {MOST_STEPS} steps"
                )
            }
            SteadyError::Refused(why) => write!(f, "{why}"),
            SteadyError::DidNotFinish => write!(f, "the integration of a steady run failed"),
        }
    }
}

impl std::error::Error for SteadyError {}

/// Turns of the cage that a run may take until it is steady.
const MOST_TURNS: u32 = 60;
/// Difference of the mean moments of a turn, relative to M or t_I, below which a run is steady: then L no longer changes.
const STEADY: f64 = 1e-3;
/// Passes of λ.
const PASSES: u32 = 2;
/// Steps that all turns of a run may take together: two seconds of computing.
const MOST_STEPS: u64 = 300_000;

/// Computes a steady run at a speed (rad/s, not 0) under a radial load (N), with the bearing's own λ.
///
/// The race runs at the given speed, free to move under the load; the balls start rolling.
pub fn steady_run(
    bearing: &PlanarConstants,
    race: &InnerRace<f64>,
    speed: f64,
    load: f64,
) -> Result<SteadyRun, SteadyError> {
    let machine = machine(bearing, race, speed, load)?;
    let mut state = rolling_start(&machine, bearing, speed);
    settle(&machine, bearing, &mut state, speed)
}

/// The scale λ at a speed and load, as the steady run that was computed with it. Where the balls skid there is none:
/// the run is that with λ = 1.
pub fn moment_scale(
    bearing: &PlanarConstants,
    race: &InnerRace<f64>,
    speed: f64,
    load: f64,
) -> Result<SteadyRun, SteadyError> {
    let mut bearing = bearing.clone();
    let mut state = Vec::new();
    let mut scale = 1.0;
    for pass in 0.. {
        bearing.moment.as_mut().ok_or(SteadyError::NoMoment)?.scale = scale;
        let machine = machine(&bearing, race, speed, load)?;
        if pass == 0 {
            state = rolling_start(&machine, &bearing, speed);
        }
        let run = settle(&machine, &bearing, &mut state, speed)?;
        if pass == PASSES || run.skids() {
            return Ok(run);
        }
        let law = run.moment * speed;
        let explicit = run.inner_moment * speed - scale * law;
        if explicit >= law {
            return Err(SteadyError::ExplicitExceedsLaw { explicit, law });
        }
        scale = 1.0 - explicit / law;
    }
    unreachable!("the loop ends by its passes")
}

/// The bearing at a given speed under its load.
fn machine(
    bearing: &PlanarConstants,
    race: &InnerRace<f64>,
    speed: f64,
    load: f64,
) -> Result<SpinUpMachine, SteadyError> {
    SpinUpMachine::new(SpinUpConstants {
        race: InnerRace {
            centre_held: false,
            ..*race
        },
        bearing: BearingConstants::Planar(bearing.clone()),
        drive: Drive::step(speed),
        load: Table::constant(load),
        target_speed: speed,
    })
    .map_err(SteadyError::Refused)
}

fn rolling_start(machine: &SpinUpMachine, bearing: &PlanarConstants, speed: f64) -> Vec<f64> {
    let mut state = machine.start();
    bearing.roll(&mut state[machine.layout().bearing()], speed);
    state
}

/// Runs turn by turn until nothing changes any more; `state` is then the last one.
fn settle(
    machine: &SpinUpMachine,
    bearing: &PlanarConstants,
    state: &mut Vec<f64>,
    speed: f64,
) -> Result<SteadyRun, SteadyError> {
    let moment = bearing.moment.as_ref().ok_or(SteadyError::NoMoment)?;
    let set = machine.constants.bearing.set();
    let cage = set.cage_speed(speed);
    let turn = 2.0 * std::f64::consts::PI / cage.abs();
    let layout = *machine.layout();
    let mut last_slip = f64::INFINITY;
    let mut steps_left = MOST_STEPS;
    for _ in 0..MOST_TURNS {
        let from = std::mem::take(state);
        *state = advance(machine, &from, turn, &mut steps_left)?;
        let mean = |channel: usize| (state[channel] - from[channel]) / turn;
        let law = mean_moment(machine, &from, state);
        let inner_moment = mean(layout.work(0)) / speed;
        let outer_moment = mean(layout.work(1)) / speed;
        let cage_slip = 1.0 - (state[BEARING] - from[BEARING]) / (turn * cage);
        let steady = (inner_moment - outer_moment).abs()
            < STEADY * law.abs().max(inner_moment.abs())
            && (cage_slip - last_slip).abs() < STEADY;
        last_slip = cage_slip;
        if steady {
            let (_, probe) = machine.inspect(0.0, state);
            let traction = largest_coefficient(&bearing.traction)
                * set.inner_track_radius
                * probe[INNER_LOAD_SUM];
            let heats: f64 = (0..HEATS.len()).map(|kind| mean(layout.heat(kind))).sum();
            return Ok(SteadyRun {
                moment: law,
                inner_moment,
                outer_moment,
                capacity: traction / law.abs(),
                cage_slip,
                explicit_heat: heats - mean(layout.heat(STEADY_HEAT)),
                scale: moment.scale,
            });
        }
    }
    Err(SteadyError::NotSteady)
}

/// Index of the steady moment among the heats.
const STEADY_HEAT: usize = 7;

/// The law's moment, mean of both ends of a window.
fn mean_moment(machine: &SpinUpMachine, from: &[f64], to: &[f64]) -> f64 {
    let at = |state: &[f64]| machine.inspect(0.0, state).1[STEADY_MOMENT];
    0.5 * (at(from) + at(to))
}

/// Watches nothing.
struct Blind;

impl Observer<SpinUpMachine> for Blind {
    fn step(&mut self, _step: &mut Step<SpinUpMachine>) -> Flow {
        Flow::Continue
    }
}

fn advance(
    machine: &SpinUpMachine,
    state: &[f64],
    length: f64,
    steps_left: &mut u64,
) -> Result<Vec<f64>, SteadyError> {
    let settings = Settings {
        start: 0.0,
        end: length,
        tolerance: TOLERANCE,
        first_step: 1e-7,
        largest_step: 1e-3,
        step_limit: *steps_left,
    };
    let never = AtomicBool::new(false);
    let machines = [machine];
    let starts = [state.to_vec()];
    let mut endings =
        solve::run::<f64, SpinUp<f64>, _>(&machines, &starts, &mut [Blind], &settings, &never);
    let Some(ending) = endings.pop() else {
        return Err(SteadyError::DidNotFinish);
    };
    *steps_left = steps_left.saturating_sub(ending.work.accepted + ending.work.rejected);
    match ending.stop {
        Stop::Finished => Ok(ending.state),
        Stop::StepLimit => Err(SteadyError::NotSteady),
        _ => Err(SteadyError::DidNotFinish),
    }
}

/// Error control of steady runs: their means are wanted to 1e-3.
const TOLERANCE: f64 = 1e-4;

/// The largest coefficient of a traction law, searched over slips of 1e-6 to 1e3 m/s.
pub fn largest_coefficient(traction: &Traction<f64>) -> f64 {
    (0..=900)
        .map(|i| traction.coefficient(10_f64.powf(f64::from(i) / 100.0 - 6.0)))
        .fold(0.0, f64::max)
}
