//! TDMS, the format of National Instruments' measurement software: reader and writer.
//!
//! ```text
//! file = segment, segment, …        segment = head, meta data, chunk, chunk, …
//! ```
//! The meta data of a segment name objects (the file, groups, channels), set their properties, and state which of them have
//! values in each chunk and how many; a segment that states nothing repeats the one before. So a file can be written as the
//! measurement goes on, and is readable up to the place where a crash cut it.
//!
//! Source: National Instruments, "TDMS File Format Internal Structure" (white paper 5696, 2014); the layout of digital
//! line scalers and the names of the scales' properties from memory, proved on files.
//!
//! What is read: both byte orders, interleaved and contiguous values, whole numbers of 1 to 8 bytes, single, double and
//! complex numbers, flags, texts, time stamps, raw data of DAQmx with its scales. Not read: extended (10 or 16 bytes) and
//! fixed-point numbers. Scales for thermocouples, resistance thermometers, thermistors and strain gauges are reported, not
//! applied.

mod index;
mod kind;
mod layout;
mod meta;
mod scale;
mod write;

pub use write::TdmsWriter;

use std::collections::HashMap;
use std::io::{Read, Seek};
use std::path::Path;
use std::sync::Arc;

use super::Value;
use super::source::{Source, WINDOW};
use crate::{Channel, Clock, Content, FileError, Recording};
use index::{Block, Index, Object};
use kind::{Kind, Stamp, decode, stamp};
use layout::{Layout, PLAIN, Part, Piece};
use scale::Scaling;

/// Most values that are brought at once.
const BATCH: usize = 4096;

/// Whether a file begins as TDMS.
pub fn is_tdms(head: &[u8]) -> bool {
    head.starts_with(b"TDSm")
}

/// Where the values of a channel come from.
#[derive(Debug)]
struct Origin {
    /// The number of the object.
    object: u32,
    /// The imaginary part of complex values.
    imaginary: bool,
    /// How raw values become the channel's.
    scaling: Option<Scaling>,
    /// The first time stamp, for a channel of such.
    start: Stamp,
    /// Where the last piece was read: a block, and the index of its first value.
    last: (usize, u64),
}

/// A TDMS file that is open for reading.
#[derive(Debug)]
pub struct Tdms<S> {
    source: Source<S>,
    index: Index,
    channels: Vec<Channel>,
    origins: Vec<Origin>,
    /// Raw values of the parts of a piece.
    raw: Vec<Vec<f64>>,
}

impl<S: Read + Seek> Tdms<S> {
    /// Reads the index of a file, which `path` names in messages.
    ///
    /// An error only where the first bytes are no TDMS or the system cannot read; whatever else is wrong is a note.
    pub fn from_source(source: S, path: &Path) -> Result<Tdms<S>, FileError> {
        let mut source = Source::new(source, path)?;
        let index = Index::of(&mut source)?;
        let mut file = Tdms {
            source,
            index,
            channels: Vec::new(),
            origins: Vec::new(),
            raw: Vec::new(),
        };
        file.list()?;
        Ok(file)
    }

    /// Lists the channels.
    fn list(&mut self) -> Result<(), FileError> {
        for number in 0..self.index.objects.len() {
            if self.index.objects[number].names.len() > 1 {
                self.list_channel(number as u32)?;
            }
        }
        self.find_clocks();
        Ok(())
    }

    /// Points channels without a clock of their own to the channel of times in their group, where there is one of as many
    /// values.
    fn find_clocks(&mut self) {
        let mut times = HashMap::new();
        for (place, (channel, origin)) in self.channels.iter().zip(&self.origins).enumerate() {
            let names = &self.index.objects[origin.object as usize].names;
            let is_time = |name: &String| ["time", "t"].contains(&&*name.to_ascii_lowercase());
            let called = names.last().is_some_and(is_time) && channel.unit == "s";
            let holds = match channel.content {
                Content::Number => called,
                content => content == Content::Time,
            };
            if let Some(group) = names.first().filter(|_| holds) {
                times.entry((group.clone(), channel.count)).or_insert(place);
            }
        }
        for (place, (channel, origin)) in self.channels.iter_mut().zip(&self.origins).enumerate() {
            let names = &self.index.objects[origin.object as usize].names;
            let group = names.first();
            let time = group.and_then(|group| times.get(&(group.clone(), channel.count)));
            match time {
                Some(&time) if time != place && channel.clock == Clock::Unknown => {
                    channel.clock = Clock::Channel(time);
                }
                _ => {}
            }
        }
    }

