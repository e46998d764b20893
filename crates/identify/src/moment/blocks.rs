//! What of slow tests is fitted: means over equal times.

use super::settings::{LEAST_SPEED, SLOW_ACCELERATION};
use crate::measurement::Measurement;
use crate::regression::Data;
use crate::series::trapezoid;
use physics::rolling::RollingSet;

/// About as many blocks as all tests together become: few, so that quick noise averages out.
const BLOCKS: f64 = 200.0;

/// Fewest blocks that are fitted.
const FEWEST: usize = 16;

/// Means of speed and torque over equal times, in the order of time, one test after another.
pub(super) struct Blocks {
    /// Speed without sign, rad/s, and torque along the rotation without the part of inertia, N m.
    pub(super) data: Data,
    /// Test of each block.
    pub(super) test: Vec<usize>,
    /// Smallest and largest speed of what went in, rad/s.
    pub(super) range: (f64, f64),
}

impl Blocks {
    pub(super) fn new(tests: &[&Measurement], set: &RollingSet<f64>) -> Result<Self, String> {
        let inertia = set.outer_inertia();
        let taken: Vec<Vec<usize>> = tests
            .iter()
            .map(|test| {
                (0..test.time.len())
                    .filter(|&k| {
                        test.speed[k].abs() >= LEAST_SPEED
                            && test.acceleration[k].abs() <= SLOW_ACCELERATION
                    })
                    .collect()
            })
            .collect();
        let interval = |test: &Measurement| {
            (test.time[test.time.len() - 1] - test.time[0]) / (test.time.len() - 1) as f64
        };
        let whole: f64 = tests
            .iter()
            .zip(&taken)
            .map(|(test, taken)| taken.len() as f64 * interval(test))
            .sum();
        let slowest = tests.iter().map(|test| interval(test)).fold(0.0, f64::max);
        let duration = (whole / BLOCKS).max(slowest);
        let mut blocks = Self {
            data: Data::default(),
            test: Vec::new(),
            range: (f64::INFINITY, 0.0),
        };
        for (number, (test, taken)) in tests.iter().zip(&taken).enumerate() {
            let step = interval(test);
            let size = ((duration / step).round() as usize).max(1);
            let weights = trapezoid(&test.time);
            let value = |k: usize| {
                (test.torque[k] + inertia * test.acceleration[k]) * test.speed[k].signum()
            };
            let apart = |a: usize, b: usize| {
                b != a + 1
                    || test.time[b] - test.time[a] > 3.0 * step
                    || test.speed[a].signum() != test.speed[b].signum()
            };
            for run in taken.chunk_by(|&a, &b| !apart(a, b)) {
                let of = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
                    run.iter().map(|&k| value(k)).collect()
                };
                let speed = of(&|k| test.speed[k].abs());
                let used = (blocks.data).add(&speed, &of(&value), &of(&|k| weights[k]), size);
                blocks.test.resize(blocks.data.x.len(), number);
                for &speed in &speed[..used] {
                    blocks.range.0 = blocks.range.0.min(speed);
                    blocks.range.1 = blocks.range.1.max(speed);
                }
            }
        }
        if blocks.data.x.len() < FEWEST {
            return Err(format!(
                "slow running above {LEAST_SPEED} rad/s with accelerations below {SLOW_ACCELERATION} rad/s² gives {} values; at least {FEWEST} are needed: the slow test is too short or not slow",
                blocks.data.x.len()
            ));
        }
        if blocks.range.1 - blocks.range.0 < 0.02 * blocks.range.1 {
            return Err(format!(
                "all slow running is at {:.4} rad/s: a moment over speed needs a range of speeds",
                blocks.range.1
            ));
        }
        let level = blocks.data.level();
        if !(level > 0.0 && level.is_finite()) {
            return Err("the torque of the slow tests is 0 throughout".into());
        }
        Ok(blocks)
    }
}
