//! `members/NNNN.parquet`: a part of the members of a study or of a run that is repeated, drawn inputs beside results.

use crate::directory::{aside, failed, io_error};
use crate::history::{self, View};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::reader::{FileReader, SerializedFileReader};
use problem::open_file;
use problem::{Code, Problem, Result};
use run::study::kept::{Members, Store};
use run::study::parts;
use run::study::table::{Column, Table};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The folder of the parts.
pub(super) const MEMBERS: &str = "members";
/// The key of the file under which the reasons of failed members stand, as JSON.
const FAILED: &str = "auxbear.failed";
/// The key under which stands what a repetition keeps beside the table, as JSON.
const REPETITION: &str = "auxbear.repetition";
const MEMBER: &str = "member";

/// The file of a part in a directory.
pub(super) fn path(directory: &Path, part: usize) -> PathBuf {
    directory.join(MEMBERS).join(format!("{part:04}.parquet"))
}

/// Writes a part.
pub(super) fn write(file: impl Write + Send, table: &Table) -> Result<(), ParquetError> {
    write_with(file, table, Vec::new())
}

fn write_with(
    file: impl Write + Send,
    table: &Table,
    mut more: Vec<KeyValue>,
) -> Result<(), ParquetError> {
    let members: Vec<f64> = table.members.iter().map(|k| *k as f64).collect();
    let mut views = vec![View {
        name: MEMBER,
        unit: "1",
        meaning: "number of the member",
        values: &members,
    }];
    views.extend(table.columns.iter().map(View::from));
    let reasons = serde_json::to_string(&table.failed)
        .map_err(|error| ParquetError::External(Box::new(error)))?;
    more.push(KeyValue::new(FAILED.to_string(), reasons));
    history::write_table(file, "members", &views, more)
}

/// Number of members of a part.
pub(super) fn count(path: &Path) -> Result<usize> {
    let about = opened(path)?;
    Ok(about.metadata().file_metadata().num_rows().max(0) as usize)
}

fn opened(path: &Path) -> Result<SerializedFileReader<File>> {
    let file = open_file(path).map_err(|error| damaged(path, error.to_string()))?;
    SerializedFileReader::new(file).map_err(|error| damaged(path, error.to_string()))
}

/// Writes all members into a directory, part by part; nothing where there are none.
pub(super) fn write_all(directory: &Path, table: &Table) -> Result<()> {
    let Some(last) = table.members.last() else {
        return Ok(());
    };
    let folder = directory.join(MEMBERS);
    fs::create_dir_all(folder).map_err(|error| failed(directory, &error))?;
    for part in 0..=parts::part_of(*last) {
        let row = |part| {
            table
                .members
                .partition_point(|own| parts::part_of(*own) < part)
        };
        let rows = row(part)..row(part + 1);
        if !rows.is_empty() {
            let table = table.part(rows);
            aside(&path(directory, part), |file| {
                write(file, &table).map_err(io_error)
            })?;
        }
    }
    Ok(())
}

/// What stands under a key of a part.
fn said(path: &Path, key: &str) -> Result<Option<String>> {
    let about = opened(path)?;
    let keys = about.metadata().file_metadata().key_value_metadata();
    let found = keys.and_then(|keys| keys.iter().find(|own| own.key == key));
    Ok(found.and_then(|own| own.value.clone()))
}

/// Reads a part back, which has members of a range alone, rising, and these inputs.
pub(super) fn read(path: &Path, inputs: &[Column], own: &Range<usize>) -> Result<Table> {
    let reasons = said(path, FAILED)?;
    let failed: BTreeMap<usize, String> = serde_json::from_str(reasons.as_deref().unwrap_or("{}"))
        .map_err(|error| damaged(path, error.to_string()))?;
    let file = open_file(path).map_err(|error| damaged(path, error.to_string()))?;
    let columns = history::read(file, path).map_err(|error| damaged(path, error.to_string()))?;
    let mut columns = columns.into_iter();
    let members = columns.next().filter(|column| column.name == MEMBER);
    let members = members.ok_or_else(|| damaged(path, "no column of members"))?;
    let table = Table {
        members: members.values.iter().map(|k| *k as usize).collect(),
        columns: columns.collect(),
        inputs: inputs.len(),
        failed,
    };
    let given = table.columns.iter().take(table.inputs);
    if !given
        .map(|column| &column.name)
        .eq(inputs.iter().map(|column| &column.name))
    {
        return Err(damaged(path, "other inputs than those of this study"));
    }
    let rise = table.members.windows(2).all(|pair| pair[0] < pair[1]);
    if !rise || !table.members.iter().all(|member| own.contains(member)) {
        return Err(damaged(path, "other members than those of this part"));
    }
    Ok(table)
}

