//! A quick change in a record of ten seconds is found as well as in a short one.

use crate::synthetic::wheel::Random;
use measure::pulse::{Flank, Wheel, calibrate, edges, number};
use measure::speed::{SpeedSettings, smooth};
use std::f64::consts::{PI, TAU};

const MARKS: usize = 60;
const FULL: f64 = 150.0;

/// A spin-up from rest to 150 rad/s.
struct SpinUp {
    engage: f64,
    length: f64,
    /// Speed and angle at equal parts of the length, over speed and speed times length at its end.
    speed: Vec<f64>,
    angle: Vec<f64>,
    peak: f64,
}

impl SpinUp {
    /// `shape`: acceleration over the part of the length.
    fn new(engage: f64, length: f64, shape: impl Fn(f64) -> f64) -> SpinUp {
        const STEPS: usize = 20_000;
        let (mut speed, mut angle, mut top) = (vec![0.0], vec![0.0], 0.0f64);
        for k in 0..STEPS {
            let part = 1.0 / STEPS as f64;
            let a = shape((k as f64 + 0.5) * part);
            let v = speed[k];
            angle.push(angle[k] + (v + 0.5 * a * part) * part);
            speed.push(v + a * part);
            top = top.max(a);
        }
        let scale = FULL / speed[STEPS];
        angle.iter_mut().for_each(|x| *x *= scale * length);
        SpinUp {
            engage,
            length,
            peak: top * scale / length,
            speed,
            angle,
        }
    }

    fn angle(&self, time: f64) -> f64 {
        let steps = self.speed.len() - 1;
        let place = ((time - self.engage) / self.length).clamp(0.0, 1.0) * steps as f64;
        let k = (place as usize).min(steps - 1);
        let inside = self.angle[k] + (place - k as f64) * (self.angle[k + 1] - self.angle[k]);
        inside + FULL * (time - self.engage - self.length).max(0.0)
    }
}

/// Error of the peak of the acceleration as a part of it, and pulses between the knots. The marks' places are off by 0.3 % of
/// the pitch.
fn found(truth: &SpinUp, rate: f64, seed: u64) -> (f64, usize) {
    let mut random = Random::new(seed);
    let errors: Vec<f64> = (0..MARKS).map(|_| 0.003 * random.normal()).collect();
    let samples: Vec<f64> = (0..(10.0 * rate) as usize)
        .map(|k| {
            let place = MARKS as f64 * truth.angle(k as f64 / rate) / TAU + 0.37;
            let off = errors[place as usize % MARKS];
            2.5 + 2.4 * (3.0 * (TAU * (place + off)).sin()).tanh() + 0.02 * random.normal()
        })
        .collect();
    let edges = edges(0.0, 1.0 / rate, &samples, Flank::Rising).unwrap();
    let wheel = Wheel {
        marks: MARKS,
        missing: 0,
    };
    let pulses = number(&edges, &wheel).unwrap();
    let pitch = calibrate(&pulses).ok();
    let speed = smooth(&pulses, pitch.as_ref(), &SpeedSettings::default()).unwrap();
    let top = (0..2000)
        .map(|k| truth.engage + truth.length * f64::from(k) / 2000.0)
        .map(|time| speed.at(time).acceleration)
        .fold(0.0, f64::max);
    (top / truth.peak - 1.0, speed.change.unwrap().pulses)
}

#[test]
fn a_quick_change_in_a_long_record() {
    let bell = |x: f64| (PI * x).sin().powi(2);
    // Quick rise, slow end: what is left after nine tenths of the speed is as fast a transient as what came before.
    let clutch = |x: f64| {
        if x < 0.025 {
            x / 0.025
        } else {
            (1.0 - (x - 0.025) / 0.975).powf(0.9)
        }
    };
    let mut errors = Vec::new();
    for (engage, length) in [(1.0, 0.025), (5.0, 0.04), (8.0, 0.03)] {
        let truths = [
            SpinUp::new(engage, length, bell),
            SpinUp::new(engage, length, clutch),
        ];
        for (shape, truth) in truths.iter().enumerate() {
            for rate in [10_500.0, 42_000.0] {
                let (error, pulses) = found(truth, rate, 3);
                println!("{engage} s, {length} s, shape {shape}, {rate}: {error:.4}, {pulses}");
                // Half of the change's angle at least: 0.5 rad/s · 150 · length · 60/2π pulses.
                assert!(
                    pulses as f64 > 0.5 * 0.5 * FULL * length * 60.0 / TAU,
                    "{pulses}"
                );
                // 3 % is promised of the median; a single record may be at one and a half of it.
                assert!(error.abs() < 0.045, "{error}");
                errors.push(error.abs());
            }
        }
    }
    errors.sort_by(f64::total_cmp);
    assert!(errors[errors.len() / 2] < 0.02, "{errors:?}");
}
