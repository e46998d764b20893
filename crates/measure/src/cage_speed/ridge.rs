//! Cage speed from a line in a vibration or proximity signal.
//!
//! The signal is turned back by the phase of a rolling cage; what remains of the line is a slow rotation. Its rate is found
//! coarsely as the best path through short spectra, taken out, and the rest of the phase is smoothed.

use super::CageSpeed;
use super::phase::Deviations;
use crate::shaft::Shaft;
use std::f64::consts::{PI, TAU};

/// Where a line is expected.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Speed of a rolling cage over that of the shaft, 1.
    pub ratio: f64,
    /// Cycles of the line in a turn of the cage: the number of balls, or a multiple.
    pub order: f64,
    /// Lowest slip that is looked for, 1; a little below 0 allows for a ratio that is not exact.
    pub lowest_slip: f64,
    /// Highest slip that is looked for, 1.
    pub highest_slip: f64,
    /// Time after which slip may change fast, s.
    pub engagement: Option<f64>,
}

/// Speed of a cage from a signal that holds a line near ball pass.
///
/// `signal` at equal `interval` from the time `first` on, s; NaN where there is none. Values are returned at equal times, about
/// one in four periods of the line. Other lines near it (shaft orders) should be removed before.
pub fn from_vibration(
    first: f64,
    interval: f64,
    signal: &[f64],
    shaft: &Shaft,
    line: &Line,
) -> Result<CageSpeed, String> {
    shaft.check()?;
    refuse(interval, line)?;
    let (from, to) = (
        first.max(shaft.first),
        (first + signal.len() as f64 * interval).min(shaft.last()),
    );
    if to <= from || to.is_nan() || from.is_nan() {
        return Err(
            "the signal is too short to follow a line: it and the shaft have no time in common"
                .into(),
        );
    }
    let fastest = line.ratio * line.order * shaft.fastest() / TAU;
    if fastest <= 0.0 {
        return Err("the shaft does not turn".into());
    }
    let (low, high) = (-line.highest_slip * fastest, -line.lowest_slip * fastest);
    let mut notes = Vec::new();
    let middle = 0.5 * (low + high);
    let reach = 0.5 * (high - low).max(2.0 / (to - from));
    if (fastest + reach) * interval > 0.4 {
        return Err(format!(
            "the line at up to {fastest:.0} Hz needs more than {:.0} values a second",
            2.5 * (fastest + reach)
        ));
    }
    let back = |time: f64| line.order * line.ratio * shaft.angle_at(time);
    // Coarse: 8 values per period of the largest deviation.
    let hop = ((1.0 / (8.0 * reach * interval)) as usize).clamp(1, signal.len().max(1));
    let hop_time = hop as f64 * interval;
    let begin = ((from - first) / interval).ceil().max(0.0) as usize;
    let end = (((to - first) / interval) as usize).min(signal.len());
    if end < begin.saturating_add(32 * hop) {
        return Err(format!(
            "the signal is too short to follow a line: {:.3} s are common to it and the shaft, {:.3} s are needed",
            to - from,
            32.0 * hop_time
        ));
    }
    let mean = {
        let seen = signal[begin..end].iter().filter(|v| v.is_finite());
        seen.clone().sum::<f64>() / seen.count().max(1) as f64
    };
    let slow = Turned {
        first,
        interval,
        signal,
        mean,
    };
    let coarse = slow.blocks(begin, end, hop, 2 * hop, |t| {
        back(t) + TAU * middle * (t - first)
    });
    let path = followed(&coarse, reach * hop_time);
    let rate: Vec<f64> = path
        .iter()
        .map(|cycles| TAU * (middle + cycles / hop_time))
        .collect();
    let start_time = first + begin as f64 * interval;
    // Phase of the coarse path: its rate is linear between blocks.
    let mut phase = vec![0.0];
    for pair in rate.windows(2) {
        phase.push(phase[phase.len() - 1] + 0.5 * (pair[0] + pair[1]) * hop_time);
    }
    let coarse_at = |time: f64| {
        let place = ((time - start_time) / hop_time - 1.0).max(0.0);
        let k = (place as usize).min(rate.len() - 2);
        let u = (place - k as f64).min(1.0);
        let turned = phase[k] + (rate[k] * u + 0.5 * (rate[k + 1] - rate[k]) * u * u) * hop_time;
        (turned, rate[k] + u * (rate[k + 1] - rate[k]))
    };
    // Fine: blocks of four periods of the line, not overlapping, so that white noise stays white.
    let fine = ((4.0 / (fastest * interval)) as usize).max(1);
    let blocks = slow.blocks(begin, end, fine, fine, |t| back(t) + coarse_at(t).0);
    let fine_time = fine as f64 * interval;
    let time: Vec<f64> = (0..blocks.len())
        .map(|k| start_time + (k as f64 + 0.5) * fine_time)
        .collect();
    let removed: Vec<f64> = time.iter().map(|&t| coarse_at(t).1 / line.order).collect();
    let (deviation, weight, weak) = phases(&blocks, line.order);
    if weak > 0.05 {
        notes.push(format!(
            "the line is lost in noise during {:.0} % of the time",
            100.0 * weak
        ));
    }
    let slowest = time
        .iter()
        .map(|&t| line.ratio * line.order * shaft.speed_at(t).abs() / TAU)
        .fold(f64::INFINITY, f64::min);
    if slowest * fine_time < 2.0 {
        notes.push(
            "where the shaft is slow the line is not separated from the mean of the signal".into(),
        );
    }
    let edge = path
        .iter()
        .filter(|c| c.abs() > 0.97 * reach * hop_time)
        .count();
    if edge * 50 > path.len() {
        notes.push("the line runs along the limit of the slip that is looked for".into());
    }
    let data = Deviations {
        time: &time,
        deviation: &deviation,
        weight: &weight,
        wrap: TAU / line.order,
        removed: &removed,
        engagement: line.engagement,
        lock: None,
        from_rest: false,
    };
    data.smoothed(shaft, line.ratio, notes)
}

