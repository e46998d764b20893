//! What is done to the rig, and when.
//!
//! | program | start | what is done |
//! |---|---|---|
//! | [`Program::coast_down`] | turning | nothing: motor off, clutch open, or locked to the flywheel |
//! | [`Program::spin_up`] | flywheel at speed, shaft at rest | the clutch engages; the motor holds its speed or is off |
//! | [`Program::motored_spin_up`] | at rest | the motor brings the flywheel to speed, then the clutch engages |
//! | [`Program::ramp_and_hold`] | at rest, locked | the motor ramps to a speed and holds it |
//! | [`Program::repeat_after_rest`] | flywheel at speed, shaft at rest | engage, disengage, come to rest, engage again |
//!
//! Any other program is a list of actions.

use super::{Mode, RigMachine, RigRefusal};
use crate::system::rig::clutch::Clutch;
use crate::system::rig::layout::FLYWHEEL;
use crate::table::Piece;

/// A start and a list of actions in the order of their times.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// How the run starts: motor off, clutch open.
    pub start: Start,
    /// Actions at their times, s; of several at one time the last of a kind counts.
    pub actions: Vec<(f64, Action)>,
}

/// Speeds at the start; balls and cage roll with the shaft.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Start {
    /// Of the shaft, rad/s.
    pub shaft_speed: f64,
    /// Of the flywheel, rad/s.
    pub flywheel_speed: f64,
}

impl Start {
    /// Everything at rest.
    pub const REST: Start = Start {
        shaft_speed: 0.0,
        flywheel_speed: 0.0,
    };
}

/// Something that is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// The motor is set to a speed, from the speed the flywheel has.
    MotorTo {
        /// Speed to reach, rad/s.
        speed: f64,
        /// Size of the rate at which the set speed goes there, rad/s²; infinite for at once.
        rate: f64,
    },
    /// The motor is off.
    MotorOff,
    /// The clutch is pressed.
    Engage(Engagement),
    /// The clutch opens.
    Disengage,
}

/// How the clutch is pressed: its capacity goes from what it is, zero where it is open, to its largest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Engagement {
    /// Size of the rate at which it does, N m/s; infinite for at once.
    pub rate: f64,
    /// Largest capacity, N m.
    pub largest: f64,
}

impl Engagement {
    /// The whole capacity at once, N m.
    pub fn at_once(largest: f64) -> Self {
        Engagement {
            rate: f64::INFINITY,
            largest,
        }
    }
}

impl Program {
    /// From a speed of the shaft (rad/s) down, the motor off: alone, or locked to the flywheel by a clutch of a largest
    /// capacity (N m).
    pub fn coast_down(speed: f64, locked: Option<f64>) -> Self {
        Program {
            start: Start {
                shaft_speed: speed,
                flywheel_speed: if locked.is_some() { speed } else { 0.0 },
            },
            actions: locked
                .map(|largest| (0.0, Action::Engage(Engagement::at_once(largest))))
                .into_iter()
                .collect(),
        }
    }
    /// The flywheel at a speed (rad/s), the shaft at rest; the clutch engages at a time (s). The motor holds the flywheel's
    /// speed, or is off.
    pub fn spin_up(speed: f64, engage_at: f64, engagement: Engagement, motor_holds: bool) -> Self {
        let hold = (
            0.0,
            Action::MotorTo {
                speed,
                rate: f64::INFINITY,
            },
        );
        Program {
            start: Start {
                shaft_speed: 0.0,
                flywheel_speed: speed,
            },
            actions: motor_holds
                .then_some(hold)
                .into_iter()
                .chain([(engage_at, Action::Engage(engagement))])
                .collect(),
        }
    }
    /// From rest: the motor brings the flywheel to a speed (rad/s) at a rate (rad/s²) from time 0; the clutch engages at a
    /// time (s), and the motor goes on, or is off from then.
    pub fn motored_spin_up(
        speed: f64,
        rate: f64,
        engage_at: f64,
        engagement: Engagement,
        motor_holds: bool,
    ) -> Self {
        let mut actions = vec![(0.0, Action::MotorTo { speed, rate })];
        if !motor_holds {
            actions.push((engage_at, Action::MotorOff));
        }
        actions.push((engage_at, Action::Engage(engagement)));
        Program {
            start: Start::REST,
            actions,
        }
    }
    /// From rest, the clutch locked by its largest capacity (N m): the motor ramps to a speed (rad/s) at a rate (rad/s²) and
    /// holds it.
    pub fn ramp_and_hold(speed: f64, rate: f64, largest: f64) -> Self {
        Program {
            start: Start::REST,
            actions: vec![
                (0.0, Action::Engage(Engagement::at_once(largest))),
                (0.0, Action::MotorTo { speed, rate }),
            ],
        }
    }
    /// A spin-up as [`spin_up`](Self::spin_up) with the motor on; the clutch opens after `run` (s) and engages again after
    /// `rest` (s) more, in which the shaft comes to rest.
    pub fn repeat_after_rest(
        speed: f64,
        engage_at: f64,
        engagement: Engagement,
        run: f64,
        rest: f64,
    ) -> Self {
        let mut program = Program::spin_up(speed, engage_at, engagement, true);
        program.actions.extend([
            (engage_at + run, Action::Disengage),
            (engage_at + run + rest, Action::Engage(engagement)),
        ]);
        program
    }

