//! Parts of a rotor and of its levitation as the text of a file has them, before it is known what their keys mean.

use crate::key::quoted;
use crate::not_modelled;
use crate::rotor::part_keys::{PARTS, PartKind};
use crate::system::SystemName;
use problem::raw::{Raw, Written, collect, raw, tables};
use problem::{Code, Place, Problem};
use toml::de::{DeTable, DeValue};

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
        self.keys.iter().find_map(|(key, raw, _)| match raw {
            Raw::Text(name) if key == "name" || key == "magnet" => Some(name.as_str()),
            _ => None,
        })
    }
}

/// All parts of a file.
pub fn read_all(
    text: &str,
    root: &DeTable<'_>,
    file: &str,
    system: SystemName,
) -> Result<Vec<WrittenPart>, Box<Problem>> {
    let mut parts = Vec::new();
    for kind in PARTS {
        let table = root.get(kind.table()).map(|value| value.get_ref());
        let Some(DeValue::Table(table)) = table else {
            continue;
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
        let refuse = |problem: Problem| Err(Box::new(problem.at(place).on_key(kind.path())));
        if !system.has_shaft() {
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
fn no_effect(kind: &PartKind, file: &str) -> Problem {
    if let Some(absent) = not_modelled::of(&kind.path(), SystemName::Rotor) {
        let found = "a key of what is not modelled yet";
        let problem = Problem::new(Code::NotModelled, file, found, absent.allowed());
        return problem.with_hint(absent.hint());
    }
    let found = "a section that has no effect";
    let allowed = "it is used only with system = \"rotor\" or \"machine\"";
    Problem::new(Code::UnusedKey, file, found, allowed)
}

/// An override of a value of a part: `rotor.disk.impeller.mass`, the name or the number of the part before its key.
pub fn set(
    parts: &mut [WrittenPart],
    file: &str,
    path: &[String],
    raw: Raw,
) -> Result<(), Box<Problem>> {
    let [_, kind, named, keys @ ..] = path else {
        return Ok(());
    };
    let of_kind = |part: &&mut WrittenPart| part.kind == kind;
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
            .map(|(number, part)| part.name().map_or(number.to_string(), str::to_string))
            .collect();
        let allowed = format!(
            "{}.{kind}.NAME.KEY is needed, with one of the names or numbers {}",
            path[0],
            names.join(", ")
        );
        let problem = Problem::new(Code::UnknownKey, file, quoted(named), allowed);
        return Err(Box::new(problem.at(Place::Set).on_key(path.join("."))));
    };
    parts[at].keys.retain(|(other, ..)| other != key);
    parts[at].keys.push((key.clone(), raw, Place::Set));
    Ok(())
}
