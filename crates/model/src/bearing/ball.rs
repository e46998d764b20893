//! One ball between inner race, outer race and cage: the whole planar bearing is this function, summed.
//!
//! ```text
//!   ball centre  b = ρ e_r(θ),  spin σ counter-clockwise           n: race centre → ball,  t: n turned +90°
//!
//!   contact   approach δ                      slip u, race less ball surface       arms (mid-overlap)
//!   inner     R_i + r - |b - c_i|             (v_i - v_b)·t + ω_i a_i + σ a         a = r - δ/2, a_i = R_i - δ/2
//!   outer     |b - c_o| + r - R_o             (v_o - v_b)·t + ω_o a_o - σ a         a = r - δ/2, a_o = R_o + δ/2
//!
//!   surface speeds seen from the contact, which turns about the race's centre at φ̇ = (v_b - v)·t/|b - c|
//!     inner   race a_i (ω_i - φ̇)    ball a (φ̇ - σ)     their mean v = a_i (ω_i - φ̇) - u/2, their difference u
//!     outer   race a_o (ω_o - φ̇)    ball a (σ - φ̇)     v = a_o (ω_o - φ̇) - u/2
//!
//!   on the ball: inner  +Q n + μ Q t, moment -a μQ       outer  -Q n + μ Q t, moment +a μQ,  μ(u, Q, v)
//!
//!   pocket    ψ = R_p wrap(β - φ_c - seat), β azimuth about c_o;  s = sign ψ;  p = |ψ| - gap
//!             on the ball  -s P R_p/|b - c_o| t - μ_c tanh(v/v0) P n,   v = (v_b - v_o)·n - s r (σ - ω_c)
//! ```
//! Every force stands once and is added with both signs. The steady moment's drag and couple on the ball come from
//! elsewhere: [`steady_moment`](super::steady_moment).
//!
//! R_i = R_i0 + kΩ²: the inner race grows with its own speed.
//!
//! Contacts at an angle α, held by an axial preload, are computed in the plane: r is then the ball radius times cos α, K the
//! radial stiffness, Q the radial part of the contact load. Traction and results take the contact load, Q/cos α. The spin has the
//! inertia ⅖ m (r cos α)²; walls keep the arm r, their friction and its slip count cos α of themselves:
//! [`angular_contact`](physics::angular_contact).
//!
//! Assumes: motion in the plane; here the cage is centred on the outer race (else see [`pocket`](super::pocket)).
//! Does not model: axial motion, tilt, gyroscopic moments, squeeze of the film; slip that differs over one contact: in the
//! curved groove (Heathcote), and by spin about the normal, the larger of both at a contact angle.

pub use super::ball_reaction::{BallAcceleration, BallHeat, BallReaction};
use crate::motion::Wrench;
use number::{Gather, Mask, Real, Vec2, constants};
use physics::contact::{NormalForce, ball_race, linear_contact};
use physics::traction::{SlidingContact, TractionLaw};

constants! {
    /// What one ball, its two contacts and its pocket are made of.
    pub struct BallConstants {
        /// Distance r of the contacts from the ball's centre in the plane, m: ball radius times cos α.
        radius: R,
        /// Radius of the ball, m.
        ball_radius: R,
        /// Contact load over its radial part, 1/cos α.
        load_per_radial_force: R,
        /// Ball mass, kg.
        mass: R,
        /// 1/mass, 1/kg.
        inverse_mass: R,
        /// 1/(inertia of the spin in the plane), 1/(kg m²).
        inverse_inertia: R,
        /// Radius of the inner track at rest R_i0, m.
        inner_track: R,
        /// Growth k of the inner track's radius with the square of its speed, m s².
        inner_track_growth: R,
        /// Radius of the outer track R_o, m.
        outer_track: R,
        /// Hertz stiffness at the inner race K_i, N/m^1.5; at a contact angle the radial one, K cos^2.5 α.
        inner_stiffness: R,
        /// Hertz stiffness at the outer race K_o, N/m^1.5.
        outer_stiffness: R,
        /// Contact damping time β, s.
        damping_time: R,
        /// Radius of the circle of the pockets R_p, m.
        pocket_radius: R,
        /// Free travel of the ball in its pocket to either side, m.
        pocket_gap: R,
        /// Pocket stiffness, N/m.
        pocket_stiffness: R,
        /// Pocket damping, s/m.
        pocket_damping: R,
        /// Pocket friction coefficient, times cos α.
        pocket_friction: R,
        /// Inverse of the reference speed of pocket friction, s/m, times cos α.
        pocket_inverse_reference_speed: R,
        /// Drag to ground on the orbit speed, N s/m.
        orbit_drag: R,
        /// Drag to ground on the spin, N m s.
        spin_drag: R,
        /// Gravity, m/s².
        gravity: Vec2<R>,
    }
}