    /// Lists the channel of an object; two where its values are complex.
    fn list_channel(&mut self, number: u32) -> Result<(), FileError> {
        let object = &self.index.objects[number as usize];
        let (mut channel, wrong) = describe(object);
        let name = channel.name.clone();
        if let Some(wrong) = wrong {
            self.index.note(Some(name.clone()), wrong);
        }
        let scaling = match self.scaling(number) {
            Ok(scaling) => scaling,
            Err(why) => {
                let text = format!(
                    "its scaling cannot be applied: {why}; it is left out, as the counts of its device are not what was measured"
                );
                self.index.note(Some(name), text);
                return Ok(());
            }
        };
        let coded = |part: &Part| part.scale != PLAIN && !matches!(part.kind, Kind::Bit(_));
        let holds_codes = |piece: &Piece| piece.parts.iter().any(coded);
        let is_coded = self.index.pieces(number).any(holds_codes);
        if scaling.is_none() && is_coded {
            channel.unit.clear();
            let text = "its values are the codes of the device, without a unit: the file states no scaling that is applied";
            self.index.note(Some(name.clone()), text);
        }
        let complex = self.index.objects[number as usize].complex;
        let mut origin = Origin {
            object: number,
            imaginary: false,
            scaling,
            start: (0, 0),
            last: (0, 0),
        };
        if channel.content == Content::Time {
            if let Some(first) = self.first_stamp(number)? {
                origin.start = first;
                channel.start = Some(meta::instant(first));
            }
            channel.unit = "s".to_owned();
        }
        if complex {
            let scaled = match origin.scaling.take() {
                Some(_) => {
                    channel.unit.clear();
                    "; their scaling is not applied, and they have no unit"
                }
                None => "",
            };
            self.index.note(
                Some(name.clone()),
                format!(
                    "its values are complex: they are read as two channels, “{name} (real)” and “{name} (imaginary)”{scaled}"
                ),
            );
            let second = Origin {
                imaginary: true,
                scaling: None,
                ..origin
            };
            let imaginary = Channel {
                name: format!("{name} (imaginary)"),
                ..channel.clone()
            };
            channel.name = format!("{name} (real)");
            self.channels.extend([channel, imaginary]);
            self.origins.extend([origin, second]);
        } else {
            self.channels.push(channel);
            self.origins.push(origin);
        }
        Ok(())
    }

    /// The scaling of a channel: by its own properties, those of its group, or those of the file.
    fn scaling(&self, number: u32) -> Result<Option<Scaling>, String> {
        let objects = &self.index.objects;
        let channel = &objects[number as usize];
        if channel.content != Some(Content::Number) {
            return Ok(None);
        }
        let has_scales = |object: &&Object| object.property("NI_Number_Of_Scales").is_some();
        let above = |names: &[String]| {
            let mut own = objects.iter().filter(|object| object.names == names);
            own.find(has_scales)
        };
        let group = || above(channel.names.get(..1).unwrap_or_default());
        let own = Some(channel).filter(has_scales);
        let Some(object) = own.or_else(group).or_else(|| above(&[])) else {
            return Ok(None);
        };
        let Some(scaling) = Scaling::of(&|name| object.property(name))? else {
            return Ok(None);
        };
        for piece in self.index.pieces(number) {
            let lacks = |scale: &u32| part_of(&piece.parts, *scale).is_none();
            if let Some(scale) = scaling.needs().find(lacks) {
                return Err(format!("scale {scale} has no raw values"));
            }
        }
        Ok(Some(scaling))
    }

    /// The first time stamp of an object.
    fn first_stamp(&mut self, object: u32) -> Result<Option<Stamp>, FileError> {
        for block in &self.index.blocks {
            let layout = self.index.layout(block);
            let layout = layout.filter(|_| self.index.count_in(block, object) > 0);
            let part = layout.and_then(|layout| layout.piece(object)?.parts.first());
            if let (Some(layout), Some(part)) = (layout, part) {
                let at = block.at.saturating_add(part.offset);
                let bytes = self.source.window(at, 16)?;
                return Ok(Some(stamp(bytes, layout.big)));
            }
        }
        Ok(None)
    }

    /// Calls `visit` for each run of values of a channel that lie in one chunk, from the value `first` on for `count`.
    fn runs(
        &mut self,
        channel: usize,
        first: u64,
        count: u64,
        mut visit: impl FnMut(&mut Tdms<S>, Run) -> Result<(), FileError>,
    ) -> Result<(), FileError> {
        let Some(origin) = self.origins.get(channel) else {
            return Ok(());
        };
        let object = origin.object;
        let milestone = self.index.milestone(object, first);
        let (mut number, mut start) = match origin.last.1 <= first {
            true => milestone.max(origin.last),
            false => milestone,
        };
        let mut done = 0;
        while done < count {
            let Some(&block) = self.index.blocks.get(number) else {
                break;
            };
            let there = self.index.count_in(&block, object);
            let within = first + done - start;
            if within >= there {
                (number, start) = (number + 1, start + there);
                continue;
            }
            let Some(layout) = self.index.layout(&block).cloned() else {
                break;
            };
            let Some(piece) = layout.piece(object) else {
                break;
            };
            let (chunk, index) = (within / piece.count, within % piece.count);
            let in_chunk = (there - chunk * piece.count).min(piece.count);
            let run = Run {
                block,
                layout: Arc::clone(&layout),
                chunk,
                index,
                count: (in_chunk - index).min(count - done),
            };
            done += run.count;
            visit(self, run)?;
        }
        if let Some(origin) = self.origins.get_mut(channel) {
            origin.last = (number, start);
        }
        Ok(())
    }

