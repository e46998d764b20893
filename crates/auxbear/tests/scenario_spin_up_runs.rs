//! The shipped spin-ups say what they are shipped for.

use auxbear::scenario::{BuiltIn, Scenario};
use auxbear::simulate::outcome::Value;
use auxbear::simulate::{Options, Outcome, run};
use std::path::Path;
use std::sync::atomic::AtomicBool;

fn outcome(name: &str) -> Outcome {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let scenario = Scenario::read(&path.join(name), &[], &BuiltIn).expect("it is shipped");
    let interrupt = AtomicBool::new(false);
    let options = Options::unwatched(&interrupt);
    let outcome = run(&scenario, &options).expect("it builds");
    assert!(outcome.stop.complete(), "{:?}", outcome.stop);
    // the bound of every shipped scenario
    assert!(number(&outcome, "energy_residual").abs() < 1e-6);
    outcome
}

fn value<'a>(outcome: &'a Outcome, name: &str) -> &'a Value {
    let quantity = outcome.quantities.iter().find(|q| q.name == name);
    &quantity.unwrap_or_else(|| panic!("no {name}")).value
}

fn number(outcome: &Outcome, name: &str) -> f64 {
    match value(outcome, name) {
        Value::Number(number) => *number,
        other => panic!("{name}: {other:?}"),
    }
}

fn near(name: &str, ours: f64, wanted: f64, tolerance: f64) {
    let off = (ours - wanted).abs();
    assert!(
        off <= tolerance * wanted.abs(),
        "{name}: {ours}, not {wanted}"
    );
}

#[test]
fn a_step_shows_the_printed_formula_making_a_negative_loss() {
    let outcome = outcome("spin_up_step.toml");
    let truth = number(&outcome, "bearing_dissipated_energy");
    // issue 3: the exact form meets the true dissipation to 2e-3 in a skidding spin-up, the printed one does not
    near(
        "exact",
        number(&outcome, "outer_race_energy_exact"),
        truth,
        2e-3,
    );
    assert!(number(&outcome, "outer_race_energy_printed") < 0.0);
    assert!(number(&outcome, "outer_race_energy_corrected") < 0.5 * truth);
    // the balls are spun up almost wholly after the race, and by 10 ms they roll: the path term is at its upper bound
    let most = number(&outcome, "path_term_if_spun_up_after");
    near("path term", number(&outcome, "path_term"), most, 0.01);
    assert_eq!(
        value(&outcome, "balls_skid"),
        &Value::Text("while the race speeds up".to_string())
    );
    // while the balls skid the outer race is pushed against the rotation
    let column = |name: &str| {
        let column = outcome.history.iter().find(|column| column.name == name);
        column.map(|column| column.values.clone()).unwrap()
    };
    let moments = column("bearing.outer_race.moment");
    let skidding = column("time")
        .iter()
        .zip(&moments)
        .filter(|row| *row.0 > 0.2e-3 && *row.0 < 3e-3)
        .map(|row| *row.1)
        .collect::<Vec<f64>>();
    assert!(skidding.iter().all(|moment| *moment < 0.0), "{skidding:?}");
    // once they roll both races feel the moment of the law, ripple of a single instant included
    let law = number(&outcome, "law_moment_at_end");
    near(
        "t_I",
        number(&outcome, "inner_race_moment_at_end"),
        law,
        0.02,
    );
    near(
        "t_O",
        number(&outcome, "outer_race_moment_at_end"),
        law,
        0.02,
    );
}

#[test]
fn balls_that_roll_meet_the_closed_forms() {
    let outcome = outcome("spin_up_rolling.toml");
    // constant acceleration: 0.95 · 150 rad/s / 7200 rad/s²; the instant is found to rounding
    let time = number(&outcome, "inner_race_time_to_95_percent");
    near("time", time, 0.95 * 150.0 / 7200.0, 1e-9);
    let truth = number(&outcome, "bearing_dissipated_energy");
    // both are exact for balls that roll; the integration at the default tolerance leaves 3e-6
    near(
        "exact",
        number(&outcome, "outer_race_energy_exact"),
        truth,
        1e-5,
    );
    near(
        "corrected",
        number(&outcome, "outer_race_energy_corrected"),
        truth,
        1e-5,
    );
    let path = number(&outcome, "path_term");
    near("path", path, number(&outcome, "path_term_if_rolling"), 1e-5);
    // 1 + 2s = 1.43 for a 6005: the printed form counts what the drive pays against friction that much too high
    assert!(number(&outcome, "outer_race_energy_printed") > 1.3 * truth);
}

#[test]
fn lightly_loaded_balls_skid_and_say_so() {
    let outcome = outcome("spin_up_6005.toml");
    assert!(number(&outcome, "traction_capacity") < 1.2);
    assert!(number(&outcome, "cage_slip_at_end") > 0.1);
    assert!(
        outcome
            .warnings
            .iter()
            .any(|warning| warning.code == "AB1017")
    );
    let truth = number(&outcome, "bearing_dissipated_energy");
    near(
        "exact",
        number(&outcome, "outer_race_energy_exact"),
        truth,
        2e-3,
    );
}
