//! The slip of a line over its travel: best path through short spectra, and how likely another is.
//!
//! ```text
//! ln p(spectra | path) = Σ P(s)/N · share,     P power at the slip of the path, N that of noise
//! slips of two spectra differ by a normal step;  p(slip at a time | all spectra) by sums forward and backward
//! ```
//!
//! Source: the sums forward and backward are those of Baum et al. (1970), the path that of Viterbi (1967) (from memory).

use super::cells::Cell;
use std::f64::consts::{PI, TAU};

/// Distance of two cells, periods of the line.
pub(super) const HOP: f64 = 0.5;
/// Cells that overlap: 2 periods, so that the mean of the signal falls on a zero of the window.
pub(super) const OVERLAPS: usize = 4;
/// Length of a spectrum, periods.
pub(super) const LENGTH: f64 = 24.0;
/// Cells on either side of the middle of a spectrum, and between two spectra.
const HALF: usize = 24;
const STEP: usize = 8;
/// Share of a spectrum that the one before does not hold: two of 24 periods, 4 apart, under Hann windows.
const SHARE: f64 = 0.35;
/// Standard deviation of the change of slip in that step, 1.
const CHANGE: f64 = 0.006;
/// Distance of two slips at most, 1.
const FINE: f64 = 0.004;
/// Power of the foot of a line over its own, with what a change of slip within a spectrum adds.
const FOOT: f64 = 1e-2;
/// Power of noise that is taken at least, as a part of the highest line of a spectrum.
const LEAST_NOISE: f64 = 5e-3;
/// Standard deviation of the weights by which the smooth slip is averaged, in spectra: 18 periods.
const SMOOTH: f64 = 4.5;
/// Slips as far apart as this are two: half of the width of a line's foot.
pub(super) const APART: f64 = 1.0 / LENGTH;

/// Slip over travel.
pub(super) struct Path {
    /// Travel, periods.
    pub(super) travel: Vec<f64>,
    /// Slip, 1.
    pub(super) slip: Vec<f64>,
    /// The same without what changes from spectrum to spectrum, so that a line that is turned back by it moves smoothly.
    smooth: Vec<f64>,
    /// Chance that the slip is another.
    pub(super) doubt: Vec<f64>,
    /// Power of the line over that of noise in a spectrum, without the noise.
    pub(super) strength: Vec<f64>,
}

impl Path {
    fn place(&self, travel: f64) -> (usize, f64) {
        let after = self.travel.partition_point(|t| *t <= travel);
        let k = after
            .saturating_sub(1)
            .min(self.travel.len().saturating_sub(2));
        let width = self.travel[k + 1] - self.travel[k];
        // Half a spectrum at either end lies beyond the middles: the line goes on as it went.
        let beyond = 0.5 * LENGTH / width;
        (
            k,
            ((travel - self.travel[k]) / width).clamp(-beyond, 1.0 + beyond),
        )
    }

    /// Slip at a travel, straight between spectra.
    pub(super) fn slip_at(&self, travel: f64) -> f64 {
        let (k, u) = self.place(travel);
        self.slip[k] + u.clamp(0.0, 1.0) * (self.slip[k + 1] - self.slip[k])
    }

    /// The smooth slip at a travel.
    pub(super) fn smooth_at(&self, travel: f64) -> f64 {
        let (k, u) = self.place(travel);
        self.smooth[k] + u * (self.smooth[k + 1] - self.smooth[k])
    }

    /// Index of the spectrum next to a travel.
    pub(super) fn nearest(&self, travel: f64) -> usize {
        let (k, u) = self.place(travel);
        k + usize::from(u > 0.5)
    }
}

/// Weighted sums of cells around one, against a frequency in cycles a period.
struct Spectrum<'a> {
    cells: &'a [Cell],
    /// Cells on either side.
    half: usize,
}

