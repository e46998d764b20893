//! Writes Parquet: columns of doubles with their units.

use std::path::Path;
use std::sync::Arc;

use ::parquet::basic::{Compression, Encoding, Repetition, Type as Physical};
use ::parquet::data_type::DoubleType;
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::{EnabledStatistics, WriterProperties};
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::Type;

use super::COLUMNS;
use super::arrow_schema::{self, Field};
use crate::file::columns::{self, Times};
use crate::file::draft::Draft;
use crate::file::writer::Writer;
use crate::{Channel, FileError, Instant};

/// Rows of a row group: the writer, and a reader, holds one of them at a time.
const GROUP_ROWS: usize = 1 << 17;

/// Most values that are held before a row group is written, whatever the number of columns.
const GROUP_VALUES: usize = 1 << 23;

/// Writes channels of one clock as a Parquet file.
///
/// Unit and meaning of a column stand in its Arrow field metadata and under [`COLUMNS`]. A uniform clock becomes a
/// column `time` in s, unless a channel holds times. Not-a-number stays what it is. The start is
/// written under `start` into the metadata of the file.
pub struct ParquetWriter {
    writer: SerializedFileWriter<Draft>,
    channels: Vec<Channel>,
    times: Option<Times>,
    rows: u64,
    /// Values of each column, times first, that are not written yet.
    held: Vec<Vec<f64>>,
    group_rows: usize,
    draft_path: std::path::PathBuf,
}

impl std::fmt::Debug for ParquetWriter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ParquetWriter")
            .field("channels", &self.channels)
            .field("rows", &self.rows)
            .finish_non_exhaustive()
    }
}

impl ParquetWriter {
    /// Starts a file of the channels; an error where they have different clocks, one holds texts, or two have one name.
    pub fn create(path: &Path, channels: &[Channel]) -> Result<ParquetWriter, FileError> {
        let times = columns::times(path, channels)?;
        let head = |name, unit, meaning| Head {
            name,
            unit,
            meaning,
            nullable: false,
        };
        let mut heads: Vec<Head> = Vec::new();
        if times.is_some() {
            heads.push(head("time", "s", "time of the row"));
        }
        for channel in channels {
            if heads.iter().any(|head| head.name == channel.name) {
                let place = format!("channel {}", channel.name);
                let needed = "give each channel its own name";
                return Err(FileError::new(path, place, "is there twice", needed));
            }
            heads.push(head(&channel.name, &channel.unit, &channel.description));
        }
        let failed = |error: ParquetError| FileError::new(path, "", error.to_string(), "");
        let schema = schema("recording", &heads).map_err(failed)?;
        let properties = properties(&heads, about(&heads), stated(channels));
        let draft = Draft::create(path)?;
        let writer = SerializedFileWriter::new(draft, Arc::new(schema), Arc::new(properties))
            .map_err(failed)?;
        Ok(ParquetWriter {
            writer,
            channels: channels.to_vec(),
            times,
            rows: 0,
            held: vec![Vec::new(); heads.len()],
            group_rows: (GROUP_VALUES / heads.len()).clamp(1, GROUP_ROWS),
            draft_path: path.to_owned(),
        })
    }

    fn error(&self, error: &ParquetError) -> FileError {
        FileError::new(&self.draft_path, "", error.to_string(), "")
    }

    /// Writes what is held as a row group.
    fn write_group(&mut self) -> Result<(), ParquetError> {
        if self.held.first().is_none_or(Vec::is_empty) {
            return Ok(());
        }
        let mut group = self.writer.next_row_group()?;
        for values in &mut self.held {
            let Some(mut column) = group.next_column()? else {
                break;
            };
            column
                .typed::<DoubleType>()
                .write_batch(values, None, None)?;
            column.close()?;
            values.clear();
        }
        group.close()?;
        Ok(())
    }
}

/// What is known of a column of doubles besides its values.
pub struct Head<'a> {
    /// Name.
    pub name: &'a str,
    /// Unit.
    pub unit: &'a str,
    /// Meaning.
    pub meaning: &'a str,
    /// Whether cells may be empty.
    pub nullable: bool,
}

