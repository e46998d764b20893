//! Bytes of one variable, unpacked where they are packed.

use std::io::{Read, Seek};

use flate2::{Decompress, FlushDecompress, Status};

use crate::FileError;
use crate::file::source::Source;

/// Bytes of the file that are unpacked at once.
const PIECE: usize = 1 << 15;

/// A place in the bytes of a variable.
pub(super) struct Stream {
    /// How far from the start of the variable's bytes.
    at: u64,
    /// Where in the file the next bytes stand.
    next: u64,
    /// Where in the file the variable ends.
    end: u64,
    packed: Option<Packed>,
}

struct Packed {
    inflate: Decompress,
    input: Vec<u8>,
    used: usize,
    done: bool,
}

impl Stream {
    /// From `start` to `end` of the file.
    pub fn new(start: u64, end: u64, packed: bool) -> Stream {
        Stream {
            at: 0,
            next: start,
            end,
            packed: packed.then(|| Packed {
                inflate: Decompress::new(true),
                input: Vec::new(),
                used: 0,
                done: false,
            }),
        }
    }

    /// How far from the start it is.
    pub fn at(&self) -> u64 {
        self.at
    }

    /// Bytes that are left, where that is known.
    pub fn left(&self) -> Option<u64> {
        self.packed
            .is_none()
            .then(|| self.end.saturating_sub(self.next))
    }

    /// Fills `bytes`; returns how many there were, fewer than asked at the end only, or where the bytes are damaged.
    pub fn read<S: Read + Seek>(
        &mut self,
        source: &mut Source<S>,
        bytes: &mut [u8],
    ) -> Result<usize, FileError> {
        let Some(packed) = &mut self.packed else {
            let there = self.end.saturating_sub(self.next).min(bytes.len() as u64);
            let read = source.read_at(self.next, &mut bytes[..there as usize])?;
            self.next += read as u64;
            self.at += read as u64;
            return Ok(read);
        };
        let mut done = 0;
        while done < bytes.len() && !packed.done {
            if packed.used == packed.input.len() {
                let there = self.end.saturating_sub(self.next).min(PIECE as u64);
                packed.input.resize(there as usize, 0);
                let read = source.read_at(self.next, &mut packed.input)?;
                packed.input.truncate(read);
                packed.used = 0;
                self.next += read as u64;
            }
            let (taken, given) = (packed.inflate.total_in(), packed.inflate.total_out());
            let status = packed.inflate.decompress(
                &packed.input[packed.used..],
                &mut bytes[done..],
                FlushDecompress::None,
            );
            let taken = (packed.inflate.total_in() - taken) as usize;
            let given = (packed.inflate.total_out() - given) as usize;
            packed.used += taken;
            done += given;
            let stuck = taken == 0 && given == 0;
            packed.done = matches!(status, Err(_) | Ok(Status::StreamEnd)) || stuck;
        }
        self.at += done as u64;
        Ok(done)
    }

    /// Goes forward to a place; returns whether it is there.
    pub fn go_to<S: Read + Seek>(
        &mut self,
        source: &mut Source<S>,
        place: u64,
    ) -> Result<bool, FileError> {
        let Some(mut left) = place.checked_sub(self.at) else {
            return Ok(false);
        };
        if self.packed.is_none() {
            let there = left <= self.end.saturating_sub(self.next);
            if there {
                self.next += left;
                self.at = place;
            }
            return Ok(there);
        }
        let mut passed = vec![0; PIECE.min(left as usize)];
        while left > 0 {
            let piece = passed.len().min(left as usize);
            let read = self.read(source, &mut passed[..piece])?;
            if read == 0 {
                return Ok(false);
            }
            left -= read as u64;
        }
        Ok(true)
    }
}
