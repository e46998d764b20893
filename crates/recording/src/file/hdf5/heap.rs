//! Heaps: where names, texts of variable length and the links and attributes of large objects stand.

use std::collections::HashMap;
use std::io::{Read, Seek};

use super::storage::Storage;
use crate::FileError;

/// Most bytes of one name or text that are read.
const LONGEST: u64 = 1 << 20;

/// A fractal heap: blocks in rows, each row with blocks of twice the size of the row before.
pub(super) struct FractalHeap {
    address: u64,
    offset_size: usize,
    length_size: usize,
    width: u64,
    start_size: u64,
    largest_direct: u64,
    root: Option<u64>,
    rows: u32,
    /// Whether direct blocks carry a checksum.
    summed: bool,
    /// Blocks that were read, by their addresses.
    blocks: HashMap<u64, Vec<u8>>,
}

/// The two kinds of blocks of a fractal heap.
#[derive(Clone, Copy)]
enum BlockKind {
    /// Objects, in so many bytes.
    Direct(u64),
    /// So many rows of addresses of blocks.
    Indirect(u32),
}

impl<S: Read + Seek> Storage<S> {
    /// A text at an offset of the local heap at an address.
    pub fn local_name(&mut self, data: u64, offset: u64) -> Result<String, FileError> {
        const WHAT: &str = "a name of a group's member";
        let at = data.saturating_add(offset);
        let mut most = 256;
        loop {
            let bytes = self.start_of(at, most, WHAT)?;
            if let Some(text) = self.fields(&bytes).text() {
                return Ok(text);
            }
            if (bytes.len() as u64) < most || most > LONGEST {
                return Err(self.damaged(at, WHAT));
            }
            most *= 8;
        }
    }

    /// Address of the data of a local heap.
    pub fn local_heap(&mut self, address: u64) -> Result<u64, FileError> {
        const WHAT: &str = "a local heap";
        let size = 8 + 2 * self.length_size + self.address_size;
        let bytes = self.piece(address, size as u64, WHAT)?;
        let mut fields = self.fields(&bytes);
        let data = (|| {
            fields.expect(b"HEAP")?;
            fields.skip(4)?;
            fields.length()?;
            fields.length()?;
            fields.address()?
        })();
        data.ok_or_else(|| self.damaged(address, WHAT))
    }

    /// An object of the collection of the global heap at an address.
    pub fn global_object(&mut self, address: u64, index: u32) -> Result<Vec<u8>, FileError> {
        const WHAT: &str = "the global heap";
        let known = self.collection.take().filter(|(at, _)| *at == address);
        let bytes = match known {
            Some((_, bytes)) => bytes,
            None => {
                let head = self.piece(address, (8 + self.length_size) as u64, WHAT)?;
                let mut fields = self.fields(&head);
                let size = (|| {
                    fields.expect(b"GCOL")?;
                    fields.skip(4)?;
                    fields.length()
                })();
                let size = size.ok_or_else(|| self.damaged(address, WHAT))?;
                self.start_of(address, size, WHAT)?
            }
        };
        let mut fields = self.fields(&bytes);
        let found = (|| {
            fields.skip(8)?;
            fields.length()?;
            loop {
                let here = u32::from(fields.u16()?);
                fields.skip(6)?;
                let size = usize::try_from(fields.length()?).ok()?;
                if here == index {
                    return fields.take(size).map(<[u8]>::to_vec);
                }
                if here == 0 {
                    return None;
                }
                fields.skip(size.checked_next_multiple_of(8)?)?;
            }
        })();
        self.collection = Some((address, bytes));
        found.ok_or_else(|| self.damaged(address, WHAT))
    }

    /// The fractal heap whose header stands at an address.
    pub fn fractal_heap(&mut self, address: u64) -> Result<FractalHeap, FileError> {
        const WHAT: &str = "a fractal heap";
        let bytes = self.start_of(address, 256, WHAT)?;
        let mut fields = self.fields(&bytes);
        let heap = (|| {
            fields.expect(b"FRHP\0")?;
            fields.skip(2)?;
            let filters = fields.u16()?;
            let flags = fields.u8()?;
            let largest_object = u64::from(fields.u32()?);
            fields.length()?;
            fields.address()?;
            fields.length()?;
            fields.address()?;
            for _ in 0..8 {
                fields.length()?;
            }
            let width = u64::from(fields.u16()?);
            let start_size = fields.length()?;
            let largest_direct = fields.length()?;
            let offset_size = usize::from(fields.u16()?).div_ceil(8);
            fields.skip(2)?;
            let root = fields.address()?;
            let rows = u32::from(fields.u16()?);
            let plain = filters == 0
                && width.is_power_of_two()
                && start_size.is_power_of_two()
                && largest_direct.is_power_of_two()
                && largest_direct >= start_size
                && largest_direct <= 1 << 32
                && offset_size <= 8
                && rows <= 64;
            let end = fields.at();
            let heap = plain.then(|| FractalHeap {
                address,
                offset_size,
                length_size: super::fields::size_of(largest_direct)
                    .min(super::fields::size_of(largest_object)),
                width,
                start_size,
                largest_direct,
                root,
                rows,
                summed: flags & 2 != 0,
                blocks: HashMap::new(),
            })?;
            Some((heap, end))
        })();
        let (heap, end) = heap.ok_or_else(|| self.damaged(address, WHAT))?;
        self.verify(address, &bytes, end, WHAT)?;
        Ok(heap)
    }

