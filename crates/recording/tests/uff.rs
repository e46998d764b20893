//! Universal files: text and bytes of every form, real files with their flaws, and what a hand may break.

use std::io::Cursor;
use std::path::Path;

use proptest::prelude::*;
use recording::file::{self, Format, uff::Uff};
use recording::{Clock, Instant, Recording};

fn open(bytes: &[u8]) -> Uff<Cursor<Vec<u8>>> {
    Uff::from_source(Cursor::new(bytes.to_vec()), Path::new("x.uff"))
        .expect("this is a universal file")
}

fn all(file: &mut dyn Recording, channel: usize) -> Vec<f64> {
    let mut values = vec![f64::NAN; file.channels()[channel].count as usize + 1];
    let count = file
        .read(channel, 0, &mut values)
        .expect("the channel can be read");
    values.truncate(count);
    values
}

fn shown(file: &dyn Recording) -> String {
    file.notes()
        .iter()
        .map(|n| format!("{}: {}\n", n.channel.as_deref().unwrap_or("-"), n.text))
        .collect()
}

/// The eleven lines of a header: type of values, number, spacing, quantity and unit of the ordinate.
fn header(kind: u32, count: u64, spacing: u32, abscissa: &str, ordinate: &str) -> String {
    format!(
        "run 7\nNONE\n18-Apr-16 13:49:58\nNONE\nNONE\n    1         0    0         0 rotor              7   3 NONE               0   0\n\
         {kind:>10}{count:>10}{spacing:>10}  1.00000E+00  2.50000E-01  0.00000E+00\n{abscissa}\n{ordinate}\n\
         \x20        0    0    0    0 NONE                 NONE\n         0    0    0    0 NONE                 NONE\n"
    )
}

const TIME: &str = "        17    0    0    0 Time                 s                   ";
const ACCELERATION: &str = "        12    0    0    0 Acceleration         m/s2                ";

fn text_set(kind: u32, count: u64, spacing: u32, data: &str) -> String {
    format!(
        "    -1\n    58\n{}{data}    -1\n",
        header(kind, count, spacing, TIME, ACCELERATION)
    )
}

fn binary_set(
    kind: u32,
    count: u64,
    spacing: u32,
    order: u32,
    shown: u64,
    data: &[u8],
    end: &str,
) -> Vec<u8> {
    let mut out = format!("    -1\r\n    58b{order:>6}     2          11{shown:>12}     0     0           0           0\r\n").into_bytes();
    out.extend(
        header(kind, count, spacing, TIME, ACCELERATION)
            .replace('\n', "\r\n")
            .bytes(),
    );
    out.extend(data);
    out.extend(end.bytes());
    out
}

#[test]
fn every_form_of_text_is_read() {
    let mut real = open(text_set(2, 3, 1, " 1.00000E+00-2.00000E+00 3.50000D-01\n").as_bytes());
    assert_eq!(all(&mut real, 0), [1.0, -2.0, 0.35]);
    let known = &real.channels()[0];
    assert_eq!(
        (known.name.as_str(), known.unit.as_str()),
        ("run 7", "m/s2")
    );
    assert_eq!(
        known.clock,
        Clock::Uniform {
            first: 1.0,
            interval: 0.25
        }
    );
    // By `date -u -d '2016-04-18 13:49:58' +%s`.
    assert_eq!(
        known.start,
        Some(Instant {
            seconds: 1_460_987_398,
            fraction: 0.0
        })
    );

    let mut uneven = open(text_set(4, 2, 0, " 1.0E+00 5.0E+00\n 3.0E+00 -6.0E+00\n").as_bytes());
    assert_eq!(all(&mut uneven, 0), [5.0, -6.0]);
    assert_eq!(all(&mut uneven, 1), [1.0, 3.0]);
    assert_eq!(uneven.channels()[0].clock, Clock::Channel(1));
    assert_eq!(uneven.channels()[1].unit, "s");

    let mut complex = open(text_set(5, 2, 1, " 1.0E+00 2.0E+00 3.0E+00 4.0E+00\n").as_bytes());
    assert_eq!(
        (all(&mut complex, 0), all(&mut complex, 1)),
        (vec![1.0, 3.0], vec![2.0, 4.0])
    );

    let mut both = open(
        text_set(
            6,
            2,
            0,
            " 9.0E+00 1.0E+00 2.0E+00\n 8.0E+00 3.0E+00 4.0E+00\n",
        )
        .as_bytes(),
    );
    let names: Vec<&str> = both.channels().iter().map(|c| c.name.as_str()).collect();
    assert_eq!(
        names,
        ["run 7 (real)", "run 7 (imaginary)", "run 7 (abscissa)"]
    );
    assert_eq!(both.channels()[1].clock, Clock::Channel(2));
    assert_eq!(all(&mut both, 0), [1.0, 3.0]);
    assert_eq!(all(&mut both, 1), [2.0, 4.0]);
    assert_eq!(all(&mut both, 2), [9.0, 8.0]);
}

