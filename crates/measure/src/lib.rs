//! From a lab's files to signals, and from signals to speed, acceleration and torque with honest uncertainty.
//!
//! | module | what it does |
//! |---|---|
//! | [`recording`] | channels of a file: names, units, clocks, and values read in pieces |
//! | [`file`] | the formats: from a file to a recording, and back |
//!
//! Nothing here knows a bearing or a rotor. SI inside where a quantity is computed; values of a file stay in the file's unit.

pub mod cage_speed;
pub mod converter;
pub mod file;
mod kernel;
pub mod order;
pub mod recording;
pub mod shaft;
mod simplex;
pub mod spectrum;
mod state_space;
pub mod steady_curve;
pub mod torque_sensor;
pub mod uncertain;
