//! A study directory: `study.toml`, `scenario.toml`, `members/NNNN.parquet`, then `members.csv`, `summary.json`, `report.html`.
//!
//! Each part of the members is a file that gets its name when it is written, and a part of an interrupted call has those members that had
//! ended: whatever ends the program, the next call computes the members that are missing. The directory is locked while a process works on it.

mod bars;
mod cells;
mod csv;
mod document;
mod estimate;
mod page;
mod parallel;
mod qualify;
mod ranking;
mod summary;

pub use estimate::{note as estimate_note, rows as estimate_rows};
pub use qualify::{Qualified, Wish};
pub use ranking::verdict as chosen;

use super::directory::{REPORT, SCENARIO, SUMMARY, aside, exists, locked, misplaced};
use super::members::{self, MEMBERS};
use super::place::{FILES, hashes};
use outcome::host;
use problem::{Code, Problem, Result};
use run::Options;
use run::study::answer::Answer;
use run::study::table::{Table, Warned, warned};
use run::study::{Study, parts};
use scenario::StudyFile;
use std::fs::{self, File, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};

const STUDY: &str = "study.toml";
const TABLE: &str = "members.csv";
/// Computing time after which the results so far are written, s.
const INTERIM: f64 = 60.0;
/// What a study says in words: its document changes with them, and nothing that is computed.
const WORDS: [&str; 12] = [
    "",
    "title",
    "source",
    "[document]",
    "machine",
    "author",
    "revision",
    "environment",
    "expected",
    "[[requirement]]",
    "text",
    "why",
];

/// A study with its directory, which no other process may use meanwhile.
pub struct Directory {
    path: PathBuf,
    /// The study, with the blocks that were added.
    pub study: Study,
    /// Members that were there before.
    pub there: usize,
    _lock: Option<File>,
}

/// What a call left behind.
pub struct Done {
    /// What the members say.
    pub answer: Answer,
    /// Members that did not end as planned.
    pub failed: usize,
    /// What they warn of, the most severe first.
    pub warned: Vec<Warned>,
    /// Whether all members are there.
    pub complete: bool,
}

impl Directory {
    /// Begins a study, or goes on with one; `add` blocks are added to its design.
    ///
    /// # Errors
    /// Where something else stands there, another process works on it, or its study, scenario or version is another.
    pub fn open(path: &Path, study: Study, add: usize) -> Result<Directory> {
        let new = !exists(path);
        Directory::begun(path, study, add, new).inspect_err(|_| {
            // nothing stands in it yet, or it stays
            if new {
                let _ = fs::remove_dir(path);
            }
        })
    }

