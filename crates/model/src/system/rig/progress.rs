//! How far a program has come: what is due, and what holds from then on.

use super::layout::FLYWHEEL;
use super::machine::RigMachine;
use super::mode::{Clutch, Mode};
use super::program::{Action, Program};
use crate::table::Piece;

/// How far a program has come: what holds now, and what is due next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Progress {
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

impl Progress {
    /// Before anything is done: motor off, clutch open.
    pub fn new() -> Self {
        Progress {
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
