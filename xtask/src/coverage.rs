//! `cargo xtask coverage`: runs the long form of the statistical tests and writes what they found into the book.
//!
//! Each test prints a line a case; its name is a sentence and becomes the heading. The tests assert their bounds as in the
//! short form: a figure that falls out of its bound stands on the page as a failure, and the command ends with exit status 1.

use crate::repository::Repository;
use crate::toolchain::cargo;
use std::fmt::Write;

const PAGE: &str = "book/src/coverage.md";

/// What is counted: subject, package, module of its test suite, how many cases it tries in its long form, and the beginnings of the names
/// of the tests that count something, all where there are none.
const TABLES: &str = "\
Speed and acceleration from pulses  | measure    | speed_coverage | 400 |
The engagement of a soft clutch     | measure    | soft_clutch    | 100 |
Few marks in the change             | measure    | few_marks      |  40 | eight_marks the_engagement
Few samples a mark                  | measure    | few_samples    |  40 |
Pickups of other kinds              | measure    | pickups        |  20 |
Torque by a swinging sensor         | measure    | torque_sensor  | 100 | two_deviations
Torque beside a disturbance         | measure    | run_out        |  20 | the_band
The steady moment after coast-downs | identify   | moment         | 100 |
The loss of accelerated balls       | identify   | loss           | 100 |
Energy of a spin-up                 | identify   | energy         | 100 |
Cage and slip                       | identify   | cage           | 100 |
Friction of the rotor on the race   | identify   | rotor          | 100 |
Explanations: verdicts and fit      | identify   | explain        | 100 | right_as_often fit::the_probability
Rare events                         | statistics | rare           | 200 | a_known
Studies that are killed             | cli        | kills          | 200 |
";

/// A row of [`TABLES`].
struct Table {
    subject: &'static str,
    package: &'static str,
    module: &'static str,
    seeds: &'static str,
    tests: Vec<&'static str>,
}

fn tables() -> impl Iterator<Item = Table> {
    TABLES.lines().map(|line| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        Table {
            subject: cells[0],
            package: cells[1],
            module: cells[2],
            seeds: cells[3],
            tests: cells[4].split(' ').collect(),
        }
    })
}

/// Runs the tables, or those whose subject or module contains a word, and writes the page; sections that do not run stay.
pub fn run(word: Option<&str>) -> Result<(), String> {
    let repository = Repository::open()?;
    let before = repository.text(PAGE).unwrap_or_default();
    let asked = |table: &Table| {
        word.is_none_or(|word| table.module == word || table.subject.contains(word))
    };
    if !tables().any(|table| asked(&table)) {
        let known: Vec<&str> = tables().map(|table| table.module).collect();
        let known = known.join(", ");
        return Err(format!("no table of that name: there are {known}"));
    }
    let mut page = String::from(HEAD);
    let mut good = true;
    for table in tables() {
        let heading = format!("## {}\n", table.subject);
        if asked(&table) {
            eprintln!("{}: {} seeds", table.subject, table.seeds);
            let (text, passed) = measured(&repository, &table)?;
            good &= passed;
            let _ = write!(page, "\n{heading}{text}");
        } else if let Some(text) = section(&before, &heading) {
            let _ = write!(page, "\n{heading}{text}");
        }
    }
    repository.write(PAGE, &page)?;
    match good {
        true => Ok(()),
        false => Err("a test fell out of its bound".to_owned()),
    }
}

const HEAD: &str = "# Coverage

<!-- Written by `cargo xtask coverage`: do not edit. -->

What the bands of `signals` and `identify` are worth: made-up measurements whose truth is known, evaluated as a laboratory's are. A band of two
deviations should hold the truth in 95 % of cases. The lines are those that the tests print; a test that fails is marked.
";

/// What stands under a heading.
fn section<'a>(page: &'a str, heading: &str) -> Option<&'a str> {
    let (_, after) = page.split_once(heading)?;
    let end = after.find("\n## ").unwrap_or(after.len());
    Some(&after[..end])
}

