//! What measured signals say about a bearing.
//!
//! Speed, torque on the outer race and, where there is one, the speed of the cage go in; the steady friction moment, the
//! friction F of accelerated balls, the energy they dissipate, slip and skid come out, each with what is not known of it.
//!
//! | page | subject |
//! |---|---|
//! | [`measurement`] | one test, as its signals tell it |
//! | [`explain`] | which explanation of a torque transient the data support, and which test would decide |
//!
//! It knows no files and no scenario: arrays in SI in, values with deviations out.

pub mod explain;
pub mod measurement;

pub use measurement::{CageTrace, Measurement};
