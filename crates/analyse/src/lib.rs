//! Measurements read and laws evaluated without motion in time: one folder a system.

#![forbid(unsafe_code)]

pub mod identify;
pub(crate) mod interruptible;
pub mod mount;
pub mod rotor;
pub mod signals;
pub mod stiffness;
pub mod torque;
