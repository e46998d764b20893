//! What comes out of a run.

use crate::problem::raised;
use crate::table::{Column, Table};
use auxbear::outcome::{self, Quantity, Value};
use auxbear::report::directory::{page_run, summary_text, write};
use auxbear::report::page;
use auxbear::scenario::Scenario;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyList, PyString};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// Everything known after a run.
#[pyclass(frozen)]
pub struct Outcome {
    scenario: Arc<Scenario>,
    /// Its history has no values: they stand in `history`.
    found: outcome::Outcome,
    history: Py<Table>,
}

/// Mean, standard deviation, smallest, largest, quantiles at 5, 50 and 95 %, number of members.
type Spread = (f64, f64, f64, f64, [f64; 3], usize);
/// Value, unit, why there is none, law, source, range, whether chaotic, spread.
type Told<'py> = (
    Option<Bound<'py, PyAny>>,
    &'static str,
    Option<String>,
    &'static str,
    &'static str,
    &'static str,
    bool,
    Option<Spread>,
);

/// A value of a warning.
#[derive(IntoPyObject)]
pub enum Amount {
    Number(f64),
    Text(String),
}
/// Code, text, severity, part, instant and values of a warning.
pub type Warned = (
    &'static str,
    String,
    &'static str,
    String,
    Option<f64>,
    BTreeMap<&'static str, (Amount, &'static str)>,
);

pub fn warned(warning: &outcome::Warning) -> Warned {
    let amount = |amount: &outcome::Amount| match amount {
        outcome::Amount::Number(value) => Amount::Number(*value),
        outcome::Amount::Text(text) => Amount::Text(text.clone()),
    };
    let values = warning.values.iter();
    (
        warning.code,
        warning.to_string(),
        warning.severity.word(),
        warning.part.clone(),
        warning.time,
        values
            .map(|(name, value, unit)| (*name, (amount(value), *unit)))
            .collect(),
    )
}

impl Outcome {
    pub fn of(scenario: Arc<Scenario>, mut found: outcome::Outcome) -> PyResult<Outcome> {
        let columns: Vec<Column> = (found.history.iter_mut())
            .map(|column| Column {
                name: column.name.clone(),
                unit: column.unit.to_string(),
                meaning: column.meaning.clone(),
                values: std::mem::take(&mut column.values),
            })
            .collect();
        let history = Python::attach(|py| Py::new(py, Table::of(columns)?))?;
        Ok(Outcome {
            scenario,
            found,
            history,
        })
    }

    /// With the values of its history.
    fn whole(&self) -> outcome::Outcome {
        let mut found = self.found.clone();
        for (column, (_, values)) in found.history.iter_mut().zip(self.history.get().values()) {
            column.values = values;
        }
        found
    }
}

#[pymethods]
impl Outcome {
    fn system(&self) -> &'static str {
        self.found.system
    }

    fn title(&self) -> &str {
        &self.found.title
    }

    fn names(&self) -> Vec<&str> {
        let quantities = self.found.quantities.iter();
        quantities.map(|quantity| quantity.name.as_str()).collect()
    }

    fn quantity<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Option<Told<'py>>> {
        let found = self.found.quantity(name);
        found.map(|quantity| told(py, quantity)).transpose()
    }

    fn history(&self, py: Python<'_>) -> Py<Table> {
        self.history.clone_ref(py)
    }

    /// Results of each member, a column a result that is a number; none of a run that is not repeated.
    fn members(&self) -> PyResult<Option<Table>> {
        let members = &self.found.members;
        if members.is_empty() {
            return Ok(None);
        }
        let number =
            |quantity: &&Quantity| matches!(quantity.value, Value::Number(_) | Value::None { .. });
        let columns = self.found.quantities.iter().filter(number);
        let columns = columns.map(|quantity| {
            let values = members.values(&quantity.name).into_iter();
            Column {
                name: quantity.name.clone(),
                unit: quantity.unit.to_string(),
                meaning: quantity.law.to_string(),
                values: values.map(|value| value.unwrap_or(f64::NAN)).collect(),
            }
        });
        Table::of(columns).map(Some)
    }

    fn warnings(&self) -> Vec<Warned> {
        self.found.warnings.iter().map(warned).collect()
    }

    /// Reason, time and sentence of the end.
    fn stop(&self) -> (&'static str, f64, &str) {
        let stop = &self.found.stop;
        (stop.reason, stop.time, &stop.text)
    }

    fn complete(&self) -> bool {
        self.found.stop.complete()
    }

    /// The text of `summary.json`.
    fn summary(&self, py: Python<'_>) -> PyResult<String> {
        let text = py.detach(|| summary_text(&self.scenario, &self.found));
        text.map_err(|problem| raised(py, problem))
    }

    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let written = py.detach(|| write(&path, &self.scenario, &self.whole()));
        written.map_err(|problem| raised(py, problem))
    }

    /// The page of this run, as `report.html` has it.
    fn html(&self, py: Python<'_>, name: &str) -> PyResult<String> {
        let page = py.detach(|| {
            let run = page_run(name, &self.scenario, &self.whole())?;
            Ok(page::html(&[run]))
        });
        page.map_err(|problem| raised(py, problem))
    }
}

fn told<'py>(py: Python<'py>, quantity: &Quantity) -> PyResult<Told<'py>> {
    let why = quantity.value.why_absent();
    let value = match &quantity.value {
        _ if why.is_some() => None,
        Value::Number(number) => Some(PyFloat::new(py, *number).into_any()),
        Value::List(list) => Some(PyList::new(py, list)?.into_any()),
        Value::Text(text) => Some(PyString::new(py, text).into_any()),
        Value::None { .. } => None,
    };
    let spread = quantity.spread.map(|of| {
        (
            of.mean,
            of.standard_deviation,
            of.smallest,
            of.largest,
            of.quantiles,
            of.members,
        )
    });
    Ok((
        value,
        quantity.unit,
        why.map(str::to_string),
        quantity.law,
        quantity.source,
        quantity.valid,
        quantity.chaotic,
        spread,
    ))
}
