//! Means of a ball-by-ball interval with their standard errors, and what they say beside the laws.
//!
//! ```text
//!   r_b = P_b/P_laws(Ω_b, T)            power of the bearings in batch b over that of the laws at its speed; P_b/Ω_b where no law knows one of them
//!   SE² = s²/n (1 + ρ)/(1 − ρ)          s and ρ: standard deviation of the batches, correlation of neighbours where it is above 0
//!   error² = SE² + ((r̄_2 − r̄_1)/2)²    means of the two halves: what still settles or drifts is as uncertain as half its change
//!   λ = slope of ln A_b over time − q SE    growth of a motion beyond chance, q near Student's 97.5 %: A the contact force, or how far the motion is from its
//!                                           place after a batch
//! ```
//!
//! Source: batch means, as in J. Banks et al., Discrete-Event System Simulation, chapter on output analysis; book/src/theory/heat.md.

use crate::coast_down::build::CoastDownModel;
use crate::coast_down::rows::BallsSeen;
use std::sync::Arc;
use thermal::bearing_network::{Landing, NODES};
use thermal::warm_machine::{Followed, InMotion};

/// What a batch found of a bearing; means over its time.
#[derive(Clone, Debug, Default)]
pub(super) struct Bearing {
    /// Equal rows that it stands for; all else is that of one of them.
    pub planes: f64,
    /// Power of its steady moment, and of its other losses, W.
    pub steady: f64,
    pub other: f64,
    /// Powers of M0 and M1 of the laws at the same speed and temperatures, W.
    pub laws: [f64; 2],
    /// Heats of its nodes, W.
    pub nodes: [f64; NODES.len()],
    /// Power of the friction of rotor and race, W.
    pub friction: f64,
    /// Sliding speed of rotor and race, m/s, and that times their force, W over the coefficient of friction.
    pub sliding: f64,
    pub rubbing: f64,
    /// How far its motion comes back from its place after the batch, m.
    pub returns: f64,
    /// Turns of the rotor about the race with its spin, in the batch.
    pub whirl: f64,
    /// Largest contact force in the bore and on the faces, N, and rise of the patch above the start, K.
    pub peak_force: f64,
    pub peak_thrust: f64,
    pub peak_rise: f64,
    /// Factor of the lubricant on M0.
    pub drag_factor: f64,
    /// Speed of the inner race over that of one that rolls.
    pub spin: f64,
    /// How the rotor lies in it.
    pub landing: Landing,
}

/// A batch.
#[derive(Clone, Debug, Default)]
pub(super) struct Batch {
    /// s.
    pub span: f64,
    /// Mean speed of the rotor, rad/s.
    pub speed: f64,
    pub bearings: Vec<Bearing>,
    /// What the rotor itself loses, W.
    pub rotor: f64,
}

impl Batch {
    /// Power of the bearings with all their rows, and the one that it is compared with, W: that of their laws, or 1 N m where one has none.
    pub fn powers(&self) -> [f64; 2] {
        let sum = |of: &dyn Fn(&Bearing) -> f64| -> f64 {
            let each = self.bearings.iter();
            each.map(|bearing| bearing.planes * of(bearing)).sum()
        };
        let law = |bearing: &Bearing| bearing.laws.iter().sum::<f64>();
        let known = self.bearings.iter().all(|bearing| law(bearing) > 0.0);
        [
            sum(&|bearing| bearing.steady + bearing.other),
            if known { sum(&law) } else { self.speed },
        ]
    }
    /// Share of the power of its bearings that friction of rotor and race makes.
    pub fn rubs(&self) -> f64 {
        let bearings = self.bearings.iter();
        let friction: f64 = bearings.map(|own| own.planes * own.friction).sum();
        friction / self.powers()[0]
    }
    fn ratio(&self) -> f64 {
        let [own, law] = self.powers();
        own / law
    }
}

/// A ball-by-ball interval.
#[derive(Clone, Debug)]
pub(super) struct Interval {
    pub batches: Vec<Batch>,
    /// From which of them on an unbalance or a load has come.
    pub changed: Option<usize>,
    /// Of the balls of each bearing.
    pub balls: Vec<Option<Arc<BallsSeen>>>,
    /// Largest displacement of the rotor in each bearing from the line of levitation, and of its mount, m.
    pub displacements: Vec<[f64; 2]>,
}

