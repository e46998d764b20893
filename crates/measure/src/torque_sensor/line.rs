//! Steady sinusoidal lines in what a swing leaves.

use statistics::linear::solved;
use statistics::simplex;
use std::f64::consts::TAU;

/// A line: cosine and sine parts about the first value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) frequency: f64,
    cosine: f64,
    sine: f64,
}

impl Line {
    pub(super) fn amplitude(&self) -> f64 {
        self.cosine.hypot(self.sine)
    }

    /// Its value so long after the first, s.
    pub(super) fn at(&self, time: f64) -> f64 {
        let (s, c) = (TAU * self.frequency * time).sin_cos();
        self.cosine * c + self.sine * s
    }
}

/// Power of a line over the usual power beside it: noise exceeds it at one of a thousand frequencies once in 3000 records.
const SEEN: f64 = 15.0;

/// Time constants of a swing after which it is dead: a thousandth is left.
const DEAD: f64 = 7.0;

/// Values in which lines are looked for, as means of blocks.
const MOST: usize = 2048;

/// The strongest line of the second half of a residual; none where nothing stands out. One within the width of the sensor's own
/// line, frequency and damping ratio as given, is the swing's, unless that has died before.
pub(super) fn strongest(residual: &[f64], interval: f64, own: (f64, f64)) -> Option<Line> {
    let half = residual.get(residual.len() / 2..)?;
    let block = half.len().div_ceil(MOST);
    let coarse: Vec<f64> = half
        .chunks_exact(block.max(1))
        .map(|part| {
            let seen = part.iter().filter(|v| v.is_finite());
            seen.clone().sum::<f64>() / (seen.count() as f64).max(1.0)
        })
        .collect();
    let count = coarse.len();
    if count < 64 {
        return None;
    }
    let step = 1.0 / (count as f64 * block as f64 * interval);
    let powers: Vec<f64> = (2..count / 2)
        .map(|bin| power(&coarse, bin as f64 / count as f64))
        .collect();
    // the median of an exponential distribution is ln 2 of its mean
    let usual = crate::quantile::median(powers.iter().copied()) / std::f64::consts::LN_2;
    let decayed = TAU * own.0 * own.1 * (residual.len() - half.len()) as f64 * interval;
    let beside = |bin: usize| {
        decayed > DEAD || ((bin + 2) as f64 * step - own.0).abs() > 2.0 * own.1 * own.0 + 2.0 * step
    };
    let bin = (0..powers.len())
        .filter(|bin| beside(*bin))
        .max_by(|&a, &b| powers[a].total_cmp(&powers[b]))?;
    (powers[bin] > SEEN * usual).then(|| {
        let ([cycles], _) = simplex::lowest([0.0], [0.3], 1e-12, 60, |offset: &[f64; 1]| {
            -power(&coarse, ((bin + 2) as f64 + offset[0]) / count as f64)
        });
        Line {
            frequency: ((bin + 2) as f64 + cycles) * step,
            cosine: 0.0,
            sine: 0.0,
        }
    })
}

/// Power of values at a frequency in cycles a value.
fn power(values: &[f64], frequency: f64) -> f64 {
    let (turn_sine, turn_cosine) = (TAU * frequency).sin_cos();
    let (mut c, mut s) = (1.0_f64, 0.0_f64);
    let (mut sum_c, mut sum_s) = (0.0, 0.0);
    for value in values {
        sum_c += c * value;
        sum_s += s * value;
        (c, s) = (
            c * turn_cosine - s * turn_sine,
            s * turn_cosine + c * turn_sine,
        );
    }
    sum_c * sum_c + sum_s * sum_s
}

/// Fits the lines to a residual one after the other, their frequencies too.
pub(super) fn fit(lines: &mut [Line], residual: &[f64], interval: f64) {
    let mut left: Vec<f64> = residual.to_vec();
    for (k, value) in left.iter_mut().enumerate() {
        *value -= lines.iter().map(|l| l.at(k as f64 * interval)).sum::<f64>();
    }
    let resolution = 1.0 / (residual.len() as f64 * interval);
    for line in lines.iter_mut() {
        for (k, value) in left.iter_mut().enumerate() {
            *value += line.at(k as f64 * interval);
        }
        let at = |offset: f64| amplitudes(&left, interval, line.frequency + offset * resolution);
        let ([offset], _) = simplex::lowest([0.0], [0.05], 1e-9, 30, |offset: &[f64; 1]| {
            at(offset[0]).map_or(f64::INFINITY, |found| -found.2)
        });
        if let Some((cosine, sine, _)) = at(offset) {
            *line = Line {
                frequency: line.frequency + offset * resolution,
                cosine,
                sine,
            };
        }
        for (k, value) in left.iter_mut().enumerate() {
            *value -= line.at(k as f64 * interval);
        }
    }
}

/// Cosine and sine parts of a line of a frequency beside a level, and the squares they explain.
fn amplitudes(values: &[f64], interval: f64, frequency: f64) -> Option<(f64, f64, f64)> {
    let (turn_sine, turn_cosine) = (TAU * frequency * interval).sin_cos();
    let (mut c, mut s) = (1.0_f64, 0.0_f64);
    let mut a = [[0.0; 3]; 3];
    let mut b = [0.0; 3];
    for value in values {
        if value.is_finite() {
            let row = [1.0, c, s];
            for i in 0..3 {
                b[i] += row[i] * value;
                for j in 0..3 {
                    a[i][j] += row[i] * row[j];
                }
            }
        }
        (c, s) = (
            c * turn_cosine - s * turn_sine,
            s * turn_cosine + c * turn_sine,
        );
    }
    let x = solved(&a, &b)?;
    let explained = (0..3).map(|i| x[i] * b[i]).sum();
    Some((x[1], x[2], explained))
}
