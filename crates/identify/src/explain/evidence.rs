//! Marginal likelihood of one form of an explanation.
//!
//! Parameters are standard normal coordinates z. Quasi-random points of the prior find where the likelihood lies;
//! the best are refined by Levenberg and Marquardt's method; importance sampling from a mixture of Student's t around
//! the modes, of a normal fitted to a first batch of draws, and of the prior itself gives the integral, several times
//! over: the spread of the repeats is the stated error. Where the claim of an explanation is not fulfilled its prior
//! is 0, and the rest is raised so that it integrates to 1.

use super::draw::Draw;
use super::hypothesis::{Bearing, Hypothesis, Prediction};
use super::noise::Observed;
use super::proposal::Component;
use super::record::Trial;
use crate::algebra::{Factor, dot, log_sum_exp};
use measure::random::{Random, quasi_normal};
use nalgebra::{DMatrix, DVector};

/// Evidence and posterior of one form.
#[derive(Clone, Debug)]
pub(crate) struct Evidence {
    pub log: f64,
    pub deviation: f64,
    pub draws: Vec<Draw>,
}

/// All that an integral needs.
pub(crate) struct Integral<'a> {
    pub hypothesis: Hypothesis,
    pub tests: &'a [Trial],
    pub bearing: &'a Bearing<'a>,
    pub observed: &'a Observed,
    pub size: usize,
    /// ln evidence of the best explanation so far.
    pub leader: f64,
}

/// A place where the posterior is high, with the factor of its curvature.
struct Mode {
    at: Vec<f64>,
    curvature: Factor,
    height: f64,
}

/// Batches that lead from the modes to the posterior, at most.
const ADAPTATIONS: usize = 8;
/// ln of evidence by which Laplace's approximation must lie below the leader to be final.
const HOPELESS: f64 = 20.0;
/// Deviation of ln evidence that is stated for it: a factor of 3, assumed.
const LAPLACE_DEVIATION: f64 = 1.0;

