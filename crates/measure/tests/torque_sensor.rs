//! Torque from the reading of a sensor that swings, against synthetic truth.

use crate::synthetic::rig::{Random, SpinUp, median};
use measure::shaft::Shaft;
use measure::torque_sensor::{Clipped, Design, Inversion, Sensor, design_error, invert};
use statistics::uncertain::Uncertain;
use std::f64::consts::TAU;

const INTERVAL: f64 = 0.002;

/// Duration and peak acceleration of the three spin-ups to 150 rad/s, s and rad/s².
const FAST: (f64, f64) = (0.025, 11_500.0);
const MIDDLE: (f64, f64) = (0.04, 7_200.0);
const SLOW: (f64, f64) = (0.223, 1_300.0);

/// What the sensor reads, and the truth at the same times.
struct Test {
    reading: Vec<f64>,
    truth: Vec<f64>,
    angle: Vec<f64>,
    speed: Vec<f64>,
    sensor: Sensor,
    engagement: Uncertain,
}

/// Sensor with a stiffness that grows or falls by 1.3 % rms at 40 N mm, noise of two colours, jitter of the converter, a disturbance that grows
/// with Ω^1.5 and has a second order; frequency, damping, engagement and angle known with errors.
fn measured(arm: f64, seed: u64, spin: (f64, f64), mismatch: bool) -> Test {
    let (before, after) = (0.3, 0.6);
    let mut random = Random::new(seed);
    let (duration, peak) = spin;
    let spin = SpinUp::to_150(before + INTERVAL * random.uniform(), duration, peak);
    let (omega, decay) = (TAU * arm, 39.1);
    let phase = TAU * random.uniform();
    let hard = if mismatch {
        0.0128 * random.normal() / 1600.0
    } else {
        0.0
    };
    let count = ((before + after) / INTERVAL) as usize;
    let fine = 40;
    let h = INTERVAL / fine as f64;
    let force = |time: f64| {
        let theta = spin.angle(time) + phase;
        let part = spin.speed(time) / 150.0;
        let second = if mismatch {
            0.3 * (2.0 * theta).cos() * part
        } else {
            0.0
        };
        spin.torque(time) + 4.0 * part.powf(if mismatch { 1.5 } else { 2.0 }) * theta.cos() + second
    };
    let rate = |time: f64, y: f64, v: f64| {
        omega * omega * (force(time) - y - hard * y * y * y) - 2.0 * decay * v
    };
    let (mut y, mut v) = (0.0, 0.0);
    let noise = if mismatch {
        random.coloured(count, 0.15, 0.5)
    } else {
        random.coloured(count, 0.0, 0.0)
    };
    let mut reading = Vec::new();
    let zero = 3.0 * random.normal();
    for (k, noise) in noise.iter().enumerate() {
        let jitter = if mismatch {
            20e-6 * random.normal()
        } else {
            0.0
        };
        let value = y + v * jitter + zero + noise;
        // 14 bits over ±100 N mm
        reading.push(if mismatch {
            (value / 0.0122).round() * 0.0122
        } else {
            value
        });
        for i in 0..fine {
            let time = (k * fine + i) as f64 * h;
            let (k1y, k1v) = (v, rate(time, y, v));
            let (k2y, k2v) = (
                v + 0.5 * h * k1v,
                rate(time + 0.5 * h, y + 0.5 * h * k1y, v + 0.5 * h * k1v),
            );
            let (k3y, k3v) = (
                v + 0.5 * h * k2v,
                rate(time + 0.5 * h, y + 0.5 * h * k2y, v + 0.5 * h * k2v),
            );
            let (k4y, k4v) = (v + h * k3v, rate(time + h, y + h * k3y, v + h * k3v));
            y += h / 6.0 * (k1y + 2.0 * k2y + 2.0 * k3y + k4y);
            v += h / 6.0 * (k1v + 2.0 * k2v + 2.0 * k3v + k4v);
        }
    }
    let times: Vec<f64> = (0..count).map(|k| k as f64 * INTERVAL).collect();
    let known_angle = if mismatch { 0.01 } else { 0.0 };
    let (known_f, known_zeta, known_time) = if mismatch {
        (0.005, 0.01, 0.0002)
    } else {
        (0.0, 0.0, 0.0)
    };
    let zeta = decay / omega;
    Test {
        reading,
        truth: times.iter().map(|&t| spin.torque(t)).collect(),
        angle: times
            .iter()
            .map(|&t| spin.angle(t) + known_angle * random.normal())
            .collect(),
        speed: times.iter().map(|&t| spin.speed(t)).collect(),
        sensor: Sensor {
            frequency: Uncertain::new(arm * (1.0 + known_f * random.normal()), arm * known_f),
            damping_ratio: Uncertain::new(
                zeta * (1.0 + known_zeta * random.normal()),
                zeta * known_zeta,
            ),
        },
        engagement: Uncertain::new(spin.engaged + known_time * random.normal(), known_time),
    }
}

