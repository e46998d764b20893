//! Rest: what does not move stays.

use crate::machines::{BEARING, INNER, ball_of, let_roll, planar, reference, weightless};
use model::auxiliary_bearing::probe::COUNT as DETAIL;
use model::system::machine::{MachineConstants, RotorMachine};
use std::f64::consts::PI;

/// Largest ball load at rest and largest accelerations of balls: radial, orbit, spin.
fn at_rest(constants: MachineConstants) -> (f64, [f64; 3]) {
    let machine = RotorMachine::new(constants);
    let state = machine.start();
    let (rate, probe) = machine.inspect(&state);
    let mut largest = [0.0_f64; 3];
    let balls = machine.layout().bearings[0].balls;
    for j in 0..balls {
        let a = ball_of(&machine, &rate, j);
        for (most, value) in largest
            .iter_mut()
            .zip([a.radial_speed, a.orbit_speed, a.spin])
        {
            *most = most.max(value.abs());
        }
    }
    (
        probe[DETAIL..DETAIL + balls]
            .iter()
            .copied()
            .fold(0.0, f64::max),
        largest,
    )
}

#[test]
fn preloaded_balls_rest_between_concentric_races() {
    for interference in [0.0, 2e-6, 10e-6] {
        let mut c = reference();
        weightless(&mut c);
        let bearing = planar(&mut c);
        bearing.ball.outer_track =
            bearing.ball.inner_track + 2.0 * bearing.ball.radius - interference;
        let (mass, stiff) = (bearing.ball.mass, bearing.ball.inner_stiffness);
        let (load, [radial, orbit, spin]) = at_rest(c);
        // both contacts take about half of the interference
        let expected = stiff * (0.5 * interference).powf(1.5);
        assert!(
            (0.9 * expected..expected + 1e-12).contains(&load),
            "{load} {expected}"
        );
        // the ball's place is rounded to 1e-18 m, each contact is stiff: 1e-11 of the load, and at no load the root of it
        assert!(radial < 1e-9 * load / mass + 1e-6, "{radial} at {load}");
        assert!(
            orbit < 1e-9 * load / mass / 18e-3 + 1e-9 && spin == 0.0,
            "{orbit} {spin}"
        );
    }
}

#[test]
fn balls_at_rest_feel_their_weight_alone() {
    let (_, [radial, ..]) = at_rest(reference());
    // two balls each at 72°, 108° and below are the nearest to the vertical
    let expected = 9.81 * (0.4 * PI).sin();
    assert!(
        (radial / expected - 1.0).abs() < 1e-6,
        "{radial} {expected}"
    );
}

#[test]
fn balls_with_clearance_rest_in_the_middle_without_load() {
    let mut c = reference();
    weightless(&mut c);
    planar(&mut c).ball.outer_track += 20e-6;
    let (load, largest) = at_rest(c);
    assert_eq!((load, largest), (0.0, [0.0; 3]));
}

#[test]
fn a_rolling_bearing_at_rest_does_not_turn_or_push() {
    let mut c = reference();
    weightless(&mut c);
    let_roll(&mut c);
    let machine = RotorMachine::new(c);
    let (rate, _) = machine.inspect(&machine.start());
    assert_eq!(rate[BEARING], 0.0);
    // preloads of ten balls cancel: rounding of 35 N over 20 g
    for acceleration in &rate[INNER + 2..BEARING] {
        assert!(acceleration.abs() < 1e-9, "{acceleration}");
    }
}
