//! An auxiliary bearing that warms: what its network is built from, as typed values in SI.

pub mod checks;
pub mod derive;
pub mod keys;

use crate::bearing::ball_material;
use crate::bearing::fits::Growth;
use crate::bearing::kind::{BallMaterial, BearingType};
use crate::bearing::moment::{Moment, RatedBearing};
use crate::bearing::spatial::Arrangement;
use crate::section::Section;
use crate::values::Values;
use physics::air::SEA_LEVEL;
use physics::heat_conduction::{STEEL_HEAT, ThermalMaterial};
use physics::ring::PressFit;
pub use physics::viscosity::ICE_POINT;
use physics::viscosity::Viscosity;
use problem::words;

words! {
    /// Whether temperatures are followed.
    pub enum Network {
        /// They are not.
        Off = "off",
        /// They are.
        On = "on",
    }
}

words! {
    /// What surrounds a bearing.
    pub enum Atmosphere {
        /// Air, which takes heat away.
        Air = "air",
        /// Vacuum, in which only what is given does.
        Vacuum = "vacuum",
    }
}

words! {
    /// What follows the temperatures.
    pub enum Feedback {
        /// Viscosity of the lubricant and clearance of the bearing.
        Full = "viscosity and clearance",
        /// Viscosity alone.
        Viscosity = "viscosity",
        /// Nothing.
        None = "none",
    }
}

words! {
    /// Bodies of one temperature that the rotor is.
    pub enum RotorBodies {
        /// One.
        One = "one",
        /// Its surface layer, and what is deeper.
        LayerAndCore = "layer and core",
    }
}

words! {
    /// Material of a cage.
    pub enum CageMaterial {
        /// Pressed steel.
        Steel = "steel",
        /// Brass.
        Brass = "brass",
        /// Polyamide.
        Polyamide = "PA66",
        /// Polyether ether ketone.
        Peek = "PEEK",
    }
}

impl CageMaterial {
    /// What it is as a body that conducts. Source: derived; book/src/theory/heat.md.
    pub fn heat(self) -> ThermalMaterial {
        let material = |conductivity, density, specific_heat| ThermalMaterial {
            conductivity,
            density,
            specific_heat,
        };
        match self {
            CageMaterial::Steel => STEEL_HEAT,
            CageMaterial::Brass => material(110.0, 8500.0, 380.0),
            CageMaterial::Polyamide => material(0.25, 1140.0, 1700.0),
            CageMaterial::Peek => material(0.25, 1300.0, 1340.0),
        }
    }
}

/// A bearing that warms. All values are SI, temperatures in K.
#[derive(Clone, Debug, PartialEq)]
pub struct Warm {
    /// Name in the catalogue.
    pub name: Option<String>,
    /// Type.
    pub kind: BearingType,
    /// Number of balls of a row.
    pub ball_count: usize,
    /// Rows of balls on its rings.
    pub rows: usize,
    /// Diameter of a ball, m.
    pub ball_diameter: f64,
    /// Diameter of the circle through the ball centres, m.
    pub pitch_diameter: f64,
    /// Material of the balls.
    pub ball_material: BallMaterial,
    /// Contact angle, rad; 0 of radial contacts.
    pub contact_angle: f64,
    /// Axial preload that holds it, N.
    pub axial_preload: f64,
    /// Diametral internal clearance as mounted, at the start temperature, m; negative is preload.
    pub operating_diametral_clearance: f64,
    /// Groove radius of the inner race over ball diameter.
    pub inner_groove_curvature: f64,
    /// Groove radius of the outer race over ball diameter.
    pub outer_groove_curvature: f64,
    /// Static load rating, N.
    pub static_load_rating: Option<f64>,
    /// Dynamic load rating, N.
    pub dynamic_load_rating: Option<f64>,
    /// Limiting speed in continuous running, rad/s.
    pub limiting_speed: Option<f64>,
    /// Mass of the inner race of a row with its sleeve, kg.
    pub inner_race_mass: f64,
    /// Mass of the cage of a row, kg; 0 where there is none.
    pub cage_mass: f64,
    /// Mass of one ball, kg; derived from diameter and material where it is `None`.
    pub ball_mass: Option<f64>,
    /// Steady friction moment.
    pub moment: Moment,
    /// Factor on it.
    pub moment_scale: f64,
    /// Viscosity of the lubricant at two temperatures, K and m²/s.
    pub viscosity_points: Vec<[f64; 2]>,
    /// Radial load on it, N.
    pub radial_load: f64,
    /// Growth of the diameter of its inner track with the square of its speed, m s².
    pub growth: f64,
    /// Fits of its rings on shaft and in housing, where they are known.
    pub fits: [Option<PressFit>; 2],
    /// Whether its inner ring sits on the rotor itself; else on a sleeve that is one body with the ring.
    pub on_rotor: bool,
    /// What warms.
    pub heat: Heat,
}

