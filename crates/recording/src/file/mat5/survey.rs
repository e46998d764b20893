//! The walk through the variables of a file.

use std::io::{Read, Seek};

use super::stream::Stream;
use super::values::{Stored, Values};
use crate::file::number;
use crate::file::source::Source;
use crate::file::{Property, Value};
use crate::{Channel, FileError, Note};

/// Deepest structure that is looked into.
const DEEPEST: usize = 16;
/// Most channels of one array.
const MOST_COLUMNS: u64 = 4096;
/// Most members of one structure or cell array.
const MOST_MEMBERS: u64 = 1 << 16;
/// Most channels of a file.
const MOST_CHANNELS: usize = 1 << 17;
/// Longest text that is looked at, and longest name, in bytes.
const LONGEST: u64 = 1 << 16;

/// What a file holds.
#[derive(Default)]
pub(super) struct Contents {
    pub channels: Vec<Channel>,
    pub values: Vec<Values>,
    pub properties: Vec<Property>,
    pub notes: Vec<Note>,
}

/// Walks through the variables.
pub(super) fn survey<S: Read + Seek>(
    source: &mut Source<S>,
    big_endian: bool,
) -> Result<Contents, FileError> {
    let mut found = Contents::default();
    let mut at = 128;
    while at < source.length() {
        let mut head = [0; 8];
        let there = source.read_at(at, &mut head)?;
        let tag = Tag::read(&head, big_endian).filter(|_| there == head.len());
        let Some(tag) = tag.filter(|tag| !tag.small) else {
            found.note(
                "",
                format!("byte {at}: no variable starts here; the rest is left out"),
            );
            break;
        };
        let start = at + 8;
        let stated_end = start + tag.size;
        let end = stated_end.min(source.length());
        if stated_end > source.length() {
            let text = format!(
                "byte {at}: {} bytes are stated, {} are there; the file was cut off",
                tag.size,
                end - start
            );
            found.note("", text);
        }
        match tag.kind {
            14 | 15 => {
                let packed = tag.kind == 15;
                let mut walk = Walk {
                    source,
                    big_endian,
                    start,
                    end,
                    packed,
                    stream: Stream::new(start, end, packed),
                    found: &mut found,
                };
                if walk.variable(tag.size)?.is_none() {
                    let text = format!("byte {at}: a variable is damaged or cut off");
                    found.note("", text);
                }
            }
            _ => found.note("", format!("byte {at}: holds no array; it is left out")),
        }
        // A packed variable is not padded.
        at = if tag.kind == 15 {
            stated_end
        } else {
            stated_end.next_multiple_of(8)
        };
    }
    Ok(found)
}

/// The eight bytes before an element.
#[derive(Clone, Copy)]
struct Tag {
    kind: u32,
    size: u64,
    /// Whether the element stands in the last four of the eight bytes.
    small: bool,
}

impl Tag {
    fn read(head: &[u8; 8], big_endian: bool) -> Option<Tag> {
        let word = |at: usize| number::bits(&head[at..at + 4], big_endian) as u32;
        let (first, second) = (word(0), word(4));
        let (small, size) = (first >> 16 != 0, first >> 16);
        let (kind, size) = match small {
            true => (first & 0xffff, u64::from(size)),
            false => (first, u64::from(second)),
        };
        (!small || size <= 4).then_some(Tag { kind, size, small })
    }
}

/// An element of an array.
struct Element {
    kind: u32,
    size: u64,
    /// Where its bytes stand in the variable.
    at: u64,
    /// Where the next element starts.
    next: u64,
    /// The bytes themselves, where they stand beside the tag.
    small: Option<[u8; 4]>,
}

/// A text that ends before a zero.
fn text_of(bytes: &[u8]) -> String {
    let end = bytes.iter().position(|&byte| byte == 0);
    String::from_utf8_lossy(&bytes[..end.unwrap_or(bytes.len())]).into_owned()
}

/// A name of its own, or else another.
fn named(own: &[u8], other: &str) -> String {
    match own {
        [] => other.to_string(),
        own => String::from_utf8_lossy(own).into_owned(),
    }
}

/// A walk through one variable. Inside, `Ok(None)` says that the variable is damaged.
struct Walk<'a, S> {
    source: &'a mut Source<S>,
    big_endian: bool,
    start: u64,
    end: u64,
    packed: bool,
    stream: Stream,
    found: &'a mut Contents,
}

type Damage<T> = Result<Option<T>, FileError>;

/// Takes the value, or returns that the variable is damaged.
macro_rules! sound {
    ($value:expr) => {
        match $value {
            Some(value) => value,
            None => return Ok(None),
        }
    };
}

