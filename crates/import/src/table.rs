//! Tables of sections: a header with units, a row for each piece of shaft, from left to right.
//!
//! | column | needed | meaning |
//! |---|---|---|
//! | `length [mm]` | yes | length of the piece |
//! | `outer diameter [mm]`, `outer diameter end [mm]` | the first | at its left and its right end |
//! | `inner diameter [mm]`, `inner diameter end [mm]` | no | bore |
//! | `material` | or the next three | a name that the program knows |
//! | `youngs modulus [GPa]`, `density [kg/m^3]`, `poisson ratio` | | of the row |
//! | `disk mass [kg]`, `disk polar inertia [kg m^2]`, `disk diametral inertia [kg m^2]` | no | a disk at the left end of the row |

use crate::draft::{Draft, cleaned};
use physics::shaft::{Annulus, MATERIALS, Material};
use problem::{Code, Place, Problem, Result};
use rotor::{Disk, Element};
use units::Unit;

/// Columns with the SI unit of their dimension; empty where there is none.
const COLUMNS: [(&str, &str); 12] = [
    ("length", "m"),
    ("outer diameter", "m"),
    ("outer diameter end", "m"),
    ("inner diameter", "m"),
    ("inner diameter end", "m"),
    ("material", ""),
    ("youngs modulus", "Pa"),
    ("density", "kg/m^3"),
    ("poisson ratio", ""),
    ("disk mass", "kg"),
    ("disk polar inertia", "kg m^2"),
    ("disk diametral inertia", "kg m^2"),
];

/// Rows of a text: columns apart by tabs, semicolons or commas, whichever the first row has.
pub(super) fn of_text(text: &str) -> Vec<Vec<String>> {
    let lines = || {
        text.lines()
            .filter(|line| !line.trim().is_empty() && !line.starts_with('#'))
    };
    let first = lines().next().unwrap_or_default();
    let apart = ['\t', ';', ',']
        .into_iter()
        .find(|c| first.contains(*c))
        .unwrap_or(',');
    let cell = |cell: &str| cell.trim().trim_matches('"').trim().to_string();
    lines()
        .map(|line| line.split(apart).map(cell).collect())
        .collect()
}

/// Rows of sections that a rotor may have.
const MOST_ROWS: usize = 500;
/// A column of the header: which it is, and what its numbers are multiplied with.
struct Column {
    name: &'static str,
    unit: Option<Unit>,
}

