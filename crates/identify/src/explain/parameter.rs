//! What each explanation leaves open: names, units and ranges of its parameters, and what a rest undoes.

use super::hypothesis::{Bearing, Hypothesis};
use super::prior::{RECOVERY_TIME, Range};

/// Name, unit and range of a parameter.
pub(crate) struct Parameter {
    pub name: &'static str,
    pub unit: &'static str,
    kind: Kind,
    range: Range,
}

enum Kind {
    Positive,
    Share,
}

impl Parameter {
    pub fn value(&self, z: f64) -> f64 {
        match self.kind {
            Kind::Positive => self.range.positive(z),
            Kind::Share => self.range.share(z),
        }
    }
}

impl Hypothesis {
    /// Parameters in the order of the coordinates; the recovery at rest is the last one, where a test shows it.
    pub fn parameters(self, bearing: &Bearing) -> Vec<Parameter> {
        let mut parameters = self.own_parameters(bearing.share);
        if bearing.repeated && self.recovers() {
            parameters.push(Parameter {
                name: "time of the recovery at rest",
                unit: "s",
                kind: Kind::Positive,
                range: RECOVERY_TIME,
            });
        }
        parameters
    }

    /// Values of the parameters at standard normal coordinates.
    pub fn values(self, coordinates: &[f64], bearing: &Bearing) -> Vec<f64> {
        (self.parameters(bearing).iter())
            .zip(coordinates)
            .map(|(parameter, z)| parameter.value(*z))
            .collect()
    }

    /// Time of the recovery at rest, s, where it is a parameter.
    pub fn recovery(self, values: &[f64], bearing: &Bearing) -> Option<f64> {
        (bearing.repeated && self.recovers()).then(|| values[values.len() - 1])
    }

    /// Whether a rest undoes what it does.
    fn recovers(self) -> bool {
        matches!(self, Self::Grease | Self::Drift { .. } | Self::Creep { .. })
    }

    /// What is left of the test before after a rest.
    ///
    /// Formula: e^(-rest/τ), τ of the recovery for grease and sensor, of the film for its rise
    ///
    /// - `rest`: s
    /// - `values`: parameters, the recovery last where it is one
    pub fn left(self, rest: f64, recovery: f64, values: &[f64]) -> (f64, f64) {
        let film = match self {
            Self::HeatedSlip => (-rest / values[6]).exp(),
            Self::WarmOil => (-rest / values[2]).exp(),
            _ => 0.0,
        };
        ((-rest / recovery).exp(), film)
    }

    /// Ranges hold 90 % of what is thought possible; they are assumed. `share`: viscous share of the steady moment at the highest speed.
    fn own_parameters(self, share: Range) -> Vec<Parameter> {
        let positive = |name, unit, low, high| Parameter {
            name,
            unit,
            kind: Kind::Positive,
            range: Range::new(low, high),
        };
        let of_one = |name, range| Parameter {
            name,
            unit: "1",
            kind: Kind::Share,
            range,
        };
        let share = of_one("viscous share of the steady moment", share);
        // the rest of the viscous part brakes the spin of the balls
        let orbit_share = of_one(
            "share of the viscous part on the orbit",
            Range::new(0.3, 0.7),
        );
        // at which traction reaches 76 % of its limit
        let slip_speed = positive("slip speed of traction", "m/s", 0.01, 0.3);
        let turn = std::f64::consts::TAU;
        match self {
            Self::Rolling => Vec::new(),
            Self::Grease => vec![
                share,
                positive("drag factor of fresh grease", "1", 0.2, 0.95),
                positive("drag factor after breakdown", "1", 0.5, 0.95),
                positive("cage angle of the build-up", "rad", 0.1 * turn, 3.0 * turn),
                positive("time of the breakdown", "s", 0.8, 4.0),
            ],
            Self::Slip => vec![
                share,
                // R μ_max ΣQ over M at the highest speed
                positive("traction limit over M", "1", 0.4, 1.2),
                slip_speed,
                orbit_share,
            ],
            Self::HeatedSlip => vec![
                share,
                positive("cold traction limit over M", "1", 0.7, 2.0),
                slip_speed,
                orbit_share,
                // logarithms of the loss when the film is in balance with the power M Ω
                positive("softening of traction", "1", 0.15, 1.5),
                positive("softening of drag", "1", 0.02, 0.3),
                positive("time of the film's heating", "s", 0.5, 5.0),
            ],
            Self::Drift { .. } => vec![
                // at the highest speed
                positive("drift of the zero over M", "1", 0.08, 0.6),
                positive("time of the drift", "s", 0.3, 5.0),
            ],
            Self::Creep { .. } => vec![
                positive("creep of the reading", "1", 0.08, 0.5),
                positive("time of the creep", "s", 0.3, 5.0),
            ],
            Self::SlowSensor => {
                vec![positive(
                    "excess settling time of the sensor",
                    "s",
                    0.05,
                    1.0,
                )]
            }
            Self::WarmOil => vec![
                share,
                positive("softening of drag", "1", 0.1, 0.8),
                positive("time of the oil's heating", "s", 0.5, 5.0),
            ],
            Self::AnotherMoment => vec![
                positive("steady moment over that of the slow tests", "1", 0.5, 2.0),
                positive(
                    "the same at half the speed over that at full speed",
                    "1",
                    0.8,
                    1.25,
                ),
            ],
        }
    }
}
