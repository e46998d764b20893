//! Balls that roll: closed forms of (18), (19), (20), (21), and the independent spin-up times.

use super::rig::{Run, machine, palmgren, rolling, run};
use crate::machines::vec2;
use model::bearing::{AccelerationLoss, BearingConstants, RollingConstants, SteadyMoment};
use model::system::rig::layout::{
    ACCELERATION, DRIVE_MOMENT, INNER, INNER_MOMENT, OUTER_MOMENT, ROTOR,
};
use model::system::rig::{Drive, RigConstants, SlidingRotor};
use model::table::Table;

/// A rotor so fast that its friction is saturated to the last bit: tanh of thousands is 1.
fn saturated(friction: f64) -> Drive {
    Drive::SlidingRotor(SlidingRotor {
        bore_radius: 12.5e-3,
        friction,
        inverse_reference_speed: 1e3,
        speed: 4000.0,
        polar_inertia: 0.01,
        spin_held: true,
    })
}

fn rolling_machine(bearing: RollingConstants, drive: Drive, load: f64) -> RigConstants {
    let mut constants = machine(BearingConstants::Rolling(bearing), drive, 1000.0);
    constants.load = Table::constant(load);
    constants
}

/// Relative errors of energy and angular momentum over a run.
fn residuals(run: &Run) -> (f64, f64) {
    let heat = run.machine.flows(&run.end).heat;
    let impulse = run.machine.content(&run.end).angular_momentum;
    (
        run.machine.balance(&run.start, &run.end).energy_residual() / heat.max(1e-3),
        run.machine
            .balance(&run.start, &run.end)
            .angular_momentum_residual()
            .abs()
            / impulse.abs().max(1e-6),
    )
}

#[test]
fn without_a_moment_the_race_accelerates_steadily_against_all_inertia() {
    // (19) with M = F = 0: Ω = R_0 μ W t/(I_I + (7/20 N m_b + ¼ m_c) R²)
    let bearing = rolling();
    let inertia = 3.9e-6 + bearing.set.inner_inertia();
    let run = run(rolling_machine(bearing, saturated(0.1), 80.0), 0.02, 1e-6);
    let expected = 12.5e-3 * 0.1 * 80.0 * 0.02 / inertia;
    // an exact straight line: rounding of some hundred steps
    assert!((run.end[INNER.spin()] / expected - 1.0).abs() < 1e-12);
    let (energy, momentum) = residuals(&run);
    assert!(
        energy.abs() < 1e-12 && momentum < 1e-12,
        "{energy} {momentum}"
    );
}

#[test]
fn a_loss_proportional_to_acceleration_is_an_inertia_that_helps_no_brake() {
    let mut bearing = rolling();
    let q = 2e-4;
    bearing.loss = AccelerationLoss::Proportional {
        per_acceleration: q,
    };
    let arm = bearing.set.pocket_friction_arm();
    let inertia = 3.9e-6 + bearing.set.inner_inertia();
    // 10 ms forward, 10 ms against
    let torque = Table::through(vec![(0.0, 0.05), (0.01, 0.05), (0.010001, -0.02)]).expect("rises");
    let c = rolling_machine(bearing.clone(), Drive::Torque(torque), 0.0);
    let faster = run(c.clone(), 0.01, 1e-8);
    let top = 0.05 * 0.01 / (inertia + arm * q);
    assert!((faster.end[INNER.spin()] / top - 1.0).abs() < 1e-10);
    let whole = run(c, 0.02, 1e-8);
    // the flank of 1 µs: 5/7 of it forward, then against, with the smaller inertia
    let (forward, against) = (0.5 * 0.05 * 5.0 / 7.0 * 1e-6, 0.5 * 0.02 * 2.0 / 7.0 * 1e-6);
    let peak = top + forward / (inertia + arm * q);
    let expected = peak - (against + 0.02 * (0.01 - 1e-6)) / (inertia - arm * q);
    let speed = whole.end[INNER.spin()];
    assert!((speed - expected).abs() < 1e-6 * top, "{speed} {expected}");
    // what 0.02 N m took away is more than two fifths of what 0.05 N m gave
    assert!(expected > 0.0 && top - expected > 1.5 * 0.4 * top);
    // F only takes: its heat is arm F Ω all the way
    let heat = whole.end[whole.machine.layout().heat(6)];
    let closed = 0.5 * arm * q * (2.0 * peak * peak - speed * speed);
    assert!((heat / closed - 1.0).abs() < 1e-6, "{heat} {closed}");
    let (energy, momentum) = residuals(&whole);
    assert!(
        energy.abs() < 1e-8 && momentum < 1e-8,
        "{energy} {momentum}"
    );
}

