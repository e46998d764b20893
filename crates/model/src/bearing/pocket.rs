//! A ball in a pocket of a cage that is free to move.
//!
//! ```text
//!   n_j = e(φ_c + seat): axis of the pocket, from the cage's centre c through the pocket;  t_j: n_j turned +90°
//!   w = b - c        ψ = w·t_j    how far the ball is off the pocket's middle, along the cage
//!                    ψ̇ = (v_b - v_c)·t_j - ω_c w·n_j
//!   s = sign ψ,  p = |ψ| - gap    P = max(0, k p (1 + a ṗ))
//!   the wall is met at b + s r t_j; there the ball slides along n_j at
//!                    u = (v_b - v_c)·n_j - s r (σ - ω_c) + ω_c ψ
//!   on the ball  -s P t_j - f n_j,  f = μ tanh(u/u0) P;  moment +s r f
//!   on the cage  the opposite;      moment about c  s P w·n_j - (ψ + s r) f
//! ```
//! The ball is free along n_j: a pocket is a bore or a barrel that stands radially.
//!
//! Assumes: flat pocket walls; the point of contact at the ball's undeformed surface.
//! Does not model: the curvature of the pocket, which holds a ball radially in crown cages; lubricant in the pocket.

use super::ball::{BallConstants, BallMotion, RaceMotion};
use super::ball_states::direction;
use number::{Mask, Real, Vec2};
use physics::contact::linear_contact;

/// What ball and pocket do to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PocketReaction<R> {
    /// Force on the ball, N; on the cage the opposite.
    pub on_ball: Vec2<R>,
    /// Moment on the ball, N m.
    pub ball_moment: R,
    /// Moment on the cage about its centre, N m.
    pub cage_moment: R,
    /// Normal force P, N.
    pub force: R,
    /// Penetration p, m; negative when free.
    pub penetration: R,
    /// Heat of contact damping, W.
    pub damping_heat: R,
    /// Heat of sliding, W.
    pub sliding_heat: R,
}

impl<R: Real> BallConstants<R> {
    /// Reaction of a ball and its pocket, whose axis is the unit vector `axis`, of a cage that moves.
    #[inline(always)]
    pub fn in_pocket(
        &self,
        cage: &RaceMotion<R>,
        axis: Vec2<R>,
        ball: &BallMotion<R>,
    ) -> PocketReaction<R> {
        let zero = R::zero();
        let e_r = direction(ball.azimuth);
        let w = e_r * ball.radius - cage.position;
        let past = e_r * ball.radial_speed + e_r.turned() * (ball.radius * ball.orbit_speed)
            - cage.velocity;
        let across = axis.turned();
        let (reach, offset) = (w.dot(axis), w.dot(across));
        let side = offset.sign_or_plus();
        let penetration = offset.abs() - self.pocket_gap;
        let mut reaction = PocketReaction {
            on_ball: Vec2::zero(),
            ball_moment: zero,
            cage_moment: zero,
            force: zero,
            penetration,
            damping_heat: zero,
            sliding_heat: zero,
        };
        let pressed = penetration.greater(zero);
        if pressed.any() {
            let speed = side * (past.dot(across) - cage.spin * reach);
            let wall = linear_contact(
                self.pocket_stiffness,
                self.pocket_damping,
                penetration,
                speed,
            );
            let arm = side * self.ball_radius;
            let slide = past.dot(axis) - arm * (ball.spin - cage.spin) + cage.spin * offset;
            let coefficient =
                self.pocket_friction * (slide * self.pocket_inverse_reference_speed).tanh();
            let friction = coefficient * wall.force;
            reaction.on_ball = -(across * (side * wall.force) + axis * friction);
            reaction.ball_moment = arm * friction;
            reaction.cage_moment = side * wall.force * reach - (offset + arm) * friction;
            reaction.force = wall.force;
            reaction.damping_heat = (wall.force - wall.elastic) * speed;
            reaction.sliding_heat = friction * slide;
        }
        reaction
    }

    /// Energy in the contact of a ball with a pocket, J.
    #[inline(always)]
    pub fn pocket_energy(&self, penetration: R) -> R {
        R::splat(0.5) * self.pocket_stiffness * penetration.max(R::zero()).square()
    }
}