#[test]
fn every_form_of_bytes_is_read() {
    for (order, big) in [(1, false), (2, true)] {
        let single = |v: f32| {
            if big {
                v.to_be_bytes()
            } else {
                v.to_le_bytes()
            }
        };
        let double = |v: f64| {
            if big {
                v.to_be_bytes()
            } else {
                v.to_le_bytes()
            }
        };
        let data: Vec<u8> = [1.5f32, -2.0].map(single).concat();
        assert_eq!(
            all(
                &mut open(&binary_set(2, 2, 1, order, 8, &data, "    -1\r\n")),
                0
            ),
            [1.5, -2.0]
        );
        let data: Vec<u8> = [1.5f64, -0.1].map(double).concat();
        assert_eq!(
            all(
                &mut open(&binary_set(4, 2, 1, order, 16, &data, "    -1\r\n")),
                0
            ),
            [1.5, -0.1]
        );
        // Uneven, with abscissae of single and of double precision.
        let narrow = [
            single(1.0).to_vec(),
            double(0.1).to_vec(),
            single(3.0).to_vec(),
            double(0.2).to_vec(),
        ]
        .concat();
        let mut file = open(&binary_set(4, 2, 0, order, 24, &narrow, "    -1\r\n"));
        assert_eq!(
            (all(&mut file, 0), all(&mut file, 1)),
            (vec![0.1, 0.2], vec![1.0, 3.0])
        );
        let wide: Vec<u8> = [1.0, 0.1, 3.0, 0.2].map(double).concat();
        let mut file = open(&binary_set(4, 2, 0, order, 32, &wide, "    -1\r\n"));
        assert_eq!(
            (all(&mut file, 0), all(&mut file, 1)),
            (vec![0.1, 0.2], vec![1.0, 3.0])
        );
        let data: Vec<u8> = [1.0f32, 2.0, 3.0, 4.0].map(single).concat();
        let mut file = open(&binary_set(5, 2, 1, order, 16, &data, "    -1\r\n"));
        assert_eq!(
            (all(&mut file, 0), all(&mut file, 1)),
            (vec![1.0, 3.0], vec![2.0, 4.0])
        );
    }
}

#[test]
fn a_line_end_behind_the_bytes_and_a_wrong_length_do_not_matter() {
    let data: Vec<u8> = [1.5f32, -2.0]
        .iter()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    for (length, end) in [
        (8, "\r\n    -1\r\n"),
        (8, "\n    -1"),
        (0, "    -1\n"),
        (9, "    -1\n"),
    ] {
        let mut bytes = binary_set(2, 2, 1, 1, length, &data, end);
        if end.ends_with('\n') {
            bytes.extend(text_set(2, 1, 1, " 7.0E+00\n").bytes());
        }
        let mut file = open(&bytes);
        assert_eq!(all(&mut file, 0), [1.5, -2.0], "{length} {end:?}");
        assert!(
            !shown(&file).contains("closed"),
            "{length} {end:?}: {}",
            shown(&file)
        );
        if end.ends_with('\n') {
            assert_eq!(all(&mut file, 1), [7.0], "{length} {end:?}");
            assert_eq!(file.channels()[1].name, "run 7 (2)");
        }
    }
}

#[test]
fn bytes_that_look_like_the_mark_are_values() {
    let mut data = b"\n    -1\n".to_vec();
    data.extend(2.0f32.to_le_bytes());
    let mut file = open(&binary_set(2, 3, 1, 1, 12, &data, "    -1\n"));
    assert_eq!(file.channels()[0].count, 3);
    assert_eq!(all(&mut file, 0)[2], 2.0);
}

#[test]
fn a_frequency_is_no_clock_but_a_channel() {
    let axis = "        18    0    0    0 Frequency            Hz                  ";
    let text = format!(
        "    -1\n    58\n{} 1.0E+00 2.0E+00\n    -1\n",
        header(2, 2, 1, axis, ACCELERATION)
    );
    let mut file = open(text.as_bytes());
    assert_eq!(file.channels()[0].clock, Clock::Channel(1));
    assert_eq!(file.channels()[1].unit, "Hz");
    assert_eq!(all(&mut file, 1), [1.0, 1.25]);
}

