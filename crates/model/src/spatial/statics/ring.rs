//! Equilibrium of the inner ring on rows of quasi-static balls, and its stiffness.
//!
//! ```text
//!   Σ F_j + F = 0 (x, y, z),  Σ M_j + M = 0 (about x, y)           by damped Newton steps from the loaded side
//!   K = -∂(ΣF, ΣM)/∂u, the balls following: exact derivatives
//! ```
//! From afar there is a mirrored solution, the ring pushed through the clearance: steps are short and start where the load closes
//! the contacts.

use super::ball::{BallEquilibrium, Running, StaticBall};
use super::linear::{Balance, Reaction};
use std::f64::consts::TAU;
use std::fmt;

/// Balls of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticRow {
    /// Number of balls.
    pub balls: usize,
    /// Azimuth of the first, rad.
    pub first_azimuth: f64,
    /// The ball.
    pub ball: StaticBall,
}

/// Rows on shared rings.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticRows(pub Vec<StaticRow>);

/// Load on the inner ring.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RingLoad {
    /// Force, N.
    pub force: [f64; 3],
    /// Moment about x and y, N m.
    pub moment: [f64; 2],
}

impl RingLoad {
    /// All five.
    pub fn to_array(self) -> [f64; 5] {
        let ([x, y, z], [a, b]) = (self.force, self.moment);
        [x, y, z, a, b]
    }
}

/// Displacement of the inner ring.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Displacement {
    /// m.
    pub shift: [f64; 3],
    /// Rotation vector across the axis, rad.
    pub tilt: [f64; 2],
}

impl Displacement {
    /// All five.
    pub fn to_array(self) -> [f64; 5] {
        let ([x, y, z], [a, b]) = (self.shift, self.tilt);
        [x, y, z, a, b]
    }
    pub(super) fn from_array([x, y, z, a, b]: [f64; 5]) -> Self {
        Displacement {
            shift: [x, y, z],
            tilt: [a, b],
        }
    }
}

/// Equilibrium of a ring.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// Displacement of the inner ring.
    pub displacement: Displacement,
    /// Balls of each row; one that carries nothing at rest has no loads.
    pub rows: Vec<Vec<BallEquilibrium>>,
    /// Stiffness, rows force and moment, columns shift and tilt: N/m, N/rad, N m/m, N m/rad.
    pub stiffness: [[f64; 5]; 5],
    /// What the balls do to the ring.
    pub reaction: [f64; 5],
}

/// Why there is no equilibrium.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoEquilibrium {
    /// A ball finds no place between its races.
    Ball,
    /// The loads are not balanced after many steps.
    Ring,
}

impl fmt::Display for NoEquilibrium {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NoEquilibrium::Ball => "a ball finds no equilibrium between its races",
            NoEquilibrium::Ring => "the inner ring finds no equilibrium",
        })
    }
}

impl std::error::Error for NoEquilibrium {}

/// Load on a ring, its slope, and what each ball does.
type Sum = Reaction<Vec<Vec<BallEquilibrium>>>;

impl StaticRows {
    /// Balls and stiffness at a given displacement.
    pub fn at(
        &self,
        displacement: Displacement,
        running: &Running,
    ) -> Result<Equilibrium, NoEquilibrium> {
        let at = self.sum(displacement.to_array(), running, None)?;
        Ok(self.equilibrium(displacement, at))
    }
    fn equilibrium(&self, displacement: Displacement, at: Sum) -> Equilibrium {
        Equilibrium {
            displacement,
            rows: at.found,
            stiffness: at.slope.map(|row| row.map(|slope| -slope)),
            reaction: at.load,
        }
    }

    /// Equilibrium under a load. At a speed it is approached from rest in steps, as far as needed.
    pub fn settle(&self, load: &RingLoad, running: &Running) -> Result<Equilibrium, NoEquilibrium> {
        let start = self.start(load);
        let direct = self.newton(start, load, running);
        if direct.is_ok() || running.speed == 0.0 {
            return direct;
        }
        let mut from = start;
        let mut last = direct;
        for step in 0..=16 {
            let slower = Running {
                speed: running.speed * f64::from(step) / 16.0,
                ..*running
            };
            last = Ok(self.newton(from, load, &slower)?);
            if let Ok(found) = &last {
                from = found.displacement.to_array();
            }
        }
        last
    }