    /// Brings the values of a run.
    fn bring(&mut self, channel: usize, run: &Run, values: &mut [f64]) -> Result<(), FileError> {
        let Some(origin) = self.origins.get_mut(channel) else {
            return Ok(());
        };
        let Some(piece) = run.layout.piece(origin.object) else {
            return Ok(());
        };
        let Some(first) = piece.parts.first() else {
            return Ok(());
        };
        let Some(scaling) = &mut origin.scaling else {
            let mut part = first.clone();
            if origin.imaginary {
                part.offset += part.kind.component().size();
            }
            part.kind = part.kind.component();
            return run.part(&mut self.source, &part, 0, origin.start, values);
        };
        let mut done = 0;
        while done < values.len() {
            let batch = (values.len() - done).min(BATCH);
            self.raw.resize_with(piece.parts.len(), Vec::new);
            for (part, raw) in piece.parts.iter().zip(&mut self.raw) {
                raw.clear();
                raw.resize(batch, f64::NAN);
                run.part(&mut self.source, part, done as u64, origin.start, raw)?;
            }
            let raw = &self.raw;
            let parts = &piece.parts;
            let values_of = |scale| raw[part_of(parts, scale).unwrap_or(0)].as_slice();
            scaling.apply(values_of, &mut values[done..done + batch]);
            done += batch;
        }
        Ok(())
    }
}

/// The part with the raw values of a scale; plain values serve any.
fn part_of(parts: &[Part], scale: u32) -> Option<usize> {
    let only = parts.len() == 1 && scale == PLAIN;
    parts
        .iter()
        .position(|part| part.scale == scale || part.scale == PLAIN || only)
}

/// Values of a channel that lie in one chunk.
struct Run {
    block: Block,
    layout: Arc<Layout>,
    /// The number of the chunk in the block.
    chunk: u64,
    /// The number of the first value in the chunk.
    index: u64,
    /// How many values.
    count: u64,
}

impl Run {
    /// Brings values of a part, from the value `skip` of the run on.
    fn part<S: Read + Seek>(
        &self,
        source: &mut Source<S>,
        part: &Part,
        skip: u64,
        origin: Stamp,
        values: &mut [f64],
    ) -> Result<(), FileError> {
        let start = self.block.at + self.chunk * self.layout.bytes + part.offset;
        let size = part.kind.size() as usize;
        // A stride of many bytes brings one value a window.
        let stride = usize::try_from(part.stride).unwrap_or(usize::MAX).max(1);
        let most = (WINDOW - size) / stride + 1;
        let mut index = self.index + skip;
        for some in values.chunks_mut(most) {
            let count = (some.len() - 1) * stride + size;
            let bytes = source.window(start + index * part.stride, count)?;
            decode(part.kind, self.layout.big, bytes, stride, origin, some);
            index += some.len() as u64;
        }
        Ok(())
    }
}

/// What the properties of an object state of its channel; and what is wrong with them.
fn describe(object: &Object) -> (Channel, Option<String>) {
    let text = |name: &str| match object.property(name) {
        Some(Value::Text(text)) => Some(text.clone()),
        _ => None,
    };
    let number = |name: &str| match object.property(name) {
        Some(Value::Number(number)) => Some(*number),
        _ => None,
    };
    let mut channel = Channel::new(object.names.join("/"), object.count);
    channel.content = object.content.unwrap_or(Content::Number);
    let either = |first: &str, second: &str| text(first).or_else(|| text(second));
    let unit = either("unit_string", "NI_UnitDescription");
    channel.unit = unit.unwrap_or_default().trim().to_owned();
    channel.description = either("description", "Description").unwrap_or_default();
    // All zero is what an unset start looks like: the beginning of 1904.
    let unset = meta::instant((0, 0));
    channel.start = match object.property("wf_start_time") {
        Some(Value::Time(start)) if *start != unset => Some(*start),
        _ => None,
    };
    let mut wrong = None;
    match number("wf_increment") {
        Some(interval) if interval > 0.0 && interval.is_finite() => {
            let first = number("wf_start_offset").filter(|offset| offset.is_finite());
            let first = first.unwrap_or(0.0);
            channel.clock = Clock::Uniform { first, interval };
        }
        Some(interval) if interval != 0.0 => {
            let text = "its clock is unknown";
            wrong = Some(format!("its interval (wf_increment) is {interval}: {text}"));
        }
        _ => {}
    }
    (channel, wrong)
}

impl<S: Read + Seek> Recording for Tdms<S> {
    contents!(self, self.source.path(), self.index);

    fn fill(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<usize, FileError> {
        let mut done = 0;
        self.runs(channel, first, values.len() as u64, |file, run| {
            let end = done + run.count as usize;
            file.bring(channel, &run, &mut values[done..end])?;
            done = end;
            Ok(())
        })?;
        Ok(done)
    }
}
