//! Steps and faults of a converter.

use crate::synthetic::rig::Random;
use measure::converter::{Converter, Fault, Interval, faults};
use std::f64::consts::TAU;

/// 14 bits.
fn converter() -> Converter {
    Converter {
        lowest: -10.0,
        highest: 10.0,
        bits: 14,
    }
}

/// The rounding error of a noisy signal has the stated size.
#[test]
fn rounding_noise_is_as_stated() {
    let c = Converter {
        bits: 8,
        ..converter()
    };
    let mut random = Random::new(2);
    let mut squares = 0.0;
    for _ in 0..20_000 {
        let value = random.normal();
        squares += ((value / c.step()).round() * c.step() - value).powi(2);
    }
    let found = (squares / 20_000.0_f64).sqrt();
    // 20 000 values: 0.3 % of a uniform error's rms; three deviations.
    assert!((found / c.rounding_noise() - 1.0).abs() < 0.01);
}

#[test]
fn clipping_drop_outs_and_gaps_are_found() {
    let c = converter();
    let mut random = Random::new(3);
    let mut values: Vec<f64> = (0..5000)
        .map(|k| {
            let value = 11.0 * (TAU * k as f64 / 1000.0).sin() + 0.05 * random.normal();
            ((value / c.step()).round() * c.step()).clamp(c.lowest, c.highest - c.step())
        })
        .collect();
    let clean = values.clone();
    for value in &mut values[1400..1425] {
        *value = 1.234;
    }
    values[3100] = f64::NAN;
    values[3101] = f64::INFINITY;
    let found = faults(&values, Some(&c));
    assert!(
        found.contains(&Interval {
            first: 1400,
            count: 25,
            fault: Fault::Stuck
        }),
        "{found:?}"
    );
    assert!(found.contains(&Interval {
        first: 3100,
        count: 2,
        fault: Fault::Missing
    }));
    let clipped: usize = found
        .iter()
        .filter(|i| i.fault == Fault::Clipped)
        .map(|i| i.count)
        .sum();
    let true_count = clean
        .iter()
        .filter(|v| **v >= c.highest - c.step() || **v <= c.lowest)
        .count();
    assert_eq!(clipped, true_count);
    // Without a description of the converter all of the clipping is still found, a single value too, and nothing else.
    let blind = faults(&clean, None);
    assert!(blind.iter().all(|i| i.fault == Fault::Clipped));
    assert!(blind.iter().any(|i| i.count < 3), "{blind:?}");
    assert_eq!(blind.iter().map(|i| i.count).sum::<usize>(), true_count);
}

/// A quiet channel repeats values because its steps are coarse: that is no fault. Nor is any value of plain noise.
#[test]
fn a_quiet_or_noisy_channel_has_no_fault() {
    let mut random = Random::new(4);
    let quiet: Vec<f64> = (0..5000).map(|_| (0.3 * random.normal()).round()).collect();
    assert!(
        faults(&quiet, None).is_empty(),
        "{:?}",
        faults(&quiet, None)
    );
    let noise: Vec<f64> = (0..5000).map(|_| random.normal()).collect();
    assert!(faults(&noise, None).is_empty());
    assert!(faults(&[], None).is_empty());
    // A channel that says the same throughout is dead.
    let dead = faults(&[1.0; 50], None);
    assert_eq!(
        dead,
        [Interval {
            first: 0,
            count: 50,
            fault: Fault::Stuck
        }]
    );
}
