//! Where the chunks of a dataset stand: the five kinds of index, read into one table.

use std::collections::BTreeMap;
use std::io::{Read, Seek};

use super::storage::Storage;
use crate::FileError;

/// Most chunks of one dataset that are kept track of.
const MOST_CHUNKS: u64 = 1 << 22;

/// Where a chunk stands in the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chunk {
    pub address: u64,
    /// Bytes in the file.
    pub size: u64,
    /// Bit k: filter k was not applied.
    pub left_out: u32,
}

impl Chunk {
    fn at(address: u64, size: u64, left_out: u32) -> Chunk {
        Chunk {
            address,
            size,
            left_out,
        }
    }
}

/// Kind of index and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Index {
    /// B-tree of version 1.
    OldTree,
    /// One chunk; its size and mask where it is filtered.
    Single(Option<(u64, u32)>),
    /// One chunk behind the other.
    Implicit,
    /// A table of fixed length.
    Fixed,
    /// A table that grows in one direction.
    Extensible,
    /// B-tree of version 2.
    NewTree,
}

/// The grid of chunks of a dataset.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Grid {
    /// Sizes of the dataset.
    pub sizes: Vec<u64>,
    /// Largest sizes; `u64::MAX` where there is no bound.
    pub largest: Vec<u64>,
    /// Sizes of a chunk.
    pub chunk: Vec<u64>,
    /// Bytes of a chunk before filters.
    pub bytes: u64,
    /// Whether there are filters.
    pub filtered: bool,
}

impl Grid {
    /// The place in the grid of the chunk at a position of a table, for tables whose slowest direction is `slowest`.
    fn place(&self, mut position: u64, slowest: usize) -> Option<Vec<u64>> {
        let rank = self.chunk.len();
        let mut place = vec![0; rank];
        let order = (0..rank).filter(|&d| d != slowest).rev();
        for direction in order {
            let size = match self.largest[direction] {
                u64::MAX => self.sizes[direction],
                largest => largest,
            };
            let count = size.div_ceil(self.chunk[direction]).max(1);
            place[direction] = position % count;
            position /= count;
        }
        *place.get_mut(slowest)? = position;
        Some(place)
    }

    /// The direction without bound, along which an extensible table grows.
    fn unbounded(&self) -> usize {
        let unbounded = |&size: &u64| size == u64::MAX;
        self.largest.iter().position(unbounded).unwrap_or(0)
    }
}

/// Chunks by their places in the grid.
pub(super) type Chunks = BTreeMap<Vec<u64>, Chunk>;

const WHAT: &str = "an index of chunks";

impl<S: Read + Seek> Storage<S> {
    /// Reads an index.
    pub fn chunks(&mut self, index: &Index, at: u64, grid: &Grid) -> Result<Chunks, FileError> {
        let rank = grid.chunk.len();
        let mut chunks = Chunks::new();
        match index {
            Index::OldTree => {
                for (key, address) in self.old_tree(at, 1, 8 + 8 * (rank + 1))? {
                    let mut fields = self.fields(&key);
                    let entry = (|| {
                        let (size, left_out) = (u64::from(fields.u32()?), fields.u32()?);
                        let offsets = (0..rank).map(|_| fields.u64());
                        let place = offsets
                            .zip(&grid.chunk)
                            .map(|(offset, size)| offset.map(|offset| offset / size))
                            .collect::<Option<Vec<_>>>()?;
                        Some((place, size, left_out))
                    })();
                    let (place, size, left_out) = entry.ok_or_else(|| self.damaged(at, WHAT))?;
                    chunks.insert(place, Chunk::at(address, size, left_out));
                }
            }
            Index::NewTree => {
                for record in self.new_tree(at)? {
                    let whole = self.address_size + 8 * rank;
                    let (size_bytes, mask) = match grid.filtered {
                        true => (record.len().saturating_sub(whole + 4), true),
                        false => (0, false),
                    };
                    let mut fields = self.fields(&record);
                    let entry = (|| {
                        let address = fields.address()?;
                        let (size, left_out) = match mask {
                            true => (fields.whole(size_bytes)?, fields.u32()?),
                            false => (grid.bytes, 0),
                        };
                        let place = (0..rank).map(|_| fields.u64()).collect::<Option<_>>()?;
                        Some((place, address, size, left_out))
                    })();
                    let entry = entry.ok_or_else(|| self.damaged(at, WHAT))?;
                    if let (place, Some(address), size, left_out) = entry {
                        chunks.insert(place, Chunk::at(address, size, left_out));
                    }
                }
            }
            Index::Single(filtered) => {
                let (size, left_out) = filtered.unwrap_or((grid.bytes, 0));
                chunks.insert(vec![0; rank], Chunk::at(at, size, left_out));
            }
            Index::Implicit => {
                let there = self.source.length() / grid.bytes.max(1) + 1;
                for position in 0..there.min(MOST_CHUNKS) {
                    let Some(place) = grid.place(position, 0) else {
                        break;
                    };
                    if place[0] >= grid.sizes[0].div_ceil(grid.chunk[0]) {
                        break;
                    }
                    let address = at.saturating_add(position.saturating_mul(grid.bytes));
                    chunks.insert(place, Chunk::at(address, grid.bytes, 0));
                }
            }
            Index::Fixed => {
                let mut table = Table::new(grid, 0, &mut chunks);
                self.fixed_array(at, &mut table)?;
            }
            Index::Extensible => {
                let mut table = Table::new(grid, grid.unbounded(), &mut chunks);
                self.extensible_array(at, &mut table)?;
            }
        }
        Ok(chunks)
    }

