//! A rotor that runs out on its auxiliary bearings while they warm, as typed values in SI.

pub mod checks;
pub mod keys;

use crate::heat::Warm;
use crate::values::Values;

/// A coast-down. All values are SI, temperatures in K.
#[derive(Clone, Debug, PartialEq)]
pub struct CoastDown {
    /// The bearings, which are alike.
    pub bearing: Warm,
    /// Bore of the shaft or sleeve that the inner ring may grow with, m.
    pub shaft_bore_diameter: f64,
    /// Mass of the rotor, kg.
    pub rotor_mass: f64,
    /// Moment of inertia of the rotor about its axis, kg m².
    pub polar_inertia: f64,
    /// Speed at the start, rad/s.
    pub speed: f64,
    /// Number of bearings that share the rotor.
    pub planes: u32,
    /// Drag of the gas over the square of the speed, N m s².
    pub windage: f64,
    /// How it ends.
    pub end: CoastDownEnd,
}

/// How long a rotor runs out.
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
    pub(crate) fn from_values(values: &Values) -> CoastDown {
        let rotor = values.section("rotor");
        CoastDown {
            bearing: Warm::from_values(values, values.section("coast_down").number("radial_load")),
            shaft_bore_diameter: values.section("bearing.fits").number("shaft_bore_diameter"),
            rotor_mass: rotor.number("mass"),
            polar_inertia: rotor.number("polar_inertia"),
            speed: rotor.number("speed"),
            planes: rotor.count("planes") as u32,
            windage: rotor.number("windage"),
            end: CoastDownEnd::from_values(values),
        }
    }
}
