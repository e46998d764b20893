//! Changes of a text: what is set and taken away leaves no trace.

use super::*;
use auxbear::scenario::{KINDS, SystemName, template};
use auxbear::scenario::{keys_of, table};
use proptest::prelude::*;

fn names(path: &str) -> Vec<Step> {
    steps(path)
}

#[test]
fn a_value_is_replaced_where_it_stands() {
    let text = "# a file\n[rotor] # its head\nmass = \"8 kg\"  # weighed\n  speed={ value = \"1 rpm\", source = \"x\" }\n";
    let set_mass = set(text, &names("rotor.mass"), "\"9 kg\"").unwrap();
    assert_eq!(set_mass.text, text.replace("8 kg", "9 kg"));
    assert_eq!(set_mass.made, None);
    // the source beside a value stays
    let set_speed = set(text, &names("rotor.speed"), "\"2 rpm\"").unwrap();
    assert_eq!(set_speed.text, text.replace("1 rpm", "2 rpm"));
}

#[test]
fn a_new_key_stands_with_those_of_its_table() {
    let text = "a = 1\n\n[rotor]\nmass = \"8 kg\"\n\n[mount]\n# stiffness = \"1 N/m\"\n";
    let new = |path: &str| set(text, &names(path), "2").unwrap().text;
    assert_eq!(new("b"), text.replace("a = 1\n", "a = 1\nb = 2\n"));
    assert_eq!(new("rotor.x"), text.replace("8 kg\"\n", "8 kg\"\nx = 2\n"));
    assert_eq!(
        new("mount.x"),
        text.replace("[mount]\n", "[mount]\nx = 2\n")
    );
    assert_eq!(new("run.x"), format!("{text}\n[run]\nx = 2\n"));
}

#[test]
fn parts_are_reached_by_their_place() {
    let text = "[[rotor.section]]\nlength = \"1 m\"\n\n[[rotor.section]]\nlength = \"2 m\"\n[[bearing]]\n[bearing.cage]\nx = 1\n\n[[bearing]]\ny = 1\n";
    let path = |k: usize, name: &str| {
        let mut path = names("rotor.section");
        path.push(Step::Place(k));
        path.extend(names(name));
        path
    };
    let longer = set(text, &path(1, "length"), "\"3 m\"").unwrap().text;
    assert_eq!(longer, text.replace("2 m", "3 m"));
    let added = add(
        text,
        &names("rotor.section"),
        &[("length".into(), "\"4 m\"".into())],
    )
    .unwrap();
    assert_eq!(
        typed(&added).unwrap()["rotor"]["section"][2]["length"]["="],
        "4 m"
    );
    let mut third = names("rotor.section");
    third.push(Step::Place(2));
    assert_eq!(remove(&added, &third).unwrap(), text);
    // a table below one of a list stands before the next of that list
    let mut below = names("bearing");
    below.push(Step::Place(0));
    below.extend(names("mount.stiffness"));
    let edited = set(text, &below, "1").unwrap();
    assert_eq!(
        typed(&edited.text).unwrap()["bearing"][0]["mount"]["stiffness"]["="],
        "1"
    );
    let made: Vec<AddedHeader> = edited.made.into_iter().collect();
    assert_eq!(unset(&edited.text, &below, &made).unwrap(), text);
}

#[test]
fn what_no_field_can_change_is_refused() {
    for (text, path) in [
        ("a = {b = 1}\n", "a.c"),
        ("a = 1\n", "a.b"),
        ("[a]\n", "a"),
        ("a = \n", "a"),
        ("[[a]]\nb = 1\n", "a.b"),
    ] {
        assert!(set(text, &names(path), "2").is_err(), "{text:?} {path}");
    }
    // what would not be TOML any more, likewise
    assert!(set("a = 1\n", &names("a"), "not a value").is_err());
}

#[test]
fn a_mark_of_the_encoding_stays_in_front() {
    let text = "\u{feff}a = 1\n[b]\nc = 2\n";
    assert_eq!(
        set(text, &names("b.c"), "3").unwrap().text,
        text.replace('2', "3")
    );
    assert_eq!(
        set(text, &names("a"), "3").unwrap().text,
        text.replace('1', "3")
    );
    let added = set(text, &names("b.d"), "4").unwrap().text;
    assert_eq!(added, format!("{text}d = 4\n"));
    assert_eq!(unset(&added, &names("b.d"), &[]).unwrap(), text);
}

