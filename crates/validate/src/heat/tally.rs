//! Comparisons of a file, each quantity with the worst of its rows and the tolerance that the file gives.

use crate::compare::Worst;
use crate::json::{list, number, text};
use crate::report::{Row, Tolerance};
use serde_json::Value;

/// Compares a row of a kind, or a file.
pub(super) type Compare = fn(&Value, &mut Tally) -> Result<(), String>;

/// Share and size by which a value may differ; it passes where either is met.
#[derive(Clone, Copy)]
pub(super) struct Allowed {
    pub relative: f64,
    pub absolute: f64,
}

impl Allowed {
    /// A share of the reference.
    pub fn share(relative: f64) -> Self {
        let absolute = 0.0;
        Allowed { relative, absolute }
    }
    /// A size, whatever the reference.
    pub fn size(absolute: f64) -> Self {
        let relative = 0.0;
        Allowed { relative, absolute }
    }
    /// What a tolerance of a reference means for it.
    pub fn of(self, reference: f64) -> Tolerance {
        if self.absolute > self.relative * reference.abs() {
            Tolerance::Absolute(self.absolute)
        } else {
            Tolerance::Relative(self.relative)
        }
    }
}

/// A tolerance: a number that is not negative.
pub(super) fn tolerance(value: &Value, key: &str) -> Result<f64, String> {
    match number(value, key) {
        Ok(number) if number >= 0.0 => Ok(number),
        _ => Err(format!("tolerance {key} is no number from 0 on")),
    }
}

/// The comparisons of a file so far.
pub(super) struct Tally<'a> {
    file: &'a Value,
    /// Of which row they are.
    pub place: String,
    worst: Worst,
}

impl<'a> Tally<'a> {
    pub fn new(file: &'a Value) -> Self {
        Tally {
            file,
            place: String::new(),
            worst: Worst::default(),
        }
    }
    /// The whole file.
    pub fn file(&self) -> &'a Value {
        self.file
    }
    /// The one tolerance of the file: `tolerance`, and `absolute` where there is one.
    pub fn allowed(&self) -> Result<Allowed, String> {
        let relative = tolerance(self.file, "tolerance")?;
        let absolute = match &self.file["absolute"] {
            Value::Null => 0.0,
            _ => tolerance(self.file, "absolute")?,
        };
        Ok(Allowed { relative, absolute })
    }
    /// The relative tolerance under a key of `tolerance`.
    pub fn relative(&self, key: &str) -> Result<Allowed, String> {
        tolerance(&self.file["tolerance"], key).map(Allowed::share)
    }
    /// The absolute tolerance under a key of `tolerance`.
    pub fn margin(&self, key: &str) -> Result<Allowed, String> {
        tolerance(&self.file["tolerance"], key).map(Allowed::size)
    }
    /// The absolute tolerance under a key of `absolute`.
    pub fn absolute(&self, key: &str) -> Result<Allowed, String> {
        tolerance(&self.file["absolute"], key).map(Allowed::size)
    }
    /// The relative and the absolute tolerance under a key.
    pub fn both(&self, key: &str) -> Result<Allowed, String> {
        let absolute = self.absolute(key)?.absolute;
        self.relative(key)
            .map(|share| Allowed { absolute, ..share })
    }
    /// Compares a value under the one tolerance of the file.
    pub fn add(
        &mut self,
        quantity: &str,
        unit: &str,
        reference: f64,
        ours: f64,
    ) -> Result<(), String> {
        let allowed = self.allowed()?;
        self.add_by(quantity, unit, reference, ours, allowed);
        Ok(())
    }
    /// Compares a value under a tolerance.
    pub fn add_by(
        &mut self,
        quantity: &str,
        unit: &str,
        reference: f64,
        ours: f64,
        allowed: Allowed,
    ) {
        let reason = self.file["reason"].as_str().unwrap_or_default();
        let why = match reason {
            "" => self.place.clone(),
            _ => format!("{}: {reason}", self.place),
        };
        let allowed = allowed.of(reference);
        let row = Row::compared(quantity, unit, reference, ours, allowed, why);
        self.worst.add(row);
    }
    /// Compares a number of a table of the file, named as its key.
    pub fn add_number(
        &mut self,
        (table, key): (&Value, &str),
        unit: &str,
        ours: f64,
        allowed: Allowed,
    ) -> Result<(), String> {
        let reference = number(table, key)?;
        self.add_by(&key.replace('_', " "), unit, reference, ours, allowed);
        Ok(())
    }
    /// Notes what is not compared.
    pub fn leave_out(&mut self, quantity: &str, why: &str) {
        self.worst.add(Row::not_run(why).of(quantity, ""));
    }
    /// Compares a row of the file, or a case by its inputs. One that lacks a number where there is a `null` is left out by itself.
    pub fn row(
        &mut self,
        place: &str,
        row: &Value,
        compare: impl FnOnce(&mut Self) -> Result<(), String>,
    ) -> Result<(), String> {
        let before = self.worst.clone();
        self.place = place.to_string();
        let found = compare(self);
        let after = std::mem::replace(&mut self.worst, before);
        self.worst.row(place, row, |worst| {
            *worst = after;
            found
        })
    }
    /// Compares each case of the file.
    pub fn cases(&mut self, one: Compare) -> Result<(), String> {
        for case in list(self.file, "cases")? {
            let name = format!("case {}", text(case, "name")?);
            self.row(&name, &case["inputs"], |tally| one(case, tally))?;
        }
        Ok(())
    }
    /// One row for each quantity.
    pub fn into_rows(self) -> Vec<Row> {
        self.worst.into_rows()
    }
}
