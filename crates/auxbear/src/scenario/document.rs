//! The text of a scenario as a list of keys and raw values, each with its place.

use super::key::Key;
use super::table;
use crate::problem::{Code, Place, Problem, question};
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};
use units::nearest_names;

/// A value as written, before it is known what it means.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Raw {
    /// A text in quotes, or a bare word of an override.
    Text(String),
    /// A whole number, as written.
    Integer(String, Option<i64>),
    /// A number with point or exponent.
    Float(f64),
    /// `true` or `false`.
    Switch(bool),
    /// A table: a value with its source or assumption.
    Table(Vec<(String, Raw)>),
    /// Something that no key takes, in words.
    Other(&'static str),
}

impl Raw {
    /// The value in words, for a message.
    pub(super) fn text(&self) -> String {
        match self {
            Raw::Text(text) => format!("the text \"{text}\""),
            Raw::Integer(text, _) => format!("the number {text}"),
            Raw::Float(value) => format!("the number {}", units::number_text(*value)),
            Raw::Switch(value) => format!("the switch {value}"),
            Raw::Table(_) => "a table".to_string(),
            Raw::Other(words) => words.to_string(),
        }
    }
}

/// One given value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Given {
    pub(super) raw: Raw,
    /// The value as typed in an override, before it was taken as TOML.
    pub(super) typed: Option<String>,
    pub(super) place: Place,
}

/// All given values by path; every path is a key of the table.
#[derive(Clone, Debug)]
pub(super) struct Document {
    pub(super) file: String,
    pub(super) values: BTreeMap<&'static str, Given>,
}

/// One key or section of the text, before it is known whether it exists.
struct Entry {
    path: Vec<String>,
    start: usize,
    raw: Option<Raw>,
}

impl Document {
    /// Reads a text and the overrides; refuses what is no TOML and what is no key.
    pub(super) fn read(text: &str, file: &str, sets: &[String]) -> Result<Document, Box<Problem>> {
        let mut document = Document {
            file: file.to_string(),
            values: BTreeMap::new(),
        };
        let root = DeTable::parse(text).map_err(|error| {
            let message = one_clause(error.message());
            let place = error
                .span()
                .map_or(Place::Whole, |span| Place::of_offset(text, span.start));
            Box::new(
                Problem::new(
                    Code::Syntax,
                    file,
                    format!("what is not valid TOML ({message})"),
                    "lines of the form key = \"value\" are needed",
                )
                .at(place),
            )
        })?;
        document.require_format(text, root.get_ref())?;
        let mut entries = Vec::new();
        flatten(root.get_ref(), &[], &mut entries);
        entries.sort_by_key(|entry| entry.start);
        for entry in entries {
            let place = Place::of_offset(text, entry.start);
            document.add(&entry.path, entry.raw, None, place)?;
        }
        for set in sets {
            document.add_override(set)?;
        }
        Ok(document)
    }

    /// The format comes first: a file of another format would fail on its keys with misleading words.
    fn require_format(&self, text: &str, root: &DeTable<'_>) -> Result<(), Box<Problem>> {
        let needed = format!("format = \"{}\" is needed", table::FORMAT);
        let Some((key, value)) = root.get_key_value("format") else {
            return Err(Box::new(
                Problem::new(Code::UnknownFormat, &self.file, "nothing", needed).on_key("format"),
            ));
        };
        let found = match value.get_ref() {
            DeValue::String(found) if found == table::FORMAT => return Ok(()),
            DeValue::String(found) => format!("\"{found}\""),
            other => raw(other).text(),
        };
        let newer = found
            .starts_with("\"auxbear.scenario/")
            .then(|| "A file of a newer format needs a newer program".to_string());
        Err(Box::new(
            Problem::new(Code::UnknownFormat, &self.file, found, needed)
                .at(Place::of_offset(text, key.span().start))
                .on_key("format")
                .with_hint(newer),
        ))
    }

    fn add_override(&mut self, set: &str) -> Result<(), Box<Problem>> {
        let unreadable = |found: String| {
            Box::new(
                Problem::new(
                    Code::UnreadableSet,
                    &self.file,
                    found,
                    "path=value is needed, e.g. --set \"rotor.speed=9000 rpm\"",
                )
                .at(Place::Set),
            )
        };
        let (path, typed) = set
            .split_once('=')
            .ok_or_else(|| unreadable(format!("\"{set}\"")))?;
        let (path, typed) = (path.trim(), typed.trim());
        let path: Vec<String> = path
            .split('.')
            .map(|part| part.trim().to_string())
            .collect();
        if path.iter().any(String::is_empty) || typed.is_empty() {
            return Err(unreadable(format!("\"{set}\"")));
        }
        let raw = as_toml(typed).unwrap_or_else(|| Raw::Text(typed.to_string()));
        self.add(&path, Some(raw), Some(typed.to_string()), Place::Set)
    }

