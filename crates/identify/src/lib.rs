//! What measured signals say about a bearing.
//!
//! Speed, torque on the outer race and, where there is one, the speed of the cage go in; the steady friction moment, the
//! friction F of accelerated balls, the energy they dissipate, slip and skid come out, each with what is not known of it.
//!
//! | page | subject |
//! |---|---|
//! | [`measurement`] | one test: speed, acceleration, torque, cage |
//! | [`signals`] | one test put together from what its signals hold: rest, zero, correlation of errors |
//! | [`moment`] | the steady moment M(Ω) from slow tests: the forms that fit, their probabilities, one curve with its band |
//! | [`steady_curve`] | torque over speed from slow runs of which no bearing is known, by a sensor or by inertia |
//! | [`loss`] | the friction F of accelerated balls over time, and as a map over speed and acceleration |
//! | [`dissipation`] | the energy that a spin-up dissipates, with and without a cage signal |
//! | [`slip`] | slip of the cage and the time until it rolls |
//! | [`skid`] | spin of the balls, as far as the torque shows it |
//! | [`rotor_friction`] | sliding friction between rotor and race from the spin-up of a drop |
//! | [`data_checks`] | what must be said of the tests before their numbers are believed |
//! | [`explain`] | which explanation of a torque transient the data support, and which test would decide |
//!
//! It knows no files and no scenario: arrays in SI in, values with deviations out. What is refused is refused with a sentence.

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

mod algebra;
pub mod coasting;
pub mod data_checks;
pub mod dissipation;
mod evidence;
pub mod explain;
pub mod loss;
pub mod measurement;
pub mod moment;
mod regression;
pub mod rotor_friction;
mod series;
pub mod signals;
pub mod skid;
pub mod slip;
pub mod steady_curve;

pub use measurement::{CageTrace, Measurement, SetDeviation};
pub use moment::SteadyMoment;
