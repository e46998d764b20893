//! Guard: the links and paths of the book exist, its tests are there.

use crate::repository::{Outcome, Repository};
use std::collections::BTreeSet;

const FOLDER: &str = "book/src/";
const SUMMARY: &str = "book/src/SUMMARY.md";
/// Folder of the cases that ship.
pub const CASES: &str = "crates/validate/cases/";
const VALIDATION: &str = "book/src/validation.md";

/// Compares the book with the repository.
pub fn check(repository: &Repository) -> Outcome {
    let pages: Vec<(&str, String)> = repository
        .below(FOLDER, ".md")
        .filter_map(|page| Some((page, repository.text(page)?)))
        .collect();
    let text = |wanted: &str| {
        let page = pages.iter().find(|(page, _)| *page == wanted);
        page.map_or("", |(_, text)| text.as_str())
    };
    let mut findings = Vec::new();
    for (page, text) in &pages {
        findings.extend(links(page, text, repository));
        findings.extend(places(page, text, repository));
    }
    findings.extend(unlisted(text(SUMMARY), &pages));
    for case in repository.below(CASES, ".toml") {
        let name = case.trim_start_matches(CASES).trim_end_matches(".toml");
        if !text(VALIDATION).contains(&format!("## {name}\n")) {
            findings.push(format!(
                "{VALIDATION}: {case} has no section; cargo xtask docs writes the page"
            ));
        }
    }
    Outcome::new(format!("{} pages", pages.len()), findings)
}

/// Lines outside fenced blocks, with their numbers.
fn prose(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut fenced = false;
    text.lines().enumerate().filter_map(move |(index, line)| {
        let fence = line.trim_start().starts_with("```");
        fenced ^= fence;
        (!fenced && !fence).then_some((index + 1, line))
    })
}

/// Links to pages that do not exist, or to headings that a page does not have.
fn links(page: &str, text: &str, repository: &Repository) -> Vec<String> {
    let mut findings = Vec::new();
    for (number, line) in prose(text) {
        for part in line.split("](").skip(1) {
            let target = part.split(')').next().unwrap_or_default();
            if target.contains("://") {
                continue;
            }
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let file = if file.is_empty() {
                page.to_owned()
            } else {
                joined(page, file)
            };
            if !repository.files.contains(&file) {
                findings.push(format!("{page}:{number}: {target} does not exist"));
            } else if !anchor.is_empty() {
                let other = repository.text(&file).unwrap_or_default();
                if !anchors(&other).contains(anchor) {
                    findings.push(format!("{page}:{number}: {target} has no such heading"));
                }
            }
        }
    }
    findings
}

/// A path relative to the folder of a page.
fn joined(page: &str, target: &str) -> String {
    let mut parts: Vec<&str> = page.split('/').collect();
    parts.pop();
    for part in target.split('/') {
        match part {
            "." => {}
            ".." => {
                parts.pop();
            }
            name => parts.push(name),
        }
    }
    parts.join("/")
}

/// The anchors of the headings of a page: lower case, spaces as hyphens, the rest of the punctuation left out.
fn anchors(text: &str) -> BTreeSet<String> {
    let headings = prose(text).filter(|(_, line)| line.starts_with('#'));
    headings
        .map(|(_, line)| {
            let title = line.trim_start_matches('#').trim().to_lowercase();
            let kept = title
                .chars()
                .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
            kept.map(|c| if c == ' ' { '-' } else { c }).collect()
        })
        .collect()
}

/// Files and tests named in backticks that do not exist: `crates/…`, `scenarios/…`, and `path.rs::test`.
fn places(page: &str, text: &str, repository: &Repository) -> Vec<String> {
    const ROOTS: [&str; 7] = [
        "crates/",
        "cli/",
        "scenarios/",
        "validation/",
        "xtask/",
        "book/",
        "benchmarks/",
    ];
    let mut findings = Vec::new();
    for (number, line) in prose(text) {
        for span in line.split('`').skip(1).step_by(2) {
            if span.contains(char::is_whitespace)
                || !ROOTS.iter().any(|root| span.starts_with(root))
            {
                continue;
            }
            let (file, test) = span.split_once("::").unwrap_or((span, ""));
            let exists = repository.files.iter().any(|known| {
                known == file || known.starts_with(&format!("{}/", file.trim_end_matches('/')))
            });
            if !exists {
                findings.push(format!("{page}:{number}: {file} does not exist"));
            } else if !test.is_empty() {
                let code = repository.text(file).unwrap_or_default();
                if !code.contains(&format!("fn {test}(")) {
                    findings.push(format!("{page}:{number}: {file} has no test {test}"));
                }
            }
        }
    }
    findings
}

/// Pages that the summary does not list.
fn unlisted(summary: &str, pages: &[(&str, String)]) -> Vec<String> {
    let pages = pages
        .iter()
        .map(|(page, _)| *page)
        .filter(|page| *page != SUMMARY);
    pages
        .filter(|page| !summary.contains(&format!("({})", page.trim_start_matches(FOLDER))))
        .map(|page| format!("{SUMMARY}: {page} is not listed"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn repository(files: &[&str]) -> Repository {
        Repository {
            root: std::path::PathBuf::from("."),
            files: files.iter().map(|file| file.to_string()).collect(),
        }
    }

    #[test]
    fn paths_are_joined_and_headings_become_anchors() {
        assert_eq!(
            joined("book/src/guide/a.md", "../codes.md"),
            "book/src/codes.md"
        );
        assert_eq!(joined("book/src/a.md", "guide/b.md"), "book/src/guide/b.md");
        let text = "# A page, (21)\n```\n# no heading\n```\n## AB0101\n";
        let anchors: Vec<String> = anchors(text).into_iter().collect();
        assert_eq!(anchors, ["a-page-21", "ab0101"]);
    }

    #[test]
    fn broken_links_and_paths_are_found() {
        let repository = repository(&["book/src/a.md", "crates/x/src/lib.rs", "scenarios/s.toml"]);
        let text = "[a](a.md) [b](b.md)\n`scenarios/s.toml` `crates/x/` `crates/y/lib.rs` `crates/x/src/lib.rs::no_such`\n";
        assert_eq!(
            links("book/src/a.md", text, &repository),
            ["book/src/a.md:1: b.md does not exist"]
        );
        assert_eq!(
            places("book/src/a.md", text, &repository),
            [
                "book/src/a.md:2: crates/y/lib.rs does not exist",
                "book/src/a.md:2: crates/x/src/lib.rs has no test no_such"
            ]
        );
    }

    #[test]
    fn a_page_that_is_not_listed_is_found() {
        let pages = [
            (SUMMARY, String::new()),
            ("book/src/guide/a.md", String::new()),
            ("book/src/b.md", String::new()),
        ];
        assert_eq!(
            unlisted("- [A](guide/a.md)", &pages),
            ["book/src/SUMMARY.md: book/src/b.md is not listed"]
        );
    }
}
