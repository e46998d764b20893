//! Apache Parquet: reader and writer.
//!
//! A column of numbers, instants or texts is a channel; columns of lists and of bytes are left out with a note. Unit and
//! meaning of a column stand in its Arrow field metadata (`unit` or `units`, `meaning` or `description`), or in the
//! file's metadata under [`COLUMNS`], as a history of this project has them. A column named `time` or `t` is the clock.
//!
//! Packing: none, Snappy, LZ4, gzip. Row groups are read piece by piece; of a file that was cut off nothing can be read,
//! because what it holds stands at its end.

pub mod arrow_schema;
mod columns;
mod pages;
pub mod write;

use std::cell::Cell;
use std::io::{self, Read, Seek};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use ::parquet::basic::Compression;
use ::parquet::column::reader::get_column_reader;
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::{
    ColumnChunkMetaData, KeyValue, ParquetMetaData, ParquetMetaDataReader,
};
use ::parquet::file::reader::{ChunkReader, Length};
use ::parquet::file::serialized_reader::SerializedPageReader;
use bytes::Bytes;

use super::clock;
use super::source::Source;
use crate::{Channel, Content, FileError, Instant, Note, Recording};
use columns::{Cursor, Kind};
pub use write::ParquetWriter;

/// Key of names, units and meanings of the columns in the metadata of a file: a list of objects in JSON.
pub const COLUMNS: &str = "auxbear.columns";

/// Columns that are kept open.
const CURSORS: usize = 256;

/// Most bytes of the description at the end of a file.
const LARGEST_FOOTER: u64 = 256 << 20;

/// Whether a file that starts with these bytes is Parquet.
pub fn is_parquet(head: &[u8]) -> bool {
    head.starts_with(b"PAR1")
}

/// Bytes that several column readers share.
struct Shared<S>(Arc<Mutex<Source<S>>>);

impl<S> Clone for Shared<S> {
    fn clone(&self) -> Shared<S> {
        Shared(self.0.clone())
    }
}

impl<S> Shared<S> {
    fn with<T>(&self, act: impl FnOnce(&mut Source<S>) -> T) -> T {
        act(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl<S: Read + Seek + Send> Length for Shared<S> {
    fn len(&self) -> u64 {
        self.with(|source| source.length())
    }
}

/// A place in shared bytes.
struct Place<S> {
    shared: Shared<S>,
    at: u64,
}

impl<S: Read + Seek + Send> Read for Place<S> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = self.shared.with(|source| source.read_at(self.at, bytes));
        let read = read.map_err(io::Error::other)?;
        self.at += read as u64;
        Ok(read)
    }
}

impl<S: Read + Seek + Send> ChunkReader for Shared<S> {
    type T = io::BufReader<Place<S>>;

    fn get_read(&self, start: u64) -> Result<Self::T, ParquetError> {
        let place = Place {
            shared: self.clone(),
            at: start,
        };
        Ok(io::BufReader::with_capacity(256, place))
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes, ParquetError> {
        let bytes = self.with(|source| source.bytes(start, length as u64));
        let bytes = bytes.map_err(|error| ParquetError::External(Box::new(error)))?;
        Ok(Bytes::from(bytes))
    }
}

/// A column that is a channel.
#[derive(Clone, Copy, Debug)]
struct Column {
    /// Its index in the file.
    index: usize,
    kind: Kind,
    /// Instant from which instants are counted, s since 1970.
    origin: (i64, f64),
}

/// What is wrong with the values of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Damage {
    None,
    /// They cannot be unpacked, or end too early.
    Unreadable,
    /// A page does not match its checksum.
    Contradicted,
}

/// What the library that unpacks Parquet says of a page that does not match its checksum.
const CONTRADICTED: &str = "CRC checksum mismatch";

/// A Parquet file that is open for reading.
pub struct Parquet<S> {
    shared: Shared<S>,
    path: PathBuf,
    metadata: ParquetMetaData,
    /// First row of each row group, and the number of all rows behind them.
    starts: Vec<u64>,
    columns: Vec<Column>,
    channels: Vec<Channel>,
    notes: Vec<Note>,
    /// What was found damaged in each channel.
    damage: Vec<Damage>,
    /// Columns that are being read: channel, row group, and where; none where the group is damaged.
    cursors: Vec<(usize, usize, Option<Cursor>)>,
}

shown_by_contents!(Parquet);

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Whether a panic on this thread would be caught by the reader.
///
/// The library that unpacks Parquet panics on some damaged pages. The reader makes a note of that, but the panic hook of
/// the program has been called by then: a hook that reports to people asks here first, and says nothing.
pub fn panic_is_caught() -> bool {
    GUARDED.with(Cell::get)
}

/// Runs what a damaged file might make fail in the library that unpacks it.
fn guarded<T>(act: impl FnOnce() -> Result<T, ParquetError>) -> Result<T, String> {
    let before = GUARDED.with(|guarded| guarded.replace(true));
    let done = catch_unwind(AssertUnwindSafe(act));
    GUARDED.with(|guarded| guarded.set(before));
    match done {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(error)) => Err(error.to_string()),
        Err(_) => Err("is damaged".to_string()),
    }
}

