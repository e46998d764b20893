//! Pickups whose pulses are not square, and pickups that fall silent.

#[path = "synthetic/wheel.rs"]
mod synthetic;

use measure::pulse::{EdgeSettings, Pulses, Wheel, calibrate, edges, number};
use measure::speed::{Speed, SpeedSettings, smooth};
use std::f64::consts::TAU;
use synthetic::Random;

const STEP: f64 = 1e-5;
const RATE: f64 = 20_000.0;

/// Rest, a clutch whose torque rises evenly to the lock at 150 rad/s, running, and a coast to rest.
struct Motion {
    angle: Vec<f64>,
    speed: Vec<f64>,
    acceleration: Vec<f64>,
    engage: f64,
    lock: f64,
    release: f64,
    stop: f64,
}

const TOP: f64 = 11_500.0;

fn motion(engage: f64) -> Motion {
    let (lock, release) = (engage + 300.0 / TOP, engage + 1.5);
    let (mut angle, mut speed) = (0.0, 0.0);
    let mut all = Motion {
        angle: Vec::new(),
        speed: Vec::new(),
        acceleration: Vec::new(),
        engage,
        lock,
        release,
        stop: f64::INFINITY,
    };
    for k in 0.. {
        let time = k as f64 * STEP;
        if time > all.stop + 0.3 {
            break;
        }
        // At the middle of the step, so that sums are the trapezoidal rule's.
        let at = |time: f64, speed: f64| match time {
            t if t < engage => 0.0,
            t if t < lock => TOP * (t - engage) / (lock - engage),
            t if t < release => -2.0,
            _ if speed > 0.0 => -(25.0 + 0.2 * speed),
            _ => 0.0,
        };
        all.angle.push(angle);
        all.speed.push(speed);
        all.acceleration.push(at(time, speed));
        let a = at(time + 0.5 * STEP, speed);
        angle += STEP * (speed + 0.5 * STEP * a);
        speed = (speed + STEP * a).max(0.0);
        if time > release && speed == 0.0 && all.stop.is_infinite() {
            all.stop = time;
        }
    }
    all
}

impl Motion {
    fn of(&self, values: &[f64], time: f64) -> f64 {
        let place = (time / STEP).max(0.0);
        let k = (place as usize).min(values.len() - 2);
        values[k] + (place - k as f64) * (values[k + 1] - values[k])
    }

    fn end(&self) -> f64 {
        STEP * (self.angle.len() - 2) as f64
    }

    /// What a pickup shows of it, with the share of a mark that it turned, its speed and the time.
    fn seen(&self, noise: f64, seed: u64, pickup: impl Fn(f64, f64, f64) -> f64) -> Vec<f64> {
        let mut random = Random::new(seed);
        let phase = random.between(0.0, TAU);
        (0..(self.end() * RATE) as usize)
            .map(|k| {
                let time = k as f64 / RATE;
                let turned = 60.0 * self.of(&self.angle, time) + phase;
                pickup(turned, self.of(&self.speed, time), time) + noise * random.normal()
            })
            .collect()
    }
}

fn found(samples: &[f64]) -> Result<(Pulses, Speed), String> {
    let wheel = Wheel {
        marks: 60,
        missing: 0,
    };
    let edges = edges(0.0, RATE.recip(), samples, &EdgeSettings::default());
    let pulses = number(&edges.map_err(|why| why.to_string())?, &wheel);
    let pulses = pulses.map_err(|why| why.to_string())?;
    let pitch = calibrate(&pulses).ok();
    let speed = smooth(&pulses, pitch.as_ref(), &SpeedSettings::default());
    Ok((pulses, speed.map_err(|why| why.to_string())?))
}

/// Shares of an interval in which the bands of two deviations hold speed and acceleration, and the largest error over its deviation.
fn held(truth: &Motion, speed: &Speed, from: f64, to: f64) -> ([f64; 2], [f64; 2]) {
    let (mut inside, mut worst) = ([0.0; 2], [0.0f64; 2]);
    const LOOKS: usize = 400;
    for k in 0..LOOKS {
        let time = from + (to - from) * (k as f64 + 0.5) / LOOKS as f64;
        let got = speed.at(time);
        let errors = [
            (got.speed - truth.of(&truth.speed, time)) / got.speed_uncertainty(),
            (got.acceleration - truth.of(&truth.acceleration, time))
                / got.acceleration_uncertainty(),
        ];
        for i in 0..2 {
            inside[i] += f64::from(u8::from(errors[i].abs() < 2.0)) / LOOKS as f64;
            worst[i] = worst[i].max(errors[i].abs());
        }
    }
    (inside, worst)
}

