//! Values between samples: a windowed sinc, also with a lower cut-off.
//!
//! Source: Kaiser window as in Oppenheim and Schafer, Discrete-Time Signal Processing (from memory).

/// Half width of the kernel in periods of its cut-off's Nyquist interval.
const HALF: usize = 16;

/// Table entries per interval.
const FINE: usize = 512;

/// Interpolates with a cut-off at `1/stretch` of the Nyquist frequency of the samples.
///
/// Up to 0.8 of the cut-off the amplitude is right to 2e-4; above 1.2 of it the rest is below 2e-4.
pub(crate) struct Kernel {
    table: Vec<f64>,
    stretch: f64,
}

impl Kernel {
    /// `stretch` at least 1: ratio of the spacing of what is asked for to that of the samples, where that is larger.
    pub(crate) fn new(stretch: f64) -> Self {
        let beta = 8.0;
        let below = bessel(beta);
        let table = (0..=HALF * FINE + 1)
            .map(|i| {
                let x = i as f64 / FINE as f64;
                let sinc = if i == 0 {
                    1.0
                } else {
                    (std::f64::consts::PI * x).sin() / (std::f64::consts::PI * x)
                };
                let edge = (1.0 - (x / HALF as f64).powi(2)).max(0.0).sqrt();
                sinc * bessel(beta * edge) / below
            })
            .collect();
        Self {
            table,
            stretch: stretch.max(1.0),
        }
    }

    /// Value at a place counted in samples; none where the kernel finds a value missing or leaves the list.
    pub(crate) fn at(&self, values: &[f64], place: f64) -> Option<f64> {
        let reach = HALF as f64 * self.stretch;
        if !(place >= reach && place + reach < values.len() as f64) {
            return None;
        }
        let first = (place - reach).ceil() as usize;
        let last = (place + reach).floor() as usize;
        let (mut sum, mut weights) = (0.0, 0.0);
        let scale = FINE as f64 / self.stretch;
        for (offset, value) in values[first..=last].iter().enumerate() {
            let x = ((first + offset) as f64 - place).abs() * scale;
            let index = x as usize;
            let part = x - index as f64;
            let weight = self.table[index] + part * (self.table[index + 1] - self.table[index]);
            sum += weight * value;
            weights += weight;
        }
        sum.is_finite().then_some(sum / weights)
    }
}

/// Modified Bessel function of order 0 by its series.
fn bessel(x: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..60 {
        term *= quarter / f64::from(k * k);
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sine_between_samples_is_right_to_the_stated_error() {
        for stretch in [1.0, 3.7] {
            let kernel = Kernel::new(stretch);
            for part in [0.05, 0.4, 0.8, 1.2, 1.6] {
                // Cycles per sample: the cut-off is at 0.5/stretch.
                let frequency = 0.5 * part / stretch;
                if frequency > 0.5 {
                    continue;
                }
                let wave = |t: f64| (std::f64::consts::TAU * frequency * t + 0.3).sin();
                let values: Vec<f64> = (0..400).map(|k| wave(k as f64)).collect();
                for i in 0..50 {
                    let place = 150.0 + 1.037 * f64::from(i);
                    let found = kernel.at(&values, place).expect("inside");
                    let wanted = if part < 1.0 { wave(place) } else { 0.0 };
                    assert!(
                        (found - wanted).abs() < 2e-4,
                        "{stretch} {part}: {found} {wanted}"
                    );
                }
            }
        }
    }

    #[test]
    fn ends_and_gaps_have_no_value() {
        let mut values = vec![1.0; 100];
        let kernel = Kernel::new(1.0);
        assert!(kernel.at(&values, 3.0).is_none() && kernel.at(&values, 98.0).is_none());
        assert!(kernel.at(&values, f64::NAN).is_none());
        values[50] = f64::NAN;
        assert!(kernel.at(&values, 45.5).is_none() && kernel.at(&values, 30.5).is_some());
    }
}
