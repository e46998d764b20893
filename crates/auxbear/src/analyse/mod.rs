//! What measurements hold: one folder a system.

pub mod identify;
pub(crate) mod interruptible;
pub mod signals;
