//! MATLAB's format of level 4, which `-v4`, Dymola and OpenModelica write: a head of twenty bytes before each matrix.
//!
//! ```text
//! type (MOPT in decimal: byte order, 0, number, full / text / sparse), rows, columns, complex, letters of the name; name; values
//! ```

use std::io::{Read, Seek};

use super::survey::Contents;
use super::values::{Stored, Values};
use crate::FileError;
use crate::file::number;
use crate::file::source::Source;
use crate::file::{Property, Value};

/// Longest name and longest text, in letters.
const LONGEST: u64 = 1 << 12;

/// What stands before a matrix.
struct Head {
    stored: Stored,
    /// 0: full, 1: text, 2: sparse.
    class: i32,
    rows: u64,
    columns: u64,
    complex: bool,
    /// Letters of the name with the zero behind it.
    name: u64,
}

impl Head {
    fn read(head: &[u8], big_endian: bool) -> Option<Head> {
        let word = |k: usize| {
            let bytes = head.get(4 * k..4 * k + 4)?;
            Some(number::bits(bytes, big_endian) as i32)
        };
        let kind = word(0)?;
        let size = |k: usize| u64::try_from(word(k)?).ok();
        let stored = match kind / 10 % 10 {
            0 => Stored::F64,
            1 => Stored::F32,
            2 => Stored::I32,
            3 => Stored::I16,
            4 => Stored::U16,
            5 => Stored::U8,
            _ => return None,
        };
        let head = Head {
            stored,
            class: kind % 10,
            rows: size(1)?,
            columns: size(2)?,
            complex: word(3)? == 1,
            name: size(4)?,
        };
        let order = i32::from(big_endian);
        let fits = kind / 100 == 10 * order && head.class <= 2 && (0..=1).contains(&word(3)?);
        (fits && (2..=LONGEST).contains(&head.name)).then_some(head)
    }
}

/// The byte order of a file that starts with these bytes, where it is one of level 4: whether the higher byte stands first.
pub(super) fn big_endian(head: &[u8]) -> Option<bool> {
    [false, true].into_iter().find(|&big| {
        Head::read(head, big).is_some_and(|found| {
            let name = head.get(20..20 + found.name as usize);
            name.is_some_and(|name| {
                let (letters, end) = name.split_at(name.len() - 1);
                end == [0]
                    && letters
                        .iter()
                        .all(|b| b.is_ascii_alphanumeric() || *b == b'_')
            })
        })
    })
}

/// Walks through the matrices.
pub(super) fn survey<S: Read + Seek>(
    source: &mut Source<S>,
    big_endian: bool,
) -> Result<Contents, FileError> {
    let mut found = Contents::default();
    let mut at = 0;
    while at < source.length() {
        let mut bytes = [0; 20];
        let there = source.read_at(at, &mut bytes)?;
        let Some(head) = Head::read(&bytes[..there], big_endian) else {
            let text = format!("byte {at}: no matrix starts here; the rest is left out");
            found.note("", text);
            break;
        };
        let mut name = vec![0; head.name as usize];
        let there = source.read_at(at + 20, &mut name)?;
        name.truncate(there);
        name.retain(|byte| *byte != 0);
        let name = String::from_utf8_lossy(&name).into_owned();
        let start = at + 20 + head.name;
        let count = head.rows.saturating_mul(head.columns);
        let size = head.stored.size() as u64;
        let parts = 1 + u64::from(head.complex);
        let end = start.saturating_add(count.saturating_mul(size).saturating_mul(parts));
        let part = |k: u64| Values {
            start: start.saturating_add(k.saturating_mul(count).saturating_mul(size)),
            end: end.min(source.length()),
            packed: false,
            at: 0,
            stored: head.stored,
            first: 0,
            step: 1,
        };
        match head.class {
            0 if count == 0 => found.note(&name, "is empty"),
            0 if count == 1 && !head.complex => {
                let mut bytes = [0; 8];
                let there = source.read_at(start, &mut bytes)?;
                let value = head.stored.number(&bytes[..there], big_endian);
                let value = Value::Number(value);
                found.properties.push(Property { name, value });
            }
            0 => {
                for k in 0..parts {
                    let values = part(k);
                    let there = values.end.saturating_sub(values.start) / size;
                    let own = match (head.complex, k) {
                        (false, _) => name.clone(),
                        (true, 0) => format!("{name}/real"),
                        (true, _) => format!("{name}/imaginary"),
                    };
                    if there < count {
                        let text = format!("{count} values are stated, {there} are there");
                        found.note(&own, text);
                    }
                    found.matrix(&own, &[head.rows, head.columns], there, &values);
                }
            }
            1 if head.rows == 1 && count <= LONGEST => {}
            1 => found.note(&name, "holds lines of text; it is left out"),
            _ => found.note(&name, "holds a sparse matrix; it is left out"),
        }
        at = end;
    }
    Ok(found)
}
