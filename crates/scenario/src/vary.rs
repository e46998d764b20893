//! Values that repeated runs vary: `[vary]`, and the deviations of `[repeat]` in the same words.
//!
//! ```toml
//! [vary]
//! "contact.friction_coefficient" = { lognormal = 0.2 }           # times e^(0.2 z)
//! "rotor.speed" = { normal = "100 rpm" }                         # plus z times
//! "mount.stiffness" = { uniform = ["1e7 N/m", "3e7 N/m"] }
//! "mount.damping" = { triangular = ["2e3 N s/m", "5e3 N s/m", "6e3 N s/m"] }
//! "bearing.name" = { choice = ["6005", "6205"] }
//! ```
//! z is a standard normal number. A path names any key of the file; of several auxiliary bearings `contact.…` is that of
//! all, `auxiliary_bearing.drive_end.contact.…` that of one. Every drawn value is read and checked like an override.

use crate::document::Raw;
use crate::drop::Repeat;
use crate::drop::case::CASE;
use crate::key::{Key, Kind, quoted};
use crate::rotor::keys::kind_within;
use crate::several::{AUXILIARY_BEARING, VARY, of_each_bearing, path_of};
use crate::table;
use crate::values::Values;
use problem::{Code, Place, Problem, Result, did_you_mean};
use statistics::design::Coordinate;
use statistics::distribution::{self as law, triangular};
use statistics::random::Random;
use std::f64::consts::TAU;
use units::{Dimension, Quantity, parse_quantity};

/// A value of the file that repeated runs draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    /// Dotted path, as the file has it.
    pub path: String,
    /// What is drawn.
    pub distribution: Distribution,
    /// Whether a key of `[repeat]` says so.
    pub by_repeat: bool,
    /// Where it is drawn: one path, or that of each of several auxiliary bearings.
    targets: Vec<Target>,
}

/// A key that takes a drawn value.
#[derive(Clone, Debug, PartialEq)]
struct Target {
    path: String,
    /// Its value as given, SI, where it is a number.
    base: Option<f64>,
    /// Dimension of the text that is written; none of a bare number.
    dimension: Option<Dimension>,
}

/// How a value is drawn; numbers in SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// Times e^(deviation z).
    Lognormal(f64),
    /// Plus deviation z.
    Normal(f64),
    /// Evenly between two values.
    Uniform(f64, f64),
    /// Between the first and the last value, most often near the middle one.
    Triangular(f64, f64, f64),
    /// One of these texts.
    Choice(Vec<String>),
}

impl Vary {
    /// Whether it is of a part of a flexible rotor.
    pub fn is_of_part(&self) -> bool {
        self.targets[0].base.is_none() && is_of_part(&self.path)
    }

    /// Draws a value: paths with their new values, as an override has them.
    pub fn draw(&self, random: &mut Random) -> Vec<(String, String)> {
        let draw: Box<dyn Fn(f64) -> f64> = match &self.distribution {
            Distribution::Choice(texts) => {
                let place = (random.uniform() * texts.len() as f64) as usize;
                let text = &texts[place.min(texts.len() - 1)];
                let targets = self.targets.iter();
                return targets
                    .map(|target| (target.path.clone(), text.clone()))
                    .collect();
            }
            Distribution::Lognormal(deviation) => {
                let factor = (deviation * random.normal()).exp();
                Box::new(move |base| base * factor)
            }
            Distribution::Normal(deviation) => {
                let shift = deviation * random.normal();
                Box::new(move |base| base + shift)
            }
            Distribution::Uniform(low, high) => {
                let value = low + (high - low) * random.uniform();
                Box::new(move |_| value)
            }
            Distribution::Triangular(low, middle, high) => {
                let value = triangular(*low, *middle, *high, random.uniform());
                Box::new(move |_| value)
            }
        };
        let targets = self.targets.iter();
        targets
            .map(|target| {
                // a value without a base is drawn without one
                let base = target.base.unwrap_or_default();
                (target.path.clone(), target.text(draw(base)))
            })
            .collect()
    }

    /// What stands at a coordinate of a study: paths with their values, as an override has them, and the first of these as a number:
    /// in SI, or the place of a text in its list. Nothing where the value is as given.
    pub fn at(&self, coordinate: Coordinate) -> (Vec<(String, String)>, Option<f64>) {
        if coordinate == Coordinate::Given {
            return (Vec::new(), self.given());
        }
        let mut first = None;
        let mut at = |target: &Target| {
            let number = self.number_at(target.base.unwrap_or_default(), coordinate);
            first.get_or_insert(number);
            let text = match &self.distribution {
                Distribution::Choice(texts) => texts[number as usize].clone(),
                _ => target.text(number),
            };
            (target.path.clone(), text)
        };
        let values = self.targets.iter().map(&mut at).collect();
        (values, first)
    }

