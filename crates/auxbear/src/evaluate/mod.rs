//! Laws evaluated without motion.

pub mod torque;
