//! A spring and a damper in series, one branch of an elastomer.
//!
//! ```text
//!   outer race ──/\/\/── d ──[  ]── housing      F = -k (s - d),  ḋ = (s - d)/τ
//! ```
//! Source: derived; book/src/theory/drop.md, mounts. Dynamic stiffness of a sum of branches: K(jω) = Σ k jωτ/(1 + jωτ); passive for k, τ ≥ 0.

use super::DynamicStiffness;
use number::{Real, Vec2, constants};

constants! {
    /// One branch.
    pub struct MaxwellBranch {
        /// Stiffness k, N/m.
        stiffness: R,
        /// 1/τ, 1/s: inverse of the time in which it relaxes.
        rate: R,
    }
}

impl<R: Real> MaxwellBranch<R> {
    /// Force on the outer race, N; rate of d, m/s; heat, W.
    #[inline(always)]
    pub fn react(&self, s: Vec2<R>, d: Vec2<R>) -> (Vec2<R>, Vec2<R>, R) {
        let stretch = s - d;
        let rate = stretch * self.rate;
        let force = -(stretch * self.stiffness);
        (force, rate, -force.dot(rate))
    }
    /// Energy in the spring, J.
    #[inline(always)]
    pub fn energy(&self, s: Vec2<R>, d: Vec2<R>) -> R {
        R::splat(0.5) * self.stiffness * (s - d).length_squared()
    }
}

impl MaxwellBranch<f64> {
    /// Dynamic stiffness at a frequency ω (rad/s), N/m: k (x² + jx)/(1 + x²), x = ωτ.
    pub fn dynamic_stiffness(&self, frequency: f64) -> DynamicStiffness {
        let x = frequency / self.rate;
        let share = self.stiffness * x / (1.0 + x * x);
        DynamicStiffness {
            storage: share * x,
            loss: share,
        }
    }
}
