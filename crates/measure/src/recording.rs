//! What a measurement file holds: channels with name, unit and clock, and values that are read in pieces.
//!
//! A recording may be larger than the memory: a reader keeps an index of the file, and [`Recording::read`] brings the
//! piece that is asked for. What could not be read is told in [`Recording::notes`], never silently left out.

use std::fmt;
use std::path::PathBuf;

/// An instant of the calendar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Whole seconds since 1970-01-01 00:00:00 UTC.
    pub seconds: i64,
    /// The rest, s, from 0 to below 1.
    pub fraction: f64,
}

/// When the values of a channel were taken.
#[derive(Clone, Debug, PartialEq)]
pub enum Clock {
    /// At equal intervals.
    Uniform {
        /// Time of the first value after the start, s.
        first: f64,
        /// Interval, s; positive.
        interval: f64,
    },
    /// At the values of another channel of the same recording, by its index; in that channel's unit.
    Channel(usize),
    /// The file does not tell.
    Unknown,
}

/// One channel of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Name as in the file; with its group as `group/name` where the file has groups.
    pub name: String,
    /// Unit as in the file; empty where the file gives none.
    pub unit: String,
    /// Remark as in the file; may be empty.
    pub description: String,
    /// Number of values that can be read.
    pub count: u64,
    /// When the first value was taken, where the file tells.
    pub start: Option<Instant>,
    /// When the values were taken.
    pub clock: Clock,
}

/// Something a reader found wrong with a file, or repaired, or left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Name of the channel; none where it concerns the file.
    pub channel: Option<String>,
    /// What was found, and what the reader did about it.
    pub text: String,
}

/// A measurement file that is open for reading.
pub trait Recording {
    /// Channels in the order of the file.
    fn channels(&self) -> &[Channel];

    /// What was wrong with the file as far as it was read.
    fn notes(&self) -> &[Note];

    /// Fills `values` with values of a channel from the index `first` on; a gap in the file is NaN.
    ///
    /// Returns how many there were: fewer than asked at the end of the channel only.
    fn read(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<usize, FileError>;
}

/// Why a file, or a channel of it, cannot be read or written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileError {
    /// The file.
    pub path: PathBuf,
    /// Where in it: a channel, a line, a byte; empty for the file as a whole.
    pub place: String,
    /// What was found.
    pub found: String,
    /// What is needed, or what can be done; may be empty.
    pub needed: String,
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if !self.place.is_empty() {
            write!(f, ", {}", self.place)?;
        }
        write!(f, ": {}", self.found)?;
        if !self.needed.is_empty() {
            write!(f, "; {}", self.needed)?;
        }
        Ok(())
    }
}

impl std::error::Error for FileError {}
