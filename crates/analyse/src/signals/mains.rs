//! Whether a line in a reading is the hum of the mains: at 50 or 60 Hz, and there while the shaft rests.

use std::f64::consts::TAU;

/// Frequencies of mains, and how far a line may be off them, Hz.
const MAINS: [f64; 2] = [50.0, 60.0];
const OFF: f64 = 0.5;
/// Intervals of the frequencies about mains that are tried.
const STEPS: u32 = 20;
/// Shortest rest that shows a line, in its periods, and values in a period.
const PERIODS: f64 = 4.0;
const VALUES: f64 = 3.0;
/// Part of the variance at rest that a hum is at least, and its size over that of a line which noise of the rest's deviation makes.
const PART: f64 = 0.1;
const ABOVE_NOISE: f64 = 4.0;

/// Amplitude of the hum at rest, in the unit of the reading; none where the line is not of the mains, or is not seen at rest.
///
/// Formula: A = (2/n) |Σ (y_k - ȳ) e^(-2πi f k h)|, the largest about the mains; of white noise its mean square is 4 σ²/n
///
/// - `frequency`: of the line, Hz
/// - `rest`: reading while the shaft rests
/// - `interval`: between values, s
pub(super) fn hum(frequency: f64, rest: &[f64], interval: f64) -> Option<f64> {
    let near = |mains: &f64| (frequency - mains).abs() <= OFF;
    let mains = *MAINS.iter().find(|mains| near(mains))?;
    let known: Vec<(f64, f64)> = (rest.iter().enumerate())
        .filter(|(_, value)| value.is_finite())
        .map(|(k, value)| (k as f64 * interval, *value))
        .collect();
    let count = known.len() as f64;
    if count * interval * mains < PERIODS || mains * interval * VALUES > 1.0 {
        return None;
    }
    let mean = known.iter().map(|(_, value)| value).sum::<f64>() / count;
    let variance = known.iter().map(|(_, y)| (y - mean).powi(2)).sum::<f64>() / count;
    let amplitude_at = |frequency: f64| {
        let parts = known.iter().map(|(time, value)| {
            let (s, c) = (TAU * frequency * time).sin_cos();
            (c * (value - mean), s * (value - mean))
        });
        let (c, s) = parts.fold((0.0, 0.0), |(c, s), part| (c + part.0, s + part.1));
        2.0 / count * f64::hypot(c, s)
    };
    let places = (0..=STEPS).map(|k| mains + OFF * (2.0 * f64::from(k) / f64::from(STEPS) - 1.0));
    let amplitude = places.map(amplitude_at).fold(0.0, f64::max);
    let noise = 2.0 * (variance / count).sqrt();
    let seen = amplitude > ABOVE_NOISE * noise && 0.5 * amplitude.powi(2) > PART * variance;
    seen.then_some(amplitude)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hum_is_at_the_mains_and_at_rest() {
        let reading = |amplitude: f64| -> Vec<f64> {
            let noise = |k: u32| 0.3 * (f64::from(k * k) * 12.9898).sin();
            let line = |k: u32| amplitude * (TAU * 50.03 * 1e-3 * f64::from(k) + 0.4).sin();
            (0..500).map(|k| 2.0 + line(k) + noise(k)).collect()
        };
        let found = hum(49.9, &reading(1.5), 1e-3).expect("a hum");
        // noise of 0.2 over √500 values
        assert!((found - 1.5).abs() < 0.06, "{found}");
        assert_eq!(hum(42.0, &reading(1.5), 1e-3), None);
        // an arm rings at 50 Hz, and at rest there is noise alone
        assert_eq!(hum(49.9, &reading(0.0), 1e-3), None);
        assert_eq!(hum(49.9, &reading(1.5)[..50], 1e-3), None);
    }
}
