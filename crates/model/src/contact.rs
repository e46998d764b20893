//! A journal in a bore: rotor in inner race, cage in the land of an outer race, inner race in a cage.
//!
//! ```text
//!   e = C - c,  n = e/|e|,  t = n turned +90°          C centre of the journal, c of the bore
//!   d = |e| - c0                                        penetration
//!   N = max(0, k dⁿ (1 + a ḋ))                            u = bore less journal surface speed along t
//!   on the journal, at C + arm·n:  -N n + μ tanh(u/u0) N t;  on the bore the opposite
//!   arms (mid-overlap): journal R0 - c0 - d/2,  bore R0 + d/2
//! ```
//! The moment on the journal is taken about its mass centre G. No states of its own.
//!
//! Assumes: one contact point, power-law normal force, Coulomb friction regularised by tanh.
//! Does not model: the conformal contact of journal and bore, wear, lubricant between the surfaces, heat fading of μ.

use crate::motion::{Body, Wrench};
use crate::rotor::GeometricCentre;
use number::{Mask, Real, Vec2, constants};
use physics::contact::{hunt_crossley, hunt_crossley_energy};

constants! {
    /// The pair of surfaces.
    pub struct JournalContact {
        /// Radial clearance c0, m.
        radial_clearance: R,
        /// Radius of the bore (of a race or its sleeve) R0, m.
        bore_radius: R,
        /// Stiffness k, N/mⁿ.
        stiffness: R,
        /// Exponent n.
        exponent: R,
        /// Hunt-Crossley damping a, s/m.
        damping: R,
        /// Friction coefficient μ.
        friction: R,
        /// 1/u0, s/m: inverse of the slip at which friction reaches 76 % of its value.
        inverse_reference_speed: R,
    }
}

/// What the contact does to both bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactReaction<R> {
    /// On the journal, the moment about G.
    pub on_journal: Wrench<R>,
    /// On the body with the bore, the moment about its centre.
    pub on_bore: Wrench<R>,
    /// Penetration d, m; negative when open.
    pub penetration: R,
    /// Rate of penetration ḋ, m/s.
    pub penetration_speed: R,
    /// Normal force N, N.
    pub normal_force: R,
    /// Its elastic part k dⁿ, N.
    pub elastic_force: R,
    /// Friction force on the journal along t, N.
    pub friction_force: R,
    /// Sliding speed, bore less journal, m/s.
    pub slip_speed: R,
    /// Heat of contact damping, W.
    pub damping_heat: R,
    /// Heat of sliding, W.
    pub friction_heat: R,
}

impl<R: Real> ContactReaction<R> {
    /// Nothing touches.
    #[inline(always)]
    pub fn none() -> Self {
        let zero = R::zero();
        ContactReaction {
            on_journal: Wrench::zero(),
            on_bore: Wrench::zero(),
            penetration: zero,
            penetration_speed: zero,
            normal_force: zero,
            elastic_force: zero,
            friction_force: zero,
            slip_speed: zero,
            damping_heat: zero,
            friction_heat: zero,
        }
    }
}

/// Stiffness and damping of the contact, for linearly implicit steps.
#[derive(Clone, Copy, Debug)]
pub struct ContactTangent<R> {
    /// n.
    pub normal: Vec2<R>,
    /// Arm of the journal's surface about C, m.
    pub journal_arm: R,
    /// Arm of the bore's surface, m.
    pub bore_arm: R,
    /// ∂N/∂d, N/m.
    pub stiffness: R,
    /// ∂N/∂ḋ, N s/m.
    pub damping: R,
    /// Slope of friction over slip, N s/m.
    pub friction: R,
}

