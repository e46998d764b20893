//! From a lab's files to signals, and from signals to speed, acceleration and torque with honest uncertainty.
//!
//! | module | what it does |
//! |---|---|
//! | [`recording`] | channels of a file: names, units, clocks, and values read in pieces |
//! | [`mod@file`] | the formats: from a file to a recording, and back |
//! | [`pulse`] | pulse trains: edge times, numbering of the marks, calibration of the wheel |
//! | [`speed`] | from numbered pulses to angle, speed and acceleration with covariance |
//!
//! Nothing here knows a bearing or a rotor. SI inside where a quantity is computed; values of a file stay in the file's unit.

pub mod file;
pub mod pulse;
pub mod recording;
pub mod speed;
