//! The bearing whose balls roll.
//!
//! ```text
//!   t_I = M(Ω, W) + J_I Ω̇ + arm F       t_O = M(Ω, W) - J_O Ω̇ + arm F       W = |Σ Q n|
//!   F = F0(Ω) + F1(Ω)|Ω̇|: the pockets brake the balls, see [`acceleration_loss`](super::acceleration_loss)
//!   radial force: every ball a Hertz spring (both contacts in series) between the races
//!   ω_c = Ω/(2(1+s)),  s = r/R
//! ```
//! State: cage angle φ_c (rad), then those of the lubricant where it has any
//! ([`lubricant_state`]). Cage and balls move with the outer race where they translate.
//! Ball loads are quasi-static: the outer load adds the centrifugal force of the ball.
//!
//! The inner race grows with its own speed: its track's radius by kΩ².
//!
//! Assumes: no skid, no slip. Does not model: pocket contact, losses beyond M and F,
//! the effect of centrifugal force on stiffness.

use super::acceleration_loss::{AccelerationLoss, Loss};
use super::ball::gather_group;
use super::ball_states::{direction, seat, seats};
use super::ball_sums::{BallSums, largest};
use super::lubricant_state::{self, Lubricant, LubricantConstants};
use super::planar_constants::PlanarConstants;
use super::reaction::{BearingEnergy, BearingHeat, BearingReaction};
use super::steady_moment::SteadyMoment;
use crate::motion::{Motion, Wrench};
use number::{Gather, Real, Vec2, constants};
use physics::contact::{ball_race, ball_race_energy};
use physics::rolling::RollingSet;
use physics::traction::SlidingContact;

/// Number of states, without those of a lubricant.
pub const STATES: usize = 1;

