//! From samples to the instants of flanks.

use super::envelope::Envelope;
use super::flank::{Passing, sharpen};
use super::flip::Flip;
use super::level::Levels;
use super::shape::Shape;
use super::spike;
use super::{Edges, Flank, Refusal};
use problem::note;

/// Samples on each side of a crossing that a straight line is laid through, at most.
const REACH: usize = 24;
/// Part of the height of a pulse, on each side of the middle, in which a flank is taken as straight.
const STRAIGHT: f64 = 0.3;
/// Part of what a parabola corrects that may still be wrong.
const LEFT: f64 = 0.3;
/// Deviations of the crossing by which that of a parabola is elsewhere, from which on a flank is bent.
const BENT: f64 = 3.0;
/// Samples of a plateau, next to the flank, that give its level, at most.
const PLATEAU: usize = 64;

/// Finds the instants at which a sampled signal crosses the middle between its two levels.
///
/// `flank`: which flank marks the passage. `first` is the time of the first sample and `interval` the time between samples, s. A sample that is not finite is a
/// gap: nothing is counted across it, and a note says so. The crossing is the root of a straight line through the samples
/// of the flank where it has at least four of them, of a cubic through its neighbours else. The uncertainty is the noise of
/// the samples divided by the slope, and the error of interpolation: for a flank steeper than the sampling the interval
/// divided by √12. Where the record holds slow passages, they show the shape of a flank over the angle, and steep flanks are
/// laid on that shape.
pub fn edges(first: f64, interval: f64, samples: &[f64], flank: Flank) -> Result<Edges, Refusal> {
    if !(interval.is_finite() && interval > 0.0 && first.is_finite()) {
        return Err(Refusal::new(
            format!("sampling interval {interval} s from {first} s"),
            "a positive interval",
        ));
    }
    if samples.len() < 4 {
        return Err(Refusal::new(
            format!("the signal has {} samples", samples.len()),
            "a signal with pulses",
        ));
    }
    let levels = Levels::find(samples)?;
    let (levels, evened) = match Envelope::of(samples, levels.span, levels.noise) {
        Some(envelope) => {
            let evened = envelope.evened(samples);
            (Levels::evened(levels.noise, envelope), Some(evened))
        }
        None => (levels, None),
    };
    let samples = evened.as_deref().unwrap_or(samples);
    let own_level = levels.envelope().is_some_and(|e| e.own_level);
    let mut notes = Vec::new();
    let gaps = samples
        .windows(2)
        .filter(|pair| pair[0].is_finite() && !pair[1].is_finite())
        .count();
    if gaps > 0 {
        notes.push(note!(
            "the signal has {} gaps; no flank is counted across a gap",
            gaps
        ));
    }
    let flips = flips(samples, &levels);
    let (flips, spikes) = spike::without(flips);
    notes.extend(spikes.map(|(count, sample)| {
        note!(
            "{} spikes beside pulses many times as wide, the first at {:.6} s: left out",
            count,
            first + interval * sample as f64
        )
    }));
    let middles = middles(samples, &flips, &levels, own_level);
    let mut found: Vec<Passing> = flips
        .iter()
        .zip(&middles)
        .filter_map(|(flip, &middle)| {
            let (place, spread, resolved) = crossing(samples, flip, middle, &levels)?;
            Some(Passing {
                place,
                spread,
                resolved,
                rises: flip.rises,
                middle,
            })
        })
        .collect();
    found.sort_by(|a, b| a.place.total_cmp(&b.place));
    let kinds: &[bool] = match flank {
        Flank::Rising => &[true],
        Flank::Falling => &[false],
        Flank::Both | Flank::Centre => &[true, false],
    };
    for &rises in kinds {
        match Shape::of(samples, &found, rises, &levels) {
            Shape::Same => sharpen(samples, &mut found, rises, &levels),
            Shape::OverSpeed(over) => {
                sharpen(&over.samples, &mut found, rises, &levels);
                over.state(&mut found, rises, &levels);
            }
            Shape::None => {}
        }
    }
    found.sort_by(|a, b| a.place.total_cmp(&b.place));
    let found = found
        .iter()
        .map(|f| (first + f.place * interval, f.spread * interval, f.rises));
    let chosen: Vec<(f64, f64, bool)> = match flank {
        Flank::Rising => found.filter(|e| e.2).collect(),
        Flank::Falling => found.filter(|e| !e.2).collect(),
        Flank::Both => found.collect(),
        Flank::Centre => found
            .collect::<Vec<_>>()
            .windows(2)
            .filter(|pair| pair[0].2 && !pair[1].2)
            .map(|pair| {
                (
                    0.5 * (pair[0].0 + pair[1].0),
                    0.5 * pair[0].1.hypot(pair[1].1),
                    true,
                )
            })
            .collect(),
    };
    if chosen.is_empty() {
        return Err(Refusal::new(
            "the signal has no complete flank".into(),
            "at least one mark that passes",
        ));
    }
    Ok(Edges {
        times: chosen.iter().map(|e| e.0).collect(),
        uncertainties: chosen.iter().map(|e| e.1).collect(),
        rises: chosen.iter().map(|e| e.2).collect(),
        flank,
        watched: (first, first + interval * (samples.len() - 1) as f64),
        sample_interval: Some(interval),
        unseen: levels
            .envelope()
            .filter(|e| e.own_level)
            .map_or(0.0, |e| e.unseen),
        unwatched: unwatched(first, interval, samples),
        notes,
    })
}

