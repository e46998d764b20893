//! The shape of a flank, learnt from slow passages, shows where a steep one crosses the middle.
//!
//! A flank that a sampler meets with one or two samples can be laid anywhere between them if its shape is not known; and the
//! error changes slowly from pulse to pulse where the rate of the pulses is nearly a whole part of the sampling rate. Over
//! the angle the shape is the same at every speed, so the slow passages of the same record show it in full.

use super::level::Levels;
use crate::quantile::median;
use statistics::normal::MEDIAN_OF_SIZE;

/// A crossing of the middle, in samples.
pub(super) struct Passing {
    pub place: f64,
    /// Standard uncertainty.
    pub spread: f64,
    /// Whether several samples lie on the flank.
    pub resolved: bool,
    pub rises: bool,
    /// Middle between the levels there.
    pub middle: f64,
}

/// Half width of the shape, as a part of the angle between marks.
const HALF: f64 = 0.2;
/// Rounds of learning the shape and laying the flanks on it.
const ROUNDS: usize = 40;
/// Passages that it is learnt from, at most.
const PUPILS: usize = 600;
/// Cells of the shape.
const CELLS: usize = 40;
/// Passages needed to learn from.
const FEWEST: usize = 4;
/// Largest change of the rate of passages from one to the next that leaves a flank its shape.
const EVEN: f64 = 0.3;
/// Scatter on the flank, as a part of the span, above which the record does not show its shape: samples that are either low or
/// high, as of a digital pickup, lie by 0.3 and more from any shape between.
const UNSEEN: f64 = 0.1;
/// Places at which a flank is tried: so far to either side, samples, so many at once, and so often closer.
const AWAY: f64 = 1.0;
const PLACES: usize = 40;
const CLOSER: usize = 5;
/// Share of samples whose error is so many times as large as that of the others. One sample of a plateau that is off by four
/// deviations is no proof that a flank begins there: were errors taken as normal throughout, a pulse in ten thousand would lie
/// half a sample off at a deviation of a fiftieth, and a quiet shaft would seem to swing.
const GROSS: f64 = 0.02;
const GROSSER: f64 = 4.0;
/// Cells on the steep part of a flank, below which its shape is that of the cells and not its own.
const FEWEST_STEEP: usize = 3;

/// A shape over the angle: height from the middle as a part of the span.
struct Shape {
    heights: [f64; CELLS + 1],
    /// Standard deviation of samples about it.
    scatter: f64,
    /// That of the samples where it rises most.
    steep_scatter: f64,
    /// Largest slope.
    steepest: f64,
}

impl Shape {
    /// Cells that are at least half as steep as the steepest one.
    fn steep_cells(&self) -> usize {
        let steps = || self.heights.windows(2).map(|pair| pair[1] - pair[0]);
        let steepest = steps().fold(0.0, f64::max);
        steps().filter(|step| *step >= 0.5 * steepest).count()
    }

    /// Whether the shape is other than flat somewhere in an interval of angles, in parts of a pitch.
    fn changes(&self, from: f64, to: f64) -> bool {
        self.inside(to).0 - self.inside(from).0 > 0.25 * self.scatter
    }

    /// Height and slope at an angle; beyond the ends as at them.
    fn inside(&self, angle: f64) -> (f64, f64) {
        let within = HALF * (1.0 - 1e-9);
        let slope = |found: Option<(f64, f64)>| found.unwrap_or((0.0, 0.0));
        slope(self.at(angle.clamp(-within, within)))
    }

    /// Height that a sample is expected to have at an angle, and its variance: steep parts scatter more.
    fn expected(&self, angle: f64) -> (f64, f64) {
        let (height, slope) = self.inside(angle);
        let more = (self.steep_scatter.powi(2) - self.scatter.powi(2)).max(0.0);
        let part = (slope / self.steepest).powi(2).min(1.0);
        (height, self.scatter.powi(2) + part * more)
    }

    /// Height and slope at an angle, in parts of a pitch; none outside. Cubics through the cells, with slopes that let none of
    /// them overshoot.
    fn at(&self, angle: f64) -> Option<(f64, f64)> {
        let place = (angle / HALF + 1.0) * 0.5 * CELLS as f64;
        if !(0.0..CELLS as f64).contains(&place) {
            return None;
        }
        let (k, x) = (place as usize, place.fract());
        let rise = |k: usize| self.heights[k + 1] - self.heights[k];
        let slope = |k: usize| {
            let (left, right) = (rise(k.max(1) - 1), rise(k.min(CELLS - 1)));
            if left * right > 0.0 {
                2.0 * left * right / (left + right)
            } else {
                0.0
            }
        };
        let (from, to, up) = (slope(k), slope(k + 1), rise(k));
        let (square, cube) = (3.0 * up - 2.0 * from - to, from + to - 2.0 * up);
        let height = self.heights[k] + x * (from + x * (square + x * cube));
        let steepness = from + x * (2.0 * square + x * 3.0 * cube);
        Some((height, steepness * CELLS as f64 / (2.0 * HALF)))
    }
}

