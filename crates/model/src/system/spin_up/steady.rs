//! A steady run at one speed and load: its moments, whether the balls can roll, and the scale λ of the steady moment.
//!
//! ```text
//!   t_I, t_O   mean moments on the races, once balls and cage gain nothing any more: then they are equal
//!   capacity   μ_max R ΣQ_i/M: the balls roll where it is above 1.2, and must skid where it is below
//!   λ = (M Ω - P)/(P_m/λ')     P: heat of slip, pockets and damping; P_m: heat of the moment's pairs when scaled by λ'
//! ```
//! With this λ slip and pockets and the pairs together dissipate M Ω, so t_I = M. Where all balls roll the pairs take
//! P_m = λ' M Ω, and λ = 1 - P/(M Ω). Where unloaded balls lose their spin the pairs take less: then λ may exceed 1, and
//! the balls that carry load turn against more than their equal share.
//!
//! A lubricant with a slow state is taken in the state of the law, drag and traction factor 1, and without its states, which
//! never rest: what λ then means beside a drag factor stands in [`lubricant_state`](crate::bearing::lubricant_state).
//!
//! Time is cut into ball passes, of a cage turn over the number of balls. A run is steady when the last half of them,
//! of which the first of all are a cage turn at least, agrees with itself. Unloaded balls repeat nothing exactly, so that
//! a single turn can be off by half a percent: then the run goes on until the mean is good enough.

use super::layout::{BEARING, HEATS, INNER, INNER_LOAD_SUM, STEADY_MOMENT};
use super::{Drive, InnerRace, Refusal, SpinUp, SpinUpConstants, SpinUpMachine};
use crate::bearing::{BearingConstants, PlanarConstants};
use crate::table::Table;
use physics::traction::{SlidingContact, Traction, TractionLaw};
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
    /// Mean heat of the pairs of the steady moment, W.
    pub moment_heat: f64,
    /// Mean heat of everything else: creep, skidding, pockets, damping, W.
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
    /// The caller interrupted it.
    Interrupted,
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
            SteadyError::Interrupted => write!(f, "interrupted before a steady run was found"),
        }
    }
}

impl std::error::Error for SteadyError {}

/// Turns of the cage that a run may take until it is steady.
const MOST_TURNS: usize = 60;
/// What a steady mean may still change by: powers and moments relative to those of the law, the slip absolutely. Half a
/// percent is promised of the moment in all.
const STEADY: f64 = 2e-3;
/// Deviation of all heat from M Ω that ends the search of λ.
const FOUND: f64 = 3e-3;
/// Passes of λ; two suffice unless the balls are near skidding.
const PASSES: usize = 5;
/// Steps that a search may take in all: some twenty seconds of computing, for speeds of a few rad/s.
const MOST_STEPS: u64 = 3_000_000;

/// How a caller follows a search, and ends it.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Set to true, it ends the search.
    pub interrupt: &'a AtomicBool,
    /// Told the number of ball passes so far, and of those that will be needed at least.
    pub progress: &'a dyn Fn(usize, usize),
}

/// Computes a steady run at a speed (rad/s, not 0) under a radial load (N), with the bearing's own λ.
///
/// The race runs at the given speed, free to move under the load; the balls start rolling.
pub fn steady_run(
    bearing: &PlanarConstants,
    race: &InnerRace<f64>,
    speed: f64,
    load: f64,
    watch: &Watch,
) -> Result<SteadyRun, SteadyError> {
    let machine = machine(bearing, race, speed, load)?;
    let mut search = Search::new(&machine, speed, *watch)?;
    search.settle(&machine, 2 * bearing.balls)
}

/// The scale λ at a speed and load, as the steady run that was computed with it. Where the balls skid there is none:
/// the run is that with λ = 1.
pub fn moment_scale(
    bearing: &PlanarConstants,
    race: &InnerRace<f64>,
    speed: f64,
    load: f64,
    watch: &Watch,
) -> Result<SteadyRun, SteadyError> {
    let mut bearing = bearing.clone();
    let mut scaled = |scale: f64| {
        bearing.moment.as_mut().ok_or(SteadyError::NoMoment)?.scale = scale;
        machine(&bearing, race, speed, load)
    };
    let plain = scaled(1.0)?;
    let mut search = Search::new(&plain, speed, *watch)?;
    let balls = plain.layout().balls;
    // two turns of the cage to forget the start; one is enough for a change of λ
    let first = search.settle(&plain, 2 * balls)?;
    let mut run = first;
    for _ in 0..PASSES {
        if run.skids() {
            return Ok(first);
        }
        let law = run.moment * speed;
        if run.explicit_heat >= law {
            return Err(SteadyError::ExplicitExceedsLaw {
                explicit: run.explicit_heat,
                law,
            });
        }
        let off = (run.explicit_heat + run.moment_heat) / law - 1.0;
        if off.abs() < FOUND {
            break;
        }
        let scale = run.scale * (law - run.explicit_heat) / run.moment_heat;
        run = search.settle(&scaled(scale)?, balls)?;
    }
    Ok(run)
}

