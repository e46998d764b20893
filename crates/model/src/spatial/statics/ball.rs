//! A ball at a fixed azimuth between the fixed outer ring and a displaced, tilted inner ring.
//!
//! ```text
//!   in the ball's radial plane (e_r, A), unknown ρ, z;  t_y = A × e_r for both contacts;  Q = K δ^1.5, l and n of physics::groove
//!   -Q_i n_i - Q_o n_o + f_i t_y × n_i + f_o t_y × n_o + m ρ ω_m² e_r = 0            along e_r and A
//!   r (f_i + f_o) = I ω_m w_r                                                        gyroscopic moment
//!   ρ ω_m + r_i (w_z n_r - w_r n_z) = Ω (ρ + r_i n_r) at n_i;  = 0 with r_o at n_o    rolling,  r_i, r_o = r - δ/2
//!   'outer' w·n_o = 0, f_i = 0;  'inner' (w - ΩA)·n_i = 0, f_o = 0;  'half' w·(n_o - n_i) = 0, f_i = f_o;
//!   'outer_half' speeds of 'outer', f_i = f_o
//!   on the ring at b + r_i n_i:  Q_i n_i - f_i t_y × n_i
//! ```
//! w the absolute spin of the ball, ω_m its orbit speed. A ball that has lost the inner race keeps Q_i = f_i = f_o = 0 and turns as with
//! n_i = -n_o.
//!
//! Source: A. B. Jones, J. Basic Eng. 82 (1960) 309; T. A. Harris, Rolling Bearing Analysis, 4th ed. 2001 (both from memory), on exact tori.
//! Valid: cage speed at medium load; neither skid nor spin heat: no control of a race is a law.

use super::linear::solve;
use crate::spatial::race::RaceGroove;
use number::{Dual, Real, Vec3};
use physics::groove::{InGroove, in_groove};

/// Hypothesis on the spin of a ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RaceControl {
    /// No spin at the outer race, which takes the gyroscopic moment.
    Outer,
    /// No spin at the inner race, which takes the gyroscopic moment.
    Inner,
    /// The spin stands across the line of both contacts, which share the gyroscopic moment.
    Half,
    /// Speeds of the outer race's control, the gyroscopic moment shared.
    OuterHalf,
}

/// A ball between its races.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticBall {
    /// Radius r, m.
    pub radius: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Groove of the inner ring.
    pub inner: RaceGroove<f64>,
    /// Groove of the outer ring.
    pub outer: RaceGroove<f64>,
}

/// Where and under what a ball is in equilibrium.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BallEquilibrium {
    /// Azimuth, rad.
    pub azimuth: f64,
    /// ρ and z, m.
    pub place: [f64; 2],
    /// Loads Q_i and Q_o, N.
    pub loads: [f64; 2],
    /// Contact angles in the ball's radial plane, positive where the row carries a +z load on the inner ring, rad.
    pub angles: [f64; 2],
    /// Gyroscopic forces f_i and f_o, N.
    pub gyroscopic: [f64; 2],
    /// Orbit speed ω_m, rad/s.
    pub orbit_speed: f64,
    /// Spin w_r and w_z, rad/s.
    pub spin: [f64; 2],
    /// Spin about the normals, (w - ΩA)·n_i and w·n_o, rad/s.
    pub contact_spin: [f64; 2],
    /// Approaches δ_i and δ_o, m.
    pub approaches: [f64; 2],
    /// Thrust on the ring along -A for each N of inner load: positive where the row carries a +z load.
    pub axial_share: f64,
}

/// Speeds of a bearing and what is assumed of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Running {
    /// Speed of the inner ring Ω, rad/s.
    pub speed: f64,
    /// The hypothesis.
    pub control: RaceControl,
}

/// A ball at its place: residuals and load on the ring, over `R`.
struct At<R> {
    residual: [R; 2],
    /// Force on the ring, and its moment about the ring's centre across the axis.
    load: [R; 5],
    found: BallEquilibrium,
}

/// States of a derivative: ρ, z, then the displacement of the ring.
const STATES: usize = 7;

/// Longest step of a ball in the iteration, m.
const LONGEST_STEP: f64 = 5e-6;

fn times<R: Real>(value: f64, other: R) -> R {
    R::splat(value) * other
}

/// a, b, c of a x + b y + c z = d, three times.
fn three<R: Real>(rows: [Vec3<R>; 3], side: [R; 3]) -> Vec3<R> {
    let [a, b, c] = rows;
    let (bc, ca, ab) = (b.cross(c), c.cross(a), a.cross(b));
    let sum = bc * side[0] + ca * side[1] + ab * side[2];
    sum * a.dot(bc).recip()
}

/// Axis of a ring that a rotation vector (τ_x, τ_y) tilts.
fn tilted<R: Real>(x: R, y: R) -> Vec3<R> {
    // sin t/t and cos t as series in t²: exact to rounding up to 0.2 rad, and smooth at 0
    let t = x.square() + y.square();
    let series = |terms: [f64; 5]| {
        let terms = terms.iter().rev();
        terms.fold(R::zero(), |sum, term| sum * t + R::splat(*term))
    };
    let sine = series([1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362_880.0]);
    let cosine = series([1.0, -0.5, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0]);
    Vec3::new(y * sine, -(x * sine), cosine)
}

