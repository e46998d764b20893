//! Frequency and damping of a sensor from a tap or a step, against synthetic truth.

use crate::synthetic::rig::Random;
use measure::torque_sensor::identify_free_response;
use std::f64::consts::TAU;

const INTERVAL: f64 = 0.002;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Event {
    Tap,
    Twice,
    Load,
    Unload,
    /// A load let down within 0.4 s.
    Slow,
}

/// Free swing after a half-sine tap of 3 ms, or after a step; sampled with noise of two colours.
fn tapped(arm: f64, zeta: f64, seed: u64, event: Event, hard: f64) -> Vec<f64> {
    let mut random = Random::new(seed + 77);
    let omega = TAU * arm;
    let (mut y, mut v) = (
        if event == Event::Unload {
            40.0
        } else {
            0.0_f64
        },
        0.0,
    );
    let (h, every) = (4e-5, 50);
    let count = 1000;
    let begin = 0.2 + INTERVAL * random.uniform();
    let noise = random.coloured(count, 0.15, 0.5);
    let mut reading = Vec::new();
    for (k, noise) in noise.iter().enumerate() {
        reading.push(y + 7.0 + noise);
        for i in 0..every {
            let t = (k * every + i) as f64 * h - begin;
            let tap = |t: f64| {
                if t > 0.0 && t < 0.003 {
                    8000.0 / arm * (t / 0.003 * std::f64::consts::PI).sin()
                } else {
                    0.0
                }
            };
            let force = match event {
                Event::Load => 40.0 * f64::from(u8::from(t > 0.0)),
                Event::Unload => 40.0 * f64::from(u8::from(t <= 0.0)),
                Event::Slow => 40.0 * (t / 0.4).clamp(0.0, 1.0),
                Event::Tap => tap(t),
                Event::Twice => tap(t) + tap(t - 0.9),
            };
            // Semi-implicit Euler: frequency wrong by (ω h)²/24, 1e-5 here.
            v += h * (omega * omega * (force - y - hard * y * y * y) - 2.0 * zeta * omega * v);
            y += h * v;
        }
    }
    reading
}

#[test]
fn a_tap_or_a_step_shows_frequency_and_damping() {
    for (event, start) in [
        (Event::Tap, None),
        (Event::Load, Some(102)),
        (Event::Load, None),
        (Event::Unload, None),
    ] {
        let (mut inside, mut count) = ([0, 0], 0);
        for seed in 0..120 {
            let (arm, zeta) = [(10.0, 0.3), (30.0, 0.207), (60.0, 0.104)][seed % 3];
            let reading = tapped(arm, zeta, seed as u64, event, 0.0);
            let found = identify_free_response(&reading, INTERVAL, start).expect("a swing");
            let (f, z) = (found.sensor.frequency, found.sensor.damping_ratio);
            inside[0] += usize::from((f.value - arm).abs() <= 2.0 * f.deviation);
            inside[1] += usize::from((z.value - zeta).abs() <= 2.0 * z.deviation);
            count += 1;
            assert!(
                (f.value - arm).abs() < 0.05 * arm,
                "{} of {arm} Hz, {event:?}",
                f.value
            );
        }
        let share = inside.map(|n| f64::from(n as u32) / f64::from(count));
        println!(
            "{event:?} from {start:?}: frequency {:.3}, damping {:.3} inside two deviations",
            share[0], share[1]
        );
        // 120 seeds scatter by 0.02
        assert!(
            share.iter().all(|s| (0.90..=0.985).contains(s)),
            "{share:?}"
        );
    }
}

/// A load that is let down slowly sets nothing swinging.
#[test]
fn what_is_neither_tap_nor_step_is_refused() {
    let mut refused = 0;
    for seed in 0..6 {
        let zeta = if seed % 2 == 0 { 0.02 } else { 0.207 };
        let reading = tapped(30.0, zeta, seed, Event::Slow, 0.0);
        match identify_free_response(&reading, INTERVAL, None) {
            Err(why) => {
                println!("{why}");
                refused += usize::from(why.contains("neither a tap nor a step"));
            }
            // what swings on after the end of the ramp is its own
            Ok(found) => {
                let f = found.sensor.frequency;
                println!("{:.2} ± {:.2} {:?}", f.value, f.deviation, found.notes);
                refused += usize::from((f.value - 30.0).abs() < 3.0 * f.deviation);
            }
        }
    }
    assert_eq!(refused, 6);
}

#[test]
fn a_second_tap_ends_the_record() {
    for seed in 0..9 {
        let (arm, zeta) = [(10.0, 0.3), (30.0, 0.207), (60.0, 0.104)][seed % 3];
        let reading = tapped(arm, zeta, seed as u64, Event::Twice, 0.0);
        let found = identify_free_response(&reading, INTERVAL, None).expect("a swing");
        let f = found.sensor.frequency;
        println!("{:.3} ± {:.3} {:?}", f.value, f.deviation, found.notes);
        assert!((f.value - arm).abs() < 3.0 * f.deviation);
        assert!(
            found
                .notes
                .iter()
                .any(|n| n.to_string().contains("second tap")
                    || n.to_string().contains("more than one")),
            "{:?}",
            found.notes
        );
    }
}

/// Mains in the reading: without the line the frequency is off by some deviations.
#[test]
fn a_line_of_the_mains_is_taken_out_and_reported() {
    let (mut inside, mut shown, mut all) = (0, 0, 0);
    for seed in 0..60 {
        let (arm, zeta) = [(10.0, 0.3), (30.0, 0.207), (60.0, 0.104)][seed % 3];
        let mut reading = tapped(arm, zeta, seed as u64, Event::Tap, 0.0);
        for (k, value) in reading.iter_mut().enumerate() {
            *value += 0.8 * (TAU * 50.0 * k as f64 * INTERVAL + seed as f64).sin();
        }
        let found = identify_free_response(&reading, INTERVAL, None).expect("a swing");
        let (f, z) = (found.sensor.frequency, found.sensor.damping_ratio);
        inside += usize::from((f.value - arm).abs() <= 2.0 * f.deviation);
        inside += usize::from((z.value - zeta).abs() <= 2.0 * z.deviation);
        shown += usize::from(found.notes.iter().any(|n| {
            n.to_string().contains("line at 50.") || n.to_string().contains("line at 49.9")
        }));
        all += 1;
    }
    println!("inside {inside} of {}, reported {shown} of {all}", 2 * all);
    assert!(inside as f64 >= 0.9 * 2.0 * all as f64);
    assert_eq!(shown, all);
}

#[test]
fn a_sensor_that_is_not_linear_is_reported() {
    let reading = tapped(60.0, 0.02, 3, Event::Tap, 2e-5);
    let found = identify_free_response(&reading, INTERVAL, None).expect("a swing");
    assert!(
        found
            .notes
            .iter()
            .any(|n| n.to_string().contains("not linear")),
        "{:?}",
        found.notes
    );
    let linear = tapped(60.0, 0.02, 3, Event::Tap, 0.0);
    let found = identify_free_response(&linear, INTERVAL, None).expect("a swing");
    assert!(found.notes.is_empty(), "{:?}", found.notes);
}
