//! The two kinds of B-trees, walked from the lowest key to the highest.

use std::io::{Read, Seek};

use super::fields::size_of;
use super::storage::Storage;
use crate::FileError;

/// Deepest tree that is walked; a real one of this depth would fill every disk.
const DEEPEST: u32 = 32;

impl<S: Read + Seek> Storage<S> {
    /// Keys and children of the leaves of a tree of version 1; a key takes `key_size` bytes, of which the one before
    /// the child is given.
    pub fn old_tree(
        &mut self,
        address: u64,
        kind: u8,
        key_size: usize,
    ) -> Result<Vec<(Vec<u8>, u64)>, FileError> {
        let mut found = Vec::new();
        let mut below = vec![(address, None)];
        while let Some((address, level)) = below.pop() {
            let node = self.old_node(address, kind, key_size)?;
            let Some((here, entries)) = node.filter(|(here, _)| level.is_none_or(|l| l == *here))
            else {
                return Err(self.damaged(address, "a B-tree"));
            };
            if here == 0 {
                found.extend(entries);
            } else {
                let children = entries.into_iter().rev();
                below.extend(children.map(|(_, child)| (child, Some(here - 1))));
            }
        }
        Ok(found)
    }

    /// Level and entries of a node; none where it is damaged.
    #[allow(clippy::type_complexity)]
    fn old_node(
        &mut self,
        address: u64,
        kind: u8,
        key_size: usize,
    ) -> Result<Option<(u8, Vec<(Vec<u8>, u64)>)>, FileError> {
        const WHAT: &str = "a B-tree";
        let head_size = 8 + 2 * self.address_size;
        let head = self.piece(address, head_size as u64, WHAT)?;
        let mut fields = self.fields(&head);
        let Some((level, count)) = (|| {
            fields.expect(b"TREE")?;
            (fields.u8()? == kind).then_some(())?;
            Some((fields.u8()?, usize::from(fields.u16()?)))
        })() else {
            return Ok(None);
        };
        let size = count * (key_size + self.address_size);
        let bytes = self.piece(address.saturating_add(head_size as u64), size as u64, WHAT)?;
        let mut fields = self.fields(&bytes);
        let mut entries = Vec::with_capacity(count);
        for _ in 0..count {
            let (Some(key), Some(Some(child))) = (fields.take(key_size), fields.address()) else {
                return Ok(None);
            };
            entries.push((key.to_vec(), child));
        }
        Ok(Some((level, entries)))
    }

    /// The records of a tree of version 2.
    pub fn new_tree(&mut self, address: u64) -> Result<Vec<Vec<u8>>, FileError> {
        const WHAT: &str = "a B-tree of version 2";
        let size = 22 + self.address_size + self.length_size;
        let head = self.sealed(address, size as u64 - 4, WHAT)?;
        let mut fields = self.fields(&head);
        let parsed = (|| {
            fields.expect(b"BTHD\0")?;
            fields.skip(1)?;
            let (node, record) = (fields.u32()?, usize::from(fields.u16()?));
            let depth = u32::from(fields.u16()?);
            fields.skip(2)?;
            let root = fields.address()?;
            Some((node, record, depth, root, fields.u16()?))
        })();
        let fits = |&(node, record, depth, ..): &(u32, usize, u32, _, _)| {
            record > 0 && depth <= DEEPEST && node as usize > 16 + record && node <= 1 << 26
        };
        let Some((node, record, depth, root, count)) = parsed.filter(fits) else {
            return Err(self.damaged(address, WHAT));
        };
        let Some(root) = root else {
            return Ok(Vec::new());
        };
        let node = node as usize;
        // A child is stated with its records and, above the parents of leaves, with all below it; how many bytes these
        // counts take follows from the most that there can be.
        let leaf = ((node - 10) / record) as u64;
        let count_size = size_of(leaf);
        let mut total = leaf;
        let mut total_size = vec![0];
        for level in 1..=depth {
            let size = if level == 1 { 0 } else { size_of(total) };
            let pointer = self.address_size + count_size + size;
            if node < 10 + 2 * pointer + record {
                return Err(self.damaged(address, WHAT));
            }
            let most = ((node - (10 + pointer)) / (record + pointer)) as u64;
            total = most
                .saturating_add(1)
                .saturating_mul(total)
                .saturating_add(most);
            total_size.push(size);
        }
        let mut records = Vec::new();
        let mut below = vec![(root, u64::from(count), depth)];
        while let Some((address, count, level)) = below.pop() {
            let bytes = self.start_of(address, node as u64, WHAT)?;
            let mut fields = self.fields(&bytes);
            let mut children = Vec::new();
            let parsed = (|| {
                fields.expect(if level == 0 { b"BTLF" } else { b"BTIN" })?;
                fields.skip(2)?;
                for _ in 0..count {
                    records.push(fields.take(record)?.to_vec());
                }
                if level > 0 {
                    for _ in 0..=count {
                        let child = fields.address()??;
                        let count = fields.whole(count_size)?;
                        fields.skip(total_size[level as usize])?;
                        children.push((child, count, level - 1));
                    }
                }
                Some(())
            })();
            if parsed.is_none() {
                return Err(self.damaged(address, WHAT));
            }
            self.verify(address, &bytes, fields.at(), WHAT)?;
            below.extend(children);
        }
        Ok(records)
    }
}
