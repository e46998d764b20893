//! Bytes of a file, or of memory, read at a place; errors name the file.

use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use crate::FileError;

/// Number of bytes from the start of a file by which its format is recognised.
pub(crate) const HEAD: usize = 4096;

/// Most bytes that are read before the next are asked for: what a wrong size in a file can cost of memory at most is
/// then the file's own length.
const PIECE: u64 = 1 << 20;

/// Bytes that [`Source::window`] reads at a time.
pub const WINDOW: usize = 1 << 16;

/// Bytes of known length that are read at any place.
#[derive(Debug)]
pub struct Source<S> {
    inner: S,
    path: PathBuf,
    length: u64,
    /// Where the inner source stands, as far as known.
    position: Option<u64>,
    /// Bytes that were read before, and where they begin.
    window: Vec<u8>,
    window_at: u64,
}

impl<S: Read + Seek> Source<S> {
    /// A source whose errors name `path`.
    pub fn new(mut inner: S, path: &Path) -> Result<Source<S>, FileError> {
        let length = inner
            .seek(SeekFrom::End(0))
            .map_err(|e| unreadable(path, 0, &e))?;
        Ok(Source {
            inner,
            path: path.to_owned(),
            length,
            position: Some(length),
            window: Vec::new(),
            window_at: 0,
        })
    }

    /// Number of bytes.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// The file that errors name.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What the source was made of.
    pub fn into_inner(self) -> S {
        self.inner
    }

    /// An error at a byte of the file.
    pub fn error(
        &self,
        offset: u64,
        found: impl Into<String>,
        needed: impl Into<String>,
    ) -> FileError {
        FileError::new(&self.path, format!("byte {offset}"), found, needed)
    }

    fn cut_off(&self, offset: u64, needed: u64, there: u64) -> FileError {
        let found = format!("{needed} bytes are needed, {there} are there");
        self.error(offset, found, "the file was cut off")
    }

    /// Fills `bytes` from `offset` on; returns how many there were, fewer than asked at the end only.
    pub fn read_at(&mut self, offset: u64, bytes: &mut [u8]) -> Result<usize, FileError> {
        if offset >= self.length || bytes.is_empty() {
            return Ok(0);
        }
        if self.position != Some(offset) {
            self.position = None;
            self.inner
                .seek(SeekFrom::Start(offset))
                .map_err(|e| unreadable(&self.path, offset, &e))?;
        }
        self.position = None;
        let mut done = 0;
        while done < bytes.len() {
            match self.inner.read(&mut bytes[done..]) {
                Ok(0) => break,
                Ok(n) => done += n,
                Err(e) if e.kind() == std::io::ErrorKind::Interrupted => {}
                Err(e) => return Err(unreadable(&self.path, offset, &e)),
            }
        }
        self.position = offset.checked_add(done as u64);
        Ok(done)
    }

    /// Fills all of `bytes` from `offset` on; an error where the file ends before.
    pub fn fill_at(&mut self, offset: u64, bytes: &mut [u8]) -> Result<(), FileError> {
        let done = self.read_at(offset, bytes)?;
        match done < bytes.len() {
            true => Err(self.cut_off(offset, bytes.len() as u64, done as u64)),
            false => Ok(()),
        }
    }

    /// The `count` bytes from `offset` on, out of a window over the file that moves as needed: for many small pieces
    /// near to each other. At most [`WINDOW`] bytes; an error where the file ends before.
    pub fn window(&mut self, offset: u64, count: usize) -> Result<&[u8], FileError> {
        let behind = offset.checked_sub(self.window_at);
        let here = behind.and_then(|b| usize::try_from(b).ok()).filter(|b| {
            let end = b.checked_add(count);
            end.is_some_and(|end| end <= self.window.len())
        });
        let from = match here {
            Some(from) => from,
            None => {
                let mut window = std::mem::take(&mut self.window);
                window.resize(WINDOW, 0);
                let there = self.read_at(offset, &mut window)?;
                window.truncate(there);
                (self.window, self.window_at) = (window, offset);
                0
            }
        };
        if from + count > self.window.len() {
            let there = self.length.saturating_sub(offset);
            return Err(self.cut_off(offset, count as u64, there));
        }
        Ok(&self.window[from..from + count])
    }

    /// The `count` bytes from `offset` on; an error where the file ends before, found before memory is taken for them.
    pub fn bytes(&mut self, offset: u64, count: u64) -> Result<Vec<u8>, FileError> {
        let there = self.length.saturating_sub(offset);
        let needed = usize::try_from(count).ok().filter(|_| count <= there);
        let Some(needed) = needed else {
            return Err(self.cut_off(offset, count, there));
        };
        let mut bytes = Vec::new();
        while bytes.len() < needed {
            let done = bytes.len();
            bytes.resize(done + (needed - done).min(PIECE as usize), 0);
            self.fill_at(offset + done as u64, &mut bytes[done..])?;
        }
        Ok(bytes)
    }
}

/// What the system said when bytes could not be read.
fn unreadable(path: &Path, offset: u64, error: &std::io::Error) -> FileError {
    let found = format!("cannot be read ({error})");
    FileError::new(path, format!("byte {offset}"), found, "")
}
