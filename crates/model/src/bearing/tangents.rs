//! Stiffness and damping of what presses and rubs in a planar bearing, and its balls eliminated from a linearly implicit step.
//!
//! ```text
//!   (G - A) u = R,  G = 1/(hγ)                   A: the elements below; what is soft is left out, as a W-method allows
//!
//!   of a ball      n = u_ρ̇   t = ρ u_θ̇   s = r u_σ          of the border   z = (u_ẋi, u_ẏi, R_i u_ωi, u_ẋo, u_ẏo, R_p u_ωc)
//!   at the races   w_n = e_r·z_xy   w_t = e_t·z_xy + z_spin   (e_r, e_t at the ball's azimuth; the outer race does not turn)
//!
//!   element               stiffness, damping                 acts along
//!   ball/race             k = 3/2 K √δ,  c = k β  (Q > 0)      n - w_n
//!   traction              τ = Q ∂μ/∂u                          w_ti - t + s,  w_to - t - s
//!   pocket                k = k_p (1 + a ṗ),  c = k_p a p       pr (t - w_to) - z_c,  pr = R_p/ρ
//!   pocket friction       π = P ∂μ_c/∂v                        s - (r/R_p) z_c, both times r_b/r
//! ```
//! Positions follow their velocities, u_q = (R_q + u_v)/G, so that a spring joins its damper: c* = c + k/G. What is known of
//! the positions stands on the right. The direction of a contact moves with its ball, by the known R_θ/G:
//! h = ∂Q/∂θ = k c_t + c (v_c·e_t - c_r θ̇), c = (c_r, c_t) the race's centre; and the load Q turns with it.
//!
//! Every element acts on both of its bodies: the matrix is symmetric, and positive where nothing is negative. A ball meets
//! no other ball: it is eliminated by itself, normal and tangential motion apart, and leaves six rows of the border.
//!
//! Left out: how friction follows the load (μ dQ), the tilt of the contact's normal against e_r, growth of the inner race, steady moment, rolling resistance of oil, the lubricant's slow state.
//! For a cage that is centred on the outer race; others have no tangents here, and steps stay explicit.

use super::BearingConstants;
use super::ball::{BallConstants, BallDistances, PocketMotion, RaceMotion};
use super::ball_states::{BallRow, distances, grouped, load_ball, race, split, split_mut};
use super::ball_sums::BallSums;
use super::planar_constants::{PlanarConstants, Separation};
use crate::motion::Motion;
use number::{Mask, Real, Vec2};
use physics::traction::{SlidingContact, TractionLaw};

/// Rows of the border that a bearing stands in: z of the page.
pub const ROWS: usize = 6;
/// Entries on and above the diagonal of these rows.
pub const ENTRIES: usize = ROWS * (ROWS + 1) / 2;

/// What linearly implicit steps know of what is stiff, from the most to the least.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Known {
    /// All that presses and rubs.
    All,
    /// All but what keeps the balls apart, pockets of a free cage, its land, neighbours: that bounds their steps as it
    /// does those of the explicit method.
    Races,
    /// Nothing: balls that roll have no states of their own.
    Nothing,
    /// Nothing: parts of a mount besides spring and damper have no tangents.
    NotMounts,
}

impl BearingConstants {
    /// How much of what is stiff here linearly implicit steps know.
    pub fn tangents(&self) -> Known {
        match self {
            BearingConstants::Rolling(_) => Known::Nothing,
            BearingConstants::Planar(bearing) => match bearing.separation {
                Separation::CentredCage => Known::All,
                Separation::FreeCage(_) | Separation::Neighbours(_) => Known::Races,
            },
        }
    }
}

/// What is kept of each ball, in lists over the balls; some are made ready for the solutions when the balls are eliminated.
#[derive(Clone, Copy)]
enum Of {
    /// Direction e_r.
    DirectionX,
    DirectionY,
    /// ρ and 1/ρ.
    Radius,
    InverseRadius,
    /// Stiffness k, damping c, ∂Q/∂θ and load at the inner race; then k/G, c*, (∂Q/∂θ)/G, Q/G.
    InnerStiffness,
    InnerDamping,
    InnerTurn,
    InnerForce,
    /// The same at the outer race.
    OuterStiffness,
    OuterDamping,
    OuterTurn,
    OuterForce,
    /// Slopes of both tractions over slip, N s/m.
    InnerTraction,
    OuterTraction,
    /// Pocket: stiffness, damping, slope of friction; then k R_p/G, c* R_p/ρ, slope times r_b²/(r R_p).
    PocketStiffness,
    PocketDamping,
    PocketFriction,
    /// Change of the heat of pocket damping by that of ṗ/side, and of pocket friction by that of σ - ω_c.
    DampingHeat,
    FrictionHeat,
    /// 1/a, and the inverse of the tangential block.
    Inverse,
    InverseTt,
    InverseTs,
    InverseSs,
}
/// Number of them.
const LISTS: usize = 23;

