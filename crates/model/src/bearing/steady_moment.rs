//! The steady friction moment ball by ball: three pairs, each equal and opposite, none to the ground.
//!
//! ```text
//!   M = M0(Ω) + M1(W): the law's speed-dependent and load-dependent part.   s = r/R,  σ ball spin counter-clockwise
//!   v_t ball past the outer ring along t, d = |b - c_o|;  all speeds against the outer ring
//!
//!   orbit drag       f   = λ 2χ_o/(N R) M0(2(1+s) v_t/d)             on the ball -f t, on the outer ring +f t at the ball
//!   spin couple      m_s = λ 2sχ_s/N M0(2sσ)                         on the ball -m_s, on the outer ring +m_s
//!   rolling couples  m_i = λ s/(1+s) M1 Q_i/ΣQ_i tanh((σ-Ω)/ω_r)     on the ball -m_i, on the inner race +m_i
//!                    m_o = λ s/(1+s) M1 Q_o/ΣQ_o tanh(σ/ω_r)         on the ball -m_o, on the outer ring +m_o
//! ```
//! The outer ring holds the lubricant. χ_o + χ_s = 1. W = |Σ Q_i n|. M0 is odd, so each pair opposes its motion and the
//! heat f v_t + m_s σ + m_i (σ-Ω) + m_o σ is never negative.
//!
//! Why these arms. In a steady run the balls roll: v_t/d = Ω/(2(1+s)), σ = -Ω/(2s). The pairs then take the powers
//! χ_o M0 Ω, χ_s M0 Ω, M1 Ω (1+2s)/(2(1+s)) and M1 Ω/(2(1+s)): together M Ω, so statics gives t_I = t_O = M.
//! A drag to the ground could not: the outer ring would not feel it.
//!
//! What the balls lose otherwise (creep, pockets) is in a measured M already: λ takes it out, see
//! [`moment_scale`](crate::system::spin_up::moment_scale).
//!
//! Assumes: χ_o (½ where nothing is known), and that all balls share M0 equally whatever their load.
//! Does not model: drag on the cage and its lands; the flow that carries lubricant around; the moment at standstill.

use super::ball::{BallMotion, RaceMotion};
use number::{Gather, Real};
pub use physics::friction::Friction as SteadyMoment;

/// Speed at which the load-dependent part is taken where the race turns more slowly, rad/s: its sign is that of the
/// couples, not of the race, and the laws fade at a tenth of this.
const LEAST_SPEED: f64 = 1.0;

/// Constants of the steady moment of a bearing computed ball by ball.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedMoment {
    /// The law M(Ω, W, axial load).
    pub law: SteadyMoment<f64>,
    /// Axial load that the law sees, N.
    pub axial_load: f64,
    /// Share χ_o of M0 that drags on the orbit; the rest, χ_s, on the spin. ½ is assumed where nothing is known.
    pub orbit_share: f64,
    /// Speed ω_r of rolling at which the rolling couples reach 76 %, rad/s; 1 rad/s serves.
    pub reference_spin: f64,
    /// Scale λ of the law: 1 less what the bearing loses otherwise.
    pub scale: f64,
}

impl SharedMoment {
    /// True where the share lies in 0 to 1 and scale and reference spin are positive.
    pub fn is_valid(&self) -> bool {
        let share = |x: f64| (0.0..=1.0).contains(&x);
        share(self.orbit_share) && self.scale > 0.0 && self.reference_spin > 0.0
    }
}

/// The pairs of one bearing over `R`.
#[derive(Clone, Debug)]
pub(super) struct MomentPairs<R: Real> {
    /// For the moment of the whole bearing.
    law: SteadyMoment<R>,
    /// The same, for several balls at a time.
    of_ball: SteadyMoment<R::Group>,
    axial_load: R,
    /// λ s/(1+s).
    rolling_arm: R,
    arms: Arms<R::Group>,
}

number::constants! {
    /// What turns the law into forces and couples on a ball.
    pub struct Arms {
        /// λ 2χ_o/(N R), 1/m.
        orbit: R,
        /// 2(1+s).
        orbit_speed: R,
        /// λ 2sχ_s/N.
        spin: R,
        /// 2s.
        spin_speed: R,
        /// 1/ω_r, s/rad.
        inverse_reference_spin: R,
    }
}

