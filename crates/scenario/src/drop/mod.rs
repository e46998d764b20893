//! A drop as typed values in SI: what a simulation is built from.

pub mod base;
pub mod case;
pub mod checks;
pub mod event;
pub mod event_checks;
pub mod keys;
pub mod keys_mount;
pub mod keys_surface;
pub mod kinds;
pub mod mount;
mod shaft;

use crate::bearing::kind::{BUSHING, TYPE};
use crate::bearing::{Bearing, bearing};
use crate::coast_down::CoastDownEnd;
use crate::document::Document;
use crate::heat::{Network, RotorBodies, Warm};
use crate::run::{Run, Until};
use crate::section::Section;
use crate::values::Values;
pub use base::{Base, RecordFile, Shock, Spectrum};
use case::Cases;
pub(crate) use event::LOST_AT;
pub use event::{Event, Happens, MagnetEvent, Relevitation, When};
use kinds::{SpinKind, UnbalanceAngle};
use mount::MountParts;
use physics::heat_conduction::ThermalMaterial;
use problem::Problem;
pub use shaft::{BearingPlace, CUTOFFS, Shaft};
use std::f64::consts::PI;

/// A levitated rotor that is released onto its auxiliary bearings. All values are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Drop {
    /// Speed and torques of the rotor.
    pub rotor: Rotor,
    /// What the rotor is.
    pub body: Body,
    /// Weight.
    pub gravity: Gravity,
    /// Motion of the base.
    pub base: Option<Base>,
    /// The magnetic bearing before the release.
    pub levitation: Levitation,
    /// The auxiliary bearings.
    pub auxiliary_bearings: Vec<AuxiliaryBearing>,
    /// The simulation.
    pub run: Run,
    /// How the rotor coasts down after it, where the run goes on until it stands.
    pub coast_down: Option<CoastDownEnd>,
    /// Repeated runs.
    pub repeat: Repeat,
}

/// An auxiliary bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct AuxiliaryBearing {
    /// Its name in the file; empty where the file tells no bearings apart.
    pub name: String,
    /// Number of equal rows that it stands for.
    pub planes: f64,
    /// Contact of rotor and inner race.
    pub contact: Contact,
    /// Spring and damper between outer race and ground.
    pub mount: Mount,
    /// The rolling bearing; none where it is a plain bushing.
    pub bearing: Option<Bearing>,
    /// What warms of it, where that is followed.
    pub warm: Option<Box<Warm>>,
}

/// What a rotor is.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// A rigid body.
    Rigid(RigidBody),
    /// A shaft that bends.
    Flexible(Box<Shaft>),
}

/// Mass and inertia of a whole rotor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBody {
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia about the axis, kg m².
    pub polar_inertia: f64,
    /// Distance of the centre of mass from the geometric centre, m.
    pub unbalance_eccentricity: f64,
}

/// How the rotor turns.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotor {
    /// Direction of the unbalance at the release, rad from x.
    pub unbalance_angle: f64,
    /// Spin at the release, rad/s, counter-clockwise positive.
    pub speed: f64,
    /// Displacement of the whole rotor at the start from its steady motion, m.
    pub start_displacement: [f64; 2],
    /// Its velocity besides that of the steady motion, m/s.
    pub start_velocity: [f64; 2],
    /// What happens to the spin after the release.
    pub spin: Spin,
    /// Torque of a drive or a load over the size of the speed, rows of rad/s and N m; empty where there is none.
    pub torque_over_speed: Vec<[f64; 2]>,
    /// The share of it that acts, over the time from the start of the run, rows of s and share; empty where all of it does.
    pub torque_share_over_time: Vec<[f64; 2]>,
    /// Number of identical auxiliary bearings that share the rotor, where none has a name.
    pub planes: u32,
    /// First free-free bending natural frequency, rad/s.
    pub first_bending_frequency: Option<f64>,
    /// How far it may move along its axis, m.
    pub axial_clearance: Option<f64>,
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
    /// Along the shaft, m/s².
    pub axial: f64,
}

/// Gravity at the place on Earth where it is weakest, m/s² (Huascarán, 9.764).
const WEAKEST_GRAVITY: f64 = 9.76;