impl<S: Read + Seek> Walk<'_, S> {
    fn variable(&mut self, size: u64) -> Damage<()> {
        if !self.packed {
            return self.array("", size, 0);
        }
        let element = sound!(self.element()?);
        if element.kind != 14 {
            return Ok(None);
        }
        self.array("", element.size, 0)
    }

    /// The next element; its bytes come next.
    fn element(&mut self) -> Damage<Element> {
        let from = self.stream.at();
        let mut head = [0; 8];
        if self.stream.read(self.source, &mut head)? < head.len() {
            return Ok(None);
        }
        let tag = sound!(Tag::read(&head, self.big_endian));
        let (before, behind) = match tag.small {
            true => (4, 0),
            false => (8, tag.size.next_multiple_of(8)),
        };
        Ok(Some(Element {
            kind: tag.kind,
            size: tag.size,
            at: from + before,
            next: from + 8 + behind,
            small: (head.last_chunk().copied()).filter(|_| tag.small),
        }))
    }

    /// Kind and bytes of the next element, which are few.
    fn short(&mut self) -> Damage<(u32, Vec<u8>)> {
        let element = sound!(self.element()?);
        if let Some(bytes) = element.small {
            let own = bytes[..element.size as usize].to_vec();
            return Ok(Some((element.kind, own)));
        }
        if element.size > LONGEST {
            return Ok(None);
        }
        let mut bytes = vec![0; (element.next - element.at) as usize];
        let read = self.stream.read(self.source, &mut bytes)?;
        if (read as u64) < element.size {
            return Ok(None);
        }
        bytes.truncate(element.size as usize);
        Ok(Some((element.kind, bytes)))
    }

    /// Whole numbers of four bytes.
    fn words(&self, bytes: &[u8]) -> Vec<u32> {
        let word = |bytes| Stored::U32.number(bytes, self.big_endian) as u32;
        bytes.chunks_exact(4).map(word).collect()
    }

    /// An array of `size` bytes, of which the next is the first; `name` is used where it has none of its own.
    fn array(&mut self, name: &str, size: u64, depth: usize) -> Damage<()> {
        if size == 0 {
            // An empty cell or field.
            return Ok(Some(()));
        }
        let end = self.stream.at().saturating_add(size);
        let (_, flags) = sound!(self.short()?);
        let flags = sound!(self.words(&flags).first().copied());
        let class = flags & 0xff;
        let (complex, logical) = (flags & 0x0800 != 0, flags & 0x0200 != 0);
        if class == 17 {
            // An opaque object has names instead of sizes.
            let (_, own) = sound!(self.short()?);
            let name = named(&own, name);
            self.found.note(&name, "holds an object; it is left out");
            return self.leave(end);
        }
        let (_, sizes) = sound!(self.short()?);
        let sizes: Vec<u64> = self.words(&sizes).into_iter().map(u64::from).collect();
        let (_, own) = sound!(self.short()?);
        let name = named(text_of(&own).as_bytes(), name);
        let count = sizes.iter().try_fold(1u64, |n, &size| n.checked_mul(size));
        let count = sound!(count);
        if self.found.channels.len() + self.found.properties.len() > MOST_CHANNELS {
            return Ok(None);
        }
        match class {
            1 if depth < DEEPEST && count <= MOST_MEMBERS => {
                for member in 1..=count {
                    let element = sound!(self.element()?);
                    if element.kind != 14 {
                        return Ok(None);
                    }
                    let name = format!("{name}/{member}");
                    sound!(self.array(&name, element.size, depth + 1)?);
                    sound!(self.leave(element.next)?);
                }
            }
            2 | 3 if depth < DEEPEST && count <= MOST_MEMBERS => {
                if class == 3 {
                    sound!(self.short()?);
                }
                sound!(self.fields(&name, count, depth)?);
            }
            4 => match self.short()? {
                Some((kind, _)) => drop(sound!(Stored::of(kind))),
                None => self.found.note(&name, "is a text that cannot be read"),
            },
            6..=15 => {
                if count == 0 {
                    self.found.note(&name, "is empty");
                } else {
                    let (real, imaginary) = match complex {
                        true => (format!("{name}/real"), Some(format!("{name}/imaginary"))),
                        false => (name, None),
                    };
                    let element = sound!(self.numbers(&real, &sizes, logical)?);
                    if let Some(imaginary) = imaginary {
                        sound!(self.leave(element.next)?);
                        sound!(self.numbers(&imaginary, &sizes, logical)?);
                    }
                }
            }
            _ => {
                let what = match class {
                    1..=3 => "a structure that is too large or too deep",
                    5 => "a sparse matrix",
                    16 => "a function",
                    _ => "values of an unknown class",
                };
                self.found
                    .note(&name, format!("holds {what}; it is left out"));
            }
        }
        // What follows the outermost array is not needed, and to unpack it costs time.
        if depth == 0 {
            Ok(Some(()))
        } else {
            self.leave(end)
        }
    }

    /// Goes on at a place of the variable.
    fn leave(&mut self, place: u64) -> Damage<()> {
        if self.stream.at() > place {
            return Ok(None);
        }
        Ok(self.stream.go_to(self.source, place)?.then_some(()))
    }

    fn fields(&mut self, name: &str, count: u64, depth: usize) -> Damage<()> {
        let (_, length) = sound!(self.short()?);
        let length = sound!(self.words(&length).first().copied()) as usize;
        let (_, names) = sound!(self.short()?);
        if length == 0 {
            return Ok(names.is_empty().then_some(()));
        }
        let names: Vec<String> = names.chunks(length).map(text_of).collect();
        if names.is_empty() {
            return Ok(Some(()));
        }
        for number in 1..=count {
            for field in &names {
                let element = sound!(self.element()?);
                if element.kind != 14 {
                    return Ok(None);
                }
                let full = match count {
                    1 => format!("{name}/{field}"),
                    _ => format!("{name}({number})/{field}"),
                };
                sound!(self.array(&full, element.size, depth + 1)?);
                sound!(self.leave(element.next)?);
            }
        }
        Ok(Some(()))
    }

    /// An array of numbers, of which the element comes next.
    fn numbers(&mut self, name: &str, sizes: &[u64], logical: bool) -> Damage<Element> {
        let element = sound!(self.element()?);
        let Some(stored) = Stored::of(element.kind) else {
            return Ok(None);
        };
        let count: u64 = sizes.iter().product();
        let size = stored.size() as u64;
        let mut there = element.size / size;
        if let (Some(left), None) = (self.stream.left(), element.small) {
            there = there.min(left / size);
        }
        if there < count {
            let text = format!("{count} values are stated, {there} are there");
            self.found.note(name, text);
        }
        if sizes.iter().all(|&size| size == 1) {
            sound!(self.single(name, &element, stored, logical)?);
            return Ok(Some(element));
        }
        let values = Values {
            start: self.start,
            end: self.end,
            packed: self.packed,
            at: element.at,
            stored,
            first: 0,
            step: 1,
        };
        self.found.matrix(name, sizes, there, &values);
        Ok(Some(element))
    }

    fn single(
        &mut self,
        name: &str,
        element: &Element,
        stored: Stored,
        logical: bool,
    ) -> Damage<()> {
        let mut bytes = [0; 8];
        let size = stored.size().min(element.size as usize);
        match element.small {
            Some(small) => bytes[..size].copy_from_slice(&small[..size]),
            None if self.stream.read(self.source, &mut bytes[..size])? < size => return Ok(None),
            None => {}
        }
        if !logical {
            let number = stored.number(&bytes[..size], self.big_endian);
            self.found.properties.push(Property {
                name: name.to_string(),
                value: Value::Number(number),
            });
        }
        Ok(Some(()))
    }
}

