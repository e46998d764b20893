//! Comparisons of a file, each quantity with the worst of its rows and the tolerance that the file gives.

use super::json::number;
use crate::validate::compare::Worst;
use crate::validate::report::{Row, Tolerance};
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
    left_out: Vec<(String, String, usize)>,
}

impl<'a> Tally<'a> {
    pub fn new(file: &'a Value) -> Self {
        Tally {
            file,
            place: String::new(),
            worst: Worst::default(),
            left_out: Vec::new(),
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
        Ok(Allowed {
            relative: tolerance(&self.file["tolerance"], key)?,
            absolute: 0.0,
        })
    }
    /// The absolute tolerance under a key of `absolute`.
    pub fn absolute(&self, key: &str) -> Result<Allowed, String> {
        Ok(Allowed {
            relative: 0.0,
            absolute: tolerance(&self.file["absolute"], key)?,
        })
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
    /// Notes what is not compared.
    pub fn leave_out(&mut self, quantity: &str, why: &str) {
        let known = self
            .left_out
            .iter_mut()
            .find(|(known, reason, _)| known == quantity && reason == why);
        match known {
            Some((_, _, count)) => *count += 1,
            None => self
                .left_out
                .push((quantity.to_string(), why.to_string(), 1)),
        }
    }
    /// One row for each quantity.
    pub fn into_rows(self) -> Vec<Row> {
        let mut rows = self.worst.into_rows();
        let left_out = self.left_out.into_iter();
        rows.extend(left_out.map(|(quantity, why, count)| {
            Row::not_run(format!("{count} of them: {why}")).of(quantity, "")
        }));
        rows
    }
}
