//! What acts on a flexible rotor before and after its release: seals, and supports that stay.

use crate::machine::{STIFF, number, ran};
use auxbear::outcome::{Outcome, Value};
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::sync::atomic::AtomicBool;

/// A seal at mid-span of the shipped expander.
fn sealed(cross: &str) -> Outcome {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../scenarios/machine_expander.toml"
    );
    let text = std::fs::read_to_string(path).unwrap();
    let seal = format!(
        "\n[[rotor.seal]]\nname = \"labyrinth\"\nat = \"0.2 m\"\nstiffness = \"2e5 N/m\"\nstiffness_xy = \"{cross}\"\ndamping = \"300 N s/m\"\n"
    );
    let sets = ["run.duration=60 ms".to_string()];
    let scenario = Scenario::parse(&(text + &seal), "sealed.toml", &sets, &BuiltIn).unwrap();
    let never = AtomicBool::new(false);
    run(&scenario, &Options::unwatched(&never)).unwrap()
}

#[test]
fn a_seal_acts_on_after_the_release_and_the_ledger_closes() {
    let value = |outcome: &Outcome, name: &str| {
        let quantity = outcome.quantity(name).unwrap();
        match quantity.value {
            Value::Number(value) => value,
            ref other => panic!("{name}: {other:?}"),
        }
    };
    let [plain, coupled] = ["0 N/m", "4e5 N/m"].map(sealed);
    for outcome in [&plain, &coupled] {
        assert!(outcome.stop.complete(), "{:?}", outcome.stop);
        assert!(value(outcome, "energy_residual").abs() < 1e-6);
        assert!(value(outcome, "angular_momentum_residual").abs() < 1e-6);
        let damped = outcome
            .history
            .iter()
            .find(|c| c.name == "energy.heat.seal_damping");
        assert!(*damped.unwrap().values.last().unwrap() > 0.0);
    }
    let force = |outcome: &_| value(outcome, "wheel_end.peak_contact_force");
    assert_ne!(force(&plain), force(&coupled));
}

/// The rotor of [`STIFF`] whose right support stays.
fn half_released(speed: &str, unbalance: &str, sets: &[&str]) -> Outcome {
    let right = "at = \"0.25 m\"\nstiffness";
    let text = STIFF
        .replace(
            right,
            "at = \"0.25 m\"\nafter_release = \"stays\"\nstiffness",
        )
        .replace("40 g mm", unbalance)
        .replace("9000 rpm", speed);
    ran(&text, sets)
}

#[test]
fn a_support_that_stays_goes_on_carrying_its_share() {
    let sets = ["run.duration=0.1 ms", "run.output_interval=10 us"];
    let run = half_released("10 rpm", "0 g mm", &sets);
    let column = |name: &str| {
        let found = run.history.iter().find(|column| column.name == name);
        let names = run.history.iter().map(|column| column.name.as_str());
        &found
            .unwrap_or_else(|| panic!("{:?}", names.collect::<Vec<_>>()))
            .values
    };
    let [left, right] =
        ["a.rotor.y", "b.rotor.y"].map(|name| *column(name).last().unwrap() - column(name)[0]);
    // half of the weight is carried on: the middle falls with g/2, and the rotor tips about it; the shaft is a rod of 38 g
    let shaft = 100.0 * 0.3 * std::f64::consts::PI * 0.02 * 0.02;
    let fall = 0.5 * 9.80665;
    let inertia = 0.02 + shaft * (0.3 * 0.3 / 12.0 + 0.02 * 0.02 / 4.0);
    let tip = (8.0 + shaft) * fall * 0.1 * 0.1 / inertia;
    for (found, acceleration) in [(left, fall + tip), (right, fall - tip)] {
        let exact = -0.5 * acceleration * 0.1e-3_f64.powi(2);
        // the damping of the support takes 2 % by then
        assert!((found / exact - 1.0).abs() < 0.04, "{found} {exact}");
    }
}

#[test]
fn energy_closes_with_a_support_that_stays() {
    let run = half_released("9000 rpm", "40 g mm", &["run.duration=40 ms"]);
    assert!(number(&run, "energy_residual").abs() < 1e-6);
    assert!(number(&run, "angular_momentum_residual").abs() < 1e-6);
}

/// Supports that all stay: the rotor runs up on them through √(2k/m) = 499 rad/s, less what it bends, or hangs there where its drive is weak. A whirl at
/// the critical speed has A = e/(2ζ) = 2.5 mm there and takes 2cωA² = 0.6 N m.
#[test]
fn a_weak_drive_hangs_at_a_critical_speed_and_a_strong_one_runs_through() {
    let text = STIFF
        .replace(
            "m\"\nstiffness = \"1e6",
            "m\"\nafter_release = \"stays\"\nstiffness = \"1e6",
        )
        .replace("damping = \"1000 N s/m\"", "damping = \"100 N s/m\"")
        .replace("40 g mm", "1000 g mm")
        .replace("0.25 mm", "6 mm")
        .replace("2e4 GPa", "200 GPa");
    let reached = |torque: f64, seconds: f64| {
        let sets = [
            "rotor.speed=460 rad/s".to_string(),
            "run.accuracy=screening".to_string(),
            // what linearly implicit steps lose in a second of whirl is above the bound below
            "run.method=explicit".to_string(),
            format!("rotor.drive_torque={torque} N m"),
            format!("run.duration={seconds} s"),
        ];
        let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
        let run = ran(&text, &sets);
        assert_eq!(number(&run, "a.contact_count"), 0.0);
        assert!(number(&run, "energy_residual").abs() < 1e-6);
        number(&run, "rotor_final_speed")
    };
    // without the whirl 0.5 N m give 48 rad/s² and would be at 537 rad/s
    let hangs = reached(0.5, 1.6);
    assert!(hangs > 480.0 && hangs < 497.0, "{hangs}");
    let through = reached(3.0, 0.5);
    assert!(through > 580.0, "{through}");
}