/// Motion of a ball about the fixed origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallMotion<R> {
    /// Distance from the origin ρ, m.
    pub radius: R,
    /// ρ̇, m/s.
    pub radial_speed: R,
    /// Azimuth θ, rad.
    pub azimuth: R,
    /// θ̇, rad/s.
    pub orbit_speed: R,
    /// Spin σ, rad/s.
    pub spin: R,
}

/// A race as a ball sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RaceMotion<R> {
    /// Centre, m.
    pub position: Vec2<R>,
    /// Speed of the centre, m/s.
    pub velocity: Vec2<R>,
    /// Spin, rad/s.
    pub spin: R,
}

/// A pocket as its ball sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PocketMotion<R> {
    /// Angle of the pocket centre, cage angle and seat, rad.
    pub angle: R,
    /// Cage speed, rad/s.
    pub spin: R,
}

/// What the steady moment adds to the forces on a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slowing<R> {
    /// Drag along -t of the outer ring, on which the opposite acts at the ball, N.
    pub drag: R,
    /// Couple against the spin, N m; what it does to the races stands in [`steady_moment`](super::steady_moment).
    pub couple: R,
}

impl<R: Real> Slowing<R> {
    /// None.
    pub fn none() -> Self {
        Slowing {
            drag: R::zero(),
            couple: R::zero(),
        }
    }
}

/// How far a ball is from the three centres: what its chain of forces starts with, and waits for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallDistances<R> {
    /// Unit vector from the origin to the ball.
    pub e_r: Vec2<R>,
    /// Distance from the inner race's centre, m.
    pub inner: R,
    /// Distance from the outer race's centre, m.
    pub outer: R,
    /// 1/(product of both distances and ρ), 1/m³: one division serves three reciprocals.
    pub inverse_product: R,
}

impl<R: Real> BallDistances<R> {
    /// The place of a ball at a distance from the origin, in the direction of a unit vector.
    #[inline(always)]
    pub fn of(inner: &RaceMotion<R>, outer: &RaceMotion<R>, radius: R, e_r: Vec2<R>) -> Self {
        let position = e_r * radius;
        let inner = (position - inner.position).length_squared().sqrt();
        let outer = (position - outer.position).length_squared().sqrt();
        BallDistances {
            e_r,
            inner,
            outer,
            inverse_product: (inner * outer * radius).recip(),
        }
    }
}

/// A ball at one race.
#[derive(Clone, Copy, Debug)]
pub(super) struct AtRace<R> {
    /// n, from the race's centre to the ball.
    pub n: Vec2<R>,
    /// Distance from the race's centre, m.
    pub distance: R,
    /// 1/distance, 1/m.
    pub inverse_distance: R,
    /// Radius of the track, m.
    track: R,
    /// Speed of the ball past the race's centre, m/s.
    pub past: Vec2<R>,
    /// Approach δ, m.
    pub approach: R,
    /// Its rate, m/s.
    pub closing: R,
    /// Load Q.
    pub normal: NormalForce<R>,
}

/// The surfaces of ball and race where they touch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surfaces<R> {
    /// Arm from the ball's centre, m.
    ball_arm: R,
    /// Arm from the race's centre, m.
    race_arm: R,
    /// Slip, load and entrainment.
    pub contact: SlidingContact<R>,
}

