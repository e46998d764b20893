//! Parquet files that pyarrow wrote (see `peers/make_tables.py`) are read value by value, and written files come back.

use crate::tables::{all, bytes, channel, ramps, wave, waves};
use recording::file::Writer;
use recording::file::parquet::{Parquet, ParquetWriter};
use recording::{Channel, Clock, Content, Instant, Recording};
use std::io::Cursor;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

fn open(name: &str) -> Parquet<Cursor<Vec<u8>>> {
    Parquet::from_source(Cursor::new(bytes(name)), name.as_ref()).unwrap()
}

#[test]
fn every_packing_gives_the_same_values() {
    for name in ["snappy.parquet", "gzip_v2.parquet", "plain.parquet"] {
        let mut file = open(name);
        assert_eq!(all(&mut file, "force"), waves(700), "{name}");
        assert_eq!(all(&mut file, "speed"), waves(700), "{name}");
        assert_eq!(all(&mut file, "count"), ramps(700), "{name}");
        let small: Vec<f64> = ramps(700).iter().map(|v| v.rem_euclid(100.0)).collect();
        assert_eq!(all(&mut file, "small"), small, "{name}");
        let unsigned: Vec<f64> = (0..700).map(|k| f64::from(k % 256)).collect();
        assert_eq!(all(&mut file, "unsigned"), unsigned, "{name}");
        let flags: Vec<f64> = (0..700).map(|k| f64::from((k + 1) % 2)).collect();
        assert_eq!(all(&mut file, "flag"), flags, "{name}");
        for (k, value) in all(&mut file, "gaps").into_iter().enumerate() {
            let empty = k % 10 == 3;
            assert!(
                empty && value.is_nan() || value == wave(k as u32),
                "{name} {k}"
            );
        }
        let texts = &file.channels()[channel(&file, "name")];
        assert_eq!(texts.content, Content::Text, "{name}");
    }
}

#[test]
fn units_clock_and_instants() {
    let mut file = open("snappy.parquet");
    let units = |name: &str| file.channels()[channel(&file, name)].unit.clone();
    assert_eq!(
        ["time", "force", "speed", "gaps"].map(units),
        ["s", "N", "rpm", "mm"]
    );
    let clock = &file.channels()[channel(&file, "force")].clock;
    assert!(
        matches!(clock, Clock::Uniform { first, interval } if *first == 0.0 && *interval == 0.001)
    );
    let stamps = all(&mut file, "stamp");
    let stamp = &file.channels()[channel(&file, "stamp")];
    assert_eq!(stamp.content, Content::Time);
    let start = Instant {
        seconds: 1_700_000_000,
        fraction: 0.0,
    };
    assert_eq!(stamp.start, Some(start));
    assert_eq!((stamps[0], stamps[699]), (0.0, 0.699));
}

#[test]
fn rows_may_be_read_in_any_order() {
    let mut file = open("gzip_v2.parquet");
    let index = channel(&file, "count");
    for (first, count) in [(650, 100), (299, 2), (0, 5), (100, 400), (700, 5)] {
        let mut piece = vec![0.0; count];
        let read = file.read(index, first, &mut piece).unwrap();
        let end = (first as usize + count).min(700);
        assert_eq!(
            piece[..read],
            ramps(700)[(first as usize).min(end)..end],
            "{first}"
        );
    }
    assert!(file.read(channel(&file, "name"), 0, &mut [0.0]).is_err());
}

#[test]
fn a_packing_that_is_not_read_is_reported() {
    let file = open("zstd.parquet");
    assert!(file.channels().is_empty());
    assert!(file.notes()[0].text.contains("ZSTD") && file.notes()[0].text.contains("snappy"));
}

#[test]
fn a_file_without_its_end_says_so() {
    let whole = bytes("snappy.parquet");
    let cut = Cursor::new(whole[..whole.len() - 100].to_vec());
    let error = Parquet::from_source(cut, "cut.parquet".as_ref()).unwrap_err();
    assert!(error.to_string().contains("cut off"), "{error}");
}

#[test]
fn written_columns_come_back_bit_for_bit_over_several_row_groups() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.parquet");
    let clock = Clock::Uniform {
        first: 0.25,
        interval: 1.0 / 42_000.0,
    };
    let channels =
        [("force", "N", "on the arm"), ("odd", "", "")].map(|(name, unit, text)| Channel {
            unit: unit.to_string(),
            description: text.to_string(),
            clock: clock.clone(),
            ..Channel::new(name, 0)
        });
    let odd = [0.1, -0.0, 5e-324, f64::MAX, f64::NAN, f64::INFINITY];
    let rows = 150_000;
    let odd: Vec<f64> = (0..rows).map(|k| odd[k % odd.len()]).collect();
    let force: Vec<f64> = (0..rows as u32).map(|k| f64::from(k) / 3.0).collect();
    let mut writer = Box::new(ParquetWriter::create(&path, &channels).unwrap());
    for from in (0..rows).step_by(40_000) {
        let to = (from + 40_000).min(rows);
        writer.append(&[&force[from..to], &odd[from..to]]).unwrap();
    }
    assert!(!path.exists(), "the name is given at the end");
    writer.finish().unwrap();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    let source = Cursor::new(std::fs::read(&path).unwrap());
    let mut file = Parquet::from_source(source, &path).unwrap();
    let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert!(bits(&all(&mut file, "force")) == bits(&force));
    assert!(bits(&all(&mut file, "odd")) == bits(&odd));
    let found = &file.channels()[1];
    assert_eq!((&*found.unit, &*found.description), ("N", "on the arm"));
    let Clock::Uniform { first, interval } = found.clock else {
        panic!("{:?}", file.notes());
    };
    assert!(
        first == 0.25 && (interval * 42_000.0 - 1.0).abs() < 1e-12,
        "{interval}"
    );
}

