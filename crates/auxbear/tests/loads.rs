//! Forces from a file, loads that come, and speeds to which a rotor comes back.

use crate::machine::{STIFF, near, parsed, ran};
use crate::outcomes::number;
use auxbear::outcome::Outcome;
use auxbear::run::{Options, each, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::f64::consts::PI;
use std::fs;
use std::sync::atomic::AtomicBool;

/// Without unbalance; it touches nothing.
fn free() -> String {
    STIFF
        .replace("40 g mm", "0 g mm")
        .replace("0.25 mm", "5 mm")
}

fn last(run: &Outcome, column: &str) -> f64 {
    let column = run.column(column).expect("a column");
    column.values.last().copied().unwrap()
}

/// A load of F from t_0 on moves the mass centre by F (t - t_0)²/(2m) beside a force of its own; another one at the same node takes its place.
#[test]
fn a_load_acts_from_its_instant_and_the_next_takes_its_place() {
    let load = |at: &str, x: &str| {
        format!(
            "[[event]]\ndo = \"load\"\nat = \"{at}\"\nnode = \"middle\"\nforce_x = \"{x}\"\nforce_y = \"-8 N\"\n"
        )
    };
    let text = free()
        + "[[rotor.node]]\nname = \"middle\"\nat = \"0.15 m\"\n[[rotor.force]]\nat = \"0.15 m\"\ntimes = [\"0 s\", \"1 s\"]\nx = [\"20 N\", \"20 N\"]\n";
    let sets = ["run.duration=3 ms"];
    let alone = ran(&text, &sets);
    let events = load("1 ms", "60 N") + &load("2 ms", "-30 N");
    let loaded = ran(&format!("{text}{events}"), &sets);
    let moved = |column: &str| last(&loaded, column) - last(&alone, column);
    let mass = number(&alone, "rotor_mass");
    // 60 N for 1 ms, then -30 N for 1 ms
    near(
        moved("a.rotor.x"),
        (0.5 * 60.0 + 60.0 - 0.5 * 30.0) * 1e-6 / mass,
        1e-4,
    );
    near(moved("a.rotor.y"), -0.5 * 8.0 * 4e-6 / mass, 1e-4);
    assert!(number(&loaded, "energy_residual").abs() < 1e-6);
    let work = number(&loaded, "work_of_sources") - number(&alone, "work_of_sources");
    assert!(work.abs() > 1e-6, "{work}");
    let refused = |lines: &str| {
        let text = format!("{text}[[event]]\ndo = \"load\"\nat = \"1 ms\"\n{lines}\n");
        parsed(&text, &[]).unwrap_err()
    };
    let nowhere = refused("node = \"midle\"\nforce_x = \"1 N\"");
    assert!(
        nowhere.contains("middle") && nowhere.contains("machine.toml:"),
        "{nowhere}"
    );
    assert!(refused("node = \"middle\"").contains("force_x or force_y"));
    assert!(refused("force_x = \"1 N\"").contains("node is needed"));
    let twice = load("1 ms", "1 N") + &load("1 ms", "2 N");
    let twice = parsed(&format!("{text}{twice}"), &[]).unwrap_err();
    assert!(twice.contains("same instant"), "{twice}");
}

/// A load at a speed comes at another instant in each lane, and each lane is its run alone to the bit.
#[test]
fn loads_by_speed_in_lanes_are_those_alone() {
    let text = free().replace("duration = \"15 ms\"", "duration = \"6 ms\"")
        + "[[rotor.force]]\nat = \"0.15 m\"\ntimes = [\"1 ms\", \"3 ms\", \"4 ms\"]\nx = [\"0 N\", \"70 N\", \"-30 N\"]\ntorque = [\"0 N m\", \"-3 N m\", \"2 N m\"]\n[[event]]\ndo = \"brake\"\nat = \"0.5 ms\"\ntorque = \"20 N m\"\n[[event]]\nname = \"push\"\ndo = \"load\"\nbelow_speed = \"8850 rpm\"\nnode = \"right\"\nforce_y = \"90 N\"\n";
    let speeds = ["8900 rpm", "8895 rpm", "8880 rpm", "8860 rpm"];
    let scenarios = speeds.map(|speed| parsed(&text, &[&format!("rotor.speed={speed}")]).unwrap());
    let never = AtomicBool::new(false);
    let options = Options::unwatched(&never);
    let together = each(&scenarios.clone().map(Ok), &options);
    let mut times = Vec::new();
    for (scenario, beside) in scenarios.iter().zip(&together) {
        let alone = run(scenario, &options).unwrap();
        for name in [
            "event.push.time",
            "rotor_final_speed",
            "node.right.largest_displacement",
        ] {
            let pair = [number(&alone, name), number(beside, name)];
            assert_eq!(pair[0].to_bits(), pair[1].to_bits(), "{name} {pair:?}");
        }
        times.push(number(&alone, "event.push.time"));
    }
    assert!(times.is_sorted_by(|a, b| a > b), "{times:?}");
}

/// The same triangle of force from a file, in its own units, is that of the table; a file without units is refused.
#[test]
fn a_force_comes_from_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let write = |text: &str| fs::write(folder.path().join("hammer.csv"), text).unwrap();
    let read = |lines: &str| {
        let path = folder.path().join("machine.toml");
        let force = "[[rotor.force]]\nname = \"hammer\"\nat = \"0.15 m\"\nfile = \"hammer.csv\"\n";
        let text = format!("{}{force}{lines}\n", free());
        fs::write(&path, text).unwrap();
        let sets = ["run.duration=4 ms".to_string()];
        let scenario =
            Scenario::read(&path, &sets, &BuiltIn).map_err(|problem| problem.to_string())?;
        let never = AtomicBool::new(false);
        let outcome = run(&scenario, &Options::unwatched(&never));
        Ok::<_, String>((
            outcome.map_err(|problem| problem.to_string())?,
            scenario.resolved.toml(),
        ))
    };
    write("time (ms),impact (kN)\n0,0\n1,0.25\n2,0\n");
    let (struck, resolved) = read("channel_x = \"impact\"\nstart = \"1 ms\"\nscale = 2.0").unwrap();
    assert!(
        resolved.contains(&folder.path().join("hammer.csv").display().to_string()),
        "{resolved}"
    );
    let table = "[[rotor.force]]\nat = \"0.15 m\"\ntimes = [\"1 ms\", \"2 ms\", \"3 ms\"]\nx = [\"0 N\", \"500 N\", \"0 N\"]\n";
    let by_table = ran(&(free() + table), &["run.duration=4 ms"]);
    near(
        last(&struck, "a.rotor.x"),
        last(&by_table, "a.rotor.x"),
        1e-9,
    );
    assert!(number(&struck, "energy_residual").abs() < 1e-6);
    let missing = read("channel_x = \"blow\"").unwrap_err();
    assert!(
        missing.contains("impact") && missing.contains("machine.toml:"),
        "{missing}"
    );
    assert!(
        read("")
            .unwrap_err()
            .contains("channel_x, channel_y, channel_z or channel_torque")
    );
    let both = read("channel_x = \"impact\"\ntimes = [\"0 s\"]\nx = [\"1 N\"]").unwrap_err();
    assert!(both.contains("one of the two"), "{both}");
    // rounding makes its times one, and there is no force in this run
    let (far, _) = read("channel_x = \"impact\"\nstart = \"1e20 s\"").unwrap();
    assert!(last(&far, "a.rotor.x") < 0.5 * last(&struck, "a.rotor.x"));
    write("time (ms),impact (N)\n0,0\n1,1e300\n2,0\n");
    let large = read("channel_x = \"impact\"").unwrap_err();
    assert!(
        large.contains("is no number") && large.contains("in every row"),
        "{large}"
    );
    write("time (ms),impact\n0,0\n1,250\n2,0\n");
    let unit = read("channel_x = \"impact\"").unwrap_err();
    assert!(unit.contains("without a unit"), "{unit}");
    write("time (ms),impact (m/s^2)\n0,0\n1,250\n2,0\n");
    let other = read("channel_x = \"impact\"").unwrap_err();
    assert!(
        other.contains("in m/s^2; a unit of the kind of N is needed"),
        "{other}"
    );
    let nothing = parsed(&(free() + "[[rotor.force]]\nat = \"0.15 m\"\n"), &[]).unwrap_err();
    assert!(
        nothing.contains("times with x, y, z or torque, or file"),
        "{nothing}"
    );
}

