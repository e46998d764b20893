//! Spectra and spectrograms, calibrated: amplitudes of sines in the unit of the signal, densities in its square over Hz.
//!
//! ```text
//! signal ─▶ segments that overlap by half ─▶ mean removed, Hann's window ─▶ Fourier ─▶ mean of the squares
//! ```
//!
//! [`spectrum`] averages over a record, [`spectrogram`] shows it over time, [`order_spectrogram`] over the turns of a shaft whose
//! speed varies, by values at equal angles.
//!
//! Source: Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70; window as by Harris, Proc. IEEE 66 (1978) 51 (from memory).

mod angular;

pub use angular::{AngularSettings, OrderSpectrogram, order_spectrogram};

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Fewest values in a segment.
const SHORTEST: usize = 8;

/// Values from the start of a segment to that of the next: half of it, as is usual with Hann's window.
fn hop(length: usize) -> usize {
    length.div_ceil(2)
}

/// A spectrum, one-sided. All lists have the same length.
#[derive(Clone, Debug)]
pub struct Spectrum {
    /// Frequencies, Hz.
    pub frequency: Vec<f64>,
    /// Power spectral density, square of the signal's unit over Hz; its integral is the variance.
    pub density: Vec<f64>,
    /// Amplitude that a sine at this frequency has, unit of the signal, peak.
    pub amplitude: Vec<f64>,
}

/// Spectra over time.
#[derive(Clone, Debug)]
pub struct Spectrogram {
    /// Middle of each segment, s after the first value.
    pub time: Vec<f64>,
    /// Frequencies, Hz.
    pub frequency: Vec<f64>,
    /// Density of each segment, square of the signal's unit over Hz; NaN where values are missing.
    pub density: Vec<Vec<f64>>,
}

/// Fourier transform of segments weighted by Hann's window.
struct Transform {
    plan: Arc<dyn Fft<f64>>,
    weights: Vec<f64>,
    buffer: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    /// Sum of weights, and of their squares.
    sum: f64,
    squares: f64,
}

impl Transform {
    fn new(length: usize) -> Self {
        let plan = FftPlanner::new().plan_fft_forward(length);
        let weights: Vec<f64> = (0..length)
            .map(|i| 0.5 - 0.5 * (TAU * i as f64 / length as f64).cos())
            .collect();
        let zero = Complex::new(0.0, 0.0);
        Self {
            scratch: vec![zero; plan.get_inplace_scratch_len()],
            buffer: vec![zero; length],
            sum: weights.iter().sum(),
            squares: weights.iter().map(|w| w * w).sum(),
            weights,
            plan,
        }
    }

    /// One-sided density of two segments at once, at unit interval; the second may be the first again.
    fn densities(&mut self, first: &[f64], second: &[f64]) -> [Vec<f64>; 2] {
        let length = self.weights.len();
        let mean = |part: &[f64]| part.iter().sum::<f64>() / length as f64;
        let (a, b) = (mean(first), mean(second));
        for (k, slot) in self.buffer.iter_mut().enumerate() {
            *slot = Complex::new(
                self.weights[k] * (first[k] - a),
                self.weights[k] * (second[k] - b),
            );
        }
        self.plan
            .process_with_scratch(&mut self.buffer, &mut self.scratch);
        let lines = length / 2 + 1;
        let mut result = [Vec::with_capacity(lines), Vec::with_capacity(lines)];
        for k in 0..lines {
            let (z, mirror) = (self.buffer[k], self.buffer[(length - k) % length].conj());
            let sides = if k == 0 || 2 * k == length { 1.0 } else { 2.0 };
            result[0].push(sides * 0.25 * (z + mirror).norm_sqr() / self.squares);
            result[1].push(sides * 0.25 * (z - mirror).norm_sqr() / self.squares);
        }
        result
    }
}

