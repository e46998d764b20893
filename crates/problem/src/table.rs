//! One table of a file, read by the list of its keys: `[design]`, `[[limit]]`, `[[rotor.disk]]`, `[[bearing]]`.

use crate::key::{Key, Presence};
use crate::raw::{Input, Raw, Written};
use crate::read::Reader;
use crate::value::{Known, Value};
use crate::{Code, Place, Problem, Result, did_you_mean};
use std::collections::BTreeMap;

/// A table with the values of its keys, defaults filled in.
#[derive(Clone, Debug)]
pub struct Table<S: 'static = ()> {
    /// The file, as the user named it.
    pub file: String,
    /// Where the table stands in messages: `design`, `rotor.disk.impeller`; empty at the top of a file.
    pub path: String,
    /// Where its first key stands.
    pub place: Place,
    /// Its keys.
    pub keys: &'static [Key<S>],
    /// Values by the names of the keys.
    pub known: BTreeMap<&'static str, Known>,
}

impl<S> Table<S> {
    /// Reads what stands in a table; `head` is how a file writes it, such as `[[rotor.disk]]`, `others` what may stand there besides.
    ///
    /// # Errors
    /// An unknown key, a value that its key does not take, a key that is missing, excluded by another or without effect.
    pub fn read(
        file: &str,
        (path, head): (String, &str),
        keys: &'static [Key<S>],
        written: &[Written],
        others: &[&str],
    ) -> Result<Self> {
        let places = written.iter().map(|(.., place)| *place);
        let mut table = Table {
            file: file.to_string(),
            path,
            place: places.min_by_key(|place| place.line()).unwrap_or_default(),
            keys,
            known: BTreeMap::new(),
        };
        for (name, raw, place) in written {
            let Some(key) = keys.iter().find(|key| key.name() == name) else {
                let names = || {
                    keys.iter()
                        .map(|key| key.name() as &str)
                        .chain(others.iter().copied())
                };
                let allowed = format!("{head} takes {}", names().collect::<Vec<_>>().join(", "));
                let (code, found) = match name.is_empty() {
                    true => (Code::WrongType, raw.text()),
                    false => (Code::UnknownKey, "an unknown key".to_string()),
                };
                let problem = table.problem(code, name, found, allowed).at(*place);
                return Err(problem.with_hint(did_you_mean(name, names())));
            };
            let given = Input {
                raw: raw.clone(),
                typed: None,
                place: *place,
            };
            let known = table.reader(name).read(key, &given)?;
            table.known.insert(key.name(), known);
        }
        table.complete()?;
        Ok(table)
    }

    fn reader(&self, name: &str) -> Reader<'_> {
        Reader::of(&self.file, self.path_of(name))
    }

    /// Fills in defaults; refuses what lacks a key, or has one beside another that excludes it or takes its effect.
    fn complete(&mut self) -> Result<()> {
        // whether a key has an effect depends on what is given, not on defaults
        let effects: Vec<_> = (self.keys.iter())
            .map(|key| self.without_effect(key))
            .collect();
        for (key, effect) in self.keys.iter().zip(effects) {
            let given = self.known.get(key.name());
            if let Some((word, other)) = effect {
                let says = given.map(|known| &known.value);
                if says.is_some()
                    && says != self.fallen_back(key)?.map(|known| known.value).as_ref()
                {
                    let allowed = format!("it is used only {word} {other}");
                    let found = "a key that has no effect";
                    return self.refuse(Code::UnusedKey, key.name(), found, allowed);
                }
                continue;
            }
            let other = key.excludes.and_then(|path| path.rsplit('.').next());
            if let Some(other) =
                other.filter(|other| given.is_some() && self.known.contains_key(other))
            {
                let found = format!("this and {other}, which give the same thing");
                let allowed = "one of the two is needed";
                return self.refuse(Code::Conflict, key.name(), found, allowed);
            }
            if given.is_some() {
                continue;
            }
            if key.presence == Presence::Required {
                return self.refuse(Code::MissingKey, key.name(), "no value", key.needed());
            }
            if let Some(known) = self.fallen_back(key)? {
                self.known.insert(key.name(), known);
            }
        }
        Ok(())
    }

    /// The default of a key, where it has one.
    fn fallen_back(&self, key: &Key<S>) -> Result<Option<Known>> {
        let Presence::Default(fallback) = key.presence else {
            return Ok(None);
        };
        self.reader(key.name()).fall_back(key, &fallback).map(Some)
    }

    /// The other key that takes the effect of a key, and in which way; none where it has one.
    fn without_effect(&self, key: &Key<S>) -> Option<(&'static str, &'static str)> {
        let given = |name: &&&'static str| self.known.contains_key(**name);
        let missing = key.beside.iter().find(|name| !given(name));
        let taking = || key.unless.iter().find(given);
        (missing.map(|other| ("beside", *other)))
            .or_else(|| taking().map(|other| ("without", *other)))
    }

    /// The path of one of its keys; of the table for an empty name.
    pub fn path_of(&self, name: &str) -> String {
        match (self.path.as_str(), name) {
            ("", name) => name.to_string(),
            (path, "") => path.to_string(),
            (path, name) => format!("{path}.{name}"),
        }
    }

    /// A problem with one of its keys, or with the table for an empty name.
    pub fn problem(
        &self,
        code: Code,
        name: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Box<Problem> {
        let place = self.known.get(name).map(|known| known.place);
        let place = place.filter(|place| *place != Place::Whole);
        Problem::new(code, &self.file, found, allowed)
            .at(place.unwrap_or(self.place))
            .on_key(self.path_of(name))
    }

    /// Refuses one of its keys, or the table for an empty name.
    ///
    /// # Errors
    /// Always.
    pub fn refuse<T>(
        &self,
        code: Code,
        name: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Result<T> {
        Err(self.problem(code, name, found, allowed))
    }

    /// Where a key stands; nowhere where it is not given.
    pub fn place_of(&self, name: &str) -> Place {
        self.known
            .get(name)
            .map_or(Place::Whole, |known| known.place)
    }

    /// Number of a key, SI.
    pub fn number(&self, name: &str) -> Option<f64> {
        self.known.get(name)?.value.number()
    }

    /// A number that reading has made sure of.
    pub fn needed(&self, name: &str) -> f64 {
        self.number(name).unwrap_or_default()
    }

    /// A whole number.
    pub fn count(&self, name: &str) -> Option<usize> {
        match self.known.get(name)?.value {
            Value::Count(count) => usize::try_from(count).ok(),
            _ => None,
        }
    }

    /// One of the words of a key.
    pub fn word(&self, name: &str) -> Option<&'static str> {
        match &self.known.get(name)?.value {
            Value::Word(word) => Some(word),
            _ => None,
        }
    }

    /// A text.
    pub fn text(&self, name: &str) -> Option<&str> {
        match &self.known.get(name)?.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// A list of texts; empty where it is not given.
    pub fn texts(&self, name: &str) -> &[String] {
        match self.known.get(name).map(|known| &known.value) {
            Some(Value::Texts(list)) => list,
            _ => &[],
        }
    }

    /// What is not read yet.
    pub fn raw(&self, name: &str) -> Option<&Raw> {
        match &self.known.get(name)?.value {
            Value::Raw(raw) => Some(raw),
            _ => None,
        }
    }

    /// A list of numbers, SI.
    pub fn series(&self, name: &str) -> Option<&[f64]> {
        match &self.known.get(name)?.value {
            Value::Numbers(list) => Some(list),
            _ => None,
        }
    }
}
