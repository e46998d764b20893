//! Every shipped case and every reference file is met; what is wrong with files is said.

mod cases;
mod drops;
mod files;
mod heat;
mod magnets;
mod points;
mod report;
mod rotors;

/// A private page with tests of its own: the crate is not compiled once more for them.
#[path = "../../src/levitated/accept.rs"]
mod accept;

use serde_json::Value;
use std::path::{Path, PathBuf};
use validate::{Simulation, Verdict, run};

/// The folder of reference cases, which are no part of the program.
fn reference_cases() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/cases")
}

/// The path of a file of the reference implementation.
fn reference(name: &str) -> PathBuf {
    reference_cases().join(format!("reference/{name}.json"))
}

/// Such a file.
fn read(name: &str) -> Value {
    let text = std::fs::read_to_string(reference(name)).expect("a reference");
    serde_json::from_str(&text).expect("JSON")
}

/// The text of a case that ships.
fn shipped_text(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    std::fs::read_to_string(folder.join(format!("{name}.toml"))).expect("a case")
}

/// The names of the cases that ship.
fn shipped() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let files = std::fs::read_dir(folder).expect("cases");
    let names = files.map(|file| file.expect("a case").path());
    let names = names.filter(|path| path.extension().is_some_and(|end| end == "toml"));
    let names = names.filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()));
    names.collect()
}

/// The shipped cases are part of every run: they are computed once.
#[test]
fn reference_files_are_met() {
    // AUXBEAR_SEEDS: what takes long as well
    let long = std::env::var_os("AUXBEAR_SEEDS").is_some();
    let report = run(Some(&reference_cases()), &Simulation { long }).expect("readable cases");
    let failed: Vec<String> = report
        .cases
        .iter()
        .filter(|row| row.verdict == Verdict::Fail)
        .map(|row| format!("{row:?}"))
        .collect();
    assert!(failed.is_empty(), "{failed:#?}");
    let shipped = shipped();
    let passed = report
        .cases
        .iter()
        .filter(|row| row.verdict == Verdict::Pass);
    let (own, references): (Vec<_>, Vec<_>) = passed.partition(|row| shipped.contains(&row.case));
    assert!(
        own.len() >= 68,
        "only {} rows of shipped cases passed",
        own.len()
    );
    for (case, quantities) in [
        ("hertz", 12..13),
        ("rolling", 18..19),
        ("faults_runs", 101..500),
    ] {
        let own = references.iter().filter(|row| row.case == case).count();
        assert!(quantities.contains(&own), "{case}: {own}");
    }
    let passed = own.len() + references.len();
    assert!(passed >= 100, "only {passed} rows passed");
}
