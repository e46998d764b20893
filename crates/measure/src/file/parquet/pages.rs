//! The headers of the pages of a column, looked at before the pages are: a page that claims more than its bytes can
//! hold is never unpacked.
//!
//! Source: Apache Parquet, parquet.thrift (PageHeader); Apache Thrift, compact protocol.

use std::io::{Read, Seek};

use crate::file::source::Source;

/// Largest page that is unpacked, in bytes.
const LARGEST_PAGE: u64 = 256 << 20;

/// Most bytes that one packed byte can hold: deflate's bound, above those of Snappy and LZ4.
const DENSEST: u64 = 1032;

/// Bytes of a header that are read at first, and at most.
const HEAD: u64 = 256;
const LONGEST_HEAD: u64 = 1 << 20;

/// Deepest structure of a header that is passed.
const DEEPEST: u32 = 16;

/// Whether the pages from `start` to `end` of the file have sizes that can be.
pub(super) fn are_sound<S: Read + Seek>(source: &mut Source<S>, start: u64, end: u64) -> bool {
    let mut at = start;
    while at < end {
        let mut most = HEAD;
        let header = loop {
            let there = most.min(source.length().saturating_sub(at));
            let Ok(bytes) = source.bytes(at, there) else {
                return false;
            };
            match header(&bytes) {
                Some(header) => break header,
                None if there < most || most >= LONGEST_HEAD => return false,
                None => most *= 8,
            }
        };
        let most = header.packed.saturating_mul(DENSEST).saturating_add(1024);
        if header.whole > LARGEST_PAGE.min(most) || header.values > MOST_VALUES {
            return false;
        }
        at = at
            .saturating_add(header.length)
            .saturating_add(header.packed);
    }
    true
}

/// Most values of a page; writers put some tens of thousands into one.
const MOST_VALUES: u64 = 1 << 27;

struct Header {
    length: u64,
    whole: u64,
    packed: u64,
    values: u64,
}

fn header(bytes: &[u8]) -> Option<Header> {
    let mut compact = Compact { bytes, at: 0 };
    let (mut whole, mut packed, mut values) = (None, None, 0);
    let mut field = 0;
    while let Some(kind) = compact.field(&mut field)? {
        match (field, kind) {
            (2, 5) => whole = u64::try_from(compact.signed()?).ok(),
            (3, 5) => packed = u64::try_from(compact.signed()?).ok(),
            // The header of a page of data or of a dictionary starts with its number of values.
            (5 | 7 | 8, 12) => {
                let mut inner = 0;
                while let Some(kind) = compact.field(&mut inner)? {
                    if (inner, kind) == (1, 5) {
                        values = u64::try_from(compact.signed()?).ok()?;
                    } else {
                        compact.pass(kind, 0)?;
                    }
                }
            }
            _ => compact.pass(kind, 0)?,
        }
    }
    Some(Header {
        length: compact.at as u64,
        whole: whole?,
        packed: packed?,
        values,
    })
}

/// A place in a structure of Thrift's compact protocol.
struct Compact<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Compact<'_> {
    fn byte(&mut self) -> Option<u8> {
        let byte = *self.bytes.get(self.at)?;
        self.at += 1;
        Some(byte)
    }

    fn unsigned(&mut self) -> Option<u64> {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Some(value);
            }
        }
        None
    }

    fn signed(&mut self) -> Option<i64> {
        let value = self.unsigned()?;
        Some((value >> 1) as i64 ^ -((value & 1) as i64))
    }

    /// The kind of the next field, whose number is put into `field`; the inner none is the end of the structure.
    #[allow(clippy::option_option)] // the outer one is whether the bytes are there
    fn field(&mut self, field: &mut i64) -> Option<Option<u8>> {
        let head = self.byte()?;
        if head == 0 {
            return Some(None);
        }
        *field = match head >> 4 {
            0 => self.signed()?,
            step => field.saturating_add(i64::from(step)),
        };
        Some(Some(head & 0x0f))
    }

    fn skip(&mut self, count: u64) -> Option<()> {
        let at = self.at.checked_add(usize::try_from(count).ok()?)?;
        (at <= self.bytes.len()).then(|| self.at = at)
    }

    fn pass(&mut self, kind: u8, depth: u32) -> Option<()> {
        if depth > DEEPEST {
            return None;
        }
        match kind {
            1 | 2 => Some(()),
            3 => self.skip(1),
            4..=6 => self.unsigned().map(|_| ()),
            7 => self.skip(8),
            8 => {
                let length = self.unsigned()?;
                self.skip(length)
            }
            9 | 10 => {
                let head = self.byte()?;
                let count = match head >> 4 {
                    15 => self.unsigned()?,
                    count => u64::from(count),
                };
                for _ in 0..count.min(self.bytes.len() as u64) {
                    match head & 0x0f {
                        1 | 2 => self.skip(1)?,
                        kind => self.pass(kind, depth + 1)?,
                    }
                }
                Some(())
            }
            12 => {
                let mut field = 0;
                while let Some(kind) = self.field(&mut field)? {
                    self.pass(kind, depth + 1)?;
                }
                Some(())
            }
            _ => None,
        }
    }
}
