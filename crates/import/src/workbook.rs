//! Tables in workbooks: the rows of the first sheet.

use calamine::{Data, Reader, Xlsx};
use std::collections::BTreeMap;
use std::io::Cursor;

/// Columns of a table.
const MOST_COLUMNS: u32 = 50;
/// Last row of a sheet that is looked at: what stands below is no table of sections.
const LAST_ROW: u32 = 10_000;
/// Bytes of all parts of a workbook, unpacked.
const MOST_UNPACKED: u64 = 50_000_000;

/// Rows of the first sheet of a workbook, cell by cell: a stray cell far out makes no large table.
pub(super) fn of_workbook(bytes: &[u8]) -> Result<Vec<Vec<String>>, String> {
    let damaged = |error: calamine::XlsxError| format!("a workbook that cannot be read ({error})");
    let unpacked = unpacked(bytes);
    if unpacked > MOST_UNPACKED {
        return Err(format!(
            "a workbook of {unpacked} bytes unpacked, where at most {MOST_UNPACKED} are read"
        ));
    }
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(bytes)).map_err(damaged)?;
    let names = book.sheet_names();
    let name = names.first().ok_or("a workbook without a sheet")?;
    let mut cells = book.worksheet_cells_reader(name).map_err(damaged)?;
    let mut rows: BTreeMap<u32, Vec<String>> = BTreeMap::new();
    while let Some(cell) = cells.next_cell().map_err(damaged)? {
        let (row, column) = cell.get_position();
        let text = Data::from(cell.get_value().clone()).to_string();
        let text = text.trim();
        if text.is_empty() {
            continue;
        }
        if row >= LAST_ROW || column >= MOST_COLUMNS {
            return Err(format!(
                "a cell in row {} and column {}, where at most {LAST_ROW} rows and {MOST_COLUMNS} columns are read",
                u64::from(row) + 1,
                u64::from(column) + 1
            ));
        }
        let cells = rows.entry(row).or_default();
        cells.resize(cells.len().max(column as usize + 1), String::new());
        cells[column as usize] = text.to_string();
    }
    Ok(rows.into_values().collect())
}

/// Bytes of all parts of a ZIP archive as its directory states them.
fn unpacked(bytes: &[u8]) -> u64 {
    const ENTRY: &[u8] = b"PK\x01\x02";
    let entries = bytes
        .windows(ENTRY.len() + 24)
        .filter(|entry| entry.starts_with(ENTRY));
    let size = |entry: &[u8]| <[u8; 4]>::try_from(&entry[24..28]).map_or(0, u32::from_le_bytes);
    entries.map(|entry| u64::from(size(entry))).sum()
}
