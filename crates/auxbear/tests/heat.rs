//! Heat against right values: growth rates, layers on their metal, tracks, films, rings, wear.

use crate::outcomes::number;
use auxbear::outcome::Outcome;
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::sync::atomic::AtomicBool;

const CLOSING: &str = include_str!("../../../scenarios/coast_down_closing.toml");
const SKID: &str = include_str!("../../../scenarios/drop_skid.toml");

fn outcome(text: &str, sets: &[&str]) -> Outcome {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    let scenario = Scenario::parse(text, "heat.toml", &sets, &BuiltIn).unwrap();
    let never = AtomicBool::new(false);
    run(&scenario, &Options::unwatched(&never)).unwrap()
}

fn column<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    let found = outcome.history.iter().find(|column| column.name == name);
    &found.unwrap_or_else(|| panic!("{name}")).values
}

fn text_of<'a>(outcome: &'a Outcome, code: &str) -> Option<&'a str> {
    let found = outcome.warnings.iter().find(|one| one.code == code);
    found.map(|one| one.text.as_str())
}

/// Own seven-node network with LSODA and its full Jacobian, of a race as fast as the rotor: largest rate while the balls are preloaded, and from when
/// on it is above 0.
#[test]
fn a_bearing_runs_away_where_the_full_jacobian_says_so() {
    for (clearance, largest, from) in [
        ("12.9", -0.0106, None),
        ("12.7", -0.0062, None),
        ("12.5", 0.32, Some(352.0)),
        ("12.0", 0.317, Some(167.0)),
    ] {
        let set = format!("bearing.operating_diametral_clearance={clearance} um");
        let run = outcome(CLOSING, &[&set, "heat.radial_air_clearance=0.0001 mm"]);
        let columns = ["time", "heat.growth_rate", "bearing.clearance"];
        let [times, rates, open] = columns.map(|name| column(&run, name));
        let closed = || (0..times.len()).filter(|k| open[*k] < 0.0);
        let most = closed().map(|k| rates[k]).fold(f64::MIN, f64::max);
        // the reference looks at every sixth row, each its own solution
        let within = 0.03 * f64::abs(largest);
        assert!((most - largest).abs() < within, "{clearance}: {most}");
        let first = closed().find(|k| rates[*k] > 0.0).map(|k| times[k]);
        match (first, from) {
            (None, None) => assert!(text_of(&run, "AB2311").is_none()),
            // six rows are half a minute
            (Some(first), Some(from)) => {
                assert!((first - from).abs() < 30.0, "{clearance}: {first}");
                // each instant with its own rate
                let at = |rate: f64| format!("({rate:.2e} 1/s)");
                let begin = closed().find(|k| rates[*k] > 0.0).unwrap();
                let text = text_of(&run, "AB2311").unwrap();
                let places = [rates[begin], most].map(|rate| text.find(&at(rate)));
                assert!(places[0].is_some() && places[0] < places[1], "{text}");
            }
            other => panic!("{clearance}: {other:?}"),
        }
    }
}

const BUSHING: &str = r#"
format = "auxbear.scenario/1"
system = "drop"
[rotor]
mass = "8 kg"
polar_inertia = "0.01 kg m^2"
unbalance_eccentricity = "0.1 um"
speed = "12000 rpm"
[levitation]
stiffness = "1e6 N/m"
damping = "1e3 N s/m"
[contact]
radial_air_clearance = "0.25 mm"
bore_diameter = "25 mm"
width = "12 mm"
friction_coefficient = 0.1
[mount]
stiffness = "2e7 N/m"
damping = "5000 N s/m"
moving_mass = "0.5 kg"
[bearing]
type = "bushing"
[run]
duration = "1 s"
output_interval = "5 ms"
accuracy = "screening"
"#;

#[test]
fn a_bushing_is_hot_where_the_rotor_rocks_in_it_and_not_all_round() {
    let run = outcome(BUSHING, &[]);
    // 23.75 J if the whole circumference were heated. Own volumes of a ring 10 mm deep under the 31.5° where the rotor rocks take half as much as
    // under the circumference, in 1 s as in 5 s; between them the spread of the patch along the arc
    let into = number(&run, "friction_heat_into_race");
    assert!((into / (0.5 * 23.75) - 1.0).abs() < 0.25, "{into}");
    let all = into + number(&run, "friction_heat_into_rotor");
    assert!((all / number(&run, "rotor_race_friction_energy") - 1.0).abs() < 1e-9);
    assert!(text_of(&run, "AB2331").is_none());
    // it rubs until the rotor stands
    assert_eq!(number(&run, "slips_at_end"), 1.0);
}

