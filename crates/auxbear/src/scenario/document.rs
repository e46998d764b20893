//! The text of a scenario as a list of keys and raw values, each with its place.

use crate::problem::{Code, Place, Problem, did_you_mean};
use crate::scenario::key::{Key, quoted};
use crate::scenario::meant;
use crate::scenario::system::SystemName;
use crate::scenario::table;
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value as written, before it is known what it means.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Raw {
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
    /// A list.
    List(Vec<Raw>),
    /// Something that no key takes, in words.
    Other(&'static str),
}

impl Raw {
    /// The value in words, for a message.
    pub(crate) fn text(&self) -> String {
        match self {
            Raw::Text(text) => format!("the text \"{text}\""),
            Raw::Integer(text, _) => format!("the number {text}"),
            Raw::Float(value) => format!("the number {}", units::number_text(*value)),
            Raw::Switch(value) => format!("the switch {value}"),
            Raw::Table(_) => "a table".to_string(),
            Raw::List(_) => "a list".to_string(),
            Raw::Other(words) => words.to_string(),
        }
    }
}

/// One given value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Given {
    pub(crate) raw: Raw,
    /// The value as typed in an override, before it was taken as TOML.
    pub(crate) typed: Option<String>,
    pub(crate) place: Place,
}

/// All given values by path; every path is a key of the table.
#[derive(Clone, Debug)]
pub(crate) struct Document {
    pub(crate) file: String,
    pub(crate) system: SystemName,
    pub(crate) values: BTreeMap<&'static str, Given>,
    /// Where each section of the text starts.
    pub(crate) sections: BTreeMap<&'static str, Place>,
}

/// One key or section of the text, before it is known whether it exists.
struct Entry {
    path: Vec<String>,
    start: usize,
    raw: Option<Raw>,
}

impl Document {
    /// Reads a text and the overrides; refuses what is no TOML and what is no key.
    pub(crate) fn read(text: &str, file: &str, sets: &[String]) -> Result<Document, Box<Problem>> {
        let root = DeTable::parse(text).map_err(|error| Problem::of_toml(&error, text, file))?;
        require_format(text, root.get_ref(), file)?;
        let mut document = Document {
            file: file.to_string(),
            system: find_system(text, root.get_ref(), file, sets)?,
            values: BTreeMap::new(),
            sections: BTreeMap::new(),
        };
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
        let section = table::sections().find(|section| section.path == dotted);
        let problem = |code, found: String, allowed: String| {
            Problem::new(code, &self.file, found, allowed)
                .at(place)
                .on_key(&dotted)
        };
        let elsewhere = |what: &str, systems: &[SystemName]| {
            problem(
                Code::UnusedKey,
                format!("a {what} that has no effect"),
                format!(
                    "it is used only with system = {}; here it is \"{}\"",
                    SystemName::list(systems),
                    self.system.word()
                ),
            )
        };
        if let Some(section) = section {
            if !section.systems.contains(&self.system) {
                return Err(Box::new(elsewhere("section", section.systems)));
            }
            return match raw {
                None => {
                    self.sections.insert(section.path, place);
                    Ok(())
                }
                Some(raw) => Err(Box::new(problem(
                    Code::WrongType,
                    raw.text(),
                    format!("a section [{dotted}] with keys is needed"),
                ))),
            };
        }
        let key = table::keys().find(|key| key.path == dotted);
        if let Some(key) = key
            && !table::systems(key).contains(&self.system)
        {
            let hint = meant::namesake(path, self.system);
            return Err(Box::new(
                elsewhere("key", table::systems(key)).with_hint(hint),
            ));
        }
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
                let allowed =
                    key.map_or_else(|| meant::allowed_near(path, self.system), Key::needed);
                let hint = if key.is_none() {
                    meant::meant(path, self.system)
                } else {
                    None
                };
                Err(Box::new(problem(code, found, allowed).with_hint(hint)))
            }
        }
    }
}

/// The format comes first: a file of another format would fail on its keys with misleading words.
fn require_format(text: &str, root: &DeTable<'_>, file: &str) -> Result<(), Box<Problem>> {
    let needed = format!("format = \"{}\" is needed", table::FORMAT);
    let Some((key, value)) = root.get_key_value("format") else {
        return Err(Box::new(
            Problem::new(Code::UnknownFormat, file, "nothing", needed).on_key("format"),
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
        Problem::new(Code::UnknownFormat, file, found, needed)
            .at(Place::of_offset(text, key.span().start))
            .on_key("format")
            .with_hint(newer),
    ))
}

/// The system comes next: what it does not have is told as such. An override counts, the last of several.
fn find_system(
    text: &str,
    root: &DeTable<'_>,
    file: &str,
    sets: &[String],
) -> Result<SystemName, Box<Problem>> {
    let needed = format!("one of {} is needed", quoted_words(SystemName::WORDS));
    let problem = |code, found: String, allowed: String| {
        Problem::new(code, file, found, allowed).on_key("system")
    };
    let set = sets.iter().rev().find_map(|set| {
        let (path, typed) = set.split_once('=')?;
        let typed = typed.trim();
        let raw = as_toml(typed).unwrap_or_else(|| Raw::Text(typed.to_string()));
        (path.trim() == "system").then_some((raw, Place::Set))
    });
    let given = || {
        let (key, value) = root.get_key_value("system")?;
        let place = Place::of_offset(text, key.span().start);
        Some((raw(value.get_ref()), place))
    };
    let Some((raw, place)) = set.or_else(given) else {
        return Err(Box::new(problem(
            Code::MissingKey,
            "no value".to_string(),
            needed,
        )));
    };
    let raw = match raw {
        Raw::Table(parts) => match parts.into_iter().find(|(name, _)| name == "value") {
            Some((_, value)) => value,
            None => Raw::Other("a table without value"),
        },
        raw => raw,
    };
    let Raw::Text(word) = raw else {
        return Err(Box::new(
            problem(Code::WrongType, raw.text(), needed).at(place),
        ));
    };
    if let Some(system) = SystemName::of(&word) {
        return Ok(system);
    }
    Err(Box::new(if SystemName::PLANNED.contains(&word.as_str()) {
        let found = format!("\"{word}\", which is planned but not built yet");
        problem(Code::NotBuilt, found, needed).at(place)
    } else {
        problem(Code::UnknownWord, quoted(&word), needed)
            .at(place)
            .with_hint(did_you_mean(&word, SystemName::WORDS.iter().copied()))
    }))
}

fn quoted_words(words: &[&str]) -> String {
    let words: Vec<String> = words.iter().map(|word| quoted(word)).collect();
    words.join(", ")
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
        DeValue::Array(list) => Raw::List(list.iter().map(|item| raw(item.get_ref())).collect()),
        DeValue::Table(table) => table_raw(table),
    }
}

/// The value of a text when it is TOML by itself.
pub(crate) fn as_toml(typed: &str) -> Option<Raw> {
    let value = DeValue::parse(typed).ok()?;
    Some(raw(value.get_ref()))
}
