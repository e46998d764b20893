//! How a bearing carries a static load.

use crate::machines::{
    balance_mount, bearing_part, let_roll, planar, race_motion, reference, run, settings, vec2,
};
use model::auxiliary_bearing::probe::COUNT as DETAIL;
use model::bearing::BearingConstants;
use model::system::machine::{MachineConstants, RotorMachine};
use number::Vec2;
use std::f64::consts::PI;

/// Load on the inner race, N.
const LOAD: f64 = 500.0;

/// A machine at rest whose inner race carries a load of the given direction and nothing else has weight: a heavy race.
fn loaded(interference: f64, direction: f64) -> MachineConstants {
    let mut c = reference();
    c.speed = 0.0;
    crate::machines::centred(&mut c);
    let bearing = planar(&mut c);
    bearing.ball.gravity = vec2(0.0, 0.0);
    bearing.ball.outer_track = bearing.ball.inner_track + 2.0 * bearing.ball.radius - interference;
    // damping for a quick rest, without which a static answer would take long
    bearing.ball.damping_time = 1e-4;
    c.bearings[0].inner_race.mass = 2.0;
    let (s, co) = direction.sin_cos();
    c.gravity = vec2(co, s) * (LOAD / c.bearings[0].inner_race.mass);
    // the rotor falls without ever reaching the race
    c.bearings[0].contact.radial_clearance = 1.0;
    balance_mount(&mut c);
    c
}

/// Loads of the balls by statics: Q = K (i + x·n)^1.5 where positive, Σ Q n = W, both contacts in series; by Newton's
/// method for the shift x of the race.
fn statics(azimuths: &[f64], stiffness: f64, interference: f64, load: Vec2<f64>) -> Vec<f64> {
    let directions: Vec<_> = azimuths.iter().map(|a| vec2(a.cos(), a.sin())).collect();
    let approach = |shift: Vec2<f64>, n: &Vec2<f64>| (interference + shift.dot(*n)).max(0.0);
    let mut shift = load * (3e-5 / LOAD);
    for _ in 0..50 {
        let mut left = load;
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for n in &directions {
            let root = approach(shift, n).sqrt();
            left = left - *n * (stiffness * root.powi(3));
            let slope = 1.5 * stiffness * root;
            xx += slope * n.x * n.x;
            xy += slope * n.x * n.y;
            yy += slope * n.y * n.y;
        }
        let determinant = xx * yy - xy * xy;
        let step = vec2(yy * left.x - xy * left.y, xx * left.y - xy * left.x);
        shift += step * (1.0 / determinant);
    }
    directions
        .iter()
        .map(|n| stiffness * approach(shift, n).powf(1.5))
        .collect()
}

/// Azimuths and inner loads of the balls of a machine that has come to rest, and the force they carry.
fn rest(c: MachineConstants) -> (Vec<f64>, Vec<f64>, Vec2<f64>) {
    let machine = RotorMachine::new(c);
    // both resonances, race on balls and bearing on mount, decay faster than e^(-900 t); the tolerance allows errors of
    // 25 pm a step, 2 mN
    let state = run(&machine, &machine.start(), &settings(18e-3, 1e-7));
    let (_, probe) = machine.inspect(&state);
    let loads = probe[DETAIL..DETAIL + 10].to_vec();
    let own = bearing_part(&machine, &state);
    let azimuths: Vec<f64> = (0..10)
        .map(|j| machine.constants.bearings[0].bearing.azimuth(own, j))
        .collect();
    for (j, load) in loads.iter().enumerate() {
        // what is seen without a look at the whole machine
        let seen = (machine.constants.bearings[0].bearing).contacts(
            &race_motion(&machine, &state),
            own,
            j,
        );
        assert!(seen.0 == azimuths[j] && (seen.1[0].load - load).abs() <= 1e-12 * LOAD);
    }
    let mut sum = vec2(0.0, 0.0);
    for (azimuth, load) in azimuths.iter().zip(&loads) {
        sum += vec2(azimuth.cos(), azimuth.sin()) * *load;
    }
    (azimuths, loads, sum)
}

#[test]
fn ball_loads_balance_the_weight_and_share_it_by_statics() {
    for (interference, direction) in [(0.0, -0.5 * PI), (2e-6, -1.1), (-5e-6, 2.0)] {
        let planar_machine = loaded(interference, direction);
        let mut rolls = planar_machine.clone();
        let_roll(&mut rolls);
        let stiffness = match &rolls.bearings[0].bearing {
            BearingConstants::Spatial(_) => panic!("the bearing lies in the plane"),
            BearingConstants::Rolling(bearing) => bearing.ball.series_stiffness,
            BearingConstants::Planar(_) => panic!("the balls roll here"),
        };
        // ball by ball: a contact is seen from its own race, whose centre is some 10 µm of 18 mm away
        for (constants, tolerance) in [(rolls, 1e-5), (planar_machine, 2e-3)] {
            let (azimuths, loads, sum) = rest(constants);
            let expected = vec2(direction.cos(), direction.sin()) * LOAD;
            let left = (sum - expected).length_squared().sqrt() / LOAD;
            assert!(left < tolerance, "Σ Q n is {sum:?}, not {expected:?}");
            let by_statics = statics(&azimuths, stiffness, interference, expected);
            for (load, expected) in loads.iter().zip(&by_statics) {
                assert!(
                    (load - expected).abs() < tolerance * LOAD,
                    "{loads:?} {by_statics:?}"
                );
            }
        }
    }
}

#[test]
fn without_clearance_the_lowest_of_ten_balls_carries_stribecks_share() {
    // Stribeck: Q = 4.37 W/Z for point contacts without clearance and many balls (from memory: Harris, Rolling Bearing
    // Analysis); with ten, one of them below: Σ cos^2.5 over five balls, 4.380 W/Z
    let share = 1.0 + 2.0 * (0.2 * PI).cos().powf(2.5) + 2.0 * (0.4 * PI).cos().powf(2.5);
    assert!((10.0 / share / 4.37 - 1.0).abs() < 5e-3);
    let mut c = loaded(0.0, -0.5 * PI);
    planar(&mut c).first_ball_angle = -0.5 * PI;
    let mut rolls = c.clone();
    let_roll(&mut rolls);
    for (constants, tolerance) in [(rolls, 1e-5), (c, 1e-3)] {
        let (_, loads, _) = rest(constants);
        assert!(
            (loads[0] * share / LOAD - 1.0).abs() < tolerance,
            "{loads:?}"
        );
    }
}
