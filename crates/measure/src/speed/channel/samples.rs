//! Samples of a speed: their means, the steps and the noise they show, the quick change and the rest in them.

use crate::quantile::{median, quantile, step};

/// Noise of a mean, as a part of the change, that first sight bears.
const CLEAR: f64 = 0.01;
/// Means in a first look at a record, and in a change once it is seen well enough.
const LOOKED_AT: usize = 400;
const IN_CHANGE: usize = 100;
/// Parts of a change at which it is taken to begin, to be nearly done and to end at first sight.
const BEGUN: f64 = 0.04;
const MOST: f64 = 0.85;
const DONE: f64 = 0.96;
/// Speed of a shaft that counts as at rest, as a part of the largest: what a converter's zero is off by.
const CREEPS: f64 = 0.004;
/// Deviations from zero within which a mean counts as at rest.
const STILL: f64 = 4.0;

/// Samples of a speed along the rotation, rad/s, with sums up to each.
pub(super) struct Samples {
    pub values: Vec<f64>,
    sums: Vec<f64>,
    counts: Vec<usize>,
    changes: Vec<usize>,
    /// Smallest step between values, rad/s; 0 where they come in none.
    pub step: f64,
    /// Standard deviation of the quick noise of one sample, rad/s.
    pub noise: f64,
}

/// A quick change among the samples, by their numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rise {
    pub from: usize,
    pub most: usize,
    pub to: usize,
    /// Speeds before and behind it, rad/s.
    pub low: f64,
    pub high: f64,
    pub rests: bool,
}

impl Samples {
    /// `resolution` is the step where it is known, rad/s.
    pub fn new(values: Vec<f64>, resolution: Option<f64>) -> Samples {
        let step = resolution.unwrap_or_else(|| step(&values));
        let (mut sums, mut counts, mut changes) = (vec![0.0], vec![0], vec![0]);
        let mut before = f64::NAN;
        let (mut sum, mut count, mut changed) = (0.0, 0, 0);
        for &value in &values {
            if value.is_finite() {
                sum += value;
                count += 1;
                changed += usize::from(value != before && before.is_finite());
                before = value;
            }
            sums.push(sum);
            counts.push(count);
            changes.push(changed);
        }
        let noise = quick_noise(&values).max(step / 12f64.sqrt());
        Samples {
            values,
            sums,
            counts,
            changes,
            step,
            noise,
        }
    }

    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Known samples in a part.
    pub fn known(&self, from: usize, to: usize) -> usize {
        self.counts[to] - self.counts[from]
    }

    /// Mean of a part; none where nothing is known of it.
    pub fn mean(&self, from: usize, to: usize) -> Option<f64> {
        let count = self.known(from, to);
        (count > 0).then(|| (self.sums[to] - self.sums[from]) / count as f64)
    }

    /// Variance of a mean by the steps of the values: as if each crossing of a step drew a new rounding error, rad²/s².
    pub fn rounding(&self, from: usize, to: usize) -> f64 {
        let crossings = self.changes[to] - self.changes[from];
        self.step * self.step / 12.0 / crossings.max(1) as f64
    }

    /// Speed below which a mean of so many samples counts as rest, rad/s.
    fn rest(&self, largest: f64, samples: usize) -> f64 {
        let noise = self.noise / (samples.max(1) as f64).sqrt();
        (CREEPS * largest).max(STILL * noise).max(0.75 * self.step)
    }

    /// Means of `size` samples over a part; where none is known the one before is held.
    fn means(&self, from: usize, to: usize, size: usize) -> Vec<f64> {
        let mut held = self.mean(from, to).unwrap_or(0.0);
        (from..to)
            .step_by(size)
            .map(|k| {
                held = self.mean(k, (k + size).min(to)).unwrap_or(held);
                held
            })
            .collect()
    }

