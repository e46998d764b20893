//! The cage of a 6010 stepped to speed, beside the multibody package EXUDYN.
//!
//! The numbers are what `validation/exudyn/cage_spin_up.py` printed with version 1.13.6; the package is not needed here.

use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

const SHARES: [f64; 4] = [0.25, 0.5, 0.75, 0.95];

fn place(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}

struct SpinUp {
    /// Instants at which the cage passes the shares of its kinematic speed, ms.
    passed: [f64; 4],
    /// Speed at the end over the kinematic one.
    end: f64,
}

/// The package's answer for one contact exponent, at step zero: its instants are late in proportion to the step, so what
/// the last halving changed is subtracted once more.
fn theirs(all: &Value, exponent: &str) -> SpinUp {
    let number = |step: &str, pointer: &str| {
        let run = &all[format!("exponent {exponent}, step {step} us")];
        run.pointer(pointer)
            .and_then(Value::as_f64)
            .expect("printed")
    };
    SpinUp {
        passed: SHARES.map(|share| {
            let pointer = format!("/passed_ms/{share}");
            2.0 * number("0.25", &pointer) - number("0.5", &pointer)
        }),
        end: number("0.25", "/end_over_kinematic"),
    }
}

fn ours(kinematic: f64) -> SpinUp {
    let scenario = Scenario::read(&place("scenarios/spin_up_6010.toml"), &[], &BuiltIn);
    let interrupt = AtomicBool::new(false);
    let outcome = run(
        &scenario.expect("it is shipped"),
        &Options::unwatched(&interrupt),
    );
    let outcome = outcome.expect("it builds");
    let column = |name: &str| {
        let column = outcome.history.iter().find(|column| column.name == name);
        &column.expect("in every spin-up").values
    };
    let (times, speeds) = (column("time"), column("bearing.cage.speed"));
    SpinUp {
        passed: SHARES.map(|share| {
            let level = share * kinematic;
            let after = speeds.iter().position(|&speed| speed >= level);
            let after = after.expect("it gets there");
            let part = (level - speeds[after - 1]) / (speeds[after] - speeds[after - 1]);
            1e3 * (times[after - 1] + part * (times[after] - times[after - 1]))
        }),
        end: speeds[speeds.len() - 1] / kinematic,
    }
}

#[test]
fn the_cage_follows_as_in_another_code() {
    let text = std::fs::read_to_string(place("validation/exudyn/cage_spin_up_1.13.6.json"));
    let all: Value = serde_json::from_str(&text.expect("it is shipped")).expect("JSON");
    let kinematic = all["kinematic_cage_speed_rad_s"].as_f64().expect("printed");
    let ours = ours(kinematic);
    for exponent in ["1.0", "1.5"] {
        let theirs = theirs(&all, exponent);
        for (ours, theirs) in ours.passed.iter().zip(theirs.passed) {
            // their cage trails the balls by (cage inertia / (14 R² · 1000 N s/m)) = 0.67 µs, ours hardly does
            assert!(
                (ours - theirs).abs() < 0.7e-3,
                "{ours} ms, not {theirs} ms with exponent {exponent}"
            );
        }
        // arms of squeezed contacts end at another depth: half of 17.46 µm at either race over 32.5 mm is 5.4e-4
        assert!((ours.end - theirs.end).abs() < 5.4e-4, "{}", ours.end);
    }
    // and both follow the closed form: balls rolling on the outer groove, driven by full slip at the inner one,
    // a = 2 μ Q / (1.4 m + I_c / (N R²)); the centrifugal force takes up to 1.5 % off Q, so a percent
    let driven = 2.0 * 0.2 * 87.3;
    let inertia = 1.4 * 2.750028e-3 + 9.892418e-6 / (14.0 * 32.5e-3 * 32.5e-3);
    let half = 1e3 * 0.5 * kinematic * 32.5e-3 * inertia / driven;
    let ratio = (ours.passed[2] - ours.passed[0]) / half;
    assert!((0.998..1.01).contains(&ratio), "{ratio}");
}
