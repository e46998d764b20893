//! Guard: no file too long, nothing left unfinished, nothing that belongs to one machine.
//!
//! What is looked for is put together from pieces, so that this file does not find itself.

use crate::repository::{Outcome, Repository, is_vendored};

const LONGEST: usize = 600;
const SOURCE_ENDINGS: [&str; 5] = [".rs", ".js", ".ts", ".css", ".py"];

/// Whole words and beginnings of calls that mark unfinished Rust.
const UNFINISHED: [&str; 7] = [
    concat!("TO", "DO"),
    concat!("FIX", "ME"),
    concat!("X", "XX"),
    concat!("todo", "!("),
    concat!("unimpl", "emented!("),
    concat!("db", "g!("),
    concat!("#[ig", "nore"),
];

/// Folders of one machine; found where such a path begins.
const MACHINE_PATHS: [&str; 5] = [
    concat!("/ho", "me/"),
    concat!("/ro", "ot/"),
    concat!("/tm", "p/"),
    concat!("/Us", "ers/"),
    concat!("/wo", "rk/"),
];

/// Settings of one machine's package sources.
const MACHINE_WORDS: [&str; 2] = [concat!("registry", " host"), concat!("replace", "-with")];

/// A folder beside the checkout, which a clone does not have.
const OUTSIDE: &str = concat!("../", "shared");

/// What the environment says: no number of a library may depend on it.
const ENVIRONMENT: &str = concat!("env", "::var");

/// Names that say nothing about what a module holds.
const EMPTY_NAMES: [&str; 8] = [
    "common", "helper", "helpers", "manager", "managers", "misc", "util", "utils",
];

/// Scans every text file.
pub fn check(repository: &Repository) -> Outcome {
    let mut findings = Vec::new();
    let mut seen = 0;
    for file in &repository.files {
        if is_vendored(file) {
            continue;
        }
        findings.extend(empty_name(file));
        if let Some(text) = repository.text(file) {
            seen += 1;
            findings.extend(scan(file, &text));
            findings.extend(unsafe_allowed(file, &text));
        }
    }
    Outcome::new(format!("{seen} text files"), findings)
}

fn empty_name(file: &str) -> Option<String> {
    let path = file.strip_suffix(".rs")?;
    let name = path
        .split('/')
        .find(|part| EMPTY_NAMES.contains(&part.to_lowercase().as_str()))?;
    Some(format!(
        "{file}: the name {name} says nothing about its content"
    ))
}

/// The crates with unsafe code; their pages argue that it is sound.
const UNSAFE: [&str; 2] = ["crates/number/", "crates/fmu/"];

/// The root of a crate that does not forbid unsafe code.
fn unsafe_allowed(file: &str, text: &str) -> Option<String> {
    let root = file.ends_with("src/lib.rs") || file.ends_with("src/main.rs");
    let forbids = text.lines().any(|line| line == "#![forbid(unsafe_code)]");
    (root && !forbids && !UNSAFE.iter().any(|own| file.starts_with(own)))
        .then(|| format!("{file}: does not forbid unsafe code (#![forbid(unsafe_code)])"))
}

fn scan(file: &str, text: &str) -> Vec<String> {
    let mut findings = Vec::new();
    let count = text.lines().count();
    if SOURCE_ENDINGS.iter().any(|ending| file.ends_with(ending)) && count > LONGEST {
        findings.push(format!(
            "{file}: {count} lines, more than {LONGEST}: split it"
        ));
    }
    let library = file.starts_with("crates/") && file.contains("/src/");
    for (number, line) in text.lines().enumerate() {
        let mut report = |what: String| findings.push(format!("{file}:{}: {what}", number + 1));
        if file.ends_with(".rs") {
            for mark in UNFINISHED.iter().filter(|mark| has_mark(line, mark)) {
                report(format!("unfinished: {mark}"));
            }
        }
        for path in MACHINE_PATHS.iter().filter(|path| begins(line, path)) {
            report(format!("a path of one machine: {path}"));
        }
        for word in MACHINE_WORDS.iter().filter(|word| line.contains(**word)) {
            report(format!("a setting of one machine: {word}"));
        }
        if library && line.contains(ENVIRONMENT) {
            report(format!(
                "a result would depend on the environment: {ENVIRONMENT}"
            ));
        }
        if line.contains(OUTSIDE) {
            report(format!("looks outside the repository: {OUTSIDE}"));
        }
    }
    findings
}

