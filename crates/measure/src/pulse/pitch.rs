//! Errors of the wheel, from its own pulses.

use crate::quantile::median;
use statistics::normal::MEDIAN_OF_SIZE;
use std::f64::consts::TAU;

use super::{Pulses, Refusal};

/// Angular errors of the marks of a wheel.
#[derive(Clone, Debug, PartialEq)]
pub struct Pitch {
    /// By how much each position is ahead of its place on an even wheel, rad; sum zero; index as [`Pulses::position`].
    pub errors: Vec<f64>,
    /// Times each position was seen in the revolutions used; zero for a left-out mark.
    pub seen: Vec<usize>,
    /// Variance of one sight of one mark, rad²: scatter from revolution to revolution.
    pub variance: f64,
    /// Mean speed of the revolutions used, rad/s.
    pub speed: f64,
    /// Position that differs most from the others, where it differs by more than five standard deviations of them.
    pub odd: Option<usize>,
}

impl Pitch {
    /// Covariance of the errors of two positions, rad²: independent scatter of every sight, and the sum held at zero.
    ///
    /// Infinite for a position that was never seen.
    pub fn covariance(&self, a: usize, b: usize) -> f64 {
        if [a, b]
            .iter()
            .any(|&k| self.seen.get(k).is_none_or(|&n| n == 0))
        {
            return f64::INFINITY;
        }
        let own = |k: usize| self.variance / self.seen[k] as f64;
        let (mut count, mut total) = (0.0, 0.0);
        for &n in self.seen.iter().filter(|&&n| n > 0) {
            count += 1.0;
            total += self.variance / n as f64;
        }
        let same = if a == b { own(a) } else { 0.0 };
        same - (own(a) + own(b)) / count + total / (count * count)
    }
}

/// Largest relative change of the time of a revolution, from one to the next, in which marks are calibrated.
const EVEN: f64 = 0.03;

/// Angular errors of the marks from revolutions at steady or evenly changing speed.
///
/// Every pulse that has one revolution before and one after it is compared with the mean of the revolution around it: the
/// mean holds every mark once, so the errors cancel in it; the same mark one revolution earlier and later gives speed and
/// acceleration free of mark errors. What repeats with the revolution is taken for an error of the wheel.
///
/// Formula:
/// ```text
/// p_j = mean over sights i of mark j of  Ω_i (t_i - t̂_i),   t̂_i = mean_k∈rev(t_k) - b (k̄ - i) - c mean((k - i)²)
/// b = (t_{i+N} - t_{i-N}) / 2N,   c = (t_{i+N} - 2 t_i + t_{i-N}) / 2N²,   Ω_i = 2π / (N b)
/// ```
/// `t`: time of a pulse, s; `N`: positions per revolution; result in rad.
///
/// Source: derived here.
///
/// Valid: change of speed over two revolutions well described by one acceleration; refused where no revolution changes by
/// less than 3 %.
pub fn calibrate(pulses: &Pulses) -> Result<Pitch, Refusal> {
    let n = pulses.positions;
    // Beyond a gap that is not surely counted the marks are others.
    let joined = pulses.joined();
    let marks = &pulses.marks[joined.clone()];
    let (first, last) = match (marks.first(), marks.last()) {
        (Some(&first), Some(&last)) if last > first => (first, last),
        _ => return Err(too_short(0.0)),
    };
    let span = (last - first) as usize + 1;
    if n < 2 || span < 2 * n + 1 || span > 64 * joined.len() + 1024 {
        return Err(too_short(span as f64 / n.max(1) as f64));
    }
    let times = &pulses.times[joined.clone()];
    let origin = times[0];
    let mut time = vec![f64::NAN; span];
    let mut stated = vec![0.0; span];
    let uncertainties = &pulses.uncertainties[joined];
    for ((&mark, &t), &u) in marks.iter().zip(times).zip(uncertainties) {
        time[(mark - first) as usize] = t - origin;
        stated[(mark - first) as usize] = u;
    }
    // Sums over the pulses that are there: of one, of the index, of its square, of the time.
    let mut sums = vec![[0.0; 4]; span + 1];
    for (k, &t) in time.iter().enumerate() {
        let x = k as f64;
        let here = if t.is_finite() {
            [1.0, x, x * x, t]
        } else {
            [0.0; 4]
        };
        sums[k + 1] = std::array::from_fn(|s| sums[k][s] + here[s]);
    }
    // A window with a pulse missing or too many does not hold every mark once.
    let full = marks
        .iter()
        .map(|m| m.rem_euclid(n as i64))
        .collect::<std::collections::BTreeSet<_>>()
        .len();
    let place = |k: usize| (k as i64 + first).rem_euclid(n as i64) as usize;
    let mut sights: Vec<Sight> = Vec::new();
    for i in n..span - n {
        let (before, here, after) = (time[i - n], time[i], time[i + n]);
        let bend = (after - here) / (here - before);
        if !(bend.is_finite() && (bend - 1.0).abs() < EVEN) {
            continue;
        }
        let from = i - n / 2;
        let sum: [f64; 4] = std::array::from_fn(|s| sums[from + n][s] - sums[from][s]);
        let count = sum[0];
        if (count - full as f64).abs() > 0.5 {
            continue;
        }
        let x = i as f64;
        let b = (after - before) / (2 * n) as f64;
        let c = (after - 2.0 * here + before) / (2.0 * (n as f64).powi(2));
        let offset = sum[1] / count - x;
        let square = sum[2] / count - 2.0 * x * sum[1] / count + x * x;
        let smooth = sum[3] / count - b * offset - c * square;
        let speed = TAU / (n as f64 * b);
        sights.push(Sight {
            place: place(i),
            value: speed * (here - smooth),
            stated: speed * stated[i],
            speed,
        });
    }
    if sights.is_empty() {
        return Err(too_short(span as f64 / n as f64));
    }
    let (errors, seen) = without_outliers(&mut sights, n);
    let mut errors = errors;
    let present = seen.iter().filter(|&&s| s > 0).count();
    if present < full {
        return Err(too_short(1.0 + sights.len() as f64 / full as f64));
    }
    let mean = errors.iter().sum::<f64>() / present as f64;
    for (error, &count) in errors.iter_mut().zip(&seen) {
        *error = if count > 0 { *error - mean } else { 0.0 };
    }
    let freedom = sights.len().saturating_sub(present);
    let stated = sights.iter().map(|s| s.stated * s.stated).sum::<f64>() / sights.len() as f64;
    let variance = if freedom >= present {
        sights
            .iter()
            .map(|s| (s.value - mean - errors[s.place]).powi(2))
            .sum::<f64>()
            / freedom as f64
    } else {
        // Too few revolutions for a scatter: what the edges state.
        stated
    };
    let speed = sights.iter().map(|s| s.speed).sum::<f64>() / sights.len() as f64;
    Ok(Pitch {
        odd: odd(&errors, &seen),
        errors,
        seen,
        variance,
        speed,
    })
}

