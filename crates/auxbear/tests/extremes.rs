//! Machines at the ends of what a file may say: each run is finite and closes its energy, or is refused with a message.

use auxbear::outcome::Value;
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario, template};
use std::sync::atomic::AtomicBool;

/// Relative energy residual of a drop of the starting file with these changes; none where it is refused.
fn residual(sets: &[&str]) -> Option<f64> {
    let text = template("drop").expect("a drop has a starting file");
    let mut all = vec![String::from("run.duration=20 ms")];
    all.extend(sets.iter().map(|set| (*set).to_string()));
    let scenario = match Scenario::parse(&text, "drop.toml", &all, &BuiltIn) {
        Ok(scenario) => scenario,
        Err(problem) => {
            assert!(problem.to_string().contains("AB"), "{problem}");
            return None;
        }
    };
    let interrupt = AtomicBool::new(false);
    let outcome = run(&scenario, &Options::unwatched(&interrupt)).expect("it builds");
    assert!(
        ["finished", "left the model"].contains(&outcome.stop.reason),
        "{sets:?}: {:?}",
        outcome.stop
    );
    for column in &outcome.history {
        let finite = column.values.iter().all(|value| value.is_finite());
        assert!(finite, "{sets:?}: {}", column.name);
    }
    let found = outcome
        .quantities
        .iter()
        .find(|q| q.name == "energy_residual");
    match found.map(|quantity| &quantity.value) {
        Some(Value::Number(residual)) => Some(residual.abs()),
        // nothing was turned over that it could be compared with
        Some(Value::None { .. }) => Some(0.0),
        other => panic!("{sets:?}: {other:?}"),
    }
}

/// Cages and rows of balls, with what they need.
const SEPARATIONS: [&[&str]; 4] = [
    &[],
    &["bearing.cage.guidance=balls"],
    &[
        "bearing.cage.guidance=inner land",
        "bearing.cage.land_radial_clearance=0.1 mm",
    ],
    &[
        "bearing.cage.guidance=outer land",
        "bearing.cage.land_radial_clearance=0.1 mm",
    ],
];

#[test]
fn any_speed_in_either_direction_closes_its_energy() {
    for speed in [
        "0 rpm",
        "12000 rpm",
        "-12000 rpm",
        "200000 rpm",
        "-200000 rpm",
    ] {
        let speed = format!("rotor.speed={speed}");
        for separation in SEPARATIONS {
            let mut sets = vec![speed.as_str(), "rotor.unbalance_eccentricity=0 um"];
            sets.extend(separation);
            let missed = residual(&sets).expect("possible");
            // pocket impacts at ten times the usual speed ask for a tighter tolerance, which AB1006 then says
            assert!(missed < 2e-5, "{sets:?}: {missed}");
        }
    }
}

#[test]
fn any_number_of_balls_with_any_clearance_is_finite_or_refused() {
    for balls in ["3", "7", "10", "40", "60"] {
        for clearance in ["-20 um", "0 um", "0.3 mm", "3 mm"] {
            let balls = format!("bearing.ball_count={balls}");
            let clearance = format!("bearing.operating_diametral_clearance={clearance}");
            // balls small enough for the circle
            let sets = [
                balls.as_str(),
                clearance.as_str(),
                "bearing.ball_diameter=1.8 mm",
                "bearing.static_load_rating=0.5 kN",
            ];
            if let Some(missed) = residual(&sets) {
                assert!(missed < 1e-4, "{sets:?}: {missed}");
            }
        }
    }
}

#[test]
fn a_stuck_cage_and_an_unloaded_bearing_are_finite() {
    let stuck = [
        "bearing.cage.pocket_gap=0 um",
        "bearing.cage.pocket_friction_coefficient=1.0",
    ];
    let unloaded = ["gravity.acceleration=0 m/s^2"];
    for separation in SEPARATIONS {
        for change in [&stuck[..], &unloaded[..]] {
            let sets = [change, separation].concat();
            let missed = residual(&sets).expect("possible");
            assert!(missed < 1e-4, "{sets:?}: {missed}");
        }
    }
}
