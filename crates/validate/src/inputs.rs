//! What a case gives and what is computed of it.

use crate::compare::told;
use physics::hertz::{BallRace, Curvature, Race};
use physics::materials::{BEARING_STEEL, Material, contact_modulus};
use serde::Deserialize;
use std::collections::BTreeMap;
use units::{Dimension, parse_quantity};

#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(untagged)]
pub(super) enum Raw {
    Number(f64),
    Text(String),
}

/// The inputs of a case: each is taken once, so that what is left over is unknown.
pub struct Inputs {
    pub(super) values: BTreeMap<String, Raw>,
}

impl Inputs {
    /// A quantity in SI, if it is given.
    pub fn maybe_quantity(
        &mut self,
        key: &str,
        dimension: Dimension,
    ) -> Result<Option<f64>, String> {
        let Some(raw) = self.values.remove(key) else {
            return Ok(None);
        };
        let Raw::Text(text) = raw else {
            return Err(format!(
                "inputs.{key}: a quantity with a unit is needed, in {}",
                dimension.si_unit()
            ));
        };
        let quantity = parse_quantity(&text).map_err(|error| format!("inputs.{key}: {error}"))?;
        if quantity.dimension != dimension {
            return Err(format!(
                "inputs.{key}: found \"{text}\", a quantity in {} is needed",
                dimension.si_unit()
            ));
        }
        Ok(Some(quantity.value_si))
    }
    /// A quantity in SI.
    pub fn quantity(&mut self, key: &str, dimension: Dimension) -> Result<f64, String> {
        self.maybe_quantity(key, dimension)?
            .ok_or_else(|| missing(key))
    }
    /// A ratio or count, if it is given.
    pub fn maybe_number(&mut self, key: &str) -> Result<Option<f64>, String> {
        match self.values.remove(key) {
            None => Ok(None),
            Some(Raw::Number(number)) => Ok(Some(number)),
            Some(Raw::Text(text)) => Err(format!(
                "inputs.{key}: found \"{text}\", a number is needed"
            )),
        }
    }
    /// A ratio or count.
    pub fn number(&mut self, key: &str) -> Result<f64, String> {
        self.maybe_number(key)?.ok_or_else(|| missing(key))
    }
    /// A whole number from 1.
    pub fn count(&mut self, key: &str) -> Result<usize, String> {
        let number = self.number(key)?;
        if (1.0..1e6).contains(&number) && number.fract() == 0.0 {
            Ok(number as usize)
        } else {
            Err(format!(
                "inputs.{key}: found {number}, a whole number from 1 is needed"
            ))
        }
    }
    /// Any text.
    pub fn text(&mut self, key: &str) -> Result<String, String> {
        match self.values.remove(key) {
            Some(Raw::Text(text)) => Ok(text),
            Some(Raw::Number(number)) => Err(format!(
                "inputs.{key}: found {number}, a text in quotes is needed"
            )),
            None => Err(missing(key)),
        }
    }
    /// One of the words allowed.
    pub fn word(&mut self, key: &str, allowed: &[&str]) -> Result<String, String> {
        match self.values.remove(key) {
            Some(Raw::Text(text)) if allowed.contains(&text.as_str()) => Ok(text),
            Some(_) => Err(format!(
                "inputs.{key}: one of {} is needed",
                allowed.join(", ")
            )),
            None => Err(missing(key)),
        }
    }
    /// Refuses what was not taken.
    pub(super) fn finish(self) -> Result<(), String> {
        match self.values.keys().next() {
            None => Ok(()),
            Some(key) => Err(format!("inputs.{key}: unknown for this kind")),
        }
    }
}

fn missing(key: &str) -> String {
    format!("inputs.{key} is missing")
}

/// What a kind computed under one name.
pub struct Computed {
    /// Name of the quantity.
    pub quantity: String,
    /// Its dimension.
    pub dimension: Dimension,
    /// Its value in SI, or why it could not be computed.
    pub value: Result<f64, String>,
}

/// (number as written, unit as written, SI value of the unit).
pub(super) fn amount(raw: &Raw, dimension: Dimension) -> Result<(f64, String, f64), String> {
    match raw {
        Raw::Number(number) if dimension == Dimension::NONE => Ok((*number, String::new(), 1.0)),
        Raw::Number(_) => Err(format!("a quantity in {} is needed", dimension.si_unit())),
        Raw::Text(text) => {
            let quantity = parse_quantity(text).map_err(told)?;
            if quantity.dimension != dimension {
                return Err(format!(
                    "found \"{text}\", a quantity in {} is needed",
                    dimension.si_unit()
                ));
            }
            let unit = text
                .trim()
                .trim_start_matches(|c: char| !c.is_whitespace())
                .trim();
            let factor = parse_quantity(&format!("1 {unit}")).map_err(told)?.value_si;
            Ok((quantity.value_si / factor, unit.to_string(), factor))
        }
    }
}

