//! The levitated state at release: a steady orbit above bearings at rest.

use super::{MachineConstants, RotorMachine};
use number::Vec2;
use physics::unbalance::whirl;

/// The mass centre of a point rotor that orbits steadily on its levitation: (position, velocity).
///
/// ```text
///   G = C_0 + e^(jφ) (k + jcΩ) e/(k + jcΩ - mΩ²)
/// ```
/// The levitation acts at C = G - e e^(jφ) and carries the weight. Its moment about G, which a real drive balances, is
/// neglected: the spin is held while levitated.
pub fn levitated_orbit(constants: &MachineConstants) -> (Vec2<f64>, Vec2<f64>) {
    let (rotor, levitation) = (&constants.rotor, &constants.levitation);
    let spin = constants.speed;
    let own = &rotor.coordinates[0];
    let e = own.unbalance.x;
    let (along, ahead) = whirl(levitation.stiffness, levitation.damping, own.mass, spin, e);
    let (sine, cosine) = constants.unbalance_angle.sin_cos();
    let radial = Vec2::new(cosine, sine);
    let orbit = radial * (along + e) + radial.turned() * ahead;
    (levitation.centre + orbit, orbit.turned() * spin)
}

impl RotorMachine {
    /// The state at release of a point rotor, or at the start of a rig.
    ///
    /// # Panics
    /// When the rotor bends: it [starts](Self::start_with) where it is said to.
    pub fn start(&self) -> Vec<f64> {
        if let Some(fixture) = self.fixture() {
            return self.start_on_rig(fixture);
        }
        assert!(
            self.layout().rotor.coordinates == 1,
            "a rotor that bends has no levitated orbit here"
        );
        let (position, velocity) = levitated_orbit(&self.constants);
        self.at_rest_around(&[position], &[velocity])
    }

    /// The state at release of a rotor whose axis has these coordinates η (m) with these rates (m/s); everything else is at rest.
    ///
    /// # Panics
    /// When there are not so many coordinates.
    pub fn start_with(&self, position: &[Vec2<f64>], velocity: &[Vec2<f64>]) -> Vec<f64> {
        let constants = &self.constants;
        let (sine, cosine) = constants.unbalance_angle.sin_cos();
        let centres: Vec<_> = (constants.rotor.coordinates.iter())
            .map(|own| own.unbalance * cosine + own.unbalance.turned() * sine)
            .collect();
        let moved = |list: &[Vec2<f64>], by: &dyn Fn(&Vec2<f64>) -> Vec2<f64>| -> Vec<Vec2<f64>> {
            assert!(list.len() == centres.len(), "one for each coordinate");
            let pairs = list.iter().zip(&centres);
            pairs.map(|(value, centre)| *value + by(centre)).collect()
        };
        self.at_rest_around(
            &moved(position, &|centre| *centre),
            &moved(velocity, &|centre| centre.turned() * constants.speed),
        )
    }

    /// The state of a rotor whose mass centres are at these coordinates, above bearings at rest.
    fn at_rest_around(&self, position: &[Vec2<f64>], velocity: &[Vec2<f64>]) -> Vec<f64> {
        let mut state = vec![0.0; self.layout().dimension()];
        let rotor = self.layout().rotor;
        for (first, list) in [(0, position), (2, velocity)] {
            for (k, value) in list.iter().enumerate() {
                state[rotor.block(first).start + k] = value.x;
                state[rotor.block(first + 1).start + k] = value.y;
            }
        }
        state[rotor.angle()] = self.constants.unbalance_angle;
        state[rotor.spin()] = self.constants.speed;
        for (at, part) in self.layout().bearings.iter().zip(&self.constants.bearings) {
            part.bearing.rest(&mut state[at.own()]);
            for ring in [at.inner, at.outer] {
                ring.rest(&mut state);
            }
        }
        let control = self.constants.magnets.iter();
        for control in control.filter_map(|own| own.control()) {
            state[self.layout().magnets.clone()].copy_from_slice(&control.start());
        }
        let mut mode = self.mode_at(0.0);
        for event in self.constants.schedule.at_the_start() {
            self.happen(event, 0.0, &mut mode, &mut state);
        }
        state
    }

    /// Moves the rotor of a start state as a whole: by a displacement, m, and with a velocity, m/s.
    pub fn displace(&self, state: &mut [f64], displacement: Vec2<f64>, velocity: Vec2<f64>) {
        let at = self.layout().rotor;
        let housings = self.constants.rotor.housings;
        for (k, own) in (housings..).zip(self.constants.rotor.own_coordinates()) {
            let share = own.weight / own.mass;
            for (block, by) in [displacement.x, displacement.y, velocity.x, velocity.y]
                .into_iter()
                .enumerate()
            {
                state[at.block(block).start + k] += by * share;
            }
        }
    }

    /// Moves a start state: the rotor as a whole by `rotor` (m), each ball along its orbit by its `ball_angle` (rad), a function of
    /// bearing and ball. Balls without states of their own stay.
    pub fn perturb(
        &self,
        state: &mut [f64],
        rotor: Vec2<f64>,
        ball_angle: &dyn Fn(usize, usize) -> f64,
    ) {
        self.displace(state, rotor, Vec2::zero());
        let parts = self.layout().bearings.iter().zip(&self.constants.bearings);
        for (k, (at, part)) in parts.enumerate() {
            for ball in 0..part.bearing.balls() {
                if let Some(channel) = part.bearing.azimuth_state(ball) {
                    state[at.bearing + channel] += ball_angle(k, ball);
                }
            }
        }
    }
}
