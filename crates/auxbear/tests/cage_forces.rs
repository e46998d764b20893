//! Forces on a cage at steady speed, beside measured ones.
//!
//! Ball/cage forces up to 25 N and forces on the inner land up to 20 N were measured on a bearing of 110 mm bore at speeds up to
//! 12 000 rpm (J. Lubr. Technol. 101 (1979) 180, abstract). The abstract states neither load nor cage, so that only the
//! magnitude can be compared: a cage that is guided by the inner land of an angular contact bearing of that bore must stay
//! below, and well above nothing.

use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::sync::atomic::AtomicBool;

const FILE: &str = r#"
format = "auxbear.scenario/1"
system = "spin_up"

[drive]
kind = "speed"
final_speed = "12000 rpm"
acceleration = "6000 rad/s^2"
radial_load = "500 N"

[bearing]
name = "SNFA EX 110"
axial_preload = "1000 N"

[bearing.cage]
guidance = "inner land"
land_radial_clearance = "0.3 mm"

[run]
duration = "0.4 s"
"#;

/// The race is at speed from 0.21 s on, and the cage has settled then.
const SETTLED: f64 = 0.3;

#[test]
fn a_cage_at_steady_speed_is_pressed_less_than_was_measured() {
    let scenario = Scenario::parse(FILE, "cage.toml", &[], &BuiltIn).expect("a right file");
    let interrupt = AtomicBool::new(false);
    let outcome = run(&scenario, &Options::unwatched(&interrupt)).expect("it builds");
    let column = |name: &str| {
        let column = outcome.history.iter().find(|column| column.name == name);
        &column.expect("in this run").values
    };
    let times = column("time");
    let largest = |name: &str| {
        let rows = times.iter().zip(column(name));
        rows.filter(|(time, _)| **time > SETTLED)
            .map(|(_, force)| *force)
            .fold(0.0, f64::max)
    };
    // measured here: 3 N in the pockets, 11 N at the land
    let (pocket, land) = (
        largest("bearing.cage.largest_pocket_force"),
        largest("bearing.cage.land_force"),
    );
    assert!((0.5..25.0).contains(&pocket), "{pocket}");
    assert!((1.0..20.0).contains(&land), "{land}");
}