impl Test {
    fn input(&self) -> Inversion<'_> {
        Inversion {
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
            engagement: Some(self.engagement),
            lock: None,
            zero: Uncertain::new(0.0, 100.0),
            // 1.3 % rms at 40 N mm are 0.5 % at 25 N mm.
            scale_deviation: 0.005,
            disturbance_power: None,
        }
    }
}

/// Errors of one test over the first 0.3 s, N mm rms, and how many of its values lie inside two deviations.
struct Score {
    raw: f64,
    error: f64,
    inside: usize,
    count: usize,
}

fn scored(arm: f64, seed: u64, spin: (f64, f64), mismatch: bool) -> Score {
    let test = measured(arm, seed, spin, mismatch);
    let torque = invert(&test.input()).expect("a sound test inverts");
    let mut score = Score {
        raw: 0.0,
        error: 0.0,
        inside: 0,
        count: 0,
    };
    for k in 0..test.truth.len() {
        let time = k as f64 * INTERVAL - test.engagement.value;
        if time > 0.0 && time < 0.3 {
            let error = torque.torque[k] - test.truth[k];
            score.raw += (test.reading[k] - torque.zero.value - test.truth[k]).powi(2);
            score.error += error * error;
            score.inside += usize::from(error.abs() <= 2.0 * torque.deviation[k]);
            score.count += 1;
        }
    }
    score.raw = (score.raw / score.count as f64).sqrt();
    score.error = (score.error / score.count as f64).sqrt();
    score
}

/// Scores of many seeds, on two threads.
fn scores(
    seeds: std::ops::Range<u64>,
    test: impl Fn(u64) -> (f64, (f64, f64)) + Sync,
) -> Vec<Score> {
    let middle = (seeds.start + seeds.end) / 2;
    let part = |range: std::ops::Range<u64>| {
        range
            .map(|seed| {
                let (arm, spin) = test(seed);
                scored(arm, seed, spin, true)
            })
            .collect::<Vec<_>>()
    };
    std::thread::scope(|scope| {
        let second = scope.spawn(|| part(middle..seeds.end));
        let mut all = part(seeds.start..middle);
        all.extend(second.join().expect("no panic"));
        all
    })
}

/// The published errors of the raw reading belong to a spin-up much like this one: within 0.6 N mm. Ours must be below what
/// unknown-input smoothing was found to reach.
#[test]
fn the_torque_is_found_to_better_than_the_stated_error() {
    for (arm, raw, limit) in [(10.0, 4.0, 1.6), (30.0, 5.6, 1.05), (60.0, 3.6, 0.95)] {
        let scores = scores(1000..1024, |_| (arm, FAST));
        let found = median(scores.iter().map(|s| s.error).collect());
        let found_raw = median(scores.iter().map(|s| s.raw).collect());
        println!("{arm} Hz: raw {found_raw:.2}, inverted {found:.2} N mm");
        assert!(found < limit, "{arm} Hz: {found}");
        assert!((found_raw - raw).abs() < 0.6, "{arm} Hz: raw {found_raw}");
    }
}

