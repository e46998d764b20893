//! An XLSX workbook: a sheet for each table, with a frozen head.
//!
//! Texts stand in their cells, numbers with the digits that give them back bit for bit; rows go to the file one after the
//! other, so that a million of them do not stand in memory.
//!
//! Source: ECMA-376-1, SpreadsheetML, the parts that a reader needs (from memory).

use super::table::{Cell, Table};
use super::zip::Archive;
use std::fs::File;
use std::io::{self, BufWriter, Seek, Write};

/// Rows of a sheet, with its head.
const ROWS: usize = 1_048_576;
/// Columns of a sheet.
const COLUMNS: usize = 16_384;
/// What a sheet holds, in words.
pub(super) const LARGEST: &str = "a sheet holds 1 048 576 rows and 16 384 columns";
/// Letters of a cell.
const LETTERS: usize = 32_767;
/// Width of a column of texts, letters.
const TEXT_WIDTH: usize = 32;
/// Least width of a column, letters.
const NUMBER_WIDTH: usize = 12;

const XML: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n";
const MAIN: &str = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
const PACKAGE: &str = "http://schemas.openxmlformats.org/package/2006";
const DOCUMENT: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
const KIND: &str = "application/vnd.openxmlformats-officedocument.spreadsheetml";
/// Plain cells, and bold ones for the heads.
const STYLES: &str = "<fonts count=\"2\"><font/><font><b/></font></fonts>\
    <fills count=\"2\"><fill><patternFill patternType=\"none\"/></fill><fill><patternFill patternType=\"gray125\"/></fill></fills>\
    <borders count=\"1\"><border/></borders><cellStyleXfs count=\"1\"><xf/></cellStyleXfs>\
    <cellXfs count=\"2\"><xf xfId=\"0\"/><xf xfId=\"0\" fontId=\"1\" applyFont=\"1\"/></cellXfs>";
const HEAD: &str = "<sheetViews><sheetView workbookViewId=\"0\"><pane ySplit=\"1\" topLeftCell=\"A2\" \
    activePane=\"bottomLeft\" state=\"frozen\"/></sheetView></sheetViews>";

/// Why a table is no sheet; none of one that is.
pub(super) fn too_large(table: &Table) -> Option<String> {
    let (rows, columns) = (table.rows + 1, table.heads.len());
    (rows > ROWS || columns > COLUMNS).then(|| {
        format!(
            "{rows} rows and {columns} columns of the table {}",
            table.name
        )
    })
}

/// Writes a workbook.
pub(super) fn write(out: File, tables: &[Table]) -> io::Result<()> {
    let out = archived(BufWriter::new(out), tables)?;
    out.into_inner()
        .map_err(io::IntoInnerError::into_error)?
        .sync_all()
}

fn archived<W: Write + Seek>(out: W, tables: &[Table]) -> io::Result<W> {
    let mut archive = Archive::new(out);
    let mut part =
        |name: &str, body: String| archive.file(name, |file| write!(file, "{XML}{body}"));
    let each = |of: &dyn Fn(usize, &Table) -> String| -> String {
        let numbered = (1..).zip(tables);
        numbered.map(|(number, table)| of(number, table)).collect()
    };
    let sheet_kinds = each(&|number, _| {
        format!(
            "<Override PartName=\"/xl/worksheets/sheet{number}.xml\" ContentType=\"{KIND}.worksheet+xml\"/>"
        )
    });
    part(
        "[Content_Types].xml",
        format!(
            "<Types xmlns=\"{PACKAGE}/content-types\">\
             <Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\
             <Override PartName=\"/xl/workbook.xml\" ContentType=\"{KIND}.sheet.main+xml\"/>\
             <Override PartName=\"/xl/styles.xml\" ContentType=\"{KIND}.styles+xml\"/>{sheet_kinds}</Types>"
        ),
    )?;
    part(
        "_rels/.rels",
        format!(
            "<Relationships xmlns=\"{PACKAGE}/relationships\">\
             <Relationship Id=\"rId1\" Type=\"{DOCUMENT}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"
        ),
    )?;
    let sheets = each(&|number, table| {
        format!(
            "<sheet name=\"{}\" sheetId=\"{number}\" r:id=\"rId{number}\"/>",
            table.name
        )
    });
    part(
        "xl/workbook.xml",
        format!(
            "<workbook xmlns=\"{MAIN}\" xmlns:r=\"{DOCUMENT}\"><sheets>{sheets}</sheets></workbook>"
        ),
    )?;
    let sheets = each(&|number, _| {
        format!(
            "<Relationship Id=\"rId{number}\" Type=\"{DOCUMENT}/worksheet\" Target=\"worksheets/sheet{number}.xml\"/>"
        )
    });
    part(
        "xl/_rels/workbook.xml.rels",
        format!(
            "<Relationships xmlns=\"{PACKAGE}/relationships\">{sheets}\
             <Relationship Id=\"rId{}\" Type=\"{DOCUMENT}/styles\" Target=\"styles.xml\"/></Relationships>",
            tables.len() + 1
        ),
    )?;
    let styles = format!("<styleSheet xmlns=\"{MAIN}\">{STYLES}</styleSheet>");
    part("xl/styles.xml", styles)?;
    for (number, table) in (1..).zip(tables) {
        let name = format!("xl/worksheets/sheet{number}.xml");
        archive.file(&name, |file| sheet(&mut BufWriter::new(file), table))?;
    }
    archive.finish()
}

