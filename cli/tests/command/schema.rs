//! `auxbear schema`.

use crate::place::Place;
use serde_json::Value;

#[test]
fn every_kind_of_file_has_a_schema() {
    let place = Place::new();
    for kind in [
        "drop", "spin_up", "torque", "signals", "rig", "identify", "rotor",
    ] {
        let text = place.call(&["schema", kind]).done().out;
        let schema: Value = serde_json::from_str(&text).unwrap();
        assert!(schema["$schema"].as_str().unwrap().contains("2020-12"));
        assert_eq!(schema["additionalProperties"], false);
        assert_eq!(schema["properties"]["system"]["examples"][0], kind);
    }
    assert!(place.names().is_empty());
}

#[test]
fn other_kinds_are_distinguished() {
    let place = Place::new();
    for (kind, code, words) in [
        ("drp", "AB0108", "Did you mean \"drop\"?"),
        ("mount", "AB0112", "planned"),
    ] {
        let called = place.call(&["schema", kind]);
        assert_eq!(called.code, Some(2), "{called:?}");
        assert!(
            called.err.contains(code) && called.err.contains(words),
            "{called:?}"
        );
        assert!(called.out.is_empty());
    }
}

#[test]
fn results_and_columns_are_listed_before_a_run() {
    let place = Place::new();
    let listed = place.call(&["results", "drop.toml"]).done().out;
    let (results, columns) = listed.split_once("\n\nColumns of the history:\n").unwrap();
    let names = |text: &str| -> Vec<String> {
        let lines = text.lines().take_while(|line| !line.is_empty());
        lines
            .map(|line| line.split(' ').next().unwrap().to_string())
            .collect()
    };
    place.short_run(&["--out", "run"]).done();
    let run = place.read("run");
    let found: Vec<&str> = run.columns.iter().map(|column| &*column.name).collect();
    assert_eq!(names(columns), found);
    for (line, column) in columns.lines().zip(&run.columns) {
        let rest = line.strip_prefix(&column.name).unwrap().trim_start();
        let meaning = rest.strip_prefix(&column.unit).unwrap().trim_start();
        assert_eq!(meaning, column.meaning);
    }
    let summary = place.summary("run");
    let found = summary["quantities"].as_object().unwrap();
    assert!(names(results).iter().all(|name| found.contains_key(name)));
    let schema: Value =
        serde_json::from_str(&place.call(&["schema", "summary"]).done().out).unwrap();
    let known = schema["properties"].as_object().unwrap();
    assert!((summary.as_object().unwrap().keys()).all(|key| known[key]["description"].is_string()));
}
