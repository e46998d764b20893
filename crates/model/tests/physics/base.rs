//! A base that is accelerated: gravity of another kind for every body, and what is seen from the ground.

use crate::machines::{
    Random, let_roll, random_state, reference, run, separate, separations, settings, vec2,
};
use model::base::{BaseConstants, HalfSine};
use model::mount::{Housing, MountParts};
use model::schedule::Schedule;
use model::system::machine::{Event, MachineConstants, RotorMachine};
use model::table::Table;
use number::Vec2;
use solve::Machine;
use std::f64::consts::PI;

/// A base whose acceleration is always the same.
fn constant(acceleration: Vec2<f64>) -> BaseConstants {
    BaseConstants {
        record: [acceleration.x, acceleration.y].map(Table::constant),
        shocks: Vec::new(),
    }
}

/// Machines of every kind of bearing, one on a housing, one with a held race.
fn machines() -> Vec<MachineConstants> {
    let mut list: Vec<_> = (separations().into_iter())
        .map(|separation| {
            let mut constants = reference();
            separate(&mut constants, separation);
            constants
        })
        .collect();
    let mut rolls = reference();
    let_roll(&mut rolls);
    let mut held = reference();
    held.bearings[0].inner_race.centre_held = true;
    let mut housed = reference();
    housed.bearings[0].planes = 2.0;
    housed.bearings[0].mount_parts = MountParts {
        housing: Some(Housing {
            mass: 2.0,
            stiffness: 3e7,
            damping: 2e3,
        }),
        ..MountParts::NONE
    };
    list.extend([rolls, held, housed]);
    for constants in &mut list {
        constants.balance_mounts();
    }
    list
}

#[test]
fn an_accelerated_base_is_gravity_against_it_for_every_body() {
    let acceleration = vec2(30.0, -70.0);
    let mut random = Random(5);
    for (kind, constants) in machines().into_iter().enumerate() {
        let mut shaken = constants.clone();
        shaken.base = Some(constant(acceleration));
        // what balances the weights stays that of g
        let mut heavier = constants;
        heavier.gravity = heavier.gravity - acceleration;
        for bearing in &mut heavier.bearings {
            if let model::bearing::BearingConstants::Planar(planar) = &mut bearing.bearing {
                planar.ball.gravity = heavier.gravity;
            }
        }
        let (shaken, heavier) = (RotorMachine::new(shaken), RotorMachine::new(heavier));
        for _ in 0..20 {
            let state = random_state(&shaken, &mut random);
            let (rate, probe) = shaken.inspect(&state);
            let same = |channel: &usize| !shaken.channel_name(*channel).contains("base");
            let kept: Vec<f64> = (0..state.len()).filter(same).map(|k| state[k]).collect();
            let (wanted, probes) = heavier.inspect(&kept);
            let seen = (0..state.len()).filter(same).map(|k| rate[k]);
            for (k, (seen, wanted)) in seen.zip(wanted).enumerate() {
                // gravity does not move a housing: its mount is balanced at any; the motion of its ground does
                let name = heavier.channel_name(k);
                let wanted = match name.rsplit_once("housing.") {
                    Some((_, "x_speed")) => wanted - acceleration.x,
                    Some((_, "y_speed")) => wanted - acceleration.y,
                    _ => wanted,
                };
                let size = wanted.abs().max(100.0);
                assert!(
                    (seen - wanted).abs() < 1e-11 * size,
                    "{kind} {name}: {seen} {wanted}"
                );
            }
            for (seen, wanted) in probe.iter().zip(probes) {
                assert!(
                    (seen - wanted).abs() < 1e-9 * wanted.abs().max(1e3),
                    "{kind}"
                );
            }
        }
    }
}

/// A machine whose base has a record and a shock.
fn shaken(mut constants: MachineConstants) -> MachineConstants {
    let table = |points: Vec<(f64, f64)>| Table::through(points).unwrap();
    let base = BaseConstants {
        record: [
            table(vec![(0.0, 0.0), (0.003, 40.0), (0.008, -60.0), (0.01, 0.0)]),
            table(vec![(0.002, 0.0), (0.004, -90.0), (0.009, 0.0)]),
        ],
        shocks: vec![HalfSine {
            start: 0.001,
            duration: 0.011,
            acceleration: vec2(50.0, 120.0),
        }],
    };
    let knots = base.knots().map(|time| (time, Event::Knot));
    constants.schedule = Schedule::of(knots);
    constants.base = Some(base);
    constants
}

#[test]
fn the_work_of_the_base_closes_energy_and_its_moments_angular_momentum() {
    for (kind, constants) in machines().into_iter().enumerate() {
        let machine = RotorMachine::new(shaken(constants));
        let start = machine.start();
        let ending = run(&machine, &start, &settings(0.015, 1e-6));
        let balance = machine.balance(&start, &ending);
        let layout = machine.layout();
        let work = ending[layout.source(layout.of_rotor.base.unwrap())];
        assert!(work.abs() > 0.01, "{kind}: {work}");
        let turned = balance.heat().max(balance.work_size());
        let (energy, momentum) = (
            balance.energy_residual() / turned,
            balance.angular_momentum_residual(),
        );
        println!("{kind}: {energy:e} {momentum:e}");
        assert!(energy.abs() < 2e-6, "{kind}: {energy}");
        assert!(momentum.abs() < 1e-8, "{kind}: {momentum}");
    }
}

#[test]
fn from_the_ground_a_rotor_that_touches_nothing_only_falls() {
    const END: f64 = 0.02;
    let (start, duration, a) = (0.004, 0.01, vec2(5.0, -8.0));
    let mut constants = reference();
    constants.bearings[0].contact.radial_clearance = 0.1;
    let base = BaseConstants {
        record: [(3.0, 0.0), (-2.0, 6.0)]
            .map(|(from, to)| Table::through(vec![(0.0, from), (END, to)]).unwrap()),
        shocks: vec![HalfSine {
            start,
            duration,
            acceleration: a,
        }],
    };
    constants.schedule = Schedule::of(base.knots().map(|time| (time, Event::Knot)));
    constants.base = Some(base);
    let machine = RotorMachine::new(constants);
    let first = machine.start();
    let ending = run(&machine, &first, &settings(END, 1e-8));
    // displacement of the base: of the record, and of the half-sine and the speed 2aT/π that it leaves
    let record = |from: f64, to: f64| END * END * (from / 3.0 + to / 6.0);
    let sine = duration / PI * duration + 2.0 * duration / PI * (END - start - duration);
    let base = vec2(record(3.0, 0.0), record(-2.0, 6.0)) + a * sine;
    let fall = machine.constants.gravity * (0.5 * END * END);
    let seen = vec2(ending[0] - first[0], ending[1] - first[1]);
    let free = vec2(first[2], first[3]) * END + fall - base;
    let apart = (seen - free).length_squared().sqrt();
    assert!(apart < 1e-12, "{apart:e} m of {base:?}");
}