/// Calls `each` with start and density (per unit of 1/interval = 1) of every segment; none where values are missing.
fn transformed(
    signal: &[f64],
    length: usize,
    mut each: impl FnMut(usize, Option<Vec<f64>>),
) -> Transform {
    let mut transform = Transform::new(length);
    let starts: Vec<usize> = (0..)
        .map(|k| k * hop(length))
        .take_while(|s| s + length <= signal.len())
        .collect();
    for pair in starts.chunks(2) {
        let part = |start: usize| &signal[start..start + length];
        let (first, second) = (pair[0], pair[pair.len() - 1]);
        let whole = |start: usize| part(start).iter().all(|v| v.is_finite());
        // A part that misses values must not spoil its partner.
        let (left, right) = match (whole(first), whole(second)) {
            (true, true) => (part(first), part(second)),
            (true, false) => (part(first), part(first)),
            (false, true) => (part(second), part(second)),
            (false, false) => {
                pair.iter().for_each(|&s| each(s, None));
                continue;
            }
        };
        let [a, b] = transform.densities(left, right);
        each(first, whole(first).then_some(a));
        if pair.len() == 2 {
            each(second, whole(second).then_some(b));
        }
    }
    transform
}

fn check(signal: &[f64], interval: f64, length: usize) -> Result<(), String> {
    if length < SHORTEST {
        return Err(format!(
            "a segment of {length} values is too short; at least {SHORTEST} are needed"
        ));
    }
    if !(interval > 0.0 && interval.is_finite()) {
        return Err("the interval of the signal must be positive and finite".into());
    }
    if signal.len() < length {
        return Err(format!(
            "the signal has {} values, a segment {length}",
            signal.len()
        ));
    }
    Ok(())
}

fn lines(length: usize, interval: f64) -> Vec<f64> {
    (0..=length / 2)
        .map(|k| k as f64 / (length as f64 * interval))
        .collect()
}

/// Spectrum of a signal with values at equal `interval`, s, from segments of `length` values. Segments with missing values are left out.
pub fn spectrum(signal: &[f64], interval: f64, length: usize) -> Result<Spectrum, String> {
    check(signal, interval, length)?;
    let mut density = vec![0.0; length / 2 + 1];
    let mut used = 0_usize;
    let transform = transformed(signal, length, |_, one| {
        let Some(one) = one else { return };
        used += 1;
        for (sum, value) in density.iter_mut().zip(&one) {
            *sum += value;
        }
    });
    if used == 0 {
        return Err("every segment of the signal has missing values".into());
    }
    let bandwidth = transform.squares / (transform.sum * transform.sum) / interval;
    for value in &mut density {
        *value *= interval / used as f64;
    }
    let last = density.len() - 1;
    let amplitude = density
        .iter()
        .enumerate()
        .map(|(k, d)| {
            // A line at the ends of the spectrum has no partner.
            let sides = if k == 0 || (k == last && length.is_multiple_of(2)) {
                1.0
            } else {
                2.0
            };
            (sides * d * bandwidth).sqrt()
        })
        .collect();
    Ok(Spectrum {
        frequency: lines(length, interval),
        density,
        amplitude,
    })
}

/// Spectra of a signal over time, values at equal `interval`, s, in segments of `length` values.
pub fn spectrogram(signal: &[f64], interval: f64, length: usize) -> Result<Spectrogram, String> {
    check(signal, interval, length)?;
    let count = (signal.len() - length) / hop(length) + 1;
    if count.saturating_mul(length / 2 + 1) > 50_000_000 {
        return Err(
            "the spectrogram would hold more than 50 million values; take longer segments".into(),
        );
    }
    let (mut time, mut density) = (Vec::with_capacity(count), Vec::with_capacity(count));
    transformed(signal, length, |start, one| {
        time.push((start as f64 + 0.5 * length as f64) * interval);
        density.push(match one {
            Some(mut one) => {
                one.iter_mut().for_each(|v| *v *= interval);
                one
            }
            None => vec![f64::NAN; length / 2 + 1],
        });
    });
    Ok(Spectrogram {
        time,
        frequency: lines(length, interval),
        density,
    })
}
