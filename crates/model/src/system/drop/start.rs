//! The levitated state at release: a steady orbit above a bearing at rest.

use super::layout::{BEARING, ROTOR};
use super::{DropConstants, DropMachine};
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
pub fn levitated_orbit(constants: &DropConstants) -> (Vec2<f64>, Vec2<f64>) {
    let m = &constants.machine;
    let spin = constants.speed;
    let e = m.rotor.eccentricity;
    let (along, ahead) = whirl(
        m.levitation.stiffness,
        m.levitation.damping,
        m.rotor.mass,
        spin,
        e,
    );
    let (sine, cosine) = constants.unbalance_angle.sin_cos();
    let radial = Vec2::new(cosine, sine);
    let orbit = radial * (along + e) + radial.turned() * ahead;
    (m.levitation.centre + orbit, orbit.turned() * spin)
}

impl DropMachine {
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
        let own = BEARING..self.layout().ledger();
        self.constants.bearing.rest(&mut state[own]);
        state
    }

    /// Moves a start state: the rotor by `rotor` (m), each ball along its orbit by its `ball_angle` (rad).
    /// Balls without states of their own stay.
    pub fn perturb(&self, state: &mut [f64], rotor: Vec2<f64>, ball_angle: &dyn Fn(usize) -> f64) {
        state[ROTOR] += rotor.x;
        state[ROTOR + 1] += rotor.y;
        if let BearingConstants::Planar(bearing) = &self.constants.bearing {
            for ball in 0..bearing.balls {
                state[BEARING + bearing.azimuth_channel(ball)] += ball_angle(ball);
            }
        }
    }
}
