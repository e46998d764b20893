//! Members of a repetition that are kept, and what a run goes on from.

use crate::machine::STIFF;
use auxbear::report::directory::NewDirectory;
use auxbear::run::{Options, build};
use auxbear::scenario::{BuiltIn, Scenario};
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;

const BLADE: &str = include_str!("../../../scenarios/machine_blade_loss.toml");

fn read(path: &Path, sets: &[&str]) -> Scenario {
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    Scenario::read(path, &sets, &BuiltIn).unwrap()
}

/// Runs all members and leaves them as a kill after the last of them does; gives the codes of what they warn of.
fn left(path: &Path, scenario: &Scenario) -> Vec<&'static str> {
    let machine = build(scenario).unwrap();
    let directory = NewDirectory::of_run(path, scenario, machine.members()).unwrap();
    let never = AtomicBool::new(false);
    let outcome = machine.run_kept(&Options::unwatched(&never), directory.store());
    assert!(outcome.stop.complete(), "{:?}", outcome.stop);
    outcome.warnings.iter().map(|own| own.code).collect()
}

#[test]
fn a_warning_whose_grade_has_no_bound_loses_no_member() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("machine.toml");
    fs::write(&file, BLADE).unwrap();
    let scenario = read(&file, &["run.duration=30 ms", "repeat.count=3"]);
    let out = folder.path().join("out");
    // their magnets have power throughout: how long is no number
    assert!(left(&out, &scenario).contains(&"AB2035"));
    let again = NewDirectory::of_run(&out, &scenario, 3).unwrap();
    assert_eq!(again.there, 3);
}

#[test]
fn other_contents_of_a_file_are_another_run() {
    let folder = tempfile::tempdir().unwrap();
    let record = folder.path().join("record.csv");
    let shaken = |peak: f64| {
        fs::write(&record, format!("time [s],y [m/s^2]\n0,0\n0.001,{peak}\n")).unwrap();
    };
    let file = folder.path().join("machine.toml");
    let base = "[base]\nfile = \"record.csv\"\nchannel_y = \"y\"\n";
    fs::write(&file, format!("{STIFF}\n{base}")).unwrap();
    let out = folder.path().join("out");
    shaken(5.0);
    let scenario = read(&file, &["run.duration=1 ms", "repeat.count=2"]);
    left(&out, &scenario);
    shaken(60.0);
    let refused = NewDirectory::of_run(&out, &scenario, 2).unwrap_err();
    assert!(
        refused.to_string().contains("contents of a file"),
        "{refused}"
    );
    // nothing of them is lost
    shaken(5.0);
    let again = NewDirectory::of_run(&out, &scenario, 2).unwrap();
    assert_eq!(again.there, 2);
    drop(again);
    // and what is damaged is said, never written over
    let part = folder.path().join("out.partial/members/0000.parquet");
    let mut bytes = fs::read(&part).unwrap();
    let middle = bytes.len() / 2;
    bytes.truncate(middle);
    fs::write(&part, &bytes).unwrap();
    let refused = NewDirectory::of_run(&out, &scenario, 2).unwrap_err();
    assert!(refused.to_string().contains("0000.parquet"), "{refused}");
    assert_eq!(fs::read(&part).unwrap().len(), middle);
}
