//! Guard: every package that can be built in is under a licence that deny.toml allows.

use crate::repository::{Outcome, Repository};
use crate::toolchain::cargo;
use serde_json::Value;

const LIST: &str = "deny.toml";

/// Compares the licences of all packages in Cargo.lock, for every platform, with the list.
pub fn check(repository: &Repository) -> Outcome {
    match packages(repository).and_then(|packages| Ok((allowed(repository)?, packages))) {
        Ok((allowed, packages)) => {
            let findings = packages
                .iter()
                .filter_map(|package| fault(package, &allowed))
                .collect();
            Outcome::new(format!("{} packages", packages.len()), findings)
        }
        Err(error) => Outcome::new("", vec![error]),
    }
}

fn allowed(repository: &Repository) -> Result<Vec<String>, String> {
    let text = repository
        .text(LIST)
        .ok_or_else(|| format!("{LIST}: missing"))?;
    let table: toml::Table = text.parse().map_err(|error| format!("{LIST}: {error}"))?;
    let list = table.get("licenses").and_then(|part| part.get("allow"));
    let list = list.and_then(toml::Value::as_array);
    let list = list.ok_or_else(|| format!("{LIST}: has no list licenses.allow"))?;
    let names = list.iter().filter_map(toml::Value::as_str);
    Ok(names.map(str::to_owned).collect())
}

fn packages(repository: &Repository) -> Result<Vec<Value>, String> {
    let output = cargo(repository)
        .args(["metadata", "--format-version", "1", "--locked", "--quiet"])
        .output()
        .map_err(|error| format!("cargo could not be started: {error}"))?;
    if !output.status.success() {
        return Err(format!(
            "cargo metadata failed: {}",
            String::from_utf8_lossy(&output.stderr).trim()
        ));
    }
    let metadata: Value = serde_json::from_slice(&output.stdout)
        .map_err(|error| format!("cargo metadata printed what is not JSON: {error}"))?;
    metadata["packages"]
        .as_array()
        .cloned()
        .ok_or_else(|| "cargo metadata printed no packages".to_owned())
}

fn fault(package: &Value, allowed: &[String]) -> Option<String> {
    let word = |key: &str| package[key].as_str().unwrap_or("?");
    let name = format!("{} {}", word("name"), word("version"));
    let Some(expression) = package["license"].as_str() else {
        return Some(format!("{name}: names no licence"));
    };
    (!is_allowed(expression, allowed)).then(|| format!("{name}: {expression} is not allowed"))
}

/// Whether an SPDX expression can be met with allowed licences alone.
///
/// `AND` binds closer than `OR`; the older `MIT/Apache-2.0` reads as `OR`; `X WITH Y` must be allowed as a whole. What is no expression
/// is no licence that is allowed.
fn is_allowed(expression: &str, allowed: &[String]) -> bool {
    let plain = |text: &str| {
        let one = |licence: &str| {
            let licence = licence.trim();
            licence == MET || allowed.iter().any(|known| known == licence)
        };
        text.split(" OR ").any(|part| part.split(" AND ").all(one))
    };
    let mut text = expression.replace('/', " OR ");
    // the innermost brackets first
    while let Some(close) = text.find(')') {
        let Some(open) = text[..close].rfind('(') else {
            return false;
        };
        let verdict = if plain(&text[open + 1..close]) {
            MET
        } else {
            ""
        };
        text.replace_range(open..=close, verdict);
    }
    plain(&text)
}

/// Stands for brackets whose content is met.
const MET: &str = "+";

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(expression: &str) -> bool {
        is_allowed(
            expression,
            &["MIT".to_owned(), "Apache-2.0".to_owned(), "Zlib".to_owned()],
        )
    }

    #[test]
    fn one_allowed_alternative_is_enough_and_every_part_of_a_sum_counts() {
        for good in [
            "MIT",
            "GPL-3.0-only OR MIT",
            "MIT/GPL-2.0",
            "MIT AND Zlib",
            "(MIT OR LGPL-3.0) AND Apache-2.0",
            "GPL-3.0-only AND Zlib OR MIT",
            "Apache-2.0 WITH LLVM-exception OR Apache-2.0",
        ] {
            assert!(verdict(good), "{good}");
        }
        for bad in [
            "MPL-2.0",
            "mit",
            "MIT AND MPL-2.0",
            "(MIT OR Zlib) AND LGPL-3.0",
            "GPL-3.0-only AND (Zlib OR MIT)",
            "Apache-2.0 WITH LLVM-exception",
        ] {
            assert!(!verdict(bad), "{bad}");
        }
    }

    #[test]
    fn what_is_no_expression_is_not_allowed() {
        for broken in [
            "", "MIT OR", "(MIT", "MIT)", "MIT Zlib", "OR MIT", "MIT WITH",
        ] {
            assert!(!verdict(broken), "{broken}");
        }
    }

    #[test]
    fn a_package_without_a_licence_is_found() {
        let package = serde_json::json!({"name": "a", "version": "1.0.0", "license": null});
        assert_eq!(
            fault(&package, &["MIT".to_owned()]),
            Some("a 1.0.0: names no licence".to_owned())
        );
    }
}