#[test]
fn no_damage_makes_the_reader_panic() {
    for name in ["snappy.parquet", "gzip_v2.parquet"] {
        crate::tables::damage(&bytes(name), 2000, &mut |bytes| {
            let file = Parquet::from_source(Cursor::new(bytes), name.as_ref());
            if let Ok(mut file) = file {
                crate::tables::touch(&mut file);
            }
        });
    }
}

#[test]
fn a_page_without_its_dictionary_is_damage_and_no_panic() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/data/damaged/page_without_its_dictionary.parquet"
    );
    let bytes = std::fs::read(path).unwrap();
    let panicked = Arc::new(AtomicBool::new(false));
    let shown = panicked.clone();
    let before = std::panic::take_hook();
    // The hook sees panics that the reader catches too.
    let here = std::thread::current().id();
    std::panic::set_hook(Box::new(move |info| {
        if std::thread::current().id() == here {
            shown.store(true, Ordering::Relaxed);
        }
        before(info);
    }));
    let mut file = Parquet::from_source(Cursor::new(bytes), path.as_ref()).unwrap();
    crate::tables::touch(&mut file);
    assert!(!panicked.load(Ordering::Relaxed));
    assert!(
        file.notes()
            .iter()
            .any(|note| note.text.contains("damaged"))
    );
}

/// A file with a checksum for each page (pyarrow, `write_page_checksum`): one bit of a value was changed.
#[test]
fn a_page_that_contradicts_its_checksum_is_not_read() {
    let whole = include_bytes!("data/damaged/page_crc.parquet");
    let open = |bytes: Vec<u8>| Parquet::from_source(Cursor::new(bytes), "crc.parquet".as_ref());
    let read = |file: &mut Parquet<Cursor<Vec<u8>>>| -> Vec<Vec<f64>> {
        let count = file.channels().len();
        let values = |k: usize, file: &mut Parquet<Cursor<Vec<u8>>>| {
            let mut values = vec![0.0; file.channels()[k].count as usize];
            file.read(k, 0, &mut values).unwrap();
            values
        };
        (0..count).map(|k| values(k, file)).collect()
    };
    let mut good = open(whole.to_vec()).unwrap();
    let values = read(&mut good);
    assert!((0..values.len()).all(|k| !good.contradicts_checksum(k) && !good.is_damaged(k)));
    let mut changed = whole.to_vec();
    changed[891] ^= 0x10;
    let mut file = open(changed).unwrap();
    let found = read(&mut file);
    let damaged: Vec<usize> = (0..found.len())
        .filter(|&k| file.contradicts_checksum(k))
        .collect();
    assert_eq!(damaged.len(), 1, "{:?}", file.notes());
    for k in 0..found.len() {
        if k == damaged[0] {
            assert!(found[k].iter().any(|value| value.is_nan()));
            let known = |(a, b): (&f64, &f64)| b.is_nan() || a == b;
            assert!(values[k].iter().zip(&found[k]).all(known));
        } else {
            assert_eq!(values[k], found[k]);
        }
    }
    let name = &file.channels()[damaged[0]].name;
    let reported = |note: &recording::Note| {
        note.channel.as_ref() == Some(name) && note.text.contains("checksum")
    };
    assert!(file.notes().iter().any(reported), "{:?}", file.notes());
}

/// A table as pandas writes it with a DatetimeIndex: the index is a column of instants behind the others.
fn with_index(times: &[i64], speeds: &[f64]) -> Vec<u8> {
    use parquet::data_type::{DoubleType, Int64Type};
    use parquet::file::writer::SerializedFileWriter;
    use parquet::schema::parser::parse_message_type;
    let schema = "message schema { REQUIRED DOUBLE speed; REQUIRED INT64 __index_level_0__ (TIMESTAMP(NANOS,false)); }";
    let schema = Arc::new(parse_message_type(schema).unwrap());
    let mut bytes = Vec::new();
    let mut file = SerializedFileWriter::new(&mut bytes, schema, Arc::default()).unwrap();
    let mut group = file.next_row_group().unwrap();
    let mut column = group.next_column().unwrap().unwrap();
    column
        .typed::<DoubleType>()
        .write_batch(speeds, None, None)
        .unwrap();
    column.close().unwrap();
    let mut column = group.next_column().unwrap().unwrap();
    column
        .typed::<Int64Type>()
        .write_batch(times, None, None)
        .unwrap();
    column.close().unwrap();
    group.close().unwrap();
    file.close().unwrap();
    bytes
}

#[test]
fn the_index_of_pandas_is_the_clock() {
    let start = 1_700_000_000_500_000_000i64;
    let speeds = ramps(300);
    let even: Vec<i64> = (0..300).map(|k| start + 10_000_000 * k).collect();
    let gap: Vec<i64> = (0..300)
        .map(|k| start + 10_000_000 * (k + if k < 150 { 0 } else { 200 }))
        .collect();
    let read = |times: &[i64]| {
        let bytes = with_index(times, &speeds);
        let file = Parquet::from_source(Cursor::new(bytes), "x".as_ref()).unwrap();
        let clock = file.channels()[channel(&file, "speed")].clock.clone();
        (clock, channel(&file, "__index_level_0__"))
    };
    let uniform = Clock::Uniform {
        first: 0.5,
        interval: 0.01,
    };
    assert_eq!(read(&even).0, uniform);
    let (clock, index) = read(&gap);
    assert_eq!(clock, Clock::Channel(index));
}
