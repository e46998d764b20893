//! What measurements hold: one folder a system.

pub mod identify;
pub mod signals;
