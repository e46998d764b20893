//! Spellings that files had before, and those that they have now:
//!
//! | before | now |
//! |---|---|
//! | results `run_out.*` | `coast_down.*` |
//! | `bearing.fidelity = "bushing"` | `bearing.type = "bushing"` |
//! | matrices of a controller as `"8000 0; 0 8000"`, SI | `[["8000 A/m", 0], [0, "8000 A/m"]]` |
//! | its filters as `"1 / 0.001 1"`, s in 1/s | `{ numerator = [...], denominator = [...] }` |

use crate::bearing::kind::{BUSHING, FIDELITY, TYPE, is_bushing};
use crate::document::{Document, Raw};
use crate::key::quoted;
use crate::several;
use problem::raw::Written;
use problem::read_matrix::{POLYNOMIALS, power_of_seconds};
use problem::{Code, Problem, Result};

/// The name that a result or column has now, of one that it had before: `run_out.stop_time` is `coast_down.stop_time`.
pub fn present_name(name: &str) -> String {
    let parts = name.split('.').map(|part| match part {
        "run_out" => "coast_down",
        part => part,
    });
    parts.collect::<Vec<_>>().join(".")
}

/// Gives `bearing.fidelity = "bushing"` the key that it has now: `bearing.type`.
///
/// # Errors
/// Another type beside it.
pub fn under_present_keys(document: &mut Document) -> Result<()> {
    let Some(given) = document.values.remove(FIDELITY) else {
        return Ok(());
    };
    if !is_bushing(&given) {
        document.values.insert(FIDELITY, given);
        return Ok(());
    }
    let ring = quoted(BUSHING);
    match document.values.get(TYPE).filter(|other| !is_bushing(other)) {
        Some(other) => {
            let shown = other.raw.plain().map_or_else(String::new, Raw::shown);
            let found = format!("{ring} beside {TYPE} = {}", quoted(&shown));
            let allowed = format!("one of the two is needed; the ring is {TYPE} = {ring} today");
            let path = several::path_of(document.bearing.as_deref(), FIDELITY);
            let problem = Problem::new(Code::Conflict, &document.file, found, allowed);
            Err(problem.at(given.place).on_key(path))
        }
        None => {
            document.values.entry(TYPE).or_insert(given);
            Ok(())
        }
    }
}

/// Gives texts of bare numbers among the keys of a controller the units that they have in SI; `volts` says of each magnet whether
/// its commands are in V. What is no such text stays.
pub fn with_units(keys: &mut [Written], volts: &[bool]) {
    for (name, raw, _) in keys {
        let raw = match raw {
            Raw::Table(parts) => match parts.iter_mut().find(|part| part.0 == "value") {
                Some((_, raw)) => raw,
                None => continue,
            },
            raw => raw,
        };
        let command = |row: usize, per: &str| match volts.get(row / 2) {
            Some(true) => format!("V{per}"),
            _ => format!("A{per}"),
        };
        let present = match name.as_str() {
            "a" => matrix(raw, |_| "1/s".to_string()),
            "b" => matrix(raw, |_| "1/(m s)".to_string()),
            "c" => matrix(raw, |row| command(row, "")),
            "d" => matrix(raw, |row| command(row, "/m")),
            "filters" => filters(raw),
            _ => None,
        };
        if let Some(present) = present {
            *raw = present;
        }
    }
}

/// A matrix of a text "1 0; 0 1", with the unit of each row.
fn matrix(raw: &Raw, unit: impl Fn(usize) -> String) -> Option<Raw> {
    let Raw::Text(text) = raw else {
        return None;
    };
    let rows = text.split(';').enumerate();
    let rows = rows.map(|(at, row)| quantities(&numbers(row)?, |_| unit(at)));
    Some(Raw::List(rows.collect::<Option<_>>()?))
}

/// Filters of texts "1 2 / 1 3".
fn filters(raw: &Raw) -> Option<Raw> {
    let filter = |raw: &Raw| {
        let Raw::Text(text) = raw else {
            return None;
        };
        let (above, below) = text.split_once('/')?;
        let both = [numbers(above)?, numbers(below)?];
        // the highest power of the denominator has a coefficient without a unit
        let order = both[1].len() as i64;
        let row = |row: &Vec<f64>| {
            let above = row.len() as i64 - order;
            quantities(row, |at| power_of_seconds(above - at as i64))
        };
        let parts = POLYNOMIALS.iter().zip(&both);
        let parts = parts.map(|(name, own)| Some(((*name).to_string(), row(own)?)));
        Some(Raw::Table(parts.collect::<Option<_>>()?))
    };
    let all = match raw {
        Raw::List(list) => list.iter().map(filter).collect(),
        single => filter(single).map(|one| vec![one]),
    };
    all.map(Raw::List)
}

/// Numbers between spaces.
fn numbers(text: &str) -> Option<Vec<f64>> {
    let number = |word: &str| word.parse().ok().filter(|value: &f64| value.is_finite());
    text.split_whitespace().map(number).collect()
}

/// Numbers with their units.
fn quantities(numbers: &[f64], unit: impl Fn(usize) -> String) -> Option<Raw> {
    let with_unit = |(at, value): (usize, &f64)| match unit(at).as_str() {
        "1" => Raw::Float(*value),
        unit => Raw::Text(format!("{} {unit}", units::number_text(*value))),
    };
    (!numbers.is_empty()).then(|| Raw::List(numbers.iter().enumerate().map(with_unit).collect()))
}
