//! The Arrow schema that travels in a Parquet file under the key `ARROW:schema`.
//!
//! Parquet itself has no place for the unit of a column. Readers built on Arrow (pyarrow, pandas, polars, DuckDB, R)
//! take column metadata from an Arrow IPC message that the writer leaves beside the file's own schema. A table of
//! doubles needs four of its tables; they are laid out here as FlatBuffers, so that no Arrow library is built in; of the schema
//! of another writer the names and metadata of the fields are read.
//!
//! Source: Apache Arrow, format/Message.fbs and format/Schema.fbs; FlatBuffers, "Internals".

/// Key of the schema in the metadata of a Parquet file.
pub const KEY: &str = "ARROW:schema";

/// `MetadataVersion.V5`.
const VERSION: i16 = 4;
/// `MessageHeader.Schema`.
const HEADER_SCHEMA: u8 = 1;
/// `Type.FloatingPoint`.
const TYPE_FLOATING_POINT: u8 = 3;
/// `Precision.DOUBLE`.
const PRECISION_DOUBLE: i16 = 2;

/// One column of doubles.
pub struct Field<'a> {
    /// Name of the column.
    pub name: &'a str,
    /// Whether cells may be empty.
    pub nullable: bool,
    /// Its metadata.
    pub metadata: &'a [(&'a str, &'a str)],
}

/// The schema of a table of doubles, as the text that stands under [`KEY`].
pub fn encoded(fields: &[Field]) -> String {
    let mut message = vec![0; 4];
    let root = place(&mut message, &message_of(fields));
    message[..4].copy_from_slice(&(root as u32).to_le_bytes());
    pad(&mut message, 8, 0);
    let mut bytes = vec![0xff; 4];
    bytes.extend((message.len() as u32).to_le_bytes());
    bytes.extend(message);
    base64(&bytes)
}

fn message_of<'a>(fields: &[Field<'a>]) -> Part<'a> {
    use Part::{Byte, Empty, List, Short, Table, Text};
    let field = |field: &Field<'a>| {
        let pairs = field
            .metadata
            .iter()
            .map(|(key, value)| Table(vec![Text(key), Text(value)]));
        Table(vec![
            Text(field.name),
            Byte(u8::from(field.nullable)),
            Byte(TYPE_FLOATING_POINT),
            Table(vec![Short(PRECISION_DOUBLE)]),
            Empty,
            List(Vec::new()),
            List(pairs.collect()),
        ])
    };
    let schema = Table(vec![Empty, List(fields.iter().map(field).collect())]);
    Table(vec![Short(VERSION), Byte(HEADER_SCHEMA), schema])
}

