//! What has a closed form.

use super::setup::*;
use model::spatial::race::{BallInSpace, RingMotion, traction};
use model::spatial::rigid_body::RigidBody;
use model::spatial::{Assembly, AssemblyConstants};
use number::Vec3;
use physics::contact_nodes::{matched, middle, pure_spin_couple};
use physics::traction::TanhTraction;

/// Runge and Kutta's classical steps.
pub fn run(machine: &AssemblyConstants, state: &mut [f64], time: f64, steps: usize) {
    let assembly = Assembly::<f64>::gather(&|_| machine);
    let h = time / steps as f64;
    let mut k = vec![vec![0.0; state.len()]; 4];
    for _ in 0..steps {
        let mut at = state.to_vec();
        for stage in 0..4 {
            assembly.rate(&at, &mut k[stage]);
            let share = [0.5, 0.5, 1.0, 0.0][stage] * h;
            for (i, value) in at.iter_mut().enumerate() {
                *value = state[i] + share * k[stage][i];
            }
        }
        for (i, value) in state.iter_mut().enumerate() {
            *value += h / 6.0 * (k[0][i] + 2.0 * k[1][i] + 2.0 * k[2][i] + k[3][i]);
        }
    }
}

/// A rotor that nothing holds, a metre away from its bearing.
fn lone_rotor() -> (AssemblyConstants, Vec<f64>) {
    let mut machine = machine(bearing(SINGLE, TANH, &middle(), Guide::Balls), true);
    machine.rotor.as_mut().unwrap().levitation = None;
    machine
        .rotor
        .as_mut()
        .unwrap()
        .landing
        .contact
        .radial_clearance = 10.0;
    let mut state = vec![0.0; machine.states()];
    for body in 0..4 {
        state[machine.body(body) + 6] = 1.0;
    }
    for (j, row) in [0].into_iter().cycle().take(9).enumerate() {
        state[ball_state(&machine, row, j, 0)] = 0.5 * PITCH;
        state[ball_state(&machine, row, j, 2)] = std::f64::consts::TAU * j as f64 / 9.0;
    }
    (machine, state)
}

#[test]
fn a_tilted_rotor_precesses_as_euler_says() {
    let (mut machine, mut state) = lone_rotor();
    machine.gravity = Vec3::zero();
    let rotor = machine.rotor.as_mut().unwrap();
    rotor.landing.faces.clear();
    rotor.eccentricity = 0.0;
    let (axial, transverse) = (rotor.inertia.axial, rotor.inertia.transverse);
    let (spin, across) = (800.0, 30.0);
    state[10..13].copy_from_slice(&[across, 0.0, spin]);
    let time = 0.05;
    run(&machine, &mut state, time, 20_000);
    // the axis turns about L = (I_t ω_x, 0, I_a ω_z) with |L|/I_t
    let l = Vec3::new(transverse * across, 0.0, axial * spin);
    let size = l.length_squared().sqrt();
    let e = l * size.recip();
    let angle = size / transverse * time;
    let a = Vec3::new(0.0, 0.0, 1.0);
    let expected =
        a * angle.cos() + e.cross(a) * angle.sin() + e * (e.dot(a) * (1.0 - angle.cos()));
    let found = RigidBody::read(&state).axis;
    assert!(
        (found - expected).length_squared().sqrt() < 1e-9,
        "{found:?} {expected:?}"
    );
}

#[test]
fn a_rotor_falls_freely_to_the_face() {
    let (mut machine, mut state) = lone_rotor();
    machine.gravity = Vec3::new(0.0, 0.0, -9.81);
    // nothing but the rotor moves; the shoulder stands 0.2 mm above the face
    machine.inner.held = true;
    (
        machine.rows[0].ball.inner.slack,
        machine.rows[0].ball.outer.slack,
    ) = (1.0, 1.0);
    machine.rotor.as_mut().unwrap().landing.faces.truncate(1);
    machine.rotor.as_mut().unwrap().landing.faces[0].shoulder += 2e-4;
    let fall = (2.0 * 2e-4 / 9.81_f64).sqrt();
    run(&machine, &mut state, 0.999 * fall, 200);
    let expected = -0.5 * 9.81 * (0.999 * fall).powi(2);
    assert!(
        (state[2] - expected).abs() < 1e-12 * 2e-4,
        "{} {expected}",
        state[2]
    );
    let account = machine.first_account() + 13;
    assert_eq!(state[account], 0.0);
    run(&machine, &mut state, 0.002 * fall, 10);
    assert!(state[account] > 0.0);
}

