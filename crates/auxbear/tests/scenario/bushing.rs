//! An auxiliary bearing that is a plain bushing.

use super::several::{HEAD, outcome, read};
use auxbear::outcome::Value;

/// Of one bearing, then of two of which the second is a ball bearing.
const ALONE: &str = r#"
[bearing]
type = "bushing"
"#;
const BESIDE_BALLS: &str = r#"
[[auxiliary_bearing]]
name = "ring"
[auxiliary_bearing.bearing]
type = "bushing"

[[auxiliary_bearing]]
name = "balls"
[auxiliary_bearing.bearing]
name = "6005"
operating_diametral_clearance = "-4 um"
"#;

/// A file without its ball bearing.
fn with(bearings: &str) -> String {
    let (before, rest) = HEAD.split_once("[bearing]").expect("it has a bearing");
    let (_, run) = rest.split_once("[run]").expect("it has a run");
    format!("{before}[run]{run}{bearings}")
}

#[test]
fn it_runs_alone_repeated_and_beside_a_ball_bearing() {
    let number = |outcome: &auxbear::run::Outcome, name: &str| {
        let found = outcome.quantity(name);
        match found.map(|q| &q.value) {
            Some(Value::Number(value)) => Some(*value),
            _ => None,
        }
    };
    for (text, of_ring, of_balls) in [
        (with(ALONE), "", None),
        (with(BESIDE_BALLS), "ring.", Some("balls.")),
    ] {
        let outcome = outcome(&text, &[]);
        let residual = number(&outcome, "energy_residual").expect("a residual");
        assert!(residual.abs() < 1e-6, "{residual}");
        let ring = |name: &str| number(&outcome, &format!("{of_ring}{name}"));
        assert!(ring("peak_contact_force").is_some_and(|force| force > 100.0));
        assert!(ring("rotor_race_friction_energy").is_some_and(|heat| heat > 0.0));
        for name in [
            "peak_ball_load",
            "cage_final_speed",
            "inner_race_final_speed",
        ] {
            assert_eq!(ring(name), None, "{name} of a bushing");
        }
        if let Some(balls) = of_balls {
            let load = number(&outcome, &format!("{balls}peak_ball_load"));
            assert!(load.is_some_and(|load| load > 10.0), "{load:?}");
        }
        assert!(outcome.warnings.iter().any(|w| w.code == "AB2330"));
    }
    let repeated = outcome(&with(ALONE), &["repeat.count=5"]);
    assert!(
        repeated
            .quantities
            .iter()
            .any(|q| q.name.starts_with("peak_contact_force"))
    );
}

#[test]
fn at_screening_accuracy_it_runs_too() {
    let outcome = outcome(&with(BESIDE_BALLS), &["run.accuracy=screening"]);
    assert!(
        outcome
            .quantities
            .iter()
            .any(|q| q.name == "ring.peak_contact_force")
    );
}

#[test]
fn keys_of_balls_are_refused_with_their_reason() {
    for key in [
        "name = \"6005\"",
        "ball_count = 10",
        "inner_race_mass = \"20 g\"",
    ] {
        let text = format!("{}{key}\n", with(ALONE));
        let problem = read(&text, &[]).expect_err("no balls").to_string();
        assert!(
            problem.contains("no effect") && problem.contains("mount.moving_mass"),
            "{problem}"
        );
    }
    let text = with("[bearing]\ntype = \"bush\"\n");
    let problem = read(&text, &[]).expect_err("no such word").to_string();
    assert!(problem.contains("bushing"), "{problem}");
}

#[test]
fn a_spin_up_has_none() {
    let text = r#"
format = "auxbear.scenario/1"
system = "spin_up"
[drive]
kind = "speed"
final_speed = "150 rad/s"
acceleration = "7200 rad/s^2"
radial_load = "200 N"
[bearing]
type = "bushing"
"#;
    let problem = read(text, &[]).expect_err("a bushing").to_string();
    assert!(problem.contains("does not turn"), "{problem}");
}

