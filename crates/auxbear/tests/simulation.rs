//! A machine that is driven from outside: without inputs it is its run, with them it does what they say.

use crate::outcomes::number;
use auxbear::scenario::{BuiltIn, Scenario, template};
use auxbear::{Input, Options, build, run};
use std::sync::atomic::AtomicBool;

fn read(text: &str, sets: &[&str]) -> Scenario {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    Scenario::parse(text, "file.toml", &sets, &BuiltIn).unwrap()
}

fn parsed(kind: &str, sets: &[&str]) -> Scenario {
    read(&template(kind).unwrap(), sets)
}

/// A race that a torque spins up under a constant load.
const TORQUE: &str = r#"
format = "auxbear.scenario/1"
system = "spin_up"
drive = { kind = "torque", torque = "0.1 N m", radial_load = "80 N", reference_speed = "3000 rpm" }
bearing = { name = "6005", fidelity = "rolling", operating_diametral_clearance = "10 um", moment.law = "palmgren", moment.lubrication = "grease", moment.viscosity = "100 mm^2/s" }
run = { duration = "20 ms" }
"#;

#[test]
fn driven_without_inputs_it_has_the_bits_of_its_run() {
    let explicit = "run.method=explicit";
    for (kind, sets, channel, result) in [
        (
            "drop",
            &["run.duration=30 ms", explicit][..],
            "rotor.speed",
            "rotor_final_speed",
        ),
        (
            "spin_up",
            &["run.duration=20 ms", explicit],
            "bearing.inner_race.speed",
            "inner_race_final_speed",
        ),
    ] {
        let scenario = parsed(kind, sets);
        let never = AtomicBool::new(false);
        let whole = number(
            &run(&scenario, &Options::unwatched(&never)).unwrap(),
            result,
        );
        let machine = build(&scenario).unwrap();
        let mut driven = machine.simulation().unwrap();
        let stop = driven.advance(f64::INFINITY).unwrap();
        assert!(stop.complete(), "{}", stop.text);
        assert_eq!(driven.value(channel), Some(whole), "{:?}", driven.names());
        // stops end steps: as near as the tolerance
        let mut often = machine.simulation().unwrap();
        let stops = (1..).map(|stop| 1e-4 * f64::from(stop));
        let over = stops
            .map(|until| often.advance(until))
            .find_map(|stop| stop);
        assert!(over.unwrap().complete());
        let speed = often.value(channel).unwrap();
        assert!(
            (speed / whole - 1.0).abs() < 1e-3,
            "{kind}: {speed} {whole}"
        );
    }
}

#[test]
fn a_brake_brakes_from_when_it_is_put_on_until_it_is_taken_off() {
    let braked = [
        "rotor.spin=braked",
        "rotor.brake_torque=2 N m",
        "rotor.brake_start=1 s",
    ];
    let scenario = parsed("drop", &[&braked[..], &["run.duration=4 ms"]].concat());
    let machine = build(&scenario).unwrap();
    let speed = |on: [f64; 2]| {
        let mut driven = machine.simulation().unwrap();
        for (time, brake) in [(on[0], true), (on[1], false)] {
            driven.advance(time);
            driven.change(Input::Brake(brake)).unwrap();
        }
        driven.advance(4e-3);
        driven.value("rotor.speed").unwrap()
    };
    let free = speed([5e-3, 6e-3]);
    let [one, two] = [speed([1e-3, 2e-3]), speed([1e-3, 3e-3])];
    // before it touches nothing else acts on the spin
    assert!(
        one < free && ((free - two) / (free - one) - 2.0).abs() < 1e-6,
        "{free} {one} {two}"
    );
}

#[test]
fn a_load_and_a_torque_act_from_the_stop_on() {
    let scenario = read(TORQUE, &[]);
    let machine = build(&scenario).unwrap();
    let speed = |inputs: &[Input]| {
        let mut driven = machine.simulation().unwrap();
        driven.advance(5e-3);
        for input in inputs {
            driven.change(*input).unwrap();
        }
        driven.advance(15e-3);
        driven.value("bearing.inner_race.speed").unwrap()
    };
    let as_given = speed(&[]);
    assert!(speed(&[Input::Torque(0.05)]) < 0.8 * as_given);
    assert!(speed(&[Input::Load(2000.0)]) < as_given);
    // what stays as it is, put in again, changes nothing but where a step ends
    let again = speed(&[Input::Torque(0.1)]);
    assert!((again / as_given - 1.0).abs() < 1e-6, "{again} {as_given}");
}

#[test]
fn what_cannot_be_driven_or_put_in_is_said() {
    let drop = parsed("drop", &[]);
    let machine = build(&drop).unwrap();
    let mut driven = machine.simulation().unwrap();
    for input in [Input::Brake(true), Input::Load(10.0), Input::Torque(1.0)] {
        let told = driven.change(input).unwrap_err().to_string();
        assert!(told.contains("an input that its file gives"), "{told}");
    }
    let spin_up = read(TORQUE, &[]);
    let machine = build(&spin_up).unwrap();
    let mut driven = machine.simulation().unwrap();
    for wrong in [Input::Load(-1.0), Input::Torque(f64::NAN)] {
        assert!(driven.change(wrong).is_err(), "{wrong:?}");
    }
    assert_eq!(driven.value("no such channel"), None);
    let still = parsed("torque", &[]);
    let told = build(&still)
        .unwrap()
        .simulation()
        .err()
        .unwrap()
        .to_string();
    assert!(told.contains("nothing else moves in time"), "{told}");
}
