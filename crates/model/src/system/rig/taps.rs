//! What a converter samples: some channels at equal intervals, each with its own first instant.
//!
//! A multiplexed converter of f samples a second in all reads channel k of n at (k + i n)/f. The samples are taken from
//! dense output and never ask for the right-hand side, so that 42 000 of them a second cost next to nothing; they are
//! cheapest where the channels stand first in the state ([`layout`](super::layout)).
//! Room is made before the run.

use solve::{Machine, Step};

/// One sampled channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tap {
    /// Channel of the state.
    pub channel: usize,
    /// First instant, s.
    pub first: f64,
    /// Interval, s.
    pub interval: f64,
}

impl Tap {
    /// Instant of a sample, s.
    pub fn time(&self, index: usize) -> f64 {
        self.first + index as f64 * self.interval
    }
}

/// Channels of a converter that takes one after the other, `rate` samples a second in all, from time 0 on.
pub fn multiplexed(channels: &[usize], rate: f64) -> Vec<Tap> {
    let interval = channels.len() as f64 / rate;
    (channels.iter().enumerate())
        .map(|(k, channel)| Tap {
            channel: *channel,
            first: k as f64 / rate,
            interval,
        })
        .collect()
}

/// Taps with their samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Taps {
    taps: Vec<(Tap, Vec<f64>)>,
}

/// Samples for which room is made before a run at most: 2 GiB of them.
const MOST_ROOM: usize = 1 << 28;

impl Taps {
    /// Taps of a run until `end` (s). A tap without a positive interval takes nothing.
    pub fn new(taps: &[Tap], end: f64) -> Self {
        let room = |tap: &Tap| {
            let count = (end - tap.first) / tap.interval;
            if count >= 0.0 {
                (count as usize + 2).min(MOST_ROOM)
            } else {
                0
            }
        };
        Taps {
            taps: taps
                .iter()
                .filter(|tap| tap.interval > 0.0)
                .map(|tap| (*tap, Vec::with_capacity(room(tap))))
                .collect(),
        }
    }
    /// Each tap with its samples.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&Tap, &[f64])> {
        self.taps.iter().map(|(tap, samples)| (tap, &samples[..]))
    }
    /// Takes the samples that fall into a step: after its start, or on it where the run starts there.
    pub fn sample<M: Machine>(&mut self, step: &mut Step<M>) {
        let (start, end) = (step.start, step.end);
        for (tap, samples) in &mut self.taps {
            loop {
                let time = tap.time(samples.len());
                if time > end {
                    break;
                }
                let theta = ((time - start) / (end - start)).clamp(0.0, 1.0);
                samples.push(step.leading_state(theta, tap.channel + 1)[tap.channel]);
            }
        }
    }
}