/// Improves the places of steep flanks of one kind, where the record shows the shape.
pub(super) fn sharpen(samples: &[f64], found: &mut [Passing], rises: bool, levels: &Levels) {
    let own: Vec<usize> = (0..found.len())
        .filter(|&k| found[k].rises == rises)
        .collect();
    if own.len() < 2 * FEWEST || own.iter().all(|&k| found[k].resolved) {
        return;
    }
    // Passages per sample, and whether that is steady enough.
    let rates: Vec<Option<f64>> = (0..own.len())
        .map(|j| {
            let here = found[own[j]].place;
            let left = here - found[own[j.checked_sub(1)?]].place;
            let right = found[*own.get(j + 1)?].place - here;
            let even = (left - right).abs() < EVEN * left.min(right);
            even.then(|| 2.0 / (left + right))
        })
        .collect();
    let sign = if rises { 1.0 } else { -1.0 };
    let scale = sign / levels.span;
    let pupils = pupils(&own, &rates);
    let before: Vec<(f64, f64)> = own
        .iter()
        .map(|&k| (found[k].place, found[k].spread))
        .collect();
    let mut last = None;
    for _ in 0..ROUNDS {
        let Some(shape) = learn(samples, found, &pupils, scale) else {
            break;
        };
        let mut moved = 0.0f64;
        for &(k, rate) in &pupils {
            if !found[k].resolved {
                moved += lay(samples, &mut found[k], rate, scale, &shape).powi(2);
            }
        }
        last = Some(shape);
        if moved < 1e-6 * pupils.len() as f64 {
            break;
        }
    }
    let Some(shape) = last else { return };
    if shape.steep_scatter > UNSEEN || shape.steep_cells() < FEWEST_STEEP {
        for (&k, &(place, spread)) in own.iter().zip(&before) {
            (found[k].place, found[k].spread) = (place, spread);
        }
        return;
    }
    for (&k, rate) in own.iter().zip(&rates) {
        if let Some(rate) = *rate
            && !found[k].resolved
        {
            weigh(samples, &mut found[k], rate, scale, &shape);
        }
    }
}

/// Passages to learn from with their rates, in order: the slow ones show the shape in full, however few they are in a long
/// record; others are taken from all over it.
fn pupils(own: &[usize], rates: &[Option<f64>]) -> Vec<(usize, f64)> {
    let steady: Vec<(usize, f64)> = own
        .iter()
        .zip(rates)
        .filter_map(|(&k, rate)| Some((k, (*rate)?)))
        .collect();
    if steady.len() <= PUPILS {
        return steady;
    }
    let mut slowest = steady.clone();
    slowest.sort_by(|a, b| a.1.total_cmp(&b.1));
    slowest.truncate(PUPILS / 2);
    let step = steady.len().div_ceil(PUPILS / 2);
    slowest.extend(steady.iter().step_by(step));
    slowest.sort_by_key(|pupil| pupil.0);
    slowest.dedup_by_key(|pupil| pupil.0);
    slowest
}

/// Samples within the shape's half width of a place, by their numbers.
fn window(samples: &[f64], place: f64, rate: f64) -> std::ops::Range<usize> {
    let reach = HALF / rate;
    let begin = (place - reach).ceil().max(0.0) as usize;
    begin..((place + reach) as usize + 1).min(samples.len())
}

/// The same with their heights from the middle as parts of the span; what is no number is left out.
fn near<'a>(
    samples: &'a [f64],
    passing: &Passing,
    rate: f64,
    scale: f64,
) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
    let middle = passing.middle;
    window(samples, passing.place, rate)
        .map(move |m| (m as f64, scale * (samples[m] - middle)))
        .filter(|(_, height)| height.is_finite())
}

/// Lays a flank on the shape; returns by how many samples it moved.
fn lay(samples: &[f64], passing: &mut Passing, rate: f64, scale: f64, shape: &Shape) -> f64 {
    let near = near(samples, passing, rate, scale);
    let mut place = passing.place;
    let mut weight = 0.0;
    for _ in 0..2 {
        let (mut pull, mut stiffness) = (0.0, 0.0);
        for (m, height) in near.clone() {
            if let Some((model, slope)) = shape.at((m - place) * rate) {
                let slope = slope * rate;
                pull -= slope * (height - model);
                stiffness += slope * slope;
            }
        }
        weight = stiffness;
        if stiffness <= 0.0 {
            break;
        }
        place += (pull / stiffness).clamp(-0.3, 0.3);
    }
    let moved = place - passing.place;
    if weight > 0.0 && moved.abs() < 0.6 {
        // A flank between two samples lies there with a variance of 1/12; its shape says more.
        passing.place = place;
        passing.spread = (12.0 + weight / (shape.scatter * shape.scatter))
            .sqrt()
            .recip()
            .max(1e-3);
        return moved;
    }
    0.0
}

