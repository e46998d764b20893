//! Energies and angular momentum of a spin-up, what must close, and the energy seen from the outer race.
//!
//! At all times: works of the sources = change of (kinetic + potential) + heats, and
//! change of angular momentum about the origin = external angular impulse.
//!
//! The forms and their conditions stand in [`outer_race`](crate::system::outer_race). Where the inner race moves, the work
//! `other` carries its part; see [`layout`](super::layout).

use super::Drive;
use super::SpinUpMachine;
use super::layout::{HEATS, INNER, ROTOR};
use super::rate::race_motion;
use crate::bearing::BearingEnergy;
use crate::system::energy::{Balance, Content, Flows};
use crate::system::outer_race::OuterRaceEnergy;
use solve::Machine;

impl SpinUpMachine {
    /// Energies and angular momentum at a state.
    pub fn content(&self, state: &[f64]) -> Content {
        let race = &self.constants.race;
        let motion = race_motion(state);
        let inner = &motion.inner;
        let BearingEnergy {
            translation,
            spin,
            elastic,
            weight,
            angular_momentum,
        } = self.bearing_content(state);
        let rotor_inertia = match &self.constants.drive {
            Drive::SlidingRotor(rotor) if !rotor.spin_held => rotor.polar_inertia,
            _ => 0.0,
        };
        let rotor_spin = state[ROTOR.spin()];
        Content {
            translation: 0.5 * race.mass * inner.velocity.length_squared() + translation,
            spin: 0.5 * race.inertia * inner.spin * inner.spin
                + 0.5 * rotor_inertia * rotor_spin * rotor_spin
                + spin,
            potential: elastic + weight - race.mass * race.gravity.dot(inner.position),
            angular_momentum: race.mass * inner.position.cross(inner.velocity)
                + race.inertia * inner.spin
                + rotor_inertia * rotor_spin
                + angular_momentum,
        }
    }

    /// Energies and angular momentum of balls and cage alone.
    pub fn bearing_content(&self, state: &[f64]) -> BearingEnergy {
        let own = &state[self.layout.bearing()];
        self.constants.bearing.energy(&race_motion(state), own)
    }

    /// What the ledger channels of a state have summed up.
    pub fn flows(&self, state: &[f64]) -> Flows {
        Flows::of(&state[self.layout().flows()], HEATS)
    }
    /// What must close between two states.
    pub fn balance(&self, start: &[f64], end: &[f64]) -> Balance {
        Balance::between(start, end, |state| (self.content(state), self.flows(state)))
    }

    /// The energy that the bearing dissipated between two states, in four forms; see [`OuterRaceEnergy::between`].
    pub fn outer_race_energy(&self, start: &[f64], end: &[f64]) -> OuterRaceEnergy {
        OuterRaceEnergy::between(
            &self.layout,
            self.constants.bearing.set(),
            end[INNER.spin()],
            |state| self.bearing_content(state),
            [start, end],
        )
    }

    /// The rate of change of a state at an instant, for inspection: (rate, probes).
    pub fn inspect(&self, time: f64, state: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut rate = vec![0.0; self.dimension()];
        let mut probe = vec![0.0; self.probes()];
        let mode = self.constants.mode(time);
        self.rate(&mode, time, state, &mut rate, &mut probe);
        (rate, probe)
    }
}