    fn begun(path: &Path, study: Study, add: usize, new: bool) -> Result<Directory> {
        fs::create_dir_all(path).map_err(|error| misplaced(path, &error))?;
        // a link to a directory is that directory
        let own = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let lock = match locked(&own) {
            Ok(lock) => Some(lock),
            Err(TryLockError::WouldBlock) => {
                let found = "a study that another process works on";
                let needed = "one process a study is possible";
                return Err(Problem::at_path(Code::StudyInUse, path, found, needed));
            }
            Err(TryLockError::Error(_)) => None,
        };
        let known = path.join(STUDY);
        let is_empty = || fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_none());
        let Study {
            file,
            known: quantities,
        } = study;
        let files = path.join(MEMBERS).join(FILES);
        let hashes = hashes(&file.scenario.resolved.toml());
        let (file, changed) = if known.is_file() {
            let (before, reworded) = resumed(path, file)?;
            // that of an earlier version has none
            let there = fs::read_to_string(&files).unwrap_or_else(|_| hashes.clone());
            if there != hashes {
                let other = hashes.lines().find(|line| !there.contains(line));
                let other = other.map_or(files.display().to_string(), |line| {
                    line.split_whitespace().skip(1).collect()
                });
                let found = format!("other members: since the first of them {other} has changed");
                let allowed = "a study goes on with the same contents of its files; another one needs another --out";
                return Err(Problem::at_path(Code::StudyChanged, &known, found, allowed));
            }
            match add {
                0 => (before, reworded),
                more => (before.extended(more)?, true),
            }
        } else if new || is_empty() || only_begun(path) {
            (if add > 0 { file.extended(add)? } else { file }, true)
        } else {
            return Err(super::directory::taken(path));
        };
        let study = Study {
            file,
            known: quantities,
        };
        if changed {
            let members = path.join(MEMBERS);
            fs::create_dir_all(&members).map_err(|error| misplaced(&members, &error))?;
            let scenario = study.file.scenario.resolved.toml();
            text_file(&path.join(SCENARIO), &scenario)?;
            text_file(&known, &headed(&study.file))?;
            if !hashes.is_empty() {
                text_file(&files, &hashes)?;
            }
        }
        let places = (0..part_count(&study)).map(|part| members::path(path, part));
        let counts = (places.filter(|part| part.exists())).map(|part| members::count(&part));
        let there = counts.sum::<Result<usize>>()?;
        Ok(Directory {
            path: path.to_path_buf(),
            study,
            there,
            _lock: lock,
        })
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Computes what is missing, part by part, and writes what all members say, every minute what those say that are there. `progress` is
    /// told the members done.
    ///
    /// # Errors
    /// What cannot be written, and parts that cannot be read.
    pub fn run(&self, options: &Options, progress: &(dyn Fn(f64) + Sync)) -> Result<Done> {
        self.compute(options, progress, &|| self.told(options).map(|_| ()))?;
        self.finish(options)
    }

    /// Computes what is missing, part by part; `interim` writes what is known so far, every minute of computing.
    fn compute(
        &self,
        options: &Options,
        progress: &(dyn Fn(f64) + Sync),
        interim: &dyn Fn() -> Result<()>,
    ) -> Result<()> {
        let mut lacking: Vec<usize> = Vec::new();
        for part in self.open_parts()? {
            let there = self.part_there(part)?.members;
            lacking.extend(members_of(&self.study, part).filter(|own| !there.contains(own)));
        }
        let (mut done, mut since) = (self.there, 0.0);
        let drop = self.study.file.scenario.drop();
        let coasts = drop.is_some_and(|drop| drop.coast_down.is_some());
        parts::in_turns(&lacking, options, coasts, |some| {
            let plan = Options {
                progress: &|fraction| progress(done as f64 + fraction * some.len() as f64),
                ..*options
            };
            // of an interrupted run those that had ended
            let (fresh, seconds) = host::timed(|| self.study.run(some, &plan));
            for part in parts::part_of(some[0])..=parts::part_of(some[some.len() - 1]) {
                let members = members_of(&self.study, part);
                let of_part = |member: &usize| members.contains(member);
                let begin = fresh.members.iter().position(of_part).unwrap_or(0);
                let count = fresh.members.iter().filter(|own| of_part(own)).count();
                if count == 0 {
                    continue;
                }
                let mut kept = self.part_there(part)?;
                kept.append(fresh.part(begin..begin + count));
                let table = self.study.in_order(kept.sorted());
                aside(&members::path(&self.path, part), |file| {
                    members::write(file, &table).map_err(super::directory::io_error)
                })?;
            }
            done += fresh.members.len();
            progress(done as f64);
            since += seconds;
            if since > INTERIM {
                since = 0.0;
                interim()?;
            }
            Ok(())
        })
    }

    /// Parts of which members are not there.
    ///
    /// # Errors
    /// Parts that cannot be read.
    pub fn open_parts(&self) -> Result<Vec<usize>> {
        let mut open: Vec<usize> = Vec::new();
        for part in 0..part_count(&self.study) {
            if self.part_there(part)?.members.len() < members_of(&self.study, part).len() {
                open.push(part);
            }
        }
        Ok(open)
    }

    /// The members of a part that are there.
    fn part_there(&self, part: usize) -> Result<Table> {
        let place = members::path(&self.path, part);
        match place.exists() {
            true => members::read(
                &place,
                &self.study.input_columns(),
                &members_of(&self.study, part),
            ),
            false => Ok(Table::default()),
        }
    }

