//! The losses of a machine whose bearings differ: those of each bearing, and what brakes the rotor besides.
//!
//! ```text
//!   M = Σ n_k (M0_k + M1_k)(ω, T_k) + M_brake + d ω + c_w ω²
//! ```
//!
//! Nodes and losses stand bearing by bearing, two losses each; the last loss is that of the rotor, whose heat leaves with brake
//! and gas.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::bearing_network::NODES;
use crate::losses::Losses;
use crate::warm_bearing::WarmBearings;
use physics::palmgren::FADING_SPEED;

/// What brakes a rotor besides its bearings.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RotorDrag {
    /// Torque of a brake, N m.
    pub torque: f64,
    /// Over the speed, N m s.
    pub drag: f64,
    /// Over its square, N m s².
    pub drag_square: f64,
}

impl RotorDrag {
    /// Moment against the motion at a speed of 0 or more, N m.
    pub fn moment(&self, speed: f64) -> f64 {
        self.torque * (speed / FADING_SPEED).tanh() + speed * (self.drag + self.drag_square * speed)
    }
}

/// Bearings that warm, each with its own network, and their rotor.
#[derive(Clone, Debug)]
pub struct WarmMachine {
    /// The bearings.
    pub bearings: Vec<WarmBearings>,
    /// The rotor.
    pub rotor: RotorDrag,
}

impl WarmMachine {
    /// The temperatures of one bearing among those of all.
    pub fn of_bearing<'a>(&self, bearing: usize, temperatures: &'a [f64]) -> &'a [f64] {
        &temperatures[bearing * NODES.len()..][..NODES.len()]
    }
}

impl Losses for WarmMachine {
    fn count(&self) -> usize {
        2 * self.bearings.len() + 1
    }
    fn moments(&self, speed: f64, temperatures: &[f64], moments: &mut [f64]) {
        for (k, bearing) in self.bearings.iter().enumerate() {
            let parts = bearing.on_rotor(speed, self.of_bearing(k, temperatures));
            moments[2 * k..2 * k + 2].copy_from_slice(&parts);
        }
        moments[2 * self.bearings.len()] = self.rotor.moment(speed);
    }
    fn share(&self, loss: usize, node: usize) -> f64 {
        match self.bearings.get(loss / 2) {
            Some(bearing) if node / NODES.len() == loss / 2 => {
                bearing.share(loss % 2, node % NODES.len())
            }
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::warm_bearing::BearingLoad;
    use physics::palmgren::Palmgren;
    use physics::viscosity::Viscosity;

    fn bearing(pitch_diameter: f64) -> WarmBearings {
        let mut viscous = vec![0.0; NODES.len()];
        viscous[4] = 1.0;
        WarmBearings {
            count: 1.0,
            ratio: 0.98,
            moment: Palmgren {
                viscous_factor: 2.0,
                viscosity: 5e-5,
                pitch_diameter,
                load_factor: 9e-4,
                load_exponent: 0.55,
                static_load_rating: 5850.0,
                preload: 0.0,
            },
            oil: Viscosity::constant(5e-5),
            load: BearingLoad::Radial(40.0),
            windage: 0.0,
            lubricant: 4,
            shares: [viscous.clone(), viscous],
        }
    }

    #[test]
    fn each_bearing_heats_itself_and_the_rotor_none_of_them() {
        let rotor = RotorDrag {
            torque: 0.1,
            drag: 1e-5,
            drag_square: 1e-8,
        };
        let machine = WarmMachine {
            bearings: vec![bearing(36e-3), bearing(50e-3)],
            rotor,
        };
        let temperatures = [40.0; 2 * NODES.len()];
        let mut moments = vec![0.0; machine.count()];
        machine.moments(1000.0, &temperatures, &mut moments);
        for (k, bearing) in machine.bearings.iter().enumerate() {
            // the rotor rolls in a bore that is wider by 2 %: power is that of the race, M(ω_race) ω_race
            let alone = bearing.of_one(980.0, &temperatures[..NODES.len()]);
            for (moment, alone) in moments[2 * k..].iter().zip(alone) {
                assert!((moment * 1000.0 / (alone * 980.0) - 1.0).abs() < 1e-12);
            }
            for loss in 0..2 {
                let share = |node| machine.share(2 * k + loss, node);
                assert_eq!((0..2 * NODES.len()).map(share).sum::<f64>(), 1.0);
                assert_eq!(share(NODES.len() * k + 4), 1.0);
            }
        }
        assert!((moments[4] - (0.1 + 1e-2 + 1e-2)).abs() < 1e-12);
        assert!((0..2 * NODES.len()).all(|node| machine.share(4, node) == 0.0));
    }
}
