//! Laws evaluated without motion.

pub(crate) mod rotor;
pub mod torque;
