//! A run directory: `scenario.toml`, `summary.json`, `history.parquet`, `report.html`, and what the run leaves besides.
//!
//! It is filled under the name `DIR.partial` and gets its own name when all files are complete, so a directory
//! that looks whole is whole. Where a file cannot be written, the others are kept as `DIR.incomplete`; what else goes wrong
//! before removes the partial one.
//!
//! The process that fills `DIR.partial` holds a lock on it, which goes with the process: one without a lock was left behind by
//! a process that was killed, and the next takes it over.

use super::figures::with_figures;
use super::members::{self, Kept, MEMBERS};
use super::page::{self, PageColumn, PageRun};
use super::picture;
use super::place::{FILES, has_members_of, hash_of, hashes, of_another, was_interrupted};
pub use super::place::{RUNS, besides, free_path, free_path_in, has_members, path_of_run};
use super::{history, summary};
use outcome::{Attached, Stop};
use problem::open_file;
use problem::{Code, Problem, Result};
use recording::Channel;
use run::Outcome;
use run::study::kept::{Nowhere, Store};
use scenario::Scenario;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

pub(super) const SCENARIO: &str = "scenario.toml";
pub(super) const SUMMARY: &str = "summary.json";
pub(super) const HISTORY: &str = "history.parquet";
pub(super) const REPORT: &str = "report.html";
/// What the folder of an export begins with.
pub(super) const FIRST_TABLE: &str = "run.csv";

/// Values of a channel that are written at once to a measurement file.
const PIECE: usize = 16_384;

pub(super) const WRITABLE: &str = "a place with room and permission to write is needed";

/// A run directory to be: its place is reserved as `DIR.partial`, and given back unless [`NewDirectory::finish`] is
/// reached and succeeds.
#[derive(Debug)]
pub struct NewDirectory {
    path: PathBuf,
    partial: PathBuf,
    /// The partial directory, locked; none where the system locks no directories.
    lock: Option<File>,
    /// Where a repetition keeps its members.
    kept: Option<Kept>,
    /// Members that an earlier run of the same scenario has left here.
    pub there: usize,
}

impl NewDirectory {
    /// Reserves the place. What exists there is never touched: it is a problem.
    pub fn reserve(path: &Path) -> Result<NewDirectory> {
        NewDirectory::reserved(path, |_| false)
    }

    /// Reserves the place of a run of so many members. What a run of the same scenario has left there that was killed or interrupted
    /// stays: a repetition goes on from its members.
    pub fn of_run(path: &Path, scenario: &Scenario, members: usize) -> Result<NewDirectory> {
        if members < 2 {
            return NewDirectory::reserve(path);
        }
        let resolved = scenario.resolved.toml();
        if was_interrupted(path, None) && !was_interrupted(path, Some(&resolved)) {
            return Err(of_another(path));
        }
        if let Some(partial) = partial_of(path)
            && !exists(&partial)
            && was_interrupted(path, Some(&resolved))
        {
            fs::rename(path, &partial).map_err(|error| misplaced(path, &error))?;
        }
        let mut own = NewDirectory::reserved(path, |partial| has_members_of(partial, &resolved))?;
        own.file(SCENARIO, |file| file.write_all(resolved.as_bytes()))?;
        fs::create_dir_all(own.partial.join(MEMBERS)).map_err(|error| misplaced(path, &error))?;
        let hashes = hashes(&resolved);
        if !hashes.is_empty() {
            let place = own.partial.join(MEMBERS).join(FILES);
            aside(&place, |mut file| file.write_all(hashes.as_bytes()))?;
        }
        let run = hash_of(&format!("{resolved}{hashes}"));
        let (kept, there) = Kept::of(&own.partial, members, run)?;
        (own.kept, own.there) = (Some(kept), there);
        Ok(own)
    }

