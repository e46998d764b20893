//! The headers of the pages of a column, looked at before the pages are: a page that claims more than its bytes can
//! hold, or is packed in a way that it cannot be, is never unpacked.
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
    let mut has_dictionary = false;
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
        match header.page {
            Page::Dictionary if has_dictionary => return false,
            Page::Dictionary => has_dictionary = true,
            Page::Data { by_dictionary } if by_dictionary && !has_dictionary => return false,
            Page::Data { .. } | Page::Other => {}
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
    page: Page,
}

enum Page {
    Dictionary,
    Data { by_dictionary: bool },
    Other,
}

/// Numbers of encodings: by a dictionary in its old and its new form, and of levels.
const BY_DICTIONARY: [u64; 2] = [2, 8];
const OF_LEVELS: [u64; 2] = [3, 4];

fn header(bytes: &[u8]) -> Option<Header> {
    let mut compact = Compact { bytes, at: 0 };
    let (mut whole, mut packed, mut values) = (None, None, 0);
    let (mut page, mut kind_stated) = (Page::Other, 0);
    let mut field = 0;
    while let Some(kind) = compact.field(&mut field)? {
        match (field, kind) {
            (1, 5) => kind_stated = compact.number()?,
            (2, 5) => whole = Some(compact.number()?),
            (3, 5) => packed = Some(compact.number()?),
            (5 | 7 | 8, 12) => {
                // The first numbers of a header of data or of a dictionary: values, encoding, encodings of levels;
                // in the second form of data values, empty cells, rows, encoding.
                let mut numbers = [0; 5];
                let mut inner = 0;
                while let Some(kind) = compact.field(&mut inner)? {
                    match usize::try_from(inner).ok().and_then(|n| numbers.get_mut(n)) {
                        Some(number) if kind == 5 => *number = compact.number()?,
                        _ => compact.pass(kind, 0)?,
                    }
                }
                values = numbers[1];
                let levels = OF_LEVELS.contains(&numbers[3]) && OF_LEVELS.contains(&numbers[4]);
                (field != 5 || levels).then_some(())?;
                page = match field {
                    7 => Page::Dictionary,
                    5 => Page::Data {
                        by_dictionary: BY_DICTIONARY.contains(&numbers[2]),
                    },
                    _ => Page::Data {
                        by_dictionary: BY_DICTIONARY.contains(&numbers[4]),
                    },
                };
            }
            _ => compact.pass(kind, 0)?,
        }
    }
    let kinds_agree = match page {
        Page::Data { .. } => matches!(kind_stated, 0 | 3),
        Page::Dictionary => kind_stated == 2,
        Page::Other => kind_stated == 1,
    };
    kinds_agree.then_some(())?;
    Some(Header {
        length: compact.at as u64,
        whole: whole?,
        packed: packed?,
        values,
        page,
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

    /// A number that is not negative.
    fn number(&mut self) -> Option<u64> {
        u64::try_from(self.signed()?).ok()
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