/// Stretches between finite samples, s.
fn unwatched(first: f64, interval: f64, samples: &[f64]) -> Vec<(f64, f64)> {
    let mut stretches = Vec::new();
    let mut last = None;
    for k in (0..samples.len()).filter(|&k| samples[k].is_finite()) {
        if let Some(last) = last
            && k > last + 1
        {
            stretches.push((first + interval * last as f64, first + interval * k as f64));
        }
        last = Some(k);
    }
    stretches
}

/// Changes between the levels, with hysteresis.
fn flips(samples: &[f64], levels: &Levels) -> Vec<Flip> {
    let mut flips = Vec::new();
    let mut high: Option<bool> = None;
    let (from, to) = levels
        .envelope()
        .map_or((0, samples.len()), |e| (e.range.0, e.range.1 + 1));
    for (sample, &x) in samples.iter().enumerate().take(to).skip(from) {
        if !x.is_finite() {
            high = None;
            continue;
        }
        let part = (4.0 * levels.noise_at(sample) / levels.span).clamp(0.15, 0.4);
        let margin = levels.span * part;
        let away = x - levels.middle(sample);
        let now = if away > margin {
            true
        } else if away < -margin {
            false
        } else {
            continue;
        };
        if high == Some(!now) {
            flips.push(Flip { sample, rises: now });
        }
        high = Some(now);
    }
    flips
}

/// The middle between the levels at every flip: between the plateaus on its two sides, so that it follows a drift, and the
/// height of each mark. Plateaus of few samples give their level with noise, so that each middle is drawn to that of its
/// neighbours as far as these differ by no more than noise.
fn middles(samples: &[f64], flips: &[Flip], levels: &Levels, own_level: bool) -> Vec<f64> {
    let own: Vec<Middle> = flips
        .iter()
        .enumerate()
        .map(|(k, flip)| {
            let rough = levels.middle(flip.sample);
            let unknown = Middle {
                value: rough,
                variance: f64::INFINITY,
            };
            if own_level {
                return unknown;
            }
            let begin = k
                .checked_sub(1)
                .map_or(0, |last| flips[last].sample)
                .max(flip.sample.saturating_sub(PLATEAU));
            let end = flips
                .get(k + 1)
                .map_or(samples.len(), |next| next.sample)
                .min(flip.sample + PLATEAU);
            let sign = if flip.rises { 1.0 } else { -1.0 };
            let before = plateau(&samples[begin..flip.sample], rough, -sign);
            let after = plateau(&samples[flip.sample..end], rough, sign);
            let (Some(before), Some(after)) = (before, after) else {
                return unknown;
            };
            // A plateau that a gap cut short must not carry the middle out of the flank.
            let most = 0.2 * levels.span;
            Middle {
                value: (0.5 * (before.0 + after.0)).clamp(rough - most, rough + most),
                variance: 0.25
                    * levels.noise_at(flip.sample).powi(2)
                    * (1.0 / before.1 + 1.0 / after.1),
            }
        })
        .collect();
    (0..own.len()).map(|k| among_neighbours(&own, k)).collect()
}

