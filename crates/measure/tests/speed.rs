//! The smoother: covariances that fit together, other motions than a spin-up from rest, refusals, cost.

use crate::synthetic::pulses::pulses;
use crate::synthetic::wheel;
use crate::synthetic::wheel::Random;
use measure::pulse::{Edges, Flank, Wheel, calibrate, edges, number};
use measure::speed::{SpeedSettings, Transient, marks_needed, smooth};

#[test]
fn constant_acceleration_is_found_within_the_band() {
    let (mut inside, mut count) = (0, 0);
    for seed in 0..40 {
        // From 50 rad/s with 20 rad/s² for 4 s, 60 marks, 2 µs.
        let train = pulses(60, 4.0, 2e-6, seed, |t| 50.0 * t + 10.0 * t * t);
        let speed = smooth(&train, None, &SpeedSettings::default()).unwrap();
        assert!(speed.change.is_none(), "a slow ramp needs no knots");
        for k in 1..20 {
            let time = 0.2 * k as f64;
            let motion = speed.at(time);
            assert!(
                (motion.speed - 50.0 - 20.0 * time).abs() < 0.05,
                "{motion:?}"
            );
            assert!((motion.acceleration - 20.0).abs() < 2.0, "{motion:?}");
            inside += ((motion.acceleration - 20.0).abs() < 2.0 * motion.acceleration_uncertainty())
                as usize;
            inside += ((motion.speed - 50.0 - 20.0 * time).abs() < 2.0 * motion.speed_uncertainty())
                as usize;
            count += 2;
        }
    }
    let part = inside as f64 / count as f64;
    // The model knows no constant acceleration: it may be too careful, not too bold.
    println!("constant acceleration: {:.1} % inside", 100.0 * part);
    assert!(part > 0.9, "{part}");
}

#[test]
fn an_even_coast_down_of_half_a_minute_keeps_its_band() {
    // From 150 rad/s with -4 rad/s² for 30 s: the fit is a cubic, whose own covariance is lost in rounding.
    let (mut inside, mut count) = (0, 0);
    for seed in 0..20 {
        let train = pulses(12, 30.0, 2e-6, seed, |t| 150.0 * t - 2.0 * t * t);
        let speed = smooth(&train, None, &SpeedSettings::default()).unwrap();
        for k in 1..30 {
            let motion = speed.at(f64::from(k));
            let off = [
                (
                    motion.speed - 150.0 + 4.0 * motion.time,
                    motion.speed_uncertainty(),
                ),
                (motion.acceleration + 4.0, motion.acceleration_uncertainty()),
            ];
            for (off, band) in off {
                assert!(band > 0.0 && band < 0.05, "{motion:?}");
                inside += usize::from(off.abs() < 2.0 * band);
                count += 1;
            }
        }
    }
    let part = inside as f64 / count as f64;
    println!("even coast-down: {:.1} % inside", 100.0 * part);
    // 95 % of a cubic's errors; they go together along a record, of which there are 20.
    assert!(part > 0.85, "{part}");
}

#[test]
fn what_happens_after_a_quick_change_keeps_its_band() {
    // Rest, up to 150 rad/s in 0.1 s, held for 5 s, let go: 17 rad/s² down for 3 s; 60 marks, 3 µs.
    let angle = |t: f64| {
        let (up, on, off) = (
            (t - 0.3).clamp(0.0, 0.1),
            (t - 0.4).max(0.0),
            (t - 5.4).max(0.0),
        );
        750.0 * up * up + 150.0 * on - 8.5 * off * off
    };
    let (mut inside, mut count, mut worst) = (0, 0, 0.0f64);
    for seed in 0..20 {
        let train = pulses(60, 8.4, 3e-6, seed, angle);
        let speed = smooth(&train, None, &SpeedSettings::default()).unwrap();
        for k in 0..80 {
            // Around the release, and far from it.
            let time = if k < 60 {
                5.25 + 0.005 * f64::from(k)
            } else {
                1.0 + 0.35 * f64::from(k - 60)
            };
            let motion = speed.at(time);
            let off = motion.speed - 150.0 + 17.0 * (time - 5.4).max(0.0);
            worst = worst.max(off.abs() / motion.speed_uncertainty());
            inside += usize::from(off.abs() < 2.0 * motion.speed_uncertainty());
            count += 1;
        }
    }
    let part = inside as f64 / count as f64;
    println!(
        "release: {:.1} % inside, worst {worst:.1} deviations",
        100.0 * part
    );
    // Without stretches of their own density it was 39 % and 60 deviations: the fit was as stiff as the run before.
    assert!(part > 0.85 && worst < 20.0, "{part} {worst}");
}

