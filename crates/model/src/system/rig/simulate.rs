//! A run of a rig, cut into segments.
//!
//! The solver lands on instants that are known. Those at which the clutch locks or gives way are not: a segment halts at
//! the first step in which one lies, the instant is found, and the run goes back to the start of that step and ends on the
//! instant. So rows, samples and largest values never see a state that was not.
//!
//! ```text
//!   locks        ω_f - Ω = 0       bisection on dense output, then Newton's method on steps that end there
//!   gives way    |T| = T_c         bisection on the torque between both ends of the step
//! ```
//! What follows the temperatures of the bearing asks for another machine ([`Warming`]): a segment ends with the step in which it
//! is asked for, and the run goes on with that machine.

use super::clutch::slip_speed;
use super::layout::{
    ACCELERATION, CLUTCH_CAPACITY, CLUTCH_TORQUE, FLYWHEEL, FLYWHEEL_ACCELERATION, SHAFT,
};
use super::progress::Progress;
use super::{Clutch, ClutchEvent, Mode, Record, RigMachine, Segment, SegmentRun};
use number::{Level, Real, Task};
use solve::{Ending, Flow, Observer, Settings, Step, Stop, Work};
use std::sync::atomic::AtomicBool;

/// A run that has ended.
#[derive(Clone, Debug, PartialEq)]
pub struct RigRun {
    /// The state at the start.
    pub start: Vec<f64>,
    /// Where and why it ended, and what it took.
    pub ending: Ending,
    /// The mode at the end.
    pub mode: Mode,
}

/// Runs a rig from its start; the times of the settings are those of its program, and start at 0.
pub fn simulate(
    machine: &RigMachine,
    settings: &Settings,
    record: &mut Record,
    interrupt: &AtomicBool,
) -> RigRun {
    simulate_on(Level::detect(), machine, settings, record, interrupt)
}

/// What follows the temperatures of the bearing while a rig runs.
pub trait Warming {
    /// Takes note of the end of a step; whether the machine is to go on as another one.
    fn is_due(&mut self, machine: &RigMachine, time: f64, state: &dyn Fn(usize) -> f64) -> bool;
    /// That machine; none where it goes on as it is.
    fn renewed(
        &mut self,
        machine: &RigMachine,
        time: f64,
        state: &[f64],
    ) -> Option<Box<RigMachine>>;
}

/// Nothing follows.
impl Warming for () {
    fn is_due(&mut self, _machine: &RigMachine, _time: f64, _state: &dyn Fn(usize) -> f64) -> bool {
        false
    }
    fn renewed(
        &mut self,
        _machine: &RigMachine,
        _time: f64,
        _state: &[f64],
    ) -> Option<Box<RigMachine>> {
        None
    }
}

/// The same with what follows its temperatures; `progress` is called with the fraction done, 0 to 1, at each thousandth.
pub fn simulate_warming(
    machine: &RigMachine,
    settings: &Settings,
    (record, warming): (&mut Record, &mut dyn Warming),
    interrupt: &AtomicBool,
    progress: &dyn Fn(f64),
) -> RigRun {
    let run = Run {
        machine,
        settings: *settings,
        interrupt,
        progress,
    };
    Level::detect().run_one(ToTheEnd {
        run,
        record,
        warming,
    })
}

/// The same on a level of the vector unit: every one gives the same bits.
///
/// # Panics
/// When this machine does not have the level.
pub fn simulate_on(
    level: Level,
    machine: &RigMachine,
    settings: &Settings,
    record: &mut Record,
    interrupt: &AtomicBool,
) -> RigRun {
    let run = Run {
        machine,
        settings: *settings,
        interrupt,
        progress: &|_| {},
    };
    let warming = &mut ();
    level.run_one(ToTheEnd {
        run,
        record,
        warming,
    })
}

/// A run as a task.
struct ToTheEnd<'a, 'r> {
    run: Run<'a>,
    record: &'r mut Record,
    warming: &'r mut dyn Warming,
}

impl Task for ToTheEnd<'_, '_> {
    type Output = RigRun;
    fn run<R: Real>(self) -> RigRun {
        self.run.to_the_end::<R>(self.record, self.warming, false)
    }
}

/// The same, but no further than to the first instant at which the clutch locks.
pub(super) fn until_locked(
    machine: &RigMachine,
    settings: &Settings,
    record: &mut Record,
) -> RigRun {
    let run = Run {
        machine,
        settings: *settings,
        interrupt: &AtomicBool::new(false),
        progress: &|_| {},
    };
    // balls that roll are few numbers: nothing is gained by several at a time
    run.to_the_end::<f64>(record, &mut (), true)
}

/// What a run needs all along.
#[derive(Clone, Copy)]
struct Run<'a> {
    machine: &'a RigMachine,
    settings: Settings,
    interrupt: &'a AtomicBool,
    progress: &'a dyn Fn(f64),
}

