//! A ball in a pocket of a cage that is free to move.
//!
//! ```text
//!   n_j = e(φ_c + seat): axis of the pocket, from the cage's centre c through the pocket;  t_j: n_j turned +90°
//!   w = b - c
//!   flat walls   the ball is free along n_j     ψ = w·t_j,  p = |ψ| - gap,  e = sgn(ψ) t_j
//!   spherical    it is held in all directions   d = w - R_p n_j,  p = |d| - gap,  e = d/|d|
//!
//!   P = max(0, k p (1 + a ṗ)),  ṗ = (v_b - v_c)·e - ω_c w×e          t: e turned +90°
//!   the wall is met at b + r e; there the ball slides along t at
//!                    u = (v_b - v_c)·t + r σ - ω_c (w·e + r)
//!   on the ball  -P e - f t,  f = μ tanh(u/u0) P;  moment -r f
//!   on the cage  the opposite;      moment about c  P w×e + (w·e + r) f
//! ```
//! Flat walls stand for machined cages, whose pockets are bores that stand radially and which a land guides; spherical ones for
//! cages that ride on their balls.
//!
//! Assumes: the point of contact at the ball's undeformed surface.
//! Does not model: lubricant in the pocket; barrels between both shapes.

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

/// Shape of a cage's pockets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PocketShape {
    /// Two walls: the ball is free towards the bearing's axis and away from it.
    Flat,
    /// A calotte around the ball.
    Spherical,
}

impl<R: Real> BallConstants<R> {
    /// Reaction of a ball and its pocket, whose axis is the unit vector `axis`, of a cage that moves.
    #[inline(always)]
    pub fn in_pocket(
        &self,
        shape: PocketShape,
        cage: &RaceMotion<R>,
        axis: Vec2<R>,
        ball: &BallMotion<R>,
    ) -> PocketReaction<R> {
        let zero = R::zero();
        let e_r = direction(ball.azimuth);
        let w = e_r * ball.radius - cage.position;
        let past = e_r * ball.radial_speed + e_r.turned() * (ball.radius * ball.orbit_speed)
            - cage.velocity;
        let (e, off) = match shape {
            PocketShape::Flat => {
                let across = axis.turned();
                let offset = w.dot(across);
                (across * offset.sign_or_plus(), offset.abs())
            }
            PocketShape::Spherical => {
                let d = w - axis * self.pocket_radius;
                // a ball in the middle has no direction; any will do, as nothing acts
                let off = d.length_squared().max(R::splat(1e-30)).sqrt();
                (d * off.recip(), off)
            }
        };
        let penetration = off - self.pocket_gap;
        let mut reaction = PocketReaction {
            on_ball: Vec2::zero(),
            ball_moment: zero,
            cage_moment: zero,
            force: zero,
            penetration,
            damping_heat: zero,
            sliding_heat: zero,
        };
        if penetration.greater(zero).any() {
            let t = e.turned();
            let lever = w.cross(e);
            let speed = past.dot(e) - cage.spin * lever;
            let wall = linear_contact(
                self.pocket_stiffness,
                self.pocket_damping,
                penetration,
                speed,
            );
            let reach = w.dot(e) + self.ball_radius;
            let slide = past.dot(t) + self.ball_radius * ball.spin - cage.spin * reach;
            let coefficient =
                self.pocket_friction * (slide * self.pocket_inverse_reference_speed).tanh();
            let friction = coefficient * wall.force;
            reaction.on_ball = -(e * wall.force + t * friction);
            reaction.ball_moment = -(self.ball_radius * friction);
            reaction.cage_moment = lever * wall.force + reach * friction;
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
