//! Many runs of one scenario.

use crate::problem::raised;
use crate::scenario::Scenario;
use crate::table::Table;
use crate::watched::{LONG_PATIENCE, PATIENCE, watched};
use auxbear::report::study::{Directory, Wish, part as part_of, read};
use auxbear::run::Options;
use auxbear::scenario::StudyFile;
use auxbear::study;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::Arc;

/// A study that was read and checked. It does not change.
#[pyclass(frozen)]
pub struct Study(StudyFile);

#[pymethods]
impl Study {
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Study> {
        let read = py.detach(|| StudyFile::read(&path));
        read.map(Study).map_err(|problem| raised(py, problem))
    }

    #[staticmethod]
    fn parse(py: Python<'_>, text: &str, name: &str, folder: PathBuf) -> PyResult<Study> {
        let read = py.detach(|| StudyFile::parse(text, name, Some(&folder)));
        read.map(Study).map_err(|problem| raised(py, problem))
    }

    fn toml(&self) -> String {
        self.0.toml()
    }

    fn title(&self) -> Option<&str> {
        self.0.title.as_deref()
    }

    fn kind(&self) -> &'static str {
        self.0.kind
    }

    fn members(&self) -> usize {
        self.0.design.members().unwrap_or(0)
    }

    /// The paths that differ from member to member.
    fn inputs(&self) -> Vec<&str> {
        let inputs = self.0.inputs.iter();
        inputs.map(|input| input.vary.path.as_str()).collect()
    }

    fn scenario(&self) -> Scenario {
        Scenario(Arc::new(self.0.scenario.clone()))
    }

    /// The scenario of member k.
    fn member(&self, py: Python<'_>, k: usize) -> PyResult<Scenario> {
        if k >= self.members() {
            let text = format!("member {k} of a study of {} members", self.members());
            return Err(PyIndexError::new_err(text));
        }
        let scenario = study::Study::new(self.0.clone()).and_then(|study| study.scenario(k));
        match scenario {
            Ok(scenario) => Ok(Scenario(Arc::new(scenario))),
            Err(problem) => Err(raised(py, problem)),
        }
    }

    /// Computes a part: the bytes of its file.
    fn part<'py>(
        &self,
        py: Python<'py>,
        part: usize,
        threads: Option<NonZeroUsize>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let file = self.0.clone();
        let done = watched(py, threads, None, PATIENCE, move |options, _| {
            let study = study::Study::new(file)?;
            // only Ctrl-C interrupts, and that is raised
            part_of(&study, part, options).unwrap_or_else(|| Ok(Vec::new()))
        })?;
        match done {
            Ok(bytes) => Ok(PyBytes::new(py, &bytes)),
            Err(problem) => Err(raised(py, problem)),
        }
    }

    /// Begins the study of a directory or goes on with it.
    #[pyo3(signature = (path, add, threads, progress))]
    fn run(
        &self,
        py: Python<'_>,
        path: PathBuf,
        add: usize,
        threads: Option<NonZeroUsize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<()> {
        let file = self.0.clone();
        let done = watched(
            py,
            threads,
            progress,
            LONG_PATIENCE,
            move |options, tell| {
                let directory = Directory::open(&path, study::Study::new(file)?, add)?;
                let all = directory.study.members() as f64;
                directory.run(options, &|members| tell(members / all))
            },
        )?;
        done.map(|_| ()).map_err(|problem| raised(py, problem))
    }

    /// Begins a qualification or goes on with it, and writes its document.
    #[pyo3(signature = (path, date, threads, progress))]
    fn qualify(
        &self,
        py: Python<'_>,
        path: PathBuf,
        date: String,
        threads: Option<NonZeroUsize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<()> {
        let file = self.0.clone();
        let work = move |options: &Options, tell: &(dyn Fn(f64) + Sync)| {
            file.require_qualification()?;
            let directory = Directory::open(&path, study::Study::new(file)?, 0)?;
            let wish = Wish {
                date: &date,
                progress: &|_, done, all| tell(done / all.max(1) as f64),
            };
            directory.qualify(options, &wish)
        };
        let done = watched(py, threads, progress, LONG_PATIENCE, work)?;
        done.map(|_| ()).map_err(|problem| raised(py, problem))
    }
}

/// A study directory that this process alone works on, whose parts are computed elsewhere.
#[pyclass(frozen)]
pub struct Parts(Arc<Directory>);

#[pymethods]
impl Parts {
    #[staticmethod]
    fn open(py: Python<'_>, study: &Study, path: PathBuf, add: usize) -> PyResult<Parts> {
        let file = study.0.clone();
        let opened = py.detach(|| Directory::open(&path, study::Study::new(file)?, add));
        let opened = opened.map_err(|problem| raised(py, problem))?;
        Ok(Parts(Arc::new(opened)))
    }

    /// The study as it stands in its directory, and its scenario, as texts.
    fn texts(&self) -> (String, String) {
        let file = &self.0.study.file;
        (file.toml(), file.scenario.resolved.toml())
    }

    /// Numbers of the parts that are not there.
    fn missing(&self, py: Python<'_>) -> PyResult<Vec<usize>> {
        let missing = py.detach(|| self.0.open_parts());
        missing.map_err(|problem| raised(py, problem))
    }

    fn put(&self, py: Python<'_>, part: usize, bytes: &[u8]) -> PyResult<()> {
        let put = py.detach(|| self.0.put(part, bytes));
        put.map_err(|problem| raised(py, problem))
    }

    /// Writes what the members say that are there.
    fn finish(&self, py: Python<'_>) -> PyResult<()> {
        let directory = self.0.clone();
        let done = watched(py, None, None, LONG_PATIENCE, move |options, _| {
            directory.finish(options)
        })?;
        done.map(|_| ()).map_err(|problem| raised(py, problem))
    }
}

/// The study of a directory with its members: inputs first, then results.
#[pyfunction]
pub fn read_study(py: Python<'_>, path: PathBuf) -> PyResult<(Study, Table)> {
    let (study, members) = py
        .detach(|| read(&path))
        .map_err(|problem| raised(py, problem))?;
    Ok((Study(study.file), Table::of_members(members)?))
}