    /// Reserves the place; `stays` says of what a killed process left whether it is taken over as it is.
    fn reserved(path: &Path, stays: impl FnOnce(&Path) -> bool) -> Result<NewDirectory> {
        if exists(path) {
            return Err(taken(path));
        }
        let partial = partial_of(path).ok_or_else(|| {
            let needed = "a directory with a name of its own is needed";
            Problem::at_path(Code::OutputPlace, path, "no name of a directory", needed)
        })?;
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(|error| misplaced(parent, &error))?;
        }
        let in_use = || {
            let found = "what another run is writing or left behind";
            let needed = "choose another directory, or remove this one if no run is using it";
            Problem::at_path(Code::OutputExists, &partial, found, needed)
        };
        let lock = match fs::create_dir(&partial) {
            Ok(()) => match locked(&partial) {
                Ok(lock) => Some(lock),
                // another run took it for one left behind
                Err(TryLockError::WouldBlock) => return Err(in_use()),
                Err(TryLockError::Error(_)) => None,
            },
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {
                let left = locked(&partial).map_err(|_| in_use())?;
                if !stays(&partial) {
                    if has_members(&partial) {
                        return Err(of_another(&partial));
                    }
                    let _ = fs::remove_dir(partial.join(MEMBERS));
                    empty_leftover(&partial).map_err(|_| in_use())?;
                }
                Some(left)
            }
            Err(error) => return Err(misplaced(&partial, &error)),
        };
        Ok(NewDirectory {
            path: path.to_path_buf(),
            partial,
            lock,
            kept: None,
            there: 0,
        })
    }

    /// Where a repetition keeps its members; none of a run that is not repeated.
    pub fn store(&self) -> &dyn Store {
        match &self.kept {
            Some(kept) => kept,
            None => &Nowhere,
        }
    }

    /// The directory as it is called until it is finished.
    pub fn partial(&self) -> &Path {
        &self.partial
    }

    /// Writes the files and gives the directory its name. Where one cannot be written, the others are kept under another name,
    /// which the problem tells, and their summary says that they are not complete.
    pub fn finish(self, scenario: &Scenario, outcome: &Outcome) -> Result<()> {
        self.fill(scenario, outcome).map_err(|problem| {
            let stop = Stop {
                reason: "not written",
                time: outcome.stop.time,
                text: problem.to_string(),
            };
            let name = self.partial.join(SUMMARY);
            if name.exists()
                && File::create(&name)
                    .is_ok_and(|file| summary::write(file, scenario, outcome, &stop).is_err())
            {
                // one that says that all is there would be worse than none
                let _ = fs::remove_file(name);
            }
            // a repetition goes on from its members
            let told = match has_members(&self.partial) {
                true => Some(format!(
                    "Its members are kept in {}: the same call goes on from them",
                    self.partial.display()
                )),
                false => self.kept(),
            };
            problem.with_hint(told)
        })
    }

    /// Gives what was written the name `DIR.incomplete`; tells that. None where nothing was.
    fn kept(&self) -> Option<String> {
        fs::read_dir(&self.partial).ok()?.next()?.ok()?;
        let others = (2..100).map(|number| format!("incomplete-{number}"));
        let ends = std::iter::once("incomplete".to_string()).chain(others);
        let mut places = ends.filter_map(|end| with_end(&self.path, &end));
        let place = places.find(|place| !exists(place))?;
        fs::rename(&self.partial, &place).ok()?;
        let place = place.display();
        Some(format!("What could be written is kept in {place}"))
    }

    /// Writes the files, each whatever became of the others; tells of the first that could not be written.
    fn fill(&self, scenario: &Scenario, outcome: &Outcome) -> Result<()> {
        // somebody may have removed it while the run was computed
        let _ = fs::create_dir(&self.partial);
        let summary_json = summary::of_page(scenario, outcome)
            .map_err(|error| failed(&self.partial.join(SUMMARY), &error.into()))?;
        let scenario_toml = scenario.resolved.toml();
        let members = match &self.kept {
            Some(kept) => kept.problem().map_or(Ok(()), Err),
            None => members::write_all(&self.partial, &outcome.members),
        };
        let mut written = vec![
            members,
            self.file(SCENARIO, |file| file.write_all(scenario_toml.as_bytes())),
            self.file(SUMMARY, |file| {
                summary::write(file, scenario, outcome, &outcome.stop).map_err(Into::into)
            }),
            self.file(HISTORY, |file| {
                history::write(file, &outcome.history).map_err(io_error)
            }),
        ];
        for attachment in &outcome.files {
            let name = &attachment.name;
            written.push(match &attachment.content {
                Attached::Text(text) => self.file(name, |file| file.write_all(text.as_bytes())),
                Attached::Bytes(bytes) => self.file(name, |file| file.write_all(bytes)),
                Attached::Recording(channels) => self.recording(name, channels),
            });
        }
        let run = PageRun {
            name: name_of(&self.path),
            directory: self.path.display().to_string(),
            summary_json,
            scenario_toml,
            columns: columns_of(outcome),
        };
        let html = page::html(&[run]);
        written.push(self.file(REPORT, |file| file.write_all(html.as_bytes())));
        written.into_iter().collect::<Result<(), _>>()?;
        self.named()
    }

    /// Gives the directory its name, when all files in it are whole.
    pub(super) fn named(&self) -> Result<()> {
        // On some systems a rename would replace an empty directory that appeared meanwhile.
        if exists(&self.path) {
            return Err(taken(&self.path));
        }
        fs::rename(&self.partial, &self.path).map_err(|error| failed(&self.path, &error))
    }

    /// Writes a measurement file.
    fn recording(&self, name: &str, channels: &[(Channel, Vec<f64>)]) -> Result<()> {
        let (told, values): (Vec<Channel>, Vec<&[f64]>) = channels
            .iter()
            .map(|(channel, values)| (channel.clone(), values.as_slice()))
            .unzip();
        recording::file::create(self.partial.join(name), &told)
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
                Problem::at_path(Code::OutputFailed, &path, found, WRITABLE)
            })
    }

    /// Writes one file, or nothing of it; a problem names the place where it would have stood.
    pub(super) fn file(
        &self,
        name: &str,
        fill: impl FnOnce(&mut File) -> std::io::Result<()>,
    ) -> Result<()> {
        let place = self.partial.join(name);
        File::create(&place)
            .and_then(|mut file| {
                fill(&mut file)
                    .and_then(|()| file.sync_all())
                    .inspect_err(|_| {
                        let _ = fs::remove_file(&place);
                    })
            })
            .map_err(|error| failed(&self.path.join(name), &error))
    }
}

