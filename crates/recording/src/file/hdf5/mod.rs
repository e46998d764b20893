//! HDF5, and with it MATLAB's format of version 7.3: reader.
//!
//! ```text
//! superblock ─ header of the root group ─┬─ names ─ headers of groups …
//!                                        └─ names ─ headers of datasets ─ values: in the header, in a row, in chunks
//! ```
//!
//! | module | what it does |
//! |---|---|
//! | `fields` | numbers and texts of a piece of the file |
//! | `checksum` | the sums over structure and over values |
//! | `storage` | superblock, addresses, sums and bounds of what is read |
//! | `header` | object headers of both versions |
//! | `tree` | B-trees of both versions |
//! | `heap` | local, global and fractal heaps |
//! | `group` | members of a group in its three forms |
//! | `attribute` | attributes and dataspaces |
//! | `datatype` | numbers, texts, compounds |
//! | `filter` | deflate, shuffle, checksum, LZF |
//! | `chunks` | the five indexes of chunks |
//! | `dataset` | lines of values, read in pieces |
//!
//! A dataset of one direction is a channel; one of two directions is a channel for every column of the longer
//! direction; a compound is a channel for every member that is a number. Single values and attributes become
//! properties. The unit is the attribute `unit` or `units`, and the clock is given by attributes or single values such
//! as `dt` or `sampling_rate` (taken in s and 1/s), or by a channel named `time` or `t` in the same group.
//!
//! Left out, with a note: values of more than two directions, references, lists of variable length, virtual and
//! external data, links out of the file or to nothing, and filters other than the four above. Every checksum is
//! verified: structure that does not match is left out with a note, values of a chunk that does not are NaN.
//!
//! Source: The HDF Group, HDF5 File Format Specification Version 3.0 (from memory).

mod attribute;
mod checksum;
mod chunks;
mod dataset;
mod datatype;
mod fields;
mod filter;
mod group;
mod header;
mod heap;
mod storage;
mod survey;
mod tree;

use std::io::{Read, Seek};
use std::path::Path;

use super::DAMAGED_PART;
use super::Property;
use super::clock;
use super::source::Source;
use crate::{Channel, FileError, Note, Recording};
use dataset::{Cache, Dataset, Line};
use storage::{SIGNATURE, Storage};

/// Whether a file that starts with these bytes is HDF5.
pub fn is_hdf5(head: &[u8]) -> bool {
    [0, 512, 1024, 2048].iter().any(|&at| {
        head.get(at..at + SIGNATURE.len())
            .is_some_and(|bytes| bytes == SIGNATURE)
    })
}

/// An HDF5 file that is open for reading.
pub struct Hdf5<S> {
    storage: Storage<S>,
    cache: Cache,
    datasets: Vec<Dataset>,
    channels: Vec<Channel>,
    /// The line of each channel.
    lines: Vec<Line>,
    /// Whether damage of each channel was reported.
    reported: Vec<bool>,
    notes: Vec<Note>,
}

shown_by_contents!(Hdf5);

impl<S: Read + Seek> Hdf5<S> {
    /// Reads what the file holds, without the values; errors name `path`.
    ///
    /// An error where no HDF5 superblock is found, or the root group cannot be read.
    pub fn from_source(source: S, path: &Path) -> Result<Hdf5<S>, FileError> {
        let mut source = Source::new(source, path)?;
        let mut head = [0; 10];
        let matlab = source.read_at(0, &mut head)? == head.len() && &head == b"MATLAB 7.3";
        let mut storage = Storage::open(source)?;
        let found = survey::survey(&mut storage, matlab)?;
        let mut file = Hdf5 {
            storage,
            cache: Cache::default(),
            reported: vec![false; found.channels.len()],
            datasets: found.datasets,
            channels: found.channels,
            lines: found.lines,
            notes: found.notes,
        };
        file.set_clocks(&found.properties);
        Ok(file)
    }

    /// Gives a clock to channels whose own attributes state none.
    fn set_clocks(&mut self, properties: &[Property]) {
        let rounding: Vec<Option<f64>> = (self.channels.iter().zip(&self.lines))
            .map(|(channel, line)| {
                let dense = self.datasets[line.dataset].is_dense(line.along, channel.count);
                let single = line.datatype.size == 4;
                let rounding = if single { f64::from(f32::EPSILON) } else { 0.0 };
                dense.then_some(rounding)
            })
            .collect();
        let (clocks, notes) = clock::clocks(self, properties, &rounding);
        for (channel, clock) in clocks {
            self.channels[channel].clock = clock;
        }
        self.notes.extend(notes);
    }
}

impl<S: Read + Seek> Recording for Hdf5<S> {
    contents!(self, self.storage.source.path(), self);

    fn contradicts_checksum(&self, channel: usize) -> bool {
        let line = self.lines.get(channel);
        line.is_some_and(|line| self.cache.contradicted.contains(&line.dataset))
    }

    fn fill(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<usize, FileError> {
        let line = &self.lines[channel];
        let dataset = &self.datasets[line.dataset];
        let (storage, cache) = (&mut self.storage, &mut self.cache);
        let whole = dataset::read_line(storage, cache, dataset, line, first, values);
        if !whole && !self.reported[channel] {
            self.reported[channel] = true;
            let name = &self.channels[channel].name;
            self.notes.push(Note::of(name, DAMAGED_PART));
        }
        Ok(values.len())
    }
}
