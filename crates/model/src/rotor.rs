//! Rigid rotor of one plane.
//!
//! ```text
//!        G  mass centre, the state        C = G - e (cos φ, sin φ)
//!        C  geometric centre: contact and levitation act here
//! ```
//! States: position of G (m), its speed (m/s), angle φ (rad), spin ω (rad/s).
//!
//! Assumes: rigid, one plane; identical planes share mass, polar inertia and torque equally.
//! Does not model: bending, tilt, axial motion.

use number::{Real, Vec2, constants};

constants! {
    /// A rigid rotor with an eccentric mass centre.
    pub struct Rotor {
        /// Mass, kg.
        mass: R,
        /// Polar moment of inertia about G, kg m².
        polar_inertia: R,
        /// Eccentricity e of the mass centre, m.
        eccentricity: R,
        /// Torque that brakes the spin once the brake is on, N m, never negative.
        brake_torque: R,
        /// True where a drive holds the spin whatever it takes.
        spin_held: bool,
    }
}

/// Motion of the rotor: its mass centre G.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorMotion<R> {
    /// Position of G, m.
    pub position: Vec2<R>,
    /// Speed of G, m/s.
    pub velocity: Vec2<R>,
    /// Angle φ, rad.
    pub angle: R,
    /// Spin ω, rad/s.
    pub spin: R,
}

/// The geometric centre C seen from G.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeometricCentre<R> {
    /// C - G, m.
    pub arm: Vec2<R>,
    /// Position of C, m.
    pub position: Vec2<R>,
    /// Speed of C, m/s.
    pub velocity: Vec2<R>,
}

/// Spin below which the brake fades out, rad/s: a brake stops, it does not reverse.
const BRAKE_FADE: f64 = 1.0;

impl<R: Real> Rotor<R> {
    /// Position and speed of the geometric centre.
    #[inline(always)]
    pub fn geometric_centre(&self, motion: &RotorMotion<R>) -> GeometricCentre<R> {
        let (s, c) = motion.angle.sin_cos();
        let arm = -(Vec2::new(c, s) * self.eccentricity);
        GeometricCentre {
            arm,
            position: motion.position + arm,
            velocity: motion.velocity + arm.turned() * motion.spin,
        }
    }
    /// Moment of the brake when it is on, N m.
    #[inline(always)]
    pub fn brake_moment(&self, spin: R) -> R {
        -(self.brake_torque * (spin * R::splat(1.0 / BRAKE_FADE)).tanh())
    }
    /// Kinetic energy: (translation, spin), J.
    #[inline(always)]
    pub fn kinetic_energy(&self, motion: &RotorMotion<R>) -> (R, R) {
        let half = R::splat(0.5);
        (
            half * self.mass * motion.velocity.length_squared(),
            half * self.polar_inertia * motion.spin.square(),
        )
    }
}