impl Contents {
    /// Channels of an array of numbers, of which `there` are in the file from `values` on: its columns, or its rows where they are
    /// longer.
    pub(super) fn matrix(&mut self, name: &str, sizes: &[u64], there: u64, values: &Values) {
        let wide: Vec<u64> = sizes.iter().copied().filter(|&size| size != 1).collect();
        let (rows, columns, by_rows) = match wide[..] {
            [] => (1, 1, false),
            [rows] => (rows, 1, false),
            [rows, columns] if rows >= columns => (rows, columns, false),
            [rows, columns] => (columns, rows, true),
            _ => {
                let text = "has more than two directions; it is left out";
                return self.note(name, text);
            }
        };
        if columns > MOST_COLUMNS {
            return self.note(name, format!("has {columns} columns; it is left out"));
        }
        for column in 0..columns {
            let (first, step) = match by_rows {
                true => (column, columns),
                false => (column * rows, 1),
            };
            let whole = there.saturating_sub(first).div_ceil(step).min(rows);
            let name = match columns {
                1 => name.to_string(),
                _ => format!("{name}[{}]", column + 1),
            };
            self.channels.push(Channel::new(name, whole));
            self.values.push(Values {
                first,
                step,
                ..values.clone()
            });
        }
    }

    pub(super) fn note(&mut self, name: &str, text: impl Into<String>) {
        self.notes.push(Note::of(name, text));
    }
}
