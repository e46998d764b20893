//! What follows the temperatures of a bearing while it is computed ball by ball.

use crate::outcomes::number;
use auxbear::outcome::{Outcome, Value};
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::sync::atomic::AtomicBool;

const SHIPPED: &str = include_str!("../../../scenarios/drop_until_standstill.toml");

/// The first of the shipped drop.
fn ran(sets: &[&str]) -> Outcome {
    let common = ["run.until=duration", "run.duration=0.3 s"];
    let sets: Vec<String> = (common.iter().chain(sets))
        .map(ToString::to_string)
        .collect();
    let scenario = Scenario::parse(SHIPPED, "drop.toml", &sets, &BuiltIn).unwrap();
    let never = AtomicBool::new(false);
    run(&scenario, &Options::unwatched(&never)).unwrap()
}

fn column<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    let found = outcome.history.iter().find(|column| column.name == name);
    &found.unwrap_or_else(|| panic!("{name}")).values
}

#[test]
fn one_run_and_a_lane_of_many_follow_alike() {
    let alone = ran(&[]);
    let many = ran(&["repeat.count=9"]);
    for name in [
        "rotor_final_speed",
        "smallest_clearance",
        "heat_made",
        "peak_hertz_pressure",
        "inner_flash_temperature_rise",
        "outer_flash_time",
        "life_share",
    ] {
        let of_lane = many.members.values(name)[0].unwrap();
        assert_eq!(of_lane.to_bits(), number(&alone, name).to_bits(), "{name}");
    }
    // the others fell otherwise, and followed their own temperatures
    let least = many.members.values("smallest_clearance");
    assert!(least.iter().flatten().all(|least| *least < 10e-6));
    assert!(least[1] != least[0]);
}

/// Bearings preloaded as mounted, on which a light rotor rolls at once.
const PRELOADED: [&str; 3] = [
    "bearing.operating_diametral_clearance=-5 um",
    "rotor.unbalance_eccentricity=0.5 um",
    "rotor.speed=24000 rpm",
];

#[test]
fn rings_that_close_on_their_balls_do_the_work_that_the_balls_store() {
    let design = [
        "run.accuracy=design",
        "rotor.first_bending_frequency=6000 rad/s",
    ];
    let changes: Vec<&str> = PRELOADED.iter().chain(&design).copied().collect();
    let outcome = ran(&changes);
    let clearance = column(&outcome, "bearing.clearance");
    assert!(clearance[0] == -5e-6 && clearance.last().unwrap() < &-5.05e-6);
    let least = clearance.iter().copied().fold(f64::INFINITY, f64::min);
    assert!((number(&outcome, "smallest_clearance") - least).abs() < 1e-12);
    let turned_over = number(&outcome, "dissipated_energy");
    let residual = number(&outcome, "energy_residual").abs();
    let work = number(&outcome, "work_of_warm_rings") / turned_over;
    assert!(residual < 1e-6, "{residual}");
    // it would be missed
    assert!(work > 5.0 * residual, "{work} {residual}");
    // and in every row
    let missed = column(&outcome, "energy.residual")
        .iter()
        .copied()
        .map(f64::abs);
    assert!(missed.fold(0.0, f64::max) < 1e-6 * turned_over);
}

#[test]
fn ball_by_ball_and_slow_time_brake_alike_where_rings_press_on_the_balls() {
    let further = ["run.until=standstill", "run.duration=1 s"];
    let outcome = ran(&[&PRELOADED[..], &further].concat());
    let (times, heats) = (
        column(&outcome, "time"),
        column(&outcome, "energy.heat.steady_moment"),
    );
    // the last hundredths of a second before it counts as rolling
    let last = times.len() - 1;
    let from = times.partition_point(|time| *time < times[last] - 0.03);
    let power = (heats[last] - heats[from]) / (times[last] - times[from]);
    let first = |name: &str| {
        let found = outcome.quantity(name).unwrap();
        let Value::List(values) = &found.value else {
            panic!("{name}")
        };
        values[0]
    };
    let moment = first("coast_down.over_time.speed_dependent.moment")
        + first("coast_down.over_time.load_dependent.moment");
    // one of two bearings
    let law = 0.5 * moment * first("coast_down.over_time.rotor.speed");
    assert!((power / law - 1.0).abs() < 0.01, "{power} {law}");
    // and say alike how a disturbance of the temperatures would grow
    let growth = *column(&outcome, "heat.growth_rate").last().unwrap();
    let after = first("coast_down.over_time.heat.growth_rate");
    assert!((growth / after - 1.0).abs() < 0.03, "{growth} {after}");
}

