//! A machine that is driven from outside: without controllers, from stop to stop.
//!
//! ```text
//!   between two stops       commands of the magnet axes, A, V or N                 states that are held
//!                           torque on the rotor, N m; forces at nodes, N           the mode
//!                           acceleration of the base besides its record, m/s²      the mode
//! ```
//! Errors of steps are judged as with the controllers, so that commands which change where theirs did give the same steps.

use super::simulate::Steps;
use super::tangents::Room;
use super::{Event, MOST_LOADED, Machines, Mode, RotorMachine};
use crate::magnets::ControlEvent;
use crate::schedule::Schedule;
use ::levitation::Commands;
use number::{Level, Real, Task, Vec2};
use solve::{
    Ending, Explicit, Held, Implicit, Machine, Observer, Pause, Saved, Settings, Start, Stepper,
    Work,
};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// What acts from outside besides what the machine has of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outside {
    /// Torque on the rotor, N m.
    pub torque: f64,
    /// Acceleration of the base, m/s².
    pub base: Vec2<f64>,
}

impl Outside {
    /// Nothing.
    pub const NONE: Self = Outside {
        torque: 0.0,
        base: Vec2 { x: 0.0, y: 0.0 },
    };
}

/// Why a machine cannot be driven from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotDriven {
    /// The amplifier of an axis takes no such command.
    Amplifier(usize),
    /// Forces from outside would act at more nodes than there is room for.
    Nodes,
}

impl RotorMachine {
    /// The commands of the axes of magnets with controllers in a state: A, V or N.
    fn commands(&self, kind: Commands, state: &[f64]) -> Result<Vec<f64>, NotDriven> {
        let motion = self.layout.rotor.motion(state);
        let states = &state[self.layout.magnets.clone()];
        let Some(magnets) = self.one.magnets.as_ref().filter(|_| self.controlled()) else {
            return Ok(Vec::new());
        };
        if kind == Commands::Force {
            return Ok(magnets.forces(0.0, &motion, states).to_vec());
        }
        let axes = magnets.commands(0.0, &motion, states).into_iter();
        axes.enumerate()
            .map(|(axis, (command, voltage))| match kind {
                Commands::Voltage => voltage.ok_or(NotDriven::Amplifier(axis)),
                _ => Ok(command),
            })
            .collect()
    }

    /// The machine without its controllers, whose commands are held, and with room for forces at more nodes, at a start of its own: it
    /// stands there as with the controllers.
    ///
    /// # Errors
    /// Where an amplifier takes no such command, or there is no room for the forces.
    pub fn without_controllers(
        &self,
        kind: Commands,
        state: &[f64],
        pushed: &[Vec<f64>],
    ) -> Result<(Self, Vec<f64>), NotDriven> {
        let commands = self.commands(kind, state)?;
        let mut constants = self.constants.clone();
        constants.loaded.extend_from_slice(pushed);
        if constants.loaded.len() > MOST_LOADED {
            return Err(NotDriven::Nodes);
        }
        if let Some(magnets) = &constants.magnets {
            let driven = magnets.without_controller(kind, &commands);
            if let Some(driven) = driven.map_err(NotDriven::Amplifier)? {
                constants.magnets = Some(driven);
            }
        }
        let sampled = |event: &Event| {
            let event = match event {
                Event::Control(event) => event,
                _ => return false,
            };
            matches!(event, ControlEvent::Sample | ControlEvent::Release)
        };
        let events = constants.schedule.all();
        constants.schedule = Schedule::of(events.filter(|(_, event)| !sampled(event)));
        let driven = Self::with_levitation(constants, self.levitated);
        let mut start = vec![0.0; driven.layout.dimension()];
        let names: Vec<String> = (0..state.len()).map(|k| self.channel_name(k)).collect();
        for (channel, value) in start.iter_mut().enumerate() {
            let name = driven.channel_name(channel);
            if let Some(at) = names.iter().position(|own| *own == name) {
                *value = state[at];
            }
        }
        for (axis, command) in commands.iter().enumerate() {
            if let Some(at) = driven.command(axis) {
                start[at] = *command;
            }
        }
        Ok((driven, start))
    }

