//! How numbers are stored, and where the values of a channel stand.

use crate::file::number;

/// How a number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stored {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
    I64,
    U64,
}

impl Stored {
    /// From the number of a data type.
    pub(super) fn of(kind: u32) -> Option<Stored> {
        Some(match kind {
            1 => Stored::I8,
            2 | 16 => Stored::U8,
            3 => Stored::I16,
            4 | 17 => Stored::U16,
            5 => Stored::I32,
            6 | 18 => Stored::U32,
            7 => Stored::F32,
            9 => Stored::F64,
            12 => Stored::I64,
            13 => Stored::U64,
            _ => return None,
        })
    }

    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Stored::I8 | Stored::U8 => 1,
            Stored::I16 | Stored::U16 => 2,
            Stored::I32 | Stored::U32 | Stored::F32 => 4,
            Stored::F64 | Stored::I64 | Stored::U64 => 8,
        }
    }

    /// The number that these bytes start with; not-a-number where they are too few.
    pub(super) fn number(self, bytes: &[u8], big_endian: bool) -> f64 {
        let Some(bytes) = bytes.get(..self.size()) else {
            return f64::NAN;
        };
        let bits = number::bits(bytes, big_endian);
        match self {
            Stored::I8 | Stored::I16 | Stored::I32 | Stored::I64 => {
                number::signed(bits, self.size()) as f64
            }
            Stored::U8 | Stored::U16 | Stored::U32 | Stored::U64 => bits as f64,
            Stored::F32 | Stored::F64 => number::float(bits, self.size()),
        }
    }
}

/// Where the values of a channel stand.
#[derive(Clone, Debug)]
pub(super) struct Values {
    /// Start and end of the variable in the file.
    pub(super) start: u64,
    pub(super) end: u64,
    pub(super) packed: bool,
    /// Where in the variable the array starts.
    pub(super) at: u64,
    pub(super) stored: Stored,
    /// Index of the first value in the array, and from one to the next.
    pub(super) first: u64,
    pub(super) step: u64,
}