    /// Takes a part as [`part`] computed it elsewhere.
    ///
    /// # Errors
    /// What cannot be written, and what is no such part.
    pub fn put(&self, part: usize, bytes: &[u8]) -> Result<()> {
        let place = members::path(&self.path, part);
        aside(&place, |mut file| file.write_all(bytes))?;
        let wanted = members_of(&self.study, part);
        match members::read(&place, &self.study.input_columns(), &wanted) {
            Ok(table) if table.members.len() == wanted.len() => Ok(()),
            other => {
                let _ = fs::remove_file(&place);
                Err(match other {
                    Err(problem) => problem,
                    Ok(_) => members::damaged(&place, "a part without some of its members"),
                })
            }
        }
    }

    /// Confirms what the study asks to, and writes what the members say that are there.
    ///
    /// # Errors
    /// What cannot be written, and parts that cannot be read.
    pub fn finish(&self, options: &Options) -> Result<Done> {
        self.confirm(options)?;
        self.told(options)
    }

    /// Runs the members nearest to the limits again, once all members are there.
    fn confirm(&self, options: &Options) -> Result<()> {
        if self.study.file.confirm == 0 {
            return Ok(());
        }
        let table = screened(&self.path, &self.study)?;
        let near = self.study.nearest(&table);
        if near.is_empty() || table.members.len() < self.study.members() {
            return Ok(());
        }
        let place = confirmed_path(&self.path);
        if place.exists()
            && members::read(
                &place,
                &self.study.input_columns(),
                &(0..self.study.members()),
            )?
            .members
                == near
        {
            return Ok(());
        }
        let quiet = Options {
            progress: &|_| {},
            ..*options
        };
        match self.study.confirmed(&near, &quiet) {
            None => Ok(()),
            Some(table) => aside(&place, |file| {
                members::write(file, &table).map_err(super::directory::io_error)
            }),
        }
    }

    /// Reads all parts and writes what they say.
    fn told(&self, options: &Options) -> Result<Done> {
        let table = table_of(&self.path, &self.study)?;
        let mut answer = self.study.answer(&table);
        let complete = table.members.len() == self.study.members();
        if complete && self.study.file.estimates() {
            answer.estimate = self.study.estimate(&table, options);
        }
        let json = summary::json(&self.study, &table, &answer, complete);
        text_file(&self.path.join(TABLE), &csv::csv(&self.study, &table))?;
        text_file(&self.path.join(SUMMARY), &json)?;
        let html = page::html(&self.study, &table, &answer);
        text_file(&self.path.join(REPORT), &html)?;
        Ok(Done {
            failed: table.failed.len(),
            warned: warned(&table),
            answer,
            complete,
        })
    }
}

/// Computes a part, on whatever machine: the bytes of its file. None where this was interrupted.
///
/// # Errors
/// What cannot be written as a file.
pub fn part(study: &Study, part: usize, options: &Options) -> Option<Result<Vec<u8>>> {
    let members: Vec<usize> = members_of(study, part).collect();
    let table = study.run(&members, options);
    if table.members.len() < members.len() {
        return None;
    }
    let table = table.part(0..table.members.len());
    let mut bytes = Vec::new();
    let written = members::write(&mut bytes, &table).map(|()| bytes);
    Some(written.map_err(|error| members::damaged(Path::new(MEMBERS), error.to_string())))
}

/// Reads a study directory back: the study, and the members that are there.
///
/// # Errors
/// Where no study directory stands there, or it is damaged.
pub fn read(path: &Path) -> Result<(Study, Table)> {
    let study = Study::new(StudyFile::read(&path.join(STUDY))?)?;
    let table = table_of(path, &study)?;
    Ok((study, table))
}