/// The bearing at a given speed under its load, its lubricant in the state of the law.
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
        bearing: BearingConstants::Planar(bearing.clone()).at_the_law(),
        drive: Drive::step(speed),
        load: Table::constant(load),
        target_speed: speed,
    })
    .map_err(SteadyError::Refused)
}

/// What a ball pass summed up.
#[derive(Clone, Copy)]
struct Pass {
    /// Mean law moment M, N m.
    law: f64,
    /// Mean t_I, N m.
    inner_moment: f64,
    /// Mean t_O, N m.
    outer_moment: f64,
    /// Mean heat of the moment's pairs, W.
    moment_heat: f64,
    /// Mean heat of everything else, W.
    explicit_heat: f64,
    /// Mean cage slip.
    cage_slip: f64,
}

fn mean(passes: &[Pass], of: impl Fn(&Pass) -> f64) -> f64 {
    passes.iter().map(of).sum::<f64>() / passes.len() as f64
}

/// True where the passes' two halves agree, and balls and cage gain no angular momentum.
fn is_steady(passes: &[Pass]) -> bool {
    let (early, late) = passes.split_at(passes.len() / 2);
    let changes = |of: &dyn Fn(&Pass) -> f64| (mean(late, of) - mean(early, of)).abs();
    let moment = mean(passes, |pass| pass.law.abs().max(pass.inner_moment.abs()));
    let heat = mean(passes, |pass| pass.moment_heat + pass.explicit_heat);
    let gain = mean(passes, |pass| pass.inner_moment - pass.outer_moment);
    gain.abs() < STEADY * moment
        && changes(&|pass| pass.moment_heat + pass.explicit_heat) < STEADY * heat
        && changes(&|pass| pass.cage_slip) < STEADY
}

/// A bearing on its way to a steady run.
struct Search<'a> {
    watch: Watch<'a>,
    speed: f64,
    state: Vec<f64>,
    steps_left: u64,
}

impl<'a> Search<'a> {
    /// Starts with balls that roll.
    fn new(machine: &SpinUpMachine, speed: f64, watch: Watch<'a>) -> Result<Self, SteadyError> {
        let bearing = planar(machine)?;
        let mut state = machine.start();
        bearing.roll(&mut state[machine.layout().bearing()], speed);
        Ok(Search {
            watch,
            speed,
            state,
            steps_left: MOST_STEPS,
        })
    }

    /// Runs for a number of ball passes, and then until nothing changes any more.
    fn settle(&mut self, machine: &SpinUpMachine, least: usize) -> Result<SteadyRun, SteadyError> {
        let balls = machine.layout().balls;
        let mut passes: Vec<Pass> = Vec::new();
        while passes.len() < MOST_TURNS * balls {
            passes.push(self.pass(machine)?);
            (self.watch.progress)(passes.len(), least);
            let last = &passes[passes.len() / 2..];
            if passes.len() >= least && is_steady(last) {
                return self.outcome(machine, last);
            }
        }
        Err(SteadyError::NotSteady)
    }

    /// What a steady run came to.
    fn outcome(&self, machine: &SpinUpMachine, passes: &[Pass]) -> Result<SteadyRun, SteadyError> {
        let bearing = planar(machine)?;
        let (_, probe) = machine.inspect(0.0, &self.state);
        let traction = traction_capacity(
            &bearing.traction,
            &machine.constants.bearing,
            self.state[INNER + 5],
            probe[INNER_LOAD_SUM],
        );
        let moment = mean(passes, |pass| pass.law);
        Ok(SteadyRun {
            moment,
            inner_moment: mean(passes, |pass| pass.inner_moment),
            outer_moment: mean(passes, |pass| pass.outer_moment),
            capacity: traction / moment.abs(),
            cage_slip: mean(passes, |pass| pass.cage_slip),
            moment_heat: mean(passes, |pass| pass.moment_heat),
            explicit_heat: mean(passes, |pass| pass.explicit_heat),
            scale: bearing.moment.as_ref().ok_or(SteadyError::NoMoment)?.scale,
        })
    }

