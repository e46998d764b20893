//! MAT 5 files that scipy wrote, and one written by hand (see `peers/make_tables.py`), are read value by value.

use crate::tables::{all, bytes, channel, ramps, waves};
use recording::file::mat5::Mat5;
use recording::{Clock, Recording};
use std::io::Cursor;

fn open(name: &str) -> Mat5<Cursor<Vec<u8>>> {
    Mat5::from_source(Cursor::new(bytes(name)), name.as_ref()).unwrap()
}

#[test]
fn packed_and_plain_files_give_the_same_values() {
    for name in ["packed.mat", "plain.mat"] {
        let mut file = open(name);
        for wave in ["torque", "both[1]", "single", "turning/real", "run/speed"] {
            assert_eq!(all(&mut file, wave), waves(300), "{name} {wave}");
        }
        for ramp in ["row", "both[2]", "long", "turning/imaginary"] {
            assert_eq!(all(&mut file, ramp), ramps(300), "{name} {ramp}");
        }
        let expected: Vec<f64> = (0..300).map(|k| f64::from(k % 200)).collect();
        assert_eq!(all(&mut file, "bytes"), expected);
        assert_eq!(all(&mut file, "run/list"), [1.0, 2.0]);
        assert_eq!(all(&mut file, "cell/1"), waves(4));
        let flags: Vec<f64> = (0..10).map(|k| f64::from((k + 1) % 2)).collect();
        assert_eq!(all(&mut file, "flags"), flags);
    }
}

#[test]
fn numbers_and_texts_are_no_channels_and_a_vector_of_times_is_a_clock() {
    for name in ["packed.mat", "plain.mat"] {
        let file = open(name);
        for name in ["fs", "note", "run/inner/unit", "run/inner/count", "cell/2"] {
            assert!(file.channels().iter().all(|own| own.name != name), "{name}");
        }
        // The unit of t is not stated, so the times stay in the unit of their channel, and that is noted.
        let t = channel(&file, "t");
        assert_eq!(
            file.channels()[channel(&file, "torque")].clock,
            Clock::Channel(t)
        );
        assert!(
            file.notes()
                .iter()
                .any(|n| n.channel.as_deref() == Some("t"))
        );
        // What is not as long as t has the clock of fs.
        let rate = Clock::Uniform {
            first: 0.0,
            interval: 0.125,
        };
        assert_eq!(file.channels()[channel(&file, "flags")].clock, rate);
        for left_out in ["empty", "cube"] {
            let shown = |note: &&recording::Note| note.channel.as_deref() == Some(left_out);
            assert!(
                file.notes().iter().any(|note| shown(&note)),
                "{name} {left_out}"
            );
        }
    }
}

#[test]
fn the_other_byte_order_is_read() {
    let mut file = open("big_endian.mat");
    assert_eq!(all(&mut file, "torque"), waves(20));
    assert_eq!(all(&mut file, "x"), ramps(3));
}

#[test]
fn pieces_may_be_read_in_any_order() {
    for name in ["packed.mat", "plain.mat"] {
        let mut file = open(name);
        let index = channel(&file, "turning/imaginary");
        for (first, count) in [(290, 20), (0, 5), (100, 100), (99, 1), (300, 5)] {
            let mut piece = vec![0.0; count];
            let read = file.read(index, first, &mut piece).unwrap();
            let end = (first as usize + count).min(300);
            assert_eq!(
                piece[..read],
                ramps(300)[first as usize..end],
                "{name} {first}"
            );
        }
    }
}

#[test]
fn a_file_that_is_cut_gives_what_is_there_and_says_so() {
    for name in ["packed.mat", "plain.mat"] {
        let whole = bytes(name);
        let cut = Cursor::new(whole[..whole.len() / 2].to_vec());
        let mut file = Mat5::from_source(cut, "cut.mat".as_ref()).unwrap();
        assert!(
            file.notes().iter().any(|n| n.text.contains("cut off")),
            "{name}"
        );
        assert_eq!(all(&mut file, "torque"), waves(300));
    }
}

#[test]
fn no_damage_makes_the_reader_panic() {
    for name in ["packed.mat", "plain.mat", "big_endian.mat"] {
        crate::tables::damage(&bytes(name), 2000, &mut |bytes| {
            let file = Mat5::from_source(Cursor::new(bytes), name.as_ref());
            if let Ok(mut file) = file {
                crate::tables::touch(&mut file);
            }
        });
    }
}
