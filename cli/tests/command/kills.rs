//! A study or a repetition that is killed at random instants, again and again, ends with the numbers of one that was not.

use crate::place::{Called, Place};
use std::fs;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A study of 320 members, in five parts, each until past the first contact, some of them run again at design accuracy.
const STUDY: &str = r#"format = "auxbear.study/1"
scenario = "drop.toml"
set = ["run.duration=8 ms", "run.accuracy=screening"]
seed = 5

[design]
kind = "sobol"
members = 320

[[input]]
path = "contact.friction_coefficient"
lognormal = 0.2

[[limit]]
quantity = "first_impact_force"
most = "700 N"
share = 0.9

[question]
results = ["first_impact_force"]
confirm = 4
"#;

/// Numbers that look random, from 0 to below 1.
fn share(k: u64) -> f64 {
    let mixed = (k + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    ((mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 11) as f64
        / (1_u64 << 53) as f64
}

#[test]
fn kills_at_random_instants_change_no_byte_of_the_table() {
    let place = Place::new();
    fs::write(place.path("study.toml"), STUDY).unwrap();
    killed(&place, &["study", "study.toml", "--quiet"], &|out| {
        let read = |file: &str| fs::read_to_string(place.path(out).join(file)).unwrap();
        [read("members.csv"), read("summary.json")].concat()
    });
}

/// A repetition of 320 members.
const REPETITION: [&str; 9] = [
    "run",
    "drop.toml",
    "--repeat",
    "320",
    "--set",
    "run.duration=8 ms",
    "--set",
    "run.accuracy=screening",
    "--quiet",
];

/// The numbers of a repetition: all but the time that it took, which stands last.
fn numbers(place: &Place, out: &str) -> String {
    let text = fs::read_to_string(place.path(out).join("summary.json")).unwrap();
    let parts = fs::read_dir(place.path(out).join("members")).unwrap();
    assert_eq!(parts.count(), 5, "{out}");
    text.split("\"wall_s\"").next().unwrap().to_string()
}

#[test]
fn kills_at_random_instants_change_no_number_of_a_repetition() {
    let place = Place::new();
    killed(&place, &REPETITION, &|out| numbers(&place, out));
}

#[cfg(unix)]
#[test]
fn a_repetition_goes_on_after_kill_and_interrupt_but_for_another() {
    let place = Place::new();
    let call = |more: &[&str]| {
        let words = [&REPETITION[..8], more].concat();
        place.command(&words)
    };
    let mut child = call(&["--quiet"]).spawn().unwrap();
    let begin = Instant::now();
    while !place
        .path("runs/drop.partial/members/0000.parquet")
        .exists()
    {
        assert!(begin.elapsed() < Duration::from_secs(60), "no member ends");
        sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    // another takes none of its members, and leaves them
    let other = ["--set", "run.duration=9 ms", "--out", "runs/drop"];
    let refused = Called::of(call(&other).output().unwrap());
    assert_eq!(refused.code, Some(2), "{refused:?}");
    assert!(refused.err.contains("runs/drop.partial"), "{refused:?}");
    // the same call finds its place again, is interrupted, and goes on once more
    let mut next = call(&[]);
    let next = next.stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = next.spawn().unwrap();
    let begin = Instant::now();
    let part = |k: usize| place.path(&format!("runs/drop.partial/members/{k:04}.parquet"));
    while !part(1).exists() {
        assert!(begin.elapsed() < Duration::from_secs(60), "it stands still");
        sleep(Duration::from_millis(1));
    }
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    let ended = Called::of(child.wait_with_output().unwrap());
    assert!(ended.err.contains("goes on: "), "{ended:?}");
    if ended.code == Some(130) {
        assert!(ended.err.contains("the same call goes on"), "{ended:?}");
        let whole = Called::of(call(&[]).output().unwrap());
        assert_eq!(whole.code, Some(0), "{whole:?}");
        assert!(whole.err.contains("goes on: "), "{whole:?}");
    }
    assert_eq!(fs::read_dir(place.path("runs")).unwrap().count(), 1);
    let straight = call(&["--out", "straight"]).output().unwrap();
    assert!(straight.status.success());
    assert!(numbers(&place, "runs/drop") == numbers(&place, "straight"));
    // ended before the first member has, the same call goes on as well
    let early = ["--out", "early"];
    let child = call(&early).spawn().unwrap();
    while !place.path("early.partial/members").exists() {
        sleep(Duration::from_millis(1));
    }
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    child.wait_with_output().unwrap();
    Called::of(call(&early).output().unwrap()).done();
    assert!(numbers(&place, "early") == numbers(&place, "straight"));
    // a whole one stays as it is
    let again = Called::of(call(&["--out", "straight"]).output().unwrap());
    assert!(
        again.err.starts_with("error[AB0301]: straight"),
        "{again:?}"
    );
}

/// Kills a call at random instants, and compares what the calls leave in a directory with what one leaves that was not killed.
fn killed(place: &Place, words: &[&str], left: &dyn Fn(&str) -> String) {
    let given = std::env::var("AUXBEAR_SEEDS").ok();
    let wanted: u64 = given.and_then(|text| text.parse().ok()).unwrap_or(3);
    let begin = Instant::now();
    let command = |out: &str| place.command(&[words, &["--out", out]].concat());
    Called::of(command("straight").output().unwrap()).done();
    // instants to kill at, from the start to about the end: where that is follows from calls that ended before
    let mut longest = begin.elapsed();
    let (mut kills, mut calls) = (0, 0);
    let mut draws = 0;
    while kills < wanted {
        calls += 1;
        let out = format!("killed-{calls}");
        // more often than not before the end, until one call comes through
        loop {
            let mut child = command(&out).spawn().unwrap();
            sleep(longest.mul_f64(share(draws)));
            draws += 1;
            let ended = child.try_wait().unwrap().is_some();
            child.kill().unwrap();
            let status = child.wait().unwrap();
            // a run has its name when it is whole
            let named = words[0] == "run" && place.path(&out).exists();
            if ended || named || status.success() {
                assert!(named || status.success());
                longest = longest.mul_f64(0.7);
                break;
            }
            kills += 1;
            longest = longest.mul_f64(1.1);
            if kills.is_multiple_of(4) || kills >= wanted {
                Called::of(command(&out).output().unwrap()).done();
                break;
            }
            sleep(Duration::from_millis(1));
        }
        assert!(left(&out) == left("straight"), "{out}");
        fs::remove_dir_all(place.path(&out)).unwrap();
    }
    println!("{kills} kills in {calls} directories: all as without one");
}
