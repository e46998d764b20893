//! WAV: every type of value, both byte orders, long files, what a crash leaves, and what a hand may break.

use std::io::Cursor;
use std::path::Path;

use proptest::prelude::*;
use recording::file::{self, Format, wav::Wav};
use recording::{Clock, Recording};

fn chunk(name: &[u8; 4], content: &[u8], big: bool) -> Vec<u8> {
    let length = content.len() as u32;
    let mut out = name.to_vec();
    out.extend(if big {
        length.to_be_bytes()
    } else {
        length.to_le_bytes()
    });
    out.extend(content);
    out.resize(out.len() + content.len() % 2, 0);
    out
}

/// The chunk that states the type: code, channels, bits; rate 8000 1/s.
fn layout(code: u16, channels: u16, bits: u16, big: bool) -> Vec<u8> {
    let short = |n: u16| {
        if big {
            n.to_be_bytes()
        } else {
            n.to_le_bytes()
        }
    };
    let long = |n: u32| {
        if big {
            n.to_be_bytes()
        } else {
            n.to_le_bytes()
        }
    };
    let row = channels * bits.div_ceil(8);
    let mut out = Vec::new();
    out.extend(short(code));
    out.extend(short(channels));
    out.extend(long(8000));
    out.extend(long(8000 * u32::from(row)));
    out.extend(short(row));
    out.extend(short(bits));
    out
}

fn riff(name: &[u8; 4], chunks: &[Vec<u8>]) -> Vec<u8> {
    let body = chunks.concat();
    let mut out = name.to_vec();
    let length = body.len() as u32 + 4;
    out.extend(if name == b"RIFX" {
        length.to_be_bytes()
    } else {
        length.to_le_bytes()
    });
    out.extend(b"WAVE");
    out.extend(body);
    out
}

fn simple(code: u16, channels: u16, bits: u16, values: &[u8]) -> Vec<u8> {
    riff(
        b"RIFF",
        &[
            chunk(b"fmt ", &layout(code, channels, bits, false), false),
            chunk(b"data", values, false),
        ],
    )
}

fn open(bytes: &[u8]) -> Wav<Cursor<Vec<u8>>> {
    Wav::from_source(Cursor::new(bytes.to_vec()), Path::new("x.wav")).expect("this is WAV")
}

fn all(file: &mut dyn Recording, channel: usize) -> Vec<f64> {
    let mut values = vec![f64::NAN; file.channels()[channel].count as usize + 1];
    let count = file
        .read(channel, 0, &mut values)
        .expect("the channel can be read");
    values.truncate(count);
    values
}

#[test]
fn every_type_of_value_is_brought_to_its_range() {
    let cases: [(u16, u16, Vec<u8>, [f64; 3]); 6] = [
        (1, 8, vec![0, 128, 192], [-1.0, 0.0, 0.5]),
        (1, 16, vec![0, 0x80, 0, 0, 0, 0x40], [-1.0, 0.0, 0.5]),
        (
            1,
            24,
            vec![0, 0, 0x80, 0xff, 0xff, 0xff, 0, 0, 0x40],
            [-1.0, -(0.5f64.powi(23)), 0.5],
        ),
        (
            1,
            32,
            vec![0, 0, 0, 0x80, 0, 0, 0, 0, 0, 0, 0, 0x40],
            [-1.0, 0.0, 0.5],
        ),
        (
            3,
            32,
            [-2.5f32, 0.0, 0.25]
                .iter()
                .flat_map(|v| v.to_le_bytes())
                .collect(),
            [-2.5, 0.0, 0.25],
        ),
        (
            3,
            64,
            [-2.5f64, 0.0, 0.1]
                .iter()
                .flat_map(|v| v.to_le_bytes())
                .collect(),
            [-2.5, 0.0, 0.1],
        ),
    ];
    for (code, bits, values, expected) in cases {
        let mut file = open(&simple(code, 1, bits, &values));
        assert_eq!(all(&mut file, 0), expected, "{bits} bits");
        assert_eq!(
            file.channels()[0].clock,
            Clock::Uniform {
                first: 0.0,
                interval: 1.0 / 8000.0
            }
        );
        assert_eq!(file.notes(), []);
    }
}

#[test]
fn channels_stand_beside_each_other() {
    let values: Vec<u8> = (0..6i16).flat_map(|v| (v * 256).to_le_bytes()).collect();
    let mut file = open(&simple(1, 2, 16, &values));
    assert_eq!(all(&mut file, 0), [0.0, 2.0 / 128.0, 4.0 / 128.0]);
    assert_eq!(all(&mut file, 1), [1.0 / 128.0, 3.0 / 128.0, 5.0 / 128.0]);
    let mut one = [0.0];
    assert_eq!(file.read(1, 2, &mut one), Ok(1));
    assert_eq!(one, [5.0 / 128.0]);
    assert_eq!(file.read(1, u64::MAX, &mut one), Ok(0));
    assert!(file.read(2, 0, &mut one).is_err());
}

