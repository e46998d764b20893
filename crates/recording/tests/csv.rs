//! Tables of loggers and of pandas (see `peers/make_tables.py`) are read, and written tables come back.

use crate::tables::{all, bytes, channel, wave, waves};
use recording::file::Writer;
use recording::file::csv::{Csv, CsvWriter};
use recording::{Channel, Clock, Content, Recording};
use std::io::Cursor;

fn open(text: impl AsRef<[u8]>) -> Csv<Cursor<Vec<u8>>> {
    Csv::from_source(Cursor::new(text.as_ref().to_vec()), "table.csv".as_ref()).unwrap()
}

fn notes(file: &dyn Recording) -> String {
    let notes = file.notes().iter();
    notes
        .map(|n| format!("{}: {}\n", n.channel.as_deref().unwrap_or(""), n.text))
        .collect()
}

fn uniform(first: f64, interval: f64) -> Clock {
    Clock::Uniform { first, interval }
}

#[test]
fn tables_of_pandas_in_both_spellings() {
    for (name, time, force) in [
        ("pandas.csv", "Time", "Force"),
        ("german.csv", "Zeit", "Kraft"),
    ] {
        let mut file = open(bytes(name));
        assert_eq!(all(&mut file, force), waves(50), "{name}");
        let found = &file.channels()[channel(&file, force)];
        assert_eq!(
            (&*found.unit, &found.clock),
            ("N", &uniform(0.0, 0.02)),
            "{name}"
        );
        assert_eq!(all(&mut file, time)[49], 49.0 * 0.02);
        assert!(file.notes().is_empty(), "{}", notes(&file));
    }
}

#[test]
fn a_logger_with_lines_before_the_table_and_units_in_a_row() {
    let text = "\u{feff}Datei: test 7\r\nAbtastrate [kHz];2\r\n\r\nMoment;Drehzahl;Bemerkung\r\n[N mm];[1/min];\r\n\
                1,5;900;ok\r\n-0,25;901,5;\"a;b\"\r\n";
    let wide: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    for bytes in [text.as_bytes().to_vec(), wide] {
        let mut file = open(bytes);
        assert_eq!(all(&mut file, "Moment"), [1.5, -0.25]);
        assert_eq!(all(&mut file, "Drehzahl"), [900.0, 901.5]);
        assert_eq!(file.channels()[0].unit, "N mm");
        assert_eq!(file.channels()[0].clock, uniform(0.0, 0.0005));
        assert_eq!(file.channels()[2].content, Content::Text);
        assert!(file.read(2, 0, &mut [0.0]).is_err());
    }
}

#[test]
fn letters_of_a_code_page_are_not_lost() {
    let file = open(b"t [s],T [\xb0C],d [\xb5m]\n0,20,1\n1,21,2\n");
    let units: Vec<&str> = file.channels().iter().map(|c| &*c.unit).collect();
    assert_eq!(units, ["s", "°C", "µm"]);
}

#[test]
fn what_is_no_value_is_reported_with_column_and_line() {
    let text = "time [s],force [N]\n0,1\n1,\n2,OVER\n3,4,5\n4\ntime [s],force [N]\n2.5,7\n";
    let mut file = open(text);
    let force = all(&mut file, "force");
    assert_eq!((force[0], force[3], force[5]), (1.0, 4.0, 7.0));
    assert!(force[1].is_nan() && force[2].is_nan() && force[4].is_nan());
    assert_eq!(file.channels()[1].clock, Clock::Channel(0));
    let shown = notes(&file);
    for expected in [
        "force: 1 cells are empty, the first in line 3",
        "force: 1 cells are no numbers, the first in line 4: “OVER”",
        "1 lines have more cells than columns; the rest is left out; the first is line 5",
        "1 lines are short; what is missing is not-a-number; the first is line 6",
        "1 lines hold no values; they are left out; the first is line 7",
        "time: 1 times are not after the one before, the first in line 8",
    ] {
        assert!(shown.contains(expected), "{expected}\n{shown}");
    }
}