fn report(name: &str, truth: &Motion, samples: &[f64]) {
    match found(samples) {
        Err(why) => println!("{name}: REFUSED {why}"),
        Ok((pulses, speed)) => {
            let z = |(value, deviation): (f64, f64), truth: f64| {
                format!(
                    "{:.5}±{:.1e} (z {:.1})",
                    value,
                    deviation,
                    (value - truth) / deviation
                )
            };
            let change = speed.change.as_ref();
            print!("{name}: {} pulses;", pulses.times.len());
            if let Some(change) = change {
                print!(" engage {}", z(change.engagement, truth.engage));
                if let Some(end) = change.end {
                    print!(" lock {}", z(end, truth.lock));
                }
            }
            println!(
                " timing {:.2} angle {:.1e}",
                speed.timing_factor, speed.angle_noise
            );
            let (a, b) = (truth.lock - truth.engage, truth.stop - truth.release);
            for (phase, from, to) in [
                ("change", truth.engage, truth.lock - 1e-4),
                ("settle", truth.lock + 1e-4, truth.lock + 3.0 * a),
                ("hold", truth.lock + 3.0 * a, truth.release - 0.02),
                ("corner", truth.release - 0.02, truth.release + 0.02),
                ("coast", truth.release + 0.02, truth.stop - 0.2 * b),
                ("creep", truth.stop - 0.2 * b, truth.stop + 0.02),
            ] {
                let (inside, worst) = held(truth, &speed, from, to);
                print!(
                    "   {phase} {:.0}/{:.0}% ({:.1}/{:.1})",
                    100.0 * inside[0],
                    100.0 * inside[1],
                    worst[0],
                    worst[1]
                );
            }
            println!();
            for note in &speed.notes {
                println!("      - {note}");
            }
        }
    }
}

fn edges_of(name: &str, truth: &Motion, samples: &[f64], seed: u64) {
    let phase = Random::new(seed).between(0.0, TAU);
    let e = edges(0.0, RATE.recip(), samples, &EdgeSettings::default()).unwrap();
    println!("{name}: {} edges, unseen {:.2}", e.times.len(), e.unseen);
    let mut bins: Vec<(String, Vec<(f64, f64)>)> = vec![];
    for (k, (t, u)) in e.times.iter().zip(&e.uncertainties).enumerate() {
        let turned = 60.0 * truth.of(&truth.angle, *t) + phase;
        let off = (turned / TAU).round() * TAU - turned;
        let w = truth.of(&truth.speed, *t).max(1e-3);
        let error = -off / 60.0 / w;
        let bin = if k < 6 {
            format!("first{k}")
        } else if k + 6 > e.times.len() {
            format!("last{}", e.times.len() - k)
        } else if *t < truth.lock {
            "change".into()
        } else if *t < truth.release {
            "hold".into()
        } else {
            format!("coast{:.0}", (w / 30.0).floor() * 30.0)
        };
        match bins.iter_mut().find(|b| b.0 == bin) {
            Some(b) => b.1.push((error, *u)),
            None => bins.push((bin, vec![(error, *u)])),
        }
    }
    for (bin, all) in bins {
        let n = all.len() as f64;
        let mean = all.iter().map(|e| e.0).sum::<f64>() / n;
        let rms = (all.iter().map(|e| e.0.powi(2)).sum::<f64>() / n).sqrt();
        let z = (all.iter().map(|e| (e.0 / e.1).powi(2)).sum::<f64>() / n).sqrt();
        println!(
            "    {bin} n {n} mean {:.2} rms {:.2} us, stated {:.2} us, z {:.2}",
            1e6 * mean,
            1e6 * rms,
            1e6 * all[all.len() / 2].1,
            z
        );
    }
}

#[test]
fn explore() {
    let seeds: u64 = std::env::var("SEEDS")
        .ok()
        .and_then(|s| s.parse().ok())
        .unwrap_or(2);
    let which = std::env::var("WHICH").unwrap_or_default();
    for seed in 0..seeds {
        let truth = motion(0.2 + 0.001 * seed as f64);
        let sine = |turned: f64| turned.sin();
        let light = |turned: f64| 5.0 / (1.0 + (-turned.sin() / 0.15).exp());
        let end = truth.end();
        let mut all: Vec<(&str, Vec<f64>)> = vec![
            ("light", truth.seen(0.02, seed, |x, _, _| light(x))),
            ("sine", truth.seen(0.02, seed, |x, _, _| 5.0 * sine(x))),
            (
                "vr",
                truth.seen(0.01, seed, |x, w, _| 5.0 * w / 150.0 * sine(x)),
            ),
            (
                "vrnoisy",
                truth.seen(0.15, seed, |x, w, _| 5.0 * w / 150.0 * sine(x)),
            ),
            (
                "vrsat",
                truth.seen(0.01, seed, |x, w, _| {
                    (20.0 * w / 150.0 * sine(x)).clamp(-5.0, 5.0)
                }),
            ),
            (
                "fade",
                truth.seen(0.02, seed, |x, _, t| light(x) * (1.0 - 0.7 * t / end)),
            ),
        ];
        let square = truth.seen(0.02, seed, |x, _, _| light(x));
        for (name, from, length) in [
            ("hold50", 0.8, 0.05),
            ("hold300", 0.8, 0.3),
            ("hold1000", 0.5, 1.0),
            ("coast60", 2.5, 0.06),
            ("coast300", 2.5, 0.3),
            ("release800", 1.5, 0.8),
            ("change5", 0.212, 0.005),
            ("dead", 0.9, 99.0),
        ] {
            for nan in [false, true] {
                let mut samples = square.clone();
                let a = (from * RATE) as usize;
                let b = (((from + length) * RATE) as usize).min(samples.len());
                for k in a..b {
                    samples[k] = if nan { f64::NAN } else { square[k % 3000] };
                }
                all.push((
                    Box::leak(format!("{name}{}", if nan { "n" } else { "" }).into_boxed_str()),
                    samples,
                ));
            }
        }
        for (name, samples) in &all {
            if which.is_empty() || which.split(',').any(|w| name.contains(w)) {
                if std::env::var("EDGES").is_ok() {
                    edges_of(name, &truth, samples, seed);
                }
                report(&format!("{name} {seed}"), &truth, samples);
            }
        }
    }
}
