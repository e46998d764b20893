//! A drop as typed values in SI: what a simulation is built from.

use super::resolve::Values;

/// A levitated rotor that is released onto its auxiliary bearing. All values are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Drop {
    /// The rigid rotor.
    pub rotor: Rotor,
    /// Weight.
    pub gravity: Gravity,
    /// The magnetic bearing before the release.
    pub levitation: Levitation,
    /// Contact of rotor and inner race.
    pub contact: Contact,
    /// Spring and damper between outer race and ground.
    pub mount: Mount,
    /// The auxiliary bearing.
    pub bearing: Bearing,
    /// The simulation.
    pub run: Run,
    /// Repeated runs.
    pub repeat: Repeat,
}

/// The rigid rotor as a whole, shared by all planes.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotor {
    /// Mass of the whole rotor, kg.
    pub mass: f64,
    /// Moment of inertia of the whole rotor about its axis, kg m².
    pub polar_inertia: f64,
    /// Distance of the centre of mass from the geometric centre, m.
    pub unbalance_eccentricity: f64,
    /// Direction of the unbalance at the release, rad from x.
    pub unbalance_angle: f64,
    /// Spin at the release, rad/s, counter-clockwise positive.
    pub speed: f64,
    /// What happens to the spin after the release.
    pub spin: Spin,
    /// Number of identical auxiliary bearings that share the rotor.
    pub planes: u32,
    /// First free-free bending natural frequency, rad/s.
    pub first_bending_frequency: Option<f64>,
}

/// What happens to the spin of the rotor after the release.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spin {
    /// Neither drive nor brake.
    Free,
    /// A torque of this size against the spin until the rotor stands.
    Braked {
        /// Size of the torque on the whole rotor, N m.
        torque: f64,
        /// Start of braking after the release, s.
        start: f64,
    },
    /// Held at the speed of the release.
    Held,
}

/// Weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Gravity {
    /// Acceleration, m/s².
    pub acceleration: f64,
    /// Direction, rad from x.
    pub direction: f64,
}

/// The magnetic bearing at one plane while it is on.
#[derive(Clone, Debug, PartialEq)]
pub struct Levitation {
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N s/m.
    pub damping: f64,
    /// Centre of levitation along x, m.
    pub offset_x: f64,
    /// Centre of levitation along y, m.
    pub offset_y: f64,
}

/// Contact of rotor and inner race: F = k dⁿ(1 + a ḋ).
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Radial air gap when concentric, m.
    pub radial_air_clearance: f64,
    /// Diameter of the bore, m.
    pub bore_diameter: f64,
    /// Stiffness k, N/mⁿ.
    pub stiffness: f64,
    /// Exponent n.
    pub exponent: f64,
    /// Hunt-Crossley damping a, s/m.
    pub damping: f64,
    /// Coefficient of sliding friction.
    pub friction_coefficient: f64,
    /// Slip speed that regularises the friction, m/s.
    pub friction_reference_speed: f64,
}

/// Spring and damper between outer race and ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Mount {
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N s/m.
    pub damping: f64,
    /// Mass of the outer race with what moves with it, kg.
    pub moving_mass: f64,
}

/// How the bearing is modelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fidelity {
    /// Each ball and the cage move in the plane, with slip.
    Planar,
    /// Pure rolling.
    Rolling,
}

/// Material of the balls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BallMaterial {
    /// Bearing steel.
    Steel,
    /// Silicon nitride: a hybrid bearing.
    SiliconNitride,
}