/// A change of the clutch within a step.
struct Found {
    /// Start of the step, s.
    start: f64,
    /// The state there.
    state: Vec<f64>,
    /// The instant of the change, s.
    instant: f64,
    /// End of the step, s.
    end: f64,
}

/// Why a segment halts.
const CHANGE: &str = "the clutch changes";
/// Why it halts where its temperatures have moved.
const WARMED: &str = "the bearing has warmed";

/// Watches the clutch, and hands on every step before a change.
struct Watch<'r> {
    record: &'r mut Record,
    warming: &'r mut dyn Warming,
    /// Length of the last step, s.
    last: f64,
    found: Option<Found>,
    progress: &'r dyn Fn(f64),
    end: f64,
}

/// Looks for nothing.
struct Blind;

impl<'a> Observer<Segment<'a>> for Blind {
    fn step(&mut self, _step: &mut Step<Segment<'a>>) -> Flow {
        Flow::Continue
    }
}

impl<'a> Observer<Segment<'a>> for Watch<'_> {
    fn step(&mut self, step: &mut Step<Segment<'a>>) -> Flow {
        let changes = match step.mode.clutch {
            Clutch::Open => false,
            Clutch::Slipping { direction } => {
                let ahead = step.end_state(FLYWHEEL + 1) - step.end_state(SHAFT + 1);
                ahead * direction <= 0.0
            }
            Clutch::Locked => step.end_probe(CLUTCH_TORQUE).abs() > step.end_probe(CLUTCH_CAPACITY),
        };
        if changes {
            let instant = instant_of_change(step);
            self.found = Some(Found {
                start: step.start,
                state: step.state(0.0).to_vec(),
                instant,
                end: step.end,
            });
            return Flow::Halt(CHANGE);
        }
        let thousandths = |time: f64| (1000.0 * time / self.end) as u64;
        if thousandths(step.end) > thousandths(step.start) {
            (self.progress)(thousandths(step.end) as f64 * 1e-3);
        }
        let flow = self.record.step(step);
        self.last = step.end - step.start;
        let rig = step.machine.rig;
        let warmed = (self.warming).is_due(rig, step.end, &|channel| step.end_state(channel));
        match flow {
            Flow::Continue if warmed => Flow::Halt(WARMED),
            flow => flow,
        }
    }
}

/// Where within a step the clutch changes, s.
fn instant_of_change(step: &mut Step<Segment<'_>>) -> f64 {
    let clutch = step.mode.clutch;
    let changed = |step: &mut Step<Segment<'_>>, theta: f64| match clutch {
        Clutch::Slipping { direction } => {
            let state = step.leading_state(theta, FLYWHEEL + 2);
            slip_speed(state) * direction <= 0.0
        }
        _ => {
            let (_, probe) = step.evaluate(theta);
            probe[CLUTCH_TORQUE].abs() > probe[CLUTCH_CAPACITY]
        }
    };
    let (mut low, mut high) = (0.0, 1.0);
    // 40 halvings: 1e-12 of a step
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if changed(step, middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    step.time(high)
}

/// Newton steps to the instant of locking; two suffice where the slip is smooth.
const NEWTON_STEPS: usize = 4;

impl<'a> Run<'a> {
    fn to_the_end<R: Real>(
        self,
        record: &mut Record,
        warming: &mut dyn Warming,
        to_lock: bool,
    ) -> RigRun {
        let start = self.machine.start();
        let mut warm: Option<Box<RigMachine>> = None;
        let mut first_step = self.settings.first_step;
        let (mut time, mut state) = (self.settings.start, start.clone());
        let mut schedule = Progress::new();
        let mut work = Work::default();
        let program = &self.machine.constants.program;
        let stop = loop {
            let machine = warm.as_deref().unwrap_or(self.machine);
            let run = Run { machine, ..self };
            if schedule.due(program) <= time {
                schedule.advance(machine, time, &state);
            }
            note(record, time, &schedule.mode, &state);
            if to_lock && schedule.mode.clutch == Clutch::Locked {
                break Stop::Halted(CHANGE);
            }
            if time >= self.settings.end {
                break Stop::Finished;
            }
            let next = schedule.due(program).min(self.settings.end);
            let mut watch = Watch {
                record: &mut *record,
                warming: &mut *warming,
                last: first_step,
                found: None,
                progress: self.progress,
                end: self.settings.end,
            };
            let ending = run.segment::<R, _>(
                &schedule.mode,
                (time, next),
                &state,
                first_step,
                work,
                &mut watch,
            );
            add(&mut work, &ending.work);
            let (found, last) = (watch.found, watch.last);
            first_step = self.settings.first_step;
            (time, state) = (ending.time, ending.state);
            if ending.stop == Stop::Halted(WARMED) {
                if let Some(new) = warming.renewed(machine, time, &state) {
                    warm = Some(new);
                }
                first_step = last;
                continue;
            }
            match found {
                None => {}
                Some(found) => {
                    let ending = run.change::<R>(&mut schedule.mode, &found, &mut work, record);
                    (time, state) = (ending.time, ending.state);
                    if ending.stop != Stop::Finished {
                        break ending.stop;
                    }
                    continue;
                }
            }
            if ending.stop != Stop::Finished {
                break ending.stop;
            }
        };
        let machine = warm.as_deref().unwrap_or(self.machine);
        record.finish(machine, &schedule.mode, time, &state);
        RigRun {
            start,
            ending: Ending {
                stop,
                time,
                state,
                work,
            },
            mode: schedule.mode,
        }
    }