/// A middle as its own plateaus give it.
struct Middle {
    value: f64,
    /// Variance that the noise of the samples leaves.
    variance: f64,
}

/// A middle, given its neighbours: their mean, and so much of the difference from it as neighbours differ in truth.
fn among_neighbours(own: &[Middle], k: usize) -> f64 {
    const NEIGHBOURS: usize = 20;
    let here = &own[k];
    let near = &own[k.saturating_sub(NEIGHBOURS)..(k + NEIGHBOURS + 1).min(own.len())];
    let mean_of = |value: &dyn Fn(&Middle) -> f64| {
        let known = near.iter().filter(|middle| middle.variance.is_finite());
        let (sum, weights) = known.fold((0.0, 0.0), |(sum, weights), middle| {
            let weight = middle.variance.max(1e-30).recip();
            (sum + weight * value(middle), weights + weight)
        });
        (weights > 0.0).then(|| sum / weights)
    };
    let Some(mean) = mean_of(&|middle| middle.value) else {
        return here.value;
    };
    if !here.variance.is_finite() {
        return mean;
    }
    let apart = mean_of(&|middle| (middle.value - mean).powi(2) - middle.variance);
    let apart = apart.unwrap_or(0.0).max(0.0);
    mean + (here.value - mean) * apart / (apart + here.variance).max(1e-30)
}

/// Samples of a plateau up to which half of them are taken for its corners: their heights follow the place of the flank, and a
/// middle that follows it too hides where it is.
const CORNERS: usize = 6;

/// Level of a plateau on one side of the middle, mean of the samples that are far from it, and their number.
fn plateau(samples: &[f64], middle: f64, sign: f64) -> Option<(f64, f64)> {
    let mut away: Vec<f64> = samples
        .iter()
        .map(|x| sign * (x - middle))
        .filter(|x| x.is_finite())
        .collect();
    away.sort_by(|a, b| b.total_cmp(a));
    if away.len() <= CORNERS {
        away.truncate((away.len() / 2).max(1));
    }
    let largest = *away.first()?;
    let (sum, count) = away
        .iter()
        .filter(|&&x| x >= 0.8 * largest)
        .fold((0.0, 0usize), |(s, n), x| (s + x, n + 1));
    let count = count.max(1) as f64;
    (largest > 0.0).then(|| (middle + sign * sum / count, count))
}