    fn add(
        &mut self,
        path: &[String],
        raw: Option<Raw>,
        typed: Option<String>,
        place: Place,
    ) -> Result<(), Box<Problem>> {
        let dotted = path.join(".");
        let is_section = table::sections().any(|section| section.path == dotted);
        let problem = |code, found: String, allowed: String| {
            Problem::new(code, &self.file, found, allowed)
                .at(place)
                .on_key(&dotted)
        };
        if is_section {
            return match raw {
                None => Ok(()),
                Some(raw) => Err(Box::new(problem(
                    Code::WrongType,
                    raw.text(),
                    format!("a section [{dotted}] with keys is needed"),
                ))),
            };
        }
        let key = table::keys().find(|key| key.path == dotted);
        match (key, raw) {
            (Some(key), Some(raw)) => {
                let given = Given { raw, typed, place };
                self.values.insert(key.path, given);
                Ok(())
            }
            (key, raw) => {
                let (code, found) = match (key, raw) {
                    (Some(_), _) => (Code::WrongType, "a section".to_string()),
                    (None, None) => (Code::UnknownKey, "an unknown section".to_string()),
                    (None, Some(_)) => (Code::UnknownKey, "an unknown key".to_string()),
                };
                let allowed = key.map_or_else(|| allowed_near(path), Key::needed);
                let hint = if key.is_none() { meant(path) } else { None };
                Err(Box::new(problem(code, found, allowed).with_hint(hint)))
            }
        }
    }
}

/// The message of the TOML reader as one clause.
fn one_clause(message: &str) -> String {
    message
        .lines()
        .map(str::trim)
        .collect::<Vec<_>>()
        .join("; ")
}

/// Lists all keys and sections below a table.
fn flatten(table: &DeTable<'_>, prefix: &[String], entries: &mut Vec<Entry>) {
    for (key, value) in table {
        let mut path = prefix.to_vec();
        path.push(key.get_ref().to_string());
        let dotted = path.join(".");
        let Range { start, .. } = key.span();
        match value.get_ref() {
            DeValue::Table(inner) if table::keys().any(|key| key.path == dotted) => {
                let raw = table_raw(inner);
                entries.push(Entry {
                    path,
                    start,
                    raw: Some(raw),
                });
            }
            DeValue::Table(inner) => {
                let is_section = table::sections().any(|section| section.path == dotted);
                entries.push(Entry {
                    path: path.clone(),
                    start,
                    raw: None,
                });
                if is_section {
                    flatten(inner, &path, entries);
                }
            }
            other => entries.push(Entry {
                path,
                start,
                raw: Some(raw(other)),
            }),
        }
    }
}

fn table_raw(table: &DeTable<'_>) -> Raw {
    let mut parts: Vec<(usize, String, Raw)> = table
        .iter()
        .map(|(key, value): (&Spanned<_>, &Spanned<_>)| {
            (
                key.span().start,
                key.get_ref().to_string(),
                raw(value.get_ref()),
            )
        })
        .collect();
    parts.sort_by_key(|part| part.0);
    Raw::Table(parts.into_iter().map(|(_, key, raw)| (key, raw)).collect())
}

