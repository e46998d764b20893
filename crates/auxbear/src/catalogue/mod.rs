//! Bearings known by name, with the origin of every number.
//!
//! The data stand in `bearings.toml`, which is part of the program. Its format `auxbear.bearings/1`:
//! `[sources]` maps short keys to citations; each `[[bearing]]` has `name`, `description`, and values under the names of
//! the scenario's `[bearing]` keys (and `bore_diameter` of its `[contact]`), plus `outer_diameter`, `width`, `mass`,
//! `limiting_speed` and `dynamic_load_rating`, which describe the bearing. A value is a table
//! `{ value = …, catalogue | derived | assumed = "…" }`: a quantity is a text with unit, a count or ratio a bare number,
//! `ball_material` a word.
//!
//! Masses and inertias are those of the bare ring: a sleeve on it belongs to the inner race and is the user's to add.

use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::OnceLock;

const TEXT: &str = include_str!("bearings.toml");
const FORMAT: &str = "auxbear.bearings/1";

/// How well a number is founded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Read in a maker's table.
    Catalogue,
    /// Computed from values read.
    Derived,
    /// Neither.
    Assumed,
}

impl Mark {
    /// The word of the data file.
    pub fn word(self) -> &'static str {
        match self {
            Mark::Catalogue => "catalogue",
            Mark::Derived => "derived",
            Mark::Assumed => "assumed",
        }
    }
}

/// What a value is.
#[derive(Clone, Debug, PartialEq)]
pub enum Datum {
    /// A number in SI with its unit as written; a count or ratio has the unit "".
    Number {
        /// Value in SI.
        si: f64,
        /// Value as written, for people: "6.55 kN".
        text: String,
    },
    /// A word, as the scenario spells it.
    Word(String),
}

/// One value of a bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// Key, as in the scenario.
    pub key: String,
    /// The value.
    pub datum: Datum,
    /// How well it is founded.
    pub mark: Mark,
    /// Citation of a value read, way of a value derived, reason of a value assumed.
    pub note: String,
}

/// One bearing of the catalogue.
#[derive(Clone, Debug, PartialEq)]
pub struct Bearing {
    /// Name by which a scenario asks for it.
    pub name: String,
    /// One line for lists.
    pub description: String,
    /// Values, in the order of the keys' names.
    pub values: Vec<Value>,
}

impl Bearing {
    /// The number under a key, SI.
    pub fn number(&self, key: &str) -> Option<f64> {
        match &self.value(key)?.datum {
            Datum::Number { si, .. } => Some(*si),
            Datum::Word(_) => None,
        }
    }
    /// The word under a key.
    pub fn word(&self, key: &str) -> Option<&str> {
        match &self.value(key)?.datum {
            Datum::Word(word) => Some(word),
            Datum::Number { .. } => None,
        }
    }
    /// The value under a key.
    pub fn value(&self, key: &str) -> Option<&Value> {
        self.values.iter().find(|value| value.key == key)
    }
}

/// All bearings, in the order of the data file.
pub fn bearings() -> &'static [Bearing] {
    static BEARINGS: OnceLock<Vec<Bearing>> = OnceLock::new();
    // The text is compiled in and read by a test, so a user never meets this panic.
    BEARINGS.get_or_init(|| read(TEXT).expect("the built-in catalogue is valid"))
}

/// The bearing of this name; spaces around it and the case of letters do not matter.
pub fn find(name: &str) -> Option<&'static Bearing> {
    bearings()
        .iter()
        .find(|bearing| bearing.name.eq_ignore_ascii_case(name.trim()))
}

/// Names of all bearings.
pub fn names() -> Vec<String> {
    bearings()
        .iter()
        .map(|bearing| bearing.name.clone())
        .collect()
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    format: String,
    sources: BTreeMap<String, String>,
    bearing: Vec<Record>,
}

