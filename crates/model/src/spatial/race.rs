//! The contact of a ball with a race, and the traction in it.
//!
//! ```text
//!   d = b - x,  ζ = d·a,  p = d - ζa,  ρ = |p|,  e = p/ρ          x centre, a axis of the ring
//!   n, δ: physics::groove;  arm = r - δ/2;  c = b + arm n: the one point where all forces act
//!   t_y = a × e (rolling direction),  t_x = t_y × n = n_a e - n_e a
//!   u = v_ring(c) - v_ball(c),  Δ = ω_ring - w;  δ̇ = -n·u
//!   slip at x = ξ a_H:  s_x = u_x - Δ_y h,  s_y = u_y + Δ_n x + Δ_x h,  h = x²/(2R_c)
//!   f = Q W μ(|s|) s/|s|;   F = Σ f,  M = (Σ h f_y, -Σ h f_x, Σ x f_y) on the ball in (t_x, t_y, n)
//!   on the ball F - Q n at c, and M; on the ring the opposite of both at c
//! ```
//! n points into the race for both races, so one function serves both. Heat of slip and spin Σ f·s ≥ 0.
//!
//! Assumes: slip and load of a strip across rolling ([`physics::contact_nodes`]); one law μ(|s|) for the vector.
//! Does not model: the shoulder, offset of the centre of pressure, film of the lubricant beyond its law of traction.

use super::rigid_body::{RigidBody, SpatialWrench};
use number::{Real, Vec3, constants};
use physics::contact::{NormalForce, ball_race};
use physics::contact_nodes::ContactNode;
use physics::groove::in_groove;
use physics::traction::{SlidingContact, TractionLaw};

constants! {
    /// The groove of a ring, and a ball's contact in it.
    pub struct RaceGroove {
        /// Radius R_g of the circle of the groove's centres, m.
        centre_radius: R,
        /// Place z_g of that circle along the ring's axis, m.
        place: R,
        /// Radius r_g of the groove less that of the ball, m.
        slack: R,
        /// K, N/m^1.5.
        stiffness: R,
        /// A_a of a_H = A_a √δ, √m.
        half_axis: R,
        /// 1/(2R_c), 1/m.
        half_curvature: R,
    }
}

/// A ring as a ball sees it.
#[derive(Clone, Copy, Debug)]
pub struct RingMotion<R> {
    /// Centre, m.
    pub position: Vec3<R>,
    /// m/s.
    pub velocity: Vec3<R>,
    /// rad/s.
    pub spin: Vec3<R>,
    /// Axis.
    pub axis: Vec3<R>,
}

impl<R: Real> RingMotion<R> {
    /// Of a body.
    pub fn of(body: &RigidBody<R>) -> RingMotion<R> {
        RingMotion {
            position: body.position,
            velocity: body.velocity,
            spin: body.spin,
            axis: body.axis,
        }
    }
    /// Of a body, for a group of balls.
    #[inline(always)]
    pub fn grouped(body: &RigidBody<R>) -> RingMotion<R::Group> {
        RingMotion {
            position: body.position.grouped(),
            velocity: body.velocity.grouped(),
            spin: body.spin.grouped(),
            axis: body.axis.grouped(),
        }
    }
}

/// Motion of a ball in the frame.
#[derive(Clone, Copy, Debug)]
pub struct BallInSpace<R> {
    /// Centre b, m.
    pub position: Vec3<R>,
    /// m/s.
    pub velocity: Vec3<R>,
    /// w, rad/s.
    pub spin: Vec3<R>,
}

/// Directions of a contact: t_x, t_y and n, in which vectors of a contact have their components x, y and z.
#[derive(Clone, Copy, Debug)]
pub struct Triad<R> {
    /// e: from the ring's axis to the ball.
    outward: Vec3<R>,
    /// t_y.
    rolling: Vec3<R>,
    axis: Vec3<R>,
    /// Parts of n along e and along a.
    pub normal: [R; 2],
}

