//! Local fits of noisy samples: the instant at which a curve reaches a level, and its extrema, each with a standard uncertainty.
//!
//! ```text
//!        ·  ·        1. a quadratic by least squares over windows that grow, until a polynomial two degrees higher differs by more than
//!      ·──────·         noise explains
//!    ·     |    ·    2. the window with the smallest variance of the quadratic plus square of what it lacks
//!          at        3. the higher polynomial of that window: what the quadratic lacks there is of the size of its noise
//! ```
//! Without noise the smallest window is taken, of four samples.
//!
//! Source: local polynomial regression; the higher degree for the estimate as in robust bias-corrected inference (Calonico, Cattaneo and Farrell, from memory).
//! Valid: noise of one deviation and autocorrelation; uncertainties of the first order. A crossing needs values that go beyond the level by more than
//! their noise.

use crate::least_squares::LeastSquares;
use crate::noise::Noise;
use crate::uncertain::Uncertain;
use std::ops::Range;

/// Rounds of a search for a crossing or an extremum, at most, and the step that ends it, in deviations.
const ROUNDS: usize = 20;
const CLOSE: f64 = 0.02;
/// A crossing is one where the sum of the values beyond the level from there on exceeds its own deviation so many times.
const SURE: f64 = 4.0;
/// Windows end where the higher polynomial twice differed by more than the first, or once by more than the second, of so many deviations.
const HOLDS: [f64; 2] = [3.0, 4.0];
/// Deviations below an extremum within which its neighbours may be as high as it.
const NEAR: f64 = 6.0;
/// Samples of a window on one side, at most: more make a fit slow, not better.
const MOST: usize = 4096;

/// Samples that a fit at an instant uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Those before it: the curve has a corner there.
    Before,
    /// As many after it as before.
    Around,
}

/// A sampled curve.
#[derive(Clone, Copy, Debug)]
pub struct Samples<'a> {
    /// Instants, rising.
    pub times: &'a [f64],
    /// Values there.
    pub values: &'a [f64],
    /// Noise of the values.
    pub noise: &'a Noise,
}

/// Polynomial about an instant: value, slope and half the second derivative there.
#[derive(Clone, Copy, Debug)]
struct Polynomial {
    value: Uncertain,
    slope: Uncertain,
    bend: Uncertain,
    /// How far the window reaches from the instant.
    reach: f64,
}

/// First row from which values are beyond a level, and the instant of the crossing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The row.
    pub row: usize,
    /// The instant.
    pub time: Uncertain,
}

/// An extremum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremum {
    /// Its instant.
    pub time: Uncertain,
    /// The value there.
    pub value: Uncertain,
}

