//! What is inverted: means of blocks of the reading, and what may lie beyond where it is clipped.

use super::chain::{Pass, Samples, ZERO};
use super::input::Inversion;

/// The reading in blocks that are short for the sensor and for a spin-up, and the shaft at their middles.
pub(super) struct Thin {
    first: f64,
    interval: f64,
    pub(super) reading: Vec<f64>,
    /// The limit at which a block holds a reading, and its side: 1 above, -1 below.
    pub(super) limits: Vec<Option<(f64, f64)>>,
    angle: Vec<f64>,
    speed: Vec<f64>,
}

/// Longest block, s: a twelfth of a spin-up of 25 ms.
const BLOCK: f64 = 0.002;

/// Blocks in a period of the sensor: means of blocks this short lose 0.4 % of a swing at its frequency.
const IN_A_PERIOD: f64 = 20.0;

/// Most blocks that are inverted at once.
const MOST: usize = 100_000;

impl Thin {
    pub(super) fn new(input: &Inversion) -> Result<Self, String> {
        let longest = BLOCK.min(1.0 / (IN_A_PERIOD * input.sensor.frequency.value));
        let block = ((longest / input.interval + 1e-6) as usize).max(1);
        let count = input.reading.len() / block;
        if count > MOST {
            return Err(format!(
                "the torque reading is too long to be inverted at once: {count} blocks, at most {MOST}"
            ));
        }
        if count < 16 {
            return Err(format!(
                "the torque reading lasts for {count} blocks; at least 16 are needed"
            ));
        }
        let interval = block as f64 * input.interval;
        let first = input.first + 0.5 * (block - 1) as f64 * input.interval;
        let mut reading: Vec<f64> = input
            .reading
            .chunks_exact(block)
            .map(|part| part.iter().sum::<f64>() / block as f64)
            .collect();
        let mut limits = vec![None; count];
        for part in input.clipped.iter().filter(|part| part.count > 0) {
            let blocks = part.first / block..=(part.first + part.count - 1) / block;
            for k in blocks.take_while(|k| *k < count) {
                reading[k] = f64::NAN;
                limits[k] = Some((part.limit, if part.above { 1.0 } else { -1.0 }));
            }
        }
        let times = (0..count).map(|k| first + k as f64 * interval);
        let (angle, speed) = match &input.shaft {
            Some(shaft) => times
                .map(|t| (shaft.angle_at(t), shaft.speed_at(t)))
                .unzip(),
            None => (Vec::new(), Vec::new()),
        };
        Ok(Self {
            first,
            interval,
            reading,
            limits,
            angle,
            speed,
        })
    }

    /// The reading with what may lie beyond its limits; none where nothing is clipped.
    ///
    /// The true reading enters a stretch with a slope and leaves it with one: a parabola rises by a quarter of slope times
    /// duration between them. Twice that, and three deviations of the noise, lie beyond the limit here; the whole span of the
    /// record where that is less, or no slope is known.
    pub(super) fn beyond_limits(&self, expected: &Pass, noise: f64) -> Option<Vec<f64>> {
        let known = self.reading.iter().filter(|v| v.is_finite());
        let (low, high) = known.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| {
            (l.min(v), h.max(v))
        });
        let mut moved = self.reading.clone();
        let mut next = 0;
        while let Some(first) = (next..moved.len()).find(|k| self.limits[*k].is_some()) {
            let end = (first..moved.len())
                .find(|k| self.limits[*k].is_none())
                .unwrap_or(moved.len());
            let step = |one: Option<usize>, other: Option<usize>| {
                let at = |k: Option<usize>| self.reading.get(k?).copied();
                (at(one)? - at(other)?).abs().into()
            };
            let slopes: [Option<f64>; 2] = [
                step(first.checked_sub(1), first.checked_sub(2)),
                step(Some(end), Some(end + 1)),
            ];
            let steepest = (slopes.iter().flatten().copied()).filter(|slope| slope.is_finite());
            let excess = (steepest.reduce(f64::max))
                .map_or(f64::INFINITY, |slope| 0.5 * slope * (end - first) as f64);
            let excess = (excess + 3.0 * noise).min(high - low);
            let stretch =
                (self.limits[first..end].iter().flatten()).zip(&expected.states[first..end]);
            for (value, (&(limit, side), (state, _))) in moved[first..end].iter_mut().zip(stretch) {
                let bridge = state[0] + state[ZERO];
                *value = side * (side * limit).max(side * bridge) + side * excess;
            }
            next = end;
        }
        (next > 0).then_some(moved)
    }

    pub(super) fn samples<'a>(&'a self, input: &Inversion) -> Samples<'a> {
        Samples {
            first: self.first,
            interval: self.interval,
            reading: &self.reading,
            angle: &self.angle,
            speed: &self.speed,
            fastest: self.speed.iter().fold(0.0, |top, v| top.max(v.abs())),
            zero: input.zero,
        }
    }
}
