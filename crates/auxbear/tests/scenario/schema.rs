//! The JSON Schema of scenario files: what the program accepts is right by it, and what it can know to be wrong is not.
//!
//! The judge below knows the words of JSON Schema that the schema uses, and panics at any other.

use auxbear::catalogue;
use auxbear::scenario::system::OVER_TIME;
use auxbear::scenario::{
    BuiltIn, Scenario, SystemName, keys_of, parts_of, schema, sections_of, template,
};
use regex_lite::Regex;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

fn schema_of(kind: &str) -> Value {
    serde_json::from_str(&schema(kind).unwrap()).unwrap()
}

/// Whether a value is right by a schema.
pub fn right(schema: &Value, value: &Value) -> bool {
    let rules = match schema {
        Value::Bool(verdict) => return *verdict,
        other => other.as_object().unwrap(),
    };
    let list = |rule: &Value| rule.as_array().unwrap().clone();
    let member = |name: &str| schema.get(name).cloned().unwrap_or(json!(true));
    rules.iter().all(|(word, rule)| match word.as_str() {
        "$schema" | "title" | "description" | "default" | "examples" | "then" | "else" => true,
        "type" if rule.is_array() => {
            let mut any = list(rule).into_iter();
            any.any(|one| right(&json!({ "type": one }), value))
        }
        "type" => match rule.as_str().unwrap() {
            "null" => value.is_null(),
            "object" => value.is_object(),
            "array" => value.is_array(),
            "string" => value.is_string(),
            "boolean" => value.is_boolean(),
            "number" => value.is_number(),
            "integer" => value.is_i64() || value.is_u64(),
            other => panic!("type {other}"),
        },
        "enum" => list(rule).contains(value),
        "pattern" => {
            let pattern = Regex::new(rule.as_str().unwrap()).unwrap();
            value.as_str().is_none_or(|text| pattern.is_match(text))
        }
        "minimum" => value.as_f64().is_none_or(|x| x >= rule.as_f64().unwrap()),
        "maximum" => value.as_f64().is_none_or(|x| x <= rule.as_f64().unwrap()),
        "exclusiveMinimum" => value.as_f64().is_none_or(|x| x > rule.as_f64().unwrap()),
        "properties" => value.as_object().is_none_or(|object| {
            let known = rule.as_object().unwrap();
            let mut both = object.iter().filter_map(|(k, v)| Some((known.get(k)?, v)));
            both.all(|(schema, value)| right(schema, value))
        }),
        "additionalProperties" => {
            let known = member("properties");
            let mut all = value.as_object().into_iter().flatten();
            all.all(|(name, value)| known.get(name).is_some() || right(rule, value))
        }
        "required" => value.as_object().is_none_or(|object| {
            let names = list(rule);
            names
                .iter()
                .all(|name| object.contains_key(name.as_str().unwrap()))
        }),
        "items" => value
            .as_array()
            .is_none_or(|items| items.iter().all(|item| right(rule, item))),
        "prefixItems" => value.as_array().is_none_or(|items| {
            let mut both = list(rule).into_iter().zip(items);
            both.all(|(schema, item)| right(&schema, item))
        }),
        "minItems" => value
            .as_array()
            .is_none_or(|items| items.len() as u64 >= rule.as_u64().unwrap()),
        "maxItems" => value
            .as_array()
            .is_none_or(|items| items.len() as u64 <= rule.as_u64().unwrap()),
        "anyOf" => list(rule).iter().any(|schema| right(schema, value)),
        "oneOf" => {
            let fit = list(rule)
                .iter()
                .filter(|schema| right(schema, value))
                .count();
            fit == 1
        }
        "allOf" => list(rule).iter().all(|schema| right(schema, value)),
        "not" => !right(rule, value),
        "if" => {
            let branch = if right(rule, value) { "then" } else { "else" };
            right(&member(branch), value)
        }
        other => panic!("the word {other}"),
    })
}

fn parsed(text: &str) -> Value {
    toml::from_str(text).unwrap()
}

pub(super) fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        // a study is no scenario
        .filter(|path| !fs::read_to_string(path).unwrap().contains("auxbear.study/"))
        .collect();
    files.sort();
    assert!(files.len() >= 2);
    files
}

/// Every file that ships or is written by the program, with its name.
fn written() -> Vec<(String, String)> {
    let mut texts: Vec<(String, String)> = shipped()
        .iter()
        .map(|path| {
            (
                path.display().to_string(),
                fs::read_to_string(path).unwrap(),
            )
        })
        .collect();
    for system in SystemName::ALL {
        let name = format!("new {}", system.word());
        texts.push((name, template(system.word()).unwrap()));
    }
    let resolved = |(name, text): &(String, String)| {
        let scenario = Scenario::parse(text, name, &[], &BuiltIn).unwrap();
        (format!("{name}, resolved"), scenario.resolved.toml())
    };
    let resolved: Vec<_> = texts.iter().map(resolved).collect();
    texts.extend(resolved);
    texts
}

