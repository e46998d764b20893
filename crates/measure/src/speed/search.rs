//! Search for the best parameters, and a picture of how well they are known.

use crate::normal::quantile;

/// Smallest value of a function by the simplex of Nelder and Mead, from a start and first steps.
///
/// Source: Nelder and Mead, The Computer Journal 7, 1965 (from memory).
pub(super) fn smallest<const D: usize>(
    start: [f64; D],
    steps: [f64; D],
    calls: usize,
    tolerance: f64,
    mut value: impl FnMut(&[f64; D]) -> f64,
) -> ([f64; D], f64) {
    let mut corners: Vec<([f64; D], f64)> = Vec::with_capacity(D + 1);
    corners.push((start, value(&start)));
    for k in 0..D {
        let mut corner = start;
        corner[k] += steps[k];
        corners.push((corner, value(&corner)));
    }
    let mut used = D + 1;
    while used < calls {
        corners.sort_by(|a, b| a.1.total_cmp(&b.1));
        if corners[D].1 - corners[0].1 < tolerance {
            break;
        }
        let centre: [f64; D] =
            std::array::from_fn(|i| corners[..D].iter().map(|c| c.0[i]).sum::<f64>() / D as f64);
        let worst = corners[D];
        let along = |factor: f64| -> [f64; D] {
            std::array::from_fn(|i| centre[i] + factor * (worst.0[i] - centre[i]))
        };
        let mut tried = (along(-1.0), 0.0);
        tried.1 = value(&tried.0);
        used += 1;
        if tried.1 < corners[0].1 {
            let far = along(-2.0);
            let there = value(&far);
            used += 1;
            corners[D] = if there < tried.1 { (far, there) } else { tried };
        } else if tried.1 < corners[D - 1].1 {
            corners[D] = tried;
        } else {
            let near = if tried.1 < worst.1 {
                along(-0.5)
            } else {
                along(0.5)
            };
            let there = value(&near);
            used += 1;
            if there < worst.1.min(tried.1) {
                corners[D] = (near, there);
            } else {
                let best = corners[0].0;
                for corner in &mut corners[1..] {
                    corner.0 = std::array::from_fn(|i| 0.5 * (best[i] + corner.0[i]));
                    corner.1 = value(&corner.0);
                }
                used += D;
            }
        }
    }
    corners.sort_by(|a, b| a.1.total_cmp(&b.1));
    corners[0]
}

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
            triangle = lower(&covariance);
        }
    }
    (found, evidence)
}

fn lower<const D: usize>(p: &[[f64; D]; D]) -> [[f64; D]; D] {
    let mut l = [[0.0; D]; D];
    for j in 0..D {
        let pivot = p[j][j] - (0..j).map(|k| l[j][k] * l[j][k]).sum::<f64>();
        l[j][j] = pivot.max(1e-12 * p[j][j]).sqrt();
        for i in j + 1..D {
            l[i][j] = (p[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>()) / l[j][j];
        }
    }
    l
}

/// Point of the sequence of Halton, mapped to a standard normal number.
fn quasi_normal(index: usize, dimension: usize) -> f64 {
    const BASES: [usize; 5] = [2, 3, 5, 7, 11];
    let base = BASES[dimension % BASES.len()];
    let (mut left, mut part, mut x) = (index, 1.0, 0.0);
    while left > 0 {
        part /= base as f64;
        x += part * (left % base) as f64;
        left /= base;
    }
    quantile(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bottom_of_a_bent_valley_is_found() {
        let valley = |x: &[f64; 2]| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2);
        let (best, value) = smallest([-1.2, 1.0], [0.5, 0.5], 400, 1e-12, valley);
        assert!(
            (best[0] - 1.0).abs() < 1e-4 && value < 1e-8,
            "{best:?} {value}"
        );
    }

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
