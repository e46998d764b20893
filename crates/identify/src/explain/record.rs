//! A test as the comparison sees it: few independent means of the torque, and fine steps that predictions run along.
//!
//! Means lie closer where more happens: their width grows with the time since the engagement and, after the
//! run-down, with the time since standstill; none spans a large change of speed.

use crate::{CageTrace, Measurement};
use statistics::interpolation::held;

use super::means::{CageMean, cage_mean, torque_mean, zeroed};
use super::steady::{Table, fading};

/// One step of a prediction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    /// Length, s.
    pub duration: f64,
    /// Time of its end since the engagement, s.
    pub elapsed: f64,
    /// Speed at its end, rad/s.
    pub speed: f64,
    /// Speed in its middle, rad/s.
    pub middle_speed: f64,
    /// Mean acceleration, rad/s².
    pub acceleration: f64,
    /// M in its middle, N m.
    pub steady: f64,
    /// tanh that lets a moment without speed dependence fade at rest.
    pub fading: f64,
    /// The mean it belongs to.
    pub bin: usize,
}

/// A mean of the signals over some time.
#[derive(Clone, Debug)]
pub(crate) struct Bin {
    /// Times since the engagement, s.
    pub from: f64,
    pub to: f64,
    /// Mean speed, rad/s.
    pub speed: f64,
    /// Mean acceleration, rad/s².
    pub acceleration: f64,
    /// Change of the torque of rolling balls over it by its width, N m/s.
    pub steepness: f64,
    /// Part of its time in which the shaft turns more slowly than in any slow test.
    pub below: f64,
    /// Whether it lies before the engagement.
    pub before: bool,
    /// Mean torque, N m, and its variance without zero and scale.
    pub torque: f64,
    pub variance: f64,
    /// Mean cage speed.
    pub cage: Option<CageMean>,
}

/// What happened to the bearing before a test, as far as it lasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Past {
    /// Radial load over that of the first measured test.
    pub load_factor: f64,
    /// Share that is left of what the last test did to grease and sensor: 0 after a long rest, 1 at once.
    pub left: f64,
    /// Share of the films' rise at the end of the last test that is left.
    pub film: f64,
}

impl Past {
    pub const RESTED: Self = Self {
        load_factor: 1.0,
        left: 0.0,
        film: 0.0,
    };
}

/// One test.
#[derive(Clone, Debug)]
pub(crate) struct Trial {
    pub steps: Vec<Step>,
    pub bins: Vec<Bin>,
    pub zero_deviation: f64,
    pub scale_deviation: f64,
    pub starts_turning: bool,
    pub past: Past,
    /// Time at rest since the test before, s; none after a long rest.
    pub rest_before: Option<f64>,
}

/// Growth of the width of a mean with its age.
const GROWTH: f64 = 0.35;
/// Largest change of speed within one mean, over the highest speed.
const SPEED_CHANGE: f64 = 0.15;
/// Speed below which the shaft counts as at rest, over the highest speed.
pub(crate) const REST: f64 = 0.005;
/// Least width of a mean, s.
const LEAST_WIDTH: f64 = 0.02;

/// Least width of a mean over the time since the engagement: two correlation times there.
///
/// A torque is smoothed less while it changes. One width for a whole test would be that of its longest part: a record with a long
/// hold would say less of the spin-up than the same one cut short.
#[derive(Clone, Debug)]
pub(crate) struct LeastWidth {
    time: Vec<f64>,
    width: Vec<f64>,
}

impl LeastWidth {
    /// Of a measured test.
    pub fn of(test: &Measurement, top_speed: f64) -> Self {
        let engagement = engagement(test, top_speed);
        Self {
            time: test.time.iter().map(|t| t - engagement).collect(),
            width: (test.correlation_time.iter())
                .map(|time| LEAST_WIDTH.max(2.0 * time))
                .collect(),
        }
    }