    /// The value of the file as a number, where it is one.
    fn given(&self) -> Option<f64> {
        match &self.distribution {
            Distribution::Choice(_) => None,
            _ => self.targets[0].base,
        }
    }

    /// The same as a file has it.
    pub fn given_text(&self) -> Option<String> {
        self.given().map(|number| self.targets[0].text(number))
    }

    fn number_at(&self, base: f64, coordinate: Coordinate) -> f64 {
        let law = match &self.distribution {
            Distribution::Lognormal(deviation) => law::Distribution::Lognormal(base, *deviation),
            Distribution::Normal(deviation) => law::Distribution::Normal(base, *deviation),
            Distribution::Uniform(low, high) => law::Distribution::Uniform(*low, *high),
            Distribution::Triangular(low, middle, high) => {
                law::Distribution::Triangular(*low, *middle, *high)
            }
            Distribution::Choice(texts) => law::Distribution::Discrete(texts.len()),
        };
        match coordinate {
            Coordinate::Given => base,
            Coordinate::Level(at, of) => law.level(at, of),
            Coordinate::Share(u) => law.quantile(u),
        }
    }

    /// SI unit of its values; empty of bare numbers and texts.
    pub fn unit(&self) -> String {
        (self.targets[0].dimension).map_or(String::new(), |dimension| dimension.si_unit())
    }

    /// The value as a file has it.
    pub fn toml(&self) -> String {
        format!(
            "{} = {{ {} }}",
            quoted(&self.path),
            self.distribution_toml()
        )
    }

    /// The distribution as a file has it.
    pub fn distribution_toml(&self) -> String {
        let text = |value: &f64| {
            let dimension = self.targets[0].dimension;
            match dimension {
                Some(dimension) => quoted(
                    &Quantity {
                        value_si: *value,
                        dimension,
                    }
                    .to_string(),
                ),
                None => units::number_text(*value),
            }
        };
        let list = |values: &[&f64]| {
            let texts: Vec<String> = values.iter().map(|value| text(value)).collect();
            texts.join(", ")
        };
        match &self.distribution {
            Distribution::Lognormal(value) => format!("lognormal = {}", units::number_text(*value)),
            Distribution::Normal(value) => format!("normal = {}", text(value)),
            Distribution::Uniform(low, high) => format!("uniform = [{}]", list(&[low, high])),
            Distribution::Triangular(low, middle, high) => {
                format!("triangular = [{}]", list(&[low, middle, high]))
            }
            Distribution::Choice(texts) => {
                let texts: Vec<String> = texts.iter().map(|text| quoted(text)).collect();
                format!("choice = [{}]", texts.join(", "))
            }
        }
    }
}

impl Target {
    fn text(&self, value: f64) -> String {
        match self.dimension {
            Some(dimension) => Quantity {
                value_si: value,
                dimension,
            }
            .to_string(),
            None => units::number_text(value),
        }
    }
}

/// What the runs of a drop vary of the machine: what the keys of `[repeat]` say, then what `[vary]` says; `all` are the
/// values of each auxiliary bearing.
pub fn of_drop(
    repeat: &Repeat,
    entries: &[(String, Raw, Place)],
    all: &[Values],
) -> Result<Vec<Vary>> {
    let deviations = [
        (
            "contact.friction_coefficient",
            repeat.friction_coefficient_deviation,
        ),
        ("mount.stiffness", repeat.mount_stiffness_deviation),
        (
            "contact.radial_air_clearance",
            repeat.radial_air_clearance_deviation,
        ),
    ];
    let mut list: Vec<Vary> = (deviations.into_iter())
        .filter(|(_, deviation)| *deviation > 0.0)
        .filter_map(|(path, deviation)| by_repeat(path, Distribution::Lognormal(deviation), all))
        .collect();
    for (path, raw, place) in entries {
        list.push(one(path, raw, *place, all)?);
    }
    if repeat.count > 1
        && repeat.random_unbalance_angle
        && list.iter().all(|vary| vary.path != UNBALANCE_ANGLE)
    {
        let anywhere = Distribution::Uniform(0.0, TAU);
        list.extend(by_repeat(UNBALANCE_ANGLE, anywhere, &all[..1]));
    }
    Ok(list)
}

/// Direction of all unbalances at the release, which decides whether friction starts whirl.
pub const UNBALANCE_ANGLE: &str = "rotor.unbalance_angle";

fn by_repeat(path: &str, distribution: Distribution, all: &[Values]) -> Option<Vary> {
    let key = table::key(path)?;
    let targets: Option<Vec<_>> = all.iter().map(|values| target(key, values)).collect();
    Some(Vary {
        path: path.to_string(),
        distribution,
        by_repeat: true,
        targets: targets?,
    })
}

