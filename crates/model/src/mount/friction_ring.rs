//! A tolerance ring: a spring that slips beyond a travel, with the memory of dry friction.
//!
//! ```text
//!   F = -k e,   ė = v - max(0, e·v) |e|^(m-2) e/e_y^m         |e| ≤ e_y: slip force k e_y
//! ```
//! Loading from rest follows e_y tanh(s/e_y) for m = 2; unloading is elastic; m → ∞ is the Jenkins element. Rate-independent.
//! Small m creeps under small vibration about a preload: m ≥ 8 unless measured.
//!
//! Source: derived; book/src/theory/drop.md, mounts. Trial stages of a step may leave |e| ≤ e_y: the larger of both stands for e_y there.

use number::{Real, Vec2, constants};

constants! {
    /// The ring.
    pub struct FrictionRing {
        /// Stiffness k before it slips, N/m.
        stiffness: R,
        /// Travel e_y at which it slips, m.
        travel: R,
        /// Exponent m ≥ 2.
        exponent: R,
    }
}

impl<R: Real> FrictionRing<R> {
    /// Force on the outer race, N; rate of e, m/s; heat, W.
    #[inline(always)]
    pub fn react(&self, v: Vec2<R>, e: Vec2<R>) -> (Vec2<R>, Vec2<R>, R) {
        let length = e.length_squared().sqrt();
        let bound = length.max(self.travel);
        let least = R::splat(1e-300);
        // |e|^(m-2)/e_y^m, without 0^0
        let share = (length / bound).max(least);
        let two = R::splat(2.0);
        let slip = e.dot(v).max(R::zero()) * share.powf(self.exponent - two) / bound.square();
        let rate = v - e * slip;
        let heat = self.stiffness * slip * length.square();
        (-(e * self.stiffness), rate, heat)
    }
    /// Energy in the spring, J.
    #[inline(always)]
    pub fn energy(&self, e: Vec2<R>) -> R {
        R::splat(0.5) * self.stiffness * e.length_squared()
    }
}
