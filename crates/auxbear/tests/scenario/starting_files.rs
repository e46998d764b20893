//! Starting files: what they say by example holds together, and every example line is one that may be uncommented.

use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario, SystemName, template};
use std::sync::atomic::AtomicBool;

/// A commented example: a key, then its value.
fn example(line: &str) -> Option<&str> {
    let text = line.strip_prefix('#')?.trim_start();
    let (key, _) = text.split_once(" = ")?;
    let is_key = !key.is_empty()
        && key
            .chars()
            .all(|c| c.is_ascii_lowercase() || "_0123456789".contains(c));
    is_key.then_some(text)
}

#[test]
fn every_example_line_is_valid_toml() {
    for kind in (SystemName::ALL.iter().map(|system| system.word())).chain(["study"]) {
        let text = template(kind).unwrap();
        let lines: Vec<&str> = text.lines().filter_map(example).collect();
        assert!(lines.len() > 5, "{kind}");
        for line in lines {
            let read = line.parse::<toml::Table>();
            assert!(read.is_ok(), "{kind}: {line}: {read:?}");
        }
    }
}

/// A series of one value was written without quotes.
#[test]
fn coefficients_of_a_support_can_be_uncommented() {
    let text = template("rotor").unwrap();
    let (before, support) = text.split_once("\n[[rotor.support]]\n").unwrap();
    let (support, _) = support.split_once("\n[[").unwrap();
    let lines = support.lines().filter_map(example);
    let coefficients: Vec<&str> = lines.filter(|line| line.contains("/m\"")).collect();
    assert!(coefficients.len() > 4, "{coefficients:?}");
    for line in coefficients {
        let support = support.replacen(&format!("# {line}"), line, 1);
        let text = format!("{before}\n[[rotor.support]]\n{support}");
        let read = Scenario::parse(&text, "new.toml", &[], &BuiltIn);
        assert!(read.is_ok(), "{line}: {}", read.unwrap_err());
    }
}

#[test]
fn the_shaft_of_the_starting_machine_fits_its_bearings() {
    let text = template("machine").unwrap();
    let sets = ["run.duration=1 ms".to_string()];
    let scenario = Scenario::parse(&text, "new.toml", &sets, &BuiltIn).unwrap();
    let outcome = run(&scenario, &Options::unwatched(&AtomicBool::new(false))).unwrap();
    let told: Vec<&str> = outcome.warnings.iter().map(|w| w.code).collect();
    assert!(
        !told.contains(&"AB2033") && told.contains(&"AB1013"),
        "{told:?}"
    );
}