impl Spectrum<'_> {
    fn power(&self, centre: usize, table: &[[f64; 2]]) -> f64 {
        let mut sum = [0.0; 2];
        for (lag, [cosine, sine]) in table.iter().enumerate() {
            let Some(cell) = (centre + lag)
                .checked_sub(self.half)
                .and_then(|k| self.cells.get(k))
            else {
                continue;
            };
            sum[0] += cell.value[0] * cosine + cell.value[1] * sine;
            sum[1] += cell.value[1] * cosine - cell.value[0] * sine;
        }
        sum[0] * sum[0] + sum[1] * sum[1]
    }

    /// Hann weights times the wave of a frequency, divided by what a cell lets pass of it.
    fn table(&self, frequency: f64) -> Vec<[f64; 2]> {
        let whole = self.half as f64 + 1.0;
        (0..=2 * self.half)
            .map(|k| {
                let lag = k as f64 - self.half as f64;
                let weight = 0.5 * (1.0 + (PI * lag / whole).cos()) / whole / passed(frequency);
                let (sine, cosine) = (TAU * frequency * HOP * lag).sin_cos();
                [weight * cosine, weight * sine]
            })
            .collect()
    }
}

/// Amplitude that a cell lets pass of a frequency in cycles a period.
fn passed(frequency: f64) -> f64 {
    let x = frequency * HOP * OVERLAPS as f64;
    let poles = 1.0 - x * x;
    if x.abs() < 1e-6 {
        return 1.0;
    }
    if poles.abs() < 1e-6 {
        return 0.5;
    }
    ((PI * x).sin() / (PI * x) / poles).abs().max(0.2)
}

/// Follows the strongest line between two slips in cells that were turned back by `middle`; none where they are too few.
pub(super) fn followed(cells: &[Cell], middle: f64, slips: (f64, f64)) -> Option<Path> {
    let bins = ((slips.1 - slips.0) / FINE).ceil().max(16.0) as usize;
    let width = (slips.1 - slips.0) / bins as f64;
    let slip = |bin: usize| slips.0 + (bin as f64 + 0.5) * width;
    let spectrum = Spectrum { cells, half: HALF };
    let tables: Vec<_> = (0..bins)
        .map(|bin| spectrum.table(middle - slip(bin)))
        .collect();
    // Noise is looked for where cells let it pass, at slips that may lie outside those that are searched.
    let around: Vec<_> = (0..20)
        .map(|k| spectrum.table((f64::from(k) - 9.5) / LENGTH))
        .collect();
    let centres: Vec<usize> = (HALF..cells.len().saturating_sub(HALF))
        .step_by(STEP)
        .collect();
    if centres.len() < 3 {
        return None;
    }
    let powers: Vec<Vec<f64>> = centres
        .iter()
        .map(|&centre| tables.iter().map(|t| spectrum.power(centre, t)).collect())
        .collect();
    let quiet: Vec<f64> = centres
        .iter()
        .map(|&centre| {
            let mut all: Vec<f64> = around.iter().map(|t| spectrum.power(centre, t)).collect();
            all.sort_by(f64::total_cmp);
            // Powers of noise are exponential: 30 of 100 lie below 0.357 of their mean.
            0.5 * (all[5] + all[6]) / 0.357
        })
        .collect();
    let noises: Vec<f64> = (0..quiet.len())
        .map(|k| {
            let near = &quiet[k.saturating_sub(4)..(k + 5).min(quiet.len())];
            (near.iter().sum::<f64>() / near.len() as f64).max(f64::MIN_POSITIVE)
        })
        .collect();
    let weights: Vec<Vec<f64>> = powers
        .iter()
        .zip(&noises)
        .map(|(power, noise)| {
            let top = power.iter().copied().fold(0.0, f64::max);
            let noise = noise.max(LEAST_NOISE * top);
            power.iter().map(|p| p / noise).collect()
        })
        .collect();
    let beyond: Vec<_> = (0..8)
        .flat_map(|k| {
            let away = 0.5 * f64::from(k + 1) / LENGTH;
            [slips.0 - away, slips.1 + away]
        })
        .map(|slip| spectrum.table(middle - slip))
        .collect();
    let outside: Vec<f64> = centres
        .iter()
        .map(|&centre| {
            let powers = beyond.iter().map(|t| spectrum.power(centre, t));
            powers.fold(0.0, f64::max)
        })
        .collect();
    let best = strongest(&weights, width);
    let chances = chances(&weights, width);
    let near = (APART / width).ceil() as usize;
    let mut path = Path {
        travel: centres.iter().map(|&c| c as f64 * HOP + 1.0).collect(),
        slip: Vec::new(),
        smooth: Vec::new(),
        doubt: Vec::new(),
        strength: Vec::new(),
    };
    for (k, (&bin, chance)) in best.iter().zip(&chances).enumerate() {
        let around = bin.saturating_sub(near)..(bin + near + 1).min(bins);
        let here: f64 = chance[around.clone()].iter().sum();
        let mean: f64 = around.map(|b| chance[b] * slip(b)).sum();
        path.slip
            .push(if here > 1e-3 { mean / here } else { slip(bin) });
        // At the border the line itself may lie beyond; and what is far below a line beyond may be the foot of that.
        let foot = FOOT * outside[k] > powers[k][bin];
        let border = bin == 0 || bin + 1 == bins || foot;
        path.doubt
            .push(if border { 1.0 } else { (1.0 - here).max(0.0) });
        path.strength
            .push((powers[k][bin] / noises[k] - 1.0).max(0.0));
    }
    path.smooth = (0..path.slip.len())
        .map(|k| straightened(&path.slip, k))
        .collect();
    Some(path)
}

