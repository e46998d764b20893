//! A study directory: `study.toml`, `scenario.toml`, `members/NNNN.parquet`, then `members.csv`, `summary.json`, `report.html`.
//!
//! Each part of the members is a file that gets its name when it is written, and a part of an interrupted call has those members that had
//! ended: whatever ends the program, the next call computes the members that are missing. The directory is locked while a process works on it.

mod bars;
mod cells;
mod document;
mod estimate;
mod page;
mod parallel;
mod part;
mod qualify;
mod ranking;
mod summary;

pub use estimate::{note as estimate_note, rows as estimate_rows};
pub use qualify::{Qualified, Wish};
pub use ranking::verdict as chosen;

use super::directory::{REPORT, SCENARIO, SUMMARY, aside, exists, locked, misplaced};
use outcome::host::{self, bounded};
use problem::{Code, Problem, Result};
use run::Options;
use run::study::answer::Answer;
use run::study::table::{Table, Warned, warned};
use run::study::{PART, Study};
use scenario::StudyFile;
use std::fs::{self, File, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

const STUDY: &str = "study.toml";
const MEMBERS: &str = "members";
const TABLE: &str = "members.csv";
/// Members that a thread has at a time, at most and at first: so that its lanes stay full, and what is not written is soon done again.
const A_THREAD: usize = 64;
const AT_FIRST: usize = 16;
/// What takes less time than this is written with more, s.
const SOON: f64 = 10.0;
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
        let (file, changed) = if known.is_file() {
            let (before, reworded) = resumed(path, file)?;
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
        }
        let places = (0..part_count(&study)).map(|part| part_path(path, part));
        let counts = (places.filter(|part| part.exists())).map(|part| part::count(&part));
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
        let threads = options.threads.map_or_else(host::threads, bounded);
        // a kill takes what is not written: members of seconds are written by few, those of milliseconds by many
        let (mut size, most) = (threads * AT_FIRST, (threads * A_THREAD).max(PART));
        let (mut done, mut since) = (self.there, 0.0);
        let mut rest = &lacking[..];
        while !rest.is_empty() {
            let some;
            (some, rest) = rest.split_at(size.min(rest.len()));
            let plan = Options {
                progress: &|fraction| progress(done as f64 + fraction * some.len() as f64),
                ..*options
            };
            // of an interrupted run those that had ended
            let (fresh, seconds) = host::timed(|| self.study.run(some, &plan));
            if seconds < SOON {
                size = most.min(2 * size);
            }
            for part in some[0] / PART..=some[some.len() - 1] / PART {
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
                aside(&part_path(&self.path, part), |file| {
                    part::write(file, &table).map_err(super::directory::io_error)
                })?;
            }
            done += fresh.members.len();
            if options.interrupt.load(Ordering::Relaxed) {
                break;
            }
            progress(done as f64);
            since += seconds;
            if since > INTERIM {
                since = 0.0;
                interim()?;
            }
        }
        Ok(())
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
        let place = part_path(&self.path, part);
        match place.exists() {
            true => part::read(&place, &self.study, &members_of(&self.study, part)),
            false => Ok(Table::default()),
        }
    }

    /// Takes a part as [`part`] computed it elsewhere.
    ///
    /// # Errors
    /// What cannot be written, and what is no such part.
    pub fn put(&self, part: usize, bytes: &[u8]) -> Result<()> {
        let place = part_path(&self.path, part);
        aside(&place, |mut file| file.write_all(bytes))?;
        let wanted = members_of(&self.study, part);
        match part::read(&place, &self.study, &wanted) {
            Ok(table) if table.members.len() == wanted.len() => Ok(()),
            other => {
                let _ = fs::remove_file(&place);
                Err(match other {
                    Err(problem) => problem,
                    Ok(_) => part::damaged(&place, "a part without some of its members"),
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
            && part::read(&place, &self.study, &(0..self.study.members()))?.members == near
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
                part::write(file, &table).map_err(super::directory::io_error)
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
        text_file(&self.path.join(TABLE), &part::csv(&self.study, &table))?;
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
    let written = part::write(&mut bytes, &table).map(|()| bytes);
    Some(written.map_err(|error| part::damaged(Path::new(MEMBERS), error.to_string())))
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
        let read = part::read(&confirmed, study, &(0..study.members()))?;
        study.with_confirmed(&mut table, &read);
    }
    Ok(table)
}

/// The members that are there, with results in the order of a run.
fn screened(path: &Path, study: &Study) -> Result<Table> {
    let mut table = Table::default();
    for part in 0..part_count(study) {
        let place = part_path(path, part);
        if place.exists() {
            table.append(part::read(&place, study, &members_of(study, part))?);
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
    study.members().div_ceil(PART)
}

fn members_of(study: &Study, part: usize) -> std::ops::Range<usize> {
    part * PART..((part + 1) * PART).min(study.members())
}

fn part_path(path: &Path, part: usize) -> PathBuf {
    path.join(MEMBERS).join(format!("{part:04}.parquet"))
}

/// Members at design accuracy.
fn confirmed_path(path: &Path) -> PathBuf {
    path.join(MEMBERS).join("confirmed.parquet")
}

/// Writes a text, whole or not at all.
fn text_file(path: &Path, text: &str) -> Result<()> {
    aside(path, |mut file| file.write_all(text.as_bytes()))
}
