//! The container of a workbook: deflated files in a ZIP archive, written one after the other.
//!
//! ```text
//!   local head, deflated bytes      of each file; sizes and checksum are set into the head when they are known
//!   central directory               the heads once more, with their places
//!   end of the directory
//! ```
//! Source: PKWARE, APPNOTE 6.3 (from memory); no file above 4 GiB, no encryption, no dates.

use flate2::write::DeflateEncoder;
use flate2::{Compression, Crc};
use std::io::{self, Seek, SeekFrom, Write};

/// An archive that is being written.
pub(super) struct Archive<W> {
    out: W,
    /// What is known of each file.
    files: Vec<Entry>,
}

struct Entry {
    name: String,
    /// Place of its local head.
    place: u32,
    checksum: u32,
    deflated: u32,
    size: u32,
}

/// The file of an archive that is being written.
pub(super) struct Inside<'a, W: Write> {
    deflating: DeflateEncoder<&'a mut W>,
    checksum: Crc,
    size: u64,
}

impl<W: Write> Inside<'_, W> {
    /// Ends the file: its size and checksum.
    fn finish(self) -> io::Result<(u32, u32)> {
        self.deflating.finish()?;
        Ok((small(self.size)?, self.checksum.sum()))
    }
}

impl<W: Write> Write for Inside<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.deflating.write(bytes)?;
        self.checksum.update(&bytes[..count]);
        self.size += count as u64;
        Ok(count)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.deflating.flush()
    }
}

impl<W: Write + Seek> Archive<W> {
    /// An archive without files.
    pub fn new(out: W) -> Self {
        Archive {
            out,
            files: Vec::new(),
        }
    }

    /// Writes a file.
    pub fn file(
        &mut self,
        name: &str,
        fill: impl FnOnce(&mut Inside<W>) -> io::Result<()>,
    ) -> io::Result<()> {
        let place = self.out.stream_position()?;
        let mut entry = Entry {
            name: name.to_string(),
            place: small(place)?,
            checksum: 0,
            deflated: 0,
            size: 0,
        };
        self.out.write_all(&entry.local())?;
        let begin = self.out.stream_position()?;
        (entry.size, entry.checksum) = {
            let mut inside = Inside {
                deflating: DeflateEncoder::new(&mut self.out, Compression::fast()),
                checksum: Crc::new(),
                size: 0,
            };
            fill(&mut inside)?;
            inside.finish()?
        };
        let end = self.out.stream_position()?;
        entry.deflated = small(end - begin)?;
        self.out.seek(SeekFrom::Start(place))?;
        self.out.write_all(&entry.local())?;
        self.out.seek(SeekFrom::Start(end))?;
        self.files.push(entry);
        Ok(())
    }

    /// Writes the directory, and gives back what was written to.
    pub fn finish(mut self) -> io::Result<W> {
        let begin = small(self.out.stream_position()?)?;
        for entry in &self.files {
            self.out.write_all(&entry.central())?;
        }
        let length = small(self.out.stream_position()?)? - begin;
        // as many files as a workbook has
        let count = (self.files.len() as u16).to_le_bytes();
        let mut end = b"PK\x05\x06\0\0\0\0".to_vec();
        end.extend(count.iter().chain(&count));
        end.extend(length.to_le_bytes().iter().chain(&begin.to_le_bytes()));
        end.extend([0, 0]);
        self.out.write_all(&end)?;
        Ok(self.out)
    }
}

impl Entry {
    /// Version 2.0, names in UTF-8, deflated, 1980-01-01; checksum, sizes, length of the name, no more.
    fn head(&self) -> Vec<u8> {
        let mut head = b"\x14\0\0\x08\x08\0\0\0\x21\0".to_vec();
        for number in [self.checksum, self.deflated, self.size] {
            head.extend(number.to_le_bytes());
        }
        head.extend((self.name.len() as u16).to_le_bytes());
        head.extend([0, 0]);
        head
    }

    fn local(&self) -> Vec<u8> {
        [b"PK\x03\x04", self.head().as_slice(), self.name.as_bytes()].concat()
    }

    fn central(&self) -> Vec<u8> {
        // made by version 2.0; no comment, first disk, no attributes
        let place = self.place.to_le_bytes();
        let made = b"PK\x01\x02\x14\0";
        let (head, name) = (self.head(), self.name.as_bytes());
        [made, head.as_slice(), &[0; 10], &place, name].concat()
    }
}

/// A size as the format has it.
fn small(size: u64) -> io::Result<u32> {
    u32::try_from(size).map_err(|_| io::Error::other("a workbook above 4 GiB; use --csv"))
}
