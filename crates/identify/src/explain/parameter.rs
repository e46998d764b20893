//! What each explanation leaves open: names, units and ranges of its parameters, and what a rest undoes.

use super::hypothesis::{Bearing, Hypothesis};
use super::prior::{Priors, Range};

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
        let mut parameters = self.own_parameters(&bearing.priors);
        if bearing.repeated && self.recovers() {
            parameters.push(Parameter {
                name: "time of the recovery at rest",
                unit: "s",
                kind: Kind::Positive,
                range: bearing.priors.recovery_time,
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

    fn own_parameters(self, priors: &Priors) -> Vec<Parameter> {
        let positive = |name, unit, range| Parameter {
            name,
            unit,
            kind: Kind::Positive,
            range,
        };
        let share = Parameter {
            name: "viscous share of the steady moment",
            unit: "1",
            kind: Kind::Share,
            range: priors.share_range(),
        };
        let orbit_share = Parameter {
            name: "share of the viscous part on the orbit",
            unit: "1",
            kind: Kind::Share,
            range: priors.orbit_share,
        };
        let slip_speed = positive("slip speed of traction", "m/s", priors.slip_speed);
        match self {
            Self::Rolling => Vec::new(),
            Self::Grease => vec![
                share,
                positive("drag factor of fresh grease", "1", priors.fresh_drag),
                positive("drag factor after breakdown", "1", priors.worked_drag),
                positive("cage angle of the build-up", "rad", priors.build_up_angle),
                positive("time of the breakdown", "s", priors.breakdown_time),
            ],
            Self::Slip => vec![
                share,
                positive("traction limit over M", "1", priors.traction_limit),
                slip_speed,
                orbit_share,
            ],
            Self::HeatedSlip => vec![
                share,
                positive(
                    "cold traction limit over M",
                    "1",
                    priors.cold_traction_limit,
                ),
                slip_speed,
                orbit_share,
                positive("softening of traction", "1", priors.traction_softening),
                positive("softening of drag", "1", priors.drag_softening),
                positive("time of the film's heating", "s", priors.film_time),
            ],
            Self::Drift { .. } => vec![
                positive("drift of the zero over M", "1", priors.drift),
                positive("time of the drift", "s", priors.sensor_time),
            ],
            Self::Creep { .. } => vec![
                positive("creep of the reading", "1", priors.creep),
                positive("time of the creep", "s", priors.sensor_time),
            ],
            Self::SlowSensor => vec![positive(
                "excess settling time of the sensor",
                "s",
                priors.settling_time,
            )],
            Self::WarmOil => vec![
                share,
                positive("softening of drag", "1", priors.oil_softening),
                positive("time of the oil's heating", "s", priors.oil_time),
            ],
            Self::AnotherMoment => vec![
                positive(
                    "steady moment over that of the slow tests",
                    "1",
                    priors.moment_ratio,
                ),
                positive(
                    "the same at half the speed over that at full speed",
                    "1",
                    priors.ratio_at_half_speed,
                ),
            ],
        }
    }
}