/// The tangents of the balls of one bearing per lane.
#[derive(Clone, Debug)]
pub struct BallTangents<R: Real> {
    lists: Vec<R>,
    balls: usize,
}

/// What never changes: lengths that make spins speeds, and reciprocals, because a division costs as much as ten products.
#[derive(Clone, Debug)]
pub struct TangentConstants<R: Real> {
    /// Radius R_i of the inner track, m, and 1/R_i.
    pub inner_radius: [R; 2],
    /// Radius R_p of the circle of the pockets, m, and 1/R_p.
    pub cage_radius: [R; 2],
    /// Moment of inertia of the cage, kg m².
    pub cage_inertia: R,
    /// 1/r, and inertia of the ball's spin over r and over r².
    inverse_radius: R::Group,
    inertia: [R::Group; 2],
    /// Arms of pocket friction: (r_b/r)², r_b²/(r R_p), (r_b/R_p)².
    arms: [R::Group; 3],
}

impl<R: Real> TangentConstants<R> {
    /// Of a bearing in each lane.
    pub(super) fn gather<'a>(bearing: &dyn Fn(usize) -> &'a PlanarConstants) -> Self {
        let own = |of: &dyn Fn(&PlanarConstants) -> f64| R::from_lanes(|lane| of(bearing(lane)));
        let all = |of: &dyn Fn(&PlanarConstants) -> f64| own(of).grouped();
        TangentConstants {
            inner_radius: [
                own(&|b| b.ball.inner_track),
                own(&|b| 1.0 / b.ball.inner_track),
            ],
            cage_radius: [
                own(&|b| b.ball.pocket_radius),
                own(&|b| 1.0 / b.ball.pocket_radius),
            ],
            // a row without a cage has none of its own: any mass keeps it regular
            cage_inertia: own(&|b| b.cage_inertia.max(f64::MIN_POSITIVE)),
            inverse_radius: all(&|b| 1.0 / b.ball.radius),
            inertia: [
                all(&|b| 1.0 / (b.ball.inverse_inertia * b.ball.radius)),
                all(&|b| 1.0 / (b.ball.inverse_inertia * b.ball.radius.powi(2))),
            ],
            arms: [
                all(&|b| (b.ball.ball_radius / b.ball.radius).powi(2)),
                all(&|b| b.ball.ball_radius.powi(2) / (b.ball.radius * b.ball.pocket_radius)),
                all(&|b| (b.ball.ball_radius / b.ball.pocket_radius).powi(2)),
            ],
        }
    }
}

/// Right-hand sides of the positions that the balls know of.
#[derive(Clone, Copy, Debug)]
pub struct KnownRates<R> {
    /// Of the inner race.
    pub inner: Vec2<R>,
    /// Of the outer race.
    pub outer: Vec2<R>,
    /// Of the cage's angle.
    pub cage: R,
}

