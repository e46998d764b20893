//! JSON Schema of a scenario file, made from the table of keys: editors complete, explain and check with it what is typed.
//!
//! | the table of keys says | the schema says |
//! |---|---|
//! | sections and keys of the system | `properties`, and `additionalProperties: false`: an unknown key is an error |
//! | kind | `type`, `enum`, `pattern` of a quantity; each value also as `{ value, source }` or `{ value, assumed }` |
//! | range | limits of bare numbers; of quantities in the description only, as their unit is free |
//! | default, meaning without it, reason | `default`, `description` |
//! | required, or from the catalogue | `required`; without `bearing.name` what the catalogue would fill |
//! | only with another key's value | `if`, `then`, `else` |
//! | two keys for one thing | `not` both |
//!
//! What an editor cannot know is left to `auxbear check`: dimensions of units, ranges of quantities, what the catalogue
//! knows of a bearing, and every check between values. Nothing that the program accepts is refused by the schema,
//! but for the spellings of earlier files.

mod plain;

use self::plain::{QUANTITY, plain};
use crate::key::{Condition, Key, Kind, Otherwise, Presence, Section};
use crate::measured::{MEASURED, TABLE};
use crate::rotor::keys::{PARTS, PartKind};
use crate::several::{AUXILIARY_BEARING, LIMIT, VARY, of_each_bearing};
use crate::system::{OVER_TIME, SystemName};
use crate::table;
use crate::values::{COMPARED_LAWS, LAW};
use problem::read::FILLED_IN;
use problem::warning::Severity;
use serde_json::{Map, Value, json};

/// Dialect of the schema.
const DIALECT: &str = "https://json-schema.org/draft/2020-12/schema";

/// The JSON Schema (draft 2020-12) of the files of a system; `None` for a kind that is not built yet.
pub fn schema(kind: &str) -> Option<String> {
    if kind == super::template::STUDY {
        let limits = format!("\"limit\": {}", limits(SystemName::Machine));
        return Some(include_str!("study_schema.json").replace("\"limit\": true", &limits));
    }
    let system = SystemName::of(kind)?;
    // strings and numbers always serialise
    let text = serde_json::to_string_pretty(&root(system)).unwrap_or_default();
    Some(text + "\n")
}

fn root(system: SystemName) -> Value {
    let mut root = object(&format!("A scenario of auxbear, system {}.", system.word()));
    for section in table::sections_of(system) {
        let (parent, name) = section.path.rsplit_once('.').unwrap_or(("", section.path));
        properties(&mut root, parent).insert(name.to_string(), object(section.doc));
    }
    for key in table::keys_of(system) {
        properties(&mut root, key.section()).insert(key.name().to_string(), value(key, system));
    }
    for key in table::keys_of_analysis(system) {
        let of = properties(&mut root, "").entry(table::ANALYSIS);
        of.or_insert_with(|| {
            object("What `auxbear rotor` computes of the rotor; a run does not read it.")
        });
        let known = value(key, SystemName::Rotor);
        properties(&mut root, key.section()).insert(key.name().to_string(), known);
    }
    properties(&mut root, "").insert(LIMIT.to_string(), limits(system));
    if OVER_TIME.contains(&system) {
        properties(&mut root, "").insert(MEASURED.to_string(), parts(&TABLE, system));
    }
    if system.has_shaft() {
        for kind in PARTS.iter().filter(|kind| system.has_part(kind.word)) {
            properties(&mut root, kind.table()).insert(kind.word.to_string(), parts(kind, system));
        }
        require(&mut root, "rotor.section");
    }
    let mut rules = exclusions(system);
    // what each of several auxiliary bearings may have of its own needs not stand in the head of the file
    let mut single = Vec::new();
    single.extend(from_bearing(system));
    let (of_bearing, of_file) = conditional(system, &|key| several(system, key));
    single.extend(of_bearing);
    rules.extend(of_file);
    let mut needed = json!({});
    for key in table::keys_of(system) {
        let required = table::presence(key, system) == Presence::Required;
        if !required || !conditions(key, system).is_empty() {
            continue;
        }
        let own = several(system, key);
        match stand_ins(key, system).as_slice() {
            [] if own => require(&mut needed, key.path),
            [] => require(&mut root, key.path),
            others if own => single.push(one_of_them(key, others)),
            others => rules.push(one_of_them(key, others)),
        }
    }
    if system.has_auxiliary_bearings() {
        add_bearings(&mut root, system);
        single.push(needed);
        rules.push(
            json!({ "if": { "not": given(AUXILIARY_BEARING) }, "then": { "allOf": single } }),
        );
    } else {
        rules.append(&mut single);
    }
    root["$schema"] = json!(DIALECT);
    root["title"] = json!(format!("auxbear {}", system.word()));
    root["allOf"] = json!(rules);
    root
}

