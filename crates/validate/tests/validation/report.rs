//! Rows, verdicts, and the report as text and JSON.

use validate::{Report, Row, Tolerance, Verdict};

#[test]
fn the_tolerance_decides() {
    let row = |ours, tolerance| Row::compared("x", "N", 200.0, ours, tolerance, "").verdict;
    assert_eq!(row(202.0, Tolerance::Relative(0.011)), Verdict::Pass);
    assert_eq!(row(202.0, Tolerance::Relative(0.009)), Verdict::Fail);
    assert_eq!(row(198.0, Tolerance::Absolute(2.0)), Verdict::Pass);
    assert_eq!(row(197.9, Tolerance::Absolute(2.0)), Verdict::Fail);
    assert_eq!(row(f64::NAN, Tolerance::Relative(1.0)), Verdict::Fail);
    assert_eq!(row(f64::INFINITY, Tolerance::Relative(1.0)), Verdict::Fail);
}
#[test]
fn a_reference_of_zero_is_compared_absolutely() {
    let row = |ours, tolerance| Row::compared("x", "N", 0.0, ours, tolerance, "");
    assert_eq!(row(1e-3, Tolerance::Absolute(2e-3)).verdict, Verdict::Pass);
    assert_eq!(row(1e-3, Tolerance::Absolute(2e-3)).deviation, Some(1e-3));
    assert_eq!(row(1e-9, Tolerance::Relative(0.0)).verdict, Verdict::Fail);
}
#[test]
fn rows_are_sorted_and_counted() {
    let mut first = Row::compared("b", "", 1.0, 1.0, Tolerance::Relative(0.0), "");
    first.case = "two".into();
    let mut second = Row::compared("a", "", 1.0, 2.0, Tolerance::Relative(0.0), "exact");
    second.case = "two".into();
    let mut third = Row::not_run("format not known");
    third.case = "one".into();
    let report = Report::new(vec![first, second, third]);
    let order: Vec<_> = report
        .cases
        .iter()
        .map(|row| row.quantity.as_str())
        .collect();
    assert_eq!(order, ["", "a", "b"]);
    assert!(!report.passed());
    let text = report.to_text();
    assert!(text.contains("not run  (format not known)"), "{text}");
    assert!(text.ends_with("1 pass, 1 fail, 1 not run\n"), "{text}");
}
#[test]
fn json_has_the_promised_shape_and_no_nan() {
    let row = Row::compared("x", "N", 1.0, f64::NAN, Tolerance::Relative(0.0), "");
    let json = Report::new(vec![row, Row::not_run("why")]).to_json();
    let value: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert!(value["cases"][1]["ours"].is_null());
    assert_eq!(value["cases"][1]["verdict"], "fail");
    assert_eq!(value["cases"][0]["verdict"], "not run");
    let keys: Vec<_> = value["cases"][0]
        .as_object()
        .unwrap()
        .keys()
        .cloned()
        .collect();
    let mut promised = [
        "case",
        "quantity",
        "unit",
        "reference",
        "ours",
        "deviation",
        "tolerance",
        "verdict",
        "why",
    ];
    promised.sort_unstable();
    let mut keys: Vec<_> = keys.iter().map(String::as_str).collect();
    keys.sort_unstable();
    assert_eq!(keys, promised);
}
#[test]
fn numbers_print_with_seven_digits() {
    for (value, digits) in [
        (967.839, "967.839"),
        (2.518829e10, "2.518829e10"),
        (81.0, "81"),
        (100.0, "100"),
        (-0.0012345678, "-0.001234568"),
    ] {
        let row = Row::compared("x", "", value, value, Tolerance::Relative(0.0), "");
        let text = Report::new(vec![row]).to_text();
        let line = text.lines().nth(1).unwrap();
        let words: Vec<_> = line.split_whitespace().collect();
        assert_eq!(words[..3], ["x", digits, digits]);
    }
}
