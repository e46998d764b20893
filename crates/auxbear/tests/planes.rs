//! Equal rows of an auxiliary bearing, `auxiliary_bearing.planes`.

use crate::machine::{STIFF, near, number, parsed, ran};
use crate::scenario::several::{HEAD, TWINS};
use auxbear::outcome::{Outcome, Value};

const COAST: &str = include_str!("../../../scenarios/coast_down_vacuum.toml");
const STANDSTILL: &str = include_str!("../../../scenarios/drop_until_standstill.toml");

fn numbers(run: &Outcome) -> impl Iterator<Item = (&str, f64)> {
    run.quantities.iter().filter_map(|own| match own.value {
        Value::Number(value) => Some((own.name.as_str(), value)),
        _ => None,
    })
}

/// A bearing with so many rows, named; results of an only one need no name.
fn only(planes: u32) -> String {
    format!("\n[[auxiliary_bearing]]\nname = \"pair\"\nplanes = {planes}\n")
}

#[test]
fn planes_of_the_rotor_are_rows_of_its_bearing() {
    for method in ["run.method=explicit", "run.method=implicit"] {
        let sets = ["run.accuracy=screening", method];
        let counted = ran(HEAD, &[&["rotor.planes=2"], &sets[..]].concat());
        let named = ran(&format!("{HEAD}{}", only(2)), &sets);
        for (name, value) in numbers(&counted) {
            let own = number(&named, name);
            // the energies of the machine are those of all rows, those of equal planes of one
            let whole = [
                "dissipated_energy",
                "work_of_sources",
                "energy_balance_residual",
            ];
            let all = whole.contains(&name) || name.ends_with("_energy_change");
            assert_eq!(own, value * if all { 2.0 } else { 1.0 }, "{name}");
        }
        assert_eq!(
            number(&named, "dissipated_energy"),
            number(&named, "dissipated_energy_of_all_bearings")
        );
        let separate = ran(&format!("{HEAD}{TWINS}"), &sets);
        let force = "first_impact_force";
        near(
            number(&named, force),
            number(&separate, &format!("other_end.{force}")),
            1e-4,
        );
    }
}

#[test]
fn rows_at_a_node_of_a_flexible_rotor_are_bearings_at_it() {
    let once = STIFF.replacen("name = \"a\"", "name = \"a\"\nplanes = 2", 1);
    let row =
        "[[auxiliary_bearing]]\nname = \"row\"\n[auxiliary_bearing.contact]\nnode = \"left\"\n";
    let each = format!("{STIFF}{row}");
    let sets = ["run.duration=9 ms", "run.tolerance=1e-6"];
    let [once, each] = [once, each].map(|text| ran(&text, &sets));
    for name in [
        "time_to_first_contact",
        "first_impact_force",
        "blow_index",
        "inner_race_final_speed",
    ] {
        for bearing in ["a", "b"] {
            let name = format!("{bearing}.{name}");
            near(number(&once, &name), number(&each, &name), 1e-5);
        }
    }
    near(
        number(&once, "dissipated_energy"),
        number(&each, "dissipated_energy"),
        1e-5,
    );
    assert!(number(&once, "energy_residual").abs() < 1e-6);
    // heats of a history are those of all rows
    let column = |run: &Outcome, name: &str| {
        let column = run.history.iter().find(|column| column.name == name);
        *column.expect(name).values.last().unwrap()
    };
    let heat = "energy.heat.inner_ball_slip";
    let own = column(&once, &format!("a.{heat}"));
    near(own, 2.0 * column(&each, &format!("row.{heat}")), 1e-4);
}

#[test]
fn rows_of_a_coast_down_share_the_load_of_their_bearing() {
    let text = COAST.replacen("planes = 2", "", 1);
    let load = |newtons: f64| format!("coast_down.radial_load = \"{newtons} N\"\n");
    let pair = format!(
        "{text}\n[[auxiliary_bearing]]\nname = \"pair\"\nplanes = 2\n{}",
        load(2000.0)
    );
    let one =
        |name: &str, load: String| format!("[[auxiliary_bearing]]\nname = \"{name}\"\n{load}");
    let other = one("other", load(600.0));
    let each = [
        one("pair", load(1000.0)),
        one("row", load(1000.0)),
        other.clone(),
    ]
    .concat();
    let [once, each] =
        [format!("{pair}{other}"), format!("{text}\n{each}")].map(|text| ran(&text, &[]));
    let own = [
        "stop_time",
        "heat_to_surroundings",
        "stored_heat",
        "other.peak_outer_race_temperature",
    ];
    for name in own
        .into_iter()
        .chain(["pair.peak_lubricant_temperature", "pair.life_share"])
    {
        near(number(&once, name), number(&each, name), 1e-9);
    }
    assert!(number(&once, "relative_heat_residual") < 1e-9);
    // without a load the weight is shared by all rows
    let [once, whole] = [2, 1].map(|planes| {
        let third = if planes == 1 {
            one("row", String::new())
        } else {
            String::new()
        };
        let text = format!(
            "{text}{}{}{third}",
            only(planes),
            one("other", String::new())
        );
        ran(&text, &[])
    });
    near(
        number(&once, "stop_time"),
        number(&whole, "stop_time"),
        1e-9,
    );
}

#[test]
fn a_drop_until_standstill_counts_rows_as_planes() {
    let sets = [
        "run.accuracy=screening",
        "rotor.spin=braked",
        "rotor.brake_torque=2 N m",
    ];
    let text = STANDSTILL.replacen("planes = 2", "", 1);
    let counted = ran(STANDSTILL, &sets);
    let named = ran(&format!("{text}{}", only(2)), &sets);
    for name in [
        "coast_down.stop_time",
        "coast_down.peak_contact_force",
        "coast_down.rotor_energy",
    ] {
        assert_eq!(number(&counted, name), number(&named, name), "{name}");
    }
}

#[test]
fn what_is_no_number_of_rows_is_refused() {
    let whole = |planes: &str| {
        format!("{HEAD}\n[[auxiliary_bearing]]\nname = \"pair\"\nplanes = {planes}\n")
    };
    for (text, sets, found) in [
        (
            whole("0"),
            &[][..],
            "auxiliary_bearing.pair.planes: found 0",
        ),
        (
            whole("1.5"),
            &[],
            "auxiliary_bearing.pair.planes: found the number 1.5",
        ),
        (
            whole("2"),
            &["rotor.planes=2"],
            "rotor.planes: found 2 beside 2 bearings",
        ),
        (
            HEAD.to_string() + TWINS,
            &["auxiliary_bearing.drive_end.planes=2", "rotor.planes=2"],
            "2 beside 3 bearings",
        ),
        (
            include_str!("../../../scenarios/spin_up_6005.toml").to_string(),
            &["planes=2"],
            "planes: found a key that has no effect",
        ),
    ] {
        let told = parsed(&text, sets).expect_err(found);
        assert!(told.contains(found), "{found}: {told}");
    }
    let set = parsed(&whole("1"), &["auxiliary_bearing.pair.planes=2"]).unwrap();
    let again = parsed(&set.resolved.toml(), &[]).unwrap();
    assert_eq!(again.system, set.system);
    // what no file counts is not listed
    let plain = parsed(HEAD, &[]).unwrap().resolved;
    assert!(plain.values.iter().all(|value| value.path != "planes"));
}
