//! Lubricants beyond the temperatures that their viscosity is known near.

use auxbear::outcome::{Outcome, Value};
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::sync::atomic::AtomicBool;

fn ran_of(text: &str, sets: &[&str]) -> Outcome {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    let scenario = Scenario::parse(text, "a.toml", &sets, &BuiltIn).unwrap();
    let never = AtomicBool::new(false);
    run(&scenario, &Options::unwatched(&never)).unwrap()
}

/// The first of the shipped drop.
fn ran(sets: &[&str]) -> Outcome {
    let shipped = include_str!("../../../scenarios/drop_until_standstill.toml");
    let common = ["run.until=duration", "run.duration=0.3 s"];
    ran_of(shipped, &[&common[..], sets].concat())
}

fn told<'a>(outcome: &'a Outcome, code: &str) -> Vec<&'a str> {
    let found = outcome
        .warnings
        .iter()
        .filter(|warning| warning.code == code);
    found.map(|warning| warning.text.as_str()).collect()
}

#[test]
fn an_oil_beyond_its_data_is_drawn_on_and_told_once() {
    // sure from 20 to 40 °C: the oil leaves that in the coast-down, and not before
    let near = "bearing.moment.viscosity_points=[[\"25 degC\", \"45 mm^2/s\"], [\"35 degC\", \"28 mm^2/s\"]]";
    assert!(told(&ran(&[near]), "AB2313").is_empty());
    let until = ["run.until=standstill", "run.duration=1 s", near];
    let found = ran(&until);
    assert_eq!(found.stop.reason, "finished");
    let list = told(&found, "AB2313");
    assert_eq!(list.len(), 1, "{list:?}");
    let told_time: f64 = (list[0]
        .split("from ")
        .nth(1)
        .unwrap()
        .split(' ')
        .next()
        .unwrap())
    .parse()
    .unwrap();
    let of = |name: &str| match &found.quantity(name).unwrap().value {
        Value::List(values) => values.clone(),
        other => panic!("{name}: {other:?}"),
    };
    let (times, oil) = (
        of("coast_down.over_time.time"),
        of("coast_down.over_time.lubricant.temperature"),
    );
    let first = oil.iter().position(|kelvin| *kelvin > 313.15).unwrap();
    assert!(
        list[0].contains("extrapolated from") && (told_time - times[first]).abs() <= 0.06,
        "{}",
        list[0]
    );
    // where all of it is beyond from the start on, in a drop and in a spin-up
    let far = near.replace("25 deg", "60 deg").replace("35 deg", "70 deg");
    let drop = ran(&[&far]);
    let [text] = told(&drop, "AB2313")[..] else {
        panic!()
    };
    assert!(
        text.contains("from the start on") && text.contains("(55 to 75 °C)"),
        "{text}"
    );
    // a run that does not follow temperatures says it of its one temperature, and of no other
    let cold = [
        &far,
        "heat.network=off",
        "bearing.moment.temperature=30 degC",
    ];
    let cold = ran(&cold.map(|set| set as &str));
    let [text] = told(&cold, "AB2313")[..] else {
        panic!()
    };
    assert!(
        text.contains("bearing.moment.temperature: ") && text.contains("30 °C is 25 K beyond"),
        "{text}"
    );
}

#[test]
fn a_run_out_ends_where_the_law_of_its_oil_ends() {
    let text = include_str!("../../../scenarios/coast_down_closing.toml");
    let thin = "bearing.moment.viscosity_points=[[\"15 degC\", \"0.30 mm^2/s\"], [\"26 degC\", \"0.215 mm^2/s\"]]";
    let found = ran_of(text, &[thin]);
    assert_eq!(found.stop.reason, "left the model");
    assert!(
        found.stop.text.contains("0.21 mm²/s"),
        "{}",
        found.stop.text
    );
}
