//! A hard stop around the outer race.
//!
//! ```text
//!   d = |s| - gap > 0:   F = -N s/|s|,   N = k d (1 + a ḋ)₊,   ḋ = v·s/|s|
//! ```
//! Source: derived; book/src/theory/drop.md, mounts.

use number::{Real, Vec2, constants};

constants! {
    /// The stop.
    pub struct HardStop {
        /// Stiffness k, N/m.
        stiffness: R,
        /// Gap, m.
        gap: R,
        /// Hunt-Crossley damping a, s/m.
        damping: R,
    }
}

impl<R: Real> HardStop<R> {
    /// Penetration d ≥ 0, and the direction outwards.
    #[inline(always)]
    fn penetration(&self, s: Vec2<R>) -> (R, Vec2<R>) {
        let length = s.length_squared().sqrt();
        let outwards = s * length.max(R::splat(1e-300)).recip();
        ((length - self.gap).max(R::zero()), outwards)
    }
    /// Force on the outer race, N; heat, W.
    #[inline(always)]
    pub fn react(&self, s: Vec2<R>, v: Vec2<R>) -> (Vec2<R>, R) {
        let (d, outwards) = self.penetration(s);
        let speed = outwards.dot(v);
        let elastic = self.stiffness * d;
        let normal = elastic * (R::one() + self.damping * speed).max(R::zero());
        (-(outwards * normal), (normal - elastic) * speed)
    }
    /// Energy in it, J.
    #[inline(always)]
    pub fn energy(&self, s: Vec2<R>) -> R {
        R::splat(0.5) * self.stiffness * self.penetration(s).0.square()
    }
}
