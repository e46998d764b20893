//! The bearing of a simulation.

pub mod build;
pub(crate) mod columns;
pub mod contacts;
pub(crate) mod feedback;
pub(crate) mod film;
pub mod loss;
pub(crate) mod networks;
pub mod pressure;
pub(crate) mod quantities;
pub(crate) mod races;
pub(crate) mod run;
pub(crate) mod severity;
pub(crate) mod skid;
pub(crate) mod spatial;
pub mod steady;
pub(crate) mod traction;
pub(crate) mod warm;
pub mod warning_table;
pub mod warnings;

pub use races::LIFE_BY_POINT;
