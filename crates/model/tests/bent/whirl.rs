//! Dry backward whirl in time against its closed form: a Jeffcott rotor, and a free rotor in a ring on its mount.
//!
//! The bushing is a ring that does not turn; gravity and unbalance are zero, the spin is held, the rotor slides everywhere.

use crate::machines::{Blind, by, reference, settings};
use model::bearing::{BearingConstants, RollingConstants};
use model::mount::{MaxwellBranch, Mount};
use model::rotor::{Coordinate, RotorConstants};
use model::system::machine::simulate::Steps;
use model::system::machine::{MachineConstants, RotorMachine};
use number::Vec2;
use physics::dry_whirl::{WhirlContact, needed_friction};
use rotor::{C64, WhirlCurve};

const CLEARANCE: f64 = 2e-4;
/// Natural frequency of the Jeffcott rotor, rad/s, and its damping ratio.
const NATURAL: f64 = 300.0;
const ZETA: f64 = 0.05;
/// Stiffness of the contact over that of the rotor.
const KAPPA: f64 = 10.0;

/// A rotor of 1 kg on a spring and damper, in a bushing.
fn machine(natural: f64, ring_mass: f64, mount: Mount<f64>) -> MachineConstants {
    let mut out = reference();
    out.rotor = RotorConstants {
        coordinates: vec![Coordinate {
            frequency: natural,
            mass: 1.0,
            weight: 0.0,
            unbalance: Vec2::zero(),
        }],
        damping: vec![2.0 * ZETA * natural],
        spin_held: true,
        ..RotorConstants::point(1.0, 1.0, 0.0)
    };
    out.gravity = Vec2::zero();
    out.speed = 2000.0;
    let part = &mut out.bearings[0];
    let contact = &mut part.contact;
    // wide: orbits of many clearances stay far from rolling
    contact.bore_radius = 1.0;
    contact.radial_clearance = CLEARANCE;
    contact.stiffness = KAPPA * NATURAL * NATURAL;
    contact.exponent = 1.0;
    contact.damping = 0.0;
    contact.inverse_reference_speed = 1e3;
    let radius = contact.bore_radius;
    part.bearing = BearingConstants::Rolling(RollingConstants::bushing(radius));
    part.inner_race.mass = 0.0;
    part.inner_race.inertia = ring_mass * radius * radius;
    part.outer_race_mass = ring_mass;
    part.mount = mount;
    out
}

/// Radius of the orbit, m, and its rate, rad/s, backward positive, after some time from an orbit.
fn after(machine: &RotorMachine, seconds: f64, radius: f64, rate: f64) -> (f64, f64) {
    let velocity = Vec2::new(0.0, -rate * radius);
    let start = machine.start_with(&[Vec2::new(radius, 0.0)], &[velocity]);
    let end = by(
        Steps::Explicit,
        machine,
        &start,
        &settings(seconds, 1e-7),
        &mut Blind,
    )
    .state;
    let at = |block: usize| end[machine.layout().rotor.block(block).start];
    let (position, speed) = (Vec2::new(at(0), at(1)), Vec2::new(at(2), at(3)));
    let square = position.length_squared();
    let turning = position.x * speed.y - position.y * speed.x;
    (square.sqrt(), -turning / square)
}

/// Below its threshold a Jeffcott rotor does not whirl; at twice that it settles at ω_n √(1+κ) from above ω_s alone.
#[test]
fn jeffcott_rotor_whirls_as_the_closed_form_says() {
    let threshold = 2.0 * ZETA * (1.0 + KAPPA).sqrt() / KAPPA;
    let ring = Mount {
        stiffness: 1.0,
        damping: 0.0,
        free_position: Vec2::zero(),
    };
    let run = |friction: f64, radius: f64, rate: f64, seconds: f64| {
        // a race that its mass holds
        let mut constants = machine(NATURAL, 1e9, ring);
        constants.bearings[0].contact.friction = friction;
        let machine = RotorMachine::new(constants);
        after(&machine, seconds, radius * CLEARANCE, rate * NATURAL)
    };
    for (radius, rate) in [(5.0, 0.9), (5.0, 2.0), (25.0, 3.3), (25.0, 4.8)] {
        let (orbit, _) = run(0.95 * threshold, radius, rate, 0.6);
        // close to the threshold large orbits decay slowly: from 25 c0 to 16 c0 here
        assert!(orbit < 0.7 * radius * CLEARANCE, "{radius} {rate}: {orbit}");
    }
    let ratio = ZETA / (2.0 * threshold);
    let (settled, orbit) = (
        ratio + (1.0 + ratio * ratio).sqrt(),
        1.433_534_056_452_062_4,
    );
    let (slower, _) = run(2.0 * threshold, orbit, 0.9 * settled, 0.6);
    assert!(slower < CLEARANCE, "{slower}");
    let (faster, rate) = run(2.0 * threshold, orbit, 1.1 * settled, 0.7);
    // the orbit still grows: 3.3178 in an independent run, √11 in the limit
    assert!(faster > 5.0 * CLEARANCE, "{faster}");
    let rate = rate / NATURAL;
    assert!((rate / 11f64.sqrt() - 1.0).abs() < 5e-4, "{rate}");
}

/// A rotor that nothing carries settles in a ring on spring, damper and Maxwell branch where its needed friction meets that of the file.
#[test]
fn whirl_on_a_mount_settles_where_the_curve_says() {
    let (mass, friction) = (0.4, 0.15);
    let mount = Mount {
        stiffness: 3e5,
        damping: 60.0,
        free_position: Vec2::zero(),
    };
    let mut constants = machine(0.0, mass, mount);
    let branch = MaxwellBranch {
        stiffness: 1e5,
        rate: 1.0 / 1e-3,
    };
    let part = &mut constants.bearings[0];
    part.mount_parts.branches = vec![branch];
    part.contact.friction = friction;
    let contact = WhirlContact {
        clearance: CLEARANCE,
        stiffness: part.contact.stiffness,
        exponent: 1.0,
    };
    let parts = part.mount_parts.clone();
    let alpha = |omega: f64| {
        let own = parts.linear(&mount, omega);
        let race = C64::new(own.storage - mass * omega * omega, own.loss).inv();
        Some(race.conj() - 1.0 / (omega * omega))
    };
    let sampled = (1..400).map(|k| 2.0 * f64::from(k));
    let sampled = sampled.map(|omega| (omega, alpha(omega).unwrap()));
    let ranges = WhirlCurve::new(contact, sampled.collect(), &alpha).ranges(friction);
    let settles = ranges[0].settles.unwrap();
    let there = alpha(settles.frequency).unwrap();
    assert!((needed_friction(there.re, there.im).unwrap() / friction - 1.0).abs() < 1e-9);
    let machine = RotorMachine::new(constants);
    // orbit of the rotor in space: |α_rotor F|, F = N|1 + jμ|
    let orbit = settles.force * (1.0 + friction * friction).sqrt() / settles.frequency.powi(2);
    for share in [0.8, 1.1] {
        let start = share * settles.frequency;
        let (radius, rate) = after(&machine, 3.0, 1.05 * CLEARANCE, start);
        // tanh(slip/u0) is 1 to 1e-12; the rest is the integration at 1e-7
        assert!(
            (rate / settles.frequency - 1.0).abs() < 1e-5,
            "{rate} {settles:?}"
        );
        assert!((radius / orbit - 1.0).abs() < 1e-5, "{radius} {orbit}");
    }
}