/// Where the bytes of a column in a row group stand; none where the file states no such place.
fn range(chunk: &ColumnChunkMetaData) -> Option<(u64, u64)> {
    let start = chunk.dictionary_page_offset();
    let start = u64::try_from(start.unwrap_or(chunk.data_page_offset())).ok()?;
    let length = u64::try_from(chunk.compressed_size()).ok()?;
    Some((start, start.checked_add(length)?))
}

impl<S: Read + Seek + Send + 'static> Parquet<S> {
    /// Reads what the file holds, without the values; errors name `path`.
    ///
    /// An error where the description at the end of the file is missing or damaged.
    pub fn from_source(source: S, path: &Path) -> Result<Parquet<S>, FileError> {
        let mut source = Source::new(source, path)?;
        let length = source.length();
        let mut tail = [0; 8];
        let there = source.read_at(length.saturating_sub(8), &mut tail)?;
        if there < 8 || &tail[4..] != b"PAR1" {
            let found = "the description at the end is missing";
            let needed = "the file was cut off, or is encrypted; nothing of it can be read";
            return Err(FileError::new(path, "", found, needed));
        }
        let footer = u64::from(u32::from_le_bytes([tail[0], tail[1], tail[2], tail[3]]));
        if footer > LARGEST_FOOTER.min(length) {
            let found = format!("states a description of {footer} bytes at its end");
            return Err(FileError::new(path, "", found, ""));
        }
        let shared = Shared(Arc::new(Mutex::new(source)));
        let metadata = guarded(|| ParquetMetaDataReader::new().parse_and_finish(&shared))
            .map_err(|e| FileError::new(path, "the description at the end", e, ""))?;
        let mut starts = vec![0u64];
        for group in metadata.row_groups() {
            let rows = u64::try_from(group.num_rows()).unwrap_or(0);
            starts.push(starts[starts.len() - 1].saturating_add(rows));
        }
        let mut file = Parquet {
            shared,
            path: path.to_owned(),
            metadata,
            starts,
            columns: Vec::new(),
            channels: Vec::new(),
            notes: Vec::new(),
            damage: Vec::new(),
            cursors: Vec::new(),
        };
        file.take_columns();
        file.set_origins();
        file.set_clocks(length);
        Ok(file)
    }

    fn take_columns(&mut self) {
        let about = About::of(&self.metadata);
        let rows = self.starts.last().copied().unwrap_or(0);
        let schema = self.metadata.file_metadata().schema_descr_ptr();
        for (index, column) in schema.columns().iter().enumerate() {
            let name = column.path().parts().join("/");
            let mut note = |text: String| {
                self.notes.push(Note::of(&name, text));
            };
            let kind = match Kind::of(column) {
                Ok(kind) => kind,
                Err(why) => {
                    note(format!("{why}; it is left out"));
                    continue;
                }
            };
            let packings = self.metadata.row_groups().iter();
            let packings = packings.filter_map(|group| group.columns().get(index));
            let mut packings = packings.map(|chunk| chunk.compression());
            let unknown = packings.find(|packing| {
                !matches!(
                    packing,
                    Compression::UNCOMPRESSED
                        | Compression::SNAPPY
                        | Compression::GZIP(_)
                        | Compression::LZ4
                        | Compression::LZ4_RAW
                )
            });
            if let Some(packing) = unknown {
                note(format!(
                    "is packed with {packing}, which is not read; write the file with snappy"
                ));
                continue;
            }
            let (unit, description) = about.column(&name);
            self.columns.push(Column {
                index,
                kind,
                origin: (0, 0.0),
            });
            self.channels.push(Channel {
                unit,
                description,
                content: match kind {
                    Kind::Number { .. } | Kind::Half => Content::Number,
                    Kind::Instant { .. } | Kind::OldInstant => Content::Time,
                    Kind::Text => Content::Text,
                },
                ..Channel::new(name, rows)
            });
            self.damage.push(Damage::None);
        }
    }

    /// Counts the instants of each channel from its first.
    fn set_origins(&mut self) {
        for channel in 0..self.channels.len() {
            if self.channels[channel].content != Content::Time {
                continue;
            }
            self.channels[channel].unit = "s".to_string();
            let mut first = [f64::NAN; 64];
            let read = self.read(channel, 0, &mut first).unwrap_or(0);
            let Some(&first) = first[..read].iter().find(|value| value.is_finite()) else {
                continue;
            };
            // Whole seconds are exact; the rest is counted with the values.
            let seconds = first.floor().clamp(-9e18, 9e18);
            self.columns[channel].origin = (seconds as i64, 0.0);
            self.channels[channel].start = Some(Instant {
                seconds: seconds as i64,
                fraction: 0.0,
            });
            self.cursors.clear();
        }
    }

    fn set_clocks(&mut self, length: u64) {
        // A file cannot hold many more different times than bytes; a claim of more is not followed to its end.
        let most = length.saturating_mul(8).saturating_add(1 << 20);
        let rounding: Vec<Option<f64>> = self
            .channels
            .iter()
            .zip(&self.columns)
            .map(|(channel, column)| (channel.count <= most).then(|| column.kind.rounding()))
            .collect();
        let (clocks, notes) = clock::clocks(self, &[], &rounding);
        for (channel, clock) in clocks {
            self.channels[channel].clock = clock;
        }
        self.notes.extend(notes);
    }

    /// Whether a part of a channel that was read is damaged or cut off.
    pub fn is_damaged(&self, channel: usize) -> bool {
        self.damage.get(channel) != Some(&Damage::None)
    }

    /// The place where a channel was read last in a row group, or the start of the group; none where it is damaged.
    fn cursor(&mut self, channel: usize, group: usize, row: u64) -> Option<Cursor> {
        let known = |(c, g, _): &(usize, usize, Option<Cursor>)| (*c, *g) == (channel, group);
        if let Some(at) = self.cursors.iter().position(known) {
            match self.cursors.remove(at).2 {
                Some(cursor) if cursor.row <= row => return Some(cursor),
                Some(_) => {}
                None => {
                    self.cursors.push((channel, group, None));
                    return None;
                }
            }
        }
        let opened = self.open(channel, group);
        if opened.is_none() {
            self.cursors.push((channel, group, None));
        }
        opened
    }

    fn open(&mut self, channel: usize, group: usize) -> Option<Cursor> {
        let index = self.columns.get(channel)?.index;
        let group = self.metadata.row_groups().get(group)?;
        let chunk = group.columns().get(index)?;
        let rows = usize::try_from(group.num_rows()).ok()?;
        let shared = self.shared.clone();
        let column = chunk.column_descr_ptr();
        guarded(|| {
            let sound = |(start, end)| shared.with(|source| pages::are_sound(source, start, end));
            if !range(chunk).is_some_and(sound) {
                return Err(ParquetError::General("a page is damaged".to_string()));
            }
            let pages = SerializedPageReader::new(Arc::new(shared.clone()), chunk, rows, None)?;
            let reader = get_column_reader(column.clone(), Box::new(pages));
            Ok(Cursor::new(reader, &column))
        })
        .ok()
    }

    fn keep(&mut self, channel: usize, group: usize, cursor: Option<Cursor>) {
        self.cursors.push((channel, group, cursor));
        if self.cursors.len() > CURSORS {
            self.cursors.remove(0);
        }
    }

    /// Row group of a row, and the row in it.
    fn group_of(&self, row: u64) -> (usize, u64) {
        let group = self.starts.partition_point(|&start| start <= row) - 1;
        (group, row - self.starts[group])
    }

    /// Notes that a part of a channel was not read, once for each reason; `why` is what the library said.
    fn tell_damage(&mut self, channel: usize, why: &str) {
        let (damage, text) = match why.contains(CONTRADICTED) {
            true => (
                Damage::Contradicted,
                "a page does not match its checksum; its values are missing",
            ),
            false => (
                Damage::Unreadable,
                "a part is damaged or cut off; its values are missing",
            ),
        };
        if matches!(self.damage[channel], known if known == damage || known == Damage::Contradicted)
        {
            return;
        }
        self.damage[channel] = damage;
        self.notes
            .push(Note::of(&self.channels[channel].name, text.to_string()));
    }
}

