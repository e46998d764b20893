//! The product's own case format, `auxbear.case/1`.
//!
//! ```toml
//! format = "auxbear.case/1"
//! kind = "hertz_point_contact"
//! long = true            # optional: run only where that is asked for
//!
//! [source]
//! citation = "…"
//! where = "…"            # optional
//! note = "…"             # optional
//!
//! [inputs]               # quantities with units, ratios and counts as numbers, words as texts
//! ball_diameter = "6.35 mm"
//!
//! [[results]]
//! quantity = "stiffness"
//! value = "2.518829e10 N/m^1.5"
//! tolerance = 2e-7       # share of the value; or absolute with a unit: "0.2 us"
//! reason = "seven printed digits"
//!
//! [[results]]            # what is known of one side alone
//! quantity = "peak_shear"
//! most = "1 GPa"         # or least
//! reason = "no yield was seen"
//! ```
//!
//! The kinds, their inputs and their quantities stand in [`kinds`]. Unknown keys, missing inputs and
//! wrong dimensions make the case fail with the reason: a case that cannot be compared must not look well.

use super::inputs::{Computed, Inputs, Raw, amount};
use super::kinds;
use super::report::{Row, Tolerance};
use super::simulator::Simulator;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Name and version of the format.
pub const FORMAT: &str = "auxbear.case/1";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "format")]
    _format: String,
    kind: String,
    #[serde(default)]
    long: bool,
    #[serde(rename = "source")]
    _source: Source,
    inputs: BTreeMap<String, Raw>,
    results: Vec<Expected>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Source {
    #[serde(rename = "citation")]
    _citation: String,
    #[serde(rename = "where")]
    _place: Option<String>,
    #[serde(rename = "note")]
    _note: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Expected {
    quantity: String,
    value: Option<Raw>,
    tolerance: Option<Raw>,
    least: Option<Raw>,
    most: Option<Raw>,
    reason: String,
}

/// Rows of a case file of this format.
pub fn rows(text: &str, simulator: &dyn Simulator) -> Vec<Row> {
    match read(text, simulator) {
        Ok(rows) => rows,
        Err(why) => vec![Row {
            damaged: true,
            ..Row::wrong(format!("wrong: {why}"))
        }],
    }
}

fn read(text: &str, simulator: &dyn Simulator) -> Result<Vec<Row>, String> {
    let file: File = toml::from_str(text).map_err(|error| error.message().to_string())?;
    if file.long && !simulator.long() {
        return Ok(vec![Row::not_run("takes long: auxbear validate --long")]);
    }
    let mut inputs = Inputs {
        values: file.inputs,
    };
    let computed = kinds::compute(&file.kind, &mut inputs, simulator)?;
    let computed = match computed {
        Some(computed) => computed,
        None => {
            return Ok(vec![Row::not_run(format!(
                "kind \"{}\" is not known; known are {}",
                file.kind,
                kinds::NAMES.join(", ")
            ))]);
        }
    };
    inputs.finish()?;
    if file.results.is_empty() {
        return Err("results: at least one is needed".into());
    }
    file.results
        .into_iter()
        .map(|expected| row(expected, &computed))
        .collect()
}

fn row(expected: Expected, computed: &[Computed]) -> Result<Row, String> {
    let name = &expected.quantity;
    // where nothing was run there are no names
    if let [
        Computed {
            quantity,
            value: Err(why),
            ..
        },
    ] = computed
        && quantity.is_empty()
    {
        return Ok(Row::not_run(why.clone()).of(name.clone(), ""));
    }
    let Some(ours) = computed.iter().find(|known| known.quantity == *name) else {
        let known: Vec<&str> = computed
            .iter()
            .map(|known| known.quantity.as_str())
            .collect();
        return Err(format!(
            "results: quantity \"{name}\" is not known; this kind has {}",
            known.join(", ")
        ));
    };
    let given = [&expected.value, &expected.least, &expected.most];
    let mut given = given.into_iter().flatten();
    let (Some(bound), None) = (given.next(), given.next()) else {
        return Err(format!(
            "results of {name}: one of value, least and most is needed"
        ));
    };
    let (reference, unit, factor) = amount(bound, ours.dimension)
        .map_err(|error| format!("results, value of {name}: {error}"))?;
    let value = match &ours.value {
        Ok(value) => value / factor,
        Err(why) => {
            return Ok(Row {
                reference: Some(reference),
                ..Row::not_run(why.clone()).of(name.clone(), unit)
            });
        }
    };
    let tolerance = match (&expected.tolerance, &expected.value) {
        (None, None) if expected.most.is_some() => Tolerance::Most,
        (None, None) => Tolerance::Least,
        (Some(Raw::Number(share)), Some(_)) => Tolerance::Relative(*share),
        (Some(text), Some(_)) => {
            let (value, _, own) = amount(text, ours.dimension)
                .map_err(|error| format!("results, tolerance of {name}: {error}"))?;
            Tolerance::Absolute(value * own / factor)
        }
        _ => {
            return Err(format!(
                "results of {name}: tolerance belongs to a value, and a value has one"
            ));
        }
    };
    Ok(Row::compared(
        name.clone(),
        unit,
        reference,
        value,
        tolerance,
        expected.reason,
    ))
}
