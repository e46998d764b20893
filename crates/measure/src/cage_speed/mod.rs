//! Speed of a cage and its slip against the shaft, from the passing of balls.
//!
//! ```text
//! phase of the signal = order · (ratio · shaft angle + δ),    cage speed = ratio · Ω + δ̇,    slip = −δ̇/(ratio · Ω)
//! ```
//!
//! Where the cage rolls, its angle is a plain ratio of the shaft angle; what is estimated is the deviation δ from it, whose
//! rate is an integrated random walk; the data choose its intensity. [`from_pulses`] takes the times at which balls pass a sensor,
//! [`from_vibration`] a signal that holds a line near ball pass.
//!
//! Source: smoothing of a phase is as for any oscillator with frequency noise; the line is followed by dynamic programming as by
//! Viterbi, IEEE Trans. Inf. Theory 13 (1967) 260 (from memory).
//!
//! Not modelled: a cage that turns backwards, ball spacing that changes with load.

mod cells;
mod path;
mod phase;
mod pulses;
mod ridge;

pub use pulses::from_pulses;
pub use ridge::{Line, from_vibration};

/// A quick change of the shaft's speed, in which the cage may slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuickChange {
    /// Time of its begin, s.
    pub engagement: f64,
    /// Time at which the shaft's acceleration ends at once, s; none where it does not, or is not known.
    pub lock: Option<f64>,
}

/// Speed of a cage over time. All lists have the same length.
#[derive(Clone, Debug, Default)]
pub struct CageSpeed {
    /// Times, s.
    pub time: Vec<f64>,
    /// Speed of the cage, rad/s.
    pub speed: Vec<f64>,
    /// Standard deviation of that speed, rad/s.
    pub deviation: Vec<f64>,
    /// Time after which two errors of that speed count as independent, s.
    pub correlation_time: Vec<f64>,
    /// Slip, 1: 0 where the cage rolls, 1 where it rests.
    pub slip: Vec<f64>,
    /// Standard deviation of the slip, 1.
    pub slip_deviation: Vec<f64>,
    /// Noise of one observation of the cage angle, rms, rad.
    pub noise: f64,
    /// What is not trustworthy.
    pub notes: Vec<problem::note::Note>,
}