/// Where the signal crosses the middle at a flip, and the standard uncertainty of it, both in samples; and whether the flank
/// itself was seen, not only its two sides.
fn crossing(
    samples: &[f64],
    flip: &Flip,
    middle: f64,
    levels: &Levels,
) -> Option<(f64, f64, bool)> {
    let sign = if flip.rises { 1.0 } else { -1.0 };
    let height = |k: usize| sign * (samples[k] - middle);
    // The last sample below the middle before the flip.
    let mut below = flip.sample;
    while height(below) > 0.0 {
        below = below.checked_sub(1)?;
        if !samples[below].is_finite() {
            return None;
        }
    }
    if below == flip.sample {
        // The middle was moved beyond the flip: go forward.
        while samples
            .get(below + 1)
            .is_some_and(|&x| sign * (x - middle) <= 0.0)
        {
            below += 1;
        }
    }
    if !samples.get(below + 1)?.is_finite() {
        return None;
    }
    let limit = STRAIGHT * levels.span;
    let noise_here = levels.noise_at(flip.sample);
    let mut from = below + 1;
    while from > 0
        && below + 1 - from < REACH
        && samples[from - 1].is_finite()
        && height(from - 1) > -limit
    {
        from -= 1;
    }
    let mut to = below + 1;
    while to < samples.len() && to - below <= REACH && samples[to].is_finite() && height(to) < limit
    {
        to += 1;
    }
    let count = to - from;
    if count >= 4 {
        let n = count as f64;
        let centre = (from + to - 1) as f64 / 2.0;
        let mean = (from..to).map(height).sum::<f64>() / n;
        let (mut up, mut square) = (0.0, 0.0);
        for k in from..to {
            let x = k as f64 - centre;
            up += x * height(k);
            square += x * x;
        }
        let slope = up / square;
        if slope > 0.0 {
            let away = -mean / slope;
            let misfit = (from..to)
                .map(|k| (height(k) - mean - slope * (k as f64 - centre)).powi(2))
                .sum::<f64>();
            let noise = noise_here.max((misfit / (n - 2.0)).sqrt());
            let spread = noise / slope * (1.0 / n + away * away / square).sqrt();
            // A shaft that starts or stops on the flank bends it; by how much a parabola crosses elsewhere is open.
            let middle = square / n;
            let (mut along, mut fourth) = (0.0, 0.0);
            for k in from..to {
                let x = (k as f64 - centre).powi(2) - middle;
                along += x * height(k);
                fourth += x * x;
            }
            let shift = -along / fourth * (away * away - middle) / slope;
            let bent = shift.abs() > BENT * spread;
            // About a level of its own a signal is straight but for the motion: the parabola is right.
            let (away, spread) = match levels.envelope().is_some_and(|e| e.own_level) {
                true => {
                    let own = noise_here / slope * (1.0 / n + middle * middle / fourth).sqrt();
                    let left = if bent { LEFT * shift } else { 0.0 };
                    (away + shift, own.hypot(left))
                }
                false => (away, if bent { spread.hypot(shift) } else { spread }),
            };
            if away.abs() <= n {
                return Some((centre + away, spread.max(1e-3), true));
            }
        }
    }
    let (a, b) = (height(below), height(below + 1));
    let slope = b - a;
    if !(slope.is_finite() && slope > 0.0) {
        return None;
    }
    let inside = |k: usize| {
        if k < samples.len() && samples[k].is_finite() {
            Some(height(k))
        } else {
            None
        }
    };
    let before = below.checked_sub(1).and_then(inside).unwrap_or(2.0 * a - b);
    let after = inside(below + 2).unwrap_or(2.0 * b - a);
    let place = cubic_root(before, a, b, after);
    // A flank that fills the whole sampling interval can lie anywhere in it; one that takes several is interpolated well.
    let width = levels.span / slope;
    let interpolation = 0.29 * (-1.2 * (width - 1.0).max(0.0)).exp();
    Some((
        below as f64 + place,
        (noise_here / slope).hypot(interpolation).max(1e-3),
        false,
    ))
}

/// Root between the second and the third of four equidistant values, of the cubic whose slopes there are central differences.
fn cubic_root(before: f64, a: f64, b: f64, after: f64) -> f64 {
    let (left, right) = (0.5 * (b - before), 0.5 * (after - a));
    let value = |x: f64| {
        let y = 1.0 - x;
        a * (1.0 + 2.0 * x) * y * y + b * x * x * (3.0 - 2.0 * x) + left * x * y * y
            - right * x * x * y
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let x = 0.5 * (low + high);
        if value(x) < 0.0 {
            low = x;
        } else {
            high = x;
        }
    }
    0.5 * (low + high)
}
