//! Marks per revolution: wrong ones are detected, right ones raise no alarm, whatever the speed is to the sampling.

use crate::synthetic::wheel::Random;
use measure::pulse::{Edges, Flank, Marks, Pulses, Wheel, check_marks, edges, number, period};
use std::f64::consts::TAU;

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
    let found = edges(0.0, 1.0 / RATE, &samples, Flank::Rising).unwrap();
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

/// Every third speed, from the first, second or third on; all of them with `AUXBEAR_SEEDS` in the environment.
fn speeds(from: usize) -> impl Iterator<Item = f64> {
    let (skipped, step) = match std::env::var_os("AUXBEAR_SEEDS") {
        Some(_) => (0, 1),
        None => (from % 3, 3),
    };
    SPEEDS.into_iter().skip(skipped).step_by(step)
}

#[test]
fn right_marks_raise_no_alarm() {
    let (mut alarms, mut count) = (Vec::new(), 0);
    for marks in [12, 24, 36, 60, 100] {
        for (kind, errors) in wheels(marks).iter().enumerate() {
            for speed in speeds(kind) {
                for (slope, digital) in [(0.0, false), (0.0, true), (5.0, false)] {
                    // At least six samples a mark: fewer show no two levels.
                    if speed * marks as f64 / TAU > RATE / 6.0 {
                        continue;
                    }
                    count += 1;
                    let train = pulses(errors, speed, slope, digital, marks);
                    if let Marks::Contradicted(why) = check_marks(&train) {
                        alarms.push(format!("{marks} {kind} {speed} {slope} {digital}: {why}"));
                    }
                }
            }
        }
    }
    assert!(count > 100, "{count}");
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
        for speed in speeds(marks / 12) {
            if speed * marks as f64 / TAU > RATE / 6.0 {
                continue;
            }
            for slope in [0.0, 5.0] {
                for stated in [marks / 2, marks - 1, marks + 12] {
                    count += 1;
                    let train = pulses(&errors, speed, slope, false, stated);
                    let words = format!("{marks} {stated} {speed} {slope}");
                    match check_marks(&train) {
                        // Marks and sampling together repeat after a multiple that takes a whole number of samples.
                        Marks::Contradicted(_)
                            if period(&train).is_some_and(|found| found % marks == 0) => {}
                        Marks::Contradicted(why) => wrong.push(format!("{words}: {why}")),
                        Marks::Shown | Marks::Unclear(_) => missed.push(words),
                    }
                }
            }
        }
    }
    println!("missed {} of {count}: {missed:?}", missed.len());
    assert!(wrong.is_empty(), "{wrong:#?}");
    // At some of these steady speeds turns take a whole number of samples, or half of one, or what they take hides the marks.
    assert!(
        missed.len() * 10 <= 3 * count,
        "{} of {count}",
        missed.len()
    );
}

/// How the shaft moves.
#[derive(Clone, Copy, Debug)]
enum Course {
    SpinUp,
    CoastDown,
    Steady,
}

/// A record of a wheel, and how it was taken.
struct Record {
    /// Samples and their interval, s; none where the instants were stamped.
    samples: Option<(Vec<f64>, f64)>,
    /// Instants, s, and the step of the clock.
    stamps: (Vec<f64>, f64),
}

impl Record {
    /// A wheel whose marks are off by 0.3 or 1 % of the pitch, at a speed and for a time of its own, with a ripple of the speed
    /// in one of three; a sampled pickup has 6 to 40 samples a mark, every other one steep flanks.
    fn of(seed: u64, marks: usize, course: Course, stamped: bool) -> Record {
        let mut random = Random::new(seed * 977 + marks as u64 * 13 + course as u64 * 5);
        let speed = random.between(30.0, 200.0);
        let duration = random.between(0.8, 2.0);
        let slowing = match course {
            Course::SpinUp => random.between(0.5, 10.0),
            Course::CoastDown => speed * random.between(0.2, 0.9) / duration,
            Course::Steady => random.between(-3.0, 3.0) * (seed % 2) as f64,
        };
        let (start, length) = (0.1, random.between(0.03, 0.3));
        let ripple = if seed.is_multiple_of(3) { 2e-4 } else { 0.0 };
        let size = if (seed / 2).is_multiple_of(2) {
            0.01
        } else {
            0.003
        };
        let errors: Vec<f64> = (0..marks).map(|_| size * random.normal()).collect();
        let angle = |time: f64| {
            let even = |time: f64| speed * time - 0.5 * slowing * time * time;
            let angle = match course {
                Course::SpinUp if time < start => 0.0,
                Course::SpinUp if time < start + length => {
                    let part = (time - start) / length;
                    speed * length * (part * part - part.powi(3) / 3.0)
                }
                Course::SpinUp => speed * length * 2.0 / 3.0 + even(time - start - length),
                Course::CoastDown | Course::Steady => even(time),
            };
            angle + ripple * angle.sin()
        };
        let places = |time: f64| marks as f64 * angle(time) / TAU;
        let rate = speed * marks as f64 / TAU;
        if stamped {
            let clock = [1e-6, 1e-7][seed as usize % 2];
            let mut times = vec![];
            let mut before = 0.0;
            for mark in 1.. {
                let wanted = mark as f64 + errors[mark % marks];
                let mut after = before;
                while after < duration && places(after) < wanted {
                    after += 0.125 / rate;
                }
                if after >= duration || times.len() > 9000 {
                    break;
                }
                for _ in 0..40 {
                    let middle = 0.5 * (before + after);
                    if places(middle) < wanted {
                        before = middle;
                    } else {
                        after = middle;
                    }
                }
                let time = ((after + 0.3 * clock * random.normal()) / clock).floor() * clock;
                if times.last().is_none_or(|last| time > *last) {
                    times.push(time);
                }
            }
            return Record {
                samples: None,
                stamps: (times, clock),
            };
        }
        let rate = rate * random.between(6.0, 40.0);
        let noise = random.between(0.007, 0.05);
        let count = ((duration * rate) as usize).min(150_000);
        let samples = (0..count).map(|k| {
            let place = places(k as f64 / rate) + 0.37;
            let wave = (TAU * (place + errors[place as usize % marks])).sin();
            let steep = match seed % 2 {
                0 => (3.0 * wave).tanh(),
                _ => wave.signum(),
            };
            2.5 + 2.4 * steep + noise * random.normal()
        });
        Record {
            samples: Some((samples.collect(), 1.0 / rate)),
            stamps: (vec![], 1.0),
        }
    }

