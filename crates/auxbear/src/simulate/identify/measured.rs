//! From what the signals of a test hold to what the estimators of the bearing take.

use super::super::signals;
use identify::{CageTrace, Measurement};
use measure::uncertain::Uncertain;

/// Most times of a measurement: beyond, neighbours tell nothing new.
const MOST_TIMES: usize = 20_000;
/// Correlation of a smooth random curve is gone after so many times the ratio of its deviation to that of its rate.
const INDEPENDENT: f64 = 2.0;
/// Covariance of angle, speed and acceleration of a shaft that shows no pulse: 0.01 rad/s, 1 rad/s².
const AT_REST: [[f64; 3]; 3] = [[1e-4, 0.0, 0.0], [0.0, 1e-4, 0.0], [0.0, 0.0, 1.0]];
/// Least deviation of a torque over that of the zero or of the noise.
const LEAST_DEVIATION: f64 = 0.02;
/// Time after the last pulse until the shaft rests and the arm has settled, s, and the least time of rest behind it, s.
const SETTLING: f64 = 0.5;
const LEAST_REST: f64 = 0.5;
/// Parts into which that rest is cut.
const PARTS: usize = 8;
/// Part of the largest speed below which the scale of the torque is not looked at.
const TURNING: f64 = 0.05;

/// One test as the estimators take it. The reason where a signal is missing.
pub(super) fn measurement(
    name: &str,
    load: f64,
    found: &signals::Found,
    scale_deviation: f64,
) -> Result<Measurement, String> {
    let lacks = |part: &'static str| format!("no {part}: {}", found.why(part, true));
    let shaft = found.shaft.as_ref().ok_or_else(|| lacks("speed"))?;
    let torque = found.torque.as_ref().ok_or_else(|| lacks("torque"))?;
    let torque = torque.torque.as_ref().ok_or(
        "the sensor's frequency and damping are needed to take its swing out of the reading",
    )?;
    let step = torque.time.len().div_ceil(MOST_TIMES).max(1);
    let thinned = |list: &[f64]| list.iter().copied().step_by(step).collect::<Vec<f64>>();
    let time = thinned(&torque.time);
    let mut motion: Vec<_> = time.iter().map(|time| shaft.speed.at(*time)).collect();
    let change = shaft.speed.change.filter(|change| change.from_rest);
    let last = shaft.speed.range().1;
    let from = change.map_or(f64::NEG_INFINITY, |change| change.engagement.0);
    // before its engagement from rest the shaft rests, and behind its last pulse where others would have come at its last speed;
    // there it may still turn by less than a mark
    let (ending, braking) = {
        let end = shaft.speed.at(last);
        (end.speed, end.acceleration)
    };
    let silence = time.last().map_or(0.0, |end| end - last);
    let stops = silence * ending.abs() > signals::shaft::SILENT_MARKS * shaft.pulses.pitch();
    let until = if stops { last } else { f64::INFINITY };
    for (motion, time) in motion.iter_mut().zip(&time) {
        if *time < from || *time > until {
            (motion.speed, motion.acceleration) = (0.0, 0.0);
            motion.covariance = AT_REST;
            if (last..last + SETTLING).contains(time) {
                motion.covariance[1][1] += ending * ending;
                motion.covariance[2][2] += braking * braking;
            }
        }
    }
    let mut values = thinned(&torque.torque);
    let mut zero_deviation = torque.zero.deviation;
    let mut torque_deviation = thinned(&torque.deviation);
    // where the zero was not seen before the test it is seen behind it, once the shaft rests
    if change.is_none()
        && stops
        && let Some(zero) = zero_at_rest(&time, &values, last)
    {
        for (value, deviation) in values.iter_mut().zip(&mut torque_deviation) {
            *value -= zero.value;
            let noise = (deviation.powi(2) - zero_deviation.powi(2)).max(0.0);
            *deviation = noise.sqrt().hypot(zero.deviation);
        }
        zero_deviation = zero.deviation;
    }
    // a torque that is zero by definition is not more certain than the data around it
    let floor = LEAST_DEVIATION * torque.zero.deviation.max(torque.noise);
    for deviation in &mut torque_deviation {
        *deviation = deviation.max(floor);
    }
    Ok(Measurement {
        name: name.to_string(),
        load,
        speed: motion.iter().map(|m| m.speed).collect(),
        speed_deviation: motion.iter().map(|m| m.speed_uncertainty()).collect(),
        acceleration: motion.iter().map(|m| m.acceleration).collect(),
        acceleration_deviation: motion
            .iter()
            .map(|m| m.acceleration_uncertainty())
            .collect(),
        torque: values,
        torque_deviation,
        zero_deviation,
        scale_deviation,
        correlation_time: correlation_time(torque, shaft.fastest.speed.abs(), shaft),
        engagement: shaft.speed.change.map(|change| change.engagement.0),
        cage: (found.cage.as_ref())
            .map(|found| cage(found, change.map(|change| change.engagement.0))),
        temperature: found.temperature.as_ref().map(|found| found.rise(&time)),
        time,
    })
}

