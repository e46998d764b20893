//! From one value of the file to a value of the kind that its key takes, with its mark.

use super::bearing::{Datum, Mark, Value};
use super::draft::{Read, Reader};
use super::key::{Key, Kind};
use super::read::{in_order, kind};
use problem::{Code, did_you_mean, question};
use toml::de::{DeTable, DeValue};
use units::{Dimension, ParseError, parse_quantity};

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
        let path = format!("{section}.{}", key.name);
        let DeValue::Table(table) = value else {
            let (mark, note) = self.founded(None, &path, start)?;
            return Ok(Value {
                key: key.name.to_string(),
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
            key: key.name.to_string(),
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
        let wrong = |code, found: String| self.problem(code, start, path, found, key.needed());
        let number = match value {
            DeValue::Integer(integer) => Some(integer.to_string()),
            DeValue::Float(float) => Some(float.as_str().to_string()),
            _ => None,
        };
        let datum = match (key.kind, value, number) {
            (Kind::Word(words), DeValue::String(text), _) => {
                if words.iter().any(|word| word == text) {
                    return Ok(Datum::Word(text.to_string()));
                }
                let mut problem = wrong(Code::UnknownWord, format!("\"{text}\""));
                problem.hint = did_you_mean(text, words.iter().copied());
                return Err(problem);
            }
            (Kind::Quantity(dimension), DeValue::String(text), _) => {
                self.quantity(key, dimension, text.trim(), path, start)?
            }
            (Kind::Quantity(dimension), _, Some(number)) => match unit {
                Some(unit) => {
                    let text = format!("{number} {unit}");
                    self.quantity(key, dimension, &text, path, start)?
                }
                None => return Err(wrong(Code::BareNumber, format!("a bare number {number}"))),
            },
            (Kind::Count, DeValue::Integer(_), Some(text)) => plain_number(text),
            (Kind::Ratio, _, Some(text)) => plain_number(text),
            (_, other, _) => return Err(wrong(Code::WrongType, kind(other))),
        };
        let Datum::Number { si, text } = &datum else {
            return Ok(datum);
        };
        let (above, most) = key.range;
        if *si > above && *si <= most {
            return Ok(datum);
        }
        Err(self.problem(
            Code::OutOfRange,
            start,
            path,
            text,
            format!("a value {} is needed", key.range_text()),
        ))
    }

    pub(super) fn quantity(
        &self,
        key: &Key,
        dimension: Dimension,
        text: &str,
        path: &str,
        start: usize,
    ) -> Read<Datum> {
        let wrong = |code, found: String| self.problem(code, start, path, found, key.needed());
        match parse_quantity(text) {
            Ok(quantity) if quantity.dimension == dimension => Ok(Datum::Number {
                si: quantity.value_si,
                text: text.to_string(),
            }),
            Ok(quantity) => {
                let is = match quantity.dimension.name() {
                    Some(name) => format!("of dimension {name}"),
                    None => format!("in {}", quantity.dimension.si_unit()),
                };
                Err(wrong(
                    Code::WrongDimension,
                    format!("\"{text}\", which is {is}"),
                ))
            }
            Err(ParseError::UnknownUnit { unit, nearest }) => {
                let found = format!("the unknown unit \"{unit}\"");
                let mut problem = wrong(Code::UnreadableQuantity, found);
                problem.hint = nearest.as_deref().and_then(|nearest| question(&[nearest]));
                Err(problem)
            }
            Err(error) => {
                let code = match error {
                    ParseError::MissingUnit { .. } => Code::BareNumber,
                    ParseError::OutOfRange { .. } | ParseError::NotFinite { .. } => {
                        Code::OutOfRange
                    }
                    _ => Code::UnreadableQuantity,
                };
                Err(wrong(code, error.to_string()))
            }
        }
    }
}

fn plain_number(text: String) -> Datum {
    let si = text.replace('_', "").parse().unwrap_or(f64::NAN);
    Datum::Number { si, text }
}
