//! Files on the disk: what is written is read, what is no TDMS.

use std::path::{Path, PathBuf};

use measure::file;
use measure::recording::{Channel, Clock, Instant, Property, Value};
use proptest::prelude::*;

use super::all;

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
            properties: vec![Property { name: "bits".into(), value: Value::Number(24.0) }],
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
            prop_assert!(read.properties.contains(&written.properties[0]));
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
