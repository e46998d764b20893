//! TDMS: files of the format's own making, what a crash leaves, and what a hand may break.

mod broken;
mod bytes;
mod whole;

use std::io::Cursor;
use std::path::Path;

use bytes::{BIG, DAQMX, INTERLEAVED, META, NEW, ObjectOf, RAW, Raw, Set, meta, segment};
use recording::file::tdms::Tdms;
use recording::{Clock, Content, Instant, Recording};

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
        let reported = |note: &recording::Note| {
            note.channel.as_deref() == Some("g/11") && note.text.contains("g/11 (real)")
        };
        assert!(file.notes().iter().any(reported), "{:?}", file.notes());
    }
}

#[test]
fn time_stamps_beside_texts_are_read() {
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
    let refused = file.read(0, 0, &mut [0.0]).unwrap_err();
    assert!(refused.to_string().contains("g/state"), "{refused}");
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
fn a_channel_of_times_is_the_clock_of_its_group() {
    let objects = [
        ("/'g'/'a'", Raw::Plain(5, 2), vec![]),
        ("/'g'/'when'", Raw::Plain(0x44, 2), vec![]),
        ("/'g'/'short'", Raw::Plain(5, 1), vec![]),
        (
            "/'h'/'Time'",
            Raw::Plain(5, 1),
            vec![("unit_string", Set::Text("s"))],
        ),
        ("/'h'/'b'", Raw::Plain(5, 1), vec![]),
    ];
    let file = open(
        "clocks.tdms",
        &segment(META | NEW | RAW, &meta(false, &objects), &[0; 37]),
    );
    let clocks: Vec<Clock> = file.channels().iter().map(|c| c.clock.clone()).collect();
    assert_eq!(
        clocks,
        [
            Clock::Channel(1),
            Clock::Unknown,
            Clock::Unknown,
            Clock::Unknown,
            Clock::Channel(3)
        ]
    );
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
    assert_eq!(file.notes().len(), 1);
    assert_eq!(file.notes()[0].channel.as_deref(), Some("g/c"));
    assert!(file.notes()[0].text.contains("codes"));
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
    let line = |bit| Raw::Daqmx(true, 4, vec![[0, 0, bit, 0]], vec![4]);
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
fn plain_values_are_scaled_and_unknown_scales_are_reported() {
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
        ("NI_Scale[0]_Table_Pre_Scaled_Values_Size", Set::Whole(2)),
        ("NI_Scale[0]_Table_Pre_Scaled_Values[0]", Set::Double(0.0)),
        ("NI_Scale[0]_Table_Pre_Scaled_Values[1]", Set::Double(2.0)),
        ("NI_Scale[0]_Table_Scaled_Values_Size", Set::Whole(2)),
        ("NI_Scale[0]_Table_Scaled_Values[0]", Set::Double(10.0)),
        ("NI_Scale[0]_Table_Scaled_Values[1]", Set::Double(50.0)),
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
    // Counts of a thermocouple are no temperature: they are no channel.
    assert_eq!(all(&mut file, 1), [30.0, 50.0]);
    assert_eq!(all(&mut file, 2), [1.0 - 11.0, 2.0 - 21.0]);
    assert_eq!(file.channels().len(), 3);
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
fn a_claim_of_more_than_is_there_is_reported() {
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
fn types_of_unknown_size_are_reported_and_later_segments_read() {
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
    assert!(all(&mut file, 0).is_empty());
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