/// The members that are there, with what was confirmed of them.
fn table_of(path: &Path, study: &Study) -> Result<Table> {
    let mut table = screened(path, study)?;
    let confirmed = confirmed_path(path);
    if confirmed.exists() {
        let read = members::read(&confirmed, &study.input_columns(), &(0..study.members()))?;
        study.with_confirmed(&mut table, &read);
    }
    Ok(table)
}

/// The members that are there, with results in the order of a run.
fn screened(path: &Path, study: &Study) -> Result<Table> {
    let mut table = Table::default();
    for part in 0..part_count(study) {
        let place = members::path(path, part);
        if place.exists() {
            table.append(members::read(
                &place,
                &study.input_columns(),
                &members_of(study, part),
            )?);
        }
    }
    Ok(study.in_order(table))
}

/// The study as it stood in its directory, with the blocks that were added, and whether its words differ; refused where it is another.
fn resumed(path: &Path, file: StudyFile) -> Result<(StudyFile, bool)> {
    let known = path.join(STUDY);
    let read = |name: &str| {
        let path = path.join(name);
        fs::read_to_string(&path).map_err(|error| {
            let found = format!("what cannot be read ({error})");
            let needed = "a study directory is needed";
            Problem::at_path(Code::StudyDamaged, &path, found, needed)
        })
    };
    let before = read(STUDY)?;
    let number = |line: &str| line.strip_prefix("added = ")?.trim().parse().ok();
    let added: usize = before.lines().find_map(number).unwrap_or(0);
    let file = match added.checked_sub(file.added) {
        Some(more @ 1..) => file.extended(more)?,
        _ => file,
    };
    let differs = |name: &str, before: &str, now: &str| {
        let at = before.lines().zip(now.lines()).position(|(a, b)| a != b);
        let at = at.unwrap_or(before.lines().count().min(now.lines().count()));
        let line = |text: &str| text.lines().nth(at).unwrap_or("nothing").to_string();
        let (before, now) = (line(before), line(now));
        let found = format!("another study: there {name} has `{before}`, now `{now}`");
        let allowed = "a study goes on with the same files and version; another one needs another --out, more members --add";
        Err(Problem::at_path(Code::StudyChanged, &known, found, allowed))
    };
    let now = headed(&file);
    let reworded = before != now;
    let (before, now) = (computing(&before), computing(&now));
    if before != now {
        return differs(STUDY, &before, &now);
    }
    let (before, now) = (read(SCENARIO)?, file.scenario.resolved.toml());
    if before != now {
        return differs(SCENARIO, &before, &now);
    }
    Ok((file, reworded))
}

/// What a study asks to be computed, without the words of its document.
fn computing(text: &str) -> String {
    let is_words = |line: &&str| {
        let key = line.split_once(" = ").map_or(*line, |(key, _)| key);
        WORDS.contains(&key)
    };
    let lines = text.lines().filter(|line| !is_words(line));
    lines.collect::<Vec<_>>().join("\n")
}

/// The resolved study with the version that computes it.
fn headed(file: &StudyFile) -> String {
    format!("# auxbear {}\n{}", env!("CARGO_PKG_VERSION"), file.toml())
}

/// Whether only what a process leaves that was killed at once stands there.
fn only_begun(path: &Path) -> bool {
    let known = |entry: fs::DirEntry| {
        let name = entry.file_name();
        name == MEMBERS
            || name.to_string_lossy().starts_with("scenario.toml")
            || name == "study.toml.partial"
    };
    fs::read_dir(path).is_ok_and(|mut entries| entries.all(|entry| entry.is_ok_and(known)))
}

fn part_count(study: &Study) -> usize {
    parts::count(study.members())
}

fn members_of(study: &Study, part: usize) -> std::ops::Range<usize> {
    parts::members(part, study.members())
}

/// Members at design accuracy.
fn confirmed_path(path: &Path) -> PathBuf {
    path.join(MEMBERS).join("confirmed.parquet")
}

/// Writes a text, whole or not at all.
fn text_file(path: &Path, text: &str) -> Result<()> {
    aside(path, |mut file| file.write_all(text.as_bytes()))
}