const FILMS: &str = r#"
format = "auxbear.scenario/1"
system = "spin_up"
[drive]
kind = "speed"
final_speed = "300 rad/s"
acceleration = "3000 rad/s^2"
radial_load = "100 N"
[bearing]
name = "6005"
fidelity = "rolling"
operating_diametral_clearance = "10 um"
[bearing.moment]
law = "palmgren"
f0 = 2.0
f1_factor = 0.0007
f1_exponent = 0.5
viscosity_points = [["40 degC", "100 mm^2/s"], ["100 degC", "11 mm^2/s"]]
temperature = "25 degC"
[bearing.lubricant_state]
kind = "films"
drag_temperature_coefficient = "0.03 1/K"
film_heat_capacity = "0.5 J/K"
film_conductance = "0.5 W/K"
[heat]
network = "on"
[run]
duration = "10 s"
output_interval = "5 ms"
"#;

#[test]
fn what_contact_films_keep_no_node_has() {
    let run = outcome(FILMS, &[]);
    let last = |name: &str| *column(&run, name).last().unwrap();
    let films = 0.5 * last("bearing.lubricant.film_temperature_rise");
    // a tenth of all heat
    let made = number(&run, "heat_made");
    assert!(films > 0.05 * made, "{films} {made}");
    let kept = number(&run, "stored_heat_in_films");
    assert!((kept / films - 1.0).abs() < 1e-9, "{kept} {films}");
    assert!(number(&run, "relative_heat_residual") < 1e-9);
    // nodes and surroundings have the rest, by what each body made, stored and gave
    let bodies: Vec<f64> = (run.quantities.iter())
        .filter(|q| q.name.starts_with("heat_made_in_"))
        .map(|q| number(&run, &q.name))
        .collect();
    let reached: f64 = bodies.iter().sum();
    assert!(((reached + films) / made - 1.0).abs() < 1e-9, "{reached}");
    let stored = number(&run, "stored_heat") - kept + number(&run, "heat_to_surroundings");
    assert!((stored / reached - 1.0).abs() < 1e-9);
    // sheared films heat balls and races, half at each side
    assert_eq!(number(&run, "heat_made_in_lubricant"), 0.0);
}

#[test]
fn an_outer_ring_is_as_heavy_as_its_steel_whatever_sits_in_the_bore() {
    const VACUUM: &str = include_str!("../../../scenarios/coast_down_vacuum.toml");
    let capacity = |sets: &[&str]| {
        let run = outcome(VACUUM, sets);
        let temperatures = column(&run, "outer_race.temperature");
        let rise = temperatures.last().unwrap() - temperatures[0];
        // of both bearings
        number(&run, "stored_heat_in_outer_race") / (2.0 * rise)
    };
    let sleeve = capacity(&["bearing.name=6005", "bearing.inner_race_mass=126.4 g"]);
    let bare = capacity(&["bearing.name=6005"]);
    // 40 g of steel, less than its catalogue mass of 80 g without balls, cage and inner ring leaves; within the chamfers
    for found in [sleeve, bare] {
        assert!((found / (0.040 * 460.0) - 1.0).abs() < 0.03, "{found}");
    }
    let heavy = capacity(&["bearing.name=6010", "bearing.inner_race_mass=0.5 kg"]);
    assert!((heavy / 58.9 - 1.0).abs() < 0.03, "{heavy}");
}

#[test]
fn wear_is_by_the_force_and_the_way_though_friction_changes() {
    let rises = "contact.friction_over_temperature=[[\"25 degC\", 0.15], [\"60 degC\", 0.3]]";
    for sets in [
        &["run.output_interval=0.01 ms"][..],
        &["run.output_interval=0.01 ms", rises],
    ] {
        let run = outcome(SKID, sets);
        let (times, forces) = (column(&run, "time"), column(&run, "bearing.contact.force"));
        let slips = column(&run, "bearing.contact.slip_speed");
        let product = |k: usize| forces[k] * slips[k].abs();
        let rubbed: f64 = (1..times.len())
            .map(|k| 0.5 * (product(k - 1) + product(k)) * (times[k] - times[k - 1]))
            .sum();
        let own = 1e-14 * rubbed / (std::f64::consts::PI * 0.025 * 0.012);
        let found = number(&run, "wear_depth");
        // rows of 10 µs in impacts of 100 µs, and steps of friction of 1 %; with the friction of the start alone it is 1.8 times as deep
        assert!((found / own - 1.0).abs() < 0.03, "{found} {own}");
    }
}
