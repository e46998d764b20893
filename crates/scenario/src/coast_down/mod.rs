//! A rotor that coasts down on its auxiliary bearings while they warm, as typed values in SI.

pub mod checks;
pub mod keys;

use crate::heat::Warm;
use crate::several::PLANES;
use crate::values::Values;

/// A coast-down. All values are SI, temperatures in K.
#[derive(Clone, Debug, PartialEq)]
pub struct CoastDown {
    /// Its auxiliary bearings: one, or several with names.
    pub bearings: Vec<CoastingBearing>,
    /// Mass of the rotor, kg.
    pub rotor_mass: f64,
    /// Moment of inertia of the rotor about its axis, kg m².
    pub polar_inertia: f64,
    /// Speed at the start, rad/s.
    pub speed: f64,
    /// Drag of the gas over the square of the speed, N m s².
    pub windage: f64,
    /// How it ends.
    pub end: CoastDownEnd,
}

/// A bearing that a rotor coasts down on.
#[derive(Clone, Debug, PartialEq)]
pub struct CoastingBearing {
    /// Its name among several; empty where it is the only one.
    pub name: String,
    /// Number of equal rows that it stands for.
    pub planes: f64,
    /// What warms.
    pub warm: Warm,
    /// Bore of the shaft or sleeve that the inner ring may grow with, m.
    pub shaft_bore_diameter: f64,
}

/// How long a rotor coasts down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoastDownEnd {
    /// Speed at which it ends, rad/s.
    pub stop_speed: f64,
    /// Time at which it ends at the latest, s.
    pub longest: f64,
    /// Error of a step.
    pub tolerance: f64,
}

impl CoastDownEnd {
    pub(crate) fn from_values(values: &Values) -> CoastDownEnd {
        let coast = values.section("coast_down");
        CoastDownEnd {
            stop_speed: coast.number("stop_speed"),
            longest: coast.number("longest"),
            tolerance: coast.number("tolerance"),
        }
    }
}

impl CoastDown {
    /// With the values of each auxiliary bearing.
    pub(crate) fn of(all: &[Values]) -> CoastDown {
        let values = &all[0];
        let rotor = values.section("rotor");
        let bearing = |own: &Values| CoastingBearing {
            name: own.bearing.clone().unwrap_or_default(),
            planes: own.planes(),
            // its rows share the load
            warm: Warm::from_values(
                own,
                own.section("coast_down").number("radial_load") / own.number(PLANES).unwrap_or(1.0),
            ),
            shaft_bore_diameter: own.section("bearing.fits").number("shaft_bore_diameter"),
        };
        CoastDown {
            bearings: all.iter().map(bearing).collect(),
            rotor_mass: rotor.number("mass"),
            polar_inertia: rotor.number("polar_inertia"),
            speed: rotor.number("speed"),
            windage: rotor.number("windage"),
            end: CoastDownEnd::from_values(values),
        }
    }
}
