//! Case files.

use crate::shipped_text;
use validate::case::rows;
use validate::{LawsOnly, Verdict};

const GOOD: &str = r#"
format = "auxbear.case/1"
kind = "bearing_kinematics"
[source]
citation = "closed form"
[inputs]
ball_count = 10
ball_diameter = "6 mm"
pitch_diameter = "36 mm"
[[results]]
quantity = "cage"
value = 0.41666667
tolerance = 1e-7
reason = "eight digits"
"#;

fn verdict_and_why(text: &str) -> (Verdict, String) {
    let rows = rows(text, &LawsOnly);
    assert_eq!(rows.len(), 1);
    (rows[0].verdict, rows[0].why.clone())
}

#[test]
fn a_good_case_passes_and_a_wrong_number_fails() {
    assert_eq!(
        verdict_and_why(GOOD),
        (Verdict::Pass, "eight digits".into())
    );
    assert_eq!(
        verdict_and_why(&GOOD.replace("0.41666667", "0.4166")).0,
        Verdict::Fail
    );
}
#[test]
fn what_cannot_be_compared_fails_with_its_reason() {
    for (from, to, why) in [
        ("ball_count = 10", "", "inputs.ball_count is missing"),
        (
            "ball_count = 10",
            "ball_count = 2.5",
            "a whole number from 1",
        ),
        (
            "ball_count = 10",
            "ball_count = 10\nballs = 3",
            "inputs.balls: unknown",
        ),
        ("\"6 mm\"", "6", "a quantity with a unit"),
        ("\"6 mm\"", "\"6 kg\"", "a quantity in m is needed"),
        (
            "quantity = \"cage\"",
            "quantity = \"cages\"",
            "quantity \"cages\" is not known",
        ),
        ("tolerance = 1e-7", "", "tolerance"),
        ("citation = \"closed form\"", "", "citation"),
        (
            "tolerance = 1e-7",
            "tolerance = \"1 mm\"",
            "tolerance of cage",
        ),
    ] {
        let (verdict, reason) = verdict_and_why(&GOOD.replace(from, to));
        assert_eq!(verdict, Verdict::Fail, "{to}");
        assert!(reason.contains(why), "{to}: {reason}");
    }
}
#[test]
fn an_unknown_kind_is_not_run() {
    let (verdict, why) = verdict_and_why(&GOOD.replace("bearing_kinematics", "gear_noise"));
    assert_eq!(verdict, Verdict::NotRun);
    assert!(why.contains("gear_noise") && why.contains("hertz_point_contact"));
}
#[test]
fn rows_keep_the_unit_of_the_source() {
    let text = GOOD
        .replace("bearing_kinematics", "free_fall")
        .replace(
            "ball_count = 10\nball_diameter = \"6 mm\"\npitch_diameter = \"36 mm\"",
            "clearance = \"0.25 mm\"\ngravity = \"9.81 m/s^2\"",
        )
        .replace("\"cage\"", "\"closed_form_time\"")
        .replace("0.41666667", "\"7.13921 ms\"")
        .replace("tolerance = 1e-7", "tolerance = \"0.2 us\"");
    let rows = rows(&text, &LawsOnly);
    assert_eq!(rows[0].verdict, Verdict::Pass, "{rows:?}");
    assert_eq!(rows[0].unit, "ms");
    assert!((rows[0].ours.unwrap() - 7.13921).abs() < 1e-5);
    assert!((rows[0].tolerance.unwrap() - 0.2e-3 / 7.13921).abs() < 1e-9);
}

fn film() -> String {
    shipped_text("film_209_inner")
}

#[test]
fn a_film_in_other_units_of_length_force_and_time_is_the_same() {
    // lengths twice, forces 8 times, times three times as large: the dimensionless groups do not change
    let scaled = film()
        .replace("12.7 mm", "25.4 mm")
        .replace("6.604 mm", "13.208 mm")
        .replace("64.9985 mm", "129.997 mm")
        .replace("0.06490377 um", "0.12980754 um")
        .replace("4944.444444444444 N", "39555.555555555555 N")
        .replace("200 GPa", "400 GPa")
        .replace("400 rad/s", "133.33333333333333 rad/s")
        .replace("0.04 Pa s", "0.24 Pa s")
        .replace("2.3e-8 1/Pa", "1.15e-8 1/Pa")
        .replace("6.251705812 m/s", "4.167803875 m/s")
        .replace("0.552660091 um", "1.105320182 um")
        .replace("0.690356389 um", "1.380712778 um");
    for text in [film(), scaled] {
        let rows = rows(&text, &LawsOnly);
        assert_eq!(rows.len(), 8);
        assert!(
            rows.iter().all(|row| row.verdict == Verdict::Pass),
            "{rows:?}"
        );
    }
}
#[test]
fn a_speed_is_given_once() {
    let both = film().replace("race_speed", "entrainment = \"6 m/s\"\nrace_speed");
    let rows = rows(&both, &LawsOnly);
    assert!(
        rows.iter().all(|row| row.verdict == Verdict::Fail),
        "{rows:?}"
    );
}
