//! A problem of the library becomes the exception `auxbear.Problem`.

use auxbear::problem::{Place, Problem};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

/// The exception of a problem. An override is named as what it is here: a call of `set`.
pub fn raised(py: Python<'_>, mut problem: Box<Problem>) -> PyErr {
    let place = problem.place;
    let file = problem.file.clone();
    if place == Place::Set {
        problem.file = format!("{file}, set()");
        problem.place = Place::Whole;
    }
    let (line, column) = match place {
        Place::Line { line, column } => (Some(line), Some(column)),
        Place::Whole | Place::Set => (None, None),
    };
    let made = || {
        let raised = class(py)?.call1((problem.to_string(),))?;
        raised.setattr("code", problem.code.text())?;
        raised.setattr("file", file)?;
        raised.setattr("line", line)?;
        raised.setattr("column", column)?;
        raised.setattr("key", problem.key)?;
        raised.setattr("found", problem.found)?;
        raised.setattr("allowed", problem.allowed)?;
        raised.setattr("hint", problem.hint)?;
        Ok(PyErr::from_value(raised))
    };
    made().unwrap_or_else(|error| error)
}

fn class(py: Python<'_>) -> PyResult<&Bound<'_, PyType>> {
    static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    CLASS.import(py, "auxbear._problem", "Problem")
}