/// A ball at the wall of its pocket; meaningful where it is pressed.
#[derive(Clone, Copy, Debug)]
pub(super) struct AtWall<R> {
    /// Pocket force.
    pub normal: NormalForce<R>,
    /// Rate of the penetration, m/s.
    pub penetration_speed: R,
    /// Arm of the friction about the ball's centre, m; its sign is the side of the pocket.
    pub arm: R,
    /// Sliding speed, m/s.
    pub slide: R,
    /// Friction coefficient, odd in the sliding speed.
    pub coefficient: R,
}

/// A ball between its races.
#[derive(Clone, Copy, Debug)]
pub(super) struct Between<R> {
    /// Unit vector from the origin to the ball.
    pub e_r: Vec2<R>,
    position: Vec2<R>,
    from_outer: Vec2<R>,
    /// 1/ρ, 1/m.
    pub inverse_radius: R,
    /// At the inner race.
    pub inner: AtRace<R>,
    /// At the outer race.
    pub outer: AtRace<R>,
}

impl<R: Real> BallConstants<R> {
    /// Where a ball stands between its races, and how it is pressed.
    #[inline(always)]
    pub(super) fn between(
        &self,
        inner: &RaceMotion<R>,
        outer: &RaceMotion<R>,
        ball: &BallMotion<R>,
        distances: &BallDistances<R>,
    ) -> Between<R> {
        let e_r = distances.e_r;
        let position = e_r * ball.radius;
        let velocity = e_r * ball.radial_speed + e_r.turned() * (ball.radius * ball.orbit_speed);

        let from_inner = position - inner.position;
        let from_outer = position - outer.position;
        let (inner_distance, outer_distance) = (distances.inner, distances.outer);
        let inverse_distances = distances.inverse_product * ball.radius;
        let inverse_inner = inverse_distances * outer_distance;
        let inverse_outer = inverse_distances * inner_distance;
        let inverse_radius = distances.inverse_product * (inner_distance * outer_distance);

        let n_i = from_inner * inverse_inner;
        let past_inner = velocity - inner.velocity;
        let inner_track = self.inner_track + self.inner_track_growth * inner.spin.square();
        let inner_approach = inner_track + self.radius - inner_distance;
        let inner_closing = -past_inner.dot(n_i);
        let q_i = ball_race(
            self.inner_stiffness,
            self.damping_time,
            inner_approach,
            inner_closing,
        );

        let n_o = from_outer * inverse_outer;
        let past_outer = velocity - outer.velocity;
        let outer_approach = outer_distance + self.radius - self.outer_track;
        let outer_closing = past_outer.dot(n_o);
        let q_o = ball_race(
            self.outer_stiffness,
            self.damping_time,
            outer_approach,
            outer_closing,
        );
        Between {
            e_r,
            position,
            from_outer,
            inverse_radius,
            inner: AtRace {
                n: n_i,
                distance: inner_distance,
                inverse_distance: inverse_inner,
                track: inner_track,
                past: past_inner,
                approach: inner_approach,
                closing: inner_closing,
                normal: q_i,
            },
            outer: AtRace {
                n: n_o,
                distance: outer_distance,
                inverse_distance: inverse_outer,
                track: self.outer_track,
                past: past_outer,
                approach: outer_approach,
                closing: outer_closing,
                normal: q_o,
            },
        }
    }

    /// The surfaces at the inner race.
    #[inline(always)]
    pub(super) fn on_inner(&self, at: &AtRace<R>, race_spin: R, spin: R) -> Surfaces<R> {
        let half = R::splat(0.5) * at.approach;
        let arm = self.radius - half;
        self.surfaces(at, race_spin, at.track - half, arm, spin * arm)
    }

    /// The surfaces at the outer race.
    #[inline(always)]
    pub(super) fn on_outer(&self, at: &AtRace<R>, race_spin: R, spin: R) -> Surfaces<R> {
        let half = R::splat(0.5) * at.approach;
        let arm = self.radius - half;
        self.surfaces(at, race_spin, at.track + half, arm, -(spin * arm))
    }

