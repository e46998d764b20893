//! Heat, severity and life.

use crate::reference_cases;
use serde_json::{Value, json};
use std::path::Path;
use validate::{LawsOnly, Row, Verdict, compared};

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
    let at =
        |time: f64| json!({"time": time, "temperatures": [20.0 + 80.0 * (-time / 100.0).exp()]});
    let mut file = json!({
        "nodes": ["body"], "capacity": [200.0], "links": [], "grounds": [["body", 2.0, 20.0]],
        "powers": [0.0], "start": [100.0], "time_constants": [100.0], "steady": [20.0],
        "tolerance": 1e-9, "rows": [at(10.0), at(50.0), at(200.0)]
    });
    assert_eq!(count(&rows(&file), Verdict::Pass), 4);
    file["rows"][1]["temperatures"][0] = Value::Null;
    let found = rows(&file);
    let (passed, left) = (count(&found, Verdict::Pass), count(&found, Verdict::NotRun));
    assert_eq!((passed, left, found.len()), (4, 1, 5), "{found:?}");
    assert!(found.iter().all(|row| !row.damaged));
    // a number that is none is wrong
    file["rows"][2]["time"] = json!("x");
    assert!(rows(&file)[0].damaged);
}

fn rows(file: &Value) -> Vec<Row> {
    compared(file, Path::new("heat.json"), &LawsOnly)
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
    let folder = reference_cases();
    for (name, least, spoilt) in FILES {
        let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
        let mut value: Value = serde_json::from_str(&text).unwrap();
        let found = rows(&value);
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
        let found = rows(&value);
        assert!(count(&found, Verdict::Fail) > 0, "{name}: {spoilt}");
    }
}
#[test]
fn no_number_of_a_file_can_panic() {
    let folder = reference_cases();
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
                    for row in rows(&changed) {
                        assert!(!row.why.is_empty(), "{name}: {place}");
                    }
                }
            }
        }
    }
}
