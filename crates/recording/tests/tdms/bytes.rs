//! Writes TDMS byte by byte, as its description has it.

/// A value of a property as the format writes it.
pub enum Set<'a> {
    Text(&'a str),
    Double(f64),
    Whole(u32),
    Time(i64, u64),
}

/// Where an object's raw data stand.
pub enum Raw {
    None,
    Same,
    /// Type, number of values.
    Plain(u32, u64),
    /// Number of texts, bytes of all.
    Texts(u64, u64),
    /// Digital, number of values, scalers (type, buffer, offset, scale), widths.
    Daqmx(bool, u64, Vec<[u32; 4]>, Vec<u32>),
}

/// Writes numbers in either byte order.
pub struct Bytes {
    pub out: Vec<u8>,
    pub big: bool,
}

impl Bytes {
    pub fn u32(&mut self, number: u32) {
        self.out.extend(if self.big {
            number.to_be_bytes()
        } else {
            number.to_le_bytes()
        });
    }
    pub fn u64(&mut self, number: u64) {
        self.out.extend(if self.big {
            number.to_be_bytes()
        } else {
            number.to_le_bytes()
        });
    }
    pub fn text(&mut self, text: &str) {
        self.u32(text.len() as u32);
        self.out.extend(text.as_bytes());
    }
}

pub const META: u32 = 2;
pub const NEW: u32 = 4;
pub const RAW: u32 = 8;
pub const INTERLEAVED: u32 = 32;
pub const BIG: u32 = 64;
pub const DAQMX: u32 = 128;

pub type ObjectOf<'a> = (&'a str, Raw, Vec<(&'a str, Set<'a>)>);

pub fn meta(big: bool, objects: &[ObjectOf]) -> Vec<u8> {
    let mut b = Bytes {
        out: Vec::new(),
        big,
    };
    b.u32(objects.len() as u32);
    for (path, raw, properties) in objects {
        b.text(path);
        match raw {
            Raw::None => b.u32(u32::MAX),
            Raw::Same => b.u32(0),
            Raw::Plain(kind, count) => {
                b.u32(20);
                b.u32(*kind);
                b.u32(1);
                b.u64(*count);
            }
            Raw::Texts(count, bytes) => {
                b.u32(28);
                b.u32(0x20);
                b.u32(1);
                b.u64(*count);
                b.u64(*bytes);
            }
            Raw::Daqmx(digital, count, scalers, widths) => {
                b.u32(if *digital { 0x126a } else { 0x1269 });
                b.u32(u32::MAX);
                b.u32(1);
                b.u64(*count);
                b.u32(scalers.len() as u32);
                for [kind, buffer, offset, scale] in scalers {
                    b.u32(*kind);
                    b.u32(*buffer);
                    b.u32(*offset);
                    if *digital {
                        b.out.push(0);
                    } else {
                        b.u32(0);
                    }
                    b.u32(*scale);
                }
                b.u32(widths.len() as u32);
                for width in widths {
                    b.u32(*width);
                }
            }
        }
        b.u32(properties.len() as u32);
        for (name, value) in properties {
            b.text(name);
            match value {
                Set::Text(text) => {
                    b.u32(0x20);
                    b.text(text);
                }
                Set::Double(number) => {
                    b.u32(10);
                    b.u64(number.to_bits());
                }
                Set::Whole(number) => {
                    b.u32(7);
                    b.u32(*number);
                }
                Set::Time(seconds, fraction) => {
                    b.u32(0x44);
                    let parts = [*fraction, *seconds as u64];
                    for i in if big { [1, 0] } else { [0, 1] } {
                        b.u64(parts[i]);
                    }
                }
            }
        }
    }
    b.out
}

pub fn segment(flags: u32, meta: &[u8], raw: &[u8]) -> Vec<u8> {
    let mut b = Bytes {
        out: b"TDSm".to_vec(),
        big: flags & BIG != 0,
    };
    b.out.extend(flags.to_le_bytes());
    b.u32(4713);
    b.u64((meta.len() + raw.len()) as u64);
    b.u64(meta.len() as u64);
    b.out.extend(meta);
    b.out.extend(raw);
    b.out
}
