//! The file below the objects: superblock, addresses, and what is found at them.

use std::io::{Read, Seek};

use super::checksum::lookup3;
use super::fields::Fields;
use crate::FileError;
use crate::file::source::Source;

/// First bytes of an HDF5 file, at byte 0, 512, 1024, 2048 …
pub(super) const SIGNATURE: &[u8; 8] = b"\x89HDF\r\n\x1a\n";

/// Largest piece of structure that is read at once; real ones are far smaller.
const LARGEST_PIECE: u64 = 64 << 20;

/// A file with the sizes that its superblock states.
#[derive(Debug)]
pub(super) struct Storage<S> {
    /// The bytes.
    pub source: Source<S>,
    /// Where addresses count from.
    pub base: u64,
    /// Bytes of an address.
    pub address_size: usize,
    /// Bytes of a length.
    pub length_size: usize,
    /// Address of the header of the root group.
    pub root: u64,
    /// Where the file ends by its own account, from its first byte.
    pub end: Option<u64>,
    /// Bytes of structure that may still be read: a file that refers to itself in circles runs out of them.
    allowance: u64,
    /// The collection of the global heap that was read last.
    pub collection: Option<(u64, Vec<u8>)>,
}

impl<S: Read + Seek> Storage<S> {
    /// Finds and reads the superblock.
    pub fn open(mut source: Source<S>) -> Result<Storage<S>, FileError> {
        let mut at = 0;
        loop {
            let mut head = [0; 8];
            if source.read_at(at, &mut head)? < head.len() {
                return Err(source.error(0, "no HDF5 signature is there", ""));
            }
            if &head == SIGNATURE {
                break;
            }
            at = if at == 0 { 512 } else { at * 2 };
        }
        let rest = (source.length() - at).min(256);
        let bytes = source.bytes(at, rest)?;
        let Some((address_size, length_size, base, root, end)) = superblock(&bytes) else {
            let needed = "versions 0 to 3 can be read";
            return Err(source.error(at, "the superblock is damaged or of a new version", needed));
        };
        // A user block stands before the signature; some writers leave it out of the base.
        // The end counts from the begin of the file, as the library writes it beside a base; without one from the signature.
        let left_out = if base == 0 { at } else { 0 };
        let base = if base == 0 { at } else { base };
        let allowance = source.length().saturating_mul(16).saturating_add(16 << 20);
        Ok(Storage {
            end: end.and_then(|end| end.checked_add(left_out)),
            source,
            base,
            address_size,
            length_size,
            root,
            allowance,
            collection: None,
        })
    }

    /// An error at an address.
    pub fn damaged(&self, address: u64, what: &str) -> FileError {
        let at = self.base.saturating_add(address);
        self.source
            .error(at, format!("{what} is damaged or cut off"), "")
    }

    /// The bytes of a piece of structure.
    pub fn piece(&mut self, address: u64, count: u64, what: &str) -> Result<Vec<u8>, FileError> {
        self.allowance = self.allowance.saturating_sub(count.saturating_add(64));
        let at = self.base.checked_add(address);
        let at = at.filter(|_| count <= LARGEST_PIECE && self.allowance > 0);
        let Some(at) = at else {
            return Err(self.damaged(address, what));
        };
        self.source
            .bytes(at, count)
            .map_err(|_| self.damaged(address, what))
    }

    /// The bytes of a piece behind which its checksum stands.
    pub fn sealed(&mut self, address: u64, count: u64, what: &str) -> Result<Vec<u8>, FileError> {
        let mut bytes = self.piece(address, count.saturating_add(4), what)?;
        let end = bytes.len() - 4;
        self.verify(address, &bytes, end, what)?;
        bytes.truncate(end);
        Ok(bytes)
    }

    /// An error where the bytes before `end` do not match the checksum that stands there.
    pub fn verify(
        &self,
        address: u64,
        bytes: &[u8],
        end: usize,
        what: &str,
    ) -> Result<(), FileError> {
        let stated = bytes.get(end..).and_then(|rest| rest.first_chunk());
        match stated {
            None => Err(self.damaged(address, what)),
            Some(stated) if lookup3(&bytes[..end]) == u32::from_le_bytes(*stated) => Ok(()),
            Some(_) => {
                let at = self.base.saturating_add(address);
                let found = format!("{what} does not match its checksum");
                Err(self.source.error(at, found, ""))
            }
        }
    }

    /// The bytes of a piece whose size is known only after its start: as many as there are, up to `most`.
    pub fn start_of(&mut self, address: u64, most: u64, what: &str) -> Result<Vec<u8>, FileError> {
        let at = self.base.saturating_add(address);
        let there = self.source.length().saturating_sub(at);
        self.piece(address, most.min(there), what)
    }

    /// Fields of bytes of this file.
    pub fn fields<'a>(&self, bytes: &'a [u8]) -> Fields<'a> {
        Fields::new(bytes, self.address_size, self.length_size)
    }
}

/// Sizes of address and length, base, root and end of a superblock.
fn superblock(bytes: &[u8]) -> Option<(usize, usize, u64, u64, Option<u64>)> {
    let mut version = Fields::new(bytes, 8, 8);
    version.skip(8)?;
    let known = |size: u8| matches!(size, 2 | 4 | 8).then_some(usize::from(size));
    match version.u8()? {
        number @ (0 | 1) => {
            version.skip(4)?;
            let (address, length) = (known(version.u8()?)?, known(version.u8()?)?);
            version.skip(if number == 0 { 9 } else { 13 })?;
            let mut fields = Fields::new(&bytes[version.at()..], address, length);
            let base = fields.address()??;
            let _free_space = fields.address()?;
            let end = fields.address()?;
            let _driver = fields.address()?;
            // The entry of the root group: offset of its name, address of its header.
            let _name = fields.address()?;
            Some((address, length, base, fields.address()??, end))
        }
        2 | 3 => {
            let (address, length) = (known(version.u8()?)?, known(version.u8()?)?);
            version.skip(1)?;
            let mut fields = Fields::new(&bytes[version.at()..], address, length);
            let base = fields.address()??;
            let _extension = fields.address()?;
            let end = fields.address()?;
            let root = fields.address()??;
            let whole = &bytes[..version.at() + fields.at()];
            (fields.u32()? == lookup3(whole)).then_some((address, length, base, root, end))
        }
        _ => None,
    }
}
