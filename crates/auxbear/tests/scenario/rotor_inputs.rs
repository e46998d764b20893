//! What the file of a rotor leaves out: defaults that fit the rotor, materials by name, and messages that say what to give.

use auxbear::outcome::Outcome;
use auxbear::run::{Options, build, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::sync::atomic::AtomicBool;

/// A short stiff shaft: five of its modes oscillate.
const SHORT: &str = r#"format = "auxbear.scenario/1"
system = "rotor"
[rotor]
speed = "1000 rpm"
[[rotor.section]]
length = "20 mm"
outer_diameter = "40 mm"
material = "titanium"
elements = 1
"#;

fn parsed(text: &str, sets: &[&str]) -> Result<Scenario, String> {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_string()).collect();
    Scenario::parse(text, "rotor.toml", &sets, &BuiltIn).map_err(|problem| problem.to_string())
}

fn analysed(scenario: &Scenario) -> Outcome {
    run(scenario, &Options::unwatched(&AtomicBool::new(false))).unwrap()
}

fn shipped(name: &str) -> String {
    let path = format!("{}/../../scenarios/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).unwrap()
}

fn modes(outcome: &Outcome) -> usize {
    let of_mode = |name: &str| name.starts_with("mode_") && name.ends_with(".frequency");
    outcome
        .quantities
        .iter()
        .filter(|q| of_mode(&q.name))
        .count()
}

#[test]
fn a_default_of_more_modes_than_there_are_shows_all() {
    let outcome = analysed(&parsed(SHORT, &[]).unwrap());
    assert_eq!(modes(&outcome), 5);
    let told = outcome
        .warnings
        .iter()
        .find(|w| w.code == "AB2025")
        .unwrap();
    assert!(told.text.starts_with("5 modes"), "{}", told.text);
}

#[test]
fn more_modes_than_there_are_asked_for_by_hand_are_refused() {
    let scenario = parsed(SHORT, &["analysis.modes=6"]).unwrap();
    let told = build(&scenario).map(|_| ()).unwrap_err().to_string();
    assert!(
        told.contains("AB2003") && told.contains("at most 5"),
        "{told}"
    );
    let outcome = analysed(&parsed(SHORT, &["analysis.modes=5"]).unwrap());
    assert_eq!(modes(&outcome), 5);
    assert!(outcome.warnings.iter().all(|w| w.code != "AB2025"));
}

/// A run-up begins at standstill: 1.5 times that is no range of speeds.
#[test]
fn the_rotor_of_a_run_up_is_looked_at_up_to_the_speed_of_its_drive() {
    let rotor = |sets: &[&str]| {
        let machine = parsed(&shipped("machine_run_up.toml"), sets).unwrap();
        machine
            .rotor_alone()
            .unwrap()
            .map_err(|problem| problem.to_string())
    };
    let given = |sets: &[&str]| {
        rotor(sets)
            .unwrap()
            .resolved
            .get("analysis.speed_to")
            .unwrap()
            .clone()
    };
    let by_drive = given(&[]);
    assert_eq!(by_drive.text.as_deref(), Some("20000 rpm"));
    assert!(by_drive.provenance.note().contains("torque_over_speed"));
    assert_eq!(
        given(&["analysis.speed_to=9000 rpm"]).text.as_deref(),
        Some("9000 rpm")
    );
    assert_eq!(given(&["rotor.speed=9000 rpm"]).text, None);
    assert!(analysed(&rotor(&[]).unwrap()).stop.complete());
}

#[test]
fn a_rotor_at_standstill_says_how_to_give_the_highest_speed() {
    let told = parsed(&SHORT.replace("1000 rpm", "0 rpm"), &[]).unwrap_err();
    assert!(
        told.contains("analysis.speed_to") && told.contains("--set analysis.speed_to="),
        "{told}"
    );
}

#[test]
fn operating_speeds_that_are_none_say_what_was_found() {
    let told = parsed(SHORT, &["analysis.operating_from=20000 rpm"]).unwrap_err();
    assert!(
        told.contains("operating_to: found 104.7") && told.contains("by its default"),
        "{told}"
    );
}

/// Numbers of materials known by name stand in the resolved file with unit and source, and give the same rotor.
#[test]
fn materials_known_by_name_are_shown_with_their_numbers() {
    for (name, young, poisson, density, source) in auxbear::physics::shaft::MATERIALS {
        let scenario = parsed(&SHORT.replace("titanium", name), &[]).unwrap();
        let text = scenario.resolved.toml();
        for (key, value) in [
            ("youngs_modulus", format!("\"{} GPa\"", young / 1e9)),
            ("poisson_ratio", format!("{poisson}")),
            ("density", format!("\"{density} kg/m^3\"")),
        ] {
            let line = format!("{key} = {{ value = {value}, source = \"{source}\" }}");
            assert!(text.contains(&line), "{line}\n{text}");
        }
        let again = parsed(&text, &[]).unwrap();
        assert_eq!(again.system, scenario.system, "{name}");
        let auxbear::scenario::System::Rotor(analysis) = &scenario.system else {
            panic!("a rotor");
        };
        let built = analysis.rotor.pieces[0].layer.material;
        assert_eq!(built, rotor::Material::new(young, poisson, density));
    }
    // what is not used is not shown, and what the file gives counts
    let text = parsed(SHORT, &[]).unwrap().resolved.toml();
    assert!(!text.contains("nickel_alloy"));
    let own = "[[rotor.material]]\nname = \"titanium\"\nyoungs_modulus = \"110 GPa\"\ndensity = \"4500 kg/m^3\"\n";
    let text = parsed(&format!("{SHORT}{own}"), &[])
        .unwrap()
        .resolved
        .toml();
    assert!(
        text.contains("110 GPa") && !text.contains("114 GPa"),
        "{text}"
    );
}

#[test]
fn the_guide_has_the_table_of_materials() {
    let guide = include_str!("../../../../book/src/guide/rotor.md");
    for (name, young, poisson, density, source) in auxbear::physics::shaft::MATERIALS {
        let row = format!(
            "| {name} | {} GPa | {poisson:.2} | {density} kg/m³ | {source} |",
            young / 1e9
        );
        assert!(guide.contains(&row), "{row}");
    }
}

#[test]
fn a_machine_without_auxiliary_bearings_names_their_table() {
    let text = shipped("machine_run_up.toml");
    let before = text.split("[contact]").next().unwrap();
    let told = parsed(before, &[]).unwrap_err();
    assert!(
        told.contains("[[auxiliary_bearing]]") && told.contains("contact.node"),
        "{told}"
    );
}

#[test]
fn a_grade_scales_the_unbalances_of_all_planes_together() {
    let text = shipped("rotor_overhung.toml");
    let number = |outcome: &Outcome, name: &str| {
        let found = outcome.quantity(name);
        match found.unwrap_or_else(|| panic!("{name}")).value {
            auxbear::outcome::Value::Number(number) => number,
            ref other => panic!("{name}: {other:?}"),
        }
    };
    let given = parsed(&text, &[]).unwrap();
    let auxbear::scenario::System::Rotor(rotor) = &given.system else {
        panic!("it is a rotor");
    };
    let sum: f64 = rotor.rotor.unbalance.iter().map(|plane| plane.amount).sum();
    let (plain, graded) = (
        analysed(&given),
        analysed(&parsed(&text, &["rotor.balance_grade=6.3 mm/s"]).unwrap()),
    );
    // Σ|U| Ω/m = G, and a linear response goes with the unbalance
    let factor = 6.3e-3 * number(&plain, "mass") / (rotor.speed * sum);
    for name in [
        "response.wheel.rated_amplitude",
        "force.wheel_end.rated_amplitude",
    ] {
        let ratio = number(&graded, name) / number(&plain, name);
        assert!(
            (ratio / factor - 1.0).abs() < 1e-9,
            "{name}: {ratio} {factor}"
        );
    }
    let told = parsed(SHORT, &["rotor.balance_grade=6.3 mm/s"]).unwrap_err();
    assert!(told.contains("[[rotor.unbalance]]"), "{told}");
}
