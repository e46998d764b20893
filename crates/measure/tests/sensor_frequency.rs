//! The frequency at which a sensor rings, beside the one that is stated.

use measure::torque_sensor::{Inversion, Sensor, invert};
use statistics::random::Random;
use statistics::uncertain::Uncertain;
use std::f64::consts::TAU;

const INTERVAL: f64 = 0.002;

#[test]
fn a_sensor_that_rings_at_another_frequency_than_stated_is_told() {
    // a step of 20 N mm on a lightly damped arm, solved by hand
    let (arm, zeta) = (30.0_f64, 0.05_f64);
    let (omega, engaged) = (TAU * arm, 0.3013);
    let damped = omega * (1.0 - zeta * zeta).sqrt();
    for (seed, stated) in [0.5, 0.7, 1.0, 1.4, 2.0].into_iter().enumerate() {
        let mut random = Random::new(40 + seed as u64);
        let reading: Vec<f64> = (0..500)
            .map(|k| {
                let since = f64::max(k as f64 * INTERVAL - engaged, 0.0);
                let swing = (damped * since).cos() + zeta * omega / damped * (damped * since).sin();
                20.0 * (1.0 - (-zeta * omega * since).exp() * swing) + 0.2 * random.normal()
            })
            .collect();
        let shown = invert(&Inversion {
            sensor: Sensor {
                frequency: Uncertain::new(stated * arm, 0.005 * stated * arm),
                damping_ratio: Uncertain::new(zeta, 0.1 * zeta),
            },
            first: 0.0,
            interval: INTERVAL,
            reading: &reading,
            clipped: &[],
            shaft: None,
            engagement: Some(Uncertain::new(engaged, 1e-4)),
            lock: None,
            zero: Uncertain::new(0.0, 1.0),
            scale_deviation: 0.005,
            disturbance_power: None,
        });
        let shown = shown.unwrap().shown_frequency;
        println!("stated {stated}: {shown:?}");
        match stated == 1.0 {
            true => assert_eq!(shown, None),
            false => assert!(
                shown.is_some_and(|shown| (shown / arm - 1.0).abs() < 0.05),
                "{stated}: {shown:?}"
            ),
        }
    }
}