/// Whether a key may belong to one of several auxiliary bearings.
fn several(system: SystemName, key: &Key) -> bool {
    system.has_auxiliary_bearings() && of_each_bearing(key.path)
}

/// The array of several auxiliary bearings, and what repeated runs vary.
fn add_bearings(root: &mut Value, system: SystemName) {
    let mut one = object("An auxiliary bearing that differs from the others: what it alone has.");
    let keys = || table::keys_of(system).filter(|key| of_each_bearing(key.path));
    let own =
        |section: &&Section| keys().any(|key| key.path.starts_with(&format!("{}.", section.path)));
    for section in table::sections_of(system).filter(own) {
        let (parent, name) = section.path.rsplit_once('.').unwrap_or(("", section.path));
        properties(&mut one, parent).insert(name.to_string(), object(section.doc));
    }
    for key in keys() {
        properties(&mut one, key.section()).insert(key.name().to_string(), value(key, system));
    }
    let name = json!({ "type": "string", "pattern": r"^[^\s.]+$", "description": "Its name: results carry it." });
    properties(&mut one, "").insert("name".to_string(), name);
    one["required"] = json!(["name"]);
    let list = json!({
        "type": "array",
        "items": one,
        "description": "Auxiliary bearings that differ. planes and sections contact, mount and bearing in the head of the file hold for all of them.",
    });
    properties(root, "").insert(AUXILIARY_BEARING.to_string(), list);
    if system.falls() {
        let vary = json!({
            "type": "object",
            "description": "What repeated runs vary: dotted paths in quotes, each with one of lognormal, normal, uniform, triangular, choice.",
        });
        properties(root, "").insert(VARY.to_string(), vary);
    }
}

/// The array of parts of one kind.
fn parts(kind: &PartKind, system: SystemName) -> Value {
    let mut one = object(kind.doc);
    for key in kind.keys {
        properties(&mut one, "").insert(key.name().to_string(), value(key, system));
        if key.presence == Presence::Required {
            require(&mut one, key.name());
        }
    }
    let several = json!({ "type": "array", "items": one });
    match kind.alone {
        true => json!({ "anyOf": [several, one], "description": kind.doc }),
        false => json!({ "type": "array", "items": one, "description": kind.doc }),
    }
}

/// The array of what results must hold.
fn limits(system: SystemName) -> Value {
    let mut one = object("A limit that a result must hold; the verdict stands among the results.");
    let numbers = json!([{ "type": "string", "pattern": QUANTITY }, { "type": "number" }]);
    let with = |words: &str| json!({ "anyOf": numbers, "description": words });
    let text = |words: &str| json!({ "type": "string", "description": words });
    let mut keys = vec![
        ("quantity", text("Name of a result, as in summary.json.")),
        (
            "source",
            text("Where the bound comes from: a standard, a drawing, a contract."),
        ),
        ("most", with("Bound that the result must not exceed.")),
        ("least", with("Bound that the result must not fall below.")),
        (
            "warning",
            json!({ "type": "string", "pattern": "^AB[0-9]{4}$", "description": "Code of a warning that must not come." }),
        ),
        (
            "severity",
            json!({ "enum": Severity::ALL.map(Severity::word), "description": "Severity of which, or worse, no warning must come." }),
        ),
    ];
    if system.falls() {
        let share = json!({ "anyOf": [
            { "type": "number", "exclusiveMinimum": 0, "maximum": 1 },
            { "type": "string", "pattern": QUANTITY },
        ], "description": "Share of the members of a repeated run that must hold it; without it all of them." });
        keys.push(("share", share));
    }
    if system == SystemName::Machine {
        keys.push((
            "case",
            text("Name of the case in which it must hold; in each without."),
        ));
    }
    for (key, schema) in keys {
        properties(&mut one, "").insert(key.to_string(), schema);
    }
    let bounded = |side| json!({ "required": ["quantity", side] });
    one["oneOf"] = json!([
        bounded("most"),
        bounded("least"),
        given("warning"),
        given("severity")
    ]);
    json!({ "type": "array", "items": one, "description": "Limits that results must hold, each with a verdict." })
}

