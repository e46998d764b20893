//! Spectra and spectrograms, calibrated: amplitudes of sines in the unit of the signal, densities in its square over Hz.
//!
//! ```text
//! signal ─▶ overlapping segments ─▶ mean removed, windowed ─▶ Fourier ─▶ mean of the squares
//! ```
//!
//! [`spectrum`] averages over a record, [`spectrogram`] shows it over time, [`order_spectrogram`] over the turns of a shaft whose
//! speed varies, by values at equal angles.
//!
//! Source: Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70; windows as by Harris, Proc. IEEE 66 (1978) 51 (from memory).

mod angular;

pub use angular::{AngularSettings, OrderSpectrogram, order_spectrogram};

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Weights of the values of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Window {
    /// All alike: for signals that repeat in the segment.
    Rectangular,
    /// The usual choice.
    Hann,
    /// Lower first side lobe than Hann, slower fall after.
    Hamming,
    /// Side lobes below 1/30 000: small lines beside large ones.
    BlackmanHarris,
    /// Amplitudes right to 0.2 % between lines of the spectrum.
    FlatTop,
}

impl Window {
    fn terms(self) -> &'static [f64] {
        match self {
            Self::Rectangular => &[1.0],
            Self::Hann => &[0.5, -0.5],
            Self::Hamming => &[0.54, -0.46],
            Self::BlackmanHarris => &[0.358_75, -0.488_29, 0.141_28, -0.011_68],
            Self::FlatTop => &[
                0.215_578_95,
                -0.416_631_58,
                0.277_263_158,
                -0.083_578_947,
                0.006_947_368,
            ],
        }
    }

    /// Weights of a segment of `length` values.
    pub fn weights(self, length: usize) -> Vec<f64> {
        let terms = self.terms();
        (0..length)
            .map(|i| {
                let turn = TAU * i as f64 / length as f64;
                terms
                    .iter()
                    .enumerate()
                    .map(|(k, a)| a * (k as f64 * turn).cos())
                    .sum()
            })
            .collect()
    }
}

/// How a signal is cut into segments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segments {
    /// Values in a segment; at least 8.
    pub length: usize,
    /// Overlap of neighbours, 0 to 0.95; 0.5 is usual with Hann.
    pub overlap: f64,
    /// Weights.
    pub window: Window,
}

impl Segments {
    fn check(&self) -> Result<(), String> {
        if self.length < 8 {
            return Err(format!(
                "a segment of {} values is too short; at least 8 are needed",
                self.length
            ));
        }
        if !(0.0..=0.95).contains(&self.overlap) {
            return Err(format!(
                "an overlap of {} is not between 0 and 0.95",
                self.overlap
            ));
        }
        Ok(())
    }

    fn hop(&self) -> usize {
        ((self.length as f64 * (1.0 - self.overlap)).round() as usize).max(1)
    }
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
    /// Width of a line for noise, Hz.
    pub bandwidth: f64,
    /// Number of independent segments that the averages are worth; a density has a relative deviation of one over its root.
    pub averages: f64,
    /// What is not trustworthy.
    pub notes: Vec<String>,
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
    /// Factor from the root of a density to the amplitude of a sine, √Hz.
    pub to_amplitude: f64,
    /// What is not trustworthy.
    pub notes: Vec<String>,
}

