//! Datatypes: which numbers the bytes of a value are.

use super::fields::Fields;
use crate::file::number;

/// Deepest nesting of compound types that is read.
const DEEPEST: u32 = 8;

/// What a value is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    /// A whole number.
    Whole { signed: bool },
    /// A floating-point number of 2, 4 or 8 bytes.
    Float,
    /// Text of fixed length.
    Text,
    /// Text of variable length, in the global heap.
    LongText,
    /// Several members.
    Compound(Vec<Member>),
    /// Something that is no number and no text, or a number of an unusual form; what it is called.
    Other(&'static str),
}

/// A member of a compound type.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Member {
    pub name: String,
    pub offset: usize,
    pub datatype: Datatype,
}

/// A type of values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Datatype {
    pub kind: Kind,
    /// Bytes of a value.
    pub size: usize,
    /// Whether the highest byte comes first.
    pub big_endian: bool,
}

impl Datatype {
    /// Reads the type from the body of its message.
    pub fn read(body: &[u8]) -> Option<Datatype> {
        read(&mut Fields::new(body, 8, 8), 0)
    }

    /// Whether a value is one number.
    pub fn is_number(&self) -> bool {
        matches!(self.kind, Kind::Whole { .. } | Kind::Float)
    }

    /// The number that starts with the first of these bytes; not-a-number where they are too few or no number.
    pub fn number(&self, bytes: &[u8]) -> f64 {
        let Some(bytes) = bytes.get(..self.size).filter(|bytes| bytes.len() <= 8) else {
            return f64::NAN;
        };
        let bits = number::bits(bytes, self.big_endian);
        match (&self.kind, self.size) {
            (Kind::Float, size @ (2 | 4 | 8)) => number::float(bits, size),
            (Kind::Whole { signed: true }, size @ 1..) => number::signed(bits, size) as f64,
            (Kind::Whole { signed: false }, 1..) => bits as f64,
            _ => f64::NAN,
        }
    }
}

fn read(fields: &mut Fields, depth: u32) -> Option<Datatype> {
    let head = fields.u8()?;
    let (class, version) = (head & 0x0f, head >> 4);
    let flags = fields.whole(3)?;
    let size = fields.u32()? as usize;
    let mut big_endian = flags & 1 != 0;
    let kind = match class {
        0 | 4 => {
            let (offset, precision) = (fields.u16()?, usize::from(fields.u16()?));
            if offset == 0 && precision == 8 * size && (1..=8).contains(&size) {
                Kind::Whole {
                    signed: class == 0 && flags & 8 != 0,
                }
            } else {
                Kind::Other("numbers that do not fill their bytes")
            }
        }
        1 => {
            let layout = fields.take(12)?;
            big_endian = flags & 0x41 == 1;
            let usual = match size {
                2 => [0, 0, 16, 0, 10, 5, 0, 10, 15, 0, 0, 0],
                4 => [0, 0, 32, 0, 23, 8, 0, 23, 127, 0, 0, 0],
                _ => [0, 0, 64, 0, 52, 11, 0, 52, 0xff, 3, 0, 0],
            };
            if matches!(size, 2 | 4 | 8) && layout == usual && flags & 0x40 == 0 {
                Kind::Float
            } else {
                Kind::Other("floating-point numbers of an unusual form")
            }
        }
        2 => {
            fields.skip(2)?;
            Kind::Other("times of an old form")
        }
        3 => Kind::Text,
        5 => {
            fields.skip(usize::from(flags as u8).next_multiple_of(8))?;
            Kind::Other("opaque bytes")
        }
        6 => {
            if depth >= DEEPEST {
                return None;
            }
            let mut members = Vec::new();
            for _ in 0..flags & 0xffff {
                let name_at = fields.at();
                let name = fields.text()?;
                if version < 3 {
                    fields.pad(name_at, 8)?;
                }
                let offset = match version {
                    3.. => fields.whole(super::fields::size_of(size as u64))?,
                    _ => u64::from(fields.u32()?),
                };
                let mut shaped = false;
                if version == 1 {
                    shaped = fields.u8()? > 0;
                    fields.skip(27)?;
                }
                let mut datatype = read(fields, depth + 1)?;
                if shaped {
                    datatype.kind = Kind::Other("arrays");
                }
                members.push(Member {
                    name,
                    offset: usize::try_from(offset).ok()?,
                    datatype,
                });
            }
            Kind::Compound(members)
        }
        7 => Kind::Other("references"),
        8 => {
            if depth >= DEEPEST {
                return None;
            }
            let base = read(fields, depth + 1)?;
            for _ in 0..flags & 0xffff {
                let name_at = fields.at();
                fields.text()?;
                if version < 3 {
                    fields.pad(name_at, 8)?;
                }
            }
            let count = (flags & 0xffff) as usize;
            fields.skip(count.checked_mul(base.size)?)?;
            big_endian = base.big_endian;
            base.kind
        }
        9 => {
            if depth >= DEEPEST {
                return None;
            }
            read(fields, depth + 1)?;
            if flags & 0x0f == 1 {
                Kind::LongText
            } else {
                Kind::Other("lists of variable length")
            }
        }
        10 => {
            if depth >= DEEPEST {
                return None;
            }
            let rank = usize::from(fields.u8()?);
            let old = version < 3;
            fields.skip(if old { 3 } else { 0 })?;
            fields.skip(rank * if old { 8 } else { 4 })?;
            read(fields, depth + 1)?;
            Kind::Other("arrays")
        }
        _ => Kind::Other("values of an unknown type"),
    };
    Some(Datatype {
        kind,
        size,
        big_endian,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(kind: Kind, size: usize, big_endian: bool) -> Datatype {
        Datatype {
            kind,
            size,
            big_endian,
        }
    }

    #[test]
    fn whole_numbers_of_all_sizes_and_orders() {
        let signed = Kind::Whole { signed: true };
        let value = |size, big, bytes: &[u8]| plain(signed.clone(), size, big).number(bytes);
        assert_eq!(value(1, false, &[0xff]), -1.0);
        assert_eq!(value(2, true, &[0xff, 0xfe]), -2.0);
        assert_eq!(value(4, false, &[0, 0, 1, 0]), 65536.0);
        assert_eq!(value(8, false, &i64::MIN.to_le_bytes()), -(2f64.powi(63)));
        let unsigned = plain(Kind::Whole { signed: false }, 1, false);
        assert_eq!(unsigned.number(&[0xff]), 255.0);
        assert!(unsigned.number(&[]).is_nan());
    }
}