/// The share of g that acts along a shaft of which a gravity, m/s², acts across; 0 where that may be all of it.
pub fn axial_share(across: f64) -> f64 {
    match across < WEAKEST_GRAVITY {
        true => (1.0 - (across / units::STANDARD_GRAVITY).powi(2)).sqrt(),
        false => 0.0,
    }
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
    /// Stiffness and damping of the axial magnet, N/m and N s/m, where there is one.
    pub axial: Option<[f64; 2]>,
}

/// Contact of rotor and inner race: F = k dⁿ(1 + a ḋ).
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Radial air gap when concentric, m.
    pub radial_air_clearance: f64,
    /// Diameter of the bore, m.
    pub bore_diameter: f64,
    /// Width of the landing surface, m.
    pub width: Option<f64>,
    /// Stiffness k, N/mⁿ.
    pub stiffness: f64,
    /// Exponent n.
    pub exponent: f64,
    /// Hunt-Crossley damping a, s/m.
    pub damping: f64,
    /// Coefficient of sliding friction.
    pub friction_coefficient: f64,
    /// Temperatures of the contact, K, with coefficients of friction; their ratio to that of the start counts.
    pub friction_over_temperature: Vec<[f64; 2]>,
    /// Slip speed that regularises the friction, m/s.
    pub friction_reference_speed: f64,
    /// Metal below the landing surface of the rotor, and below that of the race.
    pub metals: [Metal; 2],
    /// Contact modulus E*, Pa.
    pub modulus: f64,
    /// Wear coefficient k, m²/N.
    pub wear_coefficient: Option<f64>,
    /// Faces that meet shoulders of the rotor.
    pub faces: Faces,
}

/// Faces of the inner ring that meet shoulders of the rotor.
#[derive(Clone, Debug, PartialEq)]
pub struct Faces {
    /// Axial gap that closes towards the end of the shaft, m; none without a shoulder there.
    pub gap_to_end: Option<f64>,
    /// The same towards its start.
    pub gap_to_start: Option<f64>,
    /// Mean radius, m, where it is given.
    pub radius: Option<f64>,
    /// Radial width of the annulus that touches, m, where it is given.
    pub width: Option<f64>,
    /// Stiffness of a whole face, N/m.
    pub stiffness: f64,
}

/// Stiffness of a face where none is given, N/m: order of magnitude of flat steel.
const FACE_STIFFNESS: f64 = 2e8;

/// Depth of the rotor's layer where none is given, m.
const ROTOR_DEPTH: f64 = 10e-3;

impl Contact {
    /// Depth of what of the rotor its friction heat warms first, m.
    pub fn rotor_layer_depth(&self) -> f64 {
        let depth = self.metals[0].layer.unwrap_or(ROTOR_DEPTH);
        depth.min(0.5 * self.bore_diameter)
    }
}

impl Faces {
    /// Whether a shoulder of the rotor may meet one.
    pub fn any(&self) -> bool {
        self.gap_to_end.or(self.gap_to_start).is_some()
    }
}

impl AuxiliaryBearing {
    /// Area of the rotor's surface layer, m², where it is one body of the network and its core another.
    pub fn area_over_core(&self) -> Option<f64> {
        let warm = self.warm.as_ref()?;
        let width = self.contact.width?;
        let diameter = self.contact.bore_diameter - 2.0 * self.contact.radial_air_clearance;
        let apart = warm.heat.rotor_bodies == RotorBodies::LayerAndCore;
        apart.then_some(PI * diameter * width)
    }

    /// What the rotor's heat capacity needs to be where its surface layer leaves it no core.
    pub fn without_core(&self) -> Option<String> {
        let whole = self.warm.as_ref()?.heat.rotor_capacity?;
        let metal = self.contact.metals[0].material;
        let capacity = metal.density * metal.specific_heat * self.contact.rotor_layer_depth();
        let layer = capacity * self.area_over_core()?;
        (whole <= layer).then(|| format!("more than the {layer:.3} J/K of its surface layer is needed beside heat.rotor_bodies: its core is the rest"))
    }
}

/// What is below a surface that rubs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal {
    /// What it is.
    pub material: ThermalMaterial,
    /// How deep, m; of the race where it is given.
    pub layer: Option<f64>,
}

/// How a mount holds outer rings that tilt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilting {
    /// Stiffness about an axis across, N m/rad.
    pub tilt_stiffness: f64,
    /// Damping about any axis, N m s/rad.
    pub tilt_damping: f64,
    /// Stiffness about the axis of the bearing, N m/rad.
    pub torsion_stiffness: f64,
    /// Inertia about an axis across, kg m², where it is given.
    pub tilt_inertia: Option<f64>,
}