#[test]
fn friction_that_rises_with_the_temperature_brings_the_race_to_speed_sooner() {
    let with = |table: &str| ran(&[&format!("contact.friction_over_temperature={table}")]);
    let (given, flat) = (ran(&[]), with("[[\"20 degC\", 0.3], [\"200 degC\", 0.3]]"));
    let speed = "inner_race_time_to_95_percent";
    // its shape counts, not its size
    assert_eq!(
        number(&given, speed).to_bits(),
        number(&flat, speed).to_bits()
    );
    let rising = with("[[\"20 degC\", 0.1], [\"60 degC\", 0.2]]");
    assert!(number(&rising, speed) < 0.95 * number(&given, speed));
    assert!(number(&rising, "relative_heat_residual") < 1e-9);
    let most = number(&rising, "energy_residual");
    assert!(most.abs() < 2e-4, "{most}");
}

const WARMING: &str = include_str!("../../../scenarios/spin_up_warming.toml");

fn spun(sets: &[&str]) -> Outcome {
    spun_of(WARMING, sets)
}

fn spun_of(text: &str, sets: &[&str]) -> Outcome {
    let sets: Vec<String> = (["run.duration=2 s"].iter().chain(sets))
        .map(ToString::to_string)
        .collect();
    let scenario = Scenario::parse(text, "spin_up.toml", &sets, &BuiltIn).unwrap();
    let never = AtomicBool::new(false);
    run(&scenario, &Options::unwatched(&never)).unwrap()
}

#[test]
fn the_torque_of_a_spin_up_falls_with_the_viscosity_of_its_oil() {
    let warm = spun(&[]);
    let (torque, oil) = (
        column(&warm, "bearing.outer_race.moment"),
        column(&warm, "lubricant.temperature"),
    );
    let times = column(&warm, "time");
    let at = |time: f64| times.partition_point(|known| *known < time);
    // M0 ~ ν^(2/3) along the line of the oil; M1 is small and stays
    let nu = |kelvin: f64| {
        let double = |nu: f64| (nu + 0.7).log10().log10();
        let (x0, x1) = (313.15f64.log10(), 373.15f64.log10());
        let slope = (double(11.0) - double(100.0)) / (x1 - x0);
        10f64.powf(10f64.powf(double(100.0) + slope * (kelvin.log10() - x0))) - 0.7
    };
    let (first, last) = (at(0.1), at(1.9));
    let steady = 0.0007 * 200.0 * 36e-3 * (200.0f64 / 6550.0).sqrt();
    let law = (nu(oil[last]) / nu(oil[first])).powf(2.0 / 3.0);
    let found = (torque[last] - steady) / (torque[first] - steady);
    assert!(found < 0.95, "{found}");
    assert!((found / law - 1.0).abs() < 3e-3, "{found} {law}");
    // all that the ledger has made
    assert!(number(&warm, "relative_heat_residual") < 1e-9);
    assert!((number(&warm, "heat_made") / number(&warm, "dissipated_energy") - 1.0).abs() < 1e-12);
    assert!(number(&warm, "energy_residual").abs() < 1e-6);
}

