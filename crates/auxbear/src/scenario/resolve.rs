//! From the table of keys and the given values to one value for every key.

use super::bearing_source::{BearingRecord, BearingSource};
use super::document::{Document, Given, Raw, as_toml};
use super::key::{Condition, Fallback, Key, Kind, Otherwise, Presence, quoted};
use super::provenance::Provenance;
use super::read::POWER_TOLERANCE;
use super::resolved::{Resolved, ResolvedValue};
use super::system::SystemName;
use super::table;
use crate::problem::{Code, Place, Problem};
use std::collections::BTreeMap;
use units::{Quantity, Rational, parse_quantity};

/// Key of the law of the friction moment, on which its constants depend.
pub(super) const LAW: &str = "bearing.moment.law";
/// Key of the laws that are compared with it.
pub(super) const COMPARED_LAWS: &str = "torque.laws";

/// A value that was read.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    /// A quantity in SI or a bare number.
    Number(f64),
    /// A whole number, not negative.
    Count(u64),
    /// One of the words of the key.
    Word(&'static str),
    /// `true` or `false`.
    Switch(bool),
    /// Any text.
    Text(String),
    /// Rows of two quantities in SI.
    Rows(Vec<[f64; 2]>),
    /// Quantities in SI.
    Numbers(Vec<f64>),
    /// Words of the key.
    Words(Vec<&'static str>),
    /// Any texts.
    Texts(Vec<String>),
}

impl Value {
    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Value::Number(value) => Some(*value),
            Value::Count(count) => Some(*count as f64),
            Value::Word(_)
            | Value::Switch(_)
            | Value::Text(_)
            | Value::Rows(_)
            | Value::Numbers(_)
            | Value::Words(_)
            | Value::Texts(_) => None,
        }
    }
}

/// A value with everything known of it.
#[derive(Clone, Debug)]
pub(super) struct Known {
    pub(super) value: Value,
    pub(super) text: String,
    pub(super) provenance: Provenance,
    pub(super) place: Place,
    /// Whether the file says that the program filled it in.
    pub(super) filled_in: bool,
}

/// One value for every key that has one.
#[derive(Debug)]
pub(super) struct Values {
    file: String,
    system: SystemName,
    known: BTreeMap<&'static str, Known>,
    /// What the catalogue knows of the bearing named.
    record: Option<BearingRecord>,
}

impl Values {
    /// Reads every given value and fills the rest from catalogue and defaults.
    pub(super) fn resolve(
        document: &Document,
        bearings: &dyn BearingSource,
    ) -> Result<Values, Box<Problem>> {
        let mut values = Values {
            file: document.file.clone(),
            system: document.system,
            known: BTreeMap::new(),
            record: None,
        };
        let own = values.own_catalogue(document)?;
        let bearings = own
            .as_ref()
            .map_or(bearings, |own| own as &dyn BearingSource);
        let record = values.find_bearing(document, bearings)?;
        for key in table::keys_of(document.system) {
            let given = document.values.get(key.path);
            if let Some(unmet) = values.unmet(key) {
                match given {
                    Some(given) if values.of_compared_law(&unmet) => {
                        let known = values.read(key, given)?;
                        values.known.insert(key.path, known);
                    }
                    Some(given) => {
                        return Err(Box::new(values.unused(key, given, &unmet, document)));
                    }
                    None => {}
                }
                continue;
            }
            let known = match given {
                Some(given) => {
                    values.refuse_conflict(key, given, document)?;
                    let known = values.lasting_path(key, values.read(key, given)?);
                    Some(values.as_filled_in(key, known, record.as_ref(), document))
                }
                None => match values.catalogued(key, record.as_ref())? {
                    Some(known) => Some(known),
                    None => values.without(key, record.as_ref(), document)?,
                },
            };
            if let Some(known) = known {
                values.known.insert(key.path, known);
            }
        }
        values.derive()?;
        values.record = record;
        Ok(values)
    }

