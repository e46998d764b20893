//! Energies and angular momentum of a rig, what must close, and the energy seen from the outer race.
//!
//! At all times: works of the sources = change of (kinetic + potential) + heats. Angular momentum about the origin closes
//! twice:
//!
//! ```text
//!   rig             motor - belt - support - t_O + c_o × W + weights of balls
//!   balls and cage  t_I - t_O - t_g + weights + c_o × F_o
//! ```
//! The arm takes t_O as a pure couple. The temperatures count apart: C ΔT + C_f ΔΘ = heats of the bearing - ∫G T dt.

use super::layout::{FLYWHEEL, HEATS, SHAFT, bearing_impulse};
use super::rate::race_motion;
use super::{Mode, RigMachine};
use crate::bearing::BearingEnergy;
use crate::system::energy::{Balance, Content, Flows};
use crate::system::outer_race::OuterRaceEnergy;

impl RigMachine {
    /// Energies and angular momentum at a state.
    pub fn content(&self, state: &[f64]) -> Content {
        let c = &self.constants;
        let outer = race_motion(state).outer;
        let BearingEnergy {
            translation,
            spin,
            elastic,
            weight,
            angular_momentum,
        } = self.bearing_content(state);
        let (speed, flywheel) = (state[SHAFT.spin()], state[FLYWHEEL.spin()]);
        Content {
            translation: 0.5 * self.moving_mass * outer.velocity.length_squared() + translation,
            spin: 0.5 * c.shaft.inertia * speed * speed
                + 0.5 * c.flywheel.inertia * flywheel * flywheel
                + spin,
            potential: elastic + weight,
            angular_momentum: c.shaft.inertia * speed
                + c.flywheel.inertia * flywheel
                + self.moving_mass * outer.position.cross(outer.velocity)
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
        Flows::of(&state[self.layout.flows()], HEATS)
    }

    /// What must close between two states, of the whole rig.
    pub fn balance(&self, start: &[f64], end: &[f64]) -> Balance {
        Balance::between(start, end, |state| (self.content(state), self.flows(state)))
    }

    /// External angular impulse on balls and cage less the change of their angular momentum, N m s: zero but for errors.
    pub fn bearing_momentum_residual(&self, start: &[f64], end: &[f64]) -> f64 {
        let impulse = bearing_impulse(&self.layout);
        let held = |state: &[f64]| self.bearing_content(state).angular_momentum;
        (end[impulse] - start[impulse]) - (held(end) - held(start))
    }

    /// The energy that the bearing dissipated between two states, in four forms; see [`OuterRaceEnergy::between`].
    pub fn outer_race_energy(&self, start: &[f64], end: &[f64]) -> OuterRaceEnergy {
        OuterRaceEnergy::between(
            &self.layout,
            self.constants.bearing.set(),
            end[SHAFT.spin()],
            |state| self.bearing_content(state),
            [start, end],
        )
    }

    /// The rate of change of a state at an instant in a mode, for inspection: (rate, probes).
    pub fn inspect(&self, mode: &Mode, time: f64, state: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut rate = vec![0.0; self.layout.dimension()];
        let mut probe = vec![0.0; self.layout.probes()];
        self.rate_of_change(&self.bearing, mode, time, state, &mut rate, &mut probe);
        (rate, probe)
    }
}
