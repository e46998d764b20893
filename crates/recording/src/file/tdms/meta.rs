//! The meta data of a segment: objects, where their raw data stand, and their properties.

use super::kind::{EPOCH, FRACTION, Kind, Stamp, stamp};
use crate::Instant;
use crate::file::{Value, number};

/// What is wrong with meta data.
pub type Wrong = String;

/// Where the raw data of an object stand in a chunk, as its meta data state.
#[derive(Clone, Debug, PartialEq)]
pub enum RawIndex {
    /// Values of one type; `bytes` of all of them.
    Plain { kind: Kind, count: u64, bytes: u64 },
    /// Values out of the raw buffers of a DAQmx task.
    Daqmx {
        count: u64,
        scalers: Vec<Scaler>,
        widths: Vec<u32>,
    },
    /// Values of a type whose size is not known here.
    Unknown { code: u32 },
}

/// Where the raw values of one DAQmx scale stand in a row of a raw buffer.
#[derive(Clone, Debug, PartialEq)]
pub struct Scaler {
    /// The type; none where it is not known here.
    pub kind: Option<Kind>,
    /// Which raw buffer.
    pub buffer: u32,
    /// Byte within a row of the buffer.
    pub offset: u32,
    /// The scale that takes the values.
    pub scale: u32,
}

/// Where an object's raw data stand, as meta data state.
#[derive(Clone, Debug, PartialEq)]
pub enum Placement {
    /// The object has none in this segment.
    None,
    /// As in the segment before.
    Same,
    /// Anew.
    New(RawIndex),
}

/// Bytes of meta data, read one after the other.
pub struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    big: bool,
}

/// The first bytes of a raw data index of DAQmx with scalers that change the format.
const FORMAT_CHANGING: u32 = 0x1269;
/// The first bytes of one with scalers of digital lines; the second spelling stands in the format's description (from
/// memory), the first is what files carry.
const DIGITAL_LINE: [u32; 2] = [0x126a, 0x1369];

impl<'a> Cursor<'a> {
    /// Reads from the start of `bytes`, with the highest byte of a number first if `big`.
    pub fn new(bytes: &'a [u8], big: bool) -> Cursor<'a> {
        Cursor { bytes, at: 0, big }
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], Wrong> {
        let end = self
            .at
            .checked_add(count)
            .filter(|&end| end <= self.bytes.len());
        let Some(end) = end else {
            return Err(format!(
                "meta data ask for {count} bytes where {} are left",
                self.bytes.len() - self.at
            ));
        };
        let taken = &self.bytes[self.at..end];
        self.at = end;
        Ok(taken)
    }

    /// A whole number of four bytes.
    pub fn u32(&mut self) -> Result<u32, Wrong> {
        Ok(number::bits(self.take(4)?, self.big) as u32)
    }

    /// A whole number of eight bytes.
    pub fn u64(&mut self) -> Result<u64, Wrong> {
        Ok(number::bits(self.take(8)?, self.big))
    }

    /// A text behind its length.
    pub fn text(&mut self) -> Result<String, Wrong> {
        let count = self.u32()?;
        Ok(String::from_utf8_lossy(self.take(count as usize)?).into_owned())
    }

    /// Where the raw data of an object stand.
    pub fn raw_index(&mut self) -> Result<Placement, Wrong> {
        let first = self.u32()?;
        match first {
            0xffff_ffff => Ok(Placement::None),
            0 => Ok(Placement::Same),
            FORMAT_CHANGING => self.daqmx(false),
            digital if DIGITAL_LINE.contains(&digital) => self.daqmx(true),
            _ => self.plain().map(Placement::New),
        }
    }

    fn plain(&mut self) -> Result<RawIndex, Wrong> {
        let code = self.u32()?;
        let _dimension = self.u32()?;
        let count = self.u64()?;
        let bytes = if code == 0x20 { self.u64()? } else { 0 };
        Ok(match Kind::of_type(code) {
            None => RawIndex::Unknown { code },
            Some(Kind::Text) => RawIndex::Plain {
                kind: Kind::Text,
                count,
                bytes,
            },
            Some(kind) => RawIndex::Plain {
                kind,
                count,
                bytes: count.saturating_mul(kind.size()),
            },
        })
    }

    fn daqmx(&mut self, digital: bool) -> Result<Placement, Wrong> {
        let _type = self.u32()?;
        let _dimension = self.u32()?;
        let count = self.u64()?;
        let mut scalers = Vec::new();
        for _ in 0..self.u32()? {
            let kind = Kind::of_daqmx(self.u32()?);
            let buffer = self.u32()?;
            let offset = self.u32()?;
            let scaler = if digital {
                let _bitmap = self.take(1)?;
                // The offset counts bits; the lowest bit of the value is the line.
                let kind = kind.map(|_| Kind::Bit((offset % 8) as u8));
                Scaler {
                    kind,
                    buffer,
                    offset: offset / 8,
                    scale: self.u32()?,
                }
            } else {
                let _bitmap = self.u32()?;
                Scaler {
                    kind,
                    buffer,
                    offset,
                    scale: self.u32()?,
                }
            };
            scalers.push(scaler);
        }
        let mut widths = Vec::new();
        for _ in 0..self.u32()? {
            widths.push(self.u32()?);
        }
        Ok(Placement::New(RawIndex::Daqmx {
            count,
            scalers,
            widths,
        }))
    }

    /// A property: its name and value.
    pub fn property(&mut self) -> Result<(String, Value), Wrong> {
        let name = self.text()?;
        let code = self.u32()?;
        let Some(kind) = Kind::of_type(code) else {
            return Err(format!(
                "property '{name}' is of a type ({code:#x}) whose size is not known"
            ));
        };
        let value = match kind {
            Kind::Text => Value::Text(self.text()?),
            Kind::Flag => Value::Text(format!("{}", self.take(1)?[0] != 0)),
            Kind::Time => Value::Time(instant(stamp(self.take(16)?, self.big))),
            _ => {
                let raw = self.take(kind.size() as usize)?;
                let mut parts = [f64::NAN; 2];
                let part = kind.component().size() as usize;
                super::kind::decode(kind, self.big, raw, part, (0, 0), &mut parts);
                if kind.is_complex() {
                    Value::Text(format!("{} + {} i", parts[0], parts[1]))
                } else {
                    Value::Number(parts[0])
                }
            }
        };
        Ok((name, value))
    }
}

/// The instant of a time stamp.
pub fn instant((seconds, fraction): Stamp) -> Instant {
    // A fraction that rounds to one would leave its range.
    let fraction = (fraction as f64 * FRACTION).min(1.0 - f64::EPSILON / 2.0);
    Instant {
        seconds: seconds.saturating_sub(EPOCH),
        fraction,
    }
}

/// The names in an object's path: none for the file, one for a group, two for a channel; the path itself where it is of
/// another form.
pub fn names(path: &str) -> Vec<String> {
    if path == "/" {
        return Vec::new();
    }
    let mut names = Vec::new();
    let mut rest = path;
    while let Some(quoted) = rest.strip_prefix("/'") {
        let mut name = String::new();
        let mut letters = quoted.char_indices().peekable();
        let mut end = None;
        while let Some((at, letter)) = letters.next() {
            if letter != '\'' {
                name.push(letter);
            } else if letters.next_if(|next| next.1 == '\'').is_some() {
                name.push('\'');
            } else {
                end = Some(at + 1);
                break;
            }
        }
        let Some(end) = end else {
            return vec![path.to_owned()];
        };
        names.push(name);
        rest = &quoted[end..];
    }
    if rest.is_empty() {
        names
    } else {
        vec![path.to_owned()]
    }
}
