//! A batch of machines driven step by step.
//!
//! ```text
//!   load ─▶ advance ─▶ pause: until, landing, event ─▶ look, change inputs, save ─▶ go on ─▶ advance ─▶ … ─▶ ended
//! ```
//! Every lane has its machine, its time and its own steps; a lane that pauses leaves the bits of its neighbours alone. What a
//! stop is asked for (`until`), a known instant (a landing) and a state event are ends of steps.

use crate::attempt::{Advance, Explicit};
use crate::drive::{Ending, Flow, Observer, Settings, Stop, Work};
use crate::implicit::{Implicit, Tangents};
use crate::lane::{Held, Lane};
use crate::method::{Method, Place};
use crate::scheme::Scheme;
use crate::state_event::{Event, find_event};
use crate::step::{LaneOf, Scratch, Step};
use crate::system::{Batch, Machine};
use crate::workspace::{Workspace, lane_of, put, with_lane};
use number::{Mask, Real};
use std::sync::atomic::{AtomicBool, Ordering};

/// A machine to put on a lane.
#[derive(Debug)]
pub struct Start<'m, 's, M> {
    /// The machine.
    pub machine: Held<'m, M>,
    /// Its state.
    pub state: &'s [f64],
    /// Its place among the observers.
    pub observer: usize,
    /// How to integrate; it goes on to the end of these.
    pub settings: Settings,
    /// Whether it pauses at its landings and state events.
    pub pause_at_events: bool,
}

/// The mode of a machine of a batch.
pub type ModeOf<R, B> = <<B as Batch<R>>::Machine as Machine>::Mode;

/// Why a lane stands still.
#[derive(Clone, Debug, PartialEq)]
pub enum Pause {
    /// The time that was asked for is reached.
    Until,
    /// The landing of that index is taken, the last of those at one instant.
    Landing(usize),
    /// The observer wanted it.
    Wanted,
    /// A state event has happened, and no landing at its instant.
    Event,
    /// The run is over.
    Ended(Stop),
}

/// A machine on a lane at a pause, with all that its further steps depend on but its observer.
#[derive(Clone)]
pub struct Saved<'m, M: Machine> {
    lane: Lane<'m, M>,
    /// State, rates, probes at its time, and reciprocals of the errors that are allowed.
    values: [Vec<f64>; 4],
    last_logarithm: f64,
    method: Vec<f64>,
}

/// Machines side by side, `R::LANES` of them, driven step by step by a method.
///
/// Every lane has its own step: a machine gives bitwise the same result alone, in any company, on any lane and whenever it
/// gets there.
pub struct Stepper<'m, R: Real, B: Batch<R>, S> {
    method: S,
    lanes: Vec<Lane<'m, B::Machine>>,
    batch: B,
    mode: B::Mode,
    work: Workspace<R>,
    scratch: Scratch,
    /// Lanes whose rates at their start are not known.
    fresh: u64,
    /// Whether other machines stand on lanes than those that were gathered.
    loaded: bool,
    iteration: u64,
}

impl<'m, R: Real, B: Batch<R>> Stepper<'m, R, B, Explicit> {
    /// Machines at their starts, driven by explicit steps; lanes beyond the last machine stand still.
    ///
    /// # Panics
    /// When there are no machines, or more than lanes.
    pub fn explicit(scheme: &Scheme, starts: &[Start<'m, '_, B::Machine>]) -> Self {
        Self::new(|_| Explicit(*scheme), starts)
    }
}

impl<'m, R: Real, B: Tangents<R>> Stepper<'m, R, B, Implicit<R, B::Room>> {
    /// The same by linearly implicit steps, where contacts and friction are so stiff that stability bounds the explicit ones.
    ///
    /// # Panics
    /// As [`explicit`](Stepper::explicit).
    pub fn implicit(starts: &[Start<'m, '_, B::Machine>]) -> Self {
        Self::new(
            |batch| Implicit::new(batch, starts[0].machine.dimension()),
            starts,
        )
    }
}