impl Integral<'_> {
    pub fn evidence(&self) -> Evidence {
        if self.size == 0 {
            let (levels, log) = self.likelihood(&self.predict(&[]));
            return Evidence {
                log,
                deviation: 0.0,
                draws: vec![Draw {
                    coordinates: Vec::new(),
                    log_weight: 0.0,
                    levels,
                }],
            };
        }
        let settings = self.bearing.settings;
        let (starts, claimed) = self.explore(settings.prior_points);
        let none = Evidence {
            log: f64::NEG_INFINITY,
            deviation: 0.0,
            draws: Vec::new(),
        };
        if starts.is_empty() {
            return none;
        }
        let modes = self.modes(&starts);
        if let Some(hopeless) = self.hopeless(&modes, claimed) {
            return hopeless;
        }
        let mut random = Random::new(settings.seed);
        let mut proposal = self.proposal(&modes);
        // a first batch shows the shape of the posterior where it is not normal; where hardly a draw of it counts, others lead there
        for _ in 0..ADAPTATIONS {
            let first = self.batch(&proposal, settings.draws, &mut random);
            let Some((component, power)) = Component::fitted(&first, self.size) else {
                break;
            };
            for other in &mut proposal {
                other.weight *= 0.5;
            }
            proposal.push(component);
            if power == 1.0 {
                break;
            }
        }
        let mut logs = Vec::new();
        let mut draws = Vec::new();
        for _ in 0..settings.repeats.max(2) {
            let batch = self.batch(&proposal, settings.draws, &mut random);
            let weights: Vec<f64> = batch.iter().map(|draw| draw.log_weight).collect();
            logs.push(log_sum_exp(&weights) - (batch.len() as f64).ln() - claimed.ln());
            draws.extend(batch);
        }
        draws.retain(|draw| draw.log_weight > f64::NEG_INFINITY);
        if draws.is_empty() {
            return none;
        }
        let count = logs.len() as f64;
        let log = log_sum_exp(&logs) - count.ln();
        let variance = (logs.iter())
            .map(|one| ((one - log).exp() - 1.0).powi(2))
            .sum::<f64>()
            / (count * (count - 1.0));
        // of few draws that count the repeats may agree by chance
        let weights: Vec<f64> = draws.iter().map(|draw| draw.log_weight).collect();
        let total = log_sum_exp(&weights);
        let squares: f64 = weights.iter().map(|w| (2.0 * (w - total)).exp()).sum();
        let few = (squares - 1.0 / draws.len() as f64).max(0.0);
        Evidence {
            log,
            deviation: variance.max(few).sqrt(),
            draws,
        }
    }

    /// Laplace's approximation where it lies so far below the best explanation that no integral could save it.
    fn hopeless(&self, modes: &[Mode], claimed: f64) -> Option<Evidence> {
        let best = modes.first()?;
        // the mode's height times the volume of its curvature; the prior's normalisation cancels
        let log = best.height - 0.5 * best.curvature.log_determinant - claimed.ln();
        (log < self.leader - HOPELESS).then(|| {
            let (levels, _) = self.likelihood(&self.predict(&best.at));
            Evidence {
                log,
                deviation: LAPLACE_DEVIATION,
                draws: vec![Draw {
                    coordinates: best.at.clone(),
                    log_weight: 0.0,
                    levels,
                }],
            }
        })
    }

    fn predict(&self, coordinates: &[f64]) -> Prediction {
        self.hypothesis
            .predict(coordinates, self.tests, self.bearing)
    }

    /// ln likelihood and χ² per amplitude, and ln of the likelihood over all amplitudes.
    fn likelihood(&self, prediction: &Prediction) -> (Vec<(f64, f64)>, f64) {
        let levels = self.observed.log_likelihood(prediction, self.directions());
        let logs: Vec<f64> = levels.iter().map(|(log, _)| *log).collect();
        (levels, log_sum_exp(&logs) - (logs.len() as f64).ln())
    }

    /// Tests whose effect may scatter; rolling balls have none.
    fn directions(&self) -> usize {
        self.hypothesis.directions(self.tests.len())
    }

    /// The best points of the prior and the share of the prior that fulfils the claim.
    fn explore(&self, points: u32) -> (Vec<Vec<f64>>, f64) {
        let mut found: Vec<(f64, Vec<f64>)> = Vec::new();
        let mut claimed = 0_u32;
        for index in 1..=points as usize {
            let z: Vec<f64> = (0..self.size)
                .map(|axis| quasi_normal(index, axis))
                .collect();
            let prediction = self.predict(&z);
            if prediction.claim >= 1.0 {
                claimed += 1;
                // the widest amplitude shows the way from afar
                let last = self.observed.amplitudes.len() - 1;
                let whitened = self.observed.whiten(&prediction, last, self.directions());
                found.push((whitened.log_likelihood().0, z));
            }
        }
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut starts: Vec<Vec<f64>> = Vec::new();
        for (_, z) in found {
            if starts.iter().all(|other| distance(other, &z) > 0.5) {
                starts.push(z);
            }
            if starts.len() == self.bearing.settings.starts {
                break;
            }
        }
        (starts, f64::from(claimed) / f64::from(points))
    }

    /// Penalty on a claim that is not fulfilled, as a residual.
    fn shortfall(prediction: &Prediction) -> f64 {
        10.0 * (1.05 - prediction.claim).max(0.0)
    }

    /// ln of likelihood at one amplitude times prior, with the penalty.
    fn height(&self, z: &[f64], prediction: &Prediction, amplitude: usize) -> f64 {
        let whitened = self
            .observed
            .whiten(prediction, amplitude, self.directions());
        let short = Self::shortfall(prediction);
        whitened.log_likelihood().0 - 0.5 * dot(z, z) - 0.5 * short * short
    }

    fn best_amplitude(&self, prediction: &Prediction) -> usize {
        let levels = self.observed.log_likelihood(prediction, self.directions());
        (0..levels.len())
            .max_by(|i, j| levels[*i].0.total_cmp(&levels[*j].0))
            .unwrap_or(0)
    }

    fn modes(&self, starts: &[Vec<f64>]) -> Vec<Mode> {
        let mut modes: Vec<Mode> = Vec::new();
        for start in starts {
            let wide = self.observed.amplitudes.len() - 1;
            let (z, _) = self.climb(start, wide, 6);
            let amplitude = self.best_amplitude(&self.predict(&z));
            let (z, curvature) = self.climb(&z, amplitude, 12);
            let (_, likelihood) = self.likelihood(&self.predict(&z));
            let height = likelihood - 0.5 * dot(&z, &z);
            if let Some(curvature) = curvature
                && modes.iter().all(|mode| distance(&mode.at, &z) > 0.1)
            {
                modes.push(Mode {
                    at: z,
                    curvature,
                    height,
                });
            }
        }
        modes.sort_by(|a, b| b.height.total_cmp(&a.height));
        let best = modes.first().map_or(0.0, |mode| mode.height);
        modes.retain(|mode| mode.height > best - 10.0);
        modes.truncate(3);
        modes
    }

    /// Levenberg's and Marquardt's climb; the place and the factor of the curvature there.
    fn climb(&self, start: &[f64], amplitude: usize, rounds: u32) -> (Vec<f64>, Option<Factor>) {
        let size = self.size;
        let mut z = start.to_vec();
        let mut prediction = self.predict(&z);
        let mut height = self.height(&z, &prediction, amplitude);
        let mut damping = 1e-2;
        let mut curvature = None;
        for _ in 0..rounds {
            let whitened = self
                .observed
                .whiten(&prediction, amplitude, self.directions());
            let h = 1e-3;
            let mut slopes = Vec::with_capacity(size);
            let mut claim_slopes = vec![0.0; size];
            for axis in 0..size {
                let mut moved = z.clone();
                moved[axis] += h;
                let other = self.predict(&moved);
                let mut slope = self.observed.whiten_change(&prediction, &other, amplitude);
                for entry in &mut slope {
                    *entry /= h;
                }
                claim_slopes[axis] = (Self::shortfall(&other) - Self::shortfall(&prediction)) / h;
                slopes.push(slope);
            }
            let weighted = whitened.metric(&slopes);
            let short = Self::shortfall(&prediction);
            let gradient = DVector::from_fn(size, |i, _| {
                dot(&weighted[i], &whitened.residual) - z[i] - short * claim_slopes[i]
            });
            let hessian = DMatrix::from_fn(size, size, |i, j| {
                dot(&weighted[i], &slopes[j])
                    + claim_slopes[i] * claim_slopes[j]
                    + f64::from(u8::from(i == j))
            });
            curvature = Factor::of(hessian.clone());
            let mut gained = 0.0;
            for _ in 0..6 {
                let mut damped = hessian.clone();
                for i in 0..size {
                    damped[(i, i)] *= 1.0 + damping;
                }
                let Some(factor) = Factor::of(damped) else {
                    break;
                };
                let step = factor.solved(&gradient);
                let share = (1.5 / step.norm()).min(1.0);
                let moved: Vec<f64> = (z.iter().zip(&step)).map(|(z, s)| z + share * s).collect();
                let other = self.predict(&moved);
                let there = self.height(&moved, &other, amplitude);
                if there > height {
                    gained = there - height;
                    (z, prediction, height) = (moved, other, there);
                    damping = (0.2 * damping).max(1e-6);
                    break;
                }
                damping *= 8.0;
            }
            if gained < 0.02 {
                break;
            }
        }
        (z, curvature)
    }

    fn proposal(&self, modes: &[Mode]) -> Vec<Component> {
        let mass = |mode: &Mode| mode.height - 0.5 * mode.curvature.log_determinant;
        let total = log_sum_exp(&modes.iter().map(mass).collect::<Vec<_>>());
        let count = modes.len().max(1) as f64;
        let mut components: Vec<Component> = (modes.iter())
            .map(|mode| Component {
                at: mode.at.clone(),
                curvature: mode.curvature.clone(),
                weight: 0.45 * (mass(mode) - total).exp() + 0.45 / count,
                student: true,
            })
            .collect();
        let unit = DMatrix::identity(self.size, self.size);
        components.extend(Factor::of(unit).map(|curvature| Component {
            at: vec![0.0; self.size],
            curvature,
            weight: if modes.is_empty() { 1.0 } else { 0.1 },
            student: false,
        }));
        components
    }

    fn batch(&self, proposal: &[Component], count: usize, random: &mut Random) -> Vec<Draw> {
        // each component has its share of the draws; the density is that of the whole mixture
        let total: f64 = proposal.iter().map(|c| c.weight).sum();
        let mut draws = Vec::with_capacity(count);
        let mut owed = random.uniform();
        for component in proposal {
            owed += component.weight / total * count as f64;
            while owed >= 1.0 {
                owed -= 1.0;
                draws.push(self.draw(component, proposal, total, random));
            }
        }
        draws
    }

    fn draw(
        &self,
        component: &Component,
        proposal: &[Component],
        total: f64,
        random: &mut Random,
    ) -> Draw {
        let coordinates = component.sample(random);
        let densities: Vec<f64> = (proposal.iter())
            .map(|other| (other.weight / total).ln() + other.log_density(&coordinates))
            .collect();
        let prediction = self.predict(&coordinates);
        if prediction.claim < 1.0 {
            return Draw {
                coordinates,
                log_weight: f64::NEG_INFINITY,
                levels: Vec::new(),
            };
        }
        let (levels, likelihood) = self.likelihood(&prediction);
        let prior = -0.5
            * (dot(&coordinates, &coordinates)
                + self.size as f64 * (2.0 * std::f64::consts::PI).ln());
        Draw {
            log_weight: likelihood + prior - log_sum_exp(&densities),
            coordinates,
            levels,
        }
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    (a.iter().zip(b))
        .map(|(a, b)| (a - b).powi(2))
        .sum::<f64>()
        .sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::record::LeastWidth;
    use super::super::steady::known;
    use super::super::{Explanation, Priors, Settings};
    use super::*;
    use physics::rolling::RollingSet;

    /// Data of a drift of -0.2 M in 1.5 s with residuals that a fixed rule scatters, in a setting of few means.
    fn with_data(check: impl Fn(&Integral)) {
        let mut steady = known(vec![1.0, 75.0, 150.0], vec![5e-3, 15e-3, 25e-3]);
        steady.covariance = vec![vec![1e-8; 3]; 3];
        let set = RollingSet {
            inner_track_radius: 14.8e-3,
            ball_ratio: 0.214,
            balls_mass: 10.5e-3,
            cage_mass: 8e-3,
        };
        let (priors, settings) = (Priors::default(), Settings::default());
        let bearing = Bearing::new(&steady, 150.0, &set, &priors, &settings, false);
        let speed = |t: f64| 150.0 * (t / 0.1).clamp(0.0, 1.0);
        let mut test = Trial::planned(
            &speed,
            3.0,
            &LeastWidth::even(0.05),
            &bearing.table,
            set.outer_inertia(),
        );
        let rolling = Hypothesis::Rolling.predict(&[], std::slice::from_ref(&test), &bearing);
        let count = test.bins.len();
        for (i, bin) in test.bins.iter_mut().enumerate() {
            let middle = 0.5 * (bin.from + bin.to);
            let scatter = 3e-4 * (2.5 * i as f64).sin();
            bin.torque = rolling.torque[i] - 5e-3 * (1.0 - (-middle / 1.5).exp()) + scatter;
            bin.variance = 1e-7;
        }
        assert!(count > 8);
        test.zero_deviation = 3e-4;
        test.scale_deviation = 0.01;
        let tests = [test];
        let observed =
            Observed::new(&tests, &bearing, &settings.discrepancy).expect("a covariance");
        for hypothesis in [Hypothesis::SlowSensor, Hypothesis::Drift { sign: -1.0 }] {
            check(&Integral {
                hypothesis,
                tests: &tests,
                bearing: &bearing,
                observed: &observed,
                size: hypothesis.parameters(&bearing).len(),
                leader: f64::NEG_INFINITY,
            });
        }
        assert_eq!(Hypothesis::of(Explanation::Sensor).len(), 5);
    }

    #[test]
    fn the_integral_is_that_of_a_fine_grid() {
        with_data(|integral| {
            let step = 0.04;
            let axis: Vec<f64> = (-100..=100).map(|i| f64::from(i) * step).collect();
            let points: Vec<Vec<f64>> = if integral.size == 1 {
                axis.iter().map(|z| vec![*z]).collect()
            } else {
                (axis.iter())
                    .flat_map(|y| axis.iter().map(|z| vec![*y, *z]))
                    .collect()
            };
            let (mut logs, mut claimed) = (Vec::new(), Vec::new());
            for z in &points {
                let prediction = integral.predict(z);
                if prediction.claim >= 1.0 {
                    let prior = -0.5 * dot(z, z);
                    logs.push(prior + integral.likelihood(&prediction).1);
                    claimed.push(prior);
                }
            }
            let grid = log_sum_exp(&logs) - log_sum_exp(&claimed);
            let evidence = integral.evidence();
            // stated deviation, and 0.02 each for the share of the claim by 256 points and for the grid's border
            let allowed = 4.0 * evidence.deviation + 0.04;
            assert!(
                (evidence.log - grid).abs() < allowed,
                "{} {grid}",
                evidence.log
            );
            assert!(evidence.deviation < 0.15, "{}", evidence.deviation);
        });
    }
}
