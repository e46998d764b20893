//! A test as the comparison sees it: few independent means of the torque, and fine steps that predictions run along.
//!
//! Means lie closer where more happens: their width grows with the time since the engagement and, after the
//! run-down, with the time since standstill; none spans a large change of speed.

use crate::Measurement;

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
    /// Time since the engagement or, at rest, since standstill, s.
    pub age: f64,
    /// Mean speed, rad/s.
    pub speed: f64,
    /// Mean acceleration, rad/s².
    pub acceleration: f64,
    /// Change of the torque of rolling balls over it by its width, N m/s.
    pub steepness: f64,
    /// Whether it lies before the engagement.
    pub before: bool,
    /// Mean torque, N m, and its variance without zero and scale.
    pub torque: f64,
    pub variance: f64,
    /// Mean cage speed, rad/s, and its variance.
    pub cage: Option<(f64, f64)>,
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
pub(crate) struct Test {
    pub steps: Vec<Step>,
    pub bins: Vec<Bin>,
    pub zero_deviation: f64,
    pub scale_deviation: f64,
    pub starts_turning: bool,
    pub past: Past,
}

/// Growth of the width of a mean with its age.
const GROWTH: f64 = 0.35;
/// Largest change of speed within one mean, over the highest speed.
const SPEED_CHANGE: f64 = 0.15;
/// Speed below which the shaft counts as at rest, over the highest speed.
pub(crate) const REST: f64 = 0.005;
/// Least width of a mean, s.
const LEAST_WIDTH: f64 = 0.02;

