//! Dry backward whirl of machines: the linear analysis of their files, and runs of them.

use auxbear::outcome::Value;
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use auxbear::{Outcome, Severity};
use std::sync::atomic::AtomicBool;

const WHIRLS: &str = include_str!("../../../scenarios/machine_dry_whirl.toml");
/// The mount that its description names.
const CURE: [&str; 2] = ["mount.stiffness=8e5 N/m", "mount.damping=2000 N s/m"];

fn scenario(text: &str, sets: &[&str]) -> Scenario {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    Scenario::parse(text, "machine.toml", &sets, &BuiltIn).unwrap()
}

/// The analysis with short diagrams, which take most of its time: whirl is looked at at one speed.
fn analysed(text: &str, sets: &[&str]) -> Outcome {
    let sets = [&["analysis.speed_count=11"], sets].concat();
    let rotor = scenario(text, &sets).rotor_alone().unwrap().unwrap();
    run(&rotor, &Options::unwatched(&AtomicBool::new(false))).unwrap()
}

fn ran(text: &str, sets: &[&str]) -> Outcome {
    let own = scenario(text, sets);
    run(&own, &Options::unwatched(&AtomicBool::new(false))).unwrap()
}

fn number(outcome: &Outcome, name: &str) -> f64 {
    outcome.number(name).unwrap_or_else(|| panic!("{name}"))
}

/// The run reaches the force that the analysis predicts, and the mount of the description ends both.
#[test]
fn shipped_machine_whirls_as_its_analysis_says_and_its_cure_ends_it() {
    let found = analysed(WHIRLS, &[]);
    let force = number(&found, "whirl.drive_end.settling_force");
    let grave = |own: &Outcome| {
        own.warnings
            .iter()
            .any(|w| w.code == "AB2044" && w.severity == Severity::Destroys)
    };
    assert!(grave(&found));
    let drop = ran(WHIRLS, &[]);
    assert!(number(&drop, "drive_end.whirl_turns") < -25.0);
    // at the end of the run it still rises to it
    let peak = number(&drop, "drive_end.peak_contact_force");
    assert!((0.95..1.02).contains(&(peak / force)), "{peak} {force}");
    let cured = analysed(WHIRLS, &CURE);
    assert!(!grave(&cured));
    assert!((number(&cured, "whirl.drive_end.needed_friction") - 0.653).abs() < 0.001);
    let drop = ran(WHIRLS, &CURE);
    assert!(number(&drop, "drive_end.whirl_turns").abs() < 0.5);
}

/// The ends of the curve: the weight, the frequency asked for, and without gravity a minimum that says where it lies.
#[test]
fn ends_of_the_curve_are_named() {
    let found = analysed(WHIRLS, &["analysis.whirl_to=2000 rad/s"]);
    let weight = (9.81_f64 / 2e-4).sqrt();
    let from = number(&found, "whirl.drive_end.frequency_from");
    assert!((from / weight - 1.0).abs() < 1e-12);
    assert_eq!(number(&found, "whirl.drive_end.frequency_to"), 2000.0);
    let place = |own: &Outcome| match &own
        .quantity("whirl.drive_end.needed_friction_place")
        .unwrap()
        .value
    {
        Value::Text(text) => text.clone(),
        other => panic!("{other:?}"),
    };
    assert!(place(&found).starts_with("lower end: slower whirl"));
    let vertical = analysed(WHIRLS, &["gravity.acceleration=0 m/s^2"]);
    assert_eq!(place(&vertical), "lower end of the frequencies");
    // a rotor that turns the other way whirls the other way, by the same numbers
    let mirrored = analysed(WHIRLS, &["rotor.speed=-12000 rpm"]);
    let name = "whirl.other_end.settling_frequency";
    let [one, other] = [&analysed(WHIRLS, &[]), &mirrored].map(|own| number(own, name));
    assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
}

/// Parts that are not linear are named; a held race has no mount to cure; a rotor alone has no bearings.
#[test]
fn what_the_analysis_leaves_out_is_named() {
    let expander = include_str!("../../../scenarios/machine_expander.toml");
    let found = analysed(expander, &[]);
    let told = |code: &str| found.warnings.iter().filter(|own| own.code == code).count();
    assert_eq!([told("AB2045"), told("AB2048")], [2, 1]);
    let held = analysed(expander, &["bearing.inner_race_centre_held=true"]);
    let why = held
        .quantity("whirl.wheel_end.needed_damping")
        .unwrap()
        .value
        .why_absent();
    assert_eq!(why, Some("the inner race is held: no mount acts"));
    let alone = include_str!("../../../scenarios/rotor_overhung.toml");
    assert!(
        ran(alone, &[])
            .quantities
            .iter()
            .all(|own| !own.name.starts_with("whirl."))
    );
}

/// Two rows whirl as one of twice the stiffness, damping, mass and contact: each with half of its force.
#[test]
fn two_rows_whirl_as_one_of_twice_the_mount() {
    let to = "analysis.whirl_to=3000 rad/s";
    let rows = analysed(WHIRLS, &[to, "planes=2"]);
    let twice = [
        to,
        "mount.stiffness=2e7 N/m",
        "mount.damping=1000 N s/m",
        "mount.moving_mass=1 kg",
        "contact.stiffness=1e9 N/m^(10/9)",
    ];
    let one = analysed(WHIRLS, &twice);
    for (name, share) in [
        ("needed_friction", 1.0),
        ("settling_frequency", 1.0),
        ("settling_force", 0.5),
    ] {
        let name = format!("whirl.drive_end.{name}");
        let [ours, expected] = [&rows, &one].map(|own| number(own, &name));
        assert!((ours / (share * expected) - 1.0).abs() < 1e-6, "{name}");
    }
}

/// More damping than helps locks the mount: the range that prevents whirl lies below what the mount has, and the warning says both.
#[test]
fn too_much_damping_is_told_as_such() {
    let locked = ["mount.stiffness=8e5 N/m", "mount.damping=6e4 N s/m"];
    let found = analysed(WHIRLS, &locked);
    let most = number(&found, "whirl.drive_end.largest_damping");
    assert!((2e3..2e4).contains(&most), "{most}");
    let told = found.warnings.iter().find(|own| own.code == "AB2044");
    let text = told.unwrap().text.clone();
    assert!(text.contains("the mount has 6.000e4 N s/m"), "{text}");
    // the inertia of the race may carry faster whirl, and the analysis says how far it looked
    assert!(found.warnings.iter().any(|own| own.code == "AB2047"));
}