#[test]
fn a_slow_ramp_from_rest_and_a_coast_down() {
    // 30 rad/s² from 0.5 s on for 5 s, then 150 rad/s.
    let ramp = pulses(60, 7.0, 2e-6, 3, |t| {
        let (a, b) = ((t - 0.5).clamp(0.0, 5.0), (t - 5.5).max(0.0));
        15.0 * a * a + 150.0 * b
    });
    let speed = smooth(&ramp, None, &SpeedSettings::default()).unwrap();
    let change = speed.change.unwrap();
    assert!(change.from_rest, "{change:?}");
    for (time, wanted) in [(1.0, 30.0), (3.0, 30.0), (5.0, 30.0), (6.5, 0.0)] {
        let motion = speed.at(time);
        assert!((motion.acceleration - wanted).abs() < 1.0, "{motion:?}");
        assert!(
            (motion.speed - 30.0 * (time - 0.5).min(5.0)).abs() < 0.05,
            "{motion:?}"
        );
    }
    // 150 rad/s, falling by a third every second.
    let coast = pulses(60, 8.0, 2e-6, 4, |t| 450.0 * (1.0 - (-t / 3.0).exp()));
    let speed = smooth(&coast, None, &SpeedSettings::default()).unwrap();
    assert!(speed.change.is_none());
    for time in [0.5, 2.0, 4.0, 7.0] {
        let (motion, wanted) = (speed.at(time), -50.0 * (-time / 3.0f64).exp());
        assert!(
            (motion.acceleration - wanted).abs() < 0.5,
            "{motion:?} {wanted}"
        );
    }
}

#[test]
fn a_record_that_ends_in_the_spin_up() {
    let mut inside = 0;
    for seed in 0..20 {
        let truth = wheel::spin_up(seed, 150.0, 1300.0, 0.1);
        let cut = truth.engage + 0.6 * (truth.lock - truth.engage);
        let times: Vec<f64> = wheel::stamps(&truth, seed, 60)
            .into_iter()
            .filter(|t| *t < cut)
            .collect();
        let found = Edges::stamped(times, 5e-7, Some((0.0, cut))).unwrap();
        let train = number(
            &found,
            &Wheel {
                marks: 60,
                missing: 0,
            },
        )
        .unwrap();
        let speed = smooth(&train, None, &SpeedSettings::default()).unwrap();
        let time = truth.engage + 0.4 * (truth.lock - truth.engage);
        let (motion, wanted) = (speed.at(time), truth.acceleration(time));
        assert!(
            (motion.acceleration / wanted - 1.0).abs() < 0.1,
            "{seed}: {motion:?} {wanted}"
        );
        inside += ((motion.acceleration - wanted).abs() < 2.0 * motion.acceleration_uncertainty())
            as usize;
    }
    // 95 % of 20 are 19; fewer than 15 are one case in 10 000.
    assert!(inside >= 15, "{inside}");
}

