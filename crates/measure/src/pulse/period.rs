//! After how many pulses the errors of a wheel repeat, as its pulses show.
//!
//! ```text
//! intervals ─▶ pattern: each against its two neighbours ─▶ without what sampling makes ─▶ correlation over the lag ─▶ combs
//! ```
//! A wheel that repeats after P pulses repeats after 2P, 3P, … too. The evidence of P is that of all these lags together, its
//! comb, in which every pair of pulses counts once:
//!
//! ```text
//! n = Σₘ n(mP),   r = Σₘ n(mP) ρ(mP) / n          ρ: correlation of the pattern, n(L): pairs of pulses L apart
//! E(P) = -½ n ln(1 - r²)
//! ```
//! E is the logarithm of the likelihood ratio of P against no period, of pairs taken as independent normal ones. A divisor of
//! P has more lags of which fewer show anything, a multiple has fewer lags, so that E is largest at the wheel's own period.
//! Were there no wheel, z = r √n would be as large for one P as for another: its scatter over all P shows how much sampling and
//! noise make.
//!
//! Where the rate of pulses is nearly in step with the sampling, the errors of the instants repeat too, after another number
//! of pulses than the wheel's. They are a function of the place of the instant between two samples; this part is found by
//! least squares and taken out. What is left of it repeats after numbers of pulses that take a whole number of samples: such
//! lags alone prove nothing and are left out of all combs, so that at some speeds nothing is reported.

use super::Pulses;
use crate::quantile::median;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;
use statistics::linear::solved;
use statistics::normal::MEDIAN_OF_SIZE;
use std::f64::consts::TAU;

/// Harmonics of the place between two samples that are taken out.
const HARMONICS: usize = 12;
/// Fewest values of the pattern from which they are found.
const FEWEST: usize = 60;
/// Pulses that are looked at, at most.
const WINDOW: usize = 8192;
/// Largest period that is looked for.
const LARGEST: usize = 2048;
/// Pairs of pulses from which on a lag counts, as a part of all.
const FEWEST_PAIRS: f64 = 0.1;
/// Scatters of a comb from which on a period stands out: the largest of 2000 normal values exceeds 5 once in 2000 records; the
/// scatter itself is found from combs that are not quite independent.
const STANDS_OUT: f64 = 6.0;
/// Largest mean correlation: what pulses never reach is left out of the evidence.
const MOST: f64 = 0.9999;
/// Standard deviations of a difference of two mean correlations from which on they differ: 5 of a normal one come by chance
/// once in two million.
const DIFFER: f64 = 5.0;
/// Chance of a wheel of independent marks to look like one of equal parts, below which it is taken for such.
pub(super) const ALIKE: f64 = 1e-4;
/// Largest number of parts of a revolution that may look alike by chance.
const MOST_PARTS: usize = 12;
/// Part of the scatter that is left to chance where all is explained.
const OPEN: f64 = 0.01;
/// Standard deviations by which a mean correlation may be off, where a wheel is to be distinguished from one with fewer marks.
const SURE: f64 = 3.0;

/// After how many pulses the pattern of intervals repeats: the positions per revolution as the wheel itself shows them.
///
/// Intervals are compared with their two neighbours, so that speed and acceleration drop out. None where no period stands out
/// of the noise of the instants and of sampling, or where fewer than two and a half periods were seen.
pub fn period(pulses: &Pulses) -> Option<usize> {
    Correlated::of(pulses)?.period()
}

/// Correlation of the pattern over the lag.
pub(super) struct Correlated {
    values: Vec<f64>,
    /// Pairs at each lag; none where so many pulses are in step with the sampling: what repeats then may be the sampling.
    pairs: Vec<f64>,
    /// Scatter of combs by chance: that of what the best period leaves unexplained, at least that of white noise.
    scatter: f64,
    /// Number of values of the pattern.
    pub count: usize,
    /// Mean time between pulses, s.
    pub gap: f64,
}

/// Mean correlation over some lags.
#[derive(Clone, Copy)]
pub(super) struct Mean {
    pub value: f64,
    /// Its standard deviation.
    pub deviation: f64,
}

/// Whether one mean correlation is less than another beyond chance.
pub(super) fn less(one: Option<Mean>, other: Option<Mean>) -> bool {
    one.zip(other).is_some_and(|(one, other)| {
        other.value - one.value > DIFFER * one.deviation.hypot(other.deviation)
    })
}

