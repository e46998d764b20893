//! WAV: reader for RIFF, RIFX (big-endian), RF64 and BW64.
//!
//! ```text
//! file = head, chunk, chunk, …        chunk = name (4 bytes), length (4 bytes), content, a byte to make it even
//! ```
//! The chunk `fmt ` states rate, channels and type, the chunk `data` holds the values, one of each channel after the other.
//! Whole numbers are brought to the range −1 to below 1, as other programs do; 8 bits are unsigned. Start and remarks
//! (chunks `LIST` and `bext`, whose date has no zone) are not read.
//!
//! Source: Microsoft and IBM, "Multimedia Programming Interface and Data Specifications 1.0" (1991); Microsoft,
//! "Multiple channel audio data and WAVE files" (extensible format); EBU Tech 3306 (RF64) (all from memory).

use std::io::{Read, Seek};
use std::path::Path;

use super::source::{Source, WINDOW};
use super::{is_wav, keep_note, number};
use crate::{Channel, Clock, FileError, Note, Recording};

/// The type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Unsigned, 8 bits; 128 is zero.
    Unsigned8,
    /// Signed, of 2 to 4 bytes.
    Signed(u8),
    Single,
    Double,
}

impl Kind {
    /// Bytes of a value.
    fn size(self) -> u64 {
        match self {
            Kind::Unsigned8 => 1,
            Kind::Signed(bytes) => u64::from(bytes),
            Kind::Single => 4,
            Kind::Double => 8,
        }
    }
}

/// What the chunk `fmt ` states.
#[derive(Clone, Copy, Debug)]
struct Layout {
    kind: Kind,
    channels: u16,
    /// Values of a channel per second.
    rate: u32,
    /// Bytes of a value of each channel.
    row: u64,
    big: bool,
}

/// A WAV file that is open for reading.
#[derive(Debug)]
pub struct Wav<S> {
    source: Source<S>,
    layout: Layout,
    /// Byte where the values begin.
    at: u64,
    channels: Vec<Channel>,
    notes: Vec<Note>,
}

/// The chunks of a file as far as they matter.
#[derive(Default)]
struct Chunks {
    layout: Option<Layout>,
    /// Byte and length of the values.
    data: Option<(u64, u64)>,
    /// Length of the values in 8 bytes, where the 4 bytes do not hold it.
    long: Option<u64>,
    notes: Vec<Note>,
}

impl<S: Read + Seek> Wav<S> {
    /// Reads the head of a file, which `path` names in messages.
    ///
    /// An error where it is no WAV, states no type of values that can be read, or has no values.
    pub fn from_source(source: S, path: &Path) -> Result<Wav<S>, FileError> {
        let mut source = Source::new(source, path)?;
        let head = source.bytes(0, source.length().min(12))?;
        if !is_wav(&head) {
            return Err(source.error(
                0,
                "is no WAV: the first letters are not RIFF … WAVE",
                "a WAV file",
            ));
        }
        let big = head.starts_with(b"RIFX");
        let chunks = Chunks::of(&mut source, big)?;
        let Some(layout) = chunks.layout else {
            let what = "does not state the type of its values: the chunk 'fmt ' is missing";
            return Err(FileError::new(path, "", what, "a whole file"));
        };
        let Some((at, length)) = chunks.data else {
            let what = "has no values: the chunk 'data' is missing";
            return Err(FileError::new(path, "", what, "a whole file"));
        };
        let mut notes = chunks.notes;
        if length % layout.row != 0 {
            notes.push(Note::of_file(
                "the values end in the middle of a row: the rest is left out",
            ));
        }
        let mut channels = Vec::new();
        for number in 1..=layout.channels {
            let mut channel = Channel::new(format!("{number}"), length / layout.row);
            channel.clock = Clock::Uniform {
                first: 0.0,
                interval: 1.0 / f64::from(layout.rate),
            };
            channels.push(channel);
        }
        Ok(Wav {
            source,
            layout,
            at,
            channels,
            notes,
        })
    }
}

