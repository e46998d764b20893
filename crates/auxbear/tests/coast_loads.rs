//! What presses and closes a bearing that coasts down: centrifugal force of its balls, growth of its inner ring, forces of a whirl, gas.

use crate::coast_down::{list, number, parsed};
use auxbear::outcome::Outcome;
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::sync::atomic::AtomicBool;

/// A rotor on two 6005 from 30 000 rpm, of which only the oil follows the temperatures.
const FAST: &str = r#"
format = "auxbear.scenario/1"
system = "coast_down"
rotor = { mass = "8 kg", polar_inertia = "0.02 kg m^2", speed = "30000 rpm", planes = 2 }
heat = { feedback = "viscosity" }
[bearing]
name = "6005"
operating_diametral_clearance = "10 um"
moment.viscosity_points = [["40 degC", "100 mm^2/s"], ["100 degC", "11 mm^2/s"]]
"#;
const CLOSING: &str = include_str!("../../../scenarios/coast_down_closing.toml");
const DROP: &str = include_str!("../../../scenarios/drop_until_standstill.toml");
const SKID: &str = include_str!("../../../scenarios/drop_skid.toml");
const WHIRL: &str = include_str!("../../../scenarios/drop_whirl_closing.toml");

fn ran(text: &str, sets: &[&str]) -> Outcome {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    let scenario =
        Scenario::parse(text, "file.toml", &sets, &BuiltIn).unwrap_or_else(|why| panic!("{why}"));
    let never = AtomicBool::new(false);
    run(&scenario, &Options::unwatched(&never)).unwrap()
}

fn warns(run: &Outcome, code: &str) -> bool {
    run.warnings.iter().any(|warning| warning.code == code)
}

fn column<'a>(run: &'a Outcome, name: &str) -> &'a [f64] {
    let found = run.history.iter().find(|column| column.name == name);
    &found.unwrap_or_else(|| panic!("{name}")).values
}

fn near(found: f64, expected: f64, share: f64) {
    assert!((found / expected - 1.0).abs() < share, "{found} {expected}");
}

#[test]
fn balls_press_on_the_outer_race_by_their_orbit() {
    let run = ran(FAST, &[]);
    // own load zone of 360 places with m_b d_m ω_c²/2 on the outer race, over the speeds of the run: 7.186e-8, without that force 3.04e-8
    near(number(&run, "life_share"), 7.186e-8, 2e-3);
    // the most loaded of ten balls by Stribeck's 5 W/Z at this clearance, and 31 N by its orbit
    let orbit = 0.5 * 1.0524e-3 * 36e-3 * (0.5 * 0.98 * 3141.6 * (1.0 - 6.35 / 36.0_f64)).powi(2);
    let still = ran(FAST, &["rotor.speed=100 rpm"]);
    let load = |run: &Outcome| number(run, "peak_ball_load");
    near(load(&run) - load(&still), orbit, 1e-3);
    assert!(number(&run, "indentation_index") > 1.5 * number(&still, "indentation_index"));
}

#[test]
fn a_preload_counts_in_the_life_factor_as_the_load_that_presses_as_hard() {
    // own zone with W ΣQ/ΣQ_open for P, over the clearances of the run: 9.886e-7; with P = W it is 4.8e-7
    let run = ran(CLOSING, &[]);
    near(number(&run, "life_share"), 2.3737e-5, 2e-3);
    near(number(&run, "life_share_with_lubricant"), 9.886e-7, 5e-3);
}

