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
use physics::traction::TractionLaw;

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
    /// Nothing: controllers have no tangents.
    NotControllers,
    /// Nothing: bearings in space have no tangents.
    NotSpace,
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
            BearingConstants::Spatial(_) => Known::NotSpace,
        }
    }
}

/// What is kept of a group of balls; some of it is made ready for the solutions when the balls are eliminated.
#[derive(Clone, Copy, Debug)]
struct OfBalls<G> {
    /// Direction e_r, and for a while the distances.
    places: BallDistances<G>,
    /// ρ and 1/ρ.
    radius: G,
    inverse_radius: G,
    inner: AtRace<G>,
    outer: AtRace<G>,
    /// Pocket: stiffness, damping, slope of friction; then k R_p/G, c* R_p/ρ, slope times r_b²/(r R_p).
    pocket: Pressing<G>,
    pocket_friction: G,
    /// Change of the heat of pocket damping by that of ṗ/side, and of pocket friction by that of σ - ω_c.
    damping_heat: G,
    friction_heat: G,
    /// 1/a, and the inverse of the tangential block.
    inverse: G,
    inverse_tt: G,
    inverse_ts: G,
    inverse_ss: G,
}

/// A contact of balls with a race.
#[derive(Clone, Copy, Debug)]
struct AtRace<G> {
    pressing: Pressing<G>,
    /// ∂Q/∂θ and load; then both over G.
    turn: G,
    force: G,
    /// Slope of the traction over slip, N s/m.
    traction: G,
}

/// What presses.
#[derive(Clone, Copy, Debug)]
struct Pressing<G> {
    /// k; then k/G.
    stiffness: G,
    /// c; then c* = c + k/G.
    damping: G,
}

impl<G: Real> Pressing<G> {
    fn none() -> Self {
        Pressing {
            stiffness: G::zero(),
            damping: G::zero(),
        }
    }
    /// The spring joins its damper.
    #[inline(always)]
    fn joined(self, inverse_g: G) -> Self {
        let spring = self.stiffness * inverse_g;
        Pressing {
            stiffness: spring,
            damping: self.damping + spring,
        }
    }
}

impl<G: Real> OfBalls<G> {
    fn none() -> Self {
        let zero = G::zero();
        let race = AtRace {
            pressing: Pressing::none(),
            turn: zero,
            force: zero,
            traction: zero,
        };
        OfBalls {
            places: BallDistances {
                e_r: Vec2::zero(),
                inner: zero,
                outer: zero,
                inverse_product: zero,
            },
            radius: zero,
            inverse_radius: zero,
            inner: race,
            outer: race,
            pocket: Pressing::none(),
            pocket_friction: zero,
            damping_heat: zero,
            friction_heat: zero,
            inverse: zero,
            inverse_tt: zero,
            inverse_ts: zero,
            inverse_ss: zero,
        }
    }
}

