//! Edges, numbering and calibration, on made-up signals with known answers and on signals of others.

use crate::synthetic::wheel;
use std::f64::consts::TAU;
use std::path::PathBuf;

use crate::synthetic::wheel::Random;
use measure::pulse::{
    Edges, Flank, Marks, Pulses, Wheel, calibrate, check_marks, edges, number, period,
};
use measure::speed::{SpeedSettings, Transient, smooth};
use proptest::prelude::*;

const FULL: fn(usize) -> Wheel = |marks| Wheel { marks, missing: 0 };

/// Trapezoidal pulses of a wheel that turns evenly: `rate` pulses a second, sampled at 10 kHz.
fn trapezoids(rate: f64, duty: f64, flank: f64, seconds: f64) -> impl Iterator<Item = (f64, f64)> {
    (0..(seconds * 1e4) as usize).map(move |k| {
        let time = k as f64 * 1e-4;
        let x = (time * rate).rem_euclid(1.0);
        let away = (x - 0.5 * duty).abs().min(1.0 - (x - 0.5 * duty).abs());
        (time, ((0.5 * duty - away) / flank + 0.5).clamp(0.0, 1.0))
    })
}

#[test]
fn middle_of_a_flank_is_found_between_samples_at_any_duty_noise_and_drift() {
    let mut random = Random::new(1);
    for (duty, noise, drift) in [
        (0.5, 0.0, 0.0),
        (0.12, 0.02, 0.0),
        (0.85, 0.02, 0.0),
        (0.5, 0.05, 3.0),
        (0.3, 0.01, -2.0),
    ] {
        // 73 pulses a second: 137 samples a pulse, flanks of 8 samples.
        let samples: Vec<f64> = trapezoids(73.0, duty, 0.06, 2.0)
            .map(|(time, x)| 4.0 * x - 1.0 + drift * time + 4.0 * noise * random.normal())
            .collect();
        for flank in [Flank::Rising, Flank::Falling] {
            let found = edges(0.0, 1e-4, &samples, flank).unwrap();
            assert!(
                (found.times.len() as i64 - 146).abs() <= 1,
                "{} flanks",
                found.times.len()
            );
            let offset = if flank == Flank::Rising { 0.0 } else { duty };
            let mut inside = 0;
            for (time, spread) in found.times.iter().zip(&found.uncertainties) {
                let place = time * 73.0 - offset;
                let error = (place - place.round()) / 73.0;
                // A straight line through 5 samples of a flank of 8: the noise over the slope, twice, and a tenth of a sample.
                assert!(
                    error.abs() < 1e-4 * (0.12 + 5.0 * noise * 8.0 / 5f64.sqrt()),
                    "{duty} {noise} {drift}: {error}"
                );
                inside += (error.abs() < 2.0 * spread + 2e-6) as usize;
            }
            // Stated uncertainties are not smaller than the errors.
            assert!(
                inside * 100 >= 85 * found.times.len(),
                "{duty} {noise} {drift} {flank:?}: {inside} of {}",
                found.times.len()
            );
        }
    }
}

/// A coasting wheel of 60 marks at 10.5 kS/s, seven samples a pitch at first, with flanks that take a tenth of a pitch and
/// hide between two samples; and the error of each flank over its stated uncertainty, with the error, s.
fn hidden_flanks(seed: u64) -> Vec<(f64, f64)> {
    let mut random = Random::new(seed);
    let (from, slope, rate) = (150.0, 24.6, 10_500.0);
    let pitch = TAU / 60.0;
    let angle = |t: f64| from * t - 0.5 * slope * t * t;
    let samples: Vec<f64> = (0..(6.0 * rate) as usize)
        .map(|k| {
            let turned = angle(k as f64 / rate) / pitch;
            2.5 + 2.5 * (6.0 * (TAU * turned).cos()).tanh() + 0.05 * random.normal()
        })
        .collect();
    let found = edges(0.0, rate.recip(), &samples, Flank::Rising).unwrap();
    let passed = |k: usize| {
        // Rises through the middle three quarters of a pitch after each whole one.
        let wanted = (k as f64 + 0.75) * pitch;
        (from - (from * from - 2.0 * slope * wanted).sqrt()) / slope
    };
    let fast = found.times.iter().zip(&found.uncertainties).enumerate();
    fast.filter(|(_, (time, _))| **time < 3.0)
        .map(|(k, (time, uncertainty))| {
            let error = time - passed(k);
            (error, error / uncertainty)
        })
        .collect()
}

