//! What a torque sensor of another frequency would give: the picture before the arm is made.

use super::input::Inversion;
use super::inversion::invert;
use super::{Sensor, Swing, chain};
use crate::shaft::Shaft;
use statistics::random::Random;
use statistics::uncertain::Uncertain;
use std::f64::consts::TAU;

/// The test for which a sensor is to be chosen.
#[derive(Clone, Copy, Debug)]
pub struct Design<'a> {
    /// Interval between readings, s.
    pub interval: f64,
    /// Torque that is expected, from the engagement on, one value an interval; at least 16 values.
    pub torque: &'a [f64],
    /// Shaft angle at the same times, rad.
    pub angle: &'a [f64],
    /// Shaft speed at the same times, rad/s.
    pub speed: &'a [f64],
    /// Rest before the engagement, s.
    pub rest: f64,
    /// Noise of one reading, rms, unit of the torque.
    pub noise: f64,
    /// Amplitude of the order-1 disturbance at the highest speed, unit of the torque.
    pub disturbance: f64,
    /// Decay of the sensor's swing ζω, 1/s; the same for every frequency.
    pub decay: f64,
    /// Errors are judged up to this time after the engagement, s.
    pub until: f64,
    /// Number of repetitions with other noise whose errors are averaged; at least 1.
    pub repetitions: usize,
}

/// Error of the torque with a sensor of one frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignError {
    /// Frequency of the sensor, Hz.
    pub frequency: f64,
    /// Reading minus torque, rms.
    pub raw: f64,
    /// Inverted reading minus torque, rms.
    pub inverted: f64,
}

/// Error of the torque over the frequency of the sensor, Hz, raw and inverted, by simulated tests with a linear sensor that is
/// known exactly.
///
/// An overdamped frequency (decay above ω) is simulated as it is. The error names what is wrong with the design.
pub fn design_error(design: &Design, frequencies: &[f64]) -> Result<Vec<DesignError>, String> {
    let count = design.torque.len();
    if count < 16 {
        return Err(format!(
            "the expected test has {count} torques; at least 16 are needed"
        ));
    }
    if design.angle.len() != count || design.speed.len() != count {
        return Err(
            "torque, angle and speed of the expected test must be at the same times".into(),
        );
    }
    if design
        .torque
        .iter()
        .chain(design.angle)
        .chain(design.speed)
        .any(|v| !v.is_finite())
    {
        return Err("the expected test must be finite".into());
    }
    if !(design.interval > 0.0
        && design.rest >= 0.0
        && design.noise > 0.0
        && design.decay > 0.0
        && design.until > 0.0)
    {
        return Err("interval, noise, decay and time must be positive".into());
    }
    let rest = ((design.rest / design.interval) as usize).min(1_000_000);
    let mut angle = vec![design.angle.first().copied().unwrap_or(0.0); rest];
    let mut speed = vec![0.0; rest];
    angle.extend(design.angle);
    speed.extend(design.speed);
    let knot = rest as f64 * design.interval;
    let fastest = design.speed.iter().fold(0.0_f64, |top, v| top.max(v.abs()));
    let judged = ((design.until / design.interval) as usize + 1).min(count);
    let shaft = Shaft {
        first: 0.0,
        interval: design.interval,
        angle: &angle,
        speed: &speed,
        speed_deviation: &[],
    };
    let mut errors = Vec::with_capacity(frequencies.len());
    for &frequency in frequencies {
        let omega = TAU * frequency;
        if !(omega > 0.0 && omega.is_finite()) {
            return Err("a frequency of the sensor must be positive and finite".into());
        }
        let zeta = design.decay / omega;
        let swing = Swing { omega, zeta };
        let exact = chain::reading_of(swing, design.interval, design.torque, |place| {
            let k = (place as usize).min(count.saturating_sub(2));
            let part = place - k as f64;
            let between = |list: &[f64]| list[k] + part * (list[k + 1] - list[k]);
            let growth = if fastest > 0.0 {
                (between(design.speed) / fastest).powi(2)
            } else {
                0.0
            };
            design.disturbance * growth * between(design.angle).cos()
        });
        let (mut raw, mut readings) = (0.0, 0.0);
        let (mut inverted, mut judgements) = (0.0, 0.0);
        for repetition in 0..design.repetitions.max(1) {
            let mut noise = Random::new(repetition as u64 + 1);
            let mut reading: Vec<f64> = (0..rest).map(|_| design.noise * noise.normal()).collect();
            reading.extend(exact.iter().map(|y| y + design.noise * noise.normal()));
            let found = invert(&Inversion {
                sensor: Sensor {
                    frequency: Uncertain::exact(frequency),
                    damping_ratio: Uncertain::exact(zeta),
                },
                first: 0.0,
                interval: design.interval,
                reading: &reading,
                clipped: &[],
                shaft: (design.disturbance != 0.0).then_some(shaft),
                engagement: (rest > 0).then_some(Uncertain::exact(knot)),
                lock: None,
                zero: Uncertain::new(0.0, if rest > 0 { 10.0 * design.noise } else { 0.0 }),
                scale_deviation: 0.0,
                disturbance_power: Some(2.0),
            })?;
            for k in 1..judged {
                raw += (reading[rest + k] - design.torque[k]).powi(2);
                readings += 1.0;
            }
            for (&time, &torque) in found.time.iter().zip(&found.torque) {
                let place = (time - knot) / design.interval;
                if place > 0.0 && place < (judged - 1) as f64 {
                    let (k, part) = (place as usize, place.fract());
                    let truth = design.torque[k] + part * (design.torque[k + 1] - design.torque[k]);
                    inverted += (torque - truth).powi(2);
                    judgements += 1.0;
                }
            }
        }
        let rms = |sum: f64, count: f64| (sum / count.max(1.0)).sqrt();
        errors.push(DesignError {
            frequency,
            raw: rms(raw, readings),
            inverted: rms(inverted, judgements),
        });
    }
    Ok(errors)
}