pub(super) fn law(quantity: &'static str, dimension: Dimension, value: f64) -> Computed {
    Computed {
        quantity: quantity.to_string(),
        dimension,
        value: Ok(value),
    }
}

/// A ratio or count that a kind computed.
pub(super) fn ratio(quantity: &'static str, value: f64) -> Computed {
    law(quantity, Dimension::NONE, value)
}

pub(super) fn positive(key: &str, value: f64) -> Result<f64, String> {
    if value > 0.0 {
        Ok(value)
    } else {
        Err(format!("inputs.{key}: must be positive"))
    }
}

pub(super) fn length(inputs: &mut Inputs, key: &str) -> Result<f64, String> {
    positive(key, inputs.quantity(key, Dimension::LENGTH)?)
}

pub(super) fn either<T>(first: (&str, Option<T>), second: (&str, Option<T>)) -> Result<(), String> {
    match (first.1.is_some(), second.1.is_some()) {
        (true, false) | (false, true) => Ok(()),
        _ => Err(format!(
            "inputs: either {} or {} is needed",
            first.0, second.0
        )),
    }
}

/// A ball on a race, as inputs describe it.
pub(super) struct BallOnRace {
    /// Sums of principal curvatures, 1/m.
    pub curvature: Curvature,
    /// E*, Pa.
    pub modulus: f64,
    /// Poisson ratio of the race.
    pub poisson_ratio: f64,
    /// Load, N.
    pub load: f64,
    /// Ball diameter, m.
    pub ball_diameter: f64,
    /// Pitch diameter, m, where the race is described by it.
    pub pitch_diameter: Option<f64>,
    /// Contact angle, rad.
    pub contact_angle: f64,
}

pub(super) fn ball_on_race(inputs: &mut Inputs) -> Result<BallOnRace, String> {
    let load = positive("load", inputs.quantity("load", Dimension::FORCE)?)?;
    let ball_diameter = length(inputs, "ball_diameter")?;
    let race = match inputs.word("race", &["inner", "outer"])?.as_str() {
        "inner" => Race::Inner,
        _ => Race::Outer,
    };
    let ratio = inputs.maybe_number("groove_curvature")?;
    let radius = inputs.maybe_quantity("groove_radius", Dimension::LENGTH)?;
    either(("groove_curvature", ratio), ("groove_radius", radius))?;
    let groove_curvature = ratio
        .or(radius.map(|r| r / ball_diameter))
        .unwrap_or(f64::NAN);
    let pitch = inputs.maybe_quantity("pitch_diameter", Dimension::LENGTH)?;
    let race_radius = inputs.maybe_quantity("race_radius", Dimension::LENGTH)?;
    either(("pitch_diameter", pitch), ("race_radius", race_radius))?;
    let contact_angle = inputs
        .maybe_quantity("contact_angle", Dimension::ANGLE)?
        .unwrap_or(0.0);
    let geometry = BallRace {
        ball_diameter,
        pitch_diameter: pitch.unwrap_or(f64::INFINITY),
        groove_curvature,
        contact_angle,
        race,
    };
    let mut curvature = geometry.curvature();
    if let Some(radius) = race_radius {
        let track = match race {
            Race::Inner => 1.0 / radius,
            Race::Outer => -1.0 / radius,
        };
        curvature = Curvature {
            rolling: 2.0 / ball_diameter + track,
            ..curvature
        };
    }
    let race_material = Material {
        young_modulus: inputs.quantity("young_modulus", Dimension::PRESSURE)?,
        poisson_ratio: inputs.number("poisson_ratio")?,
        ..BEARING_STEEL
    };
    let ball_material = Material {
        young_modulus: inputs
            .maybe_quantity("ball_young_modulus", Dimension::PRESSURE)?
            .unwrap_or(race_material.young_modulus),
        poisson_ratio: inputs
            .maybe_number("ball_poisson_ratio")?
            .unwrap_or(race_material.poisson_ratio),
        ..BEARING_STEEL
    };
    Ok(BallOnRace {
        curvature,
        modulus: contact_modulus(ball_material, race_material),
        poisson_ratio: race_material.poisson_ratio,
        load,
        ball_diameter,
        pitch_diameter: pitch,
        contact_angle,
    })
}
