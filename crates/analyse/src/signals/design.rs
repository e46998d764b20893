//! What a torque sensor of another frequency would have made of the same test.

use crate::signals::shaft;
use measure::torque_sensor::{Design, DesignError, Sensor, Torque, design_error};
use scenario::TorqueSignal;
use statistics::interpolation::held;
use std::f64::consts::TAU;

/// Frequencies that are compared, Hz.
const FREQUENCIES: [f64; 11] = [
    5.0, 8.0, 12.0, 18.0, 25.0, 35.0, 50.0, 70.0, 100.0, 150.0, 220.0,
];
/// A sensor must be sampled at least so many times a period.
const SAMPLES: f64 = 8.0;
/// Repetitions with other noise.
const REPETITIONS: usize = 2;
/// Rest before the engagement, over the time that is judged.
const REST: f64 = 0.5;

/// Error of the torque over the frequency of the sensor, for the torque and the motion that were found, with the noise, the
/// disturbance and the decay of the sensor there is.
pub(crate) fn errors(
    wish: &TorqueSignal,
    torque: Option<&Torque>,
    sensor: Option<Sensor>,
    shaft: Option<&shaft::Estimate>,
) -> Result<Vec<DesignError>, String> {
    let until = (wish.design_until)
        .ok_or_else(|| "signals.torque.design_until is not given".to_string())?;
    let (Some(torque), Some(sensor)) = (torque, sensor) else {
        return Err("the torque without the sensor's swing is not known".to_string());
    };
    let change = shaft.and_then(|shaft| shaft.speed.change.filter(|change| change.from_rest));
    let (Some(shaft), Some(change)) = (shaft, change) else {
        return Err("the shaft is not brought up from rest".to_string());
    };
    let (Some(first), Some(second)) = (torque.time.first(), torque.time.get(1)) else {
        return Err("the torque has no length".to_string());
    };
    let interval = second - first;
    let engagement = change.engagement.0;
    let count = (until / interval).ceil() as usize + 2;
    let times: Vec<f64> = (0..count)
        .map(|k| engagement + k as f64 * interval)
        .collect();
    if times.last() > torque.time.last() {
        return Err("the record ends before signals.torque.design_until".to_string());
    }
    let motions: Vec<_> = times.iter().map(|time| shaft.speed.at(*time)).collect();
    let expected: Vec<f64> = (times.iter())
        .map(|time| held(&torque.time, &torque.torque, *time))
        .collect();
    if expected.iter().any(|value| value.is_nan()) {
        return Err("the torque is unknown where the reading is clipped".to_string());
    }
    let disturbance = torque.disturbance.iter().fold(0.0_f64, |a, b| a.max(*b));
    let possible: Vec<f64> = (FREQUENCIES.into_iter())
        .filter(|frequency| frequency * interval * SAMPLES < 1.0)
        .collect();
    design_error(
        &Design {
            interval,
            torque: &expected,
            angle: &motions.iter().map(|m| m.angle).collect::<Vec<_>>(),
            speed: &motions.iter().map(|m| m.speed).collect::<Vec<_>>(),
            rest: REST * until,
            noise: torque.noise,
            disturbance,
            decay: sensor.damping_ratio.value * TAU * sensor.frequency.value,
            until,
            repetitions: REPETITIONS,
        },
        &possible,
    )
}
