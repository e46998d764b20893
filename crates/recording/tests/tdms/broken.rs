//! Files that are cut off or broken: whatever they are, nothing panics, hangs or takes memory that the file has not.

use std::io::Cursor;
use std::path::Path;

use proptest::prelude::*;
use recording::Recording;
use recording::file::tdms::Tdms;

use super::bytes::{BIG, DAQMX, META, NEW, RAW, Raw, Set, meta, segment};
use super::{changing, daqmx};

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
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn broken_bytes_neither_panic_nor_hang(which in 0usize..5, flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8)) {
        let mut bytes = samples().swap_remove(which);
        for (at, value) in flips {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        read_whatever(&bytes);
    }
}
