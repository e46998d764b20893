//! Distributions that draws of an integral come from: Student's t and normal ones by location and curvature.

use super::draw::Draw;
use crate::algebra::{Factor, dot, log_sum_exp};
use measure::random::Random;
use nalgebra::DMatrix;

/// Part of the proposal: location, curvature, weight; Student's t or normal.
pub(crate) struct Component {
    pub at: Vec<f64>,
    pub curvature: Factor,
    pub weight: f64,
    pub student: bool,
}

/// Degrees of freedom of the proposals' tails.
const DEGREES: f64 = 5.0;

impl Component {
    /// Student's t with mean and covariance of the weighted draws, and the power to which their weights had to be raised so that
    /// enough of them count: below 1 the draws lie beside the posterior, and the component leads towards it.
    pub fn fitted(draws: &[Draw], size: usize) -> Option<(Self, f64)> {
        let logs: Vec<f64> = draws.iter().map(|draw| draw.log_weight).collect();
        let (weights, power) = tempered(&logs, 3.0 * size as f64)?;
        let mut mean = vec![0.0; size];
        for (draw, weight) in draws.iter().zip(&weights) {
            for (mean, z) in mean.iter_mut().zip(&draw.coordinates) {
                *mean += weight * z;
            }
        }
        // rows of √w (z - mean)
        let apart = DMatrix::from_fn(draws.len(), size, |draw, axis| {
            weights[draw].sqrt() * (draws[draw].coordinates[axis] - mean[axis])
        });
        let mut covariance = apart.tr_mul(&apart);
        for i in 0..size {
            covariance[(i, i)] *= 1.0 + 1e-6;
            covariance[(i, i)] += 1e-10;
        }
        let component = Self {
            at: mean,
            curvature: Factor::of(Factor::of(covariance)?.inverse())?,
            weight: 0.5,
            student: true,
        };
        Some((component, power))
    }

    pub fn sample(&self, random: &mut Random) -> Vec<f64> {
        let mut step: Vec<f64> = self.at.iter().map(|_| random.normal()).collect();
        self.curvature.unwhiten_transposed(&mut step);
        let stretch = if self.student {
            let square: f64 = (0..DEGREES as u32).map(|_| random.normal().powi(2)).sum();
            (DEGREES / square).sqrt()
        } else {
            1.0
        };
        (self.at.iter().zip(&step))
            .map(|(at, step)| at + stretch * step)
            .collect()
    }

    /// ln of its density.
    pub fn log_density(&self, z: &[f64]) -> f64 {
        let size = z.len() as f64;
        let difference: Vec<f64> = z.iter().zip(&self.at).map(|(z, at)| z - at).collect();
        // |Lᵀ d|², L the lower factor of the curvature
        let square = self.curvature.square_of(&difference);
        let half_determinant = 0.5 * self.curvature.log_determinant;
        if self.student {
            half_determinant + log_gamma_ratio(z.len())
                - 0.5 * size * (DEGREES * std::f64::consts::PI).ln()
                - 0.5 * (DEGREES + size) * (1.0 + square / DEGREES).ln()
        } else {
            half_determinant - 0.5 * (square + size * (2.0 * std::f64::consts::PI).ln())
        }
    }
}

/// Weights of draws raised to the largest power of at most 1 at which as many count as asked for, and that power; they sum to 1.
/// None where fewer draws have a weight at all.
///
/// Formula: n = 1/Σw²
///
/// - `logs`: ln of the weights
/// - `least`: how many must count
pub(crate) fn tempered(logs: &[f64], least: f64) -> Option<(Vec<f64>, f64)> {
    let usable = logs.iter().filter(|log| **log > f64::NEG_INFINITY).count();
    if (usable as f64) < least || usable == 0 {
        return None;
    }
    let raised = |power: f64| {
        let logs: Vec<f64> = (logs.iter())
            .map(|log| {
                if *log > f64::NEG_INFINITY {
                    power * log
                } else {
                    *log
                }
            })
            .collect();
        let total = log_sum_exp(&logs);
        logs.iter()
            .map(|log| (log - total).exp())
            .collect::<Vec<_>>()
    };
    let effective = |weights: &[f64]| 1.0 / dot(weights, weights);
    let whole = raised(1.0);
    if effective(&whole) >= least {
        return Some((whole, 1.0));
    }
    // all equal at a power of 0
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if effective(&raised(middle)) >= least {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some((raised(low), low))
}

/// ln Γ((5+n)/2) - ln Γ(5/2).
fn log_gamma_ratio(size: usize) -> f64 {
    let mut sum = 0.0;
    let mut from = 2.5;
    for _ in 0..size / 2 {
        sum += f64::ln(from);
        from += 1.0;
    }
    if size % 2 == 1 {
        // Γ(x+½)/Γ(x) for x = n + ½: n!/Γ(n+½)
        let n = (from - 0.5).round();
        let mut ratio = 1.0 / std::f64::consts::PI.sqrt();
        let mut k = 1.0;
        while k <= n {
            ratio *= k / (k - 0.5);
            k += 1.0;
        }
        sum += ratio.ln();
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_raised_until_enough_draws_count() {
        let logs = [0.0, -100.0, -200.0, f64::NEG_INFINITY];
        // two count at most where the third hardly does: w2 = e^(-100 p), 1/(1 + w2²)·(1 + w2)² = 2 only at p = 0
        let (weights, power) = tempered(&logs, 1.5).expect("three draws");
        assert!((1.0 / dot(&weights, &weights) - 1.5).abs() < 1e-6 && power < 0.1);
        assert_eq!(weights[3], 0.0);
        // as they are where enough count
        assert_eq!(tempered(&[0.0, 0.0], 2.0), Some((vec![0.5, 0.5], 1.0)));
        assert_eq!(tempered(&logs, 4.0), None);
        assert_eq!(tempered(&[], 0.0), None);
    }

    #[test]
    fn ratios_of_gamma_functions() {
        // Γ(5/2) = 1.329340, Γ(3) = 2, Γ(7/2) = 3.323351, Γ(4) = 6
        for (size, value) in [(1, 2.0), (2, 3.323_351), (3, 6.0)] {
            assert!((log_gamma_ratio(size) - (value / 1.329_340_f64).ln()).abs() < 1e-6);
        }
    }
}