fn sheet(out: &mut impl Write, table: &Table) -> io::Result<()> {
    write!(out, "{XML}<worksheet xmlns=\"{MAIN}\">{HEAD}<cols>")?;
    for (column, head) in table.heads.iter().enumerate() {
        let texts = table.rows > 0 && matches!((table.cell)(0, column), Cell::Text(_));
        let least = if texts { TEXT_WIDTH } else { NUMBER_WIDTH };
        let width = head.chars().count().clamp(least, 2 * TEXT_WIDTH);
        let place = column + 1;
        write!(
            out,
            "<col min=\"{place}\" max=\"{place}\" width=\"{width}\" customWidth=\"1\"/>"
        )?;
    }
    out.write_all(b"</cols><sheetData><row r=\"1\">")?;
    for (column, head) in table.heads.iter().enumerate() {
        text(out, &letters(column), 1, " s=\"1\"", head)?;
    }
    out.write_all(b"</row>")?;
    let columns: Vec<String> = (0..table.heads.len()).map(letters).collect();
    for row in 0..table.rows {
        let number = row + 2;
        write!(out, "<row r=\"{number}\">")?;
        for (column, letters) in columns.iter().enumerate() {
            match (table.cell)(row, column) {
                Cell::Empty => {}
                Cell::Number(value) => {
                    write!(out, "<c r=\"{letters}{number}\"><v>{value:?}</v></c>")?
                }
                Cell::Text(words) => text(out, letters, number, "", &words)?,
            }
        }
        out.write_all(b"</row>")?;
    }
    out.write_all(b"</sheetData></worksheet>")?;
    out.flush()
}

fn text(
    out: &mut impl Write,
    letters: &str,
    number: usize,
    style: &str,
    words: &str,
) -> io::Result<()> {
    write!(
        out,
        "<c r=\"{letters}{number}\"{style} t=\"inlineStr\"><is><t xml:space=\"preserve\">{}</t></is></c>",
        escaped(words)
    )
}

/// A text between tags: what XML cannot hold is a blank.
fn escaped(text: &str) -> String {
    let mut safe = String::new();
    for letter in text.chars().take(LETTERS) {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '\t' | '\n' => safe.push(letter),
            '\u{fffe}' | '\u{ffff}' => safe.push(' '),
            letter if letter.is_control() => safe.push(' '),
            letter => safe.push(letter),
        }
    }
    safe
}