/// A table that knows all its keys.
fn object(doc: &str) -> Value {
    json!({ "type": "object", "description": doc, "properties": {}, "additionalProperties": false })
}

/// The properties of a section of the schema; of the root for an empty path.
fn properties<'a>(root: &'a mut Value, path: &str) -> &'a mut Map<String, Value> {
    let mut node = root;
    for name in path.split('.').filter(|name| !name.is_empty()) {
        node = &mut members(node)[name];
    }
    members(node)
}

/// The member `properties` of a schema, made where there is none.
fn members(schema: &mut Value) -> &mut Map<String, Value> {
    let entry = &mut schema["properties"];
    if !entry.is_object() {
        *entry = json!({});
    }
    entry.as_object_mut().expect("an object by the line above")
}

/// Demands a key and every section above it.
fn require(schema: &mut Value, path: &str) {
    let mut node = &mut *schema;
    for name in path.split('.') {
        let entry = &mut node["required"];
        if !entry.is_array() {
            *entry = json!([]);
        }
        let list = entry.as_array_mut().expect("an array by the line above");
        if !list.iter().any(|known| known == name) {
            list.push(json!(name));
        }
        node = members(node).entry(name).or_insert_with(|| json!({}));
    }
    drop_empty(schema);
}

/// Takes away what says nothing: the empty property that stands for a key demanded.
fn drop_empty(schema: &mut Value) {
    let Some(properties) = schema.get_mut("properties").and_then(Value::as_object_mut) else {
        return;
    };
    for inner in properties.values_mut() {
        drop_empty(inner);
    }
    properties.retain(|_, inner| inner.as_object().is_none_or(|inner| !inner.is_empty()));
    if properties.is_empty()
        && let Some(schema) = schema.as_object_mut()
    {
        schema.remove("properties");
    }
}

/// Says of the value of a key what `leaf` says; not that it must be there.
fn say(schema: &mut Value, path: &str, leaf: Value) {
    let mut node = schema;
    for name in path.split('.') {
        node = members(node).entry(name).or_insert_with(|| json!({}));
    }
    *node = leaf;
}

fn given(path: &str) -> Value {
    let mut schema = json!({});
    require(&mut schema, path);
    schema
}

/// One of a key and those that may stand for it.
fn one_of_them(key: &Key, others: &[&Key]) -> Value {
    let all = std::iter::once(key).chain(others.iter().copied());
    json!({ "anyOf": all.map(|key| given(key.path)).collect::<Vec<_>>() })
}

/// The keys that give the same thing as this one.
fn stand_ins(key: &Key, system: SystemName) -> Vec<&'static Key> {
    table::keys_of(system)
        .filter(|other| other.excludes == Some(key.path))
        .collect()
}

/// Two keys for one thing.
fn exclusions(system: SystemName) -> Vec<Value> {
    let both = |key: &Key| {
        let mut both = given(key.path);
        require(&mut both, key.excludes?);
        Some(json!({ "not": both }))
    };
    table::keys_of(system).filter_map(both).collect()
}

/// Without a name nothing comes from the catalogue.
fn from_bearing(system: SystemName) -> Option<Value> {
    let mut needed = json!({});
    for key in table::keys_of(system) {
        let catalogued = table::presence(key, system) == Presence::FromBearing;
        if catalogued && conditions(key, system).is_empty() {
            require(&mut needed, key.path);
        }
    }
    let any = needed.get("required").is_some();
    any.then(|| json!({ "if": { "not": given("bearing.name") }, "then": needed }))
}