/// Pieces of files: with and without values, comments, indentation, dotted keys, the last line break, and both kinds of line breaks.
fn texts() -> impl Strategy<Value = String> {
    let line = prop_oneof![
        Just("mass = \"8 kg\""),
        Just("  speed = \"1 rpm\" # as measured"),
        Just("# speed = \"2 rpm\""),
        Just(""),
        Just("cage.gap = \"1 mm\""),
        Just("list = [\n  1, # one\n  2,\n]"),
        Just("own = { value = \"1 m\", assumed = \"why\" }"),
    ];
    let header = prop_oneof![
        Just("[rotor]"),
        Just("[mount]  # head"),
        Just("[bearing.moment]"),
        Just("[[event]]"),
        Just("[ contact ]")
    ];
    let section = (header, prop::collection::vec(line.clone(), 0..4));
    (
        prop::collection::vec(line, 0..3),
        prop::collection::vec(section, 0..4),
        any::<bool>(),
        any::<bool>(),
    )
        .prop_map(|(head, sections, ends, windows)| {
            let mut lines: Vec<&str> = head;
            for (header, own) in sections {
                lines.push(header);
                lines.extend(own);
            }
            let mut text = lines.join("\n");
            if ends && !text.is_empty() {
                text.push('\n');
            }
            if windows {
                text.replace('\n', "\r\n")
            } else {
                text
            }
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, ..ProptestConfig::default() })]
    #[test]
    fn set_and_unset_gives_the_same_bytes(text in texts(), path in prop_oneof![
        Just("new"), Just("rotor.new"), Just("mount.new"), Just("mount.branch.new"), Just("bearing.new"),
        Just("bearing.moment.new"), Just("bearing.cage.new"), Just("run.new"), Just("cage.new"), Just("rotor.cage.new"), Just("contact.new"),
    ]) {
        prop_assume!(typed(&text).is_ok());
        let Ok(edited) = set(&text, &names(path), "\"1 m\"") else { return Ok(()) };
        prop_assert_ne!(&edited.text, &text);
        let made: Vec<AddedHeader> = edited.made.into_iter().collect();
        prop_assert_eq!(unset(&edited.text, &names(path), &made).unwrap(), text);
    }

    /// A value that is changed and changed back leaves no trace either.
    #[test]
    fn changing_back_gives_the_same_bytes(text in texts(), path in prop_oneof![Just("mass"), Just("rotor.mass"), Just("rotor.own"), Just("mount.speed"), Just("rotor.cage.gap")]) {
        prop_assume!(typed(&text).is_ok());
        let tree = typed(&text).unwrap();
        let before = path.split('.').fold(&tree, |tree, name| &tree[name])["="].clone();
        let Some(before) = before.as_str() else { return Ok(()) };
        let changed = set(&text, &names(path), "\"other\"").unwrap().text;
        let back = set(&changed, &names(path), &auxbear::scenario::quoted(before)).unwrap().text;
        prop_assert_eq!(back, text);
    }
}

/// Every key of every starting file: the field of each can be filled in and emptied.
#[test]
fn every_key_of_every_starting_file_is_set_and_unset() {
    for kind in KINDS.iter().filter_map(|kind| SystemName::of(kind)) {
        let text = template(kind.word()).unwrap();
        let given = typed(&text).unwrap();
        for key in keys_of(kind) {
            let there = key
                .path
                .split('.')
                .try_fold(&given, |tree, name| tree.get(name));
            if there.is_some_and(|value| value.get("=").is_some()) {
                continue;
            }
            let literal = key.literal(key.example);
            let edited = set(&text, &names(key.path), &literal)
                .unwrap_or_else(|why| panic!("{}: {why}", key.path));
            let made: Vec<AddedHeader> = edited.made.into_iter().collect();
            let back = unset(&edited.text, &names(key.path), &made).unwrap();
            assert_eq!(back, text, "{} in {}", key.path, kind.word());
        }
    }
    assert!(table::key("rotor.mass").is_some());
}
