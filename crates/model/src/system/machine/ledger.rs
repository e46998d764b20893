//! Energies and angular momentum of a machine, and what must close.
//!
//! At all times, with n times what a bearing of n equal rows stores, loses and puts in:
//! works of the sources = change of (kinetic + potential) + heats, and
//! change of angular momentum about the origin = external angular impulse. On a rig it closes for balls and cage alone as well,
//!
//! ```text
//!   t_I - t_O - t_g + weights + c_i × F_i + c_o × F_o
//! ```
//! and the temperatures count apart: C ΔT + C_f ΔΘ = heats of the bearing - ∫G T dt.

use super::{Mode, RotorMachine};
use crate::auxiliary_bearing::{HEATS, SOURCES};
use crate::bearing::BearingEnergy;
use crate::mount::MountReaction;
use crate::spatial::rigid_body::{BODY_STATES, RigidBody};
use crate::system::energy::{Balance, Content, Flows};
use number::Vec2;
use solve::Machine;

impl RotorMachine {
    /// Energies and angular momentum at a state: of the rotor about the origin, of each bearing about its datum, of all its
    /// rows. Levitation, magnets and seals are sources: they store nothing.
    pub fn content(&self, state: &[f64]) -> Content {
        let c = &self.constants;
        let motion = self.layout().rotor.motion(state);
        let rotor = self.one.rotor.content(&motion, c.gravity);
        let half_square = |mass: f64, speed: Vec2<f64>| 0.5 * mass * speed.length_squared();
        let weight = |mass: f64, position: Vec2<f64>| -mass * c.gravity.dot(position);
        let mut content = Content {
            translation: rotor.translation,
            spin: rotor.spin,
            potential: 0.0,
            angular_momentum: rotor.angular_momentum,
        };
        let parts = self.layout().bearings.iter().zip(&c.bearings);
        let [translation, potential] = self.one.axial_content(state);
        content.translation += translation;
        content.potential += potential;
        for (k, (at, part)) in parts.enumerate() {
            if part.spatial().is_some() {
                if k == 0 {
                    content.potential += rotor.weight + rotor.elastic;
                }
                self.add_in_space(k, state, &mut content);
                continue;
            }
            let races = at.motion(state);
            let (inner, outer) = (&races.inner, &races.outer);
            let (race, outer_mass) = (&part.inner_race, part.outer_moving_mass());
            let planes = part.planes;
            let centre = self.one.nodes[k].centre(&motion);
            let contact = part.contact.react(&centre, motion.spin, inner);
            let bearing = part.bearing.energy(&races, &state[at.own()]);
            content.translation += planes * half_square(race.mass, inner.velocity);
            content.translation += planes * half_square(outer_mass, outer.velocity);
            content.translation += planes * bearing.translation;
            content.spin += planes * 0.5 * race.inertia * inner.spin * inner.spin;
            content.spin += planes * bearing.spin;
            content.potential += planes * part.contact.energy(&contact);
            let mount = &self.one.bearings[k].mount;
            let [ground, _] = self.one.ground(k, &motion);
            let against = outer.position - ground;
            let [potential, kinetic] = mount.energy(against, &state[at.of_mount()]);
            content.potential += planes * (potential - mount.weight().dot(ground));
            content.translation += planes * kinetic;
            if k == 0 {
                content.potential += rotor.weight + rotor.elastic;
            }
            if !race.centre_held {
                content.potential += planes * weight(race.mass, inner.position);
            }
            // what moves with the housing of a rig is part of its load, whose work counts
            if part.fixture.is_none() {
                content.potential += planes * weight(outer_mass, outer.position);
            }
            content.potential += planes * bearing.elastic;
            content.potential += planes * bearing.weight;
            content.angular_momentum += planes * race.mass * inner.position.cross(inner.velocity);
            content.angular_momentum += planes * race.inertia * inner.spin;
            content.angular_momentum += planes * outer_mass * outer.position.cross(outer.velocity);
            content.angular_momentum += planes * bearing.angular_momentum;
        }
        content
    }