/// Whether a mark stands in the line, not as part of a longer name.
fn has_mark(line: &str, mark: &str) -> bool {
    line.match_indices(mark).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        let after = line[at + mark.len()..].chars().next();
        let is_whole_word = mark.chars().all(is_word);
        let goes_on = is_whole_word && after.is_some_and(is_word);
        !before.is_some_and(is_word) && !goes_on
    })
}

/// Whether a character can stand inside a Rust name.
pub fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Whether an absolute path begins so, rather than going on from a name, a `..` or a host.
fn begins(line: &str, path: &str) -> bool {
    line.match_indices(path).any(|(at, _)| {
        !line[..at]
            .chars()
            .next_back()
            .is_some_and(|before| is_word(before) || "./-}$*)".contains(before))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_601_lines_is_too_long_and_600_are_not() {
        assert_eq!(scan("a.css", &"x\n".repeat(600)), Vec::<String>::new());
        assert_eq!(scan("a.css", &"x\n".repeat(601)).len(), 1);
        assert_eq!(scan("a.json", &"x\n".repeat(601)), Vec::<String>::new());
    }

    #[test]
    fn a_crate_that_allows_unsafe_code_is_found() {
        let forbids = "//! A.\n\n#![forbid(unsafe_code)]\n";
        assert!(unsafe_allowed("crates/solve/src/lib.rs", "//! A.\n").is_some());
        assert!(unsafe_allowed("cli/src/main.rs", "// #![forbid(unsafe_code)]\n").is_some());
        assert!(unsafe_allowed("crates/solve/src/lib.rs", forbids).is_none());
        assert!(unsafe_allowed("crates/solve/src/drive.rs", "").is_none());
        assert!(unsafe_allowed("crates/number/src/lib.rs", "").is_none());
    }

    #[test]
    fn a_library_that_asks_the_environment_is_found() {
        let text = format!("let a = std::{ENVIRONMENT}(\"A\");");
        assert_eq!(scan("crates/physics/src/film.rs", &text).len(), 1);
        assert_eq!(scan("crates/physics/tests/film.rs", &text).len(), 0);
        assert_eq!(scan("xtask/src/main.rs", &text).len(), 0);
    }

    #[test]
    fn every_unfinished_mark_is_found_in_rust_only() {
        for mark in UNFINISHED {
            let text = format!("fn f() {{}}\n    {mark} x\n");
            let found = scan("a.rs", &text);
            assert_eq!(found.len(), 1, "{mark}");
            assert!(found[0].starts_with("a.rs:2: "), "{mark}");
            assert_eq!(scan("a.md", &text), Vec::<String>::new(), "{mark}");
        }
        let longer = format!("{0}LIST my{0} {1}ED", UNFINISHED[0], UNFINISHED[1]);
        assert_eq!(scan("a.rs", &longer), Vec::<String>::new());
    }

    #[test]
    fn a_machine_path_is_found_where_it_begins() {
        for path in MACHINE_PATHS {
            assert_eq!(scan("a.md", &format!("see {path}x")).len(), 1, "{path}");
            assert_eq!(
                scan("a.toml", &format!("p = \"{path}x\"")).len(),
                1,
                "{path}"
            );
            assert_eq!(
                scan(
                    "a.md",
                    &format!("https://example.org{path}x heat{path}loss")
                ),
                Vec::<String>::new()
            );
        }
        for word in MACHINE_WORDS {
            assert_eq!(scan("config.toml", word).len(), 1, "{word}");
        }
    }

    #[test]
    fn nothing_looks_outside() {
        let text = format!("{OUTSIDE}/cases");
        for file in ["README.md", "crates/model/tests/a.rs"] {
            assert_eq!(scan(file, &text).len(), 1, "{file}");
        }
    }

    #[test]
    fn empty_names_are_found() {
        assert!(empty_name("crates/model/src/utils.rs").is_some());
        assert!(empty_name("crates/model/tests/common/mod.rs").is_some());
        assert!(empty_name("crates/model/src/commonality.rs").is_none());
        assert!(empty_name("docs/common/picture.svg").is_none());
    }
}
