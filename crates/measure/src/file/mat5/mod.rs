//! MATLAB's format of version 5, which its versions 5 to 7.2 write: reader.
//!
//! A vector is a channel; a matrix is a channel for every column, or for every row where rows are longer. Complex
//! values are two channels, `name/real` and `name/imaginary`. Fields of a structure and cells are `name/field` and
//! `name/1`, of an array of structures `name(2)/field`. Single numbers and texts become properties. The format knows no
//! unit, and no clock but a vector named `t` or `time` and numbers such as `fs` or `dt`.
//!
//! Left out, with a note: sparse matrices, objects, functions, and arrays of more than two directions.
//!
//! Source: MathWorks, MAT-File Format, R2019b (from memory).

mod stream;
mod survey;

use std::fmt;
use std::io::{Read, Seek};
use std::path::Path;

use super::clock;
use super::request::{refuse_number, refuse_text};
use super::source::Source;
use crate::recording::{Channel, FileError, Note, Property, Recording};
use stream::Stream;

/// Places in the file that are kept, one a channel: a packed variable can only be read forward.
const PLACES: usize = 64;

/// Bytes that are read at once.
const PIECE: usize = 1 << 18;

/// Whether a file that starts with these bytes is MAT of version 5.
pub fn is_mat5(head: &[u8]) -> bool {
    let told = head.get(124..128);
    matches!(told, Some([0, 1, b'I', b'M'] | [1, 0, b'M', b'I']))
}

/// How a number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stored {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
    I64,
    U64,
}

impl Stored {
    /// From the number of a data type.
    fn of(kind: u32) -> Option<Stored> {
        Some(match kind {
            1 => Stored::I8,
            2 | 16 => Stored::U8,
            3 => Stored::I16,
            4 | 17 => Stored::U16,
            5 => Stored::I32,
            6 | 18 => Stored::U32,
            7 => Stored::F32,
            9 => Stored::F64,
            12 => Stored::I64,
            13 => Stored::U64,
            _ => return None,
        })
    }

    /// Bytes of a number.
    fn size(self) -> usize {
        match self {
            Stored::I8 | Stored::U8 => 1,
            Stored::I16 | Stored::U16 => 2,
            Stored::I32 | Stored::U32 | Stored::F32 => 4,
            Stored::F64 | Stored::I64 | Stored::U64 => 8,
        }
    }

    /// The number that these bytes start with; not-a-number where they are too few.
    fn number(self, bytes: &[u8], big_endian: bool) -> f64 {
        let Some(bytes) = bytes.get(..self.size()) else {
            return f64::NAN;
        };
        let byte = |bits: u64, byte: &u8| bits << 8 | u64::from(*byte);
        let bits = if big_endian {
            bytes.iter().fold(0, byte)
        } else {
            bytes.iter().rev().fold(0, byte)
        };
        match self {
            Stored::I8 => f64::from(bits as i8),
            Stored::I16 => f64::from(bits as i16),
            Stored::I32 => f64::from(bits as i32),
            Stored::I64 => bits as i64 as f64,
            Stored::U8 | Stored::U16 | Stored::U32 | Stored::U64 => bits as f64,
            Stored::F32 => f64::from(f32::from_bits(bits as u32)),
            Stored::F64 => f64::from_bits(bits),
        }
    }
}

/// Where the values of a channel stand.
#[derive(Clone, Debug)]
struct Values {
    /// Start and end of the variable in the file.
    start: u64,
    end: u64,
    packed: bool,
    /// Where in the variable the array starts.
    at: u64,
    stored: Stored,
    /// Index of the first value in the array, and from one to the next.
    first: u64,
    step: u64,
}

/// A MAT file that is open for reading.
pub struct Mat5<S> {
    source: Source<S>,
    big_endian: bool,
    channels: Vec<Channel>,
    values: Vec<Values>,
    properties: Vec<Property>,
    notes: Vec<Note>,
    /// Whether damage of each channel was told.
    told: Vec<bool>,
    /// Places that were read last, of which channel.
    places: Vec<(usize, Stream)>,
}