constants! {
    /// What one rolling ball is made of.
    pub struct RollingBall {
        /// Stiffness of both contacts in series, N/m^1.5.
        series_stiffness: R,
        /// Contact load over its radial part, 1/cos α.
        load_per_radial_force: R,
        /// Contact damping time β, s.
        damping_time: R,
        /// Interference of the ball between concentric races at rest, m; negative for clearance.
        interference: R,
        /// Growth k of the inner track's radius with the square of its speed, m s².
        inner_track_growth: R,
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
    /// Masses and radii of balls and cage, as they turn.
    pub set: RollingSet<f64>,
    /// Mass of the cage, kg, as its centre moves with the outer race.
    pub cage_mass: f64,
    /// Azimuth of ball 1 at the start, rad.
    pub first_ball_angle: f64,
    /// The steady friction moment M.
    pub moment: SteadyMoment<f64>,
    /// Axial load that its law sees, N.
    pub axial_load: f64,
    /// Friction F of the balls in their pockets.
    pub loss: AccelerationLoss,
    /// The slow state of the lubricant; none where it has none.
    pub lubricant: Option<LubricantConstants>,
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
    axial_load: R,
    loss: Option<Loss<R>>,
    lubricant: Option<Lubricant<R>>,
    seats: Vec<R>,
}

impl<R: Real> Rolling<R> {
    /// One bearing per lane.
    pub(crate) fn gather<'a>(machine: &dyn Fn(usize) -> &'a RollingConstants) -> Self {
        let balls = Gather::<R>::gather(&|lane| &machine(lane).balls);
        Rolling {
            balls,
            ball: gather_group::<R, _>(&|lane| &machine(lane).ball),
            inner_inertia: R::from_lanes(|lane| machine(lane).set.inner_inertia()),
            outer_inertia: R::from_lanes(|lane| machine(lane).set.outer_inertia()),
            cage_ratio: R::from_lanes(|lane| machine(lane).set.cage_speed(1.0)),
            moment: SteadyMoment::gather(&|lane| &machine(lane).moment),
            axial_load: R::from_lanes(|lane| machine(lane).axial_load),
            loss: Loss::gather(&|lane| {
                let bearing = machine(lane);
                (bearing.set.pocket_friction_arm(), &bearing.loss)
            }),
            lubricant: Lubricant::gather(&|lane| machine(lane).lubricant.as_ref()),
            seats: seats(balls),
        }
    }

    /// Reaction to the motion of the races; the load that is held besides theirs reaches the steady moment only.
    #[inline(always)]
    pub(crate) fn react(
        &self,
        motion: &Motion<R>,
        held_load: R,
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
        let growth = self.ball.inner_track_growth;
        let interference = self.ball.interference + growth * motion.inner.spin.grouped().square();
        let mut sums = BallSums::<R, 4>::new(n);
        let mut from = 0;
        while from < n {
            let azimuth = state[0].grouped() + R::load_group(&self.seats, from);
            let (sine, cosine) = azimuth.sin_cos();
            let direction = Vec2::new(cosine, sine);
            let approach_speed = closing.dot(direction);
            let load = ball_race(
                self.ball.series_stiffness,
                self.ball.damping_time,
                interference + offset.dot(direction),
                approach_speed,
            );
            let push = direction * load.force;
            sums.add(
                from,
                &[
                    push.x,
                    push.y,
                    (load.force - load.elastic) * approach_speed,
                    load.elastic * growth,
                ],
            );
            if !detail.is_empty() {
                let share = self.ball.load_per_radial_force;
                R::store_group(load.force * share, &mut detail[..n], from);
                let outer = (load.force + centrifugal) * share;
                R::store_group(outer, &mut detail[n..2 * n], from);
            }
            from += R::GROUP;
        }
        if !detail.is_empty() {
            detail[2 * n..]
                .iter_mut()
                .for_each(|value| *value = R::zero());
        }
        let [x, y, damping, growing] = sums.total();
        let push = Vec2::new(x, y);
        let moment = match &self.moment {
            SteadyMoment::None => R::zero(),
            law => {
                let load = push.length_squared().max(R::splat(1e-30)).sqrt() + held_load;
                let parts = law.parts(spin, load, self.axial_load);
                match &self.lubricant {
                    None => parts.sum(),
                    Some(lubricant) => {
                        let state = &state[STATES..];
                        let factors = R::vectorized(lubricant_state::Act { lubricant, state });
                        parts.with_drag(factors.drag).sum()
                    }
                }
            }
        };
        let (loss_moment, loss_inertia) = match &self.loss {
            None => (R::zero(), R::zero()),
            Some(loss) => (loss.moment(spin), loss.inertia(spin)),
        };
        let resistance = moment + loss_moment;
        // the balls of eccentric races push past the centres: what turns them comes from the races in the shares of
        // their motion
        let turning = (motion.inner.position - motion.outer.position).cross(push);
        let by_inner = self.cage_ratio * turning;
        if let Some(lubricant) = &self.lubricant {
            R::vectorized(lubricant_state::Change {
                lubricant,
                cage_speed: self.cage_ratio * spin,
                film_heat: moment * spin,
                state: &state[STATES..],
                rate: &mut rate[STATES..],
            });
        }
        BearingReaction {
            on_inner: Wrench::planar(-push, by_inner - resistance),
            on_outer: Wrench::planar(push, turning - by_inner + resistance),
            inner_inertia: self.inner_inertia,
            outer_inertia: self.outer_inertia,
            loss_inertia,
            steady_moment: moment,
            growth_impulse: R::splat(2.0) * motion.inner.spin * growing,
            external_moment: R::zero(),
            heat: BearingHeat {
                inner_damping: damping,
                pocket_sliding: loss_moment * spin,
                steady_moment: moment * spin,
                ..BearingHeat::zero()
            },
            largest_inner_load: largest(detail, n, 0),
            largest_outer_load: largest(detail, n, 1),
            largest_skids: [R::zero(); 2],
            largest_pocket_force: R::zero(),
            land_force: R::zero(),
        }
    }
}

impl<R: Real> Rolling<R> {
    /// Rate of the angular momentum of balls and cage about the origin, N m, at an acceleration of the inner race.
    #[inline(always)]
    pub(crate) fn angular_momentum_rate(&self, race_acceleration: R) -> R {
        (self.inner_inertia + self.outer_inertia) * race_acceleration
    }
}

