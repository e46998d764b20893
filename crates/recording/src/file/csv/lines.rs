//! Lines of a text file, whatever its letters are made of.

use std::io::{Read, Seek};

use crate::FileError;
use crate::file::source::Source;

/// Bytes that are read at once.
const PIECE: usize = 1 << 18;

/// Longest line that is read, in bytes.
const LONGEST: usize = 1 << 24;

/// How the letters of a file are made of bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Letters {
    /// ASCII, UTF-8 or a code page of one byte a letter.
    Bytes,
    /// The same with lines that end with a carriage return alone, as old writers of Apple's made them.
    Returns,
    /// UTF-16, the lower byte first.
    LowFirst,
    /// UTF-16, the higher byte first.
    HighFirst,
}

impl Letters {
    /// Letters of a file that starts with these bytes, and how many bytes of them are the mark.
    pub fn of(head: &[u8]) -> (Letters, u64) {
        match head {
            [0xff, 0xfe, ..] => (Letters::LowFirst, 2),
            [0xfe, 0xff, ..] => (Letters::HighFirst, 2),
            [0xef, 0xbb, 0xbf, ..] => (Letters::Bytes, 3),
            _ => (Letters::Bytes, 0),
        }
    }

    /// The same, of a file with this beginning, which may show lines that end with a carriage return alone.
    pub fn with_ends(self, head: &[u8]) -> Letters {
        match self {
            Letters::Bytes if !head.contains(&b'\n') && head.contains(&b'\r') => Letters::Returns,
            other => other,
        }
    }

    /// Bytes of the end of a line.
    fn mark(self) -> usize {
        match self {
            Letters::Bytes | Letters::Returns => 1,
            Letters::LowFirst | Letters::HighFirst => 2,
        }
    }
}

/// A place in the lines of a file.
#[derive(Clone, Debug)]
pub(super) struct Lines {
    letters: Letters,
    /// Where in the file the buffer starts.
    at: u64,
    buffer: Vec<u8>,
    used: usize,
    /// Whether the file may have more than the buffer.
    more: bool,
    /// Whether the line that was given last has its end.
    ended: bool,
}

impl Lines {
    /// From a byte of the file on.
    pub fn new(letters: Letters, at: u64) -> Lines {
        Lines {
            letters,
            at,
            buffer: Vec::new(),
            used: 0,
            more: true,
            ended: true,
        }
    }

    /// Where in the file the next line starts.
    pub fn at(&self) -> u64 {
        self.at + self.used as u64
    }

    /// Whether the line that was given last has its end; where not, the file may have been cut off inside it.
    pub fn ended(&self) -> bool {
        self.ended
    }

    /// The next line without its end, as bytes of UTF-8 or a code page; none at the end of the file.
    pub fn next<S: Read + Seek>(
        &mut self,
        source: &mut Source<S>,
        line: &mut Vec<u8>,
    ) -> Result<bool, FileError> {
        line.clear();
        // How much of the line was looked at for its end.
        let mut looked = 0;
        let (end, past) = loop {
            if let Some(end) = self.end_of_line(self.used + looked) {
                break (end, end + self.letters.mark());
            }
            if !self.more {
                break (self.buffer.len(), self.buffer.len());
            }
            self.at += self.used as u64;
            self.buffer.drain(..self.used);
            self.used = 0;
            let held = self.buffer.len();
            if held > LONGEST {
                let needed = "a table has lines";
                return Err(source.error(self.at, "a line is longer than 16 MB", needed));
            }
            looked = held - held % 2;
            self.buffer.resize(held + PIECE, 0);
            let read = source.read_at(self.at + held as u64, &mut self.buffer[held..])?;
            self.buffer.truncate(held + read);
            self.more = read == PIECE;
        };
        if self.used == self.buffer.len() {
            return Ok(false);
        }
        let raw = &self.buffer[self.used..end];
        match self.letters {
            Letters::Bytes | Letters::Returns => line.extend(raw),
            wide => {
                let words = raw.chunks_exact(2).map(|pair| match wide {
                    Letters::LowFirst => u16::from_le_bytes([pair[0], pair[1]]),
                    _ => u16::from_be_bytes([pair[0], pair[1]]),
                });
                let mut letter = [0; 4];
                for decoded in char::decode_utf16(words) {
                    let decoded = decoded.unwrap_or(char::REPLACEMENT_CHARACTER);
                    line.extend(decoded.encode_utf8(&mut letter).as_bytes());
                }
            }
        }
        while let Some(b'\r') = line.last() {
            line.pop();
        }
        self.ended = past > end;
        self.used = past;
        Ok(true)
    }

    /// Where the line that starts with the bytes not used ends, looked for from a byte of the buffer on.
    fn end_of_line(&self, from: usize) -> Option<usize> {
        let rest = self.buffer.get(from..)?;
        match self.letters {
            Letters::Bytes => rest.iter().position(|&b| b == b'\n').map(|end| from + end),
            Letters::Returns => rest.iter().position(|&b| b == b'\r').map(|end| from + end),
            wide => {
                let end = match wide {
                    Letters::LowFirst => [b'\n', 0],
                    _ => [0, b'\n'],
                };
                let pairs = rest.chunks_exact(2);
                pairs
                    .into_iter()
                    .position(|pair| pair == end)
                    .map(|pair| from + 2 * pair)
            }
        }
    }
}

/// Text of bytes: UTF-8 where they are, or else the letters of Latin-1.
pub(super) fn text(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_string(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    fn lines(bytes: &[u8]) -> Vec<String> {
        let mut source = Source::new(Cursor::new(bytes), "x".as_ref()).unwrap();
        let (letters, mark) = Letters::of(bytes);
        let letters = letters.with_ends(bytes);
        let (mut lines, mut line, mut found) = (Lines::new(letters, mark), Vec::new(), Vec::new());
        while lines.next(&mut source, &mut line).unwrap() {
            found.push(text(&line));
        }
        found
    }

    #[test]
    fn ends_of_lines_and_marks_do_not_belong_to_the_text() {
        assert_eq!(lines(b"\xef\xbb\xbfa\r\nb\n\nc"), ["a", "b", "", "c"]);
        assert_eq!(lines(b"a\n"), ["a"]);
        assert_eq!(lines(b"a\rb\rc"), ["a", "b", "c"]);
        assert!(lines(b"").is_empty());
    }

    #[test]
    fn letters_of_two_bytes_are_read_in_both_orders() {
        let low: Vec<u8> = "\u{feff}µ\r\nb"
            .encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect();
        let high: Vec<u8> = "\u{feff}µ\r\nb"
            .encode_utf16()
            .flat_map(u16::to_be_bytes)
            .collect();
        assert_eq!(lines(&low), ["µ", "b"]);
        assert_eq!(lines(&high), ["µ", "b"]);
    }

    #[test]
    fn lines_over_the_borders_of_pieces_are_whole() {
        let line = "0123456789abcdef".repeat(3000);
        let all = format!("{line}\n").repeat(20);
        assert!(lines(all.as_bytes()).iter().all(|found| *found == line));
        assert_eq!(lines(all.as_bytes()).len(), 20);
    }
}
