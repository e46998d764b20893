//! Writes TDMS: double precision, little-endian, a segment for every piece.

use std::collections::HashSet;
use std::io::{self, Write};
use std::path::Path;

use super::kind::EPOCH;
use crate::file::draft::Draft;
use crate::file::writer::Writer;
use crate::file::{Property, Value};
use crate::{Channel, Clock, Content, FileError, Instant};

/// Values that are gathered before a segment is written.
const GATHER: usize = 1 << 17;

/// Version of the format that is written: 2.0.
const VERSION: u32 = 4713;

/// Group of a channel whose name has none.
const GROUP: &str = "Untitled";

/// Writes channels to a TDMS file.
#[derive(Debug)]
pub struct TdmsWriter {
    draft: Draft,
    channels: Vec<Channel>,
    gathered: Vec<Vec<f64>>,
    /// Values of each channel in the segment before; none before the first.
    counts: Option<Vec<usize>>,
}

impl TdmsWriter {
    /// Starts a file of the channels; `group/name` is written as group and channel, a name alone into the group
    /// `Untitled`.
    ///
    /// Name, unit, description, start and uniform clock are kept; texts cannot be written, and two channels of
    /// one name are an error.
    pub fn create(path: &Path, channels: &[Channel]) -> Result<TdmsWriter, FileError> {
        let mut paths = HashSet::new();
        for channel in channels {
            let place = format!("channel '{}'", channel.name);
            if channel.content == Content::Text {
                let needed = "only numbers can be written to TDMS";
                return Err(FileError::new(path, place, "holds texts", needed));
            }
            if !paths.insert(path_of(&channel.name)) {
                let needed = "give each channel its own name";
                return Err(FileError::new(path, place, "is there twice", needed));
            }
        }
        let gathered = vec![Vec::new(); channels.len()];
        Ok(TdmsWriter {
            draft: Draft::create(path)?,
            channels: channels.to_vec(),
            gathered,
            counts: None,
        })
    }

    /// Writes what is gathered as a segment.
    fn flush(&mut self) -> io::Result<()> {
        let counts: Vec<usize> = self.gathered.iter().map(Vec::len).collect();
        let bytes = counts.iter().sum::<usize>() * 8;
        let first = self.counts.is_none();
        if bytes == 0 && !first {
            return Ok(());
        }
        let mut meta = Vec::new();
        // A segment as long as the one before needs no meta data: they are repeated.
        let repeats = self.counts.as_ref() == Some(&counts);
        if !repeats {
            self.meta_data(&mut meta, &counts, first);
        }
        let flags = if repeats { 0 } else { 1 << 1 | 1 << 2 } | if bytes > 0 { 1 << 3 } else { 0 };
        self.draft.write_all(b"TDSm")?;
        self.draft.write_all(&u32::to_le_bytes(flags))?;
        self.draft.write_all(&VERSION.to_le_bytes())?;
        self.draft
            .write_all(&((meta.len() + bytes) as u64).to_le_bytes())?;
        self.draft.write_all(&(meta.len() as u64).to_le_bytes())?;
        self.draft.write_all(&meta)?;
        for values in &mut self.gathered {
            for value in values.iter() {
                self.draft.write_all(&value.to_le_bytes())?;
            }
            values.clear();
        }
        self.counts = Some(counts);
        Ok(())
    }

    /// The meta data of a segment; with properties in the first only.
    fn meta_data(&self, out: &mut Vec<u8>, counts: &[usize], with_properties: bool) {
        let mut owners: Vec<String> = Vec::new();
        if with_properties {
            owners.push("/".to_owned());
            for channel in &self.channels {
                let group = format!("/{}", quoted(split(&channel.name).0));
                if !owners.contains(&group) {
                    owners.push(group);
                }
            }
        }
        out.extend(((owners.len() + self.channels.len()) as u32).to_le_bytes());
        for owner in owners {
            put_text(out, &owner);
            out.extend(u32::MAX.to_le_bytes());
            out.extend(0u32.to_le_bytes());
        }
        for (channel, &count) in self.channels.iter().zip(counts) {
            put_text(out, &path_of(&channel.name));
            if count == 0 {
                out.extend(u32::MAX.to_le_bytes());
            } else {
                // Length of this index, type, dimension, number of values.
                for number in [20u32, 10, 1] {
                    out.extend(number.to_le_bytes());
                }
                out.extend((count as u64).to_le_bytes());
            }
            let properties = if with_properties {
                properties(channel)
            } else {
                Vec::new()
            };
            out.extend((properties.len() as u32).to_le_bytes());
            for property in properties {
                put_property(out, &property);
            }
        }
    }
}