/// Lays a flank on the shape: mean of all places at which the samples about it are likely, and their deviation. A flank that
/// hides between two samples may be anywhere there; one that a sample meets is where that sample says, if it is not grossly off.
fn weigh(samples: &[f64], passing: &mut Passing, rate: f64, scale: f64, shape: &Shape) {
    let near: Vec<(f64, f64)> = near(samples, passing, rate, scale)
        .filter(|(m, _)| {
            let (from, to) = (m - passing.place - AWAY, m - passing.place + AWAY);
            shape.changes(from * rate, to * rate)
        })
        .collect();
    let likely = |place: f64, gross: f64| -> f64 {
        near.iter()
            .map(|&(m, height)| {
                let (model, variance) = shape.expected((m - place) * rate);
                variance.ln() + surprise((height - model).powi(2) / variance, gross)
            })
            .sum()
    };
    let about = passing.place;
    if let Some((mean, spread)) = moments(about, |place| likely(place, 0.0)) {
        let open = moments(about, |place| likely(place, GROSS));
        let wider = open.map_or(0.0, |(other, wider)| wider.hypot(other - mean));
        passing.place = mean;
        passing.spread = spread.max(wider).max(1e-3);
    }
}

/// Mean and deviation of a place from twice the negative logarithm of how likely it is, looked at more closely until the steps
/// are fine enough.
fn moments(about: f64, misfit: impl Fn(f64) -> f64) -> Option<(f64, f64)> {
    let (mut from, mut to) = (about - AWAY, about + AWAY);
    for _ in 0..CLOSER {
        let step = (to - from) / PLACES as f64;
        let misfits: Vec<f64> = (0..=PLACES)
            .map(|k| misfit(from + k as f64 * step))
            .collect();
        let least = misfits.iter().copied().fold(f64::INFINITY, f64::min);
        let (mut sum, mut first, mut second) = (0.0, 0.0, 0.0);
        let (mut low, mut high) = (to, from);
        for (k, misfit) in misfits.iter().enumerate() {
            let place = k as f64 * step;
            let weight = (0.5 * (least - misfit)).exp();
            sum += weight;
            first += weight * place;
            second += weight * place * place;
            if weight > 1e-4 {
                low = low.min(from + place - step);
                high = high.max(from + place + step);
            }
        }
        let mean = first / sum;
        let spread = (second / sum - mean * mean).max(0.0).sqrt();
        if spread > 1.5 * step || high - low > 0.7 * (to - from) {
            return Some((from + mean, spread));
        }
        (from, to) = (low, high);
    }
    None
}

/// Twice the negative logarithm of how likely an error is, from its square in variances and the share of gross ones.
///
/// Source: Tukey's contaminated normal distribution (from memory).
fn surprise(square: f64, gross: f64) -> f64 {
    if gross == 0.0 {
        return square;
    }
    let wide = gross / GROSSER * (-0.5 * square / (GROSSER * GROSSER)).exp();
    -2.0 * ((1.0 - gross) * (-0.5 * square).exp() + wide).ln()
}

/// The mean shape of passages, slow ones first of all: they show it in full.
fn learn(samples: &[f64], found: &[Passing], pupils: &[(usize, f64)], scale: f64) -> Option<Shape> {
    let fastest = pupils.iter().map(|p| p.1).fold(1e-9, f64::max);
    let mut sums = [(0.0, 0.0); CELLS + 1];
    let mut seen = Vec::new();
    for &(k, rate) in pupils {
        let passing = &found[k];
        let weight = (fastest / rate).powi(4).min(1e4);
        let window = window(samples, passing.place, rate);
        let step = (window.len() / 200).max(1);
        for m in window.step_by(step) {
            let height = scale * (samples[m] - passing.middle);
            let place = ((m as f64 - passing.place) * rate / HALF + 1.0) * 0.5 * CELLS as f64;
            if height.is_finite() && place >= 0.0 && place < CELLS as f64 {
                seen.push((place, height));
                let (k, part) = (place as usize, place.fract());
                for (cell, part) in [(k, 1.0 - part), (k + 1, part)] {
                    sums[cell].0 += weight * part;
                    sums[cell].1 += weight * part * height;
                }
            }
        }
    }
    if pupils.len() < FEWEST || sums.iter().any(|s| s.0 < 0.5) {
        return None;
    }
    let mut heights: [f64; CELLS + 1] = std::array::from_fn(|k| sums[k].1 / sums[k].0);
    for k in 1..=CELLS {
        heights[k] = heights[k].max(heights[k - 1]);
    }
    let mut shape = Shape {
        heights,
        scatter: 0.0,
        steep_scatter: 0.0,
        steepest: 0.0,
    };
    let away: Vec<(f64, f64)> = seen
        .iter()
        .filter_map(|&(place, height)| {
            let (model, slope) = shape.at((place / (0.5 * CELLS as f64) - 1.0) * HALF)?;
            Some(((height - model).abs(), slope))
        })
        .collect();
    let steepest = away.iter().map(|a| a.1).fold(0.0, f64::max);
    let deviation =
        |least: f64| median(away.iter().filter(|a| a.1 >= least).map(|a| a.0)) / MEDIAN_OF_SIZE;
    (shape.scatter, shape.steep_scatter) = (deviation(0.0).max(1e-3), deviation(0.5 * steepest));
    shape.steepest = steepest.max(1e-12);
    Some(shape)
}
