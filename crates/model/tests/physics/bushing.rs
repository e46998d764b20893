//! A plain bushing: a ring that does not turn.

use crate::machines::{Blind, balance_mount, let_roll, reference, run, settings};
use model::bearing::tangents::Known;
use model::bearing::{BearingConstants, RollingConstants};
use model::system::machine::layout::ROTOR;
use model::system::machine::simulate::{Runs, Shape, Steps, simulate_on};
use model::system::machine::{MachineConstants, RotorMachine};
use number::{Level, Vec2};
use solve::{Machine, Observer};
use std::sync::atomic::AtomicBool;

/// The reference machine on a bushing.
fn on_a_bushing() -> MachineConstants {
    let mut c = reference();
    let part = &mut c.bearings[0];
    let radius = part.contact.bore_radius;
    part.bearing = BearingConstants::Rolling(RollingConstants::bushing(radius));
    part.inner_race.mass = 0.0;
    part.inner_race.inertia = part.outer_race_mass * radius * radius;
    c.balance_mounts();
    c
}

#[test]
fn its_ledger_and_angular_momentum_close_and_its_ring_does_not_turn() {
    let machine = RotorMachine::new(on_a_bushing());
    assert_eq!(machine.tangents(), Known::Nothing);
    let start = machine.start();
    let end = run(&machine, &start, &settings(30e-3, 1e-6));
    let balance = machine.balance(&start, &end);
    let residual = balance.energy_residual() / balance.heat();
    assert!(residual.abs() < 1e-6, "{residual}");
    let part = &machine.constants.bearings[0];
    let scale = part.inner_race.inertia * machine.constants.speed;
    let lost = balance.angular_momentum_residual() / scale;
    assert!(lost.abs() < 1e-6, "{lost}");
    let at = machine.layout().bearings[0];
    assert_eq!(at.inner.centre(), at.outer.centre());
    assert_eq!(end[at.inner.spin()], 0.0);
    // braked by the friction of its weight: 0.15 · 78 N · 12 mm/0.01 kg m² over the 23 ms after its fall, and blows
    let spin = machine.layout().rotor.spin();
    let lost = start[spin] - end[spin];
    assert!((0.2..0.8).contains(&lost), "{lost}");
}

#[test]
fn it_brakes_with_the_friction_coefficient_times_force_and_arm() {
    let mut c = on_a_bushing();
    c.rotor.coordinates[0].unbalance = Vec2::zero();
    let machine = RotorMachine::new(c);
    let part = &machine.constants.bearings[0];
    let depth = 10e-6;
    let mut state = machine.start();
    // at rest in the bottom of the bore
    state[ROTOR] = 0.0;
    state[ROTOR + 1] = -(part.contact.radial_clearance + depth);
    state[ROTOR + 2] = 0.0;
    state[ROTOR + 3] = 0.0;
    let (rate, _) = machine.inspect(&state);
    let normal = part.contact.stiffness * depth.powf(part.contact.exponent);
    let arm = part.contact.bore_radius - part.contact.radial_clearance - 0.5 * depth;
    let friction = part.contact.friction * normal;
    let expected = -friction * arm / machine.constants.rotor.polar_inertia;
    let spin_rate = rate[machine.layout().rotor.spin()];
    assert!(
        (spin_rate / expected - 1.0).abs() < 1e-9,
        "{spin_rate} {expected}"
    );
    // sliding to the left at the bottom pushes the rotor against its spin: to the left of a bottom that moves right
    let push = machine.constants.rotor.mass() * rate[ROTOR + 2];
    assert!(
        (push.abs() / friction - 1.0).abs() < 1e-9,
        "{push} {friction}"
    );
    let ring = part.outer_race_mass * rate[machine.layout().bearings[0].outer.velocity()[0]];
    assert!(
        (ring / -push - 1.0).abs() < 1e-9,
        "third law: {ring} {push}"
    );
}