#[test]
fn a_bearing_that_runs_away_is_named_long_before_it_is_too_hot() {
    // thin oil, little that stores, and rings that press from the start
    let sets = [
        "run.duration=25 s",
        "drive.final_speed=2000 rad/s",
        "bearing.moment.viscosity_points=[[\"40 degC\", \"22 mm^2/s\"], [\"100 degC\", \"4.6 mm^2/s\"]]",
        "heat.housing_capacity=60 J/K",
        "heat.rotor_capacity=20 J/K",
        "heat.outer_seat=1 W/K",
    ];
    let with = |clearance: &str| {
        let clearance = format!("bearing.operating_diametral_clearance={clearance}");
        spun(&[&sets[..], &[clearance.as_str()]].concat())
    };
    let told = |outcome: &Outcome| outcome.warnings.iter().any(|w| w.code == "AB2311");
    let away = with("-35 um");
    let (times, growth) = (column(&away, "time"), column(&away, "heat.growth_rate"));
    let begins = growth.iter().position(|rate| *rate > 0.0).unwrap();
    assert!(told(&away) && times[begins] < 0.5 * number(&away, "lubricant_limit_time"));
    let most = growth.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    assert_eq!(most, number(&away, "peak_growth_rate"));
    // preloaded and stable; open
    let stable = with("-5 um");
    assert!(!told(&stable) && number(&stable, "peak_growth_rate") < 0.0);
    let open = with("30 um");
    assert!(!told(&open) && !open.history.iter().any(|c| c.name == "heat.growth_rate"));
}

#[test]
fn fits_follow_the_temperatures_and_a_ring_that_gets_loose_is_told() {
    use physics::ring::PressFit;
    let fits = [
        "drive.final_speed=2000 rad/s",
        "bearing.fits.bore_diameter=25 mm",
        "bearing.fits.outer_diameter=47 mm",
        "bearing.fits.housing_outer_diameter=80 mm",
        "bearing.fits.housing_interference=6 um",
        "bearing.fits.shaft_interference=0.1 um",
    ];
    let unmounted = WARMING.replace("operating_diametral", "unmounted_diametral");
    let warm = spun_of(&unmounted, &fits);
    let told = |outcome: &Outcome| outcome.warnings.iter().any(|w| w.code == "AB2321");
    // the inner ring warms before the shaft in it
    assert!(told(&warm) && !told(&spun_of(&unmounted, &fits[..5])));
    let last = column(&warm, "time").len() - 1;
    let rise = |node: &str| {
        let temperatures = column(&warm, &format!("{node}.temperature"));
        temperatures[last] - temperatures[0]
    };
    let [rotor, inner, balls, outer, housing] =
        ["rotor", "inner_race", "balls", "outer_race", "housing"].map(rise);
    let tube = |bore: f64, joint: f64, outside: f64, interference: f64| PressFit {
        inner_material: physics::materials::BEARING_STEEL,
        outer_material: physics::materials::BEARING_STEEL,
        bore_radius: 0.5 * bore,
        joint_radius: 0.5 * joint,
        outside_radius: 0.5 * outside,
        interference,
    };
    let in_housing = |fit: f64| 2.0 * tube(42.35e-3, 47e-3, 80e-3, fit).bore_shrinking();
    let on_shaft = |fit: f64| 2.0 * tube(0.0, 25e-3, 29.65e-3, fit).outside_growth();
    let steel = 11.5e-6;
    let by_fits = in_housing(6e-6) - in_housing(6e-6 + steel * (outer - housing) * 47e-3)
        + on_shaft(0.1e-6)
        - on_shaft(0.1e-6 + steel * (rotor - inner) * 25e-3);
    let free = steel * (outer * 42.35e-3 - inner * 29.65e-3 - 2.0 * balls * 6.35e-3);
    let clearance = column(&warm, "bearing.clearance");
    let found = clearance[last] - clearance[0];
    assert!(
        (found - free - by_fits).abs() < 1e-12,
        "{found} {free} {by_fits}"
    );
    assert!(by_fits.abs() > 0.05 * free.abs());
}

/// Conductance of a seat of ground steel, 0.8 µm and 3 GPa, at an interference: W/K. Air of 2.4 µm and the jump of temperature beside the
/// metal, in a gap that it lies in once it is loose. It carries 200 N.
fn seat(fit: physics::ring::PressFit, length: f64, kelvin: f64) -> f64 {
    let area = std::f64::consts::TAU * fit.joint_radius * length;
    let pressure = fit.pressure() + 200.0 / area;
    let metal = 1.25 * 46.0 * (0.1 / 0.8e-6) * (pressure / 3e9).powf(0.95);
    let k = physics::air::conductivity(kelvin);
    let jump = k / physics::heat_exchange::free_molecular_air(1.0, 101_325.0, kelvin);
    let (least, gap) = (2.4e-6 + jump, (-fit.interference).max(0.0));
    area * (metal + k / (least * (least + gap)).sqrt())
}

