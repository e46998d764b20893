//! What measurements hold: one folder a system.

pub(crate) mod heed;
pub mod identify;
pub mod signals;
