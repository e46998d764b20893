//! The temperature of the outer race.

use crate::signals::read::Series;
use statistics::interpolation::held;

/// Length of the means, s: short against any thermocouple's lag, long enough to take its noise away.
const MEAN: f64 = 0.05;

/// Means of the temperature.
pub(crate) struct Estimate {
    /// Middles of the means, s.
    pub time: Vec<f64>,
    /// Temperature, K.
    pub temperature: Vec<f64>,
    /// Standard deviation of one mean by noise, K.
    pub deviation: f64,
}

impl Estimate {
    pub fn of(series: &Series) -> Estimate {
        let length = ((MEAN / series.interval) as usize).max(1);
        let mut found = Estimate {
            time: Vec::new(),
            temperature: Vec::new(),
            deviation: 0.0,
        };
        let mut noise = (0.0, 0.0);
        for (block, values) in series.values.chunks(length).enumerate() {
            let known: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
            if known.is_empty() {
                continue;
            }
            let mean = known.iter().sum::<f64>() / known.len() as f64;
            noise.0 += known.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
            noise.1 += (known.len() - 1) as f64;
            let middle = block as f64 * length as f64 + 0.5 * (values.len() - 1) as f64;
            found.time.push(series.first + middle * series.interval);
            found.temperature.push(mean);
        }
        if noise.1 > 0.0 {
            found.deviation = (noise.0 / noise.1 / length as f64).sqrt();
        }
        found
    }

    /// Rise above the first mean at times, K.
    pub fn rise(&self, times: &[f64]) -> Vec<f64> {
        let first = self.temperature.first().copied().unwrap_or(f64::NAN);
        times.iter().map(|time| self.at(*time) - first).collect()
    }

    /// Temperature at a time, K: straight between the means, as at the ends beyond them.
    pub fn at(&self, time: f64) -> f64 {
        held(&self.time, &self.temperature, time)
    }
}
