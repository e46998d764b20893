//! The torque of a bearing over speed, load and acceleration, as typed values in SI.

pub mod checks;
pub mod keys;

use crate::bearing::kind::{BallMaterial, BearingType};
use crate::bearing::lubricant::{Lubricant, LubricantViscosity};
use crate::bearing::moment::{AccelerationLoss, Moment, RatedBearing};
use crate::bearing::source::BearingSource;
use crate::bearing::{ball_material, cage_ring_mass};
use crate::checks::Context;
use crate::document::Document;
use crate::section::Section;
use crate::values::{COMPARED_LAWS, LAW, Values};
use physics::viscosity::Viscosity;
use problem::raw::{Input, Raw};
use problem::{Code, Place, Result};

/// A bearing whose torque is computed without motion. All values are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Torque {
    /// Name in the catalogue.
    pub name: Option<String>,
    /// Type.
    pub kind: BearingType,
    /// Number of balls.
    pub ball_count: usize,
    /// Diameter of a ball, m.
    pub ball_diameter: f64,
    /// Diameter of the circle through the ball centres, m.
    pub pitch_diameter: f64,
    /// Material of the balls.
    pub ball_material: BallMaterial,
    /// Static load rating, N.
    pub static_load_rating: Option<f64>,
    /// Limiting speed in continuous running, rad/s.
    pub limiting_speed: Option<f64>,
    /// Mass of the cage as a ring at the pitch circle, kg; 0 where there is none.
    pub cage_mass: f64,
    /// Mass of one ball, kg; derived from diameter and material where it is `None`.
    pub ball_mass: Option<f64>,
    /// Steady friction moment.
    pub moment: Moment,
    /// Friction of the balls in their pockets while the race accelerates.
    pub acceleration_loss: AccelerationLoss,
    /// Least speed, rad/s.
    pub speed_from: f64,
    /// Largest speed, rad/s.
    pub speed_to: f64,
    /// Number of speeds.
    pub speed_count: usize,
    /// Speed of the tables that vary something else, rad/s.
    pub speed: f64,
    /// Accelerations of the inner race, rad/s².
    pub accelerations: Vec<f64>,
    /// Radial loads, N; the first one is that of the tables that vary something else.
    pub loads: Vec<f64>,
    /// Running temperature of the lubricant, K.
    pub temperature: Option<f64>,
    /// Temperatures at which lubricants are compared, K.
    pub temperatures: Vec<f64>,
    /// Laws to compare.
    pub laws: Vec<ComparedLaw>,
    /// Lubricants to compare, that of the bearing first.
    pub lubricants: Vec<Lubricant>,
}

impl Lubricant {
    /// It where it is farthest beyond its data among the temperatures of a comparison, K; none where it never is.
    pub fn farthest(&self, torque: &Torque) -> Option<(Viscosity, f64)> {
        let LubricantViscosity::OverTemperature(oil) = self.viscosity else {
            return None;
        };
        let all = torque.temperature.iter().chain(&torque.temperatures);
        let known = all
            .copied()
            .filter(|now| oil.at(*now).is_ok() && oil.beyond(*now) > 0.0);
        let farthest = known.max_by(|a, b| oil.beyond(*a).total_cmp(&oil.beyond(*b)));
        Some((oil, farthest?))
    }
}

/// A law of the friction moment in a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedLaw {
    /// Its word in a file.
    pub law: &'static str,
    /// The law with its constants, or why it has none for this bearing.
    pub moment: Result<Moment, String>,
}

