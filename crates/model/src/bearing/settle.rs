//! Rest under a load: where the inner race and the balls stand before anything turns.
//!
//! ```text
//!   find x:  Σ K (i + x·n_j)^1.5 n_j = W      n_j azimuth of ball j, i interference, K both contacts in series
//! ```
//! The sum is the gradient of a convex energy, so Newton's method with a step that does not raise the residual arrives.
//! Each loaded ball then shares its approach between its contacts so that Q_i = Q_o; an unloaded one rests in the middle.
//!
//! Assumes: outer race at the origin, balls without weight; displacements small against the radii.
//! Does not model: friction that holds a bearing elsewhere.

use super::{BearingConstants, PlanarConstants};
use number::Vec2;

/// Newton steps; a dozen suffice from any start.
const STEPS: usize = 200;

/// Ball springs between the races: stiffness in series (N/m^1.5), interference (m), directions.
struct Springs {
    stiffness: f64,
    interference: f64,
    directions: Vec<Vec2<f64>>,
}

impl Springs {
    /// ΣQ n less the load, with the stiffness matrix (xx, xy, yy).
    fn residual(&self, shift: Vec2<f64>, load: Vec2<f64>) -> (Vec2<f64>, [f64; 3]) {
        let (mut left, mut matrix) = (-load, [0.0; 3]);
        for n in &self.directions {
            let root = (self.interference + shift.dot(*n)).max(0.0).sqrt();
            left += *n * (self.stiffness * root.powi(3));
            let slope = 1.5 * self.stiffness * root;
            matrix[0] += slope * n.x * n.x;
            matrix[1] += slope * n.x * n.y;
            matrix[2] += slope * n.y * n.y;
        }
        (left, matrix)
    }

    /// The shift of the inner race under a load.
    fn shift(&self, load: Vec2<f64>) -> Vec2<f64> {
        let size = load.length_squared().sqrt();
        if size == 0.0 {
            return Vec2::zero();
        }
        // start where one ball alone would carry the load twice over: every ball that will carry touches
        let reach = (2.0 * size / self.stiffness).powf(2.0 / 3.0) - self.interference.min(0.0);
        let mut shift = load * (2.0 * reach / size);
        let (mut left, mut matrix) = self.residual(shift, load);
        for _ in 0..STEPS {
            if left.length_squared().sqrt() <= 1e-13 * size {
                break;
            }
            // a single ball holds in one direction only
            let least = 1e-9 * (matrix[0] + matrix[2]);
            let [xx, xy, yy] = [matrix[0] + least, matrix[1], matrix[2] + least];
            let determinant = xx * yy - xy * xy;
            let step = Vec2::new(xy * left.y - yy * left.x, xy * left.x - xx * left.y)
                * (1.0 / determinant);
            let mut part = 1.0;
            let (next, last) = loop {
                let next = shift + step * part;
                let found = self.residual(next, load);
                if found.0.length_squared() < left.length_squared() || part < 1e-6 {
                    break (next, found);
                }
                part *= 0.5;
            };
            if last.0.length_squared() >= left.length_squared() {
                break; // rounding
            }
            shift = next;
            (left, matrix) = last;
        }
        shift
    }
}

impl BearingConstants {
    /// States of the bearing at rest under a radial load on its inner race; returns where the inner race stands, m.
    pub fn settle(&self, load: Vec2<f64>, state: &mut [f64]) -> Vec2<f64> {
        self.rest(state);
        let (stiffness, interference) = match self {
            BearingConstants::Rolling(b) => (b.ball.series_stiffness, b.ball.interference),
            BearingConstants::Planar(b) => {
                let soft = |k: f64| k.powf(-2.0 / 3.0);
                let series = soft(b.ball.inner_stiffness) + soft(b.ball.outer_stiffness);
                (series.powf(-1.5), b.interference())
            }
            // no rig has one
            BearingConstants::Spatial(_) => return Vec2::zero(),
        };
        let directions = (0..self.balls()).map(|j| {
            let (s, c) = self.azimuth(state, j).sin_cos();
            Vec2::new(c, s)
        });
        let springs = Springs {
            stiffness,
            interference,
            directions: directions.collect(),
        };
        let shift = springs.shift(load);
        if let BearingConstants::Planar(bearing) = self {
            for (j, n) in springs.directions.iter().enumerate() {
                let mut ball = bearing.motion(state, j);
                ball.radius = bearing.radius_between(shift.dot(*n));
                bearing.set_motion(state, j, &ball);
            }
        }
        shift
    }
}

impl PlanarConstants {
    /// Interference of a ball between concentric races, m; negative for clearance.
    pub fn interference(&self) -> f64 {
        let b = &self.ball;
        b.inner_track + 2.0 * b.radius - b.outer_track
    }
    /// Distance from the outer race's centre at which a ball rests when the inner race has come this much nearer, m.
    ///
    /// With interference the loads of both contacts are equal; with clearance the ball is in the middle of the gap.
    pub fn radius_between(&self, nearer: f64) -> f64 {
        let b = &self.ball;
        let approach = self.interference() + nearer;
        let inner_share = if approach > 0.0 {
            let softness = (b.inner_stiffness / b.outer_stiffness).powf(2.0 / 3.0);
            approach / (1.0 + softness)
        } else {
            0.5 * approach
        };
        b.inner_track + b.radius + nearer - inner_share
    }
    /// The distance from the centre at which a ball rests between concentric races.
    pub fn rest_radius(&self) -> f64 {
        self.radius_between(0.0)
    }
}