fn both(outcome: &Outcome, name: &str) -> [f64; 2] {
    match &outcome.quantity(name).unwrap().value {
        Value::List(list) => [list[0], list[1]],
        other => panic!("{name} is {other:?}"),
    }
}

#[test]
fn seats_conduct_by_the_pressure_that_warmth_and_speed_leave_them() {
    use physics::ring::PressFit;
    let steel = physics::materials::BEARING_STEEL;
    let tube = |bore: f64, joint: f64, outside: f64, interference: f64| PressFit {
        inner_material: steel,
        outer_material: steel,
        bore_radius: 0.5 * bore,
        joint_radius: 0.5 * joint,
        outside_radius: 0.5 * outside,
        interference,
    };
    let fits = [
        "drive.final_speed=2000 rad/s",
        "bearing.fits.bore_diameter=25 mm",
        "bearing.fits.outer_diameter=47 mm",
        "bearing.fits.housing_outer_diameter=80 mm",
        "bearing.fits.housing_interference=6 um",
        "heat.housing_expansion=23e-6 1/K",
        "bearing.fits.shaft_interference=12 um",
    ];
    let unmounted = WARMING.replace("operating_diametral", "unmounted_diametral");
    let warm = spun_of(&unmounted, &fits);
    let rows = column(&warm, "time").len();
    let at = |node: &str, row: usize| column(&warm, &format!("{node}.temperature"))[row];
    let extremes = |of: &dyn Fn(usize) -> f64| {
        let each: Vec<f64> = (0..rows).map(of).collect();
        let most = each.iter().copied().fold(0.0, f64::max);
        [each.iter().copied().fold(most, f64::min), most]
    };
    let rise = |node: &str, row: usize| at(node, row) - at(node, 0);
    let outer = extremes(&|row| {
        let fit = 6e-6 + (11.5e-6 * rise("outer_race", row) - 23e-6 * rise("housing", row)) * 47e-3;
        let mean = 0.5 * (at("outer_race", row) + at("housing", row));
        seat(tube(42.35e-3, 47e-3, 80e-3, fit), 12e-3, mean)
    });
    // the inner ring grows more than the shaft in it as both turn: 12 µm less what that takes
    let spin = column(&warm, "bearing.inner_race.speed");
    let inner = extremes(&|row| {
        let warmer = 11.5e-6 * (rise("rotor", row) - rise("inner_race", row)) * 25e-3;
        let free = tube(0.0, 25e-3, 29.65e-3, 12e-6);
        let lost = 12e-6 * (spin[row] / free.lift_off_speed()).powi(2);
        let fit = tube(0.0, 25e-3, 29.65e-3, 12e-6 + warmer - lost);
        seat(fit, 12e-3, 0.5 * (at("rotor", row) + at("inner_race", row)))
    });
    for (name, expected) in [("outer_seat", outer), ("rotor_contact", inner)] {
        let found = both(&warm, &format!("{name}_conductances"));
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found / expected - 1.0).abs() < 2e-3,
                "{name}: {found} {expected}"
            );
        }
        assert!(found[1] > 1.02 * found[0], "{name}: {found:?}");
    }
    // what is given stays; with fits and without feedback the motion is that without network
    let given = spun_of(
        &unmounted,
        &[&fits[..], &["heat.outer_seat=6 W/K"]].concat(),
    );
    assert_eq!(both(&given, "outer_seat_conductances"), [6.0; 2]);
    let still = spun_of(&unmounted, &[&fits[..], &["heat.feedback=none"]].concat());
    let off: Vec<&str> = fits
        .iter()
        .copied()
        .filter(|set| !set.starts_with("heat"))
        .collect();
    let alone = spun_of(&unmounted, &[&off[..], &["heat.network=off"]].concat());
    assert_eq!(
        column(&still, "bearing.inner_race.speed"),
        column(&alone, "bearing.inner_race.speed")
    );
    // in vacuum a ring that gets loose has radiation and the metal that its load presses, and that is said without feedback too
    let loose = [
        "bearing.fits.shaft_interference=0.1 um",
        "heat.feedback=none",
    ];
    let vacuum = [
        "heat.atmosphere=vacuum",
        "heat.surroundings=1 W/K",
        "heat.emissivity=0.2",
    ];
    let lost = spun_of(&unmounted, &[&fits[..6], &loose, &vacuum].concat());
    let [least, _] = both(&lost, "rotor_contact_conductances");
    let bore = std::f64::consts::PI * 25e-3 * 12e-3;
    let black = 4.0 * 5.670374419e-8 * bore * at("rotor", 0).powi(3);
    let pressed = 1.25 * 46.0 * (0.1 / 0.8e-6) * (200.0 / bore / 3e9f64).powf(0.95) * bore;
    let expected = pressed + black / 9.0;
    assert!((least / expected - 1.0).abs() < 1e-3, "{least} {expected}");
    assert!(lost.warnings.iter().any(|w| w.code == "AB2321"));
}