/// With AUXBEAR_SEEDS in the environment so many seeds of each arm and spin-up are tried.
#[test]
fn two_deviations_cover_the_torque() {
    let each = std::env::var("AUXBEAR_SEEDS")
        .ok()
        .and_then(|text| text.parse::<u64>().ok());
    let arms = [10.0, 30.0, 60.0];
    let report = |name: &str, scores: &[Score]| {
        let inside: usize = scores.iter().map(|s| s.inside).sum();
        let count: usize = scores.iter().map(|s| s.count).sum();
        let share = inside as f64 / count as f64;
        println!(
            "{name}: {share:.3} of {count} values inside, median error {:.2}",
            median(scores.iter().map(|s| s.error).collect())
        );
        share
    };
    let spins = [FAST, MIDDLE, SLOW];
    let mut shares = Vec::new();
    if let Some(seeds) = each {
        for arm in arms {
            for spin in spins {
                let scores = scores(0..seeds, |_| (arm, spin));
                shares.push(report(&format!("{arm} Hz, {} s", spin.0), &scores));
            }
        }
    } else {
        let pick = |seed: u64| (arms[(seed % 3) as usize], spins[(seed / 3 % 3) as usize]);
        shares.push(report("all arms and spin-ups", &scores(0..90, pick)));
    }
    // Taken one by one the slow spin-ups seen by the 10 Hz arm reach 0.981: their torque is smoother than its model.
    let highest = if each.is_some() { 0.985 } else { 0.98 };
    assert!(
        shares.iter().all(|share| (0.90..=highest).contains(share)),
        "{shares:?}"
    );
}

/// Without the knot the jump is smeared: the error in the first 20 ms must be much larger.
#[test]
fn the_jump_at_the_engagement_must_be_modelled() {
    let test = measured(60.0, 5, FAST, true);
    let early = |torque: &[f64]| {
        let mut sum = 0.0;
        for k in 0..10 {
            let at = (test.engagement.value / INTERVAL) as usize + 1 + k;
            sum += (torque[at] - test.truth[at]).powi(2);
        }
        (sum / 10.0).sqrt()
    };
    let with = invert(&test.input()).expect("inverts");
    let without = invert(&Inversion {
        engagement: None,
        zero: with.zero,
        ..test.input()
    })
    .expect("inverts");
    assert!(
        early(&without.torque) > 2.0 * early(&with.torque),
        "{} {}",
        early(&without.torque),
        early(&with.torque)
    );
    assert!(without.notes.iter().any(|n| n.to_string().contains("jump")));
}

#[test]
fn the_disturbance_is_found_beside_the_torque() {
    let test = measured(30.0, 7, FAST, true);
    let torque = invert(&test.input()).expect("inverts");
    let last = torque.disturbance.len() - 50;
    let miss = torque.disturbance[last] - 4.0;
    // The second order and the 0.5 % of frequency are not in its deviation.
    assert!(
        miss.abs() < 4.0 * torque.disturbance_deviation[last] + 0.1,
        "{miss}"
    );
}

#[test]
fn missing_values_are_bridged_and_reported() {
    let mut test = measured(30.0, 9, FAST, true);
    for k in 200..210 {
        test.reading[k] = f64::NAN;
    }
    let torque = invert(&test.input()).expect("inverts");
    assert!(torque.torque.iter().all(|v| v.is_finite()));
    assert!(
        torque
            .notes
            .iter()
            .any(|n| n.to_string().contains("10 torque readings are missing"))
    );
    assert!(torque.deviation[205] > torque.deviation[190]);
}

/// The stretches of a reading at or beyond a limit, which are cut to it.
fn cut(reading: &mut [f64], limit: f64) -> Vec<Clipped> {
    let mut found: Vec<Clipped> = Vec::new();
    for (k, value) in reading.iter_mut().enumerate() {
        if *value < limit {
            continue;
        }
        *value = limit;
        match found.last_mut() {
            Some(last) if last.first + last.count == k => last.count += 1,
            _ => found.push(Clipped {
                first: k,
                count: 1,
                limit,
                above: true,
            }),
        }
    }
    found
}

