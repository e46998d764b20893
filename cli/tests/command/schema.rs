//! `auxbear schema`.

use crate::place::Place;
use serde_json::Value;

#[test]
fn every_kind_of_file_has_a_schema() {
    let place = Place::new();
    for kind in [
        "drop", "spin_up", "torque", "signals", "rig", "identify", "rotor",
    ] {
        let text = place.call(&["schema", kind]).done().out;
        let schema: Value = serde_json::from_str(&text).unwrap();
        assert!(schema["$schema"].as_str().unwrap().contains("2020-12"));
        assert_eq!(schema["additionalProperties"], false);
        assert_eq!(schema["properties"]["system"]["examples"][0], kind);
    }
    assert!(place.names().is_empty());
}

#[test]
fn other_kinds_are_distinguished() {
    let place = Place::new();
    for (kind, code, words) in [
        ("drp", "AB0108", "Did you mean \"drop\"?"),
        ("mount", "AB0112", "planned"),
    ] {
        let called = place.call(&["schema", kind]);
        assert_eq!(called.code, Some(2), "{called:?}");
        assert!(
            called.err.contains(code) && called.err.contains(words),
            "{called:?}"
        );
        assert!(called.out.is_empty());
    }
}