#[test]
fn from_rest_the_loss_acts_whichever_way_the_race_sets_off() {
    let mut bearing = rolling();
    bearing.loss = AccelerationLoss::Proportional {
        per_acceleration: 2e-4,
    };
    let end = |torque: f64| {
        let drive = Drive::Torque(Table::constant(torque));
        run(rolling_machine(bearing.clone(), drive, 0.0), 0.01, 1e-6).end[INNER.spin()]
    };
    assert_eq!(end(0.05), -end(-0.05));
}

#[test]
fn moments_on_both_races_are_those_of_14_and_15() {
    let mut bearing = rolling();
    bearing.moment = SteadyMoment::Palmgren(palmgren());
    bearing.loss = AccelerationLoss::Affine {
        force: Table::through(vec![(0.0, 0.1), (500.0, 0.3), (800.0, 0.2)]).expect("rises"),
        per_acceleration: Table::through(vec![(0.0, 1e-5), (400.0, 3e-5)]).expect("rises"),
    };
    let set = bearing.set;
    let loss = bearing.loss.clone();
    let speed = Table::through(vec![(0.0, 0.0), (0.1, 720.0), (0.15, 300.0)]).expect("rises");
    let c = rolling_machine(bearing, Drive::Speed(speed), 80.0);
    let run = run(c, 0.15, 1e-6);
    let mut seen = 0;
    for row in run
        .record
        .rows()
        .filter(|row| row.time > 1e-3 && row.time < 0.149)
    {
        let omega = row.state[INNER.spin()];
        let rate = if row.time < 0.1 { 7200.0 } else { -8400.0 };
        if (row.time - 0.1).abs() < 1e-6 {
            continue; // the knot itself belongs to either side
        }
        let expected = if row.time < 0.1 {
            7200.0 * row.time
        } else {
            720.0 - 8400.0 * (row.time - 0.1)
        };
        assert!((omega - expected).abs() < 1e-9, "{omega} {expected}");
        let m = palmgren().moment(omega, 80.0);
        let f = loss.force(omega, rate);
        let traction = set.inner_traction(set.rolling(rate), f);
        let outer = set.outer_traction(set.rolling(rate), f);
        // rounding
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
        assert!(near(row.probe[INNER_MOMENT], set.inner_moment(m, traction)));
        assert!(near(row.probe[OUTER_MOMENT], set.outer_moment(m, outer)));
        assert!(near(
            row.probe[DRIVE_MOMENT],
            row.probe[INNER_MOMENT] + 3.9e-6 * rate
        ));
        assert!(near(row.probe[ACCELERATION], rate));
        // in the pockets: F times the sliding speed r(ω_b + ω_c)
        let (change, _) = run.machine.inspect_at(row.time, row.state);
        let sliding = set.inner_track_radius
            * set.ball_ratio
            * (set.ball_spin(omega) + set.cage_speed(omega));
        assert!(near(change[run.machine.layout().heat(6)], f * sliding));
        seen += 1;
    }
    assert!(seen > 90, "{seen}");
    let (energy, momentum) = residuals(&run);
    // error control at 1e-6
    assert!(
        energy.abs() < 1e-7 && momentum < 1e-7,
        "{energy} {momentum}"
    );
}

