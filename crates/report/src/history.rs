//! `history.parquet`: one column of doubles a channel.
//!
//! Unit and meaning of a column stand in its Arrow field metadata (`schema.field(i).metadata` in pyarrow) and once more
//! as JSON under the file's key [`COLUMNS`], for readers that know nothing of Arrow. A value that is not a finite number is
//! written as an empty cell and read back as not-a-number. Pages of the format carry no checksum here: the key [`CHECKSUM`] has the
//! CRC-32 of names, units, meanings and values of all columns and of what stands under other keys, and a reader compares it.

use super::page::PageColumn;
use crc32fast::Hasher;
use outcome::Column;
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use recording::file::parquet::write::{Head, properties, schema};
use recording::file::parquet::{COLUMNS, Parquet, arrow_schema};
use recording::{Content, FileError, Recording};
use serde::Serialize;
use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;

/// Key of the checksum, eight hexadecimal digits.
const CHECKSUM: &str = "auxbear.crc32";
/// Rows of a row group: a reader holds one of them at a time.
const GROUP_ROWS: usize = 1 << 17;

/// A column to be written; what is known of it besides its values stands as JSON in the file.
#[derive(Serialize)]
pub(super) struct View<'a> {
    pub name: &'a str,
    pub unit: &'a str,
    pub meaning: &'a str,
    #[serde(skip)]
    pub values: &'a [f64],
}

impl<'a> From<&'a PageColumn> for View<'a> {
    fn from(column: &'a PageColumn) -> Self {
        View {
            name: &column.name,
            unit: &column.unit,
            meaning: &column.meaning,
            values: &column.values,
        }
    }
}

/// Writes the columns of a history, which have equal length.
pub(super) fn write(file: &File, columns: &[Column]) -> Result<(), ParquetError> {
    let views: Vec<View> = (columns.iter())
        .map(|column| View {
            name: &column.name,
            unit: column.unit,
            meaning: &column.meaning,
            values: &column.values,
        })
        .collect();
    write_table(file, "history", &views, Vec::new())
}

/// Writes columns of equal length, and more under keys of the file.
pub(super) fn write_table(
    file: impl Write + Send,
    name: &str,
    columns: &[View],
    more: Vec<KeyValue>,
) -> Result<(), ParquetError> {
    let heads: Vec<Head> = (columns.iter())
        .map(|column| Head {
            name: column.name,
            unit: column.unit,
            meaning: column.meaning,
            nullable: !is_whole(column),
        })
        .collect();
    let about = serde_json::to_string(columns);
    let about = about.map_err(|error| ParquetError::External(Box::new(error)))?;
    let mut sum = Checksum::default();
    for column in columns {
        sum.column([column.name, column.unit, column.meaning], column.values);
    }
    let mut keys = vec![KeyValue::new(CHECKSUM.to_string(), sum.text(&more))];
    keys.extend(more);
    let schema = Arc::new(schema(name, &heads)?);
    let properties = Arc::new(properties(&heads, about, keys));
    let mut writer = SerializedFileWriter::new(file, schema, properties)?;
    let rows = columns.iter().map(|column| column.values.len()).max();
    for begin in (0..rows.unwrap_or(0)).step_by(GROUP_ROWS) {
        let mut group = writer.next_row_group()?;
        for column in columns {
            let end = (begin + GROUP_ROWS).min(column.values.len());
            let part = &column.values[begin..end];
            let Some(mut out) = group.next_column()? else {
                break;
            };
            let typed = out.typed::<DoubleType>();
            if is_whole(column) {
                typed.write_batch(part, None, None)?;
            } else {
                let present: Vec<i16> = part.iter().map(|v| i16::from(v.is_finite())).collect();
                let values: Vec<f64> = part.iter().copied().filter(|v| v.is_finite()).collect();
                typed.write_batch(&values, Some(&present), None)?;
            }
            out.close()?;
        }
        group.close()?;
    }
    writer.close()?;
    Ok(())
}

fn is_whole(column: &View) -> bool {
    column.values.iter().all(|value| value.is_finite())
}

/// The checksum of a file on its way.
#[derive(Default)]
struct Checksum(Hasher);

/// Values that are taken at once.
const AT_ONCE: usize = 256;

impl Checksum {
    fn texts(&mut self, texts: &[&str]) {
        for text in texts {
            self.0.update(text.as_bytes());
            self.0.update(&[0]);
        }
    }

    fn column(&mut self, texts: [&str; 3], values: &[f64]) {
        self.texts(&texts);
        for values in values.chunks(AT_ONCE) {
            let mut bytes = [[0; 8]; AT_ONCE];
            for (bytes, value) in bytes.iter_mut().zip(values) {
                let value = if value.is_finite() { *value } else { f64::NAN };
                *bytes = value.to_bits().to_le_bytes();
            }
            self.0.update(bytes[..values.len()].as_flattened());
        }
    }

    fn text(mut self, more: &[KeyValue]) -> String {
        for key in more {
            self.texts(&[&key.key, key.value.as_deref().unwrap_or_default()]);
        }
        format!("{:08x}", self.0.finalize())
    }
}