impl Drop for NewDirectory {
    /// After a rename there is nothing left of this name to remove, or what is there is another run's.
    fn drop(&mut self) {
        if !has_members(&self.partial)
            && (self.lock.as_ref()).is_none_or(|lock| is_at(lock, &self.partial))
        {
            let _ = fs::remove_dir_all(&self.partial);
        }
    }
}

/// A finished run as its page needs it, without a run directory.
///
/// # Errors
/// What cannot be told as JSON.
pub fn page_run(name: &str, scenario: &Scenario, outcome: &Outcome) -> Result<PageRun> {
    let summary_json = summary::of_page(scenario, outcome)
        .map_err(|error| failed(Path::new(SUMMARY), &error.into()))?;
    Ok(PageRun {
        name: name.to_string(),
        directory: String::new(),
        summary_json,
        scenario_toml: scenario.resolved.toml(),
        columns: columns_of(outcome),
    })
}

/// The text of `summary.json` of a finished run.
///
/// # Errors
/// What cannot be told as JSON.
pub fn summary_text(scenario: &Scenario, outcome: &Outcome) -> Result<String> {
    let mut text = Vec::new();
    summary::write(&mut text, scenario, outcome, &outcome.stop)
        .map_err(|error| failed(Path::new(SUMMARY), &error.into()))?;
    // JSON is UTF-8
    Ok(String::from_utf8(text).unwrap_or_default())
}

fn columns_of(outcome: &Outcome) -> Vec<PageColumn> {
    let columns = outcome.history.iter().map(|column| PageColumn {
        name: column.name.clone(),
        unit: column.unit.to_string(),
        meaning: column.meaning.clone(),
        values: column.values.clone(),
    });
    columns.collect()
}

/// Writes the run directory of a finished run.
pub fn write(path: &Path, scenario: &Scenario, outcome: &Outcome) -> Result<()> {
    NewDirectory::reserve(path)?.finish(scenario, outcome)
}

/// Most bytes of a summary or scenario that is read.
const MOST_BYTES: u64 = 1 << 29;

/// Formats of a summary that are read.
const READ_FORMATS: [&str; 2] = ["auxbear.summary/1", summary::FORMAT];

/// What every summary has: without it a page would show a run without results.
#[derive(serde::Deserialize)]
struct Head {
    format: String,
    #[serde(rename = "quantities")]
    _quantities: BTreeMap<String, serde::de::IgnoredAny>,
}

