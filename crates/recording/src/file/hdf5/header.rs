//! Object headers: the messages that say what an object is.

use std::io::{Read, Seek};

use super::storage::Storage;
use crate::FileError;

/// Most messages of one object that are read; real objects have some tens.
const MOST_MESSAGES: usize = 1 << 16;

/// Kinds of messages that are read.
pub(super) mod kind {
    pub const DATASPACE: u16 = 0x01;
    pub const LINK_INFO: u16 = 0x02;
    pub const DATATYPE: u16 = 0x03;
    pub const FILL_VALUE: u16 = 0x05;
    pub const LINK: u16 = 0x06;
    pub const LAYOUT: u16 = 0x08;
    pub const FILTERS: u16 = 0x0b;
    pub const ATTRIBUTE: u16 = 0x0c;
    pub const CONTINUATION: u16 = 0x10;
    pub const SYMBOL_TABLE: u16 = 0x11;
    pub const ATTRIBUTE_INFO: u16 = 0x15;

    /// Kinds of which a group has one at least: where its members stand, or how they are kept.
    pub const OF_GROUPS: [u16; 4] = [SYMBOL_TABLE, LINK_INFO, LINK, 0x0a];
}

/// One message of an object.
#[derive(Clone, Debug)]
pub(super) struct Message {
    /// What it holds; see [`kind`].
    pub kind: u16,
    /// Whether its body stands elsewhere.
    pub shared: bool,
    /// The bytes of it.
    pub body: Vec<u8>,
}

impl<S: Read + Seek> Storage<S> {
    /// The messages of the object whose header stands at an address.
    pub fn messages(&mut self, address: u64) -> Result<Vec<Message>, FileError> {
        const WHAT: &str = "an object header";
        let head = self.start_of(address, 48, WHAT)?;
        let mut messages = Vec::new();
        let mut fields = self.fields(&head);
        let first = if head.starts_with(b"OHDR") {
            (|| {
                fields.skip(4)?;
                (fields.u8()? == 2).then_some(())?;
                let flags = fields.u8()?;
                fields.skip(if flags & 0x20 != 0 { 16 } else { 0 })?;
                fields.skip(if flags & 0x10 != 0 { 4 } else { 0 })?;
                let size = fields.whole(1 << (flags & 3))?;
                let ordered = flags & 0x04 != 0;
                let size = size.checked_add(fields.at() as u64)?;
                Some((Layout::New { ordered }, (address, size, fields.at()), None))
            })()
        } else {
            (|| {
                (fields.u8()? == 1).then_some(())?;
                fields.skip(1)?;
                let stated = fields.u16()?;
                fields.skip(4)?;
                let size = u64::from(fields.u32()?);
                Some((
                    Layout::Old,
                    (address.checked_add(16)?, size, 0),
                    Some(stated),
                ))
            })()
        };
        let (layout, first, stated) = first.ok_or_else(|| self.damaged(address, WHAT))?;
        // Pieces of the header: address, size, and the bytes of it before the messages.
        let mut pieces = vec![first];
        // All messages are at least as many as those of the first piece.
        let mut spare = stated.map_or(usize::MAX, usize::from);
        while let Some((at, size, before)) = pieces.pop() {
            let bytes = match layout {
                Layout::Old => self.piece(at, size, WHAT)?,
                Layout::New { .. } => self.sealed(at, size, WHAT)?,
            };
            let mut fields = self.fields(&bytes);
            let begin = if at == address { b"OHDR" } else { b"OCHK" };
            if fields.skip(before).is_none() || (before > 0 && !bytes.starts_with(begin)) {
                return Err(self.damaged(at, WHAT));
            }
            while fields.left() >= layout.head() {
                let message = layout.next(&mut fields).filter(|_| spare > 0);
                let message = message.ok_or_else(|| self.damaged(at, WHAT))?;
                spare -= 1;
                if message.kind == kind::CONTINUATION {
                    let mut place = self.fields(&message.body);
                    let next = (|| match (layout, place.address()??, place.length()?) {
                        (Layout::Old, at, size) => Some((at, size, 0)),
                        // A signature stands before the messages and a checksum behind them.
                        (Layout::New { .. }, at, size) => Some((at, size.checked_sub(4)?, 4)),
                    })();
                    pieces.push(next.ok_or_else(|| self.damaged(at, WHAT))?);
                } else if message.kind != 0 {
                    messages.push(message);
                }
                if messages.len() > MOST_MESSAGES || pieces.len() > MOST_MESSAGES {
                    return Err(self.damaged(at, WHAT));
                }
            }
            // Only the newer form leaves a gap, of less than a message has before its body.
            if stated.is_some() && fields.left() > 0 {
                return Err(self.damaged(at, WHAT));
            }
            spare = usize::MAX;
        }
        Ok(messages)
    }

    /// The body of a message, from the object where it stands if it is shared.
    pub fn body(&mut self, message: &Message) -> Result<Vec<u8>, FileError> {
        if !message.shared {
            return Ok(message.body.clone());
        }
        let mut fields = self.fields(&message.body);
        let address = (|| {
            let (version, place) = (fields.u8()?, fields.u8()?);
            match version {
                1 => fields.skip(6)?,
                2 => {}
                3 if place == 2 => {}
                _ => return None,
            }
            fields.address()?
        })();
        let Some(address) = address else {
            return Err(self.damaged(0, "a shared message"));
        };
        let there = self.messages(address)?;
        there
            .into_iter()
            .find(|other| other.kind == message.kind && !other.shared)
            .map(|other| other.body)
            .ok_or_else(|| self.damaged(address, "a shared message"))
    }
}

/// How the messages of a header are laid out.
#[derive(Clone, Copy)]
enum Layout {
    /// Version 1: eight bytes before each.
    Old,
    /// Version 2, with the order of creation where it is kept.
    New { ordered: bool },
}

impl Layout {
    /// Bytes of a message before its body.
    fn head(self) -> usize {
        match self {
            Layout::Old => 8,
            Layout::New { ordered } => 4 + if ordered { 2 } else { 0 },
        }
    }

    fn next(self, fields: &mut super::fields::Fields) -> Option<Message> {
        let (kind, size, flags) = match self {
            Layout::Old => {
                let (kind, size, flags) = (fields.u16()?, fields.u16()?, fields.u8()?);
                fields.skip(3)?;
                size.is_multiple_of(8).then_some(())?;
                (kind, size, flags)
            }
            Layout::New { ordered } => {
                let (kind, size, flags) = (u16::from(fields.u8()?), fields.u16()?, fields.u8()?);
                fields.skip(if ordered { 2 } else { 0 })?;
                (kind, size, flags)
            }
        };
        Some(Message {
            kind,
            shared: flags & 2 != 0,
            body: fields.take(usize::from(size))?.to_vec(),
        })
    }
}