/// Runs a table; its text, and whether all its tests passed.
fn measured(repository: &Repository, table: &Table) -> Result<(String, bool), String> {
    let names = (table.tests.iter()).map(|name| format!("{}::{name}", table.module));
    let output = cargo(repository)
        .args(["test", "--release", "--locked"])
        .args(["-p", &format!("auxbear-{}", table.package), "--tests", "--"])
        .args(["--nocapture", "--test-threads=1", "--format=pretty"])
        .args(names)
        .env("AUXBEAR_SEEDS", table.seeds)
        .stderr(std::process::Stdio::inherit())
        .output()
        .map_err(|error| format!("cargo test: {error}"))?;
    let printed = String::from_utf8_lossy(&output.stdout);
    let folder = format!("crates/{}/tests/{}", table.package, table.module);
    let alone = format!("{folder}.rs");
    let file = match repository.root.join(&alone).exists() {
        true => alone,
        false => format!("{folder}/mod.rs"),
    };
    let mut text = format!("\n`{file}`, {} seeds.\n", table.seeds);
    for test in tests(&printed) {
        if test.lines.is_empty() && test.passed {
            continue;
        }
        let failed = if test.passed { "" } else { " (fails)" };
        let _ = write!(text, "\n**{}**{failed}\n\n", test.name);
        for line in &test.lines {
            let _ = writeln!(text, "- {line}");
        }
    }
    Ok((text, output.status.success()))
}

/// A test as it ran.
#[derive(Debug, PartialEq)]
struct TestRun {
    name: String,
    lines: Vec<String>,
    passed: bool,
}

/// The tests of an output without capture: `test NAME ... ` stands before the first line that a test prints, `ok` on a line of
/// its own behind the last.
fn tests(output: &str) -> Vec<TestRun> {
    let mut found: Vec<TestRun> = Vec::new();
    // behind the tests stands what failed, once more
    for line in output.lines().take_while(|line| *line != "failures:") {
        let rest = match line
            .strip_prefix("test ")
            .and_then(|line| line.split_once(" ... "))
        {
            Some((name, rest)) => {
                let name = name.rsplit("::").next().unwrap_or(name).replace('_', " ");
                let mut letters = name.chars();
                let first = letters.next().into_iter().flat_map(char::to_uppercase);
                found.push(TestRun {
                    name: first.chain(letters).collect(),
                    lines: Vec::new(),
                    passed: false,
                });
                rest
            }
            None => line,
        };
        let Some(test) = found.last_mut().filter(|test| !test.passed) else {
            continue;
        };
        match rest.trim() {
            "ok" => test.passed = true,
            "" | "FAILED" => {}
            said => test.lines.push(said.to_string()),
        }
    }
    found
}

#[cfg(test)]
mod tests_of_the_output {
    use super::*;

    #[test]
    fn lines_belong_to_the_test_that_printed_them() {
        let output = "\nrunning 2 tests\ntest a::two_deviations ... first: 95 %\nsecond: 94 %\nok\ntest b_c ... ok\n\
                      test d ... x\nFAILED\n\ntest result: FAILED.";
        let found = tests(output);
        let ran = |name: &str, lines: &[&str], passed| TestRun {
            name: name.into(),
            lines: lines.iter().map(|line| (*line).to_string()).collect(),
            passed,
        };
        assert_eq!(
            found[..2],
            [
                ran("Two deviations", &["first: 95 %", "second: 94 %"], true),
                ran("B c", &[], true)
            ]
        );
        assert!(!found[2].passed && found[2].lines[0] == "x");
    }

    #[test]
    fn a_section_ends_at_the_next_heading() {
        let page = "# P\n\n## A\n\none\n\n## B\n\ntwo\n";
        assert_eq!(section(page, "## A\n"), Some("\none\n"));
        assert_eq!(section(page, "## B\n"), Some("\ntwo\n"));
        assert_eq!(section(page, "## C\n"), None);
    }
}
