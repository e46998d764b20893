//! Pulses of a wheel without errors.

use crate::synthetic::wheel::Random;
use measure::pulse::{Edges, Pulses, Wheel, number};
use std::f64::consts::TAU;

/// Pulses of a wheel without errors whose angle is given, by bisection, with noise of the instants.
pub fn pulses(
    marks: usize,
    seconds: f64,
    noise: f64,
    seed: u64,
    angle: impl Fn(f64) -> f64,
) -> Pulses {
    let mut random = Random::new(seed);
    let pitch = TAU / marks as f64;
    let mut times = Vec::new();
    let mut from = 0.0;
    for k in 0.. {
        let wanted = (k as f64 + 0.3) * pitch;
        if angle(seconds) < wanted {
            break;
        }
        let (mut low, mut high) = (from, seconds);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if angle(middle) < wanted {
                low = middle
            } else {
                high = middle
            }
        }
        from = low;
        times.push(low + noise * random.normal());
    }
    let found = Edges::stamped(times, noise.max(1e-9), Some((0.0, seconds))).unwrap();
    number(&found, &Wheel { marks, missing: 0 }).unwrap()
}