    /// The object of a fractal heap with this identifier.
    pub fn heap_object(&mut self, heap: &mut FractalHeap, id: &[u8]) -> Result<Vec<u8>, FileError> {
        const WHAT: &str = "an object of a fractal heap";
        let mut fields = self.fields(id);
        let place = (|| {
            let flags = fields.u8()?;
            match flags >> 4 & 3 {
                0 => {
                    let offset = fields.whole(heap.offset_size)?;
                    Some(Ok((offset, fields.whole(heap.length_size)?)))
                }
                // A tiny object stands in its identifier.
                2 => Some(Err(fields.take(usize::from(flags & 0x0f) + 1)?.to_vec())),
                _ => None,
            }
        })();
        let (offset, length) = match place {
            Some(Ok(place)) => place,
            Some(Err(tiny)) => return Ok(tiny),
            None => return Err(self.damaged(heap.address, WHAT)),
        };
        let address = heap.address;
        let head = 5 + self.address_size + heap.offset_size + if heap.summed { 4 } else { 0 };
        let block = self.block_of(heap, offset)?.and_then(|(block, start)| {
            let inside = usize::try_from(offset - start).ok()?;
            let end = inside.checked_add(usize::try_from(length).ok()?)?;
            block.get(inside..end).filter(|_| inside >= head)
        });
        let object = block.map(<[u8]>::to_vec);
        object.ok_or_else(|| self.damaged(address, WHAT))
    }

    /// A block of a fractal heap that begins at an offset of it; its checksum, where it carries one, was verified.
    fn block<'a>(
        &mut self,
        heap: &'a mut FractalHeap,
        address: u64,
        start: u64,
        kind: BlockKind,
    ) -> Result<&'a [u8], FileError> {
        const WHAT: &str = "a block of a fractal heap";
        let head = 5 + self.address_size + heap.offset_size;
        if !heap.blocks.contains_key(&address) {
            let (signature, mut bytes) = match kind {
                BlockKind::Direct(size) => (b"FHDB", self.piece(address, size, WHAT)?),
                BlockKind::Indirect(rows) => {
                    let entries = u64::from(rows) * heap.width * self.address_size as u64;
                    (b"FHIB", self.sealed(address, head as u64 + entries, WHAT)?)
                }
            };
            if heap.summed && matches!(kind, BlockKind::Direct(_)) {
                // The sum is taken with zeros in its own place.
                let Some(checksum) = bytes.get_mut(head..head + 4) else {
                    return Err(self.damaged(address, WHAT));
                };
                let checksum =
                    std::mem::take(<&mut [u8; 4]>::try_from(checksum).expect("four bytes"));
                let end = bytes.len();
                bytes.extend(checksum);
                self.verify(address, &bytes, end, WHAT)?;
                bytes.truncate(end);
            }
            let mut fields = self.fields(&bytes);
            let belongs = (|| {
                fields.expect(signature)?;
                fields.expect(&[0])?;
                (fields.address()?? == heap.address).then_some(())?;
                (fields.whole(heap.offset_size)? == start).then_some(())
            })();
            belongs.ok_or_else(|| self.damaged(address, WHAT))?;
            heap.blocks.insert(address, bytes);
        }
        Ok(&heap.blocks[&address])
    }

    /// The direct block in which an offset lies, and the offset at which the block begins.
    fn block_of<'a>(
        &mut self,
        heap: &'a mut FractalHeap,
        offset: u64,
    ) -> Result<Option<(&'a [u8], u64)>, FileError> {
        let Some(root) = heap.root else {
            return Ok(None);
        };
        if heap.rows == 0 {
            // A heap with a single block has one of the smallest size.
            let size = heap.start_size;
            return Ok(Some((
                self.block(heap, root, 0, BlockKind::Direct(size))?,
                0,
            )));
        }
        let (mut address, mut start, mut rows) = (root, 0u64, heap.rows);
        // Each level of indirect blocks has fewer rows than the one above.
        loop {
            let direct_rows = (heap.largest_direct / heap.start_size).ilog2() + 2;
            let (mut row, mut row_start, mut size) = (0, start, heap.start_size);
            while let Some(next) = size
                .checked_mul(heap.width)
                .and_then(|row_size| row_start.checked_add(row_size))
            {
                if offset < next || row >= rows {
                    break;
                }
                row_start = next;
                if row > 0 {
                    size = size.saturating_mul(2);
                }
                row += 1;
            }
            if row >= rows || offset < row_start {
                return Ok(None);
            }
            let column = (offset - row_start) / size;
            if column >= heap.width {
                return Ok(None);
            }
            let entry = u64::from(row) * heap.width + column;
            let head = 5 + self.address_size + heap.offset_size;
            let at = head + entry as usize * self.address_size;
            let block = self.block(heap, address, start, BlockKind::Indirect(rows))?;
            let bytes = block.get(at..).unwrap_or(&[]);
            let Some(Some(child)) = self.fields(bytes).address() else {
                return Ok(None);
            };
            let child_start = row_start + column * size;
            if row < direct_rows {
                let block = self.block(heap, child, child_start, BlockKind::Direct(size))?;
                return Ok(Some((block, child_start)));
            }
            let whole_row = heap.start_size.saturating_mul(heap.width);
            let below = (size / whole_row).max(1).ilog2() + 1;
            if below >= rows {
                return Ok(None);
            }
            (address, start, rows) = (child, child_start, below);
        }
    }
}
