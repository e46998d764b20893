//! What a measurement file holds: channels with name, unit and clock, and values that are read in pieces.
//!
//! A recording may be larger than the memory: a reader keeps an index of the file, and [`Recording::read`] brings the
//! piece that is asked for. What could not be read is reported in [`Recording::notes`], never silently left out.

#![forbid(unsafe_code)]

#[cfg(feature = "files")]
pub mod file;
mod find;
pub mod over_time;
pub mod unit;

pub use find::{NoChannel, find};
use std::fmt;
use std::path::{Path, PathBuf};

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
    /// The file does not state it.
    Unknown,
}

/// What the values of a channel are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// Numbers, for [`Recording::read`]; whole numbers too, which are exact up to 2⁵³.
    Number,
    /// Instants, for [`Recording::read`] as seconds after the channel's [`Channel::start`].
    Time,
    /// Texts, which are not read.
    Text,
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
    /// What the values are.
    pub content: Content,
    /// Number of values that can be read.
    pub count: u64,
    /// The instant from which the clock counts, where the file states it.
    pub start: Option<Instant>,
    /// When the values were taken.
    pub clock: Clock,
}

impl Channel {
    /// A channel of `count` numbers, of which the file states no more than the name.
    pub fn new(name: impl Into<String>, count: u64) -> Channel {
        Channel {
            name: name.into(),
            unit: String::new(),
            description: String::new(),
            content: Content::Number,
            count,
            start: None,
            clock: Clock::Unknown,
        }
    }
}

/// Opens a measurement file, recognised by its content.
#[cfg(feature = "files")]
pub use file::open;

/// Opens no file: formats are read by the feature `files`.
#[cfg(not(feature = "files"))]
pub fn open(path: &Path) -> Result<Box<dyn Recording>, FileError> {
    Err(FileError::without(path, "measurement", "files"))
}

/// Something a reader found wrong with a file, or repaired, or left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Name of the channel; none where it concerns the file.
    pub channel: Option<String>,
    /// What was found, and what the reader did about it.
    pub text: String,
}

impl Note {
    /// A note of the file.
    pub fn of_file(text: impl Into<String>) -> Note {
        let (channel, text) = (None, text.into());
        Note { channel, text }
    }

    /// A note of a channel; of the file where the name is empty.
    pub fn of(channel: &str, text: impl Into<String>) -> Note {
        let text = text.into();
        let channel = (!channel.is_empty()).then(|| channel.to_string());
        Note { channel, text }
    }
}

/// A measurement file that is open for reading.
pub trait Recording {
    /// Channels in the order of the file.
    fn channels(&self) -> &[Channel];

    /// What was wrong with the file as far as it was read.
    fn notes(&self) -> &[Note];

    /// Whether values of a channel that were read contradict a checksum of the file. They were given as NaN, but a file that
    /// is damaged in one place may be in others that no checksum covers.
    fn contradicts_checksum(&self, _channel: usize) -> bool {
        false
    }

    /// The file, which errors name.
    fn path(&self) -> &Path;

    /// Fills `values`, which are not more than the channel of numbers has from the index `first` on; returns how many there were.
    fn fill(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<usize, FileError>;

    /// Fills `values` with values of a channel from the index `first` on; a gap in the file is NaN.
    ///
    /// Returns how many there were: fewer than asked at the end of the channel only.
    /// A channel that the recording does not have, or one of text, is an error.
    fn read(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<usize, FileError> {
        let refused =
            |place: String, found: String| Err(FileError::new(self.path(), place, found, ""));
        let count = match self.channels().get(channel) {
            Some(known) if known.content != Content::Text => known.count,
            Some(known) => {
                let place = format!("channel {}", known.name);
                return refused(place, "holds texts, not numbers".to_string());
            }
            None => {
                let count = self.channels().len();
                let found = format!("is not there; the file has {count} channels, counted from 0");
                return refused(format!("channel {channel}"), found);
            }
        };
        match count.saturating_sub(first).min(values.len() as u64) as usize {
            0 => Ok(0),
            there => self.fill(channel, first, &mut values[..there]),
        }
    }
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

impl FileError {
    /// An error that concerns a place in a file.
    pub fn new(
        path: &Path,
        place: impl Into<String>,
        found: impl Into<String>,
        needed: impl Into<String>,
    ) -> FileError {
        FileError {
            path: path.to_owned(),
            place: place.into(),
            found: found.into(),
            needed: needed.into(),
        }
    }

    /// An error where this build has no reader of such a file.
    pub(crate) fn without(path: &Path, format: &str, feature: &str) -> FileError {
        let found = format!("is a {format} file, which this build does not read");
        let needed = format!("a build with the feature {feature} is needed");
        FileError::new(path, "", found, needed)
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_format_that_is_not_built_in_names_its_feature() {
        let refused = FileError::without(Path::new("a.wav"), "WAV", "wav").to_string();
        assert_eq!(
            refused,
            "a.wav: is a WAV file, which this build does not read; a build with the feature wav is needed"
        );
    }
}
