//! Groups: which objects stand under which names.

use std::io::{Read, Seek};

use super::header::{Message, kind};
use super::storage::Storage;
use crate::recording::FileError;

impl<S: Read + Seek> Storage<S> {
    /// Names and addresses of the members of a group, by name; links to other files and soft links are left out.
    ///
    /// What cannot be read is left out too, and the error tells of the first.
    pub fn members(&mut self, messages: &[Message]) -> (Vec<(String, u64)>, Option<FileError>) {
        let mut found = Vec::new();
        let mut first_error = None;
        for message in messages {
            let members = match message.kind {
                kind::SYMBOL_TABLE => self.old_members(&message.body, &mut found),
                kind::LINK => {
                    found.extend(link(self.fields(&message.body)));
                    Ok(())
                }
                kind::LINK_INFO => self.dense_members(&message.body, &mut found),
                _ => Ok(()),
            };
            if let Err(error) = members {
                first_error.get_or_insert(error);
            }
        }
        found.sort();
        found.dedup();
        (found, first_error)
    }

    fn old_members(
        &mut self,
        body: &[u8],
        found: &mut Vec<(String, u64)>,
    ) -> Result<(), FileError> {
        const WHAT: &str = "a group";
        let mut fields = self.fields(body);
        let (Some(Some(tree)), Some(Some(heap))) = (fields.address(), fields.address()) else {
            return Err(self.damaged(0, WHAT));
        };
        let names = self.local_heap(heap)?;
        for (_, address) in self.old_tree(tree, 0, self.length_size)? {
            let head = self.piece(address, 8, WHAT)?;
            let mut fields = self.fields(&head);
            let count = (|| {
                fields.expect(b"SNOD")?;
                fields.skip(2)?;
                fields.u16()
            })();
            let count = u64::from(count.ok_or_else(|| self.damaged(address, WHAT))?);
            let size = count * (2 * self.address_size as u64 + 24);
            let bytes = self.piece(address.saturating_add(8), size, WHAT)?;
            let mut fields = self.fields(&bytes);
            for _ in 0..count {
                let entry = (|| {
                    let entry = (fields.address()?, fields.address()?, fields.u32()?);
                    fields.skip(20)?;
                    Some(entry)
                })();
                // A symbolic link has the cache type 2 and no header.
                if let Some((Some(name), Some(header), 0 | 1)) = entry {
                    let name = self.local_name(names, name)?;
                    found.push((name, header));
                }
            }
        }
        Ok(())
    }

    fn dense_members(
        &mut self,
        body: &[u8],
        found: &mut Vec<(String, u64)>,
    ) -> Result<(), FileError> {
        let mut fields = self.fields(body);
        let places = (|| {
            fields.skip(1)?;
            let ordered = fields.u8()? & 1 != 0;
            fields.skip(if ordered { 8 } else { 0 })?;
            Some((fields.address()?, fields.address()?))
        })();
        let Some((Some(heap), Some(names))) = places else {
            return Ok(());
        };
        let heap = self.fractal_heap(heap)?;
        for record in self.new_tree(names)? {
            // The hash of the name stands before the identifier.
            let id = record.get(4..).unwrap_or(&[]);
            let body = self.heap_object(&heap, id)?;
            found.extend(link(self.fields(&body)));
        }
        Ok(())
    }
}

/// Name and address of a link, where it is one to an object of this file.
fn link(mut fields: super::fields::Fields) -> Option<(String, u64)> {
    (fields.u8()? == 1).then_some(())?;
    let flags = fields.u8()?;
    if flags & 0x08 != 0 {
        (fields.u8()? == 0).then_some(())?;
    }
    fields.skip(if flags & 0x04 != 0 { 8 } else { 0 })?;
    fields.skip(if flags & 0x10 != 0 { 1 } else { 0 })?;
    let length = usize::try_from(fields.whole(1 << (flags & 3))?).ok()?;
    let name = String::from_utf8_lossy(fields.take(length)?).into_owned();
    Some((name, fields.address()??))
}