/// Reads a file that this program wrote: its columns, if its checksum is right.
pub(super) fn read(file: File, path: &Path) -> Result<Vec<PageColumn>, FileError> {
    let wrong = |found: &str| {
        let needed = "a file as auxbear writes it is needed";
        FileError::new(path, "the checksum", found, needed)
    };
    let about = file.try_clone().map_err(ParquetError::from);
    let about = about.and_then(SerializedFileReader::new);
    let about = about.map_err(|error| wrong(&format!("cannot be read ({error})")))?;
    let mut keys = about
        .metadata()
        .file_metadata()
        .key_value_metadata()
        .cloned()
        .unwrap_or_default();
    let given = keys
        .iter()
        .find(|key| key.key == CHECKSUM)
        .and_then(|key| key.value.clone());
    let given = given.ok_or_else(|| wrong("is not there"))?;
    keys.retain(|key| ![arrow_schema::KEY, COLUMNS, CHECKSUM].contains(&key.key.as_str()));
    let columns = columns_of(file, path)?;
    let mut sum = Checksum::default();
    for column in &columns {
        sum.column(
            [&column.name, &column.unit, &column.meaning],
            &column.values,
        );
    }
    match sum.text(&keys) == given {
        true => Ok(columns),
        false => Err(wrong("is not that of the values: the file is damaged")),
    }
}

fn columns_of(file: File, path: &Path) -> Result<Vec<PageColumn>, FileError> {
    let mut file = Parquet::from_source(file, path)?;
    let channels = file.channels().to_vec();
    let mut columns = Vec::new();
    for (index, channel) in channels.into_iter().enumerate() {
        if channel.content != Content::Number {
            continue;
        }
        // A damaged file may claim any number of rows: what is there is read piece by piece.
        let (mut values, mut piece) = (Vec::new(), vec![0.0; GROUP_ROWS]);
        while (values.len() as u64) < channel.count {
            let there = file.read(index, values.len() as u64, &mut piece)?;
            if file.is_damaged(index) || there == 0 {
                let place = format!("column '{}'", channel.name);
                return Err(FileError::new(path, place, "is damaged or cut off", ""));
            }
            values.extend(&piece[..there]);
        }
        columns.push(PageColumn {
            name: channel.name,
            unit: channel.unit,
            meaning: channel.description,
            values,
        });
    }
    Ok(columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(name: &str, unit: &'static str, values: Vec<f64>) -> Column {
        Column {
            name: name.to_string(),
            unit,
            meaning: format!("meaning of {name} µ"),
            optional: false,
            values,
        }
    }

    fn round_trip(columns: &[Column]) -> Vec<PageColumn> {
        let mut file = tempfile::tempfile().unwrap();
        write(&file, columns).unwrap();
        std::io::Seek::rewind(&mut file).unwrap();
        read(file, "history.parquet".as_ref()).unwrap()
    }

    #[test]
    fn values_come_back_bit_for_bit_over_several_row_groups() {
        let rows = GROUP_ROWS + 1000;
        let odd = [0.0, -0.0, f64::MIN_POSITIVE, 5e-324, f64::MAX, 1.0 / 3.0];
        let columns = [
            column("time", "s", (0..rows).map(|k| k as f64 * 1e-4).collect()),
            column("odd", "1", (0..rows).map(|k| odd[k % odd.len()]).collect()),
        ];
        let back = round_trip(&columns);
        for (back, column) in back.iter().zip(&columns) {
            assert_eq!(
                (&*back.name, &*back.unit, &*back.meaning),
                (&*column.name, column.unit, &*column.meaning)
            );
            let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            assert!(bits(&back.values) == bits(&column.values), "{}", back.name);
        }
        assert_eq!(back.len(), 2);
    }

    #[test]
    fn what_is_not_finite_becomes_an_empty_cell() {
        let values = vec![1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 2.0];
        let back = round_trip(&[column("a", "N", values), column("b", "N", vec![1.5; 5])]);
        assert_eq!(back[0].values[0], 1.0);
        assert!(back[0].values[1..4].iter().all(|value| value.is_nan()));
        assert_eq!(back[0].values[4], 2.0);
        assert_eq!(back[1].values, [1.5; 5]);
    }

    /// A run directory whose history was damaged on a disk made the report panic.
    #[test]
    fn a_flipped_bit_of_a_history_is_found() {
        let mut file = tempfile::tempfile().unwrap();
        let values = (0..40).map(|k| 1.0 / f64::from(3 + k)).collect();
        write(&file, &[column("time", "s", values)]).unwrap();
        std::io::Seek::rewind(&mut file).unwrap();
        let mut whole = Vec::new();
        std::io::Read::read_to_end(&mut file, &mut whole).unwrap();
        let try_read = |bytes: &[u8]| {
            let mut file = tempfile::tempfile().unwrap();
            std::io::Write::write_all(&mut file, bytes).unwrap();
            std::io::Seek::rewind(&mut file).unwrap();
            read(file, "history.parquet".as_ref())
        };
        let right = try_read(&whole).unwrap();
        assert_eq!(right.len(), 1);
        for end in [0, 3, whole.len() / 2, whole.len() - 1] {
            assert!(try_read(&whole[..end]).is_err(), "{end}");
        }
        let mut found = 0;
        for at in 0..whole.len() {
            let bits = (0..8).map(|bit| whole[at] ^ (1 << bit));
            for value in bits.chain([0, 0x7f, 0xff]) {
                let mut changed = whole.clone();
                changed[at] = value;
                // what stands in the file besides, such as statistics, may change unseen
                match try_read(&changed) {
                    Ok(columns) => assert_eq!(columns, right, "byte {at}"),
                    Err(_) => found += 1,
                }
            }
        }
        assert!(found > 3 * whole.len(), "{found} of {}", 11 * whole.len());
    }

    #[test]
    fn a_history_without_rows_keeps_its_columns() {
        let back = round_trip(&[column("time", "s", Vec::new())]);
        assert_eq!(back.len(), 1);
        assert!(back[0].values.is_empty() && back[0].unit == "s");
    }
}