/// What batches say of the motion at their speed.
#[derive(Clone, Debug)]
pub(super) struct Observation {
    /// Means; of forces, rises and turns the largest.
    pub mean: Batch,
    /// What its powers say beside the laws, and heats beside the laws, over the nodes of all bearings, W.
    pub followed: Followed,
    pub beside: Vec<f64>,
    pub balls: Vec<Option<Arc<BallsSeen>>>,
    /// Error of its power over the power of the laws of the bearings.
    pub error: f64,
    /// Rate at which its motion grows beyond chance, 1/s; 0 where it does not.
    pub growth: f64,
    /// Rate at which an inner race changes its speed over that of rolling, beyond chance, 1/s.
    pub spins: f64,
}

impl Observation {
    /// Means of these batches, at least four, and the balls of the interval with the last of them.
    pub fn of(
        built: &CoastDownModel,
        batches: &[&Batch],
        balls: &[Option<Arc<BallsSeen>>],
    ) -> Self {
        let mean = mean(batches);
        let (followed, beside) = beside_laws(built, &mean);
        let ratios: Vec<f64> = batches.iter().map(|batch| batch.ratio()).collect();
        Observation {
            error: error(&ratios),
            growth: 0.0,
            spins: 0.0,
            followed,
            beside,
            balls: balls.to_vec(),
            mean,
        }
    }

    /// The same, with the growth of the motion over these batches.
    #[must_use]
    pub fn growing(self, batches: &[Batch]) -> Self {
        let span: f64 = batches.iter().map(|batch| batch.span).sum();
        let motions: [fn(&Bearing) -> f64; 2] =
            [|bearing| bearing.peak_force, |bearing| bearing.returns];
        let rates = motions.into_iter().flat_map(|of| {
            (0..self.mean.bearings.len()).map(move |k| {
                let sizes = batches.iter().map(|batch| of(&batch.bearings[k]));
                let sizes = sizes.map(|size| size.max(f64::MIN_POSITIVE).ln());
                slope(&sizes.collect::<Vec<_>>())
            })
        });
        let spins = (0..self.mean.bearings.len()).map(|k| {
            let spins = batches.iter().map(|batch| batch.bearings[k].spin);
            slope(&spins.collect::<Vec<_>>()).abs()
        });
        let each = span / batches.len() as f64;
        Observation {
            growth: rates.fold(0.0, f64::max) / each,
            spins: spins.fold(0.0, f64::max) / each,
            ..self
        }
    }

    /// Power of the bearings over that of the laws; over 1 N m where one has none.
    pub fn ratio(&self) -> f64 {
        self.mean.ratio()
    }
    /// Standard error of the power of the machine over it, where what else brakes the rotor, W, is known.
    pub fn relative_error(&self, brakes: f64) -> f64 {
        let [own, law] = self.mean.powers();
        self.error * law / (own + brakes)
    }
}

/// Mean and squared standard deviation.
fn moments(list: &[f64]) -> [f64; 2] {
    let count = list.len() as f64;
    let mean = list.iter().sum::<f64>() / count;
    let squares: f64 = list.iter().map(|value| (value - mean).powi(2)).sum();
    [mean, squares / (count - 1.0)]
}

/// Error of the mean of batches, one after the other.
fn error(list: &[f64]) -> f64 {
    let [mean, variance] = moments(list);
    let count = list.len() as f64;
    let pairs: f64 = list
        .windows(2)
        .map(|two| (two[0] - mean) * (two[1] - mean))
        .sum();
    let correlation = match variance > 0.0 {
        true => (pairs / ((count - 1.0) * variance)).clamp(0.0, 1.0 - 1.0 / count),
        false => 0.0,
    };
    let chance = variance / count * (1.0 + correlation) / (1.0 - correlation);
    let (first, last) = list.split_at(list.len() / 2);
    let drift = 0.5 * (moments(last)[0] - moments(first)[0]);
    (chance + drift * drift).sqrt()
}

/// Change of a value from batch to batch beyond chance: the slope of a straight line, less 2 + 5/ν of its standard errors, near Student's 97.5 % at ν
/// degrees of freedom.
fn slope(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let [mean, _] = moments(values);
    let place = |k: usize| k as f64 - 0.5 * (count - 1.0);
    let each = || values.iter().enumerate();
    let spread: f64 = each().map(|(k, _)| place(k).powi(2)).sum();
    let slope = each().map(|(k, own)| place(k) * (own - mean)).sum::<f64>() / spread;
    let left: f64 = each()
        .map(|(k, own)| (own - mean - slope * place(k)).powi(2))
        .sum();
    let freedom = count - 2.0;
    let chance = (2.0 + 5.0 / freedom) * (left / (freedom * spread)).sqrt();
    slope.signum() * (slope.abs() - chance).max(0.0)
}

