//! Coast-downs with heat: balances, closed forms, symmetries, limits, runaway, and what is refused.

use crate::outcomes::number;
use auxbear::outcome::options::Options;
use auxbear::outcome::{Outcome, Value};
use auxbear::run;
use auxbear::scenario::{BuiltIn, Scenario, template};
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// A 6005 under 8 kg, of the starting file.
fn outcome(sets: &[&str]) -> Outcome {
    let text = template("coast_down").expect("a starting file");
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    let scenario = Scenario::parse(&text, "coast.toml", &sets, &BuiltIn).expect("it reads");
    ran(&scenario)
}

fn ran(scenario: &Scenario) -> Outcome {
    let never = AtomicBool::new(false);
    run::run(scenario, &Options::unwatched(&never)).expect("it runs")
}

fn shipped(name: &str, sets: &[&str]) -> Outcome {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    ran(&Scenario::read(&folder.join(name), &sets, &BuiltIn).expect("it reads"))
}

fn refused(sets: &[&str]) -> String {
    let text = template("coast_down").expect("a starting file");
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    match Scenario::parse(&text, "coast.toml", &sets, &BuiltIn) {
        Ok(_) => panic!("{sets:?} is read"),
        Err(problem) => format!("{:?}: {}", problem.key, problem.allowed),
    }
}

fn value(outcome: &Outcome, name: &str) -> Option<f64> {
    let quantity = outcome.quantity(name);
    match &quantity.unwrap_or_else(|| panic!("no {name}")).value {
        Value::Number(number) => Some(*number),
        _ => None,
    }
}

fn has(outcome: &Outcome, code: &str) -> bool {
    outcome.warnings.iter().any(|warning| warning.code == code)
}

#[test]
fn all_energy_of_the_rotor_is_heat_and_all_heat_is_stored_or_given_away() {
    let run = outcome(&[
        "rotor.windage=2e-8 N m s^2",
        "coast_down.stop_speed=2 rad/s",
    ]);
    let heats = [
        "speed_dependent_heat",
        "load_dependent_heat",
        "windage_heat",
    ];
    let made: f64 = heats.iter().map(|name| number(&run, name)).sum();
    let left = 0.5 * 0.01 * 4.0;
    let energy = number(&run, "rotor_energy") - left;
    assert!((made / energy - 1.0).abs() < 1e-12, "{made} {energy}");
    assert!(number(&run, "relative_heat_residual") < 1e-9);
    // each node keeps its part
    let kept: f64 = run
        .quantities
        .iter()
        .filter(|q| q.name.starts_with("stored_heat_in_"))
        .map(|q| number(&run, &q.name))
        .sum();
    assert!((kept / number(&run, "stored_heat") - 1.0).abs() < 1e-12);
}

#[test]
fn a_constant_moment_stops_the_rotor_as_it_must() {
    // without a speed-dependent part nothing follows the temperature: t = I (Ω − Ω_end)/M1
    for (tolerance, allowed) in [("5e-4", 1e-4), ("1e-7", 1e-6)] {
        let run = outcome(&[
            "bearing.moment.f0=1e-12",
            "bearing.moment.f1_factor=0.0007",
            "bearing.moment.f1_exponent=0.5",
            "bearing.moment.equivalent_load=timken",
            "heat.feedback=none",
            &format!("coast_down.tolerance={tolerance}"),
        ]);
        let exact = 0.01 * (400.0 * std::f64::consts::PI - 1.0) / number(&run, "start_moment");
        let found = number(&run, "stop_time");
        // at 1 rad/s the moment fades by 5e-9
        assert!((found / exact - 1.0).abs() < allowed, "{found} {exact}");
    }
}

#[test]
fn two_bearings_with_half_the_rotor_each_are_one_with_half_a_rotor() {
    let one = outcome(&[]);
    let two = outcome(&[
        "rotor.planes=2",
        "rotor.mass=16 kg",
        "rotor.polar_inertia=0.02 kg m^2",
    ]);
    let back = outcome(&["rotor.speed=-12000 rpm"]);
    for name in [
        "stop_time",
        "peak_inner_race_temperature",
        "smallest_clearance",
    ] {
        let [a, b, c] = [&one, &two, &back].map(|run| number(run, name));
        assert!((a / b - 1.0).abs() < 1e-12 && a == c, "{name}: {a} {b} {c}");
    }
}

#[test]
fn less_cooling_is_hotter_and_what_is_cooled_stays_at_its_limit() {
    let warm = outcome(&["heat.surroundings=0.05 W/K"]);
    let limit = "heat.lubricant_limit=45 degC";
    let limited = outcome(&["heat.surroundings=0.05 W/K", limit]);
    let peak = number(&warm, "peak_lubricant_temperature");
    assert!(peak > number(&outcome(&[]), "peak_lubricant_temperature"));
    // a limit alone changes nothing
    assert_eq!(peak, number(&limited, "peak_lubricant_temperature"));
    assert_eq!(value(&warm, "lubricant_limit_time"), None);
    assert!(number(&limited, "lubricant_limit_time") > 0.0 && has(&limited, "AB2310"));
    let taken = number(&limited, "lubricant_energy_to_take");
    assert!(taken > 0.0 && taken < number(&limited, "rotor_energy"));
    // no more than what is made
    assert!(number(&limited, "lubricant_heat_to_take") < number(&limited, "start_power"));
}