fn refuse(interval: f64, line: &Line) -> Result<(), String> {
    if !(interval > 0.0 && interval.is_finite()) {
        return Err("the interval of the signal must be positive and finite".into());
    }
    if !(line.ratio > 0.0 && line.ratio.is_finite() && line.order >= 1.0 && line.order.is_finite())
    {
        return Err("ratio and order of the line must be positive".into());
    }
    if !(line.lowest_slip < line.highest_slip
        && line.lowest_slip >= -1.0
        && line.highest_slip <= 1.0)
    {
        return Err("the slip that is looked for must be a range within -1 and 1".into());
    }
    Ok(())
}

struct Turned<'a> {
    first: f64,
    interval: f64,
    signal: &'a [f64],
    mean: f64,
}

impl Turned<'_> {
    /// Means of the signal turned back by a phase, weighted by a Hann window of `length`, one in `hop` values.
    fn blocks(
        &self,
        begin: usize,
        end: usize,
        hop: usize,
        length: usize,
        phase: impl Fn(f64) -> f64,
    ) -> Vec<[f64; 2]> {
        let turned: Vec<[f64; 2]> = (begin..end)
            .map(|k| {
                let value = self.signal[k] - self.mean;
                let (sine, cosine) = phase(self.first + k as f64 * self.interval).sin_cos();
                if value.is_finite() {
                    [value * cosine, -value * sine]
                } else {
                    [0.0, 0.0]
                }
            })
            .collect();
        let window: Vec<f64> = (0..length)
            .map(|i| 1.0 - (TAU * (i as f64 + 0.5) / length as f64).cos())
            .collect();
        let total: f64 = window.iter().sum();
        let mut blocks = Vec::new();
        let mut start = 0;
        while start + length <= turned.len() {
            let mut sum = [0.0; 2];
            for (value, weight) in turned[start..start + length].iter().zip(&window) {
                sum[0] += weight * value[0];
                sum[1] += weight * value[1];
            }
            blocks.push(sum.map(|s| s / total));
            start += hop;
        }
        blocks
    }
}