/// Readings at a limit say that the true ones are there or beyond, not by how much: the torque there is not given, and
/// what is given beside them keeps its band.
#[test]
fn clipped_readings_give_no_torque() {
    let (mut given, mut inside, mut at_limit) = (0, 0, 0);
    for seed in 0..6 {
        for limit in [15.0, 33.0, 37.0] {
            let mut test = measured(30.0, 40 + seed, MIDDLE, true);
            let clipped = cut(&mut test.reading, limit);
            let torque = invert(&Inversion {
                clipped: &clipped,
                ..test.input()
            })
            .expect("inverts");
            for part in &clipped {
                for k in part.first..part.first + part.count {
                    at_limit += usize::from(torque.torque[k].is_finite());
                    assert!(torque.torque[k].is_nan() == torque.deviation[k].is_nan());
                }
            }
            let some_unknown = torque
                .notes
                .iter()
                .any(|n| n.to_string().contains("is unknown"));
            assert_eq!(some_unknown, !clipped.is_empty());
            let start = (test.engagement.value / INTERVAL) as usize + 1;
            for k in start..torque.torque.len() {
                let away = (torque.torque[k] - test.truth[k]).abs();
                given += usize::from(away.is_finite());
                inside += usize::from(away <= 2.0 * torque.deviation[k]);
            }
            // the rest before it is a rest still
            assert!(torque.torque[..start - 2].iter().all(|t| *t == 0.0));
        }
    }
    println!("given {given}, inside {inside}, at the limit {at_limit}");
    assert_eq!(at_limit, 0);
    // some of the records clip a few readings only, or none: most of those stays given
    assert!(given > 1000, "{given}");
    // the share of the bands without clipping, less what so few seeds scatter
    assert!(inside as f64 > 0.88 * given as f64, "{inside} of {given}");
}

/// A rest that an uncertain engagement leaves open teaches no zero.
#[test]
fn a_rest_that_may_be_none_is_none() {
    let test = measured(30.0, 13, FAST, true);
    let open = Inversion {
        engagement: Some(Uncertain::new(test.engagement.value, 0.2)),
        lock: None,
        zero: Uncertain::new(0.0, 5.0),
        ..test.input()
    };
    assert!(!open.rests_at_first() && test.input().rests_at_first());
    let found = invert(&open).expect("inverts");
    let none = invert(&Inversion {
        engagement: None,
        ..open
    })
    .expect("inverts");
    assert_eq!(found.torque, none.torque);
    assert_eq!(found.zero, none.zero);
    assert!(
        found
            .notes
            .iter()
            .any(|n| n.to_string().contains("no rest before"))
    );
}

#[test]
fn what_cannot_be_inverted_is_refused() {
    let test = measured(30.0, 11, FAST, true);
    let constant = vec![1.0; 100];
    let empty = Inversion {
        reading: &[],
        shaft: None,
        ..test.input()
    };
    assert!(invert(&empty).expect_err("empty").contains("16"));
    let flat = Inversion {
        reading: &constant,
        shaft: None,
        ..test.input()
    };
    assert!(invert(&flat).expect_err("flat").contains("does not change"));
    let late = Inversion {
        first: 0.5,
        ..test.input()
    };
    assert!(
        invert(&late)
            .expect_err("late")
            .contains("must cover the reading")
    );
    let coarse = Inversion {
        interval: 0.1,
        ..test.input()
    };
    assert!(invert(&coarse).expect_err("coarse").contains("period"));
}

/// A 20 to 30 Hz arm is the worst choice when the shaft turns at 23 Hz, raw; inverted, faster is better.
#[test]
fn the_design_picture_shows_the_worst_arm() {
    let spin = SpinUp::to_150(0.0, 0.025, 11_500.0);
    let times: Vec<f64> = (0..200).map(|k| k as f64 * INTERVAL).collect();
    let torque: Vec<f64> = times.iter().map(|&t| spin.torque(t.max(1e-9))).collect();
    let angle: Vec<f64> = times.iter().map(|&t| spin.angle(t)).collect();
    let speed: Vec<f64> = times.iter().map(|&t| spin.speed(t)).collect();
    let design = Design {
        interval: INTERVAL,
        torque: &torque,
        angle: &angle,
        speed: &speed,
        rest: 0.2,
        noise: 1.0,
        disturbance: 4.0,
        decay: 39.1,
        until: 0.3,
        repetitions: 2,
    };
    let errors = design_error(&design, &[5.0, 10.0, 25.0, 60.0, 200.0]).expect("a sound design");
    for e in &errors {
        println!(
            "{:5.0} Hz: raw {:.2}, inverted {:.2}",
            e.frequency, e.raw, e.inverted
        );
    }
    assert!(
        errors[2].raw > errors[1].raw
            && errors[2].raw > errors[3].raw
            && errors[3].raw > errors[4].raw
    );
    assert!(errors[0].inverted > errors[3].inverted);
    assert!(errors.iter().all(|e| e.inverted < e.raw));
}

