//! A machine that is driven from outside.

use crate::problem::raised;
use auxbear::run::{self, Input};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A machine at an instant.
#[pyclass(frozen)]
pub struct Simulation(pub Mutex<run::Simulation>);

impl Simulation {
    fn driven(&self) -> MutexGuard<'_, run::Simulation> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl Simulation {
    fn time(&self) -> f64 {
        self.driven().time()
    }

    fn names(&self) -> Vec<String> {
        self.driven().names().to_vec()
    }

    fn value(&self, name: &str) -> Option<f64> {
        self.driven().value(name)
    }

    /// Goes on; reason, time and words of the end where it is over.
    fn advance(&self, py: Python<'_>, until: f64) -> Option<(&'static str, f64, String)> {
        let stop = py.detach(|| self.driven().advance(until));
        stop.map(|stop| (stop.reason, stop.time, stop.text))
    }

    fn change(&self, py: Python<'_>, input: &str, value: f64) -> PyResult<()> {
        let input = match input {
            "brake" => Input::Brake(value != 0.0),
            "load" => Input::Load(value),
            "torque" => Input::Torque(value),
            _ => return Err(PyValueError::new_err(format!("{input}: no input"))),
        };
        (self.driven().change(input)).map_err(|problem| raised(py, problem))
    }
}
