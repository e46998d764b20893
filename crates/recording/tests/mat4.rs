//! MAT files of level 4, laid out by hand as SciPy writes and reads them.

use crate::tables::{all, damage, touch};
use recording::Recording;
use recording::file::mat5::Mat5;
use std::io::Cursor;

/// A matrix: type without its byte order, rows, columns, complex, name, bytes of the values in either order.
fn matrix(kind: i32, sizes: [i32; 3], name: &str, big: bool, values: &[Vec<u8>]) -> Vec<u8> {
    let [rows, columns, complex] = sizes;
    let kind = kind + if big { 1000 } else { 0 };
    let words = [kind, rows, columns, complex, name.len() as i32 + 1];
    let order = |mut bytes: Vec<u8>| {
        if big {
            bytes.reverse();
        }
        bytes
    };
    let mut all: Vec<u8> = words
        .iter()
        .flat_map(|w| order(w.to_le_bytes().to_vec()))
        .collect();
    all.extend(name.as_bytes());
    all.push(0);
    all.extend(values.iter().flat_map(|value| order(value.clone())));
    all
}

fn doubles(values: impl IntoIterator<Item = f64>) -> Vec<Vec<u8>> {
    values
        .into_iter()
        .map(|v| v.to_le_bytes().to_vec())
        .collect()
}

fn file(big: bool) -> Vec<u8> {
    let speeds = (0..200).map(|k| 120.0 - 0.06 * f64::from(k));
    let shorts = (0..6i16).map(|k| (k - 3).to_le_bytes().to_vec());
    [
        matrix(0, [200, 1, 0], "speed", big, &doubles(speeds)),
        matrix(30, [3, 2, 0], "both", big, &shorts.collect::<Vec<_>>()),
        matrix(0, [1, 1, 0], "fs", big, &doubles([100.0])),
        matrix(
            0,
            [3, 1, 1],
            "turn",
            big,
            &doubles([1.0, 2.0, 3.0, -1.0, -2.0, -3.0]),
        ),
        matrix(51, [1, 2, 0], "note", big, &[vec![b'o'], vec![b'k']]),
        matrix(
            51,
            [2, 2, 0],
            "names",
            big,
            &[vec![b'a'], vec![b'b'], vec![b'c'], vec![b'd']],
        ),
        matrix(2, [2, 3, 0], "thin", big, &doubles([1.0; 6])),
        matrix(0, [2, 1, 0], "last", big, &doubles([7.0, 8.0])),
    ]
    .concat()
}

#[test]
fn matrices_of_level_4_are_channels_in_both_byte_orders() {
    for big in [false, true] {
        let bytes = file(big);
        assert!(recording::file::mat5::is_mat5(&bytes));
        let mut file = Mat5::from_source(Cursor::new(bytes), "x.mat".as_ref()).unwrap();
        let speed = all(&mut file, "speed");
        assert_eq!((speed.len(), speed[0], speed[50]), (200, 120.0, 117.0));
        assert_eq!(all(&mut file, "both[1]"), [-3.0, -2.0, -1.0]);
        assert_eq!(all(&mut file, "both[2]"), [0.0, 1.0, 2.0]);
        assert_eq!(all(&mut file, "turn/imaginary"), [-1.0, -2.0, -3.0]);
        assert_eq!(all(&mut file, "last"), [7.0, 8.0]);
        let left_out = |name| {
            file.notes()
                .iter()
                .any(|n| n.channel.as_deref() == Some(name))
        };
        assert!(left_out("names") && left_out("thin"), "{:?}", file.notes());
    }
}

#[test]
fn no_damage_of_level_4_makes_the_reader_panic() {
    damage(&file(false), 2000, &mut |bytes| {
        if let Ok(mut file) = Mat5::from_source(Cursor::new(bytes), "x.mat".as_ref()) {
            touch(&mut file);
        }
    });
}
