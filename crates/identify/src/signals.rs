//! One test put together from what its signals hold.
//!
//! ```text
//!   speed from pulses, torque without its sensor's swing, cage ──▶ Measurement on the torque's times, closer in a quick change
//!
//!   at rest          before an engagement from rest, and behind the last pulse where the next ones did not come: Ω = 0, Ω̇ = 0
//!   zero at rest     the reading's mean once the arm has settled behind that last pulse
//!   correlation      τ = 2 σ_torque/σ_rate at each time
//! ```
//! The settling time is that of the torque arm after a sudden change: within it a reading still swings, and a smoothed torque does
//! not follow. Nothing here is fitted; what the signals do not determine is in the deviations.
//!
//! **Does not model**: a shaft that turns on by less than a mark behind its last pulse, other than by its deviation; a zero that
//! wanders between the test and the rest behind it.

mod grid;

use crate::measurement::{CageTrace, Measurement, spacing};
use grid::Grid;
use measure::cage_speed::CageSpeed;
use measure::speed::{Motion, Speed};
use measure::torque_sensor::Torque;
use statistics::uncertain::Uncertain;

/// What the estimators of `measure` found in the signals of one test.
#[derive(Clone, Copy)]
pub struct Signals<'a> {
    /// Name for messages.
    pub name: &'a str,
    /// Radial load on the bearing, N.
    pub load: f64,
    /// The motion of the shaft.
    pub speed: &'a Speed,
    /// Largest speed of the shaft without sign, rad/s.
    pub fastest: f64,
    /// Angle without a pulse from which on the shaft counts as stopped, rad: some marks.
    pub silence: f64,
    /// The torque on the outer race.
    pub torque: &'a Torque,
    /// Relative standard deviation of its scale.
    pub scale_deviation: f64,
    /// The motion of the cage, where it was measured.
    pub cage: Option<&'a CageSpeed>,
    /// Time within which the torque arm settles after a sudden change, s.
    pub settling_time: f64,
    /// Time at rest since the test before, s; none after a long rest.
    pub rest_before: Option<f64>,
}

/// Covariance of angle, speed and acceleration of a shaft that shows no pulse: 0.01 rad/s, 1 rad/s².
const AT_REST: [[f64; 3]; 3] = [[1e-4, 0.0, 0.0], [0.0, 1e-4, 0.0], [0.0, 0.0, 1.0]];
/// Least deviation of a torque over that of the zero or of the noise: a torque that is zero by definition is not more certain than
/// the data around it.
const LEAST_DEVIATION: f64 = 0.02;
/// Least time of rest that a zero is taken from, s: several correlation times of a reading.
const LEAST_REST: f64 = 0.5;
/// Parts into which that rest is cut.
const PARTS: usize = 8;
/// Correlation of a smooth random curve is gone after so many times the ratio of its deviation to that of its rate.
const INDEPENDENT: f64 = 2.0;
/// Deviation of a cage's speed over the speed of its first ball, where the rise before it is taken as straight: a rise with the
/// square of time differs from it by as much.
const FIRST_RISE: f64 = 0.25;

/// The measurement by signals, without a temperature.
///
/// - `signals`: what was found in them
///
/// Each torque's deviation is at least 2 % of that of zero or noise. Where no rest before the test shows the zero, that behind it
/// does, see [`zero_at_rest`].
pub fn measurement(signals: &Signals) -> Measurement {
    let torque = signals.torque;
    let grid = Grid::of(torque, signals.speed);
    let change = signals.speed.change.filter(|change| change.from_rest);
    let last_pulse = signals.speed.range().1;
    let stops = stops(signals, &grid.time, last_pulse);
    let motion = motions(signals, &grid.time, stops.then_some(last_pulse));
    let (mut values, mut torque_deviation) = grid.torques();
    let mut zero_deviation = torque.zero.deviation;
    if change.is_none()
        && stops
        && let Some(zero) = zero_at_rest(&grid.time, &values, last_pulse + signals.settling_time)
    {
        for (value, deviation) in values.iter_mut().zip(&mut torque_deviation) {
            *value -= zero.value;
            let noise = (deviation.powi(2) - zero_deviation.powi(2)).max(0.0);
            *deviation = noise.sqrt().hypot(zero.deviation);
        }
        zero_deviation = zero.deviation;
    }
    let floor = LEAST_DEVIATION * torque.zero.deviation.max(torque.noise);
    for deviation in &mut torque_deviation {
        *deviation = deviation.max(floor);
    }
    Measurement {
        name: signals.name.to_string(),
        load: signals.load,
        speed: motion.iter().map(|m| m.speed).collect(),
        speed_deviation: motion.iter().map(Motion::speed_uncertainty).collect(),
        acceleration: motion.iter().map(|m| m.acceleration).collect(),
        acceleration_deviation: motion
            .iter()
            .map(Motion::acceleration_uncertainty)
            .collect(),
        torque: values,
        torque_deviation,
        zero_deviation,
        scale_deviation: signals.scale_deviation,
        correlation_time: grid.values(&correlation_time(torque)),
        engagement: signals.speed.change.map(|change| change.engagement.0),
        engagement_deviation: change.map_or(0.0, |change| change.engagement.1),
        rest_before: signals.rest_before,
        cage: (signals.cage).map(|found| cage(found, change.map(|change| change.engagement.0))),
        temperature: None,
        time: grid.time,
    }
}

