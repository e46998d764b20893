//! What a build of the product makes, and runs of shipped scenarios.

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

/// Builds everything as the tests are built. What scenarios and Python need comes from that build too: of fewer packages some
/// dependencies have fewer features, and all that uses them would be built once more.
const AS_TESTED: &str = "build --quiet --profile test --workspace --lib --bins --tests --locked --message-format=json-render-diagnostics";

/// The command, as the tests are built: the same bits.
pub fn program(repository: &Repository) -> Result<PathBuf, Vec<String>> {
    built(repository, |made| made["executable"].as_str(), "auxbear")
}

/// The native part of the Python package.
pub fn library(repository: &Repository) -> Result<PathBuf, Vec<String>> {
    built(repository, |made| made["filenames"][0].as_str(), "_auxbear")
}

/// What was made of a target, of which `file` says where it is.
fn built(
    repository: &Repository,
    file: fn(&Value) -> Option<&str>,
    target: &str,
) -> Result<PathBuf, Vec<String>> {
    let output = cargo(repository)
        .args(AS_TESTED.split(' '))
        .output()
        .map_err(|error| vec![format!("cargo could not be started: {error}")])?;
    if !output.status.success() {
        let printed = String::from_utf8_lossy(&output.stderr);
        return Err(printed.lines().map(str::to_owned).collect());
    }
    let messages = String::from_utf8_lossy(&output.stdout);
    made(&messages, file, target).ok_or_else(|| vec![format!("the build made no {target}")])
}

/// What was made of a target by cargo's messages, one JSON object a line; its tests, which have its name, are another thing.
fn made(messages: &str, file: fn(&Value) -> Option<&str>, target: &str) -> Option<PathBuf> {
    messages
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
        .filter(|message| message["target"]["name"] == target)
        .filter(|message| message["profile"]["test"] != true)
        .find_map(|message| file(&message).map(PathBuf::from))
}

pub fn call(folder: &Path, program: &Path, words: &[&str]) -> Vec<String> {
    let outcome = quiet(Command::new(program).args(words).current_dir(folder));
    let named = words[..words.len().min(2)].join(" ");
    let findings = outcome.findings.into_iter();
    findings
        .map(|line| format!("auxbear {named}: {line}"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_built_is_found_among_the_messages() {
        let message = |name: &str, test: bool, file: &str| {
            format!(
                "{{\"target\":{{\"name\":\"{name}\"}},\"profile\":{{\"test\":{test}}},\"filenames\":[\"{file}\"]}}\n"
            )
        };
        let messages = [
            message("other", false, "other.rlib"),
            message("_auxbear", true, "deps/auxbear-1"),
            message("_auxbear", false, "lib_auxbear.so"),
        ];
        let found = |text: &str| made(text, |made| made["filenames"][0].as_str(), "_auxbear");
        let library = Some(PathBuf::from("lib_auxbear.so"));
        assert_eq!(found(&messages.concat()), library);
        assert_eq!(found("{\"reason\":\"build-finished\"}"), None);
    }
}
