//! `auxbear signals`.

use crate::place::Place;
use std::path::Path;

fn scenario(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
    folder.join(name).display().to_string()
}

#[test]
fn a_measurement_becomes_a_run_directory() {
    let place = Place::new();
    let file = scenario("signals_spin_up.toml");
    let text = place.call(&["signals", &file, "--out", "test"]).done().out;
    assert!(
        text.contains("peak acceleration") && text.contains("test/report.html"),
        "{text}"
    );
    assert_eq!(place.names(), ["test"]);
}

#[test]
fn another_system_is_refused() {
    let place = Place::new();
    let called = place.call(&["signals", &scenario("torque_6005.toml")]);
    assert_eq!(called.code, Some(2), "{called:?}");
    assert!(
        called.err.contains("system = \"signals\" is needed"),
        "{called:?}"
    );
    assert!(place.names().is_empty());
}