/// What the metadata of a file states of its columns.
#[derive(Default)]
struct About {
    columns: Vec<(String, String, String)>,
}

impl About {
    fn of(metadata: &ParquetMetaData) -> About {
        let mut about = About::default();
        let pairs = metadata.file_metadata().key_value_metadata();
        for KeyValue { key, value, .. } in pairs.into_iter().flatten() {
            let Some(value) = value else {
                continue;
            };
            match key.as_str() {
                COLUMNS => about.take_json(value),
                arrow_schema::KEY => about.take_schema(value),
                _ => {}
            }
        }
        about
    }

    fn take_json(&mut self, text: &str) {
        let columns: serde_json::Value = serde_json::from_str(text).unwrap_or_default();
        for column in columns.as_array().into_iter().flatten() {
            let text = |key: &str| column[key].as_str().unwrap_or("").to_string();
            self.columns
                .push((text("name"), text("unit"), text("meaning")));
        }
    }

    fn take_schema(&mut self, text: &str) {
        for (name, metadata) in arrow_schema::decoded(text).unwrap_or_default() {
            let find = |keys: [&str; 3]| {
                let entry = metadata
                    .iter()
                    .find(|(key, _)| keys.contains(&key.as_str()));
                entry.map(|(_, value)| value.clone()).unwrap_or_default()
            };
            let unit = find(["unit", "units", "Unit"]);
            let meaning = find(["meaning", "description", "comment"]);
            if !unit.is_empty() || !meaning.is_empty() {
                self.columns.push((name, unit, meaning));
            }
        }
    }

