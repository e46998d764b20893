//! What measurements hold: one folder a system.

mod heed;
pub mod identify;
pub mod signals;