#[test]
fn a_torque_that_hardly_changes_keeps_its_level() {
    let mut random = Random::new(3);
    // 20 N mm throughout, noise of 1 N mm, no rest.
    let reading: Vec<f64> = (0..2000).map(|_| 20.0 + random.normal()).collect();
    let given = |zero: f64| {
        let torque = invert(&Inversion {
            sensor: Sensor {
                frequency: Uncertain::exact(30.0),
                damping_ratio: Uncertain::exact(0.2),
            },
            first: 0.0,
            interval: INTERVAL,
            reading: &reading,
            clipped: &[],
            shaft: None,
            engagement: None,
            lock: None,
            zero: Uncertain::new(0.0, zero),
            scale_deviation: 0.0,
            disturbance_power: None,
        })
        .unwrap();
        (torque.torque[1000], torque.deviation[1000])
    };
    for zero in [0.01, 0.5, 2.0, 20.0] {
        let (torque, deviation) = given(zero);
        println!("zero to {zero}: {torque:.2} ± {deviation:.2}");
        assert!(
            (torque - 20.0).abs() < 0.3 + 0.05 * zero,
            "{zero}: {torque}"
        );
        assert!(
            deviation > 0.9 * zero && deviation < 0.3 + 1.3 * zero,
            "{zero}: {deviation}"
        );
    }
}

/// Before an engagement that is known to some milliseconds the torque may be there already.
#[test]
fn the_band_before_an_engagement_holds_its_uncertainty() {
    for (late, known) in [(0.002, 0.002), (0.004, 0.002)] {
        let test = measured(60.0, 21, FAST, false);
        let truth = test.engagement.value;
        let torque = invert(&Inversion {
            engagement: Some(Uncertain::new(truth + late, known)),
            ..test.input()
        })
        .expect("inverts");
        let (mut inside, mut count) = (0, 0);
        for (k, time) in torque.time.iter().enumerate() {
            if *time > truth && *time < truth + late {
                let error = (torque.torque[k] - test.truth[k]).abs();
                println!("{error:.2} ± {:.2}", torque.deviation[k]);
                assert!(torque.deviation[k] > 0.1);
                inside += usize::from(error <= 2.0 * torque.deviation[k]);
                count += 1;
            }
            // far before it the shaft surely rests
            if *time < truth - 5.0 * known {
                assert_eq!(torque.deviation[k], 0.0);
            }
        }
        assert!(
            count > 0 && (late > 0.003 || inside == count),
            "{inside} of {count}"
        );
    }
}

/// Where the speed is not known the disturbance stays in the torque, and its band holds it.
#[test]
fn a_disturbance_that_stays_in_the_torque_is_in_its_band() {
    let (mut narrow, mut wide, mut count) = (0, 0, 0);
    for seed in 0..4 {
        let test = measured(30.0, 50 + seed, FAST, false);
        let zero = invert(&test.input()).expect("inverts").zero.value;
        let mut torque = invert(&Inversion {
            shaft: None,
            engagement: None,
            zero: Uncertain::new(zero, 0.1),
            ..test.input()
        })
        .expect("inverts");
        let inside = |torque: &measure::torque_sensor::Torque| {
            let steady = torque.time.iter().enumerate();
            steady
                .filter(|(_, time)| **time > test.engagement.value + 0.1)
                .filter(|(k, _)| {
                    (torque.torque[*k] - test.truth[*k]).abs() <= 2.0 * torque.deviation[*k]
                })
                .count()
        };
        narrow += inside(&torque);
        torque.hold_what_swings();
        wide += inside(&torque);
        count += (torque.time.iter())
            .filter(|time| **time > test.engagement.value + 0.1)
            .count();
    }
    println!("{narrow} -> {wide} of {count}");
    assert!((narrow as f64) < 0.7 * count as f64);
    assert!(wide as f64 > 0.95 * count as f64);
}

#[test]
fn of_a_sensor_as_stated_no_other_frequency_is_told() {
    let spins = [FAST, MIDDLE, SLOW];
    for (seed, arm) in (0..18).zip([22.0, 30.0, 45.0].into_iter().cycle()) {
        let test = measured(arm, 900 + seed, spins[seed as usize / 3 % 3], true);
        let shown = invert(&test.input()).unwrap().shown_frequency;
        assert_eq!(shown, None, "{seed} {arm}");
    }
}
