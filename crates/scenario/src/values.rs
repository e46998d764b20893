//! One value for every key that has one, with everything known of it.

use crate::bearing::source::BearingRecord;
use crate::key::{Key, Kind};
use crate::several;
use crate::system::SystemName;
use problem::provenance::Provenance;
use problem::read::Reader;
pub use problem::value::{Known, Value};
use problem::words::Words;
use problem::{Code, Place, Problem, Result};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Key of the law of the friction moment, on which its constants depend.
pub const LAW: &str = "bearing.moment.law";
/// Key of the lubrication, which not every law asks for.
pub const LUBRICATION: &str = "bearing.moment.lubrication";
/// Key of the laws that are compared with it.
pub const COMPARED_LAWS: &str = "torque.laws";

/// One value for every key that has one.
#[derive(Debug)]
pub struct Values {
    pub(crate) file: String,
    pub(crate) system: SystemName,
    /// Name of the auxiliary bearing, where the file has several.
    pub bearing: Option<String>,
    /// Number of rows of all auxiliary bearings.
    pub rows: f64,
    pub(crate) known: BTreeMap<&'static str, Known>,
    /// What the catalogue knows of the bearing named.
    pub record: Option<BearingRecord>,
    /// Keys that typed values needed and that have none.
    pub lacking: RefCell<Vec<String>>,
    /// Given keys that nothing is computed from, kept as information.
    pub without_effect: Vec<&'static str>,
    /// Of each key of the system whether it has neither a value nor a meaning, where that is known from a file with the same choices.
    pub(crate) hidden: Option<Arc<[bool]>>,
}

/// Surface speed that no rotor reaches, m/s.
const FASTEST_SURFACE: f64 = 2000.0;

impl Values {
    /// Number of equal rows that the auxiliary bearing stands for: its own, or planes of the whole rotor.
    pub fn planes(&self) -> f64 {
        let of = |path| self.number(path).unwrap_or(1.0);
        of(several::PLANES) * of("rotor.planes")
    }

    /// Refuses a speed at which a radius, m, would move faster than any rotor holds together.
    pub fn holds_together(&self, path: &str, speed: f64, radius: f64) -> Result<()> {
        let surface = speed.abs() * radius;
        if surface <= FASTEST_SURFACE {
            return Ok(());
        }
        let found = format!(
            "{}, at which a radius of {} mm moves with {surface:.1e} m/s",
            self.text(path).unwrap_or_default(),
            units::number_text((1e6 * radius).round() * 1e-3)
        );
        let needed = format!(
            "at most {FASTEST_SURFACE} m/s is possible: steel bursts below 600 m/s, composites below 1500 m/s"
        );
        self.refuse(Code::OutOfRange, path, found, needed)
    }

