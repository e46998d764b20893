//! The bearing of a simulation.

pub mod build;
pub(crate) mod columns;
pub(crate) mod film;
pub(crate) mod quantities;
pub(crate) mod run;
pub(crate) mod skid;
pub(crate) mod traction;
pub(crate) mod warnings;
