//! A flexible rotor: its tables, what is refused, what an analysis finds.

pub(super) use crate::outcomes::number;
use auxbear::outcome::{Outcome, Value};
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario, System};
use std::sync::atomic::AtomicBool;

/// Rotor 5.9.1 of Friswell, Penny, Garvey, Lees, Dynamics of Rotating Machines (2010), as the ROSS project has it.
const ROTOR: &str = r#"format = "auxbear.scenario/1"
system = "rotor"
[rotor]
speed = "4000 rpm"
[analysis]
speed_to = "9550 rpm"
modes = 4
[[rotor.material]]
name = "book_steel"
youngs_modulus = "211 GPa"
shear_modulus = "81.2 GPa"
density = "7810 kg/m^3"
[[rotor.section]]
length = "1.5 m"
outer_diameter = "50 mm"
material = "book_steel"
elements = 6
[[rotor.disk]]
name = "one"
at = "0.5 m"
width = "70 mm"
outer_diameter = "280 mm"
inner_diameter = "50 mm"
material = "book_steel"
[[rotor.disk]]
name = "two"
at = "1 m"
width = "70 mm"
outer_diameter = "350 mm"
inner_diameter = "50 mm"
material = "book_steel"
[[rotor.support]]
at = "0 m"
stiffness = "1 MN/m"
[[rotor.support]]
at = "1.5 m"
stiffness = "1 MN/m"
"#;

pub(super) fn parsed(text: &str, sets: &[&str]) -> Result<Scenario, String> {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_string()).collect();
    Scenario::parse(text, "rotor.toml", &sets, &BuiltIn).map_err(|problem| problem.to_string())
}

/// The message of a rotor with one text in the place of another.
fn message(old: &str, new: &str) -> String {
    assert!(ROTOR.contains(old), "{old}");
    let text = ROTOR.replacen(old, new, 1);
    let built = parsed(&text, &[]).and_then(|scenario| {
        let built = auxbear::run::build(&scenario);
        built.map(|_| ()).map_err(|problem| problem.to_string())
    });
    built.expect_err(new)
}

pub(super) fn analysed(text: &str, sets: &[&str]) -> Outcome {
    let scenario = parsed(text, sets).unwrap();
    run(&scenario, &Options::unwatched(&AtomicBool::new(false))).unwrap()
}

pub(super) fn value(outcome: &Outcome, name: &str) -> Value {
    let found = outcome.quantity(name);
    found.unwrap_or_else(|| panic!("{name}")).value.clone()
}

/// The book prints 85.39, 87.80, 251.78 and 294.71 rad/s; six digits are those of ROSS 2.3.0.
#[test]
fn frequencies_and_critical_speeds_are_those_of_the_book() {
    let outcome = analysed(ROTOR, &[]);
    let expected = [85.389467, 87.798, 251.78, 294.71];
    for (number_of_mode, expected) in (1..).zip(expected) {
        let ours = number(&outcome, &format!("mode_{number_of_mode}.frequency"));
        assert!((ours / expected - 1.0).abs() < 5e-5, "{ours} {expected}");
    }
    let Value::List(criticals) = value(&outcome, "critical_speeds") else {
        panic!("a list");
    };
    let expected = [
        86.40781088510448,
        86.90424992843776,
        260.5174968682817,
        288.61681386790144,
    ];
    for (ours, expected) in criticals.iter().zip(expected) {
        assert!((ours / expected - 1.0).abs() < 1e-8, "{ours} {expected}");
    }
    assert_eq!(
        value(&outcome, "mode_1.whirl"),
        Value::Text("backward".to_string())
    );
    assert!((number(&outcome, "mass") / 107.1173374750693 - 1.0).abs() < 1e-12);
    assert!(outcome.stop.complete());
}

