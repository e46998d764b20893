//! A run directory as tables for other programs: CSV files, or one XLSX workbook.
//!
//! | table | content |
//! |---|---|
//! | `run` | title, system, version, how the run ended |
//! | `results` | every named result with unit, spread, law, source, valid range, or why it has no value |
//! | `lists` | results that are lists of numbers, a column each |
//! | `limits`, `warnings`, `contacts`, `inputs` | as in `summary.json` |
//! | `members` | results and draws of each member of a repeated run |
//! | `history` | the time histories, a column each |
//!
//! All values are SI, the unit stands in the head of its column: `bearing.contact.force [N]`. Numbers have the digits that
//! give them back bit for bit; what is not a finite number is an empty cell. A table without rows is left out.

use super::directory::{NewDirectory, read};
use super::page::PageRun;
use super::table::{Cell, Table};
#[cfg(feature = "xlsx")]
use super::workbook;
use indexmap::{IndexMap, IndexSet};
use outcome::limits::{meant, stands_for};
use problem::{Code, Problem, Result};
use run::warnings::rank;
use serde::Deserialize;
use serde_json::Value;
use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// What other programs read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A folder of CSV files: commas, decimal points, UTF-8.
    Csv,
    /// A workbook with a sheet for each table.
    #[cfg(feature = "xlsx")]
    Xlsx,
}

/// Writes the tables of a run directory; returns the file or folder. Without a place it is `csv/` or `run.xlsx` in the run
/// directory. What exists there is never written over. `only` names the results and columns that are wanted, also by patterns with `*`
/// for a name between dots; all without any.
pub fn export(
    directory: &Path,
    format: Format,
    out: Option<&Path>,
    only: &[String],
) -> Result<PathBuf> {
    let mut run = read(directory)?;
    let mut summary: Summary = serde_json::from_str(&run.summary_json).map_err(|error| {
        let found = format!("what cannot be read as a summary ({error})");
        let needed = "a run directory, as auxbear run writes it, is needed";
        let path = directory.join("summary.json");
        Problem::at_path(Code::FileUnreadable, &path, found, needed)
    })?;
    // the first format had none
    for warning in &mut summary.warnings {
        let severity = rank(warning["code"].as_str().unwrap_or_default()).0;
        if let Some(own) = warning.as_object_mut() {
            own.entry("severity").or_insert(severity.word().into());
        }
    }
    if !only.is_empty() {
        keep(directory, &mut run, &mut summary, only)?;
    }
    let tables = tables(&run, &summary);
    let own = match format {
        Format::Csv => "csv",
        #[cfg(feature = "xlsx")]
        Format::Xlsx => "run.xlsx",
    };
    let place = out.map_or_else(|| directory.join(own), Path::to_path_buf);
    match format {
        Format::Csv => csv(&place, &tables)?,
        #[cfg(feature = "xlsx")]
        Format::Xlsx => workbook::create(&place, &tables)?,
    }
    Ok(place)
}

/// Leaves results and columns that one of these names stands for; with columns the first one, over which they are.
fn keep(directory: &Path, run: &mut PageRun, summary: &mut Summary, only: &[String]) -> Result<()> {
    let results = summary.quantities.keys().map(String::as_str);
    let columns = run.columns.iter().map(|column| column.name.as_str());
    let known: Vec<&str> = results.chain(columns).collect();
    let is_known = |only: &str| known.iter().any(|name| stands_for(only, name));
    if let Some(unknown) = only.iter().find(|only| !is_known(only)) {
        let found = format!("\"{unknown}\", which is no result and no column of this run");
        let needed = "a name that auxbear results FILE lists is needed, or a pattern with * for a name between dots";
        let problem = Problem::at_path(Code::UnknownQuantity, directory, found, needed);
        return Err(problem.with_hint(meant(unknown, &known)));
    }
    let wanted = |name: &str| only.iter().any(|only| stands_for(only, name));
    summary.quantities.retain(|name, _| wanted(name));
    for member in &mut summary.members {
        member.retain(|name, _| wanted(name));
    }
    let mut first = true;
    (run.columns).retain(|column| std::mem::take(&mut first) || wanted(&column.name));
    if run.columns.len() == 1 && !wanted(&run.columns[0].name) {
        run.columns.clear();
    }
    Ok(())
}

