//! What an HDF5 file carries of checksums is verified, and what cannot be read of it is noted.

use crate::tables::{all, bytes, channel, ramp, ramps, waves};
use recording::file::hdf5::Hdf5;
use recording::{FileError, Recording};
use std::io::Cursor;

fn open(bytes: Vec<u8>) -> Result<Hdf5<Cursor<Vec<u8>>>, FileError> {
    Hdf5::from_source(Cursor::new(bytes), "damaged.h5".as_ref())
}

fn notes(file: &impl Recording) -> Vec<String> {
    let note = |note: &recording::Note| format!("{:?}: {}", note.channel, note.text);
    file.notes().iter().map(note).collect()
}

/// Channels as they are described, with the bits of all values.
fn content(file: &mut Hdf5<Cursor<Vec<u8>>>) -> (String, Vec<u64>) {
    let channels = file.channels().to_vec();
    let described = format!("{channels:?}");
    let mut bits = Vec::new();
    for (index, channel) in channels.iter().enumerate() {
        let mut values = vec![0.0; channel.count.min(20_000) as usize];
        let read = file.read(index, 0, &mut values).unwrap();
        bits.extend(values[..read].iter().map(|value: &f64| value.to_bits()));
    }
    (described, bits)
}

/// Places where bytes stand in a file.
fn places(bytes: &[u8], wanted: &[u8]) -> Vec<usize> {
    let windows = bytes.windows(wanted.len()).enumerate();
    let found = windows.filter(|(_, window)| *window == wanted);
    found.map(|(at, _)| at).collect()
}

#[test]
fn no_change_of_the_structure_passes_for_other_content() {
    for name in ["new.h5", "links.h5"] {
        let whole = bytes(name);
        let mut file = open(whole.clone()).unwrap();
        let (good, known) = (content(&mut file), notes(&file));
        for kind in [
            "OHDR", "OCHK", "FRHP", "FHDB", "FHIB", "BTHD", "BTIN", "BTLF", "FAHD", "FADB", "EAHD",
            "EAIB", "EASB", "EADB",
        ] {
            // Every piece is longer than 24 bytes; more of a kind show nothing new.
            for &at in places(&whole, kind.as_bytes()).iter().take(2) {
                for inside in 0..24 {
                    let mut changed = whole.clone();
                    changed[at + inside] ^= 1 << (inside % 8);
                    let Ok(mut file) = open(changed) else {
                        continue;
                    };
                    let found = content(&mut file);
                    assert!(
                        found == good || notes(&file) != known,
                        "{name}: byte {inside} of the {kind} at {at} changed, and nothing was noted"
                    );
                }
            }
        }
        // The superblock, without which nothing can be read.
        for inside in 8..48 {
            let mut changed = whole.clone();
            changed[inside] ^= 4;
            assert!(open(changed).is_err(), "{name}: byte {inside}");
        }
    }
}

#[test]
fn values_that_do_not_match_their_checksum_are_not_given() {
    let whole = bytes("links.h5");
    assert_eq!(all(&mut open(whole.clone()).unwrap(), "summed"), ramps(96));
    let second: Vec<u8> = (32..35).flat_map(|k| ramp(k).to_le_bytes()).collect();
    let at = places(&whole, &second)[0];
    for (inside, bit) in [(0, 0), (7, 6), (100, 3), (255, 7)] {
        let mut changed = whole.clone();
        changed[at + inside] ^= 1 << bit;
        let mut file = open(changed).unwrap();
        let index = channel(&file, "summed");
        assert!(!file.contradicts_checksum(index), "not read yet");
        let values = all(&mut file, "summed");
        assert!(file.contradicts_checksum(index));
        assert_eq!(values[..32], ramps(96)[..32]);
        assert!(
            values[32..64].iter().all(|value| value.is_nan()),
            "{inside}"
        );
        assert_eq!(values[64..], ramps(96)[64..]);
        let shown = notes(&file).iter().any(|note| note.contains("summed"));
        assert!(shown, "{:?}", notes(&file));
    }
}