/// Whether the shaft stops behind its last pulse: at its last speed others would have come.
fn stops(signals: &Signals, time: &[f64], last_pulse: f64) -> bool {
    let silence = time.last().map_or(0.0, |end| end - last_pulse);
    silence * signals.speed.at(last_pulse).speed.abs() > signals.silence
}

/// The motion at the times of the torque; at rest before an engagement from rest and behind a stop.
fn motions(signals: &Signals, time: &[f64], stop: Option<f64>) -> Vec<Motion> {
    let mut motion: Vec<Motion> = time.iter().map(|time| signals.speed.at(*time)).collect();
    let change = signals.speed.change.filter(|change| change.from_rest);
    let from = change.map_or(f64::NEG_INFINITY, |change| change.engagement.0);
    let last = signals.speed.range().1;
    let end = signals.speed.at(last);
    let until = stop.unwrap_or(f64::INFINITY);
    for (motion, time) in motion.iter_mut().zip(time) {
        if *time < from || *time > until {
            (motion.speed, motion.acceleration) = (0.0, 0.0);
            motion.covariance = AT_REST;
            // just behind the last pulse it may still turn by less than a mark
            if (last..last + signals.settling_time).contains(time) {
                motion.covariance[1][1] += end.speed * end.speed;
                motion.covariance[2][2] += end.acceleration * end.acceleration;
            }
        }
    }
    motion
}

/// The zero of a torque reading from the rest at its end; none where that is shorter than half a second.
///
/// Formula: zero = mean of eight means over equal parts; σ_zero = their scatter, √(Σ(part - zero)²/7)
///
/// - `time`: times, s
/// - `torque`: readings, N m
/// - `from`: when the shaft rests and the arm has settled, s
///
/// The parts share slow errors to some degree, so the deviation is their scatter itself, not that of their mean.
pub fn zero_at_rest(time: &[f64], torque: &[f64], from: f64) -> Option<Uncertain> {
    let first = time.partition_point(|time| *time < from);
    let rest = torque.get(first..)?;
    let length = time.last()? - time.get(first)?;
    if length < LEAST_REST || rest.len() < PARTS {
        return None;
    }
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let parts: Vec<f64> = rest.chunks(rest.len().div_ceil(PARTS)).map(mean).collect();
    let zero = mean(&parts);
    let square = parts.iter().map(|part| (part - zero).powi(2)).sum::<f64>();
    let count = parts.len() as f64;
    Some(Uncertain::new(zero, (square / (count - 1.0)).sqrt()))
}

/// Time after which two errors of a torque count as independent, s, at each time; never less than twice the interval of its times.
///
/// Formula: τ = 2 √(σ² - σ_zero²)/σ_rate: a smooth random curve of deviation σ whose rate has the deviation σ_rate
/// changes by as much as itself within σ/σ_rate
///
/// - `torque`: the torque with its rate and their deviations; it is smoothed less where it changes
pub fn correlation_time(torque: &Torque) -> Vec<f64> {
    let count = torque.time.len();
    let interval = if count > 1 {
        (torque.time[count - 1] - torque.time[0]) / (count - 1) as f64
    } else {
        0.0
    };
    (torque.deviation.iter().zip(&torque.rate_deviation))
        .map(|(deviation, rate_deviation)| {
            let noise = deviation.powi(2) - torque.zero.deviation.powi(2);
            let ratio = noise.max(0.0).sqrt() / rate_deviation;
            INDEPENDENT
                * if ratio.is_finite() {
                    ratio.max(interval)
                } else {
                    interval
                }
        })
        .collect()
}

/// The speed of the cage; from the engagement on, where the first ball had not passed yet and the cage rose from rest.
fn cage(found: &CageSpeed, engagement: Option<f64>) -> CageTrace {
    let mut trace = CageTrace {
        time: found.time.clone(),
        speed: found.speed.clone(),
        deviation: found.deviation.clone(),
        correlation_time: (found.correlation_time.iter().zip(spacing(&found.time)))
            .map(|(correlation, apart)| correlation.max(apart))
            .collect(),
    };
    if let (Some(engagement), Some(first)) = (engagement, trace.time.first().copied())
        && engagement < first
    {
        let speed = trace.speed[0];
        trace.time.insert(0, engagement);
        trace.speed.insert(0, 0.0);
        let deviation = trace.deviation[0].hypot(FIRST_RISE * speed.abs());
        trace.deviation[0] = deviation;
        trace.deviation.insert(0, deviation);
        trace.correlation_time.insert(0, first - engagement);
    }
    trace
}

/// A slow test without its end: where the shaft stops the moment falls at once, which no smoothed torque follows.
///
/// - `test`: the test
/// - `settling_time`: time by which it is cut before the stop, s
///
/// A test that turns to its end stays whole.
pub fn before_the_stop(test: &Measurement, settling_time: f64) -> Measurement {
    let turning = test.speed.iter().rposition(|speed| *speed != 0.0);
    match (turning, test.time.first()) {
        (Some(last), Some(first)) if last + 1 < test.time.len() => {
            test.between(*first, test.time[last] - settling_time)
        }
        _ => test.clone(),
    }
}

#[cfg(test)]
#[path = "../tests/unit/signals.rs"]
mod tests;
