//! Codes of warnings: one severity each, none used again for another thing, each with a section in the book.

use auxbear::problem::Code;
use auxbear::run::warnings::declared;
use std::collections::{BTreeMap, BTreeSet};

const LIST: &str = include_str!("data/warning_codes.txt");
const BOOK: &str = include_str!("../../problem/src/codes.md");

/// A new kind of warning is a row of its home's table and a line here; a number that was given up stays here as retired.
#[test]
fn codes_and_severities_are_those_of_the_list() {
    let mut kinds: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for kind in declared() {
        let severities = kinds.entry(kind.code).or_default();
        severities.insert(kind.severity.word());
    }
    let words = |(code, severities): (&&str, &BTreeSet<&str>)| {
        let all: Vec<&str> = severities.iter().copied().collect();
        format!("{code} {}", all.join(" "))
    };
    let found: BTreeSet<String> = kinds.iter().map(words).collect();
    let (retired, listed): (BTreeSet<&str>, BTreeSet<&str>) =
        (LIST.lines()).partition(|line| line.ends_with(" retired"));
    let listed: BTreeSet<String> = listed.into_iter().map(str::to_string).collect();
    assert_eq!(found, listed);
    for line in retired {
        let code = line.trim_end_matches(" retired");
        let again = kinds.contains_key(code) || Code::ALL.iter().any(|own| own.text() == code);
        assert!(!again, "{code} is retired");
    }
}

#[test]
fn variants_have_names_of_their_own_in_a_code() {
    let mut seen = BTreeSet::new();
    for kind in declared() {
        assert!(seen.insert((kind.code, kind.name)), "{kind:?}");
    }
}

#[test]
fn every_code_has_a_section_with_a_title_and_every_section_a_code() {
    let problems = Code::ALL.iter().map(|code| code.text());
    let codes: BTreeSet<&str> = problems.chain(declared().map(|kind| kind.code)).collect();
    let sections = BOOK.split("\n## ").skip(1);
    let sections: BTreeMap<&str, &str> = sections.filter_map(|own| own.split_once('\n')).collect();
    let titled: BTreeSet<&str> = (sections.iter())
        .filter(|(_, text)| text.trim_start().starts_with("**"))
        .map(|(code, _)| *code)
        .collect();
    assert_eq!(titled, codes);
    assert_eq!(sections.len(), titled.len());
}
