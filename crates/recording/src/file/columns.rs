//! What a table needs of channels: one clock, one length, numbers only.

use std::path::Path;

use super::clock::is_time_name;
use crate::{Channel, Clock, Content, FileError};

/// The column of times that a table needs beside its channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Times {
    pub first: f64,
    pub interval: f64,
}

impl Times {
    /// The time of a row, s.
    pub fn at(&self, row: u64) -> f64 {
        self.first + row as f64 * self.interval
    }
}

/// The column of times that the channels need as a table; none where they have one, or no clock.
///
/// An error where a channel holds texts, or the channels have different clocks.
pub(crate) fn times(path: &Path, channels: &[Channel]) -> Result<Option<Times>, FileError> {
    let Some(one) = channels.first() else {
        let found = "cannot be written: there is no channel";
        return Err(FileError::new(path, "", found, ""));
    };
    for channel in channels {
        let place = || format!("channel {}", channel.name);
        if channel.content == Content::Text {
            let needed = "leave it out: a table of numbers is written";
            return Err(FileError::new(path, place(), "holds texts", needed));
        }
        if channel.clock != one.clock {
            let found = format!("has another clock than {}", one.name);
            let needed = "write channels of one clock into one file";
            return Err(FileError::new(path, place(), found, needed));
        }
    }
    let has_times = channels.iter().any(|channel| is_time_name(&channel.name));
    Ok(match one.clock {
        Clock::Uniform { first, interval } if !has_times => Some(Times { first, interval }),
        _ => None,
    })
}

/// Number of rows of the values; an error where they are not one slice of one length for each channel.
pub(crate) fn rows(
    path: &Path,
    channels: &[Channel],
    values: &[&[f64]],
) -> Result<usize, FileError> {
    if values.len() != channels.len() {
        let (given, wanted) = (values.len(), channels.len());
        let found = format!("{given} slices of values for {wanted} channels");
        return Err(FileError::new(path, "", found, "give one for each channel"));
    }
    let rows = values.first().map_or(0, |slice| slice.len());
    for (channel, slice) in channels.iter().zip(values) {
        if slice.len() != rows {
            let place = format!("channel {}", channel.name);
            let found = format!("{} values, {rows} of {}", slice.len(), channels[0].name);
            let needed = "the columns of a table have one length";
            return Err(FileError::new(path, place, found, needed));
        }
    }
    Ok(rows)
}