    /// Number of samples up to the stop of a shaft that rests at the end of the record; all of them where it turns on.
    pub fn turning(&self, largest: f64) -> usize {
        let n = self.len();
        let size = n.div_ceil(2000);
        let means = self.means(0, n, size);
        let rest = self.rest(largest, size);
        let last = means.iter().rposition(|mean| *mean > rest);
        match last {
            // A few means alone are no rest.
            Some(last) if last + 4 < means.len() => ((last + 1) * size).min(n),
            _ => n,
        }
    }

    /// The steepest rise of speed in a part, where there is one.
    pub fn rise(&self, within: (usize, usize)) -> Option<Rise> {
        let (mut from, mut to) = within;
        let mut size = (to.checked_sub(from)?).div_ceil(LOOKED_AT).max(1);
        let means = self.means(from, to, size);
        let steady = medians(&means, 4);
        let top = (0..steady.len()).max_by(|&a, &b| steady[a].total_cmp(&steady[b]))?;
        let (low, high) = (
            steady[..=top].iter().copied().fold(f64::INFINITY, f64::min),
            steady[top],
        );
        let first = self.first_rest(from, to, high);
        let low = if first > 0 { 0.0 } else { low };
        let change = high - low;
        let clear = |size: usize| self.noise / (size as f64).sqrt() < CLEAR * change;
        let unclear = 8.0 * self.noise / (size as f64).sqrt();
        if change.is_nan() || change < 0.3 * high || change <= unclear {
            return None;
        }
        let at = |part: f64| low + part * change;
        let mut found = None;
        // Closer and closer, until the change has means enough or these have too much noise.
        for _ in 0..20 {
            let means = medians(&self.means(from, to, size), 1);
            let end = means.iter().position(|m| *m >= at(DONE))?;
            let begin = means[..end].iter().rposition(|m| *m <= at(BEGUN));
            let start = begin.map_or(0, |k| k + 1);
            let most = means[..=end].iter().position(|m| *m >= at(MOST))?;
            found = Some(Rise {
                from: (from + start * size).min(to),
                most: (from + most * size).min(to),
                to: (from + end * size + size / 2).min(to),
                low,
                high,
                rests: first > 0,
            });
            let wide = end - start + 1;
            let next = (size * wide).div_ceil(IN_CHANGE).max(1);
            if next >= size || !clear(next) {
                break;
            }
            let margin = 2 * wide * size;
            to = (from + (end + 1) * size + margin).min(within.1);
            from = (from + start * size).saturating_sub(margin).max(within.0);
            size = next;
        }
        let rise = found?;
        let whole = within.1 - within.0;
        // A slow rise of a turning shaft needs no knots.
        (rise.rests || rise.to - rise.from <= whole / 2).then_some(rise)
    }

    /// Number of samples from the first one on at which the shaft rests; 0 where it turns from the beginning.
    fn first_rest(&self, from: usize, to: usize, high: f64) -> usize {
        let size = (to - from).div_ceil(2000);
        let means = self.means(from, to, size);
        let rest = self.rest(high, size);
        let count = means.iter().take_while(|mean| mean.abs() <= rest).count();
        match count * size {
            few if few < 5 => 0,
            count => count,
        }
    }
}

/// Medians over so many neighbours on both sides.
fn medians(values: &[f64], beside: usize) -> Vec<f64> {
    let n = values.len();
    (0..n)
        .map(|k| {
            median((values[k.saturating_sub(beside)..(k + beside + 1).min(n)].iter()).copied())
        })
        .collect()
}

/// Noise of a sample that changes from value to value, rad/s: fourth differences let pass what is smooth.
fn quick_noise(values: &[f64]) -> f64 {
    let sizes = (values.windows(5))
        .map(|w| (w[0] - 4.0 * w[1] + 6.0 * w[2] - 4.0 * w[3] + w[4]).abs())
        .filter(|size| size.is_finite());
    // The weights make √70 of white noise, and 0.683 of normal numbers are within one deviation.
    quantile(sizes, 0.683) / 70f64.sqrt()
}