#[test]
fn an_override_reaches_a_part_by_name_or_number() {
    let heavier = [
        "rotor.disk.one.width=0.14 m",
        "rotor.support.2.stiffness=2 MN/m",
    ];
    let System::Rotor(changed) = parsed(ROTOR, &heavier).unwrap().system else {
        panic!("a rotor");
    };
    let System::Rotor(plain) = parsed(ROTOR, &[]).unwrap().system else {
        panic!("a rotor");
    };
    let (one, other) = (&changed.rotor, &plain.rotor);
    assert!((one.disks[0].mass / other.disks[0].mass - 2.0).abs() < 1e-12);
    assert_eq!(one.supports[1].coefficients.at(0.0).stiffness[1][1], 2e6);
    assert_eq!(one.supports[0], other.supports[0]);
    let unknown = parsed(ROTOR, &["rotor.disk.three.mass=1 kg"]).unwrap_err();
    assert!(
        unknown.contains("AB0101") && unknown.contains("one, two"),
        "{unknown}"
    );
}

#[test]
fn the_resolved_file_is_the_same_rotor() {
    let scenario = parsed(ROTOR, &["rotor.disk.one.width=0.14 m"]).unwrap();
    let again = parsed(&scenario.resolved.toml(), &[]).unwrap();
    assert_eq!(scenario.system, again.system);
}

#[test]
fn what_cannot_be_a_rotor_is_refused() {
    const SUPPORT: &str = "[[rotor.support]]\nat = \"1.5 m\"\nstiffness = \"1 MN/m\"\n";
    const OVER: &str = "[[rotor.section]]\nname = \"collar\"\nfrom = \"0.2 m\"\nlength = \"0.1 m\"\nouter_diameter = \"80 mm\"\nmaterial = \"steel\"\n";
    for (old, new, wanted) in [
        ("at = \"1 m\"", "at = \"wheel\"", "AB2000"),
        ("at = \"1 m\"", "at = \"1.6 m\"", "beside the shaft"),
        ("elements = 6\n", &format!("elements = 6\n{OVER}"), "AB2001"),
        ("elements = 6", "elements = 900", "at most 500"),
        ("elements = 6", "inner_diameter = \"60 mm\"", "AB2001"),
        (
            "material = \"book_steel\"\nelements",
            "elements",
            "rotor.section.1.material: found no value",
        ),
        (
            "material = \"book_steel\"\nelements",
            "material = \"stel\"\nelements",
            "Did you mean \"steel\"?",
        ),
        (
            "outer_diameter = \"50 mm\"",
            "outer_diameter = \"-50 mm\"",
            "AB0106",
        ),
        (
            "outer_diameter = \"50 mm\"",
            "outer_diameter = 50",
            "AB0103",
        ),
        ("\"81.2 GPa\"", "\"200 GPa\"", "Poisson's ratio"),
        ("modes = 4", "modes = 60", "AB2003"),
        (SUPPORT, "", "AB2004"),
        ("width = \"70 mm\"\n", "", "a disk without width"),
        (
            "width = \"70 mm\"\n",
            "mass = \"3 kg\"\npolar_inertia = \"0.1 kg m^2\"\ndiametral_inertia = \"0.04 kg m^2\"\n",
            "no body has more than twice",
        ),
        ("name = \"two\"", "name = \"one\"", "AB0109"),
        (
            "length = \"1.5 m\"",
            "lenght = \"1.5 m\"",
            "Did you mean \"length\"?",
        ),
        (
            SUPPORT,
            &SUPPORT.replace("stiffness", "on = \"floor\"\nstiffness"),
            "the file has none",
        ),
        (
            SUPPORT,
            &SUPPORT.replace("\"1 MN/m\"", "[\"1 MN/m\", \"2 MN/m\"]"),
            "or speeds as well",
        ),
        (
            SUPPORT,
            &SUPPORT.replace("stiffness", "speeds = [\"9 rpm\", \"5 rpm\"]\nstiffness"),
            "AB0114",
        ),
        (
            "[[rotor.disk]]\nname = \"one\"",
            "[rotor.mass]\nname = \"one\"",
            "tables [[rotor.mass]] are needed",
        ),
    ] {
        let told = message(old, new);
        assert!(told.contains(wanted), "{new}: {told}");
    }
    let of_drop = ROTOR.replace("system = \"rotor\"", "system = \"drop\"");
    let told = parsed(&of_drop, &[]).unwrap_err();
    assert!(told.contains("AB0110"), "{told}");
    let unbalanced = ROTOR.split("[[rotor.support]]").next().unwrap();
    let unbalanced =
        format!("{unbalanced}[[rotor.unbalance]]\nat = \"1 m\"\namount = \"1 g mm\"\n");
    let scenario = parsed(&unbalanced, &[]).unwrap();
    let told = auxbear::run::build(&scenario)
        .map(|_| ())
        .unwrap_err()
        .to_string();
    assert!(
        told.contains("AB2004") && told.contains("unbalance"),
        "{told}"
    );
}