#[test]
fn a_spin_up_without_feedback_is_the_one_without_network() {
    let (with, without) = (spun(&["heat.feedback=none"]), spun(&["heat.network=off"]));
    for known in &without.history {
        let bits = |values: &[f64]| -> Vec<u64> { values.iter().map(|v| v.to_bits()).collect() };
        assert_eq!(
            bits(column(&with, &known.name)),
            bits(&known.values),
            "{}",
            known.name
        );
    }
    assert!(number(&with, "peak_lubricant_temperature") > 298.5);
}

const RIG: &str = include_str!("../../../scenarios/rig_test_3_warming.toml");

fn tested(sets: &[&str]) -> Outcome {
    let sets: Vec<String> = (["run.duration=4 s"].iter().chain(sets))
        .map(ToString::to_string)
        .collect();
    let scenario = Scenario::parse(RIG, "rig.toml", &sets, &BuiltIn).unwrap();
    let never = AtomicBool::new(false);
    run(&scenario, &Options::unwatched(&never)).unwrap()
}

#[test]
fn the_oil_of_a_rig_warms_and_the_torque_falls() {
    let warm = tested(&[]);
    assert!(number(&warm, "relative_heat_residual") < 1e-9);
    assert!(number(&warm, "energy_residual").abs() < 1e-6);
    // the clutch, the belt and the shaft's own bearings warm something else
    let of_bearing = number(&warm, "bearing_dissipated_energy");
    assert!((number(&warm, "heat_made") / of_bearing - 1.0).abs() < 1e-12);
    let torque = column(&warm, "bearing.outer_race.moment");
    let cold = tested(&["heat.feedback=none"]);
    let times = column(&warm, "time");
    let at = times.partition_point(|known| *known < 3.9);
    let fall = torque[at] / column(&cold, "bearing.outer_race.moment")[at];
    // preloaded as mounted, and at rest before it starts: nothing grows
    assert!(!warm.warnings.iter().any(|w| w.code == "AB2311"));
    assert!(number(&warm, "peak_growth_rate") <= 0.0);
    // as of spin_up_warming.toml, to 4 s
    assert!((0.7..0.95).contains(&fall), "{fall}");
}

#[test]
fn a_rig_without_feedback_is_the_one_without_network_but_for_its_temperatures() {
    let (with, without) = (
        tested(&["heat.feedback=none"]),
        tested(&["heat.network=off"]),
    );
    for known in &without.history {
        let bits = |values: &[f64]| -> Vec<u64> { values.iter().map(|v| v.to_bits()).collect() };
        let same = bits(column(&with, &known.name)) == bits(&known.values);
        assert_eq!(
            same,
            !known.name.ends_with("temperature_rise"),
            "{}",
            known.name
        );
    }
}

