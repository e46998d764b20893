//! A rotor of one node, an unbalance on its axis, is the rotor of a drop.

use crate::machines::{Blind, by, reference, settings};
use model::rotor::{Coordinate, RotorConstants, Unbalance};
use model::system::machine::simulate::Steps;
use model::system::machine::{MachineConstants, RotorMachine};
use number::Vec2;

/// The reference drop with its rotor as one node of mass m: I_p = I_G + m e², u = m e.
fn of_one_node(drop: &MachineConstants) -> MachineConstants {
    let mut out = drop.clone();
    let own = &drop.rotor;
    let (mass, offset) = (own.coordinates[0].mass, own.coordinates[0].unbalance.x);
    let row = vec![1.0 / mass.sqrt()];
    let about_axis = own.polar_inertia + mass * offset * offset;
    let node = Coordinate {
        frequency: 0.0,
        mass: 1.0,
        weight: mass.sqrt(),
        unbalance: Vec2::zero(),
    };
    out.rotor = RotorConstants {
        coordinates: vec![node],
        ..RotorConstants::point(1.0, about_axis, 0.0)
    }
    .with_unbalance(&[Unbalance {
        node: row.clone(),
        product: mass * offset,
        phase: 0.0,
    }]);
    for part in &mut out.bearings {
        part.node.clone_from(&row);
    }
    out
}

#[test]
fn a_rotor_of_one_node_falls_as_the_drop_does() {
    let drop = reference();
    let node = of_one_node(&drop);
    assert!((node.rotor.polar_inertia / drop.rotor.polar_inertia - 1.0).abs() < 1e-12);
    let scale = drop.rotor.coordinates[0].mass.sqrt();
    let [drop, node] = [drop, node].map(RotorMachine::new);
    let at = drop.layout().rotor;
    let lateral: Vec<usize> = (0..4).map(|block| at.block(block).start).collect();
    let to_node = |state: &[f64]| {
        let mut out = state.to_vec();
        lateral.iter().for_each(|k| out[*k] *= scale);
        out
    };
    let end = |machine: &RotorMachine, start: &[f64], seconds: f64| {
        let settings = settings(seconds, 1e-7);
        by(Steps::Explicit, machine, start, &settings, &mut Blind).state
    };
    // in the first impact, and in the middle of the spin-up
    let start = drop.start();
    let mut before = start.clone();
    for (seconds, tolerance) in [(8.5e-3, 1e-7), (20e-3, 1e-5)] {
        let (point, own) = (
            end(&drop, &start, seconds),
            end(&node, &to_node(&start), seconds),
        );
        let inner = drop.layout().bearings[0].inner.spin();
        let spun = (own[inner] / point[inner] - 1.0).abs();
        assert!(
            point[inner] > 1.0 && spun < tolerance,
            "{seconds}: {spun:.1e}"
        );
        before.clone_from(&point);
    }
    // derivatives at a state of contact
    let (rates, _) = drop.inspect(&before);
    let (own, _) = node.inspect(&to_node(&before));
    let expected = to_node(&rates);
    for k in 0..drop.layout().ledger() {
        let size = expected[k].abs().max(1e-3);
        assert!(
            (own[k] - expected[k]).abs() < 1e-9 * size,
            "{k}: {} {}",
            own[k],
            expected[k]
        );
    }
}
