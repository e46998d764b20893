//! The slow state of the lubricant in a drop: implicit steps, and what is paid where there is none.

use super::relatives::grease;
use crate::machines::{by, lubricant, planar, reference, settings};
use model::bearing::lubricant_state::STATES;
use model::bearing::{SharedMoment, SteadyMoment};
use model::system::machine::record::Record;
use model::system::machine::simulate::Steps;
use model::system::machine::{MachineConstants, RotorMachine};
use solve::{Ending, Stop};

/// The reference machine with a grease whose films warm within milliseconds.
fn warming() -> MachineConstants {
    let mut constants = reference();
    let bearing = planar(&mut constants);
    bearing.ball.orbit_drag = 0.0;
    bearing.ball.spin_drag = 0.0;
    bearing.moment = Some(SharedMoment {
        law: SteadyMoment::Palmgren(grease()),
        axial_load: 0.0,
        orbit_share: 0.5,
        reference_spin: 1.0,
    });
    let mut slow = lubricant();
    slow.films.as_mut().expect("they warm").heat_capacity = 0.01;
    bearing.lubricant = Some(slow);
    constants
}

fn implicit(machine: &RotorMachine, end: f64, tolerance: f64) -> (Ending, Record) {
    let mut record = Record::new(machine, end, 1e-3, false);
    let settings = settings(end, tolerance);
    let ending = by(
        Steps::Implicit,
        machine,
        &machine.start(),
        &settings,
        &mut record,
    );
    assert_eq!(ending.stop, Stop::Finished);
    (ending, record)
}

fn explicit(machine: &RotorMachine, end: f64, tolerance: f64) -> (Ending, Record) {
    let mut record = Record::new(machine, end, 1e-3, false);
    let settings = settings(end, tolerance);
    let ending = by(
        Steps::Explicit,
        machine,
        &machine.start(),
        &settings,
        &mut record,
    );
    assert_eq!(ending.stop, Stop::Finished);
    (ending, record)
}

#[test]
fn implicit_steps_change_the_lubricant_as_explicit_ones_do() {
    let machine = RotorMachine::new(warming());
    // past the first contact, while the race gains speed
    let end = 0.015;
    let (ours, record) = implicit(&machine, end, 1e-4);
    let (expected, other) = explicit(&machine, end, 1e-6);
    let at = |ending: &Ending| {
        let own = &ending.state[..machine.layout().ledger()];
        own[own.len() - STATES..].to_vec()
    };
    let (ours_at, expected_at) = (at(&ours), at(&expected));
    assert!(expected_at[0] > 0.02 && expected_at[1] > 1e-4 && expected_at[2] > 5.0);
    // the spread that a tolerance of 1e-4 leaves in the spin-up of the balls
    for (ours, expected) in ours_at.iter().zip(&expected_at) {
        assert!(
            (ours / expected - 1.0).abs() < 5e-3,
            "{ours_at:?} {expected_at:?}"
        );
    }
    let peak = |record: &Record| record.bearings[0].contacts[0].peak_force;
    assert!((peak(&record) - peak(&other)).abs() < 0.1);
    for ending in [&ours, &expected] {
        let balance = machine.balance(&machine.start(), &ending.state);
        let residual = balance.energy_residual() / balance.heat();
        assert!(residual.abs() < 1e-6, "{residual}");
    }
}
