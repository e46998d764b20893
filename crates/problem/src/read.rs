//! From one raw value to a value of the kind that its key takes.

use crate::key::{Fallback, Key, Kind, article, quoted};
use crate::provenance::Provenance;
use crate::raw::{Input, Raw, as_toml};
use crate::value::{Known, Value};
use crate::{Code, Place, Problem, Result, did_you_mean, question};
use units::{Dimension, ParseError, Rational, as_product, parse_quantity};

/// How far the power in the unit of a contact stiffness may be from its exponent: decimals of 10/9 are accepted.
pub const POWER_TOLERANCE: f64 = 1e-6;

/// What a resolved file says of values that were not given.
pub const FILLED_IN: [&str; 2] = ["default", "catalogue"];

/// A value without the table around it.
struct Unwrapped<'a> {
    raw: &'a Raw,
    provenance: Provenance,
    filled_in: bool,
}

/// A key that is read: where it stands, for messages, and what its kind asks of others.
#[derive(Clone, Debug)]
pub struct Reader<'a> {
    /// The file, as the user named it.
    pub file: &'a str,
    /// The path of the key, as the file has it.
    pub path: String,
    /// Of a contact stiffness: its exponent, as a number and as written.
    pub exponent: (f64, String),
}

impl<'a> Reader<'a> {
    /// A key at a path, of no contact stiffness.
    pub fn of(file: &'a str, path: impl Into<String>) -> Self {
        let (path, exponent) = (path.into(), (f64::NAN, String::new()));
        Reader {
            file,
            path,
            exponent,
        }
    }