impl Correlated {
    pub fn of(pulses: &Pulses) -> Option<Correlated> {
        let times = &pulses.times[longest_regular(pulses)];
        let gaps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        if gaps.len() < 12 {
            return None;
        }
        let mut pattern = pattern(pulses, times, &gaps);
        let count = pattern.len();
        let longest = count - (FEWEST_PAIRS * count as f64).ceil() as usize;
        let sampling = pulses.sample_interval.map(|s| Sampling::of(times, s));
        let pairs = |lag: usize| {
            let counts = lag > 0 && sampling.as_ref().is_none_or(|s| !s.in_step(lag));
            if counts { (count - lag) as f64 } else { 0.0 }
        };
        let mut seen = Correlated {
            values: correlations(&pattern, longest)?,
            pairs: (0..=longest).map(pairs).collect(),
            scatter: 1.0,
            count,
            gap: (times[times.len() - 1] - times[0]) / gaps.len() as f64,
        };
        let best = seen.best()?;
        without_period(&mut pattern, best);
        if let Some(values) = correlations(&pattern, longest) {
            let found = std::mem::replace(&mut seen.values, values);
            seen.scatter = seen.scatter_beside(best);
            seen.values = found;
        }
        Some(seen)
    }

    /// Sums over lags: of pairs times correlation, and of pairs.
    fn sums(&self, lags: impl Iterator<Item = usize>) -> (f64, f64) {
        lags.fold((0.0, 0.0), |(sum, pairs), lag| {
            (
                sum + self.pairs[lag] * self.values[lag],
                pairs + self.pairs[lag],
            )
        })
    }