/// Geometry that the pairs need.
#[derive(Clone, Copy, Debug)]
pub(super) struct Geometry {
    /// Number of balls.
    pub balls: usize,
    /// Ball radius, m.
    pub ball_radius: f64,
    /// Radius of the inner track, m.
    pub inner_track: f64,
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
            let (
                Geometry {
                    balls,
                    ball_radius,
                    inner_track,
                },
                m,
            ) = (machine(lane).0, moment(lane));
            let (n, s) = (balls as f64, ball_radius / inner_track);
            Arms {
                orbit: m.scale * 2.0 * m.orbit_share / (n * inner_track),
                orbit_speed: 2.0 * (1.0 + s),
                spin: m.scale * 2.0 * s * (1.0 - m.orbit_share) / n,
                spin_speed: 2.0 * s,
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
                let s = machine(lane).0.ball_radius / machine(lane).0.inner_track;
                moment(lane).scale * s / (1.0 + s)
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

    /// What the balls share at this speed of the inner race against the outer and these loads: radial W, ΣQ_i, ΣQ_o.
    #[inline(always)]
    pub fn share(
        &self,
        speed: R,
        load: R,
        inner_sum: R,
        outer_sum: R,
    ) -> PairsOfBall<'_, R::Group> {
        // without any load nothing is shared: the quotient is of zeros
        let least = R::splat(1e-30);
        let magnitude = speed.abs().max(R::splat(LEAST_SPEED));
        let parts = self.law.parts(magnitude, load, self.axial_load);
        let couple = self.rolling_arm * parts.load_dependent;
        PairsOfBall {
            law: &self.of_ball,
            arms: &self.arms,
            load: load.grouped(),
            axial_load: self.axial_load.grouped(),
            inner_couple: (couple / inner_sum.max(least)).grouped(),
            outer_couple: (couple / outer_sum.max(least)).grouped(),
        }
    }

    /// The law's moment at this speed and load, N m, as if nothing else made friction.
    #[inline(always)]
    pub fn moment(&self, speed: R, load: R) -> R {
        self.law.moment(speed, load, self.axial_load)
    }
}

/// The part of the steady moment that one ball feels, or nothing: chosen once a call, not once a ball.
pub trait BallMoment<R: Real> {
    /// False where there is nothing: then nothing is computed.
    const PRESENT: bool;
    /// The pairs of a ball: its speed past the outer ring along t, its distance from the ring's centre, its loads.
    fn pairs(
        &self,
        inner: &RaceMotion<R>,
        outer: &RaceMotion<R>,
        ball: &BallMotion<R>,
        place: &BallPlace<R>,
    ) -> BallPairs<R>;
}

/// Where a ball stands between its races.
#[derive(Clone, Copy, Debug)]
pub struct BallPlace<R> {
    /// Speed of its centre past that of the outer race along t, m/s.
    pub past_outer: R,
    /// Distance from the outer race's centre, m.
    pub distance: R,
    /// 1/distance, 1/m.
    pub inverse_distance: R,
    /// Load at the inner race, N.
    pub inner_load: R,
    /// Load at the outer race, N.
    pub outer_load: R,
}

/// The pairs of one ball, each against the motion.
#[derive(Clone, Copy, Debug)]
pub struct BallPairs<R> {
    /// Drag f against its motion along t, on the outer ring the opposite, N.
    pub orbit_drag: R,
    /// Couple against its rotation on the inner race, on the race the opposite, N m.
    pub inner_couple: R,
    /// Couples against its rotation in the outer ring, on the ring the opposite, N m.
    pub outer_couple: R,
    /// Heat, W.
    pub heat: R,
}

/// No steady moment.
#[derive(Clone, Copy, Debug)]
pub struct NoMoment;

impl<R: Real> BallMoment<R> for NoMoment {
    const PRESENT: bool = false;
    #[inline(always)]
    fn pairs(
        &self,
        _inner: &RaceMotion<R>,
        _outer: &RaceMotion<R>,
        _ball: &BallMotion<R>,
        _place: &BallPlace<R>,
    ) -> BallPairs<R> {
        let zero = R::zero();
        BallPairs {
            orbit_drag: zero,
            inner_couple: zero,
            outer_couple: zero,
            heat: zero,
        }
    }
}

/// The steady moment of several balls at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct PairsOfBall<'a, R> {
    law: &'a SteadyMoment<R>,
    arms: &'a Arms<R>,
    load: R,
    axial_load: R,
    /// λ s/(1+s) M1/ΣQ_i, m.
    inner_couple: R,
    /// λ s/(1+s) M1/ΣQ_o, m.
    outer_couple: R,
}

impl<R: Real> PairsOfBall<'_, R> {
    /// M0 at a speed of the inner race.
    #[inline(always)]
    fn m0(&self, speed: R) -> R {
        let parts = self.law.parts(speed, self.load, self.axial_load);
        parts.speed_dependent
    }
}

impl<R: Real> BallMoment<R> for PairsOfBall<'_, R> {
    const PRESENT: bool = true;
    #[inline(always)]
    fn pairs(
        &self,
        inner: &RaceMotion<R>,
        outer: &RaceMotion<R>,
        ball: &BallMotion<R>,
        place: &BallPlace<R>,
    ) -> BallPairs<R> {
        let a = self.arms;
        let past = place.past_outer - outer.spin * place.distance;
        let on_outer = ball.spin - outer.spin;
        let on_inner = ball.spin - inner.spin;
        let orbit_drag = a.orbit * self.m0(a.orbit_speed * (past * place.inverse_distance));
        let spin = a.spin * self.m0(a.spin_speed * on_outer);
        let (rolls_inner, rolls_outer) =
            (on_inner * a.inverse_reference_spin).tanh_pair(on_outer * a.inverse_reference_spin);
        let inner_couple = self.inner_couple * place.inner_load * rolls_inner;
        let outer_couple = self.outer_couple * place.outer_load * rolls_outer + spin;
        BallPairs {
            orbit_drag,
            inner_couple,
            outer_couple,
            heat: orbit_drag * past + inner_couple * on_inner + outer_couple * on_outer,
        }
    }
}