    /// Adds what a bearing in space stores, about its datum.
    fn add_in_space(&self, k: usize, state: &[f64], content: &mut Content) {
        let (at, part) = (&self.layout().bearings[k], &self.constants.bearings[k]);
        let (Some(own), Some(rotor)) = (part.spatial(), self.one.node_in_space(k, state)) else {
            return;
        };
        // the rotor's place in the assembly's own list is empty here
        let mut list = vec![0.0; BODY_STATES];
        list[6] = 1.0;
        let rings = [at.inner, at.outer].map(|ring| ring.channels().start);
        for first in rings {
            list.extend(&state[first..first + BODY_STATES]);
        }
        let inner = RigidBody::read(&list[BODY_STATES..]);
        list.extend(&state[at.own()]);
        let found = part.assembly().content(&list);
        let landed = own.landing.energy(&rotor, rotor.position, &inner);
        let mount = &self.one.bearings[k].mount;
        let outer = at.motion(state).outer;
        let [mounted, moving] = mount.energy(outer.position, &state[at.of_mount()]);
        content.translation += part.planes * (found.kinetic - found.turning + moving);
        content.spin += part.planes * found.turning;
        content.potential += part.planes * (found.potential + landed + mounted);
        content.angular_momentum += part.planes * found.angular_momentum.z;
    }

    /// What the ledger channels of a state have summed up, of all rows of each bearing.
    pub fn flows(&self, state: &[f64]) -> Flows {
        let channels = state[self.layout().flows()].iter().zip(self.ledger_rows());
        let channels: Vec<f64> = channels.map(|(value, rows)| rows * value).collect();
        Flows::of(&channels, self.layout().heats().len())
    }
    /// How many rows each channel of the ledger's flows stands for: those of its bearing.
    pub fn ledger_rows(&self) -> Vec<f64> {
        let layout = self.layout();
        let mut rows = vec![1.0; layout.flows().len()];
        for (at, part) in layout.bearings.iter().zip(&self.constants.bearings) {
            let source = layout.heats().len() + at.source;
            let own = (at.heat..at.heat + HEATS).chain(source..source + SOURCES.len());
            own.for_each(|channel| rows[channel] = part.planes);
        }
        rows
    }
    /// What must close between two states.
    pub fn balance(&self, start: &[f64], end: &[f64]) -> Balance {
        Balance::between(start, end, |state| (self.content(state), self.flows(state)))
    }

    /// Energies and angular momentum of balls and cage of a bearing alone.
    pub fn bearing_content(&self, bearing: usize, state: &[f64]) -> BearingEnergy {
        let at = &self.layout().bearings[bearing];
        let constants = &self.constants.bearings[bearing].bearing;
        constants.energy(&at.motion(state), &state[at.own()])
    }
    /// External angular impulse on balls and cage less the change of their angular momentum, N m s: zero but for errors. Of a
    /// rig with a housing.
    pub fn bearing_momentum_residual(&self, start: &[f64], end: &[f64]) -> f64 {
        // the second of the impulses
        let impulse = self.layout().angular_impulse() + 1;
        let held = |state: &[f64]| self.bearing_content(0, state).angular_momentum;
        (end[impulse] - start[impulse]) - (held(end) - held(start))
    }

    /// What the mount of a bearing does at a state, for inspection.
    pub fn mount(&self, bearing: usize, state: &[f64]) -> MountReaction<f64> {
        let at = &self.layout().bearings[bearing];
        let motion = at.motion(state);
        let mut rate = vec![0.0; self.dimension()];
        let ground = self.ground(bearing, state);
        self.one.bearings[bearing].mount(at, &motion, ground, state, &mut rate)
    }
    /// The rate of change of a state at the start, for inspection: (rate, probes).
    pub fn inspect(&self, state: &[f64]) -> (Vec<f64>, Vec<f64>) {
        self.inspect_in(&self.start_mode(), 0.0, state)
    }
    /// The same at an instant in a mode.
    pub fn inspect_in(&self, mode: &Mode<f64>, time: f64, state: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut rate = vec![0.0; self.dimension()];
        let mut probe = vec![0.0; self.probes()];
        self.rate(mode, time, state, &mut rate, &mut probe);
        (rate, probe)
    }
    /// The same on a rig without a clutch, in the mode of that instant.
    pub fn inspect_at(&self, time: f64, state: &[f64]) -> (Vec<f64>, Vec<f64>) {
        self.inspect_in(&self.mode_at(time), time, state)
    }
    /// The probes at the end of a rig's run, in the mode that it has come to.
    pub fn last_probes(&self, mode: &Mode<f64>, time: f64, state: &[f64]) -> Vec<f64> {
        let (_, probe) = match self.clutch() {
            Some(_) => self.inspect_in(mode, time, state),
            None => self.inspect_at(time, state),
        };
        probe
    }
}
