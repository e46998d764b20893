//! Orders at varying speed, against a signal whose orders are known.

use crate::synthetic::rig::Random;
use measure::order::orders;
use measure::shaft::Shaft;
use std::f64::consts::TAU;

const INTERVAL: f64 = 1.0 / 4200.0;

fn speed(t: f64) -> f64 {
    80.0 + 14.0 * t + 4.0 * (0.8 * t).sin()
}

fn angle(t: f64) -> f64 {
    80.0 * t + 7.0 * t * t - 5.0 * (0.8 * t).cos()
}

/// Amplitudes that grow with the speed, as by a resonance, and a phase that turns.
fn first_order(t: f64) -> (f64, f64) {
    let amplitude = 1.0 + 2.0 / (1.0 + ((speed(t) - 115.0) / 15.0).powi(2));
    let phase = 0.5 + 0.8 * ((speed(t) - 115.0) / 15.0).atan();
    (amplitude * phase.cos(), -amplitude * phase.sin())
}

fn lists() -> (Vec<f64>, Vec<f64>) {
    let times = (0..2700).map(|k| k as f64 * 0.002);
    (
        times.clone().map(angle).collect(),
        times.map(speed).collect(),
    )
}

/// Signal with orders 1, 2, 4.1 and slow drift, and noise of two colours whose power grows with time.
fn signal(seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    let noise = random.coloured(21_000, 0.7, 0.95);
    (0..21_000)
        .map(|k| {
            let t = k as f64 * INTERVAL;
            let (a, b) = first_order(t);
            let theta = angle(t);
            a * theta.cos()
                + b * theta.sin()
                + 0.6 * (2.0 * theta).cos()
                + 0.4 * (4.1 * theta + 1.0).cos()
                + 0.3 * (TAU * 0.3 * t).sin()
                + (0.5 + 0.1 * t) * noise[k]
        })
        .collect()
}

#[test]
fn two_deviations_cover_the_orders() {
    let (angles, speeds) = lists();
    let shaft = Shaft {
        first: 0.0,
        interval: 0.002,
        angle: &angles,
        speed: &speeds,
        speed_deviation: &[],
    };
    let (mut inside, mut count) = (0, 0);
    let mut worst: f64 = 0.0;
    for seed in 0..100 {
        let found =
            orders(&signal(seed), 0.0, INTERVAL, &shaft, &[1.0, 2.0, 4.1], 2.0).expect("orders");
        for (n, &t) in found.time.iter().enumerate().take(found.time.len() - 1) {
            let (a, b) = first_order(t);
            let truth = [(a, b), (0.6, 0.0), (0.4 * 1f64.cos(), -0.4 * 1f64.sin())];
            for (order, (a, b)) in found.orders.iter().zip(truth) {
                for error in [order.cosine[n] - a, order.sine[n] - b] {
                    inside += usize::from(error.abs() <= 2.0 * order.deviation[n]);
                    count += 1;
                    worst = worst.max(error.abs());
                }
            }
        }
    }
    let share = inside as f64 / count as f64;
    println!("{share:.3} of {count} parts inside two deviations, worst {worst:.2}");
    assert!((0.90..=0.98).contains(&share), "{share}");
}

/// Without noise nothing of the orders is left, and what is not an order stays.
#[test]
fn the_rest_holds_no_order() {
    let (angles, speeds) = lists();
    let shaft = Shaft {
        first: 0.0,
        interval: 0.002,
        angle: &angles,
        speed: &speeds,
        speed_deviation: &[],
    };
    let other = |t: f64| 0.2 * (TAU * 311.0 * t).sin() + 1.0;
    let clean: Vec<f64> = (0..21_000)
        .map(|k| {
            let t = k as f64 * INTERVAL;
            3.0 * angle(t).cos() + other(t)
        })
        .collect();
    let found = orders(&clean, 0.0, INTERVAL, &shaft, &[1.0, 2.0], 2.0).expect("orders");
    let mut worst: f64 = 0.0;
    for k in 500..20_500 {
        worst = worst.max((found.rest[k] - other(k as f64 * INTERVAL)).abs());
    }
    // The other line leaks into the nodes by its share of their bandwidth: 0.2 of a value over 2 Hz in 2100 Hz.
    assert!(worst < 0.01, "{worst}");
    let amplitude = found.orders[0].amplitude();
    assert!((amplitude[50] - 3.0).abs() < 0.01 && found.orders[0].sine[50].abs() < 0.03);
}

#[test]
fn low_speed_and_gaps_are_reported_and_survived() {
    let mut values = signal(3);
    for value in &mut values[5000..6000] {
        *value = f64::NAN;
    }
    let (angles, speeds) = lists();
    let shaft = Shaft {
        first: 0.0,
        interval: 0.002,
        angle: &angles,
        speed: &speeds,
        speed_deviation: &[],
    };
    let found = orders(&values, 0.0, INTERVAL, &shaft, &[1.0, 0.1], 2.0).expect("orders");
    assert!(
        found
            .notes
            .iter()
            .any(|n| n.to_string().contains("order 0.1 is below"))
    );
    assert!(found.rest[5500].is_nan() && found.rest[7000].is_finite());
    assert!(found.orders[0].cosine.iter().all(|v| v.is_finite()));
    let gap = (5500.0 * INTERVAL / (found.time[1] - found.time[0])) as usize;
    assert!(found.orders[0].deviation[gap] > 1.5 * found.orders[0].deviation[gap / 2]);
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let (angles, speeds) = lists();
    let shaft = Shaft {
        first: 0.0,
        interval: 0.002,
        angle: &angles,
        speed: &speeds,
        speed_deviation: &[],
    };
    let values = signal(1);
    let refused = |list: &[f64], bandwidth| {
        orders(&values, 0.0, INTERVAL, &shaft, list, bandwidth).expect_err("refused")
    };
    assert!(refused(&[], 2.0).contains("positive orders"));
    assert!(refused(&[1.0, 1.0], 2.0).contains("twice"));
    assert!(refused(&[1.0], 0.0).contains("bandwidth"));
    assert!(
        orders(&values, 100.0, INTERVAL, &shaft, &[1.0], 2.0)
            .expect_err("apart")
            .contains("in common")
    );
    assert!(
        orders(&[], 0.0, INTERVAL, &shaft, &[1.0], 2.0)
            .expect_err("empty")
            .contains("in common")
    );
}
