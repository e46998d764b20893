//! How many marks a wheel has, as its own errors tell it.
//!
//! ```text
//! intervals ─▶ pattern: each against its two neighbours ─▶ without what sampling makes ─▶ correlation over the lag
//! ```
//! Where the rate of pulses is nearly in step with the sampling, the errors of the instants repeat too, after another number
//! of pulses than the wheel's. They are a function of the place of the instant between two samples; this part is found by
//! least squares and taken out. What is left of it repeats after numbers of pulses that take a whole number of samples: such
//! numbers alone prove nothing, so that at some speeds nothing is told.

use super::{Pulses, Refusal, median};

/// Harmonics of the place between two samples that are taken out.
const HARMONICS: usize = 4;
/// Fewest values of the pattern from which they are found.
const FEWEST: usize = 60;

/// After how many pulses the pattern of intervals repeats: the positions per revolution as the wheel itself tells them.
///
/// Intervals are compared with their two neighbours, so that speed and acceleration drop out; the shortest lag whose
/// correlation is as large as the largest one, within its scatter, is the period. None where the pattern does not stand out of
/// the noise of the instants and of sampling, or where fewer than three periods were seen.
pub fn period(pulses: &Pulses) -> Option<usize> {
    correlated(pulses)?.period()
}

/// Correlation of the pattern over the lag.
struct Correlated {
    values: Vec<f64>,
    count: usize,
    /// Whether so many pulses take a whole number of samples: what repeats then may be the sampling.
    in_step: Vec<bool>,
}

impl Correlated {
    /// Standard deviation of a correlation by chance, at a lag.
    fn scatter(&self, lag: usize) -> f64 {
        // Second differences make neighbouring values dependent: about half as many count.
        (2.0 / (self.count - lag.min(self.count - 1)) as f64).sqrt()
    }

    /// Lags that tell of the wheel and not of the sampling.
    fn telling(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let all = self.values.iter().copied().enumerate().skip(1);
        all.filter(|&(lag, _)| !self.in_step[lag])
    }

    fn period(&self) -> Option<usize> {
        // Where one pulse takes a whole number of samples all lags are in step, but for a drift; at other speeds two of three tell.
        if 2 * self.telling().count() < self.values.len() {
            return None;
        }
        let (at, top) = self.telling().max_by(|a, b| a.1.total_cmp(&b.1))?;
        if top < 0.3f64.max(5.0 * self.scatter(at)) {
            return None;
        }
        // What the wheel does not explain is left to chance.
        let open = (1.0 - top * top).max(0.05).sqrt();
        let near = |lag: usize, value: f64| {
            value >= top - (0.02 + 4.0 * open * self.scatter(lag)).min(0.2 * top)
        };
        let (whole, _) = self.telling().find(|&(lag, value)| near(lag, value))?;
        // The wheel's own period may be in step itself, or weaker by what sampling adds: then all its multiples stand out.
        (1..=whole).find(|&lag| whole.is_multiple_of(lag) && self.stands_out(lag, top))
    }

    /// Whether all multiples of a lag that tell are nearly as large as the largest; a wheel with two like halves has half.
    fn stands_out(&self, lag: usize, top: f64) -> bool {
        let mut multiples = self
            .telling()
            .filter(|(other, _)| other.is_multiple_of(lag))
            .peekable();
        multiples.peek().is_some()
            && multiples.all(|(other, value)| {
                value >= (0.7 * top).max(5.0 * self.scatter(other)).min(0.8 * top)
            })
    }

    fn top(&self) -> f64 {
        self.telling().map(|(_, value)| value).fold(0.0, f64::max)
    }
}

/// How much larger the correlation of another number of marks than the stated one must be.
const CLEARLY: f64 = 0.25;

/// Root mean square distance of so many pulses from a whole number of samples, below which they are in step with it; 0.29 where
/// they have nothing to do with each other.
const IN_STEP: f64 = 0.15;

/// The same from half a sample: samples that are either low or high repeat there too.
const HALF_STEP: f64 = 0.05;