/// What warms, and where the heat goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Heat {
    /// Of the surroundings, K.
    pub ambient_temperature: f64,
    /// Of everything at the start, K.
    pub start_temperature: f64,
    /// What surrounds the bearing.
    pub atmosphere: Atmosphere,
    /// What follows the temperatures.
    pub feedback: Feedback,
    /// Bore of the bearing, m.
    pub bore_diameter: f64,
    /// Outer diameter of the bearing, m.
    pub outer_diameter: f64,
    /// Width of the bearing, m.
    pub width: f64,
    /// Material of the cage; steel where there is none.
    pub cage_material: CageMaterial,
    /// Mass of the lubricant, kg.
    pub lubricant_mass: f64,
    /// Film between balls and races, m.
    pub film_thickness: f64,
    /// Of the rotor's part, J/K.
    pub rotor_capacity: Option<f64>,
    /// Of the housing, J/K.
    pub housing_capacity: f64,
    /// Rotor to inner race, W/K, where it is given.
    pub rotor_contact: Option<f64>,
    /// Radial clearance of the rotor in the race, m, where no conductance is given.
    pub radial_air_clearance: Option<f64>,
    /// Outer race to housing, W/K; none where it follows the fit.
    pub outer_seat: Option<f64>,
    /// Housing to its surroundings, W/K; none where gas and radiation take the heat, or nothing does.
    pub surroundings: Option<f64>,
    /// Rotor to its surroundings, W/K, where it is given.
    pub rotor_surroundings: Option<f64>,
    /// Pressure of the air, Pa, where gas is computed.
    pub gas_pressure: Option<f64>,
    /// Emissivity of rotor and inner race; 0 where they do not radiate.
    pub emissivity: f64,
    /// Emissivity of the housing; 0 where it does not radiate.
    pub housing_emissivity: f64,
    /// Surface of the housing of one bearing, m².
    pub housing_area: f64,
    /// Diameter of the rotor as a cylinder, m, where it is known.
    pub rotor_diameter: Option<f64>,
    /// Its surface for one bearing, m², where it is known.
    pub rotor_area: Option<f64>,
    /// Expansion of shaft or sleeve, 1/K.
    pub shaft_expansion: f64,
    /// Expansion of the housing, 1/K.
    pub housing_expansion: f64,
    /// Bodies that the rotor is.
    pub rotor_bodies: RotorBodies,
    /// Of the mount, J/K, where it is a body of its own.
    pub mount_capacity: Option<f64>,
    /// Housing to mount, W/K.
    pub mount_contact: f64,
    /// Mount to its surroundings, W/K.
    pub mount_surroundings: f64,
    /// Contamination factor e_C.
    pub contamination: f64,
    /// Limit of the races, K.
    pub race_limit: f64,
    /// Limit of the cage, K.
    pub cage_limit: f64,
    /// Limit of the lubricant, K.
    pub lubricant_limit: f64,
}

impl Warm {
    /// Of the values of a bearing under a radial load, N.
    pub fn from_values(values: &Values, radial_load: f64) -> Warm {
        let bearing = values.section("bearing");
        let heat = Heat::from_values(&values.section("heat"));
        Warm {
            name: values.text("bearing.name"),
            kind: bearing.choice("type"),
            ball_count: bearing.count("ball_count") as usize,
            rows: (bearing.chosen("arrangement")).map_or(1, |own: Arrangement| own.rows()),
            ball_diameter: bearing.number("ball_diameter"),
            pitch_diameter: bearing.number("pitch_diameter"),
            ball_material: ball_material(&bearing),
            contact_angle: bearing.maybe("contact_angle").unwrap_or(0.0),
            axial_preload: bearing.maybe("axial_preload").unwrap_or(0.0),
            operating_diametral_clearance: bearing.number("operating_diametral_clearance"),
            inner_groove_curvature: bearing.number("inner_groove_curvature"),
            outer_groove_curvature: bearing.number("outer_groove_curvature"),
            static_load_rating: bearing.maybe("static_load_rating"),
            dynamic_load_rating: bearing.maybe("dynamic_load_rating"),
            limiting_speed: bearing.maybe("limiting_speed"),
            inner_race_mass: (bearing.maybe("inner_race_mass"))
                .unwrap_or_else(|| heat.ring_of(bearing.number("inner_race_inertia"), &bearing)),
            cage_mass: bearing.maybe("cage_mass").unwrap_or(0.0),
            ball_mass: bearing.maybe("ball_mass"),
            moment: Moment::from_values(values),
            moment_scale: bearing.maybe("moment.scale").unwrap_or(1.0),
            viscosity_points: values
                .rows("bearing.moment.viscosity_points")
                .unwrap_or_default(),
            radial_load,
            growth: 2.0 * growth(values, &heat),
            fits: values.known_fits(),
            on_rotor: false,
            heat,
        }
    }

    /// The same whose inner ring may sit on the rotor itself: where that does not slide in it.
    pub fn on_rotor(mut self, sits: bool) -> Warm {
        self.on_rotor = sits;
        self
    }

