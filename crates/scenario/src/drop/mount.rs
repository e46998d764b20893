//! What a mount has besides spring and damper, as values. What belongs together is checked to be there.

use crate::section::Section;

/// Parts beside spring and damper; absent where they are not given.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MountParts {
    /// Stiffness of each Maxwell branch, N/m.
    pub branch_stiffness: Vec<f64>,
    /// Relaxation time of each, s.
    pub branch_time: Vec<f64>,
    /// Stiffness of a friction ring, N/m.
    pub ring_stiffness: Option<f64>,
    /// Travel at which it slips, m.
    pub ring_travel: Option<f64>,
    /// How sharply it begins to.
    pub ring_exponent: Option<f64>,
    /// Viscosity of a squeeze film, Pa s.
    pub film_viscosity: Option<f64>,
    /// Its radius, m.
    pub film_radius: Option<f64>,
    /// Its length, m.
    pub film_length: Option<f64>,
    /// Its radial clearance, m.
    pub film_clearance: Option<f64>,
    /// Whether the half that opens pulls.
    pub film_flooded: bool,
    /// Gap of a hard stop, m.
    pub stop_gap: Option<f64>,
    /// Its stiffness, N/m.
    pub stop_stiffness: Option<f64>,
    /// Its damping, s/m.
    pub stop_damping: Option<f64>,
    /// Mass of a housing, kg.
    pub housing_mass: Option<f64>,
    /// Stiffness to ground, N/m.
    pub housing_stiffness: Option<f64>,
    /// Damping to ground, N s/m.
    pub housing_damping: Option<f64>,
}

impl MountParts {
    pub(super) fn of(mount: &Section<'_>) -> Self {
        let numbers = |name: &str| mount.values.numbers(&format!("mount.{name}"));
        MountParts {
            branch_stiffness: numbers("branch_stiffness"),
            branch_time: numbers("branch_time"),
            ring_stiffness: mount.maybe("ring_stiffness"),
            ring_travel: mount.maybe("ring_travel"),
            ring_exponent: mount.maybe("ring_exponent"),
            film_viscosity: mount.maybe("film_viscosity"),
            film_radius: mount.maybe("film_radius"),
            film_length: mount.maybe("film_length"),
            film_clearance: mount.maybe("film_clearance"),
            film_flooded: mount.switch("film_flooded"),
            stop_gap: mount.maybe("stop_gap"),
            stop_stiffness: mount.maybe("stop_stiffness"),
            stop_damping: mount.maybe("stop_damping"),
            housing_mass: mount.maybe("housing_mass"),
            housing_stiffness: mount.maybe("housing_stiffness"),
            housing_damping: mount.maybe("housing_damping"),
        }
    }
}
