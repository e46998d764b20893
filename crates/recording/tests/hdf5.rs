//! HDF5 and MAT 7.3 files that h5py wrote (see `peers/make_tables.py`) are read value by value.

use crate::tables::{all, bytes, channel, ramp, ramps, waves};
use recording::file::hdf5::Hdf5;
use recording::{Clock, Recording};
use std::io::Cursor;

fn open(name: &str) -> Hdf5<Cursor<Vec<u8>>> {
    Hdf5::from_source(Cursor::new(bytes(name)), name.as_ref()).unwrap()
}

#[test]
fn both_generations_of_the_format_give_the_same_values() {
    for name in ["old.h5", "new.h5"] {
        let mut file = open(name);
        for wave in [
            "plain",
            "lzf",
            "half",
            "single",
            "growing",
            "growing_packed",
            "one_chunk",
            "columns[1]",
            "columns_chunked[1]",
            "rows_chunked[1]",
            "table/a",
        ] {
            assert_eq!(
                all(&mut file, &format!("run/{wave}")),
                waves(400),
                "{name} {wave}"
            );
        }
        for ramp in [
            "packed",
            "big_endian",
            "columns[2]",
            "columns_chunked[2]",
            "rows_chunked[2]",
            "table/b",
        ] {
            assert_eq!(
                all(&mut file, &format!("run/{ramp}")),
                ramps(400),
                "{name} {ramp}"
            );
        }
        for k in 0..12 {
            let values: Vec<f64> = (0..3).map(|i| ramp(i) + f64::from(k)).collect();
            assert_eq!(all(&mut file, &format!("many/short{k:02}")), values);
        }
        assert_eq!(all(&mut file, "run/small"), waves(5));
        let flags: Vec<f64> = (0..10).map(|k| f64::from((k + 1) % 2)).collect();
        assert_eq!(all(&mut file, "run/flags"), flags);
    }
}

#[test]
fn tables_of_chunks_in_pages_are_read() {
    let mut file = open("new.h5");
    let expected: Vec<f64> = (0..9000).map(|k| ramp(k).rem_euclid(251.0)).collect();
    assert_eq!(all(&mut file, "run/paged_growing"), expected);
    assert_eq!(all(&mut file, "run/paged"), expected[..1500]);
}

#[test]
fn what_was_never_written_has_the_fill_value() {
    for name in ["old.h5", "new.h5"] {
        let values = all(&mut open(name), "run/gaps");
        let mut expected = vec![7.0; 100];
        expected[20..30].fill(1.0);
        expected[99] = 2.0;
        assert_eq!(values, expected, "{name}");
    }
}

#[test]
fn a_piece_in_the_middle_is_the_same_as_in_the_whole() {
    let mut file = open("new.h5");
    for name in [
        "plain",
        "growing_packed",
        "columns_chunked[2]",
        "columns[1]",
    ] {
        let name = format!("run/{name}");
        let whole = all(&mut file, &name);
        let index = channel(&file, &name);
        for (first, count) in [(0, 1), (399, 1), (63, 130), (250, 1000), (400, 5)] {
            let mut piece = vec![0.0; count];
            let read = file.read(index, first, &mut piece).unwrap();
            let end = (first as usize + count).min(400);
            assert_eq!(piece[..read], whole[first as usize..end], "{name} {first}");
        }
    }
}

#[test]
fn units_and_clocks_come_from_attributes() {
    for name in ["old.h5", "new.h5"] {
        let file = open(name);
        let channels = file.channels();
        let plain = &channels[channel(&file, "run/plain")];
        assert_eq!(
            (&*plain.unit, &*plain.description),
            ("N", "force on the arm")
        );
        let rate = |interval| Clock::Uniform {
            first: 0.0,
            interval,
        };
        assert_eq!(plain.clock, rate(0.001));
        let packed = &channels[channel(&file, "run/packed")];
        assert_eq!((&*packed.unit, &packed.clock), ("rpm", &rate(0.5)));
        // 0.25 ms from a channel of times.
        let signal = &channels[channel(&file, "timed/signal")];
        assert_eq!(signal.clock, rate(0.00025));
        let time = &channels[channel(&file, "timed/time")];
        assert_eq!(
            time.unit, "ms",
            "of more attributes than fit into the header"
        );
    }
}

#[test]
fn what_is_left_out_is_reported() {
    for name in ["old.h5", "new.h5"] {
        let file = open(name);
        let single = |note: &recording::Note| note.text.contains("no channels: run/scalar");
        assert!(file.notes().iter().any(single), "{:?}", file.notes());
        for left_out in ["run/words", "run/cube"] {
            let shown = |note: &&recording::Note| note.channel.as_deref() == Some(left_out);
            assert!(
                file.notes().iter().any(|note| shown(&note)),
                "{name} {left_out}"
            );
        }
    }
}

#[test]
fn matlab_columns_are_channels() {
    let mut file = open("v73.mat");
    assert_eq!(all(&mut file, "torque"), waves(300));
    assert_eq!(all(&mut file, "row"), ramps(300));
    assert_eq!(all(&mut file, "both[1]"), waves(300));
    assert_eq!(all(&mut file, "both[2]"), ramps(300));
    assert_eq!(all(&mut file, "run/speed"), waves(300));
    // MATLAB states no unit, so the times stay in the unit of their channel.
    let t = Clock::Channel(channel(&file, "t"));
    assert_eq!(file.channels()[channel(&file, "torque")].clock, t);
    assert_eq!(file.channels()[channel(&file, "run/speed")].clock, t);
}

#[test]
fn a_file_that_is_cut_gives_what_is_there_and_says_so() {
    let whole = bytes("v73.mat");
    let cut = Cursor::new(whole[..whole.len() - 1000].to_vec());
    if let Ok(file) = Hdf5::from_source(cut, "cut.mat".as_ref()) {
        assert!(!file.notes().is_empty());
    }
}

#[test]
fn no_damage_makes_the_reader_panic() {
    for name in ["old.h5", "new.h5", "v73.mat"] {
        crate::tables::damage(&bytes(name), 400, &mut |bytes| {
            let file = Hdf5::from_source(Cursor::new(bytes), name.as_ref());
            if let Ok(mut file) = file {
                crate::tables::touch(&mut file);
            }
        });
    }
}

/// MATLAB writes its text into a user block before the file: the end that the file states counts from its first byte.
#[test]
fn a_user_block_is_no_cut() {
    let shown = |bytes: Vec<u8>| {
        let file = Hdf5::from_source(Cursor::new(bytes), "v73.mat".as_ref()).unwrap();
        file.notes()
            .iter()
            .any(|note| note.text.contains("cut off"))
    };
    let whole = bytes("v73.mat");
    assert!(!shown(whole.clone()));
    let length = whole.len();
    assert!(shown(whole[..length - 1].to_vec()));
}

#[test]
fn arrays_of_structures_are_left_out_with_the_way_out() {
    let file = open("references.mat");
    let told = |name: &str| {
        let notes = file.notes().iter();
        let mut own = notes.filter(|note| note.channel.as_deref() == Some(name));
        own.any(|note| note.text.contains("-v7") && note.text.contains("S(1).speed"))
    };
    assert!(told("S/speed") && told("S/time"), "{:?}", file.notes());
}
