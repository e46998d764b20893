//! The steady moment ball by ball: what a steady run gives back at every speed, and what happens where traction does not
//! suffice.

use super::plateaus::{Plateau, plateaus};
use super::rig::{greased_bearing, shared};
use crate::machines::{ball_pair, land, oil, vec2};
use model::bearing::land::LandRace;
use model::bearing::{PlanarConstants, Separation, SteadyMoment};
use physics::moment_curve::MomentCurve;

/// Rising and falling: 10, 30, 100 % of the speed.
const SPEEDS: [f64; 5] = [100.0, 300.0, 1000.0, 300.0, 100.0];

/// The greased bearing with another interference, less the clearance.
fn with_interference(interference: f64) -> PlanarConstants {
    let mut bearing = greased_bearing();
    let ball = &mut bearing.ball;
    ball.outer_track = ball.inner_track + 2.0 * ball.radius - interference;
    bearing
}

/// One speed, from rest.
fn plateau(bearing: &PlanarConstants, speed: f64, load: f64) -> Plateau {
    plateaus(bearing, load, &[speed])[0]
}

/// The law's moment on both races within a share of it.
fn gives_back_the_moment(at: &Plateau, within: f64) -> bool {
    (at.inner - 1.0).abs() < within && (at.outer - 1.0).abs() < within
}

/// On every plateau; `within` is a share of the law's moment.
fn holds_at_every_speed(bearing: &PlanarConstants, load: f64, within: f64) {
    for at in plateaus(bearing, load, &SPEEDS) {
        assert!(at.capacity > 1.2, "{at:?}");
        assert!(gives_back_the_moment(&at, within), "{load} N: {at:?}");
    }
}

// Bounds: the balls creep by slip/speed, which takes two thirds of it from M0; the rest is the share κμ of unloaded balls
// and half a percent that means over a few cage turns leave.

#[test]
fn the_law_s_moment_at_every_speed_without_preload() {
    // equal shares give 0.79, 0.82, 0.96, 0.82, 0.79 of it with a traction of 0.08
    holds_at_every_speed(&with_interference(0.0), 300.0, 0.01);
}

#[test]
fn the_law_s_moment_at_every_speed_with_preload() {
    // not all balls stay pressed: equal shares give 0.86, 0.88, 0.98, 0.88, 0.86
    holds_at_every_speed(&with_interference(2e-6), 300.0, 0.01);
}

#[test]
fn the_law_s_moment_with_clearance_and_little_load() {
    // equal shares give 0.74 and 0.77
    for at in plateaus(&with_interference(-5e-6), 100.0, &SPEEDS[..2]) {
        assert!(gives_back_the_moment(&at, 0.02), "{at:?}");
    }
}

#[test]
fn a_steady_run_has_the_moment_of_the_law_on_both_races() {
    for (interference, speed, load) in [
        (2e-6, 1000.0, 500.0),
        (2e-6, -1000.0, 100.0),
        (2e-6, 150.0, 100.0),
        (1.4e-6, 1000.0, 0.0),
        (5e-6, 400.0, 20.0),
    ] {
        let at = plateau(&with_interference(interference), speed, load);
        assert!(at.capacity > 1.2, "{at:?}");
        assert!(gives_back_the_moment(&at, 0.01), "{speed} {load}: {at:?}");
        assert!(at.cage_slip.abs() < 0.02, "{at:?}");
    }
}

#[test]
fn it_holds_down_to_a_capacity_of_1_2_and_skids_below_1() {
    // the ball load grows with interference to 1.5
    let at = plateau(&with_interference(1.28e-6), 1000.0, 0.0);
    assert!((1.2..1.3).contains(&at.capacity), "{at:?}");
    assert!(
        gives_back_the_moment(&at, 0.01) && at.cage_slip < 0.03,
        "{at:?}"
    );
    let at = plateau(&with_interference(1.0e-6), 1000.0, 0.0);
    assert!(
        (0.7..1.0).contains(&at.capacity) && at.cage_slip > 0.1,
        "{at:?}"
    );
    // the whole grip is used up by less than M, and both races still feel the same
    // the balls still gain a little after three turns: 5e-3
    assert!((at.inner - at.outer).abs() < 5e-3, "{at:?}");
    assert!(at.inner < 0.95, "{at:?}");
    // and so do balls of which some are not pressed: 40 N
    let at = plateau(&with_interference(0.0), 1000.0, 40.0);
    assert!(at.capacity < 1.0 && at.inner < 0.95, "{at:?}");
}

#[test]
fn shares_of_the_moment_do_not_change_its_sum() {
    for orbit_share in [0.0, 1.0] {
        let mut bearing = with_interference(0.0);
        bearing.moment.as_mut().expect("greased").orbit_share = orbit_share;
        let at = plateau(&bearing, 300.0, 300.0);
        assert!(gives_back_the_moment(&at, 0.01), "{orbit_share}: {at:?}");
    }
}

#[test]
fn a_scale_is_the_user_s_own_factor() {
    let mut bearing = with_interference(0.0);
    let whole = plateau(&bearing, 300.0, 300.0);
    let moment = bearing.moment.as_mut().expect("greased");
    moment.law = moment.law.clone().scaled(0.7);
    let at = plateau(&bearing, 300.0, 300.0);
    assert!(gives_back_the_moment(&at, 0.01), "{at:?}");
    // the same grip stands against less
    let grip = whole.capacity / at.capacity;
    assert!((grip / 0.7 - 1.0).abs() < 0.01, "{at:?}");
}

#[test]
fn pockets_that_rub_hard_add_little_in_a_steady_run() {
    // pressed balls carry the moment, so that they push the others with next to nothing
    let mut bearing = with_interference(0.0);
    bearing.ball.pocket_friction = 0.5;
    let at = plateau(&bearing, 1000.0, 300.0);
    assert!(gives_back_the_moment(&at, 0.02), "{at:?}");
}

#[test]
fn land_and_neighbours_add_little_to_the_moment() {
    for (separation, speed) in [
        (
            Separation::FreeCage(Some(land(LandRace::Outer, 0.15e-3))),
            1000.0,
        ),
        (
            Separation::FreeCage(Some(land(LandRace::Inner, 0.15e-3))),
            1000.0,
        ),
        (Separation::FreeCage(None), 300.0),
        (Separation::Neighbours(ball_pair()), 1000.0),
    ] {
        let mut bearing = with_interference(0.0);
        if let Separation::Neighbours(_) = separation {
            bearing.balls = 17;
        }
        bearing.separation = separation;
        bearing.ball.gravity = vec2(0.0, -9.81);
        let at = plateau(&bearing, speed, 300.0);
        assert!(
            gives_back_the_moment(&at, 0.02),
            "{:?}: {at:?}",
            bearing.separation
        );
    }
}

#[test]
fn films_and_other_laws_keep_the_moment() {
    let mut oiled = with_interference(0.0);
    oiled.traction = oil();
    let mut measured = with_interference(0.0);
    let curve = MomentCurve::through(&[(0.0, 0.01), (100.0, 0.02), (300.0, 0.03)]);
    measured.moment = Some(shared(SteadyMoment::Curve(curve.expect("it rises"))));
    for bearing in [oiled, measured] {
        let at = plateau(&bearing, 300.0, 300.0);
        assert!(gives_back_the_moment(&at, 0.02), "{at:?}");
    }
}
