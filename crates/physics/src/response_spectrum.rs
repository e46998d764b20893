//! The response spectrum of an acceleration record: the largest absolute acceleration of an oscillator on the moving base.
//!
//! ```text
//!   z̈ + 2ζω ż + ω² z = -b̈(t),     S(ω, ζ) = max |ω² z + 2ζω ż|
//! ```
//! b̈ is straight between its values, and each interval is solved exactly: no step is too long but for where in it the largest lies.

/// An oscillator on a base whose acceleration is given at equal intervals.
#[derive(Clone, Copy, Debug)]
pub struct Oscillator {
    /// ω² and 2ζω: the absolute acceleration from z and ż.
    of_motion: [f64; 2],
    /// z and ż at the end of an interval from z, ż, b̈ at its start and b̈ at its end.
    step: [[f64; 4]; 2],
}

impl Oscillator {
    /// An oscillator of a natural frequency ω (rad/s) and a damping ratio ζ on a base with values every h seconds.
    ///
    /// With a = b̈ at the start of an interval and s its slope, z = -(a + s t)/ω² + 2ζ s/ω³ + e^(-ζωt)(A cos ω_d t + B sin ω_d t).
    ///
    /// Source: `nigam_jennings_1969`.
    ///
    /// Valid: 0 < ω, 0 ≤ ζ < 1, 0 < h.
    pub fn new(frequency: f64, damping: f64, interval: f64) -> Self {
        let (w, z, h) = (frequency, damping, interval);
        let damped = w * (1.0 - z * z).sqrt();
        let (sine, cosine) = (damped * h).sin_cos();
        let fade = (-z * w * h).exp();
        // z and ż after an interval, from a start, an acceleration and a slope
        let after = |[place, speed, a, slope]: [f64; 4]| {
            let offset = (2.0 * z * slope / w - a) / (w * w);
            let first = place - offset;
            let second = (speed + slope / (w * w) + z * w * first) / damped;
            let place = offset - slope * h / (w * w) + fade * (first * cosine + second * sine);
            let speed = fade
                * ((damped * second - z * w * first) * cosine
                    - (damped * first + z * w * second) * sine)
                - slope / (w * w);
            [place, speed]
        };
        let units = [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, -1.0 / h],
            [0.0, 0.0, 0.0, 1.0 / h],
        ]
        .map(after);
        Oscillator {
            of_motion: [w * w, 2.0 * z * w],
            step: [0, 1].map(|row| units.map(|unit| unit[row])),
        }
    }

    /// Its largest absolute acceleration under a record, m/s², from rest.
    ///
    /// Formula: S = max |ω² z + 2ζω ż|
    ///
    /// Source: `nigam_jennings_1969`; the maximum over the ends of the intervals.
    ///
    /// Valid: at least ten intervals in a period, where it is short of the maximum by 5 % at most.
    pub fn largest(&self, record: &[f64]) -> f64 {
        let (mut place, mut speed, mut largest) = (0.0, 0.0, 0.0_f64);
        for pair in record.windows(2) {
            let before = [place, speed, pair[0], pair[1]];
            let next = self.step.map(|row| {
                let products = row.iter().zip(before).map(|(entry, own)| entry * own);
                products.sum::<f64>()
            });
            [place, speed] = next;
            let [of_place, of_speed] = self.of_motion;
            largest = largest.max((of_place * place + of_speed * speed).abs());
        }
        largest
    }
}

/// The value of a spectrum at a frequency: straight between its rows of frequency and acceleration on logarithmic axes, constant beyond
/// them.
///
/// Formula: ln S = ln S_k + (ln S_{k+1} - ln S_k) ln(ω/ω_k)/ln(ω_{k+1}/ω_k)
///
/// Source: derived; how design spectra are drawn.
///
/// Valid: rows of positive numbers, frequencies rising.
pub fn spectrum_at(rows: &[[f64; 2]], frequency: f64) -> f64 {
    let next = rows.partition_point(|row| row[0] <= frequency);
    match (next.checked_sub(1).map(|k| rows[k]), rows.get(next)) {
        (None, Some(row)) => row[1],
        (Some(row), None) => row[1],
        (Some(from), Some(to)) => {
            let share = (frequency / from[0]).ln() / (to[0] / from[0]).ln();
            from[1] * (to[1] / from[1]).powf(share)
        }
        (None, None) => 0.0,
    }
}
