//! One curve against another.

use super::SteadyCurve;
use nalgebra::{DMatrix, DVector};
use statistics::normal::squares_above;
use statistics::uncertain::Uncertain;

/// Directions of a smaller variance, over the largest, do not count: of a smooth curve they are rounding.
const LEAST_VARIANCE: f64 = 1e-4;

/// Difference of two curves at their common speeds.
#[derive(Clone, Debug)]
pub struct Difference {
    /// Speeds at which both have a torque, rad/s.
    pub speed: Vec<f64>,
    /// First torque minus second.
    pub difference: Vec<f64>,
    /// Standard deviation of the difference, scales included.
    pub deviation: Vec<f64>,
    /// Mean of the difference over these speeds, and its standard deviation.
    pub mean: Uncertain,
    /// Probability that a difference as large comes about by chance where both curves are the same; small: they differ.
    pub chance: f64,
}

/// Sets two curves against each other that were drawn at the same speeds, up against down or direct against inertial.
///
/// Errors of the curves are taken as independent: a scale or a zero that both share must be left out of both. The chance is that of
/// the sum of squares over the directions in which the covariance is not negligible. Where a curve is more its smoothness than its
/// record, both curves leave the truth alike: such directions count by the part of their variance that is the record's.
/// Source: multivariate normal theory; Satterthwaite, Biometrics Bull. 2 (1946) 110, for a sum of squares of different sizes; Wilson
/// and Hilferty, PNAS 17 (1931) 684, for the tail (from memory).
pub fn compare(first: &SteadyCurve, second: &SteadyCurve) -> Result<Difference, String> {
    if first.speed != second.speed {
        return Err("two curves are compared at the same speeds only".into());
    }
    let common: Vec<usize> = (0..first.speed.len())
        .filter(|&k| first.torque[k].is_finite() && second.torque[k].is_finite())
        .collect();
    if common.is_empty() {
        return Err("the curves have no speed in common".into());
    }
    let difference: Vec<f64> = common
        .iter()
        .map(|&k| first.torque[k] - second.torque[k])
        .collect();
    let covariance = DMatrix::from_fn(common.len(), common.len(), |row, column| {
        let (i, j) = (common[row], common[column]);
        let of = |c: &SteadyCurve| {
            let scale = c.scale_deviation.powi(2) * c.torque[i] * c.torque[j];
            c.covariance[i][j] + scale + c.zero_deviation.powi(2)
        };
        of(first) + of(second)
    });
    let smoothing = DMatrix::from_fn(common.len(), common.len(), |row, column| {
        let of = |c: &SteadyCurve| Some(*c.smoothing.get(common[row])?.get(common[column])?);
        of(first).unwrap_or(0.0) + of(second).unwrap_or(0.0)
    });
    let count = common.len() as f64;
    let mean = difference.iter().sum::<f64>() / count;
    let spread = (covariance.sum().max(0.0)).sqrt() / count;
    let deviation: Vec<f64> = (0..common.len())
        .map(|k| covariance[(k, k)].max(0.0).sqrt())
        .collect();
    let (squares, directions) = squares(covariance, &smoothing, &difference);
    Ok(Difference {
        speed: common.iter().map(|&k| first.speed[k]).collect(),
        chance: squares_above(squares, directions),
        difference,
        deviation,
        mean: Uncertain::new(mean, spread),
    })
}

/// Sum of squares of the difference in units of its deviation along the main directions, and of how many normal numbers of
/// deviation 1 it is, both over the size that these have where they are smaller.
fn squares(covariance: DMatrix<f64>, smoothing: &DMatrix<f64>, difference: &[f64]) -> (f64, f64) {
    let main = covariance.symmetric_eigen();
    let least = LEAST_VARIANCE * main.eigenvalues.max();
    let kept: Vec<DVector<f64>> = (main.eigenvalues.iter())
        .zip(main.eigenvectors.column_iter())
        .filter(|(variance, _)| **variance > least)
        .map(|(variance, direction)| direction / variance.sqrt())
        .collect();
    if kept.is_empty() {
        return (0.0, 0.0);
    }
    let units = DMatrix::from_columns(&kept);
    let square = units
        .tr_mul(&DVector::from_column_slice(difference))
        .norm_squared();
    // covariance of the parts that the records differ by: a sum of their squares has its trace as mean, twice its square as variance
    let own = DMatrix::identity(kept.len(), kept.len()) - units.tr_mul(smoothing) * &units;
    let (mean, half_variance) = (own.trace(), own.norm_squared());
    let size = half_variance / mean;
    (square / size, mean / size)
}

#[cfg(test)]
#[path = "../../tests/unit/steady_curve_compare.rs"]
mod tests;
