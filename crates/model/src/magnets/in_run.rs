//! What an observer sees of magnets, and what events do to them.

use super::conditions::{Change, What};
use super::{Axes, Axis, Control, ControlEvent, Magnets};
use crate::rotor::{RotorAt, RotorMotion};
use ::levitation::{Condition, Inputs, OfAxes, Signals};
use smallvec::{SmallVec, smallvec};
use std::ops::Range;

impl Magnets<f64> {
    /// Currents of the coils of all axes in a state, A, with the control current that they amount to; without power what is left of
    /// them.
    pub fn currents_in(
        &self,
        time: f64,
        rotor: &RotorMotion<f64>,
        states: &[f64],
    ) -> CurrentsOfAxes {
        let centres = self.centres(rotor);
        let mut rates: SmallVec<[f64; 64]> = smallvec![0.0; states.len()];
        let coils = self.coils(time, (rotor, &centres), states, &mut rates);
        let axes = self.list.iter().flat_map(|(_, axes)| axes);
        let current = |(axis, ([near, far], share)): (&Axis<f64>, &([f64; 2], f64))| {
            let [plus, minus] = axis.law.biases();
            let control = 0.5 * ((near - plus * share) - (far - minus * share));
            (control, [*near, *far])
        };
        axes.zip(&coils).map(current).collect()
    }

    /// Whether any magnet has power, and whether all have.
    pub fn powered(&self, states: &[f64]) -> [bool; 2] {
        let Some(control) = &self.control else {
            return [false; 2];
        };
        let of = &control.conditions;
        let mut on = (0..of.supplies()).map(|k| of.supply(k, states, 0.0).on);
        [on.clone().any(|on| on), on.all(|on| on)]
    }

    /// Largest current of a coil of each axis, A; infinite without limit.
    pub fn coil_limits(&self, states: &[f64]) -> OfAxes<f64> {
        let limits = |control: &Control<f64>| {
            let axes = control.levitation.actuators().iter().enumerate();
            let limit = |(axis, actuator)| match control.conditions.largest_current(axis) {
                Some(at) => states[at],
                None => Condition::<f64>::of(actuator).largest_current,
            };
            axes.map(limit).collect()
        };
        self.control.as_ref().map_or_else(OfAxes::new, limits)
    }

    /// Of each axis: the command behind limits, A or V, and the voltage that its amplifier is asked for, V, where it has one.
    pub fn commands(
        &self,
        time: f64,
        rotor: &RotorMotion<f64>,
        states: &[f64],
    ) -> SmallVec<[(f64, Option<f64>); 8]> {
        let of = |control| {
            let signals = self.signals(control, time, rotor, states);
            let axes = signals.commands.iter().enumerate();
            axes.map(|(axis, command)| (*command, control.levitation.voltage(axis, &signals)))
                .collect()
        };
        self.control.as_ref().map_or_else(SmallVec::new, of)
    }

    /// Of each sensor axis: what it shows of the rotor behind its faults, m, and its signal behind its filter, m.
    pub fn sensed(
        &self,
        time: f64,
        rotor: &RotorMotion<f64>,
        states: &[f64],
    ) -> SmallVec<[(f64, f64); 8]> {
        let of = |control: &Control<f64>| {
            let shown = Self::axes(control, time, rotor, states).shown;
            let own = &states[..control.levitation.states()];
            let signals = control.levitation.sensed(own, &shown);
            shown.iter().copied().zip(signals).collect()
        };
        self.control.as_ref().map_or_else(SmallVec::new, of)
    }

    /// Force of each magnet along each of its axes, N.
    pub fn forces(&self, time: f64, rotor: &RotorMotion<f64>, states: &[f64]) -> OfAxes<f64> {
        let mut rates: SmallVec<[f64; 64]> = smallvec![0.0; states.len()];
        let pulls = self.pull(time, rotor, states, &mut rates);
        let magnets = self.list.iter().zip(&pulls);
        magnets
            .flat_map(|((_, axes), pull)| axes.iter().map(|axis| axis.direction.dot(pull.force)))
            .collect()
    }

    /// With power, of each axis: the voltage asked of its amplifier over the largest it has; empty where no voltage is limited.
    pub fn voltage_shares(
        &self,
        time: f64,
        rotor: &RotorMotion<f64>,
        states: &[f64],
    ) -> OfAxes<f64> {
        let control = self.control.as_ref();
        let limited = control.filter(|own| own.levitation.limits_voltage());
        let Some(control) = limited.filter(|_| self.powered(states)[0]) else {
            return OfAxes::new();
        };
        control
            .levitation
            .voltage_shares(&self.signals(control, time, rotor, states))
    }