#[test]
fn a_bearing_that_closes_runs_away_below_a_clearance_and_is_warned_of_before_its_limit() {
    let stable = shipped("coast_down_closing.toml", &[]);
    assert!(!has(&stable, "AB2311") && has(&stable, "AB2312"));
    assert!(number(&stable, "smallest_clearance") < 0.0);
    assert!(number(&stable, "peak_growth_rate") <= 1e-6);
    // two sides, each with its half, are as near to running away
    let sides = [
        "rotor.planes=2",
        "rotor.mass=24 kg",
        "rotor.polar_inertia=1 kg m^2",
    ];
    let twice = shipped("coast_down_closing.toml", &sides);
    for name in ["peak_growth_rate", "smallest_clearance", "stop_time"] {
        let ratio = number(&twice, name) / number(&stable, name);
        assert!((ratio - 1.0).abs() < 1e-9, "{name} {ratio}");
    }
    let closes = "bearing.operating_diametral_clearance=10 um";
    let away = shipped("coast_down_closing.toml", &[closes]);
    assert_eq!(away.stop.reason, "left the model");
    assert!(has(&away, "AB2311") && number(&away, "peak_growth_rate") > 0.01);
    let growth = away
        .history
        .iter()
        .find(|c| c.name == "heat.growth_rate")
        .unwrap();
    let time = &away.history[0].values;
    let clearance = away
        .history
        .iter()
        .find(|c| c.name == "bearing.clearance")
        .unwrap();
    let begins = (0..time.len()).find(|&k| growth.values[k] > 0.0 && clearance.values[k] < 0.0);
    assert!(time[begins.unwrap()] < number(&away, "balls_limit_time"));
    // hybrid balls open as they warm
    let hybrid = shipped(
        "coast_down_closing.toml",
        &[closes, "bearing.ball_material=silicon nitride"],
    );
    assert!(!has(&hybrid, "AB2311"));
}

#[test]
fn finer_steps_change_little_and_hours_cost_little() {
    let coarse = shipped("coast_down_vacuum.toml", &[]);
    let fine = shipped("coast_down_vacuum.toml", &["coast_down.tolerance=2e-5"]);
    let [a, b] = [&coarse, &fine].map(|run| number(run, "stop_time"));
    assert!((a / b - 1.0).abs() < 5e-4, "{a} {b}");
    assert!(a > 2.5 * 3600.0);
    let [a, b] = [&coarse, &fine].map(|run| number(run, "peak_lubricant_temperature"));
    assert!((a - b).abs() < 0.05, "{a} {b}");
    assert!(coarse.work.steps < 1000);
}

#[test]
fn n_equal_runs_use_n_times_the_life_and_no_rating_gives_none() {
    let run = outcome(&[]);
    let share = number(&run, "life_share");
    let ten = number(&run, "runs_until_ten_percent_fail");
    // the life with lubricant decides where it is known
    let with = number(&run, "life_share_with_lubricant");
    assert!(with != share && (with * ten - 1.0).abs() < 1e-12);
    assert!(number(&run, "runs_until_half_fail") > 5.4 * ten);
    let bare: Vec<&str> = vec![
        "bearing.operating_diametral_clearance=0 um",
        "bearing.dynamic_load_rating=23.8 kN",
    ];
    // twice the rating is an eighth of the share
    let strong = number(&outcome(&bare), "life_share");
    assert!(
        (share / strong / 8.0 - 1.0).abs() < 1e-9,
        "{share} {strong}"
    );
}

fn both(outcome: &Outcome, name: &str) -> [f64; 2] {
    let quantity = outcome.quantity(name);
    match &quantity.unwrap_or_else(|| panic!("no {name}")).value {
        Value::List(list) => [list[0], list[1]],
        other => panic!("{name} is {other:?}"),
    }
}