    /// Refuses what has no meaning.
    pub fn check(&self) -> Result<(), RigRefusal> {
        if !(self.start.shaft_speed.is_finite() && self.start.flywheel_speed.is_finite()) {
            return Err(RigRefusal::Negative("size of a speed at the start"));
        }
        let mut last = 0.0;
        for (index, (time, action)) in self.actions.iter().enumerate() {
            if !(time.is_finite() && *time >= last) {
                return Err(RigRefusal::Order(index));
            }
            last = *time;
            let sound = match action {
                Action::MotorTo { speed, rate } => speed.is_finite() && *rate > 0.0,
                Action::Engage(by) => by.rate > 0.0 && by.largest >= 0.0 && by.largest.is_finite(),
                Action::MotorOff | Action::Disengage => true,
            };
            if !sound {
                return Err(RigRefusal::Action(index));
            }
        }
        Ok(())
    }
}

/// How far a program has come: what holds now, and what is due next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Schedule {
    /// What holds.
    pub mode: Mode,
    next_action: usize,
    /// When the set speed has arrived, and where.
    arrival: Option<(f64, f64)>,
    /// When the capacity is the largest, and that.
    full: Option<(f64, f64)>,
}

fn flat(time: f64, value: f64) -> Piece<f64> {
    Piece {
        start: time,
        value,
        slope: 0.0,
    }
}

impl Schedule {
    /// Before anything is done: motor off, clutch open.
    pub fn new() -> Self {
        Schedule {
            mode: Mode {
                motor: None,
                capacity: flat(0.0, 0.0),
                clutch: Clutch::Open,
            },
            next_action: 0,
            arrival: None,
            full: None,
        }
    }
    /// The next instant at which something is due, s.
    pub fn due(&self, program: &Program) -> f64 {
        let action = program.actions.get(self.next_action).map(|next| next.0);
        [
            action,
            self.arrival.map(|(time, _)| time),
            self.full.map(|(time, _)| time),
        ]
        .into_iter()
        .flatten()
        .fold(f64::INFINITY, f64::min)
    }
    /// Does what is due at an instant; true where the clutch was pressed or opened.
    pub fn advance(&mut self, machine: &RigMachine, time: f64, state: &[f64]) -> bool {
        let mut touched = false;
        let mut engaged = self.mode.clutch != Clutch::Open;
        if let Some((_, speed)) = self.arrival.take_if(|(at, _)| *at <= time) {
            self.mode.motor = Some(flat(time, speed));
        }
        if let Some((_, largest)) = self.full.take_if(|(at, _)| *at <= time) {
            self.mode.capacity = flat(time, largest);
        }
        let actions = &machine.constants.program.actions;
        while let Some((_, action)) = actions.get(self.next_action).filter(|next| next.0 <= time) {
            self.next_action += 1;
            match *action {
                Action::MotorTo { speed, rate } => {
                    let from = state[FLYWHEEL + 1];
                    let (set, arrival) = rise(time, from, speed, rate);
                    self.mode.motor = Some(set);
                    self.arrival = arrival;
                }
                Action::MotorOff => {
                    self.mode.motor = None;
                    self.arrival = None;
                }
                Action::Engage(by) => {
                    let from = self.mode.capacity.at(time);
                    (self.mode.capacity, self.full) = rise(time, from, by.largest, by.rate);
                    (touched, engaged) = (true, true);
                }
                Action::Disengage => {
                    (self.mode.capacity, self.full) = (flat(time, 0.0), None);
                    (touched, engaged) = (true, false);
                }
            }
        }
        // last, since what locking takes depends on all of it
        self.mode.clutch = if engaged {
            machine.engaged(&self.mode, time, state)
        } else {
            Clutch::Open
        };
        touched
    }
}

/// The line from a value to another at a rate of that size, and when it arrives where; at once the value itself.
fn rise(time: f64, from: f64, to: f64, rate: f64) -> (Piece<f64>, Option<(f64, f64)>) {
    let duration = (to - from).abs() / rate;
    if duration > 0.0 && duration.is_finite() {
        let line = Piece {
            start: time,
            value: from,
            slope: (to - from) / duration,
        };
        (line, Some((time + duration, to)))
    } else {
        (flat(time, to), None)
    }
}