impl<'m, R: Real, B: Batch<R>, S: Method<R, B>> Stepper<'m, R, B, S> {
    pub(crate) fn new(method: impl FnOnce(&B) -> S, starts: &[Start<'m, '_, B::Machine>]) -> Self {
        assert!((1..=R::LANES).contains(&starts.len()), "one machine a lane");
        // spare lanes copy the last machine and stand still
        let start = |lane: usize| &starts[lane.min(starts.len() - 1)];
        let mut lanes: Vec<_> = (0..R::LANES).map(|lane| Lane::of(start(lane))).collect();
        for spare in &mut lanes[starts.len()..] {
            spare.pause = Some(Pause::Ended(Stop::Finished));
        }
        let machine = &*starts[0].machine;
        let mut work = Workspace::<R>::of(machine);
        for lane in 0..R::LANES {
            load(&mut work, lane, start(lane));
        }
        let batch = B::gather(&|lane| &*lanes[lane].machine);
        Stepper {
            method: method(&batch),
            mode: B::gather_mode(&|lane| lanes[lane].mode),
            lanes,
            batch,
            work,
            scratch: Scratch::new(machine.dimension(), machine.probes()),
            fresh: u64::MAX,
            loaded: false,
            iteration: 0,
        }
    }

    /// Puts a machine at its start on a lane, whatever stood there.
    pub fn load(&mut self, lane: usize, start: &Start<'m, '_, B::Machine>) {
        self.lanes[lane] = Lane::of(start);
        load(&mut self.work, lane, start);
        self.fresh |= 1 << lane;
        self.loaded = true;
    }
    /// Lets a lane that paused go on to a time (s), or to its end where that comes first. A run that is over stays so.
    pub fn go_on(&mut self, lane: usize, until: f64) {
        let lane = &mut self.lanes[lane];
        lane.until = until;
        lane.pause
            .take_if(|pause| !matches!(pause, Pause::Ended(_)));
    }
    /// Changes the mode, inputs among it, or the state of a lane at a pause: it goes on from there as after a landing.
    ///
    /// # Panics
    /// When the next landing of the new mode lies before the time that is reached.
    pub fn change(&mut self, lane: usize, change: impl FnOnce(&mut ModeOf<R, B>, &mut [f64])) {
        let own = &mut self.lanes[lane];
        self.scratch.take(&self.work, lane);
        change(&mut own.mode, &mut self.scratch.state);
        let state = &self.scratch.state;
        put(&mut self.work.state, lane, |channel| state[channel]);
        assert!(own.due() >= own.time, "no landing lies behind");
        own.jumped(&mut self.work, lane);
        self.fresh |= 1 << lane;
    }
    /// Why a lane stands still; none before it has paused.
    pub fn pause(&self, lane: usize) -> Option<&Pause> {
        self.lanes[lane].pause.as_ref()
    }
    /// Time that a lane has reached, s.
    pub fn time(&self, lane: usize) -> f64 {
        self.lanes[lane].time
    }
    /// The machine on a lane, as it is now.
    pub fn machine(&self, lane: usize) -> &B::Machine {
        &self.lanes[lane].machine
    }
    /// Its mode.
    pub fn mode(&self, lane: usize) -> ModeOf<R, B> {
        self.lanes[lane].mode
    }
    /// Its state.
    pub fn state(&self, lane: usize) -> Vec<f64> {
        lane_of(&self.work.state, lane)
    }
    /// Its steps until now.
    pub fn work(&self, lane: usize) -> Work {
        self.lanes[lane].work
    }
    /// How a run that is over ended; none before.
    pub fn ending(&self, lane: usize) -> Option<Ending> {
        let own = &self.lanes[lane];
        let Some(Pause::Ended(stop)) = &own.pause else {
            return None;
        };
        Some(Ending {
            stop: stop.clone(),
            time: own.time,
            state: self.state(lane),
            work: own.work,
        })
    }

