//! The steady friction moment of a row in space.

use super::closed_forms::run;
use super::setup::*;
use model::bearing::SteadyMoment;
use model::spatial::ball::BALL_STATES;
use model::spatial::{Assembly, AssemblyConstants};
use number::Vec3;
use physics::contact_nodes::{ContactNode, matched, middle};
use physics::moment_curve::MomentCurve;

const SPEED: f64 = 1000.0;

/// One row that its rings press, the inner one turning about an axis that is held, the outer one too heavy to move.
fn pressed(nodes: &[ContactNode<f64>]) -> AssemblyConstants {
    let mut machine = bearing(SINGLE, TANH, nodes, Guide::Balls);
    machine.gravity = Vec3::zero();
    machine.rows[0].ball.gravity = Vec3::zero();
    machine.rows[0].ball.inner_growth = 0.0;
    // loads beside which the centrifugal force changes no angle
    machine.rows[0].ball.inner.place += 20e-6;
    machine.inner.held = true;
    machine.inner.inertia.axial = 1e6;
    machine.outer.turns = false;
    machine.outer.inertia.mass = 1e6;
    machine.rows[0].moment = greased();
    machine
}

/// Its balls between concentric rings, rolling; their axes of spin turned by a spin about the contact normals, rad/s.
fn rolling(machine: &AssemblyConstants, spin: f64) -> Vec<f64> {
    let mut state = vec![0.0; machine.states()];
    for body in 0..4 {
        state[machine.body(body) + 6] = 1.0;
    }
    let ball = machine.rows[0].ball;
    let [rho, z] = ball.between_rings();
    let [radial, axial] = [rho - ball.outer.centre_radius, z - ball.outer.place];
    let length = radial.hypot(axial);
    let [cosine, sine] = [radial / length, axial / length];
    let track = rho - ball.radius * cosine;
    let s = ball.radius * cosine / track;
    state[machine.body(1) + 12] = SPEED;
    state[machine.body(3) + 2] = z;
    state[machine.body(3) + 12] = 0.5 * SPEED / (1.0 + s);
    let turns = -0.5 * SPEED * track / ball.radius;
    let count = machine.rows[0].balls;
    for j in 0..count {
        let azimuth = std::f64::consts::TAU * j as f64 / count as f64;
        // about the line between both contacts' tracks, across the normal
        let values = [
            rho,
            0.0,
            azimuth,
            0.5 * SPEED / (1.0 + s),
            z,
            0.0,
            spin * cosine - turns * sine,
            0.0,
            spin * sine + turns * cosine,
        ];
        for (k, value) in values.into_iter().enumerate() {
            state[ball_state(machine, 0, j, k)] = value;
        }
    }
    state
}

/// Moment on the inner ring about its axis, N m, and the power that drags, W.
fn resisted(machine: &AssemblyConstants, state: &[f64]) -> (f64, f64) {
    let mut rate = vec![0.0; state.len()];
    let probe = Assembly::<f64>::gather(&|_| machine).rate(state, &mut rate);
    (probe.inner_torque, rate[machine.first_account() + 4])
}

/// Heat of spin and curvature in the contacts, W.
fn spun(machine: &AssemblyConstants, state: &[f64]) -> f64 {
    let own = |j: usize| {
        let races = machine.ball(0, j, state).races;
        let own = |k: usize| races.traction[k].couple.dot(races.touch[k].turning);
        own(0) + own(1)
    };
    (0..machine.rows[0].balls).map(own).sum()
}

/// The law's parts of a row under the loads of its balls, N m.
fn law(machine: &AssemblyConstants, state: &[f64]) -> [f64; 2] {
    let row = &machine.rows[0];
    let load: f64 = (0..row.balls)
        .map(|j| {
            let touch = machine.ball(0, j, state).races.touch[0];
            touch.load.force * touch.triad.normal[1]
        })
        .sum();
    let parts = (row.moment.as_ref().unwrap().law).parts(SPEED, 0.0, load);
    [parts.speed_dependent, parts.load_dependent]
}

#[test]
fn balls_that_roll_take_the_power_of_the_law_wherever_their_axes_stand() {
    let machine = pressed(&middle());
    for spin in [-800.0, 0.0, 300.0] {
        let state = rolling(&machine, spin);
        let [viscous, loaded] = law(&machine, &state);
        assert!(loaded > 0.1 * viscous && viscous > 0.1 * loaded);
        let (_, power) = resisted(&machine, &state);
        let expected = (viscous + loaded) * SPEED;
        assert!(
            (power / expected - 1.0).abs() < 1e-10,
            "{spin}: {power} {expected}"
        );
    }
}

#[test]
fn what_contacts_resist_by_spin_is_part_of_the_load_dependent_moment() {
    for factor in [1.0, 0.0] {
        let mut machine = pressed(&matched(8.0));
        let moment = machine.rows[0].moment.as_mut().unwrap();
        if let SteadyMoment::PalmgrenCombined(own) = &mut moment.law {
            own.law.load_factor *= factor;
        }
        let state = rolling(&machine, 300.0);
        let spun = spun(&machine, &state);
        let [viscous, loaded] = law(&machine, &state);
        assert!(spun > 0.01 * loaded * SPEED);
        let (_, power) = resisted(&machine, &state);
        let expected = viscous * SPEED + (loaded * SPEED - spun).max(0.0);
        assert!((power / expected - 1.0).abs() < 1e-10, "{power} {expected}");
    }
}