/// The draft of a table.
pub(super) fn draft(rows: &[Vec<String>], file: &str) -> Result<Draft> {
    let problem = |line: usize, found: String, allowed: &str| {
        Problem::new(Code::SectionTable, file, found, allowed).at(Place::Line { line, column: 1 })
    };
    let Some((head, rows)) = rows.split_first() else {
        let found = "an empty table".to_string();
        return Err(problem(
            1,
            found,
            "a header and a row for each section are needed",
        ));
    };
    if rows.len() > MOST_ROWS {
        let found = format!("{} rows of sections", rows.len());
        let allowed = format!("at most {MOST_ROWS} are possible");
        return Err(problem(1, found, &allowed));
    }
    let mut notes = Vec::new();
    let mut columns: Vec<Option<Column>> = Vec::new();
    for text in head {
        columns.push(column(text).map_err(|(found, allowed)| problem(1, found, &allowed))?);
        if columns.last().is_some_and(Option::is_none) && !text.is_empty() {
            notes.push(format!("column \"{text}\": not understood, left out"));
        }
    }
    for (at, name) in columns
        .iter()
        .flatten()
        .map(|column| column.name)
        .enumerate()
    {
        let others = columns.iter().flatten().take(at);
        if others.into_iter().any(|other| other.name == name) {
            let found = format!("two columns {name}");
            return Err(problem(1, found, "each column is possible once"));
        }
    }
    let has = |name: &str| columns.iter().flatten().any(|column| column.name == name);
    for name in ["length", "outer diameter"] {
        if !has(name) {
            let found = format!("a header without {name}");
            let allowed = "columns \"length [mm]\" and \"outer diameter [mm]\" are needed";
            return Err(problem(1, found, allowed));
        }
    }
    let mut draft = Draft {
        kind: "table of sections".to_string(),
        title: "Rotor of a table of sections".to_string(),
        speed: 100.0,
        nodes: vec![0.0],
        divide: true,
        ..Draft::default()
    };
    notes.push("rotor.speed = 100 rad/s is a place-holder to be replaced".to_string());
    notes.push("a table has no supports: add [[rotor.support]]".to_string());
    for (line, row) in (2..).zip(rows) {
        if let Some(text) = row.iter().skip(head.len()).find(|text| !text.is_empty()) {
            let found = format!("\"{text}\" in a column without a name");
            let allowed = "cells below the header alone are possible";
            return Err(problem(line, found, allowed));
        }
        let at = |name: &str| {
            columns
                .iter()
                .position(|c| c.as_ref().is_some_and(|c| c.name == name))
        };
        let text = |name: &str| {
            at(name)
                .and_then(|k| row.get(k))
                .filter(|text| !text.is_empty())
        };
        let number = |name: &str| -> Result<Option<f64>> {
            let Some(written) = text(name) else {
                return Ok(None);
            };
            let (whole, rest) = written.split_once(',').unwrap_or((written, ""));
            if rest.len() == 3
                && !whole.starts_with('0')
                && rest.bytes().all(|b| b.is_ascii_digit())
            {
                let found =
                    format!("\"{written}\" as {name}, which may be a decimal comma or thousands");
                let allowed = "a point before decimals, and no mark between thousands, is needed";
                return Err(problem(line, found, allowed));
            }
            let value: Option<f64> = written.replace(',', ".").parse().ok();
            let value = value
                .filter(|value: &f64| value.is_finite() && *value >= 0.0)
                .ok_or_else(|| {
                    problem(
                        line,
                        format!("\"{written}\" as {name}"),
                        "a number not below 0 is needed",
                    )
                })?;
            let unit = at(name).and_then(|k| columns[k].as_ref()?.unit);
            Ok(Some(unit.map_or(value, |unit| cleaned(unit.to_si(value)))))
        };
        let needed = |name: &str| -> Result<f64> {
            number(name)?.filter(|value| *value > 0.0).ok_or_else(|| {
                problem(
                    line,
                    format!("a row without {name}"),
                    "a number above 0 is needed in each row",
                )
            })
        };
        let (length, outer) = (needed("length")?, needed("outer diameter")?);
        let inner = number("inner diameter")?.unwrap_or(0.0);
        let own = [number("youngs modulus")?, number("density")?];
        let name = text("material").map_or("", String::as_str);
        let known = MATERIALS.iter().find(|m| m.0 == name);
        let material = match (own, known) {
            ([Some(young), Some(density)], _) => {
                Material::new(young, number("poisson ratio")?.unwrap_or(0.3), density)
            }
            (_, Some((_, young, poisson, density, _))) => Material::new(*young, *poisson, *density),
            _ => {
                let found = format!("a row without material (\"{name}\")");
                let names: Vec<&str> = MATERIALS.iter().map(|m| m.0).collect();
                let allowed = format!(
                    "a column material with one of {}, or columns \"youngs modulus [GPa]\" and \"density [kg/m^3]\", is needed",
                    names.join(", ")
                );
                return Err(problem(line, found, &allowed));
            }
        };
        let index = draft.material(name, material);
        let left = draft.nodes.len() - 1;
        if let Some(mass) = number("disk mass")?.filter(|mass| *mass > 0.0) {
            let name = format!("disk_{}", draft.disks.len() + 1);
            let mut inertia = |which: &str| -> Result<f64> {
                let given = number(&format!("disk {which} inertia"))?;
                if given.is_none() {
                    notes.push(format!(
                        "{name} of line {line}: no {which} inertia in the table, 0 is written; it does not resist tilting by it"
                    ));
                }
                Ok(given.unwrap_or(0.0))
            };
            let disk = Disk {
                node: left,
                mass,
                polar: inertia("polar")?,
                diametral: inertia("diametral")?,
            };
            draft.disks.push((name, disk));
        }
        let start = Annulus { outer, inner };
        let end = Annulus {
            outer: number("outer diameter end")?.unwrap_or(outer),
            inner: number("inner diameter end")?.unwrap_or(inner),
        };
        if let Some(own) = [start, end].iter().find(|own| own.inner >= own.outer) {
            let found = format!("an inner diameter of {} m in {} m", own.inner, own.outer);
            let allowed = "an inner diameter below the outer one is needed";
            return Err(problem(line, found, allowed));
        }
        draft.nodes.push(cleaned(draft.nodes[left] + length));
        draft.pieces.push((
            index,
            Element {
                left,
                length,
                start,
                end,
                material,
                carries: true,
                damping_of_mass: 0.0,
                damping_of_stiffness: 0.0,
                damping_rotating: 0.0,
            },
        ));
    }
    if draft.pieces.is_empty() {
        let found = "a header without rows".to_string();
        return Err(problem(1, found, "a row for each section is needed"));
    }
    draft.notes = notes;
    Ok(draft)
}

/// A column of a header: `outer diameter [mm]`; `None` for one that is not known.
fn column(text: &str) -> Result<Option<Column>, (String, String)> {
    let (name, unit) = match text.split_once(['[', '(']) {
        Some((name, rest)) => (name, Some(rest.trim_end_matches([']', ')']).trim())),
        None => (text, None),
    };
    let plain = name
        .trim()
        .to_lowercase()
        .replace(['_', '-'], " ")
        .replace('\'', "");
    let Some((name, si)) = COLUMNS.iter().find(|column| column.0 == plain) else {
        return Ok(None);
    };
    if si.is_empty() {
        return Ok(Some(Column { name, unit: None }));
    }
    let allowed = format!(
        "a header with a unit is needed, e.g. \"{name} [{}]\"",
        match *si {
            "m" => "mm",
            "Pa" => "GPa",
            other => other,
        }
    );
    let Some(unit) = unit else {
        return Err((format!("the column \"{text}\" without a unit"), allowed));
    };
    let parsed = Unit::parse(unit).ok();
    let wanted = Unit::parse(si).ok().map(|unit| unit.dimension());
    match parsed.filter(|unit| Some(unit.dimension()) == wanted) {
        Some(unit) => Ok(Some(Column {
            name,
            unit: Some(unit),
        })),
        None => Err((
            format!("the column \"{text}\", whose unit is none of its dimension"),
            allowed,
        )),
    }
}
