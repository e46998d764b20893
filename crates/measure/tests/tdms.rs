//! TDMS: files of the format's own making, real files, what a crash leaves, and what a hand may break.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use measure::file::{self, tdms::Tdms};
use measure::recording::{Channel, Clock, Content, Instant, Property, Recording, Value};
use proptest::prelude::*;

/// A value of a property as the format writes it.
enum Set<'a> {
    Text(&'a str),
    Double(f64),
    Whole(u32),
    Time(i64, u64),
}

/// Where an object's raw data stand.
enum Raw {
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
struct Bytes {
    out: Vec<u8>,
    big: bool,
}

impl Bytes {
    fn u32(&mut self, number: u32) {
        self.out.extend(if self.big {
            number.to_be_bytes()
        } else {
            number.to_le_bytes()
        });
    }
    fn u64(&mut self, number: u64) {
        self.out.extend(if self.big {
            number.to_be_bytes()
        } else {
            number.to_le_bytes()
        });
    }
    fn text(&mut self, text: &str) {
        self.u32(text.len() as u32);
        self.out.extend(text.as_bytes());
    }
}

const META: u32 = 2;
const NEW: u32 = 4;
const RAW: u32 = 8;
const INTERLEAVED: u32 = 32;
const BIG: u32 = 64;
const DAQMX: u32 = 128;

type ObjectOf<'a> = (&'a str, Raw, Vec<(&'a str, Set<'a>)>);

