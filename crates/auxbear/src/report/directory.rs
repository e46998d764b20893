//! A run directory: `scenario.toml`, `summary.json`, `history.parquet`, `report.html`, and what the run leaves besides.
//!
//! It is filled under the name `DIR.partial` and gets its own name when all files are complete, so a directory
//! that looks whole is whole. Whatever goes wrong before, the partial one is removed.

use super::page::{self, PageColumn, PageRun};
use super::picture;
use super::{history, summary};
use crate::problem::{Code, Problem};
use crate::result::outcome::Attached;
use crate::run::Outcome;
use crate::scenario::Scenario;
use measure::recording::Channel;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

const SCENARIO: &str = "scenario.toml";
const SUMMARY: &str = "summary.json";
const HISTORY: &str = "history.parquet";
const REPORT: &str = "report.html";

/// Values of a channel that are written at once to a measurement file.
const PIECE: usize = 16_384;

const WRITABLE: &str = "a place with room and permission to write is needed";

/// A run directory to be: its place is reserved as `DIR.partial`, and given back unless [`NewDirectory::finish`] is
/// reached and succeeds.
#[derive(Debug)]
pub struct NewDirectory {
    path: PathBuf,
    partial: PathBuf,
}

impl NewDirectory {
    /// Reserves the place. What exists there is never touched: it is a problem.
    pub fn reserve(path: &Path) -> Result<NewDirectory, Box<Problem>> {
        if exists(path) {
            return Err(taken(path));
        }
        let partial = partial_of(path).ok_or_else(|| {
            Box::new(Problem::at_path(
                Code::OutputPlace,
                path,
                "no name of a directory",
                "a directory with a name of its own is needed",
            ))
        })?;
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(|error| misplaced(parent, &error))?;
        }
        match fs::create_dir(&partial) {
            Ok(()) => Ok(NewDirectory {
                path: path.to_path_buf(),
                partial,
            }),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {
                Err(Box::new(Problem::at_path(
                    Code::OutputExists,
                    &partial,
                    "what another run is writing or left behind",
                    "choose another directory, or remove this one if no run is using it",
                )))
            }
            Err(error) => Err(misplaced(&partial, &error)),
        }
    }

    /// The directory as it will be called.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The directory as it is called until it is finished.
    pub fn partial(&self) -> &Path {
        &self.partial
    }

    /// Writes the files and gives the directory its name.
    pub fn finish(self, scenario: &Scenario, outcome: &Outcome) -> Result<(), Box<Problem>> {
        let summary_json = summary::json(scenario, outcome)
            .map_err(|error| failed(&self.partial.join(SUMMARY), &error.into()))?;
        let scenario_toml = scenario.resolved.toml();
        self.file(SCENARIO, |file| file.write_all(scenario_toml.as_bytes()))?;
        self.file(SUMMARY, |file| file.write_all(summary_json.as_bytes()))?;
        self.file(HISTORY, |file| {
            history::write(file, &outcome.history).map_err(io_error)
        })?;
        for attachment in &outcome.files {
            match &attachment.content {
                Attached::Text(text) => {
                    self.file(&attachment.name, |file| file.write_all(text.as_bytes()))?;
                }
                Attached::Recording(channels) => self.recording(&attachment.name, channels)?,
            }
        }
        let columns = outcome.history.iter().map(|column| PageColumn {
            name: column.name.clone(),
            unit: column.unit.to_string(),
            meaning: column.meaning.clone(),
            values: column.values.clone(),
        });
        let run = PageRun {
            name: name_of(&self.path),
            directory: self.path.display().to_string(),
            summary_json,
            scenario_toml,
            columns: columns.collect(),
        };
        let html = page::html(&[run]);
        self.file(REPORT, |file| file.write_all(html.as_bytes()))?;
        // On some systems a rename would replace an empty directory that appeared meanwhile.
        if exists(&self.path) {
            return Err(taken(&self.path));
        }
        fs::rename(&self.partial, &self.path).map_err(|error| failed(&self.path, &error))
    }

    /// Writes a measurement file.
    fn recording(&self, name: &str, channels: &[(Channel, Vec<f64>)]) -> Result<(), Box<Problem>> {
        let (told, values): (Vec<Channel>, Vec<&[f64]>) = channels
            .iter()
            .map(|(channel, values)| (channel.clone(), values.as_slice()))
            .unzip();
        measure::file::create(self.partial.join(name), &told)
            .and_then(|mut writer| {
                // in pieces, as a logger writes: a file that is cut keeps its begin
                let longest = values.iter().map(|list| list.len()).max().unwrap_or(0);
                for from in (0..longest).step_by(PIECE) {
                    let piece = |list: &[f64]| from.min(list.len())..(from + PIECE).min(list.len());
                    let pieces: Vec<&[f64]> =
                        values.iter().map(|list| &list[piece(list)]).collect();
                    writer.append(&pieces)?;
                }
                writer.finish()
            })
            .map_err(|error| {
                let found = format!("that it cannot be written ({error})");
                let path = self.path.join(name);
                Box::new(Problem::at_path(Code::OutputFailed, &path, found, WRITABLE))
            })
    }

    /// Writes one file; a problem names the place where it would have stood.
    fn file(
        &self,
        name: &str,
        fill: impl FnOnce(&mut File) -> std::io::Result<()>,
    ) -> Result<(), Box<Problem>> {
        File::create_new(self.partial.join(name))
            .and_then(|mut file| {
                fill(&mut file)?;
                file.sync_all()
            })
            .map_err(|error| failed(&self.path.join(name), &error))
    }
}

