//! Guard: the built command reads and runs every shipped scenario, and its validation passes.

use crate::repository::{Outcome, Repository};
use crate::toolchain::{cargo, quiet};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Builds the command as users do, then runs it on every file of `scenarios/`.
pub fn check(repository: &Repository) -> Outcome {
    let program = match build(repository) {
        Ok(program) => program,
        Err(findings) => return Outcome::new("", findings),
    };
    let folder = std::env::temp_dir().join(format!("auxbear-check-{}", std::process::id()));
    if let Err(error) = std::fs::create_dir_all(&folder) {
        return Outcome::new("", vec![format!("{}: {error}", folder.display())]);
    }
    let mut findings = Vec::new();
    let files: Vec<&str> = repository.below("scenarios/", ".toml").collect();
    for file in &files {
        let name = Path::new(file).file_stem().unwrap_or_default();
        let out = folder.join(name);
        let out = out.to_string_lossy();
        findings.extend(call(repository, &program, &["check", file]));
        findings.extend(call(
            repository,
            &program,
            &["run", file, "--quiet", "--out", &out],
        ));
    }
    // Nothing depends on the folder any more; one that stays behind is no fault of the product.
    let _ = std::fs::remove_dir_all(&folder);
    findings.extend(call(repository, &program, &["validate"]));
    let seen = match files.len() {
        0 => "no scenarios to run: the folder is empty; validation passed".to_owned(),
        count => format!("{count} run; validation passed"),
    };
    Outcome::new(seen, findings)
}

fn build(repository: &Repository) -> Result<PathBuf, Vec<String>> {
    let output = cargo(repository)
        .args([
            "build",
            "--quiet",
            "--release",
            "--locked",
            "--message-format",
            "json-render-diagnostics",
        ])
        .output()
        .map_err(|error| vec![format!("cargo could not be started: {error}")])?;
    if !output.status.success() {
        let printed = String::from_utf8_lossy(&output.stderr);
        return Err(printed.lines().map(str::to_owned).collect());
    }
    executable(&String::from_utf8_lossy(&output.stdout))
        .ok_or_else(|| vec!["the build made no program named auxbear".to_owned()])
}

/// The program `auxbear` among cargo's messages, one JSON object a line.
fn executable(messages: &str) -> Option<PathBuf> {
    messages
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
        .filter(|message| message["target"]["name"] == "auxbear")
        .find_map(|message| message["executable"].as_str().map(PathBuf::from))
}

fn call(repository: &Repository, program: &Path, words: &[&str]) -> Vec<String> {
    let outcome = quiet(
        Command::new(program)
            .args(words)
            .current_dir(&repository.root),
    );
    outcome
        .findings
        .into_iter()
        .map(|line| format!("auxbear {}: {line}", words[..words.len().min(2)].join(" ")))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_program_is_found_among_the_messages() {
        let messages = "{\"reason\":\"compiler-artifact\",\"target\":{\"name\":\"auxbear\",\"kind\":[\"lib\"]},\"executable\":null}\n{\"reason\":\"compiler-artifact\",\"target\":{\"name\":\"auxbear\",\"kind\":[\"bin\"]},\"executable\":\"target/release/auxbear\"}\n{\"reason\":\"build-finished\"}\n";
        assert_eq!(
            executable(messages),
            Some(PathBuf::from("target/release/auxbear"))
        );
        assert_eq!(executable("{\"reason\":\"build-finished\"}"), None);
    }
}
