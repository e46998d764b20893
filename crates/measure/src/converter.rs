//! What a converter does to signals: steps, limits, drop-outs.

/// A converter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Converter {
    /// Lowest value it can give, in the unit of the channel.
    pub lowest: f64,
    /// Highest value it can give.
    pub highest: f64,
    /// Bits of a value.
    pub bits: u32,
}

impl Converter {
    /// Smallest difference of two values.
    ///
    /// Formula: range/2^bits
    ///
    /// Source: definition.
    ///
    /// Valid: equal steps.
    pub fn step(&self) -> f64 {
        (self.highest - self.lowest) / 2.0_f64.powi(self.bits as i32)
    }

    /// Noise that rounding to steps adds, rms.
    ///
    /// Formula: step/√12
    ///
    /// Source: Bennett, Bell Syst. Tech. J. 27 (1948) 446 (from memory).
    ///
    /// Valid: a signal that moves over several steps between values; less than a step, and rounding is not noise.
    pub fn rounding_noise(&self) -> f64 {
        self.step() / 12.0_f64.sqrt()
    }
}

/// What is wrong with a stretch of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// At the lowest or highest value that can be given.
    Clipped,
    /// The same value for longer than the channel's noise allows.
    Stuck,
    /// Not a number, or infinite.
    Missing,
}

/// A stretch of a channel that is not to be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interval {
    /// Index of its first value.
    pub first: usize,
    /// Number of values.
    pub count: usize,
    /// What is wrong.
    pub fault: Fault,
}

/// Finds clipped, stuck and missing stretches, in the order of time.
///
/// With a `converter` clipping is at its limits. Without one, it is every value at the channel's own highest or lowest, where that
/// is held for three values or more, twice or more, and neighbours are not equal like that elsewhere. Stuck is a run of equal values so long that, with
/// the share of equal neighbours in the channel, it comes about by chance once in a million records.
pub fn faults(values: &[f64], converter: Option<&Converter>) -> Vec<Interval> {
    let runs = runs(values);
    let finite = || values.iter().copied().filter(|v| v.is_finite());
    let (low, high) = finite().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
        (l.min(v), h.max(v))
    });
    let limit = |value: f64| match converter {
        Some(c) => value <= c.lowest + 0.5 * c.step() || value >= c.highest - 1.5 * c.step(),
        None => value == low || value == high,
    };
    // The usual share of equal neighbours, without what is held at the limits and without the longest run.
    let inner = || {
        runs.iter()
            .filter(|r| r.2.is_finite() && r.2 != low && r.2 != high)
    };
    let longest = inner().map(|r| r.1).max().unwrap_or(1);
    let equal = inner().map(|r| r.1 - 1).sum::<usize>() - (longest - 1);
    let pairs = (inner().map(|r| r.1).sum::<usize>().saturating_sub(longest)).max(1) as f64;
    let usual = (equal as f64 / pairs).clamp(1e-6, 1.0);
    let bound = if usual > 0.99 {
        f64::INFINITY
    } else {
        ((1e-6 / values.len() as f64).ln() / usual.ln()).max(4.0)
    };
    let held_often = |value: f64| runs.iter().filter(|r| r.2 == value && r.1 >= 3).count() >= 2;
    let mut found: Vec<Interval> = Vec::new();
    for &(first, count, value) in &runs {
        let fault = if !value.is_finite() {
            Some(Fault::Missing)
        } else if limit(value)
            && (converter.is_some() || (low < high && held_often(value) && usual < 0.2))
        {
            Some(Fault::Clipped)
        } else if count as f64 > bound {
            Some(Fault::Stuck)
        } else {
            None
        };
        let Some(fault) = fault else { continue };
        match found.last_mut() {
            Some(last) if last.fault == fault && last.first + last.count == first => {
                last.count += count
            }
            _ => found.push(Interval {
                first,
                count,
                fault,
            }),
        }
    }
    found
}

/// Runs of equal values: first index, count, value; everything that is not finite counts as equal.
fn runs(values: &[f64]) -> Vec<(usize, usize, f64)> {
    let mut runs: Vec<(usize, usize, f64)> = Vec::new();
    for (k, &value) in values.iter().enumerate() {
        match runs.last_mut() {
            Some(run) if run.2 == value || (!run.2.is_finite() && !value.is_finite()) => run.1 += 1,
            _ => runs.push((k, 1, value)),
        }
    }
    runs
}
