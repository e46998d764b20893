//! The formats of measurement files.
//!
//! A format is recognised by its content, not by the name of its file. Each format has its module, and one row in the
//! table of this file; a reader is given any source of bytes, so that it reads memory as well as files.
//!
//! | module | what it does |
//! |---|---|
//! | [`source`] | bytes of a file, read at a place, with errors that name the file |
//! | [`draft`] | a file that carries its name only once it is whole |
//! | [`tdms`] | TDMS of National Instruments: reader and writer |
//! | [`csv`] | text in columns: reader and writer |
//! | [`mat5`] | MATLAB up to 7.2, and level 4: reader |
//! | [`hdf5`] | HDF5 and MATLAB 7.3: reader |
//! | [`parquet`] | Apache Parquet: reader and writer |
//! | [`uff`] | the universal file format, sets 58 and 58b: reader |
//! | [`wav`] | WAV: reader |

/// What a reader says of its file: where it keeps the path, and what holds notes.
macro_rules! contents {
    ($self:ident, $path:expr, $of:expr) => {
        fn path(&$self) -> &std::path::Path {
            $path
        }
        fn channels(&$self) -> &[$crate::Channel] {
            &$self.channels
        }
        fn notes(&$self) -> &[$crate::Note] {
            &$of.notes
        }
    };
}

/// Shows a reader by its channels and notes.
macro_rules! shown_by_contents {
    ($Reader:ident) => {
        impl<S> std::fmt::Debug for $Reader<S> {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.debug_struct(stringify!($Reader))
                    .field("channels", &self.channels)
                    .field("notes", &self.notes)
                    .finish_non_exhaustive()
            }
        }
    };
}

/// What is noted of a channel once values of it could not be read.
const DAMAGED_PART: &str = "a part is damaged or cut off; its values are not-a-number";

/// Most notes of a file that are kept: a broken one would else fill the memory with them.
const NOTES: usize = 100;

/// What a file states beside the values, of itself or of a channel, that a clock, a unit or a scale may follow from.
#[derive(Clone, Debug, PartialEq)]
struct Property {
    name: String,
    value: Value,
}

/// The value of a [`Property`].
#[derive(Clone, Debug, PartialEq)]
enum Value {
    /// A number, in the file's unit.
    Number(f64),
    /// An instant.
    Time(Instant),
    /// A text.
    Text(String),
}

/// Keeps a note unless it is there, or there are many.
fn keep_note(notes: &mut Vec<Note>, note: Note) {
    if notes.len() > NOTES || notes.contains(&note) {
        return;
    }
    let many = || Note::of_file("more was found that is not listed");
    let note = if notes.len() == NOTES { many() } else { note };
    notes.push(note);
}

mod clock;
mod columns;
pub mod csv;
pub mod draft;
pub mod hdf5;
pub mod mat5;
mod number;
pub mod parquet;
pub mod source;
pub mod tdms;
#[cfg(feature = "uff")]
pub mod uff;
#[cfg(feature = "wav")]
pub mod wav;
mod writer;

pub use writer::Writer;

use std::fmt;
use std::fs::File;
use std::path::Path;

use crate::{Channel, FileError, Instant, Note, Recording};
use problem::open_file;

/// A format of measurement files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// TDMS of National Instruments, both byte orders.
    Tdms,
    /// Universal file format: sets 58 (text) and 58b (binary).
    Uff,
    /// Text in columns.
    Csv,
    /// MATLAB's format of version 5, up to 7.2, or of level 4.
    Mat5,
    /// HDF5, which MATLAB's format of version 7.3 is too.
    Hdf5,
    /// Apache Parquet.
    Parquet,
    /// WAV: RIFF, RIFX, RF64 or BW64.
    Wav,
}

impl Format {
    /// What people call the format.
    pub fn name(self) -> &'static str {
        match self {
            Format::Tdms => "TDMS",
            Format::Uff => "UFF 58",
            Format::Csv => "CSV",
            Format::Mat5 => "MAT 4 or 5",
            Format::Hdf5 => "HDF5 or MAT 7.3",
            Format::Parquet => "Parquet",
            Format::Wav => "WAV",
        }
    }

    /// Recognises the format by the first bytes of a file; none where they are of no format that is known.
    pub fn of(head: &[u8]) -> Option<Format> {
        let row = FORMATS.iter().find(|row| (row.recognise)(head));
        row.map(|row| row.format)
    }

    /// Which formats a file of this name would be of, going by its extension.
    fn promised_by(path: &Path) -> &'static [Format] {
        match extension(path).as_str() {
            "tdms" => &[Format::Tdms],
            "uff" | "unv" => &[Format::Uff],
            "mat" => &[Format::Mat5, Format::Hdf5],
            "h5" | "hdf5" | "hdf" => &[Format::Hdf5],
            "parquet" => &[Format::Parquet],
            "wav" | "wave" => &[Format::Wav],
            _ => &[],
        }
    }
}