impl RollingConstants {
    /// No bearing between the races: those of a plain bushing of this bore radius are one ring.
    pub fn bushing(bore_radius: f64) -> Self {
        RollingConstants {
            balls: 0,
            ball: RollingBall {
                series_stiffness: 0.0,
                load_per_radial_force: 1.0,
                damping_time: 0.0,
                interference: 0.0,
                inner_track_growth: 0.0,
                mass_radius: 0.0,
            },
            set: RollingSet {
                inner_track_radius: bore_radius,
                ball_ratio: 0.0,
                balls_mass: 0.0,
                cage_mass: 0.0,
            },
            cage_mass: 0.0,
            first_ball_angle: 0.0,
            moment: SteadyMoment::None,
            axial_load: 0.0,
            loss: AccelerationLoss::None,
            lubricant: None,
        }
    }
    /// The bearing whose balls roll that corresponds to one computed ball by ball: contacts in series, the law of its
    /// steady moment as a whole, no loss in the pockets.
    pub fn of(planar: &PlanarConstants) -> Self {
        let ball = &planar.ball;
        let soft = |stiffness: f64| stiffness.powf(-2.0 / 3.0);
        let series = soft(ball.inner_stiffness) + soft(ball.outer_stiffness);
        RollingConstants {
            balls: planar.balls,
            ball: RollingBall {
                series_stiffness: series.powf(-1.5),
                load_per_radial_force: ball.load_per_radial_force,
                damping_time: ball.damping_time,
                interference: planar.interference(),
                inner_track_growth: ball.inner_track_growth,
                mass_radius: ball.mass * (ball.inner_track + ball.radius),
            },
            set: planar.set(),
            cage_mass: planar.mass_of_cage(),
            first_ball_angle: planar.first_ball_angle,
            moment: match &planar.moment {
                Some(shared) => shared.law.clone(),
                None => SteadyMoment::None,
            },
            axial_load: planar
                .moment
                .as_ref()
                .map_or(0.0, |shared| shared.axial_load),
            loss: AccelerationLoss::None,
            lubricant: planar.lubricant,
        }
    }
    pub(super) fn rest(&self, state: &mut [f64]) {
        state[0] = self.first_ball_angle;
    }
    /// Approach of both races at an azimuth, m.
    fn approach(&self, motion: &Motion<f64>, azimuth: f64) -> f64 {
        let grown = self.ball.inner_track_growth * motion.inner.spin * motion.inner.spin;
        let offset = motion.inner.position - motion.outer.position;
        self.ball.interference + grown + offset.dot(direction(azimuth))
    }
    /// Azimuth of a ball, and its contacts at both races.
    pub(super) fn contacts(
        &self,
        motion: &Motion<f64>,
        state: &[f64],
        ball: usize,
    ) -> (f64, [SlidingContact<f64>; 2]) {
        let azimuth = state[0] + seat(ball, self.balls);
        let cage_speed =
            self.set.cage_speed(motion.inner.spin - motion.outer.spin) + motion.outer.spin;
        let along = direction(azimuth);
        let offset = motion.inner.position - motion.outer.position;
        // as the balls see the races part: they turn with the cage
        let closing = motion.inner.velocity - motion.outer.velocity - offset.turned() * cage_speed;
        let load = ball_race(
            self.ball.series_stiffness,
            self.ball.damping_time,
            self.approach(motion, azimuth),
            closing.dot(along),
        );
        let outer = load.force + self.ball.mass_radius * cage_speed * cage_speed;
        let contact = |force: f64| SlidingContact {
            slip: 0.0,
            load: force * self.ball.load_per_radial_force,
            entrainment: 0.0,
        };
        (azimuth, [load.force, outer].map(contact))
    }
    pub(super) fn energy(&self, motion: &Motion<f64>, state: &[f64]) -> BearingEnergy {
        let spin = motion.inner.spin - motion.outer.spin;
        let elastic = (0..self.balls)
            .map(|j| {
                let approach = self.approach(motion, state[0] + seat(j, self.balls));
                ball_race_energy(self.ball.series_stiffness, approach)
            })
            .sum();
        BearingEnergy {
            // balls and cage: ½ J_I Ω²; their translation with the outer race is the system's
            translation: 0.0,
            spin: 0.5 * self.set.inner_inertia() * spin * spin,
            elastic,
            weight: 0.0,
            angular_momentum: (self.set.inner_inertia() + self.set.outer_inertia()) * spin,
        }
    }
}