impl<R: Real> BallTangents<R> {
    /// Room for so many balls.
    pub fn new(balls: usize) -> Self {
        BallTangents {
            lists: vec![R::zero(); LISTS * balls],
            balls,
        }
    }
    #[inline(always)]
    fn of(&self, list: Of, from: usize) -> R::Group {
        let start = list as usize * self.balls;
        R::load_group(&self.lists[start..start + self.balls], from)
    }
    #[inline(always)]
    fn set(&mut self, list: Of, from: usize, value: R::Group) {
        let start = list as usize * self.balls;
        R::store_group(value, &mut self.lists[start..start + self.balls], from);
    }
    /// Takes the tangents of all balls at a state; `state` is the bearing's own.
    #[inline(always)]
    pub(super) fn take<L: TractionLaw<R::Group>>(
        &mut self,
        row: &BallRow<R>,
        seats: &[R],
        traction: &L,
        motion: &Motion<R>,
        state: &[R],
    ) {
        let zero = <R::Group as Real>::zero();
        let lists = split(state, row.first, row.balls);
        let (inner, outer) = (race(&motion.inner), race(&motion.outer));
        let b = &row.ball;
        // roots and divisions of one ball keep no other waiting; distances stand for a while where stiffness will
        let mut from = 0;
        while from < row.balls {
            let ball = load_ball(&lists, from);
            let d = distances(&inner, &outer, &ball);
            self.set(Of::DirectionX, from, d.e_r.x);
            self.set(Of::DirectionY, from, d.e_r.y);
            self.set(Of::InnerStiffness, from, d.inner);
            self.set(Of::OuterStiffness, from, d.outer);
            self.set(Of::InverseRadius, from, d.inverse_product);
            from += R::GROUP;
        }
        let mut from = 0;
        while from < row.balls {
            let ball = load_ball(&lists, from);
            let e_r = Vec2::new(self.of(Of::DirectionX, from), self.of(Of::DirectionY, from));
            let distances = BallDistances {
                e_r,
                inner: self.of(Of::InnerStiffness, from),
                outer: self.of(Of::OuterStiffness, from),
                inverse_product: self.of(Of::InverseRadius, from),
            };
            let at = b.between(&inner, &outer, &ball, &distances);
            self.set(Of::Radius, from, ball.radius);
            self.set(Of::InverseRadius, from, at.inverse_radius);

            // normal contacts
            let [k_i, c_i] = contact(
                b,
                b.inner_stiffness,
                at.inner.approach,
                at.inner.normal.force,
            );
            let [k_o, c_o] = contact(
                b,
                b.outer_stiffness,
                at.outer.approach,
                at.outer.normal.force,
            );
            let turn_i = turn(&[k_i, c_i], &inner, e_r, ball.orbit_speed);
            let turn_o = turn(&[k_o, c_o], &outer, e_r, ball.orbit_speed);
            self.set(Of::InnerStiffness, from, k_i);
            self.set(Of::InnerDamping, from, c_i);
            self.set(Of::InnerTurn, from, turn_i);
            self.set(Of::InnerForce, from, at.inner.normal.force);
            self.set(Of::OuterStiffness, from, k_o);
            self.set(Of::OuterDamping, from, c_o);
            self.set(Of::OuterTurn, from, -turn_o);
            self.set(Of::OuterForce, from, at.outer.normal.force);

            // traction
            let in_ = b.on_inner(&at.inner, inner.spin, ball.spin).contact;
            let out = b.on_outer(&at.outer, outer.spin, ball.spin).contact;
            let (slope_i, slope_o) = traction.slopes_at_races(&in_, &out);
            self.set(Of::InnerTraction, from, loaded(slope_i, &in_));
            self.set(Of::OuterTraction, from, loaded(slope_o, &out));

            // pocket
            let pocket = PocketMotion {
                angle: state[0].grouped() + R::load_group(seats, from),
                spin: state[1].grouped(),
            };
            let offset = b.pocket_offset(&at, ball.azimuth, pocket.angle);
            let (side, depth) = (offset.sign_or_plus(), b.pocket_penetration(offset));
            let mut of_pocket = [zero; 5];
            if depth.greater(zero).any() {
                let orbit = at.outer.past.dot(at.outer.n.turned()) * at.outer.inverse_distance;
                let wall = b.at_wall(side, depth, orbit, at.outer.closing, ball.spin, &pocket);
                let pressed = depth.greater(zero) & wall.normal.force.greater(zero);
                let one = <R::Group as Real>::one();
                let two = <R::Group as Real>::splat(2.0);
                let tiny = <R::Group as Real>::splat(1e-300);
                let (k_p, a_p) = (b.pocket_stiffness, b.pocket_damping);
                let damping = k_p * a_p * depth;
                let saturation = wall.coefficient / b.pocket_friction.max(tiny);
                let slope = b.pocket_friction
                    * b.pocket_inverse_reference_speed
                    * (one - saturation.square()).max(zero)
                    * wall.normal.force;
                let friction = wall.coefficient * wall.normal.force + slope * wall.slide;
                let values = [
                    k_p * (one + a_p * wall.penetration_speed),
                    damping,
                    slope,
                    two * damping * wall.penetration_speed * side,
                    -(friction * wall.arm),
                ];
                for (kept, value) in of_pocket.iter_mut().zip(values) {
                    *kept = <R::Group as Real>::select(pressed, value, zero);
                }
            }
            self.set(Of::PocketStiffness, from, of_pocket[0]);
            self.set(Of::PocketDamping, from, of_pocket[1]);
            self.set(Of::PocketFriction, from, of_pocket[2]);
            self.set(Of::DampingHeat, from, of_pocket[3]);
            self.set(Of::FrictionHeat, from, of_pocket[4]);
            from += R::GROUP;
        }
    }

