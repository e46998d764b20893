//! Mounts by their dynamic stiffness: fits to tables, refusals, and the mounts of files.

use auxbear::run::mount::fit::{Fit, MeasuredStiffness};
use auxbear::run::mount::{Request, run};
use auxbear::scenario::{BuiltIn, Scenario};

/// A table of a mount whose relaxation times are whole decades, with a deviation of each row.
fn table(deviation: impl Fn(usize) -> f64) -> String {
    let mut text = "frequency [rad/s]; storage [N/mm]; loss [N/mm]\n".to_string();
    for k in 0..41 {
        let omega = 10f64.powf(1.0 + 0.1 * k as f64);
        let (mut storage, mut loss) = (3e6, 40.0 * omega);
        for (stiffness, time) in [(2e6, 1e-2), (5e6, 1e-4)] {
            let x: f64 = omega * time;
            storage += stiffness * x * x / (1.0 + x * x);
            loss += stiffness * x / (1.0 + x * x);
        }
        let factor = 1.0 + deviation(k);
        text += &format!(
            "{omega:e}; {:e}; {:e}\n",
            1e-3 * storage * factor,
            1e-3 * loss * factor
        );
    }
    text
}

#[test]
fn fit_recovers_the_branches_of_an_exact_table() {
    let measured = MeasuredStiffness::parse(&table(|_| 0.0), "o_ring.csv").unwrap();
    let fit = Fit::of(&measured);
    assert!((fit.stiffness / 3e6 - 1.0).abs() < 1e-6, "{fit:?}");
    assert!((fit.damping / 40.0 - 1.0).abs() < 1e-6, "{fit:?}");
    for (wanted, time) in [(2e6, 1e-2), (5e6, 1e-4)] {
        let own = fit
            .branches
            .iter()
            .find(|own| (1.0 / own.rate / time - 1.0).abs() < 1e-9);
        assert!(
            (own.unwrap().stiffness / wanted - 1.0).abs() < 1e-6,
            "{fit:?}"
        );
    }
    // what the table does not have is nothing beside it
    let others = fit.branches.iter().filter(|own| {
        ![1e-2, 1e-4]
            .iter()
            .any(|t| (1.0 / own.rate / t - 1.0).abs() < 1e-9)
    });
    assert!(others.map(|own| own.stiffness).sum::<f64>() < 1.0);
    assert!(fit.worst(&measured) < 1e-9);
    assert!((measured.decades() - 4.0).abs() < 1e-9);
}

/// Rows wrong by ±3 %: the fit is at least as near as that, and no part of it negative.
#[test]
fn fit_of_a_noisy_table_states_its_error() {
    let noisy = |k: usize| if k.is_multiple_of(2) { 0.03 } else { -0.03 };
    let measured = MeasuredStiffness::parse(&table(noisy), "o_ring.csv").unwrap();
    let fit = Fit::of(&measured);
    assert!(
        (0.01..0.05).contains(&fit.worst(&measured)),
        "{}",
        fit.worst(&measured)
    );
    assert!(fit.mean(&measured) < 0.031);
    assert!(
        fit.stiffness >= 0.0
            && fit.damping >= 0.0
            && fit.branches.iter().all(|own| own.stiffness > 0.0)
    );
    assert!((fit.stiffness / 3e6 - 1.0).abs() < 0.05, "{fit:?}");
}

#[test]
fn tables_that_are_none_are_refused_with_line_and_column() {
    let head = "frequency [Hz], storage [N/m], loss [N/m]\n";
    let cases = [
        (
            "frequency, storage [N/m], loss [N/m]\n1,2,3\n".to_string(),
            "1",
            "frequency",
        ),
        (
            "frequency [Hz], storage [N/m], loss [N]\n1,2,3\n".to_string(),
            "1",
            "loss",
        ),
        (
            "frequency [Hz], storage [N/m]\n1,2\n".to_string(),
            "1",
            "loss",
        ),
        (format!("{head}1,2,3\n2,5,-1\n"), "3", "loss"),
        (format!("{head}1,2,3\n1,5,1\n"), "3", "frequency"),
        (format!("{head}2,2,3\n1,5,1\n"), "3", "frequency"),
        (format!("{head}1,x,3\n"), "2", "storage"),
        (format!("{head}1,5,1\n2,0,0\n3,5,1\n"), "3", "storage"),
        (format!("{head}1,2,3\n1000,5,1\n"), "1", "frequency"),
    ];
    for (text, line, key) in cases {
        let problem = MeasuredStiffness::parse(&text, "table.csv").unwrap_err();
        let told = problem.to_string();
        assert!(
            told.contains(&format!("table.csv:{line}")) && told.contains(key),
            "{told}"
        );
        assert_eq!(problem.key.as_deref(), Some(key));
    }
}

/// One Maxwell branch has no static stiffness, which a mount of a scenario must have.
#[test]
fn a_table_without_static_stiffness_gives_no_lines() {
    let row = |k: i32| {
        let frequency = 10f64.powf(0.25 * f64::from(k));
        let x = frequency / 100.0;
        let loss = 1e6 * x / (1.0 + x * x);
        format!("{frequency:e},{:e},{loss:e}\n", x * loss)
    };
    let rows: String = (0..13).map(row).collect();
    let head = "frequency [rad/s], storage [N/m], loss [N/m]\n";
    let table = MeasuredStiffness::parse(&format!("{head}{rows}"), "table.csv").unwrap();
    let fit = Fit::of(&table);
    assert!(fit.worst(&table) < 1e-6);
    assert!(fit.stiffness > 0.0 || fit.lines().is_err());
    let soft = Fit {
        stiffness: 0.0,
        ..fit
    };
    assert!(soft.lines().unwrap_err().contains("no static stiffness"));
}

#[test]
fn mounts_of_a_machine_have_their_parts_and_sum() {
    let text = include_str!("../../../scenarios/machine_expander.toml");
    let scenario = Scenario::parse(text, "machine_expander.toml", &[], &BuiltIn).unwrap();
    let request = Request {
        amplitude: 1e-7,
        table: None,
    };
    let outcome = run(&scenario, &request).unwrap();
    // 1e7 N/m and a ring of 2e7 N/m that sticks at a hundredth of its travel
    let low = outcome.number("thrust_end.stiffness_low").unwrap();
    assert!((low / 3e7 - 1.0).abs() < 1e-6, "{low}");
    let columns: Vec<&str> = outcome
        .history
        .iter()
        .map(|own| own.name.as_str())
        .collect();
    for name in [
        "frequency",
        "wheel_end.spring_damper.loss",
        "wheel_end.ring.storage",
        "wheel_end.sum.loss_factor",
    ] {
        assert!(columns.contains(&name), "{name}");
    }
    assert!(outcome.warnings.iter().any(|own| own.code == "AB2049"));
    let torque =
        "format = \"auxbear.scenario/1\"\nsystem = \"torque\"\n[bearing]\nname = \"6005\"\n";
    let torque = Scenario::parse(torque, "t.toml", &[], &BuiltIn).unwrap();
    assert!(run(&torque, &request).is_err());
}
