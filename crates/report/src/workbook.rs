//! An XLSX workbook: a sheet for each table, with a frozen head. Rows go to a temporary file one after the other, so that a
//! million of them do not stand in memory; numbers have the digits that give them back bit for bit.

use super::directory::new_file;
use super::table::{Cell, Table};
use problem::{Code, Problem, Result};
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, Worksheet, XlsxError};
use std::io::{self, Seek, Write};
use std::path::Path;

/// Rows of a sheet, with its head.
const ROWS: usize = 1_048_576;
/// Columns of a sheet.
const COLUMNS: usize = 16_384;
/// What a sheet holds, in words.
const LARGEST: &str = "a sheet holds 1 048 576 rows and 16 384 columns";
/// Letters of a cell.
const LETTERS: usize = 32_767;
/// Width of a column of texts, letters.
const TEXT_WIDTH: usize = 32;
/// Least width of a column, letters.
const NUMBER_WIDTH: usize = 12;

/// Why a table is no sheet; none of one that is.
fn too_large(table: &Table) -> Option<String> {
    let (rows, columns) = (table.rows + 1, table.heads.len());
    (rows > ROWS || columns > COLUMNS).then(|| {
        format!(
            "{rows} rows and {columns} columns of the table {}",
            table.name
        )
    })
}

/// Writes a workbook, whole or not at all.
pub(super) fn create(file: &Path, tables: &[Table]) -> Result<()> {
    if let Some(found) = tables.iter().find_map(too_large) {
        let needed = format!("{LARGEST}: use --csv, or history.parquet itself");
        let problem = Problem::at_path(Code::TooManyRows, file, found, needed);
        return Err(problem);
    }
    new_file(file, |out| write(out, tables))
}

fn write(out: impl Write + Seek + Send, tables: &[Table]) -> io::Result<()> {
    let mut workbook = Workbook::new();
    // the same run gives the same file: it does not say when it was exported
    let origin = ExcelDateTime::from_timestamp(0).map_err(io::Error::other)?;
    workbook.set_properties(&DocProperties::new().set_creation_datetime(&origin));
    for table in tables {
        let sheet = workbook.add_worksheet_with_constant_memory();
        sheet
            .and_then(|sheet| fill(sheet, table))
            .map_err(io::Error::other)?;
    }
    workbook.save_to_writer(out).map_err(io::Error::other)
}

fn fill(sheet: &mut Worksheet, table: &Table) -> Result<(), XlsxError> {
    sheet.set_name(table.name)?.set_freeze_panes(1, 0)?;
    let bold = Format::new().set_bold();
    for (column, head) in (0..).zip(&table.heads) {
        let texts = table.rows > 0 && matches!((table.cell)(0, column.into()), Cell::Text(_));
        let least = if texts { TEXT_WIDTH } else { NUMBER_WIDTH };
        let width = head.chars().count().clamp(least, 2 * TEXT_WIDTH);
        sheet.set_column_width(column, width as f64)?;
    }
    for (column, head) in (0..).zip(&table.heads) {
        sheet.write_string_with_format(0, column, head, &bold)?;
    }
    for row in 0..table.rows {
        for column in 0..table.heads.len() {
            let (place, at) = (row as u32 + 1, column as u16);
            match (table.cell)(row, column) {
                Cell::Empty => continue,
                Cell::Number(value) => sheet.write_number(place, at, value)?,
                Cell::Text(words) => sheet.write_string(place, at, printable(&words))?,
            };
        }
    }
    Ok(())
}

/// A text that a cell can hold: control characters are blanks.
fn printable(text: &str) -> String {
    let kept = |letter: char| match letter {
        '\t' | '\n' => letter,
        '\u{fffe}' | '\u{ffff}' => ' ',
        letter if letter.is_control() => ' ',
        letter => letter,
    };
    text.chars().take(LETTERS).map(kept).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use calamine::{Data, Reader, Xlsx};

    #[test]
    fn a_workbook_holds_its_tables() {
        let values = [1.0 / 3.0, f64::NAN, -0.0, 5e-324, f64::MAX];
        let rows = vec![
            vec![Cell::text("a < b & \"c\"\u{1}"), Cell::Number(2.0)],
            vec![Cell::Empty],
        ];
        let heads = vec!["result".into(), "value, SI".into()];
        let columns = vec![(&values[..]).into()];
        let tables = [
            Table::of_rows("results", heads, rows),
            Table::of_columns("history", vec!["force [N]".into()], columns),
        ];
        let mut file = tempfile::tempfile().unwrap();
        write(&mut file, &tables).unwrap();
        let mut book = Xlsx::new(io::BufReader::new(file)).unwrap();
        assert_eq!(book.sheet_names(), ["results", "history"]);
        let results = book.worksheet_range("results").unwrap();
        let text = |text: &str| Some(Data::String(text.to_string()));
        assert_eq!(results.get_value((1, 0)).cloned(), text("a < b & \"c\" "));
        assert_eq!(results.get_value((1, 1)).cloned(), Some(Data::Float(2.0)));
        let history = book.worksheet_range("history").unwrap();
        assert_eq!(history.get_value((0, 0)).cloned(), text("force [N]"));
        for (row, value) in (1..).zip(values) {
            match history.get_value((row, 0)) {
                Some(Data::Float(read)) => assert_eq!(*read, value),
                _ => assert!(value.is_nan(), "{value}"),
            }
        }
    }

    #[test]
    fn a_table_longer_than_a_sheet_is_told() {
        let long = |rows| Table {
            rows,
            ..Table::of_rows("history", vec!["time [s]".into()], Vec::new())
        };
        assert_eq!(too_large(&long(1_048_575)), None);
        let told = too_large(&long(1_048_576)).unwrap();
        assert!(told.starts_with("1048577 rows"), "{told}");
    }
}