    /// The surfaces at these arms; `back` is the speed of the ball's surface against its centre along -t.
    #[inline(always)]
    fn surfaces(&self, at: &AtRace<R>, spin: R, race_arm: R, ball_arm: R, back: R) -> Surfaces<R> {
        let past = at.past.dot(at.n.turned());
        let slip = spin * race_arm + back - past;
        let turning = spin - past * at.inverse_distance;
        Surfaces {
            ball_arm,
            race_arm,
            contact: SlidingContact {
                slip,
                load: at.normal.force * self.load_per_radial_force,
                entrainment: race_arm * turning - R::splat(0.5) * slip,
            },
        }
    }

    /// Acceleration of a ball and its reactions on its three neighbours: the inner race, the outer race, the pocket.
    #[inline(always)]
    pub fn react<L: TractionLaw<R>>(
        &self,
        traction: &L,
        (inner, outer, pocket): (&RaceMotion<R>, &RaceMotion<R>, &PocketMotion<R>),
        ball: &BallMotion<R>,
        distances: &BallDistances<R>,
        slowing: &Slowing<R>,
    ) -> BallReaction<R> {
        let zero = R::zero();
        let orbital = ball.radius * ball.orbit_speed;
        let Between {
            e_r,
            position,
            from_outer,
            inverse_radius,
            inner: at_inner,
            outer: at_outer,
        } = self.between(inner, outer, ball, distances);
        let e_t = e_r.turned();

        let (n_i, t_i) = (at_inner.n, at_inner.n.turned());
        let (inner_approach, inner_closing, q_i) =
            (at_inner.approach, at_inner.closing, at_inner.normal);
        let (n_o, t_o) = (at_outer.n, at_outer.n.turned());
        let (outer_approach, outer_closing, q_o) =
            (at_outer.approach, at_outer.closing, at_outer.normal);
        let inverse_outer = at_outer.inverse_distance;
        let past_outer_t = at_outer.past.dot(t_o);
        let at_i = self.on_inner(&at_inner, inner.spin, ball.spin);
        let at_o = self.on_outer(&at_outer, outer.spin, ball.spin);

        // traction: zero by itself where the load is
        let (inner, outer) = (at_i.contact, at_o.contact);
        let (mu_i, mu_o) = traction.at_races(&inner, &outer);
        let inner_traction = mu_i * inner.load;
        let outer_traction = mu_o * outer.load;

        // pocket: computed only where any ball of the group may be pressed, which costs less to decide than where each
        // stands exactly; the answer is the same, and the compiler moves what only the branch needs into it
        let sine = e_r.cross(from_outer) * inverse_outer;
        let angle = pocket_angle(ball.azimuth, pocket.angle);
        let most = (angle.abs() + sine.abs() * R::splat(MOST_ARC)) * self.pocket_radius;
        let offset = angle + sine.asin_small();
        let side = offset.sign_or_plus();
        let penetration = self.pocket_penetration(offset);
        let (mut pocket_force, mut pocket_push, mut pocket_friction) = (zero, zero, zero);
        let (mut pocket_moment, mut damping_heat, mut sliding_heat) = (zero, zero, zero);
        if most.greater(self.pocket_gap).any() {
            let pressed = penetration.greater(zero);
            let orbit = past_outer_t * inverse_outer;
            let wall = self.at_wall(side, penetration, orbit, outer_closing, ball.spin, pocket);
            let (p, coefficient) = (wall.normal, wall.coefficient);
            pocket_force = p.force;
            pocket_push = R::select(pressed, -(p.force * (side * self.pocket_radius)), zero);
            pocket_friction = R::select(pressed, -(coefficient * p.force), zero);
            pocket_moment = R::select(pressed, wall.arm * pocket_friction, zero);
            damping_heat = (p.force - p.elastic) * wall.penetration_speed;
            sliding_heat = R::select(pressed, coefficient * p.force * wall.slide, zero);
        }

        // the three force pairs
        let by_inner = n_i * q_i.force + t_i * inner_traction;
        let by_outer = n_o * (pocket_friction - q_o.force)
            + t_o * (outer_traction + pocket_push * inverse_outer - slowing.drag);
        let drag = self.orbit_drag * orbital;
        let force = by_inner + by_outer - e_t * drag;
        let moment = at_o.ball_arm * outer_traction
            - at_i.ball_arm * inner_traction
            - pocket_moment
            - self.spin_drag * ball.spin
            - slowing.couple;

        let acceleration = force * self.inverse_mass + self.gravity;
        let two = R::splat(2.0);
        BallReaction {
            acceleration: BallAcceleration {
                radial: acceleration.dot(e_r) + orbital * ball.orbit_speed,
                orbit: (acceleration.dot(e_t) - two * ball.radial_speed * ball.orbit_speed)
                    * inverse_radius,
                spin: moment * self.inverse_inertia,
            },
            on_inner: Wrench::planar(-by_inner, -(at_i.race_arm * inner_traction)),
            on_outer: Wrench::planar(-by_outer, -(at_o.race_arm * outer_traction)),
            on_cage: pocket_moment - pocket_push,
            external_moment: position.cross(self.gravity) * self.mass
                - drag * ball.radius
                - self.spin_drag * ball.spin,
            heat: BallHeat {
                inner_damping: (q_i.force - q_i.elastic) * inner_closing,
                outer_damping: (q_o.force - q_o.elastic) * outer_closing,
                inner_sliding: inner_traction * inner.slip,
                outer_sliding: outer_traction * outer.slip,
                drag: drag * orbital + self.spin_drag * ball.spin.square(),
                pocket_damping: damping_heat,
                pocket_sliding: sliding_heat,
            },
            inner_load: inner.load,
            outer_load: outer.load,
            inner_approach,
            outer_approach,
            inner_traction,
            outer_traction,
            inner_slip: inner.slip,
            outer_slip: outer.slip,
            inner_entrainment: inner.entrainment,
            outer_entrainment: outer.entrainment,
            pocket_force,
            pocket_friction,
            pocket_side: side,
            pocket_penetration: penetration,
        }
    }