/// The letters of a column: A, B, …, Z, AA, …
fn letters(mut column: usize) -> String {
    let mut reversed = Vec::new();
    loop {
        reversed.push(char::from(b'A' + (column % 26) as u8));
        match column / 26 {
            0 => return reversed.into_iter().rev().collect(),
            rest => column = rest - 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::DeflateDecoder;
    use std::collections::BTreeMap;
    use std::io::{Cursor, Read};

    #[test]
    fn columns_have_the_letters_of_a_sheet() {
        for (column, name) in [
            (0, "A"),
            (25, "Z"),
            (26, "AA"),
            (701, "ZZ"),
            (702, "AAA"),
            (16_383, "XFD"),
        ] {
            assert_eq!(letters(column), name);
        }
    }

    /// The files of an archive, by its own directory; sizes and checksums are those written there.
    fn unpacked(bytes: &[u8]) -> BTreeMap<String, String> {
        let number = |at: usize, length: usize| {
            let bytes = &bytes[at..at + length];
            bytes
                .iter()
                .rev()
                .fold(0, |sum, byte| 256 * sum + usize::from(*byte))
        };
        let end = bytes.len() - 22;
        assert_eq!(&bytes[end..end + 4], b"PK\x05\x06");
        let mut at = number(end + 16, 4);
        assert_eq!(number(end + 12, 4), end - at);
        let mut files = BTreeMap::new();
        for _ in 0..number(end + 10, 2) {
            assert_eq!(&bytes[at..at + 4], b"PK\x01\x02");
            let (checksum, deflated, size) =
                (number(at + 16, 4), number(at + 20, 4), number(at + 24, 4));
            let (length, place) = (number(at + 28, 2), number(at + 42, 4));
            let name = String::from_utf8(bytes[at + 46..at + 46 + length].to_vec()).unwrap();
            assert_eq!(&bytes[place..place + 4], b"PK\x03\x04");
            // the local head says the same
            assert_eq!(bytes[place + 4..place + 30], bytes[at + 6..at + 32]);
            let from = place + 30 + length;
            let mut text = String::new();
            DeflateDecoder::new(&bytes[from..from + deflated])
                .read_to_string(&mut text)
                .unwrap();
            let mut sum = flate2::Crc::new();
            sum.update(text.as_bytes());
            assert_eq!((text.len(), sum.sum() as usize), (size, checksum), "{name}");
            files.insert(name, text);
            at += 46 + length;
        }
        files
    }

    #[test]
    fn a_workbook_holds_its_tables() {
        let values = [
            1.0 / 3.0,
            f64::NAN,
            -0.0,
            5e-324,
            1.797_693_134_862_315_7e308,
        ];
        let rows = vec![
            vec![Cell::text("a < b & \"c\"\u{1}"), Cell::Number(2.0)],
            vec![Cell::Empty],
        ];
        let tables = [
            Table::of_rows("results", vec!["result".into(), "value, SI".into()], rows),
            Table::of_columns(
                "history",
                vec!["force [N]".into()],
                vec![(&values[..]).into()],
            ),
        ];
        let bytes = archived(Cursor::new(Vec::new()), &tables)
            .unwrap()
            .into_inner();
        let files = unpacked(&bytes);
        assert_eq!(files.len(), 7);
        assert!(files["xl/workbook.xml"].contains("<sheet name=\"history\" sheetId=\"2\""));
        let results = &files["xl/worksheets/sheet1.xml"];
        assert!(results.contains(">a &lt; b &amp; \"c\" </t>"), "{results}");
        assert!(
            results.contains("<c r=\"B2\"><v>2.0</v></c></row><row r=\"3\"></row>"),
            "{results}"
        );
        let history = &files["xl/worksheets/sheet2.xml"];
        assert!(history.contains(">force [N]</t>"));
        let numbers: Vec<f64> = (history.split("<v>").skip(1))
            .map(|rest| rest.split('<').next().unwrap().parse().unwrap())
            .collect();
        let finite: Vec<f64> = values
            .iter()
            .copied()
            .filter(|value| value.is_finite())
            .collect();
        let bits = |values: &[f64]| {
            values
                .iter()
                .map(|value| value.to_bits())
                .collect::<Vec<_>>()
        };
        assert_eq!(bits(&numbers), bits(&finite));
        assert!(history.contains("<row r=\"3\"></row>"));
    }

    #[test]
    fn a_table_longer_than_a_sheet_is_told() {
        let long = |rows| Table {
            rows,
            ..Table::of_rows("history", vec!["time [s]".into()], Vec::new())
        };
        assert_eq!(too_large(&long(1_048_575)), None);
        assert!(
            too_large(&long(1_048_576))
                .unwrap()
                .starts_with("1048577 rows")
        );
    }
}
