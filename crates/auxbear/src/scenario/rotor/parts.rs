//! Parts of a rotor as tables of a file: read, completed with defaults, written again.

use crate::scenario::document::{Document, Given, Raw};
use crate::scenario::key::{Key, Presence, quoted};
use crate::scenario::resolved::{ResolvedValue, line};
use crate::scenario::rotor::part_keys::{PARTS, PartKind};
use crate::scenario::rotor::written::WrittenPart;
use crate::scenario::values::{Known, Value, Values};
use problem::{Code, Place, Problem, did_you_mean};
use rotor::MATERIALS;
use std::collections::BTreeMap;
use units::number_text;

/// A part with all its values.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub(crate) kind: &'static PartKind,
    /// Its name, else that of its magnet, else its number from 1.
    pub(crate) label: String,
    pub(crate) known: BTreeMap<&'static str, Known>,
    pub(crate) place: Place,
    pub(crate) file: String,
}

impl Part {
    /// Number of a key, SI.
    pub(crate) fn number(&self, name: &str) -> Option<f64> {
        self.known.get(name)?.value.number()
    }

    /// A number that reading has made sure of.
    pub(crate) fn needed(&self, name: &str) -> f64 {
        self.number(name).unwrap_or_default()
    }

    pub(crate) fn word(&self, name: &str) -> Option<&'static str> {
        match &self.known.get(name)?.value {
            Value::Word(word) => Some(word),
            _ => None,
        }
    }

    pub(crate) fn text(&self, name: &str) -> Option<&str> {
        match &self.known.get(name)?.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// A list of texts; empty where it is not given.
    pub(crate) fn texts(&self, name: &str) -> &[String] {
        match self.known.get(name).map(|known| &known.value) {
            Some(Value::Texts(list)) => list,
            _ => &[],
        }
    }

    pub(crate) fn series(&self, name: &str) -> Option<&[f64]> {
        match &self.known.get(name)?.value {
            Value::Numbers(list) => Some(list),
            _ => None,
        }
    }

    /// A problem with one of its keys, or with the part for an empty name.
    pub(crate) fn problem(
        &self,
        code: Code,
        name: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Problem {
        let mut path = format!("{}.{}", self.kind.path(), self.label);
        if !name.is_empty() {
            path = format!("{path}.{name}");
        }
        let place = self.known.get(name).map(|known| known.place);
        let place = place.filter(|place| *place != Place::Whole);
        Problem::new(code, &self.file, found, allowed)
            .at(place.unwrap_or(self.place))
            .on_key(path)
    }

    /// The part as a file has it.
    fn toml(&self) -> String {
        let mut out = format!("[[{}]]\n", self.kind.path());
        for key in self.kind.keys {
            let Some(known) = self.known.get(key.name()) else {
                continue;
            };
            let value = ResolvedValue {
                path: key.path,
                bearing: None,
                text: Some(known.text.clone()),
                value_si: known.value.number(),
                unit: key.unit().to_string(),
                provenance: known.provenance.clone(),
                place: known.place,
            };
            out.push_str(&line(key, &value));
            out.push('\n');
        }
        out
    }
}

/// Parts of a rotor, at most: more than there may be elements and what sits between them.
const MOST_PARTS: usize = 2000;

/// All parts of a document, completed.
pub(crate) fn resolve(document: &Document, values: &Values) -> Result<Vec<Part>, Box<Problem>> {
    if document.parts.len() > MOST_PARTS {
        let found = format!("{} parts of a rotor", document.parts.len());
        let allowed = format!("at most {MOST_PARTS} are possible");
        return Err(Box::new(Problem::new(
            Code::RotorGeometry,
            &values.file,
            found,
            allowed,
        )));
    }
    let mut all: Vec<Part> = Vec::new();
    for kind in PARTS {
        let of_kind = document.parts.iter().filter(|part| part.kind == kind.word);
        for (number, written) in (1..).zip(of_kind) {
            let part = read(kind, number, written, values)?;
            let same = |other: &&Part| other.kind.word == kind.word && other.label == part.label;
            if part.known.contains_key("name") && all.iter().any(|other| same(&other)) {
                let found = format!("the name {} twice", quoted(&part.label));
                let allowed = "a name of its own for each is needed";
                return Err(Box::new(part.problem(
                    Code::Conflict,
                    "name",
                    found,
                    allowed,
                )));
            }
            all.push(part);
        }
    }
    let known = known_materials(&all, values)?;
    all.splice(0..0, known);
    Ok(all)
}

/// The materials known by name that parts are of, as the file could give them.
fn known_materials(all: &[Part], values: &Values) -> Result<Vec<Part>, Box<Problem>> {
    let Some(kind) = PARTS.iter().find(|kind| kind.word == "material") else {
        return Ok(Vec::new());
    };
    let own =
        |name: &str| (all.iter()).any(|part| part.kind.word == kind.word && part.label == name);
    let used = |name: &str| all.iter().any(|part| part.text("material") == Some(name));
    let wanted = MATERIALS
        .iter()
        .filter(|known| used(known.0) && !own(known.0));
    wanted
        .map(|(name, young, poisson, density, source)| {
            let sourced = |value: Raw| {
                let source = Raw::Text((*source).to_string());
                Raw::Table(vec![
                    ("value".to_string(), value),
                    ("source".to_string(), source),
                ])
            };
            let young = format!("{} GPa", number_text(young * 1e-9));
            let density = format!("{} kg/m^3", number_text(*density));
            let keys = [
                ("name", Raw::Text((*name).to_string())),
                ("youngs_modulus", sourced(Raw::Text(young))),
                ("poisson_ratio", sourced(Raw::Float(*poisson))),
                ("density", sourced(Raw::Text(density))),
            ];
            let written = WrittenPart {
                kind: kind.word,
                keys: (keys.into_iter())
                    .map(|(key, raw)| (key.to_string(), raw, Place::Whole))
                    .collect(),
                place: Place::Whole,
            };
            read(kind, 0, &written, values)
        })
        .collect()
}

/// The parts of a document as its resolved file has them.
pub(crate) fn toml(document: &Document, values: &Values) -> Vec<String> {
    let parts = resolve(document, values).unwrap_or_default();
    parts.iter().map(Part::toml).collect()
}

fn read(
    kind: &'static PartKind,
    number: usize,
    written: &WrittenPart,
    values: &Values,
) -> Result<Part, Box<Problem>> {
    let label = written.name().map_or(number.to_string(), str::to_string);
    let mut part = Part {
        kind,
        label,
        known: BTreeMap::new(),
        place: written.place,
        file: values.file.clone(),
    };
    for (name, raw, place) in &written.keys {
        let Some(key) = kind.keys.iter().find(|key| key.name() == name) else {
            let names = || kind.keys.iter().map(Key::name);
            let allowed = format!(
                "[[{}]] takes {}",
                kind.path(),
                names().collect::<Vec<_>>().join(", ")
            );
            let (code, found) = match name.is_empty() {
                true => (Code::WrongType, raw.text()),
                false => (Code::UnknownKey, "an unknown key".to_string()),
            };
            let problem = part.problem(code, name, found, allowed).at(*place);
            return Err(Box::new(problem.with_hint(did_you_mean(name, names()))));
        };
        let given = Given {
            raw: raw.clone(),
            typed: None,
            place: *place,
        };
        let known = values.read(key, &given).map_err(|mut problem| {
            problem.key = Some(format!("{}.{}.{name}", kind.path(), part.label));
            problem
        })?;
        part.known.insert(key.name(), known);
    }
    let idle = idle(&part, values)?;
    for key in kind.keys.iter().filter(|key| !idle.contains(&key.name())) {
        let other = key.excludes.and_then(|path| path.rsplit('.').next());
        if part.known.contains_key(key.name()) {
            if let Some(other) = other.filter(|other| part.known.contains_key(other)) {
                let found = format!("this and {other}, which give the same thing");
                let allowed = "one of the two is needed";
                return Err(Box::new(part.problem(
                    Code::Conflict,
                    key.name(),
                    found,
                    allowed,
                )));
            }
            continue;
        }
        match key.presence {
            Presence::Required => {
                let problem = part.problem(Code::MissingKey, key.name(), "no value", key.needed());
                return Err(Box::new(problem));
            }
            Presence::Default(fallback) => {
                part.known
                    .insert(key.name(), values.fall_back(key, &fallback)?);
            }
            _ => {}
        }
    }
    Ok(part)
}

/// Keys that have no effect beside what is given; refused where one of them is given and says otherwise than its default.
fn idle(part: &Part, values: &Values) -> Result<Vec<&'static str>, Box<Problem>> {
    let given = |name: &&&str| part.known.contains_key(**name);
    let mut out = Vec::new();
    for key in part.kind.keys {
        let missing = key.beside.iter().find(|name| !given(name));
        let (word, other) = match (missing, key.unless.iter().find(given)) {
            (Some(other), _) => ("beside", other),
            (None, Some(other)) => ("without", other),
            (None, None) => continue,
        };
        out.push(key.name());
        let Some(known) = part.known.get(key.name()) else {
            continue;
        };
        if let Presence::Default(fallback) = key.presence
            && values.fall_back(key, &fallback)?.value == known.value
        {
            continue;
        }
        let allowed = format!("it is used only {word} {other}");
        let found = "a key that has no effect";
        let problem = part.problem(Code::UnusedKey, key.name(), found, allowed);
        return Err(Box::new(problem));
    }
    Ok(out)
}