#[test]
fn a_clutch_that_engages_on_a_turning_shaft() {
    // 40 rad/s, then from 1 s on 3000 rad/s² for 30 ms, then 130 rad/s: the acceleration jumps twice.
    let angle = |t: f64| {
        let (a, b) = ((t - 1.0).clamp(0.0, 0.03), (t - 1.03).max(0.0));
        40.0 * t + 1500.0 * a * a + 90.0 * b
    };
    let train = pulses(60, 2.0, 2e-6, 7, angle);
    let speed = smooth(&train, None, &SpeedSettings::default()).unwrap();
    let change = speed.change.unwrap();
    println!("{change:?}");
    assert!(!change.from_rest);
    // Between two marks 2.6 ms apart before, 0.8 ms after.
    assert!((change.engagement.0 - 1.0).abs() < 1e-3, "{change:?}");
    assert!((change.end.unwrap().0 - 1.03).abs() < 5e-4, "{change:?}");
    for (time, wanted) in [(0.9, 0.0), (1.01, 3000.0), (1.02, 3000.0), (1.1, 0.0)] {
        let motion = speed.at(time);
        assert!(
            (motion.acceleration - wanted).abs() < 0.03 * 3000.0,
            "{motion:?}"
        );
    }
}

#[test]
fn the_shaft_rests_before_the_engagement() {
    let truth = wheel::spin_up(8, 150.0, 1300.0, 0.3);
    let samples = wheel::pickup(&truth, 8, 60, 1e4);
    let found = edges(0.0, 1e-4, &samples, Flank::Rising).unwrap();
    let train = number(
        &found,
        &Wheel {
            marks: 60,
            missing: 0,
        },
    )
    .unwrap();
    let speed = smooth(&train, None, &SpeedSettings::default()).unwrap();
    let motion = speed.at(0.005);
    assert_eq!(
        (
            motion.speed,
            motion.acceleration,
            motion.speed_uncertainty()
        ),
        (0.0, 0.0, 0.0)
    );
    assert!(motion.covariance[0][0] > 0.0);
}

#[test]
fn one_mark_cannot_see_a_short_spin_up_and_the_message_says_how_many_could() {
    let truth = wheel::spin_up(4, 150.0, 11_500.0, 1.0);
    let found =
        Edges::stamped(wheel::stamps(&truth, 4, 1), 1e-6, Some((0.0, truth.end()))).unwrap();
    let train = number(
        &found,
        &Wheel {
            marks: 1,
            missing: 0,
        },
    )
    .unwrap();
    for wanted in [None, Some(0.03)] {
        let refusal = smooth(
            &train,
            None,
            &SpeedSettings {
                wanted,
                ..Default::default()
            },
        )
        .unwrap_err();
        println!("{refusal}");
        assert!(refusal.found.contains("the speed changes by"), "{refusal}");
        let marks: usize = refusal
            .needed
            .split_whitespace()
            .find_map(|word| word.parse().ok())
            .unwrap();
        assert!((4..=120).contains(&marks), "{refusal}");
    }
}

#[test]
fn more_marks_or_better_instants_are_asked_for_when_the_band_is_too_wide() {
    let truth = wheel::spin_up(4, 150.0, 11_500.0, 0.4);
    let found =
        Edges::stamped(wheel::stamps(&truth, 4, 24), 1e-6, Some((0.0, truth.end()))).unwrap();
    let train = number(
        &found,
        &Wheel {
            marks: 24,
            missing: 0,
        },
    )
    .unwrap();
    let pitch = calibrate(&train).unwrap();
    assert!(
        smooth(
            &train,
            Some(&pitch),
            &SpeedSettings {
                wanted: Some(0.3),
                ..Default::default()
            }
        )
        .is_ok()
    );
    let refusal = smooth(
        &train,
        Some(&pitch),
        &SpeedSettings {
            wanted: Some(0.01),
            ..Default::default()
        },
    )
    .unwrap_err();
    println!("{refusal}");
    assert!(refusal.needed.contains("marks per revolution"), "{refusal}");
}