#[test]
fn a_measured_curve_contains_what_contacts_resist() {
    let mut machine = pressed(&matched(8.0));
    let moment = machine.rows[0].moment.as_mut().unwrap();
    let curve = [(10.0, 0.05), (500.0, 0.06), (2.0 * SPEED, 0.08)];
    moment.law = SteadyMoment::Curve(MomentCurve::through(&curve).unwrap());
    let state = rolling(&machine, 300.0);
    let spun = spun(&machine, &state);
    let [measured, none] = law(&machine, &state);
    assert!(spun > 1e-3 * measured * SPEED && none == 0.0);
    let (_, power) = resisted(&machine, &state);
    let expected = measured * SPEED - spun;
    assert!((power / expected - 1.0).abs() < 1e-10, "{power} {expected}");
}

#[test]
fn the_inner_ring_feels_the_law_once_its_balls_are_steady() {
    // of three nodes in the contacts spin makes a part of it, of one none
    for nodes in [middle(), matched(8.0)] {
        let machine = pressed(&nodes);
        let mut state = rolling(&machine, 0.0);
        run(&machine, &mut state, 10e-3, 10_000);
        let (torque, _) = resisted(&machine, &state);
        let [viscous, loaded] = law(&machine, &state);
        let expected = -(viscous + loaded);
        assert!(
            (torque / expected - 1.0).abs() < 0.01,
            "{} nodes: {torque} {expected}",
            nodes.len()
        );
    }
}

/// Without a contact angle each ball is slowed as the planar bearing slows it: the formulae of the plane by hand.
#[test]
fn in_the_plane_the_pairs_are_those_of_the_planar_bearing() {
    let mut machine = pressed(&middle());
    let middle_of_grooves = 0.0;
    let row = &mut machine.rows[0];
    row.ball.inner.place = middle_of_grooves;
    row.ball.outer.place = middle_of_grooves;
    // grooves whose centres are as far apart as the ball is pressed by 4 µm
    let slack = row.ball.inner.slack + row.ball.outer.slack;
    row.ball.outer.centre_radius = row.ball.inner.centre_radius - slack - 4e-6;
    let mut state = rolling(&machine, 0.0);
    let mut random = Random(5);
    for j in 0..machine.rows[0].balls {
        for (k, size) in [(0, 1e-6), (3, 0.2 * SPEED), (8, 0.3 * SPEED)] {
            state[ball_state(&machine, 0, j, k)] += size * random.next();
        }
    }
    let mut without = machine.clone();
    without.rows[0].moment = None;
    let rates = |machine: &AssemblyConstants| {
        let mut rate = vec![0.0; state.len()];
        Assembly::<f64>::gather(&|_| machine).rate(&state, &mut rate);
        rate
    };
    let (with, without) = (rates(&machine), rates(&without));
    let row = &machine.rows[0];
    let (own, ball) = (row.moment.as_ref().unwrap(), &row.ball);
    let count = row.balls as f64;
    let (r, track) = (ball.radius, ball.between_rings()[0] - ball.radius);
    let s = r / track;
    let loads: Vec<(f64, f64)> = (0..row.balls)
        .map(|j| {
            let angle = state[ball_state(&machine, 0, j, 2)];
            (machine.ball(0, j, &state).races.touch[0].load.force, angle)
        })
        .collect();
    let sum = |of: &dyn Fn(&(f64, f64)) -> f64| loads.iter().map(of).sum::<f64>();
    let radial = sum(&|(q, angle)| q * angle.cos()).hypot(sum(&|(q, angle)| q * angle.sin()));
    let parts = |speed: f64| own.law.parts(speed, radial, 0.0);
    let at_speed = parts(SPEED);
    let idle = 0.1 * at_speed.sum() / (count * track);
    let inner_sum = sum(&|(q, _)| *q);
    for (j, (load, _)) in loads.iter().enumerate() {
        let at = |k: usize| state[ball_state(&machine, 0, j, k)];
        let change = |k: usize| {
            let at = ball_state(&machine, 0, j, k);
            with[at] - without[at]
        };
        let share = (load + idle) / (inner_sum + count * idle);
        let viscous = |speed: f64| parts(speed).speed_dependent;
        let drag = share * 2.0 * own.orbit_share / track * viscous(2.0 * (1.0 + s) * at(3));
        let spin = at(8);
        let rolling = s / (1.0 + s) * at_speed.load_dependent;
        let couple = share
            * (2.0 * s * (1.0 - own.orbit_share) * viscous(2.0 * s * spin)
                + rolling * spin.tanh()
                + rolling * (spin - SPEED).tanh());
        let expected = [
            -drag / (ball.mass * at(0)),
            -couple / (0.4 * ball.mass * r * r),
        ];
        for (k, expected) in [3, 8].into_iter().zip(expected) {
            let found = change(k);
            assert!(
                (found / expected - 1.0).abs() < 1e-7,
                "ball {j} state {k}: {found} {expected}"
            );
        }
        for k in (0..BALL_STATES).filter(|k| ![3, 8].contains(k)) {
            assert!(change(k).abs() < 1e-6, "ball {j} state {k}: {}", change(k));
        }
    }
}
