//! The two levels of a pulse signal, from the signal itself.

use super::Refusal;
use super::envelope::Envelope;
use crate::quantile::{median, quantile};

/// Where a signal is high or low, over the samples.
pub(super) struct Levels {
    /// Samples in a block.
    block: usize,
    /// Middle between low and high at the centre of each block.
    middle: Vec<f64>,
    /// Distance from low to high.
    pub span: f64,
    /// Standard deviation of the noise of a sample.
    pub noise: f64,
    /// Height of pulses before they were evened, where they were.
    envelope: Option<Envelope>,
}

impl Levels {
    /// Middle between low and high at a sample.
    pub fn middle(&self, sample: usize) -> f64 {
        let place = (sample as f64 + 0.5) / self.block as f64 - 0.5;
        let last = self.middle.len() - 1;
        let left = (place.max(0.0) as usize).min(last);
        let right = (left + 1).min(last);
        let part = (place - left as f64).clamp(0.0, 1.0);
        self.middle[left] * (1.0 - part) + self.middle[right] * part
    }

    /// Those of a signal that was evened, whose noise was as given.
    pub fn evened(noise: f64, envelope: Envelope) -> Levels {
        Levels {
            block: usize::MAX,
            middle: vec![0.0],
            span: 1.0,
            noise,
            envelope: Some(envelope),
        }
    }

    /// The height of pulses before they were evened, where they were.
    pub fn envelope(&self) -> Option<&Envelope> {
        self.envelope.as_ref()
    }

    /// Standard deviation of the noise of a sample.
    pub fn noise_at(&self, sample: usize) -> f64 {
        let height = self.envelope.as_ref().map_or(1.0, |e| e.at(sample).1);
        self.noise / height
    }

    /// Finds levels block by block: a block that holds both levels gives its own, the others take their neighbours'.
    ///
    /// So a slow drift by more than the height of a pulse does no harm, nor a duty far from one half.
    pub fn find(samples: &[f64]) -> Result<Levels, Refusal> {
        let block = (samples.len() / 32).max(64);
        let extremes: Vec<(f64, f64)> = samples.chunks(block).map(second_extremes).collect();
        let mut ranges: Vec<f64> = extremes.iter().map(|&(low, high)| high - low).collect();
        let many = ranges.len() >= 4;
        ranges.sort_by(f64::total_cmp);
        let largest = ranges[ranges.len() - if many { 2 } else { 1 }].max(0.0);
        let both = |&(low, high): &(f64, f64)| high - low > 0.6 * largest;
        let full = extremes
            .iter()
            .filter(|e| both(e))
            .map(|&(low, high)| high - low);
        let span = median(full);
        let noise = noise(samples);
        if !(span > 8.0 * noise && span > 0.0) {
            return Err(Refusal::new(
                format!(
                    "the signal spans {span:.3e}, {:.1} times its noise: no two levels",
                    span / noise.max(1e-300)
                ),
                "pulses at least 8 times as high as the standard deviation of the noise",
            ));
        }
        let known: Vec<(usize, f64)> = extremes
            .iter()
            .enumerate()
            .filter(|(_, e)| both(e))
            .map(|(at, &(low, high))| (at, 0.5 * (low + high)))
            .collect();
        Ok(Levels {
            block,
            middle: fill(extremes.len(), &known),
            span,
            noise,
            envelope: None,
        })
    }
}

/// Second smallest and second largest finite value: one spike does not count.
fn second_extremes(samples: &[f64]) -> (f64, f64) {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for &x in samples.iter().filter(|x| x.is_finite()) {
        if x < low[0] {
            low = [x, low[0]];
        } else if x < low[1] {
            low[1] = x;
        }
        if x > high[0] {
            high = [x, high[0]];
        } else if x > high[1] {
            high[1] = x;
        }
    }
    if low[1].is_finite() && high[1].is_finite() {
        (low[1], high[1])
    } else {
        (0.0, 0.0)
    }
}

/// Standard deviation of the noise from the smallest tenth of the differences: the flanks of pulses are in the upper part.
///
/// A signal that never rests, as a sine, has no smallest differences that are noise alone; differences of the third order, in
/// which little is left of it, serve there.
fn noise(samples: &[f64]) -> f64 {
    let stride = (samples.len() / 20_000).max(1);
    // A tenth of |x| is below 0.1257 standard deviations for normal x; a difference has √2 the noise, the third one √20.
    let of = |width: usize, factor: f64, difference: &dyn Fn(&[f64]) -> f64| {
        let steps = samples
            .windows(width)
            .step_by(stride)
            .map(|near| difference(near).abs())
            .filter(|step| step.is_finite());
        quantile(steps, 0.1) / (0.1257 * factor.sqrt())
    };
    let first = of(2, 2.0, &|x| x[1] - x[0]);
    let third = of(4, 20.0, &|x| x[3] - 3.0 * x[2] + 3.0 * x[1] - x[0]);
    if third < 0.5 * first { third } else { first }
}

/// Values at `0..count` by straight lines between the known ones, constant beyond them.
fn fill(count: usize, known: &[(usize, f64)]) -> Vec<f64> {
    let mut next = 0;
    (0..count)
        .map(|at| {
            while next < known.len() && known[next].0 < at {
                next += 1;
            }
            match (next.checked_sub(1).map(|left| known[left]), known.get(next)) {
                (_, Some(&(right, value))) if right == at => value,
                (Some((left, a)), Some(&(right, b))) => {
                    a + (b - a) * (at - left) as f64 / (right - left) as f64
                }
                (Some((_, value)), None) | (None, Some(&(_, value))) => value,
                (None, None) => 0.0,
            }
        })
        .collect()
}
