//! The heat of the surfaces of rotor and inner race: what of it is booked, and that nothing of the motion knows it.

use super::several::{HEAD, TWINS, outcome};
use crate::outcomes::number;
use auxbear::outcome::Value;

const WIDTH: &str = "contact.width=12 mm";

#[test]
fn friction_heat_is_in_one_of_both_bodies() {
    let run = outcome(HEAD, &[WIDTH]);
    let [rotor, race] =
        ["rotor", "race"].map(|body| number(&run, &format!("friction_heat_into_{body}")));
    let made = number(&run, "rotor_race_friction_energy");
    assert!(
        ((rotor + race) / made - 1.0).abs() < 1e-9,
        "{rotor} {race} {made}"
    );
    // the rotor passes the patch quickly and takes more
    assert!(rotor > race && race > 0.0);
    let rise = number(&run, "contact_temperature_rise");
    assert!(rise > number(&run, "rotor_surface_rise"));
    assert!(number(&run, "contact_temperature_time") > number(&run, "time_to_first_contact"));
    let rises = run
        .quantities
        .iter()
        .find(|q| q.name == "contact_temperature_rises");
    let Some(Value::List(rises)) = rises.map(|q| &q.value) else {
        panic!("a list");
    };
    assert_eq!(rises.len(), run.contacts.len());
    assert_eq!(rises.iter().copied().fold(0.0, f64::max), rise);
}

#[test]
fn the_motion_knows_nothing_of_it() {
    let [with, without] = [outcome(HEAD, &[WIDTH]), outcome(HEAD, &[])];
    for quantity in &without.quantities {
        let other = with.quantities.iter().find(|q| q.name == quantity.name);
        if let Value::Number(_) = quantity.value {
            assert_eq!(other.map(|q| &q.value), Some(&quantity.value));
        }
    }
    assert_eq!(with.history, without.history);
}

#[test]
fn without_friction_nothing_warms() {
    let run = outcome(HEAD, &[WIDTH, "contact.friction_coefficient=0"]);
    assert_eq!(number(&run, "contact_temperature_rise"), 0.0);
    assert_eq!(number(&run, "friction_heat_into_rotor"), 0.0);
}

#[test]
fn a_machine_turned_or_mirrored_is_as_hot() {
    let upright = number(&outcome(HEAD, &[WIDTH]), "contact_temperature_rise");
    let turned = [
        WIDTH,
        "gravity.direction=-50 deg",
        "rotor.unbalance_angle=40 deg",
    ];
    let mirrored = [
        WIDTH,
        "rotor.speed=-12000 rpm",
        "rotor.unbalance_angle=180 deg",
    ];
    for sets in [&turned, &mirrored] {
        let other = number(&outcome(HEAD, &sets[..]), "contact_temperature_rise");
        assert!((other / upright - 1.0).abs() < 0.02, "{other} {upright}");
    }
}

#[test]
fn a_better_conductor_is_cooler_and_more_wear_is_deeper() {
    let of = |sets: &[&str]| outcome(HEAD, sets);
    let steel = number(&of(&[WIDTH]), "contact_temperature_rise");
    let bronze = [
        WIDTH,
        "contact.surface.rotor_conductivity=200 W/(m K)",
        "contact.surface.rotor_density=8700 kg/m^3",
    ];
    assert!(number(&of(&bronze), "contact_temperature_rise") < 0.8 * steel);
    let depth = |k: &str| {
        let k = format!("contact.surface.wear_coefficient={k}");
        number(&of(&[WIDTH, &k]), "wear_depth")
    };
    let (mild, severe) = (depth("1e-14 m^2/N"), depth("1e-12 m^2/N"));
    assert!((severe / mild - 100.0).abs() < 1e-9 && mild > 0.0);
}

#[test]
fn each_bearing_has_its_own_and_lanes_give_the_same() {
    let text = format!("{HEAD}{TWINS}");
    let run = outcome(&text, &[WIDTH]);
    for bearing in ["drive_end", "other_end"] {
        assert!(number(&run, &format!("{bearing}.contact_temperature_rise")) > 0.0);
    }
    let alone = outcome(HEAD, &[WIDTH]);
    let repeated = outcome(HEAD, &[WIDTH, "repeat.count=5"]);
    for name in ["contact_temperature_rise", "friction_heat_into_race"] {
        assert_eq!(number(&alone, name), number(&repeated, name), "{name}");
    }
}
