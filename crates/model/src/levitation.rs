//! Levitation: the magnetic bearing before it fails, and magnets whose currents decay.
//!
//! ```text
//!   before    F = -k (C - C_0) - c Ċ - m g                       a point rotor: it is carried and held at C_0
//!   after     F = e² (F_0 + k_s C),  e = exp(-(t - t_f)/τ)        at a node of any rotor
//! ```
//! Both act at the geometric centre C; their work is a signed source (damping is electronic, no part gets warm). With the
//! current, k_i i_0 e, the bias of a magnet decays too, and with both what it pulls by: nothing is left of k_s. k_s > 0 pushes away.
//!
//! Does not model: saturation, delay, sensor runout; a magnet that is off at once is none.

use number::{Real, Vec2, constants};

/// A magnet whose currents decay, at a node of the rotor.
#[derive(Clone, Debug, PartialEq)]
pub struct FadingMagnet {
    /// Row φ of the node.
    pub node: Vec<f64>,
    /// Its force.
    pub fade: Fade<f64>,
}

constants! {
    /// What a magnet does while its currents decay.
    pub struct Fade {
        /// Force F_0 = k_i i_0 of the control current when it was cut, N.
        force: Vec2<R>,
        /// k_s at full bias, N/m.
        stiffness: R,
        /// 1/τ, 1/s.
        decay_rate: R,
        /// Instant t_f at which it was cut, s; not after the start.
        cut: R,
    }
}

impl<R: Real> Fade<R> {
    /// Force on the rotor at a time (s), N; `centre` is the geometric centre of its node.
    #[inline(always)]
    pub fn force(&self, time: R, centre: Vec2<R>) -> Vec2<R> {
        let left = (R::splat(-2.0) * self.decay_rate * (time - self.cut)).exp();
        (self.force + centre * self.stiffness) * left
    }
}

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
