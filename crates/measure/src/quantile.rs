//! Medians and quantiles, and the noise that they show.

use statistics::normal::MEDIAN_OF_SIZE;

/// Median of finite values; zero of none.
pub(crate) fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    quantile(values, 0.5)
}

/// Value below which a fraction of the values lies; zero of none.
pub(crate) fn quantile(values: impl IntoIterator<Item = f64>, fraction: f64) -> f64 {
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
pub(crate) fn noise<const N: usize>(values: &[f64], weights: [f64; N]) -> f64 {
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