impl<R: Real> Triad<R> {
    /// A vector of the frame in the contact.
    #[inline(always)]
    fn inward(&self, v: Vec3<R>) -> Vec3<R> {
        let [n_e, n_a] = self.normal;
        let (e, a) = (v.dot(self.outward), v.dot(self.axis));
        Vec3::new(n_a * e - n_e * a, v.dot(self.rolling), n_e * e + n_a * a)
    }
    /// A vector of the contact in the frame.
    #[inline(always)]
    fn outward(&self, v: Vec3<R>) -> Vec3<R> {
        let [n_e, n_a] = self.normal;
        self.outward * (n_a * v.x + n_e * v.z)
            + self.rolling * v.y
            + self.axis * (n_a * v.z - n_e * v.x)
    }
}

/// Ball and race where they touch.
#[derive(Clone, Copy, Debug)]
pub struct Touch<R> {
    /// From the ring's centre to the ball's, m.
    pub(super) from_ring: Vec3<R>,
    /// Its directions.
    pub triad: Triad<R>,
    /// δ, m.
    pub approach: R,
    /// δ̇, m/s.
    pub closing: R,
    /// Load Q.
    pub load: NormalForce<R>,
    /// r - δ/2, m.
    arm: R,
    /// u, m/s; its part along n is -δ̇.
    pub slip: Vec3<R>,
    /// Δ, rad/s.
    pub turning: Vec3<R>,
    /// Half axis a_H, m.
    pub half_axis: R,
    /// a_H²/(2R_c): how far the rim of the ellipse stands back, m.
    bulge: R,
    /// Mean speed of both surfaces past the contact, m/s.
    entrainment: R,
}

/// Traction in a contact, on the ball.
#[derive(Clone, Copy, Debug)]
pub struct Traction<R> {
    /// F, N; none along n.
    pub force: Vec3<R>,
    /// M about c, N m.
    pub couple: Vec3<R>,
    /// Heat of slip and spin, W.
    pub heat: R,
}

impl<R: Real> RaceGroove<R> {
    /// Where and how a ball touches.
    #[inline(always)]
    pub fn touch(
        &self,
        ring: &RingMotion<R>,
        ball: &BallInSpace<R>,
        radius: R,
        damping_time: R,
    ) -> Touch<R> {
        let half = R::splat(0.5);
        let axis = ring.axis;
        let from_ring = ball.position - ring.position;
        let along = from_ring.dot(axis);
        let p = from_ring - axis * along;
        let distance = p.length_squared().sqrt();
        let inverse = distance.recip();
        let outward = p * inverse;
        let rolling = axis.cross(outward);
        let at = in_groove(
            distance - self.centre_radius,
            along - self.place,
            self.slack,
        );
        let (n_e, n_a) = (at.radial, at.axial);

        // ring less ball: at the ball's centre as if the ring reached there, then at c
        let past = ring.velocity + ring.spin.cross(from_ring) - ball.velocity;
        let turned = ring.spin - ball.spin;
        let triad = Triad {
            outward,
            rolling,
            axis,
            normal: [n_e, n_a],
        };
        let (g, turning) = (triad.inward(past), triad.inward(turned));
        let arm = radius - half * at.approach;
        let slip = Vec3::new(g.x + arm * turning.y, g.y - arm * turning.x, g.z);
        let closing = -g.z;
        let load = ball_race(self.stiffness, damping_time, at.approach, closing);
        let half_axis = self.half_axis * at.approach.max(R::zero()).sqrt();
        Touch {
            from_ring,
            triad,
            approach: at.approach,
            closing,
            load,
            arm,
            slip,
            turning,
            half_axis,
            bulge: half_axis.square() * self.half_curvature,
            entrainment: (distance + arm * n_e) * (g.y * inverse) - half * slip.y,
        }
    }
}

