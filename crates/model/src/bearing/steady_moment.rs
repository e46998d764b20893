//! The steady friction moment ball by ball: three pairs, each equal and opposite, none to the ground.
//!
//! ```text
//!   M = M0(Ω) + M1(W): the law's speed-dependent and load-dependent part.   s = r/R,  σ ball spin counter-clockwise
//!   v_t ball past the outer ring along t, d = |b - c_o|;  all speeds against the outer ring
//!
//!   orbit drag       f   = w 2χ_o/R M0(2(1+s) v_t/d)               on the ball -f t, on the outer ring +f t at the ball
//!   spin couple      m_s = w 2sχ_s M0(2sσ)                         on the ball -m_s, on the outer ring +m_s
//!   rolling couples  m_i = w s/(1+s) M1 tanh((σ-Ω)/ω_r)            on the ball -m_i, on the inner race +m_i
//!                    m_o = w s/(1+s) M1 tanh(σ/ω_r)                on the ball -m_o, on the outer ring +m_o
//!   share            w   = (Q_i + q)/(ΣQ_i + N q),  q = κ M/(N R),  κ = 0.1;  Σw = 1
//! ```
//! In space the same, see [`crate::spatial`]: there s = r cos α/R, and r/R stands for the first s of m_s and of m_i, m_o and for that
//! beside σ. The outer ring holds the lubricant. χ_o + χ_s = 1. W = |Σ Q_i n|.  M0 is odd
//! and w positive, so each pair opposes its motion and the heat f v_t + m_s σ + m_i (σ-Ω) + m_o σ is never negative.
//!
//! Why these arms. A ball that gains neither orbit nor spin needs T_i = ½[f + (m_i + m_o + m_s)/r] at the inner race, so its
//! share of t_I is ½R f + (m_o + m_s)/(2s) + m_i (1+2s)/(2s): with rolling balls, |v_t|/d = Ω/(2(1+s)) and |σ| = Ω/(2s), the sum
//! is M Σw = M, and t_O = t_I. Creep takes its power out of that of the pairs, whose balls turn a little more slowly: it
//! does not count twice. A drag to the ground could not do so: the outer ring would not feel it.
//!
//! Why this share. Only a ball pressed on the inner race can be turned against its pairs. With equal shares the unloaded balls
//! lose their spin, their M0 fades, and t_I falls below M by up to a quarter at low speed. With w ∝ Q_i every pressed ball
//! needs the same fraction of its traction, T_i/(μ Q_i) = M/(μ R ΣQ_i): all roll, or all skid. A bearing without load
//! shares equally, as does one whose balls are loaded alike.
//!
//! A lubricant with a slow state multiplies M0 by its drag factor D, in all three places at once: see
//! [`lubricant_state`](super::lubricant_state).
//!
//! What balls lose in pockets, on a land and on each other while they accelerate adds to M, as the loss F of the source paper
//! does. In a steady run pressed balls push the others through the cage with next to nothing, and what is left of it is small.
//!
//! Assumes: χ_o (½ where nothing is known), and that M is shared by the load.
//! Does not model: drag on the cage and its lands; the flow that carries lubricant around; the moment at standstill.

use super::ball_states::{BallRow, kept_distances, load_ball, race, split};
use super::ball_sums::BallSums;
use super::reaction::BearingReaction;
use crate::motion::Motion;
use number::{Gather, Real, Vec2, Vectorized};
pub use physics::friction::Friction as SteadyMoment;

/// Speed at which the load-dependent part is taken where the race turns more slowly, rad/s: its sign is that of the
/// couples, not of the race, and the laws fade at a tenth of this.
const LEAST_SPEED: f64 = 1.0;

/// κ: a ball with less load than q = κ M/(N R) counts as not pressed; to carry an equal share there traction would need a
/// coefficient of 1/κ. Wherever a bearing can roll, R ΣQ_i > M/μ, its balls without load take N q/ΣQ_i < κ μ of M: 1 % and less.
/// It keeps shares smooth where loads begin, and equal where there are none.
const IDLE_LOAD: f64 = 0.1;

/// Constants of the steady moment of a bearing computed ball by ball.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedMoment {
    /// The law M(Ω, W, axial load).
    pub law: SteadyMoment<f64>,
    /// Axial load that the law sees besides what loads its balls along the axis, N.
    pub axial_load: f64,
    /// Share χ_o of M0 that drags on the orbit; the rest, χ_s, on the spin. ½ is assumed where nothing is known.
    pub orbit_share: f64,
    /// Speed ω_r of rolling at which the rolling couples reach 76 %, rad/s; 1 rad/s serves.
    pub reference_spin: f64,
}