/// What is read of a summary; older ones have less.
#[derive(Deserialize)]
struct Summary {
    #[serde(default)]
    title: String,
    #[serde(default)]
    system: String,
    #[serde(default)]
    version: String,
    #[serde(default)]
    complete: bool,
    #[serde(default)]
    stop: Value,
    #[serde(default)]
    quantities: IndexMap<String, Value>,
    #[serde(default)]
    limits: Vec<Value>,
    #[serde(default)]
    warnings: Vec<Value>,
    #[serde(default)]
    contacts: Vec<Value>,
    #[serde(default)]
    inputs: Vec<Value>,
    #[serde(default)]
    members: Vec<IndexMap<String, Option<f64>>>,
    #[serde(default)]
    drawn: Vec<IndexMap<String, String>>,
}

/// Name and unit of a column.
fn head(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_string(),
        unit => format!("{name} [{unit}]"),
    }
}

fn tables<'a>(run: &'a PageRun, summary: &'a Summary) -> Vec<Table<'a>> {
    let history = run.columns.iter();
    let heads = history
        .clone()
        .map(|column| head(&column.name, &column.unit));
    let columns = history.map(|column| Cow::Borrowed(column.values.as_slice()));
    let all = vec![
        facts(run, summary),
        results(summary),
        lists(summary),
        Table::of_objects("limits", LIMITS, &summary.limits),
        Table::of_objects("warnings", WARNINGS, &summary.warnings),
        Table::of_objects("contacts", CONTACTS, &summary.contacts),
        members(summary),
        Table::of_objects("inputs", INPUTS, &summary.inputs),
        Table::of_columns("history", heads.collect(), columns.collect()),
    ];
    all.into_iter().filter(|table| table.rows > 0).collect()
}

const LIMITS: &[(&str, &str)] = &[
    ("quantity", "quantity"),
    ("side", "at"),
    ("bound", "bound, SI"),
    ("value", "value, SI"),
    ("unit", "unit"),
    ("share", "share"),
    ("members", "members"),
    ("hold", "members that hold it"),
    ("verdict", "verdict"),
    ("why", "why"),
];
const WARNINGS: &[(&str, &str)] = &[
    ("code", "code"),
    ("text", "text"),
    ("severity", "severity"),
    ("part", "part"),
    ("time_s", "time [s]"),
];
const CONTACTS: &[(&str, &str)] = &[
    ("auxiliary_bearing", "auxiliary bearing"),
    ("start_s", "start [s]"),
    ("end_s", "end [s]"),
    ("peak_force_N", "peak force [N]"),
    ("peak_time_s", "peak time [s]"),
];
const INPUTS: &[(&str, &str)] = &[
    ("path", "path"),
    ("value", "value"),
    ("mark", "origin"),
    ("note", "note"),
];

fn facts<'a>(run: &'a PageRun, summary: &'a Summary) -> Table<'a> {
    let stop = |key| Cell::of(summary.stop.get(key));
    let complete = if summary.complete { "yes" } else { "no" };
    let facts = [
        ("title", Cell::text(&summary.title)),
        ("system", Cell::text(&summary.system)),
        ("directory", Cell::text(&run.directory)),
        ("version of auxbear", Cell::text(&summary.version)),
        ("complete", Cell::text(complete)),
        ("how it ended", stop("text")),
        ("end [s]", stop("time_s")),
    ];
    let rows = facts.map(|(name, value)| vec![Cell::Text(name.into()), value]);
    let heads = ["fact", "value"].map(String::from);
    Table::of_rows("run", heads.to_vec(), rows.to_vec())
}

