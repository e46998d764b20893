//! Rolling resistance of the oil in the inlets: a couple at each loaded contact, equal and opposite on ball and race.
//!
//! ```text
//!   rotation of the ball against the race    inner  w = σ - ω_i         outer  w = σ - ω_o
//!   on the ball  m = -2 F R_x φ sgn(R_x w)   on the race  -m            heat  -m w ≥ 0
//! ```
//! F(Q, v), R_x and the smooth sign are the law's: [`inlet_rolling`](physics::inlet_rolling). F knows the entrainment v, which
//! drags the oil in; the couple opposes the rotation of ball against race, which in pure rolling is v/R_x. So it is passive where
//! balls skid as well, and surfaces that run against each other, v near zero, hardly have it.
//!
//! Contacts at an angle α: the couple lies along the axis of rolling, of which the plane sees the share cos α, as it sees that
//! share of the rotation.
//!
//! A steady friction moment was measured with this resistance: with one there are no couples here.
//!
//! Added to the sums over the balls only where oil is: other bearings pay nothing.
//!
//! Does not model: what the source leaves out besides, see the law's page.

use super::ball::{BallConstants, BallMotion, RaceMotion, gather_group};
use super::ball_states::{BallRow, add, distances, load_ball, race, split, split_mut};
use super::ball_sums::BallSums;
use super::planar_constants::PlanarConstants;
use super::reaction::BearingReaction;
use super::steady_moment::SteadyMoment;
use crate::motion::Motion;
use number::{Real, Vectorized};
use physics::inlet_rolling::ResistanceAtRaces;

/// The couples of one bearing over `R`.
#[derive(Clone, Debug)]
pub(super) struct InletCouples<R: Real> {
    law: ResistanceAtRaces<R::Group>,
    /// cos α.
    cosine: R::Group,
}

/// The couples of one ball.
#[derive(Clone, Copy, Debug)]
struct CouplesOfBall<R> {
    /// On the ball by the inner race, N m.
    inner: R,
    /// On the ball by the outer race, N m.
    outer: R,
    /// Heat, W.
    heat: R,
}

impl PlanarConstants {
    /// The rolling resistance of the inlets that counts: none beside a steady moment.
    pub fn resisting_inlets(&self) -> Option<&ResistanceAtRaces<f64>> {
        let held = (self.moment.as_ref()).is_some_and(|moment| moment.law != SteadyMoment::None);
        self.inlet_rolling.as_ref().filter(|_| !held)
    }
}

impl<R: Real> InletCouples<R> {
    /// The couples of one bearing per lane; none where there is no oil, or a steady moment.
    pub fn gather<'a>(machine: &dyn Fn(usize) -> &'a PlanarConstants) -> Option<Self> {
        machine(0).resisting_inlets()?;
        let cosine = |lane: usize| {
            let ball = &machine(lane % R::LANES).ball;
            ball.radius / ball.ball_radius
        };
        Some(InletCouples {
            law: gather_group::<R, _>(&|lane| match machine(lane).resisting_inlets() {
                Some(law) => law,
                None => panic!("lanes share whether oil resists rolling"),
            }),
            cosine: <R::Group as Real>::from_lanes(cosine),
        })
    }

    /// The couples of several balls.
    #[inline(always)]
    fn of_ball(
        &self,
        constants: &BallConstants<R::Group>,
        inner: &RaceMotion<R::Group>,
        outer: &RaceMotion<R::Group>,
        ball: &BallMotion<R::Group>,
    ) -> CouplesOfBall<R::Group> {
        let place = constants.between(inner, outer, ball, &distances(inner, outer, ball));
        let at_inner = constants.on_inner(&place.inner, inner.spin, ball.spin);
        let at_outer = constants.on_outer(&place.outer, outer.spin, ball.spin);
        let on_inner = self.cosine * (ball.spin - inner.spin);
        let on_outer = self.cosine * (ball.spin - outer.spin);
        let by_inner = self.law.inner.couple(&at_inner.contact, on_inner);
        let by_outer = self.law.outer.couple(&at_outer.contact, on_outer);
        CouplesOfBall {
            inner: self.cosine * by_inner,
            outer: self.cosine * by_outer,
            heat: -(by_inner * on_inner) - by_outer * on_outer,
        }
    }
}

/// The couples of all balls as a task: it is compiled once for all systems.
pub(super) struct Act<'a, R: Real> {
    pub row: &'a BallRow<R>,
    pub couples: &'a InletCouples<R>,
    pub motion: &'a Motion<R>,
    pub state: &'a [R],
    pub rate: &'a mut [R],
    pub reaction: &'a mut BearingReaction<R>,
}

impl<R: Real> Vectorized for Act<'_, R> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let BallRow { balls, first, ball } = self.row;
        let (inner, outer) = (race(&self.motion.inner), race(&self.motion.outer));
        let lists = split(self.state, *first, *balls);
        let [.., d_spin] = split_mut(self.rate, *first, *balls);
        let mut sums = BallSums::<R, 3>::new(*balls);
        let mut from = 0;
        while from < *balls {
            let moving = load_ball(&lists, from);
            let by = self.couples.of_ball(ball, &inner, &outer, &moving);
            add(d_spin, from, (by.inner + by.outer) * ball.inverse_inertia);
            sums.add(from, &[by.inner, by.outer, by.heat]);
            from += R::GROUP;
        }
        let [by_inner, by_outer, heat] = sums.total();
        self.reaction.on_inner.moment -= by_inner;
        self.reaction.on_outer.moment -= by_outer;
        self.reaction.heat.inlet_rolling = heat;
    }
}