/// Fourier transform of weighted segments.
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
    fn new(segments: &Segments) -> Self {
        let plan = FftPlanner::new().plan_fft_forward(segments.length);
        let weights = segments.window.weights(segments.length);
        let zero = Complex::new(0.0, 0.0);
        Self {
            scratch: vec![zero; plan.get_inplace_scratch_len()],
            buffer: vec![zero; segments.length],
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
    segments: &Segments,
    mut each: impl FnMut(usize, Option<Vec<f64>>),
) -> Transform {
    let mut transform = Transform::new(segments);
    let starts: Vec<usize> = (0..)
        .map(|k| k * segments.hop())
        .take_while(|s| s + segments.length <= signal.len())
        .collect();
    for pair in starts.chunks(2) {
        let part = |start: usize| &signal[start..start + segments.length];
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

fn check(signal: &[f64], interval: f64, segments: &Segments) -> Result<(), String> {
    segments.check()?;
    if !(interval > 0.0 && interval.is_finite()) {
        return Err("the interval of the signal must be positive and finite".into());
    }
    if signal.len() < segments.length {
        return Err(format!(
            "the signal has {} values, a segment {}",
            signal.len(),
            segments.length
        ));
    }
    Ok(())
}

fn lines(length: usize, interval: f64) -> Vec<f64> {
    (0..=length / 2)
        .map(|k| k as f64 / (length as f64 * interval))
        .collect()
}

/// Spectrum of a signal with values at equal `interval`, s. Segments with missing values are left out and reported.
pub fn spectrum(signal: &[f64], interval: f64, segments: &Segments) -> Result<Spectrum, String> {
    check(signal, interval, segments)?;
    let mut density = vec![0.0; segments.length / 2 + 1];
    let (mut used, mut lost) = (0_usize, 0_usize);
    let transform = transformed(signal, segments, |_, one| match one {
        Some(one) => {
            used += 1;
            for (sum, value) in density.iter_mut().zip(&one) {
                *sum += value;
            }
        }
        None => lost += 1,
    });
    if used == 0 {
        return Err("every segment of the signal has missing values".into());
    }
    let mut notes = Vec::new();
    if lost > 0 {
        notes.push(format!(
            "{lost} of {} segments have missing values and were left out",
            lost + used
        ));
    }
    let averages = worth(&transform.weights, segments.hop(), used);
    if averages < 4.0 {
        notes.push(format!(
            "densities are averages of {averages:.1} segments only"
        ));
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
            let sides = if k == 0 || (k == last && segments.length.is_multiple_of(2)) {
                1.0
            } else {
                2.0
            };
            (sides * d * bandwidth).sqrt()
        })
        .collect();
    Ok(Spectrum {
        frequency: lines(segments.length, interval),
        density,
        amplitude,
        bandwidth,
        averages,
        notes,
    })
}

/// Number of independent segments that overlapping ones are worth (Welch).
fn worth(weights: &[f64], hop: usize, count: usize) -> f64 {
    let squares: f64 = weights.iter().map(|w| w * w).sum();
    let mut sum = 1.0;
    let mut lag = 1;
    while lag * hop < weights.len() && lag < count {
        let shared: f64 = weights
            .iter()
            .zip(&weights[lag * hop..])
            .map(|(a, b)| a * b)
            .sum();
        sum += 2.0 * (1.0 - lag as f64 / count as f64) * (shared / squares).powi(2);
        lag += 1;
    }
    count as f64 / sum
}

/// Spectra of a signal over time, values at equal `interval`, s.
pub fn spectrogram(
    signal: &[f64],
    interval: f64,
    segments: &Segments,
) -> Result<Spectrogram, String> {
    check(signal, interval, segments)?;
    let count = (signal.len() - segments.length) / segments.hop() + 1;
    if count.saturating_mul(segments.length / 2 + 1) > 50_000_000 {
        return Err("the spectrogram would hold more than 50 million values; take longer segments or less overlap".into());
    }
    let (mut time, mut density) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let mut lost = 0;
    let transform = transformed(signal, segments, |start, one| {
        time.push((start as f64 + 0.5 * segments.length as f64) * interval);
        density.push(match one {
            Some(mut one) => {
                one.iter_mut().for_each(|v| *v *= interval);
                one
            }
            None => {
                lost += 1;
                vec![f64::NAN; segments.length / 2 + 1]
            }
        });
    });
    let mut notes = Vec::new();
    if lost > 0 {
        notes.push(format!("{lost} of {count} segments have missing values"));
    }
    let bandwidth = transform.squares / (transform.sum * transform.sum) / interval;
    Ok(Spectrogram {
        time,
        frequency: lines(segments.length, interval),
        density,
        to_amplitude: (2.0 * bandwidth).sqrt(),
        notes,
    })
}
