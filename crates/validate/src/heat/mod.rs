//! Heat, severity and life: rows of closed forms, moving sources, ball loads, wear and fatigue by their `kind`; a network of
//! bodies; printed counts of cycles; thermal reference speeds; worked life examples. Tolerances are those that each file states.

mod catalogue;
mod coast;
mod conduction;
mod cycles;
mod fatigue;
mod moving;
mod network;
mod runaway;
mod severity;
mod skid;
mod surroundings;
mod tally;
mod warm;

use super::compare::{Refusal, rows_of};
use super::json;
use super::report::Row;
use serde_json::Value;
use tally::{Compare, Tally};

/// Rows of a file; `None` when its keys are those of another.
pub(super) fn rows(value: &Value) -> Option<Vec<Row>> {
    let compare = of_file(value)?;
    let mut tally = Tally::new(value);
    let found = compare(value, &mut tally);
    Some(rows_of(
        found.map(|()| tally.into_rows()).map_err(Refusal::from),
    ))
}

/// The comparison of a whole file, by its keys.
fn of_file(value: &Value) -> Option<Compare> {
    let top = value.as_object()?;
    let has = |keys: &[&str]| keys.iter().all(|key| top.contains_key(*key));
    if has(&["capacity", "links", "grounds", "rows"]) {
        return Some(network::compare);
    }
    if has(&["series", "results"]) && value["results"]["counts_by_range"].is_object() {
        return Some(cycles::by_range);
    }
    if let Some(inputs) = top.get("cases").map(|cases| &cases[0]["inputs"]) {
        return cases_of(inputs);
    }
    let rows = top.get("rows")?.as_array()?;
    let any = |of: &dyn Fn(&Value) -> bool| rows.iter().any(of);
    if any(&|row| {
        row["kind"]
            .as_str()
            .is_some_and(|kind| of_kind(kind).is_some())
    }) {
        Some(by_kind)
    } else if any(&|row| row["reference_speed_rpm"].is_number() && row["bore_mm"].is_number()) {
        Some(surroundings::compare)
    } else if any(&catalogue::is_example) {
        Some(catalogue::compare)
    } else {
        None
    }
}

/// The comparison of a file of cases, by the inputs of the first.
fn cases_of(inputs: &Value) -> Option<Compare> {
    let has = |key: &str| !inputs[key].is_null();
    if has("E_stop") && has("race") {
        Some(skid::compare)
    } else if has("stop_speed") && has("share_M0") {
        Some(coast::compare)
    } else if has("Pd0") && has("share_M0") {
        Some(runaway::compare)
    } else {
        None
    }
}

fn of_kind(kind: &str) -> Option<Compare> {
    conduction::of_kind(kind)
        .or_else(|| moving::of_kind(kind))
        .or_else(|| severity::of_kind(kind))
        .or_else(|| fatigue::of_kind(kind))
        .or_else(|| cycles::of_kind(kind))
}