#[test]
fn the_thermocouple_of_a_rig_reads_the_outer_race_of_its_network() {
    let warm = tested(&["rig.temperature.lag=0.5 s"]);
    let (times, race, reading) = (
        column(&warm, "time"),
        column(&warm, "outer_race.temperature"),
        column(&warm, "thermocouple.temperature_rise"),
    );
    // Ṫ_m = (T − T_m)/τ by small steps of its own
    let mut own = 0.0;
    for k in 1..times.len() {
        let step = times[k] - times[k - 1];
        let middle = 0.5 * (race[k] + race[k - 1]) - race[0];
        own += (middle - own) * (1.0 - f64::exp(-step / 0.5));
        assert!((reading[k] - own).abs() < 1e-6, "{} {own}", reading[k]);
    }
    assert!(own > 0.01, "{own}");
}

#[test]
fn the_one_node_of_a_rig_is_the_smallest_network() {
    let one = tested(&[
        "heat.network=off",
        "run.duration=3 s",
        "run.output_interval=0.05 ms",
        // so much is given away that it shows
        "rig.temperature.conductance=4 W/K",
        "rig.temperature.heat_capacity=10 J/K",
    ]);
    let network = thermal::network::Network::new(
        &[10.0],
        &[],
        &[thermal::network::Ground {
            node: 0,
            conductance: 4.0,
            temperature: 0.0,
        }],
    )
    .unwrap();
    let (times, rises) = (
        column(&one, "time"),
        column(&one, "bearing.temperature_rise"),
    );
    let heats: Vec<&[f64]> = (model::bearing::HEATS.iter())
        .map(|kind| format!("energy.heat.{kind}"))
        .filter(|name| one.history.iter().any(|known| known.name == *name))
        .map(|name| column(&one, &name))
        .collect();
    let made = |k: usize| heats.iter().map(|kind| kind[k]).sum::<f64>();
    let (mut own, mut given) = ([0.0], 0.0);
    let most = rises.iter().copied().fold(0.0, f64::max);
    let mut worst = 0.0f64;
    for k in 1..times.len() {
        let span = times[k] - times[k - 1];
        let power = (made(k) - made(k - 1)) / span;
        given += network.advance(&mut own, &[power], span)[0];
        worst = worst.max((own[0] - rises[k]).abs() / most);
    }
    assert!(given > 0.2 * made(times.len() - 1));
    // powers of the rows are means over 0.05 ms: their change within is what is left
    assert!(worst < 2e-9, "{worst} of {most} K");
}

#[test]
fn the_contact_angle_of_a_sprung_pair_falls_as_the_inner_ring_warms() {
    const ANGULAR: &str = include_str!("../../../scenarios/angular_contact_drop.toml");
    let sets = [
        "heat.network=on",
        "run.duration=0.2 s",
        "run.output_interval=1 ms",
    ];
    let warm = spun_of(ANGULAR, &sets);
    let angle = column(&warm, "bearing.contact_angle");
    let (first, last) = (angle[0], *angle.last().unwrap());
    // cos α = 1 − P_d/(2A), P_d by free rings and balls of silicon nitride; the shaft's fit by the sleeve that is one with the ring
    let end = angle.len() - 1;
    let rise = |node: &str| {
        let temperatures = column(&warm, &format!("{node}.temperature"));
        temperatures[end] - temperatures[0]
    };
    let bearing = match &Scenario::parse(ANGULAR, "a.toml", &[], &BuiltIn)
        .unwrap()
        .system
    {
        auxbear::scenario::System::Drop(drop) => {
            drop.auxiliary_bearings[0].bearing.clone().unwrap()
        }
        _ => unreachable!(),
    };
    let (pitch, ball) = (bearing.pitch_diameter, bearing.ball_diameter);
    let opened = 11.5e-6
        * ((pitch + ball) * rise("outer_race") - (pitch - ball) * rise("inner_race"))
        - 2.0 * 3.2e-6 * ball * rise("balls");
    let grooves = bearing.inner_groove_curvature + bearing.outer_groove_curvature - 1.0;
    let cosine = first.cos() - 0.5 * opened / (grooves * ball);
    assert!((last - cosine.acos()).abs() < 1e-9, "{first} {last}");
    assert!(opened < 0.0 && last < first - 1e-3, "{first} {last}");
    assert!(number(&warm, "energy_residual").abs() < 1e-3);
    let told = warm.warnings.iter().find(|w| w.code == "AB2320").unwrap();
    assert!(told.text.contains("contact angle follows"), "{}", told.text);
}
