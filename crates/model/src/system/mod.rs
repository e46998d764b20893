//! Systems: one readable page each.

pub mod drop;
pub mod energy;
pub mod sampling;
pub mod spin_up;