    /// Goes on for a ball pass.
    fn pass(&mut self, machine: &SpinUpMachine) -> Result<Pass, SteadyError> {
        let layout = *machine.layout();
        let cage = machine.constants.bearing.set().cage_speed(self.speed);
        let length = 2.0 * std::f64::consts::PI / (cage.abs() * layout.balls as f64);
        let from = std::mem::take(&mut self.state);
        self.state = self.advance(machine, &from, length)?;
        let to = &self.state;
        let mean = |channel: usize| (to[channel] - from[channel]) / length;
        let law = |state: &[f64]| machine.inspect(0.0, state).1[STEADY_MOMENT];
        let heats: f64 = (0..HEATS.len()).map(|kind| mean(layout.heat(kind))).sum();
        let moment_heat = mean(layout.heat(STEADY_HEAT));
        Ok(Pass {
            law: 0.5 * (law(&from) + law(to)),
            inner_moment: mean(layout.work(0)) / self.speed,
            outer_moment: mean(layout.work(1)) / self.speed,
            moment_heat,
            explicit_heat: heats - moment_heat,
            cage_slip: 1.0 - mean(BEARING) / cage,
        })
    }

    fn advance(
        &mut self,
        machine: &SpinUpMachine,
        state: &[f64],
        length: f64,
    ) -> Result<Vec<f64>, SteadyError> {
        let settings = Settings {
            start: 0.0,
            end: length,
            tolerance: TOLERANCE,
            first_step: 1e-7,
            largest_step: 1e-3,
            step_limit: self.steps_left,
        };
        let mut endings = solve::run::<f64, SpinUp<f64>, _>(
            &[machine],
            &[state.to_vec()],
            &mut [Blind],
            &settings,
            self.watch.interrupt,
        );
        let Some(ending) = endings.pop() else {
            return Err(SteadyError::DidNotFinish);
        };
        let steps = ending.work.accepted + ending.work.rejected;
        self.steps_left = self.steps_left.saturating_sub(steps);
        match ending.stop {
            Stop::Finished => Ok(ending.state),
            Stop::StepLimit => Err(SteadyError::NotSteady),
            Stop::Interrupted => Err(SteadyError::Interrupted),
            Stop::Halted(_) | Stop::Diverged { .. } => Err(SteadyError::DidNotFinish),
        }
    }
}

/// The bearing of a machine, with a steady moment.
fn planar(machine: &SpinUpMachine) -> Result<&PlanarConstants, SteadyError> {
    match &machine.constants.bearing {
        BearingConstants::Planar(bearing) if bearing.moment.is_some() => Ok(bearing),
        _ => Err(SteadyError::NoMoment),
    }
}

/// Index of the steady moment among the heats.
const STEADY_HEAT: usize = 7;

/// Watches nothing.
struct Blind;

impl Observer<SpinUpMachine> for Blind {
    fn step(&mut self, _step: &mut Step<SpinUpMachine>) -> Flow {
        Flow::Continue
    }
}

/// Error control of steady runs: their means are wanted to 1e-3.
const TOLERANCE: f64 = 1e-4;

/// The largest coefficient of a traction law at the inner race, searched over slips of 1e-6 to 1e3 m/s.
///
/// - `load`: of a ball, N
/// - `entrainment`: m/s
pub fn largest_coefficient(traction: &Traction<f64>, load: f64, entrainment: f64) -> f64 {
    (0..=900)
        .map(|i| {
            let at = SlidingContact {
                slip: 10_f64.powf(f64::from(i) / 100.0 - 6.0),
                load,
                entrainment,
            };
            traction.at_races(&at, &at).0
        })
        .fold(0.0, f64::max)
}

/// Largest traction moment of the balls on the inner race, N m: their mean load and rolling stand for all of them.
///
/// - `speed`: of the inner race, rad/s
/// - `inner_load_sum`: of all balls, N
pub fn traction_capacity(
    traction: &Traction<f64>,
    bearing: &BearingConstants,
    speed: f64,
    inner_load_sum: f64,
) -> f64 {
    let set = bearing.set();
    let track = set.inner_track_radius;
    let load = inner_load_sum / bearing.balls() as f64;
    let entrainment = track * (speed - set.cage_speed(speed));
    largest_coefficient(traction, load, entrainment) * track * inner_load_sum
}