/// Reads a run directory back.
pub fn read(path: &Path) -> Result<PageRun> {
    const NEEDED: &str = "a run directory, as auxbear run writes it, is needed";
    let unreadable = |path: &Path, error: &std::io::Error| {
        let (code, found) = match error.kind() {
            ErrorKind::NotFound | ErrorKind::NotADirectory => {
                (Code::FileMissing, "nothing there".to_string())
            }
            ErrorKind::InvalidData => (Code::FileNotUtf8, "bytes that are not UTF-8 text".into()),
            _ => (Code::FileUnreadable, error.to_string()),
        };
        Problem::at_path(code, path, found, NEEDED)
    };
    let text = |name: &str, damage: fn(&str) -> Option<String>| -> Result<String> {
        let path = path.join(name);
        let of_directory =
            |found: String| Problem::at_path(Code::FileUnreadable, &path, found, NEEDED);
        let mut text = String::new();
        let file = open_file(&path).map_err(|error| unreadable(&path, &error))?;
        let length = file.metadata().map_or(0, |about| about.len());
        if length > MOST_BYTES {
            let found = format!("{length} bytes, of which a run writes at most {MOST_BYTES}");
            return Err(of_directory(found));
        }
        file.take(MOST_BYTES)
            .read_to_string(&mut text)
            .map_err(|error| unreadable(&path, &error))?;
        match damage(&text) {
            None => Ok(text),
            Some(damage) => Err(of_directory(damage)),
        }
    };
    if !exists(path) {
        let missing = ErrorKind::NotFound.into();
        return Err(unreadable(path, &missing));
    }
    if !path.is_dir() {
        let code = Code::FileUnreadable;
        return Err(Problem::at_path(code, path, "a file", NEEDED));
    }
    let history = path.join(HISTORY);
    let damaged = |error: recording::FileError| {
        let what = format!("{} {}", error.place, error.found);
        let found = format!("what cannot be read as a history ({})", what.trim());
        Problem::at_path(Code::FileUnreadable, &history, found, NEEDED)
    };
    let columns = open_file(&history)
        .map_err(|error| unreadable(&history, &error))
        .and_then(|file| history::read(file, &history).map_err(damaged));
    Ok(PageRun {
        name: name_of(path),
        directory: path.display().to_string(),
        summary_json: with_figures(
            text(SUMMARY, |text| match serde_json::from_str::<Head>(text) {
                Err(error) => Some(format!("what cannot be read as a summary ({error})")),
                Ok(head) if READ_FORMATS.contains(&head.format.as_str()) => None,
                Ok(head) => Some(format!(
                    "a summary of format {:?}; this version reads {}",
                    head.format,
                    READ_FORMATS.join(" and ")
                )),
            })?,
            &path.join(SCENARIO),
        ),
        scenario_toml: text(SCENARIO, |text| {
            let table: Result<toml::Table, _> = toml::from_str(text);
            match table {
                Ok(table) if table.contains_key("format") => None,
                Ok(_) => Some("a text without the key format".to_string()),
                Err(error) => Some(format!("what is no scenario ({})", error.message())),
            }
        })?,
        columns: columns?,
    })
}

/// Writes the report of one run directory into it again; what it replaces was drawn from the same files.
pub fn rewrite_report(path: &Path) -> Result<PathBuf> {
    let html = page::html(&[read(path)?]);
    let report = path.join(REPORT);
    aside(&report, |mut file| file.write_all(html.as_bytes()))?;
    Ok(report)
}

/// Writes a new file, whole or not at all, also where the process is killed.
pub(super) fn new_file(path: &Path, write: impl FnOnce(File) -> std::io::Result<()>) -> Result<()> {
    match exists(path) {
        true => Err(taken(path)),
        false => aside(path, write),
    }
}

/// Writes a file as `FILE.partial`, which gets its name when it is whole. One that a killed process left is written over.
pub(super) fn aside(path: &Path, write: impl FnOnce(File) -> std::io::Result<()>) -> Result<()> {
    let nameless = || misplaced(path, &ErrorKind::InvalidFilename.into());
    let fresh = partial_of(path).ok_or_else(nameless)?;
    let file = File::create(&fresh).map_err(|error| misplaced(path, &error))?;
    write(file)
        .and_then(|()| File::open(&fresh)?.sync_all())
        .and_then(|()| fs::rename(&fresh, path))
        .map_err(|error| {
            let _ = fs::remove_file(&fresh);
            failed(path, &error)
        })
}

/// Writes the page of one run directory, or of several side by side, to a new file; to a file `*.svg` one run's orbit,
/// contact force and speeds as a picture.
pub fn write_report(file: &Path, directories: &[PathBuf]) -> Result<()> {
    let runs = directories.iter().map(|path| read(path));
    let runs = runs.collect::<Result<Vec<_>, _>>()?;
    let refused =
        |code, found: String, needed: &str| Err(Problem::at_path(code, file, found, needed));
    let text = match (
        file.extension().and_then(|end| end.to_str()),
        runs.as_slice(),
    ) {
        (Some("html" | "htm"), _) => page::html(&runs),
        (Some("svg"), [run]) if picture::shows(run) => picture::orbit_svg(run),
        (Some("svg"), [run]) => {
            let found = format!("a picture of {}, which is no drop", run.name);
            let needed = "a picture (*.svg) shows the orbit of a drop; name a *.html file";
            return refused(Code::Conflict, found, needed);
        }
        (Some("svg"), _) => {
            let found = format!("a picture of {} runs", runs.len());
            let needed = "a picture (*.svg) shows one run; name one directory, or a *.html file";
            return refused(Code::Conflict, found, needed);
        }
        _ => {
            let found = "a name of no kind that the report has".to_string();
            let needed = "*.html is needed, or *.svg for the picture of one run; a browser prints the page to PDF, and history.parquet of the run holds the columns";
            return refused(Code::UnknownWord, found, needed);
        }
    };
    new_file(file, |mut out| out.write_all(text.as_bytes()))
}

