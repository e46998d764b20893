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
mod tests {
    use super::*;

    #[test]
    fn the_running_variance_is_the_double_sum() {
        let time = [0.0, 0.3, 0.35, 1.0, 1.2];
        let factor = [1.0, -0.5, 2.0, 0.7, 0.1];
        let mut running = RunningVariance::default();
        let mut last = 0.0;
        for (t, a) in time.iter().zip(factor) {
            last = running.add(*t / 0.8, a);
        }
        let mut sum = 0.0;
        for i in 0..5 {
            for j in 0..5 {
                sum += factor[i] * factor[j] * (-2.0_f64 * (time[i] - time[j]).abs() / 0.8).exp();
            }
        }
        assert!((last / sum - 1.0).abs() < 1e-13);
    }
    #[test]
    fn a_straight_line_is_found_with_its_rate() {
        let time: Vec<f64> = (0..50).map(|k| 0.01 * f64::from(k)).collect();
        let values: Vec<f64> = time.iter().map(|t| 3.0 - 40.0 * t).collect();
        for (rate, deviation) in rates(&time, &values, &[0.1; 50], 0.1) {
            assert!((rate + 40.0).abs() < 1e-10 && deviation > 2.4);
        }
    }
}
