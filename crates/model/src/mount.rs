//! Spring-damper mount of the outer race.
//!
//! ```text
//!   ground ──/\/\/──┬── outer race        F = -k (c_o - c_0) - c v_o
//!          ──[  ]───┘
//! ```
//! No states of its own. c_0 is chosen so that the weight of the bearing is balanced at c_o = 0.
//!
//! Assumes: isotropic, linear, massless. Does not model: end stops, dry friction, frequency dependence.

use number::{Real, Vec2, constants};

constants! {
    /// A spring with a damper between outer race and ground.
    pub struct Mount {
        /// Stiffness k, N/m.
        stiffness: R,
        /// Damping c, N s/m.
        damping: R,
        /// Position of the outer race at which the spring is free, m.
        free_position: Vec2<R>,
    }
}

impl<R: Real> Mount<R> {
    /// Force on the outer race, N.
    #[inline(always)]
    pub fn force(&self, position: Vec2<R>, velocity: Vec2<R>) -> Vec2<R> {
        -((position - self.free_position) * self.stiffness + velocity * self.damping)
    }
    /// Heat made per second, W.
    #[inline(always)]
    pub fn heat(&self, velocity: Vec2<R>) -> R {
        self.damping * velocity.length_squared()
    }
    /// Energy in the spring, J.
    #[inline(always)]
    pub fn energy(&self, position: Vec2<R>) -> R {
        R::splat(0.5) * self.stiffness * (position - self.free_position).length_squared()
    }
}
