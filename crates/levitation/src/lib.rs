//! Magnets and their controllers: one list of states for the time run, and the linear analysis of the closed loop.
//!
//! ```text
//!            ┌──────────────── rotor, supports (Plant) ◄───────── force k_i i + k_s x at the magnet's node
//!            ▼                                                     ▲
//!   displacement at the sensor's node → sensor → reference - signal → controller → delay → amplifier → current i
//! ```
//! [`Levitation`] holds everything below the rotor and gives the rates of its states; [`LinearControl`] takes its matrices
//! from those rates, so that analysis and time run have the same. [`ClosedLoop`] couples them with a [`Plant`]: M q̈ + D q̇ + K q = F
//! at one speed, over complex coordinates w = x + jy where both directions are alike, else over real ones (x-plane, then y-plane).
//! [`suspension`] is the same as what holds a rotor in its own analyses over speed.
//!
//! k_s > 0 pushes away from the magnet's centre. Signs and frames are those of NOTATION.md.
//!
//! What it does not model: saturation and hysteresis of iron, eddy currents, coupling between the axes of a magnet, noise of sensors.

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

mod analysed;
mod checks;
mod closed_loop;
mod eigen;
mod held;
mod levitation;
mod linear_control;
mod parts;
mod plant;
mod refused;
mod resolvent;
pub mod response;
pub mod sensitivity;
mod state_space;
mod suspension;

pub use closed_loop::{ClosedLoop, Pole, Verdict, ZERO, verdict};
pub use levitation::{Inputs, Levitation, OfAxes, Signals};
pub use linear_control::LinearControl;
pub use parts::{Actuator, Axis, Commands, Condition, Control, Sensor};
pub use physics::magnet::{Amplifier, Timing};
pub use plant::{Coordinates, Plant, weight};
pub use refused::Refused;
pub use resolvent::{Resolvent, Transfer};
pub use state_space::StateSpace;
pub use suspension::suspension;

/// A complex number in double precision.
pub type C64 = nalgebra::Complex<f64>;
