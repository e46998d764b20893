//! To come.

use super::source::Source;
use crate::recording::{Channel, FileError, Note, Recording};
use std::io::{Read, Seek};
use std::path::Path;

/// Whether a file begins as one of this format.
pub fn is_tdms(_head: &[u8]) -> bool {
    false
}

/// A file that is open for reading.
#[derive(Debug)]
pub struct Tdms<S> {
    source: Source<S>,
}

impl<S: Read + Seek> Tdms<S> {
    /// Reads the index of a file.
    pub fn from_source(source: S, path: &Path) -> Result<Tdms<S>, FileError> {
        Ok(Tdms {
            source: Source::new(source, path)?,
        })
    }
}

impl<S: Read + Seek> Recording for Tdms<S> {
    fn channels(&self) -> &[Channel] {
        &[]
    }
    fn notes(&self) -> &[Note] {
        &[]
    }
    fn read(&mut self, _: usize, _: u64, _: &mut [f64]) -> Result<usize, FileError> {
        Err(self.source.error(0, "", ""))
    }
    fn read_text(&mut self, _: usize, _: u64, _: usize) -> Result<Vec<String>, FileError> {
        Err(self.source.error(0, "", ""))
    }
}

/// Writes a file.
#[derive(Debug)]
pub struct TdmsWriter {
    draft: super::draft::Draft,
}

impl TdmsWriter {
    /// Starts a file.
    pub fn create(path: &Path, _channels: &[Channel]) -> Result<TdmsWriter, FileError> {
        Ok(TdmsWriter {
            draft: super::draft::Draft::create(path)?,
        })
    }
}

impl super::Writer for TdmsWriter {
    fn append(&mut self, _: &[&[f64]]) -> Result<(), FileError> {
        Ok(())
    }
    fn finish(self: Box<Self>) -> Result<(), FileError> {
        self.draft.finish()
    }
}