    /// Signals of an instant.
    fn signals(
        &self,
        control: &Control<f64>,
        time: f64,
        rotor: &RotorMotion<f64>,
        states: &[f64],
    ) -> Signals<f64> {
        let levitation = &control.levitation;
        let mut signals = levitation.signals();
        let now = Self::axes(control, time, rotor, states);
        levitation.read(
            &states[..levitation.states()],
            now.inputs(&[]),
            &mut signals,
        );
        signals
    }

    /// How far the rotor has come to a pole along each axis, of the gap there.
    pub fn towards_poles(&self, rotor: &RotorMotion<f64>) -> OfAxes<f64> {
        let centres = self.centres(rotor);
        let magnets = self.list.iter().zip(&centres);
        magnets
            .flat_map(|((_, axes), centre)| {
                let share =
                    |axis: &Axis<f64>| (axis.direction.dot(centre.position) / axis.law.gap()).abs();
                axes.iter().map(share)
            })
            .collect()
    }

    /// What happens to the states of the controllers at an instant; `magnets` are their channels.
    pub fn happen(
        &self,
        event: ControlEvent,
        time: f64,
        (at, magnets): (RotorAt, Range<usize>),
        state: &mut [f64],
    ) {
        let Some(control) = &self.control else {
            return;
        };
        let levitation = &control.levitation;
        let rotor = at.motion(state);
        let own = &state[magnets.clone()];
        let now = Self::axes(control, time, &rotor, own);
        let mut signals = self.signals(control, time, &rotor, own);
        let [powered, _] = self.powered(own);
        let own = &mut state[magnets];
        match event {
            ControlEvent::Sample if powered => {
                let states = &mut own[..levitation.states()];
                levitation.sample(states, now.inputs(&[]), &mut signals);
            }
            ControlEvent::Release if powered => levitation.release(&mut own[..levitation.states()]),
            ControlEvent::Sample | ControlEvent::Release => {}
            // a rotor that the magnets hold is not levitated again
            ControlEvent::Change(change)
                if powered && matches!(control.changes[change].what, What::Levitated { .. }) => {}
            ControlEvent::Change(change) => {
                control.change(&control.changes[change], time, (&now, &signals), own);
            }
        }
    }
}

/// Of each axis its control current and the currents of both coils, A.
pub type CurrentsOfAxes = SmallVec<[(f64, [f64; 2]); 8]>;

impl Control<f64> {
    /// A change at an instant.
    fn change(
        &self,
        change: &Change,
        time: f64,
        (now, signals): (&Axes<f64>, &Signals<f64>),
        own: &mut [f64],
    ) {
        let of = &self.conditions;
        for axis in &change.axes {
            let supply = now.supplies[of.supply_of(*axis)];
            let offset = self.levitation.sensors()[*axis].offset;
            match change.what {
                What::Lost { decay_rate } => {
                    let kept = of.kept[*axis].clone();
                    if supply.on && self.levitation.current_states(*axis).is_empty() {
                        own[kept.start] = signals.currents[*axis];
                    }
                    let fades = decay_rate.is_finite();
                    let left = match (fades, supply.on) {
                        (false, _) => 0.0,
                        (true, true) => 1.0,
                        (true, false) => supply.left,
                    };
                    own[kept].iter_mut().for_each(|current| *current *= left);
                    let (share, rate) = if fades {
                        (supply.share, decay_rate)
                    } else {
                        (0.0, 0.0)
                    };
                    of.switch(*axis, [0.0, 0.0, share, rate, time], own);
                }
                What::Levitated {
                    bias_rate,
                    reference_rate,
                } => {
                    let gradual = bias_rate.is_finite();
                    let channels = match gradual {
                        true => [1.0, 1.0, -1.0, bias_rate, time],
                        false => [1.0, 1.0, 0.0, 0.0, time],
                    };
                    of.switch(*axis, channels, own);
                    let sensor = &self.levitation.sensors()[*axis];
                    let away = now.shown[*axis] + sensor.offset - sensor.reference;
                    of.refer(*axis, away, reference_rate, own);
                }
                What::Frozen => of.freeze(*axis, signals.commands[*axis], own),
                What::Limited {
                    largest_current,
                    slew,
                } => of.limit(*axis, [largest_current, slew], own),
                sensed => of.sense(*axis, sensed, [now.shown[*axis], offset], own),
            }
        }
        if let What::Levitated { .. } = change.what {
            self.settle(now, time, own);
        }
    }

    /// Controllers that start on a rotor that is where it is.
    fn settle(&self, now: &Axes<f64>, time: f64, own: &mut [f64]) {
        let of = &self.conditions;
        let reference = |axis| {
            let supply = of.supply(of.supply_of(axis), own, time);
            of.reference(axis, own, &supply)
        };
        let references: OfAxes<f64> = (0..now.shown.len()).map(reference).collect();
        let inputs = Inputs {
            references: &references,
            ..now.inputs(&[])
        };
        let states = &mut own[..self.levitation.states()];
        // what does not settle is refused where a machine is built
        let _ = self.levitation.settle(states, inputs);
    }
}
