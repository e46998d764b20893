//! The bearing whose balls roll.
//!
//! ```text
//!   t_I = M(Ω, W) + J_I Ω̇          t_O = M(Ω, W) - J_O Ω̇          W = |Σ Q n|
//!   radial force: every ball a Hertz spring (both contacts in series) between the races
//!   ω_c = Ω/(2(1+s)),  s = r/R
//! ```
//! State: cage angle φ_c (rad). Cage and balls move with the outer race where they translate.
//! Ball loads are quasi-static: the outer load adds the centrifugal force of the ball.
//!
//! Assumes: no skid, no slip. Does not model: pocket contact, losses beyond the steady moment,
//! the effect of centrifugal force on stiffness.

use super::ball::gather_group;
use super::{BallSums, BearingEnergy, BearingHeat, BearingReaction, largest};
use crate::motion::{Motion, Wrench};
use number::{Gather, Real, Vec2, constants};
use physics::contact::{ball_race, ball_race_energy};
use physics::palmgren::Palmgren;

/// Number of states.
pub const STATES: usize = 1;

/// The steady friction moment M(Ω, W).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SteadyMoment<R> {
    /// None.
    None,
    /// Palmgren's law, continuous and odd in speed.
    Palmgren(Palmgren<R>),
    /// Palmgren's law as the source paper prints it, with its steps.
    PalmgrenPrinted(Palmgren<R>),
}

impl<R: Real> Gather<R> for SteadyMoment<f64> {
    type Out = SteadyMoment<R>;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> SteadyMoment<R>
    where
        Self: 'a,
    {
        let law = || {
            Gather::<R>::gather(&|lane| match machine(lane) {
                SteadyMoment::Palmgren(law) | SteadyMoment::PalmgrenPrinted(law) => law,
                SteadyMoment::None => panic!("lanes share the friction law"),
            })
        };
        match machine(0) {
            SteadyMoment::None => SteadyMoment::None,
            SteadyMoment::Palmgren(_) => SteadyMoment::Palmgren(law()),
            SteadyMoment::PalmgrenPrinted(_) => SteadyMoment::PalmgrenPrinted(law()),
        }
    }
}

constants! {
    /// What one rolling ball is made of.
    pub struct RollingBall {
        /// Stiffness of both contacts in series, N/m^1.5.
        series_stiffness: R,
        /// Contact damping time β, s.
        damping_time: R,
        /// Interference of the ball between concentric races, m; negative for clearance.
        interference: R,
        /// Ball mass times radius of its orbit, kg m: centrifugal force per ω_c².
        mass_radius: R,
    }
}

/// Constants of one rolling bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct RollingConstants {
    /// Number of balls.
    pub balls: usize,
    /// The ball.
    pub ball: RollingBall<f64>,
    /// Inertia J_I that balls and cage add at the inner race, kg m².
    pub inner_inertia: f64,
    /// Inertia J_O that balls and cage subtract at the outer race, kg m².
    pub outer_inertia: f64,
    /// Cage speed per inner race speed, 1/(2(1+s)).
    pub cage_ratio: f64,
    /// Radius of the circle of the ball centres, m.
    pub pitch_radius: f64,
    /// Mass of balls and cage, kg.
    pub mass_with_outer_race: f64,
    /// Azimuth of ball 1 at the start, rad.
    pub first_ball_angle: f64,
    /// The steady friction moment.
    pub moment: SteadyMoment<f64>,
}

/// The rolling bearing over `R`.
#[derive(Clone, Debug)]
pub struct Rolling<R: Real> {
    balls: usize,
    ball: RollingBall<R::Group>,
    inner_inertia: R,
    outer_inertia: R,
    cage_ratio: R,
    moment: SteadyMoment<R>,
    seats: Vec<R>,
}