/// What is between outer race and ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Mount {
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N s/m.
    pub damping: f64,
    /// Mass of the outer race with what moves with it, kg.
    pub moving_mass: f64,
    /// Stiffness along the axis, N/m.
    pub axial_stiffness: f64,
    /// Damping along the axis, N s/m.
    pub axial_damping: f64,
    /// How the outer rings tilt in it; none where they keep their orientation.
    pub tilt: Option<Tilting>,
    /// What it has besides spring and damper.
    pub parts: MountParts,
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
    /// Whether the unbalance points anywhere at the release.
    pub random_unbalance_angle: bool,
    /// Standard deviation of the logarithm of the friction coefficient of rotor and race.
    pub friction_coefficient_deviation: f64,
    /// Standard deviation of the logarithm of the mount's stiffness.
    pub mount_stiffness_deviation: f64,
    /// Standard deviation of the logarithm of the radial air clearance.
    pub radial_air_clearance_deviation: f64,
}

impl Drop {
    /// Whether its rotor is a shaft that bends.
    pub fn body_bends(&self) -> bool {
        matches!(self.body, Body::Flexible(_))
    }

    /// Number of rows of all auxiliary bearings.
    pub fn rows(&self) -> f64 {
        self.auxiliary_bearings.iter().map(|part| part.planes).sum()
    }

    /// Whether the magnets of a machine lose their power by events alone, and not by the key, or its default.
    pub(crate) fn loses_power_by_events(&self) -> bool {
        let Body::Flexible(shaft) = &self.body else {
            return false;
        };
        shaft.rotor.levitation.is_some() && !shaft.events.iter().any(|own| own.by_key)
    }

    /// Of a document, with the values of each auxiliary bearing.
    pub(crate) fn of(document: &Document, all: &[Values]) -> Result<Drop, Box<Problem>> {
        let values = &all[0];
        let gravity = values.section("gravity");
        let repeat = values.section("repeat");
        let until = values.chosen("run.until");
        let bends = document.system.has_shaft();
        // magnets of a rotor that bends are parts of it, and no spring about a point
        let levitation = |name| match bends {
            true => 0.0,
            false => values.section("levitation").number(name),
        };
        let body = match bends {
            true => Body::Flexible(Box::new(Shaft::of(document, all)?)),
            false => Body::Rigid(body(&values.section("rotor"))),
        };
        let cases = match &body {
            Body::Flexible(shaft) => shaft.cases.clone(),
            Body::Rigid(_) => Cases::default(),
        };
        Ok(Drop {
            rotor: rotor(&values.section("rotor"), bends),
            body,
            coast_down: (until == Some(Until::Standstill))
                .then(|| CoastDownEnd::from_values(values)),
            gravity: Gravity {
                acceleration: gravity.number("acceleration"),
                direction: gravity.number("direction"),
                axial: gravity.maybe("axial").unwrap_or(0.0),
            },
            base: Base::of(values, &cases)?,
            levitation: Levitation {
                stiffness: levitation("stiffness"),
                damping: levitation("damping"),
                offset_x: levitation("offset_x"),
                offset_y: levitation("offset_y"),
                axial: axial_magnet(&values.section("levitation")),
            },
            auxiliary_bearings: (all.iter()).map(auxiliary_bearing).collect(),
            run: Run::from_values(values),
            repeat: Repeat {
                count: repeat.count("count") as u32,
                seed: repeat.count("seed"),
                rotor_position_deviation: repeat.number("rotor_position_deviation"),
                ball_angle_deviation: repeat.number("ball_angle_deviation"),
                random_unbalance_angle: repeat.choice::<UnbalanceAngle>("unbalance_angle")
                    == UnbalanceAngle::Random,
                friction_coefficient_deviation: repeat.number("friction_coefficient_deviation"),
                mount_stiffness_deviation: repeat.number("mount_stiffness_deviation"),
                radial_air_clearance_deviation: repeat.number("radial_air_clearance_deviation"),
            },
        })
    }
}

