//! The losses of a machine whose bearings differ: those of each bearing, and what brakes the rotor besides.
//!
//! ```text
//!   M = Σ n_k (M0_k + M1_k)(ω, T_k) + M_brake + d ω + c_w ω²
//! ```
//!
//! Nodes and losses stand bearing by bearing, three losses each: M0, M1, and what no law of a rolling bearing knows; the last loss is that of the
//! rotor, whose heat leaves with brake and gas.
//!
//! A rotor that does not roll is known at speeds at which its motion was followed: how M0 and M1 differ from their laws there, and what else
//! brakes. Between two of them that goes along straight lines, and the laws follow the temperatures.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::bearing_network::{Landing, NODES};
use crate::losses::Losses;
use crate::warm_bearing::WarmBearings;

/// Spin below which the brake of a rotor fades out, rad/s: a brake stops, it does not reverse.
pub const BRAKE_FADE: f64 = 1.0;

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
        self.torque * (speed / BRAKE_FADE).tanh() + speed * (self.drag + self.drag_square * speed)
    }
}

/// What a bearing does at a speed at which its motion was followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InMotion {
    /// M0 and M1 over their laws at the temperatures there.
    pub factors: [f64; 2],
    /// What else brakes the rotor, N m.
    pub beside: f64,
    /// Speed of its inner race over that of one that rolls.
    pub spin: f64,
    /// How the rotor lies in it.
    pub landing: Landing,
}

/// What a machine does at a speed at which its motion was followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Followed {
    /// rad/s.
    pub speed: f64,
    /// The bearings.
    pub bearings: Vec<InMotion>,
    /// What else brakes the rotor, whose heat leaves, N m.
    pub rotor: f64,
}

/// A machine between two speeds at which its motion was followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Between {
    /// At both.
    pub ends: [Followed; 2],
    /// Shares of what else brakes in each bearing, over the nodes of all bearings; those of a bearing add to one.
    pub shares: Vec<f64>,
}

impl Between {
    /// Share of the way from the first speed to the second.
    pub fn way(&self, speed: f64) -> f64 {
        let [from, to] = [self.ends[0].speed, self.ends[1].speed];
        match from == to {
            true => 0.0,
            false => ((speed - from) / (to - from)).clamp(0.0, 1.0),
        }
    }
    fn bearing(&self, way: f64, bearing: usize) -> InMotion {
        let [from, to] = [0, 1].map(|end: usize| self.ends[end].bearings[bearing]);
        let along = |from: f64, to: f64| from + way * (to - from);
        InMotion {
            factors: [0, 1].map(|part| along(from.factors[part], to.factors[part])),
            beside: along(from.beside, to.beside),
            spin: along(from.spin, to.spin),
            landing: from.landing.along(to.landing, way),
        }
    }
    /// Speed of the inner race of a bearing over that of one that rolls, at a speed of the rotor.
    pub fn spin(&self, speed: f64, bearing: usize) -> f64 {
        self.bearing(self.way(speed), bearing).spin
    }
    /// How the rotor lies in a bearing at a speed of the rotor.
    pub fn landing(&self, speed: f64, bearing: usize) -> Landing {
        self.bearing(self.way(speed), bearing).landing
    }
}

/// Bearings that warm, each with its own network, and their rotor.
#[derive(Clone, Debug)]
pub struct WarmMachine {
    /// The bearings.
    pub bearings: Vec<WarmBearings>,
    /// The rotor.
    pub rotor: RotorDrag,
    /// How its motion differs from rolling; none where it rolls.
    pub motion: Option<Between>,
}

/// Losses of each bearing.
pub const OF_BEARING: usize = 3;

/// Of moments or heats of all losses: M0 of all bearings, what else brakes in them, and what brakes the rotor.
pub fn by_kind(all: &[f64]) -> [f64; 3] {
    let (rotor, bearings) = all.split_last().unwrap_or((&0.0, &[]));
    let sum = |loss: usize| -> f64 { bearings.iter().skip(loss).step_by(OF_BEARING).sum() };
    [sum(0), sum(1) + sum(2), *rotor]
}

impl WarmMachine {
    /// The temperatures of one bearing among those of all.
    pub fn of_bearing<'a>(&self, bearing: usize, temperatures: &'a [f64]) -> &'a [f64] {
        &temperatures[bearing * NODES.len()..][..NODES.len()]
    }
}

