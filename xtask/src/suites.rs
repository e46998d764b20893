//! Guard: every test file of a crate belongs to one of its test binaries.
//!
//! A crate links its tests into few binaries (`tests/suite.rs`), since each would be built by itself; a file that none of them names
//! would never run.

use crate::repository::{Outcome, Repository};

/// Looks at every crate that has a suite.
pub fn check(repository: &Repository) -> Outcome {
    let mut findings = Vec::new();
    let mut seen = 0;
    for suite in repository.below("crates/", "/tests/suite.rs") {
        let folder = suite.trim_end_matches("suite.rs");
        let text = |file: &str| repository.text(file).unwrap_or_default();
        let named = text(suite);
        let manifest = text(&suite.replace("tests/suite.rs", "Cargo.toml"));
        for file in repository.below(folder, ".rs") {
            let Some(module) = module(&file[folder.len()..]) else {
                continue;
            };
            seen += 1;
            if !belongs(module, &named, &manifest) {
                findings.push(format!(
                    "{file}: no test binary names it; add it to {suite}"
                ));
            }
        }
    }
    Outcome::new(format!("{seen} test files"), findings)
}

/// The module that a file is the page of: `a.rs`, `a/mod.rs`, `a/main.rs`; none for parts of such a module.
fn module(inner: &str) -> Option<&str> {
    let name = inner.strip_suffix(".rs")?;
    match name.split_once('/') {
        None => Some(name),
        Some((folder, "mod" | "main")) => Some(folder),
        Some(_) => None,
    }
}

fn belongs(module: &str, suite: &str, manifest: &str) -> bool {
    module == "suite"
        || suite.lines().any(|line| line == format!("mod {module};"))
        || [".rs", "/main.rs"]
            .iter()
            .any(|ending| manifest.contains(&format!("path = \"tests/{module}{ending}\"")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_no_binary_names_is_found() {
        let suite = "mod a;\nmod folder;\n";
        let manifest = "path = \"tests/suite.rs\"\npath = \"tests/alone.rs\"\n";
        for (file, fits) in [
            ("suite.rs", true),
            ("a.rs", true),
            ("folder/mod.rs", true),
            ("alone.rs", true),
            ("b.rs", false),
            ("other/mod.rs", false),
        ] {
            assert_eq!(
                belongs(module(file).unwrap(), suite, manifest),
                fits,
                "{file}"
            );
        }
        assert_eq!(module("folder/part.rs"), None);
    }
}
