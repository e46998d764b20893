//! What happens at an instant of a record, and what is known there.

use super::matrix::{Matrix, Memory, N, Vector};
use crate::state_space::{applied, dot};

/// What is seen of the motion at an instant: `value = row · state + noise`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight {
    pub value: f64,
    /// Variance of the noise.
    pub variance: f64,
    pub row: Vector,
}

impl Sight {
    /// A mark that passes: its angle, off by the rough speed times the error of the clock.
    pub(super) fn mark(angle: f64, variance: f64, speed: f64) -> Sight {
        Sight {
            value: angle,
            variance,
            row: [1.0, 0.0, 0.0, 0.0, speed],
        }
    }

    /// A covariance as it is seen: `p h`.
    pub(super) fn seen(&self, matrix: &Matrix) -> Vector {
        applied(matrix, &self.row)
    }

    pub(super) fn of(&self, x: &Vector) -> f64 {
        dot(&self.row, x)
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
    pub pulse: Option<Sight>,
    /// Variance added to each state, before the pulse.
    pub added: Option<[f64; N]>,
    /// A motion that begins anew, before the pulse: it does not follow from what was before.
    pub fresh: Option<Fresh>,
}

/// A motion of which nearly nothing is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fresh {
    pub angle: f64,
    /// Rough speed.
    pub speed: f64,
    /// Angle between marks.
    pub pitch: f64,
}

impl Fresh {
    pub(super) fn belief(&self, memory: &Memory) -> Belief {
        let mut belief = moving(self.angle, self.speed, self.pitch);
        belief.covariance[4][4] = memory.spread * memory.spread;
        belief
    }
}

/// Mean and covariance of a state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Belief {
    pub mean: Vector,
    pub covariance: Matrix,
}

/// Belief before a first passage in motion: hardly anything.
pub(super) fn moving(angle: f64, speed: f64, pitch: f64) -> Belief {
    let speed = speed.max(1e-6 * pitch);
    let mut covariance = [[0.0; N]; N];
    covariance[0][0] = pitch * pitch;
    covariance[1][1] = (0.3 * speed).powi(2);
    covariance[2][2] = (0.1 * speed).powi(2);
    covariance[3][3] = (0.03 * speed).powi(2);
    Belief {
        mean: [angle, speed, 0.0, 0.0, 0.0],
        covariance,
    }
}
