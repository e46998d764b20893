//! What happens at an instant of a record, and what is known there.

use super::transition::{Belief, Matrix, Memory, Observation, Vector};

/// A mark that passes: its angle, off by the rough speed times the error of the clock.
pub(super) fn mark(angle: f64, variance: f64, speed: f64) -> Observation {
    Observation {
        value: angle,
        variance,
        row: Vector::from([1.0, 0.0, 0.0, 0.0, speed]),
    }
}

/// Something that happens at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    /// Instant, in units of the track.
    pub time: f64,
    /// Density of the snap in the interval before it.
    pub density: f64,
    /// Where something is seen.
    pub pulse: Option<Observation>,
    /// Variance added to each state, before the pulse.
    pub added: Option<Vector>,
    /// A motion that begins anew, before the pulse: it does not follow from what was before.
    pub fresh: Option<Belief>,
}

/// Belief before a first passage in motion, or behind a silence: hardly anything.
pub(super) fn moving(angle: f64, speed: f64, pitch: f64, memory: &Memory) -> Belief {
    let speed = speed.max(1e-6 * pitch);
    let deviations = [pitch, 0.3 * speed, 0.1 * speed, 0.03 * speed, memory.spread];
    Belief {
        mean: Vector::from([angle, speed, 0.0, 0.0, 0.0]),
        covariance: Matrix::from_diagonal(&Vector::from(deviations.map(|d| d * d))),
    }
}
