//! A user's file of bearings: what it adds and replaces, and the one message for everything that can be wrong with it.

use auxbear::catalogue::{Catalogue, Filter, FilterTexts, Mark, Origin, bearings, to_json};
use auxbear::problem::{Code, Problem};
use auxbear::scenario::BearingSource;
use std::path::Path;

const GOOD: &str = r#"format = "auxbear.bearings/1"

[sources]
maker = "Maker's catalogue 2024, p. 12"

[[bearing]]
name = "my 6205"
type = "deep groove"
bore_diameter = { value = "25 mm", catalogue = "maker" }
outer_diameter = { value = "52 mm", catalogue = "maker" }
width = "15 mm"
ball_count = 9
ball_diameter = { value = "7.938 mm", assumed = "as other makers" }
ball_material = "silicon nitride"
static_load_rating = "7.8 kN"
inner_groove_curvature = 0.52

[[bearing]]
name = "6005"
bore_diameter = "25 mm"
ball_count = 11

[[family]]
name = "mine {size}"
description = "bore {bore_diameter}"
type = "angular contact"
columns = [
  { note = "size" },
  { key = "bore_diameter", unit = "mm", catalogue = "maker" },
  { key = "ball_count", derived = "counted on {size}" },
]
rows = [["A", 25, 9], ["B", "1 in", { value = 10, assumed = "as A" }]]
"#;

fn catalogue() -> Catalogue {
    Catalogue::with_text(GOOD, "mine.toml").unwrap()
}

/// The good file with one part replaced.
fn refused(from: &str, to: &str) -> Problem {
    assert!(GOOD.contains(from), "{from}");
    let text = GOOD.replacen(from, to, 1);
    *Catalogue::with_text(&text, "mine.toml").unwrap_err()
}

#[track_caller]
fn assert_refused(from: &str, to: &str, code: Code, parts: &[&str]) {
    let problem = refused(from, to);
    assert_eq!(problem.code, code, "{problem}");
    let text = problem.to_string();
    assert!(text.contains("mine.toml"), "{text}");
    for part in parts {
        assert!(text.contains(part), "{part} in {text}");
    }
}

#[test]
fn a_file_adds_and_replaces() {
    let catalogue = catalogue();
    assert_eq!(catalogue.iter().count(), bearings().len() + 3);
    assert_eq!(
        catalogue.names()[..4],
        ["my 6205", "6005", "mine A", "mine B"]
    );
    let origin = |name: &str| catalogue.find(name).unwrap().origin.clone();
    let from_file = |replaces_built_in| Origin::File {
        file: "mine.toml".to_string(),
        replaces_built_in,
    };
    assert_eq!(origin("My 6205"), from_file(false));
    assert_eq!(origin("6005"), from_file(true));
    assert_eq!(origin("6205"), Origin::BuiltIn);
    // A replaced bearing is replaced as a whole.
    let own = catalogue.find("6005").unwrap();
    assert_eq!(own.number("ball_count"), Some(11.0));
    assert_eq!(own.number("static_load_rating"), None);
    let same_name = catalogue.iter().filter(|bearing| bearing.name == "6005");
    assert_eq!(same_name.count(), 1);
}

#[test]
fn values_carry_their_marks() {
    let catalogue = catalogue();
    let bearing = catalogue.find("my 6205").unwrap();
    let mark = |key| {
        let value = bearing.value(key).unwrap();
        (value.mark, value.note.as_str())
    };
    assert_eq!(
        mark("bore_diameter"),
        (Mark::Catalogue, "Maker's catalogue 2024, p. 12")
    );
    assert_eq!(mark("ball_diameter"), (Mark::Assumed, "as other makers"));
    assert_eq!(mark("width"), (Mark::Given, "given in mine.toml"));
    assert_eq!(mark("pitch_diameter").0, Mark::Derived);
    // By hand: pitch circle (25 + 52)/2.
    assert_eq!(bearing.value("pitch_diameter").unwrap().text(), "38.5 mm");
    assert_eq!(mark("inner_race_mass").0, Mark::Assumed);
    assert_eq!(bearing.assumed_count(), 6);
}

#[test]
fn families_fill_their_templates() {
    let catalogue = catalogue();
    let bearing = catalogue.find("mine B").unwrap();
    assert_eq!(bearing.description, "bore 1 in");
    // one rounding
    assert!((bearing.number("bore_diameter").unwrap() - 0.0254).abs() < 1e-17);
    let count = bearing.value("ball_count").unwrap();
    assert_eq!((count.mark, count.note.as_str()), (Mark::Assumed, "as A"));
    let bearing = catalogue.find("mine A").unwrap();
    assert_eq!(bearing.value("ball_count").unwrap().note, "counted on A");
    assert_eq!(bearing.word("type"), Some("angular contact"));
}