impl Drop for NewDirectory {
    /// After a rename there is nothing left of this name to remove.
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.partial);
    }
}

/// Writes the run directory of a finished run.
pub fn write(path: &Path, scenario: &Scenario, outcome: &Outcome) -> Result<(), Box<Problem>> {
    NewDirectory::reserve(path)?.finish(scenario, outcome)
}

/// The directory that a run gets where none is asked for: `runs/NAME`, or `runs/NAME-2` and so on where that is taken.
pub fn free_path(name: &str) -> PathBuf {
    let first = Path::new("runs").join(name);
    let others = (2..).map(|number| Path::new("runs").join(format!("{name}-{number}")));
    std::iter::once(first.clone())
        .chain(others)
        .find(|path| !exists(path) && !partial_of(path).is_some_and(|path| exists(&path)))
        .unwrap_or(first)
}

/// Reads a run directory back.
pub fn read(path: &Path) -> Result<PageRun, Box<Problem>> {
    const NEEDED: &str = "a run directory, as auxbear run writes it, is needed";
    let unreadable = |path: &Path, error: &std::io::Error| {
        let (code, found) = match error.kind() {
            ErrorKind::NotFound | ErrorKind::NotADirectory => {
                (Code::FileMissing, "nothing there".to_string())
            }
            ErrorKind::InvalidData => (Code::FileNotUtf8, "bytes that are not UTF-8 text".into()),
            _ => (Code::FileUnreadable, error.to_string()),
        };
        Box::new(Problem::at_path(code, path, found, NEEDED))
    };
    let text = |name: &str| -> Result<String, Box<Problem>> {
        let path = path.join(name);
        let mut text = String::new();
        File::open(&path)
            .and_then(|mut file| file.read_to_string(&mut text))
            .map_err(|error| unreadable(&path, &error))?;
        Ok(text)
    };
    if !exists(path) {
        let missing = ErrorKind::NotFound.into();
        return Err(unreadable(path, &missing));
    }
    if !path.is_dir() {
        return Err(Box::new(Problem::at_path(
            Code::FileUnreadable,
            path,
            "a file",
            NEEDED,
        )));
    }
    let history = path.join(HISTORY);
    let columns = File::open(&history)
        .and_then(|file| history::read(file).map_err(io_error))
        .map_err(|error| match error.kind() {
            ErrorKind::Other => Box::new(Problem::at_path(
                Code::FileUnreadable,
                &history,
                format!("what cannot be read as a history ({error})"),
                NEEDED,
            )),
            _ => unreadable(&history, &error),
        });
    Ok(PageRun {
        name: name_of(path),
        directory: path.display().to_string(),
        summary_json: text(SUMMARY)?,
        scenario_toml: text(SCENARIO)?,
        columns: columns?,
    })
}

