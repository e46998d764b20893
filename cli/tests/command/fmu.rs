//! `auxbear fmu`, and units that command magnets.

use crate::place::Place;
use std::fs;
use std::path::{Path, PathBuf};

/// A file that begins as a library of 64-bit Linux does.
fn library(place: &Place) -> PathBuf {
    let mut bytes = b"\x7fELF\x02\x01\x01".to_vec();
    bytes.resize(64, 0);
    bytes[18] = 62;
    let path = place.path("library.so");
    fs::write(&path, bytes).unwrap();
    path
}

fn rig() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/amb_rig_drop.toml");
    fs::read_to_string(path).unwrap()
}

#[test]
fn a_unit_is_written_with_the_libraries_that_are_named_and_says_what_it_holds() {
    let place = Place::new();
    let library = library(&place);
    let library = library.to_str().unwrap();
    fs::write(place.path("rig.toml"), rig()).unwrap();
    let later = ["--set", "levitation.power_lost_at=1 ms"];
    let words = |more: &[&'static str]| {
        [
            &["fmu", "rig.toml", "--library"],
            &[library][..],
            &later,
            more,
        ]
        .concat()
    };
    let called = place.call(&words(&[])).done();
    assert!(
        called
            .out
            .starts_with("rig.fmu\nFMI 2.0 for co-simulation: 5 inputs, "),
        "{}",
        called.out
    );
    assert!(
        called.out.contains("linux64: ") && !called.out.contains("k_s"),
        "{}",
        called.out
    );
    let called = place
        .call(&words(&[
            "--input",
            "force",
            "--version",
            "3",
            "--out",
            "force.fmu",
        ]))
        .done();
    assert!(
        called.out.contains("FMI 3.0") && called.out.contains("x86_64-linux: "),
        "{}",
        called.out
    );
    assert!(called.out.contains("k_s"), "{}", called.out);
    let drop = place
        .call(&["fmu", "drop.toml", "--library", library])
        .done();
    assert!(
        drop.out.contains(" 3 inputs, ") && drop.out.contains("No magnets"),
        "{}",
        drop.out
    );
    // a file is never written over another
    place
        .call(&words(&[]))
        .refused(&["rig.fmu", "never written over"]);
    place
        .call(&words(&["--out", "other.fmu", "--input", "amps"]))
        .refused(&["--input", "\"amps\"", "current, voltage, force"]);
    place
        .call(&words(&["--out", "other.fmu", "--version", "1"]))
        .refused(&["--version", "2, 3"]);
    place
        .call(&words(&["--out", "other.fmu", "--input", "voltage"]))
        .refused(&["levitation.magnet", "inductance and resistance"]);
    place
        .call(&words(&["--out", "other.fmu", "--library", "rig.toml"]))
        .refused(&["rig.toml", "no library of Linux"]);
    let twice = [&words(&["--out", "other.fmu", "--library"])[..], &[library]].concat();
    place
        .call(&twice)
        .refused(&["a second library for linux64"]);
    assert_eq!(
        place.names(),
        ["drop.fmu", "force.fmu", "library.so", "rig.fmu", "rig.toml"]
    );
}

#[test]
fn without_a_library_it_says_what_makes_one() {
    let place = Place::new();
    let program = place.path("auxbear");
    fs::copy(env!("CARGO_BIN_EXE_auxbear"), &program).unwrap();
    let called = std::process::Command::new(&program)
        .args(["fmu", "drop.toml"])
        .current_dir(place.folder())
        .output()
        .unwrap();
    crate::place::Called::of(called).refused(&[
        "auxbear_fmu",
        "beside the program",
        "cargo build --release",
    ]);
    assert_eq!(place.names(), ["auxbear"]);
}

#[test]
fn a_unit_that_cannot_command_magnets_is_refused_before_the_run() {
    let place = Place::new();
    let sampled = "fmu = \"controller.fmu\"\nsampling_period = \"50 us\"";
    fs::write(
        place.path("rig.toml"),
        rig().replace("delay = \"50 us\"", sampled),
    )
    .unwrap();
    let words = ["run", "rig.toml", "--quiet"];
    place
        .call(&words)
        .refused(&["levitation.controller.fmu", "No such file"]);
    fs::write(place.path("controller.fmu"), "no unit").unwrap();
    place
        .call(&words)
        .refused(&["controller.fmu", "no unit that can be unpacked"]);
    // a unit, and of the other kind: it has the inputs of a machine
    let library = library(&place);
    let export = [
        "fmu",
        "drop.toml",
        "--out",
        "machine.fmu",
        "--library",
        library.to_str().unwrap(),
    ];
    place.call(&export).done();
    fs::rename(place.path("machine.fmu"), place.path("controller.fmu")).unwrap();
    place.call(&words).refused(&["controller.fmu"]);
    fs::write(
        place.path("delayed.toml"),
        rig().replace("delay = \"50 us\"", "fmu = \"controller.fmu\""),
    )
    .unwrap();
    place
        .call(&["check", "delayed.toml"])
        .refused(&["levitation.controller.1.fmu", "sampling_period"]);
    assert!(!place.path("runs").exists());
}