impl<R: Real> Touch<R> {
    /// What traction and load do to the ball, the moment about its centre; and to the ring, about the ring's.
    #[inline(always)]
    pub fn on_ball_and_ring(&self, traction: &Traction<R>) -> [SpatialWrench<R>; 2] {
        let Vec3 { x, y, z } = traction.force;
        let force = self.triad.outward(Vec3::new(x, y, z - self.load.force));
        let arms = Vec3::new(-(self.arm * y), self.arm * x, R::zero());
        let moment = self.triad.outward(traction.couple + arms);
        let on_ball = SpatialWrench { force, moment };
        let on_ring = SpatialWrench {
            force: -force,
            moment: -(self.from_ring.cross(force) + moment),
        };
        [on_ball, on_ring]
    }
    /// Load on the race, in the frame, N.
    #[inline(always)]
    pub(super) fn push(&self) -> Vec3<R> {
        let [n_e, n_a] = self.triad.normal;
        (self.triad.outward * n_e + self.triad.axis * n_a) * self.load.force
    }
    /// t_x: across rolling, along which the ball turns as it rolls.
    #[inline(always)]
    pub(super) fn across(&self) -> Vec3<R> {
        let [n_e, n_a] = self.triad.normal;
        self.triad.outward * n_a - self.triad.axis * n_e
    }
    /// t_y: along rolling.
    #[inline(always)]
    pub(super) fn along(&self) -> Vec3<R> {
        self.triad.rolling
    }
    /// Speed of the ball's centre along t_y past the ring, which reaches there, m/s.
    #[inline(always)]
    pub(super) fn past(&self) -> R {
        -(self.slip.y + self.arm * self.turning.x)
    }
    #[inline(always)]
    fn at_node(&self, node: &ContactNode<R>) -> NodeSlip<R> {
        let place = node.place * self.half_axis;
        let back = node.place.square() * self.bulge;
        NodeSlip {
            x: self.slip.x - self.turning.y * back,
            y: self.slip.y + self.turning.z * place + self.turning.x * back,
            place,
            back,
        }
    }
    /// The contact as the plane sees it: slip along rolling.
    pub fn slides(&self) -> SlidingContact<R> {
        self.at(self.slip.y)
    }
    #[inline(always)]
    fn at(&self, slip: R) -> SlidingContact<R> {
        SlidingContact {
            slip,
            load: self.load.force,
            entrainment: self.entrainment,
        }
    }
}

/// Slip at a node, m/s, and where it is: across rolling, and behind the middle of the contact, m.
struct NodeSlip<R> {
    x: R,
    y: R,
    place: R,
    back: R,
}

impl<R: Real> NodeSlip<R> {
    #[inline(always)]
    fn size(&self) -> R {
        let least = R::splat(LEAST_SLIP * LEAST_SLIP);
        (self.x.square() + self.y.square()).max(least).sqrt()
    }
}

/// Slip below which traction is proportional to slip, m/s.
const LEAST_SLIP: f64 = 1e-12;

impl<R: Real> Traction<R> {
    #[inline(always)]
    fn none() -> Self {
        Traction {
            force: Vec3::zero(),
            couple: Vec3::zero(),
            heat: R::zero(),
        }
    }
    #[inline(always)]
    fn add(&mut self, weight: R, at: &NodeSlip<R>) {
        let (x, y) = (weight * at.x, weight * at.y);
        self.force += Vec3::new(x, y, R::zero());
        self.couple += Vec3::new(at.back * y, -(at.back * x), at.place * y);
        self.heat += x * at.x + y * at.y;
    }
    #[inline(always)]
    fn times(self, load: R) -> Self {
        Traction {
            force: self.force * load,
            couple: self.couple * load,
            heat: self.heat * load,
        }
    }
}

/// Traction in the contacts of a ball with its inner and its outer race.
#[inline(always)]
pub fn traction<R: Real, L: TractionLaw<R>>(
    law: &L,
    nodes: &[ContactNode<R>],
    touches: [&Touch<R>; 2],
) -> [Traction<R>; 2] {
    let [inner, outer] = touches;
    let (mut at_inner, mut at_outer) = (Traction::none(), Traction::none());
    for node in nodes {
        let (i, o) = (inner.at_node(node), outer.at_node(node));
        let (size_i, size_o) = (i.size(), o.size());
        let (mu_i, mu_o) = law.at_races(&inner.at(size_i), &outer.at(size_o));
        // one division for both
        let inverse = node.weight / (size_i * size_o);
        at_inner.add(mu_i * size_o * inverse, &i);
        at_outer.add(mu_o * size_i * inverse, &o);
    }
    [
        at_inner.times(inner.load.force),
        at_outer.times(outer.load.force),
    ]
}
