//! From the channels of a measurement to speed, acceleration and torque with honest uncertainty.
//!
//! | module | what it does |
//! |---|---|
//! | [`pulse`] | pulse trains: edge times, numbering of the marks, calibration of the wheel |
//! | [`speed`] | from numbered pulses, or a speed that an instrument shows, to angle, speed and acceleration with covariance |
//! | [`converter`] | steps, clipping, drop-outs |
//! | [`shaft`] | angle and speed of the shaft as the estimators below take them |
//! | [`spectrum`] | spectra and spectrograms over time and over order |
//! | [`order`] | amplitude and phase of orders at any speed; the signal without them |
//! | [`torque_sensor`] | a sensor that swings: identified from a tap, its reading inverted, its frequency chosen |
//! | [`inertia`] | inertia of a rotor from simple tests |
//! | [`cage_speed`] | speed and slip of a cage from passing balls or vibration |
//!
//! Estimators return values with standard deviations and notes about what is not trustworthy; what they refuse they refuse with a
//! sentence. Nothing here knows a bearing or a rotor. SI inside where a quantity is computed; values of a file stay in the file's unit.

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

pub mod cage_speed;
pub mod converter;
pub mod inertia;
mod kernel;
pub mod order;
pub mod pulse;
pub mod shaft;
pub mod spectrum;
pub mod speed;
mod state_space;
pub mod torque_sensor;

use statistics::quantile;