#[test]
fn a_unit_that_was_lost_is_reported_and_given_only_where_the_file_is_in_si() {
    let lost = "        12    1    0    0 Acceleration         NONE                ";
    let set = format!(
        "    -1\n    58\n{} 1.0E+00\n    -1\n",
        header(2, 1, 1, TIME, lost)
    );
    let file = open(set.as_bytes());
    assert_eq!(file.channels()[0].unit, "");
    assert!(
        shown(&file).contains("run 7: its unit is lost"),
        "{}",
        shown(&file)
    );
    let si = "    -1\n   164\n         1SI: metre (newton)           2\n  1.0D+00  1.0D+00  1.0D+00\n  2.7315D+02\n    -1\n";
    let file = open(format!("{si}{set}").as_bytes());
    assert_eq!(file.channels()[0].unit, "m/s^2");
    assert!(shown(&file).contains("by its quantity"), "{}", shown(&file));
}

#[test]
fn sets_of_other_types_are_skipped_with_a_note() {
    let other = "    -1\n    15\n         1         0         0        11  0.0E+00\n    -1\n";
    let head = "    -1\n   151\nrig 6\nNONE\nprogram 2\n    -1\n";
    let text = format!("{head}{other}{other}{}", text_set(2, 1, 1, " 7.0E+00\n"));
    let mut file = open(text.as_bytes());
    assert_eq!(all(&mut file, 0), [7.0]);
    assert!(
        shown(&file).contains("type 15 are left out (2)"),
        "{}",
        shown(&file)
    );
    let none = open(format!("{head}{other}").as_bytes());
    assert_eq!(none.channels().len(), 0);
    assert!(shown(&none).contains("no values"));
}

#[test]
fn more_and_fewer_values_than_stated_and_words_among_them_are_reported() {
    let mut fewer = open(text_set(2, 9, 1, " 1.0E+00 2.0E+00\n").as_bytes());
    assert_eq!(all(&mut fewer, 0), [1.0, 2.0]);
    assert!(shown(&fewer).contains("states 9 values, 2 are there"));
    let mut more = open(text_set(2, 1, 1, " 1.0E+00 2.0E+00\n").as_bytes());
    assert_eq!(all(&mut more, 0), [1.0]);
    assert!(shown(&more).contains("left out"));
    let mut words = open(text_set(2, 3, 1, " 1.0E+00 ****** 3.0E+00\n").as_bytes());
    let values = all(&mut words, 0);
    assert!(
        values[0] == 1.0 && values[1].is_nan() && values[2] == 3.0,
        "{values:?}"
    );
    assert!(
        shown(&words).contains("1 of its values are no numbers"),
        "{}",
        shown(&words)
    );
    let text = text_set(2, 3, 1, " 1.0E+00 2.0E+00 3.0E+00\n");
    let cut = open(text.trim_end_matches("    -1\n").as_bytes());
    assert!(shown(&cut).contains("not closed"), "{}", shown(&cut));
    let huge = open(&binary_set(
        2,
        u64::MAX / 4,
        1,
        1,
        u64::MAX / 2,
        &[0; 10],
        "",
    ));
    assert_eq!(huge.channels()[0].count, 2);
    assert!(shown(&huge).contains("cut off"), "{}", shown(&huge));
}

#[test]
fn a_long_text_is_read_at_any_place() {
    let data: String = (0..20_000)
        .map(|i| format!(" {i}.5{}", if i % 6 == 5 { "\n" } else { "" }))
        .collect();
    let mut file = open(text_set(2, 20_000, 1, &format!("{data}\n")).as_bytes());
    let expected: Vec<f64> = (0..20_000).map(|i| f64::from(i) + 0.5).collect();
    assert_eq!(all(&mut file, 0), expected);
    for first in [19_999usize, 12_345, 4096, 4095, 4097, 0] {
        let mut values = vec![0.0; 3.min(20_000 - first)];
        assert_eq!(file.read(0, first as u64, &mut values), Ok(values.len()));
        assert_eq!(values, expected[first..first + values.len()]);
    }
    // In pieces, one after the other.
    let mut values = Vec::new();
    let mut piece = [0.0; 777];
    while let Ok(count @ 1..) = file.read(0, values.len() as u64, &mut piece) {
        values.extend_from_slice(&piece[..count]);
    }
    assert_eq!(values, expected);
}

