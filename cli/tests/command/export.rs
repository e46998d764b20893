//! Tables of a run for other programs.

use crate::place::Place;
use std::fs;
use std::path::Path;

/// The cells of a CSV file without quoted commas, row by row.
fn rows(path: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).unwrap();
    let cells = |line: &str| line.split(',').map(String::from).collect();
    text.lines().map(cells).collect()
}

#[test]
fn csv_gives_every_number_back_with_its_unit() {
    let place = Place::new();
    place.short_run(&["--out", "run", "--repeat", "3"]).done();
    let called = place.call(&["export", "run", "--csv"]).done();
    assert_eq!(called.out.trim(), "run/csv");
    let run = place.read("run");
    let history = rows(&place.path("run/csv/history.csv"));
    assert_eq!(history[0][0], "time [s]");
    assert_eq!(history[0].len(), run.columns.len());
    assert_eq!(history.len(), run.columns[0].values.len() + 1);
    for (column, known) in run.columns.iter().enumerate() {
        assert_eq!(
            history[0][column],
            format!("{} [{}]", known.name, known.unit)
        );
        for (row, value) in known.values.iter().enumerate() {
            let read: f64 = history[row + 1][column].parse().unwrap();
            assert_eq!(read.to_bits(), value.to_bits(), "{} {row}", known.name);
        }
    }
    let summary = place.summary("run");
    let results = fs::read_to_string(place.path("run/csv/results.csv")).unwrap();
    let first = &summary["quantities"]["first_impact_force"];
    let line = results
        .lines()
        .find(|line| line.starts_with("first_impact_force,"));
    let cells: Vec<&str> = line.unwrap().split(',').collect();
    assert_eq!(
        cells[1].parse::<f64>().unwrap(),
        first["value"].as_f64().unwrap()
    );
    assert_eq!(cells[2..4], ["N", "3"]);
    // in the order of the report
    assert!(
        results.find("\ntime_to_first_contact").unwrap()
            < results.find("\nfirst_impact_force").unwrap()
    );
    let members = rows(&place.path("run/csv/members.csv"));
    assert_eq!(members.len(), 4);
    let at = members[0]
        .iter()
        .position(|head| head == "first_impact_force [N]")
        .unwrap();
    let known = summary["members"][2]["first_impact_force"].as_f64();
    assert_eq!(members[3][at].parse::<f64>().ok(), known);
    place.call(&["export", "run", "--csv"]).refused(&["AB0301"]);
}

#[test]
fn a_workbook_is_written_once() {
    let place = Place::new();
    place.short_run(&["--out", "run"]).done();
    let called = place.call(&["export", "run", "--xlsx"]).done();
    assert_eq!(called.out.trim(), "run/run.xlsx");
    let bytes = fs::read(place.path("run/run.xlsx")).unwrap();
    assert!(bytes.starts_with(b"PK\x03\x04"));
    place
        .call(&["export", "run", "--xlsx"])
        .refused(&["AB0301"]);
    place
        .call(&["export", "run", "--xlsx", "--out", "other.xlsx"])
        .done();
    assert_eq!(fs::read(place.path("other.xlsx")).unwrap(), bytes);
    place
        .call(&["export", "nothing", "--xlsx"])
        .refused(&["AB0001"]);
    fs::write(place.path("run/summary.json"), "{").unwrap();
    place.call(&["export", "run", "--csv"]).refused(&["AB0006"]);
    assert!(!place.path("run/csv").exists());
}

