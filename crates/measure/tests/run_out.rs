//! The growth of the disturbance once a turn: a run-out is there at rest too, an unbalance is not, and nobody may know which.

use crate::synthetic::rig::{Random, SpinUp};
use measure::shaft::Shaft;
use measure::torque_sensor::{Inversion, Sensor, Torque, invert};
use statistics::uncertain::Uncertain;
use std::f64::consts::TAU;

const INTERVAL: f64 = 0.002;
const RELEASE: f64 = 1.2;
/// Deceleration after the release, rad/s².
const COASTING: f64 = 75.0;
const AMPLITUDE: f64 = 4.0;

/// Rest, spin-up within 40 ms, hold, coasting down, rest: the truth at equal times.
struct Test {
    reading: Vec<f64>,
    truth: Vec<f64>,
    angle: Vec<f64>,
    speed: Vec<f64>,
    sensor: Sensor,
    spin: SpinUp,
    zero: f64,
}

fn measured(arm: f64, seed: u64, power: f64, until: f64) -> Test {
    let mut random = Random::new(seed + 300);
    let spin = SpinUp::to_150(0.3 + INTERVAL * random.uniform(), 0.04, 7_200.0);
    let start = TAU * random.uniform();
    let stop = RELEASE + 150.0 / COASTING;
    let speed = |t: f64| spin.speed(t) - COASTING * (t.min(stop) - RELEASE).max(0.0);
    let angle = |t: f64| {
        spin.angle(t.min(stop)) - 0.5 * COASTING * (t.min(stop) - RELEASE).max(0.0).powi(2)
    };
    let torque = |t: f64| {
        let since = t - spin.engaged;
        if since <= 0.0 {
            return 0.0;
        }
        let turns = 0.4 * spin.angle(t) / TAU;
        let grease = (1.0 - 0.7 * (-turns / 0.5).exp()) * (0.75 + 0.25 * (-since / 1.5).exp());
        let fades = (speed(t) / 0.1).tanh();
        (3.0 + 22.0 * (speed(t).max(2.0) / 150.0).powf(2.0 / 3.0)) * grease * fades
            - 12.9 / 11_500.0 * spin.acceleration(t)
    };
    let run_out = |t: f64| {
        let growth = if power == 0.0 {
            1.0
        } else {
            (speed(t).max(0.0) / 150.0).powf(power)
        };
        AMPLITUDE * growth * (start + angle(t)).cos()
    };
    let zero = 0.5 * random.normal();
    let omega = TAU * arm;
    let count = (until / INTERVAL) as usize;
    let fine = 40;
    let h = INTERVAL / f64::from(fine);
    let (mut y, mut v) = (run_out(0.0), 0.0);
    let noise = random.coloured(count, 0.15, 0.5);
    let mut reading = Vec::new();
    for (k, noise) in noise.iter().enumerate() {
        reading.push(y + zero + noise);
        for i in 0..fine {
            // Verlet's way: frequency wrong by (ω h)²/24, 1e-5 here
            let t = k as f64 * INTERVAL + (f64::from(i) + 0.5) * h;
            let half = y + 0.5 * h * v;
            v += h * (omega * omega * (torque(t) + run_out(t) - half) - 2.0 * 39.1 * v);
            y = half + 0.5 * h * v;
        }
    }
    let times: Vec<f64> = (0..count).map(|k| k as f64 * INTERVAL).collect();
    Test {
        reading,
        truth: times.iter().map(|&t| torque(t)).collect(),
        // a wheel knows no angle at rest better than its marks
        angle: times
            .iter()
            .map(|&t| angle(t) + 0.005 * random.normal())
            .collect(),
        speed: times.iter().map(|&t| speed(t).max(0.0)).collect(),
        sensor: Sensor {
            frequency: Uncertain::new(arm, 0.003 * arm),
            damping_ratio: Uncertain::new(39.1 / omega, 0.01 * 39.1 / omega),
        },
        spin,
        zero,
    }
}

impl Test {
    fn inverted(&self, power: Option<f64>, zero: f64) -> Torque {
        let instant = |time: f64| Some(Uncertain::new(time, 1e-4));
        invert(&Inversion {
            sensor: self.sensor,
            first: 0.0,
            interval: INTERVAL,
            reading: &self.reading,
            clipped: &[],
            shaft: Some(Shaft {
                first: 0.0,
                interval: INTERVAL,
                angle: &self.angle,
                speed: &self.speed,
                speed_deviation: &[],
            }),
            engagement: instant(self.spin.engaged),
            lock: instant(self.spin.engaged + self.spin.duration),
            zero: Uncertain::new(0.0, zero),
            scale_deviation: 0.005,
            disturbance_power: power,
        })
        .expect("a sound test inverts")
    }

