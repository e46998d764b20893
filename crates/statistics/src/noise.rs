//! Noise of a sampled channel: its standard deviation, and how far a sample repeats those before it.
//!
//! ```text
//!   var Σ w(i) e(i) = s² Σ Σ w(i) w(j) ρ(|i-j|)        τ = 1 + 2 Σ ρ(k): one sample in τ is independent
//! ```

use crate::uncertain::Uncertain;

/// Noise of one deviation and autocorrelation throughout.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Noise {
    /// Standard deviation of a value.
    pub deviation: f64,
    /// Autocorrelation at lags 1, 2 ... up to the first that white noise may have as well.
    pub correlation: Vec<f64>,
    /// Step of the values where noise does not spread them over several: its error does not average out while a curve stays within one.
    pub rounding: f64,
}

impl Noise {
    /// Of residuals of a fit of so many coefficients; none where nothing is left of them.
    ///
    /// Formula: s² = Σ r²/(n - p τ), ρ(k) = Σ r(i) r(i+k)/Σ r²
    pub fn of(residuals: &[f64], coefficients: usize) -> Option<Noise> {
        let product = |lag: usize| -> f64 {
            let both = residuals.iter().zip(&residuals[lag..]);
            both.map(|(a, b)| a * b).sum()
        };
        let whole = product(0);
        if whole.is_nan() || whole <= 0.0 {
            return None;
        }
        // white noise has autocorrelations of this size
        let least = (residuals.len() as f64).powf(-0.5);
        let lags = (1..residuals.len() / 2).map(|lag| product(lag) / whole);
        let mut noise = Noise {
            deviation: 0.0,
            correlation: lags.take_while(|own| *own > least).collect(),
            rounding: 0.0,
        };
        let count = residuals.len() as f64;
        let free = count - coefficients as f64 * noise.repetition();
        noise.deviation = (whole / free.max(0.5 * count)).sqrt();
        Some(noise)
    }

    /// How many neighbouring samples say the same: 1 of independent ones.
    pub fn repetition(&self) -> f64 {
        1.0 + 2.0 * self.correlation.iter().sum::<f64>()
    }

    /// A weighted sum of neighbouring values.
    pub fn weighted(&self, weights: &[f64], values: &[f64]) -> Uncertain {
        let product = |lag: usize, of: &[f64]| -> f64 {
            let both = weights.get(lag..).unwrap_or_default().iter().zip(of);
            both.map(|(a, b)| a * b).sum()
        };
        let alone = product(0, weights);
        let lags = (1..).zip(&self.correlation);
        let shared: f64 = lags.map(|(lag, own)| own * product(lag, weights)).sum();
        // the autocorrelation is an estimate, and cut off: no sum of samples is better than so
        let variance = (alone + 2.0 * shared).max(1e-2 * alone);
        Uncertain::new(product(0, values), self.deviation * variance.sqrt())
    }
}
