//! What a planar bearing stores: energies and angular momentum of its balls and its cage.

use super::ball_states::race;
use super::planar_constants::{PlanarConstants, Separation};
use super::reaction::BearingEnergy;
use super::{cage, full_complement};
use crate::motion::Motion;

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
