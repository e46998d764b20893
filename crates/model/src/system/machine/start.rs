//! The levitated state at release: a steady orbit above bearings at rest.

use super::layout::ROTOR;
use super::{MachineConstants, RotorMachine};
use crate::bearing::BearingConstants;
use number::Vec2;
use physics::unbalance::whirl;

/// The mass centre of a rotor that orbits steadily on its levitation: (position, velocity).
///
/// ```text
///   G = C_0 + e^(jφ) (k + jcΩ) e/(k + jcΩ - mΩ²)
/// ```
/// The levitation acts at C = G - e e^(jφ) and carries the weight. Its moment about G, which a real drive balances, is
/// neglected: the spin is held while levitated.
pub fn levitated_orbit(constants: &MachineConstants) -> (Vec2<f64>, Vec2<f64>) {
    let (rotor, levitation) = (&constants.rotor, &constants.levitation);
    let spin = constants.speed;
    let e = rotor.eccentricity;
    let (along, ahead) = whirl(
        levitation.stiffness,
        levitation.damping,
        rotor.mass,
        spin,
        e,
    );
    let (sine, cosine) = constants.unbalance_angle.sin_cos();
    let radial = Vec2::new(cosine, sine);
    let orbit = radial * (along + e) + radial.turned() * ahead;
    (levitation.centre + orbit, orbit.turned() * spin)
}

impl RotorMachine {
    /// The state at release.
    pub fn start(&self) -> Vec<f64> {
        let mut state = vec![0.0; self.layout().dimension()];
        let (position, velocity) = levitated_orbit(&self.constants);
        state[ROTOR] = position.x;
        state[ROTOR + 1] = position.y;
        state[ROTOR + 2] = velocity.x;
        state[ROTOR + 3] = velocity.y;
        state[ROTOR + 4] = self.constants.unbalance_angle;
        state[ROTOR + 5] = self.constants.speed;
        for (at, part) in self.layout().bearings.iter().zip(&self.constants.bearings) {
            part.bearing.rest(&mut state[at.own()]);
        }
        state
    }

    /// Moves a start state: the rotor by `rotor` (m), each ball along its orbit by its `ball_angle` (rad), a function of
    /// bearing and ball. Balls without states of their own stay.
    pub fn perturb(
        &self,
        state: &mut [f64],
        rotor: Vec2<f64>,
        ball_angle: &dyn Fn(usize, usize) -> f64,
    ) {
        state[ROTOR] += rotor.x;
        state[ROTOR + 1] += rotor.y;
        let parts = self.layout().bearings.iter().zip(&self.constants.bearings);
        for (k, (at, part)) in parts.enumerate() {
            if let BearingConstants::Planar(bearing) = &part.bearing {
                for ball in 0..bearing.balls {
                    state[at.bearing + bearing.azimuth_channel(ball)] += ball_angle(k, ball);
                }
            }
        }
    }
}
