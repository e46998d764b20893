//! Guard: names of results stand in the tables that declare them. Fronts ask for figures (`in figure "words"` in a row of a table);
//! they spell few names, none that no table declares, and none more than before.

use crate::repository::{Outcome, Repository, is_vendored};
use std::collections::BTreeSet;

/// Names that fronts may spell: lower it with each that goes.
const SPELLED: usize = 28;

const TABLES: [&str; 3] = [
    "crates/simulate/src/",
    "crates/analyse/src/",
    "crates/run/src/",
];
const FRONTS: [&str; 6] = [
    "crates/report/src/",
    "cli/src/",
    "python/src/",
    "python/auxbear/",
    "crates/studio/src/",
    "xtask/src/",
];

/// Calls whose text is the name of a result, and those whose text is the name of a figure.
const RESULT_OF: [&str; 3] = ["numberOf(run, ", "quantityOf(run, ", "listOf(run, "];
const FIGURE_OF: [&str; 5] = [
    "shownIn(run, ",
    "tableOf(run, ",
    "rowsIn(run, ",
    "in_figure(",
    "words_in(",
];

/// What the tables declare: names of results, also without what stands before their last point, and figures.
#[derive(Default)]
struct Declared<'a> {
    names: BTreeSet<&'a str>,
    figures: BTreeSet<&'a str>,
}

impl<'a> Declared<'a> {
    /// Adds the rows of a table: `"name": kind "unit", …, "meaning" in figure "words" …`.
    fn add(&mut self, text: &'a str) {
        for line in text.lines() {
            let mut parts = line.trim_start().split('"');
            let (Some(""), Some(name), Some(kind)) = (parts.next(), parts.next(), parts.next())
            else {
                continue;
            };
            if !["number", "instant", "list", "text"]
                .iter()
                .any(|word| kind.trim_start_matches(": ").trim() == *word)
            {
                continue;
            }
            self.names.insert(name);
            self.names.extend(name.rsplit('.').next());
            self.figures
                .extend(parts.filter_map(|part| part.trim().strip_prefix("in ")));
        }
    }
}

/// Names of results that a text spells, and what it asks for that no table declares, each with its line.
fn spelled(text: &str, declared: &Declared) -> (Vec<String>, Vec<String>) {
    let (mut names, mut unknown) = (Vec::new(), Vec::new());
    let product = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = product.lines().zip(1..);
    let is_code = |line: &str| {
        !["//", ">>>"]
            .iter()
            .any(|mark| line.trim_start().starts_with(mark))
    };
    for (line, number) in lines.filter(|(line, _)| is_code(line)) {
        let parts: Vec<&str> = line.split('"').collect();
        for pair in parts.chunks_exact(2) {
            let (before, literal) = (pair[0], pair[1]);
            let of = |calls: &[&str]| calls.iter().any(|call| before.ends_with(call));
            let asked = of(&RESULT_OF);
            // a name of one word is a word like others
            let is_name =
                declared.names.contains(literal) && (asked || literal.contains(['_', '.']));
            if is_name {
                names.push(format!("{number}: {literal}"));
            } else if asked || of(&FIGURE_OF) && !declared.figures.contains(literal) {
                unknown.push(format!("{number}: {literal}"));
            }
        }
        for field in line.split("quantities.").skip(1) {
            let end = field.find(|letter: char| letter != '_' && !letter.is_alphanumeric());
            let name = &field[..end.unwrap_or(field.len())];
            if declared.names.contains(name) {
                names.push(format!("{number}: {name}"));
            }
        }
    }
    (names, unknown)
}

/// Counts the names in all fronts.
pub fn check(repository: &Repository) -> Outcome {
    let below = |folders: &'static [&'static str]| {
        let files = repository
            .files
            .iter()
            .filter(move |file| folders.iter().any(|folder| file.starts_with(folder)));
        files
            .filter(|file| !is_vendored(file))
            .filter_map(|file| Some((file, repository.text(file)?)))
    };
    let tables: Vec<String> = below(&TABLES).map(|(_, text)| text).collect();
    let mut declared = Declared::default();
    tables.iter().for_each(|text| declared.add(text));
    let (mut names, mut findings) = (Vec::new(), Vec::new());
    for (file, text) in below(&FRONTS)
        .filter(|(file, _)| [".rs", ".js", ".py"].iter().any(|end| file.ends_with(end)))
    {
        let (some, unknown) = spelled(&text, &declared);
        names.extend(some.iter().map(|entry| format!("{file}:{entry}")));
        findings.extend(
            unknown
                .iter()
                .map(|entry| format!("{file}:{entry} is declared in no table")),
        );
    }
    let seen = format!(
        "{} of {} names in fronts",
        names.len(),
        declared.names.len()
    );
    if names.len() != SPELLED {
        findings.push(format!(
            "{} names in fronts, {SPELLED} are allowed: ask for a figure, or lower the count",
            names.len()
        ));
        findings.extend(names);
    }
    Outcome::new(seen, findings)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_is_spelled_and_one_that_is_not_declared_are_found_with_their_lines() {
        let mut declared = Declared::default();
        declared.add("  \"peak_force\": number \"N\" headline, FORCE, \"largest\" in tile \"Peak\" in instants \"peak\" => run.force;\n  \"end.mass\": list \"kg\", BODY, \"mass\" => 1;\n(\"other_name\", \"N\")");
        assert_eq!(declared.names, ["peak_force", "end.mass", "mass"].into());
        assert_eq!(declared.figures, ["tile", "instants"].into());
        let text = "a(\"mass\")\nnumberOf(run, \"mass\") + \"peak_force\"\n// \"peak_force\"\nrun.quantities.peak_force\n#[cfg(test)]\n\"peak_force\"";
        let (names, unknown) = spelled(text, &declared);
        assert_eq!(names, ["2: mass", "2: peak_force", "4: peak_force"]);
        assert!(unknown.is_empty());
        let text = "listOf(run, \"loads\")\nshownIn(run, \"marks\")\nshownIn(run, \"tile\")";
        assert_eq!(spelled(text, &declared).1, ["1: loads", "2: marks"]);
    }
}
