//! `cargo xtask check`: the guards one after the other, the tests last.

use crate::repository::{Outcome, Repository};
use crate::{
    advisories, architecture, book, documentation, licences, python, result_names, scenarios,
    source_text, suites, toolchain,
};
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::Instant;

/// Where a full check that passed writes the commit that it passed on.
const PASSED: &str = "target/check-passed";

/// How much is checked.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// The guards that build nothing of the product.
    Fast,
    /// All guards and all tests.
    Full,
}

type Guard = (&'static str, fn(&Repository) -> Outcome);

const FAST: [Guard; 9] = [
    ("architecture page", architecture::check),
    ("book", book::check),
    ("documentation rules", documentation::check),
    ("source text", source_text::check),
    ("names of results", result_names::check),
    ("test files", suites::check),
    ("licences", licences::check),
    ("advisories", advisories::check),
    ("format", toolchain::format),
];

const SLOW: [Guard; 2] = [
    ("lints", toolchain::lints),
    ("documentation pages", toolchain::pages),
];

/// Each of these leaves a core idle for a part of its time.
static SIDE_BY_SIDE: [Guard; 4] = [
    ("scenarios", scenarios::check),
    ("packages", toolchain::packages),
    ("Python", python::check),
    ("documentation examples", toolchain::examples),
];

/// Runs the guards and prints a line for each, and every finding.
pub fn run(extent: Extent) -> Result<(), String> {
    let repository = Repository::open()?;
    let mut failed = failures(&FAST, &repository);
    if extent == Extent::Fast {
        return verdict(failed.is_empty());
    }
    let begun = commit(&repository.root);
    failed.extend(failures(&SLOW, &repository));
    let beside = thread::scope(|scope| {
        let side = |guard: &'static Guard| {
            let repository = &repository;
            scope.spawn(move || failures(std::slice::from_ref(guard), repository))
        };
        let begun = SIDE_BY_SIDE.each_ref().map(side);
        begun.map(|own| own.join().unwrap_or_else(|_| vec!["a guard panicked"]))
    });
    failed.extend(beside.concat());
    if !failed.is_empty() {
        println!("with findings: {}", failed.join(", "));
    }
    println!("tests: the runner's own lines follow");
    let passed = toolchain::tests(&repository) && failed.is_empty();
    if passed && begun.is_some() && begun == commit(&repository.root) {
        note(&repository.root, &begun.unwrap_or_default())?;
    }
    verdict(passed)
}

/// The commit whose tree this is; none where files differ from it, or git cannot say.
fn commit(root: &Path) -> Option<String> {
    let said = |arguments: &[&str]| {
        let mut git = Command::new("git");
        let output = git.args(arguments).current_dir(root).output().ok()?;
        (output.status.success()).then(|| String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let changes = said(&["status", "--porcelain"])?;
    changes.is_empty().then(|| said(&["rev-parse", "HEAD"]))?
}

/// Writes the commit that a check passed on.
fn note(root: &Path, commit: &str) -> Result<(), String> {
    let place = root.join(PASSED);
    let done = std::fs::create_dir_all(place.with_file_name(""));
    let done = done.and_then(|()| std::fs::write(place, commit));
    done.map_err(|error| format!("{PASSED}: {error}"))
}

fn verdict(is_clean: bool) -> Result<(), String> {
    match is_clean {
        true => Ok(()),
        false => Err("the check failed".to_owned()),
    }
}

/// The names of the guards that found something.
fn failures(guards: &[Guard], repository: &Repository) -> Vec<&'static str> {
    let mut failed = Vec::new();
    for (name, guard) in guards {
        let start = Instant::now();
        let outcome = guard(repository);
        let mut lines = line(name, &outcome, start.elapsed().as_secs());
        for finding in &outcome.findings {
            lines.push_str(&format!("\n    {finding}"));
        }
        println!("{lines}");
        if !outcome.findings.is_empty() {
            failed.push(*name);
        }
    }
    failed
}

fn line(name: &str, outcome: &Outcome, seconds: u64) -> String {
    let is_clean = outcome.findings.is_empty();
    let verdict = if is_clean { "ok  " } else { "FAIL" };
    let mut notes = Vec::new();
    if is_clean && !outcome.seen.is_empty() {
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
    fn only_a_tree_without_changes_has_a_commit_that_is_noted() {
        let folder = std::env::temp_dir().join(format!("auxbear-check-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let git = |arguments: &[&str]| {
            let mut command = Command::new("git");
            // a repository that the caller's environment names is another one
            command.env_remove("GIT_DIR").env_remove("GIT_WORK_TREE");
            let author = ["-c", "user.name=a", "-c", "user.email=a@b.c"];
            let output = command.args(author).args(arguments).current_dir(&folder);
            assert!(output.output().unwrap().status.success(), "{arguments:?}");
        };
        assert_eq!(commit(&folder), None, "no repository");
        git(&["init", "--quiet"]);
        std::fs::write(folder.join(".gitignore"), "/target\n").unwrap();
        assert_eq!(commit(&folder), None, "a new file");
        git(&["add", "."]);
        git(&["commit", "--quiet", "--message", "first"]);
        let first = commit(&folder).unwrap();
        assert_eq!(first.trim().len(), 40);
        note(&folder, &first).unwrap();
        assert_eq!(std::fs::read_to_string(folder.join(PASSED)).unwrap(), first);
        assert_eq!(
            commit(&folder).as_ref(),
            Some(&first),
            "the note is ignored"
        );
        std::fs::write(folder.join(".gitignore"), "/target\n/runs\n").unwrap();
        assert_eq!(commit(&folder), None, "a change");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_line_names_guard_verdict_and_count() {
        assert_eq!(line("text", &clean(&empty()), 0), "ok   text (3 files)");
        assert_eq!(line("text", &faulty(&empty()), 7), "FAIL text (7 s)");
    }
}
