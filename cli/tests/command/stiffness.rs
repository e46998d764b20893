//! `auxbear bearings stiffness`.

use crate::place::{Called, Place};
use serde_json::Value;
use std::fs;

/// The bearing of the reference's quasi-static file: 14 balls on the circle that its groove centres give.
const REFERENCE: &str = "format = \"auxbear.bearings/1\"\n\n[[bearing]]\nname = \"reference\"\ntype = \"angular contact\"\nball_count = 14\nball_diameter = \"6.35 mm\"\npitch_diameter = \"36.02195945375878 mm\"\nwidth = \"12 mm\"\ninner_groove_curvature = 0.52\nouter_groove_curvature = 0.52\ncontact_angle = \"24 deg\"\n";

fn call(place: &Place, words: &[&str]) -> Called {
    let mut all = vec!["bearings", "stiffness"];
    all.extend(words);
    place.call(&all)
}

fn json(place: &Place, words: &[&str]) -> Value {
    let mut all = words.to_vec();
    all.push("--json");
    serde_json::from_str(&call(place, &all).done().out).unwrap()
}

fn close(value: &Value, expected: f64, share: f64) {
    let value = value.as_f64().unwrap();
    assert!((value / expected - 1.0).abs() < share, "{value} {expected}");
}

#[test]
fn the_reference_bearing_has_the_reference_equilibrium() {
    let place = Place::new();
    fs::write(place.path("own.toml"), REFERENCE).unwrap();
    let own = ["reference", "--catalogue", "own.toml"];
    // the row steel, 300 N, 2000 rad/s, inner, and the pair O at 2000 rad/s of spatial_quasistatic.json
    let mut words = own.to_vec();
    words.extend([
        "--axial",
        "300 N",
        "--speed",
        "2000 rad/s",
        "--race-control",
        "inner",
    ]);
    let found = json(&place, &words);
    close(&found["shift"][2], 7.356_039_825_254_202_5e-6, 1e-6);
    let mut words = own.to_vec();
    words.extend([
        "--arrangement",
        "DB",
        "--offset",
        "8 um",
        "--speed",
        "2000 rad/s",
    ]);
    let found = json(&place, &words);
    close(&found["preload_thrusts"][0], 193.309_935_562_338_8, 1e-6);
    close(
        &found["rows"][1][3]["load_outer"],
        40.113_797_304_598_58,
        1e-6,
    );
    close(
        &found["rows"][0][0]["contact_angle_inner"],
        0.517_260_489_776_366_7,
        1e-6,
    );
    // a preload is the force of a row at rest: 8 µm are 103.03 N
    let mut words = own.to_vec();
    words.extend(["--arrangement", "DF", "--preload", "103.03033943154108 N"]);
    let found = json(&place, &words);
    close(&found["offset"], 8e-6, 1e-6);
    close(&found["stiffness"][0][0], 183_641_102.05, 1e-6);
}

#[test]
fn the_table_shows_angles_loads_and_stiffness() {
    let place = Place::new();
    let words = [
        "6005",
        "--axial",
        "200N",
        "--speed",
        "20000rpm",
        "--contact-angle",
        "15deg",
    ];
    let shown = call(&place, &words).done();
    assert!(
        shown
            .out
            .starts_with("6005, single, free contact angle 15.00 deg, race control: half\n")
    );
    for part in [
        "displacement of the inner ring",
        "MPa",
        "of the ring",
        "tilt x",
        "Mx",
    ] {
        assert!(shown.out.contains(part), "{part} in {}", shown.out);
    }
    assert!(shown.out.lines().all(|line| line.chars().count() <= 130));
    assert_eq!(shown.err, "");
}

