//! Frequency and damping of a sensor from its free response after a tap or a step.
//!
//! ```text
//! y(t) = level + e^{-ζωt} (A cos ω_d t + B sin ω_d t),   ω_d = ω √(1 − ζ²)
//! ```
//!
//! A tap leaves the level as it was, a step moves it; both end in this swing. What the record holds is found from it: the rest at
//! its begin, where it ends, and the level to which the reading comes. After a step the swing begins at once, after a tap at the
//! largest reading, where that leaves too much at the next extreme. A second event ends the fit; steady lines, as of the mains, are
//! fitted beside the swing where they are seen in the second half, in which it is small.
//!
//! Level and amplitudes are solved for linearly inside a search over frequency and damping (variable projection); the covariance
//! allows for correlated residuals.
//!
//! Does not model: a force that lasts, two modes, a line whose frequency changes.
//! Source: Golub and Pereyra, SIAM J. Numer. Anal. 10 (1973) 413; Newey and West, Econometrica 55 (1987) 703 (both from memory).

use super::Sensor;
use super::line::{self, Line};
use super::swing::{Data, Fit, damping_of};
use problem::{note, note::Note};
use statistics::uncertain::Uncertain;
use std::f64::consts::TAU;

/// Frequency and damping as a free response shows them.
#[derive(Clone, Debug)]
pub struct FreeResponse {
    /// The sensor.
    pub sensor: Sensor,
    /// What is not trustworthy.
    pub notes: Vec<Note>,
}

/// A swing fitted to the values from a start on.
struct FittedSwing {
    start: usize,
    point: [f64; 2],
    fit: Fit,
    noise: f64,
    count: usize,
}

impl FittedSwing {
    fn of(reading: &[f64], interval: f64, start: usize) -> Result<FittedSwing, String> {
        let values = reading.get(start..).unwrap_or(&[]);
        let count = values.iter().filter(|v| v.is_finite()).count();
        if count < 32 {
            return Err(format!(
                "{count} values follow the tap; at least 32 are needed"
            ));
        }
        let data = Data { values, interval };
        let (point, noise) = data.search()?;
        let fit = fitted(&data, &point)?;
        Ok(FittedSwing {
            start,
            point,
            fit,
            noise,
            count,
        })
    }

    fn amplitude(&self) -> f64 {
        self.fit.linear[1].hypot(self.fit.linear[2])
    }

    fn left(&self) -> f64 {
        (self.fit.squares / self.count as f64).sqrt()
    }

    /// Whether more is left than noise.
    fn leaves_more(&self) -> bool {
        self.left() > 2.0 * self.noise && self.left() > 0.02 * self.amplitude()
    }
}

fn fitted(data: &Data, point: &[f64; 2]) -> Result<Fit, String> {
    data.fit(point[0].exp(), damping_of(point[1]))
        .ok_or_else(|| "the free response cannot be separated from its level".into())
}

/// Part of the swing that may be left where tap or step have no stated beginning.
const LEFT: f64 = 0.2;

/// Damping ratio from which on a sensor hardly swings: a load that is let down slowly looks like one.
const OVERDAMPED: f64 = 0.7;

/// How much less the swing from the next extreme must leave to be the better one.
const BETTER: f64 = 0.7;

/// Steady lines that are looked for.
const LINES: usize = 3;