    /// One width throughout, s.
    #[cfg(test)]
    pub fn even(width: f64) -> Self {
        Self {
            time: vec![0.0],
            width: vec![width],
        }
    }

    fn at(&self, time: f64) -> f64 {
        held(&self.time, &self.width, time)
    }
}

/// Limits of the means after the engagement, s since the engagement, with the age of each.
///
/// - `speed`: speed over the time since the engagement
/// - `stop`: time of standstill, s
/// - `least`: least width
fn limits(
    speed: &dyn Fn(f64) -> f64,
    end: f64,
    stop: f64,
    least: &LeastWidth,
    top_speed: f64,
) -> Vec<(f64, f64, f64)> {
    let mut limits = Vec::new();
    let mut from = 0.0;
    loop {
        let first = least.at(from);
        let least = first.max(least.at(from + first));
        if end - from <= 0.5 * least {
            break;
        }
        let (origin, border) = if from < stop {
            (0.0, stop)
        } else {
            (stop, end)
        };
        let mut width = (GROWTH * (from - origin)).max(least);
        while width > least && (speed(from + width) - speed(from)).abs() > SPEED_CHANGE * top_speed
        {
            width = (0.7 * width).max(least);
        }
        let mut to = from + width;
        if border - to < 0.5 * least.max(0.5 * width) {
            to = border;
        }
        let to = to.min(end).min(border);
        limits.push((from, to, 0.5 * (from + to) - origin));
        from = to;
    }
    limits
}

impl Trial {
    /// Steps and empty means over a course of speed.
    ///
    /// - `speed`: speed over the time since the engagement, rad/s
    /// - `end`: end of the test, s since the engagement
    /// - `least`: least width of a mean
    /// - `inertia`: J_O, kg m²
    pub fn planned(
        speed: &dyn Fn(f64) -> f64,
        end: f64,
        least: &LeastWidth,
        table: &Table,
        inertia: f64,
    ) -> Self {
        let rolling = |t: f64| {
            let h = 1e-3;
            table.at(speed(t)).0 - inertia * (speed(t + h) - speed(t - h)) / (2.0 * h)
        };
        let top_speed = table.top_speed;
        let grid = 4000;
        let at = |i: usize| end * i as f64 / grid as f64;
        let peak = (0..=grid)
            .max_by(|i, j| speed(at(*i)).total_cmp(&speed(at(*j))))
            .unwrap_or(0);
        let stop = (peak..=grid)
            .find(|i| speed(at(*i)) < REST * top_speed)
            .map_or(end, at);
        let mut test = Self {
            steps: Vec::new(),
            bins: Vec::new(),
            zero_deviation: 0.0,
            scale_deviation: 0.0,
            starts_turning: speed(0.0) > REST * top_speed,
            past: Past::RESTED,
            rest_before: None,
        };
        for (from, to, age) in limits(speed, end, stop, least, top_speed) {
            let slope = (speed(to) - speed(from)).abs() / (to - from);
            let longest = (0.05 * age)
                .clamp(1e-3, 0.1)
                .min((0.015 * top_speed / slope).max(1e-3));
            let count = ((to - from) / longest).ceil().max(2.0);
            let bin = test.bins.len();
            let duration = (to - from) / count;
            let (mut mean_speed, mut below) = (0.0, 0.0);
            for i in 0..count as usize {
                let begin = from + i as f64 * duration;
                let speeds = [0.0, 0.5, 1.0].map(|part| speed(begin + part * duration).max(0.0));
                mean_speed += speeds[1] / count;
                if speeds[1] < table.lowest {
                    below += 1.0 / count;
                }
                test.steps.push(Step {
                    duration,
                    elapsed: begin + duration,
                    speed: speeds[2],
                    middle_speed: speeds[1],
                    acceleration: (speeds[2] - speeds[0]) / duration,
                    steady: table.at(speeds[1]).0,
                    fading: fading(speeds[1]),
                    bin,
                });
            }
            test.bins.push(Bin {
                from,
                to,
                speed: mean_speed,
                acceleration: (speed(to) - speed(from)) / (to - from),
                steepness: (rolling(to) - rolling(from)) / (to - from),
                below,
                before: false,
                torque: 0.0,
                variance: 0.0,
                cage: None,
            });
        }
        test
    }