#[test]
fn what_is_out_of_range_is_warned_of() {
    let place = Place::new();
    let radial = call(&place, &["6005", "--radial", "200 N"]).done();
    assert!(
        radial.err.contains("AB2402") && radial.err.contains("of 10 balls"),
        "{}",
        radial.err
    );
    let fast = [
        "6005",
        "--axial",
        "20 N",
        "--radial",
        "100 N",
        "--speed",
        "30000 rpm",
        "--contact-angle",
        "15 deg",
    ];
    assert!(call(&place, &fast).done().err.contains("AB2404"));
    let pair = [
        "6005",
        "--contact-angle",
        "15 deg",
        "--arrangement",
        "DB",
        "--preload",
        "20 N",
        "--axial",
        "300 N",
    ];
    assert!(call(&place, &pair).done().err.contains("AB2403"));
    let heavy = call(&place, &["6005", "--radial", "12 kN"]).done();
    assert!(
        heavy.err.contains("AB2406") && heavy.err.contains("MPa"),
        "{}",
        heavy.err
    );
    let deep = call(
        &place,
        &["6005", "--axial", "9 kN", "--contact-angle", "28 deg"],
    )
    .done();
    assert!(deep.err.contains("AB2401"), "{}", deep.err);
}

#[test]
fn a_name_says_the_arrangement_and_the_balls() {
    let place = Place::new();
    let loads = [
        "--preload",
        "100 N",
        "--axial",
        "50 N",
        "--speed",
        "10000 rpm",
    ];
    let words = |name: &[&'static str]| [name, &loads].concat();
    let named = json(&place, &words(&["7010 C DB"]));
    let typed = json(&place, &words(&["7010 C", "--arrangement", "DB"]));
    assert_eq!(named, typed);
    assert_eq!(named["arrangement"], "DB");
    let agreed = json(&place, &words(&["7010CDB", "--arrangement", "db"]));
    assert_eq!(named, agreed);
    let refused = |name: &[&'static str], parts: &[&str]| {
        call(&place, &words(name)).refused(parts);
    };
    refused(
        &["7010 C DB", "--arrangement", "DF"],
        &["--arrangement", "\"DF\"", "DB is needed"],
    );
    refused(&["7010 C DB", "--arrangement", "single"], &["DB is needed"]);
    refused(&["7010 C DT"], &["--preload", "tandem"]);
    refused(&["7010 DB"], &["\"7010 C\", \"7010 AC\""]);
    // at rest K grows with E*^(2/3): 113.2 GPa of steel on steel, 135.6 of silicon nitride on steel
    let stiffness = |name| json(&place, &[name, "--axial", "100 N"])["stiffness"][2][2].as_f64();
    let ratio = stiffness("7010 C hybrid").unwrap() / stiffness("7010 C").unwrap();
    // the contact angle under load is that of the softer contact, 0.2 deg more
    assert!(
        (ratio / (135.6_f64 / 113.2).powf(2.0 / 3.0) - 1.0).abs() < 0.03,
        "{ratio}"
    );
}

#[test]
fn a_preload_by_a_spring_follows_the_load() {
    let place = Place::new();
    let of = |axial: &str, more: &[&str]| {
        let axial = format!("--axial={axial}");
        let words = [
            "7010 C DB",
            "--preload",
            "100 N",
            "--speed",
            "9000 rpm",
            &axial,
        ];
        call(&place, &[&words, more].concat())
    };
    let json = |axial: &str, more: &[&str]| -> Value {
        let more = [more, &["--json"]].concat();
        serde_json::from_str(&of(axial, &more).done().out).unwrap()
    };
    let rigid = json("80 N", &[]);
    let stiff = json("80 N", &["--preload-spring", "1e20 N/m"]);
    assert!(rigid["spring_force"].is_null());
    for (name, k) in [("shift", 2), ("thrusts", 0)] {
        close(&stiff[name][k], rigid[name][k].as_f64().unwrap(), 1e-9);
    }
    // of a spring of any use the force is that of the preload
    let kept = json("80 N", &["--preload-spring", "1e5 N/m"]);
    close(&kept["spring_force"], 100.0, 0.02);
    // its compression is what the balls add as they press outwards
    let compression = kept["spring_compression"].as_f64().unwrap();
    close(&kept["spring_force"], 100.0 + 1e5 * compression, 1e-9);
    let text = of("80 N", &["--preload-spring", "1e5 N/m"]).done().out;
    assert!(text.contains("preload spring under the rows"), "{text}");
    let solid = of(
        "-400 N",
        &["--preload-spring", "1e6 N/m", "--spring-travel", "50 um"],
    );
    assert!(solid.done().err.contains("AB2408"));
    // at speed the balls press on all the way
    let words = ["7010 C DB", "--preload", "100 N", "--axial", "2 kN"];
    let free = call(
        &place,
        &[&words[..], &["--preload-spring", "1e8 N/m"]].concat(),
    );
    assert!(free.done().err.contains("AB2407"));
    let alone = ["7010 C DB", "--axial", "1 N", "--preload-spring", "1e6 N/m"];
    call(&place, &alone).refused(&["--preload-spring", "without --preload"]);
}

#[test]
fn wrong_input_is_one_message() {
    let place = Place::new();
    let refused = |words: &[&str], parts: &[&str]| {
        let mut all = vec!["6005"];
        all.extend(words);
        let mut parts = parts.to_vec();
        parts.push("auxbear bearings stiffness");
        call(&place, &all).refused(&parts);
    };
    refused(&[], &["--axial", "no load"]);
    refused(
        &["--axial", "200"],
        &["--axial", "\"200\"", "a force is needed"],
    );
    refused(&["--axial", "200 mm"], &["--axial", "a force is needed"]);
    refused(
        &["--axial", "1 N", "--contact-angle", "70 deg"],
        &["--contact-angle", "0 to 60 deg"],
    );
    refused(
        &["--axial", "1 N", "--contact-angle", "55 deg"],
        &["--contact-angle", "groove", "ends"],
    );
    refused(
        &["--axial", "1 N", "--arrangement", "OX"],
        &["--arrangement", "single, DB, DF, DT"],
    );
    refused(
        &["--preload", "65 N"],
        &["--preload", "single bearing", "DB or DF"],
    );
    refused(
        &["--arrangement", "DT", "--preload", "65 N"],
        &["--preload", "tandem"],
    );
    refused(
        &["--arrangement", "DB", "--offset=-2 um"],
        &["--offset", "unloaded at rest"],
    );
    refused(
        &["--arrangement", "DB", "--preload", "0 N"],
        &["--preload", "unloaded at rest"],
    );
    refused(
        &[
            "--arrangement",
            "DB",
            "--preload",
            "65 N",
            "--offset",
            "2 um",
        ],
        &["both"],
    );
    refused(
        &["--axial", "1 N", "--clearance", "0.9 mm"],
        &["AB0204", "--clearance"],
    );
    refused(
        &[
            "--axial",
            "1 N",
            "--clearance",
            "1 um",
            "--contact-angle",
            "9 deg",
        ],
        &["both"],
    );
    refused(
        &["--axial", "1 N", "--race-control", "orc"],
        &["--race-control", "half, outer"],
    );
    refused(&["--axial", "1e8 N"], &["loads and speed"]);
    call(&place, &["6o05", "--axial", "1 N"]).refused(&["\"6o05\"", "\"6005\""]);
}

/// Rounding in the places of balls is no imbalance: at rest each of these has an equilibrium, and the spring its preload and a little more.
#[test]
fn a_spring_balances_its_rows_at_rest_under_any_load() {
    let place = Place::new();
    for name in ["7010 C DB", "7010 AC DB", "7007 C DB"] {
        for axial in [100.0, 200.0, 500.0, 1000.0, -200.0, -1000.0] {
            let axial = format!("--axial={axial} N");
            let words = [
                name,
                "--preload",
                "240 N",
                "--preload-spring",
                "1e6 N/m",
                &axial,
            ];
            let found = json(&place, &words);
            let force = found["spring_force"].as_f64().unwrap();
            assert!((200.0..1100.0).contains(&force), "{name} {axial}: {force}");
        }
    }
}
