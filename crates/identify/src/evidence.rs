//! Evidence of a hypothesis by Laplace's method, for data whose errors are alike at neighbouring times.
//!
//! ```text
//!   L(θ)   likelihood of N data with independent errors        w = N_eff/N
//!   Z = ∫ L(θ)^w p(θ) dθ                                        evidence
//!   ln Z = w ln L(θ*) + ln p(θ*) + (k/2) ln 2π - ½ ln det H     θ* the largest of L^w p, H = -∇² ln(L^w p) there
//!
//!   N_eff = N/(1 + 2 Σ r_j)                                     r_j autocorrelation of the residuals, as long as positive
//! ```
//! Errors that share a correlation r_j make the sum of N of them as uncertain as that of N_eff independent ones. What distinguishes
//! hypotheses changes more slowly than errors do, so that N_eff data of independent errors would say as much: the likelihood to the
//! power w is theirs. Of the errors of prediction only what is left of the residuals is known, which is why the correlation is
//! taken from there, of the most probable hypothesis, and is one for all that are compared. Each of N_eff data can make odds of a
//! factor e at most before an error of its own is more probable than the odds: none beyond exp(N_eff) are stated.
//!
//! A second derivative by Gauss and Newton stands for H; where θ is linear in the data and normal, Laplace's method is exact.
//!
//! Source: Kass and Raftery 1995 (Laplace's method); the power of a composite likelihood by effective sample size.

use crate::algebra::{Factor, dot, log_sum_exp};
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// Effective number of data N_eff by residuals; at least 1 where there are any.
///
/// - `stretches`: residuals in units of their deviations, in the order of time, a list for each record
pub(crate) fn effective_number<'a>(stretches: impl Iterator<Item = &'a [f64]> + Clone) -> f64 {
    let count: usize = stretches.clone().map(<[f64]>::len).sum();
    let square: f64 = stretches.clone().map(|list| dot(list, list)).sum();
    let longest = stretches.clone().map(<[f64]>::len).max().unwrap_or(0);
    let mut sum = 0.0;
    for lag in 1..longest {
        let products = (stretches.clone().filter(|list| list.len() > lag))
            .map(|list| dot(&list[..list.len() - lag], &list[lag..]));
        let correlation = products.sum::<f64>() / square;
        // also not a number, of residuals that are all 0
        if correlation.is_nan() || correlation <= 0.0 {
            break;
        }
        sum += correlation;
    }
    (count as f64 / (1.0 + 2.0 * sum)).max(count.min(1) as f64)
}

/// ln of the evidence of each hypothesis, of which none lies further below the best than data of this number can say.
///
/// - `logs`: ln Z
/// - `effective`: N_eff
pub(crate) fn limited(logs: &[f64], effective: f64) -> Vec<f64> {
    let best = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // what cannot be at all stays so
    let limit = |log: &f64| match log.is_finite() {
        true => log.max(best - effective),
        false => *log,
    };
    logs.iter().map(limit).collect()
}

/// Probabilities of ln of weights.
pub(crate) fn shares(logs: &[f64]) -> Vec<f64> {
    let total = log_sum_exp(logs);
    logs.iter().map(|log| (log - total).exp()).collect()
}

/// ln of the evidence of a linear form y = X θ + e, θ ~ N(0, P⁻¹), summed over sizes σ of the errors and over P, all as likely.
///
/// Formula: ln Z = -½ [w N ln 2πσ² + w y²/σ² - bᵀA⁻¹b + ln|A| - ln|P|], A = w XᵀX/σ² + P, b = w Xᵀy/σ²
///
/// - `columns`: X, a row for each datum
/// - `precisions`: P
/// - `noises`: σ
/// - `weight`: w
pub(crate) fn linear(
    y: &[f64],
    columns: &DMatrix<f64>,
    precisions: &[DMatrix<f64>],
    noises: &[f64],
    weight: f64,
) -> f64 {
    let normal = columns.tr_mul(columns);
    let right = columns.tr_mul(&nalgebra::DVectorView::from_slice(y, y.len()));
    let tried = precisions.iter().flat_map(|precision| {
        let prior = Factor::of(precision.clone()).map(|factor| factor.log_determinant);
        let (normal, right) = (&normal, &right);
        noises.iter().filter_map(move |noise| {
            let certainty = weight / (noise * noise);
            let factor = Factor::of(normal * certainty + precision)?;
            let mut white = right * certainty;
            factor.whiten(white.as_mut_slice());
            let normalised = weight * y.len() as f64 * (TAU * noise * noise).ln();
            let squares = certainty * dot(y, y) - white.norm_squared();
            Some(-0.5 * (normalised + squares + factor.log_determinant - prior?))
        })
    });
    let logs: Vec<f64> = tried.filter(|log| log.is_finite()).collect();
    log_sum_exp(&logs) - ((noises.len() * precisions.len()) as f64).ln()
}

#[cfg(test)]
#[path = "../tests/unit/evidence.rs"]
mod tests;