/// What the name of a file ends with, in lower case.
fn extension(path: &Path) -> String {
    let end = path.extension().and_then(|end| end.to_str());
    end.unwrap_or_default().to_ascii_lowercase()
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Opens a file, which the path names in messages.
type Open = fn(File, &Path) -> Result<Box<dyn Recording>, FileError>;

/// One format: how it is recognised by its first bytes, and how a file of it is opened, or which feature is missing for that.
struct Row {
    format: Format,
    recognise: fn(&[u8]) -> bool,
    open: Result<Open, &'static str>,
}

/// The row of a format, whose reader has its name; a build without the feature of the reader refuses its files.
macro_rules! row {
    ($Format:ident, $module:ident, $recognise:path $(, $feature:tt)?) => {
        Row {
            format: Format::$Format,
            recognise: $recognise,
            $(#[cfg(feature = $feature)])?
            open: Ok(|file, path| Ok(Box::new($module::$Format::from_source(file, path)?))),
            $(
                #[cfg(not(feature = $feature))]
                open: Err($feature),
            )?
        }
    };
}

/// The formats that can be read, the most certain signature first; text, which has none, is last.
static FORMATS: &[Row] = &[
    row!(Tdms, tdms, tdms::is_tdms),
    row!(Hdf5, hdf5, hdf5::is_hdf5),
    row!(Parquet, parquet, parquet::is_parquet),
    row!(Mat5, mat5, mat5::is_mat5),
    row!(Wav, wav, is_wav, "wav"),
    row!(Uff, uff, is_uff, "uff"),
    row!(Csv, csv, csv::is_csv),
];

/// The names of the formats that can be read, for messages.
fn readable() -> String {
    let rows = FORMATS.iter().filter(|row| row.open.is_ok());
    let names: Vec<&str> = rows.map(|row| row.format.name()).collect();
    format!("files of these formats can be read: {}", names.join(", "))
}

/// Whether a file begins as WAV.
fn is_wav(head: &[u8]) -> bool {
    let names: [&[u8]; 4] = [b"RIFF", b"RIFX", b"RF64", b"BW64"];
    names.iter().any(|name| head.starts_with(name)) && head.get(8..12) == Some(b"WAVE")
}

/// Whether a file begins as one of universal sets.
fn is_uff(head: &[u8]) -> bool {
    let mut lines = head
        .split(|byte| *byte == b'\n')
        .filter(|line| !line.trim_ascii().is_empty());
    // Both stand in the first six columns, at their right end: so a table of whole numbers is not taken for one.
    let indented = |line: &&[u8]| line.starts_with(b"  ");
    let opens = lines.next().filter(indented).is_some_and(is_uff_mark);
    let kind = lines
        .next()
        .filter(indented)
        .map_or(&[][..], |line| line.trim_ascii_start());
    let digits = kind.iter().take_while(|byte| byte.is_ascii_digit()).count();
    opens
        && (1..=5).contains(&digits)
        && matches!(kind.get(digits), None | Some(b' ' | b'\r' | b'b' | b'B'))
}

/// Whether a line opens or closes a set.
fn is_uff_mark(line: &[u8]) -> bool {
    line.trim_ascii() == b"-1"
}

/// Whether the bytes look like text of one byte a letter: no zero byte, and few control characters.
fn is_plain_text(head: &[u8]) -> bool {
    let control = |b: &&u8| b.is_ascii_control() && !b.is_ascii_whitespace();
    let controls = head.iter().filter(control).count();
    !head.is_empty() && !head.contains(&0) && controls * 50 <= head.len()
}

/// Whether they look like any text, UTF-16 with its mark too.
fn is_text(head: &[u8]) -> bool {
    head.starts_with(&[0xff, 0xfe]) || head.starts_with(&[0xfe, 0xff]) || is_plain_text(head)
}

/// Opens a file for reading; its format is recognised by its content.
///
/// An error where the file cannot be opened, is of no readable format, or is text under the name of another format.
pub fn open(path: impl AsRef<Path>) -> Result<Box<dyn Recording>, FileError> {
    opened(path.as_ref())
}

/// As [`open`]: what is not generic is compiled here alone, with the readers of all formats.
fn opened(path: &Path) -> Result<Box<dyn Recording>, FileError> {
    let file = open_file(path)
        .map_err(|e| FileError::new(path, "", format!("cannot be opened ({e})"), ""))?;
    let mut source = source::Source::new(file, path)?;
    let head = source.bytes(0, source.length().min(source::HEAD as u64))?;
    if head.is_empty() {
        return Err(FileError::new(path, "", "is empty", readable()));
    }
    let Some(row) = FORMATS.iter().find(|row| (row.recognise)(&head)) else {
        let what = match (is_text(&head), head.starts_with(b"TDSh")) {
            (true, _) => "is text, but of no format that is known",
            (_, true) => "is the index of a TDMS file, which holds no values",
            _ => "is of no format that is known",
        };
        return Err(FileError::new(path, "", what, readable()));
    };
    let promised = Format::promised_by(path);
    if row.format == Format::Csv && !promised.is_empty() {
        let found = format!("is text, not {} as its name says", promised[0]);
        let needed = format!("rename it if it is a table; {}", readable());
        return Err(FileError::new(path, "", found, needed));
    }
    let without = |feature| FileError::without(path, row.format.name(), feature);
    row.open.map_err(without)?(source.into_inner(), path)
}

/// Starts a file of the channels; the extension of its name decides the format.
///
/// The counts of the channels do not matter: the values that are appended count.
pub fn create(path: impl AsRef<Path>, channels: &[Channel]) -> Result<Box<dyn Writer>, FileError> {
    created(path.as_ref(), channels)
}

/// As [`create`], compiled here alone.
fn created(path: &Path, channels: &[Channel]) -> Result<Box<dyn Writer>, FileError> {
    match extension(path).as_str() {
        "tdms" => Ok(Box::new(tdms::TdmsWriter::create(path, channels)?)),
        "csv" => Ok(Box::new(csv::CsvWriter::create(path, channels)?)),
        "parquet" => Ok(Box::new(parquet::ParquetWriter::create(path, channels)?)),
        _ => {
            let found = "cannot be written: its name has no format that can be";
            let needed = "end the name with: .tdms, .csv, .parquet";
            Err(FileError::new(path, "", found, needed))
        }
    }
}