    fn fixed_array(&mut self, at: u64, table: &mut Table) -> Result<(), FileError> {
        let size = 8 + self.length_size + self.address_size;
        let head = self.sealed(at, size as u64, WHAT)?;
        let mut fields = self.fields(&head);
        let parsed = (|| {
            fields.expect(b"FAHD\0")?;
            fields.skip(1)?;
            let (entry, bits) = (usize::from(fields.u8()?), u32::from(fields.u8()?));
            Some((entry, bits, fields.length()?, fields.address()?))
        })();
        let fits = |&(entry, bits, count, _): &(usize, u32, u64, _)| {
            entry > 0 && bits < 32 && count <= MOST_CHUNKS
        };
        let Some((entry, bits, count, Some(block))) = parsed.filter(fits) else {
            return match parsed {
                Some((.., None)) => Ok(()),
                _ => Err(self.damaged(at, WHAT)),
            };
        };
        table.entry = entry;
        let page = 1u64 << bits;
        let owner = Owner { at, offset_size: 0 };
        if count <= page {
            let bytes = self.table_block(&owner, b"FADB", block, count * entry as u64)?;
            return table.fill(self, 0, &bytes);
        }
        let pages = count.div_ceil(page);
        let bitmap = self.table_block(&owner, b"FADB", block, pages.div_ceil(8))?;
        let around = (6 + self.address_size) as u64 + bitmap.len() as u64 + 4;
        let mut address = block.saturating_add(around);
        for number in 0..pages {
            let here = page.min(count - number * page);
            let byte = bitmap.get((number / 8) as usize).copied().unwrap_or(0);
            if byte & 0x80 >> (number % 8) != 0 {
                let bytes = self.sealed(address, here * entry as u64, WHAT)?;
                table.fill(self, number * page, &bytes)?;
            }
            address = address.saturating_add(page * entry as u64 + 4);
        }
        Ok(())
    }

    fn extensible_array(&mut self, at: u64, table: &mut Table) -> Result<(), FileError> {
        let size = 12 + 6 * self.length_size + self.address_size;
        let head = self.sealed(at, size as u64, WHAT)?;
        let mut fields = self.fields(&head);
        let parsed = (|| {
            fields.expect(b"EAHD\0")?;
            fields.skip(1)?;
            table.entry = usize::from(fields.u8()?);
            let (most_bits, in_index) = (u32::from(fields.u8()?), u64::from(fields.u8()?));
            let (smallest, pointers) = (u64::from(fields.u8()?), u64::from(fields.u8()?));
            let page_bits = u32::from(fields.u8()?);
            for _ in 0..4 {
                fields.length()?;
            }
            let count = fields.length()?;
            fields.length()?;
            let plain = table.entry > 0
                && most_bits <= 64
                && smallest.is_power_of_two()
                && pointers.is_power_of_two()
                && pointers > 1
                && page_bits < 32
                && most_bits >= smallest.ilog2()
                && count <= MOST_CHUNKS;
            let block = fields.address()?;
            plain.then_some((
                most_bits, in_index, smallest, pointers, page_bits, count, block,
            ))
        })();
        let Some((most_bits, in_index, smallest, pointers, page_bits, count, block)) = parsed
        else {
            return Err(self.damaged(at, WHAT));
        };
        let Some(block) = block else {
            return Ok(());
        };
        let blocks = Blocks {
            owner: Owner {
                at,
                offset_size: most_bits.div_ceil(8) as usize,
            },
            page: 1 << page_bits,
            count,
        };
        // The index block: its own elements, then addresses of data blocks, then addresses of blocks of those.
        let entry = table.entry as u64;
        let direct_levels = 2 * pointers.ilog2();
        let levels = 1 + most_bits - smallest.ilog2();
        let direct = 2 * (pointers - 1);
        let above = u64::from(levels.saturating_sub(direct_levels));
        let size = in_index * entry + (direct + above) * self.address_size as u64;
        let bytes = self.table_block(&Owner { at, offset_size: 0 }, b"EAIB", block, size)?;
        let own = (in_index * entry) as usize;
        table.fill(self, 0, &bytes[..own])?;
        let mut fields = self.fields(&bytes[own..]);
        let mut position = in_index;
        for level in 0..levels {
            let here = 1u64 << (level / 2);
            let length = smallest.saturating_mul(1 << level.div_ceil(2).min(62));
            if position >= count {
                break;
            }
            if level < direct_levels {
                for _ in 0..here {
                    let address = fields.address().flatten();
                    self.data_block(&blocks, address, position, length, &[], table)?;
                    position = position.saturating_add(length);
                }
            } else {
                let address = fields.address().flatten();
                let pages = match length > blocks.page {
                    true => (length / blocks.page).div_ceil(8),
                    false => 0,
                };
                if let Some(address) = address {
                    let bitmaps = here.saturating_mul(pages);
                    let size = bitmaps.saturating_add(here * self.address_size as u64);
                    let bytes = self.table_block(&blocks.owner, b"EASB", address, size)?;
                    let (bitmaps, addresses) = bytes.split_at(bitmaps as usize);
                    let mut fields = self.fields(addresses);
                    for block in 0..here {
                        let address = fields.address().flatten();
                        let from = (block * pages) as usize;
                        let bitmap = &bitmaps[from..from + pages as usize];
                        let start = position.saturating_add(block.saturating_mul(length));
                        self.data_block(&blocks, address, start, length, bitmap, table)?;
                    }
                }
                position = position.saturating_add(here.saturating_mul(length));
            }
        }
        Ok(())
    }

