//! The start of a rig: its bearing settled under its load.

use super::Drive;
use super::layout::{ARM, HOUSING};
use crate::bearing::ball_states::CAGE_PLACE;
use crate::bearing::{BearingConstants, Separation};
use crate::body::put;
use crate::system::machine::RotorMachine;
use crate::system::rig::fixture::Fixture;
use number::Vec2;

impl RotorMachine {
    /// The state at the start of a rig: the bearing settled under its load, given speeds at their first values. Balls roll with the shaft
    /// of a clutch, and the arm has settled under what disturbs it where that rests; else they are at rest.
    pub(in crate::system) fn start_on_rig(&self, fixture: &Fixture) -> Vec<f64> {
        let (part, at) = (&self.constants.bearings[0], &self.layout().bearings[0]);
        let (bearing, race, gravity) = (&part.bearing, &part.inner_race, self.constants.gravity);
        let mut state = vec![0.0; self.layout().dimension()];
        let load = fixture.load_direction * fixture.load.value(0.0);
        match &fixture.housing {
            Some(housing) if !housing.centre_held => {
                let weight = load + gravity * part.outer_weighing_mass();
                let place = settle_housing(bearing, weight, &mut state[at.own()]);
                put(&mut state, HOUSING.centre(), place);
            }
            Some(_) => {
                bearing.settle(Vec2::zero(), &mut state[at.own()]);
            }
            None => {
                let on_race = match part.is_concentric() {
                    true => Vec2::zero(),
                    false => load + gravity * race.mass,
                };
                let place = bearing.settle(on_race, &mut state[at.own()]);
                put(&mut state, at.inner.centre(), place);
            }
        }
        let speed = fixture.drive.race_speed();
        state[at.inner.spin()] = speed;
        state[at.driver] = fixture.drive.rotor_speed();
        if let Some(housing) = &fixture.housing
            && speed == 0.0
        {
            let angle = state[at.inner.angle()];
            state[ARM] = housing.arm.disturbance.moment(angle, 0.0);
        }
        if let (Drive::Clutch(_), BearingConstants::Planar(bearing)) = (&fixture.drive, bearing) {
            bearing.roll(&mut state[at.own()], speed);
        }
        state
    }
}

/// Settles a bearing whose inner race is fixed at the origin under a force on its outer race; returns where the outer
/// race stands, m.
fn settle_housing(bearing: &BearingConstants, force: Vec2<f64>, state: &mut [f64]) -> Vec2<f64> {
    // the outer race at the origin, the inner one pushed the other way; then all of it moved back
    let place = -bearing.settle(-force, state);
    if let BearingConstants::Planar(planar) = bearing {
        for j in 0..planar.balls {
            let mut ball = planar.motion(state, j);
            let (sine, cosine) = ball.azimuth.sin_cos();
            let radial = Vec2::new(cosine, sine);
            let centre = radial * ball.radius + place;
            // the small angle between the old and the new direction
            ball.azimuth += radial.cross(centre).atan2(radial.dot(centre));
            ball.radius = centre.length_squared().sqrt();
            planar.set_motion(state, j, &ball);
        }
        if let Separation::FreeCage(_) = planar.separation {
            state[CAGE_PLACE] += place.x;
            state[CAGE_PLACE + 1] += place.y;
        }
    }
    place
}