impl StaticBall {
    /// Groove of a ring, the ball seen from it.
    fn touch<R: Real>(race: &RaceGroove<f64>, d: Vec3<R>, axis: Vec3<R>) -> (InGroove<R>, Vec3<R>) {
        let along = d.dot(axis);
        let p = d - axis * along;
        let distance = p.length_squared().sqrt();
        let at = in_groove(
            distance - R::splat(race.centre_radius),
            along - R::splat(race.place),
            R::splat(race.slack),
        );
        (at, p * (at.radial / distance) + axis * at.axial)
    }

    fn at<R: Real>(&self, azimuth: f64, place: [R; 2], ring: [R; 5], running: &Running) -> At<R> {
        let (sine, cosine) = azimuth.sin_cos();
        let (zero, one) = (R::zero(), R::one());
        let e_r = Vec3::new(R::splat(cosine), R::splat(sine), zero);
        let e_z = Vec3::new(zero, zero, one);
        let rolling = e_z.cross(e_r);
        let [rho, z] = place;
        let b = e_r * rho + e_z * z;
        let centre = Vec3::new(ring[0], ring[1], ring[2]);
        let (inner, n_inner) = Self::touch(&self.inner, b - centre, tilted(ring[3], ring[4]));
        let (outer, n_o) = Self::touch(&self.outer, b, e_z);
        let load = |race: &RaceGroove<f64>, approach: R| {
            let depth = approach.max(zero);
            times(race.stiffness, depth * depth.sqrt())
        };
        let lost = inner.approach.lane(0) <= 0.0;
        let n_i = if lost { -n_o } else { n_inner };
        let (q_i, q_o) = (
            load(&self.inner, inner.approach),
            load(&self.outer, outer.approach),
        );
        let arm = |approach: R| R::splat(self.radius) - times(0.5, approach);
        let (r_i, r_o) = (arm(inner.approach), arm(outer.approach));

        let plane = |n: Vec3<R>| [n.dot(e_r), n.z];
        let ([i_r, i_z], [o_r, o_z]) = (plane(n_i), plane(n_o));
        let speed = R::splat(running.speed);
        // unknown ω_m, w_r, w_z
        let (third, side) = match running.control {
            RaceControl::Outer | RaceControl::OuterHalf => (Vec3::new(zero, o_r, o_z), zero),
            RaceControl::Inner => (Vec3::new(zero, i_r, i_z), speed * i_z),
            RaceControl::Half => (Vec3::new(zero, o_r - i_r, o_z - i_z), zero),
        };
        let rows = [
            Vec3::new(rho, -(r_i * i_z), r_i * i_r),
            Vec3::new(rho, -(r_o * o_z), r_o * o_r),
            third,
        ];
        let w = three(rows, [speed * (rho + r_i * i_r), zero, side]);
        let (orbit, w_r, w_z) = (w.x, w.y, w.z);
        let inertia = 0.4 * self.mass * self.radius * self.radius;
        let both = times(inertia / self.radius, orbit * w_r);
        let (f_i, f_o) = match running.control {
            _ if lost => (zero, zero),
            RaceControl::Outer => (zero, both),
            RaceControl::Inner => (both, zero),
            RaceControl::Half | RaceControl::OuterHalf => (times(0.5, both), times(0.5, both)),
        };
        let across = |n: Vec3<R>| rolling.cross(n);
        let on_ring = n_i * q_i - across(n_i) * f_i;
        let centrifugal = e_r * times(self.mass, rho * orbit.square());
        let force = centrifugal - on_ring - n_o * q_o + across(n_o) * f_o;
        let moment = (b + n_i * r_i - centre).cross(on_ring);
        let value = |x: R| x.lane(0);
        let spin = |n: [R; 2], axial: R| value(w_r * n[0] + axial * n[1]);
        At {
            residual: [force.dot(e_r), force.z],
            load: [on_ring.x, on_ring.y, on_ring.z, moment.x, moment.y],
            found: BallEquilibrium {
                azimuth,
                place: [value(rho), value(z)],
                loads: [value(q_i), value(q_o)],
                angles: [
                    (-value(i_z)).atan2(-value(i_r)),
                    value(o_z).atan2(value(o_r)),
                ],
                gyroscopic: [value(f_i), value(f_o)],
                orbit_speed: value(orbit),
                spin: [value(w_r), value(w_z)],
                contact_spin: [spin([i_r, i_z], w_z - speed), spin([o_r, o_z], w_z)],
                approaches: [value(inner.approach), value(outer.approach)],
                axial_share: -value(n_i.z),
            },
        }
    }

