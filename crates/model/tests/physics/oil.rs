//! A ball between races with oil: the inputs of its contacts, from points on the surfaces.

use super::relatives::grease;
use crate::machines::{
    BEARING, INNER, Random, ball_of, bearing_part, heat_of, inlets, oil, planar, race_motion,
    random_state, reference, vec2,
};
use model::bearing::{BearingConstants, PlanarConstants, SharedMoment, SteadyMoment};
use model::system::machine::RotorMachine;
use number::Vec2;

/// Speed of a point at an arm from a centre of a body that turns.
fn surface(velocity: Vec2<f64>, spin: f64, arm: Vec2<f64>) -> Vec2<f64> {
    velocity + arm.turned() * spin
}

#[test]
fn entrainment_is_the_mean_of_both_surface_speeds() {
    let mut c = reference();
    planar(&mut c).traction = oil();
    let machine = RotorMachine::new(c);
    let BearingConstants::Planar(b) = &machine.constants.bearings[0].bearing else {
        panic!("the bearing is planar here");
    };
    let mut random = Random(5);
    for _ in 0..50 {
        let state = random_state(&machine, &mut random);
        let motion = race_motion(&machine, &state);
        for j in 0..b.balls {
            let ball = ball_of(&machine, &state, j);
            let (sine, cosine) = ball.azimuth.sin_cos();
            let e_r = vec2(cosine, sine);
            let centre = e_r * ball.radius;
            let velocity =
                e_r * ball.radial_speed + e_r.turned() * (ball.radius * ball.orbit_speed);
            let reaction = b.ball_reaction(&motion, bearing_part(&machine, &state), j);
            let contacts = reaction.contacts();
            for (race, at, approach, side) in [
                (&motion.inner, contacts[0], reaction.inner_approach, -1.0),
                (&motion.outer, contacts[1], reaction.outer_approach, 1.0),
            ] {
                let away = centre - race.position;
                let distance = away.length_squared().sqrt();
                let n = away * (1.0 / distance);
                // the contact lies on the line of centres, at a fixed arm from the ball
                let arm = n * (side * (b.ball.radius - 0.5 * approach));
                let turning = n.cross(velocity - race.velocity) / distance;
                let contact = surface(velocity, turning, arm);
                let of_ball = surface(velocity, ball.spin, arm) - contact;
                let of_race = surface(race.velocity, race.spin, away + arm) - contact;
                let t = n.turned();
                let (ball_speed, race_speed) = (of_ball.dot(t), of_race.dot(t));
                // rounding of speeds of some m/s
                let near = |a: f64, b: f64| (a - b).abs() < 1e-12 * (1.0 + a.abs() + b.abs());
                assert!(near(at.slip, race_speed - ball_speed), "{at:?}");
                assert!(
                    near(at.entrainment, 0.5 * (race_speed + ball_speed)),
                    "{at:?} {race_speed} {ball_speed}"
                );
            }
        }
    }
}

/// The reference machine in oil whose bearing rolls at 1000 rad/s, with or without the resistance of the inlets, and its rate.
fn rolling_in_oil(change: impl Fn(&mut PlanarConstants)) -> (RotorMachine, Vec<f64>, Vec<f64>) {
    let mut c = reference();
    planar(&mut c).traction = oil();
    change(planar(&mut c));
    let machine = RotorMachine::new(c);
    let mut state = machine.start();
    let BearingConstants::Planar(b) = &machine.constants.bearings[0].bearing else {
        panic!("the bearing is planar here");
    };
    state[INNER + 5] = 1000.0;
    b.roll(&mut state[BEARING..machine.layout().ledger()], 1000.0);
    let (rate, _) = machine.inspect(&state);
    (machine, state, rate)
}

#[test]
fn oil_in_the_inlets_resists_rolling() {
    let (_, _, free) = rolling_in_oil(|_| ());
    let (machine, state, rate) = rolling_in_oil(|bearing| bearing.inlet_rolling = Some(inlets()));
    let BearingConstants::Planar(b) = &machine.constants.bearings[0].bearing else {
        panic!("the bearing is planar here");
    };
    let (motion, law) = (race_motion(&machine, &state), inlets());
    let mut expected = 0.0;
    for j in 0..b.balls {
        let r = b.ball_reaction(&motion, bearing_part(&machine, &state), j);
        for (at, law) in r.contacts().into_iter().zip([law.inner, law.outer]) {
            let heated = law.heating.factor(at.slip, at.entrainment, at.load);
            let force = law.rolling.force(at.load, at.entrainment);
            expected += 2.0 * force * heated * at.entrainment.abs();
        }
        let [slowed, rolling] = [&rate, &free].map(|rate| ball_of(&machine, rate, j).spin);
        let spin = ball_of(&machine, &state, j).spin;
        assert!((slowed - rolling) * spin < 0.0, "ball {j}");
    }
    // the sum over both races of 2 F v, the source's own dissipation; arms under load differ from those of the law by 1e-4
    let heat = heat_of(&machine, &rate, "inlet_rolling");
    assert!((heat / expected - 1.0).abs() < 1e-3, "{heat} {expected}");
    assert!(rate[INNER + 5] < free[INNER + 5]);
    // of the order of Palmgren's M0, which is 49 N mm with f0 = 2 and 40 mm²/s at 1000 rad/s, drag included: factor 3
    assert!((0.015..0.14).contains(&(heat / 1000.0)), "{heat}");
}

#[test]
fn a_steady_moment_holds_the_resistance_of_the_inlets() {
    let greased = |bearing: &mut PlanarConstants| {
        bearing.ball.orbit_drag = 0.0;
        bearing.ball.spin_drag = 0.0;
        bearing.moment = Some(SharedMoment {
            law: SteadyMoment::Palmgren(grease()),
            axial_load: 0.0,
            orbit_share: 0.5,
            reference_spin: 1.0,
        });
    };
    let (_, _, alone) = rolling_in_oil(greased);
    let (machine, _, both) = rolling_in_oil(|bearing| {
        greased(bearing);
        bearing.inlet_rolling = Some(inlets());
    });
    assert_eq!(alone, both);
    assert!(
        !machine.constants.bearings[0]
            .bearing
            .may_make("inlet_rolling")
    );
}
