//! From one value of the file to a value of the kind that its key takes, with its mark.

use super::bearing::{Datum, Mark, Value};
use super::draft::{Read, Reader};
use super::key::Key;
use super::read::{in_order, kind};
use problem::raw::{Input, Raw, raw};
use problem::read::Reader as ValueReader;
use problem::value::Value as KeyValue;
use problem::{Code, Place, did_you_mean};
use toml::de::{DeTable, DeValue};

impl Reader<'_> {
    /// A value with its mark: bare, or `{ value = …, catalogue | derived | assumed = "…" }`.
    pub(super) fn value(
        &self,
        key: &'static Key,
        value: &DeValue<'_>,
        unit: Option<&str>,
        section: &str,
        start: usize,
    ) -> Read<Value> {
        let path = format!("{section}.{}", key.path);
        let DeValue::Table(table) = value else {
            let (mark, note) = self.founded(None, &path, start)?;
            return Ok(Value {
                key: key.path.to_string(),
                datum: self.datum(key, value, unit, &path, start)?,
                mark,
                note,
            });
        };
        let mark = self.mark(table, &["value"], &path, start)?;
        let (mark, note) = self.founded(mark, &path, start)?;
        let Some(value) = table.get("value") else {
            return Err(self.problem(
                Code::MissingKey,
                start,
                &path,
                "a table without value",
                "{ value = …, assumed = \"why\" } is needed",
            ));
        };
        Ok(Value {
            key: key.path.to_string(),
            datum: self.datum(key, value.get_ref(), unit, &path, start)?,
            mark,
            note,
        })
    }

    /// The mark of a table of values or of a column; other keys than those named are refused.
    pub(super) fn mark(
        &self,
        table: &DeTable<'_>,
        others: &[&str],
        path: &str,
        start: usize,
    ) -> Read<Option<(Mark, String)>> {
        let mut found = None;
        for (key, value) in in_order(table) {
            let name = key.get_ref().as_ref();
            let mark = match name {
                "catalogue" => Mark::Catalogue,
                "derived" => Mark::Derived,
                "assumed" => Mark::Assumed,
                name if others.contains(&name) => continue,
                unknown => {
                    let mut known = vec!["catalogue", "derived", "assumed"];
                    known.extend(others);
                    let mut problem = self.problem(
                        Code::UnknownKey,
                        start,
                        &format!("{path}.{unknown}"),
                        "an unknown key",
                        format!("{} are known here", known.join(", ")),
                    );
                    problem.hint = did_you_mean(unknown, known);
                    return Err(problem);
                }
            };
            let note = match value.get_ref() {
                DeValue::String(text) if !text.trim().is_empty() => text.trim().to_string(),
                other => {
                    return Err(self.problem(
                        Code::WrongType,
                        start,
                        &format!("{path}.{name}"),
                        kind(other),
                        "a text in quotes is needed",
                    ));
                }
            };
            if found.replace((mark, note)).is_some() {
                return Err(self.problem(
                    Code::Conflict,
                    start,
                    path,
                    "two marks",
                    "one of catalogue, derived and assumed is needed",
                ));
            }
        }
        match found {
            Some((Mark::Catalogue, source)) => {
                let citation = self.sources.get(&source).ok_or_else(|| {
                    let known = || self.sources.keys().map(String::as_str);
                    let listed: Vec<&str> = known().collect();
                    let mut problem = self.problem(
                        Code::UnknownWord,
                        start,
                        &format!("{path}.catalogue"),
                        format!("\"{source}\""),
                        format!("a key of [sources] is needed ({})", listed.join(", ")),
                    );
                    problem.hint = did_you_mean(&source, known());
                    problem
                })?;
                Ok(Some((Mark::Catalogue, citation.clone())))
            }
            other => Ok(other),
        }
    }

    /// A mark there must be, except in a user's file.
    pub(super) fn founded(
        &self,
        mark: Option<(Mark, String)>,
        path: &str,
        start: usize,
    ) -> Read<(Mark, String)> {
        match mark {
            Some(mark) => Ok(mark),
            None if !self.built_in => Ok((Mark::Given, format!("given in {}", self.file))),
            None => Err(self.problem(
                Code::MissingKey,
                start,
                path,
                "a value without mark",
                "one of catalogue, derived and assumed is needed",
            )),
        }
    }

    pub(super) fn datum(
        &self,
        key: &Key,
        value: &DeValue<'_>,
        unit: Option<&str>,
        path: &str,
        start: usize,
    ) -> Read<Datum> {
        let place = Place::of_offset(self.text, start);
        let raw = match (raw(value), unit) {
            (Raw::Integer(number, _), Some(unit)) => Raw::Text(format!("{number} {unit}")),
            (Raw::Float(number), Some(unit)) => {
                Raw::Text(format!("{} {unit}", units::number_text(number)))
            }
            (other, _) => other,
        };
        let typed = None;
        let known = ValueReader::of(self.file, path).read(key, &Input { raw, typed, place })?;
        Ok(match known.value {
            KeyValue::Word(word) => Datum::Word(word.to_string()),
            other => Datum::Number {
                si: other.number().unwrap_or(f64::NAN),
                text: known.text,
            },
        })
    }
}
