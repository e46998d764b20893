//! A shoulder of the rotor on the face of the inner ring.
//!
//! ```text
//!   nodes fixed on the ring's face, p = x_i + s_f a_i + r_f (cos φ_k d1 + sin φ_k d2);  shoulder plane through C + s_sh a_r
//!   d = -σ (C + s_sh a_r - p)·a_r,  c = p - ½ σ d a_r,  u = v_rotor(c) - v_ring(c),  ḋ = -σ u·a_r
//!   N = (k d (1 + a ḋ))₊ a node;  on the rotor at c: σ N a_r - μ tanh(|u_t|/u0) N u_t/|u_t|;  on the ring the opposite
//! ```
//! σ = +1: the shoulder stands above the face and pushes the ring along -a; -1: on the other side. Eight nodes and more give the
//! tilt stiffness and the friction torque μ N r_f of a ring of contact.

use super::rigid_body::{RigidBody, SpatialWrench};
use crate::bearing::ball_sums::{BallSums, largest_part};
use number::{Mask, Real, Vec3, constants};
use physics::contact::linear_contact;

constants! {
    /// A face of the inner ring, with the shoulder of the rotor that meets it.
    pub struct Face {
        /// σ: +1 where the shoulder stands above the face, -1 below.
        side: R,
        /// Place s_sh of the shoulder on the rotor's axis, m.
        shoulder: R,
        /// Place s_f of the face on the ring's axis, m.
        place: R,
        /// Mean radius r_f of the face, m.
        radius: R,
        /// Stiffness of the whole face k_f, N/m.
        stiffness: R,
        /// Damping a, s/m.
        damping: R,
        /// Friction coefficient.
        friction: R,
        /// 1/u0, s/m.
        inverse_reference_speed: R,
    }
}

/// What shoulder and face do to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceReaction<R> {
    /// On the rotor about its centre of mass.
    pub on_rotor: SpatialWrench<R>,
    /// On the inner ring.
    pub on_ring: SpatialWrench<R>,
    /// Sum of N, N.
    pub normal_force: R,
    /// Sum of |friction|, N.
    pub friction: R,
    /// Largest d, m.
    pub penetration: R,
    /// Heat of contact damping, W.
    pub damping_heat: R,
    /// Heat of sliding, W.
    pub friction_heat: R,
}

/// Directions of the nodes, cosines and sines.
#[derive(Clone, Debug)]
pub struct FaceNodes<R> {
    pub(super) cosines: Vec<R>,
    pub(super) sines: Vec<R>,
}

impl<R: Real> Face<R> {
    /// Reaction to the motion of rotor and ring; `centre` C is the rotor's geometric centre.
    #[inline(always)]
    pub fn react(
        &self,
        nodes: &FaceNodes<R>,
        rotor: &RigidBody<R>,
        centre: Vec3<R>,
        ring: &RigidBody<R>,
    ) -> FaceReaction<R> {
        let count = nodes.cosines.len();
        let [d1, d2] = ring.transverse_axes();
        let middle = ring.axis * self.place;
        let up = rotor.axis;
        // of the ring's centre, before the circle of the nodes is added
        let level = (ring.position + middle - centre).dot(up) - self.shoulder;
        let share = self.stiffness * R::splat(1.0 / count as f64);
        let slope = [d1.dot(up), d2.dot(up)];
        let (mut wrench, mut sums) = (BallSums::<R, 6>::new(count), BallSums::<R, 4>::new(count));
        let mut largest = <R::Group as Real>::splat(f64::NEG_INFINITY);
        let mut from = 0;
        while from < count {
            let cosine = R::load_group(&nodes.cosines, from) * self.radius.grouped();
            let sine = R::load_group(&nodes.sines, from) * self.radius.grouped();
            let side = self.side.grouped();
            let d =
                side * (level.grouped() + cosine * slope[0].grouped() + sine * slope[1].grouped());
            largest = largest.max(d);
            if d.greater(<R::Group as Real>::zero()).any() {
                let up = up.grouped();
                let arm = middle.grouped() + d1.grouped() * cosine + d2.grouped() * sine
                    - up * (side * d * <R::Group as Real>::splat(0.5));
                let to_rotor = arm + (ring.position - rotor.position).grouped();
                let u = rotor.velocity.grouped() + rotor.spin.grouped().cross(to_rotor)
                    - ring.velocity.grouped()
                    - ring.spin.grouped().cross(arm);
                let d_rate = -(side * u.dot(up));
                let load = linear_contact(share.grouped(), self.damping.grouped(), d, d_rate);
                let slip = u.across(up);
                let size = slip
                    .length_squared()
                    .max(<R::Group as Real>::splat(1e-24))
                    .sqrt();
                let rate = size * self.inverse_reference_speed.grouped();
                let friction = self.friction.grouped() * rate.tanh() * load.force;
                let force = up * (side * load.force) - slip * (friction / size);
                let moment = arm.cross(force);
                wrench.add(from, &SpatialWrench { force, moment }.to_array());
                let terms = [
                    load.force,
                    friction,
                    (load.force - load.elastic) * d_rate,
                    friction * size,
                ];
                sums.add(from, &terms);
            }
            from += R::GROUP;
        }
        let SpatialWrench { force, moment } = SpatialWrench::from_array(wrench.total());
        let [normal, friction, damping_heat, friction_heat] = sums.total();
        let to_rotor = (ring.position - rotor.position).cross(force);
        FaceReaction {
            on_rotor: SpatialWrench {
                force,
                moment: moment + to_rotor,
            },
            on_ring: SpatialWrench {
                force: -force,
                moment: -moment,
            },
            normal_force: normal,
            friction,
            penetration: largest_part::<R>(largest),
            damping_heat,
            friction_heat,
        }
    }
}
