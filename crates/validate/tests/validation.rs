//! Every shipped case and every reference file is met.

use std::path::{Path, PathBuf};
use validate::{Simulation, Verdict, run};

/// The folder of reference cases, which are no part of the program.
fn reference_cases() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/cases")
}

fn assert_nothing_fails(folder: Option<&Path>, least: usize) {
    let report = run(folder, &Simulation).expect("readable cases");
    let failed: Vec<String> = report
        .cases
        .iter()
        .filter(|row| row.verdict == Verdict::Fail)
        .map(|row| format!("{row:?}"))
        .collect();
    assert!(failed.is_empty(), "{failed:#?}");
    let passed = report
        .cases
        .iter()
        .filter(|row| row.verdict == Verdict::Pass)
        .count();
    assert!(passed >= least, "only {passed} rows passed");
}

#[test]
fn shipped_cases_are_met() {
    assert_nothing_fails(None, 68);
}

#[test]
fn reference_files_are_met() {
    assert_nothing_fails(Some(&reference_cases()), 100);
}
