//! Runs that do not reach their end.

use crate::place::{Called, Place};
use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

#[test]
fn a_run_that_diverges_says_where_and_keeps_what_was_computed() {
    for set in [
        "bearing.drag.spin=1e10 N m s",
        "bearing.inner_race_mass=1e-300 kg",
    ] {
        let place = Place::new();
        let called = place.short_run(&["--out", "run", "--set", set]);
        assert_eq!(called.code, Some(1), "{called:?}");
        assert!(called.err.contains("run failed: "), "{called:?}");
        assert!(
            called.err.contains("What was computed is in run"),
            "{called:?}"
        );
        let summary = place.summary("run");
        assert_eq!(summary["complete"], false);
        assert_eq!(summary["stop"]["reason"], "diverged");
        let time = summary["stop"]["time_s"].as_f64().unwrap();
        assert!((0.0..0.012).contains(&time));
        for column in place.read("run").columns {
            let finite = column.values.iter().all(|value| value.is_finite());
            assert!(finite, "{set}: {}", column.name);
        }
        assert!(place.path("run/report.html").is_file());
    }
}

/// A run of many minutes, once it has begun.
#[cfg(unix)]
fn long_run(place: &Place) -> Child {
    let words = [
        "run",
        "drop.toml",
        "--out",
        "run",
        "--set",
        "run.duration=1000 s",
        "--set",
        "run.output_interval=10 ms",
    ];
    let child = place
        .command(&words)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begin = Instant::now();
    while !place.path("run.partial").exists() {
        assert!(begin.elapsed() < Duration::from_secs(20), "does not begin");
        sleep(Duration::from_millis(10));
    }
    // The handler is set right after the directory is reserved; then some steps are made.
    sleep(Duration::from_millis(500));
    child
}

#[cfg(unix)]
fn send(signal: &str, child: &Child) {
    let sent = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_keeps_what_was_computed() {
    for signal in ["-INT", "-TERM"] {
        let place = Place::new();
        let child = long_run(&place);
        send(signal, &child);
        let called = Called::of(child.wait_with_output().unwrap());
        assert_eq!(called.code, Some(130), "{called:?}");
        assert!(called.err.contains("interrupted: "), "{called:?}");
        assert!(
            called.out.contains("NOT WHOLE, the values are"),
            "{called:?}"
        );
        assert_eq!(place.names(), ["run"]);
        let summary = place.summary("run");
        assert_eq!(summary["complete"], false);
        assert_eq!(summary["stop"]["reason"], "interrupted");
        let time = summary["stop"]["time_s"].as_f64().unwrap();
        assert!(time > 0.0 && time < 1000.0);
        let run = place.read("run");
        let rows = run.columns[0].values.len();
        assert!(rows > 1, "{rows}");
        assert!(run.columns[0].values[rows - 1] <= time);
    }
}

#[cfg(unix)]
#[test]
fn a_full_disk_keeps_what_could_be_written_and_says_so() {
    let place = Place::new();
    // Files of at most 4 blocks (2 or 4 kB): the scenario does not fit.
    let script = format!(
        "ulimit -f 4; exec '{}' run drop.toml --out run --set 'run.duration=12 ms'",
        env!("CARGO_BIN_EXE_auxbear")
    );
    let output = Command::new("sh")
        .args(["-c", &script])
        .current_dir(place.folder())
        .output()
        .unwrap();
    let called = Called::of(output);
    assert_eq!(called.code, Some(1), "{called:?}");
    assert!(called.err.starts_with("error[AB0302]: run/"), "{called:?}");
    assert!(called.err.contains("File too large"), "{called:?}");
    // not even the scenario has room
    assert!(place.names().is_empty(), "{:?}", place.names());

    // The same for each larger file in turn: the history, then the page.
    for (kept, blocks, file) in [
        ("run.incomplete", 150, "history.parquet"),
        ("run.incomplete-2", 400, "report.html"),
    ] {
        let script = script.replace("-f 4", &format!("-f {blocks}"));
        let output = Command::new("sh")
            .args(["-c", &script])
            .current_dir(place.folder())
            .output()
            .unwrap();
        let called = Called::of(output);
        assert_eq!(called.code, Some(1), "{called:?}");
        assert!(called.err.contains(&format!("run/{file}")), "{called:?}");
        let told = format!("What could be written is kept in {kept}\n");
        assert!(called.err.contains(&told), "{called:?}");
        assert!(!place.path("run").exists() && !place.path("run.partial").exists());
        assert!(!place.path(kept).join(file).exists());
        let summary = place.summary(kept);
        assert_eq!(summary["complete"], false);
        assert_eq!(summary["stop"]["reason"], "not written");
    }
    let text = fs::read_to_string(place.path("drop.toml")).unwrap();
    assert!(text.contains("[rotor]"));
}