/// The auxiliary bearing at one plane. What is `None` is derived from the other values when the run starts.
#[derive(Clone, Debug, PartialEq)]
pub struct Bearing {
    /// Name in the catalogue.
    pub name: Option<String>,
    /// How it is modelled.
    pub fidelity: Fidelity,
    /// Number of balls.
    pub ball_count: usize,
    /// Diameter of a ball, m.
    pub ball_diameter: f64,
    /// Diameter of the circle through the ball centres, m.
    pub pitch_diameter: f64,
    /// Diametral internal clearance as mounted, m; negative is preload.
    pub operating_diametral_clearance: f64,
    /// Groove radius of the inner race over ball diameter.
    pub inner_groove_curvature: f64,
    /// Groove radius of the outer race over ball diameter.
    pub outer_groove_curvature: f64,
    /// Material of the balls.
    pub ball_material: BallMaterial,
    /// Static load rating, N.
    pub static_load_rating: Option<f64>,
    /// Mass of the inner race with its sleeve, kg.
    pub inner_race_mass: f64,
    /// Moment of inertia of the inner race with its sleeve, kg m².
    pub inner_race_inertia: f64,
    /// Mass of the cage, kg.
    pub cage_mass: f64,
    /// Moment of inertia of the cage, kg m².
    pub cage_inertia: f64,
    /// Mass of one ball, kg.
    pub ball_mass: Option<f64>,
    /// Stiffness of ball and inner race, N/m^1.5.
    pub inner_contact_stiffness: Option<f64>,
    /// Stiffness of ball and outer race, N/m^1.5.
    pub outer_contact_stiffness: Option<f64>,
    /// Retardation time of the ball contacts, s.
    pub contact_damping_time: f64,
    /// Whether the centre of the inner race is held.
    pub inner_race_centre_held: bool,
    /// Torque from ground on the inner race, N m.
    pub inner_race_torque: f64,
    /// Angle of the first ball at the release, rad from x.
    pub first_ball_angle: f64,
    /// Contact pressure that the report compares with, Pa.
    pub hertz_pressure_limit: Option<f64>,
    /// Pockets of the cage.
    pub cage: Cage,
    /// Traction between balls and races.
    pub traction: Traction,
    /// Drag to ground.
    pub drag: Drag,
    /// Steady friction moment, for the rolling fidelity.
    pub moment: Moment,
}

/// Pockets of the cage.
#[derive(Clone, Debug, PartialEq)]
pub struct Cage {
    /// Whether balls and cage touch at all.
    pub pocket_contact: bool,
    /// One-sided gap along the pitch circle, m.
    pub pocket_gap: f64,
    /// Stiffness, N/m.
    pub pocket_stiffness: f64,
    /// Hunt-Crossley damping, s/m.
    pub pocket_damping: f64,
    /// Coefficient of friction.
    pub pocket_friction_coefficient: f64,
    /// Slip speed that regularises the friction, m/s.
    pub pocket_friction_reference_speed: f64,
}

/// Traction coefficient as a function of the slip speed u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Traction {
    /// maximum · tanh(u / reference speed).
    Tanh {
        /// Largest coefficient.
        maximum: f64,
        /// Reference speed, m/s.
        reference_speed: f64,
    },
    /// sgn(u)[(a + b|u|) e^(-c|u|) + d].
    FourParameter {
        /// A.
        a: f64,
        /// B, s/m.
        b: f64,
        /// C, s/m.
        c: f64,
        /// D.
        d: f64,
    },
    /// From static at small slip to kinetic at high slip.
    Dry {
        /// Coefficient at high slip.
        kinetic_coefficient: f64,
        /// Coefficient at small slip.
        static_coefficient: f64,
        /// Slip speed of the fall, m/s.
        decay_speed: f64,
        /// Slip speed that regularises the law, m/s.
        reference_speed: f64,
    },
}

/// Drag of balls and cage to ground, to reproduce reference cases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// Force on a ball over its orbital speed, N s/m.
    pub orbit: f64,
    /// Torque on a ball over its spin, N m s.
    pub spin: f64,
    /// Torque on the cage over its speed, N m s.
    pub cage: f64,
}

/// Steady friction moment of the rolling fidelity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moment {
    /// No moment.
    None,
    /// Palmgren's two terms.
    Palmgren {
        /// Form of the load-independent term.
        form: MomentForm,
        /// Factor f0.
        f0: f64,
        /// Kinematic viscosity, m²/s.
        viscosity: f64,
        /// Factor z of f1 = z (P0/C0)^y.
        f1_factor: f64,
        /// Exponent y of f1 = z (P0/C0)^y.
        f1_exponent: f64,
    },
}