impl Writer for TdmsWriter {
    fn append(&mut self, values: &[&[f64]]) -> Result<(), FileError> {
        if values.len() != self.gathered.len() {
            let found = format!(
                "{} channels are given for {}",
                values.len(),
                self.gathered.len()
            );
            let (path, needed) = (self.draft.path(), "one slice for each channel");
            return Err(FileError::new(path, "", found, needed));
        }
        let longest = values.iter().map(|values| values.len()).max().unwrap_or(0);
        // Pieces, so that a long append does not double what is in memory.
        let piece = (GATHER / values.len().max(1)).max(1);
        for start in (0..longest).step_by(piece) {
            for (gathered, values) in self.gathered.iter_mut().zip(values) {
                let end = values.len().min(start + piece);
                gathered.extend_from_slice(values.get(start..end).unwrap_or(&[]));
            }
            if self.gathered.iter().map(Vec::len).sum::<usize>() >= GATHER {
                self.flush().map_err(|e| self.draft.error(&e))?;
            }
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> Result<(), FileError> {
        self.flush().map_err(|e| self.draft.error(&e))?;
        self.draft.finish()
    }
}

/// Group and name of a channel.
fn split(name: &str) -> (&str, &str) {
    name.split_once('/')
        .filter(|(group, name)| !group.is_empty() && !name.is_empty())
        .unwrap_or((GROUP, name))
}

/// A name as it stands in a path.
fn quoted(name: &str) -> String {
    format!("'{}'", name.replace('\'', "''"))
}

/// The path of a channel.
fn path_of(name: &str) -> String {
    let (group, name) = split(name);
    format!("/{}/{}", quoted(group), quoted(name))
}

/// The properties of a channel in the format's own names.
fn properties(channel: &Channel) -> Vec<Property> {
    let mut properties = Vec::new();
    let mut put = |name: &str, value| {
        properties.push(Property {
            name: name.to_owned(),
            value,
        })
    };
    if !channel.unit.is_empty() {
        put("unit_string", Value::Text(channel.unit.clone()));
    }
    if !channel.description.is_empty() {
        put("description", Value::Text(channel.description.clone()));
    }
    if let Some(start) = channel.start {
        put("wf_start_time", Value::Time(start));
    }
    if let Clock::Uniform { first, interval } = channel.clock {
        put("wf_start_offset", Value::Number(first));
        put("wf_increment", Value::Number(interval));
    }
    properties
}

fn put_text(out: &mut Vec<u8>, text: &str) {
    out.extend((text.len() as u32).to_le_bytes());
    out.extend(text.as_bytes());
}

fn put_property(out: &mut Vec<u8>, property: &Property) {
    put_text(out, &property.name);
    match &property.value {
        Value::Number(number) => {
            out.extend(10u32.to_le_bytes());
            out.extend(number.to_le_bytes());
        }
        Value::Text(text) => {
            out.extend(0x20u32.to_le_bytes());
            put_text(out, text);
        }
        Value::Time(Instant { seconds, fraction }) => {
            out.extend(0x44u32.to_le_bytes());
            // 2⁶⁴ parts of a second; the conversion keeps the range.
            let parts = (fraction * 18_446_744_073_709_551_616.0) as u64;
            out.extend(parts.to_le_bytes());
            out.extend(seconds.saturating_add(EPOCH).to_le_bytes());
        }
    }
}