/// A file that was cut inside its last number has no line end behind it; nothing else shows it.
#[test]
fn a_last_line_without_its_end_is_reported() {
    let whole = "time [s],force [N]\n0,1\n1,2\n2,1433.5\n";
    let reported = |text: &str| notes(&open(text)).contains("last line, 4, has no line end");
    assert!(!reported(whole));
    assert!(!reported(&whole.replace('\n', "\r\n")));
    assert!(!reported(&whole.replace('\n', "\r")));
    assert!(reported(&whole[..whole.len() - 1]));
    assert!(reported(&whole[..whole.len() - 5]));
    // a remark behind the table is none of its lines
    assert!(!reported(&format!("{whole}# end")));
}

#[test]
fn instants_become_seconds_after_the_first() {
    let text = "Timestamp,v\n2001-09-09 01:46:40.000,1\n2001-09-09 01:46:40.250,2\n2001-09-09 01:46:40.500,3\n";
    let mut file = open(text);
    assert_eq!(all(&mut file, "Timestamp"), [0.0, 0.25, 0.5]);
    let v = &file.channels()[1];
    assert_eq!(v.start.map(|start| start.seconds), Some(1_000_000_000));
    assert_eq!(v.clock, uniform(0.0, 0.25));
}

#[test]
fn rounded_times_are_still_a_uniform_clock() {
    let mut text = String::from("Time,Force\ns,N\n");
    for k in 0..3000 {
        text += &format!("{:.5},{k}\n", f64::from(k) / 4096.0);
    }
    let file = open(text);
    let Clock::Uniform { first, interval } = file.channels()[1].clock else {
        panic!("{}", notes(&file));
    };
    // Two ends rounded by half of 1e-5 s, over 2999 intervals.
    assert!(
        first == 0.0 && (interval - 1.0 / 4096.0).abs() < 1e-5 / 2999.0,
        "{interval}"
    );
}

#[test]
fn a_time_without_unit_stays_in_its_own() {
    let file = open("Time,RPM\n0,598\n0.001,599\n0.002,600\n");
    assert_eq!(file.channels()[1].clock, Clock::Channel(0));
    assert!(notes(&file).contains("Time: is a time by its name, but its unit is not stated"));
}

#[test]
fn many_rows_and_columns_are_read_in_any_order() {
    let width = 3000;
    let mut text: String = (0..width).map(|c| format!("c{c},")).collect();
    text.pop();
    text.push('\n');
    for row in 0..1500 {
        let cells: Vec<String> = (0..width).map(|c| (row * 7 + c).to_string()).collect();
        text += &(cells.join(",") + "\n");
    }
    let mut file = open(text);
    assert_eq!(file.channels().len(), width);
    for (row, column) in [(1499, 2999), (0, 0), (700, 1500), (1, 2)] {
        let mut value = [0.0; 3];
        let read = file.read(column, row as u64, &mut value).unwrap();
        assert_eq!(value[0], (row * 7 + column) as f64);
        assert_eq!(read, 3.min(1500 - row));
    }
}

#[test]
fn files_of_the_laboratory_are_read_like_their_text() {
    let folder = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../measure/tests/data/tachorpm"
    );
    for name in ["test_input.csv", "matlab_ref_output.csv"] {
        let text = std::fs::read_to_string(format!("{folder}/{name}")).unwrap();
        let mut file = open(&text);
        let mut rows = text.lines();
        let names: Vec<&str> = rows.next().unwrap().split(',').collect();
        let column = |k: usize| -> Vec<f64> {
            let cells = text
                .lines()
                .skip(1)
                .map(|row| row.split(',').nth(k).unwrap());
            cells
                .map(|cell| cell.trim().parse().unwrap_or(f64::NAN))
                .collect()
        };
        for (k, name) in names.iter().enumerate() {
            let (ours, theirs) = (all(&mut file, name.trim()), column(k));
            let same =
                |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
            assert!(
                ours.len() == theirs.len() && ours.iter().zip(&theirs).all(same),
                "{name}"
            );
        }
    }
}

