//! A picture of how well parameters are known.

use statistics::linear::lower;
use statistics::random::quasi_normal;

/// Points spread as a density `exp(-value)`, with weights and the logarithm of the integral of the density.
///
/// Importance sampling with a normal density that is fitted to its own result in three rounds; points are a quasi-random
/// sequence, so that the same data give the same answer.
///
/// Source: Cappé, Guillin, Marin and Robert, J. Comput. Graph. Stat. 13, 2004 (from memory): population Monte Carlo.
pub(super) fn spread<const D: usize>(
    best: [f64; D],
    guess: [f64; D],
    points: usize,
    mut value: impl FnMut(&[f64; D]) -> f64,
) -> (Vec<([f64; D], f64)>, f64) {
    let mut centre = best;
    let mut triangle = [[0.0; D]; D];
    for k in 0..D {
        triangle[k][k] = guess[k];
    }
    let mut found = Vec::new();
    let mut evidence = f64::NEG_INFINITY;
    for round in 0..3 {
        let mut logs = Vec::with_capacity(points);
        found.clear();
        let volume: f64 = (0..D).map(|k| triangle[k][k].ln()).sum();
        for k in 0..points {
            let normal: [f64; D] = std::array::from_fn(|i| quasi_normal(k + 1 + round * points, i));
            let point: [f64; D] = std::array::from_fn(|i| {
                centre[i] + (0..=i).map(|j| triangle[i][j] * normal[j]).sum::<f64>()
            });
            let square: f64 = normal.iter().map(|x| x * x).sum();
            logs.push(-value(&point) + 0.5 * square + volume);
            found.push((point, 0.0));
        }
        let top = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if !top.is_finite() {
            return (vec![(best, 1.0)], f64::NEG_INFINITY);
        }
        let total: f64 = logs.iter().map(|l| (l - top).exp()).sum();
        evidence = top + (total / points as f64).ln();
        for (entry, log) in found.iter_mut().zip(&logs) {
            entry.1 = (log - top).exp() / total;
        }
        if round < 2 {
            // A single heavy point must not shrink the density to nothing: its weight is tempered.
            let heaviest = found.iter().map(|f| f.1).fold(0.0, f64::max);
            let power = if heaviest > 0.3 { 0.5 } else { 1.0 };
            let sum: f64 = found.iter().map(|f| f.1.powf(power)).sum();
            centre = std::array::from_fn(|i| {
                found.iter().map(|f| f.1.powf(power) * f.0[i]).sum::<f64>() / sum
            });
            let mut covariance = [[0.0; D]; D];
            for (point, weight) in &found {
                for i in 0..D {
                    for j in 0..D {
                        covariance[i][j] += 1.3 * weight.powf(power) / sum
                            * (point[i] - centre[i])
                            * (point[j] - centre[j]);
                    }
                }
            }
            for i in 0..D {
                covariance[i][i] += (0.02 * guess[i]).powi(2);
            }
            // where rounding leaves no covariance the density stays as it was
            triangle = lower(&covariance).unwrap_or(triangle);
        }
    }
    (found, evidence)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_have_the_moments_and_the_integral_of_their_density() {
        // A normal density with correlation, three times too narrow a guess, and half a deviation beside its top.
        let (sx, sy, r) = (2.0, 0.3, 0.8);
        let value = |p: &[f64; 2]| {
            let (x, y) = ((p[0] - 5.0) / sx, (p[1] + 1.0) / sy);
            0.5 * (x * x - 2.0 * r * x * y + y * y) / (1.0 - r * r)
        };
        let (points, evidence) = spread([6.0, -0.9], [0.7, 0.1], 200, value);
        let mean =
            |of: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(|(p, w)| w * of(p)).sum::<f64>();
        // 200 points: 0.07 of a standard deviation; three times that.
        assert!((mean(&|p| p[0]) - 5.0).abs() < 0.2 * sx);
        assert!((mean(&|p| ((p[1] + 1.0) / sy).powi(2)) - 1.0).abs() < 0.3);
        assert!((mean(&|p| (p[0] - 5.0) / sx * (p[1] + 1.0) / sy) - r).abs() < 0.3);
        // The integral over the normal density of the same dimension: sx sy √(1 - r²).
        assert!(
            (evidence - (sx * sy * (1.0 - r * r).sqrt()).ln()).abs() < 0.2,
            "{evidence}"
        );
    }
}
