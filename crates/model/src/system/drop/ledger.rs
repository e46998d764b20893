//! Energies and angular momentum of a drop, and what must close.
//!
//! At all times: works of the sources = change of (kinetic + potential) + heats, and
//! change of angular momentum about the origin = external angular impulse.

use super::DropMachine;
use super::layout::HEATS;
use super::rate::{race_motion, rotor_motion};
use crate::system::energy::{Balance, Content, Flows};
use solve::Machine;

impl DropMachine {
    /// Energies and angular momentum at a state. The levitation is a source: it stores nothing.
    pub fn content(&self, state: &[f64]) -> Content {
        let m = &self.constants.machine;
        let rotor = rotor_motion(state);
        let races = race_motion(state);
        let (inner, outer) = (&races.inner, &races.outer);
        let centre = m.rotor.geometric_centre(&rotor);
        let contact = m.contact.react(&centre, rotor.spin, inner);
        let own = &state[self.layout().bearing()];
        let bearing = self.constants.bearing.energy(&races, own);
        let outer_mass = self.constants.outer_moving_mass();

        let (rotor_translation, rotor_spin) = m.rotor.kinetic_energy(&rotor);
        let half_square = |mass: f64, speed: number::Vec2<f64>| 0.5 * mass * speed.length_squared();
        let weight = |mass: f64, position: number::Vec2<f64>| -mass * m.gravity.dot(position);
        let inner_weight = if m.inner_race_centre_held {
            0.0
        } else {
            weight(m.inner_race_mass, inner.position)
        };
        let momentum = |mass: f64, position: number::Vec2<f64>, velocity: number::Vec2<f64>| {
            mass * position.cross(velocity)
        };
        Content {
            translation: rotor_translation
                + half_square(m.inner_race_mass, inner.velocity)
                + half_square(outer_mass, outer.velocity)
                + bearing.translation,
            spin: rotor_spin + 0.5 * m.inner_race_inertia * inner.spin * inner.spin + bearing.spin,
            potential: m.contact.energy(&contact)
                + m.mount.energy(outer.position)
                + weight(m.rotor.mass, rotor.position)
                + inner_weight
                + weight(outer_mass, outer.position)
                + bearing.elastic
                + bearing.weight,
            angular_momentum: momentum(m.rotor.mass, rotor.position, rotor.velocity)
                + m.rotor.polar_inertia * rotor.spin
                + momentum(m.inner_race_mass, inner.position, inner.velocity)
                + m.inner_race_inertia * inner.spin
                + momentum(outer_mass, outer.position, outer.velocity)
                + bearing.angular_momentum,
        }
    }

    /// What the ledger channels of a state have summed up.
    pub fn flows(&self, state: &[f64]) -> Flows {
        Flows::of(&state[self.layout().flows()], HEATS.len())
    }
    /// What must close between two states.
    pub fn balance(&self, start: &[f64], end: &[f64]) -> Balance {
        Balance::between(start, end, |state| (self.content(state), self.flows(state)))
    }

    /// The rate of change of a state, for inspection: (rate, probes).
    pub fn inspect(&self, state: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut rate = vec![0.0; self.dimension()];
        let mut probe = vec![0.0; self.probes()];
        self.rate(&self.start_mode(), 0.0, state, &mut rate, &mut probe);
        (rate, probe)
    }
}