fn target(key: &Key, values: &Values) -> Option<Target> {
    let dimension = match key.kind {
        Kind::Quantity(_) | Kind::ContactStiffness { .. } => {
            let text = values.text(key.path)?;
            Some(parse_quantity(&text).ok()?.dimension)
        }
        _ => None,
    };
    Some(Target {
        path: path_of(values.bearing.as_deref(), key.path),
        base: values.number(key.path),
        dimension,
    })
}

const WORDS: &str = "one of lognormal, normal, uniform, triangular, choice is needed, e.g. { lognormal = 0.2 }, { uniform = [\"1 mm\", \"2 mm\"] }";

/// One value that is varied, with its distribution as a table of one word.
pub fn one(path: &str, raw: &Raw, place: Place, all: &[Values]) -> Result<Vary> {
    if all[0].system().has_shaft() && is_of_part(path) {
        return of_part(path, raw, place, all[0].file());
    }
    let shown = format!("{VARY}.{path}");
    let problem = |code, found: String, allowed: &str| {
        Problem::new(code, all[0].file(), found, allowed)
            .at(place)
            .on_key(&shown)
    };
    let (of, plain) = match path.strip_prefix(AUXILIARY_BEARING) {
        Some(rest) => {
            let rest = rest.strip_prefix('.').unwrap_or(rest);
            let (name, plain) = rest.split_once('.').unwrap_or((rest, ""));
            let of = all.iter().filter(|v| v.bearing.as_deref() == Some(name));
            (of.collect::<Vec<_>>(), plain)
        }
        None if of_each_bearing(path) => (all.iter().collect(), path),
        None => (vec![&all[0]], path),
    };
    let system = all[0].system();
    let key = table::keys_of(system).find(|key| key.path == plain);
    let (Some(key), false) = (key, of.is_empty()) else {
        let found = format!("{}, which is no key of this file", quoted(path));
        let unknown = problem(
            Code::UnknownKey,
            found,
            "the dotted path of a key is needed",
        );
        let known = table::keys_of(system).map(|key| key.path);
        return Err(unknown.with_hint(did_you_mean(plain, known)));
    };
    if ["format", "system", "title", "description", "catalogue"].contains(&plain)
        || ["run.", "repeat."]
            .iter()
            .any(|section| plain.starts_with(section) && plain != CASE)
    {
        let found = format!("{}, which is no property of the machine", quoted(path));
        return Err(problem(
            Code::UnusedKey,
            found,
            "the path of a value of the machine is needed",
        ));
    }
    let Raw::Table(parts) = raw else {
        return Err(problem(Code::WrongType, raw.text(), WORDS));
    };
    let [(word, given)] = parts.as_slice() else {
        return Err(problem(Code::WrongType, raw.text(), WORDS));
    };
    let number = |raw: &Raw| -> Result<f64> {
        let (value, _) = (of[0].reader(key).read_raw(key, raw, place)).map_err(|mut wrong| {
            wrong.key = Some(shown.clone());
            wrong
        })?;
        let number = value.number().filter(|number| number.is_finite());
        number.ok_or_else(|| problem(Code::WrongType, raw.text(), "a number is needed"))
    };
    let numbers = |count: usize| -> Result<Vec<f64>> {
        let needed = format!(
            "a list of {count} values, the last above the first and none below the one before, is needed"
        );
        let Raw::List(list) = given else {
            return Err(problem(Code::WrongType, given.text(), &needed));
        };
        let values = list.iter().map(number).collect::<Result<Vec<_>, _>>()?;
        let rising = values.windows(2).all(|pair| pair[0] <= pair[1]);
        let wide = values.first() < values.last();
        if values.len() != count || !rising || !wide {
            return Err(problem(Code::OutOfRange, given.shown(), &needed));
        }
        if !(values[count - 1] - values[0]).is_finite() {
            let needed = "a difference that is a number is needed";
            return Err(problem(Code::OutOfRange, given.text(), needed));
        }
        Ok(values)
    };
    let distribution = match word.as_str() {
        "lognormal" => match given {
            Raw::Float(deviation) if *deviation >= 0.0 => Distribution::Lognormal(*deviation),
            Raw::Integer(_, Some(deviation)) if *deviation >= 0 => {
                Distribution::Lognormal(*deviation as f64)
            }
            other => {
                let allowed =
                    "the standard deviation of the logarithm is needed, a bare number not below 0";
                return Err(problem(Code::WrongType, other.text(), allowed));
            }
        },
        "normal" => {
            let celsius =
                matches!(given, Raw::Text(text) if text.contains("deg")) && key.unit() == "K";
            if celsius {
                let allowed = "a difference of temperatures in K is needed";
                return Err(problem(Code::WrongType, given.text(), allowed));
            }
            Distribution::Normal(number(given)?)
        }
        "uniform" => {
            let values = numbers(2)?;
            Distribution::Uniform(values[0], values[1])
        }
        "triangular" => {
            let values = numbers(3)?;
            Distribution::Triangular(values[0], values[1], values[2])
        }
        "choice" => {
            let Raw::List(list) = given else {
                let allowed = "a list of values is needed";
                return Err(problem(Code::WrongType, given.text(), allowed));
            };
            let texts: Option<Vec<String>> = list.iter().map(override_text).collect();
            match texts.filter(|texts| !texts.is_empty()) {
                Some(texts) => Distribution::Choice(texts),
                None => {
                    let allowed = "a list of texts, numbers or switches is needed";
                    return Err(problem(Code::WrongType, given.text(), allowed));
                }
            }
        }
        other => {
            return Err(problem(Code::UnknownWord, quoted(other), WORDS));
        }
    };
    let continuous = !matches!(distribution, Distribution::Choice(_));
    let numeric = matches!(
        key.kind,
        Kind::Quantity(_) | Kind::ContactStiffness { .. } | Kind::Coefficient | Kind::Exponent
    );
    if continuous && !numeric {
        let found = format!("{word} of a value that is no real number");
        return Err(problem(Code::WrongType, found, "choice = [...] is needed"));
    }
    let targets: Option<Vec<Target>> = of.iter().map(|values| target(key, values)).collect();
    let relative = matches!(
        distribution,
        Distribution::Lognormal(_) | Distribution::Normal(_)
    );
    let targets = targets.filter(|list| !relative || list.iter().all(|t| t.base.is_some()));
    match targets {
        Some(targets) => Ok(Vary {
            path: path.to_string(),
            distribution,
            by_repeat: false,
            targets,
        }),
        None => Err(problem(
            Code::MissingKey,
            format!("{} has no value in this file", quoted(path)),
            "a value to begin with is needed",
        )),
    }
}

