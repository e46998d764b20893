//! Motion of the base: an earthquake, a shock, a vehicle.
//!
//! ```text
//!   b̈ = b̈_r(t) + Σ a sin(π (t - t_0)/T), t_0 ≤ t < t_0 + T        a record, straight between its points; half-sines
//!   g(t) = g - b̈     of every body alike: rotor, races, balls, cage, housing; what balances weights keeps g
//!   P = -Σ m b̈·v     a signed source, v relative to the base
//! ```
//! All coordinates are relative to the base, which carries magnets, sensors, seals, mounts and their stops. It translates in the
//! plane of the bearings. Its points and both ends of a half-sine are landed. Does not model: a base that rocks or turns.
//!
//! Source: derived; book/src/theory/drop.md, motion of the base.

use crate::table::{Piece, Table};
use number::{Gather, Real, Vec2, constants};

constants! {
    /// An acceleration of the base over half a period of a sine.
    pub struct HalfSine {
        /// Start t_0, s.
        start: R,
        /// Duration T, s.
        duration: R,
        /// Largest acceleration a, m/s².
        acceleration: Vec2<R>,
    }
}

impl<R: Real> HalfSine<R> {
    /// The acceleration of the base, m/s².
    #[inline(always)]
    fn at(&self, time: R) -> Vec2<R> {
        let share = ((time - self.start) / self.duration).max(R::zero());
        let (sine, _) = (share.min(R::one()) * R::splat(std::f64::consts::PI)).sin_cos();
        self.acceleration * sine
    }
}

/// How the base moves.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseConstants {
    /// Acceleration along x and along y over time, m/s² over s.
    pub record: [Table; 2],
    /// Half-sines besides.
    pub shocks: Vec<HalfSine<f64>>,
}

impl BaseConstants {
    /// Instants to land on, s.
    pub fn knots(&self) -> impl Iterator<Item = f64> + '_ {
        let points = self.record.iter().flat_map(Table::points);
        let shocks = self.shocks.iter();
        let ends = shocks.flat_map(|own| [own.start, own.start + own.duration]);
        points.map(|(time, _)| *time).chain(ends)
    }
    /// The record from an instant to the next point.
    pub(crate) fn pieces(&self, time: f64) -> [Piece<f64>; 2] {
        self.record.each_ref().map(|table| table.piece(time))
    }
    /// Acceleration at an instant, m/s².
    pub fn acceleration(&self, time: f64) -> Vec2<f64> {
        let [x, y] = self.record.each_ref().map(|table| table.value(time));
        let shocks = self.shocks.iter().map(|own| own.at(time));
        shocks.fold(Vec2::new(x, y), |sum, own| sum + own)
    }
}

/// The half-sines of a base over `R`; its record is in the mode.
#[derive(Clone, Debug)]
pub struct Base<R> {
    shocks: Vec<HalfSine<R>>,
}

impl<R: Real> Base<R> {
    /// One base per lane.
    pub fn gather<'a>(constants: &dyn Fn(usize) -> &'a BaseConstants) -> Self {
        let count = constants(0).shocks.len();
        let shock = |k: usize| Gather::<R>::gather(&|lane| &constants(lane).shocks[k]);
        Base {
            shocks: (0..count).map(shock).collect(),
        }
    }
    /// What it adds to gravity, -b̈, m/s².
    #[inline(always)]
    pub fn added(&self, [x, y]: &[Piece<R>; 2], time: R) -> Vec2<R> {
        let mut sum = Vec2::new(x.at(time), y.at(time));
        for shock in &self.shocks {
            sum += shock.at(time);
        }
        -sum
    }
}

/// Momentum Σ m v, kg m/s, and first moment Σ m r, kg m, of bodies.
#[derive(Clone, Copy, Debug)]
pub struct Masses<R> {
    /// Σ m v.
    pub momentum: Vec2<R>,
    /// Σ m r.
    pub moment: Vec2<R>,
}

impl<R: Real> Masses<R> {
    /// Of a body.
    #[inline(always)]
    pub fn of(mass: R, position: Vec2<R>, velocity: Vec2<R>) -> Self {
        Masses {
            momentum: velocity * mass,
            moment: position * mass,
        }
    }
    /// Of nothing.
    #[inline(always)]
    pub fn none() -> Self {
        Masses {
            momentum: Vec2::zero(),
            moment: Vec2::zero(),
        }
    }
    /// Of both together.
    #[inline(always)]
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Masses {
            momentum: self.momentum + other.momentum,
            moment: self.moment + other.moment,
        }
    }
}
