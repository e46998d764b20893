//! The mount of an outer ring with six freedoms.
//!
//! ```text
//!   F = -(k_s x_⊥ + k_z x_z) - (c_s v_⊥ + c_z v_z),   x from the place at which the springs are free
//!   M = k_t a × e_z + ½ k_φ (d1 × e_x + d2 × e_y) - c_t ω
//!   stores ½ k_s|x_⊥|² + ½ k_z x_z², k_t (1 - a·e_z), ½ k_φ (2 - d1·e_x - d2·e_y): exact at any rotation
//! ```
//! e_x, e_y, e_z: the bearing's frame.

use super::rigid_body::{RigidBody, SpatialWrench};
use number::{Real, Vec3, constants};

constants! {
    /// Springs and dampers of a mount in space.
    pub struct SpatialMount {
        /// Across the axis k_s, N/m.
        radial_stiffness: R,
        /// Along the axis k_z, N/m.
        axial_stiffness: R,
        /// Across the axis c_s, N s/m.
        radial_damping: R,
        /// Along the axis c_z, N s/m.
        axial_damping: R,
        /// Against tilt k_t, N m/rad.
        tilt_stiffness: R,
        /// Against turning of any direction c_t, N m s.
        turn_damping: R,
        /// Against torsion k_φ, N m/rad.
        torsion_stiffness: R,
        /// Place of the outer ring at which the springs are free, m.
        free_position: Vec3<R>,
    }
}

impl<R: Real> SpatialMount<R> {
    /// Of a vector along and across the axis.
    #[inline(always)]
    fn scaled(v: Vec3<R>, radial: R, axial: R) -> Vec3<R> {
        Vec3::new(v.x * radial, v.y * radial, v.z * axial)
    }
    #[inline(always)]
    fn damping_force(&self, ring: &RigidBody<R>) -> Vec3<R> {
        -Self::scaled(ring.velocity, self.radial_damping, self.axial_damping)
    }
    /// Wrench on the ring.
    #[inline(always)]
    pub fn wrench(&self, ring: &RigidBody<R>) -> SpatialWrench<R> {
        let (zero, half) = (R::zero(), R::splat(0.5));
        let x = ring.position - self.free_position;
        let springs = Self::scaled(x, self.radial_stiffness, self.axial_stiffness);
        let [d1, d2] = ring.transverse_axes();
        // a × e_z, d1 × e_x + d2 × e_y
        let tilt = Vec3::new(ring.axis.y, -ring.axis.x, zero);
        let torsion = Vec3::new(-d2.z, d1.z, d2.x - d1.y);
        SpatialWrench {
            force: self.damping_force(ring) - springs,
            moment: tilt * self.tilt_stiffness + torsion * (half * self.torsion_stiffness)
                - ring.spin * self.turn_damping,
        }
    }
    /// Heat of its dampers, W.
    #[inline(always)]
    pub fn heat(&self, ring: &RigidBody<R>) -> R {
        self.turn_damping * ring.spin.length_squared() - self.damping_force(ring).dot(ring.velocity)
    }
    /// Energy in its springs, J.
    pub fn energy(&self, ring: &RigidBody<R>) -> R {
        let (one, half) = (R::one(), R::splat(0.5));
        let x = ring.position - self.free_position;
        let springs = Self::scaled(x, self.radial_stiffness, self.axial_stiffness);
        let [d1, d2] = ring.transverse_axes();
        half * springs.dot(x)
            + self.tilt_stiffness * (one - ring.axis.z)
            + half * self.torsion_stiffness * (R::splat(2.0) - d1.x - d2.y)
    }
}