#[test]
fn a_universal_file_is_recognised_and_a_table_is_not_taken_for_one() {
    assert_eq!(
        Format::of(text_set(2, 1, 1, " 1.0\n").as_bytes()),
        Some(Format::Uff)
    );
    assert_ne!(Format::of(b"-1\n58\n3\n"), Some(Format::Uff));
    assert_ne!(Format::of(b"    -1\n    time\n"), Some(Format::Uff));
}

/// FNV-1a of the little-endian doubles, as the peer's script computes it.
fn checksum(values: &[f64]) -> String {
    let bytes = values.iter().flat_map(|v| v.to_le_bytes());
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325u64, |h, b| {
        (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3)
    });
    format!("{hash:016x}")
}

/// Compares the files of a folder with what pyuff read of them; returns the number of rows.
fn compare(folder: &Path, reference: &str) -> usize {
    let rows: Vec<Vec<&str>> = reference
        .lines()
        .filter(|row| !row.starts_with('#'))
        .map(|row| row.split('\t').collect())
        .collect();
    for (number, cells) in rows.iter().enumerate() {
        let mut file = file::open(folder.join(cells[0])).unwrap();
        // Rows of a file follow its channels; abscissae that follow from an interval are no rows.
        let written =
            |c: &&recording::Channel| !(c.name.ends_with("(abscissa)") && cells[4] != "0.0");
        let names: Vec<String> = file
            .channels()
            .iter()
            .filter(written)
            .map(|c| c.name.clone())
            .collect();
        let place = rows[..number]
            .iter()
            .filter(|other| other[0] == cells[0])
            .count();
        let channel = file
            .channels()
            .iter()
            .position(|c| c.name == names[place])
            .unwrap();
        let known = file.channels()[channel].clone();
        assert_eq!(known.count.to_string(), cells[2], "{cells:?}");
        assert!(
            cells[3].contains('\u{fffd}') || known.unit == cells[3],
            "{cells:?}: {}",
            known.unit
        );
        if let Clock::Uniform { interval, .. } = known.clock {
            assert_eq!(interval, cells[4].parse::<f64>().unwrap(), "{cells:?}");
        }
        assert_eq!(
            checksum(&all(file.as_mut(), channel)),
            cells[5],
            "{cells:?}"
        );
    }
    rows.len()
}

#[test]
fn files_that_pyuff_wrote_agree_with_it_in_every_sample() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    assert_eq!(compare(&folder, include_str!("data/uff_samples.txt")), 16);
}

#[test]
fn real_files_agree_with_pyuff_in_every_sample() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/pyuff");
    assert_eq!(compare(&folder, include_str!("data/uff.txt")), 5);
    let notes = |name: &str| shown(file::open(folder.join(name)).unwrap().as_ref());
    assert!(notes("TestLab_161_164_18_15_82.uff").contains("no values"));
    let non_ascii = file::open(folder.join("non_ascii_header.uff")).unwrap();
    assert_eq!(non_ascii.channels()[0].unit, "(1/N)*(m/s²)");
    assert!(shown(non_ascii.as_ref()).contains("Latin-1"));
    let short = file::open(folder.join("time-history-not-all-columns-filled.uff")).unwrap();
    assert_eq!(short.channels()[0].unit, "m/s²");
}

fn read_whatever(bytes: &[u8]) {
    let Ok(mut file) = Uff::from_source(Cursor::new(bytes), Path::new("x.uff")) else {
        return;
    };
    let mut values = [0.0; 64];
    for channel in 0..file.channels().len() {
        let count = file.channels()[channel].count;
        assert!(count <= bytes.len() as u64);
        for first in [0, 1, count.saturating_sub(64), count] {
            let read = file
                .read(channel, first, &mut values)
                .expect("what is counted can be read");
            assert_eq!(read as u64, count.saturating_sub(first).min(64));
        }
    }
}

fn samples() -> Vec<Vec<u8>> {
    let si = "    -1\n   164\n         1SI: metre (newton)           2\n    -1\n    -1\n   151\nrig\n    -1\n";
    vec![
        format!(
            "{si}{}",
            text_set(
                6,
                2,
                0,
                " 9.0E+00 1.0E+00 2.0E+00\n 8.0E+00 3.0E+00 4.0E+00\n"
            )
        )
        .into_bytes(),
        [
            binary_set(4, 2, 0, 2, 24, &[7; 24], "\r\n    -1\r\n"),
            text_set(2, 3, 1, " 1.0E+00-2.0E+00 3.0-101\n").into_bytes(),
        ]
        .concat(),
    ]
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
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn broken_bytes_neither_panic_nor_hang(which in 0usize..2, flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8)) {
        let mut bytes = samples().swap_remove(which);
        for (at, value) in flips {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        read_whatever(&bytes);
    }
}
