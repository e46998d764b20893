//! The most probable parameters of a form of an explanation, and its evidence there.
//!
//! Parameters are standard normal coordinates z. Quasi-random points of the prior find where the likelihood lies; the best are refined
//! by Levenberg and Marquardt's method. Where the claim of an explanation is not fulfilled its prior is 0, and the rest is raised by
//! the share of the prior that fulfils it, so that it integrates to 1:
//!
//! ```text
//!   ln Z = ln L^w(z*) - ½ z*ᵀz* - ½ ln det H - ln share       H = JᵀC⁻¹J + I; the prior's (2π)^(-k/2) and Laplace's (2π)^(k/2) cancel
//! ```

use super::hypothesis::{Bearing, Hypothesis, Prediction};
use super::noise::Observed;
use super::record::Trial;
use super::settings::{PRIOR_POINTS, STARTS};
use crate::algebra::{Factor, dot, log_sum_exp};
use nalgebra::{DMatrix, DVector};
use statistics::random::{Random, quasi_normal};

/// A place where the posterior is high.
pub(crate) struct Mode {
    /// Coordinates z*.
    pub at: Vec<f64>,
    /// Factor of H.
    pub curvature: Factor,
    /// ln Z.
    pub log_evidence: f64,
}

impl Mode {
    /// A place of the normal distribution by which Laplace's method takes the posterior.
    pub fn draw(&self, random: &mut Random) -> Vec<f64> {
        let mut step: Vec<f64> = self.at.iter().map(|_| random.normal()).collect();
        self.curvature.unwhiten_transposed(&mut step);
        self.at
            .iter()
            .zip(&step)
            .map(|(at, step)| at + step)
            .collect()
    }
}

/// All that a search for a mode needs.
pub(crate) struct Search<'a> {
    hypothesis: Hypothesis,
    tests: &'a [Trial],
    bearing: &'a Bearing<'a>,
    observed: &'a Observed,
}

impl<'a> Search<'a> {
    pub fn new(
        hypothesis: Hypothesis,
        tests: &'a [Trial],
        bearing: &'a Bearing<'a>,
        observed: &'a Observed,
    ) -> Self {
        Self {
            hypothesis,
            tests,
            bearing,
            observed,
        }
    }

    /// The most probable place; none where no parameters fulfil the claim.
    pub fn mode(&self) -> Option<Mode> {
        let (starts, claimed) = self.explore(PRIOR_POINTS);
        let modes = starts.iter().filter_map(|start| {
            let wide = self.observed.amplitudes.len() - 1;
            let (z, _) = self.climb(start, wide, 6);
            let (at, curvature) = self.climb(&z, self.best_amplitude(&z), 12);
            let logs = self.observed.log_likelihood(&self.predict(&at));
            let logs: Vec<f64> = logs.iter().map(|(log, _)| *log).collect();
            let curvature = curvature?;
            let log_evidence = log_sum_exp(&logs)
                - (logs.len() as f64).ln()
                - 0.5 * dot(&at, &at)
                - 0.5 * curvature.log_determinant
                - claimed.ln();
            Some(Mode {
                at,
                curvature,
                log_evidence,
            })
        });
        modes.max_by(|a, b| a.log_evidence.total_cmp(&b.log_evidence))
    }

    pub fn predict(&self, coordinates: &[f64]) -> Prediction {
        self.hypothesis
            .predict(coordinates, self.tests, self.bearing)
    }

    /// The best points of the prior and the share of the prior that fulfils the claim.
    fn explore(&self, points: u32) -> (Vec<Vec<f64>>, f64) {
        let size = self.hypothesis.parameters(self.bearing).len();
        if size == 0 {
            return (vec![Vec::new()], 1.0);
        }
        // the widest amplitude shows the way from afar
        let wide = self.observed.amplitudes.len() - 1;
        let mut found: Vec<(f64, Vec<f64>)> = Vec::new();
        for index in 1..=points as usize {
            let z: Vec<f64> = (0..size).map(|axis| quasi_normal(index, axis)).collect();
            let prediction = self.predict(&z);
            if prediction.claim >= 1.0 {
                let residual = self.observed.residual(&prediction, wide);
                found.push((dot(&residual, &residual), z));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let claimed = found.len() as f64 / f64::from(points);
        let mut starts: Vec<Vec<f64>> = Vec::new();
        for (_, z) in found {
            let apart = |other: &Vec<f64>| {
                let squares = other.iter().zip(&z).map(|(a, b)| (a - b).powi(2));
                squares.sum::<f64>() > 0.25
            };
            if starts.iter().all(apart) {
                starts.push(z);
            }
            if starts.len() == STARTS {
                break;
            }
        }
        (starts, claimed)
    }

    /// Penalty on a claim that is not fulfilled, as a residual.
    fn shortfall(prediction: &Prediction) -> f64 {
        10.0 * (1.05 - prediction.claim).max(0.0)
    }

    /// The amplitude at which a place is most probable.
    pub fn best_amplitude(&self, z: &[f64]) -> usize {
        let levels = self.observed.log_likelihood(&self.predict(z));
        (0..levels.len())
            .max_by(|i, j| levels[*i].0.total_cmp(&levels[*j].0))
            .unwrap_or(0)
    }

    /// Levenberg's and Marquardt's climb; the place and the factor of the curvature there.
    fn climb(&self, start: &[f64], amplitude: usize, rounds: u32) -> (Vec<f64>, Option<Factor>) {
        let size = start.len();
        let mut z = start.to_vec();
        // all that must be small: of data, of claim, of the prior
        let of = |z: &[f64]| {
            let prediction = self.predict(z);
            let mut all = self.observed.residual(&prediction, amplitude);
            all.push(Self::shortfall(&prediction));
            all.extend(z);
            all
        };
        let mut left = of(&z);
        let mut damping = 1e-2;
        for round in 0.. {
            let h = 1e-3;
            let mut slopes = DMatrix::zeros(left.len(), size);
            for axis in 0..size {
                let mut moved = z.clone();
                moved[axis] += h;
                for (row, (there, here)) in of(&moved).iter().zip(&left).enumerate() {
                    slopes[(row, axis)] = (there - here) / h;
                }
            }
            let hessian = slopes.tr_mul(&slopes);
            let gradient = slopes.tr_mul(&DVector::from_column_slice(&left));
            let height = dot(&left, &left);
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
                let moved: Vec<f64> = (z.iter().zip(&step)).map(|(z, s)| z - share * s).collect();
                let there = of(&moved);
                if dot(&there, &there) < height {
                    gained = height - dot(&there, &there);
                    (z, left) = (moved, there);
                    damping = (0.2 * damping).max(1e-6);
                    break;
                }
                damping *= 8.0;
            }
            if gained < 0.04 || round + 1 == rounds {
                return (z, Factor::of(hessian));
            }
        }
        (z, None)
    }
}