    /// Eliminates the balls at a diagonal G: what they add to the border, its entries on and above the diagonal row by row.
    #[inline(always)]
    pub(super) fn factor(
        &mut self,
        row: &BallRow<R>,
        constants: &TangentConstants<R>,
        [g, inverse_g]: [R; 2],
    ) -> [R; ENTRIES] {
        let b = &row.ball;
        let inverse_g = inverse_g.grouped();
        let gm = g.grouped() * b.mass;
        let inertia = g.grouped() * constants.inertia[1];
        let arms = &constants.arms;
        let mut sums = BallSums::<R, ENTRIES>::new(row.balls);
        let mut from = 0;
        while from < row.balls {
            let spring_i = self.of(Of::InnerStiffness, from) * inverse_g;
            let spring_o = self.of(Of::OuterStiffness, from) * inverse_g;
            let spring_p = self.of(Of::PocketStiffness, from) * inverse_g;
            let inner = self.of(Of::InnerDamping, from) + spring_i;
            let outer = self.of(Of::OuterDamping, from) + spring_o;
            let pocket = self.of(Of::PocketDamping, from) + spring_p;
            let (ti, to) = (
                self.of(Of::InnerTraction, from),
                self.of(Of::OuterTraction, from),
            );
            let friction = self.of(Of::PocketFriction, from);
            let pr = b.pocket_radius * self.of(Of::InverseRadius, from);
            let push = pocket * pr;
            let cross = friction * arms[1];
            self.set(Of::InnerStiffness, from, spring_i);
            self.set(Of::OuterStiffness, from, spring_o);
            self.set(Of::PocketStiffness, from, spring_p * b.pocket_radius);
            self.set(Of::InnerDamping, from, inner);
            self.set(Of::OuterDamping, from, outer);
            self.set(Of::PocketDamping, from, push);
            self.set(Of::PocketFriction, from, cross);
            for list in [Of::InnerTurn, Of::InnerForce, Of::OuterTurn, Of::OuterForce] {
                self.set(list, from, self.of(list, from) * inverse_g);
            }

            let a = gm + inner + outer;
            let (tt, ts) = (gm + ti + to + push * pr, to - ti);
            let ss = inertia + ti + to + friction * arms[0];
            let determinant = tt * ss - ts.square();
            let inverse = (a * determinant).recip();
            let (inverse_a, inverse_det) = (determinant * inverse, a * inverse);
            let (i_tt, i_ts, i_ss) = (ss * inverse_det, -(ts * inverse_det), tt * inverse_det);
            self.set(Of::Inverse, from, inverse_a);
            self.set(Of::InverseTt, from, i_tt);
            self.set(Of::InverseTs, from, i_ts);
            self.set(Of::InverseSs, from, i_ss);

            let n_ii = inner - inner.square() * inverse_a;
            let n_io = -(inner * outer * inverse_a);
            let n_oo = outer - outer.square() * inverse_a;
            // columns of the tangential block: (ti, -ti), (to + walled, to), (push, cross)
            let walled = push * pr;
            let x_i = [(i_tt - i_ts) * ti, (i_ts - i_ss) * ti];
            let to_t = to + walled;
            let x_o = [i_tt * to_t + i_ts * to, i_ts * to_t + i_ss * to];
            let x_c = [i_tt * push + i_ts * cross, i_ts * push + i_ss * cross];
            let t_ii = ti - ti * (x_i[0] - x_i[1]);
            let t_io = -(ti * (x_o[0] - x_o[1]));
            let t_ic = -(ti * (x_c[0] - x_c[1]));
            let t_oo = to_t - (to_t * x_o[0] + to * x_o[1]);
            let t_oc = push - (to_t * x_c[0] + to * x_c[1]);
            let t_cc = pocket + friction * arms[2] - (push * x_c[0] + cross * x_c[1]);

            let (x, y) = (self.of(Of::DirectionX, from), self.of(Of::DirectionY, from));
            let (xx, xy, yy) = (x.square(), x * y, y.square());
            sums.add(
                from,
                &[
                    n_ii * xx + t_ii * yy,
                    (n_ii - t_ii) * xy,
                    -(t_ii * y),
                    n_io * xx + t_io * yy,
                    (n_io - t_io) * xy,
                    -(t_ic * y),
                    // row 1
                    n_ii * yy + t_ii * xx,
                    t_ii * x,
                    (n_io - t_io) * xy,
                    n_io * yy + t_io * xx,
                    t_ic * x,
                    // row 2
                    t_ii,
                    -(t_io * y),
                    t_io * x,
                    t_ic,
                    // row 3
                    n_oo * xx + t_oo * yy,
                    (n_oo - t_oo) * xy,
                    -(t_oc * y),
                    // row 4
                    n_oo * yy + t_oo * xx,
                    t_oc * x,
                    // row 5
                    t_cc,
                ],
            );
            from += R::GROUP;
        }
        sums.total()
    }

