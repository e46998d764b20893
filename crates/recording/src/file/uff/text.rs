//! Lines, numbers and fixed columns of a text made for cards of 80 columns.

use std::io::{Read, Seek};

use crate::FileError;
use crate::file::source::{Source, WINDOW};

/// The line at a byte, without its end, and the byte where the next begins; none at the end of the file.
///
/// A line longer than [`WINDOW`] comes in pieces.
pub fn line<S: Read + Seek>(
    source: &mut Source<S>,
    at: u64,
) -> Result<Option<(&[u8], u64)>, FileError> {
    let left = source.length().saturating_sub(at);
    if left == 0 {
        return Ok(None);
    }
    let most = left.min(WINDOW as u64) as usize;
    let mut look = most.min(256);
    let (count, next) = loop {
        let bytes = source.window(at, look)?;
        if let Some(end) = bytes.iter().position(|byte| *byte == b'\n') {
            break (end, end + 1);
        }
        if look == most {
            break (look, look);
        }
        look = most.min(look * 4);
    };
    let bytes = source.window(at, count)?;
    Ok(Some((
        bytes.strip_suffix(b"\r").unwrap_or(bytes),
        at + next as u64,
    )))
}

/// A text of unknown encoding: UTF-8 where it is that, else Latin-1; and whether it was the latter.
pub fn decoded(bytes: &[u8]) -> (String, bool) {
    match std::str::from_utf8(bytes) {
        Ok(text) => (text.to_owned(), false),
        Err(_) => (bytes.iter().copied().map(char::from).collect(), true),
    }
}

/// The numbers on a line as they are spelt. They may touch: a sign begins the next.
pub struct Numbers<'a> {
    line: &'a [u8],
    at: usize,
}

impl<'a> Numbers<'a> {
    /// Those of a line.
    pub fn of(line: &'a [u8]) -> Numbers<'a> {
        Numbers { line, at: 0 }
    }

    fn byte(&self, at: usize) -> u8 {
        self.line.get(at).copied().unwrap_or(b' ')
    }

    /// Whether the sign at a place begins an exponent that lost its letter: exactly three digits, and no point.
    fn is_exponent(&self, at: usize) -> bool {
        let digits = (at + 1..)
            .take_while(|&i| self.byte(i).is_ascii_digit())
            .count();
        digits == 3 && self.byte(at + 4) != b'.'
    }
}

impl<'a> Iterator for Numbers<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        while self.at < self.line.len() && self.byte(self.at).is_ascii_whitespace() {
            self.at += 1;
        }
        let start = self.at;
        if start == self.line.len() {
            return None;
        }
        let (mut point, mut exponent, mut end) = (false, false, start);
        if matches!(self.byte(end), b'+' | b'-') {
            end += 1;
        }
        while end < self.line.len() {
            match self.byte(end) {
                b'0'..=b'9' => {}
                b'.' if !point && !exponent => point = true,
                b'e' | b'E' | b'd' | b'D' if !exponent => {
                    exponent = true;
                    end += usize::from(matches!(self.byte(end + 1), b'+' | b'-'));
                }
                b'+' | b'-' if point && !exponent && self.is_exponent(end) => exponent = true,
                b'+' | b'-' => break,
                byte if byte.is_ascii_whitespace() => break,
                // What is no number is one piece up to the next blank.
                _ => {
                    while end < self.line.len() && !self.byte(end).is_ascii_whitespace() {
                        end += 1;
                    }
                    break;
                }
            }
            end += 1;
        }
        self.at = end.min(self.line.len()).max(start + 1);
        self.line.get(start..self.at)
    }
}

/// Whether a spelling is a number for certain: digits with at most a point or an exponent between or before them.
pub fn is_plain(spelling: &[u8]) -> bool {
    let digits = spelling.strip_prefix(b"-").unwrap_or(spelling);
    let known = |byte: &u8| matches!(byte, b'0'..=b'9' | b'.' | b'+' | b'-' | b'e' | b'E');
    let ends = digits.first().zip(digits.last());
    ends.is_some_and(|(a, b)| a.is_ascii_digit() && b.is_ascii_digit()) && digits.iter().all(known)
}

/// The value of a spelling; none where it is no number.
pub fn value(spelling: &[u8]) -> Option<f64> {
    if let Ok(value) = std::str::from_utf8(spelling).ok()?.parse() {
        return Some(value);
    }
    let mut text = String::with_capacity(spelling.len() + 1);
    for (i, &byte) in spelling.iter().enumerate() {
        let after_digit = i > 0 && spelling[i - 1].is_ascii_digit();
        match byte {
            b'd' | b'D' => text.push('e'),
            b'+' | b'-' if after_digit || (i > 0 && spelling[i - 1] == b'.') => {
                text.push('e');
                text.push(char::from(byte));
            }
            _ => text.push(char::from(byte)),
        }
    }
    text.parse().ok()
}

/// Columns of a line, from the first to before the last, trimmed; short lines end where they end.
pub fn columns(line: &str, first: usize, last: usize) -> &str {
    let byte = |column: usize| {
        line.char_indices()
            .nth(column)
            .map_or(line.len(), |(at, _)| at)
    };
    line.get(byte(first)..byte(last)).unwrap_or("").trim()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(line: &str) -> Vec<Option<f64>> {
        Numbers::of(line.as_bytes()).map(value).collect()
    }

    #[test]
    fn numbers_may_touch_and_may_be_spelt_as_fortran_does() {
        assert_eq!(
            values(" 1.5E+00-2.5E-01 3"),
            [Some(1.5), Some(-0.25), Some(3.0)]
        );
        assert_eq!(values("-1.00000-2.00000"), [Some(-1.0), Some(-2.0)]);
        assert_eq!(
            values(" 1.00000D+02 2.5d1 .5 5."),
            [Some(100.0), Some(25.0), Some(0.5), Some(5.0)]
        );
        assert_eq!(
            values(" 1.50000-101-2.50000+100"),
            [Some(1.5e-101), Some(-2.5e100)]
        );
        assert_eq!(values("0.00000E+000 5.00000E-005"), [Some(0.0), Some(5e-5)]);
        assert_eq!(
            values("****** 1.0 - x-1 ++"),
            [None, Some(1.0), None, None, None, None]
        );
        assert_eq!(values("   "), []);
    }

    #[test]
    fn columns_count_letters_not_bytes() {
        assert_eq!(columns("m/s²  Pa", 6, 9), "Pa");
        assert_eq!(columns("ab", 1, 9), "b");
        assert_eq!(columns("ab", 5, 9), "");
    }
}