impl<R: Real> Rolling<R> {
    /// One bearing per lane.
    pub(crate) fn gather<'a>(machine: &dyn Fn(usize) -> &'a RollingConstants) -> Self {
        let balls = Gather::<R>::gather(&|lane| &machine(lane).balls);
        Rolling {
            balls,
            ball: gather_group::<R, _>(&|lane| &machine(lane).ball),
            inner_inertia: R::from_lanes(|lane| machine(lane).inner_inertia),
            outer_inertia: R::from_lanes(|lane| machine(lane).outer_inertia),
            cage_ratio: R::from_lanes(|lane| machine(lane).cage_ratio),
            moment: SteadyMoment::gather(&|lane| &machine(lane).moment),
            seats: (0..balls)
                .map(|j| R::from_lanes(|lane| machine(lane).seat(j)))
                .collect(),
        }
    }

    /// Reaction to the motion of the races.
    #[inline(always)]
    pub(crate) fn react(
        &self,
        motion: &Motion<R>,
        state: &[R],
        rate: &mut [R],
        detail: &mut [R],
    ) -> BearingReaction<R> {
        let n = self.balls;
        let spin = motion.inner.spin - motion.outer.spin;
        let cage_speed = self.cage_ratio * spin + motion.outer.spin;
        rate[0] = cage_speed;
        let centrifugal = self.ball.mass_radius * cage_speed.square().grouped();
        let offset = motion.inner.position - motion.outer.position;
        let closing = motion.inner.velocity - motion.outer.velocity;
        let (offset, closing) = (
            Vec2::new(offset.x.grouped(), offset.y.grouped()),
            // as the balls see the races part: they turn with the cage
            Vec2::new(
                (closing.x + cage_speed * offset.y).grouped(),
                (closing.y - cage_speed * offset.x).grouped(),
            ),
        );
        let mut sums = BallSums::<R, 3>::new(n);
        let mut from = 0;
        while from < n {
            let azimuth = state[0].grouped() + R::load_group(&self.seats, from);
            let (sine, cosine) = azimuth.sin_cos();
            let direction = Vec2::new(cosine, sine);
            let approach_speed = closing.dot(direction);
            let load = ball_race(
                self.ball.series_stiffness,
                self.ball.damping_time,
                self.ball.interference + offset.dot(direction),
                approach_speed,
            );
            let push = direction * load.force;
            sums.add(
                from,
                &[push.x, push.y, (load.force - load.elastic) * approach_speed],
            );
            if !detail.is_empty() {
                R::store_group(load.force, &mut detail[..n], from);
                R::store_group(load.force + centrifugal, &mut detail[n..2 * n], from);
            }
            from += R::GROUP;
        }
        if !detail.is_empty() {
            detail[2 * n..]
                .iter_mut()
                .for_each(|value| *value = R::zero());
        }
        let [x, y, damping] = sums.total();
        let push = Vec2::new(x, y);
        let load = || push.length_squared().max(R::splat(1e-30)).sqrt();
        let moment = match &self.moment {
            SteadyMoment::None => R::zero(),
            SteadyMoment::Palmgren(law) => law.moment(spin, load()),
            SteadyMoment::PalmgrenPrinted(law) => law.printed_moment(spin, load()),
        };
        // the balls of eccentric races push past the centres: what turns them comes from the races in the shares of
        // their motion
        let turning = (motion.inner.position - motion.outer.position).cross(push);
        let by_inner = self.cage_ratio * turning;
        BearingReaction {
            on_inner: Wrench::planar(-push, by_inner - moment),
            on_outer: Wrench::planar(push, turning - by_inner + moment),
            inner_inertia: self.inner_inertia,
            outer_inertia: self.outer_inertia,
            external_moment: R::zero(),
            heat: BearingHeat {
                inner_damping: damping,
                outer_damping: R::zero(),
                inner_sliding: R::zero(),
                outer_sliding: R::zero(),
                drag: R::zero(),
                pocket_damping: R::zero(),
                pocket_sliding: R::zero(),
                steady_moment: moment * spin,
            },
            largest_inner_load: largest(detail, n, 0),
            largest_outer_load: largest(detail, n, 1),
        }
    }
}

impl RollingConstants {
    /// Angle of a ball on the cage, rad.
    pub fn seat(&self, ball: usize) -> f64 {
        2.0 * std::f64::consts::PI * ball as f64 / self.balls as f64
    }
    pub(super) fn rest(&self, state: &mut [f64]) {
        state[0] = self.first_ball_angle;
    }
    pub(super) fn energy(&self, motion: &Motion<f64>, state: &[f64]) -> BearingEnergy {
        let spin = motion.inner.spin - motion.outer.spin;
        let offset = motion.inner.position - motion.outer.position;
        let elastic = (0..self.balls)
            .map(|j| {
                let (sine, cosine) = (state[0] + self.seat(j)).sin_cos();
                let approach = self.ball.interference + offset.dot(Vec2::new(cosine, sine));
                ball_race_energy(self.ball.series_stiffness, approach)
            })
            .sum();
        BearingEnergy {
            // balls and cage: ½ J_I Ω²; their translation with the outer race is the system's
            translation: 0.0,
            spin: 0.5 * self.inner_inertia * spin * spin,
            elastic,
            weight: 0.0,
            angular_momentum: (self.inner_inertia + self.outer_inertia) * spin,
        }
    }
}