fn meta(big: bool, objects: &[ObjectOf]) -> Vec<u8> {
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

fn segment(flags: u32, meta: &[u8], raw: &[u8]) -> Vec<u8> {
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

/// The file of these bytes, also left where a peer can read it.
fn open(name: &str, bytes: &[u8]) -> Tdms<Cursor<Vec<u8>>> {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, bytes).expect("the folder for tests can be written");
    Tdms::from_source(Cursor::new(bytes.to_vec()), &path).expect("the first bytes are TDMS")
}

fn all(file: &mut dyn Recording, channel: usize) -> Vec<f64> {
    let count = file.channels()[channel].count as usize;
    let mut values = vec![f64::NAN; count + 1];
    assert_eq!(
        file.read(channel, 0, &mut values)
            .expect("the channel can be read"),
        count
    );
    values.truncate(count);
    values
}

fn doubles(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// A file with what changes from segment to segment: counts, lists, repeated segments, two chunks, interleaved values.
fn changing() -> Vec<u8> {
    let mut bytes = segment(
        META | NEW | RAW,
        &meta(
            false,
            &[
                ("/", Raw::None, vec![("operator", Set::Text("A"))]),
                ("/'g'", Raw::None, vec![("rig", Set::Double(6.0))]),
                (
                    "/'g'/'it''s a'",
                    Raw::Plain(10, 2),
                    vec![
                        ("unit_string", Set::Text("rad/s")),
                        ("wf_increment", Set::Double(0.5)),
                    ],
                ),
                ("/'g'/'b'", Raw::Plain(3, 1), vec![]),
            ],
        ),
        &[
            doubles(&[1.0, 2.0]),
            (-7i32).to_le_bytes().to_vec(),
            doubles(&[3.0, 4.0]),
            8i32.to_le_bytes().to_vec(),
        ]
        .concat(),
    );
    // No meta data at all: as before.
    bytes.extend(segment(
        RAW,
        &[],
        &[doubles(&[5.0, 6.0]), 9i32.to_le_bytes().to_vec()].concat(),
    ));
    // Properties only.
    bytes.extend(segment(
        META,
        &meta(
            false,
            &[("/'g'/'b'", Raw::Same, vec![("unit_string", Set::Text("N"))])],
        ),
        &[],
    ));
    // A third channel joins; interleaved.
    bytes.extend(segment(
        META | RAW | INTERLEAVED,
        &meta(
            false,
            &[
                ("/'g'/'it''s a'", Raw::Plain(10, 1), vec![]),
                ("/'g'/'c'", Raw::Plain(9, 1), vec![]),
            ],
        ),
        &[
            doubles(&[7.0]),
            10i32.to_le_bytes().to_vec(),
            0.5f32.to_le_bytes().to_vec(),
        ]
        .concat(),
    ));
    // A new list without the first channel.
    bytes.extend(segment(
        META | NEW | RAW,
        &meta(
            false,
            &[
                ("/'g'/'c'", Raw::Plain(9, 2), vec![]),
                ("/'g'/'b'", Raw::None, vec![]),
            ],
        ),
        &[1.5f32.to_le_bytes(), 2.5f32.to_le_bytes()].concat(),
    ));
    bytes
}

#[test]
fn lists_counts_and_chunks_may_change_from_segment_to_segment() {
    let mut file = open("changing.tdms", &changing());
    let names: Vec<&str> = file.channels().iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["g/it's a", "g/b", "g/c"]);
    assert_eq!(file.notes(), []);
    assert_eq!(all(&mut file, 0), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    assert_eq!(all(&mut file, 1), [-7.0, 8.0, 9.0, 10.0]);
    assert_eq!(all(&mut file, 2), [0.5, 1.5, 2.5]);
    assert_eq!(file.channels()[0].unit, "rad/s");
    assert_eq!(file.channels()[1].unit, "N");
    assert_eq!(
        file.channels()[0].clock,
        Clock::Uniform {
            first: 0.0,
            interval: 0.5
        }
    );
    assert_eq!(file.channels()[1].clock, Clock::Unknown);
    let expected = [
        ("operator", Value::Text("A".into())),
        ("g/rig", Value::Number(6.0)),
    ];
    let expected = expected.map(|(name, value)| Property {
        name: name.into(),
        value,
    });
    assert_eq!(file.properties(), expected);
}

#[test]
fn a_range_is_the_same_piece_of_the_whole() {
    let mut file = open("changing.tdms", &changing());
    let whole = all(&mut file, 0);
    // Backwards, so that no reading goes on from the one before.
    for first in (0..whole.len()).rev() {
        for count in 1..=whole.len() - first {
            let mut values = vec![0.0; count];
            assert_eq!(file.read(0, first as u64, &mut values), Ok(count));
            assert_eq!(values, whole[first..first + count]);
        }
    }
    assert_eq!(file.read(0, 7, &mut [0.0]), Ok(0));
    assert_eq!(file.read(0, u64::MAX, &mut [0.0]), Ok(0));
    assert!(file.read(3, 0, &mut [0.0]).is_err());
    assert!(
        file.read_text(0, 0, 1)
            .is_err_and(|e| e.to_string().contains("g/it's a"))
    );
}

#[test]
fn every_numeric_type_is_read_in_both_byte_orders() {
    for big in [false, true] {
        let mut raw = Vec::new();
        let mut objects: Vec<ObjectOf> = Vec::new();
        let paths: Vec<String> = (0..12).map(|i| format!("/'g'/'{i}'")).collect();
        macro_rules! put {
            ($place:literal, $code:literal, $values:expr) => {
                for value in $values {
                    raw.extend(if big {
                        value.to_be_bytes()
                    } else {
                        value.to_le_bytes()
                    });
                }
                objects.push((&paths[$place], Raw::Plain($code, 2), vec![]));
            };
        }
        put!(0, 1, [-128i8, 127]);
        put!(1, 2, [-32768i16, 258]);
        put!(2, 3, [-2_147_483_648i32, 66051]);
        put!(3, 4, [-4_503_599_627_370_497i64, 1]);
        put!(4, 5, [255u8, 1]);
        put!(5, 6, [65535u16, 258]);
        put!(6, 7, [4_294_967_295u32, 1]);
        put!(7, 8, [9_007_199_254_740_991u64, 1]);
        put!(8, 9, [-1.5f32, 0.25]);
        put!(9, 0x1a, [-1.0e300f64, 0.1]);
        put!(10, 0x21, [0u8, 1]);
        // Complex, double: two values of two parts.
        for value in [1.0f64, 2.0, 3.0, 4.0] {
            raw.extend(if big {
                value.to_be_bytes()
            } else {
                value.to_le_bytes()
            });
        }
        objects.push((&paths[11], Raw::Plain(0x10_000d, 2), vec![]));
        let flags = META | NEW | RAW | if big { BIG } else { 0 };
        let name = if big {
            "types_big.tdms"
        } else {
            "types_little.tdms"
        };
        let mut file = open(name, &segment(flags, &meta(big, &objects), &raw));
        let expected = [
            [-128.0, 127.0],
            [-32768.0, 258.0],
            [-2_147_483_648.0, 66051.0],
            [-4_503_599_627_370_497.0, 1.0],
            [255.0, 1.0],
            [65535.0, 258.0],
            [4_294_967_295.0, 1.0],
            [9_007_199_254_740_991.0, 1.0],
            [-1.5, 0.25],
            [-1.0e300, 0.1],
            [0.0, 1.0],
            [1.0, 3.0],
            [2.0, 4.0],
        ];
        assert_eq!(file.channels().len(), expected.len());
        for (channel, expected) in expected.iter().enumerate() {
            assert_eq!(
                all(&mut file, channel),
                expected,
                "channel {channel}, big {big}"
            );
        }
        assert_eq!(file.channels()[12].name, "g/11 (imaginary)");
    }
}

#[test]
fn texts_and_time_stamps_are_read() {
    let half = 1u64 << 63;
    let texts: Vec<u8> = [3u32, 3, 8]
        .iter()
        .flat_map(|end| end.to_le_bytes())
        .chain(*b"offgrips")
        .collect();
    let mut raw = [texts.clone(), texts].concat();
    // Two chunks of three texts each are one piece: the stamps follow in each chunk.
    raw.truncate(20);
    for (seconds, fraction) in [(3_800_000_000u64, half), (3_800_000_002, 0)] {
        raw.extend(fraction.to_le_bytes());
        raw.extend(seconds.to_le_bytes());
    }
    let twice = [raw.clone(), raw].concat();
    let objects = [
        ("/'g'/'state'", Raw::Texts(3, 20), vec![]),
        ("/'g'/'when'", Raw::Plain(0x44, 2), vec![]),
    ];
    let mut file = open(
        "texts.tdms",
        &segment(META | NEW | RAW, &meta(false, &objects), &twice),
    );
    assert_eq!(file.channels()[0].content, Content::Text);
    assert_eq!(
        file.read_text(0, 0, 9).unwrap(),
        ["off", "", "grips", "off", "", "grips"]
    );
    assert_eq!(file.read_text(0, 2, 2).unwrap(), ["grips", "off"]);
    assert!(file.read(0, 0, &mut [0.0]).is_err());
    assert_eq!(file.channels()[1].content, Content::Time);
    assert_eq!(
        file.channels()[1].start,
        Some(Instant {
            seconds: 3_800_000_000 - 2_082_844_800,
            fraction: 0.5
        })
    );
    assert_eq!(all(&mut file, 1), [0.0, 1.5, 0.0, 1.5]);
}

#[test]
fn an_unset_start_is_none_and_a_set_one_is_kept() {
    let start = |seconds| {
        vec![
            ("wf_start_time", Set::Time(seconds, 0)),
            ("wf_start_offset", Set::Double(2.0)),
            ("wf_increment", Set::Double(0.1)),
        ]
    };
    let objects = [
        ("/'g'/'a'", Raw::Plain(5, 1), start(0)),
        ("/'g'/'b'", Raw::Plain(5, 1), start(2_082_844_801)),
    ];
    let file = open(
        "start.tdms",
        &segment(META | NEW | RAW, &meta(false, &objects), &[1, 2]),
    );
    assert_eq!(file.channels()[0].start, None);
    assert_eq!(
        file.channels()[1].start,
        Some(Instant {
            seconds: 1,
            fraction: 0.0
        })
    );
    assert_eq!(
        file.channels()[1].clock,
        Clock::Uniform {
            first: 2.0,
            interval: 0.1
        }
    );
}

/// Two devices with buffers of their own width; three analogue channels, the second scaled twice over.
fn daqmx() -> Vec<u8> {
    let linear = |slope, intercept| {
        vec![
            ("NI_Scaling_Status", Set::Text("unscaled")),
            ("NI_Number_Of_Scales", Set::Whole(2)),
            ("NI_Scale[1]_Scale_Type", Set::Text("Linear")),
            ("NI_Scale[1]_Linear_Slope", Set::Double(slope)),
            ("NI_Scale[1]_Linear_Y_Intercept", Set::Double(intercept)),
            ("NI_Scale[1]_Linear_Input_Source", Set::Whole(0)),
        ]
    };
    let mut twice = linear(2.0, 1.0);
    twice[1].1 = Set::Whole(3);
    twice.extend([
        ("NI_Scale[2]_Scale_Type", Set::Text("Polynomial")),
        ("NI_Scale[2]_Polynomial_Coefficients_Size", Set::Whole(3)),
        ("NI_Scale[2]_Polynomial_Coefficients[0]", Set::Double(0.5)),
        ("NI_Scale[2]_Polynomial_Coefficients[1]", Set::Double(0.0)),
        ("NI_Scale[2]_Polynomial_Coefficients[2]", Set::Double(3.0)),
        ("NI_Scale[2]_Polynomial_Input_Source", Set::Whole(1)),
    ]);
    let objects = [
        (
            "/'g'/'a'",
            Raw::Daqmx(false, 2, vec![[3, 0, 0, 0]], vec![6, 4]),
            linear(0.5, -1.0),
        ),
        (
            "/'g'/'b'",
            Raw::Daqmx(false, 2, vec![[5, 0, 2, 0]], vec![6, 4]),
            twice,
        ),
        (
            "/'g'/'c'",
            Raw::Daqmx(false, 2, vec![[2, 1, 2, 0]], vec![6, 4]),
            vec![],
        ),
    ];
    let mut raw = Vec::new();
    for (a, b) in [(-3i16, 100_000i32), (4, -2)] {
        raw.extend(a.to_le_bytes());
        raw.extend(b.to_le_bytes());
    }
    for c in [7u16, 65535] {
        raw.extend([0xaa, 0xbb]);
        raw.extend(c.to_le_bytes());
    }
    let twice = [raw.clone(), raw].concat();
    segment(META | NEW | RAW | DAQMX, &meta(false, &objects), &twice)
}

#[test]
fn raw_data_of_daqmx_are_scaled() {
    let mut file = open("daqmx.tdms", &daqmx());
    assert_eq!(file.notes(), []);
    assert_eq!(all(&mut file, 0), [-2.5, 1.0, -2.5, 1.0]);
    let b = |x: f64| 0.5 + 3.0 * (1.0 + 2.0 * x) * (1.0 + 2.0 * x);
    assert_eq!(
        all(&mut file, 1),
        [b(100_000.0), b(-2.0), b(100_000.0), b(-2.0)]
    );
    assert_eq!(all(&mut file, 2), [7.0, 65535.0, 7.0, 65535.0]);
}

#[test]
fn digital_lines_of_daqmx_are_bits() {
    let line = |bit| Raw::Daqmx(true, 4, vec![[4, 0, bit, 0]], vec![4]);
    let objects = [
        ("/'g'/'0'", line(0), vec![]),
        ("/'g'/'1'", line(1), vec![]),
        ("/'g'/'9'", line(9), vec![]),
    ];
    let raw: Vec<u8> = [0x001u32, 0x203, 0x200, 0x002]
        .iter()
        .flat_map(|w| w.to_le_bytes())
        .collect();
    let mut file = open(
        "digital.tdms",
        &segment(META | NEW | RAW | DAQMX, &meta(false, &objects), &raw),
    );
    assert_eq!(all(&mut file, 0), [1.0, 1.0, 0.0, 0.0]);
    assert_eq!(all(&mut file, 1), [0.0, 1.0, 0.0, 1.0]);
    assert_eq!(all(&mut file, 2), [0.0, 1.0, 1.0, 0.0]);
}

#[test]
fn plain_values_are_scaled_and_unknown_scales_are_told() {
    let scale = |kind| {
        vec![
            ("NI_Scaling_Status", Set::Text("unscaled")),
            ("NI_Number_Of_Scales", Set::Whole(1)),
            ("NI_Scale[0]_Scale_Type", Set::Text(kind)),
            ("NI_Scale[0]_Linear_Slope", Set::Double(10.0)),
            ("NI_Scale[0]_Linear_Y_Intercept", Set::Double(1.0)),
            ("NI_Scale[0]_Linear_Input_Source", Set::Whole(u32::MAX)),
        ]
    };
    let table = vec![
        ("NI_Scaling_Status", Set::Text("unscaled")),
        ("NI_Number_Of_Scales", Set::Whole(1)),
        ("NI_Scale[0]_Scale_Type", Set::Text("Table")),
        ("NI_Scale[0]_Table_Scaled_Values_Size", Set::Whole(2)),
        ("NI_Scale[0]_Table_Scaled_Values[0]", Set::Double(0.0)),
        ("NI_Scale[0]_Table_Scaled_Values[1]", Set::Double(2.0)),
        ("NI_Scale[0]_Table_Pre_Scaled_Values_Size", Set::Whole(2)),
        ("NI_Scale[0]_Table_Pre_Scaled_Values[0]", Set::Double(10.0)),
        ("NI_Scale[0]_Table_Pre_Scaled_Values[1]", Set::Double(50.0)),
        ("NI_Scale[0]_Table_Input_Source", Set::Whole(u32::MAX)),
    ];
    let subtract = vec![
        ("NI_Scaling_Status", Set::Text("unscaled")),
        ("NI_Number_Of_Scales", Set::Whole(2)),
        ("NI_Scale[0]_Scale_Type", Set::Text("Linear")),
        ("NI_Scale[0]_Linear_Slope", Set::Double(10.0)),
        ("NI_Scale[0]_Linear_Y_Intercept", Set::Double(1.0)),
        ("NI_Scale[0]_Linear_Input_Source", Set::Whole(u32::MAX)),
        ("NI_Scale[1]_Scale_Type", Set::Text("Subtract")),
        (
            "NI_Scale[1]_Subtract_Left_Operand_Input_Source",
            Set::Whole(0),
        ),
        (
            "NI_Scale[1]_Subtract_Right_Operand_Input_Source",
            Set::Whole(u32::MAX),
        ),
    ];
    let objects = [
        ("/'g'/'linear'", Raw::Plain(2, 2), scale("Linear")),
        ("/'g'/'other'", Raw::Plain(2, 2), scale("Thermocouple")),
        ("/'g'/'table'", Raw::Plain(2, 2), table),
        ("/'g'/'subtract'", Raw::Plain(2, 2), subtract),
    ];
    let raw: Vec<u8> = [1i16, 2]
        .repeat(4)
        .iter()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let mut file = open(
        "scales.tdms",
        &segment(META | NEW | RAW, &meta(false, &objects), &raw),
    );
    assert_eq!(all(&mut file, 0), [11.0, 21.0]);
    assert_eq!(all(&mut file, 1), [1.0, 2.0]);
    assert_eq!(all(&mut file, 2), [30.0, 50.0]);
    assert_eq!(all(&mut file, 3), [1.0 - 11.0, 2.0 - 21.0]);
    assert_eq!(file.notes().len(), 1);
    assert_eq!(file.notes()[0].channel.as_deref(), Some("g/other"));
    assert!(file.notes()[0].text.contains("Thermocouple"));
}

#[test]
fn a_file_that_a_crash_cut_gives_what_is_there() {
    let objects = [
        ("/'g'/'a'", Raw::Plain(10, 3), vec![]),
        ("/'g'/'b'", Raw::Plain(10, 3), vec![]),
    ];
    let raw = doubles(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0]);
    let mut bytes = segment(META | NEW | RAW, &meta(false, &objects), &raw);
    // The head as it is while the segment is being written.
    bytes[12..20].fill(0xff);
    let mut file = open("cut.tdms", &bytes);
    assert_eq!(all(&mut file, 0), [1.0, 2.0, 3.0, 7.0, 8.0, 9.0]);
    assert_eq!(all(&mut file, 1), [4.0, 5.0, 6.0, 10.0]);
    assert!(
        file.notes()[0].text.contains("never completed"),
        "{:?}",
        file.notes()
    );
}

#[test]
fn a_claim_of_more_than_is_there_is_told() {
    let objects = [("/'g'/'a'", Raw::Plain(10, 1 << 60), vec![])];
    let mut bytes = segment(
        META | NEW | RAW,
        &meta(false, &objects),
        &doubles(&[1.0, 2.0]),
    );
    let length = bytes.len() as u64 - 28;
    bytes[12..20].copy_from_slice(&(length + (1 << 62)).to_le_bytes());
    let mut file = open("claim.tdms", &bytes);
    assert_eq!(all(&mut file, 0), [1.0, 2.0]);
    assert!(
        file.notes()[0].text.contains("claims"),
        "{:?}",
        file.notes()
    );
}

#[test]
fn types_of_unknown_size_are_told_and_later_segments_read() {
    let mut bytes = segment(
        META | NEW | RAW,
        &meta(false, &[("/'g'/'a'", Raw::Plain(11, 1), vec![])]),
        &[0; 16],
    );
    bytes.extend(segment(
        META | NEW | RAW,
        &meta(false, &[("/'g'/'b'", Raw::Plain(5, 1), vec![])]),
        &[9],
    ));
    let mut file = open("extended.tdms", &bytes);
    assert_eq!(all(&mut file, 0), []);
    assert_eq!(all(&mut file, 1), [9.0]);
    assert_eq!(file.notes()[0].channel.as_deref(), Some("g/a"));
}

#[test]
fn many_segments_need_little_and_are_read_at_any_place() {
    let mut bytes = segment(
        META | NEW | RAW,
        &meta(false, &[("/'g'/'a'", Raw::Plain(5, 3), vec![])]),
        &[0, 1, 2],
    );
    let mut expected = vec![0.0, 1.0, 2.0];
    for i in 1..3000u32 {
        let raw: Vec<u8> = (0..3).map(|k| (i * 3 + k) as u8).collect();
        expected.extend(raw.iter().map(|&v| f64::from(v)));
        bytes.extend(segment(RAW, &[], &raw));
    }
    let mut file = open("many.tdms", &bytes);
    assert_eq!(all(&mut file, 0), expected);
    for first in [8999, 4321, 191, 192, 193, 0] {
        let mut value = [0.0];
        assert_eq!(file.read(0, first, &mut value), Ok(1));
        assert_eq!(value[0], expected[first as usize]);
    }
}

/// Opens bytes and reads all there is; whatever they are, this ends without a panic.
fn read_whatever(bytes: &[u8]) {
    let Ok(mut file) = Tdms::from_source(Cursor::new(bytes), Path::new("x.tdms")) else {
        return;
    };
    for channel in 0..file.channels().len() {
        let count = file.channels()[channel].count;
        assert!(
            count <= 8 * bytes.len() as u64,
            "{count} values out of {} bytes",
            bytes.len()
        );
        let mut values = [0.0; 64];
        for first in [0, 1, count.saturating_sub(64), count] {
            let _ = file.read(channel, first, &mut values);
            let _ = file.read_text(channel, first, 64);
        }
    }
}

/// Small files with all there is in the format.
fn samples() -> Vec<Vec<u8>> {
    let texts: Vec<u8> = [3u32, 8]
        .iter()
        .flat_map(|end| end.to_le_bytes())
        .chain(*b"offgrips")
        .collect();
    let text = segment(
        META | NEW | RAW,
        &meta(false, &[("/'g'/'s'", Raw::Texts(2, 16), vec![])]),
        &texts,
    );
    let line = Raw::Daqmx(true, 4, vec![[0, 0, 1, 0]], vec![1]);
    let digital = segment(
        META | NEW | RAW | DAQMX,
        &meta(false, &[("/'g'/'0'", line, vec![])]),
        &[1, 2, 3, 4],
    );
    let time = [(
        "/'g'/'t'",
        Raw::Plain(0x44, 1),
        vec![("wf_start_time", Set::Time(1, 2))],
    )];
    let big = segment(META | NEW | RAW | BIG, &meta(true, &time), &[7; 16]);
    vec![changing(), daqmx(), text, digital, big]
}

#[test]
fn a_file_cut_at_any_byte_neither_panics_nor_hangs() {
    for bytes in samples() {
        for end in 0..bytes.len() {
            read_whatever(&bytes[..end]);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn broken_bytes_neither_panic_nor_hang(which in 0usize..5, flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8)) {
        let mut bytes = samples().swap_remove(which);
        for (at, value) in flips {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        read_whatever(&bytes);
    }

    #[test]
    fn what_is_written_is_read(
        names in prop::collection::hash_set("[a-z'é ]{1,6}(/[a-z'/]{1,6})?", 1..4),
        pieces in prop::collection::vec(prop::collection::vec(any::<f64>(), 0..20), 0..6),
        interval in 1e-6f64..10.0,
    ) {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("round.tdms");
        let names: Vec<String> = names.into_iter().collect();
        let channels: Vec<Channel> = names.iter().map(|name| Channel {
            unit: "m/s²".into(),
            description: "a remark".into(),
            start: Some(Instant { seconds: 1_700_000_000, fraction: 0.25 }),
            clock: Clock::Uniform { first: -1.0, interval },
            properties: vec![Property { name: "bits".into(), value: Value::Number(24.0) }],
            ..Channel::new(name.clone(), 0)
        }).collect();
        let mut writer = file::create(&path, &channels).unwrap();
        for piece in &pieces {
            writer.append(&vec![piece.as_slice(); channels.len()]).unwrap();
        }
        writer.finish().unwrap();
        let expected: Vec<u64> = pieces.concat().iter().map(|v| v.to_bits()).collect();
        let mut back = file::open(&path).unwrap();
        prop_assert_eq!(back.notes(), []);
        prop_assert_eq!(back.channels().len(), channels.len());
        for (i, written) in channels.iter().enumerate() {
            let read = back.channels()[i].clone();
            let name = if written.name.contains('/') { written.name.clone() } else { format!("Untitled/{}", written.name) };
            prop_assert_eq!(&read.name, &name);
            prop_assert_eq!((&read.unit, &read.description, read.start, &read.clock), (&written.unit, &written.description, written.start, &written.clock));
            prop_assert!(read.properties.contains(&written.properties[0]));
            let values: Vec<u64> = all(back.as_mut(), i).iter().map(|v| v.to_bits()).collect();
            prop_assert_eq!(&values, &expected);
        }
    }
}

#[test]
fn a_file_has_its_name_only_when_it_is_finished() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("draft");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("a.tdms");
    let mut writer = file::create(&path, &[Channel::new("a", 0)]).unwrap();
    writer.append(&[&[1.0; 200_000]]).unwrap();
    assert!(!path.exists());
    drop(writer);
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
    assert!(file::create(folder.join("none").join("a.tdms"), &[]).is_err());
    assert!(
        file::create(
            &path,
            &[Channel::new("a", 0), Channel::new("Untitled/a", 0)]
        )
        .is_err_and(|e| e.to_string().contains("twice"))
    );
}

#[test]
fn what_is_no_tdms_is_told() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let tell = |name: &str, bytes: &[u8]| {
        std::fs::write(folder.join(name), bytes).unwrap();
        file::open(folder.join(name))
            .err()
            .map(|e| e.to_string())
            .unwrap_or_default()
    };
    let text = tell("text.tdms", b"this is no measurement");
    assert!(
        text.contains("text.tdms") && text.contains("is text") && text.contains("TDMS, "),
        "{text}"
    );
    assert!(tell("empty.tdms", b"").contains("empty"));
    assert!(tell("index.tdms", b"TDSh\x0e\0\0\0").contains("index of a TDMS file"));
    assert!(tell("noise.tdms", &[0, 1, 2, 3, 250, 0]).contains("no format that is known"));
    assert!(
        file::open(folder.join("absent.tdms")).is_err_and(|e| e.found.contains("cannot be opened"))
    );
}

/// FNV-1a of the little-endian doubles, as the peer's script computes it.
fn checksum(values: &[f64]) -> String {
    let bytes = values.iter().flat_map(|v| v.to_le_bytes());
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325u64, |h, b| {
        (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3)
    });
    format!("{hash:016x}")
}

