//! The loop: per-lane step control, landed instants, endings.

use crate::attempt::{Advance, Explicit};
use crate::bogacki_shampine::BOGACKI_SHAMPINE;
use crate::heun::HEUN;
use crate::implicit::{Implicit, Tangents};
use crate::method::{Method, Place};
use crate::scheme::Scheme;
use crate::step::{LaneOf, Scratch, Step};
use crate::system::{Batch, Machine};
use crate::workspace::{Judgement, Workspace};
use number::{Mask, Real};
use std::sync::atomic::{AtomicBool, Ordering};

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
}

impl<M: Machine> Observer<M> for &mut (dyn Observer<M> + '_) {
    fn step(&mut self, step: &mut Step<M>) -> Flow {
        (**self).step(step)
    }
    fn renewed(&mut self, machine: &M, time: f64, state: &[f64]) -> Option<Box<M>> {
        (**self).renewed(machine, time, state)
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

/// Smallest step relative to the time it starts from: below, time no longer advances reliably.
const SMALLEST_STEP: f64 = 64.0 * f64::EPSILON;

/// After this part of the step limit a machine is given up early…
const HOPELESS_PART: u64 = 20;
/// …but not before so many steps, since the first ones are short everywhere…
const HOPELESS_LEAST: u64 = 10_000;
/// …when its pace would need the limit so many times over.
const HOPELESS_FACTOR: u64 = 10;

/// What the loop keeps per lane.
struct Lane<M: Machine> {
    /// The machine on it, by its place among all.
    member: usize,
    /// The same with other constants, once its observer has renewed it.
    renewed: Option<Box<M>>,
    /// Whether the machine's ending was taken down, or the lane never had one of its own.
    empty: bool,
    time: f64,
    /// The length wanted by the error; a landing may cut it short for one step.
    length: f64,
    /// End of the current step: the landing itself where it lands.
    step_end: f64,
    mode: M::Mode,
    next_landing: usize,
    after_rejection: bool,
    work: Work,
    stop: Option<Stop>,
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
    let dimension = machines[0].dimension();
    let probes = machines[0].probes();

    // spare lanes copy the last machine and stand still
    let mut lanes: Vec<Lane<B::Machine>> = (0..R::LANES)
        .map(|lane| Lane::at_start(machines, lane, settings))
        .collect();
    let mut next = count.min(R::LANES);
    let mut endings: Vec<Option<Ending>> = vec![None; count];
    let mut scratch = Scratch::new(dimension, probes);
    let mut work = Workspace::<R>::of(machines[0]);
    let mut batch = B::gather(&|lane| lanes[lane].machine(machines));
    for (lane, own) in lanes.iter().enumerate() {
        load(
            &mut work,
            lane,
            machines[own.member],
            &starts[own.member],
            settings,
        );
    }
    work.time = R::splat(settings.start);
    let mut method = method(&batch);
    let mut mode = B::gather_mode(&|lane| lanes[lane].mode);
    let place = Place {
        batch: &batch,
        mode: &mode,
    };
    method.begin(place, R::Mask::from_lanes(|_| true), &mut work);

    let mut iteration: u64 = 0;
    loop {
        if iteration.is_multiple_of(256) && interrupt.load(Ordering::Relaxed) {
            for lane in &mut lanes {
                lane.stop.get_or_insert(Stop::Interrupted);
            }
            for member in next..count {
                endings[member] = Some(Ending {
                    stop: Stop::Interrupted,
                    time: settings.start,
                    state: starts[member].clone(),
                    work: Work::default(),
                });
            }
            next = count;
        }
        iteration += 1;
        for (index, lane) in lanes.iter_mut().enumerate() {
            if lane.stop.is_none() {
                aim(lane, machines, settings, &work, index);
            }
        }
        let mut refilled: u64 = 0;
        for (index, lane) in lanes.iter_mut().enumerate() {
            if lane.empty || lane.stop.is_none() {
                continue;
            }
            endings[lane.member] = Some(lane.ending(&work, index));
            lane.empty = true;
            if next < count {
                *lane = Lane::at_start(machines, next, settings);
                load(&mut work, index, machines[next], &starts[next], settings);
                next += 1;
                refilled |= 1 << index;
            }
        }
        if refilled != 0 {
            batch = B::gather(&|lane| lanes[lane].machine(machines));
            mode = B::gather_mode(&|lane| lanes[lane].mode);
            work.time = R::from_lanes(|i| lanes[i].time);
            let place = Place {
                batch: &batch,
                mode: &mode,
            };
            // rates and probes of the others are what they were: the same functions of the same states
            let fresh = R::Mask::from_lanes(|i| refilled & (1 << i) != 0);
            method.begin(place, fresh, &mut work);
            continue;
        }
        if lanes.iter().all(|lane| lane.stop.is_some()) {
            break;
        }
        work.length = R::from_lanes(|i| match lanes[i].stop {
            None => lanes[i].step_end - lanes[i].time,
            Some(_) => 0.0,
        });

        let place = Place {
            batch: &batch,
            mode: &mode,
        };
        let judgement = method.attempt(place, &mut work);

        let mut jumped: u64 = 0;
        let mut wanted: u64 = 0;
        for (index, lane) in lanes.iter_mut().enumerate() {
            if lane.stop.is_some() {
                continue;
            }
            lane.work.rate_calls += method.evaluations();
            if !control(lane, &judgement, index, M::GROWTH) {
                continue;
            }
            scratch.copied = 0;
            let flow = observers[lane.member].step(&mut Step {
                machine: lane.machine(machines),
                mode: &lane.mode,
                start: lane.time,
                end: lane.step_end,
                at_start: work.seen.lane(index),
                at_end: work.next_seen.lane(index),
                data: &LaneOf {
                    work: &work,
                    lane: index,
                },
                scratch: &mut scratch,
            });
            lane.time = lane.step_end;
            match flow {
                Flow::Continue => {}
                Flow::Renew => wanted |= 1 << index,
                Flow::Halt(why) => lane.stop = Some(Stop::Halted(why)),
            }
        }
        let accepted = R::Mask::from_lanes(|i| {
            lanes[i].time == lanes[i].step_end && work.length.lane(i) > 0.0
        });
        method.accept(accepted, &work);
        R::vectorized(Advance {
            work: &mut work,
            accepted,
            logarithm: judgement.logarithm,
        });
        work.time = R::from_lanes(|i| lanes[i].time);
        let mut renewed = false;
        for (index, lane) in lanes.iter_mut().enumerate() {
            if wanted & (1 << index) == 0 {
                continue;
            }
            scratch.take(&work, index);
            let machine = lane.machine(machines);
            let new = observers[lane.member].renewed(machine, lane.time, &scratch.state);
            if new.is_some() {
                lane.renewed = new;
                renewed = true;
            }
        }
        if renewed {
            batch = B::gather(&|lane| lanes[lane].machine(machines));
        }
        for (index, lane) in lanes.iter_mut().enumerate() {
            let machine = machines[lane.member];
            let landings = machine.landings();
            while lane.next_landing < landings.len() && landings[lane.next_landing] <= lane.time {
                scratch.take(&work, index);
                machine.transition(lane.next_landing, &mut lane.mode, &mut scratch.state);
                for (channel, value) in scratch.state.iter().enumerate() {
                    let old = work.state[channel];
                    work.state[channel] =
                        R::from_lanes(|i| if i == index { *value } else { old.lane(i) });
                }
                lane.next_landing += 1;
                jumped |= 1 << index;
            }
        }
        if jumped != 0 || renewed {
            mode = B::gather_mode(&|lane| lanes[lane].mode);
            let place = Place {
                batch: &batch,
                mode: &mode,
            };
            // a renewed machine goes on from its earlier points: slow values have moved, its state has not
            let fresh = R::Mask::from_lanes(|i| jumped & (1 << i) != 0);
            method.begin(place, fresh, &mut work);
        }
    }

    // every machine has been on a lane, or has its ending already
    endings.into_iter().flatten().collect()
}

impl<M: Machine> Lane<M> {
    /// A lane with a machine at its start; beyond the last machine it stands still with a copy of that.
    fn at_start(machines: &[&M], member: usize, settings: &Settings) -> Self {
        let spare = member >= machines.len();
        let member = member.min(machines.len() - 1);
        let machine = machines[member];
        Lane {
            member,
            renewed: None,
            empty: spare,
            time: settings.start,
            length: settings.first_step,
            step_end: settings.start,
            mode: machine.start_mode(),
            // landings before the start are past
            next_landing: (machine.landings()).partition_point(|instant| *instant < settings.start),
            after_rejection: false,
            work: Work::default(),
            stop: spare.then_some(Stop::Finished),
        }
    }

    /// The machine on it, as it is now.
    fn machine<'a>(&'a self, machines: &[&'a M]) -> &'a M {
        self.renewed.as_deref().unwrap_or(machines[self.member])
    }

    /// How its machine ended.
    fn ending<R: Real>(&self, work: &Workspace<R>, lane: usize) -> Ending {
        Ending {
            stop: self.stop.clone().unwrap_or(Stop::Finished),
            time: self.time,
            state: work.state.iter().map(|value| value.lane(lane)).collect(),
            work: self.work,
        }
    }
}

/// Puts a machine's start and error scale on a lane.
fn load<R: Real, M: Machine>(
    work: &mut Workspace<R>,
    lane: usize,
    machine: &M,
    start: &[f64],
    settings: &Settings,
) {
    let put = |list: &mut [R], value: &dyn Fn(usize) -> f64| {
        for (channel, lanes) in list.iter_mut().enumerate() {
            let old = *lanes;
            let new = value(channel);
            *lanes = R::from_lanes(|i| if i == lane { new } else { old.lane(i) });
        }
    };
    let last = work.last_logarithm;
    work.last_logarithm = R::from_lanes(|i| if i == lane { 0.0 } else { last.lane(i) });
    put(&mut work.state, &|channel| start[channel]);
    put(&mut work.inverse_error, &|channel| {
        1.0 / (settings.tolerance * machine.error_scale(channel))
    });
}

/// Chooses where the next step of a lane ends, or why there is none.
fn aim<R: Real, M: Machine>(
    lane: &mut Lane<M>,
    machines: &[&M],
    settings: &Settings,
    work: &Workspace<R>,
    index: usize,
) {
    let machine = machines[lane.member];
    let target = machine
        .landings()
        .get(lane.next_landing)
        .copied()
        .unwrap_or(f64::INFINITY)
        .min(settings.end);
    if lane.time >= settings.end {
        lane.stop = Some(Stop::Finished);
        return;
    }
    let steps = lane.work.accepted + lane.work.rejected;
    // far from the end after many steps: at this pace the limit would be passed many times over
    let share = (lane.time - settings.start) / (settings.end - settings.start);
    let hopeless = steps >= (settings.step_limit / HOPELESS_PART).max(HOPELESS_LEAST)
        && (HOPELESS_FACTOR * HOPELESS_PART) as f64 * share < 1.0;
    if steps >= settings.step_limit || hopeless {
        lane.stop = Some(Stop::StepLimit { share });
        return;
    }
    lane.length = lane.length.min(settings.largest_step);
    let scale = lane.time.abs().max(settings.end.abs());
    if lane.length.is_nan() || lane.length <= SMALLEST_STEP * scale {
        lane.stop = Some(Stop::Diverged {
            channel: machine.channel_name(worst_channel(work, index)),
            step: lane.length,
        });
        return;
    }
    let remaining = target - lane.time;
    lane.step_end = if lane.length >= remaining {
        target
    } else if lane.length > 0.5 * remaining {
        // two equal steps rather than a long and a tiny one
        lane.time + 0.5 * remaining
    } else {
        lane.time + lane.length
    };
}

/// The channel whose rate is largest in units of its error scale, or not a number.
fn worst_channel<R: Real>(work: &Workspace<R>, lane: usize) -> usize {
    let urgency = |channel: usize| {
        let rate = work.last[channel].lane(lane);
        let urgency = (rate * work.inverse_error[channel].lane(lane)).abs();
        if urgency.is_nan() {
            f64::INFINITY
        } else {
            urgency
        }
    };
    (0..work.state.len())
        .max_by(|a, b| urgency(*a).total_cmp(&urgency(*b)))
        .unwrap_or(0)
}

/// Accepts or rejects a step by its error and chooses the next length. True when accepted.
fn control<R: Real, M: Machine>(
    lane: &mut Lane<M>,
    judgement: &Judgement<R>,
    index: usize,
    growth: f64,
) -> bool {
    let taken = lane.step_end - lane.time;
    let error = judgement.error.lane(index);
    if error <= 1.0 {
        lane.work.accepted += 1;
        let most = if lane.after_rejection { 1.0 } else { growth };
        // a step cut short by a landing does not shrink the next one
        let proposed = taken * judgement.next.lane(index).clamp(0.2, most);
        lane.length = if taken < 0.99 * lane.length {
            proposed.max(lane.length)
        } else {
            proposed
        };
        lane.after_rejection = false;
        true
    } else {
        lane.work.rejected += 1;
        let factor = if error.is_finite() {
            judgement.again.lane(index).clamp(0.1, 0.9)
        } else {
            0.1
        };
        lane.length = taken * factor;
        lane.after_rejection = true;
        false
    }
}