/// Cycles per value of the strongest smooth path through short spectra of a complex series, within ± `reach`.
fn followed(series: &[[f64; 2]], reach: f64) -> Vec<f64> {
    let half = 8_usize;
    let bins = 65_usize;
    let frequency = |bin: usize| reach * (2.0 * bin as f64 / (bins - 1) as f64 - 1.0);
    let step = 4_usize;
    let centres: Vec<usize> = (0..series.len()).step_by(step).collect();
    let mut powers = Vec::with_capacity(centres.len());
    for &centre in &centres {
        let (from, to) = (
            centre.saturating_sub(half),
            (centre + half + 1).min(series.len()),
        );
        let mut total = 0.0;
        let power: Vec<f64> = (0..bins)
            .map(|bin| {
                let mut sum = [0.0; 2];
                for (k, value) in series.iter().enumerate().take(to).skip(from) {
                    let lag = k as f64 - centre as f64;
                    let weight = 1.0 + (PI * lag / (half as f64 + 1.0)).cos();
                    let (sine, cosine) = (TAU * frequency(bin) * lag).sin_cos();
                    sum[0] += weight * (value[0] * cosine + value[1] * sine);
                    sum[1] += weight * (value[1] * cosine - value[0] * sine);
                }
                sum[0] * sum[0] + sum[1] * sum[1]
            })
            .inspect(|p| total += p)
            .collect();
        let mean = (total / bins as f64).max(f64::MIN_POSITIVE);
        powers.push(
            power
                .into_iter()
                .map(|p| (p / mean).min(1e3))
                .collect::<Vec<f64>>(),
        );
    }
    // Best path: power counts, a move of one bin a step costs little, of more costs its square.
    let penalty = |from: usize, to: usize| 0.15 * (from as f64 - to as f64).powi(2);
    let mut score = powers[0].clone();
    let mut origin = Vec::with_capacity(powers.len());
    for power in &powers[1..] {
        let mut next = vec![0.0; bins];
        let mut from = vec![0_usize; bins];
        for bin in 0..bins {
            let near = bin.saturating_sub(8)..(bin + 9).min(bins);
            let best = near
                .max_by(|&a, &b| {
                    (score[a] - penalty(a, bin)).total_cmp(&(score[b] - penalty(b, bin)))
                })
                .unwrap_or(bin);
            from[bin] = best;
            next[bin] = score[best] - penalty(best, bin) + power[bin];
        }
        origin.push(from);
        score = next;
    }
    let mut bin = (0..bins)
        .max_by(|&a, &b| score[a].total_cmp(&score[b]))
        .unwrap_or(0);
    let mut nodes = vec![frequency(bin)];
    for from in origin.iter().rev() {
        bin = from[bin];
        nodes.push(frequency(bin));
    }
    nodes.reverse();
    // Smooth over three nodes, then linear between them.
    let smooth: Vec<f64> = (0..nodes.len())
        .map(|k| {
            let near = &nodes[k.saturating_sub(1)..(k + 2).min(nodes.len())];
            near.iter().sum::<f64>() / near.len() as f64
        })
        .collect();
    (0..series.len())
        .map(|k| {
            let place = k as f64 / step as f64;
            let i = (place as usize).min(smooth.len().saturating_sub(2));
            match smooth.get(i + 1) {
                Some(next) => smooth[i] + (place - i as f64).min(1.0) * (next - smooth[i]),
                None => smooth[i],
            }
        })
        .collect()
}

/// Deviations of the cage angle, their relative variance, and the share of time in which the line is lost.
fn phases(blocks: &[[f64; 2]], order: f64) -> (Vec<f64>, Vec<f64>, f64) {
    let strength: Vec<f64> = (0..blocks.len())
        .map(|k| {
            let near = &blocks[k.saturating_sub(3)..(k + 4).min(blocks.len())];
            near.iter().map(|b| b[0] * b[0] + b[1] * b[1]).sum::<f64>() / near.len() as f64
        })
        .collect();
    let mean = strength.iter().sum::<f64>() / strength.len().max(1) as f64;
    let deviation = blocks.iter().map(|b| b[1].atan2(b[0]) / order).collect();
    let weight = strength
        .iter()
        .map(|s| (mean / s.max(1e-6 * mean).max(f64::MIN_POSITIVE)).max(1e-3))
        .collect();
    // Noise: what changes from block to block.
    let mut jumps: Vec<f64> = blocks
        .windows(2)
        .map(|w| (w[1][0] - w[0][0]).powi(2) + (w[1][1] - w[0][1]).powi(2))
        .collect();
    jumps.sort_by(f64::total_cmp);
    let noise = jumps.get(jumps.len() / 4).copied().unwrap_or(0.0);
    let lost =
        strength.iter().filter(|s| **s < 1.5 * noise).count() as f64 / strength.len().max(1) as f64;
    (deviation, weight, lost)
}