    pub(super) fn problem(
        &self,
        code: Code,
        path: &str,
        place: Place,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Problem {
        Problem::new(code, &self.file, found, allowed)
            .at(place)
            .on_key(path)
    }

    /// The condition that keeps a key from having a meaning, followed to its root.
    pub(super) fn unmet(&self, key: &Key) -> Option<Condition> {
        key.when.iter().find_map(|condition| {
            if let Some(parent) = table::keys().find(|other| other.path == condition.path) {
                if !table::systems(parent).contains(&self.system) {
                    // there is no choice to be made in this system
                    return None;
                }
                if let Some(root) = self.unmet(parent) {
                    return Some(root);
                }
            }
            (!self.holds(condition)).then_some(*condition)
        })
    }

    fn holds(&self, condition: &Condition) -> bool {
        let Some(known) = self.known.get(condition.path) else {
            return false;
        };
        condition.values.iter().any(|wanted| match &known.value {
            Value::Word(word) => word == wanted,
            Value::Text(text) => text == wanted,
            Value::Switch(value) => value.to_string() == *wanted,
            Value::Number(value) => Rational::parse(wanted)
                .is_some_and(|wanted| (wanted.value() - value).abs() <= POWER_TOLERANCE),
            Value::Count(count) => count.to_string() == *wanted,
            Value::Rows(_) | Value::Numbers(_) | Value::Words(_) | Value::Texts(_) => false,
        })
    }

    /// Whether a law that is compared has the key that the law of the bearing has not.
    fn of_compared_law(&self, unmet: &Condition) -> bool {
        unmet.path == LAW
            && self
                .words(COMPARED_LAWS)
                .iter()
                .any(|law| unmet.values.contains(law))
    }

    fn unused(&self, key: &Key, given: &Given, unmet: &Condition, document: &Document) -> Problem {
        let here = self.known.get(unmet.path).map_or(String::new(), |known| {
            format!("; here it is {}", quoted(&known.text))
        });
        let reason = if unmet.reason.is_empty() {
            String::new()
        } else {
            format!(" ({})", unmet.reason)
        };
        self.problem(
            Code::UnusedKey,
            key.path,
            given.place,
            "a key that has no effect",
            format!("it is used only with {}{reason}{here}", unmet.text()),
        )
        .with_hint(self.remedy(given, unmet, document))
    }

    /// Which lines have no effect by the same choice, and what would give them one.
    fn remedy(&self, given: &Given, unmet: &Condition, document: &Document) -> Option<String> {
        given.place.line()?;
        let lines: Vec<String> = table::keys_of(self.system)
            .filter(|key| {
                let other = self.unmet(key);
                other.is_some_and(|other| other.path == unmet.path && !self.of_compared_law(&other))
            })
            .filter_map(|key| {
                let line = document.values.get(key.path)?.place.line()?;
                Some(format!("{line} ({})", key.name()))
            })
            .collect();
        let back = match self.place(unmet.path) {
            Place::Set => format!("leave --set {} away", unmet.path),
            Place::Line { line, .. } => format!("change {} in line {line}", unmet.path),
            Place::Whole => format!("give {}", unmet.path),
        };
        let word = if lines.len() == 1 { "line" } else { "lines" };
        Some(format!("Remove {word} {}, or {back}", lines.join(", ")))
    }

    fn refuse_conflict(
        &self,
        key: &Key,
        given: &Given,
        document: &Document,
    ) -> Result<(), Box<Problem>> {
        let Some(other) = key.excludes else {
            return Ok(());
        };
        let Some(second) = document.values.get(other) else {
            return Ok(());
        };
        let (path, place, first) = if order(second.place) > order(given.place) {
            (other, second.place, key.path)
        } else {
            (key.path, given.place, other)
        };
        Err(Box::new(self.problem(
            Code::Conflict,
            path,
            place,
            format!("this and {first}, which give the same thing"),
            "one of the two is needed",
        )))
    }

    fn without(
        &self,
        key: &Key,
        record: Option<&BearingRecord>,
        document: &Document,
    ) -> Result<Option<Known>, Box<Problem>> {
        let replaced = table::keys().any(|other| {
            other.excludes == Some(key.path) && document.values.contains_key(other.path)
        });
        if replaced {
            return Ok(None);
        }
        match table::presence(key, self.system) {
            Presence::Optional(_) | Presence::Derived(_) => Ok(None),
            Presence::Default(fallback) => self.fall_back(key, &fallback).map(Some),
            Presence::DefaultWhen(condition, fallback, _) if self.holds(&condition) => {
                self.fall_back(key, &fallback).map(Some)
            }
            Presence::DefaultWhen(_, _, Otherwise::Fallback(fallback)) => {
                self.fall_back(key, &fallback).map(Some)
            }
            Presence::DefaultWhen(condition, _, Otherwise::Required) => Err(Box::new(
                self.missing(key)
                    .with_hint(format!("It has a default only with {}", condition.text())),
            )),
            Presence::Required => Err(Box::new(self.missing(key))),
            Presence::FromBearing => {
                let hint = match record {
                    Some(record) => {
                        format!("The catalogue does not know it of \"{}\"", record.name)
                    }
                    None => "bearing.name takes it from the catalogue".to_string(),
                };
                Err(Box::new(self.missing(key).with_hint(hint)))
            }
        }
    }

    /// A value of a resolved file keeps the origin of a default or of the catalogue as long as it is that value.
    fn as_filled_in(
        &self,
        key: &Key,
        known: Known,
        record: Option<&BearingRecord>,
        document: &Document,
    ) -> Known {
        if !known.filled_in {
            return known;
        }
        let catalogued = self.catalogued(key, record).ok().flatten();
        let filled = catalogued.or_else(|| self.without(key, record, document).ok().flatten());
        match filled {
            Some(filled) if filled.value == known.value => Known {
                provenance: filled.provenance,
                ..known
            },
            _ => known,
        }
    }

    fn missing(&self, key: &Key) -> Problem {
        self.problem(
            Code::MissingKey,
            key.path,
            Place::Whole,
            "no value",
            key.needed(),
        )
    }

    fn fall_back(&self, key: &Key, fallback: &Fallback) -> Result<Known, Box<Problem>> {
        let raw = match key.kind {
            Kind::Count => Raw::Integer(fallback.text.to_string(), fallback.text.parse().ok()),
            Kind::Switch => Raw::Switch(fallback.text == "true"),
            Kind::Coefficient => Raw::Float(fallback.text.parse().unwrap_or(f64::NAN)),
            Kind::Quantities(_) | Kind::Words(_) | Kind::Texts => {
                as_toml(fallback.text).unwrap_or(Raw::Text(fallback.text.to_string()))
            }
            _ => Raw::Text(fallback.text.to_string()),
        };
        let given = Given {
            raw,
            typed: None,
            place: Place::Whole,
        };
        let mut known = self.read(key, &given)?;
        let reason = fallback.reason.to_string();
        known.provenance = if fallback.assumed {
            Provenance::DefaultAssumed(reason)
        } else {
            Provenance::Default(reason)
        };
        Ok(known)
    }

    /// The file, as the user named it.
    pub(super) fn file(&self) -> &str {
        &self.file
    }

    /// The system of the file.
    pub(super) fn system(&self) -> SystemName {
        self.system
    }

    pub(super) fn put(&mut self, path: &'static str, known: Known) {
        self.known.insert(path, known);
    }

    /// Takes a value away that has no effect after all.
    pub(super) fn take_away(&mut self, path: &str) {
        self.known.remove(path);
    }

    /// Whether a value was given, rather than filled in.
    pub(super) fn is_given(&self, path: &str) -> bool {
        self.known.get(path).is_some_and(|known| {
            !matches!(
                known.provenance,
                Provenance::Default(_) | Provenance::DefaultAssumed(_)
            )
        })
    }

    /// Where a value comes from, in one word; empty where there is none.
    pub(super) fn mark(&self, path: &str) -> &'static str {
        let known = self.known.get(path);
        known.map_or("", |known| known.provenance.mark())
    }