#[test]
fn a_free_rotor_has_modes_and_says_what_it_has_not() {
    let free = ROTOR.split("[[rotor.support]]").next().unwrap();
    let outcome = analysed(free, &[]);
    assert!(
        outcome
            .warnings
            .iter()
            .any(|warning| warning.code == "AB2023")
    );
    assert!(matches!(value(&outcome, "largest_sag"), Value::None { .. }));
    assert!(number(&outcome, "mode_1.frequency") > 0.0);
}

#[test]
fn a_margin_gives_each_critical_speed_its_verdict() {
    let sets = ["analysis.separation_margin=0.2", "rotor.speed=2700 rpm"];
    let outcome = analysed(ROTOR, &sets);
    // 282.7 rad/s: the forward ones at 86.9 and 288.6 rad/s are far and near, backward ones are not excited
    assert_eq!(
        value(&outcome, "separation_verdict"),
        Value::Text("fail".to_string())
    );
    let verdicts: Vec<Value> = (1..=4)
        .map(|k| value(&outcome, &format!("critical_{k}.verdict")))
        .collect();
    let words = ["no excitation", "pass", "no excitation", "fail"];
    assert_eq!(verdicts, words.map(|word| Value::Text(word.to_string())));
    let separation = number(&outcome, "critical_4.separation");
    let speed = 2700.0 * std::f64::consts::PI / 30.0;
    assert!((separation - (288.61681386790144 / speed - 1.0)).abs() < 1e-8);
}

/// What a narrow search around a peak finds, the whole range finds as well: a peak is not as low as its nearest sampled speeds.
#[test]
fn a_peak_is_the_largest_response_whatever_the_speeds_of_the_diagram() {
    let unbalance = "[[rotor.unbalance]]\nat = \"0.5 m\"\namount = \"10 g mm\"\n";
    for (damping, quality) in [("20 N s/m", 300.0), ("2000 N s/m", 3.0)] {
        let damped = format!("stiffness = \"1 MN/m\"\ndamping = \"{damping}\"\n");
        let text = ROTOR.replace("stiffness = \"1 MN/m\"\n", &damped) + unbalance;
        let whole = analysed(&text, &["analysis.speed_to=1400 rpm"]);
        let speed = number(&whole, "response.one.peak_speed");
        let largest = number(&whole, "response.one.peak_amplitude");
        // by itself, around that speed
        let (from, to) = (0.9999 * speed, 1.0001 * speed);
        let near = [
            &format!("analysis.speed_from={from} rad/s") as &str,
            &format!("analysis.speed_to={to} rad/s"),
        ];
        let found = number(&analysed(&text, &near), "response.one.peak_amplitude");
        assert!(
            (found / largest - 1.0).abs() < 1e-7,
            "{damping}: {found} {largest}"
        );
        assert!(number(&whole, "critical_2.amplification") > quality);
    }
    // nothing bounds it without damping
    let whole = analysed(&(ROTOR.to_string() + unbalance), &[]);
    let Value::None { why } = value(&whole, "response.one.peak_amplitude") else {
        panic!("a number");
    };
    assert!(why.contains("has no damping"), "{why}");
}

#[test]
fn a_critical_speed_at_which_the_mode_grows_has_no_margin() {
    let crossed =
        "stiffness = \"1 MN/m\"\nstiffness_xy = \"0.1 MN/m\"\nstiffness_yx = \"-0.1 MN/m\"\n";
    let text = ROTOR.replace("stiffness = \"1 MN/m\"\n", crossed);
    let found = analysed(&text, &["analysis.separation_margin=0.001"]);
    let Value::None { why } = value(&found, "critical_2.amplification") else {
        panic!("it is damped");
    };
    assert_eq!(why, "the mode grows");
    let word = |name: &str| match value(&found, name) {
        Value::Text(word) => word,
        other => panic!("{other:?}"),
    };
    assert_eq!(word("critical_2.verdict"), "grows");
    assert_eq!(word("separation_verdict"), "fail");
}