/// What a killed process left is no obstacle, and nothing unfinished has the name that was asked for.
#[test]
fn what_a_killed_export_left_is_taken_over() {
    let place = Place::new();
    place.short_run(&["--out", "run"]).done();
    fs::create_dir(place.path("run/csv.partial")).unwrap();
    fs::write(place.path("run/csv.partial/run.csv"), "ti").unwrap();
    fs::write(place.path("run/csv.partial/history.csv"), "ti").unwrap();
    fs::write(place.path("page.html.partial"), "<html").unwrap();
    place.call(&["export", "run", "--csv"]).done();
    assert!(!place.path("run/csv.partial").exists());
    assert!(rows(&place.path("run/csv/history.csv")).len() > 2);
    place.call(&["report", "run", "--out", "page.html"]).done();
    assert!(!place.path("page.html.partial").exists());
    let page = fs::read_to_string(place.path("page.html")).unwrap();
    assert!(page.ends_with("</html>\n"), "{}", &page[page.len() - 40..]);
    place
        .call(&["report", "run", "--out", "page.html"])
        .refused(&["AB0301"]);
    assert_eq!(fs::read_to_string(place.path("page.html")).unwrap(), page);
}

#[test]
fn results_and_columns_are_chosen_by_name_and_pattern() {
    let place = Place::new();
    place.short_run(&["--out", "run", "--repeat", "2"]).done();
    let chosen = [
        "--only",
        "*.peak_contact_force",
        "--only",
        "bearing.*.speed",
    ];
    let words = [&["export", "run", "--csv"], &chosen[..]].concat();
    place.call(&words).done();
    let first = |table: &str| -> Vec<String> {
        let rows = rows(&place.path(&format!("run/csv/{table}.csv")));
        rows.into_iter().next().unwrap()
    };
    assert_eq!(
        first("history"),
        [
            "time [s]",
            "bearing.inner_race.speed [rad/s]",
            "bearing.cage.speed [rad/s]"
        ]
    );
    assert_eq!(first("members")[..2], ["member", "peak_contact_force [N]"]);
    let results = fs::read_to_string(place.path("run/csv/results.csv")).unwrap();
    assert!(results.lines().count() == 2 && results.contains("\npeak_contact_force,"));
    for (name, near) in [
        ("*.peak_contact_forse", "peak_contact_force"),
        ("bearing.lode", "bearing.load"),
    ] {
        let words = ["export", "run", "--csv", "--out", "x", "--only", name];
        place.call(&words).refused(&["AB0340", name, near]);
    }
    assert!(!place.path("x").exists());
}

/// Warnings of the first format had a number for their severity, or none.
#[test]
fn a_summary_of_the_first_format_stays_readable() {
    let place = Place::new();
    place.short_run(&["--out", "run"]).done();
    let mut summary = place.summary("run");
    assert_eq!(summary["format"], "auxbear.summary/2");
    let severities = ["destroys", "invalid", "uncertain", "note"];
    for warning in summary["warnings"].as_array().unwrap() {
        assert!(severities.contains(&warning["severity"].as_str().unwrap()));
        assert!(warning["part"].is_string() && warning["values"].is_object());
        assert!(warning["time_s"].is_null() || warning["time_s"].is_number());
    }
    summary["format"] = "auxbear.summary/1".into();
    summary["warnings"] = serde_json::json!([
        { "code": "AB1014", "graveness": 0, "text": "Backward whirl." },
        { "code": "AB1011", "text": "12 contacts." },
    ]);
    let path = place.path("run").join("summary.json");
    fs::write(path, summary.to_string()).unwrap();
    place.call(&["export", "run", "--csv"]).done();
    let table = rows(&place.path("run/csv/warnings.csv"));
    assert_eq!(table[1][..3], ["AB1014", "Backward whirl.", "destroys"]);
    assert_eq!(table.len(), 3);
    place.call(&["report", "run", "--out", "page.html"]).done();
    let page = fs::read_to_string(place.path("page.html")).unwrap();
    assert!(page.replace('\\', "").contains("\"graveness\":0"));

    summary["format"] = "auxbear.summary/3".into();
    let path = place.path("run").join("summary.json");
    fs::write(path, summary.to_string()).unwrap();
    let refused = place.call(&["export", "run", "--csv"]);
    refused.refused(&["auxbear.summary/3", "auxbear.summary/2"]);
}
