//! The command as users build it, and its runs of shipped scenarios.

use crate::repository::Repository;
use crate::toolchain::{cargo, quiet};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The summary in a run directory.
pub fn summary_in(directory: &Path) -> Result<Value, String> {
    let path = directory.join("summary.json");
    let text =
        std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))
}

/// Builds the command in a profile: `test` shares everything with the tests and gives the same bits.
pub fn build_in(repository: &Repository, profile: &str) -> Result<PathBuf, Vec<String>> {
    let output = cargo(repository)
        .args([
            "build",
            "--quiet",
            "--profile",
            profile,
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
pub fn executable(messages: &str) -> Option<PathBuf> {
    messages
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
        .filter(|message| message["target"]["name"] == "auxbear")
        .find_map(|message| message["executable"].as_str().map(PathBuf::from))
}

pub fn call(folder: &Path, program: &Path, words: &[&str]) -> Vec<String> {
    let outcome = quiet(Command::new(program).args(words).current_dir(folder));
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