impl SharedMoment {
    /// True where the share lies in 0 to 1 and the reference spin is positive.
    pub fn is_valid(&self) -> bool {
        let share = |x: f64| (0.0..=1.0).contains(&x);
        share(self.orbit_share) && self.reference_spin > 0.0
    }
}

/// The pairs of one bearing, or of a row in space, over `R`.
#[derive(Clone, Debug)]
pub(crate) struct MomentPairs<R: Real> {
    /// For the moment of the whole bearing.
    law: SteadyMoment<R>,
    /// The same, for several balls at a time.
    of_ball: SteadyMoment<R::Group>,
    axial_load: R,
    /// (r/R)/(1+s).
    rolling_arm: R,
    /// N.
    balls: R,
    /// κ/(N R), 1/m.
    idle_load: R,
    arms: Arms<R::Group>,
}

number::constants! {
    /// What turns the law into forces and couples on a ball.
    pub struct Arms {
        /// 2χ_o/R, 1/m.
        orbit: R,
        /// 2(1+s).
        orbit_speed: R,
        /// 2χ_s r/R.
        spin: R,
        /// 2r/R.
        spin_speed: R,
        /// 1/ω_r, s/rad.
        inverse_reference_spin: R,
    }
}

/// Geometry that the pairs need.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Geometry {
    /// Number of balls.
    pub balls: usize,
    /// Ball radius r, m.
    pub ball_radius: f64,
    /// Radius R of the inner track where the balls touch it, m.
    pub inner_track: f64,
    /// cos α of the contact angle; 1 in the plane, where r is the ball's radius there.
    pub contact_cosine: f64,
}

impl Geometry {
    /// s = r cos α/R: orbit speed is Ω/(2(1+s)).
    fn ratio(&self) -> f64 {
        self.contact_cosine * self.turns()
    }
    /// r/R: the ball rolls on the outer race at Ω R/(2r).
    fn turns(&self) -> f64 {
        self.ball_radius / self.inner_track
    }
}

/// What loads the balls, and what their contacts resist by themselves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Loads<R> {
    /// Radial load W, N.
    pub radial: R,
    /// Axial load besides the given one, N.
    pub axial: R,
    /// ΣQ_i, N.
    pub inner_sum: R,
    /// What the contacts make by spin and curvature, which the law contains, N m: a part of M1, of a measured curve of all of it.
    pub by_contacts: R,
}

impl<R: Real> MomentPairs<R> {
    /// The pairs of one bearing per lane; none where there is no moment.
    pub fn gather<'a>(
        machine: &dyn Fn(usize) -> (Geometry, Option<&'a SharedMoment>),
    ) -> Option<Self> {
        let present = |lane: usize| {
            let moment = machine(lane).1;
            moment.filter(|moment| moment.law != SteadyMoment::None)
        };
        let any = present(0).is_some();
        for lane in 1..R::LANES {
            let same = present(lane).is_some() == any;
            assert!(same, "lanes share the presence of a steady moment");
        }
        if !any {
            return None;
        }
        let moment = |lane: usize| present(lane).expect("lanes share it");
        let arms = |lane: usize| {
            let (geometry, m) = (machine(lane).0, moment(lane));
            let turns = geometry.turns();
            Arms {
                orbit: 2.0 * m.orbit_share / geometry.inner_track,
                orbit_speed: 2.0 * (1.0 + geometry.ratio()),
                spin: 2.0 * turns * (1.0 - m.orbit_share),
                spin_speed: 2.0 * turns,
                inverse_reference_spin: 1.0 / m.reference_spin,
            }
        };
        let part = |part: &dyn Fn(Arms<f64>) -> f64| {
            <R::Group as Real>::from_lanes(|i| part(arms(i % R::LANES)))
        };
        Some(MomentPairs {
            law: Gather::<R>::gather(&|lane| &moment(lane).law),
            of_ball: super::ball::gather_group::<R, _>(&|lane| &moment(lane).law),
            axial_load: R::from_lanes(|lane| moment(lane).axial_load),
            rolling_arm: R::from_lanes(|lane| {
                let geometry = machine(lane).0;
                geometry.turns() / (1.0 + geometry.ratio())
            }),
            balls: R::from_lanes(|lane| machine(lane).0.balls as f64),
            idle_load: R::from_lanes(|lane| {
                let geometry = machine(lane).0;
                IDLE_LOAD / (geometry.balls as f64 * geometry.inner_track)
            }),
            arms: Arms {
                orbit: part(&|arms| arms.orbit),
                orbit_speed: part(&|arms| arms.orbit_speed),
                spin: part(&|arms| arms.spin),
                spin_speed: part(&|arms| arms.spin_speed),
                inverse_reference_spin: part(&|arms| arms.inverse_reference_spin),
            },
        })
    }

