//! What a bearing answers to its loads: plain data, and JSON.

use super::Contacts;
use super::request::Request;
use super::warnings::{self, Rows};
use model::spatial::PreloadSpring;
use model::spatial::statics::{BallEquilibrium, Displacement, Equilibrium};
use outcome::Warning;
use physics::hertz::maximum_pressure;
use serde_json::{Value as Json, json};

/// A ball in equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Azimuth from the radial load, rad.
    pub azimuth: f64,
    /// Contact angles at the inner and the outer race, rad.
    pub angles: [f64; 2],
    /// Loads, N.
    pub loads: [f64; 2],
    /// Largest Hertz pressures, Pa.
    pub pressures: [f64; 2],
    /// Half axes of the ellipses across rolling, m.
    pub half_axes: [f64; 2],
    /// Orbit speed, rad/s.
    pub cage_speed: f64,
    /// Spin about the normals of the contacts, rad/s.
    pub spins: [f64; 2],
}

/// Equilibrium and stiffness.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// What was asked.
    pub asked: Request,
    /// Distance by which the pair is closed, m; 0 without preload.
    pub offset: f64,
    /// Thrust of each row without the loads, N; none without preload.
    pub preload_thrusts: Option<Vec<f64>>,
    /// Compression of the preload spring beyond that of the preload, m, and its force, N.
    pub spring: Option<[f64; 2]>,
    /// How far outer rings have slid against it along the axis, m.
    slid: f64,
    /// Displacement of the inner ring.
    pub displacement: Displacement,
    /// Balls of each row.
    pub rows: Vec<Vec<Ball>>,
    /// Thrust that each row carries on the inner ring, N: normal part.
    pub thrusts: Vec<f64>,
    /// Stiffness: forces x y z and moments about x y over shifts and tilts.
    pub stiffness: [[f64; 5]; 5],
    /// What to know before it is used.
    pub warnings: Vec<Warning>,
}

fn thrusts(equilibrium: &Equilibrium) -> Vec<f64> {
    let of = |ball: &BallEquilibrium| ball.loads[0] * ball.axial_share;
    let rows = equilibrium.rows.iter();
    rows.map(|balls| balls.iter().map(of).sum()).collect()
}

impl Answer {
    pub(super) fn new(
        asked: &Request,
        contacts: &Contacts,
        offset: f64,
        (loaded, preloaded): (Equilibrium, Option<Equilibrium>),
    ) -> Self {
        let factors = [
            contacts.inner.pressure_factor,
            contacts.outer.pressure_factor,
        ];
        let both = [&contacts.inner, &contacts.outer];
        let ball = |own: &BallEquilibrium| Ball {
            azimuth: own.azimuth,
            angles: own.angles,
            loads: own.loads,
            pressures: [0, 1].map(|k| maximum_pressure(factors[k], own.loads[k])),
            half_axes: [0, 1].map(|k| both[k].semi_major(own.loads[k])),
            cage_speed: own.orbit_speed,
            spins: own.contact_spin,
        };
        let rows = loaded
            .rows
            .iter()
            .map(|balls| balls.iter().map(ball).collect());
        let mut answer = Answer {
            asked: asked.clone(),
            offset,
            preload_thrusts: preloaded.as_ref().map(thrusts),
            spring: None,
            slid: loaded.slid,
            displacement: loaded.displacement,
            rows: rows.collect(),
            thrusts: thrusts(&loaded),
            stiffness: loaded.stiffness,
            warnings: Vec::new(),
        };
        answer.warnings = warnings::of(asked, &Rows(&answer.rows));
        answer
    }

    /// Adds what a preload spring does.
    pub(super) fn add_spring(&mut self, spring: Option<&PreloadSpring<f64>>) {
        let Some(spring) = spring else { return };
        let (compression, force) = (spring.side * self.slid, spring.force(self.slid));
        self.spring = Some([compression, force]);
        self.warnings
            .extend(warnings::of_spring(spring, compression, force));
    }

    /// All of it as one JSON text; numbers in SI, angles in rad.
    pub fn to_json(&self) -> String {
        let ball = |own: &Ball| {
            json!({
                "azimuth": own.azimuth,
                "contact_angle_inner": own.angles[0],
                "contact_angle_outer": own.angles[1],
                "load_inner": own.loads[0],
                "load_outer": own.loads[1],
                "pressure_inner": own.pressures[0],
                "pressure_outer": own.pressures[1],
                "half_axis_inner": own.half_axes[0],
                "half_axis_outer": own.half_axes[1],
                "cage_speed": own.cage_speed,
                "spin_inner": own.spins[0],
                "spin_outer": own.spins[1],
            })
        };
        let rows: Vec<Json> = self
            .rows
            .iter()
            .map(|balls| balls.iter().map(ball).collect())
            .collect();
        let warnings = self.warnings.iter();
        let warnings: Vec<Json> = warnings
            .map(|own| json!({ "code": own.code, "text": own.text }))
            .collect();
        let asked = &self.asked;
        let whole = json!({
            "bearing": asked.name,
            "arrangement": asked.words()[0],
            "race_control": asked.words()[1],
            "free_contact_angle": asked.free_angle,
            "axial_load": asked.axial,
            "radial_load": asked.radial,
            "moment": asked.moment,
            "speed": asked.speed,
            "offset": self.offset,
            "preload_thrusts": self.preload_thrusts,
            "spring_compression": self.spring.map(|own| own[0]),
            "spring_force": self.spring.map(|own| own[1]),
            "shift": self.displacement.shift,
            "tilt": self.displacement.tilt,
            "thrusts": self.thrusts,
            "stiffness": self.stiffness,
            "rows": rows,
            "warnings": warnings,
        });
        format!("{whole:#}\n")
    }
}