/// Of the file, and of each auxiliary bearing, what resolves of its type and of its fidelity.
fn types(text: &str, sets: &[&str]) -> Vec<(String, String)> {
    let scenario = read(text, sets).unwrap_or_else(|problem| panic!("{problem}"));
    let values = scenario.resolved.values.iter();
    let of = values.filter(|value| ["bearing.type", "bearing.fidelity"].contains(&value.path));
    of.filter(|value| value.text.as_deref() != Some("deep groove"))
        .map(|value| (value.shown(), value.text.clone().unwrap_or_default()))
        .collect()
}

const BALLS: &str = r#"
[[auxiliary_bearing]]
name = "balls"
[auxiliary_bearing.bearing]
name = "6005"
"#;
const RING: &str = r#"
[[auxiliary_bearing]]
name = "ring"
[auxiliary_bearing.bearing]
"#;

#[test]
fn its_earlier_spelling_resolves_to_the_one_of_now() {
    let alone = [("bearing.type".to_string(), "bushing".to_string())];
    let beside = [
        ("auxiliary_bearing.ring.bearing.type", "bushing"),
        ("auxiliary_bearing.balls.bearing.fidelity", "rolling"),
    ]
    .map(|(path, word)| (path.to_string(), word.to_string()));
    let earlier = "fidelity = \"bushing\"\n";
    let now = "type = \"bushing\"\n";
    for word in [earlier, now, "fidelity = { value = \"bushing\" }\n"] {
        assert_eq!(types(&with(&format!("[bearing]\n{word}")), &[]), alone);
        // the rolling model of all bearings says nothing of the one that is a ring
        let common = "[bearing]\nfidelity = \"rolling\"\n";
        let text = with(&format!("{common}{RING}{word}{BALLS}"));
        assert_eq!(types(&text, &[]), beside);
    }
    // a ring for all, and balls for one
    let own = "fidelity = \"rolling\"\n";
    let text = with(&format!("[bearing]\n{earlier}{RING}{BALLS}{own}"));
    assert_eq!(types(&text, &[]), beside);
    let own = "type = \"deep groove\"\nfidelity = \"rolling\"\n";
    let text = with(&format!("[bearing]\n{now}{RING}{BALLS}{own}"));
    assert_eq!(types(&text, &[]), beside);
    for set in ["bearing.type=bushing", "bearing.fidelity=bushing"] {
        assert_eq!(types(&with("[bearing]\n"), &[set]), alone);
        let of_ring = format!("auxiliary_bearing.ring.{set}");
        let text = with(&format!("{RING}{BALLS}{own}"));
        assert_eq!(types(&text, &[&of_ring]), beside);
    }
    let resolved = |word: &str| {
        let text = with(&format!("[bearing]\n{word}"));
        read(&text, &[]).expect("a ring").resolved.toml()
    };
    assert_eq!(resolved(earlier), resolved(now));
    let again = read(&resolved(now), &[]).expect("a resolved file");
    assert_eq!(again.resolved.toml(), resolved(now));
}

#[test]
fn both_spellings_may_agree_and_must_not_contradict() {
    let both = |kind: &str| {
        with(&format!(
            "[bearing]\ntype = \"{kind}\"\nfidelity = \"bushing\"\n"
        ))
    };
    assert!(read(&both("bushing"), &[]).is_ok());
    let problem = read(&both("deep groove"), &[]).expect_err("two types");
    let line = both("").lines().position(|line| line.starts_with("fid"));
    let at = format!(":{}: bearing.fidelity: found", line.expect("a line") + 1);
    let told = problem.to_string();
    assert!(told.contains(&at), "{told}");
    assert!(
        told.contains("\"bushing\" beside bearing.type = \"deep groove\""),
        "{told}"
    );
    // how balls are modelled has no effect on a ring
    let text = with("[bearing]\ntype = \"bushing\"\nfidelity = \"rolling\"\n");
    let told = read(&text, &[]).expect_err("no balls").to_string();
    assert!(
        told.contains("bearing.fidelity: found a key that has no effect"),
        "{told}"
    );
    assert!(told.contains("here it is \"bushing\""), "{told}");
}
