//! Raw values: what stands in a text or an override, before it is known what it means.

use crate::Place;
use std::collections::BTreeMap;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value as written, before it is known what it means.
#[derive(Clone, Debug, PartialEq)]
pub enum Raw {
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
    /// The value without its source; none of a table without value.
    pub fn plain(&self) -> Option<&Raw> {
        match self {
            Raw::Table(keys) => Some(&keys.iter().find(|(key, _)| key == "value")?.1),
            raw => Some(raw),
        }
    }
    /// The value in words, for a message.
    pub fn text(&self) -> String {
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

    /// The value alone, as somebody wrote it, for a page.
    pub fn shown(&self) -> String {
        match self {
            Raw::Text(text) | Raw::Integer(text, _) => text.clone(),
            Raw::Float(value) => units::number_text(*value),
            Raw::List(list) => list.iter().map(Raw::shown).collect::<Vec<_>>().join(", "),
            other => other.text(),
        }
    }
}

/// A key or path, what stands there, and where.
pub type Written = (String, Raw, Place);

/// Lists paths with what stands there, down to tables whose values are no tables.
pub fn collect(
    text: &str,
    table: &DeTable<'_>,
    before: &str,
    list: &mut Vec<(String, Raw, Place)>,
) {
    for (key, value) in table {
        let path = match before {
            "" => key.get_ref().to_string(),
            _ => format!("{before}.{}", key.get_ref()),
        };
        match value.get_ref() {
            DeValue::Table(inner)
                if !inner.is_empty()
                    && inner
                        .iter()
                        .all(|(_, v)| matches!(v.get_ref(), DeValue::Table(_))) =>
            {
                collect(text, inner, &path, list);
            }
            other => list.push((path, raw(other), Place::of_offset(text, key.span().start))),
        }
    }
}

/// The keys of each table of an array, with what stands there; what is no such array as a key without a name.
pub fn tables(text: &str, start: usize, value: &DeValue<'_>) -> Vec<Vec<Written>> {
    let DeValue::Array(list) = value else {
        return vec![unnamed(text, start, value)];
    };
    let keys = |item: &Spanned<DeValue<'_>>| match item.get_ref() {
        DeValue::Table(table) => {
            let mut keys = Vec::new();
            collect(text, table, "", &mut keys);
            keys
        }
        other => unnamed(text, item.span().start, other),
    };
    list.iter().map(keys).collect()
}

/// The keys at the top of a file, and those of its sections: of `[design]` once, of `[[input]]` as often as it stands there.
#[derive(Debug, Default)]
pub struct Sections {
    /// What stands before all sections, or in none of those named.
    pub head: Vec<Written>,
    sections: BTreeMap<&'static str, Vec<Vec<Written>>>,
}

impl Sections {
    /// Tells the sections named apart.
    pub fn of(text: &str, root: &DeTable<'_>, names: &[&'static str]) -> Self {
        let mut this = Sections::default();
        for (key, value) in root {
            let start = key.span().start;
            let Some(name) = names.iter().find(|name| *name == key.get_ref()) else {
                let place = Place::of_offset(text, start);
                let key = key.get_ref().to_string();
                this.head.push((key, raw(value.get_ref()), place));
                continue;
            };
            let lists = match value.get_ref() {
                DeValue::Table(table) => {
                    let mut keys = Vec::new();
                    collect(text, table, "", &mut keys);
                    vec![keys]
                }
                other => tables(text, start, other),
            };
            this.sections.insert(name, lists);
        }
        this
    }

    /// The keys of each table of a section.
    pub fn all(&self, name: &str) -> &[Vec<Written>] {
        self.sections.get(name).map_or(&[], Vec::as_slice)
    }

    /// The keys of a section that stands in a file once.
    pub fn one(&self, name: &str) -> &[Written] {
        self.all(name).first().map_or(&[], Vec::as_slice)
    }
}

fn unnamed(text: &str, start: usize, value: &DeValue<'_>) -> Vec<Written> {
    let place = Place::of_offset(text, start);
    vec![(String::new(), raw(value), place)]
}

/// A table of values.
pub fn table_raw(table: &DeTable<'_>) -> Raw {
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

/// A value.
pub fn raw(value: &DeValue<'_>) -> Raw {
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
pub fn as_toml(typed: &str) -> Option<Raw> {
    let value = DeValue::parse(typed).ok()?;
    Some(raw(value.get_ref()))
}

/// One given value.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// What stands there.
    pub raw: Raw,
    /// The value as typed in an override, before it was taken as TOML.
    pub typed: Option<String>,
    /// Where.
    pub place: Place,
}