    pub(crate) fn problem(
        &self,
        code: Code,
        place: Place,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Box<Problem> {
        Problem::new(code, self.file, found, allowed)
            .at(place)
            .on_key(&self.path)
    }

    /// Reads one given value.
    ///
    /// # Errors
    /// A value of another kind, dimension or range than the key takes.
    pub fn read<S>(&self, key: &Key<S>, given: &Input) -> Result<Known> {
        let Unwrapped {
            raw,
            provenance,
            filled_in,
        } = self.unwrap_table(key, given)?;
        // The name 6005 typed as an override is a text, though it reads as a number too.
        let text = match (key.kind, &given.typed, raw) {
            (Kind::Text, Some(typed), Raw::Integer(..) | Raw::Float(_) | Raw::Switch(_)) => {
                Some(Raw::Text(typed.clone()))
            }
            _ => None,
        };
        let (value, text) = self.read_raw(key, text.as_ref().unwrap_or(raw), given.place)?;
        if let Some(number) = value.number()
            && !key.range.holds(number)
        {
            return Err(self.problem(
                Code::OutOfRange,
                given.place,
                key.literal(&text),
                key.needed(),
            ));
        }
        Ok(Known {
            value,
            text,
            provenance,
            place: given.place,
            filled_in,
        })
    }

    /// The value of `{ value = …, source = … }`, or the value itself.
    fn unwrap_table<'v, S>(&self, key: &Key<S>, given: &'v Input) -> Result<Unwrapped<'v>> {
        let bare = match key.kind {
            Kind::Any(_) => true,
            Kind::Filters => given.raw.plain().is_none(),
            _ => false,
        };
        let (Raw::Table(parts), false) = (&given.raw, bare) else {
            return Ok(Unwrapped {
                raw: &given.raw,
                provenance: Provenance::Given,
                filled_in: false,
            });
        };
        let example = key.literal(key.example);
        let form = format!(
            "{{ value = {example}, source = \"…\" }} or {{ value = {example}, assumed = \"why\" }} is needed"
        );
        let mut value = None;
        let mut provenance = None;
        let mut filled_in = false;
        for (name, raw) in parts {
            match (name.as_str(), raw) {
                ("value", raw) => value = Some(raw),
                ("source" | "assumed", Raw::Text(_)) if provenance.is_some() => {
                    return Err(self.problem(
                        Code::Conflict,
                        given.place,
                        "both source and assumed",
                        form,
                    ));
                }
                ("source", Raw::Text(text)) => {
                    provenance = Some(Provenance::GivenWithSource(text.clone()));
                }
                ("assumed", Raw::Text(text)) => {
                    provenance = Some(Provenance::Assumed(text.clone()));
                }
                ("from", Raw::Text(word)) if FILLED_IN.contains(&word.as_str()) => filled_in = true,
                ("from", raw) => {
                    let words: Vec<String> = FILLED_IN.iter().map(|word| quoted(word)).collect();
                    let part = Reader::of(self.file, format!("{}.from", self.path));
                    return Err(part.problem(
                        Code::UnknownWord,
                        given.place,
                        raw.text(),
                        format!(
                            "{} is needed, as the program writes it into a resolved file",
                            words.join(" or ")
                        ),
                    ));
                }
                ("source" | "assumed", raw) => {
                    return Err(self.problem(
                        Code::WrongType,
                        given.place,
                        format!("{} for {name}", raw.text()),
                        form,
                    ));
                }
                (unknown, _) => {
                    let hint = did_you_mean(unknown, ["value", "source", "assumed"]);
                    let part = Reader::of(self.file, format!("{}.{unknown}", self.path));
                    return Err(part
                        .problem(Code::UnknownKey, given.place, "an unknown key", form)
                        .with_hint(hint));
                }
            }
        }
        match value {
            Some(raw) => Ok(Unwrapped {
                raw,
                provenance: provenance.unwrap_or(Provenance::Given),
                filled_in,
            }),
            None => Err(self.problem(Code::MissingKey, given.place, "a table without value", form)),
        }
    }

    /// Reads one raw value: the value and how a file has it.
    ///
    /// # Errors
    /// A value of another kind or dimension than the key takes.
    pub fn read_raw<S>(&self, key: &Key<S>, raw: &Raw, place: Place) -> Result<(Value, String)> {
        let wrong = |code, found: String| self.problem(code, place, found, key.needed());
        match (key.kind, raw) {
            (Kind::Quantity(_) | Kind::ContactStiffness { .. }, Raw::Text(text)) => {
                self.read_quantity(key, text, place)
            }
            (
                Kind::Quantity(_) | Kind::ContactStiffness { .. },
                Raw::Integer(..) | Raw::Float(_),
            ) => {
                let number = raw.text();
                let number = number.trim_start_matches("the number ");
                Err(self.problem(
                    Code::BareNumber,
                    place,
                    format!("a bare number {number}"),
                    format!(
                        "a quantity with a unit is needed, e.g. {}",
                        key.literal(key.example)
                    ),
                ))
            }
            (Kind::Coefficient | Kind::Exponent, Raw::Float(value)) => {
                Ok((Value::Number(*value), format!("{value:?}")))
            }
            (Kind::Coefficient | Kind::Exponent, Raw::Integer(_, Some(value))) => {
                let value = *value as f64;
                Ok((Value::Number(value), format!("{value:?}")))
            }
            (Kind::Exponent, Raw::Text(text)) => match Rational::parse(text) {
                Some(fraction) => Ok((Value::Number(fraction.value()), fraction.to_string())),
                None => Err(wrong(Code::WrongType, raw.text())),
            },
            (Kind::Table(first, second), Raw::List(rows)) => {
                self.read_rows(key, [first, second], rows, place)
            }
            (Kind::Quantities(_) | Kind::Series(_) | Kind::Words(_) | Kind::Texts, raw) => {
                self.read_list(key, raw, place)
            }
            (Kind::Matrix(units), raw) => self.read_matrix(key, units, raw, place),
            (Kind::Filters, raw) => self.read_filters(key, raw, place),
            (Kind::Any(_), raw) => Ok((Value::Raw(raw.clone()), raw.shown())),
            (Kind::Count, Raw::Integer(text, value)) => match value {
                Some(value) if *value >= 0 => {
                    Ok((Value::Count(value.unsigned_abs()), value.to_string()))
                }
                _ => Err(wrong(Code::OutOfRange, text.clone())),
            },
            // some words are numbers
            (Kind::Word(words), Raw::Integer(text, _)) if words.contains(&text.as_str()) => {
                self.read_raw(key, &Raw::Text(text.clone()), place)
            }
            (Kind::Word(words), Raw::Text(text)) => match words.iter().find(|word| *word == text) {
                Some(word) => Ok((Value::Word(word), text.clone())),
                None => {
                    let mut problem = wrong(Code::UnknownWord, quoted(text));
                    problem.hint = did_you_mean(text, words.iter().copied());
                    Err(problem)
                }
            },
            (Kind::Switch, Raw::Switch(value)) => Ok((Value::Switch(*value), value.to_string())),
            (Kind::Text, Raw::Text(text)) => Ok((Value::Text(text.clone()), text.clone())),
            _ => Err(wrong(Code::WrongType, raw.text())),
        }
    }

    fn read_quantity<S>(&self, key: &Key<S>, text: &str, place: Place) -> Result<(Value, String)> {
        let text = text.trim();
        let prefixed = key.prefix.and_then(|(letter, unit)| {
            let number = text.strip_prefix(letter)?.trim();
            number
                .parse::<f64>()
                .ok()
                .map(|_| format!("{number} {unit}"))
        });
        let plain = prefixed.as_deref().unwrap_or(text);
        let quantity = parse_quantity(plain).map_err(|error| {
            let (code, found, hint) = unreadable(&error, text, key.dimension());
            self.problem(code, place, found, key.needed())
                .with_hint(hint)
        })?;
        let own = key.dimension();
        let fits = match key.kind {
            Kind::ContactStiffness { .. } => {
                let power = quantity.dimension.length_power_under_force();
                power
                    .is_some_and(|power| (power.value() - self.exponent.0).abs() <= POWER_TOLERANCE)
            }
            _ => own == Some(quantity.dimension),
        };
        let turns =
            quantity.dimension == Dimension::FREQUENCY && own == Some(Dimension::ANGULAR_SPEED);
        // of a mode people say Hz, of a rotor that may be its drive's
        if turns && text.ends_with("Hz") && key.is_frequency() {
            let value = 2.0 * std::f64::consts::PI * quantity.value_si;
            return Ok((Value::Number(value), text.to_string()));
        }
        if fits {
            return Ok((Value::Number(quantity.value_si), text.to_string()));
        }
        // Rotational speeds are given in 1/min, as frequencies are not.
        if turns
            && ["1/min", "min^-1", "min⁻¹"]
                .iter()
                .any(|unit| text.ends_with(unit))
        {
            let speed = quantity.value_si * std::f64::consts::TAU;
            return Ok((Value::Number(speed), text.to_string()));
        }
        let wanted = match key.kind {
            Kind::ContactStiffness { .. } => {
                format!("{}; here n = {}", key.needed(), self.exponent.1)
            }
            _ => key.needed(),
        };
        let hint = turns.then(|| {
            let speed = quantity.value_si * 2.0 * std::f64::consts::PI;
            format!(
                "That frequency in cycles per second is \"{speed:.6} rad/s\" as an angular speed"
            )
        });
        Err(self
            .problem(
                Code::WrongDimension,
                place,
                format!("\"{text}\", which is {}", described(quantity.dimension)),
                wanted,
            )
            .with_hint(hint))
    }

    /// The value of a default.
    ///
    /// # Errors
    /// A default that its own key does not take.
    pub fn fall_back<S>(&self, key: &Key<S>, fallback: &Fallback) -> Result<Known> {
        let raw = match key.kind {
            Kind::Count => Raw::Integer(fallback.text.to_string(), fallback.text.parse().ok()),
            Kind::Switch => Raw::Switch(fallback.text == "true"),
            Kind::Coefficient => (fallback.text.parse())
                .map_or_else(|_| Raw::Text(fallback.text.to_string()), Raw::Float),
            Kind::Quantities(_) | Kind::Series(_) | Kind::Words(_) | Kind::Texts => {
                as_toml(fallback.text).unwrap_or(Raw::Text(fallback.text.to_string()))
            }
            _ => Raw::Text(fallback.text.to_string()),
        };
        let given = Input {
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
}

/// A dimension in words: `a length`.
pub fn described(dimension: Dimension) -> String {
    match dimension.name() {
        Some(name) => format!("{} {name}", article(name)),
        None => format!("in {}", dimension.si_unit()),
    }
}

/// What is wrong with the text of a quantity. What was meant is a hint of its own, not the middle of the message.
pub fn unreadable(
    error: &ParseError,
    text: &str,
    wanted: Option<Dimension>,
) -> (Code, String, Option<String>) {
    let code = match error {
        ParseError::MissingUnit { .. } => Code::BareNumber,
        ParseError::OutOfRange { .. } | ParseError::NotFinite { .. } => Code::OutOfRange,
        _ => Code::UnreadableQuantity,
    };
    match error {
        ParseError::UnknownUnit { unit, nearest } => (
            code,
            format!("the unknown unit \"{unit}\""),
            (wanted.and_then(|wanted| as_product(text, wanted)))
                .as_deref()
                .or(nearest.as_deref())
                .and_then(|meant| question(&[meant])),
        ),
        ParseError::GroupedDigits { joined, .. } => (code, error.to_string(), question(&[joined])),
        other => (code, other.to_string(), None),
    }
}
