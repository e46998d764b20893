//! Attributes: names with small values that an object carries, and the dataspace that values have.

use std::io::{Read, Seek};

use super::datatype::{Datatype, Kind};
use super::fields::Fields;
use super::header::{Message, kind};
use super::storage::Storage;
use crate::FileError;
use crate::file::{Property, Value};

/// Most attributes of one object that are read.
const MOST: usize = 4096;

/// How many values there are along each direction.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Dataspace {
    /// Sizes now; none for a single value.
    pub sizes: Vec<u64>,
    /// Largest sizes; `u64::MAX` where there is no bound.
    pub largest: Vec<u64>,
    /// Whether there is no value at all.
    pub null: bool,
}

impl Dataspace {
    /// Number of values; none where it is too large for a number.
    pub fn count(&self) -> Option<u64> {
        if self.null {
            return Some(0);
        }
        self.sizes
            .iter()
            .try_fold(1u64, |count, &size| count.checked_mul(size))
    }

    /// Reads the dataspace from the body of its message.
    pub fn read(mut fields: Fields) -> Option<Dataspace> {
        let version = fields.u8()?;
        let rank = usize::from(fields.u8()?);
        let flags = fields.u8()?;
        let null = match version {
            1 => {
                fields.skip(5)?;
                false
            }
            2 => fields.u8()? == 2,
            _ => return None,
        };
        if rank > 32 {
            return None;
        }
        let mut sizes = || {
            (0..rank)
                .map(|_| fields.length())
                .collect::<Option<Vec<_>>>()
        };
        let now = sizes()?;
        let largest = if flags & 1 != 0 {
            sizes()?
        } else {
            now.clone()
        };
        let fits = now.iter().zip(&largest).all(|(now, most)| now <= most);
        fits.then_some(Dataspace {
            sizes: now,
            largest,
            null,
        })
    }
}

impl<S: Read + Seek> Storage<S> {
    /// The attributes of an object that are numbers or texts, of several values the first; and whether all could be read.
    pub fn attributes(&mut self, messages: &[Message]) -> (Vec<Property>, bool) {
        let (mut found, mut whole) = (Vec::new(), true);
        let mut bodies: Vec<Vec<u8>> = Vec::new();
        for message in messages {
            let here = match message.kind {
                kind::ATTRIBUTE => self.body(message).map(|body| vec![body]),
                kind::ATTRIBUTE_INFO => self.dense_attributes(&message.body),
                _ => continue,
            };
            whole &= here.is_ok();
            bodies.extend(here.unwrap_or_default());
        }
        for body in bodies.iter().take(MOST) {
            // One attribute that cannot be read is no reason to lose the object.
            match self.attribute(body) {
                Some(property) => found.extend(property),
                None => whole = false,
            }
        }
        (found, whole)
    }

    /// The bodies of attributes that stand in a heap of their own.
    fn dense_attributes(&mut self, info: &[u8]) -> Result<Vec<Vec<u8>>, FileError> {
        let mut fields = self.fields(info);
        let places = (|| {
            fields.skip(1)?;
            let ordered = fields.u8()? & 1 != 0;
            fields.skip(if ordered { 2 } else { 0 })?;
            Some((fields.address()?, fields.address()?))
        })();
        let Some((Some(heap), Some(names))) = places else {
            return Ok(Vec::new());
        };
        let mut heap = self.fractal_heap(heap)?;
        let mut bodies = Vec::new();
        for record in self.new_tree(names)?.iter().take(MOST) {
            let id = record.get(..8).unwrap_or(record);
            bodies.push(self.heap_object(&mut heap, id)?);
        }
        Ok(bodies)
    }

    /// The attribute of a message, where it is a number or a text; none where it is damaged.
    #[allow(clippy::option_option)] // the outer one is whether it could be read
    fn attribute(&mut self, body: &[u8]) -> Option<Option<Property>> {
        let mut fields = self.fields(body);
        let version = fields.u8()?;
        let flags = fields.u8()?;
        let sizes = [fields.u16()?, fields.u16()?, fields.u16()?].map(usize::from);
        if version == 3 {
            fields.skip(1)?;
        }
        let step = match version {
            1 => 8,
            2 | 3 => 1,
            _ => return None,
        };
        let mut part = |size: usize| {
            let bytes = fields.take(size)?;
            fields.skip(size.next_multiple_of(step) - size)?;
            Some(bytes)
        };
        let (name, datatype, dataspace) = (part(sizes[0])?, part(sizes[1])?, part(sizes[2])?);
        let data = fields.take(fields.left())?.to_vec();
        let name = name.split(|&byte| byte == 0).next()?;
        let name = String::from_utf8_lossy(name).into_owned();
        let message = Message {
            kind: kind::DATATYPE,
            shared: version > 1 && flags & 1 != 0,
            body: datatype.to_vec(),
        };
        let datatype = Datatype::read(&self.body(&message).ok()?)?;
        let dataspace = Dataspace::read(self.fields(dataspace))?;
        let count = usize::try_from(dataspace.count()?).ok()?;
        if count == 0 || matches!(datatype.kind, Kind::Compound(_) | Kind::Other(_)) {
            return Some(None);
        }
        data.get(..datatype.size.checked_mul(count)?)?;
        let value = self.value(&datatype, &data)?;
        Some(Some(Property { name, value }))
    }

    /// The first value of these bytes, where it is a number or a text.
    pub fn value(&mut self, datatype: &Datatype, bytes: &[u8]) -> Option<Value> {
        match datatype.kind {
            Kind::Whole { .. } | Kind::Float => {
                let number = datatype.number(bytes);
                Some(Value::Number(number))
            }
            Kind::Text => {
                let text = bytes.get(..datatype.size)?;
                let end = text.iter().rposition(|&b| b != 0 && b != b' ');
                let text = &text[..end.map_or(0, |end| end + 1)];
                let text = text.split(|&byte| byte == 0).next()?;
                Some(Value::Text(String::from_utf8_lossy(text).into_owned()))
            }
            Kind::LongText => {
                let mut fields = self.fields(bytes);
                let length = fields.u32()? as usize;
                if length == 0 {
                    return Some(Value::Text(String::new()));
                }
                let address = fields.address()??;
                let index = fields.u32()?;
                let text = self.global_object(address, index).ok()?;
                let text = &text[..length.min(text.len())];
                let text = text.split(|&byte| byte == 0).next()?;
                Some(Value::Text(String::from_utf8_lossy(text).into_owned()))
            }
            Kind::Compound(_) | Kind::Other(_) => None,
        }
    }
}