impl Losses for WarmMachine {
    fn count(&self) -> usize {
        OF_BEARING * self.bearings.len() + 1
    }
    fn moments(&self, speed: f64, temperatures: &[f64], moments: &mut [f64]) {
        let motion = (self.motion.as_ref()).map(|motion| (motion, motion.way(speed)));
        for (k, bearing) in self.bearings.iter().enumerate() {
            let [first, second] = bearing.on_rotor(speed, self.of_bearing(k, temperatures));
            let all = match motion {
                Some((motion, way)) => {
                    let InMotion {
                        factors, beside, ..
                    } = motion.bearing(way, k);
                    [factors[0] * first, factors[1] * second, beside]
                }
                None => [first, second, 0.0],
            };
            moments[OF_BEARING * k..][..OF_BEARING].copy_from_slice(&all);
        }
        let beside = motion.map_or(0.0, |(motion, way)| {
            let [from, to] = [motion.ends[0].rotor, motion.ends[1].rotor];
            from + way * (to - from)
        });
        moments[OF_BEARING * self.bearings.len()] = self.rotor.moment(speed) + beside;
    }
    fn share(&self, loss: usize, node: usize) -> f64 {
        let bearing = loss / OF_BEARING;
        if bearing >= self.bearings.len() || node / NODES.len() != bearing {
            return 0.0;
        }
        match (loss % OF_BEARING, &self.motion) {
            (2, Some(motion)) => motion.shares[node],
            (2, None) => 0.0,
            (part, _) => self.bearings[bearing].share(part, node % NODES.len()),
        }
    }
    fn planes(&self, node: usize) -> f64 {
        self.bearings[node / NODES.len()].count
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
            motion: None,
        };
        let temperatures = [40.0; 2 * NODES.len()];
        let mut moments = vec![0.0; machine.count()];
        machine.moments(1000.0, &temperatures, &mut moments);
        for (k, bearing) in machine.bearings.iter().enumerate() {
            // the rotor rolls in a bore that is wider by 2 %: power is that of the race, M(ω_race) ω_race
            let alone = bearing.of_one(980.0, &temperatures[..NODES.len()]);
            for (moment, alone) in moments[OF_BEARING * k..].iter().zip(alone) {
                assert!((moment * 1000.0 / (alone * 980.0) - 1.0).abs() < 1e-12);
            }
            for loss in 0..2 {
                let share = |node| machine.share(OF_BEARING * k + loss, node);
                assert_eq!((0..2 * NODES.len()).map(share).sum::<f64>(), 1.0);
                assert_eq!(share(NODES.len() * k + 4), 1.0);
            }
        }
        assert!((moments[6] - (0.1 + 1e-2 + 1e-2)).abs() < 1e-12);
        assert!((0..2 * NODES.len()).all(|node| machine.share(6, node) == 0.0));
    }

    #[test]
    fn between_two_speeds_at_which_it_was_followed_the_laws_go_with_the_temperatures() {
        let at = |speed: f64, factor: f64, beside: f64| Followed {
            speed,
            bearings: vec![InMotion {
                factors: [1.0, factor],
                beside,
                spin: beside,
                landing: Landing::rolls(100.0 * beside),
            }],
            rotor: 1e-3 * speed,
        };
        let mut shares = vec![0.0; NODES.len()];
        shares[1] = 1.0;
        let mut machine = WarmMachine {
            bearings: vec![bearing(36e-3)],
            rotor: RotorDrag::default(),
            motion: None,
        };
        let moments = |machine: &WarmMachine, speed: f64, celsius: f64| {
            let mut moments = vec![0.0; machine.count()];
            machine.moments(speed, &[celsius; NODES.len()], &mut moments);
            moments
        };
        let law = [40.0, 90.0].map(|celsius| moments(&machine, 950.0, celsius));
        let motion = Between {
            ends: [at(1000.0, 3.0, 0.2), at(900.0, 5.0, 0.4)],
            shares,
        };
        assert!((motion.spin(950.0, 0) - 0.3).abs() < 1e-12);
        assert!((motion.landing(950.0, 0).force - 30.0).abs() < 1e-10);
        machine.motion = Some(motion);
        for (law, celsius) in law.iter().zip([40.0, 90.0]) {
            let found = moments(&machine, 950.0, celsius);
            assert!((found[0] / law[0] - 1.0).abs() < 1e-12);
            assert!((found[1] / law[1] - 4.0).abs() < 1e-12);
            assert!((found[2] - 0.3).abs() < 1e-12 && (found[3] - 0.95).abs() < 1e-12);
        }
        assert_eq!(machine.share(2, 1), 1.0);
        // beyond both it stays as it was there
        assert!((moments(&machine, 800.0, 40.0)[2] - 0.4).abs() < 1e-12);
    }

    #[test]
    fn a_brake_is_whole_when_it_turns_and_nothing_at_rest() {
        let brake = RotorDrag {
            torque: 2.0,
            drag: 0.0,
            drag_square: 0.0,
        };
        assert_eq!(brake.moment(0.0), 0.0);
        // 2 tanh 1 and 2 tanh 10, by a table
        assert!((brake.moment(1.0) - 1.523_188_311_911_53).abs() < 1e-13);
        assert!((2.0 - brake.moment(10.0) - 8.244_614_5e-9).abs() < 1e-15);
    }
}