impl<S> fmt::Debug for Mat5<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Mat5")
            .field("channels", &self.channels)
            .field("notes", &self.notes)
            .finish_non_exhaustive()
    }
}

impl<S: Read + Seek> Mat5<S> {
    /// Reads which variables the file holds, without the values; errors name `path`.
    ///
    /// An error where the file does not start as one of version 5.
    pub fn from_source(source: S, path: &Path) -> Result<Mat5<S>, FileError> {
        let mut source = Source::new(source, path)?;
        let mut head = [0; 128];
        let there = source.read_at(0, &mut head)?;
        if !is_mat5(&head[..there]) {
            let needed = "save it with MATLAB's version 5 or 7.3";
            return Err(FileError::new(
                path,
                "",
                "is no MAT file of version 5",
                needed,
            ));
        }
        let big_endian = &head[126..128] == b"MI";
        let found = survey::survey(&mut source, big_endian)?;
        let rounding: Vec<Option<f64>> = (found.values.iter())
            .map(|values| {
                let single = values.stored == Stored::F32;
                Some(if single { f64::from(f32::EPSILON) } else { 0.0 })
            })
            .collect();
        let mut file = Mat5 {
            source,
            big_endian,
            told: vec![false; found.channels.len()],
            channels: found.channels,
            values: found.values,
            properties: found.properties,
            notes: found.notes,
            places: Vec::new(),
        };
        let (clocks, notes) = clock::clocks(&mut file, &rounding);
        for (channel, clock) in clocks {
            file.channels[channel].clock = clock;
        }
        file.notes.extend(notes);
        Ok(file)
    }

    /// Fills `values` from the index `first` on; tells whether all were there.
    fn fill(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<bool, FileError> {
        values.fill(f64::NAN);
        let told = &self.values[channel];
        let size = told.stored.size();
        let step = told.step.saturating_mul(size as u64);
        let known = self.places.iter().position(|(known, _)| *known == channel);
        let mut place = match known {
            Some(known) => self.places.remove(known).1,
            None => Stream::new(told.start, told.end, told.packed),
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
                .saturating_add(told.first.saturating_mul(size as u64))
                .saturating_add(told.at);
            if place.at() > from {
                place = Stream::new(told.start, told.end, told.packed);
            }
            bytes.resize((values.len() - 1) * step as usize + size, 0);
            let mut read = 0;
            if place.go_to(&mut self.source, from)? {
                read = place.read(&mut self.source, &mut bytes)?;
            }
            whole &= read == bytes.len();
            for (k, value) in values.iter_mut().enumerate() {
                let bytes = bytes[..read].get(k * step as usize..).unwrap_or(&[]);
                *value = told.stored.number(bytes, self.big_endian);
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
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn properties(&self) -> &[Property] {
        &self.properties
    }

    fn notes(&self) -> &[Note] {
        &self.notes
    }

    fn read(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<usize, FileError> {
        let Some(told) = self.channels.get(channel) else {
            let path = self.source.path();
            return Err(refuse_number(path, channel, &self.channels));
        };
        let there = told.count.saturating_sub(first).min(values.len() as u64) as usize;
        if there == 0 {
            return Ok(0);
        }
        if !self.fill(channel, first, &mut values[..there])? && !self.told[channel] {
            self.told[channel] = true;
            self.notes.push(Note {
                channel: Some(self.channels[channel].name.clone()),
                text: "a part is damaged or cut off; its values are not-a-number".to_string(),
            });
        }
        Ok(there)
    }

    fn read_text(
        &mut self,
        channel: usize,
        _first: u64,
        _count: usize,
    ) -> Result<Vec<String>, FileError> {
        Err(refuse_text(self.source.path(), channel, &self.channels))
    }
}