    /// A ball at the wall of its pocket; `orbit` is its angular speed about the outer race's centre.
    #[inline(always)]
    pub(super) fn at_wall(
        &self,
        side: R,
        penetration: R,
        orbit: R,
        outer_closing: R,
        spin: R,
        pocket: &PocketMotion<R>,
    ) -> AtWall<R> {
        let penetration_speed = (side * self.pocket_radius) * (orbit - pocket.spin);
        let arm = side * self.ball_radius;
        let slide = outer_closing - arm * (spin - pocket.spin);
        AtWall {
            normal: linear_contact(
                self.pocket_stiffness,
                self.pocket_damping,
                penetration,
                penetration_speed,
            ),
            penetration_speed,
            arm,
            slide,
            coefficient: self.pocket_friction
                * (slide * self.pocket_inverse_reference_speed).tanh(),
        }
    }

    /// Angle of a ball off the middle of its pocket about the outer race's centre, rad.
    #[inline(always)]
    pub(super) fn pocket_offset(&self, at: &Between<R>, azimuth: R, pocket: R) -> R {
        let sine = at.e_r.cross(at.from_outer) * at.outer.inverse_distance;
        pocket_angle(azimuth, pocket) + sine.asin_small()
    }

    /// Depth of a ball in its pocket at an angle off the pocket's middle, m; negative when free.
    #[inline(always)]
    pub(super) fn pocket_penetration(&self, offset: R) -> R {
        offset.abs() * self.pocket_radius - self.pocket_gap
    }
}

/// Angle of a ball from the middle of its pocket about the origin, between -π and π.
///
/// The azimuth counts about the outer race's centre, which adds the small arc sine of e_r × (b - c_o)/|b - c_o|.
#[inline(always)]
pub(super) fn pocket_angle<R: Real>(azimuth: R, pocket: R) -> R {
    let angle = azimuth - pocket;
    let turns = angle * R::splat(0.5 / std::f64::consts::PI);
    angle - turns.round() * R::splat(2.0 * std::f64::consts::PI)
}

/// More than an arc sine over its sine, up to 0.125: 0.1253/0.125.
const MOST_ARC: f64 = 1.01;

/// The constants of one machine for every part of a group, or of one machine per lane.
pub(crate) fn gather_group<'a, R: Real, T>(machine: &dyn Fn(usize) -> &'a T) -> T::Out
where
    T: Gather<R::Group> + 'a,
{
    T::gather(&|part| machine(part % R::LANES))
}