/// Form of the load-independent moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MomentForm {
    /// Continuous and odd in speed.
    Continuous,
    /// As printed, with its step.
    Printed,
}

/// The simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Simulated time from the release, s.
    pub duration: f64,
    /// Relative tolerance.
    pub tolerance: f64,
    /// Time between rows of the history, s.
    pub output_interval: f64,
    /// Largest step, s.
    pub largest_step: f64,
}

/// Repeated runs from perturbed starts.
#[derive(Clone, Debug, PartialEq)]
pub struct Repeat {
    /// Number of runs.
    pub count: u32,
    /// Seed of the study.
    pub seed: u64,
    /// Standard deviation of the rotor position, m.
    pub rotor_position_deviation: f64,
    /// Standard deviation of each ball angle, rad.
    pub ball_angle_deviation: f64,
}

/// Takes typed values out of the resolved ones.
struct Section<'a> {
    values: &'a Values,
    path: &'static str,
}

impl Section<'_> {
    fn path(&self, name: &str) -> String {
        format!("{}.{name}", self.path)
    }

    fn maybe(&self, name: &str) -> Option<f64> {
        self.values.number(&self.path(name))
    }

    /// A number that the table of keys guarantees; not-a-number would show a gap in that table, which the tests exclude.
    fn number(&self, name: &str) -> f64 {
        let value = self.maybe(name);
        debug_assert!(value.is_some(), "{} has no value", self.path(name));
        value.unwrap_or(f64::NAN)
    }

    fn word(&self, name: &str) -> &'static str {
        self.values.word(&self.path(name))
    }

    fn switch(&self, name: &str) -> bool {
        self.values.switch(&self.path(name))
    }

    fn count(&self, name: &str) -> u64 {
        self.values.count(&self.path(name))
    }
}

impl Drop {
    pub(super) fn from_values(values: &Values) -> Drop {
        let section = |path| Section { values, path };
        let gravity = section("gravity");
        let levitation = section("levitation");
        let mount = section("mount");
        let run = section("run");
        let repeat = section("repeat");
        Drop {
            rotor: rotor(&section("rotor")),
            gravity: Gravity {
                acceleration: gravity.number("acceleration"),
                direction: gravity.number("direction"),
            },
            levitation: Levitation {
                stiffness: levitation.number("stiffness"),
                damping: levitation.number("damping"),
                offset_x: levitation.number("offset_x"),
                offset_y: levitation.number("offset_y"),
            },
            contact: contact(&section("contact")),
            mount: Mount {
                stiffness: mount.number("stiffness"),
                damping: mount.number("damping"),
                moving_mass: mount.number("moving_mass"),
            },
            bearing: bearing(values),
            run: Run {
                duration: run.number("duration"),
                tolerance: run.number("tolerance"),
                output_interval: run.number("output_interval"),
                largest_step: run.number("largest_step"),
            },
            repeat: Repeat {
                count: repeat.count("count") as u32,
                seed: repeat.count("seed"),
                rotor_position_deviation: repeat.number("rotor_position_deviation"),
                ball_angle_deviation: repeat.number("ball_angle_deviation"),
            },
        }
    }
}

fn rotor(rotor: &Section<'_>) -> Rotor {
    Rotor {
        mass: rotor.number("mass"),
        polar_inertia: rotor.number("polar_inertia"),
        unbalance_eccentricity: rotor.number("unbalance_eccentricity"),
        unbalance_angle: rotor.number("unbalance_angle"),
        speed: rotor.number("speed"),
        spin: match rotor.word("spin") {
            "braked" => Spin::Braked {
                torque: rotor.number("brake_torque"),
                start: rotor.number("brake_start"),
            },
            "held" => Spin::Held,
            _ => Spin::Free,
        },
        planes: rotor.count("planes") as u32,
        first_bending_frequency: rotor.maybe("first_bending_frequency"),
    }
}