    /// Eliminates the balls from a right-hand side, `side` of the bearing's own states: what they add to the right of the border.
    #[inline(always)]
    pub(super) fn forward(
        &self,
        row: &BallRow<R>,
        constants: &TangentConstants<R>,
        known: &KnownRates<R>,
        side: &mut [R],
    ) -> [R; ROWS] {
        let b = &row.ball;
        let (inner, outer) = (grouped(known.inner), grouped(known.outer));
        let cage = known.cage.grouped();
        let mut sums = BallSums::<R, ROWS>::new(row.balls);
        let mut from = 0;
        while from < row.balls {
            let given = {
                let lists = split(side, row.first, row.balls);
                load_ball::<R>(&lists, from)
            };
            let (ti, to) = (
                self.of(Of::InnerTraction, from),
                self.of(Of::OuterTraction, from),
            );
            let e_r = Vec2::new(self.of(Of::DirectionX, from), self.of(Of::DirectionY, from));
            let e_t = e_r.turned();
            let inverse_radius = self.of(Of::InverseRadius, from);
            let pr = b.pocket_radius * inverse_radius;
            let turned = given.azimuth;
            let q_i = self.of(Of::InnerStiffness, from) * (e_r.dot(inner) - given.radius)
                + self.of(Of::InnerTurn, from) * turned;
            let q_o = self.of(Of::OuterStiffness, from) * (given.radius - e_r.dot(outer))
                + self.of(Of::OuterTurn, from) * turned;
            let q_p = self.of(Of::PocketStiffness, from)
                * (turned - e_t.dot(outer) * inverse_radius - cage);

            let n = (b.mass * given.radial_speed + q_i - q_o) * self.of(Of::Inverse, from);
            let on_t = b.mass * given.orbit_speed * self.of(Of::Radius, from) - pr * q_p;
            let on_s = constants.inertia[0] * given.spin;
            let i_ts = self.of(Of::InverseTs, from);
            let t = self.of(Of::InverseTt, from) * on_t + i_ts * on_s;
            let s = i_ts * on_t + self.of(Of::InverseSs, from) * on_s;

            let pull_i = ti * (t - s);
            let pull_o = to * (t + s);
            let on_inner = e_r * (self.of(Of::InnerDamping, from) * n - q_i)
                + e_t * (pull_i - self.of(Of::InnerForce, from) * turned);
            let wall = self.of(Of::PocketDamping, from) * t + q_p;
            let on_outer = e_r * (self.of(Of::OuterDamping, from) * n + q_o)
                + e_t * (pull_o + pr * wall + self.of(Of::OuterForce, from) * turned);
            let on_cage = wall + self.of(Of::PocketFriction, from) * s;
            sums.add(
                from,
                &[
                    on_inner.x, on_inner.y, pull_i, on_outer.x, on_outer.y, on_cage,
                ],
            );
            let [_, radial, _, orbit, spin] = split_mut(side, row.first, row.balls);
            R::store_group(n, radial, from);
            R::store_group(t, orbit, from);
            R::store_group(s, spin, from);
            from += R::GROUP;
        }
        sums.total()
    }

