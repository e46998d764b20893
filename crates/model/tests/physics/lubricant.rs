//! The slow state of the lubricant in a drop: implicit steps, and what is paid where there is none.

use crate::machines::{Random, lubricant, planar, random_state, reference, settings};
use crate::relatives::grease;
use model::bearing::lubricant_state::STATES;
use model::bearing::{SharedMoment, SteadyMoment};
use model::system::drop::linear::DropLinear;
use model::system::drop::record::Record;
use model::system::drop::{Drop, DropConstants, DropMachine};
use solve::{Arrowhead, Ending, Linear, Machine, Stop};
use std::sync::atomic::AtomicBool;

/// The reference machine with a grease whose films warm within milliseconds.
fn warming() -> DropConstants {
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

fn implicit(machine: &DropMachine, end: f64, tolerance: f64) -> (Ending, Record) {
    let mut record = Record::new(machine, end, 1e-3, false);
    let ending = solve::run_implicit::<f64, Drop<f64>, _, _, _, _, _>(
        machine,
        DropLinear::of(machine).expect("planar"),
        &machine.start(),
        &mut record,
        &settings(end, tolerance),
        &AtomicBool::new(false),
    );
    assert_eq!(ending.stop, Stop::Finished);
    (ending, record)
}

fn explicit(machine: &DropMachine, end: f64, tolerance: f64) -> (Ending, Record) {
    let mut record = Record::new(machine, end, 1e-3, false);
    let ending = solve::run::<f64, Drop<f64>, _>(
        &[machine],
        &[machine.start()],
        std::slice::from_mut(&mut record),
        &settings(end, tolerance),
        &AtomicBool::new(false),
    )
    .remove(0);
    assert_eq!(ending.stop, Stop::Finished);
    (ending, record)
}

#[test]
fn implicit_steps_change_the_lubricant_as_explicit_ones_do() {
    let machine = DropMachine::new(warming());
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
    let peak = |record: &Record| record.contacts[0].peak_force;
    assert!((peak(&record) - peak(&other)).abs() < 0.1);
    for ending in [&ours, &expected] {
        let balance = machine.balance(&machine.start(), &ending.state);
        let residual = balance.energy_residual() / balance.heat();
        assert!(residual.abs() < 1e-6, "{residual}");
    }
}

#[test]
fn the_jacobian_of_a_ball_between_warmed_films_is_that_of_its_weaker_traction() {
    // 1/u0 and μ_max stand in ∂/∂spin of the traction alone: a factor F on μ is the law with F μ_max
    let mut warmed = warming();
    planar(&mut warmed).moment = None;
    let machine = DropMachine::new(warmed);
    let mut random = Random(3);
    let state = random_state(&machine, &mut random);
    let own = machine.layout().ledger() - STATES;
    let at = machine
        .constants
        .bearing
        .lubricant_at(&state[16..own + STATES]);
    let factor = at.expect("it has a state").traction_factor;
    assert!((0.4..0.99).contains(&factor), "{factor}");
    let mut weaker = machine.constants.clone();
    let bearing = planar(&mut weaker);
    bearing.lubricant = None;
    if let physics::traction::Traction::Tanh(law) = &mut bearing.traction {
        law.maximum *= factor;
    }
    let weaker = DropMachine::new(weaker);
    let mut short = state[..own].to_vec();
    short.extend_from_slice(&state[own + STATES..]);
    let jacobian = |machine: &DropMachine, state: &[f64]| {
        let mut linear = DropLinear::of(machine).expect("planar");
        let mut arrow = Arrowhead::new(linear.shape());
        linear.jacobian(&machine.start_mode(), 0.0, state, &mut arrow);
        arrow
    };
    let (ours, expected) = (jacobian(&machine, &state), jacobian(&weaker, &short));
    assert_eq!(
        ours.shape().border.len(),
        expected.shape().border.len() + STATES
    );
    for (ours, expected) in ours.blocks.iter().zip(&expected.blocks) {
        for (ours, expected) in (ours.own.iter().flatten()).zip(expected.own.iter().flatten()) {
            // F (μ_max x) and (F μ_max) x
            assert!((ours - expected).abs() <= 1e-12 * expected.abs().max(1.0));
        }
    }
}
