//! What is simulated, and what is known without a run: catalogue, starting files, schemas, codes.

use crate::outcome::{Outcome, Warned, warned};
use crate::problem::raised;
use crate::simulation::Simulation;
use crate::table::Table;
use crate::watched::{PATIENCE, watched};
use auxbear::catalogue::{self, Catalogue, Filter, FilterTexts};
use auxbear::problem::explain::explain as page_of;
use auxbear::report;
use auxbear::run::{Machine, build, of_other_cases};
use auxbear::scenario::{self, BuiltIn};
use auxbear::study::evaluate;
use auxbear::units;
use auxbear_fmu::{controller, package};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// A scenario that was read and checked. It does not change.
#[pyclass(frozen)]
pub struct Scenario(pub Arc<scenario::Scenario>);

#[pymethods]
impl Scenario {
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Scenario> {
        let read = py.detach(|| scenario::Scenario::read(&path, &[], &BuiltIn));
        of(py, read)
    }

    #[staticmethod]
    fn parse(py: Python<'_>, text: &str, name: &str) -> PyResult<Scenario> {
        of(py, scenario::Scenario::parse(text, name, &[], &BuiltIn))
    }

    fn changed(&self, py: Python<'_>, changes: Vec<(String, String)>) -> PyResult<Scenario> {
        of(py, self.0.with(&changes))
    }

    fn toml(&self) -> String {
        self.0.resolved.toml()
    }

