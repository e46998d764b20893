//! Each Hertz pressure is compared with the limit of what touches there, and results and warnings agree.

use crate::outcomes::number;
use auxbear::run::{Options, Outcome, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// The shipped drop onto a full complement of ceramic balls, to behind its first impact.
fn dropped(sets: &[&str]) -> (Scenario, Outcome) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let mut all = vec!["run.duration=14 ms".to_string()];
    all.extend(sets.iter().map(|set| set.to_string()));
    let path = path.join("full_complement_drop.toml");
    let scenario = Scenario::read(&path, &all, &BuiltIn).expect("it is shipped");
    let interrupt = AtomicBool::new(false);
    let outcome = run(&scenario, &Options::unwatched(&interrupt)).expect("it builds");
    (scenario, outcome)
}

fn warned<'a>(outcome: &'a Outcome, code: &str) -> Option<&'a str> {
    let warning = outcome.warnings.iter().find(|warning| warning.code == code);
    warning.map(|warning| warning.text.as_str())
}

#[test]
fn ceramic_balls_that_meet_crack_by_a_limit_of_their_own() {
    let (scenario, outcome) = dropped(&[]);
    for path in [
        "bearing.hertz_pressure_limit",
        "bearing.full_complement.hertz_pressure_limit",
    ] {
        let value = scenario.resolved.get(path).expect("it has a default");
        assert_eq!(value.provenance.mark(), "assumed", "{path}");
    }
    let races = number(&outcome, "peak_hertz_pressure");
    let neighbours = number(&outcome, "peak_ball_ball_pressure");
    let share = number(&outcome, "hertz_pressure_share_of_limit");
    // 3 700 MPa/(1 - 2 0.26) = 4375 MPa, rounded
    let limit: f64 = 4.4e9;
    assert!((limit / (3.0 * 700e6 / (1.0 - 2.0 * 0.26)) - 1.0).abs() < 0.01);
    assert_eq!(share, (races / 4.2e9).max(neighbours / limit));
    assert!(neighbours > limit && races < 4.2e9, "{neighbours} {races}");
    assert!(warned(&outcome, "AB1002").is_none(), "no race dents");
    let text = warned(&outcome, "AB1070").expect("balls crack");
    let tension = (1.0 - 2.0 * 0.26) * neighbours / 3.0;
    for shown in [neighbours, limit, tension] {
        assert!(text.contains(&format!("{:.0} MPa", shown * 1e-6)), "{text}");
    }
    assert!(text.contains("crack in rings") && !text.contains("dents"));
    // of a strength that is known nothing is said
    let strong = "bearing.full_complement.hertz_pressure_limit=20 GPa";
    let (_, outcome) = dropped(&[strong]);
    assert!(warned(&outcome, "AB1070").is_none());
    let share = number(&outcome, "hertz_pressure_share_of_limit");
    assert_eq!(share, races / 4.2e9);
}

#[test]
fn steel_balls_that_meet_dent() {
    let (_, outcome) = dropped(&[
        "bearing.ball_material=steel",
        "bearing.full_complement.hertz_pressure_limit=1000 MPa",
        "bearing.hertz_pressure_limit=20 GPa",
    ]);
    let text = warned(&outcome, "AB1070").expect("balls dent");
    assert!(text.contains("permanent dents"), "{text}");
    assert!(number(&outcome, "hertz_pressure_share_of_limit") > 1.0);
}

#[test]
fn a_cage_that_no_body_has_is_reported() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/spin_up_step.toml");
    let run_with = |inertia: &str| {
        let sets = [
            "run.duration=0.2 ms".to_string(),
            "bearing.cage_mass=5 g".to_string(),
            format!("bearing.cage_inertia={inertia}"),
        ];
        let scenario = Scenario::read(&path, &sets, &BuiltIn).expect("it is shipped");
        let interrupt = AtomicBool::new(false);
        run(&scenario, &Options::unwatched(&interrupt)).expect("it builds")
    };
    // rings of 25.5 and 18 mm radius between tracks of 14.8 and 21.2 mm
    assert!(warned(&run_with("3.24e-6 kg m^2"), "AB1071").is_some());
    assert!(warned(&run_with("1.62e-6 kg m^2"), "AB1071").is_none());
}