    fn pulses(&self, stated: usize) -> Pulses {
        let found = match &self.samples {
            Some((samples, interval)) => edges(0.0, *interval, samples, Flank::Rising),
            None => {
                let (times, clock) = &self.stamps;
                Edges::stamped(times.clone(), clock / 12f64.sqrt(), None)
            }
        };
        let wheel = Wheel {
            marks: stated,
            missing: 0,
        };
        number(&found.unwrap(), &wheel).unwrap()
    }
}

/// Seeds of each course, wheel and way of recording.
const SEEDS: u64 = 3;

/// True wheels of 12, 60 and 360 marks are never called wrong; wrong numbers are reported where the wheel shows its own.
///
/// With 100 seeds: of 1800 true wheels none is called wrong; of 3600 numbers that are no multiple 77 % are reported, of 1800
/// twofold ones 45 %; 15 of these with another number than the wheel's, a part or a multiple of it. Reported most seldom: digital
/// signals, whose instants are those of the samples, and a dozen marks, of which too few differ.
#[test]
fn true_wheels_are_not_called_wrong_and_wrong_ones_are() {
    let (mut alarms, mut count) = (vec![], 0);
    let (mut shown, mut asked, mut strange) = ([0; 2], [0; 2], vec![]);
    for marks in [12, 60, 360] {
        let others: &[usize] = match marks {
            12 => &[11, 24],
            60 => &[59, 61, 30, 120],
            _ => &[359, 180, 720],
        };
        for course in [Course::SpinUp, Course::CoastDown, Course::Steady] {
            for stamped in [false, true] {
                for seed in 0..SEEDS {
                    let mut train = Record::of(seed, marks, course, stamped).pulses(marks);
                    count += 1;
                    let words = format!("{marks} {course:?} {stamped} {seed}");
                    if let Marks::Contradicted(why) = check_marks(&train) {
                        alarms.push(format!("{words}: {why}"));
                    }
                    for &other in others {
                        train.positions = other;
                        let parts = usize::from(other.is_multiple_of(marks));
                        asked[parts] += 1;
                        if let Marks::Contradicted(why) = check_marks(&train) {
                            shown[parts] += 1;
                            if !why.found.contains(&format!("after {marks} pulses")) {
                                strange.push(format!("{words}, {other}: {why}"));
                            }
                        }
                    }
                }
            }
        }
    }
    println!(
        "{} of {count} true wheels called wrong: {alarms:#?}",
        alarms.len()
    );
    println!("reported {shown:?} of {asked:?}, with another number {strange:#?}");
    assert!(alarms.is_empty());
    assert!(strange.len() * 20 <= shown[0], "{strange:#?}");
    // 77 and 45 % less what chance makes of 108 and 54.
    assert!(10 * shown[0] >= 5 * asked[0], "{shown:?} of {asked:?}");
    assert!(10 * shown[1] >= 2 * asked[1], "{shown:?} of {asked:?}");
}

/// An even wheel on a shaft whose speed ripples ten times a turn: the ripple is no wheel of six marks.
#[test]
fn a_ripple_of_the_speed_is_no_wheel() {
    let mut random = Random::new(3);
    let times: Vec<f64> = (1..4000)
        .map(|mark| {
            let angle = f64::from(mark) * TAU / 60.0;
            (angle + 2e-4 * (10.0 * angle).sin()) / 150.0 + 2e-7 * random.normal()
        })
        .collect();
    let edges = Edges::stamped(times, 2e-7, None).unwrap();
    for stated in [60, 48] {
        let wheel = Wheel {
            marks: stated,
            missing: 0,
        };
        let said = check_marks(&number(&edges, &wheel).unwrap());
        assert!(!matches!(said, Marks::Contradicted(_)), "{said:?}");
    }
}