    /// The channel in which the command of a magnet axis is held; none where a controller gives it.
    pub fn command(&self, axis: usize) -> Option<usize> {
        let control = self.constants.magnets.as_ref()?.control()?;
        Some(self.layout.magnets.start + control.levitation.command(axis)?)
    }
    /// The first node of those at which forces come from outside, where so many were added last.
    pub fn first_pushed(&self, added: usize) -> usize {
        self.constants.loaded.len() - added
    }
    /// Puts what acts from outside into the mode, from a time on, s.
    pub fn act_from_outside(&self, mode: &mut Mode<f64>, time: f64, outside: Outside) {
        mode.driving += outside.torque - mode.outside.torque;
        mode.outside = outside;
        mode.base = self.base_at(time, outside.base);
    }
}

/// A machine on its way, on the widest vector unit there is.
pub trait Driver: Send {
    /// Time that is reached, s.
    fn time(&self) -> f64;
    /// The state there.
    fn state(&self) -> Vec<f64>;
    /// Why it stands still; none before it has paused.
    fn pause(&self) -> Option<&Pause>;
    /// How a run that is over ended; none before.
    fn ending(&self) -> Option<Ending>;
    /// Its steps until now.
    fn work(&self) -> Work;
    /// The machine as it is now.
    fn machine(&self) -> &RotorMachine;
    /// Goes on to a time, s, or to its end where that comes first; `observer` sees each step, and `interrupt` ends it.
    fn advance(
        &mut self,
        until: f64,
        observer: &mut dyn Observer<RotorMachine>,
        interrupt: &AtomicBool,
    );
    /// Changes mode and state.
    fn change(&mut self, change: &mut dyn FnMut(&mut Mode<f64>, &mut [f64]));
    /// What its further steps depend on.
    fn save(&mut self) -> Saved<'static, RotorMachine>;
    /// Goes back to what was saved.
    fn restore(&mut self, saved: &Saved<'static, RotorMachine>);
}

macro_rules! driver {
    ($method:ty) => {
        impl<R: Real> Driver for Stepper<'static, R, Machines<R>, $method> {
            fn time(&self) -> f64 {
                Stepper::time(self, 0)
            }
            fn state(&self) -> Vec<f64> {
                Stepper::state(self, 0)
            }
            fn pause(&self) -> Option<&Pause> {
                Stepper::pause(self, 0)
            }
            fn ending(&self) -> Option<Ending> {
                Stepper::ending(self, 0)
            }
            fn work(&self) -> Work {
                Stepper::work(self, 0)
            }
            fn machine(&self) -> &RotorMachine {
                Stepper::machine(self, 0)
            }
            fn advance(
                &mut self,
                until: f64,
                observer: &mut dyn Observer<RotorMachine>,
                interrupt: &AtomicBool,
            ) {
                self.go_on(0, until);
                let mut observers = [observer];
                while Stepper::pause(self, 0).is_none() {
                    Stepper::advance(self, &mut observers, interrupt);
                }
            }
            fn change(&mut self, change: &mut dyn FnMut(&mut Mode<f64>, &mut [f64])) {
                Stepper::change(self, 0, |mode, state| change(mode, state));
            }
            fn save(&mut self) -> Saved<'static, RotorMachine> {
                Stepper::save(self, 0)
            }
            fn restore(&mut self, saved: &Saved<'static, RotorMachine>) {
                Stepper::restore(self, 0, saved);
            }
        }
    };
}

driver!(Explicit);
driver!(Implicit<R, Room<R>>);

struct Begin<'a> {
    start: Start<'static, 'a, RotorMachine>,
    steps: Steps,
}

impl Task for Begin<'_> {
    type Output = Box<dyn Driver>;
    fn run<R: Real>(self) -> Box<dyn Driver> {
        let starts = [self.start];
        match self.steps.scheme() {
            Some(scheme) => Box::new(Stepper::<R, Machines<R>, Explicit>::explicit(
                scheme, &starts,
            )),
            None => Box::new(Stepper::<R, Machines<R>, Implicit<R, Room<R>>>::implicit(
                &starts,
            )),
        }
    }
}

/// A machine at its start, with the steps of its run.
pub fn driver(
    machine: Arc<RotorMachine>,
    state: &[f64],
    settings: Settings,
    steps: Steps,
) -> Box<dyn Driver> {
    let start = Start {
        machine: Held::Own(machine),
        state,
        observer: 0,
        settings,
        pause_at_events: false,
    };
    Level::detect().run_one(Begin { start, steps })
}