/// The schema of a table of doubles.
///
/// # Errors
/// Names that Parquet refuses.
pub fn schema(name: &str, heads: &[Head]) -> Result<Type, ParquetError> {
    let columns = heads.iter().map(|head| {
        let repetition = match head.nullable {
            true => Repetition::OPTIONAL,
            false => Repetition::REQUIRED,
        };
        Type::primitive_type_builder(head.name, Physical::DOUBLE)
            .with_repetition(repetition)
            .build()
            .map(Arc::new)
    });
    Type::group_type_builder(name)
        .with_fields(columns.collect::<Result<_, _>>()?)
        .build()
}

/// How a table of doubles is packed, and what its metadata state: `about` is the text under [`COLUMNS`], `more` what stands under
/// keys of its own.
pub fn properties(heads: &[Head], about: String, more: Vec<KeyValue>) -> WriterProperties {
    let metadata: Vec<[(&str, &str); 2]> = heads
        .iter()
        .map(|head| [("unit", head.unit), ("meaning", head.meaning)])
        .collect();
    let fields: Vec<Field> = heads
        .iter()
        .zip(&metadata)
        .map(|(head, metadata)| Field {
            name: head.name,
            nullable: head.nullable,
            metadata,
        })
        .collect();
    let schema = arrow_schema::encoded(&fields);
    let mut pairs = vec![
        KeyValue::new(arrow_schema::KEY.to_string(), schema),
        KeyValue::new(COLUMNS.to_string(), about),
    ];
    pairs.extend(more);
    WriterProperties::builder()
        .set_created_by(format!("auxbear {}", env!("CARGO_PKG_VERSION")))
        .set_key_value_metadata(Some(pairs))
        // Doubles that were measured or computed hardly repeat, so a dictionary only adds to them; their bytes of equal rank do.
        .set_dictionary_enabled(false)
        .set_encoding(Encoding::BYTE_STREAM_SPLIT)
        .set_compression(Compression::SNAPPY)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .build()
}

/// Names, units and meanings in JSON.
fn about(heads: &[Head]) -> String {
    let columns = heads.iter().map(|head| {
        let (name, unit, meaning) = (head.name, head.unit, head.meaning);
        serde_json::json!({"name": name, "unit": unit, "meaning": meaning})
    });
    serde_json::Value::from_iter(columns).to_string()
}

/// The start of the channels.
fn stated(channels: &[Channel]) -> Vec<KeyValue> {
    let start = channels.iter().find_map(|channel| channel.start);
    let text = start.map(|Instant { seconds, fraction }| {
        format!("{:?} s since 1970", seconds as f64 + fraction)
    });
    Vec::from_iter(text.map(|text| KeyValue::new("start".to_string(), text)))
}

impl Writer for ParquetWriter {
    fn append(&mut self, values: &[&[f64]]) -> Result<(), FileError> {
        let rows = columns::rows(&self.draft_path, &self.channels, values)?;
        let mut done = 0;
        while done < rows {
            let held = self.held[0].len();
            let here = (self.group_rows - held).min(rows - done);
            let mut columns = self.held.iter_mut();
            if let Some(times) = self.times
                && let Some(column) = columns.next()
            {
                let from = self.rows;
                column.extend((from..from + here as u64).map(|row| times.at(row)));
            }
            for (column, slice) in columns.zip(values) {
                column.extend(&slice[done..done + here]);
            }
            done += here;
            self.rows += here as u64;
            if self.held[0].len() >= self.group_rows {
                self.write_group().map_err(|error| self.error(&error))?;
            }
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> Result<(), FileError> {
        self.write_group().map_err(|error| self.error(&error))?;
        let path = self.draft_path;
        let draft = self.writer.into_inner();
        let draft = draft.map_err(|e| FileError::new(&path, "", e.to_string(), ""))?;
        draft.finish()
    }
}
