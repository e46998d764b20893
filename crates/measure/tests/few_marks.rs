//! Few marks in a quick change: what eight of them show, what fewer do not, and how many are enough.
//!
//! A pickup whose flanks are sampled, on a wheel whose marks are off by a hundredth of their pitch. Where marks are few the
//! likelihood of the engagement has many summits, one for each interval between marks that the lock may lie in; a search that
//! misses the highest one is wrong by a fifth of the slip with a band of a tenth.
//!
//! Forty seeds a case in a release build; parts of the instants of the slip within two standard deviations:
//!
//! | marks, in the slip | rises evenly: speed, acceleration | is even | breaks away |
//! |---|---|---|---|
//! | 12, nine in 63 to 94 ms | 91.1, 93.8 % | 94.8, 96.7 % | 95.3, 95.4 % |
//! | 24, twelve in 42 to 63 ms | 99.0, 98.5 % | 96.6, 97.6 % | 95.2, 95.2 % |
//! | 60, nine in 13 to 19 ms | 97.7, 99.6 % | 96.5, 94.5 % | 84.4, 78.6 % |
//!
//! With seven of 12 or 24 marks it was 82 to 100 % each, with five 79 % of the acceleration where the torque breaks away: refused.

use std::f64::consts::TAU;

use crate::synthetic::wheel::{Truth, optical, shaped};
use measure::pulse::{Flank, Pulses, Wheel, calibrate, edges, number};
use measure::speed::{Speed, SpeedSettings, marks_needed, smooth};

/// Samples per second of the pickup: one of four channels of a converter of 42 kHz.
const RATE: f64 = 10_500.0;
/// Speed that is reached, rad/s.
const REACHED: f64 = 150.0;

/// A shape of the acceleration, and the mean of the speed over the slip as a part of the one reached.
type Shape = (fn(f64) -> f64, f64);

const RAMP: Shape = (|x| x, 1.0 / 3.0);
const EVEN: Shape = (|_| 1.0, 0.5);
const BREAKS_AWAY: Shape = (|x| 0.2 + 0.8 * x, (0.1 + 0.8 / 6.0) / 0.6);

fn passages(truth: &Truth, seed: u64, marks: usize) -> Pulses {
    let samples = optical(truth, seed, marks, RATE);
    let found = edges(0.0, RATE.recip(), &samples, Flank::Rising).unwrap();
    number(&found, &Wheel { marks, missing: 0 }).unwrap()
}

fn smoothed(truth: &Truth, seed: u64, marks: usize) -> Result<Speed, measure::pulse::Refusal> {
    let pulses = passages(truth, seed, marks);
    let pitch = calibrate(&pulses).unwrap();
    let settings = SpeedSettings {
        latency: 5e-6,
        ..SpeedSettings::default()
    };
    smooth(&pulses, Some(&pitch), &settings)
}

/// Slip in which so many marks pass, s.
fn slip(shape: Shape, marks: usize, within: f64) -> f64 {
    within * TAU / marks as f64 / (REACHED * shape.1)
}

fn seeds() -> u64 {
    std::env::var("AUXBEAR_SEEDS")
        .ok()
        .and_then(|seeds| seeds.parse().ok())
        .unwrap_or(4)
}

#[test]
fn the_engagement_of_a_rising_torque_is_found_with_twelve_marks_in_the_slip() {
    // 60 marks and 26 ms: the first mark passes after two fifths of the slip.
    let mut inside = 0;
    for seed in 0..seeds() {
        let truth = shaped(seed, RAMP.0, REACHED, 0.0258, 0.5);
        let change = smoothed(&truth, seed, 60).unwrap().change.unwrap();
        let off = change.engagement.0 - truth.engage;
        // A tenth of the slip is half of what a summit that is missed costs.
        assert!(off.abs() < 2.6e-3, "{seed}: {off} {change:?}");
        inside += usize::from(off.abs() < 2.0 * change.engagement.1);
    }
    // One of four outside comes by chance in a sixth of all trials, two in a hundredth; of forty four in a tenth, six in a hundredth.
    let outside = 1 + (seeds() - seeds().min(4)) / 9;
    assert!(inside as u64 + outside >= seeds(), "{inside}");
}