    /// Viscosity of its lubricant, where two temperatures are given.
    pub fn viscosity(&self) -> Option<Viscosity> {
        match self.viscosity_points.as_slice() {
            [one, other] => Viscosity::through((one[0], one[1]), (other[0], other[1])).ok(),
            _ => None,
        }
    }

    /// What a friction law needs to know of the bearing.
    pub fn rated(&self) -> RatedBearing {
        RatedBearing {
            kind: self.kind,
            pitch_diameter: self.pitch_diameter,
            static_load_rating: self.static_load_rating,
            ball_material: self.ball_material,
            in_space: false,
        }
    }
}

/// Growth of the radius of the inner track with the square of its speed, m s².
fn growth(values: &Values, heat: &Heat) -> f64 {
    let (bearing, fits) = (values.section("bearing"), values.section("bearing.fits"));
    let track = bearing.number("pitch_diameter") - bearing.number("ball_diameter");
    let ring_bore = fits.maybe("bore_diameter").unwrap_or(heat.bore_diameter);
    let chosen: Growth = bearing.chosen("inner_race_growth").unwrap_or(Growth::None);
    let shaft_bore = fits.maybe("shaft_bore_diameter").unwrap_or(0.0);
    chosen.of_track(track, ring_bore, shaft_bore)
}

/// Expansion of bearing steel, 1/K. Source: derived; book/src/theory/heat.md.
pub const STEEL_EXPANSION: f64 = 11.5e-6;

/// Diameter of a housing over the outer diameter of its bearing, where nothing else is known. Source: assumed.
pub const HOUSING_SIZE: f64 = 2.0;

/// Depth of a shoulder below the pitch circle, over the diameter of a ball.
pub const SHOULDER: f64 = 0.3;

impl Heat {
    /// Whether gas or radiation takes heat from a surface of such an emissivity.
    pub fn is_open(&self, emissivity: f64) -> bool {
        self.gas_pressure.is_some() || emissivity > 0.0
    }

    /// Pressure of the gas, Pa: of the atmosphere where none is given.
    pub fn pressure(&self) -> f64 {
        let air = match self.atmosphere {
            Atmosphere::Air => SEA_LEVEL,
            Atmosphere::Vacuum => 0.0,
        };
        self.gas_pressure.unwrap_or(air)
    }

    /// Mass of an inner ring of this inertia between bore and shoulder, kg.
    fn ring_of(&self, inertia: f64, bearing: &Section<'_>) -> f64 {
        let depth = 2.0 * SHOULDER * bearing.number("ball_diameter");
        let shoulder = bearing.number("pitch_diameter") - depth;
        // I = m (r₁² + r₂²)/2
        8.0 * inertia / (self.bore_diameter.powi(2) + shoulder.powi(2))
    }

    fn from_values(heat: &Section<'_>) -> Heat {
        Heat {
            ambient_temperature: heat.number("ambient_temperature"),
            start_temperature: heat.number("start_temperature"),
            atmosphere: heat.choice("atmosphere"),
            feedback: heat.choice("feedback"),
            bore_diameter: heat.number("bore_diameter"),
            outer_diameter: heat.number("outer_diameter"),
            width: heat.number("width"),
            cage_material: heat.chosen("cage_material").unwrap_or(CageMaterial::Steel),
            lubricant_mass: heat.number("lubricant_mass"),
            film_thickness: heat.number("film_thickness"),
            rotor_capacity: heat.maybe("rotor_capacity"),
            housing_capacity: heat.number("housing_capacity"),
            rotor_contact: heat.maybe("rotor_contact"),
            radial_air_clearance: heat.maybe("radial_air_clearance"),
            outer_seat: heat.maybe("outer_seat"),
            surroundings: heat.maybe("surroundings"),
            rotor_surroundings: heat.maybe("rotor_surroundings"),
            gas_pressure: heat.maybe("gas_pressure"),
            emissivity: heat.number("emissivity"),
            housing_emissivity: heat.number("housing_emissivity"),
            housing_area: heat.number("housing_area"),
            rotor_diameter: heat.maybe("rotor_diameter"),
            rotor_area: heat.maybe("rotor_area"),
            shaft_expansion: heat.maybe("shaft_expansion").unwrap_or(STEEL_EXPANSION),
            housing_expansion: heat.maybe("housing_expansion").unwrap_or(STEEL_EXPANSION),
            rotor_bodies: heat.chosen("rotor_bodies").unwrap_or(RotorBodies::One),
            mount_capacity: heat.maybe("mount_capacity"),
            mount_contact: heat.maybe("mount_contact").unwrap_or(0.0),
            mount_surroundings: heat.maybe("mount_surroundings").unwrap_or(0.0),
            contamination: heat.number("contamination"),
            race_limit: heat.number("race_limit"),
            cage_limit: heat.number("cage_limit"),
            lubricant_limit: heat.number("lubricant_limit"),
        }
    }
}
