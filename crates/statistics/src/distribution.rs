//! How a value is distributed, by its quantiles: numbers in, numbers out.

use crate::normal::quantile;

/// How a value is distributed.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// Mean and standard deviation.
    Normal(f64, f64),
    /// Median and standard deviation of the logarithm.
    Lognormal(f64, f64),
    /// Evenly between two values.
    Uniform(f64, f64),
    /// Between the first and the last value, most often near the middle one.
    Triangular(f64, f64, f64),
    /// The numbers 0, 1, …, each as often as the others.
    Discrete(usize),
}

impl Distribution {
    /// The value below which the share `u` in (0, 1) lies.
    pub fn quantile(&self, u: f64) -> f64 {
        match *self {
            Distribution::Normal(mean, deviation) => mean + deviation * quantile(u),
            Distribution::Lognormal(median, deviation) => median * (deviation * quantile(u)).exp(),
            Distribution::Uniform(low, high) => low + (high - low) * u,
            Distribution::Triangular(low, middle, high) => triangular(low, middle, high, u),
            Distribution::Discrete(count) => ((u * count as f64) as usize).min(count - 1) as f64,
        }
    }

    /// Level `at` of `of` levels: from end to end where there are ends, else the middles of parts that are equally frequent.
    pub fn level(&self, at: usize, of: usize) -> f64 {
        let part = match of {
            1 => 0.5,
            _ => at as f64 / (of - 1) as f64,
        };
        match *self {
            Distribution::Normal(..) | Distribution::Lognormal(..) => {
                self.quantile((at as f64 + 0.5) / of as f64)
            }
            Distribution::Uniform(low, high) | Distribution::Triangular(low, _, high) => {
                low + (high - low) * part
            }
            Distribution::Discrete(_) => at as f64,
        }
    }
}

/// The value below which the share `u` of a triangular distribution lies.
pub fn triangular(low: f64, middle: f64, high: f64, u: f64) -> f64 {
    let width = high - low;
    if width <= 0.0 {
        return middle;
    }
    if u * width < middle - low {
        low + (u * width * (middle - low)).sqrt()
    } else {
        high - ((1.0 - u) * width * (high - middle)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marginals_have_their_means_deviations_and_quantiles() {
        let s = 0.3_f64;
        let cases = [
            (Distribution::Normal(3.0, 0.5), 3.0, 0.5, 3.0),
            (
                Distribution::Lognormal(2.0, s),
                2.0 * (0.5 * s * s).exp(),
                2.0 * (0.5 * s * s).exp() * ((s * s).exp() - 1.0).sqrt(),
                2.0,
            ),
            (
                Distribution::Uniform(-1.0, 2.0),
                0.5,
                3.0 / 12.0_f64.sqrt(),
                0.5,
            ),
            // mean (a + b + c)/3, variance (a² + b² + c² - ab - bc - ca)/18; the median of 1, 2, 5 is 5 - √6
            (
                Distribution::Triangular(1.0, 2.0, 5.0),
                8.0 / 3.0,
                (13.0_f64 / 18.0).sqrt(),
                5.0 - 6.0_f64.sqrt(),
            ),
            (Distribution::Discrete(5), 2.0, 2.0_f64.sqrt(), 2.0),
        ];
        let count = 200_000;
        for (distribution, mean, deviation, median) in cases {
            let values: Vec<f64> = (0..count)
                .map(|k| distribution.quantile((f64::from(k) + 0.5) / f64::from(count)))
                .collect();
            let found = values.iter().sum::<f64>() / f64::from(count);
            let square = values.iter().map(|v| (v - found).powi(2)).sum::<f64>() / f64::from(count);
            // the middles of equal parts miss the ends of the tails by some 1e-4 of the variance
            assert!(
                (found - mean).abs() < 1e-4 * deviation,
                "{distribution:?} {found}"
            );
            assert!(
                (square.sqrt() / deviation - 1.0).abs() < 2e-4,
                "{distribution:?}"
            );
            assert!((distribution.quantile(0.5) - median).abs() < 1e-9);
        }
        // the quantile of one deviation
        let z = Distribution::Normal(0.0, 1.0).quantile(0.841_344_746_068_543);
        assert!((z - 1.0).abs() < 1e-9);
    }

    #[test]
    fn levels_reach_the_ends() {
        let uniform = Distribution::Uniform(1.0, 3.0);
        let levels: Vec<f64> = (0..3).map(|at| uniform.level(at, 3)).collect();
        assert_eq!(levels, [1.0, 2.0, 3.0]);
        assert!((Distribution::Normal(1.0, 1.0).level(1, 3) - 1.0).abs() < 1e-12);
        assert_eq!(Distribution::Discrete(2).level(1, 2), 1.0);
    }
}
