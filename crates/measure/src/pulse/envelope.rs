//! The height of pulses where it changes over the record: a magnetic pickup, whose voltage is the speed's, a light that fades.
//!
//! ```text
//! swings      from turning point to turning point, those above 8 standard deviations of the noise
//! no pulses   swings below 0.4 of both neighbours, and what does not join on to the tall ones from swing to swing
//! one level   a slope below 0.15 of the middle of swings over their height: a signal about a level of its own (0.5 for one with a foot)
//! samples     (x - middle)/height,  both from swing to swing
//! ```
//! After that a pulse is one high wherever it is, and levels, hysteresis and flanks are found as in any other record. A signal
//! about a level of its own crosses that level at the same angle whatever its height; one with a foot is halfway up at the same
//! angle.
//!
//! **Does not model**: a height that changes by more than a half from a pulse to the next, but at the first and last ones.

use crate::quantile::median;

/// Height of swings that count, over the standard deviation of the noise.
const ABOVE_NOISE: f64 = 8.0;
/// The same as a part of the usual height.
const LEAST: f64 = 0.01;
/// Height of a swing over that of its neighbours, below which it is none.
const RIPPLE: f64 = 0.4;
/// Height of the tall ones, as a part of the usual height.
const TALL: f64 = 0.5;
/// Time of a swing over that of the one before, at most, where it joins on.
const LONGER: f64 = 4.0;
/// Least height over the largest one, local, at which pulses count as equally high.
const STEADY: f64 = 0.7;
/// Largest slope of the middle over the height of a signal about a level of its own.
const OWN_LEVEL: f64 = 0.15;
/// Part of the samples within 0.3 heights of the middle, from which on a signal has no plateaus: 0.41 of a sine are.
const ON_ITS_WAY: f64 = 0.3;
/// Usual distance of the middle of swings from one level, as a part of their height, below which that level is the middle.
const EVEN: f64 = 0.02;
/// Swings to each side among which the local height is looked for.
const BESIDE: usize = 4;

/// Middle and height over the samples.
pub(super) struct Envelope {
    /// Middles of swings: place in samples, middle and height of the signal there.
    points: Vec<[f64; 3]>,
    /// First and last sample of the pulses.
    pub range: (usize, usize),
    /// Whether the signal swings about a level of its own.
    pub own_level: bool,
    /// Height of the first pulse at which it would have been lost, as a part of it.
    pub unseen: f64,
}

impl Envelope {
    /// That of a signal whose pulses are not equally high, or have no plateaus that give their middle; `usual` is the height of the higher ones.
    pub fn of(samples: &[f64], usual: f64, noise: f64) -> Option<Envelope> {
        let least = (ABOVE_NOISE * noise).max(LEAST * usual);
        let turns = without_ripple(turning_points(samples, least));
        let swings: Vec<Swing> = turns
            .windows(2)
            .map(|pair| Swing {
                from: pair[0].0,
                to: pair[1].0,
                middle: 0.5 * (pair[0].1 + pair[1].1),
                height: (pair[1].1 - pair[0].1).abs(),
            })
            .collect();
        let joined = joined(&swings, TALL * usual);
        let own: Vec<Swing> = swings
            .into_iter()
            .zip(&joined)
            .filter(|(_, joined)| **joined)
            .map(|(swing, _)| swing)
            .collect();
        if own.len() < 4 * BESIDE {
            return None;
        }
        let level = median(own.iter().map(|s| s.middle));
        let own_level = if !is_steady(&own) {
            slope(&own).abs() < OWN_LEVEL
        } else if has_no_plateaus(samples, &own) {
            median(own.iter().map(|s| (s.middle - level).abs())) < EVEN * usual
        } else {
            return None;
        };
        let around = |k: usize, value: &dyn Fn(&Swing) -> f64| {
            let (left, right) = (k.saturating_sub(1), (k + 1).min(own.len() - 1));
            0.25 * (value(&own[left]) + 2.0 * value(&own[k]) + value(&own[right]))
        };
        let points = (0..own.len())
            .map(|k| {
                let middle = match own_level {
                    true => level,
                    false => around(k, &|s| s.middle),
                };
                let place = 0.5 * (own[k].from + own[k].to) as f64;
                [place, middle, around(k, &|s| s.height)]
            })
            .collect();
        Some(Envelope {
            points,
            range: (own[0].from, own[own.len() - 1].to),
            own_level,
            unseen: (least / own[0].height.max(own[1].height)).min(1.0),
        })
    }

    /// Middle and height at a sample.
    pub fn at(&self, sample: usize) -> (f64, f64) {
        let place = sample as f64;
        let next = self.points.partition_point(|point| point[0] < place);
        let right = self.points[next.min(self.points.len() - 1)];
        let left = self.points[next.saturating_sub(1).min(self.points.len() - 1)];
        let part = ((place - left[0]) / (right[0] - left[0])).clamp(0.0, 1.0);
        let part = if part.is_finite() { part } else { 0.0 };
        let between = |i: usize| left[i] + part * (right[i] - left[i]);
        (between(1), between(2))
    }

