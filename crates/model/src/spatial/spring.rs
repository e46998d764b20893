//! A preload by a spring: the outer rings of one side slide along the axis, pressed by a spring against those that stand.
//!
//! ```text
//!   fixed outer ring ──/\/\/── outer ring that slides by s      c = σ s    σ sign of the thrust that its rows take on the inner ring
//!                    ──  |travel|                               F = (F0 + k c)₊ + N,   N = k_s d (1 + a ḋ)₊,   d = (c - travel)₊
//!   on the ring that slides -σ F, on the fixed one +σ F;  store F²/(2k) + ½ k_s d²,  heat (N - k_s d) ċ
//! ```
//! The set is mounted at c = 0 with the preload F0. k → ∞ is a preload by a distance, k → 0 a constant force. Under a thrust against the fixed
//! rows the bearing is stiff; against the spring it yields as the spring does, once the fixed rows are free.
//!
//! Source: derived; book/src/theory/spatial.md. Assumes: outer rings that keep their orientation; the ring that slides follows the other one
//! across the axis. Does not model: friction of its sliding fit, tilt of one outer ring against the other.

use super::ball::SpatialBall;
use super::race::RaceGroove;
use number::{Real, constants};

constants! {
    /// A spring between the outer rings of both sides.
    pub struct PreloadSpring {
        /// Sign σ of the thrust that the rows on it take on the inner ring.
        side: R,
        /// Force F0 as mounted, N.
        preload: R,
        /// k, N/m.
        stiffness: R,
        /// Compression from the mounted state until it is solid, m; infinite where it never is.
        travel: R,
        /// k_s of what is solid, N/m.
        stop_stiffness: R,
        /// Hunt-Crossley damping a there, s/m.
        stop_damping: R,
        /// Mass of the outer rings that slide, kg.
        mass: R,
    }
}

/// Force of a spring and what is lost in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringForce<R> {
    /// Along the axis on the ring that slides, N.
    pub on_ring: R,
    /// W.
    pub heat: R,
}

impl<R: Real> PreloadSpring<R> {
    /// Its force where the ring has slid by s, m, at a speed, m/s.
    #[inline(always)]
    pub fn act(&self, slid: R, speed: R) -> SpringForce<R> {
        let (zero, closing) = (R::zero(), self.side * speed);
        let (spring, stop) = self.elastic(slid);
        let damped = stop * (R::one() + self.stop_damping * closing).max(zero);
        SpringForce {
            on_ring: -(self.side * (spring + damped)),
            heat: (damped - stop) * closing,
        }
    }
    /// Forces of the spring and of what is solid, at rest, N.
    #[inline(always)]
    fn elastic(&self, slid: R) -> (R, R) {
        let (zero, compression) = (R::zero(), self.side * slid);
        let spring = (self.preload + self.stiffness * compression).max(zero);
        let depth = (compression - self.travel).max(zero);
        (spring, self.stop_stiffness * depth)
    }
    /// Its force at rest, N.
    pub fn force(&self, slid: R) -> R {
        let (spring, stop) = self.elastic(slid);
        spring + stop
    }
    /// Energy in it, J.
    pub fn energy(&self, slid: R) -> R {
        let (spring, stop) = self.elastic(slid);
        R::splat(0.5) * (spring.square() / self.stiffness + stop.square() / self.stop_stiffness)
    }
    /// Whether a row with these grooves presses on it.
    pub(super) fn carries<S: Real>(&self, [inner, outer]: [&RaceGroove<S>; 2]) -> bool {
        (inner.place - outer.place).lane(0) * self.side.lane(0) > 0.0
    }
}

impl PreloadSpring<f64> {
    /// Whether a row of such balls presses on it.
    pub fn presses(&self, ball: &SpatialBall<f64>) -> bool {
        self.carries([&ball.inner, &ball.outer])
    }
    /// Slope of its force over its compression, N/m.
    pub(super) fn rate(&self, slid: f64) -> f64 {
        let (spring, stop) = self.elastic(slid);
        f64::from(u8::from(spring > 0.0)) * self.stiffness
            + f64::from(u8::from(stop > 0.0)) * self.stop_stiffness
    }
    /// How far the ring has slid where it presses with a force at rest, m.
    pub(super) fn slid_by(&self, force: f64) -> f64 {
        let free = (force - self.preload) / self.stiffness;
        let solid = free.min(self.travel);
        let beyond = (free - solid) * self.stiffness / (self.stiffness + self.stop_stiffness);
        self.side * (solid + beyond)
    }
}
