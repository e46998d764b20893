//! Linear forms against data whose residuals are alike at neighbouring times.
//!
//! ```text
//!   y = X θ + e,   θ ~ N(0, P⁻¹),   e_k = ρ e_{k-1} + σ √(1-ρ²) ε_k      within a stretch of record
//!   ln p(y | ρ, σ, P) = -½ [n ln 2πσ² + ln|R| + yᵀR⁻¹y/σ² - bᵀA⁻¹b + ln|A| - ln|P|],  A = XᵀR⁻¹X/σ² + P, b = XᵀR⁻¹y/σ²
//! ```
//! Summed over a grid of ρ (from 0 to 0.98, artanh ρ normal about 0.3), σ (level in its logarithm) and, for a spline, smoothness P.
//! Source: Bayesian linear regression; the inverse of R is that of a first-order autoregression.

pub(crate) mod spline;

use crate::algebra::{Factor, dot, log_sum_exp};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;
use std::ops::Range;

/// Correlations of neighbouring residuals that are tried.
const CORRELATIONS: [f64; 13] = [
    0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.87, 0.92, 0.95, 0.98,
];

/// Mean and deviation of artanh ρ expected: nearly any correlation up to 0.98, which would be noise that lasts fifty means. Assumed.
const EXPECTED: (f64, f64) = (0.3, 1.0);

/// ln of the probability expected of each correlation in the list, as far as half way to its neighbours.
fn correlation_priors() -> [f64; CORRELATIONS.len()] {
    let places = CORRELATIONS.map(f64::atanh);
    let logs = std::array::from_fn(|k| {
        let (before, after) = (k.saturating_sub(1), (k + 1).min(places.len() - 1));
        let width = 0.5 * (places[after] - places[before]);
        width.ln() - 0.5 * ((places[k] - EXPECTED.0) / EXPECTED.1).powi(2)
    });
    let total = log_sum_exp(&logs);
    logs.map(|log| log - total)
}

/// Means of a curve's place x and value y over equal parts of a record, in the order of time.
#[derive(Default)]
pub(crate) struct Data {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// Those that follow each other without a gap.
    pub stretches: Vec<Range<usize>>,
}

impl Data {
    /// Adds a stretch of record as means of so many values; one of fewer than three means is left out, as it says nothing of the
    /// correlation and little of the curve. Returns how many values went in.
    ///
    /// - `x`, `y`, `weights`: values and their weights in the means, of the same length
    pub fn add(&mut self, x: &[f64], y: &[f64], weights: &[f64], size: usize) -> usize {
        if x.len() / size < 3 {
            return 0;
        }
        let first = self.x.len();
        let taken = x.len() / size * size;
        for from in (0..taken).step_by(size) {
            let part = from..from + size;
            let whole: f64 = weights[part.clone()].iter().sum();
            let mean = |list: &[f64]| dot(&weights[part.clone()], &list[part.clone()]) / whole;
            self.x.push(mean(x));
            self.y.push(mean(y));
        }
        self.stretches.push(first..self.x.len());
        taken
    }

    /// Root mean square of y: the unit of the priors.
    pub fn level(&self) -> f64 {
        (dot(&self.y, &self.y) / self.y.len() as f64).sqrt()
    }

    /// The standard deviations of one mean that are tried, from less than what the changes between neighbours show to all there is.
    ///
    /// Third differences let a curve pass; white noise has √20 times its deviation in them, noise that correlates by 0.98 half.
    pub fn noises(&self) -> Vec<f64> {
        let (mut square, mut count) = (0.0, 0.0);
        for range in &self.stretches {
            for w in self.y[range.clone()].windows(4) {
                square += (w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]).powi(2) / 20.0;
                count += 1.0;
            }
        }
        let quick = (square / f64::max(count, 1.0)).sqrt();
        let level = self.level();
        let least = (0.5 * quick).max(1e-6 * level);
        let most = (10.0 * quick).max(level);
        let count = ((most / least).ln() / 0.2).ceil().clamp(1.0, 80.0) as usize;
        (0..=count)
            .map(|k| least * (most / least).powf(k as f64 / count as f64))
            .collect()
    }
}

/// Weight of a point of the grid below which it is left out.
const LEAST_WEIGHT: f64 = 1e-6;

/// What the data say of one form.
pub(crate) struct Posterior {
    pub mean: DVector<f64>,
    pub covariance: DMatrix<f64>,
    /// Part of the covariance that is the prior's alone, A⁻¹PA⁻¹: no repetition of the record would show it.
    pub prior: DMatrix<f64>,
    /// Correlation of neighbouring residuals.
    pub correlation: f64,
}

impl Posterior {
    /// Values and covariance of weighted sums of the coefficients, the weights by rows.
    pub fn drawn(&self, rows: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let covariance = rows * &self.covariance * rows.transpose();
        (rows * &self.mean, covariance)
    }

    /// Part of that covariance that is the prior's alone.
    pub fn drawn_prior(&self, rows: &DMatrix<f64>) -> DMatrix<f64> {
        rows * &self.prior * rows.transpose()
    }
}

/// Sums of products over all data, over those inside a stretch, and over neighbours.
struct Sums {
    all: DMatrix<f64>,
    inner: DMatrix<f64>,
    beside: DMatrix<f64>,
}

impl Sums {
    /// - `rows`: \[X y\]
    fn new(rows: &DMatrix<f64>, stretches: &[Range<usize>]) -> Self {
        let empty = || DMatrix::zeros(rows.ncols(), rows.ncols());
        let mut sums = Self {
            all: empty(),
            inner: empty(),
            beside: empty(),
        };
        for &Range { start, end } in stretches {
            let all = rows.rows_range(start..end);
            let inner = rows.rows_range(start + 1..end - 1);
            let beside = rows
                .rows_range(start + 1..end)
                .tr_mul(&rows.rows_range(start..end - 1));
            sums.all += all.tr_mul(&all);
            sums.inner += inner.tr_mul(&inner);
            sums.beside += beside.transpose() + beside;
        }
        sums
    }

