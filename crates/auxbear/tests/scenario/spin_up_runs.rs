//! The shipped spin-ups say what they are shipped for.

use crate::outcomes::number;
use auxbear::outcome::Value;
use auxbear::run::{Options, Outcome, run};
use auxbear::scenario::{BuiltIn, Scenario};
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
    let quantity = outcome.quantity(name);
    &quantity.unwrap_or_else(|| panic!("no {name}")).value
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

#[test]
fn a_rested_grease_starts_low_meets_the_law_and_falls_below_it() {
    let outcome = outcome("grease_spin_up.toml");
    let column = |name: &str| {
        let column = outcome.history.iter().find(|column| column.name == name);
        let column = column.unwrap_or_else(|| panic!("no {name}"));
        column.values.clone()
    };
    let (time, torque) = (column("time"), column("bearing.outer_race.moment"));
    let drag = column("bearing.lubricant.drag_factor");
    // the law: its parts are known from the drag factor at the end, M = D M0 + M1, M1 = 0.0007 (200/6550)^0.5·200·0.036
    let (last, m1) = (time.len() - 1, 0.8807e-3);
    let law = (torque[last] - m1) / drag[last] + m1;
    // 1e-7·2·46656·(143 239)^(2/3) N mm = 25.546 N mm, as by hand for Palmgren's law
    near("law", law, 25.546e-3 + m1, 1e-3);
    let at = |instant: f64| {
        let row = time.iter().position(|time| *time >= instant).unwrap();
        torque[row] / law
    };
    // the ramp has ended at 40 ms, with a fifth of a cage turn
    assert!(at(0.045) < 0.55, "{}", at(0.045));
    let met =
        (torque.iter().zip(&time)).find(|(torque, time)| **time > 0.04 && **torque > 0.95 * law);
    let met = *met.unwrap().1;
    assert!((0.2..0.3).contains(&met), "{met}");
    assert!(torque.iter().all(|torque| *torque < law));
    assert!((0.78..0.83).contains(&at(3.5)), "{}", at(3.5));
    near(
        "drag at the end",
        number(&outcome, "lubricant_drag_factor_at_end"),
        drag[last],
        1e-12,
    );
    let built = column("bearing.lubricant.build_up");
    let worked = column("bearing.lubricant.breakdown");
    for (built, worked) in built.iter().zip(&worked) {
        assert!((0.0..=1.0).contains(built) && (0.0..=1.0).contains(worked));
    }
    // films do not warm in this run
    let films = "bearing.lubricant.film_temperature_rise";
    assert!(outcome.history.iter().all(|column| column.name != films));
}

#[test]
fn without_a_lubricant_state_there_is_no_trace_of_one() {
    let outcome = outcome("spin_up_rolling.toml");
    let slow = |name: &str| name.contains("lubricant.") || name.starts_with("lubricant_");
    assert!(outcome.history.iter().all(|column| !slow(&column.name)));
    assert!(
        outcome
            .quantities
            .iter()
            .all(|quantity| !slow(&quantity.name))
    );
}
