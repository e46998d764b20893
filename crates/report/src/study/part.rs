//! `members/NNNN.parquet`: a part of the members, drawn inputs beside results; and all of them as one table of text.

use crate::history::{self, View};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::reader::{FileReader, SerializedFileReader};
use problem::open_file;
use problem::{Code, Problem, Result};
use run::study::Study;
use run::study::table::Table;
use scenario::Distribution;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Write;
use std::ops::Range;
use std::path::Path;

/// The key of the file under which the reasons of failed members stand, as JSON.
const FAILED: &str = "auxbear.failed";
const MEMBER: &str = "member";

/// Writes a part.
pub(super) fn write(file: impl Write + Send, table: &Table) -> Result<(), ParquetError> {
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
    let more = vec![KeyValue::new(FAILED.to_string(), reasons)];
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

/// Reads a part back, which has members of a range alone, rising.
pub(super) fn read(path: &Path, study: &Study, own: &Range<usize>) -> Result<Table> {
    let about = opened(path)?;
    let keys = about.metadata().file_metadata().key_value_metadata();
    let reasons = keys.and_then(|keys| keys.iter().find(|key| key.key == FAILED));
    let reasons = reasons.and_then(|key| key.value.as_deref()).unwrap_or("{}");
    let failed: BTreeMap<usize, String> =
        serde_json::from_str(reasons).map_err(|error| damaged(path, error.to_string()))?;
    let file = open_file(path).map_err(|error| damaged(path, error.to_string()))?;
    let columns = history::read(file, path).map_err(|error| damaged(path, error.to_string()))?;
    let mut columns = columns.into_iter();
    let members = columns.next().filter(|column| column.name == MEMBER);
    let members = members.ok_or_else(|| damaged(path, "no column of members"))?;
    let table = Table {
        members: members.values.iter().map(|k| *k as usize).collect(),
        columns: columns.collect(),
        inputs: study.file.inputs.len(),
        failed,
    };
    let wanted = study.input_columns();
    let given = table.columns.iter().take(table.inputs);
    if !given
        .map(|column| &column.name)
        .eq(wanted.iter().map(|column| &column.name))
    {
        return Err(damaged(path, "other inputs than those of this study"));
    }
    let rise = table.members.windows(2).all(|pair| pair[0] < pair[1]);
    if !rise || !table.members.iter().all(|member| own.contains(member)) {
        return Err(damaged(path, "other members than those of this part"));
    }
    Ok(table)
}

/// All members as text: names with units in the first line, an empty cell where there is nothing.
pub(super) fn csv(study: &Study, table: &Table) -> String {
    let cell = |text: &str| match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_string(),
    };
    let mut out = String::from("member");
    for column in &table.columns {
        let unit = match column.unit.as_str() {
            "" | "1" => String::new(),
            unit => format!(" [{unit}]"),
        };
        out.push(',');
        out.push_str(&cell(&format!("{}{unit}", column.name)));
    }
    out.push_str(",failed\n");
    for (row, member) in table.members.iter().enumerate() {
        out.push_str(&member.to_string());
        for (at, column) in table.columns.iter().enumerate() {
            out.push(',');
            let value = column.values[row];
            let input = study
                .file
                .inputs
                .get(at)
                .map(|input| &input.vary.distribution);
            match input {
                _ if !value.is_finite() => {}
                Some(Distribution::Choice(texts)) => {
                    out.push_str(&cell(texts.get(value as usize).map_or("", String::as_str)));
                }
                _ => out.push_str(&value.to_string()),
            }
        }
        out.push(',');
        out.push_str(&cell(table.failed.get(member).map_or("", String::as_str)));
        out.push('\n');
    }
    out
}

/// A part that is not what this study wrote.
pub(super) fn damaged(path: &Path, found: impl Into<String>) -> Box<Problem> {
    let allowed = "a part as auxbear study writes it is needed; without the file its members are computed again";
    Problem::at_path(Code::StudyDamaged, path, found, allowed)
}
