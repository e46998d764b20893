//! A file is opened by its content, and what is written under a name is read from it.

use crate::tables::{all, path, waves};
use recording::file::{create, open};
use recording::{Channel, Clock};

#[test]
fn the_content_shows_the_format() {
    for (name, channel) in [
        ("old.h5", "run/plain"),
        ("new.h5", "run/plain"),
        ("v73.mat", "torque"),
        ("packed.mat", "torque"),
        ("big_endian.mat", "torque"),
        ("snappy.parquet", "force"),
        ("german.csv", "Kraft"),
    ] {
        let mut file = open(path(name)).unwrap();
        let values = all(&mut *file, channel);
        assert_eq!(values[..20], waves(20), "{name}");
    }
}

#[test]
fn a_text_under_another_name_is_reported() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.parquet", "a.mat", "a.h5", "a.tdms"] {
        let path = folder.path().join(name);
        std::fs::write(&path, "t,F\n0,1\n").unwrap();
        let error = open(&path).err().unwrap().to_string();
        assert!(error.contains(name) && error.contains("is text"), "{error}");
    }
    let path = folder.path().join("a.csv");
    std::fs::write(&path, "").unwrap();
    assert!(open(&path).err().unwrap().to_string().contains("is empty"));
}

#[test]
fn what_is_written_under_a_name_is_read_from_it() {
    let folder = tempfile::tempdir().unwrap();
    let channel = Channel {
        unit: "N".to_string(),
        clock: Clock::Uniform {
            first: 0.0,
            interval: 1e-3,
        },
        ..Channel::new("force", 0)
    };
    for name in ["out.csv", "out.parquet", "out.tdms"] {
        let path = folder.path().join(name);
        let mut writer = create(&path, std::slice::from_ref(&channel)).unwrap();
        writer.append(&[&waves(100)]).unwrap();
        writer.finish().unwrap();
        let mut file = open(&path).unwrap();
        let index = file
            .channels()
            .iter()
            .position(|c| c.name.ends_with("force"));
        let found = file.channels()[index.unwrap()].clone();
        assert_eq!(all(&mut *file, &found.name), waves(100), "{name}");
        assert_eq!(
            (&*found.unit, &found.clock),
            ("N", &channel.clock),
            "{name}"
        );
    }
    assert!(create(folder.path().join("out.xyz"), &[channel]).is_err());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 3);
}