/// Finds frequency and damping of a sensor from a reading after a tap or a step.
///
/// `interval` in s; `reading` in any unit, NaN where there is none. The fit begins at the index `start`, which must lie after
/// the end of the force; without it where the swing begins, after a rest that shows the level before. The error says what is
/// missing; where neither tap nor step is seen, that a start is needed.
pub fn identify_free_response(
    reading: &[f64],
    interval: f64,
    start: Option<usize>,
) -> Result<FreeResponse, String> {
    if !(interval > 0.0 && interval.is_finite()) {
        return Err("the interval of the tap's reading must be positive and finite".into());
    }
    let mut notes = Vec::new();
    let rest = rest_end(reading);
    let mut found = match start {
        Some(start) => FittedSwing::of(reading, interval, start)?,
        None => {
            let begin = begin(reading, rest);
            let first = FittedSwing::of(reading, interval, begin)?;
            let next = (first.leaves_more())
                .then(|| next_extreme(reading, begin))
                .flatten()
                .and_then(|next| FittedSwing::of(reading, interval, next).ok());
            match next {
                Some(next) if next.left() < BETTER * first.left() => next,
                _ => first,
            }
        }
    };
    // the record up to a second event
    let mut end = reading.len();
    let data = |end: usize| Data {
        values: &reading[found.start..end],
        interval,
    };
    let period = 1.0 / (found.point[0].exp() * interval);
    if let Some(event) = second_event(
        &data(end).residual(&found.point, &found.fit),
        period,
        found.amplitude(),
    ) {
        let until = found.start + event;
        if let Ok(shorter) = FittedSwing::of(&reading[..until], interval, found.start) {
            notes.push(note!(
                "a second tap or step follows {:.3} s after the first: the record from there on is not used",
                event as f64 * interval
            ));
            (found, end) = (shorter, until);
        }
    }
    let early = rest.filter(|_| start.is_none());
    if let Some(rest) = early.filter(|&rest| rest as f64 + 3.0 * period < found.start as f64) {
        notes.push(note!(
            "the reading leaves its rest {:.3} s before the swing that is used: more than one tap or step, or a rest that drifts",
            (found.start - rest) as f64 * interval
        ));
    }
    let raw = &reading[found.start..end];
    let mut clean = raw.to_vec();
    for line in take_lines_out(raw, &mut clean, interval, &mut found)? {
        notes.push(note!(
            "a steady line at {:.2} Hz, {:.1} % of the swing, was taken out: mains, perhaps",
            line.frequency,
            100.0 * line.amplitude() / found.amplitude()
        ));
    }
    let data = Data {
        values: &clean,
        interval,
    };
    let covariance = data
        .covariance(&found.point, &found.fit)
        .ok_or("the free response does not determine frequency and damping")?;
    let (frequency, damping) = (found.point[0].exp(), damping_of(found.point[1]));
    let slope = damping * (1.0 - damping);
    let (amplitude, residual) = (found.amplitude(), found.left());
    let level = found.fit.linear[0];
    let bent = data.drift(frequency, damping);
    if start.is_none() {
        let highest = (clean.iter().filter(|v| v.is_finite()))
            .fold(0.0_f64, |top, v| top.max((v - level).abs()));
        let uneven = residual > LEFT * amplitude && residual > 2.0 * found.noise && bent.is_none();
        if uneven || amplitude > 3.0 * highest || damping > OVERDAMPED {
            return Err(format!(
                "neither a tap nor a step fits the reading: a swing of {frequency:.2} Hz, damped by {damping:.2}, leaves {:.0} % of itself; the time at which its force had ended is needed",
                100.0 * residual / amplitude
            ));
        }
    }
    notes.extend(weak(&found, clean.len() as f64 * interval));
    notes.extend(bent);
    Ok(FreeResponse {
        sensor: Sensor {
            frequency: Uncertain::new(frequency, frequency * covariance[0].sqrt()),
            damping_ratio: Uncertain::new(damping, slope * covariance[1].sqrt()),
        },
        notes,
    })
}

/// What a swing that was found is too weak for.
fn weak(found: &FittedSwing, length: f64) -> Vec<Note> {
    let (frequency, damping) = (found.point[0].exp(), damping_of(found.point[1]));
    let share = 100.0 * found.left() / found.amplitude();
    let mut notes = Vec::new();
    if share > 20.0 {
        notes.push(note!(
            "the swing is hardly above what is left, which is {:.0} % of it",
            share
        ));
    }
    if frequency * length < 3.0 {
        notes.push(note!(
            "the record holds {:.1} periods of the sensor; damping needs more",
            frequency * length
        ));
    }
    if length * TAU * frequency * damping < 1.0 {
        notes.push(note!(
            "the swing has not died within the record: level and damping are weak"
        ));
    }
    if damping > OVERDAMPED {
        notes.push(note!(
            "a sensor damped by {:.2} hardly swings: frequency and damping cannot be separated well",
            damping
        ));
    }
    if found.leaves_more() {
        notes.push(note!(
            "the model leaves {:.1} times the noise: a second mode, or a force that had not ended",
            found.left() / found.noise
        ));
    }
    notes
}

