//! Parts of a rotor as tables of a file: read, completed with defaults, written again.

use crate::document::Document;
use crate::resolved::{ResolvedValue, line};
use crate::rotor::part_keys::{PARTS, PartKind};
use crate::rotor::written::WrittenPart;
use crate::system::SystemName;
use crate::values::Values;
use physics::shaft::MATERIALS;
use problem::key::quoted;
use problem::raw::Raw;
use problem::table::Table;
use problem::{Code, Place, Problem};
use std::ops::Deref;
use units::number_text;

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
pub fn resolve(document: &Document, values: &Values) -> Result<Vec<Part>, Box<Problem>> {
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
            let part = read(kind, number, written, &values.file)?;
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
            read(kind, 0, &written, &values.file)
        })
        .collect()
}

/// The parts of a document as its resolved file has them.
pub fn toml(document: &Document, values: &Values) -> Vec<String> {
    let parts = resolve(document, values).unwrap_or_default();
    parts.iter().map(Part::toml).collect()
}

fn read(
    kind: &'static PartKind,
    number: usize,
    written: &WrittenPart,
    file: &str,
) -> Result<Part, Box<Problem>> {
    let label = written.name().map_or(number.to_string(), str::to_string);
    let place = (
        format!("{}.{label}", kind.path()),
        &*format!("[[{}]]", kind.path()),
    );
    let table = Table::read(file, place, kind.keys, &written.keys, &[])?;
    Ok(Part { kind, label, table })
}