/// The older headers carry no checksum: what contradicts itself is refused.
#[test]
fn an_old_header_that_contradicts_itself_is_noted() {
    let whole = bytes("old.h5");
    // The header of run/plain: version 1, eight messages, one reference; the first message behind 16 bytes.
    let heads = places(&whole, &[1, 0, 8, 0, 1, 0, 0, 0]);
    assert!(!heads.is_empty());
    for head in heads {
        for (inside, value) in [(2, 1), (18, 0xff), (19, 0x10), (18, 9)] {
            let mut changed = whole.clone();
            changed[head + inside] = value;
            let file = open(changed).unwrap();
            let shown = notes(&file);
            assert!(
                shown
                    .iter()
                    .any(|note| note.contains("an object header is damaged")),
                "{head} {inside}: {shown:?}"
            );
        }
    }
}

/// One byte of the old root header made all channels vanish without a word.
#[test]
fn a_group_whose_message_of_members_is_lost_is_noted() {
    let whole = bytes("old.h5");
    // The message of the members: its kind and its size of 16 bytes.
    let found = places(&whole, &[0x11, 0, 0x10, 0]);
    assert!(!found.is_empty());
    for at in found {
        let mut changed = whole.clone();
        changed[at] = 0x16;
        let found = notes(&open(changed).unwrap());
        assert!(
            found
                .iter()
                .any(|note| note.contains("names neither members nor values")),
            "{at}: {found:?}"
        );
    }
}

#[test]
fn a_damaged_attribute_is_noted() {
    let whole = bytes("old.h5");
    // Name, size of the name before it, and the version at the start of the message.
    let at = places(&whole, b"unit\0\0\0\0")[0] - 8;
    let mut changed = whole.clone();
    changed[at] = 9;
    let file = open(changed).unwrap();
    let shown = notes(&file);
    assert!(
        shown
            .iter()
            .any(|note| note.contains("attributes of it are damaged")),
        "{shown:?}"
    );
    let known = notes(&open(whole).unwrap());
    assert!(
        !known.iter().any(|note| note.contains("attributes")),
        "{known:?}"
    );
}

/// A node of a symbol table of version 0 (and no entries), and a dataspace larger than its largest size.
#[test]
fn a_symbol_table_or_dataspace_that_cannot_be_is_noted() {
    let whole = bytes("old.h5");
    let known = notes(&open(whole.clone()).unwrap());
    let is_noted = |changed: Vec<u8>| match open(changed) {
        Ok(file) => notes(&file).iter().any(|note| !known.contains(note)),
        Err(_) => true,
    };
    for node in places(&whole, b"SNOD\x01\0") {
        let mut changed = whole.clone();
        changed[node + 4..node + 8].fill(0);
        assert!(is_noted(changed), "{node}");
    }
    // version 1, one dimension with a largest size, both 400
    let [now, most] = [400u64, 400].map(u64::to_le_bytes);
    let space = [&[1, 1, 1, 0, 0, 0, 0, 0][..], &now, &most].concat();
    let found = places(&whole, &space);
    assert!(!found.is_empty());
    for at in found {
        let mut changed = whole.clone();
        changed[at + 16] -= 1;
        assert!(is_noted(changed), "{at}");
    }
}

#[test]
fn links_that_lead_nowhere_and_deep_groups_are_noted() {
    let mut file = open(bytes("links.h5")).unwrap();
    assert_eq!(all(&mut file, "force"), waves(20));
    let deep = format!("{}speed", "deep/".repeat(40));
    assert_eq!(all(&mut file, &deep), ramps(20));
    let shown = notes(&file);
    for text in [
        "\"elsewhere\"): leads to the file other.h5; it is left out",
        "\"nowhere\"): leads to /many/force, which is not there",
        "below\"): stands below 64 groups; it is left out",
    ] {
        assert!(
            shown.iter().any(|note| note.contains(text)),
            "{text}: {shown:?}"
        );
    }
    // The two hundred links to a channel that is there are one of them.
    assert_eq!(shown.len(), 4, "{shown:?}");
    assert!(
        (shown.iter())
            .any(|note| note.contains("200 links or other names") && note.contains("(read as ")),
        "{shown:?}"
    );
    assert_eq!(
        channel(&file, "force"),
        0,
        "a group before the groups below it"
    );
}