#[test]
fn what_ships_and_what_the_program_writes_is_right() {
    for (name, text) in written() {
        let file = parsed(&text);
        let kind = match &file["system"] {
            Value::Object(table) => table["value"].as_str().unwrap(),
            word => word.as_str().unwrap(),
        };
        assert!(right(&schema_of(kind), &file), "{name}");
    }
}

#[test]
fn the_schema_has_every_section_and_key_and_no_other() {
    for system in SystemName::ALL {
        let root = schema_of(system.word());
        let mut found = Vec::new();
        list(&root, "", &mut found);
        let mut known: Vec<String> = keys_of(*system).map(|key| key.path.to_string()).collect();
        known.extend(sections_of(*system).map(|section| section.path.to_string()));
        known.push("limit".to_string());
        known.extend(parts_of(*system).map(|(path, _)| path));
        if *system == SystemName::Machine {
            // what is asked of its rotor
            let asked = keys_of(SystemName::Rotor).map(|key| key.path);
            let asked = asked.filter(|path| path.starts_with("analysis."));
            known.extend(asked.chain(["analysis"]).map(String::from));
        }
        if OVER_TIME.contains(system) {
            known.push("measured".to_string());
        }
        if system.has_auxiliary_bearings() {
            known.push("auxiliary_bearing".to_string());
        }
        if system.falls() {
            known.push("vary".to_string());
        }
        found.sort();
        known.sort();
        assert_eq!(found, known);
    }
}

#[test]
fn a_limit_is_right_with_one_bound_and_no_other_key() {
    let schema = schema_of("drop");
    let with = |lines: &str| {
        let text = format!("{}\n[[limit]]\n{lines}\n", template("drop").unwrap());
        right(&schema, &parsed(&text))
    };
    assert!(with("quantity = \"contact_count\"\nmost = 5\nshare = 0.9"));
    assert!(with("quantity = \"peak_contact_force\"\nleast = \"5 kN\""));
    assert!(with("warning = \"AB2030\"") && with("severity = \"destroys\"\nshare = 0.9"));
    for wrong in [
        "quantity = \"contact_count\"",
        "most = 5",
        "quantity = \"contact_count\"\nmost = 5\nleast = 4",
        "quantity = \"contact_count\"\nmax = 5",
        "warning = \"AB2030\"\nseverity = \"note\"",
        "severity = \"bad\"",
        "quantity = \"contact_count\"\nmost = 5\nshare = 2",
    ] {
        assert!(!with(wrong), "{wrong}");
    }
    let torque = parsed(&format!(
        "{}\n[[limit]]\nquantity = \"power_loss\"\nmost = \"1 W\"\nshare = 0.9\n",
        template("torque").unwrap()
    ));
    assert!(!right(&schema_of("torque"), &torque));
}

/// Paths of all sections and keys of a schema; each has a description.
fn list(schema: &Value, path: &str, found: &mut Vec<String>) {
    assert!(
        schema["description"].as_str().unwrap().ends_with('.'),
        "{path}"
    );
    let Some(properties) = schema.get("properties").and_then(Value::as_object) else {
        return;
    };
    for (name, inner) in properties {
        let path = if path.is_empty() {
            name.clone()
        } else {
            format!("{path}.{name}")
        };
        list(inner, &path, found);
        found.push(path);
    }
}

/// The starting file of a kind with lines put at the ends of sections, and lines taken out.
fn edited(kind: &str, without: &[&str], with: &[(&str, &str)]) -> Value {
    let mut file = parsed(&template(kind).unwrap());
    for path in without {
        let (section, key) = path.rsplit_once('.').unwrap();
        at(&mut file, section)
            .as_object_mut()
            .unwrap()
            .remove(key)
            .unwrap();
    }
    for (section, line) in with {
        let more = parsed(line);
        let table = at(&mut file, section).as_object_mut().unwrap();
        for (key, value) in more.as_object().unwrap() {
            table.insert(key.clone(), value.clone());
        }
    }
    file
}

fn at<'a>(file: &'a mut Value, section: &str) -> &'a mut Value {
    let names = section.split('.').filter(|name| !name.is_empty());
    names.fold(file, |node, name| {
        if node.get(name).is_none() {
            node[name] = json!({});
        }
        &mut node[name]
    })
}

type Edit<'a> = (&'a str, &'a [&'a str], &'a [(&'a str, &'a str)]);

