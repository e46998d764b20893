//! Guard: arrows between the crates point down.

use crate::repository::{Outcome, Repository};
use std::collections::BTreeMap;
use toml::Table;

/// Each folder with a package, and the workspace crates it may name.
const ALLOWED: [(&str, &[&str]); 17] = [
    ("crates/number", &[]),
    ("crates/units", &[]),
    ("crates/physics", &["number"]),
    ("crates/solve", &["number"]),
    // of the rotor its tests alone
    (
        "crates/model",
        &[
            "levitation",
            "number",
            "physics",
            "rotor",
            "solve",
            "thermal",
        ],
    ),
    ("crates/levitation", &["number", "physics", "rotor"]),
    ("crates/measure", &["recording", "statistics", "units"]),
    ("crates/recording", &["statistics", "units"]),
    ("crates/recording/fuzz", &["recording"]),
    ("crates/identify", &["measure", "physics", "statistics"]),
    ("crates/rotor", &[]),
    ("crates/statistics", &[]),
    ("crates/thermal", &["physics"]),
    (
        "crates/auxbear",
        &[
            "identify",
            "levitation",
            "measure",
            "model",
            "number",
            "physics",
            "recording",
            "rotor",
            "solve",
            "statistics",
            "thermal",
            "units",
        ],
    ),
    ("cli", &["auxbear"]),
    ("python", &["auxbear"]),
    ("xtask", &[]),
];

/// Reads every manifest below the root and compares it with the table above.
pub fn check(repository: &Repository) -> Outcome {
    let mut findings = Vec::new();
    let mut manifests = BTreeMap::new();
    for file in repository.below("", "Cargo.toml") {
        let Some(folder) = file.strip_suffix("/Cargo.toml") else {
            continue;
        };
        match repository.text(file).map(|text| text.parse::<Table>()) {
            Some(Ok(table)) => {
                manifests.insert(folder.to_owned(), table);
            }
            Some(Err(error)) => findings.push(format!("{file}: {error}")),
            None => findings.push(format!("{file}: cannot be read")),
        }
    }
    findings.extend(compare(&manifests));
    Outcome::new(format!("{} packages", manifests.len()), findings)
}

/// The findings for manifests by folder.
fn compare(manifests: &BTreeMap<String, Table>) -> Vec<String> {
    let names: BTreeMap<&str, &str> = manifests
        .iter()
        .filter_map(|(folder, table)| Some((package_name(table)?, short_name(folder))))
        .collect();
    let mut findings = Vec::new();
    for (folder, table) in manifests {
        let Some((_, allowed)) = ALLOWED.iter().find(|(known, _)| known == folder) else {
            findings.push(format!(
                "{folder}/Cargo.toml: a package without a place: add it to ALLOWED in xtask/src/crate_directions.rs and to ARCHITECTURE.md"
            ));
            continue;
        };
        for (key, value) in dependencies(table) {
            let Some(target) = workspace_crate(key, value, &names) else {
                continue;
            };
            if !allowed.contains(&target) {
                let list = match allowed.join(", ") {
                    none if none.is_empty() => "none".to_owned(),
                    list => list,
                };
                findings.push(format!(
                    "{folder}/Cargo.toml: depends on {target}; allowed here: {list}"
                ));
            }
        }
    }
    findings
}

fn package_name(table: &Table) -> Option<&str> {
    table.get("package")?.get("name")?.as_str()
}

fn short_name(folder: &str) -> &str {
    folder.rsplit('/').next().unwrap_or(folder)
}

/// The workspace crate that a dependency means, if it is one.
fn workspace_crate<'a>(
    key: &'a str,
    value: &'a toml::Value,
    names: &BTreeMap<&str, &'a str>,
) -> Option<&'a str> {
    let package = value
        .get("package")
        .and_then(toml::Value::as_str)
        .unwrap_or(key);
    if let Some(name) = names.get(package) {
        return Some(name);
    }
    if let Some(path) = value.get("path").and_then(toml::Value::as_str) {
        return Some(short_name(path.trim_end_matches('/')));
    }
    let inherited = value.get("workspace").is_some();
    names
        .values()
        .copied()
        .find(|name| inherited && *name == key)
}

/// Every dependency of every kind, for any target.
fn dependencies(table: &Table) -> Vec<(&str, &toml::Value)> {
    let targets = table
        .get("target")
        .and_then(toml::Value::as_table)
        .into_iter()
        .flat_map(|targets| targets.values())
        .filter_map(toml::Value::as_table);
    std::iter::once(table)
        .chain(targets)
        .flat_map(|part| {
            ["dependencies", "dev-dependencies", "build-dependencies"].map(|kind| part.get(kind))
        })
        .flatten()
        .filter_map(toml::Value::as_table)
        .flat_map(|list| list.iter().map(|(key, value)| (key.as_str(), value)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn findings(entries: &[(&str, &str)]) -> Vec<String> {
        let manifests = entries
            .iter()
            .map(|(folder, text)| ((*folder).to_owned(), text.parse().expect("valid TOML")))
            .collect();
        compare(&manifests)
    }

    const NUMBER: (&str, &str) = ("crates/number", "[package]\nname = \"auxbear-number\"");
    const MODEL: (&str, &str) = (
        "crates/model",
        "[package]\nname = \"auxbear-model\"\n[dependencies]\nnumber.workspace = true\nserde = \"1\"",
    );

    #[test]
    fn an_arrow_down_and_a_foreign_crate_are_fine() {
        assert_eq!(findings(&[NUMBER, MODEL]), Vec::<String>::new());
    }

    #[test]
    fn an_arrow_up_is_found_however_it_is_written() {
        for dependency in [
            "[dependencies]\nmodel.workspace = true",
            "[dev-dependencies]\nmodel = { path = \"../model\", package = \"auxbear-model\" }",
            "[build-dependencies]\nauxbear-model = { path = \"../model\" }",
            "[target.'cfg(unix)'.dependencies]\nother = { path = \"../model\" }",
        ] {
            let number = format!("{}\n{dependency}", NUMBER.1);
            let found = findings(&[("crates/number", &number), MODEL]);
            assert_eq!(
                found,
                ["crates/number/Cargo.toml: depends on model; allowed here: none"],
                "{dependency}"
            );
        }
    }

    #[test]
    fn a_crate_without_a_row_is_found() {
        let found = findings(&[("crates/extra", "[package]\nname = \"extra\"")]);
        assert_eq!(found.len(), 1);
        assert!(found[0].contains("crates/extra"));
    }
}
