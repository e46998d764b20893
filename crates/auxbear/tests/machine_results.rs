//! What a machine's results count from, and that its energy balance is that of all bearings together.

use crate::machine::{STIFF, near, number, ran};
use auxbear::outcome::{Outcome, Value};

fn rig() -> String {
    include_str!("../../../scenarios/amb_rig_drop.toml").to_string()
}

fn list(outcome: &Outcome, name: &str) -> Vec<f64> {
    let found = outcome.quantity(name);
    match found.map(|quantity| &quantity.value) {
        Some(Value::List(values)) => values.clone(),
        other => panic!("{name}: {other:?}"),
    }
}

fn column<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    let found = outcome.history.iter().find(|column| column.name == name);
    &found.unwrap_or_else(|| panic!("{name}")).values
}

/// The same drop at the start and 20 turns later: results count from the release, contacts and column `time` from the start.
#[test]
fn instants_after_the_release_do_not_depend_on_when_it_is() {
    let spins = "rotor.spin=held";
    let at_once = ran(&rig(), &["run.duration=60 ms", spins]);
    let lost = "levitation.power_lost_at=100 ms";
    let later = ran(&rig(), &["run.duration=160 ms", spins, lost]);
    assert_eq!(number(&at_once, "release_time"), 0.0);
    assert_eq!(number(&later, "release_time"), 0.1);
    // the fall is the same; later balls and races have settled, which the spin-up after several bounces feels by 1.3e-4
    let spun = "drive_end.inner_race_time_to_50_percent";
    near(number(&later, spun), number(&at_once, spun), 1e-3);
    for end in ["drive_end", "other_end"] {
        let first = format!("{end}.time_to_first_contact");
        near(number(&later, &first), number(&at_once, &first), 1e-3);
        let starts = |of: &Outcome| list(of, &format!("{end}.contact_start_times"))[0];
        near(starts(&later), starts(&at_once), 1e-3);
        let first = later.contacts.iter().find(|c| c.bearing == end).unwrap();
        near(first.start, 0.1 + starts(&later), 1e-12);
        let windows = list(&later, &format!("{end}.whirl_order_times"));
        assert!(windows.iter().all(|time| (-0.1..0.06).contains(time)));
    }
    let time = column(&later, "time");
    assert!(time[0] == 0.0 && (time[time.len() - 1] - 0.16).abs() < 1e-12);
}

/// `rotor.brake_start` is a time from the release: until then magnets hold a rotor that nothing brakes.
#[test]
fn a_brake_follows_the_release() {
    let braked = [
        "rotor.spin=braked",
        "rotor.brake_torque=5 N m",
        "rotor.brake_start=1 ms",
    ];
    let slower = |more: [&str; 2], until: f64| {
        let outcome = ran(&rig(), &[&braked[..], &more].concat());
        let speed = column(&outcome, "rotor.speed");
        let mut rows = column(&outcome, "time").iter().zip(speed);
        speed[0] - rows.rfind(|(time, _)| **time < until).unwrap().1
    };
    let at_once = ["run.duration=4 ms", "levitation.power_lost_at=0 ms"];
    let later = ["run.duration=8 ms", "levitation.power_lost_at=4 ms"];
    // the orbit alone changes the spin by some 1e-3 rad/s before, the brake by 1 rad/s in each millisecond
    assert!(slower(later, 4.95e-3).abs() < 0.05);
    near(slower(later, 7.95e-3), slower(at_once, 3.95e-3), 0.01);
}

/// A bearing 36 µm off the line of levitation: what a seal at its node sees is the distance from that line.
#[test]
fn displacements_of_a_misaligned_bearing_count_from_the_line_of_levitation() {
    let sets = [
        "contact.misalignment_x=30 um",
        "contact.misalignment_y=-20 um",
        "run.duration=20 ms",
    ];
    let outcome = ran(STIFF, &sets);
    let most = number(&outcome, "a.max_rotor_displacement");
    // one is taken at the steps in contact, the other at 64 points a turn: a turn moves it by a part of the gap
    near(
        most,
        number(&outcome, "node.left.largest_displacement"),
        2e-3,
    );
    let of = |name: &str| {
        let [x, y] = ["x", "y"].map(|axis| column(&outcome, &format!("a.{name}.{axis}")));
        x.iter().zip(y).map(|(x, y)| [*x, *y]).collect::<Vec<_>>()
    };
    let (rotor, race) = (of("rotor"), of("bearing.inner_race"));
    let size = |[x, y]: [f64; 2]| x.hypot(y);
    // until the release nothing has moved but the orbit, and the race stands where the bearing does
    assert!(size(rotor[0]) < 10e-6, "{:?}", rotor[0]);
    assert!(size([race[0][0] - 30e-6, race[0][1] + 20e-6]) < 1e-6);
    // rows are every 0.1 ms at most: they miss little of the largest
    let seen = rotor.iter().map(|at| size(*at)).fold(0.0, f64::max);
    near(seen, most, 2e-2);
}

/// Works of the sources become kinetic and potential energy and the heats of both bearings.
#[test]
fn the_balance_of_a_machine_closes_with_the_heats_of_all_its_bearings() {
    let outcome = ran(&rig(), &["run.duration=60 ms"]);
    let of = |name: &str| number(&outcome, name);
    let heats = outcome.history.iter();
    let heats = heats.filter(|column| column.name.contains("energy.heat."));
    let parts: Vec<(String, f64)> = heats
        .map(|column| (column.name.clone(), *column.values.last().unwrap()))
        .collect();
    let sum = |start: &str| -> f64 {
        let own = parts.iter().filter(|(name, _)| name.starts_with(start));
        own.map(|(_, heat)| heat).sum()
    };
    // neither bearing alone is the balance
    assert!(sum("drive_end.") > 0.0 && sum("other_end.") > 0.0);
    near(sum(""), of("dissipated_energy"), 1e-9);
    let stored = of("kinetic_energy_change") + of("potential_energy_change");
    let missed = of("work_of_sources") - stored - of("dissipated_energy");
    // to rounding of the kinetic energy, which is kilojoules
    assert!((missed - of("energy_balance_residual")).abs() < 1e-9);
    assert!(missed.abs() < 1e-5 * of("dissipated_energy"), "{missed}");
}
