//! Medians and quantiles, and the noise and the steps that they show.

use crate::normal::MEDIAN_OF_SIZE;

/// Part of the differences between neighbours that are none from which on the values come in steps.
const IN_STEPS: f64 = 0.2;

/// Median of finite values; zero of none.
pub fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    quantile(values, 0.5)
}

/// Value below which a fraction of the values lies; zero of none.
pub fn quantile(values: impl IntoIterator<Item = f64>, fraction: f64) -> f64 {
    let mut values: Vec<f64> = values.into_iter().collect();
    if values.is_empty() {
        return 0.0;
    }
    let place = ((values.len() - 1) as f64 * fraction).round() as usize;
    *values.select_nth_unstable_by(place, f64::total_cmp).1
}

/// Standard deviation of the white noise of values, from differences of neighbours that let pass what is smooth; outliers hardly
/// move it. Of no finite difference nothing is known: that of a median of 1.
///
/// - `weights`: of the neighbours in a difference
pub fn noise<const N: usize>(values: &[f64], weights: [f64; N]) -> f64 {
    let differences = values.windows(N).map(|near| {
        let terms = near
            .iter()
            .zip(&weights)
            .map(|(value, weight)| value * weight);
        terms.sum::<f64>().abs()
    });
    let square: f64 = weights.iter().map(|weight| weight * weight).sum();
    let sizes: Vec<f64> = differences.filter(|size| size.is_finite()).collect();
    let middle = if sizes.is_empty() { 1.0 } else { median(sizes) };
    middle / MEDIAN_OF_SIZE / square.sqrt()
}

/// The smallest step between neighbouring values, where many of them are equal; else 0.
pub fn step(values: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = (values.windows(2))
        .map(|pair| (pair[1] - pair[0]).abs())
        .filter(|size| size.is_finite())
        .collect();
    let all = sizes.len();
    let largest = values.iter().fold(0.0f64, |most, v| most.max(v.abs()));
    // What rounding of a text leaves is no step.
    sizes.retain(|size| *size > 1e-9 * largest);
    if sizes.is_empty() || ((all - sizes.len()) as f64) < IN_STEPS * all as f64 {
        return 0.0;
    }
    quantile(sizes, 0.02)
}
