//! The shape of a flank, learnt from slow passages, tells where a steep one crosses the middle.
//!
//! A flank that a sampler meets with one or two samples can be laid anywhere between them if its shape is not known; and the
//! error changes slowly from pulse to pulse where the rate of the pulses is nearly a whole part of the sampling rate. Over
//! the angle the shape is the same at every speed, so the slow passages of the same record show it in full.

use super::level::Levels;
use super::median;

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
/// Cells on the steep part of a flank, below which its shape is that of the cells and not its own.
const FEWEST_STEEP: usize = 3;

/// A shape over the angle: height from the middle as a part of the span.
struct Shape {
    heights: [f64; CELLS + 1],
    /// Standard deviation of samples about it.
    scatter: f64,
    /// That of the samples where it rises most.
    steep_scatter: f64,
}

impl Shape {
    /// Cells that are at least half as steep as the steepest one.
    fn steep_cells(&self) -> usize {
        let steps = || self.heights.windows(2).map(|pair| pair[1] - pair[0]);
        let steepest = steps().fold(0.0, f64::max);
        steps().filter(|step| *step >= 0.5 * steepest).count()
    }

    /// Height and slope at an angle, in parts of a pitch; none outside.
    fn at(&self, angle: f64) -> Option<(f64, f64)> {
        let place = (angle / HALF + 1.0) * 0.5 * CELLS as f64;
        if !(0.0..CELLS as f64).contains(&place) {
            return None;
        }
        let k = place as usize;
        let (a, b) = (self.heights[k], self.heights[k + 1]);
        Some((
            a + (b - a) * (place - k as f64),
            (b - a) * CELLS as f64 / (2.0 * HALF),
        ))
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
            lay(samples, &mut found[k], rate, scale, &shape);
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

/// Lays a flank on the shape; returns by how many samples it moved.
fn lay(samples: &[f64], passing: &mut Passing, rate: f64, scale: f64, shape: &Shape) -> f64 {
    let reach = HALF / rate;
    let begin = (passing.place - reach).ceil().max(0.0) as usize;
    let end = ((passing.place + reach) as usize + 1).min(samples.len());
    let mut place = passing.place;
    let mut weight = 0.0;
    for _ in 0..2 {
        let (mut pull, mut stiffness) = (0.0, 0.0);
        for (m, x) in samples.iter().enumerate().take(end).skip(begin) {
            let height = scale * (x - passing.middle);
            if let Some((model, slope)) = shape.at((m as f64 - place) * rate)
                && height.is_finite()
            {
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
        // A flank between two samples lies there with a variance of 1/12; its shape tells more.
        passing.place = place;
        passing.spread = (12.0 + weight / (shape.scatter * shape.scatter))
            .sqrt()
            .recip()
            .max(1e-3);
        return moved;
    }
    0.0
}

/// The mean shape of passages, slow ones first of all: they show it in full.
fn learn(samples: &[f64], found: &[Passing], pupils: &[(usize, f64)], scale: f64) -> Option<Shape> {
    let fastest = pupils.iter().map(|p| p.1).fold(1e-9, f64::max);
    let mut sums = [(0.0, 0.0); CELLS + 1];
    let mut seen = Vec::new();
    for &(k, rate) in pupils {
        let passing = &found[k];
        let weight = (fastest / rate).powi(4).min(1e4);
        let reach = HALF / rate;
        let begin = (passing.place - reach).ceil().max(0.0) as usize;
        let end = ((passing.place + reach) as usize + 1).min(samples.len());
        let step = ((end - begin) / 200).max(1);
        for m in (begin..end).step_by(step) {
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
    };
    let away: Vec<(f64, f64)> = seen
        .iter()
        .filter_map(|&(place, height)| {
            let (model, slope) = shape.at((place / (0.5 * CELLS as f64) - 1.0) * HALF)?;
            Some(((height - model).abs(), slope))
        })
        .collect();
    let steepest = away.iter().map(|a| a.1).fold(0.0, f64::max);
    // The median of |x| is 0.6745 standard deviations for normal x.
    let deviation = |least: f64| {
        let mut sizes: Vec<f64> = away.iter().filter(|a| a.1 >= least).map(|a| a.0).collect();
        median(&mut sizes) / 0.6745
    };
    (shape.scatter, shape.steep_scatter) = (deviation(0.0).max(1e-3), deviation(0.5 * steepest));
    Some(shape)
}
