//! Writes a table: a row of names, a row of units, rows of values.

use std::io::{self, Write};
use std::path::Path;

use crate::file::columns::{self, Times};
use crate::file::draft::Draft;
use crate::file::writer::Writer;
use crate::{Channel, FileError};

/// Writes channels of one clock as text in columns: commas between cells, a point before decimals, and as many digits
/// as give back the same number.
///
/// A uniform clock becomes a column `time` in s, unless a channel holds times. A value that is not a number is an empty
/// cell. Descriptions, properties and the start are not written.
#[derive(Debug)]
pub struct CsvWriter {
    draft: Draft,
    channels: Vec<Channel>,
    times: Option<Times>,
    rows: u64,
}

impl CsvWriter {
    /// Starts a table of the channels; an error where they have different clocks, or one holds texts.
    pub fn create(path: &Path, channels: &[Channel]) -> Result<CsvWriter, FileError> {
        let times = columns::times(path, channels)?;
        let mut writer = CsvWriter {
            draft: Draft::create(path)?,
            channels: channels.to_vec(),
            times,
            rows: 0,
        };
        let head = writer.head();
        let written = writer.draft.write_all(head.as_bytes());
        written.map_err(|error| writer.draft.error(&error))?;
        Ok(writer)
    }

    fn head(&self) -> String {
        let time = self.times.map(|_| ("time", "s"));
        let named = self
            .channels
            .iter()
            .map(|c| (c.name.as_str(), c.unit.as_str()));
        let all: Vec<(&str, &str)> = time.into_iter().chain(named).collect();
        let names: Vec<String> = all.iter().map(|(name, _)| quoted(name)).collect();
        let mut text = names.join(",") + "\n";
        if all.iter().any(|(_, unit)| !unit.is_empty()) {
            let units: Vec<String> = all
                .iter()
                .map(|(_, unit)| match *unit {
                    "" => String::new(),
                    unit => quoted(&format!("[{unit}]")),
                })
                .collect();
            text += &(units.join(",") + "\n");
        }
        text
    }

    fn row(&mut self, cells: impl Iterator<Item = f64>) -> io::Result<()> {
        for (column, value) in cells.enumerate() {
            if column > 0 {
                self.draft.write_all(b",")?;
            }
            if !value.is_nan() {
                write!(self.draft, "{value:?}")?;
            }
        }
        self.draft.write_all(b"\n")
    }
}

/// A name as a cell: on one line, in quotes where it holds what stands between cells.
fn quoted(name: &str) -> String {
    let name = name.replace(['\r', '\n'], " ").replace('"', "'");
    let plain = !name.contains([',', ';', '\t']) && !name.starts_with(['#', '%', '/']);
    if plain { name } else { format!("\"{name}\"") }
}

impl Writer for CsvWriter {
    fn append(&mut self, values: &[&[f64]]) -> Result<(), FileError> {
        let rows = columns::rows(self.draft.path(), &self.channels, values)?;
        for row in 0..rows {
            let time = self.times.map(|times| times.at(self.rows));
            let cells = time
                .into_iter()
                .chain(values.iter().map(|slice| slice[row]));
            let written = self.row(cells);
            written.map_err(|error| self.draft.error(&error))?;
            self.rows += 1;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), FileError> {
        self.draft.finish()
    }
}
