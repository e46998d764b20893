//! Levitation of a point rotor before it fails: a linear spring and damper that also carries its weight.
//!
//! ```text
//!   F = -k (C - C_0) - c Ċ - m g
//! ```
//! It acts at the geometric centre C; its work is a signed source (damping is electronic, no part gets warm). Magnets with their
//! controllers, and those whose currents decay, are [magnets](crate::magnets).
//!
//! Does not model: saturation, delay, sensor runout.

use number::{Real, Vec2, constants};

constants! {
    /// A point rotor held by a linear spring and damper.
    pub struct Levitation {
        /// Stiffness k, N/m.
        stiffness: R,
        /// Damping c, N s/m.
        damping: R,
        /// Held position C_0, m.
        centre: Vec2<R>,
        /// Carried force, opposite to the weight, N.
        carried: Vec2<R>,
    }
}

impl Levitation<f64> {
    /// Nothing holds the rotor.
    pub const NONE: Self = Levitation {
        stiffness: 0.0,
        damping: 0.0,
        centre: Vec2 { x: 0.0, y: 0.0 },
        carried: Vec2 { x: 0.0, y: 0.0 },
    };
}

impl<R: Real> Levitation<R> {
    /// Force on the rotor at its geometric centre, N.
    #[inline(always)]
    pub fn force(&self, centre: Vec2<R>, velocity: Vec2<R>) -> Vec2<R> {
        self.carried - (centre - self.centre) * self.stiffness - velocity * self.damping
    }
    /// Potential of spring and carried weight, J.
    #[inline(always)]
    pub fn energy(&self, centre: Vec2<R>) -> R {
        R::splat(0.5) * self.stiffness * (centre - self.centre).length_squared()
            - self.carried.dot(centre)
    }
}