fn contact(contact: &Section<'_>) -> Contact {
    Contact {
        radial_air_clearance: contact.number("radial_air_clearance"),
        bore_diameter: contact.number("bore_diameter"),
        stiffness: contact.number("stiffness"),
        exponent: contact.number("exponent"),
        damping: contact.number("damping"),
        friction_coefficient: contact.number("friction_coefficient"),
        friction_reference_speed: contact.number("friction_reference_speed"),
    }
}

fn bearing(values: &Values) -> Bearing {
    let section = |path| Section { values, path };
    let bearing = section("bearing");
    let cage = section("bearing.cage");
    let drag = section("bearing.drag");
    Bearing {
        name: values.text("bearing.name"),
        fidelity: match bearing.word("fidelity") {
            "rolling" => Fidelity::Rolling,
            _ => Fidelity::Planar,
        },
        ball_count: bearing.count("ball_count") as usize,
        ball_diameter: bearing.number("ball_diameter"),
        pitch_diameter: bearing.number("pitch_diameter"),
        operating_diametral_clearance: bearing.number("operating_diametral_clearance"),
        inner_groove_curvature: bearing.number("inner_groove_curvature"),
        outer_groove_curvature: bearing.number("outer_groove_curvature"),
        ball_material: match bearing.word("ball_material") {
            "silicon nitride" => BallMaterial::SiliconNitride,
            _ => BallMaterial::Steel,
        },
        static_load_rating: bearing.maybe("static_load_rating"),
        inner_race_mass: bearing.number("inner_race_mass"),
        inner_race_inertia: bearing.number("inner_race_inertia"),
        cage_mass: bearing.number("cage_mass"),
        cage_inertia: bearing.number("cage_inertia"),
        ball_mass: bearing.maybe("ball_mass"),
        inner_contact_stiffness: bearing.maybe("inner_contact_stiffness"),
        outer_contact_stiffness: bearing.maybe("outer_contact_stiffness"),
        contact_damping_time: bearing.number("contact_damping_time"),
        inner_race_centre_held: bearing.switch("inner_race_centre_held"),
        inner_race_torque: bearing.number("inner_race_torque"),
        first_ball_angle: bearing.number("first_ball_angle"),
        hertz_pressure_limit: bearing.maybe("hertz_pressure_limit"),
        cage: Cage {
            pocket_contact: cage.switch("pocket_contact"),
            pocket_gap: cage.number("pocket_gap"),
            pocket_stiffness: cage.number("pocket_stiffness"),
            pocket_damping: cage.number("pocket_damping"),
            pocket_friction_coefficient: cage.number("pocket_friction_coefficient"),
            pocket_friction_reference_speed: cage.number("pocket_friction_reference_speed"),
        },
        traction: traction(&section("bearing.traction")),
        drag: Drag {
            orbit: drag.number("orbit"),
            spin: drag.number("spin"),
            cage: drag.number("cage"),
        },
        moment: moment(&section("bearing.moment")),
    }
}

fn traction(traction: &Section<'_>) -> Traction {
    match traction.word("law") {
        "four parameter" => Traction::FourParameter {
            a: traction.number("a"),
            b: traction.number("b"),
            c: traction.number("c"),
            d: traction.number("d"),
        },
        "dry" => Traction::Dry {
            kinetic_coefficient: traction.number("kinetic"),
            static_coefficient: traction.number("static"),
            decay_speed: traction.number("decay_speed"),
            reference_speed: traction.number("reference_speed"),
        },
        _ => Traction::Tanh {
            maximum: traction.number("maximum"),
            reference_speed: traction.number("reference_speed"),
        },
    }
}

fn moment(moment: &Section<'_>) -> Moment {
    match moment.word("law") {
        "palmgren" => Moment::Palmgren {
            form: match moment.word("form") {
                "printed" => MomentForm::Printed,
                _ => MomentForm::Continuous,
            },
            f0: moment.number("f0"),
            viscosity: moment.number("viscosity"),
            f1_factor: moment.number("f1_factor"),
            f1_exponent: moment.number("f1_exponent"),
        },
        _ => Moment::None,
    }
}
