//! One linear form against data whose residuals are alike at neighbouring times.
//!
//! ```text
//!   y = X θ + e,   θ ~ N(0, P⁻¹),   e_k = ρ e_{k-1} + σ √(1-ρ²) ε_k      within a stretch of record
//!   ln p(y | ρ, σ, P) = -½ [n ln 2πσ² + ln|R| + yᵀR⁻¹y/σ² - bᵀA⁻¹b + ln|A| - ln|P|],  A = XᵀR⁻¹X/σ² + P, b = XᵀR⁻¹y/σ²
//! ```
//! Summed over a grid of ρ (level from 0 to 0.98), σ (level in its logarithm) and, for a spline, smoothness P.
//! Source: Bayesian linear regression; the inverse of R is that of a first-order autoregression.

use super::blocks::Blocks;
use crate::dense::{Matrix, between, cholesky, dot, inverse, log_determinant, solved, zeros};
use std::f64::consts::TAU;

/// Correlations of neighbouring residuals that are tried.
const CORRELATIONS: [f64; 13] = [
    0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.87, 0.92, 0.95, 0.98,
];

/// What the data say of one form.
pub(super) struct Posterior {
    /// Logarithm of the probability density of the data.
    pub(super) log_evidence: f64,
    pub(super) mean: Vec<f64>,
    pub(super) covariance: Matrix,
    /// Correlation of neighbouring residuals.
    pub(super) correlation: f64,
    /// Standard deviation of one block, N m.
    pub(super) noise: f64,
}

/// The standard deviations of one block that are tried, from less than the changes between neighbours tell to all there is.
pub(super) fn noises(blocks: &Blocks) -> Vec<f64> {
    let mut steps = Vec::new();
    for range in &blocks.stretches {
        steps.extend(
            blocks.y[range.clone()]
                .windows(2)
                .map(|p| (p[1] - p[0]).powi(2)),
        );
    }
    let step = (steps.iter().sum::<f64>() / steps.len().max(1) as f64).sqrt();
    let level = blocks.level();
    // Neighbours that correlate by 0.98 differ by a fifth of their deviation; a form that does not fit leaves all the data.
    let least = (0.4 * step).max(1e-6 * level);
    let most = (6.0 * step).max(level);
    let count = ((most / least).ln() / 0.2).ceil().clamp(1.0, 80.0) as usize;
    (0..=count)
        .map(|k| least * (most / least).powf(k as f64 / count as f64))
        .collect()
}

/// Sums of products over all blocks, over those inside a stretch, and over neighbours.
struct Sums {
    all: Matrix,
    inner: Matrix,
    beside: Matrix,
    stretches: f64,
    count: f64,
}

impl Sums {
    /// The last column is y.
    fn new(blocks: &Blocks, columns: &Matrix) -> Self {
        let size = columns[0].len() + 1;
        let row = |k: usize| {
            columns[k]
                .iter()
                .copied()
                .chain([blocks.y[k]])
                .collect::<Vec<f64>>()
        };
        let mut sums = Self {
            all: zeros(size, size),
            inner: zeros(size, size),
            beside: zeros(size, size),
            stretches: blocks.stretches.len() as f64,
            count: blocks.y.len() as f64,
        };
        for range in &blocks.stretches {
            let mut before: Option<Vec<f64>> = None;
            for k in range.clone() {
                let own = row(k);
                let inside = k > range.start && k + 1 < range.end;
                for i in 0..size {
                    for j in 0..size {
                        let product = own[i] * own[j];
                        sums.all[i][j] += product;
                        if inside {
                            sums.inner[i][j] += product;
                        }
                        if let Some(before) = &before {
                            sums.beside[i][j] += own[i] * before[j] + before[i] * own[j];
                        }
                    }
                }
                before = Some(own);
            }
        }
        sums
    }

    /// [X y]ᵀ R⁻¹ [X y].
    fn whitened(&self, correlation: f64) -> Matrix {
        let scale = 1.0 / (1.0 - correlation * correlation);
        let size = self.all.len();
        let mut sum = zeros(size, size);
        for (i, row) in sum.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value = scale
                    * (self.all[i][j] + correlation * correlation * self.inner[i][j]
                        - correlation * self.beside[i][j]);
            }
        }
        sum
    }
}

/// One point of the grid.
struct Point {
    /// Place of its correlation in the list.
    correlation: usize,
    noise: f64,
    precision: usize,
    log_weight: f64,
}