    /// Goes on in a mode between two instants.
    fn segment<R: Real, O: Observer<Segment<'a>>>(
        &self,
        mode: &Mode,
        (from, to): (f64, f64),
        state: &[f64],
        first_step: f64,
        done: Work,
        observer: &mut O,
    ) -> Ending {
        let segment = self.machine.segment(*mode);
        let settings = Settings {
            start: from,
            end: to,
            first_step,
            step_limit: (self.settings.step_limit).saturating_sub(done.accepted + done.rejected),
            ..self.settings
        };
        solve::run::<R, SegmentRun<'a, R>, O>(
            &solve::BOGACKI_SHAMPINE,
            &[&segment],
            &[state.to_vec()],
            std::slice::from_mut(observer),
            &settings,
            self.interrupt,
        )
        // one machine, one ending
        .remove(0)
    }

    /// From the start of the step in which the clutch changes to that instant, and the mode from then on.
    fn change<R: Real>(
        &self,
        mode: &mut Mode,
        found: &Found,
        work: &mut Work,
        record: &mut Record,
    ) -> Ending {
        let locks = matches!(mode.clutch, Clutch::Slipping { .. });
        let span = found.end - found.start;
        let mut instant = found.instant;
        if locks {
            // a slip that began in this step and came to nothing: the step is the shortest there is
            if instant - found.start < 1e-9 * span {
                instant = found.end;
            } else {
                instant = self.instant_of_locking::<R>(mode, found, work);
            }
        }
        let mut ending = if instant > found.start {
            self.segment::<R, _>(
                mode,
                (found.start, instant),
                &found.state,
                span,
                *work,
                record,
            )
        } else {
            Ending {
                stop: Stop::Finished,
                time: found.start,
                state: found.state.clone(),
                work: Work::default(),
            }
        };
        add(work, &ending.work);
        if ending.stop != Stop::Finished {
            return ending;
        }
        if locks {
            self.machine.even_out(&mut ending.state);
            mode.clutch = self.machine.engaged(mode, ending.time, &ending.state);
        } else {
            let (_, probe) = self.machine.inspect(mode, ending.time, &ending.state);
            mode.clutch = Clutch::Slipping {
                direction: probe[CLUTCH_TORQUE].signum(),
            };
        }
        ending
    }

    /// The instant at which a slip ends, s: steps that end there bring it to zero.
    fn instant_of_locking<R: Real>(&self, mode: &Mode, found: &Found, work: &mut Work) -> f64 {
        let mut instant = found.instant;
        let least = 1e-13 * self.machine.constants.target_speed.abs();
        for _ in 0..NEWTON_STEPS {
            let ending = self.segment::<R, _>(
                mode,
                (found.start, instant),
                &found.state,
                found.end - found.start,
                *work,
                &mut Blind,
            );
            add(work, &ending.work);
            let slip = slip_speed(&ending.state);
            if ending.stop != Stop::Finished || slip.abs() <= least {
                break;
            }
            let (_, probe) = self.machine.inspect(mode, instant, &ending.state);
            let change = slip / (probe[FLYWHEEL_ACCELERATION] - probe[ACCELERATION]);
            let next = instant - change;
            // not beyond the step it was found in
            if !(next > found.start && next <= found.end) {
                break;
            }
            instant = next;
        }
        instant
    }
}

/// Takes down what the clutch does where it is something new.
fn note(record: &mut Record, time: f64, mode: &Mode, state: &[f64]) {
    if record
        .clutch
        .last()
        .is_none_or(|last| last.clutch != mode.clutch)
    {
        record.clutch.push(ClutchEvent {
            time,
            clutch: mode.clutch,
            speed: state[SHAFT + 1],
        });
    }
}

fn add(work: &mut Work, more: &Work) {
    work.accepted += more.accepted;
    work.rejected += more.rejected;
    work.rate_calls += more.rate_calls;
}