/// Value at an index of the straight line through those around it, weighted by their distance.
fn straightened(values: &[f64], index: usize) -> f64 {
    let reach = (4.0 * SMOOTH) as usize;
    let (mut w, mut x, mut xx, mut y, mut xy) = (0.0, 0.0, 0.0, 0.0, 0.0);
    let near = index.saturating_sub(reach)..(index + reach + 1).min(values.len());
    for k in near {
        let lag = k as f64 - index as f64;
        let weight = (-0.5 * (lag / SMOOTH).powi(2)).exp();
        w += weight;
        x += weight * lag;
        xx += weight * lag * lag;
        y += weight * values[k];
        xy += weight * lag * values[k];
    }
    (xx * y - x * xy) / (xx * w - x * x)
}

/// Logarithm of the chance of a change by so many bins.
fn change(bins: usize, width: f64) -> f64 {
    -0.5 * (bins as f64 * width / CHANGE).powi(2)
}

/// Bins of the change that is possible in a step.
fn reach(width: f64) -> usize {
    (4.5 * CHANGE / width).ceil() as usize
}

/// The best path.
fn strongest(weights: &[Vec<f64>], width: f64) -> Vec<usize> {
    let bins = weights[0].len();
    let reach = reach(width);
    let mut score: Vec<f64> = weights[0].iter().map(|w| SHARE * w).collect();
    let mut origin: Vec<Vec<usize>> = Vec::with_capacity(weights.len());
    for weight in &weights[1..] {
        let mut from = vec![0; bins];
        let mut next = vec![0.0; bins];
        for bin in 0..bins {
            let value = |a: usize| score[a] + change(a.abs_diff(bin), width);
            let near = bin.saturating_sub(reach)..(bin + reach + 1).min(bins);
            let best = near
                .max_by(|&a, &b| value(a).total_cmp(&value(b)))
                .unwrap_or(bin);
            from[bin] = best;
            next[bin] = value(best) + SHARE * weight[bin];
        }
        origin.push(from);
        score = next;
    }
    let last = (0..bins).max_by(|&a, &b| score[a].total_cmp(&score[b]));
    let mut path = vec![last.unwrap_or(0)];
    for from in origin.iter().rev() {
        path.push(from[path[path.len() - 1]]);
    }
    path.reverse();
    path
}

