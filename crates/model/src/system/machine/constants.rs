//! Constants of a machine.

use crate::auxiliary_bearing::AuxiliaryBearingConstants;
use crate::levitation::Levitation;
use crate::rotor::Rotor;
use crate::schedule::Schedule;
use number::Vec2;

/// Constants of one machine.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineConstants {
    /// The rotor, or its share of one of several equal bearings.
    pub rotor: Rotor<f64>,
    /// Levitation, active before release only.
    pub levitation: Levitation<f64>,
    /// The auxiliary bearings, one at least.
    pub bearings: Vec<AuxiliaryBearingConstants>,
    /// Gravity, m/s².
    pub gravity: Vec2<f64>,
    /// Spin of the rotor at release, rad/s.
    pub speed: f64,
    /// Angle of the unbalance at release, rad.
    pub unbalance_angle: f64,
    /// What happens, and when.
    pub schedule: Schedule<Event>,
}

/// Something that happens at a known instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// The brake of the rotor comes on.
    Brake,
}

impl MachineConstants {
    /// Chooses where the springs of all mounts are free, so that each carries its bearing's weight.
    pub fn balance_mounts(&mut self) {
        for part in &mut self.bearings {
            part.balance_mount(self.gravity);
        }
    }
}