#[test]
fn the_least_viscosity_ratio_leaves_out_the_last_turns() {
    let run = ran(FAST, &[]);
    let least = number(&run, "smallest_viscosity_ratio");
    // own ratio at every row, by the line of the oil (ASTM D341) and ν₁ of ISO 281: 99 % of the turns exceed what is reported
    let loglog = |nu: f64| (nu + 0.7).log10().log10();
    let [cold, hot] = [40.0, 100.0].map(|celsius: f64| (celsius + 273.15).log10());
    let slope = (loglog(11.0) - loglog(100.0)) / (hot - cold);
    let ratio = |kelvin: f64, speed: f64| {
        let viscosity =
            10f64.powf(10f64.powf(loglog(100.0) + slope * (kelvin.log10() - cold))) - 0.7;
        let rpm = 0.98 * speed * 30.0 / std::f64::consts::PI;
        let needed = match rpm < 1000.0 {
            true => 45_000.0 * rpm.powf(-0.83),
            false => 4500.0 * rpm.powf(-0.5),
        };
        viscosity / (needed / 36f64.sqrt())
    };
    let [time, speed, oil] =
        ["time", "rotor.speed", "lubricant.temperature"].map(|name| column(&run, name));
    let (mut all, mut below) = (0.0, 0.0);
    for k in 1..time.len() {
        let turned = (time[k] - time[k - 1]) * (speed[k] + speed[k - 1]);
        let middle = 0.5 * (ratio(oil[k], speed[k]) + ratio(oil[k - 1], speed[k - 1]));
        all += turned;
        below += if middle < least { turned } else { 0.0 };
    }
    // rows lie 3 % of speed apart, 6 % of the turns that are left
    assert!((0.009..0.011).contains(&(below / all)), "{}", below / all);
    // the ratio of the last rad/s says nothing of the coast-down
    let last = ratio(*oil.last().unwrap(), *speed.last().unwrap());
    assert!(last < 0.1 * least, "{last} {least}");
}

#[test]
fn an_inner_ring_that_grows_closes_its_bearing() {
    // annulus of 25 mm to 29.65 mm, E 210 GPa, ν 0.3, 7850 kg/m³: 2u = 1.866 µm at 3141.6 rad/s; the race turns 2 % slower than the rotor
    let growth = 1.866e-6 * 0.98 * 0.98;
    let grows = ["bearing.inner_race_growth=free ring"];
    let least = |run: &Outcome| number(run, "smallest_clearance");
    let run = ran(FAST, &grows);
    assert!(
        (10e-6 - least(&run) - growth).abs() < 5e-9,
        "{}",
        least(&run)
    );
    let clearance = column(&run, "bearing.clearance");
    assert!((clearance.last().unwrap() - 10e-6).abs() < 1e-11);
    // a bearing without clearance is preloaded by it as by one that is mounted so much closer
    let full = "heat.feedback=viscosity and clearance";
    let tight = ran(
        FAST,
        &[full, grows[0], "bearing.operating_diametral_clearance=0 um"],
    );
    let mounted = format!("bearing.operating_diametral_clearance={} um", -1e6 * growth);
    let mounted = ran(FAST, &[full, &mounted]);
    near(
        number(&tight, "start_moment"),
        number(&mounted, "start_moment"),
        1e-3,
    );
    // with its shaft it grows less than half as far; a shaft as hollow as the ring grows as the ring does
    let shaft = ran(FAST, &["bearing.inner_race_growth=with shaft"]);
    assert!((10e-6 - least(&shaft)) < 0.5 * growth && least(&shaft) < 10e-6);
    let hollow = [
        "bearing.inner_race_growth=with shaft",
        "bearing.fits.shaft_bore_diameter=24.99 mm",
    ];
    near(10e-6 - least(&ran(FAST, &hollow)), growth, 2e-3);
}

#[test]
fn ball_by_ball_the_clearance_knows_the_growth_of_the_race_as_well() {
    let sets = [
        "run.until=duration",
        "run.duration=0.3 s",
        "heat.network=on",
        "bearing.fits.bore_diameter=25 mm",
        "bearing.inner_race_growth=free ring",
    ];
    let run = ran(DROP, &sets);
    let last = |name: &str| *column(&run, name).last().unwrap();
    let rise = |node: &str| last(&format!("{node}.temperature")) - 298.15;
    let speed = last("bearing.inner_race.speed");
    assert!(speed > 1000.0, "{speed}");
    // P_d0 + α (d_o ΔT_o − d_i ΔT_i − 2 D ΔT_b) − 2u
    let by_heat =
        42.35e-3 * rise("outer_race") - 29.65e-3 * rise("inner_race") - 12.7e-3 * rise("balls");
    let expected = 10e-6 + 11.5e-6 * by_heat - 1.866e-6 * (speed / 3141.6).powi(2);
    let found = last("bearing.clearance");
    assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    // the balls follow in steps of 20 nm
    let least = number(&run, "smallest_clearance");
    assert!(
        least < expected + 30e-9 && least > expected - 0.5e-6,
        "{least} {expected}"
    );
}