    /// The means of a measurement.
    pub fn measured(measurement: &Measurement, table: &Table, inertia: f64) -> Self {
        let time = &measurement.time;
        let engagement = engagement(measurement, table.top_speed);
        let end = time[time.len() - 1] - engagement;
        let speed = |t: f64| held(time, &measurement.speed, t + engagement);
        let least = LeastWidth::of(measurement, table.top_speed);
        let age = measurement.noise_age();
        let mut test = Self::planned(&speed, end, &least, table, inertia);
        test.zero_deviation = measurement.zero_deviation;
        test.scale_deviation = measurement.scale_deviation;
        test.rest_before = measurement.rest_before;
        let cage = measurement.cage.as_ref();
        let cage_age = cage.map(CageTrace::age).unwrap_or_default();
        for bin in &mut test.bins {
            let (from, to) = (bin.from + engagement, bin.to + engagement);
            (bin.torque, bin.variance) = torque_mean(measurement, &age, from, to);
            bin.cage = cage.and_then(|cage| cage_mean(cage, &cage_age, from, to));
            if let Some(mean) = &mut bin.cage {
                mean.from -= engagement;
                mean.to -= engagement;
            }
        }
        // Only what surely lies before the engagement is rest.
        let unsure =
            measurement.correlation_time_at(engagement) + 2.0 * measurement.engagement_deviation;
        let (from, to) = (time[0], engagement - unsure);
        let (torque, variance) = torque_mean(measurement, &age, from, to);
        if variance.is_finite() && !zeroed(measurement, from, to) {
            test.bins.push(Bin {
                from: from - engagement,
                to: to - engagement,
                speed: if test.starts_turning {
                    speed(0.5 * (from + to) - engagement)
                } else {
                    0.0
                },
                acceleration: 0.0,
                steepness: 0.0,
                below: 0.0,
                before: true,
                torque,
                variance,
                cage: None,
            });
        }
        test
    }

    /// Means of a quantity along the steps, one for each bin.
    pub fn means(&self, values: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut sums = vec![0.0; self.bins.len()];
        for (step, value) in self.steps.iter().zip(values) {
            let bin = &self.bins[step.bin];
            sums[step.bin] += value * step.duration / (bin.to - bin.from);
        }
        sums
    }

    /// Means of the cage speed along the steps, one for each bin, over the part of it that the cage's signal covers.
    pub fn cage_means(&self, values: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut sums = vec![0.0; self.bins.len()];
        for (step, value) in self.steps.iter().zip(values) {
            let bin = &self.bins[step.bin];
            let (from, to) = bin
                .cage
                .map_or((bin.from, bin.to), |mean| (mean.from, mean.to));
            let inside = step.elapsed.min(to) - (step.elapsed - step.duration).max(from);
            sums[step.bin] += value * inside.max(0.0) / (to - from);
        }
        sums
    }
}

/// When the test began, s: as given, else the first sign of turning.
pub(super) fn engagement(measurement: &Measurement, top_speed: f64) -> f64 {
    let (first, last) = (
        measurement.time[0],
        measurement.time[measurement.time.len() - 1],
    );
    measurement
        .engagement
        .filter(|t| (first..last).contains(t))
        .unwrap_or_else(|| {
            let turning = (measurement.speed.iter())
                .position(|speed| *speed > 2.0 * REST * top_speed)
                .unwrap_or(0);
            measurement.time[turning.saturating_sub(1)]
        })
}

#[cfg(test)]
#[path = "../../tests/unit/explain_record.rs"]
mod tests;
