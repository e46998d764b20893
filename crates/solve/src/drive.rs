//! Many machines from their starts to their ends: settings, observers, endings, and the queue for free lanes.

use crate::attempt::Explicit;
use crate::bogacki_shampine::BOGACKI_SHAMPINE;
use crate::heun::HEUN;
use crate::implicit::{Implicit, Tangents};
use crate::lane::Held;
use crate::method::Method;
use crate::scheme::Scheme;
use crate::step::Step;
use crate::stepper::{Start, Stepper};
use crate::system::{Batch, Machine};
use number::Real;
use std::sync::atomic::AtomicBool;

/// The steps of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steps {
    /// Explicit: Bogacki-Shampine 3(2), the quicker one where accuracy bounds a step.
    Explicit,
    /// Explicit: Heun 3(2) with an extended region of stability, the quicker one where stability bounds a step.
    Extended,
    /// Linearly implicit: ROS34PW2, by the tangents of what is stiff.
    Implicit,
}

impl Steps {
    /// The scheme of explicit steps.
    pub fn scheme(self) -> Option<&'static Scheme> {
        match self {
            Steps::Explicit => Some(&BOGACKI_SHAMPINE),
            Steps::Extended => Some(&HEUN),
            Steps::Implicit => None,
        }
    }
}

/// How to integrate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Time at the start, s.
    pub start: f64,
    /// Time at the end, s.
    pub end: f64,
    /// Allowed error of a step, in units of each channel's error scale.
    pub tolerance: f64,
    /// Length of the first step, s.
    pub first_step: f64,
    /// Longest step, s.
    pub largest_step: f64,
    /// Steps, accepted and rejected, after which a machine is given up; after a twentieth of them already when it would
    /// need them ten times over.
    pub step_limit: u64,
}

/// What an observer wants next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// Go on.
    Continue,
    /// Go on with the machine that [`Observer::renewed`] gives.
    Renew,
    /// Pause at the end of this step.
    Pause,
    /// This machine is done; the text says why.
    Halt(&'static str),
}

/// Sees every accepted step of one machine.
pub trait Observer<M: Machine> {
    /// Called once for each accepted step, in order.
    fn step(&mut self, step: &mut Step<M>) -> Flow;
    /// The machine with other constants, from the time and state of the step after which it was wanted: slow values that
    /// are no states. It has the same channels, probes and landings. None where this machine goes on.
    fn renewed(&mut self, _machine: &M, _time: f64, _state: &[f64]) -> Option<Box<M>> {
        None
    }
    /// Called after what switches at the end of a step: the mode from then on, and the state.
    fn switched(&mut self, _machine: &M, _mode: &M::Mode, _time: f64, _state: &[f64]) -> Flow {
        Flow::Continue
    }
}

impl<M: Machine> Observer<M> for &mut (dyn Observer<M> + '_) {
    fn step(&mut self, step: &mut Step<M>) -> Flow {
        (**self).step(step)
    }
    fn renewed(&mut self, machine: &M, time: f64, state: &[f64]) -> Option<Box<M>> {
        (**self).renewed(machine, time, state)
    }
    fn switched(&mut self, machine: &M, mode: &M::Mode, time: f64, state: &[f64]) -> Flow {
        (**self).switched(machine, mode, time, state)
    }
}

/// Why a machine stopped.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// The end was reached.
    Finished,
    /// Somebody asked to stop.
    Interrupted,
    /// The observer ended it.
    Halted(&'static str),
    /// The step shrank below what time can resolve: the named channel is the stiffest or no longer a number.
    Diverged {
        /// The channel whose error stood out.
        channel: String,
        /// The step length at which it was given up, s.
        step: f64,
    },
    /// The step limit was reached.
    StepLimit {
        /// Part of the whole time that was reached.
        share: f64,
    },
}

/// How much work a machine took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Accepted steps.
    pub accepted: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Evaluations of the right-hand side in the steps.
    pub rate_calls: u64,
}

