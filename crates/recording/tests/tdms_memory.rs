//! The memory that a long TDMS file of many segments costs: a process of its own, so that nothing else is counted.

use std::path::Path;

use recording::Channel;
use recording::file;

/// Peak of the memory of this process, bytes; none where the system does not report it.
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace()
        .nth(1)?
        .parse::<u64>()
        .ok()
        .map(|kilobytes| 1024 * kilobytes)
}

#[test]
fn a_file_of_64_megabytes_is_written_and_read_in_little_memory() {
    let Some(before) = peak() else {
        println!("did not run: this system does not report the memory of a process");
        return;
    };
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("long.tdms");
    let channels: Vec<Channel> = (0..8).map(|i| Channel::new(format!("g/{i}"), 0)).collect();
    let mut writer = file::create(&path, &channels).unwrap();
    let rows = 1 << 20;
    let piece = 1 << 12;
    for start in (0..rows).step_by(piece) {
        let columns: Vec<Vec<f64>> = (0..8)
            .map(|c| {
                (start..start + piece)
                    .map(|row| (row * 8 + c) as f64)
                    .collect()
            })
            .collect();
        let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        writer.append(&slices).unwrap();
    }
    writer.finish().unwrap();
    assert!(std::fs::metadata(&path).unwrap().len() > 64 << 20);

    let mut file = file::open(&path).unwrap();
    let mut values = vec![0.0; piece];
    for channel in 0..8 {
        for start in (0..rows).step_by(piece) {
            assert_eq!(file.read(channel, start as u64, &mut values), Ok(piece));
            let wrong = values
                .iter()
                .enumerate()
                .find(|(i, value)| **value != ((start + i) * 8 + channel) as f64);
            assert_eq!(wrong, None);
        }
    }
    std::fs::remove_file(&path).unwrap();
    // A writer gathers 1 MiB and a reader keeps a window of 64 KiB: 16 MiB leave room for the allocator, and are a quarter
    // of the file.
    let cost = peak().unwrap() - before;
    assert!(cost < 16 << 20, "{cost} bytes");
}