/// A torque over time turns a rotor that touches nothing by ∫T dt/I, from a table as from a file.
#[test]
fn a_torque_over_time_turns_the_rotor() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("brake.csv");
    fs::write(&file, "time (ms),brake (kN mm)\n0,0\n1,25\n2,0\n").unwrap();
    let force = |lines: &str| format!("{}[[rotor.force]]\nat = \"0.15 m\"\n{lines}\n", free());
    let rows =
        "times = [\"1 ms\", \"2 ms\", \"3 ms\"]\ntorque = [\"0 N m\", \"-50 N m\", \"0 N m\"]";
    let table = ran(&force(rows), &["run.duration=4 ms"]);
    let read = format!(
        "file = \"{}\"\nchannel_torque = \"brake\"\nstart = \"1 ms\"\nscale = -2.0",
        file.display()
    );
    let read = ran(&force(&read), &["run.duration=4 ms"]);
    let inertia = 0.01 + 100.0 * 0.3 * PI * 0.04_f64.powi(4) / 32.0;
    for run in [&table, &read] {
        let slower = 300.0 * PI - number(run, "rotor_final_speed");
        near(slower, 50.0 * 1e-3 / inertia, 1e-6);
        assert!(number(run, "energy_residual").abs() < 1e-6);
    }
    let held = parsed(&force(rows), &["rotor.spin=held"]).unwrap_err();
    assert!(held.contains("a torque beside rotor.spin"), "{held}");
}