/// The tangents of the balls of one bearing per lane, in groups.
#[derive(Clone, Debug)]
pub struct BallTangents<R: Real> {
    groups: Vec<OfBalls<R::Group>>,
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
            groups: vec![OfBalls::none(); balls.div_ceil(R::GROUP)],
        }
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
        // roots and divisions of one ball keep no other waiting
        for (group, own) in self.groups.iter_mut().enumerate() {
            let ball = load_ball(&lists, group * R::GROUP);
            own.places = distances(&inner, &outer, &ball);
        }
        for (group, own) in self.groups.iter_mut().enumerate() {
            let from = group * R::GROUP;
            let ball = load_ball(&lists, from);
            let at = b.between(&inner, &outer, &ball, &own.places);
            let e_r = own.places.e_r;
            own.radius = ball.radius;
            own.inverse_radius = at.inverse_radius;

            // normal contacts
            let (normal_i, normal_o) = (at.inner.normal.force, at.outer.normal.force);
            let pressing_i = contact(b, b.inner_stiffness, at.inner.approach, normal_i);
            let pressing_o = contact(b, b.outer_stiffness, at.outer.approach, normal_o);
            // traction
            let in_ = b.on_inner(&at.inner, inner.spin, ball.spin).contact;
            let out = b.on_outer(&at.outer, outer.spin, ball.spin).contact;
            let (slope_i, slope_o) = traction.slopes_at_races(&in_, &out);
            own.inner = AtRace {
                pressing: pressing_i,
                turn: turn(&pressing_i, &inner, e_r, ball.orbit_speed),
                force: normal_i,
                traction: slope_i * in_.load,
            };
            own.outer = AtRace {
                pressing: pressing_o,
                turn: -turn(&pressing_o, &outer, e_r, ball.orbit_speed),
                force: normal_o,
                traction: slope_o * out.load,
            };

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
            own.pocket = Pressing {
                stiffness: of_pocket[0],
                damping: of_pocket[1],
            };
            own.pocket_friction = of_pocket[2];
            own.damping_heat = of_pocket[3];
            own.friction_heat = of_pocket[4];
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
        for (group, own) in self.groups.iter_mut().enumerate() {
            for race in [&mut own.inner, &mut own.outer] {
                race.pressing = race.pressing.joined(inverse_g);
                race.turn *= inverse_g;
                race.force *= inverse_g;
            }
            let (inner, outer) = (own.inner.pressing.damping, own.outer.pressing.damping);
            let (ti, to) = (own.inner.traction, own.outer.traction);
            let wall = own.pocket.joined(inverse_g);
            let (pocket, friction) = (wall.damping, own.pocket_friction);
            let pr = b.pocket_radius * own.inverse_radius;
            let push = pocket * pr;
            let cross = friction * arms[1];
            own.pocket = Pressing {
                stiffness: wall.stiffness * b.pocket_radius,
                damping: push,
            };
            own.pocket_friction = cross;

            let a = gm + inner + outer;
            let (tt, ts) = (gm + ti + to + push * pr, to - ti);
            let ss = inertia + ti + to + friction * arms[0];
            let determinant = tt * ss - ts.square();
            let inverse = (a * determinant).recip();
            let (inverse_a, inverse_det) = (determinant * inverse, a * inverse);
            let (i_tt, i_ts, i_ss) = (ss * inverse_det, -(ts * inverse_det), tt * inverse_det);
            own.inverse = inverse_a;
            own.inverse_tt = i_tt;
            own.inverse_ts = i_ts;
            own.inverse_ss = i_ss;

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

            let Vec2 { x, y } = own.places.e_r;
            let (xx, xy, yy) = (x.square(), x * y, y.square());
            sums.add(
                group * R::GROUP,
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
        let [radius, radial, azimuth, orbit, spin] = split_mut(side, row.first, row.balls);
        for (group, own) in self.groups.iter().enumerate() {
            let from = group * R::GROUP;
            let at_radius = R::load_group(radius, from);
            let turned = R::load_group(azimuth, from);
            let e_r = own.places.e_r;
            let e_t = e_r.turned();
            let pr = b.pocket_radius * own.inverse_radius;
            let (at_i, at_o) = (&own.inner, &own.outer);
            let q_i = at_i.pressing.stiffness * (e_r.dot(inner) - at_radius) + at_i.turn * turned;
            let q_o = at_o.pressing.stiffness * (at_radius - e_r.dot(outer)) + at_o.turn * turned;
            let q_p = own.pocket.stiffness * (turned - e_t.dot(outer) * own.inverse_radius - cage);

            let n = (b.mass * R::load_group(radial, from) + q_i - q_o) * own.inverse;
            let on_t = b.mass * R::load_group(orbit, from) * own.radius - pr * q_p;
            let on_s = constants.inertia[0] * R::load_group(spin, from);
            let t = own.inverse_tt * on_t + own.inverse_ts * on_s;
            let s = own.inverse_ts * on_t + own.inverse_ss * on_s;

            let pull_i = at_i.traction * (t - s);
            let pull_o = at_o.traction * (t + s);
            let on_inner =
                e_r * (at_i.pressing.damping * n - q_i) + e_t * (pull_i - at_i.force * turned);
            let wall = own.pocket.damping * t + q_p;
            let on_outer = e_r * (at_o.pressing.damping * n + q_o)
                + e_t * (pull_o + pr * wall + at_o.force * turned);
            let on_cage = wall + own.pocket_friction * s;
            sums.add(
                from,
                &[
                    on_inner.x, on_inner.y, pull_i, on_outer.x, on_outer.y, on_cage,
                ],
            );
            R::store_group(n, radial, from);
            R::store_group(t, orbit, from);
            R::store_group(s, spin, from);
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
        let [radius, radial, azimuth, orbit, spin] = split_mut(side, row.first, row.balls);
        for (group, own) in self.groups.iter().enumerate() {
            let from = group * R::GROUP;
            let e_r = own.places.e_r;
            let e_t = e_r.turned();
            let (at_i, at_o) = (&own.inner, &own.outer);
            let pull_i = at_i.traction * (e_t.dot(inner) + race_spin);
            let past_outer = e_t.dot(outer);
            let pull_o = at_o.traction * past_outer;
            let pr = b.pocket_radius * own.inverse_radius;
            let on_t = pull_i + pull_o + own.pocket.damping * (cage + pr * past_outer);
            let on_s = pull_o - pull_i + own.pocket_friction * cage;
            let pressed =
                at_i.pressing.damping * e_r.dot(inner) + at_o.pressing.damping * e_r.dot(outer);
            let n = R::load_group(radial, from) + pressed * own.inverse;
            let t = R::load_group(orbit, from) + (own.inverse_tt * on_t + own.inverse_ts * on_s);
            let s = R::load_group(spin, from) + (own.inverse_ts * on_t + own.inverse_ss * on_s);
            let orbit_speed = t * own.inverse_radius;
            let (r, angle) = (R::load_group(radius, from), R::load_group(azimuth, from));
            R::store_group((r + n) * inverse_g, radius, from);
            R::store_group(n, radial, from);
            R::store_group((angle + orbit_speed) * inverse_g, azimuth, from);
            R::store_group(orbit_speed, orbit, from);
            R::store_group(s * constants.inverse_radius, spin, from);
        }
    }

    /// Changes of the heats of pocket damping and of pocket friction along a vector over the bearing's own states.
    #[inline(always)]
    pub(super) fn heats_along(&self, row: &BallRow<R>, vector: &[R]) -> [R; 2] {
        let b = &row.ball;
        let cage = vector[1].grouped();
        let mut sums = BallSums::<R, 2>::new(row.balls);
        let [.., orbit, spin] = split(vector, row.first, row.balls);
        for (group, own) in self.groups.iter().enumerate() {
            let from = group * R::GROUP;
            let closing = b.pocket_radius * (R::load_group(orbit, from) - cage);
            sums.add(
                from,
                &[
                    own.damping_heat * closing,
                    own.friction_heat * (R::load_group(spin, from) - cage),
                ],
            );
        }
        sums.total()
    }
}

/// Stiffness and damping of a ball at a race; none where it does not press.
#[inline(always)]
fn contact<G: Real>(b: &BallConstants<G>, stiffness: G, approach: G, force: G) -> Pressing<G> {
    let zero = G::zero();
    let slope = G::splat(1.5) * stiffness * approach.max(zero).sqrt();
    let slope = G::select(force.greater(zero), slope, zero);
    Pressing {
        stiffness: slope,
        damping: slope * b.damping_time,
    }
}

/// ∂Q/∂θ of a contact whose race stands aside of the origin.
#[inline(always)]
fn turn<G: Real>(contact: &Pressing<G>, race: &RaceMotion<G>, e_r: Vec2<G>, orbit_speed: G) -> G {
    let e_t = e_r.turned();
    contact.stiffness * race.position.dot(e_t)
        + contact.damping * (race.velocity.dot(e_t) - race.position.dot(e_r) * orbit_speed)
}