#[test]
fn flanks_between_two_samples_have_the_uncertainty_that_leaves() {
    for seed in 0..3 {
        let flanks = hidden_flanks(seed);
        let count = flanks.len() as f64;
        let square = |of: &dyn Fn(&(f64, f64)) -> f64| {
            (flanks.iter().map(|f| of(f).powi(2)).sum::<f64>() / count).sqrt()
        };
        let (error, relative) = (square(&|f| f.0), square(&|f| f.1));
        println!("{:.2} µs, {relative:.2} of what is stated", 1e6 * error);
        // A record that shows the shape leaves 2.6 µs.
        assert!(error < 3.2e-6, "{error}");
        assert!((0.7..1.5).contains(&relative), "{relative}");
    }
}

#[test]
fn both_flanks_and_their_middle() {
    let samples: Vec<f64> = trapezoids(50.0, 0.3, 0.05, 1.0)
        .map(|(_, x)| 5.0 * x)
        .collect();
    let take = |flank| edges(0.0, 1e-4, &samples, flank).unwrap();
    let (rising, both, centre) = (take(Flank::Rising), take(Flank::Both), take(Flank::Centre));
    assert!(both.times.len() >= 2 * rising.times.len() - 1);
    for time in &centre.times {
        let place = time * 50.0 - 0.15;
        assert!((place - place.round()).abs() < 2e-4, "{time}");
    }
    let numbered = number(&both, &FULL(60)).unwrap();
    assert_eq!(numbered.positions, 120);
    assert!(numbered.marks.windows(2).all(|pair| pair[1] == pair[0] + 1));
}

#[test]
fn noise_without_pulses_is_refused_and_so_is_a_constant() {
    let mut random = Random::new(2);
    let noise: Vec<f64> = (0..5000).map(|_| random.normal()).collect();
    for samples in [noise, vec![1.5; 5000], vec![f64::NAN; 100], vec![0.0; 2]] {
        let refusal = edges(0.0, 1e-4, &samples, Flank::Rising).unwrap_err();
        assert!(!refusal.needed.is_empty(), "{refusal}");
    }
}

#[test]
fn a_gap_in_the_samples_is_reported_and_nothing_is_counted_across_it() {
    let mut samples: Vec<f64> = trapezoids(50.0, 0.5, 0.05, 1.0).map(|(_, x)| x).collect();
    samples[3000..3450].fill(f64::NAN);
    let found = edges(0.0, 1e-4, &samples, Flank::Rising).unwrap();
    assert!(
        found.notes[0].to_string().contains("1 gaps"),
        "{:?}",
        found.notes
    );
    assert!(found.times.iter().all(|t| !(0.2999..0.3451).contains(t)));
    let numbered = number(&found, &FULL(60)).unwrap();
    // The count goes on over the gap: 50 pulses in the second, of which two fell into the gap or beside it.
    assert_eq!(numbered.marks.last().unwrap() + 1, 49);
}

/// Instants of a wheel that speeds up from rest: a constant acceleration of 50 rad/s².
fn ramp(marks: usize, count: usize) -> Vec<f64> {
    (0..count)
        .map(|k| (2.0 * (k as f64 + 0.4) * TAU / marks as f64 / 50.0).sqrt())
        .collect()
}

fn stamped(times: Vec<f64>) -> Edges {
    Edges::stamped(times, 1e-7, None).unwrap()
}

#[test]
fn an_even_start_from_rest_is_no_fault() {
    let numbered = number(&stamped(ramp(60, 500)), &FULL(60)).unwrap();
    assert_eq!(numbered.marks, (0..500).collect::<Vec<_>>());
    assert!(numbered.notes.is_empty(), "{:?}", numbered.notes);
}

#[test]
fn missing_and_doubled_pulses_are_repaired_with_a_note() {
    let all = ramp(60, 500);
    for lost in [vec![10], vec![57, 58], vec![100, 300, 302, 450]] {
        let kept: Vec<f64> = all
            .iter()
            .enumerate()
            .filter(|(k, _)| !lost.contains(k))
            .map(|(_, t)| *t)
            .collect();
        let numbered = number(&stamped(kept), &FULL(60)).unwrap();
        let wanted: Vec<i64> = (0..500)
            .filter(|k| !lost.contains(&(*k as usize)))
            .collect();
        assert_eq!(numbered.marks, wanted, "lost {lost:?}");
        assert!(
            numbered.notes[0]
                .to_string()
                .contains(&format!("{} pulses missing", lost.len())),
            "{:?}",
            numbered.notes
        );
    }
    for part in [0.05, 0.3, 0.5, 0.8] {
        let mut more = all.clone();
        for k in [20, 200, 203, 399] {
            more.push(all[k] + part * (all[k + 1] - all[k]));
        }
        more.sort_by(f64::total_cmp);
        let numbered = number(&stamped(more), &FULL(60)).unwrap();
        let lone = numbered.marks.last().unwrap();
        assert!(
            (lone - 499).abs() <= 1,
            "{part}: {lone} {:?}",
            numbered.notes
        );
        assert!(
            numbered.notes[0].to_string().contains("too many"),
            "{:?}",
            numbered.notes
        );
    }
}