#[test]
fn a_ball_that_nothing_touches_flies_straight() {
    // nine coordinates that turn with it: seen in the frame only gravity is left
    let machine = {
        let mut machine = bearing(SINGLE, TANH, &matched(8.0), Guide::Balls);
        machine.rows[0].ball.inner.slack = 1.0;
        machine.rows[0].ball.outer.slack = 1.0;
        machine.rows[0].ball.pocket.gap = 1.0;
        machine
    };
    let mut random = Random(5);
    let mut state = random_state(&machine, &mut random, 1.0);
    let place = |state: &[f64]| {
        let value = |k| state[ball_state(&machine, 0, 4, k)];
        let (sine, cosine) = value(2).sin_cos();
        let out =
            |r: f64, t: f64, z: f64| Vec3::new(r * cosine - t * sine, r * sine + t * cosine, z);
        let velocity = out(value(1), value(0) * value(3), value(5));
        [
            out(value(0), 0.0, value(4)),
            velocity,
            out(value(6), value(7), value(8)),
        ]
    };
    let [x, v, w] = place(&state);
    let time = 2e-3;
    run(&machine, &mut state, time, 2000);
    let [x1, v1, w1] = place(&state);
    let g = machine.rows[0].ball.gravity;
    let close =
        |a: Vec3<f64>, b: Vec3<f64>, scale: f64| (a - b).length_squared().sqrt() < 1e-10 * scale;
    assert!(close(x1, x + v * time + g * (0.5 * time * time), 0.02));
    assert!(close(v1, v + g * time, 5.0) && close(w1, w, 1500.0));
}

#[test]
fn pure_spin_has_the_couple_of_the_ellipse() {
    let k = 8.0;
    let ball = bearing(SINGLE, TANH, &middle(), Guide::Balls).rows[0].ball;
    let still = |spin: Vec3<f64>| RingMotion {
        position: Vec3::zero(),
        velocity: Vec3::zero(),
        spin,
        axis: Vec3::new(0.0, 0.0, 1.0),
    };
    // in the plane of the groove's bottom, the normal is radial
    let depth = 5e-6;
    let outer = ball.outer;
    let distance = outer.centre_radius + outer.slack + depth;
    let spin = 50.0;
    let at = BallInSpace {
        position: Vec3::new(distance, 0.0, outer.place),
        velocity: Vec3::zero(),
        spin: Vec3::new(-spin, 0.0, 0.0),
    };
    let touch = outer.touch(&still(Vec3::zero()), &at, ball.radius, 0.0);
    let law = TanhTraction {
        maximum: 0.07,
        inverse_reference_speed: 1e9,
    };
    let [found, _] = traction(&law, &matched(k), [&touch, &touch]);
    assert!((touch.turning.z - spin).abs() < 1e-12 && touch.slip.y.abs() < 1e-12);
    let expected = pure_spin_couple(0.07 * touch.load.force, touch.half_axis, k);
    assert!(
        (found.couple.z / expected - 1.0).abs() < 1e-6,
        "{} {expected}",
        found.couple.z
    );
}

/// A face pressed by a force, its shoulder turning and gliding.
fn pressed(spin: f64, lateral: f64) -> (f64, Vec3<f64>, Vec3<f64>) {
    let (machine, mut state) = lone_rotor();
    state[2] = -1e-5;
    state[3] = lateral;
    state[12] = spin;
    let assembly = Assembly::<f64>::gather(&|_| &machine);
    let mut rate = vec![0.0; state.len()];
    let probe = assembly.rate(&state, &mut rate);
    let inertia = machine.rotor.as_ref().unwrap().inertia;
    let force = Vec3::new(rate[3], rate[4], rate[5]) * inertia.mass;
    let moment = Vec3::new(rate[10], rate[11], rate[12] * inertia.axial);
    (
        probe.face_normal_force,
        force - machine.gravity * inertia.mass,
        moment,
    )
}

#[test]
fn a_face_rubs_with_its_mean_radius_and_hardly_guides() {
    let spin = 1000.0;
    let (normal, _, moment) = pressed(spin, 0.0);
    let expected = -0.15 * normal * 14e-3;
    assert!(normal > 1000.0);
    assert!(
        (moment.z / expected - 1.0).abs() < 1e-5,
        "{} {expected}",
        moment.z
    );
    let v = 1e-3;
    let (normal, force, _) = pressed(spin, v);
    let expected = -0.15 * normal * v / (2.0 * 14e-3 * spin);
    assert!(
        (force.x / expected - 1.0).abs() < 1e-4,
        "{} {expected}",
        force.x
    );
}
