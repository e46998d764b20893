//! The losses of warm bearings: Palmgren's moment with the viscosity of the lubricant node, and windage.
//!
//! ```text
//!   M = n (M0(ν(T_lubricant), ω) + M1) + c_w ω²
//! ```
//!
//! Losses by number: 0 is M0, 1 is M1, 2 is windage, whose heat leaves with the gas. Viscosity goes on along the line of
//! the oil beyond its points: a bearing that runs away leaves every range, and a run that stopped there would hide it.
//!
//! Source: the laws are those of `physics`.

use crate::clearance::{ThermalClearance, preload};
use crate::load_zone::LoadZone;
use crate::losses::Losses;
use physics::palmgren::{FADING_SPEED, Palmgren};
use physics::viscosity::ICE_POINT;
use physics::viscosity::Viscosity;

/// Bearings that are all alike.
#[derive(Clone, Debug, PartialEq)]
pub struct WarmBearings {
    /// How many brake.
    pub count: f64,
    /// Speed of their inner races over that of the rotor, which rolls in their wider bores: 1 − c0/R.
    pub ratio: f64,
    /// Moment of one; its viscosity is not used.
    pub moment: Palmgren<f64>,
    /// Oil.
    pub oil: Viscosity,
    /// Load of one.
    pub load: BearingLoad,
    /// Windage coefficient c_w, N m s².
    pub windage: f64,
    /// Node of the lubricant.
    pub lubricant: usize,
    /// Shares of M0 and of M1 over the nodes of one bearing; each adds to one.
    pub shares: [Vec<f64>; 2],
}

/// Where M1 comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum BearingLoad {
    /// A radial load, N, with the factors of Palmgren's law.
    Radial(f64),
    /// M1 as it is, N m: of balls that an axial load presses besides.
    Moment(f64),
    /// Ball loads, some of them from rings that close: M1 = μ₁ (d_m/2) (ΣQ + Z Q), N m.
    Closing {
        /// μ₁.
        coefficient: f64,
        /// ΣQ of the radial load, N.
        radial: f64,
        /// Number of balls Z.
        balls: f64,
        /// Ball and both races in series, N/m^1.5.
        stiffness: f64,
        /// Clearance over temperatures.
        clearance: ThermalClearance,
        /// Nodes of inner ring, balls and outer ring.
        nodes: [usize; 3],
    },
    /// The radial load that presses the balls as hard as they are at the clearance there is, with the factors of Palmgren's law.
    Zone {
        /// ΣQ of the radial load without preload, N.
        unpreloaded: f64,
        /// The balls.
        zone: LoadZone,
    },
}

impl WarmBearings {
    /// Diametral clearance, m, and preload of each ball, N, at a speed of the inner race, rad/s; none where the load is given.
    pub fn closing(&self, speed: f64, temperatures: &[f64]) -> Option<(f64, f64)> {
        let (open, stiffness) = match &self.load {
            BearingLoad::Radial(_) | BearingLoad::Moment(_) => return None,
            BearingLoad::Closing {
                stiffness,
                clearance,
                nodes: [inner, balls, outer],
                ..
            } => {
                let open = clearance.at(
                    temperatures[*inner],
                    temperatures[*balls],
                    temperatures[*outer],
                );
                (open, *stiffness)
            }
            BearingLoad::Zone { zone, .. } => {
                (zone.clearance_at(temperatures, speed), zone.stiffness)
            }
        };
        Some((open, preload(stiffness, open)))
    }

    /// M0 and M1 of all of them as the rotor feels them, N m: less by the ratio of the speeds, so that the power is theirs.
    pub fn on_rotor(&self, speed: f64, temperatures: &[f64]) -> [f64; 2] {
        let each = self.of_one(self.ratio * speed, temperatures);
        each.map(|moment| self.count * self.ratio * moment)
    }

    /// The law of one bearing with the viscosity that its lubricant has.
    pub fn law_at(&self, temperatures: &[f64]) -> Palmgren<f64> {
        Palmgren {
            viscosity: self.oil.held(temperatures[self.lubricant] + ICE_POINT),
            ..self.moment
        }
    }

    /// The radial load that the law of one bearing counts, N, at the speed of its inner race.
    pub fn radial_load(&self, speed: f64, temperatures: &[f64]) -> f64 {
        match &self.load {
            BearingLoad::Radial(load) => *load,
            BearingLoad::Closing { .. } | BearingLoad::Moment(_) => 0.0,
            BearingLoad::Zone { unpreloaded, zone } => {
                zone.pressing(zone.clearance_at(temperatures, speed), *unpreloaded)
            }
        }
    }

    /// M0 and M1 of one bearing at the speed of its inner race, N m.
    pub fn of_one(&self, speed: f64, temperatures: &[f64]) -> [f64; 2] {
        let moment = self.law_at(temperatures);
        let radial = self.radial_load(speed, temperatures);
        let parts = moment.parts(speed, radial);
        let closing = match (&self.load, self.closing(speed, temperatures)) {
            (
                BearingLoad::Closing {
                    coefficient,
                    radial,
                    balls,
                    ..
                },
                Some((_, preload)),
            ) => {
                let loads = radial + balls * preload;
                0.5 * coefficient
                    * self.moment.pitch_diameter
                    * loads
                    * (speed / FADING_SPEED).tanh()
            }
            (BearingLoad::Moment(moment), _) => moment * (speed / FADING_SPEED).tanh(),
            _ => 0.0,
        };
        [parts.speed_dependent, parts.load_dependent + closing]
    }
}

impl Losses for WarmBearings {
    fn planes(&self, _node: usize) -> f64 {
        self.count
    }
    fn count(&self) -> usize {
        3
    }
    fn moments(&self, speed: f64, temperatures: &[f64], moments: &mut [f64]) {
        let [first, second] = self.on_rotor(speed, temperatures);
        moments[0] = first;
        moments[1] = second;
        moments[2] = self.windage * speed * speed.abs();
    }
    fn share(&self, loss: usize, node: usize) -> f64 {
        self.shares.get(loss).map_or(0.0, |shares| shares[node])
    }
}