/// A drive brings the rotor above the speed, and a brake below it again: T t = I ΔΩ says when. Without a drive it never comes there.
#[test]
fn a_run_up_reaches_a_speed_from_above_where_it_falls_to_it() {
    let event = |name: &str, what: &str, when: &str, torque: &str| {
        format!("[[event]]\nname = \"{name}\"\ndo = \"{what}\"\n{when}\ntorque = \"{torque}\"\n")
    };
    let begun = event("on", "drive", "at = \"1 ms\"", "20 N m");
    let falls = event("falls", "brake", "below_speed = \"9010 rpm\"", "1 N m");
    let turns = event("off", "drive", "at = \"3 ms\"", "0 N m")
        + &event("slows", "brake", "at = \"3 ms\"", "20 N m");
    let sets = ["run.duration=6 ms"];
    let run = ran(&format!("{}{begun}{turns}{falls}", free()), &sets);
    let inertia = 0.01 + 100.0 * 0.3 * PI * 0.04_f64.powi(4) / 32.0;
    // above 9000 rpm by 20 N m · 2 ms/I, then down to 9010 rpm
    let expected = 3e-3 + 2e-3 - inertia * 10.0 * PI / 30.0 / 20.0;
    near(number(&run, "event.falls.time"), expected, 1e-5);
    assert!(number(&run, "energy_residual").abs() < 1e-6);
    let never = ran(&format!("{}{begun}{falls}", free()), &sets);
    let never = never.warnings.iter().find(|own| own.code == "AB2083");
    let told = never.expect("an event that never happens").to_string();
    assert!(told.contains("does not fall to 9010.0 rpm"), "{told}");
    let undriven = parsed(&(free() + &falls), &[]).unwrap_err();
    assert!(undriven.contains("from the start on"), "{undriven}");
}
