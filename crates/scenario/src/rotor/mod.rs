//! A flexible rotor with what carries it, and what is asked of it.

pub mod keys;
pub mod levitation;
pub mod parts;
pub mod tables;

use crate::document::Document;
use crate::drop::{Drop, RecordFile};
use crate::key::Key;
use crate::system::SystemName;
use crate::values::Values;
use physics::shaft::Layer;
use physics::support::Coefficients;
use problem::{Code, Result};
use units::number_text;

/// A flexible rotor as its file gives it. Positions are along the shaft, m.
#[derive(Clone, Debug, PartialEq)]
pub struct FlexibleRotor {
    /// Sections, then sleeves.
    pub pieces: Vec<Piece>,
    /// Named places.
    pub nodes: Vec<Node>,
    /// Disks.
    pub disks: Vec<Disk>,
    /// Masses without inertia.
    pub masses: Vec<PointMass>,
    /// Supports, then seals, then the mounts of housings.
    pub supports: Vec<Support>,
    /// Masses of the housings, kg.
    pub housings: Vec<f64>,
    /// Unbalance planes.
    pub unbalance: Vec<Unbalance>,
    /// Forces from outside.
    pub forces: Vec<Force>,
    /// Balance quality grade G of ISO 21940-11, m/s: of the balance planes, else of the unbalances, which are scaled to it.
    pub balance_grade: Option<f64>,
    /// Planes in which the grade leaves unbalance.
    pub balance_planes: Option<BalancePlanes>,
    /// Magnets with their sensors and controllers.
    pub levitation: Option<levitation::Magnets>,
    /// Longest element of a section that says nothing of elements, m.
    pub longest_element: f64,
}

/// A section of the shaft, or a sleeve on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Its name, else its number.
    pub name: String,
    /// Name of its material.
    pub material: String,
    /// Dimensions; a sleeve does not bend with the shaft.
    pub layer: Layer,
}

/// A named place.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// Its position.
    pub at: f64,
    /// Radial clearance of what stands around the rotor there, m.
    pub clearance: Option<f64>,
    /// The housing that this belongs to; the ground without.
    pub on: Option<usize>,
}

/// A rigid disk.
#[derive(Clone, Debug, PartialEq)]
pub struct Disk {
    /// Its name, else its number.
    pub name: String,
    /// Its position.
    pub at: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia about the axis, kg m².
    pub polar: f64,
    /// Moment of inertia about a diameter, kg m².
    pub diametral: f64,
    /// Diameter, m, where the file gives it.
    pub outer_diameter: Option<f64>,
    /// Width, m, where the file gives it.
    pub width: Option<f64>,
}

/// A mass without inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMass {
    /// Its position.
    pub at: f64,
    /// Mass, kg.
    pub mass: f64,
}

/// A linear support, a seal, or the mount of a housing.
#[derive(Clone, Debug, PartialEq)]
pub struct Support {
    /// Its name, else its number.
    pub name: String,
    /// Its position; none of the mount of a housing, in the order of the housings.
    pub at: Option<f64>,
    /// The housing that it stands on; the ground without.
    pub on: Option<usize>,
    /// Stiffness, damping and mass over speed.
    pub coefficients: Coefficients,
    /// Whether it is a seal, which takes no static load.
    pub seal: bool,
    /// Whether it acts on after the release of a machine's rotor.
    pub stays: bool,
}

/// An unbalance plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Unbalance {
    /// Its name, else its number.
    pub name: String,
    /// Its position.
    pub at: f64,
    /// Mass times distance from the axis, kg m.
    pub amount: f64,
    /// Angle on the rotor, rad.
    pub phase: f64,
}

/// The two planes of a balanced rotor.
#[derive(Clone, Debug, PartialEq)]
pub struct BalancePlanes {
    /// Their names.
    pub names: [String; 2],
    /// Their positions.
    pub at: [f64; 2],
    /// Seed of the angles of their unbalances.
    pub seed: u64,
}

/// A force and torque from outside over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Force {
    /// Its path in the scenario: `rotor.force.shaker`.
    pub path: String,
    /// Its position.
    pub at: f64,
    /// Rows of time, s, and force along x, N; the same along y and along the shaft, and of the torque, N m.
    pub over_time: [Vec<[f64; 2]>; 4],
    /// A file that has them instead.
    pub record: Option<ForceRecord>,
}