/// A part that is not what this study wrote.
pub(super) fn damaged(path: &Path, found: impl Into<String>) -> Box<Problem> {
    let allowed =
        "a part as auxbear writes it is needed; without the file its members are computed again";
    Problem::at_path(Code::StudyDamaged, path, found, allowed)
}

/// Members of a repetition in the files of a directory.
#[derive(Debug)]
pub(super) struct Kept {
    directory: PathBuf,
    count: usize,
    /// Hash of what their scenario is.
    run: String,
    /// The first that could not be written.
    problem: Mutex<Option<Box<Problem>>>,
}

/// What a repetition keeps beside the table of a part.
#[derive(Serialize, Deserialize)]
struct Stored<M> {
    version: String,
    run: String,
    members: M,
}

impl Kept {
    /// Those of a directory, of so many in all, and how many are there.
    ///
    /// # Errors
    /// A part that cannot be read.
    pub(super) fn of(directory: &Path, count: usize, run: String) -> Result<(Kept, usize)> {
        let own = Kept {
            directory: directory.to_path_buf(),
            count,
            run,
            problem: Mutex::new(None),
        };
        let parts = (0..parts::count(count)).map(|part| own.part(part));
        let counts = parts.map(|part| Ok(part?.map_or(0, |own| own.table.len())));
        let there = counts.sum::<Result<usize>>()?;
        Ok((own, there))
    }

    /// What could not be written.
    pub(super) fn problem(&self) -> Option<Box<Problem>> {
        self.problem
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }

    /// A part as this version wrote it for a repetition; none where there is no such.
    fn part(&self, part: usize) -> Result<Option<Members>> {
        let place = path(&self.directory, part);
        if !place.exists() {
            return Ok(None);
        }
        let table = read(&place, &[], &parts::members(part, self.count))?;
        let Some(text) = said(&place, REPETITION)? else {
            return Ok(None);
        };
        let stored: Stored<Members> =
            serde_json::from_str(&text).map_err(|error| damaged(&place, error.to_string()))?;
        if stored.run != self.run {
            return Err(damaged(&place, "members of another run"));
        }
        let mut members = stored.members;
        members.table = table;
        Ok((stored.version == env!("CARGO_PKG_VERSION")).then_some(members))
    }

    fn written(&self, part: usize, fresh: &Members) -> Result<()> {
        let mut whole = self.part(part)?.unwrap_or_default();
        whole.append(fresh.clone());
        let place = path(&self.directory, part);
        let unwritten = |error: &std::io::Error| failed(&place, error);
        let stored = Stored {
            version: env!("CARGO_PKG_VERSION").to_string(),
            run: self.run.clone(),
            members: &whole,
        };
        let stored = serde_json::to_string(&stored).map_err(|error| unwritten(&error.into()))?;
        let beside = vec![KeyValue::new(REPETITION.to_string(), stored)];
        fs::create_dir_all(self.directory.join(MEMBERS)).map_err(|error| unwritten(&error))?;
        aside(&place, |file| {
            write_with(file, &whole.table.sorted(), beside).map_err(io_error)
        })
    }
}

impl Store for Kept {
    fn there(&self, part: usize) -> Members {
        // what cannot be read was refused before the run
        self.part(part).ok().flatten().unwrap_or_default()
    }

    fn keep(&self, part: usize, fresh: &Members) {
        if let Err(problem) = self.written(part, fresh) {
            let mut known = self.problem.lock().unwrap_or_else(PoisonError::into_inner);
            known.get_or_insert(problem);
        }
    }
}
