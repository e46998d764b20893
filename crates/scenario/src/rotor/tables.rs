//! Parts of a rotor and of its levitation as tables of a file: read, completed with defaults, written again.

use crate::document::Document;
use crate::not_modelled;
use crate::renamed;
use crate::resolved::{ResolvedValue, line};
use crate::rotor::keys::{EVENT, OF_MACHINES, PARTS, PartKind, kind_within};
use crate::system::SystemName;
use crate::table::names_files;
use crate::values::Values;
use physics::shaft::MATERIALS;
use problem::key::quoted;
use problem::raw::{Raw, Written, collect, raw, tables};
use problem::table::Table;
use problem::value::Known;
use problem::{Code, Place, Problem, Result};
use std::ops::Deref;
use toml::de::{DeTable, DeValue};
use units::number_text;

/// Most parts of a kind: a shaft has at most 500 elements, and reading takes the square of their number.
const MOST_OF_A_KIND: usize = 1000;

/// A part as the text has it.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenPart {
    /// Word of its kind.
    pub kind: &'static str,
    pub(crate) keys: Vec<Written>,
    pub(crate) place: Place,
}

impl WrittenPart {
    /// Its name, of a sensor or controller that of its magnet, where it has one.
    pub fn name(&self) -> Option<&str> {
        let of_magnet = self.kind != EVENT;
        self.keys.iter().find_map(|(key, raw, _)| match raw {
            Raw::Text(name) if key == "name" || key == "magnet" && of_magnet => Some(name.as_str()),
            _ => None,
        })
    }

    /// Its name, else its number from 1.
    fn label(&self, number: usize) -> String {
        self.name().map_or(number.to_string(), str::to_string)
    }
}

/// All parts of a file.
pub fn read_all(
    text: &str,
    root: &DeTable<'_>,
    file: &str,
    system: SystemName,
) -> Result<Vec<WrittenPart>> {
    let mut parts = Vec::new();
    for kind in PARTS {
        let table = match kind.table() {
            "" => root,
            table => match root.get(table).map(|value| value.get_ref()) {
                Some(DeValue::Table(table)) => table,
                _ => continue,
            },
        };
        let Some((key, value)) = table.get_key_value(kind.word) else {
            continue;
        };
        // rotor.mass of a drop is a mass, not a part
        if !system.has_shaft() && !is_part(system, kind, value.get_ref()) {
            continue;
        }
        let start = key.span().start;
        let place = Place::of_offset(text, start);
        let refuse = |problem: Box<Problem>| Err(problem.at(place).on_key(kind.path()));
        if !system.has_part(kind.word) {
            return refuse(no_effect(kind, file));
        }
        let written = match value.get_ref() {
            DeValue::Array(list) if list.len() > MOST_OF_A_KIND => {
                let found = format!("{} tables [[{}]]", list.len(), kind.path());
                let allowed = format!("at most {MOST_OF_A_KIND} are needed");
                return refuse(Problem::new(Code::RotorGeometry, file, found, allowed));
            }
            DeValue::Array(_) => tables(text, start, value.get_ref()),
            DeValue::Table(single) if kind.alone => {
                let mut keys = Vec::new();
                collect(text, single, "", &mut keys);
                vec![keys]
            }
            other => {
                let found = raw(other).text();
                let allowed = format!("tables [[{}]] are needed", kind.path());
                return refuse(Problem::new(Code::WrongType, file, found, allowed));
            }
        };
        for keys in written {
            let first = keys.iter().map(|(_, _, place)| *place);
            parts.push(WrittenPart {
                kind: kind.word,
                place: first.min_by_key(|place| place.line()).unwrap_or(place),
                keys,
            });
        }
    }
    Ok(parts)
}

/// Whether something is written as parts of a kind are: as tables, but not as the value of a key with its source.
pub fn is_part(system: SystemName, kind: &PartKind, value: &DeValue<'_>) -> bool {
    let meant = system.has_shaft();
    match value {
        DeValue::Array(list) => {
            let is_table =
                |item: &toml::Spanned<DeValue<'_>>| matches!(item.get_ref(), DeValue::Table(_));
            meant || (!list.is_empty() && list.iter().all(is_table))
        }
        DeValue::Table(single) => (meant || kind.alone) && !single.contains_key("value"),
        _ => false,
    }
}

/// What is said of a part in a file of another system.
fn no_effect(kind: &PartKind, file: &str) -> Box<Problem> {
    if let Some(absent) = not_modelled::of(kind.path(), SystemName::Rotor) {
        let found = "a key of what is not modelled yet";
        let problem = Problem::new(Code::NotModelled, file, found, absent.allowed());
        return problem.with_hint(absent.hint());
    }
    let found = "a section that has no effect";
    let allowed = match OF_MACHINES.contains(&kind.word) {
        true => "it is used only with system = \"machine\"",
        false => "it is used only with system = \"rotor\" or \"machine\"",
    };
    Problem::new(Code::UnusedKey, file, found, allowed)
}

