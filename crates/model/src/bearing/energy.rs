//! What a planar bearing stores: energies and angular momentum of its balls and its cage.

use super::ball::{BallConstants, BallMotion, PocketMotion, RaceMotion, pocket_angle};
use super::ball_states::race;
use super::planar_constants::{PlanarConstants, Separation};
use super::reaction::BearingEnergy;
use super::{cage, full_complement};
use crate::motion::Motion;
use number::{Real, Vec2};
use physics::contact::ball_race_energy;

impl PlanarConstants {
    pub(super) fn energy(&self, motion: &Motion<f64>, state: &[f64]) -> BearingEnergy {
        let (inner, outer) = (race(&motion.inner), race(&motion.outer));
        let between_races = self.separation.beyond_pockets(self.ball);
        let mut sum = BearingEnergy::default();
        for j in 0..self.balls {
            let ball = self.motion(state, j);
            let pocket = self.pocket(state, j);
            let (elastic, weight) = between_races.energy(&inner, &outer, &pocket, &ball);
            let (translation, spin) = self.ball.kinetic_energy(&ball);
            sum.translation += translation;
            sum.spin += spin;
            sum.elastic += elastic;
            sum.weight += weight;
            sum.angular_momentum += self.ball.angular_momentum(&ball);
        }
        match &self.separation {
            Separation::CentredCage => {}
            Separation::FreeCage(land) => {
                let cage = cage::energy(self, land.as_ref(), motion, state);
                sum.translation += cage.translation;
                sum.weight += cage.weight;
                sum.elastic += cage.elastic;
                sum.angular_momentum += cage.angular_momentum;
            }
            Separation::Neighbours(pair) => {
                sum.elastic += full_complement::energy(self, pair, state);
                return sum;
            }
        }
        sum.spin += 0.5 * self.cage_inertia * state[1] * state[1];
        sum.angular_momentum += self.cage_inertia * state[1];
        sum
    }
}

impl<R: Real> BallConstants<R> {
    /// Energy stored around a ball, J: (two Hertz contacts and the pocket, weight).
    #[inline(always)]
    pub fn energy(
        &self,
        inner: &RaceMotion<R>,
        outer: &RaceMotion<R>,
        pocket: &PocketMotion<R>,
        ball: &BallMotion<R>,
    ) -> (R, R) {
        let (sine, cosine) = ball.azimuth.sin_cos();
        let e_r = Vec2::new(cosine, sine);
        let position = e_r * ball.radius;
        let from_outer = position - outer.position;
        let inner_distance = (position - inner.position).length_squared().sqrt();
        let outer_distance = from_outer.length_squared().sqrt();
        let sine = e_r.cross(from_outer) / outer_distance;
        let offset = pocket_angle(ball.azimuth, pocket.angle) + sine.asin_small();
        let pressed = self.pocket_penetration(offset).max(R::zero());
        (
            ball_race_energy(
                self.inner_stiffness,
                self.inner_track + self.inner_track_growth * inner.spin.square() + self.radius
                    - inner_distance,
            ) + ball_race_energy(
                self.outer_stiffness,
                outer_distance + self.radius - self.outer_track,
            ) + R::splat(0.5) * self.pocket_stiffness * pressed.square(),
            -(self.mass * self.gravity.dot(position)),
        )
    }

    /// Kinetic energy of a ball, J: (translation, spin).
    #[inline(always)]
    pub fn kinetic_energy(&self, ball: &BallMotion<R>) -> (R, R) {
        let half = R::splat(0.5);
        let orbital = ball.radius * ball.orbit_speed;
        (
            half * self.mass * (ball.radial_speed.square() + orbital.square()),
            half * ball.spin.square() / self.inverse_inertia,
        )
    }

    /// Angular momentum of a ball about the origin, N m s.
    #[inline(always)]
    pub fn angular_momentum(&self, ball: &BallMotion<R>) -> R {
        self.mass * ball.radius.square() * ball.orbit_speed + ball.spin / self.inverse_inertia
    }
}
