//! Marks per revolution: wrong ones are detected, right ones raise no alarm, whatever the speed is to the sampling.

#[path = "synthetic/wheel.rs"]
mod synthetic;

use measure::pulse::{EdgeSettings, Pulses, Wheel, check_marks, edges, number, period};
use std::f64::consts::TAU;
use synthetic::Random;

const RATE: f64 = 10_000.0;

/// Pulses of four seconds at a speed that changes by `slope`, rad/s²; steep flanks where `digital`.
fn pulses(errors: &[f64], speed: f64, slope: f64, digital: bool, stated: usize) -> Pulses {
    let mut random = Random::new(errors.len() as u64);
    let marks = errors.len();
    let samples: Vec<f64> = (0..(4.0 * RATE) as usize)
        .map(|k| {
            let time = k as f64 / RATE;
            let angle = speed * time + 0.5 * slope * time * time;
            let place = marks as f64 * angle / TAU + 0.37;
            let wave = (TAU * (place + errors[place as usize % marks])).sin();
            let steep = if digital {
                wave.signum()
            } else {
                (3.0 * wave).tanh()
            };
            2.5 + 2.4 * steep + 0.02 * random.normal()
        })
        .collect();
    let found = edges(0.0, 1.0 / RATE, &samples, &EdgeSettings::default()).unwrap();
    let wheel = Wheel {
        marks: stated,
        missing: 0,
    };
    number(&found, &wheel).unwrap()
}

/// Errors of the marks in parts of the pitch: none, independent, and such that neighbours have nearly the same.
fn wheels(marks: usize) -> [Vec<f64>; 3] {
    let mut random = Random::new(marks as u64 + 8);
    let plain: Vec<f64> = (0..marks).map(|_| 0.01 * random.normal()).collect();
    let alike = (0..marks)
        .map(|k| {
            let turn = TAU * k as f64 / marks as f64;
            (1..6)
                .map(|order| 0.01 * (f64::from(order) * turn + f64::from(order * order)).sin())
                .sum()
        })
        .collect();
    [vec![0.0; marks], plain, alike]
}

const SPEEDS: [f64; 9] = [
    40.0,
    61.3,
    80.0,
    25.0 * TAU,
    104.72,
    117.0,
    140.0,
    150.0,
    163.1,
];

#[test]
fn right_marks_raise_no_alarm() {
    let (mut alarms, mut count) = (Vec::new(), 0);
    for marks in [12, 24, 36, 60, 100] {
        for (kind, errors) in wheels(marks).iter().enumerate() {
            for speed in SPEEDS {
                for (slope, digital) in [(0.0, false), (0.0, true), (5.0, false)] {
                    // At least six samples a mark: fewer show no two levels.
                    if speed * marks as f64 / TAU > RATE / 6.0 {
                        continue;
                    }
                    count += 1;
                    let train = pulses(errors, speed, slope, digital, marks);
                    if let Err(why) = check_marks(&train) {
                        alarms.push(format!("{marks} {kind} {speed} {slope} {digital}: {why}"));
                    }
                }
            }
        }
    }
    assert!(count > 300, "{count}");
    assert!(
        alarms.is_empty(),
        "{} of {count}: {alarms:#?}",
        alarms.len()
    );
}

#[test]
fn wrong_marks_are_detected_with_the_right_number() {
    let (mut missed, mut wrong, mut count) = (Vec::new(), Vec::new(), 0);
    for marks in [24usize, 36, 60] {
        let [_, errors, _] = wheels(marks);
        for speed in SPEEDS {
            // With fewer samples a mark, errors of 1 % of the pitch are lost in the instants.
            if speed * marks as f64 / TAU > RATE / 15.0 {
                continue;
            }
            for slope in [0.0, 5.0] {
                for stated in [marks / 2, marks - 1, marks + 12] {
                    count += 1;
                    let train = pulses(&errors, speed, slope, false, stated);
                    let words = format!("{marks} {stated} {speed} {slope}");
                    match check_marks(&train) {
                        Ok(()) => missed.push(words),
                        Err(_) if period(&train) == Some(marks) => (),
                        Err(why) => wrong.push(format!("{words}: {why}")),
                    }
                }
            }
        }
    }
    println!("missed {} of {count}: {missed:?}", missed.len());
    assert!(wrong.is_empty(), "{wrong:#?}");
    // A turn that takes nearly a whole number of samples cannot be told from sampling: one in three does.
    assert!(
        missed.len() * 10 <= 4 * count,
        "{} of {count}",
        missed.len()
    );
}
