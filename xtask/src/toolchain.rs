//! Guards that are commands of the Rust toolchain: format, lints, documentation, tests.

use crate::repository::{Outcome, Repository};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The cargo that started this tool, in the root of the checkout.
pub fn cargo(repository: &Repository) -> Command {
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(program);
    command.current_dir(&repository.root).stdin(Stdio::null());
    command
}

/// Every source file is as rustfmt writes it.
pub fn format(repository: &Repository) -> Outcome {
    let mut command = cargo(repository);
    command.args(["fmt", "--all", "--check", "--", "--files-with-diff"]);
    let mut outcome = quiet(&mut command);
    for finding in &mut outcome.findings {
        if let Ok(file) = std::path::Path::new(finding.as_str()).strip_prefix(&repository.root) {
            *finding = format!("{}: differs; run cargo fmt --all", file.display());
        }
    }
    outcome
}

/// No lint of the compiler or of clippy, in any target; and nothing that computes asks for a file, a thread or a clock where the library is
/// built without them.
pub fn lints(repository: &Repository) -> Outcome {
    let mut outcome = done(
        repository,
        "clippy --quiet --package auxbear --lib --no-default-features --locked -- \
         -D warnings -D clippy::disallowed_methods -D clippy::disallowed_types",
    );
    let everywhere = "clippy --quiet --profile test --workspace --all-targets --locked";
    let mut command = cargo(repository);
    let mut warned = silent(command.args(everywhere.split(' ')));
    outcome.findings.append(&mut warned.findings);
    outcome
}

/// The program by which `cargo clippy` replaces the compiler; none where it is not found.
fn clippy_driver() -> Option<PathBuf> {
    let asked = Command::new("rustc").args(["--print", "sysroot"]).output();
    let sysroot = String::from_utf8(asked.ok()?.stdout).ok()?;
    let driver = Path::new(sysroot.trim_end()).join("bin/clippy-driver");
    driver.exists().then_some(driver)
}

/// The documentation of the libraries builds without a warning.
///
/// Libraries only: the command and the library share the name `auxbear`, and so would their pages. There are no examples: asked for,
/// they give dependencies the features that lints and tests give them, and what they share is not built again. Libraries that clippy has
/// checked are not checked a second time: it is named as their compiler, without arguments, as in [`lints`].
pub fn pages(repository: &Repository) -> Outcome {
    let words = "doc --quiet --profile test --workspace --lib --examples --no-deps --locked";
    let mut command = cargo(repository);
    if let Some(driver) = clippy_driver() {
        command.env("RUSTC_WORKSPACE_WRAPPER", driver);
        command.env("CLIPPY_ARGS", "");
    }
    quiet((command.args(words.split(' '))).env("RUSTDOCFLAGS", "-D warnings"))
}

/// Every crate that is published can be packed: its manifest says what a registry asks for, and the texts of its licences are with it.
pub fn packages(repository: &Repository) -> Outcome {
    let but = "--exclude auxbear-python --exclude xtask";
    let words = format!("package --quiet --workspace {but} --no-verify --allow-dirty");
    let mut outcome = done(repository, &words);
    let manifests = repository.below("", "/Cargo.toml");
    let published = manifests.filter(|file| {
        let text = repository.text(file).unwrap_or_default();
        text.contains("publish.workspace = true")
    });
    for manifest in published {
        for licence in ["LICENSE-APACHE", "LICENSE-MIT"] {
            let file = manifest.replace("Cargo.toml", licence);
            if repository.text(&file) != repository.text(licence) {
                let finding = format!("{file}: is not a link to {licence}, which is packed");
                outcome.findings.push(finding);
            }
        }
    }
    outcome
}

/// The examples inside the documentation compile and run.
pub fn examples(repository: &Repository) -> Outcome {
    let words = "test --quiet --workspace --doc --no-fail-fast --locked";
    done(repository, words)
}

/// Runs cargo with the words of a line.
fn done(repository: &Repository, words: &str) -> Outcome {
    quiet(cargo(repository).args(words.split(' ')))
}

/// All other tests, with the runner's own lines as the last ones printed; true when all passed.
pub fn tests(repository: &Repository) -> bool {
    let has_nextest = cargo(repository)
        .args(["nextest", "--version"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success());
    let mut command = cargo(repository);
    if has_nextest {
        command.args(["nextest", "run", "--cargo-quiet", "--status-level", "slow"]);
    } else {
        command.args(["test", "--quiet", "--lib", "--bins", "--tests"]);
    }
    command
        .args(["--workspace", "--no-fail-fast", "--locked"])
        .stderr(std::io::stdout()); // one stream, so that the last lines are the last everywhere
    command.status().is_ok_and(|status| status.success())
}

/// Runs a command that says nothing where all is well: a warning is a finding too.
fn silent(command: &mut Command) -> Outcome {
    found_in(command, |output| {
        output.status.success() && output.stderr.is_empty()
    })
}

/// Runs a command; what it printed are the findings when it failed.
pub fn quiet(command: &mut Command) -> Outcome {
    found_in(command, |output| output.status.success())
}

fn found_in(command: &mut Command, is_well: fn(&Output) -> bool) -> Outcome {
    let output = match command.output() {
        Ok(output) => output,
        Err(error) => {
            return Outcome::new(
                "",
                vec![format!("{command:?} could not be started: {error}")],
            );
        }
    };
    if is_well(&output) {
        return Outcome::new("", Vec::new());
    }
    let printed = [output.stdout, output.stderr].concat();
    let mut findings: Vec<String> = String::from_utf8_lossy(&printed)
        .lines()
        .filter(|line| !line.trim().is_empty())
        .map(str::to_owned)
        .collect();
    if findings.is_empty() {
        findings.push(format!("{command:?} ended with {}", output.status));
    }
    Outcome::new("", findings)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_that_fails_is_a_finding_even_when_it_says_nothing() {
        let of = |script: &str| quiet(Command::new("sh").args(["-c", script])).findings;
        assert_eq!(of("exit 3").len(), 1);
        assert_eq!(of("echo a; echo b >&2; exit 1"), ["a", "b"]);
        assert!(of("echo fine").is_empty());
        let lost = quiet(&mut Command::new("no such program"));
        assert_eq!(lost.findings.len(), 1);
    }

    #[test]
    fn a_warning_is_a_finding_where_nothing_should_be_said() {
        let of = |script: &str| silent(Command::new("sh").args(["-c", script])).findings;
        assert!(of("true").is_empty());
        assert_eq!(of("echo 'warning: unused' >&2"), ["warning: unused"]);
        assert_eq!(of("exit 3").len(), 1);
    }
}
