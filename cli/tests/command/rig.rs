//! `auxbear run` of a rig, and `auxbear identify`.

use crate::place::Place;
use std::fs;
use std::path::Path;

fn scenario(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
    folder.join(name).display().to_string()
}

/// A short test on a rig in `test`.
fn tested(place: &Place) {
    let file = scenario("rig_test_3.toml");
    let words = [
        "run",
        &file,
        "--out",
        "test",
        "--quiet",
        "--set",
        "run.duration=0.6 s",
        "--set",
        "rig.release_at=0.55 s",
    ];
    place.call(&words).done();
}

fn identify(place: &Place, coast_down: &str, more: &str) {
    let text = format!(
        "format = \"auxbear.scenario/1\"\nsystem = \"identify\"\n[identify]\ncoast_down = [\"{coast_down}\"]\n{more}\n[bearing]\nname = \"6005\"\n"
    );
    fs::write(place.path("identify.toml"), text).unwrap();
}

#[test]
fn a_rig_leaves_a_raw_file_that_the_next_command_reads() {
    let place = Place::new();
    tested(&place);
    for name in ["raw.tdms", "signals.toml", "history.parquet", "report.html"] {
        assert!(place.path("test").join(name).exists(), "{name}");
    }
    let text = place
        .call(&["signals", "test/signals.toml", "--out", "read"])
        .done()
        .out;
    assert!(text.contains("peak acceleration"), "{text}");
    let peak = &place.summary("read")["quantities"]["peak_acceleration"]["value"];
    // the promise of the pulses is 3 %; here the clutch's corner comes on top
    let peak = peak.as_f64().unwrap();
    assert!((peak / 11_500.0 - 1.0).abs() < 0.1, "{peak}");
}

#[test]
fn what_does_not_fit_together_is_refused_before_anything_is_written() {
    let place = Place::new();
    tested(&place);
    let drop = scenario("reference_drop.toml");
    let short = place.path("short.toml");
    let signals = fs::read_to_string(place.path("test").join("signals.toml")).unwrap();
    let signals = signals.replace("raw.tdms", "test/raw.tdms");
    let without = |from: &str, to: &str| {
        assert!(signals.contains(from), "{from}");
        fs::write(&short, signals.replace(from, to)).unwrap();
    };
    let refused = |found: &str| {
        let called = place.call(&["identify", "identify.toml"]);
        assert_eq!(called.code, Some(2), "{called:?}");
        assert!(called.err.contains(found), "{found}: {}", called.err);
        assert!(!place.path("runs").exists());
    };
    identify(&place, "absent.toml", "");
    refused("absent.toml");
    identify(&place, &drop, "");
    refused("system = \"drop\"");
    identify(
        &place,
        "test/signals.toml",
        "tests = [\"test/signals.toml\"]",
    );
    refused("which is a coast-down too");
    identify(&place, "short.toml", "");
    without("radial_load = \"60 N\"\n", "");
    refused("signals.radial_load");
    without("ball_count = 10", "ball_count = 9");
    refused("read with 9 balls, where the bearing has 10");
    without("rig/torque", "rig/torqe");
    refused("Did you mean \"rig/torque\"");
    identify(
        &place,
        "test/signals.toml",
        "rotor_friction.rotor_speed = \"100 rad/s\"",
    );
    refused("identify.rotor_friction.file is needed with it");
    let rotor = "rotor_friction.file = \"test/signals.toml\"\nrotor_friction.rotor_speed = \"100 rad/s\"\n\
        rotor_friction.radial_load = \"60 N\"\nrotor_friction.bore_diameter = \"25 mm\"\n\
        rotor_friction.inertia = \"4e-6 kg m^2\"\nrotor_friction.from = \"0.2 s\"\nrotor_friction.to = \"0.1 s\"";
    identify(&place, "test/signals.toml", rotor);
    refused("a time behind identify.rotor_friction.from is needed");
    identify(&place, "test/signals.toml", "cage_mass_deviation = 20");
    refused("identify.cage_mass_deviation");
    identify(&place, "test/signals.toml", "settling_time = 0.5");
    refused("identify.settling_time");
}

#[test]
fn a_slow_test_that_shows_nothing_ends_with_its_reason() {
    let place = Place::new();
    tested(&place);
    identify(&place, "test/signals.toml", "");
    let called = place.call(&["identify", "identify.toml", "--out", "found"]);
    // a spin-up of 0.6 s is no coast-down: reported, kept, and no panic
    assert!(
        called.code == Some(0) || called.code == Some(1),
        "{called:?}"
    );
    assert!(place.path("found").join("summary.json").exists());
}

#[test]
fn orders_that_make_no_sense_are_refused() {
    let place = Place::new();
    let file = scenario("rig_test_3.toml");
    for (set, found) in [
        ("rig.release_at=0.1 s", "rig.engage_at"),
        ("rig.engage_at=20 s", "run.duration"),
        ("rig.clutch.torque_rate=300 N m/s", "rig.peak_acceleration"),
        (
            "rig.peak_acceleration=1e7 rad/s^2",
            "the clutch does not give",
        ),
        ("rig.pickup.kind=edges", "rig.pickup"),
        ("rig.program=coast-down", "rig.program"),
        ("rig.logger.total_rate=1e9 Hz", "rig.logger.total_rate"),
        (
            "rig.logger.format=tdms",
            "Did you mean \"rig.logger.file\"?",
        ),
        ("rig.logger.file=TDM", "Did you mean \"tdms\"?"),
        ("rig.load.radial_load=-3 N", "rig.load.radial_load"),
    ] {
        let mut words = vec!["run", &file, "--set", set, "--out", "none"];
        if set == "rig.pickup.kind=edges" {
            words.extend(["--set", "rig.logger.file=csv"]);
        }
        let called = place.call(&words);
        assert_eq!(called.code, Some(2), "{set}: {called:?}");
        assert!(called.err.contains(found), "{set}: {}", called.err);
        assert!(place.names().is_empty(), "{set}");
    }
}