    /// The signal with pulses of the height one about zero.
    pub fn evened(&self, samples: &[f64]) -> Vec<f64> {
        let even = |(k, x): (usize, &f64)| {
            let (middle, height) = self.at(k);
            (x - middle) / height
        };
        samples.iter().enumerate().map(even).collect()
    }
}

/// From one turning point to the next.
struct Swing {
    /// Samples of the two.
    from: usize,
    to: usize,
    middle: f64,
    height: f64,
}

/// Highest and lowest samples by turns, each at least `least` from the one before.
fn turning_points(samples: &[f64], least: f64) -> Vec<(usize, f64)> {
    let mut turns: Vec<(usize, f64)> = Vec::new();
    // The highest and the lowest sample since the last turning point.
    let mut low: Option<(usize, f64)> = None;
    let mut high: Option<(usize, f64)> = None;
    let mut rising: Option<bool> = None;
    for (k, &x) in samples.iter().enumerate().filter(|(_, x)| x.is_finite()) {
        if high.is_none_or(|high| x > high.1) {
            high = Some((k, x));
        }
        if low.is_none_or(|low| x < low.1) {
            low = Some((k, x));
        }
        let (Some(lowest), Some(highest)) = (low, high) else {
            continue;
        };
        if rising != Some(false) && highest.1 - x >= least {
            turns.push(highest);
            (rising, low, high) = (Some(false), Some((k, x)), Some((k, x)));
        } else if rising != Some(true) && x - lowest.1 >= least {
            turns.push(lowest);
            (rising, low, high) = (Some(true), Some((k, x)), Some((k, x)));
        }
    }
    turns.extend(match rising {
        Some(true) => high,
        Some(false) => low,
        None => None,
    });
    turns
}

/// Turning points without those of swings that are much smaller than what is around them.
fn without_ripple(turns: Vec<(usize, f64)>) -> Vec<(usize, f64)> {
    let mut kept: Vec<(usize, f64)> = Vec::with_capacity(turns.len());
    for turn in turns {
        kept.push(turn);
        while let [.., a, b, c, d] = kept.as_slice() {
            let (before, own, after) = ((b.1 - a.1).abs(), (c.1 - b.1).abs(), (d.1 - c.1).abs());
            if own > before.min(after) || own > RIPPLE * before.max(after) {
                break;
            }
            let last = kept.len() - 1;
            kept.drain(last - 2..last);
        }
    }
    kept
}

/// Which swings are pulses: the tall ones, and those that join on to them one by one.
fn joined(swings: &[Swing], tall: f64) -> Vec<bool> {
    let mut joined: Vec<bool> = swings.iter().map(|s| s.height >= tall).collect();
    let time = |k: usize| (swings[k].to - swings[k].from) as f64;
    let joins = |k: usize, last: usize, before: usize| {
        let local = 0.5 * (swings[last].height + swings[before].height);
        swings[k].height >= RIPPLE * local.min(swings[last].height)
            && time(k) <= LONGER * time(last).max(time(before))
    };
    for k in 2..swings.len() {
        joined[k] = joined[k] || joined[k - 1] && joined[k - 2] && joins(k, k - 1, k - 2);
    }
    for k in (0..swings.len().saturating_sub(2)).rev() {
        joined[k] = joined[k] || joined[k + 1] && joined[k + 2] && joins(k, k + 1, k + 2);
    }
    joined
}

/// Whether all pulses are about equally high: a local height is the second largest of some, so that one that is sampled beside
/// its top does not count, nor a spike.
fn is_steady(swings: &[Swing]) -> bool {
    let (mut least, mut largest) = (f64::INFINITY, 0.0f64);
    for k in 0..swings.len() {
        let near = &swings[k.saturating_sub(BESIDE)..(k + BESIDE + 1).min(swings.len())];
        let (first, second) = near
            .iter()
            .fold((0.0f64, 0.0f64), |(first, second), swing| {
                (first.max(swing.height), second.max(first.min(swing.height)))
            });
        assert!(first >= second);
        (least, largest) = (least.min(second), largest.max(second));
    }
    least > STEADY * largest
}

/// Whether the signal is between its levels most of the time, as a sine is and pulses with plateaus are not.
fn has_no_plateaus(samples: &[f64], swings: &[Swing]) -> bool {
    let (mut between, mut count) = (0.0, 0.0);
    for swing in swings {
        let step = (swing.to - swing.from).div_ceil(50);
        for x in samples[swing.from..swing.to].iter().step_by(step) {
            count += 1.0;
            between += f64::from(u8::from((x - swing.middle).abs() < 0.3 * swing.height));
        }
    }
    between > ON_ITS_WAY * count
}

/// Slope of the middle of swings over their height, by least squares.
fn slope(swings: &[Swing]) -> f64 {
    let count = swings.len() as f64;
    let mean = |value: &dyn Fn(&Swing) -> f64| swings.iter().map(value).sum::<f64>() / count;
    let (height, middle) = (mean(&|s| s.height), mean(&|s| s.middle));
    let both = mean(&|s| (s.height - height) * (s.middle - middle));
    both / mean(&|s| (s.height - height).powi(2)).max(f64::MIN_POSITIVE)
}