fn raw(value: &DeValue<'_>) -> Raw {
    match value {
        DeValue::String(text) => Raw::Text(text.to_string()),
        DeValue::Integer(integer) => Raw::Integer(
            integer.to_string(),
            i64::from_str_radix(integer.as_str(), integer.radix()).ok(),
        ),
        DeValue::Float(float) => Raw::Float(float.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(value) => Raw::Switch(*value),
        DeValue::Datetime(_) => Raw::Other("a date"),
        DeValue::Array(_) => Raw::Other("a list"),
        DeValue::Table(table) => table_raw(table),
    }
}

/// The value of an override when it is TOML by itself.
fn as_toml(typed: &str) -> Option<Raw> {
    let value = DeValue::parse(typed).ok()?;
    Some(raw(value.get_ref()))
}

/// Most names that a message lists.
const MOST_NAMES: usize = 12;

/// What may stand where the unknown key stands.
fn allowed_near(path: &[String]) -> String {
    let section = path[..path.len() - 1].join(".");
    let names: Vec<&str> = if section.is_empty() {
        let keys = table::keys().filter(|key| key.section().is_empty());
        let sections = table::sections().filter(|section| !section.path.contains('.'));
        keys.map(|key| key.path)
            .chain(sections.map(|section| section.path))
            .collect()
    } else {
        table::keys()
            .filter(|key| key.section() == section)
            .map(Key::name)
            .chain(
                table::sections()
                    .filter_map(|inner| inner.path.strip_prefix(&section)?.strip_prefix('.')),
            )
            .collect()
    };
    if names.is_empty() {
        let sections: Vec<&str> = table::sections().map(|section| section.path).collect();
        return format!("the sections are {}", sections.join(", "));
    }
    if names.len() > MOST_NAMES {
        return format!("a key of [{section}] is needed; auxbear new drop lists them");
    }
    let place = if section.is_empty() {
        "the top level".to_string()
    } else {
        format!("[{section}]")
    };
    format!("{place} takes {}", names.join(", "))
}

/// What an unknown key was probably meant to be.
fn meant(path: &[String]) -> Option<String> {
    let name = path.last()?;
    if let Some(hint) = confused(name) {
        return Some(hint.to_string());
    }
    let dotted = path.join(".");
    let section = path[..path.len() - 1].join(".");
    let all = || {
        table::keys()
            .map(|key| key.path)
            .chain(table::sections().map(|section| section.path))
    };
    let last = |path: &'static str| path.rsplit('.').next().unwrap_or(path);
    let inside = |path: &str| path.rsplit_once('.').map_or("", |(section, _)| section) == section;
    // The same name elsewhere, then a near name in the same section, then a near path, then a near name elsewhere.
    let mut names: Vec<&str> = all().filter(|path| last(path) == name).collect();
    if names.is_empty() {
        let near = nearest_names(name, all().filter(|path| inside(path)).map(last));
        names = all()
            .filter(|path| inside(path) && near.first() == Some(&last(path)))
            .collect();
    }
    if names.is_empty() {
        names = nearest_names(&dotted, all());
        names.truncate(1);
    }
    // Short names are near too many others.
    if names.is_empty() && name.len() > 3 {
        let near = nearest_names(name, all().map(last));
        names = all()
            .filter(|path| near.first() == Some(&last(path)))
            .collect();
    }
    names.truncate(3);
    question(&names)
}

const CLEARANCES: &str = "contact.radial_air_clearance is the radial gap between rotor and inner race, half the difference of their diameters; bearing.operating_diametral_clearance is the diametral internal clearance of the bearing";
const DIAMETERS: &str = "The file takes diameters: bearing.ball_diameter, bearing.pitch_diameter, contact.bore_diameter";

/// Names that are commonly confused, by the last part of the path.
fn confused(name: &str) -> Option<&'static str> {
    let name = name.to_lowercase();
    if ["clearance", "air_gap", "airgap", "preload", "internal_play"]
        .iter()
        .any(|part| name.contains(part))
    {
        // A near miss of the right name is better told as such.
        let right = ["radial_air_clearance", "operating_diametral_clearance"];
        let near = right
            .iter()
            .any(|right| units::edit_distance(&name, right) <= 4);
        return (!near).then_some(CLEARANCES);
    }
    if name.contains("radius") {
        return Some(DIAMETERS);
    }
    Some(match name.as_str() {
        "rpm" | "omega" | "spin_speed" | "rotational_speed" => {
            "The spin of the rotor is rotor.speed, e.g. \"12000 rpm\""
        }
        "mu" | "friction" => {
            "Friction between rotor and inner race is contact.friction_coefficient"
        }
        "inertia" | "moment_of_inertia" => {
            "The inertia of the rotor about its axis is rotor.polar_inertia"
        }
        "balls" | "number_of_balls" | "n_balls" => "The number of balls is bearing.ball_count",
        "eccentricity" => "The eccentricity of the rotor is rotor.unbalance_eccentricity",
        "timestep" | "time_step" | "dt" | "step" => {
            "The step follows from run.tolerance and is at most run.largest_step; run.output_interval is the time between rows of the history"
        }
        "gravity" | "g" => "Gravity is gravity.acceleration with gravity.direction",
        _ => return None,
    })
}