/// A value as an override has it.
fn override_text(raw: &Raw) -> Option<String> {
    match raw {
        Raw::Text(text) => Some(text.clone()),
        Raw::Integer(text, _) => Some(text.clone()),
        Raw::Float(value) => Some(units::number_text(*value)),
        Raw::Switch(value) => Some(value.to_string()),
        Raw::Table(_) | Raw::List(_) | Raw::Other(_) => None,
    }
}

/// Whether a path is that of a value of a part of a flexible rotor.
fn is_of_part(path: &str) -> bool {
    kind_within(path).is_some()
}

/// A value of a part of a flexible rotor that is varied: between values that are given, since none is taken from the part.
fn of_part(path: &str, raw: &Raw, place: Place, file: &str) -> Result<Vary> {
    let needed = "uniform = [\"1 kg\", \"2 kg\"], triangular with three values or choice with texts is needed for a part of a rotor";
    let problem = |code| {
        Problem::new(code, file, raw.text(), needed)
            .at(place)
            .on_key(path)
    };
    let Raw::Table(parts) = raw else {
        return Err(problem(Code::WrongType));
    };
    let [(word, Raw::List(list))] = parts.as_slice() else {
        return Err(problem(Code::WrongType));
    };
    let number = |raw: &Raw| match raw {
        Raw::Text(text) => (parse_quantity(text).ok()).map(|q| (q.value_si, Some(q.dimension))),
        Raw::Float(value) => Some((*value, None)),
        Raw::Integer(_, Some(value)) => Some((*value as f64, None)),
        _ => None,
    };
    let (distribution, dimension) = if word == "choice" {
        let texts: Option<Vec<String>> = list.iter().map(override_text).collect();
        let texts = texts.filter(|texts| !texts.is_empty());
        let texts = texts.ok_or_else(|| problem(Code::WrongType))?;
        (Distribution::Choice(texts), None)
    } else {
        let numbers: Option<Vec<(f64, Option<Dimension>)>> = list.iter().map(number).collect();
        let numbers = numbers.ok_or_else(|| problem(Code::UnreadableQuantity))?;
        let rising = numbers.windows(2).all(|pair| {
            (0.0..f64::INFINITY).contains(&(pair[1].0 - pair[0].0)) && pair[0].1 == pair[1].1
        });
        let wide = numbers.first().map(|own| own.0) < numbers.last().map(|own| own.0);
        let rising = rising && wide;
        match (word.as_str(), numbers.as_slice()) {
            ("uniform", [(low, of), (high, _)]) if rising => {
                (Distribution::Uniform(*low, *high), *of)
            }
            ("triangular", [(low, of), (middle, _), (high, _)]) if rising => {
                (Distribution::Triangular(*low, *middle, *high), *of)
            }
            _ => return Err(problem(Code::OutOfRange)),
        }
    };
    Ok(Vary {
        path: path.to_string(),
        distribution,
        by_repeat: false,
        targets: vec![Target {
            path: path.to_string(),
            base: None,
            dimension,
        }],
    })
}
