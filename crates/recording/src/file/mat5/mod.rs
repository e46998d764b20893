//! MATLAB's format of version 5, which its versions 5 to 7.2 write, and that of level 4: reader.
//!
//! A vector is a channel; a matrix is a channel for every column, or for every row where rows are longer. Complex
//! values are two channels, `name/real` and `name/imaginary`. Fields of a structure and cells are `name/field` and
//! `name/1`, of an array of structures `name(2)/field`. Single numbers and texts are no channels. The format
//! knows no unit, and no clock but a vector named `t` or `time` and numbers such as `fs` or `dt`.
//!
//! Level 4 holds matrices alone. Left out, with a note: sparse matrices, objects, functions, and arrays of more than two directions.
//!
//! Source: MathWorks, MAT-File Format, R2019b (from memory).

mod level4;
mod stream;
mod survey;
mod values;

use std::io::{Read, Seek};
use std::path::Path;

use super::DAMAGED_PART;
use super::clock;
use super::source::{HEAD, Source};
use crate::{Channel, FileError, Note, Recording};
use stream::Stream;
use values::{Stored, Values};

/// Places in the file that are kept, one a channel: a packed variable can only be read forward.
const PLACES: usize = 64;

/// Bytes that are read at once.
const PIECE: usize = 1 << 18;

/// Whether a file that starts with these bytes is MAT of version 5 or level 4.
pub fn is_mat5(head: &[u8]) -> bool {
    let mark = head.get(124..128);
    matches!(mark, Some([0, 1, b'I', b'M'] | [1, 0, b'M', b'I']))
        || level4::big_endian(head).is_some()
}

/// A MAT file that is open for reading.
pub struct Mat5<S> {
    source: Source<S>,
    big_endian: bool,
    channels: Vec<Channel>,
    values: Vec<Values>,
    notes: Vec<Note>,
    /// Whether damage of each channel was reported.
    reported: Vec<bool>,
    /// Places that were read last, of which channel.
    places: Vec<(usize, Stream)>,
}

shown_by_contents!(Mat5);

impl<S: Read + Seek> Mat5<S> {
    /// Reads which variables the file holds, without the values; errors name `path`.
    ///
    /// An error where the file does not start as one of version 5.
    pub fn from_source(source: S, path: &Path) -> Result<Mat5<S>, FileError> {
        let mut source = Source::new(source, path)?;
        let head = source.bytes(0, source.length().min(HEAD as u64))?;
        if !is_mat5(&head) {
            let needed = "save it with MATLAB's version 5 or 7.3";
            return Err(FileError::new(
                path,
                "",
                "is no MAT file of version 5 or level 4",
                needed,
            ));
        }
        let level4 = level4::big_endian(&head);
        let big_endian = level4.unwrap_or_else(|| head.get(126..128) == Some(b"MI"));
        let found = match level4 {
            Some(_) => level4::survey(&mut source, big_endian)?,
            None => survey::survey(&mut source, big_endian)?,
        };
        let rounding: Vec<Option<f64>> = (found.values.iter())
            .map(|values| {
                let single = values.stored == Stored::F32;
                Some(if single { f64::from(f32::EPSILON) } else { 0.0 })
            })
            .collect();
        let mut file = Mat5 {
            source,
            big_endian,
            reported: vec![false; found.channels.len()],
            channels: found.channels,
            values: found.values,
            notes: found.notes,
            places: Vec::new(),
        };
        let (clocks, notes) = clock::clocks(&mut file, &found.properties, &rounding);
        for (channel, clock) in clocks {
            file.channels[channel].clock = clock;
        }
        file.notes.extend(notes);
        Ok(file)
    }

    /// Fills `values` from the index `first` on; returns whether all were there.
    fn bring(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<bool, FileError> {
        values.fill(f64::NAN);
        let layout = &self.values[channel];
        let size = layout.stored.size();
        let step = layout.step.saturating_mul(size as u64);
        let known = self.places.iter().position(|(known, _)| *known == channel);
        let mut place = match known {
            Some(known) => self.places.remove(known).1,
            None => Stream::new(layout.start, layout.end, layout.packed),
        };
        // Values that stand apart are read with what is between them, unless that is much.
        let at_once = match step {
            0..=4096 => (PIECE as u64 / step.max(1)).max(1) as usize,
            _ => 1,
        };
        let mut bytes = Vec::new();
        let mut whole = true;
        for (piece, values) in values.chunks_mut(at_once).enumerate() {
            let index = first + (piece * at_once) as u64;
            let from = index
                .saturating_mul(step)
                .saturating_add(layout.first.saturating_mul(size as u64))
                .saturating_add(layout.at);
            if place.at() > from {
                place = Stream::new(layout.start, layout.end, layout.packed);
            }
            bytes.resize((values.len() - 1) * step as usize + size, 0);
            let mut read = 0;
            if place.go_to(&mut self.source, from)? {
                read = place.read(&mut self.source, &mut bytes)?;
            }
            whole &= read == bytes.len();
            for (k, value) in values.iter_mut().enumerate() {
                let bytes = bytes[..read].get(k * step as usize..).unwrap_or(&[]);
                *value = layout.stored.number(bytes, self.big_endian);
            }
            if !whole {
                break;
            }
        }
        self.places.push((channel, place));
        if self.places.len() > PLACES {
            self.places.remove(0);
        }
        Ok(whole)
    }
}

impl<S: Read + Seek> Recording for Mat5<S> {
    contents!(self, self.source.path(), self);

    fn fill(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<usize, FileError> {
        if !self.bring(channel, first, values)? && !self.reported[channel] {
            self.reported[channel] = true;
            let name = &self.channels[channel].name;
            self.notes.push(Note::of(name, DAMAGED_PART));
        }
        Ok(values.len())
    }
}
