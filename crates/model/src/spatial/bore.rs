//! A cylinder in a bore, at a station of the bore's axis: rotor in inner ring, cage in a land, inner ring in a cage.
//!
//! ```text
//!   p_B = x_B + s a_B;   e = (p_A - p_B) across a_A,  ε = |e|,  n = e/ε,  d = ε - c0,  c = p_B + (R_0 + d/2) n
//!   N = (k dⁿ (1 + a ḋ))₊,  ḋ = n·(v_A(c) - v_B(c));  on A: -N n - μ tanh(|u|/u0) N u/|u|, u the slip across n; on B the opposite
//! ```
//! Two stations at the edges of a bore stand for the edge contact of a tilted cylinder.

use super::rigid_body::{RigidBody, SpatialWrench};
use crate::contact::JournalContact;
use number::{Mask, Real, Vec3};
use physics::contact::{hunt_crossley, hunt_crossley_energy, linear_contact};

/// What a cylinder and its bore do to each other at one station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StationReaction<R> {
    /// On the cylinder about its centre of mass.
    pub on_cylinder: SpatialWrench<R>,
    /// On the body with the bore.
    pub on_bore: SpatialWrench<R>,
    /// d, m; negative when open.
    pub penetration: R,
    /// ḋ, m/s.
    pub penetration_speed: R,
    /// Slip along the circumference, bore less cylinder, m/s.
    pub slip: R,
    /// N, N.
    pub normal_force: R,
    /// Rate of its elastic part, N/s.
    pub elastic_rate: R,
    /// |friction|, N.
    pub friction: R,
    /// Friction on the cylinder along the circumference, N.
    pub along: R,
    /// Heat of contact damping, W.
    pub damping_heat: R,
    /// Heat of sliding, W.
    pub friction_heat: R,
}

impl<R: Real> JournalContact<R> {
    /// A cylinder about an axis through a point `through` of its body, at a station of the bore's axis. `LINEAR` where the exponent
    /// is 1: it costs no power.
    #[inline(always)]
    pub fn at_station<const LINEAR: bool>(
        &self,
        cylinder: &RigidBody<R>,
        through: Vec3<R>,
        bore: &RigidBody<R>,
        station: R,
    ) -> StationReaction<R> {
        let zero = R::zero();
        let middle = bore.position + bore.axis * station;
        let e = (through - middle).across(cylinder.axis);
        let distance = e.length_squared().max(R::splat(1e-30)).sqrt();
        let n = e * distance.recip();
        let d = distance - self.radial_clearance;
        let mut reaction = StationReaction {
            on_cylinder: SpatialWrench::zero(),
            on_bore: SpatialWrench::zero(),
            penetration: d,
            penetration_speed: zero,
            slip: zero,
            normal_force: zero,
            elastic_rate: zero,
            friction: zero,
            along: zero,
            damping_heat: zero,
            friction_heat: zero,
        };
        let touching = d.greater(zero).any();
        if LINEAR && !touching {
            return reaction;
        }
        let c = middle + n * (self.bore_radius + R::splat(0.5) * d);
        let (arm_a, arm_b) = (c - cylinder.position, c - bore.position);
        let u = cylinder.velocity_at(arm_a) - bore.velocity_at(arm_b);
        let d_rate = n.dot(u);
        reaction.penetration_speed = d_rate;
        if !touching {
            return reaction;
        }
        let load = if LINEAR {
            linear_contact(self.stiffness, self.damping, d, d_rate)
        } else {
            hunt_crossley(self.stiffness, self.exponent, self.damping, d, d_rate)
        };
        let slip = u.across(n);
        let size = slip.length_squared().max(R::splat(1e-24)).sqrt();
        let friction = self.friction * (size * self.inverse_reference_speed).tanh() * load.force;
        let force = -(n * load.force) - slip * (friction / size);
        reaction.on_cylinder.add_at(force, arm_a);
        reaction.on_bore.add_at(-force, arm_b);
        reaction.slip = bore.axis.cross(n).dot(-u);
        reaction.normal_force = load.force;
        reaction.elastic_rate =
            self.exponent * load.elastic * d_rate / d.abs().max(R::splat(1e-30));
        reaction.friction = friction;
        reaction.along = reaction.slip * (friction / size);
        reaction.damping_heat = (load.force - load.elastic) * d_rate;
        reaction.friction_heat = friction * size;
        reaction
    }
    /// Energy of the contact at a penetration, J.
    pub fn energy_at(&self, penetration: R) -> R {
        hunt_crossley_energy(self.stiffness, self.exponent, penetration)
    }
}