#[test]
fn a_rotor_that_rolls_in_a_wider_bore_turns_its_race_slower() {
    // M0 goes with ρ (ρ Ω)^⅔, M1 with ρ
    let moments = |clearance: &str| {
        let set = format!("heat.radial_air_clearance={clearance}");
        let run = ran(FAST, &["heat.feedback=none", &set]);
        ["speed_dependent.moment", "load_dependent.moment"].map(|name| column(&run, name)[0])
    };
    let ([wide0, wide1], [tight0, tight1]) = (moments("0.5 mm"), moments("0.1 um"));
    let ratio: f64 = 1.0 - 0.5 / 12.5;
    near(wide0 / tight0, ratio.powf(5.0 / 3.0), 1e-4);
    near(wide1 / tight1, ratio, 1e-4);
}

#[test]
fn gas_that_cools_and_does_not_brake_is_warned_of() {
    for (sets, warned) in [
        (&[][..], true),
        (&["rotor.windage=4e-8 N m s^2"][..], false),
        (&["heat.gas_pressure=50 Pa"][..], false),
        (
            &["heat.gas_pressure=1 bar", "heat.rotor_surroundings=0.1 W/K"][..],
            true,
        ),
        (
            &["heat.atmosphere=vacuum", "heat.housing_emissivity=0.8"][..],
            false,
        ),
    ] {
        assert_eq!(warns(&ran(FAST, sets), "AB2335"), warned, "{sets:?}");
    }
}

#[test]
fn a_line_beyond_its_law_is_warned_of() {
    // c0/R_0 of 8e-4; b of 39 N there is 0.5 mm
    assert!(warns(
        &ran(FAST, &["heat.radial_air_clearance=0.01 mm"]),
        "AB2336"
    ));
    assert!(!warns(&ran(FAST, &[]), "AB2336"));
    let skid = |clearance: &str| {
        let clearance = format!("contact.radial_air_clearance={clearance}");
        ran(SKID, &[&clearance, "run.duration=0.02 s"])
    };
    assert!(warns(&skid("0.01 mm"), "AB2336"));
    assert!(!warns(&skid("0.25 mm"), "AB2336"));
}

#[test]
fn a_whirl_conducts_by_its_force() {
    let run = ran(WHIRL, &["run.duration=1.5 s"]);
    // a rough line in proportion to its force: 0.123 W/K under 39 N, about 0.83 under the 290 N that a backward whirl presses with
    let force = column(&run, "bearing.contact.force");
    let late = &force[force.len() / 2..];
    let mean = late.iter().sum::<f64>() / late.len() as f64;
    let most = list(&run, "rotor_contact_conductances")[1];
    assert!((150.0..600.0).contains(&mean), "{mean}");
    assert!(
        (0.6..4.0).contains(&(most / (0.123 * mean / 39.0))),
        "{most} {mean}"
    );
}

#[test]
fn the_flash_of_a_skid_is_the_largest_of_the_run() {
    // own flash of every ball in rows of 10 µs of this motion: 28.96 K at the inner race, 31.04 K at the outer one; rows miss a per cent
    let run = ran(SKID, &["run.duration=0.05 s"]);
    near(number(&run, "inner_flash_temperature_rise"), 28.96, 0.02);
    near(number(&run, "outer_flash_temperature_rise"), 31.04, 0.02);
}

#[test]
fn the_air_clearance_follows_rotor_and_race() {
    let run = ran(WHIRL, &["run.duration=3 s", "run.output_interval=0.37 ms"]);
    let of = |name: &str| column(&run, name);
    let places = [
        "rotor.x",
        "rotor.y",
        "bearing.inner_race.x",
        "bearing.inner_race.y",
    ]
    .map(of);
    let penetration = of("bearing.contact.penetration");
    // distance of the centres less penetration
    let clearance = |row: usize| {
        let [x, y, race_x, race_y] = places.map(|values| values[row]);
        (x - race_x).hypot(y - race_y) - penetration[row]
    };
    let rows = penetration.len() - penetration.len() / 20..penetration.len();
    let count = rows.len() as f64;
    let found = rows.clone().map(clearance).sum::<f64>() / count;
    let mean = |node: &str| rows.clone().map(|row| of(node)[row]).sum::<f64>() / count - 298.15;
    let (race, rotor) = (mean("inner_race.temperature"), mean("rotor.temperature"));
    // steel: α R_0 ΔT_race − α (R_0 − c0) ΔT_rotor; it follows in steps of 0.1 µm
    let gained = 11.5e-6 * (12.5e-3 * race - 12.25e-3 * rotor);
    assert!(gained > 0.4e-6, "{gained}");
    let expected = 0.25e-3 + gained;
    assert!((found - expected).abs() < 0.12e-6, "{found} {expected}");
}

