//! States with their derivatives.

use crate::drops;
use serde_json::{Value, json};
use validate::reference::{self, DerivativePoint};
use validate::simulator::DerivativeAnswer;
use validate::{Row, Simulator, Verdict};

/// Answers with the reference itself, changed.
struct Echo<F>(F);

impl<F: Fn(&mut DerivativeAnswer)> Simulator for Echo<F> {
    fn derivative(&self, point: &DerivativePoint) -> Result<DerivativeAnswer, String> {
        let mut answer = DerivativeAnswer {
            rates: point.dy.clone(),
            per_ball: point.per_ball.clone(),
            globals: point.globals.clone(),
            kinetic: point.kinetic,
            potential: point.potential,
        };
        self.0(&mut answer);
        Ok(answer)
    }
}

/// A state of a machine with so many balls.
fn file(balls: usize) -> Value {
    let mut params = drops::file()["params"].clone();
    params["N"] = balls.into();
    let accounts: Vec<_> = (0..12).map(|k| format!("account {k}")).collect();
    let states = 18 + 5 * balls + accounts.len();
    let rates: Vec<f64> = (1..=states).map(|state| state as f64).collect();
    json!({
        "points": [{"params": params, "y": vec![0.0; states], "dy": rates,
                    "per_ball": vec![[5.0, 0.0]; balls],
                    "globals": [2.0, 0.0], "kinetic": 3.0, "potential": 0.5}],
        "per_ball_cols": ["Q_i", "u_i"],
        "global_cols": ["force_x", "force_y"],
        "quadratures": accounts
    })
}

fn rows(file: &Value, change: impl Fn(&mut DerivativeAnswer)) -> Vec<Row> {
    reference::rows(file, &Echo(change)).expect("states")
}

fn failures(file: &Value, change: impl Fn(&mut DerivativeAnswer)) -> Vec<String> {
    let failed = rows(file, change).into_iter();
    let failed = failed.filter(|row| row.verdict == Verdict::Fail);
    failed.map(|row| row.quantity).collect()
}

#[test]
fn the_reference_itself_passes_and_every_change_is_seen() {
    let file = file(1);
    let failures = |change: fn(&mut DerivativeAnswer)| failures(&file, change);
    assert!(failures(|_| ()).is_empty());
    assert_eq!(
        failures(|a| a.rates[3] *= 1.0 + 2e-9),
        ["rate_of_velocities"]
    );
    assert_eq!(failures(|a| a.rates[22] += 1e-6), ["rate_of_ball_spin"]);
    assert_eq!(
        failures(|a| a.rates[23] = f64::NAN),
        ["power_of_energy_accounts"]
    );
    assert_eq!(failures(|a| a.per_ball[0][1] = 1e-12), ["ball u_i"]);
    assert_eq!(failures(|a| a.globals[1] = 1e-11), ["force_y"]);
    assert!(failures(|a| a.globals[1] = 1e-12).is_empty());
    assert_eq!(failures(|a| a.kinetic += 1e-8), ["kinetic_energy"]);
}
#[test]
fn files_of_another_shape_are_refused() {
    let mut short = file(1);
    short["points"][0]["dy"] = json!([1.0]);
    let mut crowded = file(1);
    crowded["points"][0]["params"]["N"] = json!(u64::MAX);
    for (file, left) in [(short, 24), (crowded, 24), (file(1), 3)] {
        let rows = rows(&file, |answer| answer.rates.truncate(left));
        assert!(rows.len() == 1 && rows[0].damaged, "{rows:?}");
    }
}

#[test]
fn every_state_has_its_class() {
    let file = file(2);
    let class = |state: usize| failures(&file, |answer| answer.rates[state] *= 2.0);
    let names: Vec<_> = (0..18 + 10 + 12).map(class).collect();
    assert!(names.iter().all(|names| names.len() == 1), "{names:?}");
    assert_eq!(names[..6], names[6..12]);
    assert_eq!(names[..4], names[12..16]);
    assert_eq!(names[4..6], names[16..18]);
    assert_eq!(names[18..23], names[23..28]);
    assert!(
        names[28..]
            .iter()
            .all(|name| *name == ["power_of_energy_accounts"])
    );
}
#[test]
fn the_criterion_is_that_of_the_files() {
    let verdict = |reference: f64, ours: f64, largest: f64| {
        let mut file = file(1);
        file["points"][0]["globals"] = json!([largest, reference]);
        let rows = rows(&file, |answer| answer.globals[1] = ours);
        let row = rows.iter().find(|row| row.quantity == "force_y");
        row.unwrap().verdict
    };
    assert_eq!(verdict(1.0, 1.0 + 0.9e-9, 1.0), Verdict::Pass);
    assert_eq!(verdict(1.0, 1.0 + 1.1e-9, 1.0), Verdict::Fail);
    assert_eq!(verdict(1e-9, 2e-9, 1e3), Verdict::Pass);
    assert_eq!(verdict(0.0, 1.1e-9, 1e3), Verdict::Fail);
    assert_eq!(verdict(0.0, 0.0, 0.0), Verdict::Pass);
}