#[test]
fn a_pulse_that_comes_much_too_late_is_left_out() {
    let mut times = ramp(60, 500);
    for k in [150, 320] {
        times[k] += 0.3 * (times[k + 1] - times[k]);
    }
    let numbered = number(&stamped(times.clone()), &FULL(60)).unwrap();
    assert!(
        numbered.notes[0].to_string().starts_with("2 pulses far"),
        "{:?}",
        numbered.notes
    );
    assert!(!numbered.times.contains(&times[150]) && !numbered.times.contains(&times[320]));
    assert_eq!(numbered.times.len(), 498);
}

#[test]
fn left_out_marks_are_the_reference_and_no_fault() {
    let times: Vec<f64> = ramp(60, 900)
        .into_iter()
        .enumerate()
        .filter(|(k, _)| k % 60 < 58)
        .map(|(_, t)| t)
        .collect();
    let numbered = number(
        &stamped(times),
        &Wheel {
            marks: 60,
            missing: 2,
        },
    )
    .unwrap();
    assert_eq!(numbered.reference, Some(0));
    assert!(numbered.notes.is_empty(), "{:?}", numbered.notes);
    assert_eq!(*numbered.marks.last().unwrap(), 14 * 60 + 57);
}

/// Pulses of a wheel with errors at a speed that falls slowly, with white noise of the instants.
fn coast(errors: &[f64], seed: u64, noise: f64, seconds: f64) -> Pulses {
    let mut random = Random::new(seed);
    let marks = errors.len();
    let mut times = Vec::new();
    for k in 0.. {
        let angle = k as f64 * TAU / marks as f64 + errors[k % marks];
        // Speed 150 - 12 t.
        let time = 150.0 / 12.0 - ((150.0f64 / 12.0).powi(2) - 2.0 * angle / 12.0).sqrt();
        if time > seconds {
            break;
        }
        times.push(time + 0.01 + noise * random.normal());
    }
    number(&stamped(times), &FULL(marks)).unwrap()
}

#[test]
fn wheel_errors_are_found_within_their_stated_covariance() {
    let (mut square, mut count) = (0.0, 0.0);
    for seed in 0..20 {
        let mut random = Random::new(seed + 100);
        let mut errors = wheel::wheel(&mut random, 60, 1e-3, 2e-3);
        let mean = errors.iter().sum::<f64>() / 60.0;
        errors.iter_mut().for_each(|e| *e -= mean);
        let pulses = coast(&errors, seed, 2e-6, 1.0);
        let pitch = calibrate(&pulses).unwrap();
        assert!(pitch.errors.iter().sum::<f64>().abs() < 1e-12);
        for (k, (found, wanted)) in pitch.errors.iter().zip(&errors).enumerate() {
            square += (found - wanted).powi(2) / pitch.covariance(k, k);
            count += 1.0;
        }
        // Every row sums to zero: the sum of the errors is known to be zero.
        let row: f64 = (0..60).map(|k| pitch.covariance(7, k)).sum();
        assert!(row.abs() < 1e-3 * pitch.covariance(7, 7), "{row}");
    }
    // Mean square of 1180 standardised errors: 1 with a standard deviation of 0.04; the noise of neighbouring revolutions,
    // which give the speed, adds a little.
    let mean: f64 = square / count;
    assert!((0.85..1.3).contains(&mean), "{mean}");
}

#[test]
fn an_odd_mark_is_found() {
    let mut errors = wheel::wheel(&mut Random::new(5), 24, 3e-4, 0.0);
    errors[17] += 0.02;
    assert_eq!(
        calibrate(&coast(&errors, 3, 1e-6, 1.0)).unwrap().odd,
        Some(17)
    );
}

#[test]
fn too_few_revolutions_are_not_calibrated() {
    let refusal = calibrate(&coast(&[0.0; 60], 1, 1e-6, 0.06)).unwrap_err();
    assert!(refusal.needed.contains("three revolutions"), "{refusal}");
}