/// The conditions of a key that are a choice in this system.
fn conditions(key: &Key, system: SystemName) -> Vec<Condition> {
    let choice =
        |condition: &&Condition| table::keys_of(system).any(|key| key.path == condition.path);
    crate::key::conditions(key)
        .filter(choice)
        .copied()
        .collect()
}

/// Keys that have a meaning only with other values: one rule for all keys of the same conditions. First the rules of those of
/// which `own` holds.
fn conditional(system: SystemName, own: &dyn Fn(&Key) -> bool) -> (Vec<Value>, Vec<Value>) {
    let mut groups: Vec<(Vec<Condition>, Vec<&Key>)> = Vec::new();
    for key in table::keys_of(system) {
        let conditions = conditions(key, system);
        if conditions.is_empty() {
            continue;
        }
        match groups.iter_mut().find(|group| group.0 == conditions) {
            Some(group) => group.1.push(key),
            None => groups.push((conditions, vec![key])),
        }
    }
    let rule = |(conditions, keys): &(Vec<Condition>, Vec<&Key>)| {
        let all: Vec<Value> = conditions
            .iter()
            .map(|condition| holds(condition, system))
            .collect();
        let mut then = json!({});
        let mut others = Vec::new();
        let mut without = json!({});
        for key in keys {
            say(&mut without, key.path, json!(false));
            match (
                table::presence(key, system),
                stand_ins(key, system).as_slice(),
            ) {
                (Presence::Required, []) => require(&mut then, key.path),
                (Presence::Required, stand_ins) => others.push(one_of_them(key, stand_ins)),
                (Presence::FromBearing, _) => {
                    others.push(json!({ "anyOf": [given("bearing.name"), given(key.path)] }));
                }
                _ => {}
            }
        }
        if !others.is_empty() {
            then["allOf"] = json!(others);
        }
        let compared = conditions.iter().find_map(|c| compared(c, system));
        match compared {
            None => vec![json!({ "if": { "allOf": all }, "then": then, "else": without })],
            // a law that is compared may have its keys, and says why where it lacks one
            Some(compared) => vec![
                json!({ "if": { "allOf": all }, "then": then }),
                json!({ "anyOf": [{ "allOf": all }, compared, without] }),
            ],
        }
    };
    let (of, others): (Vec<_>, Vec<_>) = groups.into_iter().partition(|group| own(group.1[0]));
    (
        of.iter().flat_map(rule).collect(),
        others.iter().flat_map(rule).collect(),
    )
}

/// That a condition on the law holds for a law that is compared.
fn compared(condition: &Condition, system: SystemName) -> Option<Value> {
    let known = table::keys_of(system).any(|key| key.path == COMPARED_LAWS);
    (known && condition.path == LAW).then(|| {
        let word = json!({ "enum": condition.values });
        let none = json!({ "items": { "not": word } });
        let list = json!({ "type": "array", "not": none });
        let mut schema = given(COMPARED_LAWS);
        let some = with_origin(&json!({ "anyOf": [word, list] }));
        say(&mut schema, COMPARED_LAWS, some);
        schema
    })
}

/// That a condition holds, also by the default of its key.
fn holds(condition: &Condition, system: SystemName) -> Value {
    let key = table::keys_of(system).find(|key| key.path == condition.path);
    let by_default = matches!(
        key.map(|key| table::presence(key, system)),
        Some(Presence::Default(fallback)) if condition.values.contains(&fallback.text)
    );
    let mut schema = if by_default {
        json!({})
    } else {
        given(condition.path)
    };
    let values = match key.map(|key| key.kind) {
        Some(Kind::Switch) => {
            let switched: Vec<bool> = condition.values.iter().map(|v| *v == "true").collect();
            json!({ "enum": switched })
        }
        _ => json!({ "enum": condition.values }),
    };
    say(&mut schema, condition.path, with_origin(&values));
    if by_default || condition.path != BEARING_TYPE {
        return schema;
    }
    // the catalogue may tell the type of a bearing that is named
    let by_name = json!({ "allOf": [given("bearing.name"), { "not": given(BEARING_TYPE) }] });
    json!({ "anyOf": [schema, by_name] })
}