#[test]
fn right_edits_are_right_and_wrong_ones_are_not() {
    let good: &[Edit] = &[
        (
            "drop",
            &[],
            &[("rotor", "mass = { value = \"8 kg\", source = \"scales\" }")],
        ),
        (
            "drop",
            &[],
            &[("rotor", "spin = \"braked\"\nbrake_torque = \"2 N m\"")],
        ),
        (
            "drop",
            &[],
            &[("contact", "exponent = \"3/2\"\nstiffness = \"1e8 N/m^1.5\"")],
        ),
        (
            "drop",
            &["bearing.name"],
            &[
                ("contact", "bore_diameter = \"25 mm\""),
                (
                    "bearing",
                    "ball_count = 10\nball_diameter = \"6.35 mm\"\npitch_diameter = \"36 mm\"",
                ),
                (
                    "bearing",
                    "inner_race_mass = \"20 g\"\ninner_race_inertia = \"3.9e-6 kg m^2\"\ncage_mass = \"5 g\"",
                ),
            ],
        ),
        (
            "drop",
            &[],
            &[(
                "bearing.traction",
                "law = \"dry\"\nkinetic = 0.1\nstatic = 0.15\ndecay_speed = \"0.5 m/s\"",
            )],
        ),
        (
            "spin_up",
            &["drive.radial_load"],
            &[(
                "drive",
                "load_history = [[\"0 s\", \"1 N\"], [\"1 s\", \"2 N\"]]",
            )],
        ),
    ];
    for (kind, without, with) in good {
        assert!(
            right(&schema_of(kind), &edited(kind, without, with)),
            "{with:?}"
        );
    }
    let wrong: &[Edit] = &[
        ("drop", &[], &[("rotor", "mas = \"8 kg\"")]),
        ("drop", &[], &[("rotor", "mass = 8")]),
        ("drop", &[], &[("rotor", "mass = \"8\"")]),
        ("drop", &[], &[("rotor", "mass = { source = \"scales\" }")]),
        (
            "drop",
            &[],
            &[(
                "rotor",
                "mass = { value = \"8 kg\", source = \"a\", assumed = \"b\" }",
            )],
        ),
        ("drop", &["rotor.mass"], &[]),
        ("drop", &[], &[("rotor", "planes = 9")]),
        ("drop", &[], &[("rotor", "brake_torque = \"2 N m\"")]),
        ("drop", &[], &[("rotor", "spin = \"braked\"")]),
        (
            "drop",
            &[],
            &[(
                "rotor",
                "unbalance = \"1 g mm\"\nunbalance_eccentricity = \"1 um\"",
            )],
        ),
        ("drop", &[], &[("contact", "exponent = 3.0")]),
        ("drop", &["bearing.name"], &[]),
        ("drop", &[], &[("", "[drive]\nkind = \"torque\"")]),
        ("drop", &[], &[("", "system = \"spin_up\"")]),
        ("drop", &[], &[("bearing.traction", "law = \"dry\"")]),
        ("spin_up", &["drive.radial_load"], &[]),
        (
            "spin_up",
            &[],
            &[(
                "drive",
                "load_history = [[\"0 s\", \"1 N\"], [\"1 s\", \"2 N\"]]",
            )],
        ),
        (
            "spin_up",
            &["drive.radial_load"],
            &[(
                "drive",
                "load_history = [[\"0 s\", \"1 N\", \"2 N\"], [\"1 s\", \"2 N\"]]",
            )],
        ),
        ("spin_up", &[], &[("drive", "final_speed = \"100 rad/s\"")]),
    ];
    for (kind, without, with) in wrong {
        assert!(
            !right(&schema_of(kind), &edited(kind, without, with)),
            "{without:?} {with:?}"
        );
    }
}

#[test]
fn quantities_that_the_program_reads_have_the_right_form() {
    let root = schema_of("drop");
    let mass = &root["properties"]["rotor"]["properties"]["mass"];
    let form = |text: &str| right(mass, &json!(text));
    let mut texts: Vec<String> = [
        "8 kg",
        "8kg",
        " .5 kg ",
        "-1e-3 g",
        "+8. kg",
        "−90 deg",
        "0.5 1/(m/s)",
        "2 1",
        "5e8 N/m^(10/9)",
        "1 kg m²",
        "3 °C",
        "15 µm",
        "10 %",
        "1 (m)",
        "5 eV",
        "1e3 1/s",
        "7 E",
    ]
    .map(String::from)
    .to_vec();
    let of_catalogue = catalogue::bearings().iter().take(20);
    texts.extend(
        of_catalogue
            .flat_map(|bearing| bearing.values.iter().map(|value| value.text().to_string())),
    );
    let mut read = 0;
    for text in &texts {
        if units::parse_quantity(text).is_ok() {
            read += 1;
            assert!(form(text), "{text}");
        }
    }
    assert!(read > 100, "{read}");
    for text in [
        "", "8", "8e5", "kg", "8 .kg", "1,5 kg", "2e-5", "- 8 kg", "8 5 kg", "m 8",
    ] {
        assert!(units::parse_quantity(text).is_err(), "{text}");
        assert!(!form(text), "{text}");
    }
}

#[test]
fn a_kind_that_is_not_built_has_no_schema() {
    assert!(schema("gearbox").is_none() && schema("drops").is_none());
}