#[derive(Deserialize)]
struct Record {
    name: String,
    description: String,
    #[serde(flatten)]
    values: BTreeMap<String, Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    value: Raw,
    catalogue: Option<String>,
    derived: Option<String>,
    assumed: Option<String>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Raw {
    Number(f64),
    Text(String),
}

fn read(text: &str) -> Result<Vec<Bearing>, String> {
    let file: File = toml::from_str(text).map_err(|error| error.to_string())?;
    if file.format != FORMAT {
        return Err(format!("format {}, needed {FORMAT}", file.format));
    }
    file.bearing
        .into_iter()
        .map(|record| {
            let values = record
                .values
                .into_iter()
                .map(|(key, entry)| value(&file.sources, &key, entry))
                .collect::<Result<_, String>>()
                .map_err(|error| format!("{}: {error}", record.name))?;
            Ok(Bearing {
                name: record.name,
                description: record.description,
                values,
            })
        })
        .collect()
}

fn value(sources: &BTreeMap<String, String>, key: &str, entry: Entry) -> Result<Value, String> {
    let (mark, note) = match (entry.catalogue, entry.derived, entry.assumed) {
        (Some(source), None, None) => {
            let citation = sources
                .get(&source)
                .ok_or(format!("{key}: no source named {source}"))?;
            (Mark::Catalogue, citation.clone())
        }
        (None, Some(how), None) => (Mark::Derived, how),
        (None, None, Some(why)) => (Mark::Assumed, why),
        _ => return Err(format!("{key}: exactly one mark is needed")),
    };
    let datum = match entry.value {
        Raw::Number(number) => Datum::Number {
            si: number,
            text: format!("{number}"),
        },
        Raw::Text(word) if key == "ball_material" => Datum::Word(word),
        Raw::Text(text) => Datum::Number {
            si: units::parse_quantity(&text)
                .map_err(|error| format!("{key}: {error}"))?
                .value_si,
            text,
        },
    };
    Ok(Value {
        key: key.to_string(),
        datum,
        mark,
        note,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use physics::materials::{BEARING_STEEL, SILICON_NITRIDE, ball_mass};
    use std::f64::consts::PI;

    const KEYS: [&str; 16] = [
        "ball_count",
        "ball_diameter",
        "ball_material",
        "bore_diameter",
        "cage_mass",
        "dynamic_load_rating",
        "inner_groove_curvature",
        "inner_race_inertia",
        "inner_race_mass",
        "limiting_speed",
        "mass",
        "outer_diameter",
        "outer_groove_curvature",
        "pitch_diameter",
        "static_load_rating",
        "width",
    ];

    fn number(bearing: &Bearing, key: &str) -> f64 {
        bearing
            .number(key)
            .unwrap_or_else(|| panic!("{} has no {key}", bearing.name))
    }

    #[test]
    fn every_bearing_has_every_key_and_a_reason_for_it() {
        for bearing in bearings() {
            for key in KEYS {
                let value = bearing
                    .value(key)
                    .unwrap_or_else(|| panic!("{} has no {key}", bearing.name));
                assert!(!value.note.is_empty(), "{} {key}", bearing.name);
            }
            assert_eq!(bearing.values.len(), KEYS.len(), "{}", bearing.name);
            assert!(["steel", "silicon nitride"].contains(&bearing.word("ball_material").unwrap()));
        }
    }
    #[test]
    fn the_parts_fit_into_the_bearing() {
        for bearing in bearings() {
            let get = |key| number(bearing, key);
            let (bore, outside) = (get("bore_diameter"), get("outer_diameter"));
            let (ball, pitch, balls) = (
                get("ball_diameter"),
                get("pitch_diameter"),
                get("ball_count"),
            );
            assert!(bore < pitch - ball && pitch + ball < outside);
            // chord between neighbouring ball centres, with some room for the cage
            assert!(pitch * (PI / balls).sin() > 1.2 * ball, "{}", bearing.name);
            assert!(ball < get("width"));
            for key in ["inner_groove_curvature", "outer_groove_curvature"] {
                assert!((0.505..0.54).contains(&get(key)));
            }
            let density = match bearing.word("ball_material").unwrap() {
                "steel" => BEARING_STEEL.density,
                _ => SILICON_NITRIDE.density,
            };
            let parts =
                get("inner_race_mass") + get("cage_mass") + balls * ball_mass(ball, density);
            assert!(parts < 0.75 * get("mass"), "{}: {parts}", bearing.name);
            assert!(get("static_load_rating") < get("dynamic_load_rating"));
        }
    }
    /// Mass and inertia of a ring from bore to shoulder less its groove, by thin shells.
    fn ring(bore: f64, shoulder: f64, width: f64, track: f64, groove: f64) -> (f64, f64) {
        let (shells, mut mass, mut inertia) = (20_000, 0.0, 0.0);
        let thickness = (shoulder - bore) / 2.0 / f64::from(shells);
        for shell in 0..shells {
            let radius = bore / 2.0 + thickness * (f64::from(shell) + 0.5);
            let cut = (groove * groove - (radius - track - groove).powi(2)).max(0.0);
            let part =
                BEARING_STEEL.density * 2.0 * PI * radius * thickness * (width - 2.0 * cut.sqrt());
            mass += part;
            inertia += part * radius * radius;
        }
        (mass, inertia)
    }
    #[test]
    fn ring_masses_are_those_of_the_derivation() {
        for (name, shoulder) in [
            ("6005", 32.0e-3),
            ("6005 hybrid", 32.0e-3),
            ("6007", 43.8e-3),
            ("61807", 38.7e-3),
        ] {
            let bearing = find(name).unwrap();
            let get = |key| number(bearing, key);
            let track = (get("pitch_diameter") - get("ball_diameter")) / 2.0;
            let groove = get("inner_groove_curvature") * get("ball_diameter");
            let (mass, inertia) = ring(get("bore_diameter"), shoulder, get("width"), track, groove);
            // three printed digits
            assert!(
                (get("inner_race_mass") / mass - 1.0).abs() < 2e-3,
                "{name} {mass}"
            );
            assert!(
                (get("inner_race_inertia") / inertia - 1.0).abs() < 2e-3,
                "{name} {inertia}"
            );
        }
    }
    #[test]
    fn ball_counts_follow_from_the_static_ratings_quoted() {
        // C0 = f0 Z Dw² [N, mm], ISO 76; f0 is printed to three digits, so Z to better than 0.1.
        for (name, rating, f0) in [
            ("6005", 5850.0, 14.5),
            ("6007", 10_300.0, 14.8),
            ("6007", 10_300.0, 14.9),
            ("61807", 3850.0, 16.5),
        ] {
            let bearing = find(name).unwrap();
            let ball = number(bearing, "ball_diameter") * 1e3;
            let balls = rating / (f0 * ball * ball);
            assert!(
                (balls - number(bearing, "ball_count")).abs() < 0.1,
                "{name} {balls}"
            );
        }
    }
    #[test]
    fn values_are_read_in_si() {
        let bearing = find(" 6005 ").unwrap();
        assert_eq!(bearing.number("bore_diameter"), Some(0.025));
        assert_eq!(bearing.number("static_load_rating"), Some(6550.0));
        assert_eq!(bearing.value("ball_count").unwrap().mark, Mark::Derived);
        assert_eq!(
            find("6005 Hybrid").unwrap().word("ball_material"),
            Some("silicon nitride")
        );
        assert!(find("6999").is_none());
        assert_eq!(names(), ["6005", "6005 hybrid", "6007", "61807"]);
    }
    #[test]
    fn wrong_data_are_refused() {
        for (from, to, message) in [
            (FORMAT, "auxbear.bearings/9", "format auxbear.bearings/9"),
            (
                "\"25 mm\", catalogue = \"skf\"",
                "\"25 mm\"",
                "exactly one mark",
            ),
            (
                "\"25 mm\", catalogue = \"skf\"",
                "\"25 mm\", catalogue = \"nobody\"",
                "no source named nobody",
            ),
            ("\"25 mm\"", "\"25 furlongs\"", "bore_diameter"),
        ] {
            let error = read(&TEXT.replacen(from, to, 1)).unwrap_err();
            assert!(error.contains(message), "{error}");
        }
    }
}
