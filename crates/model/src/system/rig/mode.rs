//! What motor and clutch do between two instants at which something is switched, and how far a program has come.

use super::program::{Action, Program};
use crate::system::machine::{Mode, RotorMachine};
use crate::table::Piece;

/// Discrete facts of motor and clutch, what holds between two instants at which something is switched, and what is due next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClutchMode {
    /// Speed the motor is set to, rad/s over s; none while it is off.
    pub motor: Option<Piece<f64>>,
    /// Capacity T_c of the clutch, N m over s.
    pub capacity: Piece<f64>,
    /// What the clutch does.
    pub state: Clutch,
    next_action: usize,
    /// When the set speed has arrived, and where.
    arrival: Option<(f64, f64)>,
    /// When the capacity is the largest, and that.
    full: Option<(f64, f64)>,
}

/// What the clutch does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Clutch {
    /// Nothing.
    Open,
    /// It slips: the torque on the shaft is the capacity in this direction, 1 or -1.
    Slipping {
        /// Direction in which the flywheel is ahead of the shaft.
        direction: f64,
    },
    /// Flywheel and shaft are one body.
    Locked,
}

/// A change of the clutch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClutchEvent {
    /// When, s.
    pub time: f64,
    /// What it does from then on.
    pub clutch: Clutch,
    /// Speed of the shaft then, rad/s.
    pub speed: f64,
}

impl ClutchMode {
    /// Before anything is done: motor off, clutch open.
    pub(in crate::system) fn idle() -> Self {
        ClutchMode {
            motor: None,
            capacity: flat(0.0, 0.0),
            state: Clutch::Open,
            next_action: 0,
            arrival: None,
            full: None,
        }
    }
    /// The next instant at which something is due, s.
    pub(in crate::system) fn due(&self, program: &Program) -> f64 {
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
    /// Does what is due at an instant, where the flywheel has a speed, rad/s; whether the clutch is engaged from then on.
    fn advance(&mut self, program: &Program, time: f64, flywheel: f64) -> bool {
        let mut engaged = self.state != Clutch::Open;
        if let Some((_, speed)) = self.arrival.take_if(|(at, _)| *at <= time) {
            self.motor = Some(flat(time, speed));
        }
        if let Some((_, largest)) = self.full.take_if(|(at, _)| *at <= time) {
            self.capacity = flat(time, largest);
        }
        let actions = &program.actions;
        while let Some((_, action)) = actions.get(self.next_action).filter(|next| next.0 <= time) {
            self.next_action += 1;
            match *action {
                Action::MotorTo { speed, rate } => {
                    let (set, arrival) = rise(time, flywheel, speed, rate);
                    self.motor = Some(set);
                    self.arrival = arrival;
                }
                Action::MotorOff => {
                    self.motor = None;
                    self.arrival = None;
                }
                Action::Engage(by) => {
                    let from = self.capacity.at(time);
                    (self.capacity, self.full) = rise(time, from, by.largest, by.rate);
                    engaged = true;
                }
                Action::Disengage => {
                    (self.capacity, self.full) = (flat(time, 0.0), None);
                    engaged = false;
                }
            }
        }
        engaged
    }
}

impl Mode<f64> {
    /// Does what the program of a clutch has due at an instant.
    pub(in crate::system) fn advance(
        &mut self,
        machine: &RotorMachine,
        program: &Program,
        time: f64,
        state: &[f64],
    ) {
        let flywheel = state[machine.layout().rotor.spin()];
        let engaged = self.clutch.advance(program, time, flywheel);
        // last, since what locking takes depends on all of it
        self.clutch.state = match engaged {
            true => machine.engaged(self, time, state),
            false => Clutch::Open,
        };
    }
}

fn flat(time: f64, value: f64) -> Piece<f64> {
    Piece {
        start: time,
        value,
        slope: 0.0,
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