    /// Centres of both grooves in the radial plane of an azimuth, inner and outer, (ρ, z).
    fn centres(&self, azimuth: f64, ring: [f64; 5]) -> [[f64; 2]; 2] {
        let axis = tilted(ring[3], ring[4]);
        let (sine, cosine) = azimuth.sin_cos();
        let (e_r, e_t) = (Vec3::new(cosine, sine, 0.0), Vec3::new(-sine, cosine, 0.0));
        let middle = Vec3::new(ring[0], ring[1], ring[2]) + axis * self.inner.place;
        let mut out = e_r;
        for _ in 0..10 {
            // the direction across the axis in which the circle meets the plane
            out = out.across(axis);
            out = out * out.length_squared().sqrt().recip();
            let beside = (middle + out * self.inner.centre_radius).dot(e_t);
            out -= e_t * (beside / self.inner.centre_radius);
        }
        let point = middle + out * self.inner.centre_radius;
        let outer = [self.outer.centre_radius, self.outer.place];
        [[point.dot(e_r), point.z], outer]
    }

    /// A place to start from: on the line of the groove centres, or in the outer groove alone.
    fn start(&self, azimuth: f64, ring: [f64; 5], running: &Running) -> [f64; 2] {
        let [inner, outer] = self.centres(azimuth, ring);
        let (x, y) = (inner[0] - outer[0], inner[1] - outer[1]);
        let apart = x.hypot(y);
        let slack = self.outer.slack + self.inner.slack;
        let share = 1.0 / (1.0 + (self.outer.stiffness / self.inner.stiffness).powf(2.0 / 3.0));
        if apart > slack {
            let out = self.outer.slack + share * (apart - slack);
            return [outer[0] + x / apart * out, outer[1] + y / apart * out];
        }
        let rho = outer[0] + self.outer.slack;
        let thrown = self.mass * rho * (0.5 * running.speed).powi(2);
        [
            rho + (thrown / self.outer.stiffness).powf(2.0 / 3.0),
            outer[1],
        ]
    }

    /// Equilibrium of the ball; from a place near it, or from one of its own. None where none is found.
    pub(super) fn settle(
        &self,
        azimuth: f64,
        ring: [f64; 5],
        running: &Running,
        near: Option<[f64; 2]>,
    ) -> Option<[f64; 2]> {
        let from = self.start(azimuth, ring, running);
        let starts = near.into_iter().chain([from]);
        starts
            .map(|start| self.newton(azimuth, ring, running, start))
            .find_map(|found| found)
    }

    fn newton(
        &self,
        azimuth: f64,
        ring: [f64; 5],
        running: &Running,
        start: [f64; 2],
    ) -> Option<[f64; 2]> {
        let fixed = ring.map(Dual::<2>::splat);
        let mut place = start;
        for _ in 0..200 {
            let moved = [0, 1].map(|k| Dual::variable(place[k], k));
            let [a, b] = self.at(azimuth, moved, fixed, running).residual;
            let step = solve([a.partial, b.partial], [-a.value, -b.value])?;
            let longest = step[0].abs().max(step[1].abs());
            let share = (LONGEST_STEP / longest).min(1.0);
            place = [place[0] + share * step[0], place[1] + share * step[1]];
            // a step below the rounding of ρ
            if longest < 4e-18 {
                return Some(place);
            }
            if longest < 1e-14 {
                let moved = [0, 1].map(|k| Dual::variable(place[k], k));
                let at = self.at(azimuth, moved, fixed, running);
                let scale = at.found.loads[1].max(1e-9);
                let left = at.residual.map(|r| r.value.abs());
                if left[0].max(left[1]) < 1e-9 * scale {
                    return Some(place);
                }
            }
        }
        None
    }

    /// Load on the ring and its derivative by the displacement, the ball following; and the ball's equilibrium.
    pub(super) fn on_ring(
        &self,
        azimuth: f64,
        ring: [f64; 5],
        running: &Running,
        place: [f64; 2],
    ) -> ([f64; 5], [[f64; 5]; 5], BallEquilibrium) {
        let at = self.at(
            azimuth,
            [0, 1].map(|k| Dual::<STATES>::variable(place[k], k)),
            std::array::from_fn(|k| Dual::variable(ring[k], 2 + k)),
            running,
        );
        let own = at.residual.map(|r| [r.partial[0], r.partial[1]]);
        let mut slope = [[0.0; 5]; 5];
        for k in 0..5 {
            let side = at.residual.map(|r| -r.partial[2 + k]);
            let follows = solve(own, side).unwrap_or_default();
            for (row, load) in slope.iter_mut().zip(&at.load) {
                let [a, b] = follows;
                row[k] = load.partial[2 + k] + load.partial[0] * a + load.partial[1] * b;
            }
        }
        (at.load.map(|load| load.value), slope, at.found)
    }
    /// Whether the ball can carry anything: at rest only where it is wider than its room.
    pub(super) fn is_held(&self, azimuth: f64, ring: [f64; 5], running: &Running) -> bool {
        let [inner, outer] = self.centres(azimuth, ring);
        let apart = (inner[0] - outer[0]).hypot(inner[1] - outer[1]);
        running.speed != 0.0 || apart > self.outer.slack + self.inner.slack
    }
}
