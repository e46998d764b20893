//! A study that is killed at random instants, again and again, ends with the table of one that was not.

use crate::place::Place;
use std::fs;
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
    let given = std::env::var("AUXBEAR_SEEDS").ok();
    let wanted: u64 = given.and_then(|text| text.parse().ok()).unwrap_or(3);
    let place = Place::new();
    fs::write(place.path("study.toml"), STUDY).unwrap();
    let begin = Instant::now();
    let words = |out: &'static str| ["study", "study.toml", "--out", out, "--quiet"];
    place.call(&words("straight")).done();
    // instants to kill at, from the start to about the end: where that is follows from calls that ended before
    let mut longest = begin.elapsed();
    let read = |out: &str, file: &str| fs::read(place.path(out).join(file)).unwrap();
    let (mut kills, mut studies) = (0, 0);
    let mut draws = 0;
    while kills < wanted {
        studies += 1;
        let out: &'static str = format!("killed-{studies}").leak();
        // more often than not before the end, until one call comes through
        loop {
            let mut child = place.command(&words(out)).spawn().unwrap();
            sleep(longest.mul_f64(share(draws)));
            draws += 1;
            let ended = child.try_wait().unwrap().is_some();
            child.kill().unwrap();
            let status = child.wait().unwrap();
            if ended {
                assert!(status.success());
                longest = longest.mul_f64(0.7);
                break;
            }
            kills += 1;
            longest = longest.mul_f64(1.1);
            if kills.is_multiple_of(4) {
                place.call(&words(out)).done();
                break;
            }
            sleep(Duration::from_millis(1));
        }
        if kills >= wanted {
            place.call(&words(out)).done();
        }
        for file in ["members.csv", "summary.json"] {
            assert!(read(out, file) == read("straight", file), "{out}: {file}");
        }
        fs::remove_dir_all(place.path(out)).unwrap();
    }
    println!("{kills} kills of {studies} studies: every table as it is without one");
}