impl Chunks {
    /// Reads the chunks until the values and what they need are found, or the file ends.
    fn of<S: Read + Seek>(source: &mut Source<S>, big: bool) -> Result<Chunks, FileError> {
        let mut chunks = Chunks::default();
        let mut at = 12;
        while at < source.length() {
            if source.length() - at < 8 {
                chunks.note("the file ends in the head of a chunk");
                break;
            }
            let Some((&name, stated)) = source.window(at, 8)?.split_first_chunk::<4>() else {
                break;
            };
            let stated = number::bits(stated, big);
            let body = at + 8;
            let there = source.length() - body;
            let stated = match chunks.long {
                Some(long) if &name == b"data" && stated == u64::from(u32::MAX) => long,
                _ => stated,
            };
            let length = stated.min(there);
            match &name {
                b"ds64" => {
                    let bytes = source.bytes(body, length.min(24))?;
                    let long = bytes.get(8..16).and_then(|raw| raw.first_chunk::<8>());
                    chunks.long = long.map(|raw| u64::from_le_bytes(*raw));
                }
                b"fmt " => {
                    let bytes = source.bytes(body, length.min(40))?;
                    chunks.layout = Some(layout(&bytes, big).map_err(|why| {
                        source.error(
                            body,
                            why,
                            "whole numbers of 8 to 32 bits, or floating point of 32 or 64",
                        )
                    })?);
                }
                b"data" if chunks.data.is_none() => {
                    chunks.data = Some((body, chunks.values(stated, there)))
                }
                b"data" => chunks.note("has a second chunk of values, which is left out"),
                _ => {}
            }
            // Chunks begin at even places.
            at = body.saturating_add(stated).saturating_add(stated % 2);
        }
        Ok(chunks)
    }

    fn note(&mut self, text: impl Into<String>) {
        keep_note(&mut self.notes, Note::of_file(text));
    }

    /// Bytes of values that can be read where `stated` are stated and `there` are there.
    fn values(&mut self, stated: u64, there: u64) -> u64 {
        if stated == u64::from(u32::MAX) || (stated == 0 && there > 0) {
            self.note("the length of the values was never entered: what is there is read");
            return there;
        }
        if stated > there {
            self.note(format!(
                "the values are cut off: {stated} bytes are stated, {there} are there"
            ));
        }
        stated.min(there)
    }
}

/// What the chunk `fmt ` states; or why its values cannot be read.
fn layout(bytes: &[u8], big: bool) -> Result<Layout, String> {
    let short = |at: usize| -> Result<u16, String> {
        let raw = bytes.get(at..at + 2);
        let raw = raw.ok_or("the chunk 'fmt ' is cut off")?;
        Ok(number::bits(raw, big) as u16)
    };
    let (low, high) = (
        u32::from(short(if big { 6 } else { 4 })?),
        u32::from(short(if big { 4 } else { 6 })?),
    );
    let rate = high << 16 | low;
    let (channels, row, bits) = (short(2)?, u64::from(short(12)?), short(14)?);
    // The extensible format has the type in the first bytes of its identifier.
    let code = match short(0)? {
        0xfffe => short(24)?,
        code => code,
    };
    if channels == 0 || rate == 0 {
        return Err(format!(
            "the chunk 'fmt ' states {channels} channels at {rate} 1/s"
        ));
    }
    // Values are as wide as their place in a row: 20 bits stand in 24.
    let bytes = match row / u64::from(channels) {
        0 => u64::from(bits).div_ceil(8),
        bytes => bytes,
    };
    let kind = match (code, bytes) {
        (1, 1) => Kind::Unsigned8,
        (1, 2..=4) => Kind::Signed(bytes as u8),
        (3, 4) => Kind::Single,
        (3, 8) => Kind::Double,
        _ => {
            return Err(format!(
                "values of type {code:#x} with {bits} bits in {bytes} bytes cannot be read"
            ));
        }
    };
    Ok(Layout {
        kind,
        channels,
        rate,
        row: row.max(kind.size() * u64::from(channels)),
        big,
    })
}

/// Brings values to doubles: one every `row` bytes.
fn decode(layout: &Layout, bytes: &[u8], values: &mut [f64]) {
    let rows = bytes.chunks(usize::try_from(layout.row).unwrap_or(usize::MAX).max(1));
    for (value, at) in values.iter_mut().zip(rows) {
        let size = layout.kind.size() as usize;
        let Some(raw) = at.get(..size) else { return };
        let whole = number::bits(raw, layout.big);
        *value = match layout.kind {
            Kind::Unsigned8 => (whole as f64 - 128.0) / 128.0,
            Kind::Signed(bytes) => {
                let shift = 64 - 8 * u32::from(bytes);
                // The sign bit goes to the top: the full range is then that of 64 bits.
                ((whole << shift) as i64) as f64 / 9_223_372_036_854_775_808.0
            }
            Kind::Single | Kind::Double => number::float(whole, size),
        };
    }
}

impl<S: Read + Seek> Recording for Wav<S> {
    contents!(self, self.source.path(), self);

    fn fill(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<usize, FileError> {
        let (row, size) = (self.layout.row, self.layout.kind.size());
        let most = ((WINDOW as u64 - size) / row + 1) as usize;
        let mut at = self.at + first * row + channel as u64 * size;
        for some in values.chunks_mut(most) {
            let needed = (some.len() as u64 - 1) * row + size;
            decode(&self.layout, self.source.window(at, needed as usize)?, some);
            at += some.len() as u64 * row;
        }
        Ok(values.len())
    }
}