    /// What reads a value of this key.
    pub fn reader(&self, key: &Key) -> Reader<'_> {
        let of = |path: &str| Some((self.number(path)?, self.text(path)?));
        let exponent = match key.kind {
            Kind::ContactStiffness { exponent } => of(exponent),
            _ => None,
        };
        Reader {
            exponent: exponent.unwrap_or((f64::NAN, String::new())),
            ..Reader::of(&self.file, self.shown(key.path))
        }
    }

    pub(crate) fn problem(
        &self,
        code: Code,
        path: &str,
        place: Place,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Box<Problem> {
        Problem::new(code, &self.file, found, allowed)
            .at(place)
            .on_key(self.shown(path))
    }

    /// Refuses the value of a key, where it stands.
    pub(crate) fn refuse<T>(
        &self,
        code: Code,
        path: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Result<T> {
        let problem = self.problem(code, path, self.place(path), found, allowed);
        Err(problem)
    }

    /// Whether a value was computed from others.
    pub fn is_derived(&self, path: &str) -> bool {
        let known = self.known.get(path);
        known.is_some_and(|known| matches!(known.provenance, Provenance::Derived(_)))
    }

    /// The path of a key as the file has it.
    pub fn shown(&self, path: &str) -> String {
        several::path_of(self.bearing.as_deref(), path)
    }

    /// The file, as the user named it.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The system of the file.
    pub fn system(&self) -> SystemName {
        self.system
    }

    /// Whether the system of the file is one of these.
    pub(crate) fn is_in(&self, systems: &[SystemName]) -> bool {
        systems.contains(&self.system)
    }

    pub(crate) fn put(&mut self, path: &'static str, known: Known) {
        self.known.insert(path, known);
    }

    /// Takes a value away that has no effect after all.
    pub fn take_away(&mut self, path: &str) {
        self.known.remove(path);
    }

    /// Whether a value was given, rather than filled in.
    pub fn is_given(&self, path: &str) -> bool {
        self.known.get(path).is_some_and(|known| {
            !matches!(
                known.provenance,
                Provenance::Default(_) | Provenance::DefaultAssumed(_)
            )
        })
    }

    /// Whether the user gave a value, rather than a default, the catalogue or other values.
    pub fn is_own(&self, path: &str) -> bool {
        self.known.get(path).is_some_and(|known| {
            matches!(
                known.provenance,
                Provenance::Given | Provenance::GivenWithSource(_) | Provenance::Assumed(_)
            )
        })
    }

    /// Where a value comes from, in one word; empty where there is none.
    pub fn mark(&self, path: &str) -> &'static str {
        let known = self.known.get(path);
        known.map_or("", |known| known.provenance.mark())
    }

    /// A dimension of the bearing named, as the catalogue knows it.
    pub fn dimension(&self, name: &str) -> Option<f64> {
        let mut values = self.record.as_ref()?.values.iter();
        values.find(|value| value.0 == name).map(|value| value.1)
    }

    /// Where a value was given.
    pub fn place(&self, path: &str) -> Place {
        self.known
            .get(path)
            .map_or(Place::Whole, |known| known.place)
    }

    /// The value as written.
    pub fn text(&self, path: &str) -> Option<String> {
        self.known.get(path).map(|known| known.text.clone())
    }

    /// A number in SI, where there is one.
    pub fn number(&self, path: &str) -> Option<f64> {
        self.known.get(path).and_then(|known| known.value.number())
    }

    /// A word as its enum, where there is one.
    pub fn chosen<T: Words>(&self, path: &str) -> Option<T> {
        match self.known.get(path)?.value {
            Value::Word(word) => T::of_word(word),
            _ => None,
        }
    }

    /// Remembers a key that is needed and has no value; `instead` stands for it until the scenario is refused.
    pub fn lack<T>(&self, path: &str, instead: T) -> T {
        self.lacking.borrow_mut().push(path.to_string());
        instead
    }

    /// Refuses what lacks a value that is needed.
    pub fn complete(&self) -> Result<()> {
        match self.lacking.borrow().first() {
            None => Ok(()),
            Some(path) => self.refuse(Code::MissingKey, path, "no value", "a value is needed"),
        }
    }

    /// A word; empty where there is none.
    pub fn word(&self, path: &str) -> &'static str {
        match self.known.get(path).map(|known| &known.value) {
            Some(Value::Word(word)) => word,
            _ => "",
        }
    }

    /// A switch; off where there is none.
    pub fn switch(&self, path: &str) -> bool {
        matches!(
            self.known.get(path).map(|known| &known.value),
            Some(Value::Switch(true))
        )
    }

    /// The rows of a table, where there is one.
    pub fn rows(&self, path: &str) -> Option<Vec<[f64; 2]>> {
        match self.known.get(path).map(|known| &known.value) {
            Some(Value::Rows(rows)) => Some(rows.clone()),
            _ => None,
        }
    }

    /// A list of quantities in SI; empty where there is none.
    pub fn numbers(&self, path: &str) -> Vec<f64> {
        match self.known.get(path).map(|known| &known.value) {
            Some(Value::Numbers(list)) => list.clone(),
            _ => Vec::new(),
        }
    }

    /// A list of words; empty where there is none.
    pub fn words(&self, path: &str) -> &[&'static str] {
        match self.known.get(path).map(|known| &known.value) {
            Some(Value::Words(list)) => list,
            _ => &[],
        }
    }

    /// A list of texts; empty where there is none.
    pub fn texts(&self, path: &str) -> &[String] {
        match self.known.get(path).map(|known| &known.value) {
            Some(Value::Texts(list)) => list,
            _ => &[],
        }
    }

    /// A whole number; 0 where there is none.
    pub fn count(&self, path: &str) -> u64 {
        match self.known.get(path).map(|known| &known.value) {
            Some(Value::Count(count)) => *count,
            _ => 0,
        }
    }
}