fn auxiliary_bearing(values: &Values) -> AuxiliaryBearing {
    let followed = values.chosen("heat.network") == Some(Network::On);
    let mount = values.section("mount");
    let (stiffness, damping) = (mount.number("stiffness"), mount.number("damping"));
    AuxiliaryBearing {
        name: values.bearing.clone().unwrap_or_default(),
        planes: values.planes(),
        contact: contact(&values.section("contact")),
        mount: Mount {
            stiffness,
            damping,
            moving_mass: mount.number("moving_mass"),
            axial_stiffness: mount.maybe("axial_stiffness").unwrap_or(stiffness),
            axial_damping: mount.maybe("axial_damping").unwrap_or(damping),
            tilt: mount.maybe("tilt_stiffness").map(|tilt_stiffness| Tilting {
                tilt_stiffness,
                tilt_damping: mount.maybe("tilt_damping").unwrap_or(0.0),
                torsion_stiffness: mount.maybe("torsion_stiffness").unwrap_or(tilt_stiffness),
                tilt_inertia: mount.maybe("tilt_inertia"),
            }),
            parts: MountParts::of(&mount),
        },
        bearing: (values.word(TYPE) != BUSHING).then(|| bearing(values)),
        // what it carries is known when the whole rotor is
        warm: followed.then(|| Box::new(Warm::from_values(values, 0.0))),
    }
}

/// Stiffness and damping of the axial magnet.
fn axial_magnet(levitation: &Section<'_>) -> Option<[f64; 2]> {
    let stiffness = levitation.maybe("axial_stiffness")?;
    Some([stiffness, levitation.maybe("axial_damping").unwrap_or(0.0)])
}

fn body(rotor: &Section<'_>) -> RigidBody {
    RigidBody {
        mass: rotor.number("mass"),
        polar_inertia: rotor.number("polar_inertia"),
        unbalance_eccentricity: rotor.number("unbalance_eccentricity"),
    }
}

fn rotor(rotor: &Section<'_>, bends: bool) -> Rotor {
    let start = |keys: [&str; 2]| keys.map(|key| rotor.maybe(key).unwrap_or_default());
    Rotor {
        unbalance_angle: rotor.number("unbalance_angle"),
        speed: rotor.number("speed"),
        start_displacement: start(["start_x", "start_y"]),
        start_velocity: start(["start_speed_x", "start_speed_y"]),
        spin: spin(rotor),
        torque_over_speed: rotor.rows("torque_over_speed").unwrap_or_default(),
        torque_share_over_time: rotor.rows("torque_share_over_time").unwrap_or_default(),
        planes: match bends {
            true => 1,
            false => rotor.count("planes") as u32,
        },
        first_bending_frequency: rotor.maybe("first_bending_frequency"),
        axial_clearance: rotor.maybe("axial_clearance"),
    }
}

fn spin(rotor: &Section<'_>) -> Spin {
    match rotor.choice("spin") {
        SpinKind::Free => Spin::Free,
        SpinKind::Held => Spin::Held,
        SpinKind::Braked => Spin::Braked {
            torque: rotor.number("brake_torque"),
            start: rotor.number("brake_start"),
        },
    }
}

fn contact(contact: &Section<'_>) -> Contact {
    Contact {
        radial_air_clearance: contact.number("radial_air_clearance"),
        bore_diameter: contact.number("bore_diameter"),
        width: contact.maybe("width"),
        stiffness: contact.number("stiffness"),
        exponent: contact.number("exponent"),
        damping: contact.number("damping"),
        friction_coefficient: contact.number("friction_coefficient"),
        friction_over_temperature: contact
            .rows("friction_over_temperature")
            .unwrap_or_default(),
        friction_reference_speed: contact.number("friction_reference_speed"),
        metals: ["rotor", "race"].map(|body| metal(contact, body)),
        modulus: contact.number("surface.modulus"),
        wear_coefficient: contact.maybe("surface.wear_coefficient"),
        faces: Faces {
            gap_to_end: contact.maybe("gap_to_end"),
            gap_to_start: contact.maybe("gap_to_start"),
            radius: contact.maybe("face_radius"),
            width: contact.maybe("face_width"),
            stiffness: contact.maybe("face_stiffness").unwrap_or(FACE_STIFFNESS),
        },
    }
}

fn metal(contact: &Section<'_>, body: &str) -> Metal {
    let number = |what: &str| contact.number(&format!("surface.{body}_{what}"));
    Metal {
        material: ThermalMaterial {
            conductivity: number("conductivity"),
            density: number("density"),
            specific_heat: number("specific_heat"),
        },
        layer: contact.maybe(&format!("surface.{body}_layer")),
    }
}
