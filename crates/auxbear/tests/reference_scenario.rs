//! The shipped reference scenario builds the very machine of the reference cases: what a user writes reaches the model.

use auxbear::scenario::{BuiltIn, Scenario, System};
use auxbear::simulate::drop::build;
use model::bearing::{BearingConstants, PlanarConstants, Separation};
use physics::traction::Traction;
use std::path::Path;

fn near(name: &str, ours: f64, reference: f64) {
    within(1e-9, name, ours, reference);
}

fn within(tolerance: f64, name: &str, ours: f64, reference: f64) {
    assert!(
        (ours - reference).abs() <= tolerance * reference.abs(),
        "{name}: {ours} is not {reference}"
    );
}

#[test]
fn reference_drop_is_the_reference_machine() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/reference_drop.toml");
    let scenario = Scenario::read(&path, &[], &BuiltIn).expect("the shipped scenario is right");
    let System::Drop(drop) = &scenario.system else {
        panic!("the reference is a drop");
    };
    let built = build::drop(drop).expect("it builds").constants;
    let part = &built.bearings[0];
    near("speed", built.speed, 1_256.637_061_435_917_3);
    near("rotor mass", built.rotor.mass(), 8.0);
    near("rotor inertia", built.rotor.polar_inertia, 0.01);
    near("eccentricity", built.rotor.eccentricity(&[1.0]), 5e-6);
    near("clearance", part.contact.radial_clearance, 0.25e-3);
    near("bore radius", part.contact.bore_radius, 0.0125);
    near("contact stiffness", part.contact.stiffness, 5e8);
    near("contact exponent", part.contact.exponent, 10.0 / 9.0);
    near("contact damping", part.contact.damping, 0.5);
    near("friction", part.contact.friction, 0.15);
    near("1/u0r", part.contact.inverse_reference_speed, 20.0);
    near("inner race mass", part.inner_race.mass, 0.0204);
    near("inner race inertia", part.inner_race.inertia, 3.9e-6);
    near("outer race mass", part.outer_race_mass, 0.15);
    near("mount stiffness", part.mount.stiffness, 2e7);
    near("mount damping", part.mount.damping, 5e3);
    near("levitation stiffness", built.levitation.stiffness, 1e6);
    near("levitation damping", built.levitation.damping, 1e3);
    near("gravity", built.gravity.y, -9.81);
    // (0.15 + 0.005 + 10·0.00105242 + 0.0204)·9.81/2e7
    near(
        "free mount",
        part.mount.free_position.y,
        (0.15 + 0.005 + 10.0 * 0.001_052_420_877_679_688_1 + 0.0204) * 9.81 / 2e7,
    );
    let BearingConstants::Planar(bearing) = &part.bearing else {
        panic!("the reference is planar");
    };
    let ball = &bearing.ball;
    assert_eq!(bearing.balls, 10);
    near("ball radius", ball.radius, 0.003175);
    near("ball mass", ball.mass, 0.001_052_420_877_679_688_1);
    near("inner track", ball.inner_track, 0.014825);
    near("outer track", ball.outer_track, 0.021173);
    // the reference took its Hertz factors from a pitch diameter rounded in the sixth digit
    within(
        2e-6,
        "inner stiffness",
        ball.inner_stiffness,
        25_188_251_676.112_152,
    );
    within(
        2e-6,
        "outer stiffness",
        ball.outer_stiffness,
        22_185_150_515.377_434,
    );
    near("damping time", ball.damping_time, 2.5e-6);
    near("pocket radius", ball.pocket_radius, 0.018);
    near("pocket gap", ball.pocket_gap, 1e-4);
    near("pocket stiffness", ball.pocket_stiffness, 1e7);
    near("pocket damping", ball.pocket_damping, 0.5);
    near("pocket friction", ball.pocket_friction, 0.05);
    near("1/u0c", ball.pocket_inverse_reference_speed, 10.0);
    near("orbit drag", ball.orbit_drag, 2e-4);
    near("spin drag", ball.spin_drag, 1e-9);
    near("cage mass", bearing.cage_mass, 0.005);
    near("cage inertia", bearing.cage_inertia, 1.62e-6);
    let Traction::Tanh(traction) = bearing.traction else {
        panic!("the reference has the tanh law");
    };
    near("maximum traction", traction.maximum, 0.07);
    near("1/u0", traction.inverse_reference_speed, 10.0);
}

/// A shipped scenario with balls at 40°, built.
fn at_forty_degrees(name: &str) -> PlanarConstants {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let sets = [
        "bearing.type=angular contact",
        "bearing.contact_angle=40 deg",
    ]
    .map(str::to_string);
    let path = folder.join(name);
    let scenario = Scenario::read(&path, &sets, &BuiltIn).expect("it is right");
    let System::Drop(drop) = &scenario.system else {
        panic!("a drop");
    };
    let built = build::drop(drop).expect("it builds").constants;
    match built.bearings.into_iter().next().expect("one").bearing {
        BearingConstants::Planar(bearing) => bearing,
        _ => panic!("planar"),
    }
}

#[test]
fn friction_across_the_line_of_contact_counts_its_cosine() {
    let cosine = 40_f64.to_radians().cos();
    // pocket: 0.05 and 0.1 m/s, neighbours: 0.1 and 0.1 m/s by default
    let ball = at_forty_degrees("angular_contact_drop.toml").ball;
    near("pocket friction", ball.pocket_friction, 0.05 * cosine);
    near("1/u0c", ball.pocket_inverse_reference_speed, 10.0 * cosine);
    near("contact radius", ball.radius, ball.ball_radius * cosine);
    near(
        "spin inertia",
        1.0 / ball.inverse_inertia,
        0.4 * ball.mass * ball.radius * ball.radius,
    );
    let Separation::Neighbours(pair) = at_forty_degrees("full_complement_drop.toml").separation
    else {
        panic!("no cage");
    };
    near("radius", pair.radius, 3.175e-3);
    near("neighbour friction", pair.friction, 0.1 * cosine);
    near("1/u0n", pair.inverse_reference_speed, 10.0 * cosine);
}
