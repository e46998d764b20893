//! One curve against another.

use super::SteadyCurve;
use crate::normal::squares_above;

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
    pub mean: crate::uncertain::Uncertain,
    /// Probability that a difference as large comes about by chance where both curves are the same; small: they differ.
    pub chance: f64,
}

/// Sets two curves against each other that were drawn at the same speeds, up against down or direct against inertial.
///
/// Errors of the curves are taken as independent: a scale or a zero that both share must be left out of both. The chance is that of the sum of squares over the directions in which the
/// covariance is not negligible. Source: multivariate normal theory; Wilson and Hilferty, PNAS 17 (1931) 684, for the tail (from
/// memory).
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
    let covariance: Vec<Vec<f64>> = common
        .iter()
        .map(|&i| {
            common
                .iter()
                .map(|&j| {
                    let of = |c: &SteadyCurve| {
                        let scale = c.scale_deviation.powi(2) * c.torque[i] * c.torque[j];
                        c.covariance[i][j] + scale + c.zero_deviation.powi(2)
                    };
                    of(first) + of(second)
                })
                .collect()
        })
        .collect();
    let count = common.len() as f64;
    let mean = difference.iter().sum::<f64>() / count;
    let spread = (covariance.iter().flatten().sum::<f64>().max(0.0)).sqrt() / count;
    let deviation: Vec<f64> = (0..common.len())
        .map(|k| covariance[k][k].max(0.0).sqrt())
        .collect();
    let (squares, directions) = squares(covariance, &difference);
    Ok(Difference {
        speed: common.iter().map(|&k| first.speed[k]).collect(),
        chance: squares_above(squares, directions),
        difference,
        deviation,
        mean: crate::uncertain::Uncertain::new(mean, spread),
    })
}

#[allow(clippy::needless_range_loop)] // two rows at a time
/// Sum of squares of the difference in units of its deviation along the main directions, and their number. By Jacobi rotations.
fn squares(mut a: Vec<Vec<f64>>, difference: &[f64]) -> (f64, usize) {
    let n = a.len();
    let mut along = difference.to_vec();
    for _ in 0..30 {
        let off: f64 = (0..n)
            .map(|i| (0..i).map(|j| a[i][j] * a[i][j]).sum::<f64>())
            .sum();
        let trace: f64 = (0..n).map(|i| a[i][i] * a[i][i]).sum();
        if off <= 1e-24 * trace {
            break;
        }
        for p in 1..n {
            for q in 0..p {
                if a[p][q] == 0.0 {
                    continue;
                }
                let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                let sign = if theta >= 0.0 { 1.0 } else { -1.0 };
                let t = sign / (theta.abs() + theta.hypot(1.0));
                let c = 1.0 / t.hypot(1.0);
                let s = t * c;
                for row in &mut a {
                    let (x, y) = (row[p], row[q]);
                    row[p] = c * x - s * y;
                    row[q] = s * x + c * y;
                }
                for k in 0..n {
                    let (x, y) = (a[p][k], a[q][k]);
                    a[p][k] = c * x - s * y;
                    a[q][k] = s * x + c * y;
                }
                let (x, y) = (along[p], along[q]);
                along[p] = c * x - s * y;
                along[q] = s * x + c * y;
            }
        }
    }
    let largest = (0..n).map(|i| a[i][i]).fold(0.0, f64::max);
    let kept: Vec<usize> = (0..n).filter(|&i| a[i][i] > 1e-4 * largest).collect();
    (
        kept.iter().map(|&i| along[i] * along[i] / a[i][i]).sum(),
        kept.len(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_do_not_depend_on_the_axes() {
        // Covariance [[2, 1], [1, 2]]: inverse [[2, -1], [-1, 2]]/3; for (1, 3): (2 - 6 + 18)/3.
        let (sum, directions) = squares(vec![vec![2.0, 1.0], vec![1.0, 2.0]], &[1.0, 3.0]);
        assert_eq!(directions, 2);
        assert!((sum - 14.0 / 3.0).abs() < 1e-12);
    }
}