/// Reading of the torque while the shaft rests behind its last pulse, s: none where it does not rest long enough.
fn zero_at_rest(time: &[f64], torque: &[f64], last_pulse: f64) -> Option<Uncertain> {
    let from = time.partition_point(|time| *time < last_pulse + SETTLING);
    let rest = torque.get(from..)?;
    let length = time.last()? - time.get(from)?;
    if length < LEAST_REST || rest.len() < PARTS {
        return None;
    }
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let parts: Vec<f64> = rest.chunks(rest.len().div_ceil(PARTS)).map(mean).collect();
    let zero = mean(&parts);
    let square = parts.iter().map(|part| (part - zero).powi(2)).sum::<f64>();
    let count = parts.len() as f64;
    // the parts are alike to some degree: their scatter itself, not that of their mean
    Some(Uncertain::new(zero, (square / (count - 1.0)).sqrt()))
}

/// The speed of the cage; from the engagement on, where the first ball had not passed yet and the cage rose from rest.
fn cage(found: &signals::cage::Found, engagement: Option<f64>) -> CageTrace {
    let found = &found.cage;
    let mut trace = CageTrace {
        time: found.time.clone(),
        speed: found.speed.clone(),
        deviation: found.deviation.clone(),
    };
    if let (Some(engagement), Some(first)) = (engagement, trace.time.first().copied())
        && engagement < first
    {
        let speed = trace.speed[0];
        trace.time.insert(0, engagement);
        trace.speed.insert(0, 0.0);
        // straight between is what is assumed: by as much as a rise with the square of time differs from it
        let deviation = trace.deviation[0].hypot(0.25 * speed.abs());
        trace.deviation[0] = deviation;
        trace.deviation.insert(0, deviation);
    }
    trace
}

/// Time after which two errors of the torque are independent, s: the median ratio of its deviation by noise to that of its
/// rate while the shaft turns, as of a smooth random curve.
fn correlation_time(
    torque: &measure::torque_sensor::Torque,
    fastest: f64,
    shaft: &signals::shaft::Found,
) -> f64 {
    let turning = |time: f64| shaft.speed.at(time).speed.abs() > TURNING * fastest;
    let count = torque.time.len();
    let step = (count / 500).max(1);
    let mut ratios: Vec<f64> = (0..count)
        .step_by(step)
        .filter(|k| turning(torque.time[*k]))
        .map(|k| {
            let noise = torque.deviation[k].powi(2) - torque.zero.deviation.powi(2);
            noise.max(0.0).sqrt() / torque.rate_deviation[k]
        })
        .filter(|ratio| ratio.is_finite())
        .collect();
    ratios.sort_by(f64::total_cmp);
    let median = ratios.get(ratios.len() / 2).copied().unwrap_or(0.0);
    let interval = if count > 1 {
        (torque.time[count - 1] - torque.time[0]) / (count - 1) as f64
    } else {
        0.0
    };
    INDEPENDENT * median.max(interval)
}