/// Chance of each slip at each spectrum.
fn chances(weights: &[Vec<f64>], width: f64) -> Vec<Vec<f64>> {
    let bins = weights[0].len();
    let reach = reach(width);
    let kernel: Vec<f64> = (0..=reach).map(|d| change(d, width).exp()).collect();
    let spread = |from: &[f64]| -> Vec<f64> {
        (0..bins)
            .map(|bin| {
                let near = bin.saturating_sub(reach)..(bin + reach + 1).min(bins);
                near.map(|a| from[a] * kernel[a.abs_diff(bin)]).sum()
            })
            .collect()
    };
    let seen = |from: &[f64], weight: &[f64]| -> Vec<f64> {
        let top = weight.iter().copied().fold(0.0, f64::max);
        let values = from.iter().zip(weight);
        // So small a floor that only what is far stronger reaches over a step that is too large.
        let mut all: Vec<f64> = values
            .map(|(f, w)| f.max(1e-200) * (SHARE * (w - top)).exp())
            .collect();
        let sum: f64 = all.iter().sum();
        all.iter_mut().for_each(|v| *v /= sum);
        all
    };
    let flat = vec![1.0 / bins as f64; bins];
    let mut forward = vec![seen(&flat, &weights[0])];
    for weight in &weights[1..] {
        let before = spread(&forward[forward.len() - 1]);
        forward.push(seen(&before, weight));
    }
    let mut behind = flat;
    for k in (0..weights.len()).rev() {
        let here = seen(&behind, &weights[k]);
        let sum: f64 = forward[k].iter().zip(&behind).map(|(f, b)| f * b).sum();
        for (f, b) in forward[k].iter_mut().zip(&behind) {
            *f = *f * b / sum.max(f64::MIN_POSITIVE);
        }
        behind = spread(&here);
    }
    forward
}

/// A line beside the ridge.
pub(super) struct Rival {
    /// Its slip, or its distance from that of the ridge, 1.
    pub(super) slip: f64,
    /// Its amplitude, unit of the signal, half of a line's.
    pub(super) amplitude: f64,
}

/// The strongest line between two slips in cells without the ridge, at one slip throughout; none where only noise is left.
pub(super) fn rival(cells: &[Cell], middle: f64, slips: (f64, f64)) -> Option<Rival> {
    let half = (cells.len() / 4).clamp(HALF, RIVAL_HALF);
    let spectrum = Spectrum { cells, half };
    let whole = 2.0 * (half as f64 + 1.0) * HOP;
    let bins = ((slips.1 - slips.0) * 4.0 * whole).ceil().max(8.0) as usize;
    let slip = |bin: usize| slips.0 + (bin as f64 + 0.5) * (slips.1 - slips.0) / bins as f64;
    let centres: Vec<usize> = (half..cells.len().saturating_sub(half))
        .step_by(half)
        .collect();
    let powers: Vec<f64> = (0..bins)
        .map(|bin| {
            let table = spectrum.table(middle - slip(bin));
            let sum: f64 = centres.iter().map(|&c| spectrum.power(c, &table)).sum();
            sum / centres.len().max(1) as f64
        })
        .collect();
    let top = (0..bins).max_by(|&a, &b| powers[a].total_cmp(&powers[b]))?;
    let mut around: Vec<f64> = (0..41)
        .map(|k| {
            let table = spectrum.table((f64::from(k) - 20.0) * 0.012);
            let sum: f64 = centres.iter().map(|&c| spectrum.power(c, &table)).sum();
            sum / centres.len().max(1) as f64
        })
        .collect();
    around.sort_by(f64::total_cmp);
    let noise = around[20];
    // Means of so many exponential powers; the highest of some hundred lies below 6 deviations.
    let limit = noise * (1.5 + 6.0 / (centres.len().max(1) as f64).sqrt());
    (powers[top] > limit).then(|| Rival {
        slip: slip(top),
        amplitude: (powers[top] - noise).sqrt(),
    })
}

/// Cells on either side of the middle of a spectrum in which rivals are looked for.
pub(super) const RIVAL_HALF: usize = 80;
