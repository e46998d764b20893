//! Energy and angular momentum of a rotor that bends: what flows is what changes.

use crate::machines::bent::bent;
use crate::machines::{Blind, by, settings, vec2};
use model::levitation::{Fade, FadingMagnet};
use model::system::machine::simulate::Steps;
use model::system::machine::{MachineConstants, RotorMachine};
use solve::Stop;

/// A drop with everything that a rotor may have: gyroscopic moments, both dampings, drive, drag, magnets that fade, gravity.
fn loaded() -> (MachineConstants, Vec<f64>) {
    let (mut constants, start) = bent(3e4);
    constants.rotor.drive_torque = 1.0;
    constants.rotor.drive_slope = 2e-4;
    constants.rotor.drag = 1e-4;
    constants.rotor.drag_square = 1e-7;
    constants.magnets = vec![FadingMagnet {
        node: constants.bearings[0].node.clone(),
        fade: Fade {
            force: vec2(-10.0, 30.0),
            stiffness: 1e5,
            decay_rate: 500.0,
            cut: 0.0,
        },
    }];
    let machine = RotorMachine::new(constants.clone());
    let mut state = vec![0.0; solve::Machine::dimension(&machine)];
    let old = RotorMachine::new(bent(3e4).0);
    state[..machine.layout().ledger()].copy_from_slice(&start[..old.layout().ledger()]);
    (constants, state)
}

/// Relative to what is turned over: energy, angular momentum.
fn residuals(
    constants: MachineConstants,
    start: &[f64],
    steps: Steps,
    tolerance: f64,
    end: f64,
) -> (f64, f64) {
    let machine = RotorMachine::new(constants);
    let ending = by(
        steps,
        &machine,
        start,
        &settings(end, tolerance),
        &mut Blind,
    );
    assert_eq!(ending.stop, Stop::Finished);
    let balance = machine.balance(start, &ending.state);
    // both bearings were hit and spun up, the shaft bends
    for at in &machine.layout().bearings {
        assert!(
            ending.state[at.inner + 5] > 10.0,
            "{}",
            ending.state[at.inner + 5]
        );
    }
    assert!(balance.heat() > 0.5, "{}", balance.heat());
    let spin = machine.constants.rotor.polar_inertia * machine.constants.speed;
    println!(
        "{steps:?} {tolerance}: {:?}, heat {} J",
        ending.work,
        balance.heat()
    );
    (
        balance.energy_residual() / balance.heat().max(balance.work_size()),
        balance.angular_momentum_residual() / spin,
    )
}

#[test]
fn energy_and_angular_momentum_close_through_a_drop() {
    let (constants, start) = loaded();
    for (steps, tolerance, energy, momentum) in [
        (Steps::Explicit, 1e-4, 1e-5, 1e-7),
        (Steps::Explicit, 1e-6, 1e-7, 1e-9),
        (Steps::Implicit, 1e-4, 1e-5, 1e-7),
    ] {
        let (of_energy, of_momentum) = residuals(constants.clone(), &start, steps, tolerance, 0.02);
        println!("energy {of_energy:e}, angular momentum {of_momentum:e}");
        assert!(
            of_energy.abs() < energy,
            "{steps:?} {tolerance}: {of_energy}"
        );
        assert!(
            of_momentum.abs() < momentum,
            "{steps:?} {tolerance}: {of_momentum}"
        );
    }
}
