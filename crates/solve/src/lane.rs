//! One lane of a stepper: where its machine stands, and how long its steps are.

use crate::drive::{Settings, Stop, Work};
use crate::state_event::Retake;
use crate::stepper::{Pause, Start};
use crate::system::Machine;
use crate::workspace::{Judgement, Workspace, with_lane};
use number::Real;
use std::ops::Deref;
use std::sync::Arc;

/// Smallest step relative to the time it starts from: below, time no longer advances reliably.
const SMALLEST_STEP: f64 = 64.0 * f64::EPSILON;

/// After this part of the step limit a machine is given up early…
const HOPELESS_PART: u64 = 20;
/// …but not before so many steps, since the first ones are short everywhere…
const HOPELESS_LEAST: u64 = 10_000;
/// …when its pace would need the limit so many times over.
const HOPELESS_FACTOR: u64 = 10;

/// A machine that a lane holds: somebody else's, or its own.
#[derive(Debug)]
pub enum Held<'m, M> {
    /// Somebody else's.
    Borrowed(&'m M),
    /// Its own.
    Own(Arc<M>),
}

impl<M> Clone for Held<'_, M> {
    fn clone(&self) -> Self {
        match self {
            Held::Borrowed(machine) => Held::Borrowed(machine),
            Held::Own(machine) => Held::Own(machine.clone()),
        }
    }
}

impl<M> Deref for Held<'_, M> {
    type Target = M;
    fn deref(&self) -> &M {
        match self {
            Held::Borrowed(machine) => machine,
            Held::Own(machine) => machine,
        }
    }
}

/// What the stepper keeps per lane.
#[derive(Clone)]
pub(crate) struct Lane<'m, M: Machine> {
    /// The machine, as it is now: another one once its observer has renewed it.
    pub machine: Held<'m, M>,
    pub observer: usize,
    pub settings: Settings,
    pub pause_at_events: bool,
    /// Where it is to pause, s.
    pub until: f64,
    pub time: f64,
    /// The length wanted by the error; a landing may cut it short for one step.
    pub length: f64,
    /// End of the current step: the landing itself where it lands.
    pub step_end: f64,
    pub mode: M::Mode,
    pub next_landing: usize,
    /// The instant to land on next, s.
    pub next_due: f64,
    pub after_rejection: bool,
    pub retake: Option<Retake>,
    /// Whether the step just accepted ended on a state event.
    pub crossed: bool,
    pub work: Work,
    pub pause: Option<Pause>,
    /// Whether [`Stepper::advance`] has returned for its pause.
    pub told: bool,
}

impl<'m, M: Machine> Lane<'m, M> {
    pub fn of(start: &Start<'m, '_, M>) -> Self {
        let (machine, settings) = (&start.machine, start.settings);
        let mut lane = Lane {
            machine: machine.clone(),
            observer: start.observer,
            settings,
            pause_at_events: start.pause_at_events,
            until: f64::INFINITY,
            time: settings.start,
            length: settings.first_step,
            step_end: settings.start,
            mode: machine.start_mode(),
            // landings before the start are past
            next_landing: (machine.landings()).partition_point(|instant| *instant < settings.start),
            next_due: f64::INFINITY,
            after_rejection: false,
            retake: None,
            crossed: false,
            work: Work::default(),
            pause: None,
            told: false,
        };
        lane.next_due = lane.due();
        lane
    }
    /// The next instant to land on in the mode as it is now, s.
    pub fn due(&self) -> f64 {
        self.machine.due(&self.mode, self.next_landing)
    }
    /// Whether it paused since [`Stepper::advance`] began.
    pub fn has_news(&self) -> bool {
        self.pause.is_some() && !self.told
    }
    /// After a jump of the mode or the state.
    pub fn jumped<R: Real>(&mut self, work: &mut Workspace<R>, lane: usize) {
        self.next_due = self.due();
        if self.machine.starts_afresh() {
            self.length = self.settings.first_step;
            self.after_rejection = false;
            work.last_logarithm = with_lane(work.last_logarithm, lane, 0.0);
        }
    }

    /// Chooses where the next step ends, or why there is none.
    pub fn aim<R: Real>(&mut self, work: &Workspace<R>, index: usize) {
        let settings = &self.settings;
        if self.time >= settings.end {
            self.pause = Some(Pause::Ended(Stop::Finished));
            return;
        }
        if self.time >= self.until {
            self.pause = Some(Pause::Until);
            return;
        }
        let steps = self.work.accepted + self.work.rejected;
        let many = (settings.step_limit / HOPELESS_PART).max(HOPELESS_LEAST);
        if steps >= many.min(settings.step_limit) {
            // far from the end after many steps: at this pace the limit would be passed many times over
            let share = (self.time - settings.start) / (settings.end - settings.start);
            if steps >= settings.step_limit
                || (HOPELESS_FACTOR * HOPELESS_PART) as f64 * share < 1.0
            {
                self.pause = Some(Pause::Ended(Stop::StepLimit { share }));
                return;
            }
        }
        self.length = self.length.min(settings.largest_step);
        let scale = self.time.abs().max(settings.end.abs());
        if self.length.is_nan() || self.length <= SMALLEST_STEP * scale {
            self.pause = Some(Pause::Ended(Stop::Diverged {
                channel: self.machine.channel_name(worst_channel(work, index)),
                step: self.length,
            }));
            return;
        }
        if self.retake.is_some() {
            return;
        }
        let target = self.next_due.min(self.until).min(settings.end);
        let remaining = target - self.time;
        self.step_end = if self.length >= remaining {
            target
        } else if self.length > 0.5 * remaining {
            // two equal steps rather than a long and a tiny one
            self.time + 0.5 * remaining
        } else {
            self.time + self.length
        };
    }

    /// Takes a step and chooses the next length.
    pub fn accept<R: Real>(&mut self, judgement: &Judgement<R>, index: usize, growth: f64) {
        let taken = self.step_end - self.time;
        self.work.accepted += 1;
        let most = if self.after_rejection { 1.0 } else { growth };
        // a step cut short by a landing does not shrink the next one
        let proposed = taken * judgement.next.lane(index).clamp(0.2, most);
        self.length = if taken < 0.99 * self.length {
            proposed.max(self.length)
        } else {
            proposed
        };
        self.after_rejection = false;
        self.retake = None;
        self.time = self.step_end;
    }

    /// Chooses the length with which the step is tried again.
    pub fn reject<R: Real>(&mut self, judgement: &Judgement<R>, index: usize) {
        self.work.rejected += 1;
        let factor = if judgement.error.lane(index).is_finite() {
            judgement.again.lane(index).clamp(0.1, 0.9)
        } else {
            0.1
        };
        self.length = (self.step_end - self.time) * factor;
        self.after_rejection = true;
        self.retake = None;
    }
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