/// Fits steady lines and the swing in turns; the values without the lines are left in `clean`.
fn take_lines_out(
    raw: &[f64],
    clean: &mut Vec<f64>,
    interval: f64,
    found: &mut FittedSwing,
) -> Result<Vec<Line>, String> {
    let mut lines: Vec<Line> = Vec::new();
    while lines.len() < LINES {
        let data = Data {
            values: clean.as_slice(),
            interval,
        };
        let residual = data.residual(&found.point, &found.fit);
        let own = (found.point[0].exp(), damping_of(found.point[1]));
        let Some(line) = line::strongest(&residual, interval, own) else {
            break;
        };
        lines.push(line);
        // The swing holds a little of the lines, and they of it.
        for _ in 0..3 {
            let data = Data {
                values: clean.as_slice(),
                interval,
            };
            let mut swingless = data.residual(&found.point, &found.fit);
            for (value, (raw, clean)) in swingless.iter_mut().zip(raw.iter().zip(clean.iter())) {
                *value += raw - clean;
            }
            line::fit(&mut lines, &swingless, interval);
            for (k, (value, raw)) in clean.iter_mut().zip(raw).enumerate() {
                let sum: f64 = lines.iter().map(|line| line.at(k as f64 * interval)).sum();
                *value = raw - sum;
            }
            let data = Data {
                values: clean.as_slice(),
                interval,
            };
            found.point = data.refined(found.point);
            found.fit = fitted(&data, &found.point)?;
        }
    }
    Ok(lines)
}

/// Where a rest at the begin of a record ends; none where the record does not begin with one that it leaves.
fn rest_end(reading: &[f64]) -> Option<usize> {
    let first = reading.get(..(reading.len() / 50).max(16))?;
    let seen: Vec<f64> = first.iter().copied().filter(|v| v.is_finite()).collect();
    if seen.len() < 8 {
        return None;
    }
    let count = seen.len() as f64;
    let mean = seen.iter().sum::<f64>() / count;
    let spread = (seen.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt();
    let widest = seen
        .iter()
        .fold(0.0_f64, |top, v| top.max((v - mean).abs()));
    let whole = (reading.iter().filter(|v| v.is_finite()))
        .fold(0.0_f64, |top, v| top.max((v - mean).abs()));
    // beyond the noise, what of it was seen, and a step of a coarse converter
    let limit = (6.0 * spread).max(1.5 * widest).max(0.02 * whole);
    let far = |k: usize| (reading[k] - mean).abs() > limit;
    (first.len()..reading.len().saturating_sub(1)).find(|&k| far(k) && far(k + 1))
}

/// Where a swing begins: the reading furthest from the level to which it comes, after the rest. After a step that is where the
/// rest ends.
fn begin(reading: &[f64], rest: Option<usize>) -> usize {
    let after = rest.unwrap_or(0);
    let level = last_level(reading);
    furthest(reading, level, after..reading.len())
}

/// Mean of the last quarter of the values.
fn last_level(reading: &[f64]) -> f64 {
    let tail = &reading[reading.len() - reading.len() / 4..];
    let seen: Vec<f64> = tail.iter().copied().filter(|v| v.is_finite()).collect();
    if seen.is_empty() {
        0.0
    } else {
        seen.iter().sum::<f64>() / seen.len() as f64
    }
}

fn furthest(reading: &[f64], level: f64, range: std::ops::Range<usize>) -> usize {
    let far = |v: f64| {
        if v.is_finite() {
            (v - level).abs()
        } else {
            0.0
        }
    };
    let start = range.start;
    range
        .max_by(|&a, &b| far(reading[a]).total_cmp(&far(reading[b])))
        .unwrap_or(start)
}

/// The extreme on the other side of the level that follows a start.
fn next_extreme(reading: &[f64], start: usize) -> Option<usize> {
    let level = last_level(reading);
    let side = (reading[start] - level).signum();
    let other = |k: &usize| (reading[*k] - level) * side < 0.0;
    let crossing = (start..reading.len()).find(other)?;
    let back = (crossing..reading.len())
        .find(|k| (reading[*k] - level) * side > 0.0)
        .unwrap_or(reading.len());
    Some(furthest(reading, level, crossing..back))
}

/// Place at which the residual, quiet before, becomes loud: a second tap or step. `period` in values.
fn second_event(residual: &[f64], period: f64, amplitude: f64) -> Option<usize> {
    let block = (0.5 * period).max(8.0) as usize;
    let loud: Vec<f64> = residual
        .chunks_exact(block)
        .map(|part| {
            let seen = || part.iter().filter(|v| v.is_finite());
            (seen().map(|v| v * v).sum::<f64>() / (seen().count() as f64).max(1.0)).sqrt()
        })
        .collect();
    let usual = crate::quantile::median(loud.iter().copied());
    let quiet = loud.iter().position(|l| *l < 2.5 * usual)?;
    let event =
        (quiet..loud.len()).find(|&k| loud[k] > 6.0 * usual && loud[k] > 0.1 * amplitude)?;
    // it may have begun in the block before
    Some((event.saturating_sub(1)) * block)
}
