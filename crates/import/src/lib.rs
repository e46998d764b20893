//! Rotors of other programs and tables of sections, as files of this program.
//!
//! ```text
//!   file ──ross, case, table──▶ Draft ──toml──▶ text ──Scenario──▶ rotor
//!                                 └────────────rotor───────────────▶ rotor     compared by eigenvalues
//! ```
//! What a file says that is not understood is listed, never dropped without a word.

#![forbid(unsafe_code)]

pub mod case;
pub mod draft;
pub mod ross;
mod table;
#[cfg(feature = "xlsx")]
mod workbook;

#[cfg(feature = "xlsx")]
use workbook::of_workbook;

use draft::Draft;
use problem::{Code, Problem, Result};
use rotor::{Analysis, C64};
use scenario::{BuiltIn, Scenario};
use simulate::rotor::RotorModel;
use std::io::Read;
use std::path::Path;

/// A rotor of another program.
pub struct Imported {
    /// The text of a scenario, system rotor.
    pub toml: String,
    /// What was read, and of which kind the file is.
    pub kind: String,
    /// What was not understood, or not taken as it stands.
    pub notes: Vec<String>,
    /// Eigenvalues of the rotor as read and as written.
    pub eigenvalues: Vec<Compared>,
}

/// Eigenvalues at one speed, 1/s; with the spin Im λ > 0 where all supports are alike in both directions, else Im λ ≥ 0.
pub struct Compared {
    /// Speed, rad/s.
    pub speed: f64,
    /// Those that the file itself states, where it does; else those of the rotor as it was read.
    pub before: Vec<C64>,
    /// Those of the scenario that was written.
    pub after: Vec<C64>,
    /// Whether the file states them.
    pub stated: bool,
}

impl Compared {
    /// Largest distance of an eigenvalue before from the nearest after, as a share of it.
    pub fn deviation(&self) -> f64 {
        let own = |z: &C64| {
            let distances = self.after.iter().map(|other| (z - other).norm());
            distances.fold(f64::INFINITY, f64::min) / z.norm()
        };
        self.before.iter().map(own).fold(0.0, f64::max)
    }
}

/// Eigenvalues shown at each speed.
const SHOWN: usize = 8;

/// Largest file, bytes.
const LARGEST: u64 = 10_000_000;

/// Reads a file of another program and writes it as a scenario.
///
/// # Errors
/// Where the file is none that is understood.
pub fn import(path: &Path) -> Result<Imported> {
    let name = path.display().to_string();
    let draft = read(path, &name)?;
    let toml = draft.toml();
    // The text that was written is not the user's: its lines say nothing.
    let of_text = |mut problem: Box<Problem>| {
        problem.file.clone_from(&name);
        problem.place = problem::Place::Whole;
        problem
    };
    let scenario = Scenario::parse(&toml, &name, &[], &BuiltIn).map_err(of_text)?;
    let Some(written) = scenario.rotor() else {
        return Err(unknown(&name, "a rotor that cannot be written"));
    };
    let lost = |_| unknown(&name, "a rotor without mass somewhere");
    let before = Analysis::full(&draft.rotor()).map_err(lost)?;
    let model = RotorModel::new(&written.rotor, written.speed);
    let after = Analysis::full(&model.map_err(of_text)?.rotor).map_err(lost)?;
    let speeds: Vec<f64> = match draft.stated.is_empty() {
        // sections of a table are divided into elements: there is nothing to compare
        true if draft.divide => Vec::new(),
        true => vec![0.0, draft.speed],
        false => draft.stated.iter().map(|(speed, _)| *speed).collect(),
    };
    let compared = speeds.iter().enumerate().map(|(k, speed)| {
        let of = |analysis: &Analysis| analysis.oscillations(*speed).map_err(lost);
        let stated = draft.stated.get(k).map(|(_, list)| list.clone());
        let mut after = of(&after)?;
        if stated.is_some() {
            // other programs list each pair once, without the sense in the sign
            for value in &mut after {
                value.im = value.im.abs();
            }
        }
        Ok(Compared {
            speed: *speed,
            stated: stated.is_some(),
            before: stated
                .map_or_else(|| of(&before), Ok)?
                .into_iter()
                .take(SHOWN)
                .collect(),
            after,
        })
    });
    Ok(Imported {
        eigenvalues: compared.collect::<Result<_>>()?,
        kind: draft.kind.clone(),
        notes: draft.notes.clone(),
        toml,
    })
}

/// Reads no workbook.
#[cfg(not(feature = "xlsx"))]
fn of_workbook(_bytes: &[u8]) -> Result<Vec<Vec<String>>, String> {
    Err("a workbook, which a build without the feature xlsx does not read".to_string())
}

/// The draft of a file, recognised by its content.
fn read(path: &Path, name: &str) -> Result<Draft> {
    let opened = problem::open_file(path).and_then(|file| {
        let mut bytes = Vec::new();
        file.take(LARGEST + 1).read_to_end(&mut bytes)?;
        Ok(bytes)
    });
    let bytes = opened.map_err(|error| {
        let code = match error.kind() {
            std::io::ErrorKind::NotFound => Code::FileMissing,
            _ => Code::FileUnreadable,
        };
        let found = format!("no file that can be read ({error})");
        Problem::at_path(
            code,
            path,
            found,
            "a rotor or a table of sections is needed",
        )
    })?;
    if bytes.len() as u64 > LARGEST {
        let found = format!("a file of more than {LARGEST} bytes");
        let needed = "a rotor or a table of sections is needed";
        return Err(Problem::at_path(Code::FileTooLarge, path, found, needed));
    }
    // a workbook is a ZIP archive
    if bytes.starts_with(b"PK\x03\x04") {
        let rows = of_workbook(&bytes).map_err(|why| unknown(name, &why))?;
        return table::draft(&rows, name);
    }
    let Ok(text) = String::from_utf8(bytes) else {
        return Err(unknown(
            name,
            "bytes that are neither text in UTF-8 nor a workbook",
        ));
    };
    let text = text.trim_start_matches('\u{feff}');
    let json: Option<serde_json::Value> = serde_json::from_str(text).ok();
    let json = json.filter(serde_json::Value::is_object);
    let toml = || toml::from_str::<serde_json::Value>(text).ok();
    match json.or_else(toml) {
        Some(value) if value.get("model").is_some() => {
            case::draft(&value).map_err(|why| unknown(name, &why))
        }
        Some(value) if value.get("parameters").is_some() || value.get("ross_version").is_some() => {
            ross::draft(&value).map_err(|why| unknown(name, &why))
        }
        Some(_) => Err(unknown(
            name,
            "a file without the parameters of a ROSS rotor",
        )),
        None => table::draft(&table::of_text(text), name),
    }
}

/// A file that is none of those that are understood.
fn unknown(name: &str, found: &str) -> Box<Problem> {
    let allowed = "a rotor saved by ROSS 2 or 3 (TOML or JSON), or a table of sections (CSV or XLSX) with units in its header, is needed";
    Problem::new(Code::ImportFormat, name, found, allowed)
}
