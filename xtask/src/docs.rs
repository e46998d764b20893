//! `cargo xtask docs`: writes the page of the book that shows what the program was compared with.

use crate::bench::given_or_built;
use crate::book::CASES;
use crate::repository::Repository;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

const PAGE: &str = "book/src/validation.md";

/// Writes the page from what the command given says, or the release build.
pub fn run(program: Option<&str>) -> Result<(), String> {
    let repository = Repository::open()?;
    let program = given_or_built(&repository, program)?;
    let output = Command::new(&program)
        .args(["validate", "--long", "--json"])
        .current_dir(&repository.root)
        .output()
        .map_err(|error| format!("{}: {error}", program.display()))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let report: Value =
        serde_json::from_str(&text).map_err(|error| format!("auxbear validate --json: {error}"))?;
    let mut sources = BTreeMap::new();
    for file in repository.below(CASES, ".toml") {
        let name = Path::new(file).file_stem().unwrap_or_default();
        let text = repository.text(file).unwrap_or_default();
        let case: toml::Table =
            toml::from_str(&text).map_err(|error| format!("{file}: {error}"))?;
        sources.insert(name.to_string_lossy().into_owned(), case);
    }
    let page = page(&report, &sources);
    repository.write(PAGE, &page)
}

/// The page as Markdown.
fn page(report: &Value, sources: &BTreeMap<String, toml::Table>) -> String {
    let rows: Vec<&Value> = report["cases"].as_array().into_iter().flatten().collect();
    let count = |verdict: &str| rows.iter().filter(|row| row["verdict"] == verdict).count();
    let mut cases: BTreeMap<&str, Vec<&Value>> = BTreeMap::new();
    for row in &rows {
        cases
            .entry(row["case"].as_str().unwrap_or_default())
            .or_default()
            .push(row);
    }
    let mut out = String::from(
        "# Validation\n\n<!-- Written by `cargo xtask docs` from `auxbear validate`: do not edit. -->\n\n",
    );
    let _ = write!(
        out,
        "What the program was compared with: published and closed-form results, each with its source and a tolerance that the source supports. \
         {} of {} comparisons in {} cases pass. A deviation is a share of the reference, or absolute where the reference is 0.\n\n\
         The case files stand in `crates/validate/cases/`. `auxbear validate` runs them, with `--long` those of half a minute as well; `--cases DIR` adds your own.\n",
        count("pass"),
        rows.len(),
        cases.len()
    );
    for (case, rows) in cases {
        let _ = write!(out, "\n## {case}\n\n");
        let source = sources.get(case).and_then(|case| case.get("source"));
        for key in ["citation", "note"] {
            if let Some(text) = source.and_then(|source| source.get(key)?.as_str()) {
                let _ = write!(out, "{}\n\n", cell(text));
            }
        }
        out.push_str("| quantity | reference | ours | unit | deviation | tolerance | verdict | reason of the tolerance |\n|---|---|---|---|---|---|---|---|\n");
        for row in rows {
            let text = |key: &str| cell(row[key].as_str().unwrap_or_default());
            let _ = writeln!(
                out,
                "| {} | {} | {} | {} | {} | {} | {} | {} |",
                text("quantity"),
                number(&row["reference"]),
                number(&row["ours"]),
                text("unit"),
                small(&row["deviation"]),
                small(&row["tolerance"]),
                text("verdict"),
                text("why")
            );
        }
    }
    out
}

/// A text inside a table: one line, no bars.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}

/// A value with nine digits, which is what the sources print at most.
fn number(value: &Value) -> String {
    let Some(value) = value.as_f64() else {
        return String::new();
    };
    let short: f64 = format!("{value:.8e}").parse().unwrap_or(value);
    match short.abs() {
        size if size == 0.0 || (1e-4..1e9).contains(&size) => format!("{short}"),
        _ => format!("{short:e}"),
    }
}

fn small(value: &Value) -> String {
    match value.as_f64() {
        None => String::new(),
        Some(0.0) => "0".to_string(),
        // rounding differs between machines; the page does not
        Some(value) if value < 1e-13 => "below 1e-13".to_string(),
        Some(value) => format!("{value:.1e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_case_has_its_source_and_its_rows() {
        let report = json!({"cases": [{
            "case": "fall", "quantity": "time", "unit": "s", "reference": 0.5, "ours": 0.500001, "deviation": 2e-6,
            "tolerance": 1e-5, "verdict": "pass", "why": "a | b"
        }]});
        let case: toml::Table =
            toml::from_str("[source]\ncitation = \"G. Galilei\"\n").expect("a table");
        let page = page(&report, &BTreeMap::from([("fall".to_string(), case)]));
        assert!(page.contains("1 of 1 comparisons in 1 cases pass"));
        assert!(page.contains("\n## fall\n\nG. Galilei\n"));
        assert!(
            page.contains("| time | 0.5 | 0.500001 | s | 2.0e-6 | 1.0e-5 | pass | a \\| b |\n")
        );
    }

    #[test]
    fn numbers_are_short_and_rounding_is_hidden() {
        assert_eq!(number(&json!(0.1 + 0.2)), "0.3");
        assert_eq!(number(&json!(2.5e10)), "2.5e10");
        assert_eq!(number(&Value::Null), "");
        assert_eq!(small(&json!(3e-16)), "below 1e-13");
    }
}
