//! Values over time: their rates, and errors that are alike at neighbouring times.

/// Weights of the trapezoidal rule, s.
pub(crate) fn trapezoid(time: &[f64]) -> Vec<f64> {
    let mut weights = vec![0.0; time.len()];
    for (k, pair) in time.windows(2).enumerate() {
        let half = 0.5 * (pair[1] - pair[0]);
        weights[k] += half;
        weights[k + 1] += half;
    }
    weights
}

/// Correlation of two errors some correlation times apart: exp(-2 apart).
///
/// Its integral over all times is τ, so that a record of length T holds T/τ independent errors: what a time "after which two errors
/// count as independent" means here.
pub(crate) fn alike(apart: f64) -> f64 {
    (-2.0 * apart.abs()).exp()
}

/// Shortest correlation time, s: errors that have none.
const LEAST_CORRELATION: f64 = 1e-9;

/// Age of noise in correlation times since the first time: what two times are apart, their errors are alike by [`alike`].
///
/// Formula: ∫dt/τ
pub(crate) fn ages(time: &[f64], correlation_time: &[f64]) -> Vec<f64> {
    let mut age = 0.0;
    let mut before: Option<(f64, f64)> = None;
    (time.iter().zip(correlation_time))
        .map(|(time, correlation)| {
            let rate = 1.0 / correlation.max(LEAST_CORRELATION);
            if let Some((last, last_rate)) = before {
                age += 0.5 * (rate + last_rate) * (time - last);
            }
            before = Some((*time, rate));
            age
        })
        .collect()
}

/// Variance of the running sum Σ a_k e_k, errors e of deviation 1 and correlation [`alike`].
#[derive(Default)]
pub(crate) struct RunningVariance {
    variance: f64,
    carried: f64,
    before: Option<f64>,
}

impl RunningVariance {
    /// Adds a term at an age in correlation times and returns the variance of the sum so far.
    pub(crate) fn add(&mut self, age: f64, factor: f64) -> f64 {
        if let Some(before) = self.before {
            self.carried *= alike(age - before);
        }
        self.variance += factor * factor + 2.0 * factor * self.carried;
        self.carried += factor;
        self.before = Some(age);
        self.variance
    }
}

/// Rate of a noisy list by a straight line over a window around each time, with its deviation.
///
/// The errors within half a window are taken as common: σ_rate = √6 σ/L, more than independent errors would give.
pub(crate) fn rates(
    time: &[f64],
    values: &[f64],
    deviation: &[f64],
    window: f64,
) -> Vec<(f64, f64)> {
    (0..time.len())
        .map(|k| {
            let mut first = time.partition_point(|&t| t < time[k] - 0.5 * window);
            let mut last = time.partition_point(|&t| t <= time[k] + 0.5 * window);
            if last - first < 3 {
                first = k.saturating_sub(1);
                last = (k + 2).min(time.len());
            }
            let count = (last - first) as f64;
            let mean = |list: &[f64]| list[first..last].iter().sum::<f64>() / count;
            let (middle, level) = (mean(time), mean(values));
            let (mut square, mut product) = (0.0, 0.0);
            for i in first..last {
                square += (time[i] - middle).powi(2);
                product += (time[i] - middle) * (values[i] - level);
            }
            let length = time[last - 1] - time[first];
            (product / square, 6_f64.sqrt() * mean(deviation) / length)
        })
        .collect()
}

/// The median of a list; 0 of an empty one.
pub(crate) fn median(list: &[f64]) -> f64 {
    let mut sorted = list.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
#[path = "../tests/unit/series.rs"]
mod tests;