#[test]
fn an_angular_contact_bearing_coasts_down_as_ball_by_ball() {
    const ANGULAR: &str = include_str!("../../../scenarios/angular_contact_drop.toml");
    let sets = [
        "heat.network=on",
        "bearing.moment.law=palmgren",
        "bearing.moment.f0=1.7",
        "bearing.moment.f1_factor=0.001",
        "bearing.moment.f1_exponent=0.33",
        "bearing.moment.temperature=25 degC",
        "bearing.moment.viscosity_points=[[\"40 degC\", \"22 mm^2/s\"], [\"100 degC\", \"4.6 mm^2/s\"]]",
        "run.accuracy=screening",
        "run.output_interval=10 ms",
    ];
    let with = |more: &[&str]| ran(ANGULAR, &[&sets, more].concat());
    let coasts = with(&["run.until=standstill", "coast_down.stop_speed=5300 rad/s"]);
    assert!(coasts.stop.complete(), "{}", coasts.stop.text);
    assert!(number(&coasts, "coast_down.relative_heat_residual") < 1e-9);
    assert!(number(&coasts, "coast_down.life_share") > 0.0);
    let motion = with(&["run.duration=8 s"]);
    let ball_by_ball = |name: &str| {
        let column = motion.history.iter().find(|column| column.name == name);
        *column.unwrap().values.last().unwrap()
    };
    let course = |name: &str| {
        let list = |name: &str| list(&coasts, &format!("coast_down.over_time.{name}"));
        let (times, values) = (list("time"), list(name));
        let next = times.partition_point(|time| *time < 8.0);
        let way = (8.0 - times[next - 1]) / (times[next] - times[next - 1]);
        values[next - 1] + way * (values[next] - values[next - 1])
    };
    let speed = course("rotor.speed") / ball_by_ball("rotor.speed");
    assert!((speed - 1.0).abs() < 5e-3, "{speed}");
    for node in ["inner_race", "balls", "lubricant", "outer_race"] {
        let name = format!("{node}.temperature");
        let (one, other) = (course(&name), ball_by_ball(&name));
        assert!((one - other).abs() < 2.0, "{node}: {one} {other}");
    }
}

