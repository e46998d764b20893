//! Systems: one readable page each.

pub mod drop;
pub mod sampling;
pub mod spin_up;
