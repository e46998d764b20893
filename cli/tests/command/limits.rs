//! Limits of a file: what is printed and written, and that a failed one is a result.

use crate::place::Place;
use std::fs;

#[test]
fn a_failed_limit_is_a_result() {
    let place = Place::new();
    let mut text = fs::read_to_string(place.path("drop.toml")).unwrap();
    text.push_str("\n[[limit]]\nquantity = \"first_impact_force\"\nmost = \"1 N\"\n");
    text.push_str("\n[[limit]]\nquantity = \"inner_race_time_to_95_percent\"\nmost = \"1 s\"\n");
    fs::write(place.path("drop.toml"), text).unwrap();
    let called = place.short_run(&["--out", "run"]).done();
    let lines: Vec<&str> = (called.out.lines())
        .skip_while(|line| *line != "limits:")
        .collect();
    assert!(
        lines[1].starts_with("  fail       first impact force"),
        "{lines:?}"
    );
    assert!(lines[1].contains("at most 1 N"), "{lines:?}");
    assert!(
        lines[2].starts_with("  undecided  inner race time to 95 percent"),
        "{lines:?}"
    );
    let summary = place.summary("run");
    let limits = summary["limits"].as_array().unwrap();
    assert_eq!(limits[0]["verdict"], "fail");
    assert_eq!(limits[0]["bound"], 1.0);
    assert_eq!(limits[0]["side"], "most");
    assert_eq!(
        limits[0]["value"],
        summary["quantities"]["first_impact_force"]["value"]
    );
    assert!(limits[1]["value"].is_null() && limits[1]["verdict"] == "undecided");
    let page = fs::read_to_string(place.path("run/report.html")).unwrap();
    assert!(page.contains("limitTiles"));

    let set = [
        "check",
        "drop.toml",
        "--set",
        "limit.first_impakt_force.most=1 N",
    ];
    place
        .call(&set)
        .refused(&["AB0340", "--set", "limit.quantity", "first_impact_force"]);
    let set = [
        "check",
        "drop.toml",
        "--set",
        "limit.first_impact_force.most=1 s",
    ];
    place.call(&set).refused(&["AB0105", "limit.most", "force"]);
}
