//! What a run leaves behind.

use crate::place::Place;
use serde_json::Value;
use std::fs;
use std::process::Command;

const FILES: [&str; 4] = [
    "history.parquet",
    "report.html",
    "scenario.toml",
    "summary.json",
];

/// The quantities of a drop that the interface promises always.
const PROMISED: [&str; 19] = [
    "time_to_first_contact",
    "first_impact_force",
    "peak_contact_force",
    "contact_count",
    "contact_start_times",
    "inner_race_time_to_50_percent",
    "inner_race_time_to_95_percent",
    "cage_time_to_95_percent_of_rolling",
    "rotor_race_friction_energy",
    "ball_slip_energy",
    "dissipated_energy",
    "energy_residual",
    "inner_race_final_speed",
    "cage_final_speed",
    "rotor_final_speed",
    "max_rotor_race_displacement",
    "max_mount_displacement",
    "whirl_direction",
    "peak_hertz_pressure",
];

#[test]
fn a_run_directory_is_whole() {
    let place = Place::new();
    let called = place.short_run(&["--out", "deep/run"]).done();
    assert!(called.out.contains("time to first contact"));
    assert!(called.out.contains("deep/run/report.html"));
    let mut names: Vec<String> = fs::read_dir(place.path("deep/run"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, FILES);
    assert_eq!(fs::read_dir(place.path("deep")).unwrap().count(), 1);

    let summary = place.summary("deep/run");
    assert_eq!(summary["format"], "auxbear.summary/2");
    assert_eq!(summary["complete"], true);
    assert_eq!(summary["stop"]["reason"], "finished");
    for name in PROMISED {
        let quantity = &summary["quantities"][name];
        assert!(quantity["unit"].is_string(), "{name}");
        if quantity["value"].is_null() {
            assert!(quantity["why"].is_string(), "{name}");
        }
    }
    // Inputs are a list of objects with their origin.
    let inputs = summary["inputs"].as_array().unwrap();
    let mass = inputs.iter().find(|input| input["path"] == "rotor.mass");
    assert_eq!(mass.unwrap()["mark"], "given");

    let run = place.read("deep/run");
    assert_eq!(run.name, "run");
    assert_eq!(run.columns[0].name, "time");
    assert_eq!(run.columns[0].unit, "s");
    let rows = run.columns[0].values.len();
    for column in &run.columns {
        assert_eq!(column.values.len(), rows, "{}", column.name);
        assert!(!column.unit.is_empty() && !column.meaning.is_empty());
    }
}

#[test]
fn no_result_file_holds_what_is_not_a_number() {
    let place = Place::new();
    place.short_run(&["--out", "run", "--repeat", "3"]).done();
    let summary = place.read("run").summary_json.to_lowercase();
    for word in [": nan", ": -nan", ": inf", ": -inf", "infinity"] {
        assert!(!summary.contains(word), "{word}");
    }
    for column in place.read("run").columns {
        let finite = column.values.iter().all(|value| value.is_finite());
        assert!(finite, "{}", column.name);
    }
}

#[test]
fn the_resolved_scenario_gives_the_same_history_bit_for_bit() {
    let place = Place::new();
    place
        .short_run(&["--out", "first", "--set", "rotor.speed=11000 rpm"])
        .done();
    place
        .call(&["run", "first/scenario.toml", "--out", "second", "--quiet"])
        .done();
    assert!(place.history_bits("first") == place.history_bits("second"));
    let quantities = |run| place.summary(run)["quantities"].clone();
    assert_eq!(quantities("first"), quantities("second"));
}

/// 20000 threads take minutes to start.
#[test]
fn the_environment_does_not_set_the_number_of_threads() {
    let place = Place::new();
    let words = [
        "run",
        "drop.toml",
        "--set",
        "run.duration=1 ms",
        "--repeat",
        "8",
    ];
    let mut command = place.command(&words);
    let begin = std::time::Instant::now();
    let output = command.env("RAYON_NUM_THREADS", "20000").output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert!(begin.elapsed().as_secs() < 10, "{:?}", begin.elapsed());
}

#[test]
fn repeated_runs_do_not_depend_on_the_number_of_threads() {
    let place = Place::new();
    let runs = [("one", "1"), ("two", "2")];
    for (out, threads) in runs {
        place
            .short_run(&["--out", out, "--repeat", "20", "--threads", threads])
            .done();
    }
    let summaries = runs.map(|(out, _)| {
        let mut summary = place.summary(out);
        summary["work"]["wall_s"] = Value::Null;
        summary
    });
    assert_eq!(summaries[0], summaries[1]);
    assert_eq!(summaries[0]["members"].as_array().unwrap().len(), 20);
    let spread = &summaries[0]["quantities"]["first_impact_force"]["spread"];
    assert_eq!(spread["members"], 20);
    assert!(place.history_bits("one") == place.history_bits("two"));
    // The number of runs is part of the resolved scenario.
    place
        .call(&["run", "one/scenario.toml", "--out", "three", "--quiet"])
        .done();
    assert_eq!(place.summary("three")["members"], summaries[0]["members"]);
}

#[test]
fn a_run_without_a_place_gets_the_next_free_one() {
    let place = Place::new();
    let said = |name: &str| {
        let called = place.short_run(&[]).done();
        assert!(called.out.contains(&format!("runs/{name}/report.html")));
    };
    said("drop");
    fs::create_dir(place.path("runs/drop-2.partial")).unwrap();
    said("drop-3");
    assert_eq!(place.names(), ["runs"]);
}

#[test]
fn quiet_leaves_the_warnings_alone() {
    let place = Place::new();
    let called = place.short_run(&["--quiet"]).done();
    let all: String = (place.summary("runs/drop")["warnings"]
        .as_array()
        .unwrap()
        .iter())
    .map(|told| {
        let part = |name: &str| told[name].as_str().unwrap().to_string();
        format!("warning[{}]: {}\n", part("code"), part("text"))
    })
    .collect();
    assert!(all.contains("AB1013"), "{all}");
    assert_eq!((called.out.as_str(), called.err), ("", all));
}

#[test]
fn the_report_is_drawn_again_and_side_by_side() {
    let place = Place::new();
    place.short_run(&["--out", "a"]).done();
    place
        .short_run(&["--out", "b", "--set", "rotor.mass=9 kg"])
        .done();
    let report = place.path("a/report.html");
    let drawn = fs::read_to_string(&report).unwrap();
    fs::write(&report, "spoiled").unwrap();
    let called = place.call(&["report", "a"]).done();
    assert_eq!(called.out, "a/report.html\n");
    assert_eq!(fs::read_to_string(&report).unwrap(), drawn);

    let called = place.call(&["report", "a", "b"]).done();
    assert_eq!(called.out, "comparison.html\n");
    let page = fs::read_to_string(place.path("comparison.html")).unwrap();
    assert_eq!(page.matches("class=\"run\">").count(), 2);
    place
        .call(&["report", "a", "b"])
        .refused(&["AB0301", "comparison.html"]);
    place
        .call(&["report", "a", "b", "--out", "both.html"])
        .done();
    assert_eq!(fs::read_to_string(place.path("both.html")).unwrap(), page);

    for name in ["both.pdf", "both.csv", "both"] {
        place
            .call(&["report", "a", "b", "--out", name])
            .refused(&["AB0108", name, "*.html", "*.svg"]);
        assert!(!place.path(name).exists());
    }

    let kept = fs::read(place.path("a/report.html")).unwrap();
    for (file, contents) in [
        ("summary.json", "garbage"),
        ("summary.json", ""),
        ("summary.json", "{}"),
        ("summary.json", "[]"),
        ("scenario.toml", "= garbage"),
        ("scenario.toml", ""),
    ] {
        let damaged = place.path("a").join(file);
        let whole = fs::read(&damaged).unwrap();
        fs::write(&damaged, contents).unwrap();
        let name = format!("a/{file}");
        for call in [
            &["report", "a"][..],
            &["report", "a", "b", "--out", "c.html"],
        ] {
            place.call(call).refused(&["AB0006", &name]);
        }
        assert_eq!(fs::read(place.path("a/report.html")).unwrap(), kept);
        fs::write(&damaged, whole).unwrap();
    }

    fs::write(place.path("b/history.parquet"), "PAR1 is not enough PAR1").unwrap();
    place
        .call(&["report", "b"])
        .refused(&["AB0006", "b/history.parquet"]);
}

#[test]
fn pyarrow_shows_unit_and_meaning_of_every_column() {
    let known = Command::new("python3")
        .args(["-c", "import pyarrow.parquet"])
        .output();
    if !known.is_ok_and(|output| output.status.success()) {
        println!("DID NOT RUN: python3 has no pyarrow");
        return;
    }
    let place = Place::new();
    place.short_run(&["--out", "run"]).done();
    let script = "
import pyarrow, pyarrow.parquet
table = pyarrow.parquet.read_table('run/history.parquet')
for field in table.schema:
    assert field.type == pyarrow.float64() and set(field.metadata) == {b'unit', b'meaning'}, field
assert table.schema.field('time').metadata[b'unit'] == b's'
print(table.num_rows, sum(table['time'].to_pylist()).hex())
";
    let output = Command::new("python3")
        .args(["-c", script])
        .current_dir(place.folder())
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let read: f64 = place.read("run").columns[0].values.iter().sum();
    let printed = String::from_utf8(output.stdout).unwrap();
    let rows = place.read("run").columns[0].values.len();
    assert!(printed.starts_with(&format!("{rows} ")));
    assert!(read > 0.0);
}