/// Weighs a form. `columns` by rows of blocks; `precisions` are equally likely priors P; none if no prior is positive.
pub(super) fn weighed(
    blocks: &Blocks,
    columns: &Matrix,
    precisions: &[Matrix],
    noises: &[f64],
) -> Option<Posterior> {
    let size = columns[0].len();
    let sums = Sums::new(blocks, columns);
    let priors: Vec<f64> = precisions
        .iter()
        .map(|p| cholesky(p.clone()).map(|factor| log_determinant(&factor)))
        .collect::<Option<_>>()?;
    let whitened: Vec<Matrix> = CORRELATIONS.iter().map(|&rho| sums.whitened(rho)).collect();
    let system = |white: &Matrix, noise: f64, precision: &Matrix| {
        let weight = 1.0 / (noise * noise);
        let matrix: Matrix = (0..size)
            .map(|i| {
                (0..size)
                    .map(|j| weight * white[i][j] + precision[i][j])
                    .collect()
            })
            .collect();
        let right: Vec<f64> = (0..size).map(|i| weight * white[i][size]).collect();
        (matrix, right)
    };
    let mut points = Vec::new();
    for (place, (white, &correlation)) in whitened.iter().zip(&CORRELATIONS).enumerate() {
        let log_shape = (sums.count - sums.stretches) * (1.0 - correlation * correlation).ln();
        for &noise in noises {
            for (precision, prior) in priors.iter().enumerate() {
                let (matrix, right) = system(white, noise, &precisions[precision]);
                let Some(factor) = cholesky(matrix) else {
                    continue;
                };
                let explained = dot(&right, &solved(&factor, &right));
                let squares = white[size][size] / (noise * noise) - explained;
                points.push(Point {
                    correlation: place,
                    noise,
                    precision,
                    log_weight: -0.5
                        * (sums.count * (TAU * noise * noise).ln()
                            + log_shape
                            + squares
                            + log_determinant(&factor)
                            - prior),
                });
            }
        }
    }
    points.retain(|point| point.log_weight.is_finite());
    let top = points
        .iter()
        .fold(f64::NEG_INFINITY, |a, p| a.max(p.log_weight));
    if !top.is_finite() {
        return None;
    }
    let tried = (CORRELATIONS.len() * noises.len() * precisions.len()) as f64;
    let total: f64 = points.iter().map(|p| (p.log_weight - top).exp()).sum();
    let points: Vec<(f64, Point)> = points
        .into_iter()
        .map(|point| ((point.log_weight - top).exp() / total, point))
        .filter(|(weight, _)| *weight > 1e-6)
        .collect();
    // Mean and covariance over the grid, the noise wider by a factor.
    let drawn = |wide: f64| {
        let mut mean = vec![0.0; size];
        let mut square = zeros(size, size);
        for (weight, point) in &points {
            let white = &whitened[point.correlation];
            let (matrix, right) = system(white, wide * point.noise, &precisions[point.precision]);
            let factor = cholesky(matrix)?;
            let own_mean = solved(&factor, &right);
            let own = inverse(&factor);
            for i in 0..size {
                mean[i] += weight * own_mean[i];
                for j in 0..size {
                    square[i][j] += weight * (own[i][j] + own_mean[i] * own_mean[j]);
                }
            }
        }
        for (row, a) in square.iter_mut().zip(&mean) {
            for (value, b) in row.iter_mut().zip(&mean) {
                *value -= a * b;
            }
        }
        Some((mean, square))
    };
    let over = |f: &dyn Fn(&Point) -> f64| points.iter().map(|(w, p)| w * f(p)).sum::<f64>();
    let correlation = over(&|point| CORRELATIONS[point.correlation]);
    let (mean, _) = drawn(1.0)?;
    let wide = colour(blocks, columns, &mean, correlation);
    let (mean, covariance) = drawn(wide.sqrt())?;
    Some(Posterior {
        log_evidence: top + (total / tried).ln(),
        mean,
        covariance,
        correlation,
        noise: over(&|point| point.noise),
    })
}

/// Factor on the variance of the noise for what a first-order autoregression leaves in the residuals: 1 + 2Σ r_k of what should
/// be white, lags falling in weight to 0 (Bartlett) after a few, or three correlation lengths up to twenty; at least 1.
fn colour(blocks: &Blocks, columns: &Matrix, mean: &[f64], correlation: f64) -> f64 {
    let lags = (3.0 / (1.0 - correlation)).clamp(5.0, 20.0) as usize;
    let mut square = 0.0;
    let mut products = vec![0.0; lags];
    for range in &blocks.stretches {
        let rest: Vec<f64> = range
            .clone()
            .map(|k| blocks.y[k] - dot(&columns[k], mean))
            .collect();
        let own: Vec<f64> = rest.windows(2).map(|p| p[1] - correlation * p[0]).collect();
        for (lag, product) in products.iter_mut().enumerate() {
            let later = own.iter().skip(lag + 1);
            *product += own.iter().zip(later).map(|(a, b)| a * b).sum::<f64>();
        }
        square += dot(&own, &own);
    }
    let weighted: f64 = products
        .iter()
        .enumerate()
        .map(|(lag, product)| (1.0 - (lag + 1) as f64 / (lags + 1) as f64) * product)
        .sum();
    if square > 0.0 {
        (1.0 + 2.0 * weighted / square).max(1.0)
    } else {
        1.0
    }
}

/// The covariance of rows of two curves.
pub(super) fn covariance(rows: &Matrix, posterior: &Posterior) -> Matrix {
    let size = rows.len();
    let mut sum = zeros(size, size);
    for i in 0..size {
        for j in 0..=i {
            let value = between(&rows[i], &posterior.covariance, &rows[j]);
            sum[i][j] = value;
            sum[j][i] = value;
        }
    }
    sum
}