    /// Which part of the test a value belongs to.
    fn part(&self, k: usize) -> Option<usize> {
        let since = k as f64 * INTERVAL - self.spin.engaged;
        match (since, self.speed[k]) {
            (since, _) if since < 0.0 => None,
            (since, _) if since < 0.05 => Some(0),
            (since, _) if since + self.spin.engaged < RELEASE => Some(1),
            (_, speed) if speed > 3.0 => Some(2),
            _ => Some(3),
        }
    }
}

const PARTS: [&str; 4] = ["change", "hold", "coasting", "end"];

/// Values inside two deviations, values, and sum of squared errors, by part; zeros inside theirs, and how many; powers found.
type Covered = ([(usize, usize, f64); 4], (usize, usize), Vec<f64>);

fn covered(arm: f64, power: f64, seeds: std::ops::Range<u64>, stated: bool, until: f64) -> Covered {
    let mut parts = [(0, 0, 0.0); 4];
    let mut zeros = (0, 0);
    let mut powers = Vec::new();
    for seed in seeds {
        let test = measured(arm, seed, power, until);
        let zero = if seed % 2 == 0 { 0.5 } else { 50.0 };
        let found = test.inverted(stated.then_some(power), zero);
        for (k, truth) in test.truth.iter().enumerate() {
            let error = found.torque[k] - truth;
            if let Some(part) = test.part(k) {
                let (inside, count, squares) = &mut parts[part];
                *inside += usize::from(error.abs() <= 2.0 * found.deviation[k]);
                *count += 1;
                *squares += error * error;
            }
        }
        let away = (found.zero.value - test.zero).abs();
        zeros.0 += usize::from(away <= 2.0 * found.zero.deviation);
        zeros.1 += 1;
        powers.push(found.disturbance_power);
    }
    (parts, zeros, powers)
}

fn shown(name: &str, (parts, zeros, powers): &Covered) {
    print!("{name}: ");
    for ((inside, count, squares), part) in parts.iter().zip(PARTS).filter(|(p, _)| p.1 > 0) {
        print!(
            "{part} {:.3} rms {:.2}; ",
            *inside as f64 / *count as f64,
            (squares / *count as f64).sqrt()
        );
    }
    println!("zero {} of {}; powers {powers:?}", zeros.0, zeros.1);
}

#[test]
fn the_band_holds_the_torque_whatever_the_disturbance_grows_with() {
    let seeds = (std::env::var("AUXBEAR_SEEDS").ok())
        .and_then(|text| text.parse().ok())
        .unwrap_or(4);
    for power in [0.0, 1.0, 2.0] {
        for stated in [true, false] {
            let mut sum = [(0, 0); 4];
            for arm in [10.0, 30.0, 60.0] {
                let found = covered(arm, power, 0..seeds, stated, 3.5);
                shown(&format!("power {power}, {arm} Hz, stated {stated}"), &found);
                for (all, part) in sum.iter_mut().zip(&found.0) {
                    all.0 += part.0;
                    all.1 += part.1;
                }
            }
            for ((inside, count), part) in sum.iter().zip(PARTS) {
                let share = *inside as f64 / *count as f64;
                // few seeds, whose errors last for a good part of a record
                assert!(
                    share >= 0.90,
                    "power {power}, stated {stated}, {part}: {share}"
                );
            }
        }
    }
}

#[test]
fn a_record_without_coasting_leaves_the_growth_open() {
    for power in [0.0, 2.0] {
        let mut sum = [(0, 0); 4];
        for arm in [10.0, 30.0, 60.0] {
            let found = covered(arm, power, 0..10, false, 1.1);
            shown(&format!("no coasting, power {power}, {arm} Hz"), &found);
            for (all, part) in sum.iter_mut().zip(&found.0) {
                all.0 += part.0;
                all.1 += part.1;
            }
        }
        let inside: usize = sum.iter().map(|s| s.0).sum();
        let count: usize = sum.iter().map(|s| s.1).sum();
        assert!(
            inside as f64 >= 0.9 * count as f64,
            "power {power}: {sum:?}"
        );
    }
}