    /// The u of the balls from that of the border, where [`forward`](Self::forward) has left `side`.
    #[inline(always)]
    pub(super) fn back(
        &self,
        row: &BallRow<R>,
        constants: &TangentConstants<R>,
        inverse_g: R,
        z: &[R; ROWS],
        side: &mut [R],
    ) {
        let b = &row.ball;
        let inverse_g = inverse_g.grouped();
        let inner = grouped(Vec2::new(z[0], z[1]));
        let outer = grouped(Vec2::new(z[3], z[4]));
        let (race_spin, cage) = (z[2].grouped(), z[5].grouped());
        let mut from = 0;
        while from < row.balls {
            let given = {
                let lists = split(side, row.first, row.balls);
                load_ball::<R>(&lists, from)
            };
            let e_r = Vec2::new(self.of(Of::DirectionX, from), self.of(Of::DirectionY, from));
            let e_t = e_r.turned();
            let pull_i = self.of(Of::InnerTraction, from) * (e_t.dot(inner) + race_spin);
            let past_outer = e_t.dot(outer);
            let pull_o = self.of(Of::OuterTraction, from) * past_outer;
            let inverse_radius = self.of(Of::InverseRadius, from);
            let pr = b.pocket_radius * inverse_radius;
            let on_t =
                pull_i + pull_o + self.of(Of::PocketDamping, from) * (cage + pr * past_outer);
            let on_s = pull_o - pull_i + self.of(Of::PocketFriction, from) * cage;
            let pressed = self.of(Of::InnerDamping, from) * e_r.dot(inner)
                + self.of(Of::OuterDamping, from) * e_r.dot(outer);
            let i_ts = self.of(Of::InverseTs, from);
            let n = given.radial_speed + pressed * self.of(Of::Inverse, from);
            let t = given.orbit_speed + (self.of(Of::InverseTt, from) * on_t + i_ts * on_s);
            let s = given.spin + (i_ts * on_t + self.of(Of::InverseSs, from) * on_s);
            let orbit_speed = t * inverse_radius;
            let [radius, radial, azimuth, orbit, spin] = split_mut(side, row.first, row.balls);
            R::store_group((given.radius + n) * inverse_g, radius, from);
            R::store_group(n, radial, from);
            R::store_group((given.azimuth + orbit_speed) * inverse_g, azimuth, from);
            R::store_group(orbit_speed, orbit, from);
            R::store_group(s * constants.inverse_radius, spin, from);
            from += R::GROUP;
        }
    }

    /// Changes of the heats of pocket damping and of pocket friction along a vector over the bearing's own states.
    #[inline(always)]
    pub(super) fn heats_along(&self, row: &BallRow<R>, vector: &[R]) -> [R; 2] {
        let b = &row.ball;
        let cage = vector[1].grouped();
        let mut sums = BallSums::<R, 2>::new(row.balls);
        let lists = split(vector, row.first, row.balls);
        let mut from = 0;
        while from < row.balls {
            let ball = load_ball::<R>(&lists, from);
            let closing = b.pocket_radius * (ball.orbit_speed - cage);
            sums.add(
                from,
                &[
                    self.of(Of::DampingHeat, from) * closing,
                    self.of(Of::FrictionHeat, from) * (ball.spin - cage),
                ],
            );
            from += R::GROUP;
        }
        sums.total()
    }
}

/// Stiffness and damping of a ball at a race; none where it does not press.
#[inline(always)]
fn contact<G: Real>(b: &BallConstants<G>, stiffness: G, approach: G, force: G) -> [G; 2] {
    let zero = G::zero();
    let slope = G::splat(1.5) * stiffness * approach.max(zero).sqrt();
    let slope = G::select(force.greater(zero), slope, zero);
    [slope, slope * b.damping_time]
}

/// ∂Q/∂θ of a contact whose race stands aside of the origin.
#[inline(always)]
fn turn<G: Real>(contact: &[G; 2], race: &RaceMotion<G>, e_r: Vec2<G>, orbit_speed: G) -> G {
    let [k, c] = *contact;
    let e_t = e_r.turned();
    k * race.position.dot(e_t) + c * (race.velocity.dot(e_t) - race.position.dot(e_r) * orbit_speed)
}

/// Slope of the traction force over slip.
#[inline(always)]
fn loaded<G: Real>(slope: G, at: &SlidingContact<G>) -> G {
    slope * at.load
}