    fn data_block(
        &mut self,
        blocks: &Blocks,
        address: Option<u64>,
        position: u64,
        length: u64,
        bitmap: &[u8],
        table: &mut Table,
    ) -> Result<(), FileError> {
        let Some(address) = address.filter(|_| position < blocks.count) else {
            return Ok(());
        };
        let entry = table.entry as u64;
        let owner = &blocks.owner;
        if length <= blocks.page {
            let bytes = self.table_block(owner, b"EADB", address, length * entry)?;
            let here = length.min(blocks.count - position) * entry;
            return table.fill(self, position, &bytes[..here as usize]);
        }
        self.table_block(owner, b"EADB", address, 0)?;
        let around = (6 + self.address_size + owner.offset_size + 4) as u64;
        let first = address.saturating_add(around);
        for number in 0..length / blocks.page {
            let start = position + number * blocks.page;
            if start >= blocks.count {
                break;
            }
            let byte = bitmap.get((number / 8) as usize).copied().unwrap_or(0);
            if byte & 0x80 >> (number % 8) != 0 {
                let at = first.saturating_add(number * (blocks.page * entry + 4));
                let bytes = self.sealed(at, blocks.page * entry, WHAT)?;
                let here = blocks.page.min(blocks.count - start) * entry;
                table.fill(self, start, &bytes[..here as usize])?;
            }
        }
        Ok(())
    }

    /// The `size` bytes behind the head of a block, which carries its signature, the address of its table and an offset,
    /// and behind them the checksum of all.
    fn table_block(
        &mut self,
        owner: &Owner,
        signature: &[u8; 4],
        address: u64,
        size: u64,
    ) -> Result<Vec<u8>, FileError> {
        let head = 6 + self.address_size + owner.offset_size;
        let bytes = self.sealed(address, size.saturating_add(head as u64), WHAT)?;
        let mut fields = self.fields(&bytes);
        let belongs = (|| {
            fields.expect(signature)?;
            fields.expect(&[0])?;
            fields.skip(1)?;
            (fields.address()?? == owner.at).then_some(())
        })();
        belongs.ok_or_else(|| self.damaged(address, WHAT))?;
        Ok(bytes[head..].to_vec())
    }
}

/// Sizes that all blocks of an extensible array share.
struct Blocks {
    owner: Owner,
    page: u64,
    count: u64,
}

/// What the head of a block states of the table to which it belongs.
struct Owner {
    /// Address of the header of the table.
    at: u64,
    /// Bytes of the offset of the block.
    offset_size: usize,
}

/// A table of chunks that is being read.
struct Table<'a> {
    grid: &'a Grid,
    slowest: usize,
    entry: usize,
    chunks: &'a mut Chunks,
}

impl<'a> Table<'a> {
    fn new(grid: &'a Grid, slowest: usize, chunks: &'a mut Chunks) -> Table<'a> {
        Table {
            grid,
            slowest,
            entry: 0,
            chunks,
        }
    }

    /// Takes entries, the first of which has this position in the table.
    fn fill<S: Read + Seek>(
        &mut self,
        storage: &Storage<S>,
        position: u64,
        bytes: &[u8],
    ) -> Result<(), FileError> {
        for (number, entry) in bytes.chunks_exact(self.entry).enumerate() {
            let mut fields = storage.fields(entry);
            let size_bytes = self.entry.saturating_sub(storage.address_size + 4);
            let parsed = (|| {
                let address = fields.address()?;
                let (size, left_out) = match self.grid.filtered {
                    true => (fields.whole(size_bytes)?, fields.u32()?),
                    false => (self.grid.bytes, 0),
                };
                Some(address.map(|address| Chunk::at(address, size, left_out)))
            })();
            let chunk = parsed.ok_or_else(|| storage.damaged(0, WHAT))?;
            let place = self.grid.place(position + number as u64, self.slowest);
            if let (Some(chunk), Some(place)) = (chunk, place) {
                self.chunks.insert(place, chunk);
            }
        }
        Ok(())
    }
}