/// Limits of the means after the engagement, s since the engagement, with the age of each.
///
/// - `speed`: speed over the time since the engagement
/// - `stop`: time of standstill, s
/// - `least`: least width, s
fn limits(
    speed: &dyn Fn(f64) -> f64,
    end: f64,
    stop: f64,
    least: f64,
    top_speed: f64,
) -> Vec<(f64, f64, f64)> {
    let mut limits = Vec::new();
    let mut from = 0.0;
    while end - from > 0.5 * least {
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

impl Test {
    /// Steps and empty means over a course of speed.
    ///
    /// - `speed`: speed over the time since the engagement, rad/s
    /// - `end`: end of the test, s since the engagement
    /// - `least`: least width of a mean, s
    /// - `inertia`: J_O, kg m²
    pub fn planned(
        speed: &dyn Fn(f64) -> f64,
        end: f64,
        least: f64,
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
        };
        for (from, to, age) in limits(speed, end, stop, least, top_speed) {
            let slope = (speed(to) - speed(from)).abs() / (to - from);
            let longest = (0.05 * age)
                .clamp(1e-3, 0.1)
                .min((0.015 * top_speed / slope).max(1e-3));
            let count = ((to - from) / longest).ceil().max(2.0);
            let bin = test.bins.len();
            let duration = (to - from) / count;
            let mut mean_speed = 0.0;
            for i in 0..count as usize {
                let begin = from + i as f64 * duration;
                let speeds = [0.0, 0.5, 1.0].map(|part| speed(begin + part * duration).max(0.0));
                mean_speed += speeds[1] / count;
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
                age,
                speed: mean_speed,
                acceleration: (speed(to) - speed(from)) / (to - from),
                steepness: (rolling(to) - rolling(from)) / (to - from),
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
        let speed = |t: f64| interpolate(time, &measurement.speed, t + engagement);
        let least = LEAST_WIDTH.max(2.0 * measurement.correlation_time);
        let mut test = Self::planned(&speed, end, least, table, inertia);
        test.zero_deviation = measurement.zero_deviation;
        test.scale_deviation = measurement.scale_deviation;
        for bin in &mut test.bins {
            let (from, to) = (bin.from + engagement, bin.to + engagement);
            (bin.torque, bin.variance) = torque_mean(measurement, from, to);
            bin.cage = measurement.cage.as_ref().and_then(|cage| {
                let inside = cage.time.partition_point(|t| *t < from)
                    ..cage.time.partition_point(|t| *t < to);
                let count = inside.len() as f64;
                let sum: f64 = cage.speed[inside.clone()].iter().sum();
                let variance = cage.deviation[inside.clone()]
                    .iter()
                    .map(|deviation| deviation * deviation)
                    .sum::<f64>()
                    / (count * count);
                (!inside.is_empty()).then_some((sum / count, variance))
            });
        }
        // Only what surely lies before the engagement is rest.
        let unsure = measurement.correlation_time + 2.0 * measurement.engagement_deviation;
        let (from, to) = (time[0], engagement - unsure);
        let (torque, variance) = torque_mean(measurement, from, to);
        if variance.is_finite() {
            test.bins.push(Bin {
                from: from - engagement,
                to: to - engagement,
                age: 0.0,
                speed: if test.starts_turning {
                    speed(0.5 * (from + to) - engagement)
                } else {
                    0.0
                },
                acceleration: 0.0,
                steepness: 0.0,
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
}

/// When the test began, s: as told, else the first sign of turning.
fn engagement(measurement: &Measurement, top_speed: f64) -> f64 {
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

/// Mean of the torque over some time, N m, and its variance without zero and scale; infinite without data.
fn torque_mean(measurement: &Measurement, from: f64, to: f64) -> (f64, f64) {
    let time = &measurement.time;
    let inside = time.partition_point(|t| *t < from)..time.partition_point(|t| *t < to);
    if inside.is_empty() || to <= from {
        return (0.0, f64::INFINITY);
    }
    let count = inside.len() as f64;
    let (mut torque, mut variance) = (0.0, 0.0);
    for i in inside {
        let (value, deviation) = (measurement.torque[i], measurement.torque_deviation[i]);
        let shared =
            measurement.zero_deviation.powi(2) + (measurement.scale_deviation * value).powi(2);
        torque += value / count;
        variance += (deviation * deviation - shared).max(0.01 * deviation * deviation) / count;
    }
    let independent = ((to - from) / measurement.correlation_time.max(1e-9)).clamp(1.0, count);
    (torque, variance / independent)
}

/// Linear interpolation, constant beyond the ends.
pub(crate) fn interpolate(time: &[f64], values: &[f64], t: f64) -> f64 {
    let above = time.partition_point(|knot| *knot <= t);
    if above == 0 {
        return values[0];
    }
    if above == time.len() {
        return values[above - 1];
    }
    let share = (t - time[above - 1]) / (time[above] - time[above - 1]);
    values[above - 1] + share * (values[above] - values[above - 1])
}

#[cfg(test)]
mod tests {
    use super::super::steady::{Continued, known};
    use super::*;

    fn table() -> Table {
        Continued(&known(vec![1.0, 150.0], vec![20e-3, 20e-3])).table(150.0)
    }

    /// Up in 0.1 s, held for 5 s, down in 1.5 s, a second of rest.
    fn course(t: f64) -> f64 {
        150.0 * (t / 0.1).clamp(0.0, 1.0) * (1.0 - (t - 5.1) / 1.5).clamp(0.0, 1.0)
    }

    #[test]
    fn means_lie_side_by_side_and_none_spans_much_change() {
        let test = Test::planned(&course, 7.6, 0.02, &table(), 0.0);
        let mut from = 0.0;
        for bin in &test.bins {
            assert_eq!(bin.from, from);
            from = bin.to;
            let change = (course(bin.to) - course(bin.from)).abs();
            // a mean of the least width may span more; a remnant at a border at most doubles the last one
            let allowed = 0.35 * 150.0_f64;
            assert!(change < allowed, "{bin:?}");
        }
        assert!((from - 7.6).abs() < 0.011);
        // few enough to count as independent, and closer where more happens
        assert!((25..60).contains(&test.bins.len()), "{}", test.bins.len());
        // one border is the standstill: no mean mixes turning and rest
        let stop = 6.6 - 1.5 * REST;
        assert!(test.bins.iter().any(|bin| (bin.from - stop).abs() < 0.01));
        assert!((test.steps.iter().map(|s| s.duration).sum::<f64>() - from).abs() < 1e-9);
    }
    #[test]
    fn the_mean_of_a_constant_is_the_constant() {
        let test = Test::planned(&course, 7.6, 0.02, &table(), 0.0);
        for mean in test.means(test.steps.iter().map(|_| 3.0)) {
            assert!((mean - 3.0).abs() < 1e-9);
        }
    }
    #[test]
    fn noise_counts_by_its_correlation_time_and_zero_and_scale_apart() {
        let time: Vec<f64> = (0..4000).map(|i| f64::from(i) * 2e-3).collect();
        let count = time.len();
        let measurement = Measurement {
            name: "constant".into(),
            load: 50.0,
            speed: time.iter().map(|t| course(t - 0.4)).collect(),
            speed_deviation: vec![0.1; count],
            acceleration: vec![0.0; count],
            acceleration_deviation: vec![1.0; count],
            torque: vec![10e-3; count],
            // 0.3 noise, 0.4 zero, no scale: √(0.3² + 0.4²)
            torque_deviation: vec![0.5e-3; count],
            time,
            zero_deviation: 0.4e-3,
            scale_deviation: 0.0,
            correlation_time: 0.02,
            engagement: Some(0.4),
            engagement_deviation: 0.0,
            cage: None,
            temperature: None,
        };
        let test = Test::measured(&measurement, &table(), 0.0);
        for bin in &test.bins {
            let width = bin.to - bin.from;
            let expected = 0.3e-3 / (width / 0.02).sqrt();
            assert!((bin.torque - 10e-3).abs() < 1e-12);
            assert!((bin.variance.sqrt() / expected - 1.0).abs() < 1e-6);
        }
        let before = test
            .bins
            .iter()
            .find(|bin| bin.before)
            .expect("rest before");
        assert!((before.to - before.from - 0.38).abs() < 1e-9 && before.speed == 0.0);
    }
}