    /// What the balls share at this speed of the inner race against the outer, these loads, and a drag factor D of the lubricant.
    #[inline(always)]
    pub fn share(&self, speed: R, loads: &Loads<R>, drag_factor: R) -> PairsOfBall<'_, R> {
        let limit = R::splat(LEAST_SPEED);
        let (load, inner_sum) = (loads.radial, loads.inner_sum);
        let axial_load = self.axial_load + loads.axial;
        let mut parts = (self.law).parts(speed.abs().max(limit), load, axial_load);
        let mut drag_factor = drag_factor;
        if let SteadyMoment::Curve(_) = self.law {
            let left = (parts.speed_dependent - loads.by_contacts).max(R::zero());
            drag_factor = drag_factor * left / parts.speed_dependent.max(R::splat(1e-30));
        } else {
            parts.load_dependent = (parts.load_dependent - loads.by_contacts).max(R::zero());
        }
        let idle_load = self.idle_load * parts.sum();
        // without load and moment nothing is shared: the quotient is of zeros
        let per_load = (inner_sum + self.balls * idle_load)
            .max(R::splat(1e-30))
            .recip();
        let direction = speed.max(-limit).min(limit) * limit.recip();
        let drag = drag_factor.grouped();
        PairsOfBall {
            law: &self.of_ball,
            arms: Arms {
                orbit: self.arms.orbit * drag,
                spin: self.arms.spin * drag,
                ..self.arms
            },
            load: load.grouped(),
            axial_load: axial_load.grouped(),
            per_load: per_load.grouped(),
            idle_share: (idle_load * per_load).grouped(),
            rolling: (self.rolling_arm * parts.load_dependent).grouped(),
            moment: parts.with_drag(drag_factor).sum() * direction,
        }
    }
}

/// Where a ball stands between its races; speeds against the outer ring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BallPlace<R> {
    /// Speed of its centre past the outer ring along t, m/s.
    pub past: R,
    /// 1/(distance from the outer race's centre), 1/m.
    pub inverse_distance: R,
    /// Spin against the inner race, rad/s.
    pub on_inner: R,
    /// Spin against the outer race, rad/s.
    pub on_outer: R,
    /// Load at the inner race, N.
    pub inner_load: R,
}

/// The pairs of one ball, each against the motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BallPairs<R> {
    /// Drag f against its motion along t, on the outer ring the opposite, N.
    pub orbit_drag: R,
    /// Couple against its rotation on the inner race, on the race the opposite, N m.
    pub inner_couple: R,
    /// Couples against its rotation in the outer ring, on the ring the opposite, N m.
    pub outer_couple: R,
    /// Heat, W.
    pub heat: R,
}

/// The steady moment at one instant, ready for the balls.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairsOfBall<'a, R: Real> {
    law: &'a SteadyMoment<R::Group>,
    /// With the drag factor.
    arms: Arms<R::Group>,
    load: R::Group,
    axial_load: R::Group,
    /// 1/(ΣQ_i + N q), 1/N.
    per_load: R::Group,
    /// q/(ΣQ_i + N q).
    idle_share: R::Group,
    /// s/(1+s) M1, N m.
    rolling: R::Group,
    /// The law's moment M at this speed, load and drag factor, as if nothing else made friction, N m; below 1 rad/s proportional to
    /// the speed.
    pub moment: R,
}