#[test]
fn too_few_marks_are_refused_with_a_number_that_is_enough() {
    for (marks, length) in [(12, 0.0412), (24, 0.0258)] {
        for seed in 0..2 {
            let truth = shaped(seed, RAMP.0, REACHED, length, 0.5);
            let refusal = smoothed(&truth, seed, marks).unwrap_err();
            let enough: usize = refusal
                .needed
                .split_whitespace()
                .find_map(|word| word.parse().ok())
                .unwrap();
            assert!(enough > marks && enough <= 3 * marks, "{refusal}");
            let change = smoothed(&truth, seed, enough).unwrap().change.unwrap();
            let off = change.engagement.0 - truth.engage;
            assert!(off.abs() < 0.1 * length, "{enough}: {off} {change:?}");
        }
    }
}

#[test]
fn marks_that_are_asked_for_beforehand_are_enough_for_a_rising_torque() {
    let marks = marks_needed(REACHED, 0.0258, 2e-6, 0.1).unwrap();
    assert!((44..=90).contains(&marks), "{marks}");
    let truth = shaped(3, RAMP.0, REACHED, 0.0258, 0.5);
    assert!(smoothed(&truth, 3, marks).is_ok());
}

#[test]
fn eight_marks_and_more_hold_their_band() {
    let (mut speeds, mut accelerations, mut count) = (0, 0, 0);
    for (marks, within) in [(12, 9.0), (24, 12.0), (60, 9.0)] {
        for (name, shape) in [("ramp", RAMP), ("even", EVEN), ("breaks away", BREAKS_AWAY)] {
            let length = slip(shape, marks, within);
            let (mut speed, mut acceleration, mut refused, mut all) = (0, 0, 0, 0);
            for seed in 0..seeds() {
                let truth = shaped(seed, shape.0, REACHED, length, 0.5);
                let Ok(found) = smoothed(&truth, seed, marks) else {
                    refused += 1;
                    continue;
                };
                for k in 0..48 {
                    let time = truth.engage + length * (f64::from(k) + 0.5) / 48.0;
                    let motion = found.at(time);
                    let away = (motion.speed - truth.speed(time)) / motion.speed_uncertainty();
                    speed += usize::from(away.abs() < 2.0);
                    let away = (motion.acceleration - truth.acceleration(time))
                        / motion.acceleration_uncertainty();
                    acceleration += usize::from(away.abs() < 2.0);
                    all += 1;
                }
            }
            println!(
                "{name}, {marks} marks, {within} in {:.0} ms: speed {:.1} %, acceleration {:.1} %, {refused} refused",
                1e3 * length,
                100.0 * speed as f64 / all as f64,
                100.0 * acceleration as f64 / all as f64
            );
            assert!(refused == 0, "{name} {marks} {within}");
            speeds += speed;
            accelerations += acceleration;
            count += all;
        }
    }
    let (speed, acceleration) = (
        speeds as f64 / count as f64,
        accelerations as f64 / count as f64,
    );
    // Nine tenths over all cases, less a deviation of some forty records whose instants stand or fall together.
    assert!(
        speed > 0.87 && acceleration > 0.87,
        "{speed} {acceleration}"
    );
}

#[test]
fn a_change_that_began_before_the_record_is_not_dated() {
    for seed in 0..seeds() {
        let truth = shaped(seed, RAMP.0, REACHED, 0.0258, 0.5);
        let whole = passages(&truth, seed, 60);
        // The record begins behind two, four or six marks of the slip.
        for missing in [2, 4, 6] {
            let mut late = whole.clone();
            late.times.drain(..missing);
            late.uncertainties.drain(..missing);
            late.marks.drain(..missing);
            late.watched.0 = late.times[0];
            let Ok(speed) = smooth(&late, None, &SpeedSettings::default()) else {
                continue;
            };
            let Some(change) = speed.change else { continue };
            let off = (change.engagement.0 - truth.engage).abs();
            assert!(
                off < 2.0 * change.engagement.1,
                "{seed} {missing}: {change:?}"
            );
            let shown =
                |note: &problem::note::Note| note.to_string().contains("may have begun before");
            assert!(
                change.from_rest || speed.notes.iter().any(shown),
                "{:?}",
                speed.notes
            );
        }
    }
}