#[test]
fn rolling_balls_fulfil_the_corrected_energy_form_and_not_the_printed_one() {
    let mut bearing = rolling();
    bearing.moment = SteadyMoment::Palmgren(palmgren());
    bearing.loss = AccelerationLoss::Constant { force: 0.2 };
    let run = run(rolling_machine(bearing, saturated(0.2), 80.0), 0.04, 1e-8);
    let energy = run.machine.outer_race_energy(&run.start, &run.end);
    let true_loss = energy.dissipated;
    assert!(true_loss > 0.5);
    // error control at 1e-8
    assert!((energy.exact / true_loss - 1.0).abs() < 1e-8, "{energy:?}");
    assert!(
        (energy.corrected / true_loss - 1.0).abs() < 1e-8,
        "{energy:?}"
    );
    assert!(
        (energy.path / energy.least_path - 1.0).abs() < 1e-8,
        "{energy:?}"
    );
    assert!((energy.printed / true_loss - 1.0).abs() > 0.2, "{energy:?}");
    assert_eq!(energy.path_behind_the_race, 2.0 * energy.least_path);
    assert!(energy.largest_path > energy.path_behind_the_race);
}

#[test]
fn a_loss_over_speed_brakes_a_race_that_coasts() {
    // I Ω̇ = -arm F0(Ω), F0 falling in proportion to Ω: an exponential
    let mut bearing = rolling();
    let force = Table::through(vec![(0.0, 0.0), (2000.0, 0.4)]).expect("rises");
    bearing.loss = AccelerationLoss::OverSpeed { force };
    let arm = bearing.set.pocket_friction_arm();
    let inertia = 3.9e-6 + bearing.set.inner_inertia();
    // 0.2 N m for 5 ms, then nothing
    let torque = vec![(0.0, 0.2), (5e-3, 0.2), (5.001e-3, 0.0)];
    let drive = Drive::Torque(Table::through(torque).expect("rises"));
    let c = rolling_machine(bearing, drive, 0.0);
    let top = run(c.clone(), 5.001e-3, 1e-8).end[INNER.spin()];
    let whole = run(c, 25.001e-3, 1e-8);
    let expected = top * (-arm * 2e-4 * 0.02 / inertia).exp();
    let speed = whole.end[INNER.spin()];
    // error control at 1e-8
    assert!((speed / expected - 1.0).abs() < 1e-6, "{speed} {expected}");
    assert!(expected < 0.999 * top);
}

#[test]
fn a_free_rotor_and_the_race_share_their_angular_momentum() {
    let rotor = SlidingRotor {
        bore_radius: 12.5e-3,
        friction: 0.2,
        inverse_reference_speed: 100.0,
        speed: 800.0,
        polar_inertia: 1e-5,
        spin_held: false,
    };
    let bearing = rolling();
    let (inner, outer) = (bearing.set.inner_inertia(), bearing.set.outer_inertia());
    let run = run(
        rolling_machine(bearing, Drive::SlidingRotor(rotor), 100.0),
        0.2,
        1e-8,
    );
    let (race, rotor) = (run.end[INNER.spin()], run.end[ROTOR.spin()]);
    // error control at 1e-8 while friction is stiff
    assert!((race / rotor - 1.0).abs() < 1e-7, "{race} {rotor}");
    // the outer race takes -J_O Ω̇ from what the rotor gives: the speeds follow from the inertias at the inner race
    let expected = 1e-5 * 800.0 / (1e-5 + 3.9e-6 + inner);
    assert!((race / expected - 1.0).abs() < 1e-7, "{race} {expected}");
    let impulse = run.end[run.machine.layout().angular_impulse()];
    assert!((impulse / (outer * race) - 1.0).abs() < 1e-6);
    let (energy, momentum) = residuals(&run);
    assert!(
        energy.abs() < 1e-7 && momentum < 1e-7,
        "{energy} {momentum}"
    );
}

