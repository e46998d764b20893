//! What tests ask of an outcome.

use auxbear::outcome::{Column, Outcome};
use auxbear::run::build;
use auxbear::scenario::Scenario;
use regex_lite::Regex;
use std::collections::BTreeSet;

/// The number of a result, which must have one.
pub fn number(outcome: &Outcome, name: &str) -> f64 {
    let value = || outcome.quantity(name).map(|quantity| &quantity.value);
    (outcome.number(name)).unwrap_or_else(|| panic!("{name}: {:?}", value()))
}

/// Compares the columns of a run with those declared before it: names, units, meanings, order. Each `*` stands for what the run decides.
pub fn has_declared_columns(scenario: &Scenario, outcome: &Outcome) {
    let declared = build(scenario).unwrap().columns();
    let stands_for = |pattern: &str, text: &str| {
        let pattern = regex_lite::escape(pattern).replace("\\*", ".+");
        (Regex::new(&format!("^{pattern}$")).unwrap()).is_match(text)
    };
    let place = |column: &Column| {
        let mut all = declared.iter();
        let found = all.position(|known| {
            stands_for(&known.name, &column.name)
                && stands_for(&known.meaning, &column.meaning)
                && (known.unit, known.optional) == (column.unit, column.optional)
        });
        found.unwrap_or_else(|| panic!("{column:?}"))
    };
    let mut places: Vec<usize> = outcome.history.iter().map(place).collect();
    let again = |at: usize| declared[at].name.contains('*');
    let mut seen = BTreeSet::new();
    places.retain(|at| seen.insert(*at) || !again(*at));
    assert!(places.is_sorted_by(|a, b| a < b), "{places:?}");
    for (at, known) in declared.iter().enumerate() {
        let missing = !places.contains(&at) && !known.optional && !again(at);
        assert!(!missing, "{}", known.name);
    }
}