#[test]
fn real_files_agree_with_nptdms_in_every_sample() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/tdms");
    if !folder.is_dir() {
        println!("did not run: {} is absent", folder.display());
        return;
    }
    let mut rows = 0;
    for row in include_str!("data/tdms.txt")
        .lines()
        .filter(|row| !row.starts_with('#'))
    {
        let cells: Vec<&str> = row.split('\t').collect();
        let mut file = file::open(folder.join(cells[0])).unwrap();
        assert_eq!(file.notes(), []);
        let channel = file
            .channels()
            .iter()
            .position(|c| c.name == cells[1])
            .unwrap_or_else(|| panic!("{row}"));
        let known = file.channels()[channel].clone();
        assert_eq!(
            (known.count.to_string().as_str(), known.unit.as_str()),
            (cells[2], cells[3]),
            "{row}"
        );
        let interval: f64 = cells[4].parse().unwrap();
        assert!(
            matches!(known.clock, Clock::Uniform { interval: i, .. } if i == interval),
            "{row}"
        );
        assert_eq!(checksum(&all(file.as_mut(), channel)), cells[5], "{row}");
        rows += 1;
    }
    assert_eq!(rows, 13);
    let big = file::open(folder.join("big_endian.tdms")).unwrap();
    assert_eq!(big.channels()[0].start, None);
}
