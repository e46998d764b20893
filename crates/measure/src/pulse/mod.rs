//! Pulse trains of a pickup that looks at a wheel with marks: when did which mark pass?
//!
//! ```text
//! samples ──edges──▶ Edges (time, uncertainty) ──number──▶ Pulses (mark number) ──calibrate──▶ Pitch (errors of the wheel)
//! ```
//!
//! | step | what it does | what it says when it cannot |
//! |---|---|---|
//! | [`edges`] | levels, threshold and hysteresis from the signal itself, crossing times between samples | no two levels in the signal |
//! | [`number`] | counts marks: gaps are filled in the count as far as it is sure ([`Gap`]), doubled pulses are left out, each with a note | times that do not increase |
//! | [`calibrate`] | angular error of every mark, from revolutions whose speed changes evenly | fewer than two even revolutions |
//! | [`period`] | number of pulses after which the pattern of intervals repeats | no pattern above the noise |
//! | [`check_marks`] | compares it with the marks that were stated | they differ, or why nothing can be said |
//!
//! **What it does not model**: an error of the wheel that changes with time or speed (loose discs, a lateral vibration of
//! the shaft seen by one pickup); speed ripple locked to the revolution cannot be separated from mark errors and is taken for them.

mod edge;
mod envelope;
mod flank;
mod flip;
mod gap;
mod in_step;
mod level;
mod marks;
mod period;
mod pitch;
mod shape;
mod spike;
mod train;
mod undersampled;
mod wheel;

use problem::note::Note;
use std::fmt;

pub use edge::edges;
pub use gap::Gap;
pub use marks::{Marks, check_marks};
pub use period::period;
pub use pitch::{Pitch, calibrate};
pub use train::{Pulses, number};
pub use wheel::Wheel;

/// Which flank of a pulse marks the passage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flank {
    /// From low to high.
    Rising,
    /// From high to low.
    Falling,
    /// Both: twice as many marks; the wheel then has `2 * marks` positions, and its calibration finds the duty.
    Both,
    /// The middle between a rising flank and the falling one after it.
    Centre,
}

/// Passages of marks as a channel shows them.
#[derive(Clone, Debug, PartialEq)]
pub struct Edges {
    /// Instants, s, increasing.
    pub times: Vec<f64>,
    /// Standard uncertainty of each instant, s.
    pub uncertainties: Vec<f64>,
    /// Whether each is a rising one; distinguishes the two kinds where both flanks are used.
    pub rises: Vec<bool>,
    /// The flank in use.
    pub flank: Flank,
    /// First and last instant that the pickup was watched, s.
    pub watched: (f64, f64),
    /// Interval of the samples that the instants were found in, s; none where they were stamped.
    pub sample_interval: Option<f64>,
    /// Height of the first pulse at which the noise would have hidden it, as a part of that height, where the height grows with
    /// the speed; 0 where it does not.
    pub unseen: f64,
    /// Intervals within that in which there is no signal, s, in order.
    pub unwatched: Vec<(f64, f64)>,
    /// What was found wrong, and what was done about it.
    pub notes: Vec<Note>,
}

impl Edges {
    /// Edges whose times a counter has stamped, each with the same standard uncertainty, s.
    ///
    /// `watched` is the interval in which the counter ran, s; the interval from the first to the last stamp where it is
    /// not known. The uncertainty of a stamp that is cut to steps of a clock is the step divided by √12.
    pub fn stamped(
        times: Vec<f64>,
        uncertainty: f64,
        watched: Option<(f64, f64)>,
    ) -> Result<Edges, Refusal> {
        if !(uncertainty.is_finite() && uncertainty > 0.0) {
            return Err(Refusal::new(
                format!("the uncertainty of the time stamps is {uncertainty} s"),
                "a positive number: for a counter its step divided by √12",
            ));
        }
        let (Some(&first), Some(&last)) = (times.first(), times.last()) else {
            return Err(Refusal::new(
                "there are no time stamps".into(),
                "one for each mark that passed",
            ));
        };
        let watched = watched.unwrap_or((first, last));
        Ok(Edges {
            uncertainties: vec![uncertainty; times.len()],
            rises: vec![true; times.len()],
            times,
            flank: Flank::Rising,
            watched: (watched.0.min(first), watched.1.max(last)),
            sample_interval: None,
            unseen: 0.0,
            unwatched: Vec::new(),
            notes: Vec::new(),
        })
    }
}

/// Why a signal does not carry the answer that is asked of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// What was found.
    pub found: String,
    /// What would be needed.
    pub needed: String,
}

impl Refusal {
    pub(crate) fn new(found: String, needed: impl Into<String>) -> Refusal {
        Refusal {
            found,
            needed: needed.into(),
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.found)?;
        if !self.needed.is_empty() {
            write!(f, "; needed: {}", self.needed)?;
        }
        Ok(())
    }
}

impl std::error::Error for Refusal {}
