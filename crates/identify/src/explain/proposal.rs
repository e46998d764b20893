//! Distributions that draws of an integral come from: Student's t and normal ones by location and curvature.

use super::evidence::Draw;
use super::linear::{Cholesky, dot, log_sum_exp};
use super::sampling::Random;

/// Part of the proposal: location, curvature, weight; Student's t or normal.
pub(crate) struct Component {
    pub at: Vec<f64>,
    pub curvature: Cholesky,
    pub weight: f64,
    pub student: bool,
}

/// Degrees of freedom of the proposals' tails.
const DEGREES: f64 = 5.0;

impl Component {
    /// Student's t with mean and covariance of the weighted draws.
    pub fn fitted(draws: &[Draw], size: usize) -> Option<Self> {
        let weights: Vec<f64> = draws.iter().map(|draw| draw.log_weight).collect();
        let total = log_sum_exp(&weights);
        if total == f64::NEG_INFINITY {
            return None;
        }
        let weights: Vec<f64> = weights
            .iter()
            .map(|weight| (weight - total).exp())
            .collect();
        let effective = 1.0 / dot(&weights, &weights);
        if effective < 3.0 * size as f64 {
            return None;
        }
        let mut mean = vec![0.0; size];
        for (draw, weight) in draws.iter().zip(&weights) {
            for (mean, z) in mean.iter_mut().zip(&draw.coordinates) {
                *mean += weight * z;
            }
        }
        let mut covariance = vec![0.0; size * size];
        for (draw, weight) in draws.iter().zip(&weights) {
            for i in 0..size {
                for j in 0..size {
                    covariance[i * size + j] +=
                        weight * (draw.coordinates[i] - mean[i]) * (draw.coordinates[j] - mean[j]);
                }
            }
        }
        for i in 0..size {
            covariance[i * size + i] += 1e-6;
        }
        let factor = Cholesky::of(&covariance, size)?;
        let mut inverse = vec![0.0; size * size];
        for i in 0..size {
            let mut column = vec![0.0; size];
            column[i] = 1.0;
            factor.solve(&mut column);
            for j in 0..size {
                inverse[j * size + i] = column[j];
            }
        }
        for i in 0..size {
            for j in 0..i {
                inverse[i * size + j] = inverse[j * size + i];
            }
        }
        Some(Self {
            at: mean,
            curvature: Cholesky::of(&inverse, size)?,
            weight: 0.5,
            student: true,
        })
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
    fn ratios_of_gamma_functions() {
        // Γ(5/2) = 1.329340, Γ(3) = 2, Γ(7/2) = 3.323351, Γ(4) = 6
        for (size, value) in [(1, 2.0), (2, 3.323_351), (3, 6.0)] {
            assert!((log_gamma_ratio(size) - (value / 1.329_340_f64).ln()).abs() < 1e-6);
        }
    }
}
