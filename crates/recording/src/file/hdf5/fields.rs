//! Fields of a piece of an HDF5 file, read one after the other.

use crate::file::number;

/// A place in a piece of the file; every read says whether the bytes are there.
#[derive(Clone, Copy)]
pub(super) struct Fields<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Bytes of an address.
    address_size: usize,
    /// Bytes of a length.
    length_size: usize,
}

impl<'a> Fields<'a> {
    /// Fields from the start of `bytes` on.
    pub fn new(bytes: &'a [u8], address_size: usize, length_size: usize) -> Fields<'a> {
        Fields {
            bytes,
            at: 0,
            address_size,
            length_size,
        }
    }

    /// How many bytes were read.
    pub fn at(&self) -> usize {
        self.at
    }

    /// How many bytes are left.
    pub fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The next bytes.
    pub fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let taken = self.bytes.get(self.at..self.at.checked_add(count)?)?;
        self.at += count;
        Some(taken)
    }

    /// Leaves bytes out.
    pub fn skip(&mut self, count: usize) -> Option<()> {
        self.take(count).map(|_| ())
    }

    /// Goes on at the next multiple of `to` bytes after `from`.
    pub fn pad(&mut self, from: usize, to: usize) -> Option<()> {
        let past = (self.at - from.min(self.at)) % to;
        if past == 0 {
            Some(())
        } else {
            self.skip(to - past)
        }
    }

    /// Whether these bytes come next; they are passed if so.
    pub fn expect(&mut self, bytes: &[u8]) -> Option<()> {
        (self.take(bytes.len())? == bytes).then_some(())
    }

    /// A whole number of up to eight bytes, the lowest first.
    pub fn whole(&mut self, size: usize) -> Option<u64> {
        if size > 8 {
            return None;
        }
        self.take(size).map(|bytes| number::bits(bytes, false))
    }

    /// One byte.
    pub fn u8(&mut self) -> Option<u8> {
        self.take(1).map(|bytes| bytes[0])
    }

    /// Two bytes.
    pub fn u16(&mut self) -> Option<u16> {
        self.whole(2).map(|value| value as u16)
    }

    /// Four bytes.
    pub fn u32(&mut self) -> Option<u32> {
        self.whole(4).map(|value| value as u32)
    }

    /// Eight bytes.
    pub fn u64(&mut self) -> Option<u64> {
        self.whole(8)
    }

    /// A length.
    pub fn length(&mut self) -> Option<u64> {
        self.whole(self.length_size)
    }

    /// An address; the one that is undefined is `Some(None)`.
    #[allow(clippy::option_option)] // the outer one is whether the bytes are there
    pub fn address(&mut self) -> Option<Option<u64>> {
        let undefined = u64::MAX >> (64 - 8 * self.address_size.clamp(1, 8));
        let address = self.whole(self.address_size)?;
        Some((address != undefined).then_some(address))
    }

    /// Text up to a zero byte, which is passed.
    pub fn text(&mut self) -> Option<String> {
        let rest = self.bytes.get(self.at..)?;
        let length = rest.iter().position(|&byte| byte == 0)?;
        self.at += length + 1;
        Some(String::from_utf8_lossy(&rest[..length]).into_owned())
    }
}

/// Bytes that are needed to hold a number up to `most`.
pub(super) fn size_of(most: u64) -> usize {
    (most.max(1).ilog2() / 8 + 1) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_lowest_byte_first_and_never_past_the_end() {
        let mut fields = Fields::new(&[1, 2, 3, 0xff, 0xff, b'a', 0, 7], 2, 4);
        assert_eq!(fields.u16(), Some(0x0201));
        assert_eq!(fields.u8(), Some(3));
        assert_eq!(fields.address(), Some(None));
        assert_eq!(fields.text().as_deref(), Some("a"));
        assert_eq!(fields.u16(), None);
        assert_eq!(fields.u8(), Some(7));
        assert_eq!(fields.left(), 0);
    }

    #[test]
    fn the_size_of_a_number_is_in_whole_bytes() {
        assert_eq!([0, 255, 256, 65535, 65536].map(size_of), [1, 1, 2, 2, 3]);
    }
}
