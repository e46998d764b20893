//! Golden values: what some shipped scenarios gave last time, in `xtask/golden.json`, which also decides what is compared: to add a
//! result write its name with `null`. Compared with 1e-9, the work exactly; a change that is meant is written by
//! `cargo xtask golden`, and its difference is reviewed.
//!
//! Only what is reproducible is kept: first impacts, times of the spin-up, energies of smooth runs. The program compared with
//! itself is a regression test, no validation.

use crate::repository::Repository;
use crate::shipped;
use serde_json::{Map, Value, json};
use std::path::Path;

/// Where the values stand.
pub const FILE: &str = "xtask/golden.json";

/// Largest relative difference: the last digits that another compiler may round in another way.
const TOLERANCE: f64 = 1e-9;

/// Counts of work that must be the same.
const WORK: [&str; 3] = ["steps", "rejected", "rate_calls"];

/// What a summary holds of the results that golden values of a scenario name.
fn kept(golden: &Value, summary: &Value) -> Value {
    let of = |names: &mut dyn Iterator<Item = &str>, found: &dyn Fn(&str) -> Value| -> Value {
        let known = names.map(|name| (name.to_owned(), found(name)));
        known
            .filter(|(_, value)| !value.is_null())
            .collect::<Map<_, _>>()
            .into()
    };
    let mut names = golden["quantities"]
        .as_object()
        .into_iter()
        .flat_map(Map::keys)
        .map(String::as_str);
    json!({
        "quantities": of(&mut names, &|name| summary["quantities"][name]["value"].clone()),
        "work": of(&mut WORK.into_iter(), &|count| summary["work"][count].clone()),
    })
}

/// Golden values by scenario.
fn values(repository: &Repository) -> Result<Map<String, Value>, String> {
    let text = repository.text(FILE).unwrap_or_default();
    serde_json::from_str(&text).map_err(|error| format!("{FILE}: {error}"))
}

/// Differences of a scenario's run from its golden values; none where it has no golden values.
pub fn differences(repository: &Repository, scenario: &str, summary: &Value) -> Vec<String> {
    match values(repository) {
        Ok(golden) => (golden.get(scenario))
            .map_or_else(Vec::new, |golden| compare(golden, &kept(golden, summary))),
        Err(error) => vec![error],
    }
}

fn compare(golden: &Value, found: &Value) -> Vec<String> {
    let mut differences = Vec::new();
    for (group, tolerance) in [("quantities", TOLERANCE), ("work", 0.0)] {
        let (was, is) = (golden[group].as_object(), found[group].as_object());
        let (Some(was), Some(is)) = (was, is) else {
            return vec![format!(
                "no golden values in {FILE}: cargo xtask golden writes them"
            )];
        };
        let names = was
            .keys()
            .chain(is.keys().filter(|name| !was.contains_key(*name)));
        for name in names {
            let number = |map: &Map<String, Value>| map.get(name).and_then(Value::as_f64);
            let same = match (number(was), number(is)) {
                (Some(was), Some(is)) => (was - is).abs() <= tolerance * was.abs(),
                _ => false,
            };
            if !same {
                let text = |map: &Map<String, Value>| {
                    map.get(name).map_or("nothing".to_owned(), Value::to_string)
                };
                differences.push(format!(
                    "{name} was {} and is {}; where that is meant, cargo xtask golden writes it",
                    text(was),
                    text(is)
                ));
            }
        }
    }
    differences
}

/// Golden values of runs in a folder, as the file has them.
pub fn of_runs(repository: &Repository, runs: &Path) -> Result<String, String> {
    let mut golden = values(repository)?;
    for (name, values) in &mut golden {
        *values = kept(values, &shipped::summary_in(&runs.join(name))?);
        if values["quantities"].as_object().is_none_or(Map::is_empty) {
            return Err(format!("{name} has none of the results that {FILE} names"));
        }
    }
    let text = serde_json::to_string_pretty(&golden).map_err(|error| error.to_string())?;
    Ok(text + "\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_value_and_a_changed_count_are_found() {
        let golden = json!({ "quantities": { "a": 1.0 }, "work": { "steps": 10 } });
        assert!(compare(&golden, &golden).is_empty());
        let other = json!({ "quantities": { "a": 1.0 + 1e-8 }, "work": { "steps": 11 } });
        assert_eq!(compare(&golden, &other).len(), 2);
        let missing = json!({ "quantities": {}, "work": { "steps": 10 } });
        assert_eq!(compare(&golden, &missing).len(), 1);
        assert_eq!(compare(&Value::Null, &golden).len(), 1);
    }
}