impl Torque {
    pub(crate) fn from_values(values: &Values, laws: Vec<ComparedLaw>) -> Result<Torque> {
        let bearing = values.section("bearing");
        let torque = values.section("torque");
        Ok(Torque {
            name: values.text("bearing.name"),
            kind: bearing.choice("type"),
            ball_count: bearing.count("ball_count") as usize,
            ball_diameter: bearing.number("ball_diameter"),
            pitch_diameter: bearing.number("pitch_diameter"),
            ball_material: ball_material(&bearing),
            static_load_rating: bearing.maybe("static_load_rating"),
            limiting_speed: bearing.maybe("limiting_speed"),
            cage_mass: cage_ring_mass(&bearing),
            ball_mass: bearing.maybe("ball_mass"),
            moment: Moment::from_values(values),
            acceleration_loss: AccelerationLoss::from_values(values),
            speed_from: torque.number("speed_from"),
            speed_to: torque.number("speed_to"),
            speed_count: torque.count("speed_count") as usize,
            speed: torque.number("speed"),
            accelerations: values.numbers("torque.accelerations"),
            loads: values.numbers("torque.loads"),
            temperature: values.number("bearing.moment.temperature"),
            temperatures: values.numbers("torque.temperatures"),
            laws,
            lubricants: lubricants(values)?,
        })
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

/// The lubricants of a comparison: that of the bearing, where it is known over temperature, and those listed.
fn lubricants(values: &Values) -> Result<Vec<Lubricant>> {
    const LISTED: &str = "torque.lubricants";
    let texts = values.texts(LISTED);
    let listed = texts.iter().map(|text| {
        Lubricant::parse(text).map_err(|why| {
            values.problem(
                Code::NoLawData,
                LISTED,
                values.place(LISTED),
                format!("\"{text}\": {why}"),
                "viscosities are needed, e.g. \"ISO VG 68, 8.7 mm^2/s at 100 degC\"",
            )
        })
    });
    let points = values.rows("bearing.moment.viscosity_points");
    let compared = !texts.is_empty() || !values.numbers("torque.temperatures").is_empty();
    let own = match points.as_deref() {
        Some([one, other]) if compared => {
            Viscosity::through((one[0], one[1]), (other[0], other[1])).ok()
        }
        _ => None,
    };
    let own = own.map(|viscosity| {
        Ok(Lubricant {
            name: "the lubricant of the bearing".to_string(),
            viscosity: LubricantViscosity::OverTemperature(viscosity),
        })
    });
    own.into_iter().chain(listed).collect()
}

/// The laws of a comparison: the same file, read once with each of them.
pub fn compared_laws(
    document: &Document,
    values: &Values,
    bearings: &dyn BearingSource,
) -> Vec<ComparedLaw> {
    let laws = values.words(COMPARED_LAWS).iter();
    laws.map(|&law| ComparedLaw {
        law,
        moment: moment_by(law, document, values, bearings).map_err(|problem| {
            let key = problem.key.as_deref().unwrap_or(LAW);
            format!("{key}: found {}; {}", problem.found, problem.allowed)
        }),
    })
    .collect()
}

/// The moment of the bearing if the law were this one. Keys that belong to the file's own law have no effect then.
fn moment_by(
    law: &'static str,
    document: &Document,
    values: &Values,
    bearings: &dyn BearingSource,
) -> Result<Moment> {
    if law == values.word(LAW) {
        return Ok(Moment::from_values(values));
    }
    let mut document = document.clone();
    let mut set = |path, raw| {
        document.values.insert(
            path,
            Input {
                raw,
                typed: None,
                place: Place::Whole,
            },
        );
    };
    set(LAW, Raw::Text(law.to_string()));
    let mut all = values.words(COMPARED_LAWS).to_vec();
    all.push(values.word(LAW));
    let mut all: Vec<&str> = all.into_iter().filter(|law| *law != "none").collect();
    all.sort_unstable();
    all.dedup();
    let all = all.into_iter().map(|law| Raw::Text(law.to_string()));
    set(COMPARED_LAWS, Raw::List(all.collect()));
    let values = Values::resolve(&document, bearings, None)?;
    let moment = Moment::from_values(&values);
    let bearing = Section {
        values: &values,
        path: "bearing",
    };
    let rated = RatedBearing {
        kind: bearing.choice("type"),
        pitch_diameter: bearing.number("pitch_diameter"),
        static_load_rating: bearing.maybe("static_load_rating"),
        ball_material: ball_material(&bearing),
        in_space: false,
    };
    let context = Context {
        values: &values,
        file: &document.file,
    };
    context.moment(&moment, &rated)?;
    Ok(moment)
}
