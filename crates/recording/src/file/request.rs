//! What a reader answers to a request that its file cannot fulfil.

use std::path::Path;

use crate::{Channel, Content, FileError};

/// The error where numbers are asked for: the channel is not there, or holds texts.
pub(crate) fn refuse_number(path: &Path, channel: usize, channels: &[Channel]) -> FileError {
    match channels.get(channel) {
        Some(channel) => FileError::new(
            path,
            format!("channel {}", channel.name),
            "holds texts, not numbers",
            "",
        ),
        None => missing(path, channel, channels.len()),
    }
}

/// The error where texts are asked for: the channel is not there, or holds numbers.
pub(crate) fn refuse_text(path: &Path, channel: usize, channels: &[Channel]) -> FileError {
    match channels.get(channel) {
        Some(channel) if channel.content != Content::Text => FileError::new(
            path,
            format!("channel {}", channel.name),
            "holds numbers, not texts",
            "",
        ),
        _ => missing(path, channel, channels.len()),
    }
}

fn missing(path: &Path, channel: usize, count: usize) -> FileError {
    FileError::new(
        path,
        format!("channel {channel}"),
        format!("is not there; the file has {count} channels, counted from 0"),
        "",
    )
}