#[test]
fn the_extensible_and_the_big_endian_format_are_read() {
    let mut extensible = layout(0xfffe, 1, 24, false);
    extensible.extend([22, 0, 20, 0, 0, 0, 0, 0, 1, 0]);
    extensible.extend([0; 14]);
    let bytes = riff(
        b"RIFF",
        &[
            chunk(b"fmt ", &extensible, false),
            chunk(b"data", &[0, 0, 0x40], false),
        ],
    );
    assert_eq!(all(&mut open(&bytes), 0), [0.5]);
    let big = riff(
        b"RIFX",
        &[
            chunk(b"fmt ", &layout(1, 1, 16, true), true),
            chunk(b"data", &[0x40, 0, 0x80, 0], true),
        ],
    );
    assert_eq!(all(&mut open(&big), 0), [0.5, -1.0]);
}

/// A file of the long format: the lengths of the ordinary chunks are all ones.
fn long() -> Vec<u8> {
    let mut sizes = vec![0; 28];
    sizes[8..16].copy_from_slice(&4u64.to_le_bytes());
    let mut data = chunk(b"data", &[0, 0x40, 0, 0xc0], false);
    data[4..8].fill(0xff);
    let mut bytes = riff(
        b"RF64",
        &[
            chunk(b"ds64", &sizes, false),
            chunk(b"fmt ", &layout(1, 1, 16, false), false),
            data,
        ],
    );
    bytes[4..8].fill(0xff);
    bytes.extend(chunk(b"junk", &[9; 8], false));
    bytes
}

#[test]
fn the_long_format_is_read() {
    let mut file = open(&long());
    assert_eq!(all(&mut file, 0), [0.5, -0.5]);
    assert_eq!(file.notes(), []);
}

/// A file with odd chunks and remarks.
fn remarks() -> Vec<u8> {
    let mut list = b"INFO".to_vec();
    list.extend(chunk(b"INAM", b"run 7\0", false));
    list.extend(chunk(b"ICRD", b"202", false));
    riff(
        b"RIFF",
        &[
            chunk(b"LIST", &list, false),
            chunk(b"odd ", &[1, 2, 3], false),
            chunk(b"fmt ", &layout(1, 1, 8, false), false),
            chunk(b"data", &[128, 192, 0], false),
        ],
    )
}

#[test]
fn odd_chunks_and_remarks_are_skipped() {
    let mut file = open(&remarks());
    assert_eq!(all(&mut file, 0), [0.0, 0.5, -1.0]);
}

#[test]
fn values_that_are_cut_off_or_never_counted_are_read_as_far_as_they_are_there() {
    let whole = simple(1, 2, 16, &[0, 0x40, 0, 0x20, 0, 0x10, 0, 0x08]);
    let mut cut = open(&whole[..whole.len() - 1]);
    assert_eq!(all(&mut cut, 1), [0.25]);
    assert_eq!(cut.notes().len(), 2, "{:?}", cut.notes());
    assert!(
        cut.notes()[0]
            .text
            .contains("8 bytes are stated, 7 are there")
    );
    let mut uncounted = whole.clone();
    let length = whole.len() - 12;
    uncounted[length..length + 4].fill(0);
    let mut uncounted = open(&uncounted);
    assert_eq!(all(&mut uncounted, 0), [0.5, 0.125]);
    assert!(uncounted.notes()[0].text.contains("never entered"));
}

#[test]
fn what_cannot_be_read_is_reported() {
    let error = |bytes: &[u8]| {
        Wav::from_source(Cursor::new(bytes.to_vec()), Path::new("x.wav"))
            .err()
            .map(|e| e.to_string())
            .unwrap_or_default()
    };
    assert!(error(b"RIFF\0\0\0\0AVI ").contains("no WAV"));
    assert!(error(&simple(2, 1, 4, &[1, 2])).contains("type 0x2"));
    assert!(error(&riff(b"RIFF", &[chunk(b"data", &[1], false)])).contains("fmt "));
    assert!(
        error(&riff(
            b"RIFF",
            &[chunk(b"fmt ", &layout(1, 1, 16, false), false)]
        ))
        .contains("data")
    );
    assert!(error(&simple(1, 0, 16, &[1, 2])).contains("0 channels"));
}

#[test]
fn a_file_is_recognised_by_its_content() {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("content.dat");
    std::fs::write(&path, simple(1, 1, 16, &[0, 0x40])).unwrap();
    assert_eq!(all(file::open(&path).unwrap().as_mut(), 0), [0.5]);
    assert_eq!(Format::of(&long()), Some(Format::Wav));
}

fn read_whatever(bytes: &[u8]) {
    let Ok(mut file) = Wav::from_source(Cursor::new(bytes), Path::new("x.wav")) else {
        return;
    };
    let count = file.channels().first().map_or(0, |c| c.count);
    let mut values = [0.0; 64];
    for channel in 0..file.channels().len().min(4) {
        for first in [0, 1, count.saturating_sub(64), count] {
            let read = file
                .read(channel, first, &mut values)
                .expect("what is counted can be read");
            assert_eq!(read as u64, count.saturating_sub(first).min(64));
        }
    }
}

#[test]
fn a_file_cut_at_any_byte_neither_panics_nor_hangs() {
    for bytes in [long(), remarks(), simple(3, 2, 64, &[7; 64])] {
        for end in 0..bytes.len() {
            read_whatever(&bytes[..end]);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn broken_bytes_neither_panic_nor_hang(which in 0usize..3, flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8)) {
        let mut bytes = [long(), remarks(), simple(3, 2, 64, &[7; 64])][which].clone();
        for (at, value) in flips {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        read_whatever(&bytes);
    }
}