impl Force {
    /// Whether it acts along the shaft.
    pub fn has_thrust(&self) -> bool {
        let given = self.over_time[2].iter().any(|[_, force]| *force != 0.0);
        given || (self.record.iter()).any(|record| record.along.is_some())
    }
}

/// A record of a force in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceRecord {
    /// The file.
    pub file: RecordFile,
    /// Its channel with the force along the shaft.
    pub along: Option<String>,
    /// Its channel with the torque.
    pub torque: Option<String>,
    /// When the record begins, s.
    pub start: f64,
    /// Factor on it.
    pub scale: f64,
}

/// The kinds of parts of a system, with their keys: `rotor.section` of `[[rotor.section]]`.
pub fn parts_of(system: SystemName) -> impl Iterator<Item = (String, &'static [Key])> {
    let own = keys::PARTS
        .iter()
        .filter(move |kind| system.has_part(kind.word));
    own.map(|kind| (kind.path().to_string(), kind.keys))
}

/// A rotor and what is asked of it. Speeds in rad/s.
#[derive(Clone, Debug, PartialEq)]
pub struct RotorAnalysis {
    /// The rotor.
    pub rotor: FlexibleRotor,
    /// Rated speed.
    pub speed: f64,
    /// Lowest speed looked at.
    pub speed_from: f64,
    /// Highest speed looked at.
    pub speed_to: f64,
    /// Number of speeds.
    pub speed_count: usize,
    /// Highest frequency looked at, rad/s.
    pub frequency_to: f64,
    /// Number of modes shown at the rated speed.
    pub modes: usize,
    /// Whether the file gives that number; else fewer are shown where there are no more.
    pub modes_given: bool,
    /// Modes of the free rotor up to this frequency are kept, rad/s.
    pub cutoff: f64,
    /// Whether the file gives that frequency; else more are kept where the modes shown need them.
    pub cutoff_given: bool,
    /// Gravity across the shaft, m/s².
    pub gravity: f64,
    /// Direction of gravity from x, rad.
    pub gravity_angle: f64,
    /// Lowest operating speed.
    pub operating_from: f64,
    /// Highest operating speed.
    pub operating_to: f64,
    /// Least separation of a critical speed from the operating speeds, as a share.
    pub separation_margin: Option<f64>,
    /// Amplification below which a critical speed needs no separation.
    pub exempt_amplification: Option<f64>,
    /// Lowest stiffness of the map, N/m.
    pub map_from: f64,
    /// Highest stiffness of the map, N/m.
    pub map_to: f64,
    /// Number of stiffnesses of the map.
    pub map_count: usize,
    /// Highest frequency of dry whirl looked at, rad/s.
    pub whirl_to: Option<f64>,
    /// The machine whose rotor it is; none of a rotor alone.
    pub machine: Option<Box<Drop>>,
}

impl RotorAnalysis {
    /// The typed values of a document, checked.
    pub fn of(document: &Document, values: &Values) -> Result<RotorAnalysis> {
        let rotor = FlexibleRotor::of_document(document, values)?;
        let analysis = values.section("analysis");
        let speed = values.number("rotor.speed").unwrap_or_default();
        let operating = |name: &str| analysis.maybe(name).unwrap_or(speed.abs());
        let (operating_from, operating_to) =
            (operating("operating_from"), operating("operating_to"));
        let separation_margin = analysis.maybe("separation_margin");
        let margin = separation_margin.unwrap_or(0.0);
        let speed_to = analysis
            .maybe("speed_to")
            .unwrap_or((1.5 * speed.abs()).max((1.0 + margin) * operating_to));
        let speed_from = analysis.number("speed_from");
        let frequency_to = analysis
            .maybe("frequency_to")
            .unwrap_or(1.5 * speed_to.max(speed.abs()));
        let followed = frequency_to.max(speed_to);
        let typical = rotor.typical_stiffness(speed);
        let map = |name: &str, factor: f64| analysis.maybe(name).unwrap_or(typical * factor);
        let this = RotorAnalysis {
            speed,
            speed_from,
            speed_to,
            speed_count: analysis.count("speed_count") as usize,
            frequency_to,
            modes: analysis.count("modes") as usize,
            modes_given: values.is_own("analysis.modes"),
            cutoff: analysis.maybe("cutoff").unwrap_or(6.0 * followed),
            cutoff_given: values.is_own("analysis.cutoff"),
            rotor,
            gravity: analysis.number("gravity"),
            gravity_angle: analysis.number("gravity_angle"),
            operating_from,
            operating_to,
            separation_margin,
            exempt_amplification: analysis.maybe("exempt_amplification"),
            map_from: map("map_from", 1e-2),
            map_to: map("map_to", 1e2),
            map_count: analysis.count("map_count") as usize,
            whirl_to: analysis.maybe("whirl_to"),
            machine: None,
        };
        this.check(values)?;
        Ok(this)
    }

