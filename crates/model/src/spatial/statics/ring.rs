//! Equilibrium of the inner ring on rows of quasi-static balls, and its stiffness.
//!
//! ```text
//!   Σ F_j + F = 0 (x, y, z),  Σ M_j + M = 0 (about x, y)           by damped Newton steps from the loaded side
//!   K = -∂(ΣF, ΣM)/∂u, the balls following: exact derivatives
//!   outer rings that slide by s against a spring   T(u_z - s) = F(σ s),  T = -σ ΣF_z of their rows at the displacement from them;
//!     their derivatives A(u - s e_z) give ds/du = A_z/(A_zz - F′), and the rows yield by A - A e_z ds/du
//! ```
//! From afar there is a mirrored solution, the ring pushed through the clearance: steps are short and start where the load closes
//! the contacts.

use super::ball::{BallEquilibrium, Running, StaticBall};
use super::linear::{Balance, ROUNDING, Reaction};
use crate::spatial::spring::PreloadSpring;
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
pub struct StaticRows {
    /// The rows.
    pub rows: Vec<StaticRow>,
    /// What presses those of one side, where a spring does.
    pub spring: Option<PreloadSpring<f64>>,
}

impl From<Vec<StaticRow>> for StaticRows {
    /// Rows whose outer rings stand.
    fn from(rows: Vec<StaticRow>) -> Self {
        let spring = None;
        StaticRows { rows, spring }
    }
}

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
    /// How far outer rings have slid against a spring, m.
    pub slid: f64,
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

/// Load on a ring, its slope, what each ball does and how far outer rings have slid.
type Sum = Reaction<(Vec<Vec<BallEquilibrium>>, f64)>;

/// Steps of outer rings that slide: the longest, m, and one that rounding hides, m.
const SLIDES: [f64; 2] = [5e-6, 1e-17];
/// Share of the force of a spring to which its rows balance it.
const BALANCED: f64 = 1e-12;

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
        let (rows, slid) = at.found;
        Equilibrium {
            displacement,
            rows,
            slid,
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
        let row = &self.rows[0];
        let balance = Balance {
            outside: load.to_array(),
            arm: row.ball.inner.centre_radius,
            stiffness: row.balls as f64 * row.ball.inner.stiffness * 1e-3,
        };
        let mut near: Option<(Vec<Vec<BallEquilibrium>>, f64)> = None;
        let (u, at) = balance.find(start, |u| {
            let sum = self.sum(u, running, near.as_ref())?;
            near = Some(sum.found.clone());
            Ok(sum)
        })?;
        Ok(self.equilibrium(Displacement::from_array(u), at))
    }

    /// Where the load has just closed the contacts: the play taken up along each of its parts.
    fn start(&self, load: &RingLoad) -> [f64; 5] {
        let close = 1e-6;
        let mut start = [0.0; 5];
        let row = &self.rows[0].ball;
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
            let places = self.rows.iter().map(|row| {
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
        near: Option<&(Vec<Vec<BallEquilibrium>>, f64)>,
    ) -> Result<Sum, NoEquilibrium> {
        let (rows, slid) = match near {
            Some((rows, slid)) => (Some(&rows[..]), *slid),
            None => (None, 0.0),
        };
        let Some(spring) = &self.spring else {
            return self.side(u, running, rows, |_| true);
        };
        let slides = |row: &StaticRow| spring.carries([&row.ball.inner, &row.ball.outer]);
        let mut fixed = self.side(u, running, rows, |row| !slides(row))?;
        let (sliding, slid) = self.slide(spring, slid, |slid| {
            let beside = [u[0], u[1], u[2] - slid, u[3], u[4]];
            self.side(beside, running, rows, slides)
        })?;
        let along = sliding.slope[2];
        let yields = along[2] - spring.rate(slid);
        let follows = along.map(|own| if yields < 0.0 { own / yields } else { 0.0 });
        for k in 0..5 {
            fixed.load[k] += sliding.load[k];
            for (j, follows) in follows.iter().enumerate() {
                fixed.slope[k][j] += sliding.slope[k][j] - sliding.slope[k][2] * follows;
            }
        }
        fixed.largest = fixed.largest.max(sliding.largest);
        let both = fixed.found.0.iter_mut().zip(sliding.found.0);
        for (own, other) in both.filter(|(own, _)| own.is_empty()) {
            *own = other;
        }
        fixed.found.1 = slid;
        Ok(fixed)
    }

    /// Where outer rings slide to, from a place, m: their rows press as the spring does. Steps come from the side on which the rows are loaded,
    /// where their thrust is a convex function of the place.
    fn slide(
        &self,
        spring: &PreloadSpring<f64>,
        from: f64,
        rows: impl Fn(f64) -> Result<Sum, NoEquilibrium>,
    ) -> Result<(Sum, f64), NoEquilibrium> {
        let [longest, rounding] = SLIDES;
        let (mut slid, mut before) = (from, f64::INFINITY);
        for _ in 0..200 {
            let at = match rows(slid) {
                Ok(at) => at,
                // at a speed a ball that is hardly pressed finds no place
                Err(NoEquilibrium::Ball) => {
                    slid -= spring.side * longest;
                    continue;
                }
                Err(why) => return Err(why),
            };
            let force = spring.force(slid);
            let left = -spring.side * at.load[2] - force;
            let step = left / (spring.rate(slid) - at.slope[2][2]).max(1e-3);
            let share = left.abs() / force.max(at.largest);
            // near the balance, what no longer shrinks is rounding
            let rounded = share < ROUNDING && share > 0.5 * before;
            if share <= BALANCED || step.abs() < rounding || rounded {
                return Ok((at, slid));
            }
            before = share;
            slid += spring.side * step.max(-longest);
        }
        Err(NoEquilibrium::Ring)
    }

    /// Balls and slopes of the rows of one side, the outer rings standing; of the others none.
    fn side(
        &self,
        u: [f64; 5],
        running: &Running,
        near: Option<&[Vec<BallEquilibrium>]>,
        counts: impl Fn(&StaticRow) -> bool,
    ) -> Result<Sum, NoEquilibrium> {
        let mut sum = Sum {
            load: [0.0; 5],
            slope: [[0.0; 5]; 5],
            largest: 0.0,
            found: (Vec::new(), 0.0),
        };
        for (index, row) in self.rows.iter().enumerate() {
            let mut balls = Vec::new();
            if !counts(row) {
                sum.found.0.push(balls);
                continue;
            }
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
            sum.found.0.push(balls);
        }
        Ok(sum)
    }
}
