//! To come.

use super::source::Source;
use crate::recording::{Channel, FileError, Note, Recording};
use std::io::{Read, Seek};
use std::path::Path;

/// Whether a file begins as one of this format.
pub fn is_wav(_head: &[u8]) -> bool {
    false
}

/// A file that is open for reading.
#[derive(Debug)]
pub struct Wav<S> {
    source: Source<S>,
}

impl<S: Read + Seek> Wav<S> {
    /// Reads the index of a file.
    pub fn from_source(source: S, path: &Path) -> Result<Wav<S>, FileError> {
        Ok(Wav {
            source: Source::new(source, path)?,
        })
    }
}

impl<S: Read + Seek> Recording for Wav<S> {
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