    /// The speeds that a verdict on the separation needs, where not all of them are looked at.
    pub fn not_looked_at(&self) -> Option<[f64; 2]> {
        let margin = self.separation_margin.unwrap_or(0.0);
        let needed = [
            (1.0 - margin).max(0.0) * self.operating_from,
            (1.0 + margin) * self.operating_to,
        ];
        (self.speed_from > needed[0] || self.speed_to < needed[1]).then_some(needed)
    }

    /// Refuses ranges that are none.
    fn check(&self, values: &Values) -> Result<()> {
        const SPEED_TO: &str = "analysis.speed_to";
        const OPERATING_TO: &str = "analysis.operating_to";
        let refuse = |path: &str, found: String, allowed: &str| {
            values.refuse(Code::OutOfRange, path, found, allowed)
        };
        // what is not given follows from rotor.speed
        let text = |path: &str, value: f64, unit: &str| {
            let by_default = || format!("{} {unit} by its default", number_text(value));
            values.text(path).unwrap_or_else(by_default)
        };
        if self.speed_to == 0.0 {
            return refuse(
                SPEED_TO,
                "no speed to look up to: rotor.speed is 0".to_string(),
                "one is needed: speed_to in [analysis], or --set analysis.speed_to=\"18000 rpm\"",
            );
        }
        let outer = |piece: &Piece| piece.layer.start.outer.max(piece.layer.end.outer);
        let radius = 0.5 * self.rotor.pieces.iter().map(outer).fold(0.0, f64::max);
        let path = match values.text(SPEED_TO) {
            Some(_) => SPEED_TO,
            None => "rotor.speed",
        };
        values.holds_together(path, self.speed_to, radius)?;
        if self.speed_to <= self.speed_from {
            let found = text(SPEED_TO, self.speed_to, "rad/s");
            return refuse(SPEED_TO, found, "more than analysis.speed_from is needed");
        }
        if self.map_to <= self.map_from {
            let found = text("analysis.map_to", self.map_to, "N/m");
            return refuse(
                "analysis.map_to",
                found,
                "more than analysis.map_from is needed",
            );
        }
        if self.operating_to < self.operating_from {
            let found = text(OPERATING_TO, self.operating_to, "rad/s");
            let allowed = "at least analysis.operating_from is needed";
            return refuse(OPERATING_TO, found, allowed);
        }
        Ok(())
    }

    /// The speeds looked at, rad/s: evenly apart, and those at which a table of a support or seal has a row.
    pub fn speeds(&self) -> Vec<f64> {
        let last = (self.speed_count - 1) as f64;
        let span = self.speed_to - self.speed_from;
        let even = (0..self.speed_count).map(|k| self.speed_from + span * k as f64 / last);
        let tables = self.rotor.supports.iter().map(|own| &own.coefficients);
        let rows = tables
            .filter(|own| own.range().is_some())
            .flat_map(|own| own.rows());
        let within = |speed: &f64| self.speed_from < *speed && *speed < self.speed_to;
        let mut all: Vec<f64> = even
            .chain(rows.map(|(speed, _)| *speed).filter(within))
            .collect();
        all.sort_by(f64::total_cmp);
        all.dedup_by(|a, b| *a - *b <= 1e-9 * *a);
        all
    }
}
