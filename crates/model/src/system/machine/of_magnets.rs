//! What is seen of the magnets of a machine in a state: currents, power, limits.

use super::{Event, RotorMachine};
use crate::magnets::conditions::What;
use crate::magnets::{AxisConstants, ControlEvent, CurrentsOfAxes};
use ::levitation::OfAxes;
use smallvec::SmallVec;

impl RotorMachine {
    /// Whether controllers hold the rotor for a while.
    pub fn controlled(&self) -> bool {
        let magnets = self.constants.magnets.as_ref();
        magnets.is_some_and(|own| own.control().is_some())
    }
    /// The axes of all magnets.
    pub fn axes(&self) -> impl Iterator<Item = &AxisConstants> {
        let magnets = self.constants.magnets.iter().flat_map(|own| &own.magnets);
        magnets.flat_map(|magnet| &magnet.axes)
    }
    /// Control currents and coil currents of the axes of all magnets at an instant of a run, A; after the loss of power what is left of
    /// them.
    pub fn currents(&self, time: f64, state: &[f64]) -> CurrentsOfAxes {
        let motion = self.layout.rotor.motion(state);
        let states = &state[self.layout.magnets.clone()];
        let magnets = self.one.magnets.as_ref();
        magnets.map_or_else(CurrentsOfAxes::new, |own| {
            own.currents_in(time, &motion, states)
        })
    }
    /// Whether an axis of magnets with controllers has no power from the start on, and whether none has.
    pub fn starts_without_power(&self) -> [bool; 2] {
        let Some(control) = self
            .constants
            .magnets
            .as_ref()
            .and_then(|own| own.control())
        else {
            return [false; 2];
        };
        let axes = control.levitation.actuators().len();
        let lost = |event| match event {
            Event::Control(ControlEvent::Change(change)) => {
                let change = &control.changes[change];
                matches!(change.what, What::Lost { .. }).then_some(change.axes.len() == axes)
            }
            _ => None,
        };
        let mut all = self.constants.schedule.at_the_start().filter_map(lost);
        let any = all.clone().next().is_some();
        [any, all.any(|whole| whole)]
    }
    /// Whether any magnet with a controller has power, and whether all have.
    pub fn powered(&self, state: &[f64]) -> [bool; 2] {
        let states = &state[self.layout.magnets.clone()];
        (self.one.magnets.as_ref()).map_or([false; 2], |own| own.powered(states))
    }
    /// Largest current of a coil of each axis of magnets with controllers, A; infinite without limit.
    pub fn coil_limits(&self, state: &[f64]) -> OfAxes<f64> {
        let states = &state[self.layout.magnets.clone()];
        (self.one.magnets.as_ref()).map_or_else(OfAxes::new, |own| own.coil_limits(states))
    }
    /// While controllers act, of each axis: the voltage asked of its amplifier over the largest it has; empty where none is limited.
    pub fn voltage_shares(&self, time: f64, state: &[f64]) -> OfAxes<f64> {
        let motion = self.layout.rotor.motion(state);
        let states = &state[self.layout.magnets.clone()];
        let magnets = self.one.magnets.as_ref();
        magnets.map_or_else(OfAxes::new, |own| own.voltage_shares(time, &motion, states))
    }
    /// Of each sensor axis of magnets with controllers: displacement that it shows, m, and signal behind its filter, m.
    pub fn sensed(&self, time: f64, state: &[f64]) -> SmallVec<[(f64, f64); 8]> {
        let motion = self.layout.rotor.motion(state);
        let states = &state[self.layout.magnets.clone()];
        let magnets = self.one.magnets.as_ref();
        magnets.map_or_else(SmallVec::new, |own| own.sensed(time, &motion, states))
    }
    /// How far the rotor has come to a pole along each axis of the magnets, of the gap there.
    pub fn towards_poles(&self, state: &[f64]) -> OfAxes<f64> {
        let magnets = self.one.magnets.as_ref();
        magnets.map_or_else(OfAxes::new, |own| {
            own.towards_poles(&self.layout.rotor.motion(state))
        })
    }
}