impl<R: Real> JournalContact<R> {
    /// Reaction of the contact to the motion of both bodies.
    #[inline(always)]
    pub fn react(
        &self,
        journal: &GeometricCentre<R>,
        journal_spin: R,
        bore: &Body<R>,
    ) -> ContactReaction<R> {
        let half = R::splat(0.5);
        let e = journal.position - bore.position;
        // a centred journal has no direction; any will do, as nothing acts
        let distance = e.length_squared().max(R::splat(1e-30)).sqrt();
        let n = e * distance.recip();
        let t = n.turned();
        let relative = journal.velocity - bore.velocity;
        let d = distance - self.radial_clearance;
        let d_rate = relative.dot(n);
        let journal_arm = self.bore_radius - self.radial_clearance - half * d;
        let bore_arm = self.bore_radius + half * d;
        let slip = bore.spin * bore_arm - journal_spin * journal_arm - relative.dot(t);

        let zero = R::zero();
        let touching = d.greater(zero);
        let (mut normal, mut elastic) = (zero, zero);
        let (mut damping_heat, mut friction) = (zero, zero);
        if touching.any() {
            let force = hunt_crossley(self.stiffness, self.exponent, self.damping, d, d_rate);
            normal = force.force;
            elastic = force.elastic;
            damping_heat = (force.force - force.elastic) * d_rate;
            let coefficient = self.friction * (slip * self.inverse_reference_speed).tanh();
            friction = R::select(touching, coefficient * normal, zero);
        }
        let force = t * friction - n * normal;
        let arm = journal.arm + n * journal_arm;
        ContactReaction {
            on_journal: Wrench::planar(force, arm.cross(force)),
            on_bore: Wrench::planar(-force, -(bore_arm * friction)),
            penetration: d,
            penetration_speed: d_rate,
            normal_force: normal,
            elastic_force: elastic,
            friction_force: friction,
            slip_speed: slip,
            damping_heat,
            friction_heat: friction * slip,
        }
    }

    /// Tangents of the contact at this motion; nothing where the surfaces do not press.
    #[inline(always)]
    pub fn tangent(
        &self,
        reaction: &ContactReaction<R>,
        journal: &GeometricCentre<R>,
        bore: &Body<R>,
    ) -> ContactTangent<R> {
        let (zero, one, half) = (R::zero(), R::one(), R::splat(0.5));
        let d = reaction.penetration;
        let pressed = reaction.normal_force.greater(zero);
        let only = |value: R| R::select(pressed, value, zero);
        let n = (journal.position - bore.position) * (d + self.radial_clearance).recip();
        let damping = reaction.elastic_force * self.damping;
        let saturation = (reaction.slip_speed * self.inverse_reference_speed).tanh();
        ContactTangent {
            normal: n,
            journal_arm: self.bore_radius - self.radial_clearance - half * d,
            bore_arm: self.bore_radius + half * d,
            stiffness: only(self.exponent * reaction.normal_force / d.max(R::splat(1e-18))),
            damping: only(damping),
            friction: only(
                self.friction
                    * self.inverse_reference_speed
                    * (one - saturation.square())
                    * reaction.normal_force,
            ),
        }
    }

    /// Rate of the normal force, N/s, for given accelerations of the two centres.
    #[inline(always)]
    pub fn force_rate(
        &self,
        reaction: &ContactReaction<R>,
        journal: &GeometricCentre<R>,
        bore: &Body<R>,
        relative_acceleration: Vec2<R>,
    ) -> R {
        let zero = R::zero();
        let d = reaction.penetration;
        let touching = d.greater(zero);
        if !touching.any() {
            return zero;
        }
        let e = journal.position - bore.position;
        let distance = d + self.radial_clearance;
        let n = e * distance.recip();
        let relative = journal.velocity - bore.velocity;
        let d_rate = reaction.penetration_speed;
        let tangential = relative.cross(n);
        let d_acceleration = relative_acceleration.dot(n) + tangential.square() * distance.recip();
        let safe = d.max(R::splat(1e-18));
        let rate = reaction.elastic_force
            * (self.exponent * d_rate / safe * (R::one() + self.damping * d_rate)
                + self.damping * d_acceleration);
        R::select(reaction.normal_force.greater(zero), rate, zero)
    }

    /// Energy in the contact, J.
    #[inline(always)]
    pub fn energy(&self, reaction: &ContactReaction<R>) -> R {
        hunt_crossley_energy(self.stiffness, self.exponent, reaction.penetration)
    }
}
