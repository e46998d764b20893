//! How a value stands in the raw data: its type, its size, and its way to a double.

use crate::Content;
use crate::file::number;

/// Seconds from the start of 1904, from which TDMS counts, to the start of 1970 (UTC, no leap seconds).
pub const EPOCH: i64 = 2_082_844_800;

/// 2⁻⁶⁴: the unit of the fraction of a time stamp, s.
pub const FRACTION: f64 = 1.0 / 18_446_744_073_709_551_616.0;

/// The type of a value in the raw data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    I8,
    I16,
    I32,
    I64,
    U8,
    U16,
    U32,
    U64,
    F32,
    F64,
    /// One byte, zero or not.
    Flag,
    /// One bit of a byte, by its number from the lowest.
    Bit(u8),
    /// Real and imaginary part, single precision.
    Complex32,
    /// Real and imaginary part, double precision.
    Complex64,
    /// Seconds since 1904 and a fraction of 2⁻⁶⁴ s.
    Time,
    /// A text; its place in the piece is four bytes, the text itself follows after all places.
    Text,
}

impl Kind {
    /// The type of a number of the format's list; none where its size is not known here.
    pub fn of_type(code: u32) -> Option<Kind> {
        Some(match code {
            1 => Kind::I8,
            2 => Kind::I16,
            3 => Kind::I32,
            4 => Kind::I64,
            5 => Kind::U8,
            6 => Kind::U16,
            7 => Kind::U32,
            8 => Kind::U64,
            9 | 0x19 => Kind::F32,
            10 | 0x1a => Kind::F64,
            0x20 => Kind::Text,
            0x21 => Kind::Flag,
            0x44 => Kind::Time,
            0x08_000c => Kind::Complex32,
            0x10_000d => Kind::Complex64,
            _ => return None,
        })
    }

    /// The type of a number of the list for raw data of DAQmx.
    pub fn of_daqmx(code: u32) -> Option<Kind> {
        Some(match code {
            0 => Kind::U8,
            1 => Kind::I8,
            2 => Kind::U16,
            3 => Kind::I16,
            4 => Kind::U32,
            5 => Kind::I32,
            _ => return None,
        })
    }

    /// Bytes of a value in the raw data.
    pub fn size(self) -> u64 {
        match self {
            Kind::I8 | Kind::U8 | Kind::Flag | Kind::Bit(_) => 1,
            Kind::I16 | Kind::U16 => 2,
            Kind::I32 | Kind::U32 | Kind::F32 | Kind::Text => 4,
            Kind::I64 | Kind::U64 | Kind::F64 | Kind::Complex32 => 8,
            Kind::Complex64 | Kind::Time => 16,
        }
    }

    /// What a channel of this type holds.
    pub fn content(self) -> Content {
        match self {
            Kind::Time => Content::Time,
            Kind::Text => Content::Text,
            _ => Content::Number,
        }
    }

    /// Whether a channel of this type is listed as two, real and imaginary part.
    pub fn is_complex(self) -> bool {
        matches!(self, Kind::Complex32 | Kind::Complex64)
    }

    /// The type of a part of a complex value; any other type is its own.
    pub fn component(self) -> Kind {
        match self {
            Kind::Complex32 => Kind::F32,
            Kind::Complex64 => Kind::F64,
            other => other,
        }
    }
}

/// A time stamp of the raw data: seconds since 1904, and the fraction in 2⁻⁶⁴ s.
pub type Stamp = (i64, u64);

/// The time stamp of 16 bytes.
pub fn stamp(bytes: &[u8], big: bool) -> Stamp {
    let (first, last) = bytes.split_at(8);
    let (high, low) = if big { (first, last) } else { (last, first) };
    (number::bits(high, big) as i64, number::bits(low, big))
}

/// Seconds of a time stamp after another.
fn after(stamp: Stamp, origin: Stamp) -> f64 {
    let seconds = i128::from(stamp.0) - i128::from(origin.0);
    let fraction = i128::from(stamp.1) - i128::from(origin.1);
    seconds as f64 + fraction as f64 * FRACTION
}

/// Brings values to doubles: one every `stride` bytes, the first at the start of `bytes`.
///
/// Time stamps become seconds after `origin`; a text becomes nothing. Where `bytes` end early the rest of `values` stays
/// as it is.
pub fn decode(
    kind: Kind,
    big: bool,
    bytes: &[u8],
    stride: usize,
    origin: Stamp,
    values: &mut [f64],
) {
    let stride = stride.max(1);
    macro_rules! each {
        ($size:literal, |$raw:ident| $value:expr) => {
            for (value, at) in values.iter_mut().zip(bytes.chunks(stride)) {
                if let Some(&$raw) = at.first_chunk::<$size>() {
                    *value = $value;
                }
            }
        };
    }
    macro_rules! number {
        ($type:ty, $size:literal) => {
            if big {
                each!($size, |raw| <$type>::from_be_bytes(raw) as f64)
            } else {
                each!($size, |raw| <$type>::from_le_bytes(raw) as f64)
            }
        };
    }
    match kind {
        Kind::I8 => number!(i8, 1),
        Kind::I16 => number!(i16, 2),
        Kind::I32 => number!(i32, 4),
        Kind::I64 => number!(i64, 8),
        Kind::U8 => number!(u8, 1),
        Kind::U16 => number!(u16, 2),
        Kind::U32 => number!(u32, 4),
        Kind::U64 => number!(u64, 8),
        Kind::F32 | Kind::Complex32 => number!(f32, 4),
        Kind::F64 | Kind::Complex64 => number!(f64, 8),
        Kind::Flag => each!(1, |raw| f64::from(u8::from(raw[0] != 0))),
        Kind::Bit(bit) => each!(1, |raw| f64::from((raw[0] >> (bit & 7)) & 1)),
        Kind::Time => each!(16, |raw| after(stamp(&raw, big), origin)),
        Kind::Text => {}
    }
}
