//! A ball between races with oil: what its contacts are told, from points on the surfaces.

use crate::machines::{Random, ball_of, bearing_part, oil, planar, random_state, reference, vec2};
use model::bearing::BearingConstants;
use model::system::drop::DropMachine;
use model::system::drop::rate::race_motion;
use number::Vec2;

/// Speed of a point at an arm from a centre of a body that turns.
fn surface(velocity: Vec2<f64>, spin: f64, arm: Vec2<f64>) -> Vec2<f64> {
    velocity + arm.turned() * spin
}

#[test]
fn entrainment_is_the_mean_of_both_surface_speeds() {
    let mut c = reference();
    planar(&mut c).traction = oil();
    let machine = DropMachine::new(c);
    let BearingConstants::Planar(b) = &machine.constants.bearing else {
        panic!("the bearing is planar here");
    };
    let mut random = Random(5);
    for _ in 0..50 {
        let state = random_state(&machine, &mut random);
        let motion = race_motion(&state);
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
