//! Constants of a machine.

use crate::auxiliary_bearing::AuxiliaryBearingConstants;
use crate::base::BaseConstants;
use crate::force::ForceConstants;
use crate::levitation::Levitation;
use crate::magnets::{ControlEvent, MagnetsConstants};
use crate::rotor::{AxialConstants, RotorConstants, Unbalance};
use crate::schedule::Schedule;
use crate::seal::SealConstants;
use crate::system::rig::refusal::{self, Refusal};
use number::Vec2;

/// Constants of one machine.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineConstants {
    /// The whole rotor; on a rig what drives the race.
    pub rotor: RotorConstants,
    /// How the rotor moves along its axis, where bearings in space carry it.
    pub axial: Option<AxialConstants<f64>>,
    /// Levitation of a point rotor, active before release only.
    pub levitation: Levitation<f64>,
    /// Magnets with their controllers, or with currents that decay after the release.
    pub magnets: Option<MagnetsConstants>,
    /// Seals, before and after the release.
    pub seals: Vec<SealConstants>,
    /// Forces from outside over time.
    pub forces: Vec<ForceConstants>,
    /// Rows of the nodes at which loads come on the way, [`MOST_LOADED`] at most.
    pub loaded: Vec<Vec<f64>>,
    /// How the base moves, where it does.
    pub base: Option<BaseConstants>,
    /// The auxiliary bearings, one at least.
    pub bearings: Vec<AuxiliaryBearingConstants>,
    /// Unbalances that come on the way, as where a blade is lost; [`MOST_UNBALANCES`] at most.
    pub unbalances: Vec<Unbalance>,
    /// Gravity, m/s².
    pub gravity: Vec2<f64>,
    /// Spin of the rotor at release, rad/s; on a rig the speed that counts as reached, of either sign.
    pub speed: f64,
    /// Angle of the unbalance at release, rad.
    pub unbalance_angle: f64,
    /// What happens, and when.
    pub schedule: Schedule<Event>,
    /// What happens where the rotor reaches a speed, each once; [`MOST_SPEEDS`] at most.
    pub at_speeds: Vec<AtSpeed>,
}

/// Most speeds at which something happens.
pub const MOST_SPEEDS: usize = 4;

/// Most unbalances that come on the way.
pub const MOST_UNBALANCES: usize = 16;

/// Most nodes at which loads come on the way.
pub const MOST_LOADED: usize = 4;

/// What happens where the rotor comes to a speed, from the side from which it is reached.
#[derive(Clone, Debug, PartialEq)]
pub struct AtSpeed {
    /// The size of the spin, rad/s.
    pub speed: f64,
    /// Whether it rises to it; else it falls to it.
    pub rising: bool,
    /// What happens, and how long after, s, rising.
    pub then: Vec<(f64, Event)>,
}

/// Share of a speed by which the rotor must have been beyond it to reach it.
const BEYOND: f64 = 1e-6;

/// A speed at which something happens, in a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached {
    /// Whether the rotor has been on the side from which it is reached.
    pub armed: bool,
    /// When the rotor reached it, s; infinite where it has not.
    pub at: f64,
    /// How much of what follows has happened.
    pub done: usize,
}

impl Reached {
    pub(super) const NEVER: Reached = Reached {
        armed: false,
        at: f64::INFINITY,
        done: 0,
    };
}

/// Something that happens at a known instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// The brake of the rotor acts with this share of its torque.
    Brake(f64),
    /// The drive of the rotor has so much more torque than at the start, N m.
    Drive(f64),
    /// A point of something over time, of a torque, a force, the base, or of load or drive of a rig: a step ends there.
    Knot,
    /// The unbalance of that place among those that come on the way is there.
    Unbalance(usize),
    /// The axial magnet holds with this share of its force.
    Thrust(f64),
    /// A load acts at that place among the loaded nodes, N, in the place of the one before.
    Load(usize, Vec2<f64>),
    /// Something happens to the controllers of the magnets.
    Control(ControlEvent),
}

impl AtSpeed {
    /// What a rotor with a size of spin lacks of it, rad/s.
    pub fn left(&self, spin: f64) -> f64 {
        match self.rising {
            true => self.speed - spin,
            false => spin - self.speed,
        }
    }
    /// What is left until a rotor reaches it, or until it is beyond it and may reach it, rad/s.
    pub(super) fn waits(&self, reached: &Reached, spin: f64) -> f64 {
        match reached.armed {
            true => self.left(spin),
            false => BEYOND * self.speed - self.left(spin),
        }
    }
}

impl MachineConstants {
    /// Why a machine cannot be computed.
    pub(super) fn fault(&self) -> Option<&'static str> {
        let on_rig = |part: &&AuxiliaryBearingConstants| part.fixture.is_some();
        let in_machine = self.bearings.iter().filter(|part| !on_rig(part));
        let rows = in_machine.map(|part| &part.node);
        let rows =
            rows.chain((self.bearings.iter()).filter_map(|part| part.mount_parts.on.as_ref()));
        let rows = rows.chain(self.magnets.iter().flat_map(MagnetsConstants::nodes));
        let rows = rows.chain(self.forces.iter().map(|force| &force.node));
        let rows = rows.chain(&self.loaded);
        let rows = rows.chain(self.unbalances.iter().map(|plane| &plane.node));
        let mut rows = rows.chain(self.seals.iter().map(|seal| &seal.node));
        let count = self.rotor.coordinates.len();
        let still = |row: &[f64]| row.iter().all(|shape| *shape == 0.0);
        if self.bearings.is_empty() {
            Some("a machine has a bearing")
        } else if self.bearings.len() > 1 && self.bearings.iter().any(|part| on_rig(&part)) {
            Some("a rig has one bearing")
        } else if self.base.is_some() && self.bearings.iter().any(|part| on_rig(&part)) {
            Some("the base of a rig stands still")
        } else if self.axial.is_none() != self.bearings.iter().all(|part| part.spatial().is_none())
        {
            Some("a rotor moves along its axis where bearings in space carry it")
        } else if rows.any(|row| row.len() != count || still(row)) {
            Some("a node has an entry for each coordinate, and moves with one of them")
        } else if self.at_speeds.len() > MOST_SPEEDS {
            Some("a machine waits for four speeds at most")
        } else if self.loaded.len() > MOST_LOADED {
            Some("loads come at four nodes at most")
        } else if self.unbalances.len() > MOST_UNBALANCES {
            Some("at most sixteen unbalances come on the way")
        } else {
            self.rotor.fault()
        }
    }
    /// Refuses the bearing of a rig that no law of it describes.
    pub fn check_on_rig(&self) -> Result<(), Refusal> {
        let mut rigs =
            (self.bearings.iter()).filter_map(|part| Some((part, part.fixture.as_ref()?)));
        rigs.try_for_each(|(part, rig)| {
            refusal::of_bearing(&part.bearing, &rig.drive, part.inner_race.inertia)
        })
    }
    /// Chooses where the springs of all mounts are free, so that each carries its bearing's weight.
    pub fn balance_mounts(&mut self) {
        for part in &mut self.bearings {
            part.balance_mount(self.gravity);
        }
    }
}