/// Writes the report of one run directory into it again; what it replaces was drawn from the same files.
pub fn rewrite_report(path: &Path) -> Result<PathBuf, Box<Problem>> {
    let html = page::html(&[read(path)?]);
    let report = path.join(REPORT);
    let fresh = path.join("report.html.partial");
    fs::write(&fresh, html)
        .and_then(|()| fs::rename(&fresh, &report))
        .map_err(|error| {
            let _ = fs::remove_file(&fresh);
            failed(&report, &error)
        })?;
    Ok(report)
}

/// Writes the page of one run directory, or of several side by side, to a new file; to a file `*.svg` one run's orbit,
/// contact force and speeds as a picture.
pub fn write_report(file: &Path, directories: &[PathBuf]) -> Result<(), Box<Problem>> {
    let runs = directories
        .iter()
        .map(|path| read(path))
        .collect::<Result<Vec<_>, _>>()?;
    let picture = match file.extension().and_then(|end| end.to_str()) {
        Some("html" | "htm") => false,
        Some("svg") => true,
        _ => {
            return Err(Box::new(Problem::at_path(
                Code::UnknownWord,
                file,
                "a name of no kind that the report has",
                "*.html is needed, or *.svg for the picture of one run; a browser prints the page to PDF, and history.parquet of the run holds the columns",
            )));
        }
    };
    let text = match (picture, runs.as_slice()) {
        (false, _) => page::html(&runs),
        (true, [run]) if picture::shows(run) => picture::orbit_svg(run),
        (true, [run]) => {
            return Err(Box::new(Problem::at_path(
                Code::Conflict,
                file,
                format!("a picture of {}, which is no drop", run.name),
                "a picture (*.svg) shows the orbit of a drop; name a *.html file",
            )));
        }
        (true, _) => {
            return Err(Box::new(Problem::at_path(
                Code::Conflict,
                file,
                format!("a picture of {} runs", runs.len()),
                "a picture (*.svg) shows one run; name one directory, or a *.html file",
            )));
        }
    };
    let mut out = File::create_new(file).map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => taken(file),
        _ => misplaced(file, &error),
    })?;
    out.write_all(text.as_bytes()).map_err(|error| {
        let _ = fs::remove_file(file);
        failed(file, &error)
    })
}

/// True for anything of this name, a dangling link too.
fn exists(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}

fn partial_of(path: &Path) -> Option<PathBuf> {
    let mut name = OsString::from(path.file_name()?);
    name.push(".partial");
    Some(path.with_file_name(name))
}

/// The last part of the path; that of the full path for one like `.`.
fn name_of(path: &Path) -> String {
    let full = fs::canonicalize(path).unwrap_or_default();
    path.file_name()
        .or(full.file_name())
        .map_or("run".into(), |name| name.to_string_lossy().into_owned())
}

fn taken(path: &Path) -> Box<Problem> {
    Box::new(Problem::at_path(
        Code::OutputExists,
        path,
        "something of this name",
        "results are never written over others: choose another --out, or remove it",
    ))
}

/// Why nothing can be made at a path that was given: the place is wrong, or the disk is full.
pub fn misplaced(path: &Path, error: &std::io::Error) -> Box<Problem> {
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => failed(path, error),
        _ => {
            let found = format!("that nothing can be made there ({error})");
            Box::new(Problem::at_path(Code::OutputPlace, path, found, WRITABLE))
        }
    }
}

/// What the system refused to write.
pub fn failed(path: &Path, error: &std::io::Error) -> Box<Problem> {
    let found = format!("that it cannot be written ({error})");
    Box::new(Problem::at_path(Code::OutputFailed, path, found, WRITABLE))
}

/// The error of the system inside one of Parquet, where there is one; else its words.
fn io_error(error: parquet::errors::ParquetError) -> std::io::Error {
    use parquet::errors::ParquetError;
    match error {
        ParquetError::External(inner) => match inner.downcast::<std::io::Error>() {
            Ok(error) => *error,
            Err(other) => std::io::Error::other(other),
        },
        other => std::io::Error::other(other),
    }
}
