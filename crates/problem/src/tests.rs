//! What problems look like.

use super::*;

#[test]
fn codes_are_distinct_and_ordered() {
    let codes: Vec<&str> = Code::ALL.iter().map(|code| code.text()).collect();
    assert!(codes.is_sorted_by(|a, b| a < b), "{codes:?}");
}

#[test]
fn prints_as_one_paragraph() {
    let problem = Problem::new(
        Code::BareNumber,
        "drop.toml",
        "a bare number 8",
        "a quantity with a unit is needed, e.g. \"8 kg\"",
    )
    .at(Place::Line {
        line: 12,
        column: 8,
    })
    .on_key("rotor.mass");
    assert_eq!(
        problem.to_string(),
        "error[AB0103]: drop.toml:12: rotor.mass: found a bare number 8; a quantity with a unit is needed, e.g. \"8 kg\""
    );
    assert_eq!(
        problem
            .at(Place::Set)
            .with_hint(did_you_mean("mas", ["mass", "speed"]))
            .to_string(),
        "error[AB0103]: drop.toml, --set: rotor.mass: found a bare number 8; a quantity with a unit is needed, e.g. \"8 kg\". Did you mean \"mass\"?"
    );
}

#[test]
fn what_a_user_typed_cannot_break_the_line() {
    let problem =
        Problem::new(Code::UnknownWord, "a.toml", "\"a\nb\"", "x").on_key("k\u{1b}[2J".repeat(100));
    let text = problem.to_string();
    assert!(!text.contains('\n') && !text.contains('\u{1b}') && text.len() < 300);
}

#[test]
fn offsets_become_lines_and_columns() {
    let text = "a = 1\nµ = 2\n";
    let line = |offset| Place::of_offset(text, offset);
    assert_eq!(line(0), Place::Line { line: 1, column: 1 });
    assert_eq!(line(6), Place::Line { line: 2, column: 1 });
    assert_eq!(line(9), Place::Line { line: 2, column: 3 });
    assert_eq!(line(7), Place::Line { line: 2, column: 1 });
    assert_eq!(line(999), Place::Line { line: 3, column: 1 });
}
