//! A machine that is driven from outside: from stop to stop, with inputs that change between them.
//!
//! Not here: rows, results and warnings, and temperatures that act on the motion. Those are of a [run](crate::drop).

use crate::drop::build::DropModel;
use crate::drop::each::One;
use crate::ending::{DESIGN, settings_at, stop};
use crate::stepping::Stepping;
use model::system::machine::{Machines, RotorMachine};
use model::system::rig::Drive;
use model::table::Piece;
use outcome::Stop;
use problem::{Code, Problem};
use scenario::{Run, Scenario, problem_at};
use solve::{
    BOGACKI_SHAMPINE, Explicit, Flow, Held, Machine, Observer, Pause, Start, Step, Stepper,
};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// What is changed from outside between two stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// The brake of the rotor, on or off.
    Brake(bool),
    /// Radial load on a bearing on a rig, N, 0 or more; until the next row of its table.
    Load(f64),
    /// Torque on its inner race, N m, where its file gives one; until the next row of its table.
    Torque(f64),
}

/// A drop, a spin-up or a test on a rig at an instant, in explicit steps.
pub struct Simulation {
    stepper: Stepper<'static, f64, Machines<f64>, Explicit>,
    names: Vec<String>,
}

/// Nobody watches the steps.
struct Unwatched;

impl Observer<RotorMachine> for Unwatched {
    fn step(&mut self, _step: &mut Step<RotorMachine>) -> Flow {
        Flow::Continue
    }
}

impl Simulation {
    /// A drop at its release, or where its magnets hold it still.
    ///
    /// # Errors
    /// Where temperatures act on its motion.
    pub fn of_drop(scenario: &Scenario, built: &Arc<DropModel>) -> Result<Self, Box<Problem>> {
        let one = One::of(scenario, built.clone());
        if one.member.following.is_some() {
            let found = "temperatures that act on the motion".to_string();
            let needed =
                "heat.feedback = \"none\" is needed of a machine that is driven from outside";
            return Err(problem_at(Code::Conflict, "heat.feedback", found, needed));
        }
        let machine = (*one.member.machine).clone();
        let start = &one.member.start;
        Ok(Self::of(machine, start, &built.drop.run, one.stepping))
    }

    /// A machine at a start; by explicit steps of design accuracy where its run would take linearly implicit ones.
    pub(crate) fn of(machine: RotorMachine, state: &[f64], run: &Run, stepping: Stepping) -> Self {
        let (scheme, tolerance) = match stepping.steps.scheme() {
            Some(scheme) => (scheme, stepping.tolerance),
            None => (&BOGACKI_SHAMPINE, DESIGN),
        };
        let names = (0..machine.dimension()).map(|channel| machine.channel_name(channel));
        let names = names.collect();
        let start = Start {
            machine: Held::Own(Arc::new(machine)),
            state,
            observer: 0,
            settings: settings_at(run, tolerance),
            pause_at_events: false,
        };
        Simulation {
            stepper: Stepper::explicit(scheme, &[start]),
            names,
        }
    }

    /// The time that is reached, s.
    pub fn time(&self) -> f64 {
        self.stepper.time(0)
    }
    /// Names of the channels of its state, in SI: motions, then what the energy ledger has summed up.
    pub fn names(&self) -> &[String] {
        &self.names
    }
    /// The value of a channel; none where there is no such name.
    pub fn value(&self, name: &str) -> Option<f64> {
        let channel = self.names.iter().position(|own| own == name)?;
        self.stepper.state(0).get(channel).copied()
    }

    /// Goes on to a time, s, which ends a step; why it is over where it is: at the end of its run, or before.
    pub fn advance(&mut self, until: f64) -> Option<Stop> {
        if until > self.time() {
            self.stepper.go_on(0, until);
            let never = AtomicBool::new(false);
            while self.stepper.pause(0).is_none() {
                self.stepper.advance(&mut [Unwatched], &never);
            }
        }
        match self.stepper.pause(0) {
            Some(Pause::Ended(_)) => self.stepper.ending(0).as_ref().map(stop),
            _ => None,
        }
    }

    /// Changes an input from the time on that is reached.
    ///
    /// # Errors
    /// An input that the machine does not have, or a number that it cannot take.
    pub fn change(&mut self, input: Input) -> Result<(), Box<Problem>> {
        let constants = &self.stepper.machine(0).constants;
        let fixture = constants.bearings[0].fixture.as_deref();
        let clutch = fixture.is_some_and(|own| matches!(own.drive, Drive::Clutch(_)));
        let torque = fixture.is_some_and(|own| matches!(own.drive, Drive::Torque(_)));
        let (path, there, value) = match input {
            Input::Brake(_) => (
                "rotor.brake_torque",
                constants.rotor.brake_torque > 0.0,
                0.0,
            ),
            Input::Load(load) => ("drive.radial_load", fixture.is_some() && !clutch, load),
            Input::Torque(torque_now) => ("drive.torque", torque, torque_now),
        };
        let negative = matches!(input, Input::Load(_)) && value < 0.0;
        if !there || negative || !value.is_finite() {
            let found = format!("{input:?}");
            let needed = "an input that its file gives, and a finite number, are needed";
            return Err(problem_at(Code::Impossible, path, found, needed));
        }
        let from_now = Piece {
            start: self.time(),
            value,
            slope: 0.0,
        };
        self.stepper.change(0, |mode, _| match input {
            Input::Brake(on) => mode.brake = f64::from(u8::from(on)),
            Input::Load(_) => mode.load = from_now,
            Input::Torque(_) => mode.drive = from_now,
        });
        Ok(())
    }
}