    fn system(&self) -> &'static str {
        self.0.system.name().word()
    }

    fn title(&self) -> Option<&str> {
        self.0.title.as_deref()
    }

    /// Path, value, mark and note of each value.
    fn values(&self) -> Vec<(String, Option<&str>, &'static str, String)> {
        let values = self.0.resolved.values.iter();
        let one = |value: &'_ scenario::ResolvedValue| {
            let provenance = &value.provenance;
            (value.shown(), provenance.mark(), provenance.note())
        };
        values
            .map(|value| {
                let (path, mark, note) = one(value);
                (path, value.text.as_deref(), mark, note)
            })
            .collect()
    }

    /// Builds the machine and returns each warning known before a run.
    fn check(&self, py: Python<'_>) -> PyResult<Vec<Warned>> {
        let scenario = self.0.clone();
        let warnings = watched(py, None, None, PATIENCE, move |_, _| {
            let machine = build(&scenario)?;
            of_other_cases(&scenario, &machine).map(|_| machine.warnings())
        })?;
        let warnings = warnings.map_err(|problem| raised(py, problem))?;
        Ok(warnings.iter().map(warned).collect())
    }

    /// Name, unit and meaning of each result of a run; nothing is run.
    fn results(&self, py: Python<'_>) -> PyResult<Vec<Declared>> {
        self.declared(py, |machine| {
            let all = machine.results().into_iter();
            all.map(|of| (of.name, of.unit, of.meaning.to_string()))
                .collect()
        })
    }

    /// The same of each column of its history.
    fn columns(&self, py: Python<'_>) -> PyResult<Vec<Declared>> {
        self.declared(py, |machine| {
            let all = machine.columns().into_iter();
            all.map(|of| (of.name, of.unit, of.meaning)).collect()
        })
    }

    #[pyo3(signature = (threads, progress))]
    fn run(
        &self,
        py: Python<'_>,
        threads: Option<NonZeroUsize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Outcome> {
        let checked = controller::checked(&self.0).map_err(|problem| raised(py, problem))?;
        let own = checked.map_or_else(|| self.0.clone(), Arc::new);
        let scenario = own.clone();
        let found = watched(py, threads, progress, PATIENCE, move |options, _| {
            build(&scenario).map(|machine| machine.run(options))
        })?;
        Outcome::of(own, found.map_err(|problem| raised(py, problem))?)
    }

    /// Writes it as a co-simulation unit.
    fn unit(
        &self,
        py: Python<'_>,
        path: PathBuf,
        input: &str,
        version: &str,
        libraries: Vec<PathBuf>,
    ) -> PyResult<()> {
        let written = package::written(&self.0, (input, version), &libraries, &path);
        written.map(|_| ()).map_err(|problem| raised(py, problem))
    }

    /// The machine at its start, to be driven from outside.
    fn simulation(&self, py: Python<'_>) -> PyResult<Simulation> {
        let scenario = self.0.clone();
        let found = watched(py, None, None, PATIENCE, move |_, _| {
            build(&scenario)?.simulation()
        })?;
        let driven = found.map_err(|problem| raised(py, problem))?;
        Ok(Simulation(Mutex::new(driven)))
    }

    /// Runs it with each of these lists of changes: results, a row each, and the reasons of the rows that failed.
    #[pyo3(signature = (changes, threads, progress))]
    fn evaluate(
        &self,
        py: Python<'_>,
        changes: Vec<Vec<(String, String)>>,
        threads: Option<NonZeroUsize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(Table, BTreeMap<usize, String>)> {
        let scenario = self.0.clone();
        let found = watched(py, threads, progress, PATIENCE, move |options, _| {
            evaluate(&scenario, &changes, options)
        })?;
        // only Ctrl-C interrupts, and that was raised
        let table = found
            .map_err(|problem| raised(py, problem))?
            .unwrap_or_default();
        let failed = table.failed.clone();
        Ok((Table::of_members(table)?, failed))
    }
}

/// Name, unit and meaning of a result or column.
type Declared = (String, &'static str, String);

impl Scenario {
    fn declared(
        &self,
        py: Python<'_>,
        list: impl FnOnce(&Machine) -> Vec<Declared> + Send + 'static,
    ) -> PyResult<Vec<Declared>> {
        let scenario = self.0.clone();
        let found = watched(py, None, None, PATIENCE, move |_, _| {
            build(&scenario).map(|machine| list(&machine))
        })?;
        found.map_err(|problem| raised(py, problem))
    }
}

fn of(
    py: Python<'_>,
    read: Result<scenario::Scenario, Box<auxbear::problem::Problem>>,
) -> PyResult<Scenario> {
    match read {
        Ok(read) => Ok(Scenario(Arc::new(read))),
        Err(problem) => Err(raised(py, problem)),
    }
}

#[pyfunction]
pub fn template(kind: &str) -> Option<String> {
    scenario::template(kind)
}

#[pyfunction]
pub fn schema(kind: &str) -> Option<String> {
    report::schema::schema(kind)
}

#[pyfunction]
pub fn explain(py: Python<'_>, code: &str) -> PyResult<String> {
    page_of(code).map_err(|problem| raised(py, problem))
}

/// A text with unit, in a unit of SI.
#[pyfunction]
pub fn number_in(text: &str, unit: &str) -> PyResult<f64> {
    let refused = |found: String| PyValueError::new_err(found);
    let quantity = units::parse_quantity(text).map_err(|error| refused(error.to_string()))?;
    let one = if unit == "1" { "" } else { unit };
    let wanted = units::parse_quantity(&format!("1 {one}"));
    if wanted.map(|one| one.dimension) != Ok(quantity.dimension) {
        return Err(refused(format!("\"{text}\" is no quantity in {unit}")));
    }
    Ok(quantity.value_si)
}

#[pyfunction]
pub fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// Bearings that are wanted, as JSON.
#[pyfunction]
pub fn bearings_json(
    py: Python<'_>,
    bore: Option<&str>,
    speed: Option<&str>,
    kind: Option<&str>,
    material: Option<&str>,
    file: Option<PathBuf>,
) -> PyResult<String> {
    let texts = FilterTexts {
        bore,
        speed,
        kind,
        material,
    };
    let found = Filter::read(&texts, "auxbear.bearings").and_then(|filter| {
        let catalogue = catalogue_of(file.as_deref())?;
        let wanted = catalogue.iter().filter(|bearing| filter.wants(bearing));
        Ok(catalogue::to_json(wanted))
    });
    found.map_err(|problem| raised(py, problem))
}

/// The bearing that is meant by a designation, as JSON, and the parts of the designation that were left out.
#[pyfunction]
pub fn bearing_json(
    py: Python<'_>,
    name: &str,
    file: Option<PathBuf>,
) -> PyResult<(String, String)> {
    let found = catalogue_of(file.as_deref()).and_then(|catalogue| {
        let meant = catalogue.meant(name, "auxbear.bearing")?;
        Ok((catalogue::to_json([meant.bearing]), meant.beyond_one()))
    });
    found.map_err(|problem| raised(py, problem))
}

fn catalogue_of(file: Option<&Path>) -> Result<Catalogue, Box<auxbear::problem::Problem>> {
    file.map_or(Ok(Catalogue::built_in()), Catalogue::with_file)
}
