//! The keys of one table of a study file, each read as what it should be.

use crate::scenario::document::Raw;
use crate::scenario::key::quoted;
use crate::scenario::raw::Written;
use problem::{Code, Place, Problem, did_you_mean};

/// The file in messages.
pub(super) struct Page<'a> {
    pub(super) file: &'a str,
}

impl Page<'_> {
    pub(super) fn problem(
        &self,
        code: Code,
        place: Place,
        key: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Box<Problem> {
        Box::new(
            Problem::new(code, self.file, found, allowed)
                .at(place)
                .on_key(key),
        )
    }
}

/// The keys of one table.
pub(super) struct Section<'a> {
    pub(super) page: &'a Page<'a>,
    pub(super) name: &'static str,
    pub(super) list: Vec<Written>,
}

impl<'a> Section<'a> {
    pub(super) fn new(page: &'a Page<'a>, name: &'static str) -> Self {
        Section {
            page,
            name,
            list: Vec::new(),
        }
    }

    fn path(&self, key: &str) -> String {
        match self.name {
            "" => key.to_string(),
            name => format!("{name}.{key}"),
        }
    }

    pub(super) fn wrong(
        &self,
        code: Code,
        place: Place,
        key: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Box<Problem> {
        self.page
            .problem(code, place, &self.path(key), found, allowed)
    }

    /// Refuses keys that are not among these; `sections` are known besides.
    pub(super) fn known(&self, keys: &[&str], sections: &[&str]) -> Result<(), Box<Problem>> {
        let unknown = self
            .list
            .iter()
            .find(|(key, ..)| !keys.contains(&key.as_str()));
        let Some((key, _, place)) = unknown else {
            return Ok(());
        };
        let all: Vec<&str> = keys.iter().chain(sections).copied().collect();
        let allowed = format!("possible are {}", all.join(", "));
        let problem = self.wrong(Code::UnknownKey, *place, key, "an unknown key", allowed);
        Err(Box::new((*problem).with_hint(did_you_mean(key, all))))
    }

    fn get(&self, key: &str) -> Option<(&Raw, Place)> {
        let found = self.list.iter().find(|(other, ..)| other == key);
        found.map(|(_, raw, place)| (raw, *place))
    }

    pub(super) fn text(&self, key: &str) -> Result<Option<(String, Place)>, Box<Problem>> {
        match self.get(key) {
            None => Ok(None),
            Some((Raw::Text(text), place)) => Ok(Some((text.clone(), place))),
            Some((other, place)) => Err(self.wrong(
                Code::WrongType,
                place,
                key,
                other.text(),
                "a text in quotes is needed",
            )),
        }
    }

    pub(super) fn texts(&self, key: &str) -> Result<Vec<(String, Place)>, Box<Problem>> {
        let Some((raw, place)) = self.get(key) else {
            return Ok(Vec::new());
        };
        let allowed = "a list of texts is needed";
        let Raw::List(list) = raw else {
            return Err(self.wrong(Code::WrongType, place, key, raw.text(), allowed));
        };
        (list.iter())
            .map(|raw| match raw {
                Raw::Text(text) => Ok((text.clone(), place)),
                other => Err(self.wrong(Code::WrongType, place, key, other.text(), allowed)),
            })
            .collect()
    }

    pub(super) fn count(&self, key: &str) -> Result<Option<(usize, Place)>, Box<Problem>> {
        match self.get(key) {
            None => Ok(None),
            Some((Raw::Integer(_, Some(value)), place)) if *value >= 0 => {
                Ok(Some((*value as usize, place)))
            }
            Some((other, place)) => {
                let allowed = "a whole number from 0 on is needed";
                Err(self.wrong(Code::WrongType, place, key, other.text(), allowed))
            }
        }
    }

    /// A bare number.
    pub(super) fn number(&self, key: &str) -> Result<Option<(f64, Place)>, Box<Problem>> {
        match self.get(key) {
            None => Ok(None),
            Some((Raw::Float(value), place)) => Ok(Some((*value, place))),
            Some((Raw::Integer(_, Some(value)), place)) => Ok(Some((*value as f64, place))),
            Some((other, place)) => {
                let allowed = "a bare number is needed";
                Err(self.wrong(Code::WrongType, place, key, other.text(), allowed))
            }
        }
    }

    pub(super) fn word(
        &self,
        key: &str,
        words: &[&'static str],
    ) -> Result<&'static str, Box<Problem>> {
        let allowed = format!("one of {} is needed", words.join(", "));
        let Some((text, place)) = self.text(key)? else {
            return Err(self.wrong(Code::MissingKey, Place::Whole, key, "nothing", allowed));
        };
        let plain = text.replace('_', " ");
        match words.iter().find(|word| **word == plain) {
            Some(word) => Ok(word),
            None => {
                let problem = self.wrong(Code::UnknownWord, place, key, quoted(&text), allowed);
                Err(Box::new(
                    (*problem).with_hint(did_you_mean(&text, words.iter().copied())),
                ))
            }
        }
    }
}
