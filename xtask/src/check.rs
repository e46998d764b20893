//! `cargo xtask check`: the guards one after the other, the tests last.

use crate::repository::{Outcome, Repository};
use crate::{
    architecture, book, circles, crate_directions, documentation, licences, module_order, python,
    scenarios, source_text, suites, toolchain, validation_cases,
};
use std::process::ExitCode;
use std::time::Instant;

/// How much is checked.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// The guards that build nothing of the product.
    Fast,
    /// All guards and all tests.
    Full,
}

type Guard = (&'static str, fn(&Repository) -> Outcome);

const FAST: [Guard; 11] = [
    ("crate directions", crate_directions::check),
    ("module order", module_order::check),
    ("no circles", circles::check),
    ("reference cases", validation_cases::check),
    ("architecture page", architecture::check),
    ("book", book::check),
    ("documentation rules", documentation::check),
    ("source text", source_text::check),
    ("test files", suites::check),
    ("licences", licences::check),
    ("format", toolchain::format),
];

const SLOW: [Guard; 5] = [
    ("lints", toolchain::lints),
    ("documentation pages", toolchain::pages),
    ("scenarios", scenarios::check),
    ("Python", python::check),
    ("documentation examples", toolchain::examples),
];

/// Runs the guards and prints a line for each, and every finding.
pub fn run(extent: Extent) -> ExitCode {
    let repository = match Repository::open() {
        Ok(repository) => repository,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    let mut failed = failures(&FAST, &repository);
    if extent == Extent::Fast {
        return verdict(failed.is_empty());
    }
    failed.extend(failures(&SLOW, &repository));
    if !failed.is_empty() {
        println!("with findings: {}", failed.join(", "));
    }
    println!("tests: the runner's own lines follow");
    let passed = toolchain::tests(&repository);
    verdict(passed && failed.is_empty())
}

fn verdict(is_clean: bool) -> ExitCode {
    if is_clean {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

/// The names of the guards that found something.
fn failures(guards: &[Guard], repository: &Repository) -> Vec<&'static str> {
    let mut failed = Vec::new();
    for (name, guard) in guards {
        let start = Instant::now();
        let outcome = guard(repository);
        println!("{}", line(name, &outcome, start.elapsed().as_secs()));
        for finding in &outcome.findings {
            println!("    {finding}");
        }
        if !outcome.findings.is_empty() {
            failed.push(*name);
        }
    }
    failed
}

fn line(name: &str, outcome: &Outcome, seconds: u64) -> String {
    let verdict = if outcome.findings.is_empty() {
        "ok  "
    } else {
        "FAIL"
    };
    let mut notes = Vec::new();
    if outcome.findings.is_empty() && !outcome.seen.is_empty() {
        notes.push(outcome.seen.clone());
    }
    if seconds >= 2 {
        notes.push(format!("{seconds} s"));
    }
    if notes.is_empty() {
        format!("{verdict} {name}")
    } else {
        format!("{verdict} {name} ({})", notes.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clean(_: &Repository) -> Outcome {
        Outcome::new("3 files", Vec::new())
    }

    fn faulty(_: &Repository) -> Outcome {
        Outcome::new("", vec!["a.rs:1: wrong".to_owned()])
    }

    fn empty() -> Repository {
        Repository {
            root: std::path::PathBuf::from("."),
            files: Vec::new(),
        }
    }

    #[test]
    fn every_guard_runs_after_a_finding_and_the_finding_counts() {
        let guards: [Guard; 3] = [("first", faulty), ("second", clean), ("third", faulty)];
        assert_eq!(failures(&guards, &empty()), ["first", "third"]);
    }

    #[test]
    fn a_line_names_guard_verdict_and_count() {
        assert_eq!(line("text", &clean(&empty()), 0), "ok   text (3 files)");
        assert_eq!(line("text", &faulty(&empty()), 7), "FAIL text (7 s)");
    }
}
