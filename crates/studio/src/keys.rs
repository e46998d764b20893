//! The table of keys as forms need it.

use auxbear::scenario::rotor::keys::PARTS;
use auxbear::scenario::{
    Fallback, Key, Kind, Otherwise, Presence, SystemName, key, presence, sections_of, table,
};
use serde_json::{Value, json};

/// Sections, keys and parts of a kind of file, in their order; of a study its schema alone. None for what is no kind.
pub fn of_kind(kind: &str) -> Option<Value> {
    let word = if kind == "qualify" { "study" } else { kind };
    let schema: Value = serde_json::from_str(&auxbear::schema(word)?).ok()?;
    let Some(system) = SystemName::of(word) else {
        return Some(json!({ "kind": kind, "sections": [], "parts": [], "schema": schema }));
    };
    let mut sections =
        vec![json!({ "path": "", "doc": system.about(), "keys": keys_of(system, "") })];
    let known = sections_of(system).map(|section| {
        json!({ "path": section.path, "doc": section.doc, "keys": keys_of(system, section.path) })
    });
    sections.extend(known.filter(|section| {
        section["keys"]
            .as_array()
            .is_some_and(|keys| !keys.is_empty())
    }));
    let parts = PARTS
        .iter()
        .filter(|part| system.has_shaft() && system.has_part(part.word));
    let parts: Vec<Value> = parts
        .map(|part| {
            let keys: Vec<Value> = part
                .keys
                .iter()
                .map(|key| about(key, key.presence))
                .collect();
            let first = part.starting.first().copied().unwrap_or_default();
            json!({ "path": part.path(), "doc": part.doc, "keys": keys, "start": first })
        })
        .collect();
    let (quantity, bound) = system.limit_example();
    let (side, value) = bound.split_once(" = ").unwrap_or((bound, ""));
    let limit = [["quantity", quantity], [side, value.trim_matches('"')]];
    Some(
        json!({ "kind": kind, "sections": sections, "parts": parts, "limit": limit, "several": system.has_auxiliary_bearings(), "schema": schema }),
    )
}

fn keys_of(system: SystemName, section: &str) -> Vec<Value> {
    let keys = table::keys_of(system).filter(|key| key.section() == section);
    keys.map(|key| about(key, presence(key, system))).collect()
}

/// A key in the words of a form.
fn about(key: &'static Key, presence: Presence) -> Value {
    let words: &[&str] = match key.kind {
        Kind::Word(words) | Kind::Words(words) => words,
        Kind::Switch => &["true", "false"],
        _ => &[],
    };
    let (fallback, without) = match presence {
        Presence::Required => (None, "it must be given".to_string()),
        Presence::FromBearing => (None, "the catalogue gives it with bearing.name".to_string()),
        Presence::Optional(meaning) => (None, meaning.to_string()),
        Presence::Derived(how) => (None, format!("computed: {how}")),
        Presence::Default(own) => (Some(own), String::new()),
        Presence::DefaultWhen(condition, own, otherwise) => {
            let rest = match otherwise {
                Otherwise::Required => "required otherwise".to_string(),
                Otherwise::Fallback(other) => format!("otherwise {}", said(&other)),
            };
            (
                None,
                format!("with {} {}; {rest}", condition.text(), said(&own)),
            )
        }
    };
    let without = fallback.map_or(without, |own| said(&own));
    let conditions: Vec<String> = key::conditions(key).map(|own| own.text()).collect();
    json!({
        "path": key.path,
        "name": key.name(),
        "unit": key.unit(),
        "words": words,
        "several": matches!(key.kind, Kind::Words(_) | Kind::Texts | Kind::Table(..) | Kind::Quantities(_) | Kind::Series(_) | Kind::Matrix(_) | Kind::Filters),
        "doc": key.doc,
        "needed": key.needed(),
        "example": key.example,
        "required": presence == Presence::Required,
        "without": without,
        "default": fallback.map(|own| own.text),
        "when": conditions,
    })
}

fn said(fallback: &Fallback) -> String {
    let mark = if fallback.assumed {
        "assumed"
    } else {
        "default"
    };
    format!("{mark} {}: {}", fallback.text, fallback.reason)
}

/// The literal of what was typed for a key of a kind of file: in quotes where its kind is a text, and where it is no value otherwise.
pub fn literal(kind: &str, path: &str, typed: &str) -> String {
    let typed = typed.trim();
    let key = SystemName::of(kind).and_then(|system| {
        let part = PARTS.iter().find_map(|part| {
            let name = path.strip_prefix(part.path())?.strip_prefix('.')?;
            part.keys.iter().find(|key| key.name() == name)
        });
        let own = || table::keys_of(system).find(|key| key.path == path);
        part.or_else(own)
    });
    let plain = match key {
        Some(key) => key.literal(typed),
        None => typed.to_string(),
    };
    let is_value = || {
        toml::from_str::<toml::Table>(&format!("x = {plain}")).is_ok_and(|table| table.len() == 1)
    };
    match is_value() && !plain.contains('\n') {
        true => plain,
        false => auxbear::scenario::quoted(typed),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use auxbear::scenario::KINDS;

    #[test]
    fn every_kind_has_its_forms() {
        for kind in KINDS {
            let keys = of_kind(kind).unwrap();
            assert!(keys["schema"]["properties"].is_object(), "{kind}");
            if *kind == "study" {
                continue;
            }
            let sections = keys["sections"].as_array().unwrap();
            let all = sections
                .iter()
                .flat_map(|section| section["keys"].as_array().unwrap());
            let count = all
                .inspect(|key| assert!(!key["doc"].as_str().unwrap().is_empty()))
                .count();
            let system = SystemName::of(kind).unwrap();
            assert_eq!(count, table::keys_of(system).count(), "{kind}");
        }
        assert!(of_kind("nonsense").is_none());
    }

    #[test]
    fn what_is_typed_becomes_a_literal_that_reads() {
        assert_eq!(literal("drop", "rotor.mass", "9 kg"), "\"9 kg\"");
        assert_eq!(
            literal("drop", "contact.friction_coefficient", " 0.2"),
            "0.2"
        );
        // what is no number is said by the program itself, not by a text that is broken
        assert_eq!(
            literal("drop", "contact.friction_coefficient", "much"),
            "\"much\""
        );
        assert_eq!(literal("drop", "contact.exponent", "10/9"), "\"10/9\"");
        assert_eq!(literal("machine", "rotor.section.length", "1 m"), "\"1 m\"");
        assert_eq!(literal("study", "design.members", "64"), "64");
        assert_eq!(literal("study", "design.kind", "sweep"), "\"sweep\"");
        assert_eq!(
            literal("drop", "title", "1\" = 2\ny = 3"),
            "\"1\\\" = 2\\ny = 3\""
        );
    }
}