#[test]
fn the_pattern_of_intervals_shows_the_marks_of_the_wheel() {
    for (marks, seed) in [(60, 1), (36, 2), (100, 3)] {
        let errors = wheel::wheel(&mut Random::new(seed), marks, 1e-3, 0.0);
        let pulses = coast(&errors, seed, 1e-6, 1.5);
        assert_eq!(period(&pulses), Some(marks));
        // What the user says does not matter: he may be wrong.
        let wrong = number(&stamped(pulses.times.clone()), &FULL(50)).unwrap();
        assert_eq!(period(&wrong), Some(marks));
        assert_eq!(check_marks(&pulses), Marks::Shown);
        let Marks::Contradicted(refusal) = check_marks(&wrong) else {
            panic!("{marks}");
        };
        assert!(
            refusal.found.contains(&format!("after {marks} pulses, 50")),
            "{refusal}"
        );
    }
    // A perfect wheel has no pattern.
    let even = coast(&[0.0; 60], 9, 1e-6, 1.5);
    assert_eq!(period(&even), None);
    let Marks::Unclear(why) = check_marks(&even) else {
        panic!("an even wheel");
    };
    assert!(why.to_string().contains("noise of their instants"), "{why}");
}

#[test]
fn sampled_pickups_do_not_mislead_about_the_marks() {
    for seed in 0..20 {
        let truth = wheel::spin_up(seed, 150.0, 7200.0, 0.6);
        let samples = wheel::pickup(&truth, seed, 60, 1e4);
        let found = edges(0.0, 1e-4, &samples, Flank::Rising).unwrap();
        let pulses = number(&found, &FULL(60)).unwrap();
        assert!(pulses.notes.is_empty(), "{seed}: {:?}", pulses.notes);
        assert_eq!(check_marks(&pulses), Marks::Shown, "seed {seed}");
        // The halves of one of these wheels look alike, by three deviations of chance: one in two hundred does.
        let found = if seed == 6 { 30 } else { 60 };
        assert_eq!(period(&pulses), Some(found), "seed {seed}");
    }
}

#[test]
fn times_that_do_not_increase_are_refused() {
    for times in [
        vec![0.0, 1.0, 1.0],
        vec![0.0, 2.0, 1.0],
        vec![0.0, f64::NAN, 1.0],
    ] {
        assert!(
            Edges::stamped(times, 1e-6, None)
                .and_then(|e| number(&e, &FULL(60)))
                .is_err()
        );
    }
    assert!(Edges::stamped(vec![], 1e-6, None).is_err());
    assert!(Edges::stamped(vec![1.0], 0.0, None).is_err());
    assert!(number(&stamped(vec![0.0, 1.0]), &FULL(0)).is_err());
}

proptest! {
    #[test]
    fn nothing_panics(samples in prop::collection::vec(prop_oneof![
        4 => -1.0..1.0, 2 => Just(0.0), 2 => Just(5.0), 1 => Just(f64::NAN), 1 => Just(f64::INFINITY), 1 => Just(1e308)
    ], 0..400), marks in 0usize..80, missing in 0usize..3, both in any::<bool>()) {
        let flank = if both { Flank::Both } else { Flank::Rising };
        if let Ok(found) = edges(0.0, 1e-3, &samples, flank)
            && let Ok(pulses) = number(&found, &Wheel { marks, missing })
        {
            let pitch = calibrate(&pulses).ok();
            let _ = period(&pulses);
            if let Ok(speed) = smooth(&pulses, pitch.as_ref(), &SpeedSettings::default()) {
                let _ = speed.at(0.1);
            }
        }
    }
}

fn data(name: &str) -> String {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    std::fs::read_to_string(folder.join(name)).unwrap()
}