    /// Unit and meaning of a column.
    fn column(&self, name: &str) -> (String, String) {
        let known = self.columns.iter().find(|(known, ..)| known == name);
        known.map_or_else(Default::default, |(_, unit, meaning)| {
            (unit.trim().to_string(), meaning.clone())
        })
    }
}

impl<S: Read + Seek + Send + 'static> Recording for Parquet<S> {
    contents!(self, &self.path, self);

    fn contradicts_checksum(&self, channel: usize) -> bool {
        self.damage.get(channel) == Some(&Damage::Contradicted)
    }

    fn fill(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<usize, FileError> {
        let there = values.len();
        let Column { kind, origin, .. } = self.columns[channel];
        values.fill(f64::NAN);
        let mut done = 0;
        while done < there {
            let (group, row) = self.group_of(first + done as u64);
            let left = self.starts[group + 1] - self.starts[group] - row;
            let here = left.min((there - done) as u64) as usize;
            let target = &mut values[done..done + here];
            done += here;
            let mut cursor = self.cursor(channel, group, row);
            let read = match &mut cursor {
                Some(cursor) => guarded(|| match cursor.go_to(row)? {
                    true => cursor.numbers(kind, origin, target),
                    false => Ok(0),
                }),
                None => Ok(0),
            };
            let whole = read == Ok(here);
            let kept = cursor.filter(|_| whole);
            if !whole {
                self.tell_damage(channel, read.err().as_deref().unwrap_or_default());
            }
            self.keep(channel, group, kept);
        }
        Ok(there)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn a_hook_knows_which_panics_are_caught() {
        // Bits: 1, a caught panic was said to be caught; 2, another one was said to be caught.
        let seen = Arc::new(AtomicUsize::new(0));
        let flags = seen.clone();
        let own = std::thread::current().id();
        let before = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            // Tests on other threads may fail meanwhile.
            if std::thread::current().id() != own {
                return;
            }
            let text = panic.payload().downcast_ref::<&str>().copied();
            let bit = if text == Some("inside") { 1 } else { 2 };
            if panic_is_caught() {
                flags.fetch_or(bit, Ordering::Relaxed);
            }
        }));
        let inside: Result<(), String> = guarded(|| panic!("inside"));
        let outside = catch_unwind(|| panic!("outside"));
        std::panic::set_hook(before);
        assert_eq!(inside, Err("is damaged".to_string()));
        assert!(outside.is_err() && !panic_is_caught());
        assert_eq!(seen.load(Ordering::Relaxed), 1);
    }
}