    /// What stands on a lane at a pause, to go on later or elsewhere.
    pub fn save(&mut self, lane: usize) -> Saved<'m, B::Machine>
    where
        B::Machine: Clone,
    {
        self.renew_fresh();
        let w = &self.work;
        Saved {
            lane: self.lanes[lane].clone(),
            values: [&w.state, &w.first, &w.probe, &w.inverse_error]
                .map(|list| lane_of(list, lane)),
            last_logarithm: w.last_logarithm.lane(lane),
            method: self.method.save(lane),
        }
    }
    /// Puts on a lane what was saved: it goes on with the bits it would have had.
    pub fn restore(&mut self, lane: usize, saved: &Saved<'m, B::Machine>)
    where
        B::Machine: Clone,
    {
        self.renew_fresh();
        self.lanes[lane] = saved.lane.clone();
        let w = &mut self.work;
        let [state, first, probe, inverse_error] = &saved.values;
        put(&mut w.inverse_error, lane, |channel| inverse_error[channel]);
        put(&mut w.state, lane, |channel| state[channel]);
        put(&mut w.first, lane, |channel| first[channel]);
        put(&mut w.probe, lane, |channel| probe[channel]);
        w.seen.take(&w.state, &w.probe);
        w.last_logarithm = with_lane(w.last_logarithm, lane, saved.last_logarithm);
        self.method.restore(lane, &saved.method);
        self.gather(true);
    }

    /// The modes of what stands on the lanes; the batch too, where other machines do.
    fn gather(&mut self, machines: bool) {
        let lanes = &self.lanes;
        if machines {
            self.batch = B::gather(&|lane| &*lanes[lane].machine);
        }
        self.mode = B::gather_mode(&|lane| lanes[lane].mode);
        self.work.time = R::from_lanes(|lane| lanes[lane].time);
    }
    /// Rates and probes of the lanes that start or jumped. Those of the others are what they were: the same functions of the
    /// same states.
    fn begin(&mut self) {
        let place = Place {
            batch: &self.batch,
            mode: &self.mode,
        };
        let fresh = R::Mask::from_lanes(|lane| self.fresh & (1 << lane) != 0);
        self.method.begin(place, fresh, &mut self.work);
        self.fresh = 0;
    }
    fn renew_fresh(&mut self) {
        if self.fresh != 0 {
            // a change of mode or state alone leaves the machines
            let loaded = std::mem::take(&mut self.loaded);
            self.gather(loaded);
            self.begin();
        }
    }

    /// Goes on until a lane pauses or all stand still. Observers see each accepted step of their machines;
    /// `interrupt` is looked at every few hundred steps.
    pub fn advance<O>(&mut self, observers: &mut [O], interrupt: &AtomicBool)
    where
        O: Observer<B::Machine>,
    {
        for lane in &mut self.lanes {
            lane.told = lane.pause.is_some();
        }
        self.renew_fresh();
        loop {
            if self.iteration.is_multiple_of(256) && interrupt.load(Ordering::Relaxed) {
                for lane in self.lanes.iter_mut().filter(|lane| lane.pause.is_none()) {
                    lane.pause = Some(Pause::Ended(Stop::Interrupted));
                }
            }
            self.iteration += 1;
            let mut stands = 0;
            for (index, lane) in self.lanes.iter_mut().enumerate() {
                if lane.pause.is_none() {
                    lane.aim(&self.work, index);
                }
                stands += usize::from(lane.pause.is_some());
            }
            if stands == R::LANES || self.lanes.iter().any(Lane::has_news) {
                return;
            }
            self.step(observers);
        }
    }

    /// One step of all lanes that run, accepted or not.
    fn step<O: Observer<B::Machine>>(&mut self, observers: &mut [O]) {
        let Stepper {
            method,
            lanes,
            batch,
            mode,
            work,
            scratch,
            ..
        } = self;
        work.length = R::from_lanes(|i| match lanes[i].pause {
            None => lanes[i].step_end - lanes[i].time,
            Some(_) => 0.0,
        });
        let judgement = method.attempt(Place { batch, mode }, work);

        let mut wanted: u64 = 0;
        for (index, lane) in lanes.iter_mut().enumerate() {
            if lane.pause.is_some() {
                continue;
            }
            lane.work.rate_calls += method.evaluations();
            let fits = judgement.error.lane(index) <= 1.0;
            if !fits {
                lane.reject(&judgement, index);
                continue;
            }
            scratch.copied = 0;
            let mut retake = lane.retake;
            let mut step = Step {
                machine: &*lane.machine,
                mode: &lane.mode,
                start: lane.time,
                end: lane.step_end,
                at_start: work.seen.lane(index),
                at_end: work.next_seen.lane(index),
                data: &LaneOf { work, lane: index },
                scratch,
            };
            let event = find_event(&mut step, &mut retake);
            if let Event::Within(instant) = event {
                (lane.step_end, lane.retake) = (instant, retake);
                lane.work.rejected += 1;
                continue;
            }
            let flow = observers[lane.observer].step(&mut step);
            lane.accept(&judgement, index, S::GROWTH);
            lane.crossed = event == Event::AtTheEnd;
            match flow {
                Flow::Continue => {}
                Flow::Renew => wanted |= 1 << index,
                Flow::Pause => lane.pause = Some(Pause::Wanted),
                Flow::Halt(why) => lane.pause = Some(Pause::Ended(Stop::Halted(why))),
            }
        }
        let accepted = R::Mask::from_lanes(|i| {
            lanes[i].time == lanes[i].step_end && work.length.lane(i) > 0.0
        });
        method.accept(accepted, work);
        R::vectorized(Advance {
            work,
            accepted,
            logarithm: judgement.logarithm,
        });
        work.time = R::from_lanes(|i| lanes[i].time);
        let renewed = wanted != 0 && self.renew(observers, wanted);
        let changed = self.switch(observers);
        if renewed || self.fresh != 0 {
            // what switches mostly changes modes and states alone
            self.gather(renewed || changed);
            self.begin();
        }
    }

    /// Machines that their observers renew, whether there is any. They go on from their earlier points: slow values have moved,
    /// their states have not.
    fn renew<O: Observer<B::Machine>>(&mut self, observers: &mut [O], wanted: u64) -> bool {
        let mut renewed = false;
        for (index, lane) in self.lanes.iter_mut().enumerate() {
            if wanted & (1 << index) == 0 {
                continue;
            }
            self.scratch.take(&self.work, index);
            let state = &self.scratch.state;
            if let Some(new) = observers[lane.observer].renewed(&lane.machine, lane.time, state) {
                lane.machine = Held::Own(new.into());
                renewed = true;
            }
        }
        renewed
    }

    /// What switches at the ends of steps: state events, then landings. Whether another machine goes on.
    fn switch<O: Observer<B::Machine>>(&mut self, observers: &mut [O]) -> bool {
        let mut changed = false;
        for (index, lane) in self.lanes.iter_mut().enumerate() {
            let crossed = std::mem::take(&mut lane.crossed);
            let stood = lane.told && lane.pause.is_some();
            if stood || !crossed && lane.next_due > lane.time {
                continue;
            }
            self.scratch.take(&self.work, index);
            let state = &mut self.scratch.state[..];
            let mut mode = lane.mode;
            let mut pause = Pause::Event;
            if crossed {
                lane.machine.cross(lane.time, &mut mode, state);
                lane.mode = mode;
            }
            while lane.due() <= lane.time {
                pause = Pause::Landing(lane.next_landing);
                lane.machine.transition(lane.next_landing, &mut mode, state);
                lane.mode = mode;
                lane.next_landing += 1;
            }
            if let Some(new) = lane.machine.changed(&lane.mode) {
                lane.machine = Held::Own(new.into());
                changed = true;
            }
            let flow =
                observers[lane.observer].switched(&lane.machine, &lane.mode, lane.time, state);
            if let Flow::Halt(why) = flow {
                lane.pause = Some(Pause::Ended(Stop::Halted(why)));
            } else if lane.pause_at_events {
                lane.pause.get_or_insert(pause);
            }
            put(&mut self.work.state, index, |channel| state[channel]);
            lane.jumped(&mut self.work, index);
            self.fresh |= 1 << index;
        }
        changed
    }
}

/// Puts a machine's start and error scale on a lane.
fn load<R: Real, M: Machine>(work: &mut Workspace<R>, lane: usize, start: &Start<M>) {
    work.last_logarithm = with_lane(work.last_logarithm, lane, 0.0);
    put(&mut work.state, lane, |channel| start.state[channel]);
    put(&mut work.inverse_error, lane, |channel| {
        1.0 / (start.settings.tolerance * start.machine.error_scale(channel))
    });
}
