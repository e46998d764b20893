//! The Arrow schema that travels in a Parquet file under the key `ARROW:schema`.
//!
//! Parquet itself has no place for the unit of a column. Readers built on Arrow (pyarrow, pandas, polars, DuckDB, R)
//! take column metadata from an Arrow IPC message that the writer leaves beside the file's own schema. A table of
//! doubles needs four of its tables; they are laid out here as FlatBuffers, so that no Arrow library is built in.
//!
//! Source: Apache Arrow, format/Message.fbs and format/Schema.fbs; FlatBuffers, "Internals".

use super::page::base64;

/// Key of the schema in the metadata of a Parquet file.
pub(super) const KEY: &str = "ARROW:schema";

/// `MetadataVersion.V5`.
const VERSION: i16 = 4;
/// `MessageHeader.Schema`.
const HEADER_SCHEMA: u8 = 1;
/// `Type.FloatingPoint`.
const TYPE_FLOATING_POINT: u8 = 3;
/// `Precision.DOUBLE`.
const PRECISION_DOUBLE: i16 = 2;

/// One column of doubles.
pub(super) struct Field<'a> {
    /// Name of the column.
    pub name: &'a str,
    /// Whether cells may be empty.
    pub nullable: bool,
    /// Its metadata.
    pub metadata: &'a [(&'static str, &'a str)],
}

/// The schema of a table of doubles, as the text that stands under [`KEY`].
pub(super) fn encoded(fields: &[Field]) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads FlatBuffers by their published rules, apart from the writer.
    struct Reader<'a>(&'a [u8]);

    impl Reader<'_> {
        fn word(&self, at: usize) -> usize {
            assert_eq!(at % 4, 0, "aligned");
            u32::from_le_bytes(self.0[at..at + 4].try_into().unwrap()) as usize
        }
        fn half(&self, at: usize) -> usize {
            assert_eq!(at % 2, 0, "aligned");
            u16::from_le_bytes(self.0[at..at + 2].try_into().unwrap()) as usize
        }
        fn follow(&self, at: usize) -> usize {
            at + self.word(at)
        }
        /// Position of a field of a table; none where it has its default.
        fn field(&self, table: usize, index: usize) -> Option<usize> {
            let offsets = table - self.word(table);
            let inside = 4 + 2 * index < self.half(offsets);
            let offset = if inside {
                self.half(offsets + 4 + 2 * index)
            } else {
                0
            };
            (offset != 0).then_some(table + offset)
        }
        fn below(&self, table: usize, index: usize) -> usize {
            self.follow(self.field(table, index).unwrap())
        }
        fn list(&self, at: usize) -> Vec<usize> {
            (0..self.word(at))
                .map(|index| self.follow(at + 4 + 4 * index))
                .collect()
        }
        fn text(&self, at: usize) -> &str {
            let length = self.word(at);
            assert_eq!(self.0[at + 4 + length], 0, "ends with a zero");
            std::str::from_utf8(&self.0[at + 4..at + 4 + length]).unwrap()
        }
    }

    fn decode(text: &str) -> Vec<u8> {
        const LETTERS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        let (mut bytes, mut word, mut bits) = (Vec::new(), 0u32, 0);
        for letter in text.trim_end_matches('=').chars() {
            word = word << 6 | LETTERS.find(letter).unwrap() as u32;
            bits += 6;
            if bits >= 8 {
                bits -= 8;
                bytes.push((word >> bits) as u8);
                word &= (1 << bits) - 1;
            }
        }
        bytes
    }

    #[test]
    fn a_reader_of_flatbuffers_finds_every_field() {
        let fields = [
            Field {
                name: "time",
                nullable: false,
                metadata: &[("unit", "s"), ("meaning", "since the release")],
            },
            Field {
                name: "ω",
                nullable: true,
                metadata: &[],
            },
        ];
        let bytes = decode(&encoded(&fields));
        assert_eq!(bytes[..4], [0xff; 4]);
        let length = u32::from_le_bytes(bytes[4..8].try_into().unwrap()) as usize;
        assert_eq!(length, bytes.len() - 8);
        assert_eq!(length % 8, 0);

        let reader = Reader(&bytes[8..]);
        let message = reader.follow(0);
        assert_eq!(reader.half(reader.field(message, 0).unwrap()), 4);
        assert_eq!(reader.0[reader.field(message, 1).unwrap()], 1);
        assert_eq!(reader.field(message, 3), None);
        let schema = reader.below(message, 2);
        let found = reader.list(reader.below(schema, 1));
        assert_eq!(found.len(), 2);
        for (table, field) in found.into_iter().zip(&fields) {
            assert_eq!(reader.text(reader.below(table, 0)), field.name);
            let nullable = reader.0[reader.field(table, 1).unwrap()];
            assert_eq!(nullable, u8::from(field.nullable));
            assert_eq!(reader.0[reader.field(table, 2).unwrap()], 3);
            let kind = reader.below(table, 3);
            assert_eq!(reader.half(reader.field(kind, 0).unwrap()), 2);
            assert!(reader.list(reader.below(table, 5)).is_empty());
            let pairs: Vec<(&str, &str)> = reader
                .list(reader.below(table, 6))
                .into_iter()
                .map(|pair| {
                    (
                        reader.text(reader.below(pair, 0)),
                        reader.text(reader.below(pair, 1)),
                    )
                })
                .collect();
            assert_eq!(pairs, field.metadata);
        }
    }
}