    /// A dimension of the bearing named, as the catalogue knows it.
    pub(super) fn dimension(&self, name: &str) -> Option<f64> {
        let mut values = self.record.as_ref()?.values.iter();
        values.find(|value| value.0 == name).map(|value| value.1)
    }

    /// Where a value was given.
    pub(super) fn place(&self, path: &str) -> Place {
        self.known
            .get(path)
            .map_or(Place::Whole, |known| known.place)
    }

    /// The value as written.
    pub(super) fn text(&self, path: &str) -> Option<String> {
        self.known.get(path).map(|known| known.text.clone())
    }

    /// A number in SI, where there is one.
    pub(super) fn number(&self, path: &str) -> Option<f64> {
        self.known.get(path).and_then(|known| known.value.number())
    }

    /// A word; empty where there is none.
    pub(super) fn word(&self, path: &str) -> &'static str {
        match self.known.get(path).map(|known| &known.value) {
            Some(Value::Word(word)) => word,
            _ => "",
        }
    }

    /// A switch; off where there is none.
    pub(super) fn switch(&self, path: &str) -> bool {
        matches!(
            self.known.get(path).map(|known| &known.value),
            Some(Value::Switch(true))
        )
    }

    /// The rows of a table, where there is one.
    pub(super) fn rows(&self, path: &str) -> Option<Vec<[f64; 2]>> {
        match self.known.get(path).map(|known| &known.value) {
            Some(Value::Rows(rows)) => Some(rows.clone()),
            _ => None,
        }
    }

    /// A list of quantities in SI; empty where there is none.
    pub(super) fn numbers(&self, path: &str) -> Vec<f64> {
        match self.known.get(path).map(|known| &known.value) {
            Some(Value::Numbers(list)) => list.clone(),
            _ => Vec::new(),
        }
    }

    /// A list of words; empty where there is none.
    pub(super) fn words(&self, path: &str) -> &[&'static str] {
        match self.known.get(path).map(|known| &known.value) {
            Some(Value::Words(list)) => list,
            _ => &[],
        }
    }

    /// A list of texts; empty where there is none.
    pub(super) fn texts(&self, path: &str) -> &[String] {
        match self.known.get(path).map(|known| &known.value) {
            Some(Value::Texts(list)) => list,
            _ => &[],
        }
    }

    /// A whole number; 0 where there is none.
    pub(super) fn count(&self, path: &str) -> u64 {
        match self.known.get(path).map(|known| &known.value) {
            Some(Value::Count(count)) => *count,
            _ => 0,
        }
    }

    /// The list of all values for people and for the resolved file.
    pub(super) fn resolved(&self) -> Resolved {
        let mut list = Vec::new();
        for key in table::keys_of(self.system) {
            let known = self.known.get(key.path);
            if known.is_none() && self.unmet(key).is_some() {
                continue;
            }
            let absent = match table::presence(key, self.system) {
                Presence::Derived(how) => Some(Provenance::Derived(how.to_string())),
                Presence::Optional(meaning) => {
                    Some(Provenance::Default(format!("not given: {meaning}")))
                }
                _ => None,
            };
            let Some(provenance) = known.map(|known| known.provenance.clone()).or(absent) else {
                continue;
            };
            list.push(ResolvedValue {
                path: key.path,
                text: known.map(|known| known.text.clone()),
                value_si: known.and_then(|known| known.value.number()),
                unit: self.si_unit(key),
                provenance,
                place: known.map_or(Place::Whole, |known| known.place),
            });
        }
        Resolved { values: list }
    }

    fn si_unit(&self, key: &Key) -> String {
        match key.kind {
            Kind::ContactStiffness { .. } => self
                .text(key.path)
                .and_then(|text| parse_quantity(&text).ok())
                .map_or(String::new(), |quantity| quantity.dimension.si_unit()),
            _ => key.unit().to_string(),
        }
    }
}

/// Later places count more: lines in their order, then overrides.
fn order(place: Place) -> usize {
    match place {
        Place::Whole => 0,
        Place::Line { line, .. } => line,
        Place::Set => usize::MAX,
    }
}

/// A value in SI as a text that reads back bit for bit.
pub(super) fn quantity_text(key: &Key, value_si: f64) -> String {
    match key.dimension() {
        Some(dimension) => Quantity {
            value_si,
            dimension,
        }
        .to_string(),
        None => units::number_text(value_si),
    }
}
