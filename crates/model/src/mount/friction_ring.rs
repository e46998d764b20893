//! A tolerance ring: a spring that slips beyond a travel, with the memory of dry friction.
//!
//! ```text
//!   F = -k e,   ė = v - max(0, e·v) |e|^(m-2) e/e_y^m         |e| ≤ e_y: slip force k e_y
//! ```
//! Loading from rest follows e_y tanh(s/e_y) for m = 2; unloading is elastic; m → ∞ is the Jenkins element. Rate-independent.
//! Small m creeps under small vibration about a preload: m ≥ 8 unless measured.
//!
//! Source: derived; book/src/theory/drop.md, mounts. Trial stages of a step may leave |e| ≤ e_y: the larger of both stands for e_y there.

use super::DynamicStiffness;
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

impl FrictionRing<f64> {
    /// First harmonic of its force in a motion along a line of an amplitude A (m), over A: secant stiffness, and damping as loss.
    ///
    /// It does not depend on the frequency. Of the settled loop, by the ring's own equation.
    pub fn harmonic(&self, amplitude: f64) -> DynamicStiffness {
        const TURNS: usize = 4;
        let sharp = 20.0 * self.exponent * amplitude / self.travel;
        let steps = sharp.clamp(4000.0, 400_000.0) as usize;
        let step = std::f64::consts::TAU / steps as f64;
        // e and its rate over the angle of s = A sin θ
        let rate = |angle: f64, e: f64| {
            let motion = Vec2::new(amplitude * angle.cos(), 0.0);
            self.react(motion, Vec2::new(e, 0.0)).1.x
        };
        let (mut e, mut sums) = (0.0, [0.0; 2]);
        for k in 0..TURNS * steps {
            let angle = k as f64 * step;
            if k >= (TURNS - 1) * steps {
                sums[0] += e * angle.sin();
                sums[1] += e * angle.cos();
            }
            let first = rate(angle, e);
            let second = rate(angle + 0.5 * step, e + 0.5 * step * first);
            let third = rate(angle + 0.5 * step, e + 0.5 * step * second);
            let fourth = rate(angle + step, e + step * third);
            e += step / 6.0 * (first + 2.0 * (second + third) + fourth);
        }
        let [storage, loss] =
            sums.map(|sum| 2.0 * self.stiffness * sum / (steps as f64 * amplitude));
        DynamicStiffness { storage, loss }
    }
}
