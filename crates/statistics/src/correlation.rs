//! Correlated inputs: a Gaussian copula.
//!
//! Independent coordinates become normal numbers, these are mixed by the Cholesky factor of their correlation, and become
//! coordinates again: every marginal stays what it is, and normal inputs have just this correlation.
//!
//! Source: Nelsen, An Introduction to Copulas, 2nd ed. (2006), section 2.3 (from memory)

use crate::normal::{below, quantile};

/// The lower factor of a correlation of the normal numbers behind the coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Correlation {
    factor: Vec<Vec<f64>>,
}

impl Correlation {
    /// Of pairs of coordinates with their coefficients; all other pairs are independent. None where no numbers can have these
    /// together: the matrix is not positive definite.
    pub fn of(count: usize, pairs: &[(usize, usize, f64)]) -> Option<Correlation> {
        let mut matrix = vec![vec![0.0; count]; count];
        for (k, row) in matrix.iter_mut().enumerate() {
            row[k] = 1.0;
        }
        for &(a, b, coefficient) in pairs {
            matrix[a][b] = coefficient;
            matrix[b][a] = coefficient;
        }
        let mut factor = vec![vec![0.0; count]; count];
        for i in 0..count {
            for j in 0..=i {
                let sum: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
                let left = matrix[i][j] - sum;
                factor[i][j] = match i == j {
                    true if left > 1e-12 => left.sqrt(),
                    true => return None,
                    false => left / factor[j][j],
                };
            }
        }
        Some(Correlation { factor })
    }

    /// Coordinates with this correlation from independent ones.
    pub fn apply(&self, coordinates: &[f64]) -> Vec<f64> {
        let normal: Vec<f64> = coordinates.iter().map(|u| quantile(*u)).collect();
        let mixed = |row: &Vec<f64>| row.iter().zip(&normal).map(|(l, z)| l * z).sum::<f64>();
        self.factor
            .iter()
            .map(|row| inside(below(mixed(row))))
            .collect()
    }
}

/// A share that every distribution has a value for.
pub(crate) fn inside(share: f64) -> f64 {
    share.clamp(f64::EPSILON, 1.0 - f64::EPSILON)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::uniform;

    #[test]
    fn the_correlation_of_normals_is_recovered() {
        let correlation = Correlation::of(3, &[(0, 1, 0.8), (1, 2, -0.5)]).unwrap();
        let count = 20_000;
        let points: Vec<Vec<f64>> = (0..count)
            .map(|k| {
                let independent: Vec<f64> = (0..3).map(|column| uniform(3, k, column)).collect();
                correlation
                    .apply(&independent)
                    .into_iter()
                    .map(quantile)
                    .collect()
            })
            .collect();
        let found = |a: usize, b: usize| {
            let sum = |f: &dyn Fn(&Vec<f64>) -> f64| points.iter().map(f).sum::<f64>();
            sum(&|p| p[a] * p[b]) / (sum(&|p| p[a] * p[a]) * sum(&|p| p[b] * p[b])).sqrt()
        };
        // deviation (1 - ρ²)/√n: 5 of these
        assert!((found(0, 1) - 0.8).abs() < 5.0 * 0.36 / (count as f64).sqrt());
        assert!((found(1, 2) + 0.5).abs() < 5.0 * 0.75 / (count as f64).sqrt());
        assert!(found(0, 2).abs() < 5.0 / (count as f64).sqrt());
    }

    #[test]
    fn what_cannot_be_together_is_refused() {
        let pairs = [(0, 1, 0.9), (1, 2, 0.9), (0, 2, -0.9)];
        assert_eq!(Correlation::of(3, &pairs), None);
        assert_eq!(Correlation::of(2, &[(0, 1, 1.0)]), None);
    }
}
