//! Measurements whose truth is known.

pub mod pulses;
pub mod rig;
pub mod wheel;