    fn newton(
        &self,
        start: [f64; 5],
        load: &RingLoad,
        running: &Running,
    ) -> Result<Equilibrium, NoEquilibrium> {
        let row = &self.0[0];
        let balance = Balance {
            outside: load.to_array(),
            arm: row.ball.inner.centre_radius,
            stiffness: row.balls as f64 * row.ball.inner.stiffness * 1e-3,
        };
        let mut near: Option<Vec<Vec<BallEquilibrium>>> = None;
        let (u, at) = balance.find(start, |u| {
            let sum = self.sum(u, running, near.as_deref())?;
            near = Some(sum.found.clone());
            Ok(sum)
        })?;
        Ok(self.equilibrium(Displacement::from_array(u), at))
    }

    /// Where the load has just closed the contacts: the play taken up along each of its parts.
    fn start(&self, load: &RingLoad) -> [f64; 5] {
        let close = 1e-6;
        let mut start = [0.0; 5];
        let row = &self.0[0].ball;
        let slack = row.inner.slack + row.outer.slack;
        let radial = row.inner.centre_radius - row.outer.centre_radius;
        let play = (slack - radial).max(0.0);
        let side = load.force[0].hypot(load.force[1]);
        if side > 0.0 {
            let across = start.iter_mut().zip(load.force).take(2);
            across.for_each(|(own, force)| *own = force / side * (play + close));
        }
        let axial = (slack * slack - radial * radial).max(0.0).sqrt();
        let turned = |value: f64| if value == 0.0 { 0.0 } else { value.signum() };
        let loaded = turned(load.force[2]);
        if loaded != 0.0 {
            // of all rows the one that the load closes first
            let places = self.0.iter().map(|row| {
                let ball = row.ball;
                loaded * axial - (ball.inner.place - ball.outer.place)
            });
            let closest = places.min_by(|a, b| a.abs().total_cmp(&b.abs()));
            let first = closest.unwrap_or(0.0);
            if loaded * first > 0.0 {
                start[2] = first + loaded * close;
            }
        }
        if loaded == 0.0 && side == 0.0 {
            let arm = row.inner.centre_radius;
            for k in 0..2 {
                start[3 + k] = turned(load.moment[k]) * (axial + 5.0 * close) / arm;
            }
        }
        start
    }

    fn sum(
        &self,
        u: [f64; 5],
        running: &Running,
        near: Option<&[Vec<BallEquilibrium>]>,
    ) -> Result<Sum, NoEquilibrium> {
        let mut sum = Sum {
            load: [0.0; 5],
            slope: [[0.0; 5]; 5],
            largest: 0.0,
            found: Vec::new(),
        };
        for (index, row) in self.0.iter().enumerate() {
            let mut balls = Vec::new();
            for j in 0..row.balls {
                let azimuth = row.first_azimuth + TAU * j as f64 / row.balls as f64;
                let idle = BallEquilibrium {
                    azimuth,
                    ..BallEquilibrium::default()
                };
                if !row.ball.is_held(azimuth, u, running) {
                    balls.push(idle);
                    continue;
                }
                let before = near.map(|rows| rows[index][j]);
                let before = before
                    .filter(|ball| ball.loads[1] > 0.0)
                    .map(|ball| ball.place);
                let place = row.ball.settle(azimuth, u, running, before);
                let place = match place {
                    Some(place) => place,
                    // at rest a ball that only just touches may slip free
                    None if running.speed == 0.0 => {
                        balls.push(idle);
                        continue;
                    }
                    None => return Err(NoEquilibrium::Ball),
                };
                let (load, slope, found) = row.ball.on_ring(azimuth, u, running, place);
                for k in 0..5 {
                    sum.load[k] += load[k];
                    for (total, own) in sum.slope[k].iter_mut().zip(slope[k]) {
                        *total += own;
                    }
                }
                sum.largest = sum.largest.max(found.loads[1]);
                balls.push(found);
            }
            sum.found.push(balls);
        }
        Ok(sum)
    }
}
