//! What happens at an instant of a record, and what is known there.

use super::matrix::{Matrix, Memory, Vector};
use super::plan::moving;

/// A mark that passes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight {
    pub angle: f64,
    /// Variance of the angle.
    pub variance: f64,
    /// Rough speed: angle per error of the instant.
    pub speed: f64,
}

impl Sight {
    /// A column of a matrix as the pulse sees it: of the angle, plus the speed times that of the clock.
    pub(super) fn seen(&self, matrix: &Matrix) -> Vector {
        std::array::from_fn(|i| matrix[i][0] + self.speed * matrix[i][4])
    }

    pub(super) fn of(&self, x: &Vector) -> f64 {
        x[0] + self.speed * x[4]
    }
}

/// Something that happens at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    /// Instant, in units of the track.
    pub time: f64,
    /// Density of the snap in the interval before it.
    pub density: f64,
    /// Where a mark passes.
    pub pulse: Option<Sight>,
    /// Variance added to each state, before the pulse.
    pub added: Option<[f64; 4]>,
    /// A motion that begins anew, before the pulse: what was before tells nothing of it.
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
