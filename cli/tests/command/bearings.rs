//! `auxbear bearings`.

use crate::place::{Called, Place};
use std::fs;

fn call(place: &Place, words: &[&str]) -> Called {
    let mut all = vec!["bearings"];
    all.extend(words);
    place.call(&all)
}

const OWN: &str = "format = \"auxbear.bearings/1\"\n\n[[bearing]]\nname = \"6005\"\nbore_diameter = \"25 mm\"\nball_count = 11\n";

#[test]
fn the_list_is_a_table_with_units() {
    let place = Place::new();
    let list = call(&place, &["list"]).done().out;
    let lines: Vec<&str> = list.lines().collect();
    assert!(lines.len() > 450);
    assert!(lines.iter().all(|line| line.chars().count() <= 100));
    assert!(lines[0].starts_with("name ") && lines[1].contains("mm"));
    let row = lines.iter().find(|line| line.starts_with("6203 ")).unwrap();
    let cells: Vec<&str> = row
        .split("  ")
        .map(str::trim)
        .filter(|cell| !cell.is_empty())
        .collect();
    assert_eq!(
        cells,
        [
            "6203",
            "deep groove",
            "17",
            "40",
            "12",
            "8 x 6.747",
            "4.75",
            "24000",
            "3"
        ]
    );
}

#[test]
fn the_list_can_be_narrowed() {
    let place = Place::new();
    let words = [
        "list",
        "--bore",
        "25 mm",
        "--type",
        "deep groove",
        "--speed",
        "26000 rpm",
    ];
    let list = call(&place, &words).done().out;
    let names: Vec<&str> = list
        .lines()
        .skip(2)
        .map(|line| line.split("  ").next().unwrap())
        .collect();
    assert_eq!(names, ["6005 hybrid", "6205 hybrid"]);
    let none = call(&place, &["list", "--bore", "1 m"]).done().out;
    assert_eq!(none, "no bearing of the catalogue is like that\n");
    for (words, parts) in [
        (
            ["list", "--bore", "25"],
            ["--bore", "Did you mean \"25 mm\"?"],
        ),
        (["list", "--bore", "25 kg"], ["mass", "e.g. \"25 mm\""]),
        (
            ["list", "--bore", "3 cm..2 cm"],
            ["range", "\"20 mm..30 mm\""],
        ),
        (["list", "--speed", "2 m"], ["length", "e.g. \"20000 rpm\""]),
        (
            ["list", "--type", "deep grove"],
            ["--type", "Did you mean \"deep groove\"?"],
        ),
        (
            ["list", "--material", "ceramic"],
            ["\"ceramic\"", "\"silicon nitride\""],
        ),
    ] {
        call(&place, &words).refused(&parts);
    }
}

#[test]
fn a_bearing_is_shown_with_the_source_of_each_number() {
    let place = Place::new();
    let shown = call(&place, &["show", "6005"]).done().out;
    assert!(shown.contains("\n3 of 18 values are assumed\n"), "{shown}");
    let row = |key: &str| {
        let row = shown.lines().find(|line| line.starts_with(key));
        row.unwrap_or_else(|| panic!("no {key} in {shown}"))
    };
    assert!(row("bore_diameter").contains("25 mm"));
    assert!(row("bore_diameter").contains("catalogue  SKF"));
    assert!(row("inner_groove_curvature").contains("assumed"));
    assert!(row("pitch_diameter").contains("derived"));
    // all marks stand in one column
    let column = |key: &str, mark: &str| row(key).find(mark).unwrap();
    assert_eq!(
        column("bore_diameter", "catalogue"),
        column("pitch_diameter", "derived")
    );
    let hybrid = call(&place, &["show", "6005", "hybrid"]).done();
    assert!(hybrid.out.contains("silicon nitride"));
    let sealed = call(&place, &["show", "6205-2RS"]).done();
    assert!(
        sealed.out.starts_with("6205: deep groove"),
        "{}",
        sealed.out
    );
    assert!(sealed.err.contains("2RS, seals"), "{}", sealed.err);
    call(&place, &["show", "71910"]).refused(&["AB0201", "\"SNFA SEB 50\"", "25deg"]);
    call(&place, &["show", "6o05"]).refused(&["\"6o05\"", "\"6005\"", "bearings list"]);
}

#[test]
fn a_file_adds_and_replaces_and_says_so() {
    let place = Place::new();
    fs::write(place.path("own.toml"), OWN).unwrap();
    let shown = call(&place, &["show", "6005", "--catalogue", "own.toml"])
        .done()
        .out;
    assert!(
        shown.starts_with("6005\nfrom own.toml, in place of the built-in bearing of this name\n")
    );
    assert!(shown.contains("given in own.toml"));
    let list = call(
        &place,
        &["list", "--catalogue", "own.toml", "--bore", "25 mm"],
    )
    .done()
    .out;
    // The type of the file's own bearing is not known.
    let own = list.lines().find(|line| line.starts_with("6005 ")).unwrap();
    assert_eq!(own.split_whitespace().nth(1), Some("-"));
    fs::write(place.path("wrong.toml"), OWN.replace("25 mm", "25 kg")).unwrap();
    call(&place, &["list", "--catalogue", "wrong.toml"]).refused(&[
        "wrong.toml:5",
        "bearing.bore_diameter",
        "mass",
        "length",
    ]);
    call(&place, &["list", "--catalogue", "none.toml"]).refused(&["none.toml", "no file"]);
}

#[test]
fn json_is_for_programs() {
    let place = Place::new();
    let json = call(&place, &["show", "6203", "--json"]).done().out;
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let bearing = &json["bearings"][0];
    assert_eq!(bearing["name"], "6203");
    assert_eq!(bearing["values"]["ball_count"]["value"], 8.0);
    assert_eq!(bearing["values"]["ball_count"]["mark"], "derived");
    let json = call(&place, &["list", "--json", "--bore", "17 mm..20 mm"])
        .done()
        .out;
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert!(json["bearings"].as_array().unwrap().len() > 20);
}