/// Pulses over which their times are averaged, so that the errors of the marks drop out.
const BLOCK: usize = 100;

/// Whether a number of pulses takes a whole number of samples, over a record.
fn in_step(times: &[f64], lag: usize, interval: f64) -> bool {
    let count = times.len() - lag;
    let block = BLOCK.min(count);
    let (mut sum, mut half, mut blocks) = (0.0, 0.0, 0.0);
    for start in (0..=count - block).step_by(block.max(1)) {
        let ends = |from: usize| times[from..from + block].iter();
        let whole: f64 = ends(start).zip(ends(start + lag)).map(|(a, b)| b - a).sum();
        let samples = whole / block as f64 / interval;
        let away = samples - samples.round();
        sum += away * away;
        half += (0.5 - away.abs()).powi(2);
        blocks += 1.0;
    }
    sum < IN_STEP * IN_STEP * blocks || half < HALF_STEP * HALF_STEP * blocks
}

fn correlated(pulses: &Pulses) -> Option<Correlated> {
    const WINDOW: usize = 8192;
    const LARGEST: usize = 1024;
    // The last stretch without repairs: a spin-up ends, a coast-down begins at speed; the longer one of both ends.
    let regular = |k: usize| pulses.marks[k + 1] - pulses.marks[k] == 1;
    let mut best = 0..0;
    let mut start = 0;
    for k in 0..pulses.marks.len() {
        if k + 1 == pulses.marks.len() || !regular(k) {
            if k + 1 - start > best.len() {
                best = start..k + 1;
            }
            start = k + 1;
        }
    }
    let from = best.end.saturating_sub(WINDOW).max(best.start);
    let times = &pulses.times[from..best.end];
    let gaps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if gaps.len() < 12 {
        return None;
    }
    let mut pattern: Vec<f64> = gaps
        .windows(3)
        .map(|g| g[1].ln() - 0.5 * (g[0].ln() + g[2].ln()))
        .collect();
    // Slow starts bend the logarithm: such values are cut, or they would outweigh all others.
    let mut sizes: Vec<f64> = pattern.iter().map(|x| x.abs()).collect();
    let cut = 6.0 * median(&mut sizes);
    pattern.iter_mut().for_each(|x| *x = x.clamp(-cut, cut));
    if let Some(interval) = pulses.sample_interval
        && pattern.len() >= FEWEST
    {
        without_sampling(&mut pattern, times, &gaps, pulses.watched.0, interval);
    }
    let power = pattern.iter().map(|x| x * x).sum::<f64>();
    // The second difference of independent instants with variance u² has the variance 5 u² in three intervals.
    let noise: f64 = gaps
        .iter()
        .skip(1)
        .zip(&pulses.uncertainties[from + 1..])
        .take(pattern.len())
        .map(|(gap, u)| 5.0 * (u / gap).powi(2))
        .sum();
    if power.is_nan() || power <= 2.0 * noise {
        return None;
    }
    let largest = LARGEST.min(pattern.len() / 2);
    let values = (0..=largest)
        .map(|lag| {
            let product: f64 = pattern
                .iter()
                .zip(&pattern[lag..])
                .map(|(a, b)| a * b)
                .sum();
            product / power * pattern.len() as f64 / (pattern.len() - lag) as f64
        })
        .collect();
    let in_step = |lag| {
        pulses
            .sample_interval
            .is_some_and(|interval| in_step(times, lag, interval))
    };
    Some(Correlated {
        values,
        count: pattern.len(),
        in_step: (0..=largest).map(in_step).collect(),
    })
}

