//! Files on the disk: what is written is read, what is no TDMS.

use std::path::{Path, PathBuf};

use proptest::prelude::*;
use recording::file;
use recording::{Channel, Clock, Instant, Recording};

use super::bytes::{BIG, META, NEW, RAW, Raw, Set, meta, segment};
use super::{all, open};

proptest! {
    // Each case waits for the disk.
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_written_is_read(
        names in prop::collection::hash_set("[a-z'é ]{1,6}(/[a-z'/]{1,6})?", 1..4),
        pieces in prop::collection::vec(prop::collection::vec(any::<f64>(), 0..20), 0..6),
        interval in 1e-6f64..10.0,
    ) {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("round.tdms");
        let names: Vec<String> = names.into_iter().collect();
        let channels: Vec<Channel> = names.iter().map(|name| Channel {
            unit: "m/s²".into(),
            description: "a remark".into(),
            start: Some(Instant { seconds: 1_700_000_000, fraction: 0.25 }),
            clock: Clock::Uniform { first: -1.0, interval },
            ..Channel::new(name.clone(), 0)
        }).collect();
        let mut writer = file::create(&path, &channels).unwrap();
        for piece in &pieces {
            writer.append(&vec![piece.as_slice(); channels.len()]).unwrap();
        }
        writer.finish().unwrap();
        let expected: Vec<u64> = pieces.concat().iter().map(|v| v.to_bits()).collect();
        let mut back = file::open(&path).unwrap();
        prop_assert_eq!(back.notes(), []);
        prop_assert_eq!(back.channels().len(), channels.len());
        for (i, written) in channels.iter().enumerate() {
            let read = back.channels()[i].clone();
            let name = if written.name.contains('/') { written.name.clone() } else { format!("Untitled/{}", written.name) };
            prop_assert_eq!(&read.name, &name);
            prop_assert_eq!((&read.unit, &read.description, read.start, &read.clock), (&written.unit, &written.description, written.start, &written.clock));
            let values: Vec<u64> = all(back.as_mut(), i).iter().map(|v| v.to_bits()).collect();
            prop_assert_eq!(&values, &expected);
        }
    }
}

#[test]
fn a_file_has_its_name_only_when_it_is_finished() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("draft");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("a.tdms");
    let mut writer = file::create(&path, &[Channel::new("a", 0)]).unwrap();
    writer.append(&[&[1.0; 200_000]]).unwrap();
    assert!(!path.exists());
    drop(writer);
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
    assert!(file::create(folder.join("none").join("a.tdms"), &[]).is_err());
    assert!(
        file::create(
            &path,
            &[Channel::new("a", 0), Channel::new("Untitled/a", 0)]
        )
        .is_err_and(|e| e.to_string().contains("twice"))
    );
}

#[test]
fn what_is_no_tdms_is_reported() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let message = |name: &str, bytes: &[u8]| {
        std::fs::write(folder.join(name), bytes).unwrap();
        file::open(folder.join(name))
            .err()
            .map(|e| e.to_string())
            .unwrap_or_default()
    };
    let text = message("text.tdms", b"this is no measurement");
    assert!(
        text.contains("text.tdms") && text.contains("is text") && text.contains("TDMS, "),
        "{text}"
    );
    assert!(message("empty.tdms", b"").contains("empty"));
    assert!(message("index.tdms", b"TDSh\x0e\0\0\0").contains("index of a TDMS file"));
    assert!(message("noise.tdms", &[0, 1, 2, 3, 250, 0]).contains("no format that is known"));
    assert!(
        file::open(folder.join("absent.tdms")).is_err_and(|e| e.found.contains("cannot be opened"))
    );
}

/// As laboratories leave them: big-endian, a start that was never set, and a `wf_samples` that is not the number of values.
///
/// npTDMS 1.13.0 reads these values, and those of the tests below of time stamps and of scaled and raw DAQmx data.
#[test]
fn a_big_endian_file_counts_its_own_values() {
    let waveform = || {
        vec![
            ("wf_start_time", Set::Time(0, 0)),
            ("wf_increment", Set::Double(0.001)),
            ("wf_samples", Set::Whole(2)),
            ("unit_string", Set::Text("V")),
        ]
    };
    let objects = [
        ("/'sweep'/'amplitude'", Raw::Plain(10, 3), waveform()),
        ("/'sweep'/'phase'", Raw::Plain(10, 3), waveform()),
    ];
    let raw = |values: [f64; 3]| values.map(f64::to_be_bytes).concat();
    let chunk = [raw([0.0, -1.5, 5.25]), raw([0.5, -0.75, 0.125])].concat();
    let mut file = open(
        "sweep.tdms",
        &segment(
            META | NEW | RAW | BIG,
            &meta(true, &objects),
            &[chunk.clone(), chunk].concat(),
        ),
    );
    assert_eq!(file.notes(), []);
    assert_eq!(all(&mut file, 0), [0.0, -1.5, 5.25, 0.0, -1.5, 5.25]);
    assert_eq!(all(&mut file, 1), [0.5, -0.75, 0.125, 0.5, -0.75, 0.125]);
    let phase = &file.channels()[1];
    assert_eq!((phase.start, phase.unit.as_str()), (None, "V"));
    assert_eq!(
        phase.clock,
        Clock::Uniform {
            first: 0.0,
            interval: 0.001
        }
    );
}
