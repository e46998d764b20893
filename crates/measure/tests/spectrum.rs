//! Spectra against signals whose spectrum is known.

use crate::synthetic::rig::Random;
use measure::shaft::Shaft;
use measure::spectrum::{AngularSettings, order_spectrogram, spectrogram, spectrum};
use std::f64::consts::TAU;

fn peak(list: &[f64]) -> (usize, f64) {
    let index = (0..list.len())
        .max_by(|&a, &b| list[a].total_cmp(&list[b]))
        .expect("not empty");
    (index, list[index])
}

/// A sine on a line of the spectrum has its amplitude, also at an odd length.
#[test]
fn amplitudes_are_calibrated() {
    for length in [1000, 625] {
        let interval = 1e-3;
        let signal: Vec<f64> = (0..10_000)
            .map(|k| 5.0 + 3.0 * (TAU * 80.0 * k as f64 * interval).cos())
            .collect();
        let found = spectrum(&signal, interval, length).expect("a spectrum");
        let (at, amplitude) = peak(&found.amplitude);
        assert!((found.frequency[at] - 80.0).abs() < 1e-9);
        assert!((amplitude - 3.0).abs() < 1e-9, "{length}: {amplitude}");
    }
}

/// Between lines Hann's window loses 15 %.
#[test]
fn between_lines_the_amplitude_is_known_to_15_per_cent() {
    let signal: Vec<f64> = (0..10_000)
        .map(|k| (TAU * 80.5e-3 * k as f64).cos())
        .collect();
    let found = spectrum(&signal, 1e-3, 1000).expect("a spectrum");
    assert!((peak(&found.amplitude).1 - 0.849).abs() < 2e-3);
}

/// White noise of variance 4 at 1000 values a second has the density 4/500, and its integral is the variance.
#[test]
fn densities_are_calibrated() {
    let mut random = Random::new(1);
    let signal: Vec<f64> = (0..200_000).map(|_| 2.0 * random.normal()).collect();
    let found = spectrum(&signal, 1e-3, 500).expect("a spectrum");
    let inner = &found.density[5..245];
    let mean = inner.iter().sum::<f64>() / 240.0;
    // 200 000 values: 0.3 %; three deviations.
    assert!((mean / 8e-3 - 1.0).abs() < 0.01, "{mean}");
    let total: f64 = found.density.iter().sum::<f64>() * 2.0;
    assert!((total / 4.0 - 1.0).abs() < 0.02);
}

#[test]
fn missing_values_cost_their_segment_only() {
    let mut signal: Vec<f64> = (0..4000).map(|k| (TAU * 0.05 * k as f64).sin()).collect();
    signal[1500] = f64::NAN;
    let found = spectrum(&signal, 1.0, 500).expect("a spectrum");
    assert!((peak(&found.amplitude).1 - 1.0).abs() < 1e-9);
    let over_time = spectrogram(&signal, 1.0, 500).expect("a spectrogram");
    assert!(
        (over_time.density.iter().map(|one| one[10].is_nan()))
            .eq((0..15).map(|k| k == 5 || k == 6))
    );
    // Hann's window has a bandwidth of 1.5 lines
    let line = (over_time.density[2][25] * 2.0 * 1.5 / 500.0).sqrt();
    assert!((line - 1.0).abs() < 1e-9, "{line}");
}

/// A chirp that runs from 50 to 250 Hz is found where it is.
#[test]
fn a_spectrogram_follows_a_chirp() {
    let signal: Vec<f64> = (0..10_000)
        .map(|k| {
            let t = k as f64 * 1e-3;
            (TAU * (50.0 * t + 10.0 * t * t)).sin()
        })
        .collect();
    let found = spectrogram(&signal, 1e-3, 256).expect("a map");
    for (time, one) in found.time.iter().zip(&found.density) {
        let frequency = found.frequency[peak(one).0];
        assert!(
            (frequency - 50.0 - 20.0 * time).abs() < 4.0,
            "{time}: {frequency}"
        );
    }
}

/// Speed 60 to 180 rad/s: orders 1 and 4.3 smear over frequency and stand over order; a line at 700 Hz that aliases at low speed is
/// kept out.
#[test]
fn orders_stand_in_the_order_spectrogram() {
    let interval = 1.0 / 5000.0;
    let angle = |t: f64| 60.0 * t + 12.0 * t * t;
    let times: Vec<f64> = (0..500).map(|k| k as f64 * 0.01).collect();
    let angles: Vec<f64> = times.iter().map(|&t| angle(t)).collect();
    let speeds: Vec<f64> = times.iter().map(|t| 60.0 + 24.0 * t).collect();
    let shaft = Shaft {
        first: 0.0,
        interval: 0.01,
        angle: &angles,
        speed: &speeds,
        speed_deviation: &[],
    };
    let signal: Vec<f64> = (0..24_000)
        .map(|k| {
            let t = k as f64 * interval;
            2.0 * angle(t).cos() + 0.5 * (4.3 * angle(t)).sin() + 3.0 * (TAU * 700.0 * t).sin()
        })
        .collect();
    let settings = AngularSettings {
        highest_order: 10.0,
        turns: 10,
        slowest: 10.0,
    };
    let found = order_spectrogram(&signal, 0.0, interval, &shaft, &settings).expect("a map");
    let inner = &found.amplitude[1..found.amplitude.len() - 1];
    for one in inner {
        assert!((one[10] - 2.0).abs() < 0.01, "{}", one[10]);
        assert!((one[43] - 0.5).abs() < 0.01, "{}", one[43]);
        assert!(
            one[70..].iter().all(|a| *a < 0.01),
            "{:?}",
            peak(&one[70..])
        );
    }
}

#[test]
fn what_has_no_spectrum_is_refused() {
    assert!(
        spectrum(&[1.0; 10], 1.0, 16)
            .expect_err("short")
            .contains("10 values")
    );
    assert!(
        spectrum(&[1.0; 10], 0.0, 8)
            .expect_err("interval")
            .contains("interval")
    );
    assert!(
        spectrum(&[f64::NAN; 10], 1.0, 8)
            .expect_err("nothing")
            .contains("every segment")
    );
    assert!(
        spectrum(&[1.0; 10], 1.0, 2)
            .expect_err("tiny")
            .contains("too short")
    );
    let shaft = Shaft {
        first: 0.0,
        interval: 1.0,
        angle: &[0.0, 0.0],
        speed: &[0.0, 0.0],
        speed_deviation: &[],
    };
    let settings = AngularSettings {
        highest_order: 10.0,
        turns: 10,
        slowest: 10.0,
    };
    assert!(
        order_spectrogram(&[1.0; 10], 0.0, 0.1, &shaft, &settings)
            .expect_err("rest")
            .contains("never turns")
    );
}