#[test]
fn a_load_by_tables_brakes_a_coast_down() {
    let coasts = |sets: &[&str]| {
        let calm = [
            "rotor.unbalance_eccentricity=0.5 um",
            "run.duration=3 s",
            "heat.feedback=none",
        ];
        let found = ran(DROP, &[&calm, sets].concat());
        assert!(found.stop.complete(), "{}", found.stop.text);
        assert!(number(&found, "coast_down.relative_heat_residual") < 1e-9);
        found
    };
    // as a brake of the same torque
    let braked = coasts(&["rotor.spin=braked", "rotor.brake_torque=0.2 N m"]);
    let flat = "rotor.torque_over_speed=[[\"0 rpm\", \"-0.2 N m\"], [\"13000 rpm\", \"-0.2 N m\"]]";
    let [by_brake, by_table] =
        [&braked, &coasts(&[flat])].map(|run| number(run, "coast_down.stop_time"));
    assert!((20.0..100.0).contains(&by_brake), "{by_brake}");
    assert!(
        (by_table / by_brake - 1.0).abs() < 2e-3,
        "{by_table} {by_brake}"
    );
    // of a fan whose gas fades: its heat is ∫τ(Ω) s(t) Ω dt over the course
    let fan = "rotor.torque_over_speed=[[\"0 rpm\", \"0 N m\"], [\"6000 rpm\", \"-0.1 N m\"], [\"13000 rpm\", \"-0.5 N m\"]]";
    let rpm = std::f64::consts::PI / 30.0;
    let torque = |speed: f64| match speed / rpm {
        slow if slow < 6000.0 => 0.1 * slow / 6000.0,
        fast => 0.1 + 0.4 * (fast - 6000.0) / 7000.0,
    };
    for (begin, end) in [(1.0, 0.3), (0.0, 1.0)] {
        let shares =
            format!("rotor.torque_share_over_time=[[\"5 s\", {begin}], [\"25 s\", {end}]]");
        let found = coasts(&[fan, &shares]);
        let share = |time: f64| begin + (end - begin) * ((time - 5.0) / 20.0).clamp(0.0, 1.0);
        let course = |name: &str| list(&found, &format!("coast_down.over_time.{name}"));
        let powers: Vec<[f64; 2]> = (course("time").iter().zip(course("rotor.speed")))
            .map(|(time, speed)| [*time, torque(*speed) * share(*time) * speed])
            .collect();
        let between =
            |pair: &[[f64; 2]]| 0.5 * (pair[1][0] - pair[0][0]) * (pair[0][1] + pair[1][1]);
        let work: f64 = powers.windows(2).map(between).sum();
        let heat = number(&found, "coast_down.windage_heat");
        assert!(heat > 0.1 * number(&found, "coast_down.rotor_energy"));
        assert!((heat / work - 1.0).abs() < 2e-3, "{heat} {work}");
    }
    let drives =
        "rotor.torque_over_speed=[[\"0 rpm\", \"0.1 N m\"], [\"13000 rpm\", \"-0.2 N m\"]]";
    let told = parsed(DROP, &[drives]).err().unwrap_or_default();
    assert!(told.contains("may never stand"), "{told}");
}

#[test]
fn bearings_with_names_coast_down_as_equal_ones_do() {
    let text = include_str!("../../../scenarios/coast_down_vacuum.toml");
    let coasts = |text: &str| ran(text, &[]);
    let equal = coasts(text);
    let text_of = |[one, other]: [&str; 2]| {
        let text = text.replacen("planes = 2", "", 1);
        format!(
            "{text}\n[[auxiliary_bearing]]\nname = \"drive_end\"\n{one}\n[[auxiliary_bearing]]\nname = \"free_end\"\n{other}\n"
        )
    };
    let named = |of_each: [&str; 2]| coasts(&text_of(of_each));
    let alike = named(["", ""]);
    for name in ["stop_time", "rotor_energy", "heat_to_surroundings"] {
        let [a, b] = [&equal, &alike].map(|run| number(run, name));
        assert!((a / b - 1.0).abs() < 1e-9, "{name}: {a} {b}");
    }
    let peak =
        |run: &Outcome, part: &str| number(run, &format!("{part}peak_outer_race_temperature"));
    assert!((peak(&equal, "") - peak(&alike, "free_end.")).abs() < 1e-6);
    // with more load a bearing makes more heat
    let unequal = named([
        "coast_down.radial_load = \"2000 N\"",
        "coast_down.radial_load = \"451 N\"",
    ]);
    assert!(number(&unequal, "relative_heat_residual") < 1e-9);
    assert!(peak(&unequal, "drive_end.") > peak(&unequal, "free_end.") + 1.0);
    let both = format!(
        "{text}\n[[auxiliary_bearing]]\nname = \"drive_end\"\n[[auxiliary_bearing]]\nname = \"free_end\"\n"
    );
    let told = parsed(&both, &[]).err().unwrap_or_default();
    assert!(told.contains("one of the two is needed"), "{told}");
    let told = parsed(&text_of(["coast_down.radial_load = \"2000 N\"", ""]), &[]);
    let told = told.err().unwrap_or_default();
    assert!(told.contains("a load for each bearing"), "{told}");
    let whole = text.replacen("planes = 2", "", 1);
    let told = parsed(
        &format!(
            "{whole}\n[[auxiliary_bearing]]\nname = \"a\"\n[auxiliary_bearing.coast_down]\nlongest = \"1 h\"\n"
        ),
        &[],
    );
    assert!(told.is_err());
}
