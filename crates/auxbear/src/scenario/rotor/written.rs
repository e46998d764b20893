//! Parts of a rotor as the text of a file has them, before it is known what their keys mean.

use crate::problem::{Code, Place, Problem};
use crate::scenario::key::quoted;
use crate::scenario::raw::{Raw, Written, raw, tables};
use crate::scenario::rotor::part_keys::PARTS;
use crate::scenario::system::SystemName;
use toml::de::{DeTable, DeValue};

/// A part as the text has it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WrittenPart {
    /// Word of its kind.
    pub(crate) kind: &'static str,
    pub(crate) keys: Vec<Written>,
    pub(crate) place: Place,
}

impl WrittenPart {
    /// Its name, where it has one.
    pub(crate) fn name(&self) -> Option<&str> {
        self.keys.iter().find_map(|(key, raw, _)| match raw {
            Raw::Text(name) if key == "name" => Some(name.as_str()),
            _ => None,
        })
    }
}

/// All parts below `[rotor]`.
pub(crate) fn read_all(
    text: &str,
    rotor: &DeTable<'_>,
    file: &str,
    system: SystemName,
) -> Result<Vec<WrittenPart>, Box<Problem>> {
    let mut parts = Vec::new();
    for kind in PARTS {
        let Some((key, value)) = rotor.get_key_value(kind.word) else {
            continue;
        };
        let start = key.span().start;
        let place = Place::of_offset(text, start);
        let path = format!("rotor.{}", kind.word);
        let refuse = |code, found: String, allowed: String| {
            let problem = Problem::new(code, file, found, allowed);
            Err(Box::new(problem.at(place).on_key(&path)))
        };
        if system != SystemName::Rotor {
            let found = "a section that has no effect".to_string();
            let allowed = "it is used only with system = \"rotor\"".to_string();
            return refuse(Code::UnusedKey, found, allowed);
        }
        if !matches!(value.get_ref(), DeValue::Array(_)) {
            let found = raw(value.get_ref()).text();
            let allowed = format!("tables [[{path}]] are needed");
            return refuse(Code::WrongType, found, allowed);
        }
        for keys in tables(text, start, value.get_ref()) {
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

/// An override of a value of a part: `rotor.disk.impeller.mass`, the name or the number of the part before its key.
pub(crate) fn set(
    parts: &mut [WrittenPart],
    file: &str,
    path: &[String],
    raw: Raw,
) -> Result<(), Box<Problem>> {
    let [_, kind, named, keys @ ..] = path else {
        return Ok(());
    };
    let mut parts: Vec<&mut WrittenPart> =
        parts.iter_mut().filter(|part| part.kind == kind).collect();
    let number = named.parse::<usize>().ok();
    let at = (parts.iter().position(|part| part.name() == Some(named)))
        .or_else(|| number?.checked_sub(1).filter(|at| *at < parts.len()));
    let (Some(at), [key]) = (at, keys) else {
        let names: Vec<String> = (1..)
            .zip(&parts)
            .map(|(number, part)| part.name().map_or(number.to_string(), str::to_string))
            .collect();
        let allowed = format!(
            "rotor.{kind}.NAME.KEY is needed, with one of the names or numbers {}",
            names.join(", ")
        );
        let problem = Problem::new(Code::UnknownKey, file, quoted(named), allowed);
        return Err(Box::new(problem.at(Place::Set).on_key(path.join("."))));
    };
    parts[at].keys.retain(|(other, ..)| other != key);
    parts[at].keys.push((key.clone(), raw, Place::Set));
    Ok(())
}