/// MATLAB's `tachorpm` on a sweep from 600 to 3000 rpm in 10 s, one pulse per revolution, 1 kHz, levels 0 and 1.
///
/// Source: github.com/rcgsheffield/tachorpm, data/; the sweep is the formula in its test file.
#[test]
fn speed_of_the_sweep_as_matlab_finds_it() {
    let (input, reference) = (
        data("tachorpm/test_input.csv"),
        data("tachorpm/matlab_ref_output.csv"),
    );
    let column = |text: &str| -> Vec<(f64, f64)> {
        text.lines()
            .skip(1)
            .filter_map(|line| line.split_once(','))
            .map(|(a, b)| (a.trim().parse().unwrap(), b.trim().parse().unwrap()))
            .collect()
    };
    let samples: Vec<f64> = column(&input).iter().map(|x| x.1).collect();
    let found = edges(0.0, 1e-3, &samples, Flank::Centre).unwrap();
    assert_eq!(found.times.len(), 300);
    let pulses = number(&found, &FULL(1)).unwrap();
    assert!(pulses.notes.is_empty(), "{:?}", pulses.notes);
    let speed = smooth(
        &pulses,
        None,
        &SpeedSettings {
            transient: Transient::None,
            ..Default::default()
        },
    )
    .unwrap();
    let (mut against_matlab, mut against_truth, mut matlab, mut inside, mut count) =
        (0.0, 0.0, 0.0, 0.0, 0.0);
    for (time, rpm) in column(&reference) {
        let motion = speed.at(time);
        let (ours, band) = (
            motion.speed * 30.0 / std::f64::consts::PI,
            motion.speed_uncertainty() * 30.0 / std::f64::consts::PI,
        );
        let truth = 600.0 + 240.0 * time;
        // The tolerance of the reference's own tests at single instants: 5 %.
        assert!(
            (ours / rpm - 1.0).abs() < 0.05,
            "{time} s: {ours} against {rpm} rpm"
        );
        against_matlab += (ours - rpm).powi(2);
        against_truth += (ours - truth).powi(2);
        matlab += (rpm - truth).powi(2);
        inside += ((ours - truth).abs() < 2.0 * band) as u8 as f64;
        count += 1.0;
    }
    let rms = |sum: f64| (sum / count).sqrt();
    println!(
        "sweep: rms {:.2} rpm to MATLAB, {:.2} rpm to the truth (MATLAB {:.2} rpm), {:.1} % within two standard deviations",
        rms(against_matlab),
        rms(against_truth),
        rms(matlab),
        100.0 * inside / count
    );
    // Its own tests allow 5 % of the range of 2400 rpm; the sweep itself is a better judge: 0.2 %.
    assert!(rms(against_matlab) < 0.005 * 2400.0);
    assert!(rms(against_truth) < 0.002 * 2400.0);
}

/// Three passages of a proximity probe, about 0.3 s apart, with noise and a bell shape: no flat top.
///
/// Source: github.com/Bladesight/Bladesight, docs/assets.
#[test]
fn passages_of_a_proximity_probe() {
    let text = data("bladesight/ch02_proximity_probe_data.json");
    let values = |key: &str| -> Vec<f64> {
        text.split(&format!("\"{key}\":"))
            .skip(1)
            .map(|rest| {
                rest.split([',', '}', '\n'])
                    .next()
                    .unwrap()
                    .trim()
                    .parse()
                    .unwrap()
            })
            .collect()
    };
    let (times, samples) = (values("time"), values("data"));
    let interval = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
    let take = |flank| edges(times[0], interval, &samples, flank).unwrap();
    let (rising, falling, centre) = (
        take(Flank::Rising),
        take(Flank::Falling),
        take(Flank::Centre),
    );
    println!("rising {:?} ± {:?}", rising.times, rising.uncertainties);
    println!("falling {:?}", falling.times);
    println!(
        "revolutions {:?}",
        centre
            .times
            .windows(2)
            .map(|p| p[1] - p[0])
            .collect::<Vec<_>>()
    );
    assert_eq!((rising.times.len(), falling.times.len()), (3, 3));
    // Read off the file: the samples on both sides of half the height, 0.37.
    let half: Vec<f64> = samples
        .windows(2)
        .zip(&times)
        .filter(|(pair, _)| pair[0] < 0.37 && pair[1] >= 0.37)
        .map(|(pair, time)| time + interval * (0.37 - pair[0]) / (pair[1] - pair[0]))
        .collect();
    assert_eq!(half.len(), 3);
    for (ours, theirs) in rising.times.iter().zip(&half) {
        // A straight line through the flank against one interval of it: noise of 0.01 on a slope of 0.04 a sample.
        assert!((ours - theirs).abs() < 0.8 * interval, "{ours} {theirs}");
    }
    // The rotor turns evenly: both revolutions last the same, whatever flank is taken.
    for found in [&rising, &falling, &centre] {
        let turns: Vec<f64> = found
            .times
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .collect();
        assert!(
            (turns[1] - turns[0]).abs() < 0.8e-3 && (turns[0] - 0.3006).abs() < 1.5e-3,
            "{turns:?}"
        );
    }
}
