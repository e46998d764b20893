//! Where everything stands in the state of a drop.
//!
//! ```text
//!   0..6    rotor        x y (of G), ẋ ẏ, φ, ω
//!   6..12   inner race   x y, ẋ ẏ, φ_i, ω_i
//!   12..16  outer race   x y, ẋ ẏ
//!   16..    bearing      its own states
//!   then    ledger       heats, works of the sources, external angular impulse
//! ```

use super::DropConstants;
use crate::bearing;
use crate::system::layout::{self, Channels, heats_and};

/// First channel of the rotor.
pub const ROTOR: usize = 0;
/// First channel of the inner race.
pub const INNER: usize = 6;
/// First channel of the outer race.
pub const OUTER: usize = 12;
/// First channel of the bearing.
pub const BEARING: usize = 16;

/// Kinds of heat, in the order of their channels: those of the bearing, then the machine's own.
pub const HEATS: [&str; bearing::HEATS.len() + 3] =
    heats_and(["mount_damping", "rotor_race_damping", "rotor_race_friction"]);
/// Kinds of source, in the order of their channels.
pub const SOURCES: [&str; 4] = [
    "levitation",
    "rotor_torque",
    "inner_race_torque",
    "inner_race_growth",
];

/// Probe: penetration of the rotor/race contact, m.
pub const PENETRATION: usize = 0;
/// Probe: its rate, m/s.
pub const PENETRATION_SPEED: usize = 1;
/// Probe: normal force, N.
pub const NORMAL_FORCE: usize = 2;
/// Probe: its rate, N/s.
pub const NORMAL_FORCE_RATE: usize = 3;
/// Probe: friction force on the rotor along t, N.
pub const FRICTION_FORCE: usize = 4;
/// Probe: sliding speed, race less rotor, m/s.
pub const SLIP_SPEED: usize = 5;
/// Probe: largest ball load at the inner race, N.
pub const LARGEST_INNER_LOAD: usize = 6;
/// Probe: largest ball load at the outer race, N.
pub const LARGEST_OUTER_LOAD: usize = 7;
/// Probe: largest force between a ball and its pocket, or between two balls without a cage, N.
pub const LARGEST_POCKET_FORCE: usize = 8;
/// Probe: force between cage and land, N.
pub const LAND_FORCE: usize = 9;
/// First probe of the bearing's detail.
pub const DETAIL: usize = 10;

/// Gravity that scales speeds where there is less, m/s²: a rotor in a vertical machine still touches.
const LEAST_GRAVITY: f64 = 1.0;

/// Names of the channels before the bearing's.
const BODIES: [&str; BEARING] = [
    "rotor.x",
    "rotor.y",
    "rotor.x_speed",
    "rotor.y_speed",
    "rotor.angle",
    "rotor.speed",
    "bearing.inner_race.x",
    "bearing.inner_race.y",
    "bearing.inner_race.x_speed",
    "bearing.inner_race.y_speed",
    "bearing.inner_race.angle",
    "bearing.inner_race.speed",
    "bearing.outer_race.x",
    "bearing.outer_race.y",
    "bearing.outer_race.x_speed",
    "bearing.outer_race.y_speed",
];

/// What a drop has besides the states of its bearing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DropChannels;

impl Channels for DropChannels {
    const BODIES: &'static [&'static str] = &BODIES;
    const HEATS: &'static [&'static str] = &HEATS;
    const SOURCES: &'static [&'static str] = &SOURCES;
    const PROBES: usize = DETAIL;
}

/// Sizes of a drop's state.
pub type Layout = layout::Layout<DropChannels>;

impl Layout {
    /// Number of first probes watched in every step: balls that roll find the largest loads in the list of all.
    pub fn watched_probes(&self) -> usize {
        if self.ball_states {
            DETAIL
        } else {
            self.probes_with_loads()
        }
    }
    /// Number of first channels watched in every step: rotor, races, cage.
    pub fn watched_channels(&self) -> usize {
        (BEARING + 2).min(self.ledger())
    }

    /// The magnitude that matters in each channel: a tolerance of 1e-6 allows errors of one millionth of it a step.
    ///
    /// Lengths by the radial air clearance, speeds by the fall through the clearance, spins by the release speed,
    /// energies by the spin energy of the inner race brought to speed; the bearing's by [`error_scale`](bearing::BearingConstants::error_scale).
    pub fn error_scale(&self, constants: &DropConstants) -> Vec<f64> {
        let machine = &constants.machine;
        let clearance = machine.contact.radial_clearance;
        let gravity = machine.gravity.length_squared().sqrt().max(LEAST_GRAVITY);
        let fall_speed = (2.0 * gravity * clearance).sqrt();
        let spin = constants.speed.abs().max(10.0);
        let energy = 0.5 * machine.inner_race_inertia * spin * spin
            + 0.5 * machine.rotor.mass * fall_speed * fall_speed;
        let mut scale = vec![0.0; self.dimension()];
        for body in [ROTOR, INNER, OUTER] {
            scale[body..body + 2].fill(clearance);
            scale[body + 2..body + 4].fill(fall_speed);
            if body != OUTER {
                scale[body + 4] = 1.0;
                scale[body + 5] = spin;
            }
        }
        (constants.bearing).error_scale(&mut scale[self.bearing()], spin, fall_speed);
        scale[self.ledger()..self.angular_impulse()].fill(energy);
        scale[self.angular_impulse()] = machine.inner_race_inertia * spin;
        scale
    }
}