#[test]
fn a_written_table_comes_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.csv");
    let channels: Vec<Channel> = [("force, raw", "N"), ("odd", "")]
        .into_iter()
        .map(|(name, unit)| Channel {
            unit: unit.to_string(),
            clock: uniform(0.5, 1.0 / 42_000.0),
            ..Channel::new(name, 0)
        })
        .collect();
    let odd = [0.1, -0.0, 5e-324, f64::MAX, f64::NAN, 1.0 / 3.0, 1e22];
    let odd: Vec<f64> = (0..6000).map(|k| odd[k % odd.len()]).collect();
    let mut writer = Box::new(CsvWriter::create(&path, &channels).unwrap());
    writer.append(&[&waves(2000)[..], &odd[..2000]]).unwrap();
    let rest: Vec<f64> = (2000..6000).map(wave).collect();
    writer.append(&[&rest[..], &odd[2000..]]).unwrap();
    assert!(!path.exists(), "the name is given at the end");
    writer.finish().unwrap();
    let mut file = open(std::fs::read(&path).unwrap());
    assert_eq!(all(&mut file, "force, raw"), waves(6000));
    let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
    assert!(all(&mut file, "odd").iter().zip(&odd).all(same));
    let found = &file.channels()[1];
    assert_eq!(found.unit, "N");
    let Clock::Uniform { first, interval } = found.clock else {
        panic!("{}", notes(&file));
    };
    // The times are written with all their digits, over 5999 intervals.
    assert!(
        first == 0.5 && (interval * 42_000.0 - 1.0).abs() < 1e-12,
        "{interval}"
    );
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_table_that_cannot_be_written_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.csv");
    let a = Channel::new("a", 0);
    let b = Channel {
        clock: uniform(0.0, 1.0),
        ..Channel::new("b", 0)
    };
    let error = CsvWriter::create(&path, &[a.clone(), b]).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("channel b: has another clock than a")
    );
    let mut writer = CsvWriter::create(&path, &[a.clone(), Channel::new("c", 0)]).unwrap();
    assert!(writer.append(&[&[1.0], &[]]).is_err());
    drop(writer);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_text_that_is_no_table_is_refused() {
    for text in ["", "hello\nworld\n", "\n\n", "# 1,2\n"] {
        let error = Csv::from_source(Cursor::new(text.as_bytes().to_vec()), "a.txt".as_ref());
        assert!(
            error
                .unwrap_err()
                .to_string()
                .contains("no table of numbers")
        );
    }
}

#[test]
fn no_damage_makes_the_reader_panic() {
    let text = "Name: x\nTime [s];Kraft [N];Text\n0,0;1,5;a\n0,1;;b\n0,2;2,5e3;c\n12:00:01;2024-01-01 10:00:00;d\n";
    let wide: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
    for bytes in [text.as_bytes().to_vec(), bytes("pandas.csv"), wide] {
        crate::tables::damage(&bytes, 3000, &mut |bytes| {
            let file = Csv::from_source(Cursor::new(bytes), "damaged.csv".as_ref());
            if let Ok(mut file) = file {
                crate::tables::touch(&mut file);
            }
        });
    }
}

/// Old writers end a line with a carriage return alone.
#[test]
fn lines_that_end_with_a_return_are_read() {
    let mut file = open("time [s],force [N]\r0,1\r0.1,2\r0.2,-3\r");
    assert_eq!(all(&mut file, "force"), [1.0, 2.0, -3.0]);
    assert_eq!(file.channels()[1].clock, uniform(0.0, 0.1));
    assert!(file.notes().is_empty(), "{}", notes(&file));
}