/// True for anything of this name, a dangling link too.
pub(super) fn exists(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}

pub(super) fn partial_of(path: &Path) -> Option<PathBuf> {
    with_end(path, "partial")
}

/// The path with a word behind its name.
fn with_end(path: &Path, word: &str) -> Option<PathBuf> {
    let mut name = OsString::from(path.file_name()?);
    name.push(".");
    name.push(word);
    Some(path.with_file_name(name))
}

/// A directory, locked for this process. An error where another one holds it, or no directory can be locked here.
pub(super) fn locked(partial: &Path) -> Result<File, TryLockError> {
    let held = File::open(partial).map_err(TryLockError::Error)?;
    held.try_lock()?;
    match is_at(&held, partial) {
        true => Ok(held),
        // it got its own name meanwhile
        false => Err(TryLockError::WouldBlock),
    }
}

/// Whether an open directory still has this path.
#[cfg(unix)]
fn is_at(held: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |data: fs::Metadata| (data.is_dir(), data.dev(), data.ino());
    let there = fs::symlink_metadata(path).map(identity);
    let held = held.metadata().map(identity);
    there.is_ok_and(|there| there.0 && held.is_ok_and(|held| held == there))
}

/// Elsewhere a directory that is open cannot be renamed.
#[cfg(not(unix))]
fn is_at(held: &File, _: &Path) -> bool {
    held.metadata().is_ok_and(|data| data.is_dir())
}

/// Removes what a killed process left in its partial directory; an error where that is not what such a one holds: no files
/// yet, or a scenario or the first table of an export, and other files.
fn empty_leftover(partial: &Path) -> std::io::Result<()> {
    let entries = fs::read_dir(partial)?.collect::<Result<Vec<_>, _>>()?;
    let foreign = |entry: &fs::DirEntry| !entry.file_type().is_ok_and(|kind| kind.is_file());
    let known = |entry: &fs::DirEntry| {
        [SCENARIO, FIRST_TABLE]
            .map(OsString::from)
            .contains(&entry.file_name())
    };
    let is_ours = entries.is_empty() || entries.iter().any(known);
    if !is_ours || entries.iter().any(foreign) {
        return Err(ErrorKind::DirectoryNotEmpty.into());
    }
    for entry in entries {
        fs::remove_file(entry.path())?;
    }
    Ok(())
}

/// The last part of the path; that of the full path for one like `.`.
fn name_of(path: &Path) -> String {
    let full = fs::canonicalize(path).unwrap_or_default();
    path.file_name()
        .or(full.file_name())
        .map_or("run".into(), |name| name.to_string_lossy().into_owned())
}

pub(super) fn taken(path: &Path) -> Box<Problem> {
    let needed = "results are never written over others: choose another --out, or remove it";
    Problem::at_path(Code::OutputExists, path, "something of this name", needed)
}

/// Why nothing can be made at a path that was given: the place is wrong, or the disk is full.
pub fn misplaced(path: &Path, error: &std::io::Error) -> Box<Problem> {
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => failed(path, error),
        _ => {
            let found = format!("that nothing can be made there ({error})");
            Problem::at_path(Code::OutputPlace, path, found, WRITABLE)
        }
    }
}

/// What the system refused to write.
pub fn failed(path: &Path, error: &std::io::Error) -> Box<Problem> {
    let found = format!("that it cannot be written ({error})");
    Problem::at_path(Code::OutputFailed, path, found, WRITABLE)
}

/// The error of the system inside one of Parquet, where there is one; else its words.
pub(super) fn io_error(error: parquet::errors::ParquetError) -> std::io::Error {
    use parquet::errors::ParquetError;
    match error {
        ParquetError::External(inner) => match inner.downcast::<std::io::Error>() {
            Ok(error) => *error,
            Err(other) => std::io::Error::other(other),
        },
        other => std::io::Error::other(other),
    }
}