/// One mark seen once.
struct Sight {
    place: usize,
    /// Angle ahead of an even wheel, rad.
    value: f64,
    /// Its stated uncertainty, rad.
    stated: f64,
    /// Speed, rad/s.
    speed: f64,
}

/// Mean error and number of sights of each place, without sights far from the median of their place: there the speed did
/// not change evenly.
fn without_outliers(sights: &mut Vec<Sight>, places: usize) -> (Vec<f64>, Vec<usize>) {
    let mut values = vec![Vec::new(); places];
    for sight in sights.iter() {
        values[sight.place].push(sight.value);
    }
    let medians: Vec<f64> = values.iter().map(|v| median(v.iter().copied())).collect();
    let away = sights.iter().map(|s| (s.value - medians[s.place]).abs());
    let usual = median(away) / MEDIAN_OF_SIZE;
    if values
        .iter()
        .filter(|v| !v.is_empty())
        .all(|v| v.len() >= 4)
    {
        sights.retain(|s| (s.value - medians[s.place]).abs() <= 4.0 * usual + 2.0 * s.stated);
    }
    let (mut errors, mut seen) = (vec![0.0; places], vec![0usize; places]);
    for sight in sights.iter() {
        errors[sight.place] += sight.value;
        seen[sight.place] += 1;
    }
    for (error, &count) in errors.iter_mut().zip(&seen) {
        *error /= count.max(1) as f64;
    }
    (errors, seen)
}

fn too_short(revolutions: f64) -> Refusal {
    Refusal::new(
        format!("{revolutions:.1} revolutions, of which too few at a speed that changes evenly"),
        "three revolutions or more that change by less than 3 % each, to calibrate the marks",
    )
}

/// The position whose error stands out.
fn odd(errors: &[f64], seen: &[usize]) -> Option<usize> {
    let sizes: Vec<f64> = errors
        .iter()
        .zip(seen)
        .filter(|(_, s)| **s > 0)
        .map(|(e, _)| e.abs())
        .collect();
    if sizes.len() < 8 {
        return None;
    }
    let usual = median(sizes) / MEDIAN_OF_SIZE;
    let (at, error) = errors
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    (error.abs() > 5.0 * usual).then_some(at)
}