#[test]
fn scenarios_can_ask_it() {
    let catalogue = catalogue();
    let record = BearingSource::find(&catalogue, "my 6205").unwrap();
    let value = |key: &str| record.values.iter().find(|value| value.0 == key).unwrap().1;
    assert_eq!(value("ball_count"), 9.0);
    assert!(BearingSource::names(&catalogue).contains(&"6203".to_string()));
}

#[test]
fn what_is_no_file_of_bearings_is_refused() {
    let missing = Catalogue::with_file(Path::new("no/such/bearings.toml")).unwrap_err();
    assert_eq!(missing.code, Code::FileMissing);
    let folder = Catalogue::with_file(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap_err();
    assert_eq!(folder.code, Code::FileIsFolder);
    let empty = Catalogue::with_text(" \n", "mine.toml").unwrap_err();
    assert_eq!(empty.code, Code::FileEmpty);
    let first = "format = \"auxbear.bearings/1\"";
    assert_refused(first, "", Code::UnknownFormat, &["format", "found nothing"]);
    assert_refused(
        first,
        "format = \"auxbear.scenario/1\"",
        Code::UnknownFormat,
        &["mine.toml:1", "auxbear.bearings/1"],
    );
    assert_refused(
        first,
        "format = \"auxbear.bearings/9\"",
        Code::UnknownFormat,
        &["newer"],
    );
    assert_refused("[sources]", "[sources", Code::Syntax, &["mine.toml:3"]);
    assert_refused("[[family]]", "[family]", Code::WrongType, &["[[family]]"]);
    assert_refused(
        "[[family]]",
        "[[familie]]",
        Code::UnknownKey,
        &["familie", "\"family\""],
    );
}

#[test]
fn wrong_values_are_refused_where_they_stand() {
    let width = "width = \"15 mm\"";
    for (to, code, parts) in [
        (
            "width = 15",
            Code::BareNumber,
            ["bare number 15", "\"12 mm\""],
        ),
        (
            "width = \"15\"",
            Code::BareNumber,
            ["without a unit", "\"12 mm\""],
        ),
        (
            "width = \"15 kg\"",
            Code::WrongDimension,
            ["mass", "length"],
        ),
        (
            "width = \"15 mmm\"",
            Code::UnreadableQuantity,
            ["\"mmm\"", "length"],
        ),
        (
            "width = \"-15 mm\"",
            Code::OutOfRange,
            ["-15 mm", "above 0"],
        ),
        (
            "width = true",
            Code::WrongType,
            ["the switch true", "length"],
        ),
        (
            "with = \"15 mm\"",
            Code::UnknownKey,
            ["bearing.with", "\"width\""],
        ),
        (
            "width = { assumed = \"x\" }",
            Code::MissingKey,
            ["without value", "value = "],
        ),
        (
            "width = { value = \"15 mm\", asumed = \"x\" }",
            Code::UnknownKey,
            ["asumed", "\"assumed\""],
        ),
        (
            "width = { value = \"15 mm\", assumed = \"x\", derived = \"y\" }",
            Code::Conflict,
            ["two marks", "one of"],
        ),
        (
            "width = { value = \"15 mm\", catalogue = \"makers\" }",
            Code::UnknownWord,
            ["\"makers\"", "\"maker\""],
        ),
    ] {
        assert_refused(width, to, code, &["mine.toml:11", parts[0], parts[1]]);
    }
    assert_refused(
        "ball_count = 9\n",
        "ball_count = 9.5\n",
        Code::WrongType,
        &["mine.toml:12", "9.5"],
    );
    assert_refused(
        "ball_count = 9\n",
        "ball_count = 900\n",
        Code::OutOfRange,
        &["900", "60"],
    );
    assert_refused("0.52", "0.49", Code::OutOfRange, &["0.49", "0.5"]);
    assert_refused(
        "\"silicon nitride\"",
        "\"silikon nitride\"",
        Code::UnknownWord,
        &["silicon nitride"],
    );
    assert_refused(
        "name = \"my 6205\"\n",
        "",
        Code::MissingKey,
        &["mine.toml:6", "name"],
    );
}

#[test]
fn two_bearings_of_one_name_are_refused() {
    let parts = ["mine.toml:18", "\"MY 6205\" once more", "line 6"];
    assert_refused(
        "name = \"6005\"",
        "name = \"MY 6205\"",
        Code::DuplicateBearing,
        &parts,
    );
    assert_refused("[\"B\",", "[\"A\",", Code::DuplicateBearing, &["mine A"]);
}

#[test]
fn wrong_families_are_refused() {
    assert_refused(
        "[\"A\", 25, 9]",
        "[\"A\", 25]",
        Code::WrongType,
        &["a row of 2 values", "3 columns"],
    );
    assert_refused(
        "counted on {size}",
        "counted on {sise}",
        Code::UnknownWord,
        &["{sise}", "\"size\""],
    );
    assert_refused(
        "key = \"ball_count\"",
        "key = \"ball_cont\"",
        Code::UnknownKey,
        &["ball_count"],
    );
    assert_refused(
        "unit = \"mm\"",
        "unit = \"kg\"",
        Code::WrongDimension,
        &["25 kg"],
    );
    assert_refused(", unit = \"mm\"", "", Code::BareNumber, &["bare number 25"]);
    assert_refused(
        "key = \"ball_count\"",
        "key = \"bore_diameter\"",
        Code::Conflict,
        &["second column"],
    );
    assert_refused("rows = [", "row = [", Code::UnknownKey, &["family.row"]);
}

#[test]
fn geometry_that_contradicts_itself_is_refused() {
    let ball = "value = \"7.938 mm\"";
    for (from, to, code, parts) in [
        (
            "\"52 mm\"",
            "\"22 mm\"",
            Code::BearingGeometry,
            ["bore_diameter", "22 mm"],
        ),
        (
            "width = \"15 mm\"",
            "width = \"7 mm\"",
            Code::BearingGeometry,
            ["7.938 mm", "at most width = 7 mm"],
        ),
        (
            "width = \"15 mm\"",
            "width = \"15 mm\"\npitch_diameter = \"24 mm\"",
            Code::BearingGeometry,
            ["25 mm", "pitch_diameter = 24 mm"],
        ),
        (
            "width = \"15 mm\"",
            "width = \"15 mm\"\npitch_diameter = \"53 mm\"",
            Code::BearingGeometry,
            ["53 mm", "outer_diameter = 52 mm"],
        ),
        (
            ball,
            "value = \"14 mm\"",
            Code::BearingGeometry,
            ["14 mm", "less than 13.5 mm"],
        ),
        (
            "ball_count = 9\n",
            "ball_count = 16\n",
            Code::BallsDoNotFit,
            ["16 balls", "at most 15"],
        ),
        (
            "width = \"15 mm\"",
            "width = \"15 mm\"\ninner_shoulder_diameter = \"30 mm\"",
            Code::BearingGeometry,
            ["a shoulder of 30 mm", "30.56 mm"],
        ),
        (
            "\"7.8 kN\"",
            "\"7.8 N\"",
            Code::RatingContradictsBalls,
            ["7.8 N with 9 balls", "1.134 kN"],
        ),
        (
            "\"7.8 kN\"",
            "\"7800 kN\"",
            Code::RatingContradictsBalls,
            ["34.03 kN", "Z D² cos α"],
        ),
        (
            "width = \"15 mm\"",
            "width = \"15 mm\"\nmass = \"13 g\"",
            Code::BearingGeometry,
            ["13 g", "more than"],
        ),
    ] {
        assert_refused(from, to, code, &["my 6205", parts[0], parts[1]]);
    }
}

#[test]
fn a_list_can_be_narrowed() {
    let texts = FilterTexts {
        bore: Some("20 mm..30 mm"),
        speed: Some("30000 rpm"),
        kind: Some("Deep Groove"),
        material: Some("silicon nitride"),
    };
    let filter = Filter::read(&texts, "list").unwrap();
    let names = |filter: &Filter| -> Vec<&str> {
        let wanted = bearings().iter().filter(|bearing| filter.wants(bearing));
        wanted.map(|bearing| bearing.name.as_str()).collect()
    };
    // SKF's table of hybrid bearings: 6004 32000 rpm, 6204 30000 rpm; all larger ones are slower.
    assert_eq!(names(&filter), ["6004 hybrid", "6204 hybrid"]);
    assert_eq!(names(&Filter::default()).len(), bearings().len());
    let open = FilterTexts {
        bore: Some("260 mm.."),
        ..FilterTexts::default()
    };
    let filter = Filter::read(&open, "list").unwrap();
    let expected = [
        "SNFA SEB 260",
        "SNFA SEB 260 25deg",
        "SNFA SEB 280",
        "SNFA SEB 280 25deg",
    ];
    assert_eq!(names(&filter), expected);
}

#[test]
fn json_holds_every_value_with_its_mark() {
    let catalogue = catalogue();
    let text = to_json([catalogue.find("6005").unwrap()]);
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let bearing = &json["bearings"][0];
    assert_eq!(bearing["origin"], "mine.toml");
    assert_eq!(bearing["replaces_built_in"], true);
    let bore = &bearing["values"]["bore_diameter"];
    assert_eq!(bore["value"], 0.025);
    assert_eq!(bore["unit"], "m");
    assert_eq!(bore["text"], "25 mm");
    assert_eq!(bore["mark"], "given");
}