    /// \[X y\]ᵀ R⁻¹ \[X y\].
    fn whitened(&self, correlation: f64) -> DMatrix<f64> {
        let square = correlation * correlation;
        (&self.all + square * &self.inner - correlation * &self.beside) / (1.0 - square)
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

/// Weighs a form; none if no prior is positive.
///
/// - `columns`: X, a row for each datum
/// - `precisions`: equally likely priors P
pub(crate) fn weighed(
    data: &Data,
    columns: &DMatrix<f64>,
    precisions: &[DMatrix<f64>],
) -> Option<Posterior> {
    let size = columns.ncols();
    let mut rows = columns.clone().insert_column(size, 0.0);
    rows.column_mut(size).copy_from_slice(&data.y);
    let sums = Sums::new(&rows, &data.stretches);
    let (count, stretches) = (data.y.len() as f64, data.stretches.len() as f64);
    let priors: Vec<f64> = precisions
        .iter()
        .map(|p| Factor::of(p.clone()).map(|factor| factor.log_determinant))
        .collect::<Option<_>>()?;
    let whitened = CORRELATIONS.map(|rho| sums.whitened(rho));
    let system = |white: &DMatrix<f64>, noise: f64, precision: &DMatrix<f64>| {
        let weight = 1.0 / (noise * noise);
        let matrix = white.view((0, 0), (size, size)) * weight + precision;
        (matrix, white.column(size).rows(0, size) * weight)
    };
    let noises = data.noises();
    let expected = correlation_priors();
    let mut points = Vec::new();
    for (place, (white, &correlation)) in whitened.iter().zip(&CORRELATIONS).enumerate() {
        let log_shape = (count - stretches) * (1.0 - correlation * correlation).ln();
        for &noise in &noises {
            for (precision, prior) in priors.iter().enumerate() {
                let (matrix, mut right) = system(white, noise, &precisions[precision]);
                let Some(factor) = Factor::of(matrix) else {
                    continue;
                };
                factor.whiten(right.as_mut_slice());
                let squares = white[(size, size)] / (noise * noise) - right.norm_squared();
                points.push(Point {
                    correlation: place,
                    noise,
                    precision,
                    log_weight: expected[place]
                        - 0.5
                            * (count * (TAU * noise * noise).ln()
                                + log_shape
                                + squares
                                + factor.log_determinant
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
    let weight = |point: &Point| (point.log_weight - top).exp();
    let total: f64 = points.iter().map(weight).sum();
    points.retain(|point| weight(point) > LEAST_WEIGHT * total);
    // what is left out must not be missing from the mean, nor its square from the covariance
    let kept: f64 = points.iter().map(weight).sum();
    let points: Vec<(f64, Point)> = (points.into_iter())
        .map(|point| (weight(&point) / kept, point))
        .collect();
    // Mean and covariance over the grid, the noise wider by a factor.
    let drawn = |wide: f64| {
        let own = points.iter().map(|(weight, point)| {
            let white = &whitened[point.correlation];
            let (matrix, right) = system(white, wide * point.noise, &precisions[point.precision]);
            let factor = Factor::of(matrix)?;
            let around = factor.inverse();
            let prior = &around * &precisions[point.precision] * &around;
            Some((*weight, factor.solved(&right), around, prior))
        });
        let own: Vec<_> = own.collect::<Option<_>>()?;
        let mut mean = DVector::zeros(size);
        for (weight, at, ..) in &own {
            mean += at * *weight;
        }
        let mut covariance = DMatrix::zeros(size, size);
        let mut prior = DMatrix::zeros(size, size);
        for (weight, at, around, held) in &own {
            let apart = at - &mean;
            covariance += (around + &apart * apart.transpose()) * *weight;
            prior += held * *weight;
        }
        Some((mean, covariance, prior))
    };
    let over = |f: &dyn Fn(&Point) -> f64| points.iter().map(|(w, p)| w * f(p)).sum::<f64>();
    let correlation = over(&|point| CORRELATIONS[point.correlation]);
    let (mean, ..) = drawn(1.0)?;
    let residual = DVector::from_column_slice(&data.y) - columns * &mean;
    let wide = colour(residual.as_slice(), &data.stretches, correlation);
    let (mean, covariance, prior) = drawn(wide.sqrt())?;
    Some(Posterior {
        mean,
        covariance,
        prior,
        correlation,
    })
}

/// Factor on the variance of the noise for what a first-order autoregression leaves in the residuals: 1 + 2Σ r_k of what should
/// be white, lags falling in weight to 0 (Bartlett) after a few, or three correlation lengths up to twenty; at least 1.
fn colour(residual: &[f64], stretches: &[Range<usize>], correlation: f64) -> f64 {
    let lags = (3.0 / (1.0 - correlation)).clamp(5.0, 20.0) as usize;
    let mut square = 0.0;
    let mut products = vec![0.0; lags];
    for range in stretches {
        let own: Vec<f64> = residual[range.clone()]
            .windows(2)
            .map(|p| p[1] - correlation * p[0])
            .collect();
        for (lag, product) in products.iter_mut().enumerate() {
            let later = own.get(lag + 1..).unwrap_or(&[]);
            *product += dot(&own[..later.len()], later);
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

#[cfg(test)]
#[path = "../../tests/unit/regression.rs"]
mod tests;
