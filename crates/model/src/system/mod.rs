//! Systems: one readable page each.

pub mod drop;
