//! A seal on a rotor that floats: its whirl in closed form, on either side of the threshold.

use crate::machines::{reference, run, settings, vec2};
use model::rotor::RotorConstants;
use model::seal::SealConstants;
use model::system::machine::RotorMachine;
use rotor::C64;

/// Forward whirl of m z̈ + c ż + (k - j k_xy) z = 0 after a time, from 0.2 mm; and its growth, 1/s.
fn whirl(damping: f64, cross: f64, end: f64) -> ([f64; 2], C64) {
    const MASS: f64 = 8.0;
    const STIFFNESS: f64 = 4e6;
    let mut constants = reference();
    constants.rotor = RotorConstants::point(MASS, 0.01, 0.0);
    constants.gravity = vec2(0.0, 0.0);
    constants.bearings[0].contact.radial_clearance = 1e-2;
    constants.seals = vec![SealConstants {
        node: vec![1.0],
        centre: vec2(0.0, 0.0),
        carried: vec2(0.0, 0.0),
        rows: vec![(
            0.0,
            [STIFFNESS, cross, -cross, STIFFNESS],
            [damping, 0.0, 0.0, damping],
        )],
    }];
    constants.balance_mounts();
    let machine = RotorMachine::new(constants);
    let square = C64::new(
        damping * damping - 4.0 * MASS * STIFFNESS,
        4.0 * MASS * cross,
    );
    let growth = (square.sqrt() - damping) / (2.0 * MASS);
    let mut state = machine.start();
    let first = C64::new(2e-4, 0.0);
    let rate = growth * first;
    state[..4].copy_from_slice(&[first.re, first.im, rate.re, rate.im]);
    let ending = run(&machine, &state, &settings(end, 1e-8));
    let balance = machine.balance(&state, &ending);
    // 0.08 J in the spring at first
    let residual = balance.energy_residual();
    assert!(residual.abs() < 1e-7, "{residual}");
    ([ending[0], ending[1]], growth)
}

#[test]
fn cross_coupling_makes_whirl_grow_beyond_c_omega_and_decay_below_it() {
    let frequency = (4e6f64 / 8.0).sqrt();
    for damping in [200.0, 800.0] {
        for share in [0.5, 0.999, 1.001, 2.0] {
            let end = 0.05;
            let ([x, y], growth) = whirl(damping, share * damping * frequency, end);
            let exact = 2e-4 * (growth * end).exp();
            let apart = C64::new(x, y) - exact;
            assert!(
                apart.norm() < 1e-5 * exact.norm(),
                "{damping} {share}: {apart}"
            );
            // the threshold is exact but for the damping's own share of the frequency
            assert_eq!(growth.re > 0.0, share > 1.0, "{damping} {share}: {growth}");
        }
    }
}