    /// Multiples of a number that are lags.
    fn multiples(&self, of: usize) -> impl Iterator<Item = usize> + '_ {
        (of.max(1)..self.values.len()).step_by(of.max(1))
    }

    /// Largest period of which the record holds two and a half.
    fn largest(&self) -> usize {
        LARGEST.min(2 * self.count / 5).min(self.values.len() - 1)
    }

    /// The comb of a period, r √n; none where all its lags are in step with the sampling.
    fn comb(&self, period: usize) -> Option<f64> {
        let (sum, pairs) = self.sums(self.multiples(period));
        (pairs > 0.0).then(|| sum / pairs.sqrt())
    }

    /// Evidence of a period against none; negative where its pulses are unlike.
    fn evidence(&self, period: usize) -> Option<f64> {
        let (sum, pairs) = self.sums(self.multiples(period));
        let mean = (sum / pairs).clamp(-MOST, MOST);
        (pairs > 0.0).then(|| -0.5 * pairs * (-mean * mean).ln_1p() * mean.signum())
    }

    /// Scatter of the combs that have nothing to do with a period.
    fn scatter_beside(&self, period: usize) -> f64 {
        let others = (3..=self.largest()).filter(|&other| common(other, period) == 1);
        (median(others.filter_map(|p| self.comb(p)).map(f64::abs)) / MEDIAN_OF_SIZE).max(1.0)
    }

    /// Mean correlation over the multiples of a number that are none of another; none where no lag counts.
    ///
    /// What the wheel explains is not left to chance: its part of the scatter is less by 1 - r².
    pub fn mean(&self, multiples_of: usize, none_of: Option<usize>) -> Option<Mean> {
        let left = |lag: &usize| none_of.is_none_or(|other| !lag.is_multiple_of(other));
        let (sum, pairs) = self.sums(self.multiples(multiples_of).filter(left));
        let value = sum / pairs;
        (pairs > 0.0).then(|| Mean {
            value,
            deviation: self.scatter * ((1.0 - value * value).max(OPEN) / pairs).sqrt(),
        })
    }

    /// Whether a period stands out of chance and of sampling.
    ///
    /// A wheel repeats at every multiple alike: where one lag is far above most of them, it counts as chance allows. What
    /// repeats more than twice as well with the sampling is the sampling's.
    pub fn stands_out(&self, period: usize) -> bool {
        let lags: Vec<usize> = self
            .multiples(period)
            .filter(|&lag| self.pairs[lag] > 0.0)
            .collect();
        if lags.len() < 2 {
            return false;
        }
        let mut values: Vec<f64> = lags.iter().map(|&lag| self.values[lag]).collect();
        values.sort_by(f64::total_cmp);
        let middle = values[(values.len() - 1) / 2];
        let most = |lag: usize| middle + SURE * self.scatter / self.pairs[lag].sqrt();
        let sum: f64 = lags
            .iter()
            .map(|&lag| self.pairs[lag] * self.values[lag].min(most(lag)))
            .sum();
        let pairs: f64 = lags.iter().map(|&lag| self.pairs[lag]).sum();
        let in_step = |of: usize| {
            let lags = self.multiples(of).filter(|&lag| self.in_step(lag));
            let squares: Vec<f64> = lags.map(|lag| self.values[lag].powi(2)).collect();
            (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
        };
        let sampling = in_step(1).max(in_step(period));
        sum >= STANDS_OUT * self.scatter * pairs.sqrt() && 2.0 * sum / pairs >= sampling
    }

    /// The period with the most evidence; 2 where only every other pulse is alike.
    fn best(&self) -> Option<usize> {
        let all = (2..=self.largest()).filter_map(|period| Some((period, self.evidence(period)?)));
        Some(all.max_by(|a, b| a.1.total_cmp(&b.1))?.0)
    }

    /// The period that stands out most, or a multiple that explains more than its parts do, or an equal part of it.
    ///
    /// Of a dozen marks some are alike by chance, so that a part of the revolution has more evidence than the whole. Errors of
    /// marks and of sampling together repeat where both do: a multiple in step with the sampling is not taken.
    pub fn period(&self) -> Option<usize> {
        let mut period = self
            .best()
            .filter(|&best| best > 2 && self.stands_out(best))?;
        let largest = self.largest();
        while let Some(whole) = (2..=MOST_PARTS)
            .map(|parts| parts * period)
            .take_while(|&whole| whole <= largest)
            .filter(|&whole| self.pairs[whole] > 0.0)
            .find(|&whole| less(self.mean(period, Some(whole)), self.mean(whole, None)))
        {
            period = whole;
        }
        let equal = |part: &usize| {
            let chance = self.chance_of_parts(*part, period);
            chance.is_some_and(|chance| chance < ALIKE)
        };
        (3..period).find(equal).or(Some(period))
    }

    /// Whether so many pulses take a whole number of samples.
    pub fn in_step(&self, lag: usize) -> bool {
        self.pairs.get(lag).is_some_and(|&pairs| pairs == 0.0)
    }

    /// Independent values that a pattern holds within its period: that many whose correlations have the same sum of squares.
    ///
    /// Differences of instants make neighbours alike; a sine, as a ripple of the speed makes it, holds two whatever the period.
    pub fn independent(&self, period: usize) -> f64 {
        let Some(whole) = self.mean(period, None) else {
            return 0.0;
        };
        let at = |lag: usize| {
            let (sum, pairs) = self.sums((lag..self.values.len()).step_by(period));
            match pairs > 0.0 {
                true => (sum / pairs).powi(2) - self.scatter * self.scatter / pairs,
                false => 0.0,
            }
        };
        let alike = (1..period).map(at).sum::<f64>() / (whole.value * whole.value);
        period as f64 / (1.0 + alike).max(1.0)
    }

    /// Chance that a wheel of independent marks looks as if it repeated after a part of a revolution: of a correlation r of f
    /// pairs of normal values, `(1 - r²)^(f/2)`.
    pub fn chance_of_parts(&self, part: usize, whole: usize) -> Option<f64> {
        if !whole.is_multiple_of(part) {
            return None;
        }
        let full = self.mean(whole, None)?;
        let parts = self.mean(part, Some(whole))?;
        let ratio = (parts.value - SURE * parts.deviation) / (full.value + SURE * full.deviation);
        let pairs = self.independent(part) * (whole / part - 1) as f64;
        Some((1.0 - ratio.clamp(0.0, 1.0).powi(2)).powf(0.5 * pairs))
    }
}

/// Correlations of values over the lag, from 0 to the longest; none where there is nothing.
fn correlations(values: &[f64], longest: usize) -> Option<Vec<f64>> {
    let size = (2 * values.len()).next_power_of_two();
    let mut line: Vec<Complex<f64>> = values.iter().map(|&x| Complex::new(x, 0.0)).collect();
    line.resize(size, Complex::default());
    let mut planner = FftPlanner::new();
    planner.plan_fft_forward(size).process(&mut line);
    line.iter_mut()
        .for_each(|x| *x = Complex::new(x.norm_sqr(), 0.0));
    planner.plan_fft_inverse(size).process(&mut line);
    let power = line[0].re;
    if power.is_nan() || power <= 0.0 {
        return None;
    }
    let count = values.len() as f64;
    let at = |lag: usize| line[lag].re / power * count / (count - lag as f64);
    Some((0..=longest).map(at).collect())
}

/// Takes the mean of every place out of values that repeat after a period.
fn without_period(values: &mut [f64], period: usize) {
    for place in 0..period.min(values.len()) {
        let places = || (place..values.len()).step_by(period);
        let mean = places().map(|k| values[k]).sum::<f64>() / places().count() as f64;
        (place..values.len())
            .step_by(period)
            .for_each(|k| values[k] -= mean);
    }
}