fn by_kind(file: &Value, tally: &mut Tally) -> Result<(), String> {
    for (at, row) in json::list(file, "rows")?.iter().enumerate() {
        tally.row(&format!("row {}", at + 1), row, |tally| {
            let kind = json::text(row, "kind")?;
            match of_kind(kind) {
                Some(compare) => compare(row, tally)?,
                None => tally.leave_out(kind, "a kind of row that is not known"),
            }
            Ok(())
        })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Row, Verdict};
    use serde_json::json;
    use std::path::Path;

    /// Files with the least number of quantities that must pass, and one number to spoil.
    const FILES: [(&str, usize, &str); 10] = [
        ("reference/heat_closed_forms", 13, "/rows/0/rise"),
        ("reference/heat_moving_sources", 12, "/rows/0/mean"),
        ("reference/heat_network", 4, "/rows/0/temperatures/1"),
        ("reference/heat_coast", 13, "/cases/0/results/rows/5/inner"),
        (
            "reference/heat_runaway",
            10,
            "/cases/2/results/end_preload_per_ball",
        ),
        (
            "reference/heat_skid",
            14,
            "/cases/1/results/rows/3/rotor_energy",
        ),
        ("reference/severity_life", 26, "/rows/0/load"),
        ("published/rainflow_astm_e1049", 2, "/series/3"),
        (
            "published/life_catalogue_examples",
            18,
            "/rows/0/results/hours",
        ),
        (
            "published/iso15312_thermal_reference_speeds",
            1,
            "/rows/7/outside_mm",
        ),
    ];

    /// A body that cools alone, T = 20 + 80 e^(-t/100): each null leaves out its own row.
    #[test]
    fn a_null_leaves_out_its_own_row_alone() {
        let at = |time: f64| json!({"time": time, "temperatures": [20.0 + 80.0 * (-time / 100.0).exp()]});
        let mut file = json!({
            "nodes": ["body"], "capacity": [200.0], "links": [], "grounds": [["body", 2.0, 20.0]],
            "powers": [0.0], "start": [100.0], "time_constants": [100.0], "steady": [20.0],
            "tolerance": 1e-9, "rows": [at(10.0), at(50.0), at(200.0)]
        });
        assert_eq!(count(&rows(&file).unwrap(), Verdict::Pass), 4);
        file["rows"][1]["temperatures"][0] = Value::Null;
        let found = rows(&file).unwrap();
        let (passed, left) = (count(&found, Verdict::Pass), count(&found, Verdict::NotRun));
        assert_eq!((passed, left, found.len()), (4, 1, 5), "{found:?}");
        assert!(found.iter().all(|row| !row.damaged));
        // a number that is none is wrong
        file["rows"][2]["time"] = json!("x");
        assert!(rows(&file).unwrap()[0].damaged);
    }

    fn count(rows: &[Row], verdict: Verdict) -> usize {
        rows.iter().filter(|row| row.verdict == verdict).count()
    }

    /// Every number of a value, by its place.
    fn numbers(value: &Value, place: &str, found: &mut Vec<String>) {
        match value {
            Value::Number(_) => found.push(place.to_string()),
            Value::Array(list) => list.iter().enumerate().for_each(|(at, inner)| {
                numbers(inner, &format!("{place}/{at}"), found);
            }),
            Value::Object(table) => table.iter().for_each(|(key, inner)| {
                numbers(inner, &format!("{place}/{key}"), found);
            }),
            _ => {}
        }
    }

    /// The file with one row alone, once for each kind of row; of a file of cases the first, short.
    fn of_one_row(file: &Value) -> Vec<Value> {
        if file["cases"].is_array() {
            let mut alone = file.clone();
            let mut case = file["cases"][0].clone();
            for list in ["/inputs/times", "/results/rows"] {
                let list = case.pointer_mut(list).unwrap();
                list.as_array_mut().unwrap().truncate(2);
            }
            alone["cases"] = json!([case]);
            return vec![alone];
        }
        let Some(list) = file["rows"].as_array() else {
            return vec![file.clone()];
        };
        let mut kinds = Vec::new();
        let mut files = Vec::new();
        for row in list {
            let kind = row.get("kind").or(row.get("name"));
            if !kinds.contains(&kind) {
                kinds.push(kind);
                let mut alone = file.clone();
                alone["rows"] = json!([row]);
                files.push(alone);
            }
        }
        files
    }

    #[test]
    fn the_laws_meet_the_files_and_a_changed_file_fails() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/cases");
        for (name, least, spoilt) in FILES {
            let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
            let mut value: Value = serde_json::from_str(&text).unwrap();
            let found = rows(&value).unwrap();
            for row in &found {
                println!(
                    "{name}: {} {:.1e} of {:.1e}, {}: {}",
                    row.quantity,
                    row.deviation.unwrap_or_default(),
                    row.tolerance.unwrap_or_default(),
                    row.verdict.word(),
                    row.why,
                );
            }
            assert_eq!(count(&found, Verdict::Fail), 0, "{name}");
            let passed = count(&found, Verdict::Pass);
            assert!(passed >= least, "{name}: {passed}");
            let number = value.pointer_mut(spoilt).unwrap();
            *number = json!(number.as_f64().unwrap() * 1.2 + 0.1);
            let found = rows(&value).unwrap();
            assert!(count(&found, Verdict::Fail) > 0, "{name}: {spoilt}");
        }
    }
    #[test]
    fn no_number_of_a_file_can_panic() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/cases");
        for (name, ..) in FILES {
            let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
            let value: Value = serde_json::from_str(&text).unwrap();
            for value in of_one_row(&value) {
                let mut places = Vec::new();
                numbers(&value, "", &mut places);
                for place in places {
                    for other in [json!(0), json!(-1), json!(1e300), json!("x")] {
                        let mut changed = value.clone();
                        *changed.pointer_mut(&place).unwrap() = other;
                        for row in rows(&changed).unwrap_or_default() {
                            assert!(!row.why.is_empty(), "{name}: {place}");
                        }
                    }
                }
            }
        }
    }
}