/// Means of batches; of forces, rises and turns the largest or the sum.
fn mean(batches: &[&Batch]) -> Batch {
    let span: f64 = batches.iter().map(|batch| batch.span).sum();
    let over = |of: &dyn Fn(&Batch) -> f64| -> f64 {
        let each = batches.iter().map(|batch| batch.span * of(batch));
        each.sum::<f64>() / span
    };
    let bearing = |k: usize| {
        let mean = |of: fn(&Bearing) -> f64| over(&|batch| of(&batch.bearings[k]));
        let largest = |of: fn(&Bearing) -> f64| {
            let each = batches.iter().map(|batch| of(&batch.bearings[k]));
            each.fold(0.0, f64::max)
        };
        Bearing {
            planes: batches[0].bearings[k].planes,
            steady: mean(|own| own.steady),
            other: mean(|own| own.other),
            laws: [mean(|own| own.laws[0]), mean(|own| own.laws[1])],
            nodes: std::array::from_fn(|node| over(&|batch| batch.bearings[k].nodes[node])),
            friction: mean(|own| own.friction),
            sliding: mean(|own| own.sliding),
            rubbing: mean(|own| own.rubbing),
            returns: mean(|own| own.returns),
            whirl: batches.iter().map(|batch| batch.bearings[k].whirl).sum(),
            peak_force: largest(|own| own.peak_force),
            peak_thrust: largest(|own| own.peak_thrust),
            peak_rise: largest(|own| own.peak_rise),
            drag_factor: mean(|own| own.drag_factor),
            // of races over rotor: in batches in which it stands their ratio says nothing
            spin: over(&|batch| batch.speed * batch.bearings[k].spin) / over(&|batch| batch.speed),
            landing: Landing {
                force: mean(|own| own.landing.force),
                slides: mean(|own| own.landing.slides),
                conductance: mean(|own| own.landing.conductance),
            },
        }
    };
    Batch {
        span,
        speed: over(&|batch| batch.speed),
        bearings: (0..batches[0].bearings.len()).map(bearing).collect(),
        rotor: over(&|batch| batch.rotor),
    }
}

/// What mean powers say beside the laws at their speed and temperatures, and what heats the nodes besides, W.
fn beside_laws(built: &CoastDownModel, mean: &Batch) -> (Followed, Vec<f64>) {
    let mut beside = Vec::new();
    let mut bearings = Vec::new();
    for (part, own) in built.parts.iter().zip(&mean.bearings) {
        // balls that bounce lag a little behind rolling: that is not M1's, which a preload makes grow
        let second = own.steady.min(own.laws[1]);
        let first = (own.steady - second).min(own.drag_factor * own.laws[0]);
        let [viscous, sliding] = &part.losses.shares;
        let nodes = own.nodes.iter().zip(viscous).zip(sliding);
        beside.extend(nodes.map(|((heat, viscous), sliding)| {
            (heat - first * viscous - second * sliding).max(0.0)
        }));
        let factor = |taken: f64, law: f64| if law > 0.0 { taken / law } else { 0.0 };
        bearings.push(InMotion {
            factors: [factor(first, own.laws[0]), factor(second, own.laws[1])],
            beside: own.planes * (own.steady - first - second + own.other) / mean.speed,
            spin: own.spin,
            landing: own.landing,
        });
    }
    let followed = Followed {
        speed: mean.speed,
        bearings,
        rotor: mean.rotor / mean.speed,
    };
    (followed, beside)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trend_is_as_uncertain_as_half_its_change_and_scatter_as_its_standard_error() {
        let trend: Vec<f64> = (0..8).map(f64::from).collect();
        assert!(error(&trend) >= 2.0);
        // alternating by ±1: s² = 8/7, neighbours do not correlate, the halves agree
        let alternates = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
        assert!((error(&alternates) - (1.0f64 / 7.0).sqrt()).abs() < 1e-12);
        assert_eq!(error(&[2.0; 4]), 0.0);
    }

    #[test]
    fn neighbours_that_correlate_say_less() {
        let pairs = [1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0];
        // correlation (4 − 3)/8 = 1/8
        let expected: f64 = 1.0 / 7.0 * (9.0 / 8.0) / (7.0 / 8.0);
        assert!((error(&pairs) - expected.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn only_what_changes_beyond_its_scatter_has_a_slope() {
        assert_eq!(slope(&[1.0, 1.2, 0.9, 1.1]), 0.0);
        assert!((slope(&[1.0, 3.0, 5.0, 7.0]) - 2.0).abs() < 1e-12);
        assert!((slope(&[7.0, 5.0, 3.0, 1.0]) + 2.0).abs() < 1e-12);
    }
}
