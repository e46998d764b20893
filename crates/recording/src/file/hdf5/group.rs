//! Groups: which objects stand under which names.

use std::io::{Read, Seek};

use super::header::{Message, kind};
use super::storage::Storage;
use crate::FileError;

/// Where the member of a group stands.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Target {
    /// At this address.
    Object(u64),
    /// At this path of the same file.
    Path(String),
    /// Outside the file; where.
    Outside(String),
}

/// A member of a group: its name and where it stands.
pub(super) type Member = (String, Target);

impl<S: Read + Seek> Storage<S> {
    /// The members of a group, by name. What cannot be read is left out, and the error is that of the first.
    pub fn members(&mut self, messages: &[Message]) -> (Vec<Member>, Option<FileError>) {
        let mut found = Vec::new();
        let mut first_error = None;
        for message in messages {
            let members = match message.kind {
                kind::SYMBOL_TABLE => self.old_members(&message.body, &mut found),
                kind::LINK => self.linked(&message.body, &mut found),
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

    fn linked(&mut self, body: &[u8], found: &mut Vec<Member>) -> Result<(), FileError> {
        let member = link(self.fields(body));
        found.push(member.ok_or_else(|| self.damaged(0, "a link"))?);
        Ok(())
    }

    fn old_members(&mut self, body: &[u8], found: &mut Vec<Member>) -> Result<(), FileError> {
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
                fields.expect(b"SNOD\x01")?;
                fields.skip(1)?;
                fields.u16()
            })();
            let count = u64::from(count.ok_or_else(|| self.damaged(address, WHAT))?);
            let size = count * (2 * self.address_size as u64 + 24);
            let bytes = self.piece(address.saturating_add(8), size, WHAT)?;
            let mut fields = self.fields(&bytes);
            for _ in 0..count {
                let entry = (|| {
                    let (name, header) = (fields.address()??, fields.address()?);
                    let (cached, path) = (fields.u32()?, (fields.skip(4)?, fields.u32()?).1);
                    fields.skip(12)?;
                    Some((name, header, cached, path))
                })();
                let target = match entry {
                    Some((_, Some(header), 0 | 1, _)) => Target::Object(header),
                    // A soft link has no header, and its path stands with the names.
                    Some((.., 2, path)) => Target::Path(self.local_name(names, u64::from(path))?),
                    _ => return Err(self.damaged(address, WHAT)),
                };
                let name = entry.map_or(0, |(name, ..)| name);
                found.push((self.local_name(names, name)?, target));
            }
        }
        Ok(())
    }

    fn dense_members(&mut self, body: &[u8], found: &mut Vec<Member>) -> Result<(), FileError> {
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
        let mut heap = self.fractal_heap(heap)?;
        for record in self.new_tree(names)? {
            // The hash of the name stands before the identifier.
            let id = record.get(4..).unwrap_or(&[]);
            let body = self.heap_object(&mut heap, id)?;
            self.linked(&body, found)?;
        }
        Ok(())
    }
}

/// The member that a link describes.
fn link(mut fields: super::fields::Fields) -> Option<Member> {
    (fields.u8()? == 1).then_some(())?;
    let flags = fields.u8()?;
    let kind = if flags & 0x08 != 0 { fields.u8()? } else { 0 };
    fields.skip(if flags & 0x04 != 0 { 8 } else { 0 })?;
    fields.skip(if flags & 0x10 != 0 { 1 } else { 0 })?;
    let length = usize::try_from(fields.whole(1 << (flags & 3))?).ok()?;
    let name = String::from_utf8_lossy(fields.take(length)?).into_owned();
    if kind == 0 {
        return Some((name, Target::Object(fields.address()??)));
    }
    let length = usize::from(fields.u16()?);
    let bytes = fields.take(length)?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let target = match (kind, bytes) {
        (1, path) => Target::Path(text(path)),
        // Name of a file and path in it behind a byte of flags, each with a zero at its end.
        (64, [_, names @ ..]) => {
            let file = names.split(|&byte| byte == 0).next()?;
            Target::Outside(format!("the file {}", text(file)))
        }
        _ => Target::Outside("a place of the writer's own".to_string()),
    };
    Some((name, target))
}