#[test]
fn surfaces_radiate_and_air_takes_heat_by_their_sizes() {
    const SIGMA: f64 = 5.670374419e-8;
    let vacuum = ["heat.atmosphere=vacuum", "heat.ambient_temperature=25 degC"];
    let with = |more: &[&str]| outcome(&[&vacuum[..], more].concat());
    let radiates = with(&["heat.emissivity=0.2", "heat.housing_emissivity=0.8"]);
    // a ring of 94 by 47 by 12 mm, outside and faces, of 0.8: from rest at 25 °C to its peak
    let area = std::f64::consts::PI * (0.094 * 0.012 + 0.5 * (0.094f64.powi(2) - 0.047f64.powi(2)));
    let exact = |t: f64| 0.8 * SIGMA * area * (t * t + 298.15 * 298.15) * (t + 298.15);
    let [least, most] = both(&radiates, "surroundings_conductances");
    let start = radiates
        .history
        .iter()
        .find(|c| c.name == "housing.temperature");
    let start = start.unwrap().values[0];
    assert!(
        (least / exact(start) - 1.0).abs() < 1e-9,
        "{least} {}",
        exact(start)
    );
    let peak = exact(number(&radiates, "peak_housing_temperature"));
    assert!((most / peak - 1.0).abs() < 1e-9, "{most} {peak}");
    assert!(number(&radiates, "relative_heat_residual") < 1e-9);
    // between rotor and race walls of 0.2 add a ninth of what black ones of that bore would
    let still = with(&["heat.housing_emissivity=0.8"]);
    let [bare, wide] = ["rotor_contact_conductances"; 2].map(|name| both(&still, name)[0]);
    assert_eq!(bare, wide);
    let added = both(&radiates, "rotor_contact_conductances")[0] - bare;
    let gap = std::f64::consts::PI * 0.0245 * 0.012;
    let grey = 4.0 * SIGMA * gap * start.powi(3) / (5.0 + 4.0 * 0.98);
    assert!((added / grey - 1.0).abs() < 0.05, "{added} {grey}");
    assert_eq!(both(&still, "rotor_surroundings_conductances"), [0.0; 2]);
    // air takes less the thinner it is, down to what radiation leaves
    let open = |pressure: &str| {
        let pressure = format!("heat.gas_pressure={pressure}");
        let run = outcome(&[&pressure, "heat.rotor_surroundings=0 W/K"]);
        ["surroundings_conductances", "rotor_contact_conductances"].map(|name| both(&run, name)[1])
    };
    let taken = ["1 bar", "10 mbar", "1 Pa"].map(open);
    for pass in 0..2 {
        assert!(
            taken.windows(2).all(|two| two[1][pass] < two[0][pass]),
            "{taken:?}"
        );
    }
    // in free flight 1.17 W/m²K per Pa across the gap
    let thin = taken[2][1] - both(&still, "rotor_contact_conductances")[1];
    let bore = std::f64::consts::PI * 0.025 * 0.012;
    assert!((thin / (1.17 * bore) - 1.0).abs() < 0.1, "{thin}");
}

#[test]
fn what_cannot_be_is_refused_with_its_key() {
    for (sets, words) in [
        (
            &[
                "heat.atmosphere=vacuum",
                "heat.surroundings=1 W/K",
                "heat.gas_pressure=1 Pa",
            ][..],
            "heat.atmosphere",
        ),
        (&["heat.gas_pressure=100 bar"], "Reynolds"),
        (
            &["heat.housing_emissivity=0.8", "heat.surroundings=0.7 W/K"],
            "beside heat.surroundings",
        ),
        (&["heat.emissivity=1.2"], "heat.emissivity"),
        (&["heat.atmosphere=vacuum"][..], "heat.surroundings"),
        (
            &[
                "heat.atmosphere=vacuum",
                "heat.surroundings=1 W/K",
                "rotor.windage=1e-8 N m s^2",
            ],
            "no gas brakes",
        ),
        (
            &["heat.race_limit=20 degC"],
            "more than heat.start_temperature",
        ),
        (
            &["coast_down.stop_speed=2000 rad/s"],
            "less than rotor.speed",
        ),
        (&["bearing.moment.law=skf"], "\"palmgren\""),
        (
            &[
                "bearing.name=SNFA SEA 35",
                "bearing.moment.f0=2",
                "bearing.moment.f1_factor=0.001",
                "bearing.moment.f1_exponent=0.33",
                "bearing.moment.equivalent_load=timken",
            ],
            "one row of balls",
        ),
        (&["heat.outer_diameter=20 mm"], "heat.bore_diameter"),
    ] {
        let found = refused(sets);
        assert!(found.contains(words), "{sets:?}: {found}");
    }
}

#[test]
fn a_rotor_that_nothing_brakes_is_said_to_turn_on() {
    let run = outcome(&["coast_down.longest=10 s"]);
    assert!(has(&run, "AB2315") && run.stop.time == 10.0);
    assert!(run.stop.reason == "still turning" && run.stop.complete());
    assert_eq!(value(&run, "stop_time"), None);
}

#[test]
fn a_stop_speed_above_a_crawl_is_no_standstill() {
    let run = outcome(&["coast_down.stop_speed=100 rad/s"]);
    assert!(run.stop.reason == "still turning" && has(&run, "AB2315"));
    assert!(
        run.stop.text.contains("still turns with 100.0000 rad/s"),
        "{}",
        run.stop.text
    );
    for absent in ["stop_time", "runs_until_ten_percent_fail"] {
        assert_eq!(value(&run, absent), None, "{absent}");
    }
}
