//! Energies and angular momentum of a rig, what must close, and the energy seen from the outer race.
//!
//! At all times: works of the sources = change of (kinetic + potential) + heats. Angular momentum about the origin closes,
//! with a housing twice:
//!
//! ```text
//!   rig             torques from the ground - t_O + c_i × (W d + S t + m g) or c_o × W d + weights of balls
//!   balls and cage  t_I - t_O - t_g + weights + c_i × F_i + c_o × F_o
//! ```
//! The arm takes t_O as a pure couple. The temperatures count apart: C ΔT + C_f ΔΘ = heats of the bearing - ∫G T dt.
//!
//! The forms of the energy and their conditions stand in [`outer_race`](crate::system::outer_race). Where a race moves, the work
//! `other` carries its part; see [`layout`](super::layout).

use super::drive::Drive;
use super::layout::DRIVE_HEAT;
use super::machine::RigMachine;
use super::mode::Mode;
use crate::bearing::BearingEnergy;
use crate::system::energy::{Balance, Content, Flows};
use crate::system::outer_race::OuterRaceEnergy;
use solve::Machine;

impl RigMachine {
    /// Energies and angular momentum at a state.
    pub fn content(&self, state: &[f64]) -> Content {
        let c = &self.constants;
        let (race, mass) = (&c.race, self.outer_mass());
        let motion = self.layout().motion(state);
        let (inner, outer) = (&motion.inner, &motion.outer);
        let BearingEnergy {
            translation,
            spin,
            elastic,
            weight,
            angular_momentum,
        } = self.bearing_content(state);
        let driver_inertia = c.drive.driver_inertia();
        let driver = state[self.layout().driver.spin()];
        Content {
            translation: 0.5 * race.mass * inner.velocity.length_squared()
                + 0.5 * mass * outer.velocity.length_squared()
                + translation,
            spin: 0.5 * race.inertia * inner.spin * inner.spin
                + 0.5 * driver_inertia * driver * driver
                + spin,
            potential: elastic + weight - race.mass * race.gravity.dot(inner.position),
            angular_momentum: race.mass * inner.position.cross(inner.velocity)
                + race.inertia * inner.spin
                + driver_inertia * driver
                + mass * outer.position.cross(outer.velocity)
                + angular_momentum,
        }
    }

    /// Energies and angular momentum of balls and cage alone.
    pub fn bearing_content(&self, state: &[f64]) -> BearingEnergy {
        let own = &state[self.layout().bearing()];
        self.constants
            .bearing
            .energy(&self.layout().motion(state), own)
    }

    /// What the ledger channels of a state have summed up.
    pub fn flows(&self, state: &[f64]) -> Flows {
        let layout = self.layout();
        Flows::of(&state[layout.flows()], layout.heats().len())
    }

    /// What must close between two states, of the whole rig.
    pub fn balance(&self, start: &[f64], end: &[f64]) -> Balance {
        Balance::between(start, end, |state| (self.content(state), self.flows(state)))
    }

    /// External angular impulse on balls and cage less the change of their angular momentum, N m s: zero but for errors. Of a
    /// rig with a housing.
    pub fn bearing_momentum_residual(&self, start: &[f64], end: &[f64]) -> f64 {
        let impulse = self.layout().bearing_impulse();
        let held = |state: &[f64]| self.bearing_content(state).angular_momentum;
        (end[impulse] - start[impulse]) - (held(end) - held(start))
    }

    /// Heats of the bearing that a state has summed up, J.
    pub fn bearing_heats(&self, state: &[f64]) -> f64 {
        let layout = self.layout();
        state[layout.heat(0)..layout.heat(DRIVE_HEAT)].iter().sum()
    }

    /// The energy that the bearing dissipated between two states, in four forms; see [`OuterRaceEnergy::between`].
    pub fn outer_race_energy(&self, start: &[f64], end: &[f64]) -> OuterRaceEnergy {
        OuterRaceEnergy::between(
            self.layout(),
            self.constants.bearing.set(),
            end[self.layout().race.spin()],
            |state| self.bearing_content(state),
            [start, end],
        )
    }

    /// The rate of change of a state at an instant in a mode, for inspection: (rate, probes).
    pub fn inspect(&self, mode: &Mode<f64>, time: f64, state: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut rate = vec![0.0; self.dimension()];
        let mut probe = vec![0.0; self.probes()];
        self.rate(mode, time, state, &mut rate, &mut probe);
        (rate, probe)
    }

    /// The same of a rig without a clutch, in the mode of that instant.
    pub fn inspect_at(&self, time: f64, state: &[f64]) -> (Vec<f64>, Vec<f64>) {
        self.inspect(&self.constants.mode(time), time, state)
    }

    /// The probes at the end of a run, in the mode that it has come to.
    pub fn last_probes(&self, mode: &Mode<f64>, time: f64, state: &[f64]) -> Vec<f64> {
        let (_, probe) = match self.constants.drive {
            Drive::Clutch(_) => self.inspect(mode, time, state),
            _ => self.inspect_at(time, state),
        };
        probe
    }
}