#[test]
fn a_ball_bearing_whose_race_is_held_and_too_heavy_to_turn_does_the_same() {
    let mut held = reference();
    let_roll(&mut held);
    held.bearings[0].inner_race.centre_held = true;
    held.bearings[0].inner_race.inertia = 1e9;
    balance_mount(&mut held);
    let mut ring = on_a_bushing();
    ring.bearings[0].outer_race_mass = 1e9;
    ring.balance_mounts();
    let [held, ring] = [held, ring].map(|constants| {
        let machine = RotorMachine::new(constants);
        let start = machine.start();
        // grazing impacts amplify what is different: the first two
        run(&machine, &start, &settings(9e-3, 1e-9))[..6].to_vec()
    });
    for (channel, size) in [1e-4, 1e-4, 0.1, 0.1, 1.0, 1e3].iter().enumerate() {
        let apart = (held[channel] - ring[channel]).abs();
        assert!(
            apart < 1e-6 * size,
            "{channel}: {} {}",
            held[channel],
            ring[channel]
        );
    }
}

#[test]
fn turning_or_mirroring_the_machine_turns_or_mirrors_the_answer() {
    let turned = |v: Vec2<f64>| {
        let (s, c) = 0.7_f64.sin_cos();
        Vec2::new(c * v.x - s * v.y, s * v.x + c * v.y)
    };
    let mirrored = |v: Vec2<f64>| Vec2::new(-v.x, v.y);
    type Change<'a> = (&'a dyn Fn(Vec2<f64>) -> Vec2<f64>, f64, f64);
    let changes: [Change; 2] = [(&turned, 1.0, 0.7), (&mirrored, -1.0, std::f64::consts::PI)];
    let end = |constants: MachineConstants| {
        let machine = RotorMachine::new(constants);
        let start = machine.start();
        run(&machine, &start, &settings(9e-3, 1e-9))
    };
    let plain = end(on_a_bushing());
    for (change, sense, angle) in changes {
        let mut c = on_a_bushing();
        c.gravity = change(c.gravity);
        c.levitation.carried = change(c.levitation.carried);
        c.speed *= sense;
        c.unbalance_angle = sense * c.unbalance_angle + angle;
        c.balance_mounts();
        let other = end(c);
        for at in [ROTOR, ROTOR + 2] {
            let expected = change(Vec2::new(plain[at], plain[at + 1]));
            let apart = expected - Vec2::new(other[at], other[at + 1]);
            let size = [1e-4, 0.1][at / 2];
            assert!(apart.length_squared().sqrt() < 1e-6 * size, "{apart:?}");
        }
        assert!((other[ROTOR + 5] - sense * plain[ROTOR + 5]).abs() < 1e-6);
    }
}

#[test]
fn lanes_give_the_bits_of_single_runs() {
    let machines: Vec<RotorMachine> = (0..5)
        .map(|k| {
            let mut c = on_a_bushing();
            c.bearings[0].contact.friction += 0.01 * f64::from(k);
            RotorMachine::new(c)
        })
        .collect();
    let refs: Vec<&RotorMachine> = machines.iter().collect();
    let starts: Vec<Vec<f64>> = machines.iter().map(RotorMachine::start).collect();
    let interrupt = AtomicBool::new(false);
    let ends = |machines: &[&RotorMachine], starts: &[Vec<f64>], shape| {
        let mut blind: Vec<Blind> = machines.iter().map(|_| Blind).collect();
        let mut observers: Vec<&mut dyn Observer<RotorMachine>> = (blind.iter_mut())
            .map(|one| one as &mut dyn Observer<RotorMachine>)
            .collect();
        let runs = Runs {
            machines,
            starts,
            settings: settings(10e-3, 1e-5),
            steps: Steps::Explicit,
            interrupt: &interrupt,
        };
        let endings = simulate_on(Level::detect(), shape, runs, &mut observers);
        endings.into_iter().map(|ending| ending.state)
    };
    let together: Vec<_> = ends(&refs, &starts, Shape::Machines).collect();
    for (k, machine) in refs.iter().enumerate() {
        let alone = ends(&[*machine], &starts[k..=k], Shape::Balls).next();
        assert_eq!(alone.as_ref(), Some(&together[k]), "{k}");
    }
    assert_eq!(together[0].len(), machines[0].dimension());
}