/// An override of a value of a part: `rotor.disk.impeller.mass`, the name or the number of the part before its key.
pub fn set(parts: &mut [WrittenPart], file: &str, path: &[String], raw: Raw) -> Result<()> {
    let Some((kind, _)) = kind_within(&path.join(".")) else {
        return Ok(());
    };
    let (head, rest) = path.split_at(kind.path().split('.').count());
    let [named, keys @ ..] = rest else {
        return Ok(());
    };
    let of_kind = |part: &&mut WrittenPart| part.kind == kind.word;
    let mut parts: Vec<&mut WrittenPart> = parts.iter_mut().filter(of_kind).collect();
    let number = named.parse::<usize>().ok();
    let at = (parts.iter().position(|part| part.name() == Some(named)))
        .or_else(|| number?.checked_sub(1).filter(|at| *at < parts.len()));
    let (at, keys) = match (at, keys) {
        // a single part needs no name
        (None, []) if parts.len() == 1 => (Some(0), std::slice::from_ref(named)),
        other => other,
    };
    let (Some(at), [key]) = (at, keys) else {
        let names: Vec<String> = (1..)
            .zip(&parts)
            .map(|(number, part)| part.label(number))
            .collect();
        let allowed = format!(
            "{}.NAME.KEY is needed, with one of the names or numbers {}",
            head.join("."),
            names.join(", ")
        );
        let problem = Problem::new(Code::UnknownKey, file, quoted(named), allowed);
        return Err(problem.at(Place::Set).on_key(path.join(".")));
    };
    parts[at].keys.retain(|(other, ..)| other != key);
    parts[at].keys.push((key.clone(), raw, Place::Set));
    Ok(())
}

/// A part with all its values.
#[derive(Clone, Debug)]
pub struct Part {
    pub(crate) kind: &'static PartKind,
    /// Its name, else that of its magnet, else its number from 1.
    pub label: String,
    table: Table<SystemName>,
}

impl Deref for Part {
    type Target = Table<SystemName>;

    fn deref(&self) -> &Table<SystemName> {
        &self.table
    }
}

impl Part {
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
pub fn resolve(document: &Document, values: &Values) -> Result<Vec<Part>> {
    if document.parts.len() > MOST_PARTS {
        let found = format!("{} parts of a rotor", document.parts.len());
        let allowed = format!("at most {MOST_PARTS} are possible");
        return Err(Problem::new(
            Code::RotorGeometry,
            &values.file,
            found,
            allowed,
        ));
    }
    let has = |part: &WrittenPart, name: &str| part.keys.iter().any(|(key, ..)| key == name);
    let magnets = document.parts.iter().filter(|part| part.kind == "magnet");
    let volts = magnets.map(|part| has(part, "inductance") && !has(part, "amplifier_gain"));
    let volts: Vec<bool> = volts.collect();
    let mut all: Vec<Part> = Vec::new();
    for kind in PARTS {
        let of_kind = document.parts.iter().filter(|part| part.kind == kind.word);
        for (number, written) in (1..).zip(of_kind) {
            let mut written = written.clone();
            if kind.word == "controller" {
                renamed::with_units(&mut written.keys, &volts);
            }
            let mut part = read(kind, number, &written, &values.file)?;
            for key in kind.keys.iter().filter(|key| names_files(key)) {
                if let Some(known) = part.table.known.remove(key.name()) {
                    let known = values.lasting_path(key, known);
                    part.table.known.insert(key.name(), known);
                }
            }
            let same = |other: &&Part| other.kind.word == kind.word && other.label == part.label;
            if part.known.contains_key("name") && all.iter().any(|other| same(&other)) {
                let found = format!("the name {} twice", quoted(&part.label));
                let allowed = "a name of its own for each is needed";
                return part.refuse(Code::Conflict, "name", found, allowed);
            }
            all.push(part);
        }
    }
    let known = known_materials(&all, values)?;
    all.splice(0..0, known);
    Ok(all)
}

/// The materials known by name that parts are of, as the file could give them.
fn known_materials(all: &[Part], values: &Values) -> Result<Vec<Part>> {
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
            read(kind, 0, &written, &values.file)
        })
        .collect()
}

/// The parts of a document as its resolved file has them, each with its values by their paths.
pub fn toml(document: &Document, values: &Values) -> Vec<(String, Vec<(String, Known)>)> {
    let parts = resolve(document, values).unwrap_or_default();
    let of = |part: &Part| {
        let path = |key: &str| format!("{}.{}.{key}", part.kind.path(), part.label);
        let known = part.known.iter();
        let known = known.map(|(key, known)| (path(key), known.clone()));
        (part.toml(), known.collect())
    };
    parts.iter().map(of).collect()
}

/// Where a key of a part stands, such as `rotor.disk.impeller.mass`; else where its table does, or the first of its kind.
pub fn place(parts: &[WrittenPart], path: &str) -> Option<Place> {
    let kind = PARTS.iter().find(|kind| path.starts_with(kind.path()))?;
    let named = path.strip_prefix(kind.path())?;
    let mut of_kind = (1..).zip(parts.iter().filter(|part| part.kind == kind.word));
    let part = of_kind.find(|(number, part)| {
        let key = named.strip_prefix(&format!(".{}", part.label(*number)));
        named.is_empty() || key.is_some_and(|key| key.is_empty() || key.starts_with('.'))
    });
    let keys = &part?.1.keys;
    let own = keys
        .iter()
        .find(|(key, ..)| path.ends_with(&format!(".{key}")));
    let first = keys.iter().min_by_key(|(.., place)| place.line());
    own.or(first).map(|(.., place)| *place)
}

fn read(kind: &'static PartKind, number: usize, written: &WrittenPart, file: &str) -> Result<Part> {
    let label = written.label(number);
    let place = (
        format!("{}.{label}", kind.path()),
        &*format!("[[{}]]", kind.path()),
    );
    let table = Table::read(file, place, kind.keys, &written.keys, &[])?;
    Ok(Part { kind, label, table })
}