#[test]
fn steps_end_on_the_knots_of_a_load() {
    // without a moment the speed is the integral of the load: exact only if no step crosses a knot
    let load = Table::through(vec![
        (0.0, 100.0),
        (0.0033, 100.0),
        (0.0034, 20.0),
        (0.009, 60.0),
    ])
    .expect("rises");
    let area = 0.0033 * 100.0 + 0.0001 * 60.0 + 0.0056 * 40.0 + 0.001 * 60.0;
    let bearing = rolling();
    let inertia = 3.9e-6 + bearing.set.inner_inertia();
    let mut c = rolling_machine(bearing, saturated(0.1), 0.0);
    c.load = load;
    let run = run(c, 0.01, 1e-3);
    let expected = 12.5e-3 * 0.1 * area / inertia;
    assert!((run.end[INNER.spin()] / expected - 1.0).abs() < 1e-12);
}

#[test]
fn a_race_free_to_move_closes_its_ledger_too() {
    let mut bearing = rolling();
    bearing.moment = SteadyMoment::Palmgren(palmgren());
    let mut c = rolling_machine(bearing, saturated(0.2), 80.0);
    c.race.centre_held = false;
    c.gravity = vec2(0.0, -9.81);
    let run = run(c, 0.04, 1e-7);
    assert!(run.end[INNER.centre()[1]] < -0.2e-6, "pressed down");
    let (energy, momentum) = residuals(&run);
    assert!(
        energy.abs() < 1e-5 && momentum < 1e-5,
        "{energy} {momentum}"
    );
    let energy = run.machine.outer_race_energy(&run.start, &run.end);
    assert!(
        (energy.exact / energy.dissipated - 1.0).abs() < 1e-5,
        "{energy:?}"
    );
}

/// The spin-up times of the independent reference.
#[test]
fn spin_up_times_are_those_of_the_reference() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../validation/cases/reference/rolling.json"
    );
    let text = std::fs::read_to_string(path).unwrap();
    let spin_ups = text.split("\"spinup\"").nth(1).expect("spin-ups");
    let field = |part: &str, name: &str| -> Option<f64> {
        let rest = part.split(&format!("\"{name}\":")).nth(1)?;
        rest.split([',', '}']).next()?.trim().parse().ok()
    };
    let mut seen = 0;
    for part in spin_ups
        .split('{')
        .skip(1)
        .filter(|part| part.contains("Om_end"))
    {
        let value = |name: &str| field(part, name).expect("a number");
        let mut bearing = rolling();
        bearing.moment = SteadyMoment::PalmgrenPrinted(palmgren());
        bearing.loss = AccelerationLoss::Proportional {
            per_acceleration: value("q"),
        };
        let mut c = rolling_machine(bearing, saturated(value("mu")), value("W"));
        // the record finds 95 % of the target
        c.target_speed = value("Om_end") / 0.95;
        let time = run(c, 0.1, 1e-10).record.bearings[0].inner_race_time_to_95_percent();
        match (time, field(part, "t")) {
            // the reference's own tolerance
            (Some(time), Some(reference)) => {
                assert!((time / reference - 1.0).abs() < 1e-8, "{time} {reference}");
            }
            (None, None) => {}
            other => panic!("{part}: {other:?}"),
        }
        seen += 1;
    }
    assert_eq!(seen, 12);
}

#[test]
fn late_means_begin_when_the_race_is_at_its_speed() {
    // a ramp of 50 ms; a turn of the cage takes 15.3 ms
    let of = |end: f64| {
        let mut bearing = rolling();
        bearing.moment = SteadyMoment::Palmgren(super::rig::palmgren());
        let constants = rolling_machine(bearing, Drive::ramp(20_000.0, 1000.0), 0.0);
        run(constants, end, 1e-6)
            .record
            .rig()
            .turns
            .late_means(1000.0)
    };
    assert_eq!(of(0.06), None, "less than a turn at full speed");
    let late = of(0.1).expect("three turns");
    assert_eq!(late.turns, 2, "the later half of three");
    // balls that roll at a constant speed: both moments are those of the law
    assert!(
        (late.inner_moment / late.steady_moment - 1.0).abs() < 1e-9,
        "{late:?}"
    );
    assert!(
        (late.outer_moment / late.steady_moment - 1.0).abs() < 1e-9,
        "{late:?}"
    );
}
