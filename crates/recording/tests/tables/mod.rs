//! What the tests of tables share: files of `peers/make_tables.py`, their formulas, and damage.
#![allow(dead_code)] // each test uses a part

use recording::Recording;

/// The bytes of a file of `data/peers`.
pub fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(path(name)).unwrap()
}

/// Where a file of `data/peers` stands.
pub fn path(name: &str) -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data/peers")
        .join(name)
}

/// The formula `wave` of the script.
pub fn wave(k: u32) -> f64 {
    f64::from(k * k % 97) / 8.0 - 6.0
}

/// The formula `ramp` of the script.
pub fn ramp(k: u32) -> f64 {
    3.0 * f64::from(k) - 50.0
}

/// The first values of `wave`.
pub fn waves(count: u32) -> Vec<f64> {
    (0..count).map(wave).collect()
}

/// The first values of `ramp`.
pub fn ramps(count: u32) -> Vec<f64> {
    (0..count).map(ramp).collect()
}

/// Index of the channel with a name.
pub fn channel(file: &dyn Recording, name: &str) -> usize {
    let names: Vec<&str> = file.channels().iter().map(|c| &*c.name).collect();
    let found = names.iter().position(|known| *known == name);
    found.unwrap_or_else(|| panic!("no {name} in {names:?}; {:?}", file.notes()))
}

/// All values of a channel, read in pieces of odd size.
pub fn all(file: &mut dyn Recording, name: &str) -> Vec<f64> {
    let index = channel(file, name);
    let mut values = Vec::new();
    let mut piece = [0.0; 77];
    loop {
        let read = file.read(index, values.len() as u64, &mut piece).unwrap();
        if read == 0 {
            break;
        }
        values.extend(&piece[..read]);
    }
    assert_eq!(values.len() as u64, file.channels()[index].count);
    values
}

/// Reads from the start, the middle and the end of every channel.
pub fn touch(file: &mut dyn Recording) {
    for index in 0..file.channels().len().min(200) {
        let count = file.channels()[index].count;
        for first in [0, count / 2, count.saturating_sub(3), u64::MAX] {
            let _ = file.read(index, first, &mut [0.0; 50]);
        }
    }
    let _ = file.notes().len();
}

/// Gives the bytes cut at many places, and with single bytes changed at `flips` places.
pub fn damage(bytes: &[u8], flips: u64, open: &mut dyn FnMut(Vec<u8>)) {
    let step = (bytes.len() / 1500).max(1);
    for end in (0..bytes.len()).step_by(step) {
        open(bytes[..end].to_vec());
    }
    // A linear congruence, for the same places in every run.
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        state >> 33
    };
    for _ in 0..flips {
        let mut changed = bytes.to_vec();
        for _ in 0..1 + next() % 3 {
            let at = (next() % bytes.len() as u64) as usize;
            changed[at] = [0, 0xff, 0x80, next() as u8][(next() % 4) as usize];
        }
        open(changed);
    }
}
