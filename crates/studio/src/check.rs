//! What a text says, as far as it can be read without building: values with their origin, the first mistake, the drawing.

use crate::edit::typed;
use auxbear::outcome::Picture;
use auxbear::outcome::list::List;
use auxbear::outcome::{Quantity, Value as ResultValue};
use auxbear::report::{directory, page};
use auxbear::scenario::{Body, Resolved, ResolvedValue, StudyFile, rotor::FlexibleRotor};
use auxbear::simulate::drawing;
use auxbear::simulate::rotor::RotorModel;
use auxbear::{BuiltIn, Outcome, Place, Problem, Scenario};
use serde_json::{Value, json};
use std::path::Path;

/// Everything that forms and marks of an editor need of a text.
pub fn check(text: &str, path: &Path) -> Value {
    let tree = match typed(text) {
        Ok(tree) => tree,
        Err((message, line)) => return json!({ "syntax": { "message": message, "line": line } }),
    };
    let kind = toml::from_str::<toml::Table>(text).ok();
    let kind = kind
        .as_ref()
        .and_then(crate::folder::kind_of)
        .unwrap_or_default();
    let mut found = json!({ "kind": kind, "typed": tree });
    match kind {
        "study" | "qualify" => {
            let own = StudyFile::parse(text, &path.display().to_string(), path.parent());
            if let Err(problem) = own {
                found["problem"] = of_problem(&problem, path);
            }
        }
        _ => match Scenario::parse(text, &path.display().to_string(), &[], &BuiltIn) {
            Err(problem) => found["problem"] = of_problem(&problem, path),
            Ok(scenario) => {
                found["values"] = of_values(&scenario.resolved);
                found["drawing"] = drawing_of(&scenario).unwrap_or_default().into();
            }
        },
    }
    found
}

/// A problem with the place that an editor marks; its own file is not named.
pub fn of_problem(problem: &Problem, path: &Path) -> Value {
    let own = problem.file == path.display().to_string();
    let (line, column) = match problem.place {
        Place::Line { line, column } if own => (line, column),
        _ => (0, 0),
    };
    let mut said = problem.clone();
    if own {
        said.file = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
    }
    json!({ "message": said.to_string(), "code": problem.code.to_string(), "key": problem.key, "line": line, "column": column })
}

/// Every value with its origin.
fn of_values(resolved: &Resolved) -> Value {
    let of = |value: &ResolvedValue| {
        json!({
            "path": value.path,
            "bearing": value.bearing,
            "text": value.text,
            "si": value.value_si,
            "mark": value.provenance.mark(),
            "note": value.provenance.note(),
        })
    };
    resolved.values.iter().map(of).collect()
}

/// A rotor to scale, as the scripts of a run's page read it; none of what has no shaft, or one that cannot be put together.
fn drawing_of(scenario: &Scenario) -> Option<String> {
    let (rotor, places): (&FlexibleRotor, Vec<(f64, &str)>) = match scenario.drop() {
        None => (&scenario.rotor()?.rotor, Vec::new()),
        Some(drop) => match &drop.body {
            Body::Flexible(shaft) => {
                let at = |place: usize| shaft.rotor.nodes.get(place).map(|node| node.at);
                let own = drop.auxiliary_bearings.iter().zip(&shaft.places);
                let own = own
                    .filter_map(|(bearing, place)| Some((at(place.node)?, bearing.name.as_str())));
                (&shaft.rotor, own.collect())
            }
            Body::Rigid(_) => return None,
        },
    };
    let speed = scenario
        .resolved
        .get("rotor.speed")
        .and_then(|value| value.value_si);
    let model = RotorModel::new(rotor, speed.unwrap_or_default()).ok()?;
    let mut list = List::default();
    drawing::name(&mut list, &model, &[]);
    if let Some(like) = list.quantities.first().cloned() {
        let positions = places.iter().map(|(at, _)| *at).collect();
        list.quantities.push(Quantity {
            name: "bearings".to_string(),
            value: ResultValue::List(positions),
            shown: vec![("bearings", "place".to_string())],
            ..like
        });
    }
    let names: Vec<&str> = places.iter().map(|(_, name)| *name).collect();
    let outcome = Outcome {
        system: "rotor",
        quantities: list.quantities,
        pictures: vec![no_picture()],
        ..Outcome::default()
    };
    let run = directory::page_run(&names.join("\n"), scenario, &outcome).ok()?;
    Some(page::brief(&run))
}

/// Numbers of pictures where there are none.
pub(crate) fn no_picture() -> Picture {
    Picture {
        bearing: String::new(),
        clearance: None,
        pressure_limit: None,
        rolling_cage_ratio: 0.0,
        balls: 0,
    }
}