/// A part of a FlatBuffer; an empty slot of a table has its default.
enum Part<'a> {
    Empty,
    Byte(u8),
    Short(i16),
    Text(&'a str),
    List(Vec<Part<'a>>),
    Table(Vec<Part<'a>>),
}

/// Appends a text, list or table and all below it; returns its position. What a part refers to stands behind it,
/// because references count forward only.
fn place(buffer: &mut Vec<u8>, part: &Part) -> usize {
    match part {
        Part::Empty | Part::Byte(_) | Part::Short(_) => unreachable!("stands inside its table"),
        Part::Text(text) => {
            pad(buffer, 4, 0);
            let position = buffer.len();
            buffer.extend((text.len() as u32).to_le_bytes());
            buffer.extend(text.as_bytes());
            buffer.push(0);
            position
        }
        Part::List(parts) => {
            pad(buffer, 4, 0);
            let position = buffer.len();
            buffer.extend((parts.len() as u32).to_le_bytes());
            buffer.resize(buffer.len() + 4 * parts.len(), 0);
            for (index, part) in parts.iter().enumerate() {
                refer(buffer, position + 4 + 4 * index, part);
            }
            position
        }
        Part::Table(slots) => {
            // Every slot takes four bytes, whatever it holds.
            pad(buffer, 4, 0);
            let offsets = buffer.len();
            buffer.extend((4 + 2 * slots.len() as u16).to_le_bytes());
            buffer.extend((4 + 4 * slots.len() as u16).to_le_bytes());
            for (index, slot) in slots.iter().enumerate() {
                let offset = match slot {
                    Part::Empty => 0,
                    _ => 4 + 4 * index as u16,
                };
                buffer.extend(offset.to_le_bytes());
            }
            pad(buffer, 4, 0);
            let position = buffer.len();
            buffer.extend(((position - offsets) as i32).to_le_bytes());
            buffer.resize(buffer.len() + 4 * slots.len(), 0);
            for (index, slot) in slots.iter().enumerate() {
                let here = position + 4 + 4 * index;
                match slot {
                    Part::Empty => {}
                    Part::Byte(value) => buffer[here] = *value,
                    Part::Short(value) => {
                        buffer[here..here + 2].copy_from_slice(&value.to_le_bytes());
                    }
                    below => refer(buffer, here, below),
                }
            }
            position
        }
    }
}

/// Appends a part and writes its distance at `here`.
fn refer(buffer: &mut Vec<u8>, here: usize, part: &Part) {
    let there = place(buffer, part);
    buffer[here..here + 4].copy_from_slice(&((there - here) as u32).to_le_bytes());
}

fn pad(buffer: &mut Vec<u8>, to: usize, with: u8) {
    buffer.resize(buffer.len().next_multiple_of(to), with);
}

/// Letters of base64 (RFC 4648), in the order of their values.
const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Bytes as a text in base64 (RFC 4648), padded.
pub fn base64(bytes: &[u8]) -> String {
    let mut text = String::new();
    push_base64(&mut text, bytes);
    text
}

/// The same behind a text.
pub fn push_base64(text: &mut String, bytes: &[u8]) {
    text.reserve(bytes.len().div_ceil(3) * 4);
    let (groups, rest) = bytes.as_chunks::<3>();
    let letters = |[a, b, c]: [u8; 3]| {
        let word = u32::from(a) << 16 | u32::from(b) << 8 | u32::from(c);
        [18, 12, 6, 0].map(|shift| char::from(LETTERS[(word >> shift & 63) as usize]))
    };
    text.extend(groups.iter().flat_map(|group| letters(*group)));
    if !rest.is_empty() {
        let last = letters([rest[0], rest.get(1).copied().unwrap_or(0), 0]);
        text.extend(&last[..=rest.len()]);
        text.push_str(&"=="[rest.len() - 1..]);
    }
}

/// The bytes of a text in base64; none where it holds other letters.
fn bytes_of(text: &str) -> Option<Vec<u8>> {
    let (mut bytes, mut word, mut bits) = (Vec::with_capacity(text.len()), 0u32, 0);
    for letter in text.trim_end_matches('=').bytes() {
        let value = LETTERS.iter().position(|&known| known == letter)?;
        word = word << 6 | value as u32;
        bits += 6;
        if bits >= 8 {
            bits -= 8;
            bytes.push((word >> bits) as u8);
            word &= (1 << bits) - 1;
        }
    }
    Some(bytes)
}

/// Most fields, and most metadata of one, that are read.
const MOST: usize = 1 << 16;

/// Names and metadata of the fields of a schema, in its order; none where the text is no schema.
#[allow(clippy::type_complexity)]
pub fn decoded(text: &str) -> Option<Vec<(String, Vec<(String, String)>)>> {
    let bytes = bytes_of(text)?;
    let message = Buffer(bytes.strip_prefix(&[0xff; 4])?.get(4..)?);
    let root = message.follow(0)?;
    let schema = message.below(root, 2)?;
    let mut fields = Vec::new();
    for field in message.list(message.below(schema, 1)?)? {
        let name = message.below(field, 0).and_then(|at| message.text(at));
        let pairs = message.below(field, 6).and_then(|at| message.list(at));
        let metadata = pairs.unwrap_or_default().into_iter().filter_map(|pair| {
            let key = message.text(message.below(pair, 0)?)?;
            Some((key, message.text(message.below(pair, 1)?)?))
        });
        fields.push((name.unwrap_or_default(), metadata.collect()));
    }
    Some(fields)
}

/// A FlatBuffer whose every reference is checked.
struct Buffer<'a>(&'a [u8]);

impl Buffer<'_> {
    fn word(&self, at: usize) -> Option<usize> {
        let bytes = self.0.get(at..at.checked_add(4)?)?.first_chunk()?;
        Some(u32::from_le_bytes(*bytes) as usize)
    }

    fn half(&self, at: usize) -> Option<usize> {
        let bytes = self.0.get(at..at.checked_add(2)?)?.first_chunk()?;
        Some(usize::from(u16::from_le_bytes(*bytes)))
    }

    fn follow(&self, at: usize) -> Option<usize> {
        at.checked_add(self.word(at)?)
    }

    /// What a slot of a table refers to; none where it is empty.
    fn below(&self, table: usize, slot: usize) -> Option<usize> {
        // The distance to the table of offsets has a sign.
        let distance = self.word(table)? as u32 as i32;
        let offsets = (table as i64).checked_sub(i64::from(distance))?;
        let offsets = usize::try_from(offsets).ok()?;
        let place = 4 + 2 * slot;
        let inside = place < self.half(offsets)?;
        let offset = self.half(offsets.checked_add(place)?).filter(|_| inside)?;
        if offset == 0 {
            return None;
        }
        self.follow(table.checked_add(offset)?)
    }

    fn list(&self, at: usize) -> Option<Vec<usize>> {
        let count = self.word(at)?;
        if count > MOST {
            return None;
        }
        (0..count).map(|k| self.follow(at + 4 + 4 * k)).collect()
    }

    fn text(&self, at: usize) -> Option<String> {
        let length = self.word(at)?;
        let start = at.checked_add(4)?;
        let bytes = self.0.get(start..start.checked_add(length)?)?;
        Some(String::from_utf8_lossy(bytes).into_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_by_its_standard() {
        // Test vectors of RFC 4648, section 10.
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(bytes.as_bytes()), text);
            assert_eq!(bytes_of(text).unwrap(), bytes.as_bytes());
        }
        assert_eq!(base64(&[0xfb, 0xff, 0xfe]), "+//+");
        assert_eq!(bytes_of("a b"), None);
    }

    #[test]
    fn what_is_written_is_read() {
        let metadata = [("unit", "N m"), ("meaning", "µ of the arm")];
        let field = |name, metadata| Field {
            name,
            nullable: true,
            metadata,
        };
        let text = encoded(&[field("torque", &metadata), field("bare", &[])]);
        let fields = decoded(&text).unwrap();
        assert_eq!(fields[0].0, "torque");
        assert_eq!(
            fields[0].1[1],
            ("meaning".to_string(), "µ of the arm".to_string())
        );
        assert_eq!(fields[1], ("bare".to_string(), Vec::new()));
        // A schema that is cut is none, and never a panic.
        for end in 0..text.len() {
            let _ = decoded(&text[..end]);
        }
    }
}