fn results(summary: &Summary) -> Table<'_> {
    const SPREAD: [(&str, &str); 8] = [
        ("members", "members"),
        ("mean", "mean"),
        ("sd", "standard deviation"),
        ("min", "smallest"),
        ("q05", "5 %"),
        ("median", "median"),
        ("q95", "95 %"),
        ("max", "largest"),
    ];
    let repeated = (summary.quantities.values()).any(|of| of.get("spread").is_some());
    let spread = if repeated { &SPREAD[..] } else { &[] };
    let ends = ["why it has no value", "law", "source", "valid"];
    let mut heads = vec!["result", "value, SI", "unit"];
    heads.extend(spread.iter().map(|(_, head)| *head));
    heads.extend(ends);
    let mut rows = Vec::new();
    for (name, of) in &summary.quantities {
        let mut row = vec![Cell::text(name)];
        row.push(match of.get("value") {
            Some(Value::Array(list)) => {
                Cell::Text(format!("{} values, in lists", list.len()).into())
            }
            value => Cell::of(value),
        });
        row.push(Cell::of(of.get("unit")));
        let of_spread = |key| Cell::of(of.get("spread").and_then(|spread| spread.get(key)));
        row.extend(spread.iter().map(|(key, _)| of_spread(*key)));
        row.extend(["why", "law", "source", "valid"].map(|key| Cell::of(of.get(key))));
        rows.push(row);
    }
    Table::of_rows(
        "results",
        heads.into_iter().map(String::from).collect(),
        rows,
    )
}

fn unit_of(quantity: &Value) -> &str {
    quantity.get("unit").and_then(Value::as_str).unwrap_or("")
}

fn lists(summary: &Summary) -> Table<'_> {
    let (mut heads, mut columns) = (Vec::new(), Vec::new());
    for (name, of) in &summary.quantities {
        if let Some(Value::Array(list)) = of.get("value") {
            heads.push(head(name, unit_of(of)));
            let values = list.iter().map(|value| value.as_f64().unwrap_or(f64::NAN));
            columns.push(Cow::Owned(values.collect()));
        }
    }
    Table::of_columns("lists", heads, columns)
}

fn members(summary: &Summary) -> Table<'_> {
    let results: IndexSet<&String> = summary.members.iter().flat_map(IndexMap::keys).collect();
    let draws: IndexSet<&String> = summary.drawn.iter().flat_map(IndexMap::keys).collect();
    let unit = |name: &str| summary.quantities.get(name).map_or("", unit_of);
    let mut heads = vec!["member".to_string()];
    heads.extend(results.iter().map(|name| head(name, unit(name))));
    heads.extend(draws.iter().map(|path| format!("drawn {path}")));
    let rows = summary.members.iter().enumerate().map(|(k, member)| {
        let mut row = vec![Cell::Number(k as f64)];
        row.extend(results.iter().map(|name| {
            let value = member.get(*name).copied().flatten();
            value.map_or(Cell::Empty, Cell::number)
        }));
        row.extend(draws.iter().map(|path| {
            let drawn = summary.drawn.get(k);
            let text = drawn.and_then(|drawn| drawn.get(*path));
            text.map_or(Cell::Empty, |text| Cell::text(text))
        }));
        row
    });
    let rows = rows.collect();
    Table::of_rows("members", heads, rows)
}

/// Writes a folder of CSV files, whole or not at all.
fn csv(folder: &Path, tables: &[Table]) -> Result<()> {
    let place = NewDirectory::reserve(folder)?;
    for table in tables {
        place.file(&format!("{}.csv", table.name), |file| {
            csv_table(file, table)
        })?;
    }
    place.named()
}

fn csv_table(file: &mut File, table: &Table) -> io::Result<()> {
    let mut out = BufWriter::new(file);
    let heads: Vec<String> = table.heads.iter().map(|head| quoted(head)).collect();
    writeln!(out, "{}", heads.join(","))?;
    for row in 0..table.rows {
        for column in 0..table.heads.len() {
            if column > 0 {
                out.write_all(b",")?;
            }
            match (table.cell)(row, column) {
                Cell::Empty => {}
                Cell::Number(value) => out.write_all(units::number_text(value).as_bytes())?,
                Cell::Text(text) => out.write_all(quoted(&text).as_bytes())?,
            }
        }
        out.write_all(b"\n")?;
    }
    out.flush()
}

/// A text as a cell by RFC 4180.
fn quoted(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r', ';', '\t']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_string(),
    }
}
