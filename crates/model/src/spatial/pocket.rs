//! A ball in the pocket of a cage in space.
//!
//! ```text
//!   s = b - x_c,  ζ = s·a,  p = s - ζa,  ρ_c = |p|;  pocket j along e_j, t_j = a × e_j of the cage
//!   ψ = R_p angle(p·e_j, p·t_j),  r_p = √(ψ² + ζ²),  pen = r_p - gap
//!   G = ∂pen/∂b = (ψ/r_p)(R_p/ρ_c)(a × p)/ρ_c + (ζ/r_p)a,     pėn = G·(v_b - v_cage(b))
//!   on the ball, at c = b + r G/|G|: -P G and friction μ tanh(|u|/u0) P against u, the slip across G; on the cage the opposite
//! ```
//! A tied cage knows no ζ: its pockets are walls across the track.
//!
//! Assumes: a circular pocket whose radius is arc length at R_p; rigid. Does not model: oil in the pocket, balls that touch balls.

use super::race::BallInSpace;
use super::rigid_body::{RigidBody, SpatialWrench};
use number::{Mask, Real, Vec3, constants, direction_angle};
use physics::contact::{NormalForce, linear_contact};

constants! {
    /// The pockets of a cage.
    pub struct SpatialPocket {
        /// Radius R_p of the circle of the pockets, m.
        circle: R,
        /// Free travel of the ball, m.
        gap: R,
        /// Stiffness, N/m.
        stiffness: R,
        /// Damping, s/m.
        damping: R,
        /// Friction coefficient.
        friction: R,
        /// 1/u0, s/m.
        inverse_reference_speed: R,
    }
}

/// A cage as its balls see it.
#[derive(Clone, Copy, Debug)]
pub struct CageMotion<R> {
    position: Vec3<R>,
    velocity: Vec3<R>,
    spin: Vec3<R>,
    axes: [Vec3<R>; 2],
    axis: Vec3<R>,
}

impl<R: Real> CageMotion<R> {
    /// Of a body.
    pub fn of(body: &RigidBody<R>) -> CageMotion<R> {
        CageMotion {
            position: body.position,
            velocity: body.velocity,
            spin: body.spin,
            axes: body.transverse_axes(),
            axis: body.axis,
        }
    }
    /// Of a body, for a group of balls.
    #[inline(always)]
    pub fn grouped(body: &RigidBody<R>) -> CageMotion<R::Group> {
        let [d1, d2] = body.transverse_axes();
        CageMotion {
            position: body.position.grouped(),
            velocity: body.velocity.grouped(),
            spin: body.spin.grouped(),
            axes: [d1.grouped(), d2.grouped()],
            axis: body.axis.grouped(),
        }
    }
}

/// What a pocket and its ball do to each other.
#[derive(Clone, Copy, Debug)]
pub struct InPocket<R> {
    /// On the ball about its centre.
    pub on_ball: SpatialWrench<R>,
    /// On the cage about its centre of mass.
    pub on_cage: SpatialWrench<R>,
    /// Pocket force P.
    pub load: NormalForce<R>,
    /// Penetration, m; negative when free.
    pub penetration: R,
    /// ψ and ζ, m.
    pub offset: [R; 2],
    /// Heat of contact damping, W.
    pub damping_heat: R,
    /// Heat of sliding, W.
    pub sliding_heat: R,
}

/// Where a ball is in its pocket, before anything is known of forces.
#[derive(Clone, Copy, Debug)]
pub struct PocketPlace<R> {
    s: Vec3<R>,
    p: Vec3<R>,
    zeta: R,
    /// p·e_j and p·t_j.
    along: [R; 2],
    squared: R,
}

impl<R: Real> SpatialPocket<R> {
    /// Place of a ball in the pocket of a seat, given by its cosine and sine.
    #[inline(always)]
    pub fn place(
        &self,
        cage: &CageMotion<R>,
        seat: [R; 2],
        ball: &BallInSpace<R>,
        tied: bool,
    ) -> PocketPlace<R> {
        let s = ball.position - cage.position;
        let zeta = s.dot(cage.axis);
        let p = s - cage.axis * zeta;
        let (x, y) = (p.dot(cage.axes[0]), p.dot(cage.axes[1]));
        PocketPlace {
            s,
            p,
            zeta: if tied { R::zero() } else { zeta },
            along: [seat[0] * x + seat[1] * y, seat[0] * y - seat[1] * x],
            squared: p.length_squared(),
        }
    }
    /// Whether any ball may be pressed: decided without root and division, with 1.5 % to spare.
    #[inline(always)]
    pub fn may_press(&self, at: &PocketPlace<R>) -> bool {
        let [x, y] = at.along;
        let square = y.square();
        let reach =
            R::splat(MORE_THAN_ARC) * self.circle.square() * square + at.zeta.square() * at.squared;
        let far = square.greater(R::splat(SMALL_SINE * SMALL_SINE) * at.squared);
        let pressed = reach.greater(self.gap.square() * at.squared);
        (pressed | far | x.less(R::zero())).any()
    }
    /// Reaction of ball and pocket.
    #[inline(always)]
    pub fn react(
        &self,
        cage: &CageMotion<R>,
        ball: &BallInSpace<R>,
        radius: R,
        at: &PocketPlace<R>,
    ) -> InPocket<R> {
        let tiny = R::splat(1e-60);
        let inverse = at.squared.max(tiny).sqrt().recip();
        let angle = direction_angle(at.along[0] * inverse, at.along[1] * inverse);
        let psi = self.circle * angle;
        let off = (psi.square() + at.zeta.square()).max(tiny).sqrt();
        let inverse_off = off.recip();
        let turning = cage.axis.cross(at.p) * (self.circle * inverse.square());
        let gradient = turning * (psi * inverse_off) + cage.axis * (at.zeta * inverse_off);
        let past = ball.velocity - cage.velocity - cage.spin.cross(at.s);
        let penetration = off - self.gap;
        let speed = gradient.dot(past);
        let load = linear_contact(self.stiffness, self.damping, penetration, speed);
        let arm = gradient * (radius * gradient.length_squared().max(tiny).sqrt().recip());
        let unit = arm * radius.recip();
        let slip = (past + (ball.spin - cage.spin).cross(arm)).across(unit);
        let size = slip.length_squared().max(R::splat(1e-24)).sqrt();
        let friction = self.friction * (size * self.inverse_reference_speed).tanh() * load.force;
        let rubbing = slip * -(friction / size);
        let force = rubbing - gradient * load.force;
        InPocket {
            on_ball: SpatialWrench {
                force,
                moment: arm.cross(force),
            },
            on_cage: SpatialWrench {
                force: -force,
                moment: -(at.s + arm).cross(force),
            },
            load,
            penetration,
            offset: [psi, at.zeta],
            damping_heat: (load.force - load.elastic) * speed,
            sliding_heat: friction * size,
        }
    }
}

/// Sine of an angle up to which a square of arc exceeds that of its sine by less than [`MORE_THAN_ARC`].
const SMALL_SINE: f64 = 0.125;
/// (0.1254/0.125)² is 1.006.
const MORE_THAN_ARC: f64 = 1.03;