/// Takes out of a pattern what errors of the instants make that depend on their place between two samples.
///
/// The pattern is `(e₀ - 3 e₁ + 3 e₂ - e₃)/(2 gap)` of the errors e of four instants; e is a sum of harmonics of the place.
fn without_sampling(pattern: &mut [f64], times: &[f64], gaps: &[f64], first: f64, interval: f64) {
    const SIZE: usize = 2 * HARMONICS;
    let waves: Vec<[f64; SIZE]> = times
        .iter()
        .map(|t| {
            let turn = std::f64::consts::TAU * ((t - first) / interval).fract();
            std::array::from_fn(|i| {
                let (sine, cosine) = ((i / 2 + 1) as f64 * turn).sin_cos();
                if i % 2 == 0 { cosine } else { sine }
            })
        })
        .collect();
    let row = |k: usize| -> [f64; SIZE] {
        std::array::from_fn(|i| {
            let e = |j: usize| waves[k + j][i];
            (e(0) - 3.0 * e(1) + 3.0 * e(2) - e(3)) * 0.5 * interval / gaps[k + 1]
        })
    };
    let (mut square, mut right) = ([[0.0; SIZE]; SIZE], [0.0; SIZE]);
    for (k, value) in pattern.iter().enumerate() {
        let row = row(k);
        for i in 0..SIZE {
            right[i] += row[i] * value;
            for j in 0..SIZE {
                square[i][j] += row[i] * row[j];
            }
        }
    }
    let size: f64 = (0..SIZE).map(|i| square[i][i]).sum::<f64>() / SIZE as f64;
    (0..SIZE).for_each(|i| square[i][i] += 1e-6 * size + f64::MIN_POSITIVE);
    let Some(amounts) = solved(square, right) else {
        return;
    };
    for (k, value) in pattern.iter_mut().enumerate() {
        *value -= row(k).iter().zip(&amounts).map(|(w, a)| w * a).sum::<f64>();
    }
}

/// Solution of a positive definite system, by elimination.
#[allow(clippy::needless_range_loop)] // two rows at a time
fn solved<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N]) -> Option<[f64; N]> {
    for p in 0..N {
        if a[p][p] <= 0.0 || !a[p][p].is_finite() {
            return None;
        }
        for i in p + 1..N {
            let factor = a[i][p] / a[p][p];
            for j in p..N {
                a[i][j] -= factor * a[p][j];
            }
            b[i] -= factor * b[p];
        }
    }
    for p in (0..N).rev() {
        let known: f64 = (p + 1..N).map(|j| a[p][j] * b[j]).sum();
        b[p] = (b[p] - known) / a[p][p];
    }
    Some(b)
}

/// Correlation from which on a wheel shows a number of marks.
const SHOWN: f64 = 0.2;

/// Compares the marks per revolution that were stated with those that the wheel itself shows, where it does.
///
/// Refused only where another number explains the pattern clearly better than the stated one: marks whose errors are alike
/// over some of them, and speeds in step with the sampling, are no contradiction. Not told either where errors are lost in the
/// instants: of a wheel whose marks are off by 1 % of the pitch, with less than some 15 samples a mark. A wheel whose pattern repeats within the
/// revolution (two equal halves) agrees with the whole.
pub fn check_marks(pulses: &Pulses) -> Result<(), Refusal> {
    let agreed = correlated(pulses).and_then(|seen| {
        let found = seen.period()?;
        let stated = seen.values.get(pulses.positions);
        let better = match stated {
            Some(stated) => seen.values[found] - stated > CLEARLY,
            // The record is too short to see the stated number twice.
            None => true,
        };
        // sampling in step may favour a multiple of a number that the wheel shows by itself, at every multiple alike
        let shown = |turns: usize| {
            let value = seen.values.get(turns * pulses.positions);
            value.is_some_and(|value| *value > SHOWN)
        };
        let multiple = found % pulses.positions == 0 && (1..found / pulses.positions).all(shown);
        let agrees =
            found == pulses.positions || multiple || seen.stands_out(pulses.positions, seen.top());
        (!agrees && better).then_some(found)
    });
    match agreed {
        Some(found) => Err(Refusal::new(
            format!(
                "the pattern of intervals repeats after {found} pulses, {} per revolution are stated",
                pulses.positions
            ),
            "the number of marks of this wheel; both flanks of a pulse count as two",
        )),
        None => Ok(()),
    }
}
