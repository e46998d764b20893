//! What is declared without a run is what a run has: the columns of its history, the keys of its summary.

use crate::outcomes::has_declared_columns;
use crate::scenario::schema::right;
use auxbear::report::{directory, schema};
use auxbear::run::{Options, build};
use auxbear::scenario::{BuiltIn, Scenario, System};
use serde_json::Value;
use std::path::Path;
use std::sync::atomic::AtomicBool;

fn summary_schema() -> Value {
    serde_json::from_str(&schema::schema(schema::SUMMARY).unwrap()).unwrap()
}

/// Runs a shipped scenario and compares; whether it ended as planned.
fn checked(file: &str, sets: &[&str], interrupt: bool) -> bool {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenarios/{file}.toml"));
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    let scenario = Scenario::read(&path, &sets, &BuiltIn).expect(file);
    let interrupt = AtomicBool::new(interrupt);
    let machine = build(&scenario).expect(file);
    let outcome = machine.run(&Options::unwatched(&interrupt));
    has_declared_columns(&scenario, &outcome);
    let summary = directory::summary_text(&scenario, &outcome).unwrap();
    let summary = serde_json::from_str(&summary).unwrap();
    assert!(right(&summary_schema(), &summary), "{file}");
    outcome.stop.complete()
}

#[test]
fn every_shipped_machine_in_time_has_its_declared_columns() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let mut count = 0;
    for entry in folder.read_dir().unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let Ok(scenario) = Scenario::read(&path, &[], &BuiltIn) else {
            continue;
        };
        let is_drop = matches!(scenario.system, System::Drop(_));
        let moves = matches!(
            scenario.system,
            System::SpinUp(_) | System::Rig(_) | System::CoastDown(_)
        );
        if is_drop || moves {
            let once = ["repeat.count=1"];
            checked(&name, &once[..usize::from(is_drop)], true);
            count += 1;
        }
    }
    assert!(count >= 27, "{count}");
}

#[test]
fn a_run_that_ends_has_its_declared_columns() {
    for (file, sets) in [
        ("spin_up_warming", &["run.duration=50 ms"][..]),
        ("spin_up_rolling", &[]),
        ("rig_test_3_warming", &["run.duration=300 ms"]),
        ("coast_down_vacuum", &[]),
        ("drop_whirl_closing", &["run.duration=20 ms"]),
        ("oil_lubricated_drop", &["run.duration=5 ms"]),
        ("land_guided_cage_drop", &["run.duration=10 ms"]),
        ("full_complement_drop", &["run.duration=10 ms"]),
        (
            "two_bearings_drop",
            &["run.duration=10 ms", "repeat.count=3"],
        ),
        ("machine_expander", &["run.duration=10 ms"]),
        ("amb_rig_drop", &["run.duration=2 ms"]),
        ("torque_6005", &[]),
        ("rotor_52_elements", &[]),
    ] {
        assert!(checked(file, sets, false), "{file}");
    }
}

#[test]
fn a_key_that_the_schema_of_summaries_lacks_is_found() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/torque_6005.toml");
    let scenario = Scenario::read(&path, &[], &BuiltIn).unwrap();
    let outcome = auxbear::run::run(&scenario, &Options::unwatched(&AtomicBool::new(false)));
    let text = directory::summary_text(&scenario, &outcome.unwrap()).unwrap();
    let whole: Value = serde_json::from_str(&text).unwrap();
    for (place, key) in [("", "more"), ("/work", "more"), ("/stop", "when")] {
        let mut summary = whole.clone();
        summary.pointer_mut(place).unwrap()[key] = Value::from(1);
        assert!(!right(&summary_schema(), &summary), "{place} {key}");
    }
    let mut summary = whole.clone();
    summary["quantities"]["friction"] = Value::from(1);
    assert!(!right(&summary_schema(), &summary));
    assert!(described(&summary_schema()["properties"]) > 60);
}

/// Number of keys with all below them; each has its description.
fn described(properties: &Value) -> usize {
    let each = properties.as_object().into_iter().flatten();
    each.map(|(name, schema)| {
        assert!(schema["description"].is_string(), "{name}");
        let inner = [&schema["items"], &schema["additionalProperties"], schema];
        let below = inner.iter().map(|inner| described(&inner["properties"]));
        1 + below.sum::<usize>()
    })
    .sum()
}
