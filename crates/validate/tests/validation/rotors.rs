//! Rotors of files.

use serde_json::{Value, json};
use validate::{LawsOnly, Row, Verdict, reference};

/// Two masses of 1 kg on a shaft without mass, on springs that grow from 1 to 4 MN/m at 200 rad/s: both move alike at √(k/m).
fn file() -> Value {
    let mode = |frequency: f64| json!([{"re": 0.0, "im": frequency, "kind": "lateral"}]);
    let at = |speed: f64, k: f64| json!({"speed_rad_s": speed, "modes": mode(k.sqrt())});
    let disk = |n: usize| json!({"n": n, "m": 1.0, "Ip": 0.0, "Id": 0.01});
    let bearing = |n: usize| json!({"n": n, "n_link": null, "frequency": [0.0, 200.0], "kxx": [1e6, 4e6], "kyy": [1e6, 4e6]});
    json!({
        "model": {
            "node_positions_m": [0.0, 0.5],
            "shaft_elements": [{
                "n_l": 0, "L": 0.5, "idl": 0.0, "odl": 0.05, "idr": 0.0, "odr": 0.05, "rho": 1e-6,
                "E": 2e11, "nu": 0.3, "alpha": 0.0, "beta": 0.0, "axial_force": 0.0, "torque": 0.0
            }],
            "disks": [disk(0), disk(1)],
            "point_masses": [],
            "bearings": [bearing(0), bearing(1)]
        },
        "eigenvalues": [at(0.0, 1e6), at(100.0, 2.5e6), at(200.0, 4e6), at(300.0, 4e6)]
    })
}
fn rows(file: &Value) -> Vec<Row> {
    reference::rows(file, &LawsOnly).expect("a rotor")
}
fn verdicts(file: &Value) -> Vec<(Verdict, String)> {
    let rows = rows(file).into_iter();
    rows.map(|row| (row.verdict, row.why)).collect()
}

#[test]
fn coefficients_over_speed_are_read() {
    let found = verdicts(&file());
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].0, Verdict::Pass, "{}", found[0].1);
    assert!(found[0].1.starts_with("worst of 4"), "{}", found[0].1);
    let mut other = file();
    for key in ["kxx", "kyy"] {
        other["model"]["bearings"][0][key] = json!([1e6, 4.1e6]);
    }
    assert_eq!(verdicts(&other)[0].0, Verdict::Fail);
    other["model"]["bearings"][0]["kxx"] = json!([1e6, 4e6, 9e6]);
    let wrong = rows(&other).remove(0);
    assert!(
        wrong.damaged && wrong.why.contains("3 values of kxx at 2 speeds"),
        "{}",
        wrong.why
    );
}
#[test]
fn a_null_leaves_out_its_own_row_alone() {
    let mut file = file();
    file["eigenvalues"][1]["modes"][0]["re"] = Value::Null;
    file["critical_speeds"] = json!({"rad_s": [null, 2000.0]});
    let found = verdicts(&file);
    let count = |verdict| found.iter().filter(|row| row.0 == verdict).count();
    assert_eq!(
        (count(Verdict::Pass), count(Verdict::NotRun)),
        // the critical speed beside the null is compared
        (2, 2),
        "{found:?}"
    );
    assert!(found[0].1.starts_with("worst of 3"), "{found:?}");
}
#[test]
fn what_is_not_modelled_is_not_compared_as_if_it_were_not_there() {
    for (key, value, word) in [
        ("torque", json!(2e3), "axial torque"),
        ("axial_force", json!(-1e4), "axial force"),
        ("gyroscopic", json!(false), "gyroscopic"),
    ] {
        let mut file = file();
        file["model"]["shaft_elements"][0][key] = value;
        let found = verdicts(&file);
        assert_eq!((found.len(), found[0].0), (1, Verdict::NotRun));
        assert!(found[0].1.contains(word), "{}", found[0].1);
    }
}
