//! Guard: ARCHITECTURE.md names what exists, and every crate.

use crate::repository::{Outcome, Repository};
use std::collections::BTreeSet;

const PAGE: &str = "ARCHITECTURE.md";

/// Compares the page with the files.
pub fn check(repository: &Repository) -> Outcome {
    let Some(page) = repository.text(PAGE) else {
        return Outcome::new("", vec![format!("{PAGE}: missing")]);
    };
    let named = paths(&page);
    let mut findings = Vec::new();
    for (line, path) in &named {
        if !exists(path, &repository.files) {
            findings.push(format!("{PAGE}:{line}: {path} does not exist"));
        }
    }
    for folder in packages(&repository.files) {
        let is_path = named
            .iter()
            .any(|(_, path)| path.trim_end_matches('/') == folder);
        if !is_path && !names_package(&page, folder) {
            findings.push(format!("{PAGE}: {folder} is not named"));
        }
    }
    Outcome::new(format!("{} paths named", named.len()), findings)
}

/// Paths in backticks outside fenced blocks, with their line.
fn paths(page: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut fenced = false;
    for (number, line) in page.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
            continue;
        }
        if fenced {
            continue;
        }
        for span in line.split('`').skip(1).step_by(2) {
            let is_command = span.contains(char::is_whitespace);
            for word in span.split_whitespace() {
                let is_file = [".rs", ".md", ".toml"]
                    .iter()
                    .any(|ending| word.ends_with(ending));
                if is_file || (word.contains('/') && !is_command && !word.contains("://")) {
                    found.extend(
                        alternatives(word)
                            .into_iter()
                            .map(|path| (number + 1, path)),
                    );
                }
            }
        }
    }
    found
}

/// `a/{b,c}/d` written out.
fn alternatives(path: &str) -> Vec<String> {
    if let (Some(open), Some(close)) = (path.find('{'), path.find('}'))
        && open < close
    {
        return path[open + 1..close]
            .split(',')
            .flat_map(|part| {
                alternatives(&format!(
                    "{}{}{}",
                    &path[..open],
                    part.trim(),
                    &path[close + 1..]
                ))
            })
            .collect();
    }
    vec![path.to_owned()]
}

/// Whether a file or folder of this name exists; a bare file name may stand in any folder, `*` stands for part of a name.
fn exists(path: &str, files: &[String]) -> bool {
    let is_bare_name = !path.contains('/');
    let wanted: Vec<&str> = path
        .trim_start_matches("./")
        .trim_end_matches('/')
        .split('/')
        .collect();
    files.iter().any(|file| {
        let parts: Vec<&str> = file.split('/').collect();
        let from = if is_bare_name { parts.len() - 1 } else { 0 };
        let rest = &parts[from..];
        rest.len() >= wanted.len() && wanted.iter().zip(rest).all(|(w, part)| matches(w, part))
    })
}

/// A name against a pattern with at most one `*`.
fn matches(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        Some((head, tail)) => {
            name.len() >= head.len() + tail.len() && name.starts_with(head) && name.ends_with(tail)
        }
        None => pattern == name,
    }
}

/// The folders that hold a manifest, the root aside.
fn packages(files: &[String]) -> BTreeSet<&str> {
    files
        .iter()
        .filter_map(|file| file.strip_suffix("/Cargo.toml"))
        .collect()
}

/// A crate is named by its folder, or by its name in backticks.
fn names_package(page: &str, folder: &str) -> bool {
    let name = folder.rsplit('/').next().unwrap_or(folder);
    let in_backticks = page.contains(&format!("`{name}`")) || page.contains(&format!("`{name}/`"));
    in_backticks || (folder.contains('/') && page.contains(folder))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files() -> Vec<String> {
        [
            "README.md",
            "cli/Cargo.toml",
            "crates/model/Cargo.toml",
            "crates/model/src/system/drop.rs",
            "scenarios/rig.toml",
        ]
        .map(str::to_owned)
        .to_vec()
    }

    #[test]
    fn paths_come_from_backticks_outside_fences() {
        let page = "see `crates/model/` and `README.md`, not crates/none or `word`\n```\n`x/y`\n```\nrun `cargo run -- run scenarios/rig.toml a/b` at `https://example.org/x`\n`crates/{model,units}`";
        let found: Vec<String> = paths(page)
            .into_iter()
            .map(|(line, path)| format!("{line} {path}"))
            .collect();
        assert_eq!(
            found,
            [
                "1 crates/model/",
                "1 README.md",
                "5 scenarios/rig.toml",
                "6 crates/model",
                "6 crates/units"
            ]
        );
    }

    #[test]
    fn folders_files_bare_names_and_stars_exist() {
        for path in [
            "crates/model",
            "crates/model/",
            "./cli/",
            "drop.rs",
            "scenarios/*.toml",
            "README.md",
        ] {
            assert!(exists(path, &files()), "{path}");
        }
        for path in [
            "crates/units",
            "system/drop.rs",
            "spin_up.rs",
            "scenarios/*.json",
            "model/",
            "../README.md",
        ] {
            assert!(!exists(path, &files()), "{path}");
        }
    }

    #[test]
    fn every_crate_must_be_named() {
        let files = files();
        assert_eq!(
            packages(&files).into_iter().collect::<Vec<_>>(),
            ["cli", "crates/model"]
        );
        assert!(names_package(
            "the folder crates/model holds",
            "crates/model"
        ));
        assert!(names_package("`model` holds", "crates/model"));
        assert!(!names_package("a model of a click", "crates/model"));
        assert!(names_package("`cli/` parses", "cli"));
        assert!(!names_package("the client", "cli"));
    }
}
