//! The kinds of heat that an auxiliary bearing makes, in the order of their channels: those of its bearing, then its own.

use crate::bearing;

/// Kinds of heat of an auxiliary bearing besides those of its bearing.
pub const OWN_HEATS: [&str; 3] = ["mount_damping", "rotor_race_damping", "rotor_race_friction"];
/// Number of kinds of heat of an auxiliary bearing.
pub const HEATS: usize = bearing::HEATS.len() + OWN_HEATS.len();
