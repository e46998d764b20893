//! `cargo xtask coverage`: runs the long form of the statistical tests and writes what they found into the book.
//!
//! Each test prints a line a case; its name is a sentence and becomes the heading. The tests assert their bounds as in the
//! short form: a figure that falls out of its bound stands on the page as a failure, and the command ends with exit status 1.

use crate::repository::Repository;
use crate::toolchain::cargo;
use std::fmt::Write;
use std::process::ExitCode;

const PAGE: &str = "book/src/coverage.md";

/// A module of a package's test suite, the tests of it that count something, and how many cases it tries in its long form.
struct Table {
    subject: &'static str,
    package: &'static str,
    module: &'static str,
    /// Beginnings of the names of the tests.
    tests: &'static [&'static str],
    seeds: u64,
}

const TABLES: &[Table] = &[
    Table {
        subject: "Speed and acceleration from pulses",
        package: "auxbear-measure",
        module: "speed_coverage",
        tests: &[""],
        seeds: 400,
    },
    Table {
        subject: "The engagement of a soft clutch",
        package: "auxbear-measure",
        module: "soft_clutch",
        tests: &[""],
        seeds: 100,
    },
    Table {
        subject: "Few marks in the change",
        package: "auxbear-measure",
        module: "few_marks",
        tests: &["eight_marks", "the_engagement"],
        seeds: 40,
    },
    Table {
        subject: "Few samples a mark",
        package: "auxbear-measure",
        module: "few_samples",
        tests: &[""],
        seeds: 40,
    },
    Table {
        subject: "Pickups of other kinds",
        package: "auxbear-measure",
        module: "pickups",
        tests: &[""],
        seeds: 20,
    },
    Table {
        subject: "Torque by a swinging sensor",
        package: "auxbear-measure",
        module: "torque_sensor",
        tests: &["two_deviations"],
        seeds: 100,
    },
    Table {
        subject: "Torque beside a disturbance",
        package: "auxbear-measure",
        module: "run_out",
        tests: &["the_band"],
        seeds: 20,
    },
    Table {
        subject: "The steady moment after coast-downs",
        package: "auxbear-identify",
        module: "moment",
        tests: &[""],
        seeds: 100,
    },
    Table {
        subject: "The loss of accelerated balls",
        package: "auxbear-identify",
        module: "loss",
        tests: &[""],
        seeds: 100,
    },
    Table {
        subject: "Energy of a spin-up",
        package: "auxbear-identify",
        module: "energy",
        tests: &[""],
        seeds: 100,
    },
    Table {
        subject: "Cage and slip",
        package: "auxbear-identify",
        module: "cage",
        tests: &[""],
        seeds: 100,
    },
    Table {
        subject: "Friction of the rotor on the race",
        package: "auxbear-identify",
        module: "rotor",
        tests: &[""],
        seeds: 100,
    },
    Table {
        subject: "Explanations: verdicts and fit",
        package: "auxbear-identify",
        module: "explain",
        tests: &["right_as_often", "fit::the_probability"],
        seeds: 100,
    },
    Table {
        subject: "Rare events",
        package: "auxbear-statistics",
        module: "rare",
        tests: &["a_known"],
        seeds: 200,
    },
    Table {
        subject: "Studies that are killed",
        package: "auxbear-cli",
        module: "kills",
        tests: &[""],
        seeds: 200,
    },
];

/// Runs the tables, or those whose subject or module contains a word, and writes the page; sections that do not run stay.
pub fn run(word: Option<&str>) -> ExitCode {
    match written(word) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn written(word: Option<&str>) -> Result<bool, String> {
    let repository = Repository::open()?;
    let before = repository.text(PAGE).unwrap_or_default();
    let asked = |table: &&Table| {
        word.is_none_or(|word| table.module == word || table.subject.contains(word))
    };
    if !TABLES.iter().any(|table| asked(&table)) {
        let known: Vec<&str> = TABLES.iter().map(|table| table.module).collect();
        return Err(format!(
            "no table of that name: there are {}",
            known.join(", ")
        ));
    }
    let mut page = String::from(HEAD);
    let mut good = true;
    for table in TABLES {
        let heading = format!("## {}\n", table.subject);
        if asked(&table) {
            eprintln!("{}: {} seeds", table.subject, table.seeds);
            let (text, passed) = measured(&repository, table)?;
            good &= passed;
            let _ = write!(page, "\n{heading}{text}");
        } else if let Some(text) = section(&before, &heading) {
            let _ = write!(page, "\n{heading}{text}");
        }
    }
    std::fs::write(repository.root.join(PAGE), page).map_err(|error| format!("{PAGE}: {error}"))?;
    Ok(good)
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
        .args(["-p", table.package, "--tests", "--"])
        .args(["--nocapture", "--test-threads=1", "--format=pretty"])
        .args(names)
        .env("AUXBEAR_SEEDS", table.seeds.to_string())
        .stderr(std::process::Stdio::inherit())
        .output()
        .map_err(|error| format!("cargo test: {error}"))?;
    let printed = String::from_utf8_lossy(&output.stdout);
    let folder = format!(
        "crates/{}/tests/{}",
        table.package.trim_start_matches("auxbear-"),
        table.module
    );
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
struct Ran {
    name: String,
    lines: Vec<String>,
    passed: bool,
}

/// The tests of an output without capture: `test NAME ... ` stands before the first line that a test prints, `ok` on a line of
/// its own behind the last.
fn tests(output: &str) -> Vec<Ran> {
    let mut found: Vec<Ran> = Vec::new();
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
                found.push(Ran {
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
        let ran = |name: &str, lines: &[&str], passed| Ran {
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