/// Largest common divisor.
fn common(a: usize, b: usize) -> usize {
    if b == 0 { a } else { common(b, a % b) }
}

/// The last stretch without repairs: a spin-up ends, a coast-down begins at speed; the longest one.
fn longest_regular(pulses: &Pulses) -> std::ops::Range<usize> {
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
    best.end.saturating_sub(WINDOW).max(best.start)..best.end
}

/// Each interval against its two neighbours, without what sampling makes, and without what two flanks differ by.
fn pattern(pulses: &Pulses, times: &[f64], gaps: &[f64]) -> Vec<f64> {
    let mut pattern: Vec<f64> = gaps
        .windows(3)
        .map(|g| g[1].ln() - 0.5 * (g[0].ln() + g[2].ln()))
        .collect();
    // Where both flanks are used every other interval is longer, by the duty; a pattern that repeats after two shows no marks.
    for parity in 0..2 {
        let places = || (parity..pattern.len()).step_by(2);
        let mean = places().map(|k| pattern[k]).sum::<f64>() / places().count().max(1) as f64;
        (parity..pattern.len())
            .step_by(2)
            .for_each(|k| pattern[k] -= mean);
    }
    // Slow starts bend the logarithm: such values are cut, or they would outweigh all others.
    let cut = 6.0 * median(pattern.iter().map(|x| x.abs()));
    pattern.iter_mut().for_each(|x| *x = x.clamp(-cut, cut));
    if let Some(interval) = pulses.sample_interval
        && pattern.len() >= FEWEST
    {
        without_sampling(&mut pattern, times, gaps, pulses.watched.0, interval);
    }
    pattern
}

/// Root mean square distance of so many pulses from a whole number of samples, below which they are in step with it; 0.29 where
/// they have nothing to do with each other.
const IN_STEP: f64 = 0.15;

/// Distance below which a stretch of a record is in step, and the share of such stretches from which on the record is: a hold
/// before a coast-down is a part of it. By chance a fifth of them are, and of 32 hardly ever more than two fifths.
const NEAR: f64 = 0.1;
const MOSTLY: f64 = 0.4;

/// The same from half a sample: samples that are either low or high repeat there too.
const HALF_STEP: f64 = 0.05;

/// Stretches of a record that show how pulses lie to the samples, at most.
const BLOCKS: usize = 32;

/// Pulses over which their times are averaged, so that the errors of the marks drop out.
const BLOCK: usize = 100;

/// Times of pulses in samples, summed up.
struct Sampling {
    /// Sum of the times before each pulse, samples.
    sums: Vec<f64>,
}

impl Sampling {
    fn of(times: &[f64], interval: f64) -> Sampling {
        let mut sums = vec![0.0];
        let mut sum = 0.0;
        for time in times {
            sum += (time - times[0]) / interval;
            sums.push(sum);
        }
        Sampling { sums }
    }

    /// Whether a number of pulses takes a whole number of samples, over a record.
    fn in_step(&self, lag: usize) -> bool {
        let count = self.sums.len() - 1 - lag;
        let block = BLOCK.min(count);
        let (mut sum, mut half, mut near, mut blocks) = (0.0, 0.0, 0.0, 0.0);
        for start in (0..=count - block).step_by(block.max(count / BLOCKS).max(1)) {
            let whole = |from: usize| self.sums[from + block] - self.sums[from];
            let samples = (whole(start + lag) - whole(start)) / block as f64;
            let away = samples - samples.round();
            sum += away * away;
            half += (0.5 - away.abs()).powi(2);
            near += f64::from(u8::from(away.abs() < NEAR));
            blocks += 1.0;
        }
        sum < IN_STEP * IN_STEP * blocks
            || half < HALF_STEP * HALF_STEP * blocks
            || near > MOSTLY * blocks
    }
}

/// Takes out of a pattern what errors of the instants make that depend on their place between two samples.
///
/// The pattern is `(e₀ - 3 e₁ + 3 e₂ - e₃)/(2 gap)` of the errors e of four instants; e is a sum of harmonics of the place.
fn without_sampling(pattern: &mut [f64], times: &[f64], gaps: &[f64], first: f64, interval: f64) {
    const SIZE: usize = 2 * HARMONICS;
    let waves: Vec<[f64; SIZE]> = times
        .iter()
        .map(|t| {
            let turn = TAU * ((t - first) / interval).fract();
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
    let Some(amounts) = solved(&square, &right) else {
        return;
    };
    for (k, value) in pattern.iter_mut().enumerate() {
        *value -= row(k).iter().zip(&amounts).map(|(w, a)| w * a).sum::<f64>();
    }
}
