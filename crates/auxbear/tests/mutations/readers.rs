//! Measurement files of every format.

use crate::mutator::{Dice, bytes};
use crate::touch::touch;
use crate::watch::{Watch, count};
use crate::{files, repository};
use recording::file::{csv, hdf5, mat5, parquet, tdms, uff, wav};
use recording::{Channel, Clock, Content, FileError, Recording};
use std::fs;
use std::io::Cursor;
use std::path::Path;

/// Mutations of each format in the short form: together some seconds.
const USUAL: usize = 200;

/// Channels and values of each that are read of a file.
const CHANNELS: usize = 16;
const VALUES: usize = 1 << 17;

/// Reads the first values of the first channels, then pieces here and there; tells whether the file was opened.
fn read(file: Result<impl Recording, FileError>) -> bool {
    let Ok(mut file) = file else {
        return false;
    };
    let mut values = vec![0.0; VALUES];
    for channel in 0..file.channels().len().min(CHANNELS) {
        if file.channels()[channel].content != Content::Text {
            let _ = file.read(channel, 0, &mut values);
        }
    }
    touch(Ok(file));
    true
}

/// Mutates files of one format and reads them.
fn mutate(name: &'static str, seeds: &[Vec<u8>], open: impl Fn(Cursor<Vec<u8>>, &Path) -> bool) {
    let path = Path::new("mutated");
    for seed in seeds {
        assert!(
            open(Cursor::new(seed.clone()), path),
            "a seed of {name} is not read"
        );
    }
    let mut watch = Watch::new(name);
    for k in 0..count("AUXBEAR_MUTATIONS", USUAL) {
        let mut dice = Dice::new(k as u64);
        let seed = dice.of(seeds);
        let other = dice.of(seeds);
        let mutated = bytes(&mut dice, seed, other);
        watch.each(&mutated, || open(Cursor::new(mutated.clone()), path));
    }
    watch.end();
}

fn peers(ending: &str) -> Vec<Vec<u8>> {
    let found = files("crates/recording/tests/data/peers", ending).into_iter();
    found.map(|(_, bytes)| bytes).collect()
}

/// A file of this program's own writer: two channels with one clock, one without.
fn written(ending: &str) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("a.{ending}"));
    let clock = Clock::Uniform {
        first: 0.5,
        interval: 1e-3,
    };
    let channel = |name: &str, unit: &str| Channel {
        unit: unit.to_string(),
        clock: clock.clone(),
        ..Channel::new(name, 0)
    };
    let channels = [channel("rig/speed", "V"), channel("rig/torque", "N m")];
    let mut writer = recording::file::create(&path, &channels).unwrap();
    let wave: Vec<f64> = (0..500).map(|k| f64::from(k * k % 97) / 8.0).collect();
    for piece in wave.chunks(120) {
        writer.append(&[piece, piece]).unwrap();
    }
    writer.finish().unwrap();
    fs::read(&path).unwrap()
}

#[test]
fn mutated_tdms_is_read() {
    let recorded = fs::read(repository("scenarios/data/spin_up.tdms")).unwrap();
    let seeds = [written("tdms"), written("tdms"), recorded];
    mutate("tdms", &seeds, |bytes, path| {
        read(tdms::Tdms::from_source(bytes, path))
    });
}

#[test]
fn mutated_csv_is_read() {
    let mut seeds = peers("csv");
    seeds.push(written("csv"));
    let wide = "\u{feff}t;Kraft\ns;N\n1;2\n2;3,5\n".encode_utf16();
    seeds.push(wide.flat_map(u16::to_le_bytes).collect());
    mutate("csv", &seeds, |bytes, path| {
        read(csv::Csv::from_source(bytes, path))
    });
}

#[test]
fn mutated_hdf5_is_read() {
    let mut seeds = peers("h5");
    let matlab = repository("crates/recording/tests/data/peers/v73.mat");
    seeds.push(fs::read(matlab).unwrap());
    mutate("hdf5", &seeds, |bytes, path| {
        read(hdf5::Hdf5::from_source(bytes, path))
    });
}

#[test]
fn mutated_mat5_is_read() {
    let mut seeds = peers("mat");
    seeds.retain(|seed| mat5::is_mat5(seed));
    mutate("mat5", &seeds, |bytes, path| {
        read(mat5::Mat5::from_source(bytes, path))
    });
}

#[test]
fn mutated_parquet_is_read() {
    let mut seeds = peers("parquet");
    seeds.push(written("parquet"));
    mutate("parquet", &seeds, |bytes, path| {
        read(parquet::Parquet::from_source(bytes, path))
    });
}

#[test]
fn mutated_uff_is_read() {
    let seeds: Vec<Vec<u8>> = files("crates/recording/tests/data", "uff")
        .into_iter()
        .map(|(_, bytes)| bytes)
        .collect();
    mutate("uff", &seeds, |bytes, path| {
        read(uff::Uff::from_source(bytes, path))
    });
}

/// A WAV file of 16-bit numbers or of single ones.
fn wave_file(code: u16, bits: u16, data: &[u8]) -> Vec<u8> {
    let mut chunk = b"fmt \x10\0\0\0".to_vec();
    let block = 2 * bits / 8;
    for word in [code, 2] {
        chunk.extend(word.to_le_bytes());
    }
    for word in [8000, 8000 * u32::from(block)] {
        chunk.extend(word.to_le_bytes());
    }
    for word in [block, bits] {
        chunk.extend(word.to_le_bytes());
    }
    chunk.extend(b"LIST\x06\0\0\0INFOab");
    chunk.extend(b"data");
    chunk.extend((data.len() as u32).to_le_bytes());
    chunk.extend(data);
    let mut file = b"RIFF".to_vec();
    file.extend((chunk.len() as u32 + 4).to_le_bytes());
    file.extend(b"WAVE");
    file.extend(chunk);
    file
}

#[test]
fn mutated_wav_is_read() {
    let whole: Vec<u8> = (0..800_i16).flat_map(|k| (k * 37).to_le_bytes()).collect();
    let single: Vec<u8> = (0..400_u16)
        .flat_map(|k| (f32::from(k) / 7.0).to_le_bytes())
        .collect();
    let seeds = [wave_file(1, 16, &whole), wave_file(3, 32, &single)];
    mutate("wav", &seeds, |bytes, path| {
        read(wav::Wav::from_source(bytes, path))
    });
}
