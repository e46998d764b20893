//! Studies: the same table however they are computed, and what a study refuses.

use crate::place::Place;
use serde_json::Value;
use std::fs;
use std::thread::sleep;
use std::time::Duration;

/// A study of 130 members, in three parts, each until past the first contact.
const STUDY: &str = r#"format = "auxbear.study/1"
scenario = "drop.toml"
set = ["run.duration=20 ms", "run.accuracy=screening"]
seed = 3

[design]
kind = "monte carlo"
members = 130

[[input]]
path = "contact.friction_coefficient"
lognormal = 0.2

[[input]]
path = "rotor.mass"
normal = "0.2 kg"

[[limit]]
quantity = "first_impact_force"
most = "700 N"
share = 0.9

[question]
results = ["first_impact_force"]
"#;

fn place(study: &str) -> Place {
    let place = Place::new();
    fs::write(place.path("study.toml"), study).unwrap();
    place
}

fn table(place: &Place, directory: &str) -> String {
    fs::read_to_string(place.path(directory).join("members.csv")).unwrap()
}

#[test]
fn threads_parts_and_a_kill_leave_the_table_as_it_is() {
    let place = place(STUDY);
    place
        .call(&["study", "study.toml", "--out", "one", "--threads", "1"])
        .done();
    let straight = table(&place, "one");
    assert_eq!(straight.lines().count(), 131);
    place
        .call(&[
            "study",
            "study.toml",
            "--out",
            "two",
            "--threads",
            "2",
            "--quiet",
        ])
        .done();
    assert_eq!(table(&place, "two"), straight);

    // killed once there is a part, whatever else it is doing
    let words = ["study", "study.toml", "--out", "killed", "--threads", "1"];
    let mut child = place.command(&words).spawn().unwrap();
    let part = place.path("killed/members/0000.parquet");
    while !part.exists() && child.try_wait().unwrap().is_none() {
        sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    place.call(&words).done();
    assert_eq!(table(&place, "killed"), straight);

    // a part that is gone is computed again
    fs::remove_file(place.path("two/members/0001.parquet")).unwrap();
    place.call(&["study", "study.toml", "--out", "two"]).done();
    assert_eq!(table(&place, "two"), straight);

    let summary: Value = place.summary("one");
    assert_eq!(summary["complete"], true);
    assert_eq!(summary["members"], 130);
    assert_eq!(summary["members_failed"], 0);
    let limit = &summary["limits"][0];
    let beyond = limit["share_beyond"]["value"].as_f64().unwrap();
    let hold = limit["hold"].as_f64().unwrap();
    assert!((beyond - (1.0 - hold / 130.0)).abs() < 1e-12);
}

#[test]
fn more_members_keep_those_that_are_there() {
    let short = STUDY.replace("members = 130", "members = 6");
    let place = place(&short);
    place.call(&["study", "study.toml", "--out", "s"]).done();
    let before = table(&place, "s");
    place
        .call(&["study", "study.toml", "--out", "s", "--add", "3"])
        .done();
    let after = table(&place, "s");
    assert!(after.starts_with(&before) && after.lines().count() == 10);
    // the same command goes on with the longer design
    place.call(&["study", "study.toml", "--out", "s"]).done();
    assert_eq!(table(&place, "s"), after);

    place
        .call(&["study", "study.toml", "--member", "5", "--out", "m"])
        .done();
    let force = place.summary("m")["quantities"]["first_impact_force"]["value"]
        .as_f64()
        .unwrap();
    let head: Vec<&str> = before.lines().next().unwrap().split(',').collect();
    let at = head
        .iter()
        .position(|name| *name == "first_impact_force [N]")
        .unwrap();
    let row: Vec<&str> = before.lines().nth(6).unwrap().split(',').collect();
    let of_study: f64 = row[at].parse().unwrap();
    // a single run computes its balls side by side: sums in another order
    assert!((force / of_study - 1.0).abs() < 1e-6, "{force} {of_study}");
}

#[test]
fn what_a_study_refuses() {
    let short = STUDY.replace("members = 130", "members = 2");
    let place = place(&short);
    place.call(&["study", "study.toml", "--out", "s"]).done();
    let refused = |from: &str, to: &str, words: &[&str]| {
        fs::write(place.path("study.toml"), short.replace(from, to)).unwrap();
        place
            .call(&["study", "study.toml", "--out", "s"])
            .refused(words);
    };
    refused(
        "seed = 3",
        "seed = 4",
        &["AB2203", "`seed = 3`", "`seed = 4`"],
    );
    refused("20 ms", "21 ms", &["AB2203", "scenario.toml", "duration"]);
    // words are no other study
    fs::write(
        place.path("study.toml"),
        short.replace("seed = 3", "title = \"Revision B\"\nseed = 3"),
    )
    .unwrap();
    place.call(&["study", "study.toml", "--out", "s"]).done();
    let kept = fs::read_to_string(place.path("s/study.toml")).unwrap();
    assert!(kept.contains("Revision B"), "{kept}");
    refused(
        "lognormal = 0.2",
        "lognormal = 0.2\nnormal = 0.1",
        &["AB0109", "study.toml:11"],
    );
    refused(
        "rotor.mass",
        "rotor.mas",
        &[
            "AB0101",
            "study.toml:15: input.path",
            "Did you mean \"rotor.mass\"",
        ],
    );
    refused("0.2 kg", "0.2 m", &["AB0105", "study.toml"]);
    refused(
        "monte carlo",
        "monte karlo",
        &["AB0108", "Did you mean \"monte carlo\"?"],
    );
    refused(
        "\"first_impact_force\"]",
        "\"first_force\"]",
        &["AB0340", "question.results"],
    );
    refused("members = 2", "members = 0", &["AB0106", "design.members"]);
    refused(
        "\"run.duration",
        "\"repeat.count=4\", \"run.duration",
        &["AB2200", "repeat.count = 4"],
    );
    let correlated = "[question]\n".to_string();
    let pair = "[[correlation]]\ninputs = [\"rotor.mass\", \"contact.friction_coefficient\"]\ncoefficient = 0.5\n\n[question]\n";
    let saltelli = short
        .replace("monte carlo", "saltelli")
        .replace("members = 2", "blocks = 2");
    fs::write(
        place.path("study.toml"),
        saltelli.replace(&correlated, pair),
    )
    .unwrap();
    place
        .call(&["study", "study.toml", "--out", "t"])
        .refused(&["AB2202", "saltelli"]);
    let sweep = short
        .replace("monte carlo", "sweep")
        .replace("members = 2\n", "");
    fs::write(place.path("study.toml"), sweep).unwrap();
    place
        .call(&["study", "study.toml", "--out", "t", "--add", "1"])
        .refused(&["AB2201", "--add"]);
    assert!(!place.path("t").join("study.toml").exists());
    fs::write(place.path("study.toml"), &short).unwrap();
    let held = fs::File::open(place.path("s")).unwrap();
    held.try_lock().unwrap();
    place
        .call(&["study", "study.toml", "--out", "s"])
        .refused(&["AB2204"]);
}

#[test]
fn a_failed_member_is_kept_with_its_reason() {
    let study = STUDY.replace("members = 130", "members = 8").replace(
        "path = \"rotor.mass\"\nnormal = \"0.2 kg\"",
        "path = \"rotor.mass\"\nuniform = [\"-8 kg\", \"8 kg\"]",
    );
    let place = place(&study);
    place.call(&["study", "study.toml", "--out", "s"]).done();
    let summary = place.summary("s");
    let failed = summary["failed"].as_array().unwrap();
    assert!(!failed.is_empty() && failed.len() < 8, "{failed:?}");
    assert!(failed[0]["why"].as_str().unwrap().contains("rotor.mass"));
    assert!(
        failed[0]["drawn"]["rotor.mass"]
            .as_str()
            .unwrap()
            .starts_with('-')
    );
    assert_eq!(
        summary["quantities"]["first_impact_force"]["members"],
        8 - failed.len()
    );
}

#[test]
fn a_study_tells_what_its_members_warn_of() {
    let study = r#"format = "auxbear.study/1"
scenario = "drop.toml"
set = ["run.duration=8 ms", "run.accuracy=screening", "rotor.first_bending_frequency=655 rad/s"]

[design]
kind = "factorial"

[[input]]
path = "rotor.speed"
choice = ["3000 rpm", "12000 rpm"]

[[input]]
path = "contact.friction_coefficient"
choice = ["0.05", "0.1"]
"#;
    let place = place(study);
    let called = place
        .call(&["study", "study.toml", "--out", "s", "--quiet"])
        .done();
    // the slow rotors are rigid enough
    let summary = place.summary("s");
    let bends = |warning: &&Value| warning["code"] == "AB1001";
    let warnings = summary["warnings"].as_array().unwrap();
    let bends = warnings.iter().find(bends).unwrap();
    assert_eq!(bends["members"], 2);
    let table = table(&place, "s");
    let names: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let column = names.iter().position(|name| *name == "warning.AB1001");
    let ones = |row: &str| row.split(',').nth(column.unwrap()) == Some("1");
    assert_eq!(table.lines().skip(1).filter(|row| ones(row)).count(), 2);
    let said = "warning[AB1001]: A rotor near its bending speed: 2 of 4 members";
    assert!(called.err.contains(said), "{}", called.err);
    let page = fs::read_to_string(place.path("s/report.html")).unwrap();
    assert!(page.contains("<li class=\"grave\"><code>AB1001</code>"));
}

#[test]
fn the_starting_file_is_a_study_of_the_starting_drop() {
    let place = Place::new();
    place.call(&["new", "study", "study.toml"]).done();
    let text = fs::read_to_string(place.path("study.toml")).unwrap();
    let short = text.replace("members = 64", "members = 2").replace(
        "\"run.accuracy=screening\"",
        "\"run.accuracy=screening\", \"run.duration=8 ms\"",
    );
    fs::write(place.path("study.toml"), short).unwrap();
    place.call(&["study", "study.toml"]).done();
    let page = fs::read_to_string(place.path("runs/study/report.html")).unwrap();
    assert!(page.contains("<svg") && !page.contains("NaN") && !page.contains("inf"));
    // as written, in its units; and a limit far beyond the members is told at the edge
    assert!(page.contains("<td>normal 100 rpm</td>"));
    assert!(page.contains("<td>uniform 1e7 N/m, 3e7 N/m</td>"));
    assert!(page.contains("at most 20 kN →"));
}

/// Bearings of one bore and two clearances, each with the same four draws.
const SELECTION: &str = r#"format = "auxbear.study/1"
scenario = "drop.toml"
set = ["run.duration=8 ms", "run.accuracy=screening"]
seed = 3

[design]
kind = "selection"
draws = 4

[[input]]
path = "bearing.name"
catalogue = { bore_diameter = "25 mm", outer_diameter = ["40 mm", "47 mm"], type = "deep groove", ball_material = "steel" }

[[input]]
path = "contact.friction_coefficient"
uniform = [0.1, 0.3]

[[input]]
path = "contact.radial_air_clearance"
choice = ["0.2 mm", "0.3 mm"]

[[limit]]
quantity = "first_impact_force"
most = "650 N"

[question]
rank = "time_to_first_contact"
best = "most"
"#;

#[test]
fn candidates_meet_the_same_draws_and_are_ranked_with_their_reasons() {
    let place = place(SELECTION);
    let called = place.call(&["study", "study.toml", "--out", "s"]).done();
    assert!(called.out.contains("candidates"), "{}", called.out);
    let summary = place.summary("s");
    let ranking = summary["ranking"].as_array().unwrap();
    let names = ranking
        .iter()
        .map(|one| one["candidate"]["bearing.name"].as_str().unwrap());
    let mut names: Vec<&str> = names.collect();
    names.sort_unstable();
    names.dedup();
    assert!(
        names.contains(&"6005") && names.len() * 2 == ranking.len(),
        "{names:?}"
    );
    // the draws of each candidate are those of the first
    let table = table(&place, "s");
    let mut rows = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let head = rows.next().unwrap();
    let at = head
        .iter()
        .position(|name| name.contains("friction_coefficient"))
        .unwrap();
    let drawn: Vec<&str> = rows.map(|row| row[at]).collect();
    assert_eq!(drawn.len(), 4 * ranking.len());
    assert!(drawn.chunks(4).all(|part| part == &drawn[..4]) && drawn[0] != drawn[1]);
    // passing ones first, the larger clearance, which takes longer to fall through, before the smaller one
    let mut last = f64::INFINITY;
    for one in ranking.iter().filter(|one| one["verdict"] == "pass") {
        let value = one["quantile_95_percent"].as_f64().unwrap();
        assert!(value <= last);
        last = value;
    }
    let failing: Vec<&Value> = ranking
        .iter()
        .filter(|one| one["verdict"] == "fail")
        .collect();
    for one in &failing {
        assert!(one["limits"][0]["hold"].as_u64().unwrap() < 4);
    }
    assert!(!failing.is_empty() && failing.len() < ranking.len());
    let ends: Vec<bool> = ranking.iter().map(|one| one["verdict"] == "fail").collect();
    assert!(ends.windows(2).all(|pair| pair[0] <= pair[1]));
    let page = fs::read_to_string(place.path("s/report.html")).unwrap();
    assert!(page.contains("<h2>Ranking</h2>"));
    // the study that stands in the directory is the same study
    place.call(&["study", "study.toml", "--out", "s"]).done();
}

#[test]
fn members_near_a_limit_are_confirmed_at_design_accuracy_and_design_decides() {
    let study = (STUDY.replace("members = 130", "members = 12"))
        .replace("results = [", "confirm = 3\nresults = [");
    let place = place(&study);
    place.call(&["study", "study.toml", "--out", "s"]).done();
    let text = table(&place, "s");
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = rows.next().unwrap();
    let at = |name: &str| head.iter().position(|cell| cell.starts_with(name)).unwrap();
    let (screening, design) = (at("first_impact_force"), at("confirmed.first_impact_force"));
    let mut apart = Vec::new();
    for row in rows {
        let value: f64 = row[screening].parse().unwrap();
        let confirmed = row[design].parse::<f64>().ok();
        apart.push(((value - 700.0).abs(), confirmed.is_some()));
        if let Some(design) = confirmed {
            assert!(
                (design / value - 1.0).abs() < 1e-2 && design != value,
                "{design} {value}"
            );
        }
    }
    apart.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(
        apart
            .iter()
            .enumerate()
            .all(|(k, (_, confirmed))| *confirmed == (k < 3))
    );
    // going on changes nothing
    place.call(&["study", "study.toml", "--out", "s"]).done();
    assert_eq!(table(&place, "s"), text);
    // nothing is confirmed of what is at design accuracy already
    let design = study.replace(", \"run.accuracy=screening\"", "");
    fs::write(place.path("study.toml"), design).unwrap();
    place
        .call(&["study", "study.toml", "--out", "t"])
        .refused(&["AB2201", "question.confirm"]);
}

#[test]
fn what_is_no_selection_is_refused() {
    for (old, new, words) in [
        (
            "rank = \"time_to_first_contact\"\n",
            "",
            "question.rank: found no value",
        ),
        (
            "rank = \"time_to_first_contact\"",
            "rank = \"beauty\"",
            "no number among the results",
        ),
        (
            "best = \"most\"",
            "best = \"nicest\"",
            "\"least\", \"most\"",
        ),
        (
            "\"25 mm\"",
            "\"25.3 mm\"",
            "no bearing of the built-in catalogue",
        ),
        ("draws = 4", "members = 4", "draws"),
    ] {
        let place = place(&SELECTION.replace(old, new));
        place
            .call(&["study", "study.toml", "--out", "s"])
            .refused(&[words]);
    }
}

#[cfg(unix)]
#[test]
fn a_link_to_a_study_is_that_study() {
    let study = STUDY.replace("members = 130", "members = 3");
    let place = place(&study.replace("duration=20 ms", "duration=100 ms"));
    place.call(&["study", "study.toml", "--out", "own"]).done();
    std::os::unix::fs::symlink(place.path("own"), place.path("link")).unwrap();
    let called = place.call(&["study", "study.toml", "--out", "link"]).done();
    assert!(called.err.is_empty(), "{called:?}");
}

#[test]
fn what_is_no_qualification_is_not_qualified() {
    let place = place(STUDY);
    let called = place.call(&["qualify", "study.toml", "--out", "q"]);
    called.refused(&["study.toml", "design.kind", "qualification"]);
    assert!(!place.path("q").exists());
}