/// The key whose value the catalogue tells where a file does not.
const BEARING_TYPE: &str = "bearing.type";

/// One key: its value and its words.
fn value(key: &Key, system: SystemName) -> Value {
    let plain = plain(key, system);
    // the format is read before anything else, as a plain text
    let mut schema = match key.path {
        "format" => plain,
        _ => with_origin(&plain),
    };
    schema["description"] = json!(description(key, system));
    let fallback = match table::presence(key, system) {
        Presence::Default(fallback) => typed(key, fallback.text),
        _ => Value::Null,
    };
    if !fallback.is_null() {
        schema["default"] = fallback;
    }
    let example = match key.path {
        "system" => json!(system.word()),
        _ => typed(key, key.example),
    };
    if !example.is_null() {
        schema["examples"] = json!([example]);
    }
    schema
}

/// A value alone, or with where it comes from.
fn with_origin(plain: &Value) -> Value {
    let text = |words: &str| json!({ "type": "string", "description": words });
    json!({ "anyOf": [plain, {
        "type": "object",
        "properties": {
            "value": plain,
            "source": text("Where the value was read."),
            "assumed": text("Why it is assumed; reports mark it."),
            "from": {
                "enum": FILLED_IN,
                "description": "Written into a resolved file: who filled the value in.",
            },
        },
        "required": ["value"],
        "not": { "required": ["source", "assumed"] },
        "additionalProperties": false,
    }] })
}

/// A value as written in the table, as JSON; null where it has no short form.
fn typed(key: &Key, text: &str) -> Value {
    match key.kind {
        Kind::Coefficient => text.parse().map_or(Value::Null, |value: f64| json!(value)),
        Kind::Count => text.parse().map_or(Value::Null, |value: u64| json!(value)),
        Kind::Switch => json!(text == "true"),
        // a list of texts, or of lists of texts, which TOML and JSON write alike
        Kind::Table(..)
        | Kind::Quantities(_)
        | Kind::Series(_)
        | Kind::Words(_)
        | Kind::Texts
        | Kind::Matrix(_) => serde_json::from_str(text).unwrap_or(Value::Null),
        _ => json!(text),
    }
}

/// What the key is, what it takes, and what holds without it.
fn description(key: &Key, system: SystemName) -> String {
    let mut words = key.doc.to_string();
    // that balls need balls goes without saying
    let conditions: Vec<String> = conditions(key, system)
        .iter()
        .filter(|condition| key.when.contains(condition))
        .map(Condition::text)
        .collect();
    if !conditions.is_empty() {
        words.push_str(&format!(" Only with {}.", conditions.join(" and ")));
    }
    if !matches!(key.kind, Kind::Word(_)) {
        let needed = key.needed();
        let mut letters = needed.chars();
        let first = letters.next().map(|c| c.to_uppercase().to_string());
        words.push_str(&format!(
            " {}{}.",
            first.unwrap_or_default(),
            letters.as_str()
        ));
    }
    let default = |fallback: crate::key::Fallback| {
        let mark = if fallback.assumed {
            "Assumed"
        } else {
            "Default"
        };
        format!("{mark} {}: {}", fallback.text, fallback.reason)
    };
    match table::presence(key, system) {
        Presence::Required => words.push_str(" Required."),
        Presence::FromBearing => {
            words.push_str(" Not needed with a bearing.name that the catalogue knows.");
        }
        Presence::Optional(meaning) => words.push_str(&format!(" Without it {meaning}.")),
        Presence::Derived(how) => words.push_str(&format!(" Without it: {how}.")),
        Presence::Default(fallback) => words.push_str(&format!(" {}.", default(fallback))),
        Presence::DefaultWhen(condition, fallback, otherwise) => {
            let rest = match otherwise {
                Otherwise::Required => "required otherwise".to_string(),
                Otherwise::Fallback(fallback) => format!("otherwise {}", default(fallback)),
            };
            words.push_str(&format!(
                " With {}: {}; {rest}.",
                condition.text(),
                default(fallback)
            ));
        }
    }
    words
}