impl<R: Real> PairsOfBall<'_, R> {
    /// The pairs of several balls.
    #[inline(always)]
    pub fn pairs(&self, ball: &BallPlace<R::Group>) -> BallPairs<R::Group> {
        let a = &self.arms;
        let speeds = [
            a.orbit_speed * (ball.past * ball.inverse_distance),
            a.spin_speed * ball.on_outer,
        ];
        // the law stands once in the compiled code: it is large
        let mut m0 = speeds;
        for value in &mut m0 {
            let parts = self.law.parts(*value, self.load, self.axial_load);
            *value = parts.speed_dependent;
        }
        let share = ball.inner_load * self.per_load + self.idle_share;
        let orbit_drag = share * a.orbit * m0[0];
        let rolls_inner = (ball.on_inner * a.inverse_reference_spin).tanh_far_out();
        let rolls_outer = (ball.on_outer * a.inverse_reference_spin).tanh_far_out();
        let inner_couple = share * self.rolling * rolls_inner;
        let outer_couple = share * (self.rolling * rolls_outer + a.spin * m0[1]);
        BallPairs {
            orbit_drag,
            inner_couple,
            outer_couple,
            heat: orbit_drag * ball.past
                + inner_couple * ball.on_inner
                + outer_couple * ball.on_outer,
        }
    }
}

/// What the pairs do besides slowing the balls: moments on the races about their centres, N m, and heat, W.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shared<R> {
    on_inner: R,
    on_outer: R,
    heat: R,
    moment: R,
}

impl<R: Real> Shared<R> {
    /// Adds it to a reaction, whose force on the outer race has the drag already.
    #[inline(always)]
    pub fn add_to(&self, reaction: &mut BearingReaction<R>) {
        reaction.on_inner.moment += self.on_inner;
        reaction.on_outer.moment += self.on_outer;
        reaction.heat.steady_moment = self.heat;
        reaction.steady_moment = self.moment;
    }
}

/// What the balls share, as a task: it is compiled once for all systems and traction laws. It leaves drag and couple of all
/// balls, one list after the other, in `slowing`.
pub(super) struct Share<'a, R: Real> {
    pub row: &'a BallRow<R>,
    pub pairs: &'a MomentPairs<R>,
    pub motion: &'a Motion<R>,
    pub held_load: R,
    pub drag_factor: R,
    pub state: &'a [R],
    /// As [`Places`](super::ball_states::Places) leaves it.
    pub kept: &'a [R],
    pub slowing: &'a mut [R],
}

impl<R: Real> Vectorized for Share<'_, R> {
    type Output = Shared<R>;
    #[inline(always)]
    fn run(self) -> Shared<R> {
        let Share { row, motion, .. } = self;
        let n = row.balls;
        let speed = motion.inner.spin - motion.outer.spin;
        let lists = split(self.state, row.first, n);
        let kept = split(self.kept, row.first, n);
        let (drags, couples) = self.slowing.split_at_mut(n);
        let (inner, outer) = (race(&motion.inner), race(&motion.outer));

        // ΣQ_i n and ΣQ_i; each Q_i stands for a while where the drag will
        let mut sums = BallSums::<R, 3>::new(n);
        let mut from = 0;
        while from < n {
            let (ball, distances) = (load_ball(&lists, from), kept_distances(&kept, from));
            let at = row.ball.between(&inner, &outer, &ball, &distances).inner;
            let push = at.n * at.normal.force;
            R::store_group(at.normal.force, drags, from);
            sums.add(from, &[push.x, push.y, at.normal.force]);
            from += R::GROUP;
        }
        let [x, y, inner_sum] = sums.total();
        let load = Vec2::new(x, y).length_squared().sqrt() + self.held_load;
        let loads = Loads {
            radial: load,
            axial: R::zero(),
            inner_sum,
            by_contacts: R::zero(),
        };
        let shared = (self.pairs).share(speed, &loads, self.drag_factor);

        let mut sums = BallSums::<R, 3>::new(n);
        let mut from = 0;
        while from < n {
            let (ball, distances) = (load_ball(&lists, from), kept_distances(&kept, from));
            let at = row.ball.between(&inner, &outer, &ball, &distances).outer;
            let p = shared.pairs(&BallPlace {
                past: at.past.dot(at.n.turned()) - outer.spin * at.distance,
                inverse_distance: at.inverse_distance,
                on_inner: ball.spin - inner.spin,
                on_outer: ball.spin - outer.spin,
                inner_load: R::load_group(drags, from),
            });
            R::store_group(p.orbit_drag, drags, from);
            R::store_group(p.inner_couple + p.outer_couple, couples, from);
            let on_outer = p.orbit_drag * at.distance + p.outer_couple;
            sums.add(from, &[p.inner_couple, on_outer, p.heat]);
            from += R::GROUP;
        }
        let [on_inner, on_outer, heat] = sums.total();
        Shared {
            on_inner,
            on_outer,
            heat,
            moment: shared.moment,
        }
    }
}