impl Samples<'_> {
    /// Row from which values are above a level (below it of sense -1), from a row on: where the sum of value less level is smallest before it
    /// has risen beyond what noise explains.
    fn passes(&self, level: f64, sense: f64, from: usize) -> Option<usize> {
        let deviation = SURE * self.noise.deviation * self.noise.repetition().sqrt();
        let (mut sum, mut lowest, mut row) = (0.0, 0.0, from);
        for (at, value) in self.values.iter().enumerate().skip(from) {
            sum += sense * (value - level);
            if sum <= lowest {
                (lowest, row) = (sum, at + 1);
            } else if sum - lowest > deviation * ((at + 1 - row) as f64).sqrt() {
                return Some(row);
            }
        }
        None
    }

    /// Where values rise to a level, from a row on. Those that begin beyond it have the instant of that row.
    pub fn crossing(&self, level: f64, from: usize, side: Side) -> Option<Crossing> {
        let row = self.passes(level, 1.0, from)?;
        if row == from {
            let time = Uncertain::exact(self.times[row]);
            return Some(Crossing { row, time });
        }
        let [begin, end] = [self.times[row - 1], self.times[row]];
        let [before, after] = [self.values[row - 1], self.values[row]];
        let share = ((level - before) / (after - before)).clamp(0.0, 1.0);
        let at = begin + (end - begin) * if share.is_nan() { 0.5 } else { share };
        let mut time = Uncertain::exact(at);
        for _ in 0..ROUNDS {
            // without noise a straight line between the rows stays
            let Some(own) = self
                .polynomial(time.value, side, from)
                .filter(|_| self.noise.deviation > 0.0)
            else {
                break;
            };
            let rate = own.slope.value.abs().max(own.slope.deviation);
            let deviation = own.value.deviation / rate;
            // the row itself scatters by the noise over the slope
            let scatter = (self.noise.deviation / (rate * (end - begin)))
                .cbrt()
                .powi(2);
            let reach = (end - begin) * (1.0 + 2.0 * scatter) + 2.0 * deviation;
            let next = time.value + (level - own.value.value) / rate;
            let next = next.clamp(begin - reach, end + reach);
            let moved = (next - time.value).abs();
            time = Uncertain::new(next, deviation);
            if moved < CLOSE * deviation {
                break;
            }
        }
        Some(Crossing { row, time })
    }

    /// As [`Self::crossing`] of a curve that may jump: between the rows on both sides of the level, it may lie anywhere.
    pub fn jump(&self, level: f64, sense: f64, from: usize) -> Option<Crossing> {
        let row = self.passes(level, sense, from)?;
        let before = row.saturating_sub(1).max(from);
        let width = self.times[row] - self.times[before];
        // slope over four rows: noise of two hides it
        let (first, last) = (
            row.saturating_sub(2).max(from),
            (row + 1).min(self.times.len() - 1),
        );
        let slope =
            (self.values[last] - self.values[first]) / (self.times[last] - self.times[first]);
        let noise = (self.noise.deviation / slope.abs()).min(width * (last - first) as f64);
        let time = Uncertain::new(
            self.times[row] - 0.5 * width,
            noise.max(0.0).hypot(width / 12_f64.sqrt()),
        );
        Some(Crossing { row, time })
    }

    /// The maximum (of sense -1 the minimum) near a row, from a row on.
    pub fn extremum(&self, row: usize, sense: f64, from: usize) -> Extremum {
        // a value is the largest by its noise: the fit begins in the middle of those that noise may have made so
        let least = sense * self.values[row] - NEAR * self.noise.deviation;
        let near = |value: &&f64| sense * **value >= least;
        let after = self.values[row..].iter().take_while(near).count();
        let before = self.values[from..=row]
            .iter()
            .rev()
            .take_while(near)
            .count();
        let middle = (row + after - 1 + row + 1 - before) / 2;
        let mut found = Extremum {
            time: Uncertain::exact(self.times[middle]),
            value: Uncertain::new(self.values[row], self.noise.deviation),
        };
        for _ in 0..ROUNDS {
            let Some(own) = self.polynomial(found.time.value, Side::Around, from) else {
                break;
            };
            let bend = (-sense * own.bend.value).max(own.bend.deviation);
            if bend <= 0.0 {
                break;
            }
            let step = sense * own.slope.value / (2.0 * bend);
            let step = step.clamp(-0.5 * own.reach, 0.5 * own.reach);
            let deviation = own.slope.deviation / (2.0 * bend);
            // noise of the slope puts the vertex beyond the curve
            let beyond = sense * bend * deviation.powi(2);
            let value = own.value.value + 0.5 * own.slope.value * step - beyond;
            // of rounding the share of the window that stays within one step of the vertex
            let share = (self.noise.rounding / (bend * own.reach * own.reach)).min(1.0);
            let rounding = share.sqrt() * self.noise.rounding / 12_f64.sqrt();
            found = Extremum {
                time: Uncertain::new(found.time.value + step, deviation),
                value: Uncertain::new(value, own.value.deviation.hypot(rounding)),
            };
            if step.abs() <= CLOSE * deviation {
                break;
            }
        }
        found
    }

    /// The polynomial of the window in which it holds, of rows from one on: around an instant, or before it where the curve has a corner.
    fn polynomial(&self, at: f64, side: Side, from: usize) -> Option<Polynomial> {
        let next = self.times.partition_point(|own| *own < at);
        let mut best: Option<(f64, Polynomial)> = None;
        let (mut half, mut failed) = (1, 0);
        while half <= next.saturating_sub(from).min(MOST) && failed < 2 {
            let end = match side {
                Side::Before => next,
                Side::Around => next + half,
            };
            if end > self.times.len() {
                break;
            }
            let start = next - half;
            half += 1 + half / 4;
            let Some((own, sum, fails)) = self.fitted(at, start..end) else {
                continue;
            };
            failed += fails;
            if best.is_none_or(|(least, _)| sum < least) {
                best = Some((sum, own));
            }
            if self.noise.deviation == 0.0 {
                break;
            }
        }
        best.map(|(_, own)| own)
    }

    /// Polynomial of a window; variance of the one two degrees lower plus square of what that lacks, and how many bounds this passes.
    fn fitted(&self, at: f64, window: Range<usize>) -> Option<(Polynomial, f64, usize)> {
        let (times, values) = (&self.times[window.clone()], &self.values[window]);
        let reach = (at - times[0]).max(times[times.len() - 1] - at);
        let lower = LeastSquares::new(powers::<3>(times, at, reach))?.weights();
        let higher = LeastSquares::new(powers::<5>(times, at, reach)).map(|fit| fit.weights());
        let weights = match &higher {
            Some([value, slope, bend, ..]) => [value, slope, bend],
            None => lower.each_ref(),
        };
        let both = weights[0].iter().zip(&lower[0]);
        let apart: Vec<f64> = both.map(|(a, b)| a - b).collect();
        let apart = self.noise.weighted(&apart, values);
        let lower = self.noise.weighted(&lower[0], values);
        let coefficient = |k: usize| {
            let scale = reach.powi(-(k as i32));
            let own = self.noise.weighted(weights[k], values);
            Uncertain::new(scale * own.value, scale * own.deviation)
        };
        let own = Polynomial {
            value: coefficient(0),
            slope: coefficient(1),
            bend: coefficient(2),
            reach,
        };
        let lack = (apart.value.powi(2) - apart.deviation.powi(2)).max(0.0);
        let passed = |bound: &&f64| apart.value.abs() > **bound * apart.deviation;
        let fails = HOLDS.iter().filter(passed).count();
        Some((own, lower.deviation.powi(2) + lack, fails))
    }
}

/// Powers of the distance from an instant over the reach.
fn powers<const N: usize>(times: &[f64], at: f64, reach: f64) -> Vec<[f64; N]> {
    let row = |time: &f64| {
        let u = (time - at) / reach;
        std::array::from_fn(|k| u.powi(k as i32))
    };
    times.iter().map(row).collect()
}