#[test]
fn marks_needed_grow_with_haste_and_with_what_is_wanted() {
    let of = |duration, wanted| marks_needed(150.0, duration, 2e-6, wanted).unwrap();
    // of a spin-up that is known to last 25 ms
    let marks = marks_needed(149.6, 0.025, 1e-6, 0.03).unwrap();
    assert!((20..=120).contains(&marks), "{marks}");
    assert!(of(0.025, 0.03) > of(0.223, 0.03));
    assert!(of(0.025, 0.01) > of(0.025, 0.03));
    // One mark per revolution sees nothing of 25 ms, sixty resolve it.
    assert!((6..=60).contains(&of(0.025, 0.03)), "{}", of(0.025, 0.03));
    assert_eq!(marks_needed(150.0, 0.0, 1e-6, 0.1), None);
    assert_eq!(marks_needed(150.0, 0.025, f64::NAN, 0.1), None);
}

#[test]
fn few_pulses_and_odd_numbers_are_refused_or_survived() {
    let train = |times: Vec<f64>| {
        number(
            &Edges::stamped(times, 1e-6, None).unwrap(),
            &Wheel {
                marks: 60,
                missing: 0,
            },
        )
    };
    let three = train(vec![0.0, 1.0, 2.0]).unwrap();
    let refusal = smooth(&three, None, &SpeedSettings::default()).unwrap_err();
    assert!(refusal.needed.contains("6 pulses"), "{refusal}");
    let mut random = Random::new(21);
    for k in 0..60 {
        let mut time = 0.0;
        let times: Vec<f64> = (0..6 + k)
            .map(|_| {
                time += 10f64.powf(random.between(-9.0, 3.0));
                time
            })
            .collect();
        // Some of these trains look like a rest within the record.
        let Ok(odd) = train(times) else { continue };
        if let Ok(speed) = smooth(&odd, None, &SpeedSettings::default()) {
            let motion = speed.at(0.5 * time);
            assert!(
                motion.speed.is_finite() && motion.covariance[2][2].is_finite(),
                "{motion:?}"
            );
        }
        let window = SpeedSettings {
            transient: Transient::Within(time, 0.0),
            ..Default::default()
        };
        let _ = smooth(
            &train(vec![0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6]).unwrap(),
            None,
            &window,
        );
    }
}

#[test]
fn ten_seconds_of_sixty_marks_are_smoothed() {
    let truth = wheel::spin_up(6, 150.0, 7200.0, 9.85);
    let samples = wheel::pickup(&truth, 6, 60, 1e4);
    let found = edges(0.0, 1e-4, &samples, Flank::Rising).unwrap();
    let train = number(
        &found,
        &Wheel {
            marks: 60,
            missing: 0,
        },
    )
    .unwrap();
    let pitch = calibrate(&train).unwrap();
    let smoothed = smooth(&train, Some(&pitch), &SpeedSettings::default()).unwrap();
    let sum: f64 = (0..100_000)
        .map(|k| smoothed.at(k as f64 * 1e-4).speed)
        .sum();
    // the sum over equal times is the angle turned: to a hundredth of a rad/s on the average
    let turned = smoothed.at(9.9999).angle - smoothed.at(0.0).angle;
    assert!((sum * 1e-4 - turned).abs() < 0.1, "{sum} {turned}");
    let (found, expected) = (smoothed.at(5.0).speed, truth.speed(5.0));
    assert!((found - expected).abs() < 0.01, "{found} {expected}");
}

#[test]
fn ten_seconds_of_an_encoder_are_smoothed() {
    // 360 marks at 150 rad/s: 86 000 pulses.
    let train = pulses(360, 10.0, 2e-7, 5, |t| 150.0 * t - 0.5 * t * t);
    let again = Edges::stamped(train.times.clone(), 2e-7, None).unwrap();
    let train = number(
        &again,
        &Wheel {
            marks: 360,
            missing: 0,
        },
    )
    .unwrap();
    let pitch = calibrate(&train).unwrap();
    let speed = smooth(&train, Some(&pitch), &SpeedSettings::default()).unwrap();
    assert!(
        (speed.at(5.0).acceleration + 1.0).abs() < 0.5,
        "{:?}",
        speed.at(5.0)
    );
}
