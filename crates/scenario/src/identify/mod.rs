//! What measured tests are to tell of a bearing, as typed values in SI.

pub mod checks;
pub mod keys;

use crate::bearing::kind::BallMaterial;
use crate::bearing::{ball_material, cage_ring_mass};
use crate::values::Values;
use problem::words;
use std::path::PathBuf;

words! {
    /// Whether balls roll in the slow tests, as a word.
    pub enum Rolling {
        /// As the cage shows it.
        ShownByTheCage = "shown by the cage",
        /// As the user states it.
        Stated = "stated",
    }
}

/// Tests of one bearing and what is asked of them. All values are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Identify {
    /// Name of the bearing in the catalogue.
    pub bearing: Option<String>,
    /// Number of balls.
    pub ball_count: usize,
    /// Diameter of a ball, m.
    pub ball_diameter: f64,
    /// Diameter of the circle through the ball centres, m.
    pub pitch_diameter: f64,
    /// Material of the balls.
    pub ball_material: BallMaterial,
    /// Mass of one ball, kg; derived from diameter and material where it is `None`.
    pub ball_mass: Option<f64>,
    /// Mass of the cage as a ring at the pitch circle, kg; 0 where there is none.
    pub cage_mass: f64,
    /// Signals files of slow tests.
    pub coast_downs: Vec<PathBuf>,
    /// Signals files of tests with acceleration.
    pub tests: Vec<PathBuf>,
    /// Weight on the bearing in tests that give none, N.
    pub radial_load: Option<f64>,
    /// Speed at which tests are compared, rad/s.
    pub analysed_speed: Option<f64>,
    /// Whether the balls are stated to roll.
    pub rolling_stated: bool,
    /// Kinematic viscosity, m²/s.
    pub viscosity: Option<f64>,
    /// Part by which the moment changes per kelvin, 1/K.
    pub moment_per_kelvin: f64,
    /// Its relative standard deviation.
    pub moment_per_kelvin_deviation: f64,
    /// Relative standard deviation of the mass of the balls.
    pub ball_mass_deviation: f64,
    /// Relative standard deviation of the mass of the cage.
    pub cage_mass_deviation: f64,
    /// Relative standard deviation of the radius of the inner track.
    pub track_radius_deviation: f64,
    /// Time within which the torque arm settles, s.
    pub settling_time: f64,
    /// How explanations are compared; none where they are not.
    pub explanations: Option<Explanations>,
    /// Sliding friction of a dropped rotor.
    pub rotor_friction: Option<RotorFriction>,
}

/// How explanations are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Explanations {
    /// Probability from which on one is taken.
    pub decide_at: f64,
    /// Time around the largest acceleration within which a jump of the torque is smeared, s.
    pub locking_window: f64,
    /// Relative standard deviation of the cage's rolling speed over the shaft's speed.
    pub rolling_ratio_deviation: f64,
    /// Seed of the sampled parameters.
    pub seed: u64,
}

/// A dropped rotor that brings an inner race up.
#[derive(Clone, Debug, PartialEq)]
pub struct RotorFriction {
    /// Signals file with the speed of the race.
    pub file: PathBuf,
    /// Spin of the rotor, rad/s.
    pub rotor_speed: f64,
    /// Force of the rotor on the race, N.
    pub radial_load: f64,
    /// Its relative standard deviation.
    pub load_deviation: f64,
    /// Time from which on the rotor lies on the race, s.
    pub from: Option<f64>,
    /// Time until which it does, s.
    pub to: Option<f64>,
    /// Least slip that counts as sliding, m/s.
    pub least_slip: f64,
    /// Diameter at which the rotor slides, m.
    pub bore_diameter: f64,
    /// Radial air clearance, m: by so much the rotor's radius is less.
    pub radial_air_clearance: Option<f64>,
    /// Inertia of the inner race with its sleeve, kg m².
    pub inertia: f64,
    /// Its relative standard deviation.
    pub inertia_deviation: f64,
}

impl Identify {
    pub(crate) fn from_values(values: &Values) -> Identify {
        let (bearing, identify) = (values.section("bearing"), values.section("identify"));
        let (explanations, rotor) = (
            values.section("identify.explanations"),
            values.section("identify.rotor_friction"),
        );
        let files = |path| values.texts(path).iter().map(PathBuf::from).collect();
        Identify {
            bearing: values.text("bearing.name"),
            ball_count: bearing.count("ball_count") as usize,
            ball_diameter: bearing.number("ball_diameter"),
            pitch_diameter: bearing.number("pitch_diameter"),
            ball_material: ball_material(&bearing),
            ball_mass: bearing.maybe("ball_mass"),
            cage_mass: cage_ring_mass(&bearing),
            coast_downs: files("identify.coast_down"),
            tests: files("identify.tests"),
            radial_load: identify.maybe("radial_load"),
            analysed_speed: identify.maybe("analysed_speed"),
            rolling_stated: identify.choice::<Rolling>("rolling") == Rolling::Stated,
            viscosity: identify.maybe("viscosity"),
            moment_per_kelvin: identify.number("moment_per_kelvin"),
            moment_per_kelvin_deviation: identify.number("moment_per_kelvin_deviation"),
            ball_mass_deviation: identify.number("ball_mass_deviation"),
            cage_mass_deviation: identify.number("cage_mass_deviation"),
            track_radius_deviation: identify.number("track_radius_deviation"),
            settling_time: identify.number("settling_time"),
            explanations: explanations.switch("compare").then(|| Explanations {
                decide_at: explanations.number("decide_at"),
                locking_window: explanations.number("locking_window"),
                rolling_ratio_deviation: explanations.number("rolling_ratio_deviation"),
                seed: explanations.count("seed"),
            }),
            rotor_friction: values
                .text("identify.rotor_friction.file")
                .map(|file| RotorFriction {
                    file: file.into(),
                    rotor_speed: rotor.number("rotor_speed"),
                    radial_load: rotor.number("radial_load"),
                    load_deviation: rotor.number("load_deviation"),
                    from: rotor.maybe("from"),
                    to: rotor.maybe("to"),
                    least_slip: rotor.number("least_slip"),
                    bore_diameter: rotor.number("bore_diameter"),
                    radial_air_clearance: rotor.maybe("radial_air_clearance"),
                    inertia: rotor.number("inertia"),
                    inertia_deviation: rotor.number("inertia_deviation"),
                }),
        }
    }
}