/// Where and why a machine ended, and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Ending {
    /// The reason.
    pub stop: Stop,
    /// Time of the last accepted state, s.
    pub time: f64,
    /// The last accepted state.
    pub state: Vec<f64>,
    /// The work.
    pub work: Work,
}

/// Integrates machines side by side by explicit steps, `R::LANES` at a time: a lane whose machine has ended takes the next one that waits.
/// `starts` are their initial states.
///
/// Every lane has its own step: a machine gives bitwise the same result alone, in any company, on any lane and whenever it
/// gets there. `interrupt` is looked at every few hundred steps; machines that still wait then end where they start.
///
/// # Panics
/// When there are no machines, or lists of different length.
pub fn run<R, B, O>(
    scheme: &Scheme,
    machines: &[&B::Machine],
    starts: &[Vec<f64>],
    observers: &mut [O],
    settings: &Settings,
    interrupt: &AtomicBool,
) -> Vec<Ending>
where
    R: Real,
    B: Batch<R>,
    O: Observer<B::Machine>,
{
    let method = |_: &B| Explicit(*scheme);
    integrate::<R, B, O, _>(method, machines, starts, observers, settings, interrupt)
}

/// The same by linearly implicit steps, where contacts and friction are so stiff that stability bounds the explicit ones.
///
/// # Panics
/// As [`run`].
pub fn run_implicit<R, B, O>(
    machines: &[&B::Machine],
    starts: &[Vec<f64>],
    observers: &mut [O],
    settings: &Settings,
    interrupt: &AtomicBool,
) -> Vec<Ending>
where
    R: Real,
    B: Tangents<R>,
    O: Observer<B::Machine>,
{
    let method = |batch: &B| Implicit::new(batch, machines[0].dimension());
    integrate::<R, B, O, _>(method, machines, starts, observers, settings, interrupt)
}

fn integrate<R, B, O, M>(
    method: impl FnOnce(&B) -> M,
    machines: &[&B::Machine],
    starts: &[Vec<f64>],
    observers: &mut [O],
    settings: &Settings,
    interrupt: &AtomicBool,
) -> Vec<Ending>
where
    R: Real,
    B: Batch<R>,
    O: Observer<B::Machine>,
    M: Method<R, B>,
{
    let count = machines.len();
    assert!(count >= 1, "at least one machine");
    assert!(starts.len() == count && observers.len() == count);
    let start = |member: usize| Start {
        machine: Held::Borrowed(machines[member]),
        state: &starts[member],
        observer: member,
        settings: *settings,
        pause_at_events: false,
    };
    let on_lanes = count.min(R::LANES);
    let first: Vec<_> = (0..on_lanes).map(start).collect();
    let mut stepper = Stepper::<R, B, M>::new(method, &first);
    let mut members: Vec<usize> = (0..on_lanes).collect();
    let mut waiting = on_lanes..count;
    let mut endings: Vec<Option<Ending>> = vec![None; count];
    let mut running = on_lanes;
    while running > 0 {
        stepper.advance(observers, interrupt);
        for (lane, member) in members.iter_mut().enumerate() {
            if endings[*member].is_some() {
                continue;
            }
            let Some(ending) = stepper.ending(lane) else {
                continue;
            };
            if ending.stop == Stop::Interrupted {
                for waits in waiting.by_ref() {
                    endings[waits] = Some(Ending {
                        stop: Stop::Interrupted,
                        time: settings.start,
                        state: starts[waits].clone(),
                        work: Work::default(),
                    });
                }
            }
            endings[*member] = Some(ending);
            match waiting.next() {
                Some(next) => {
                    *member = next;
                    stepper.load(lane, &start(next));
                }
                None => running -= 1,
            }
        }
    }
    // every machine has been on a lane, or has its ending already
    endings.into_iter().flatten().collect()
}
