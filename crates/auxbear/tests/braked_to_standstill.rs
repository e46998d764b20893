//! Events beside `run.until = "standstill"`.

use crate::machine::{STIFF, near, parsed, ran};
use crate::outcomes::number;
use auxbear::outcome::Outcome;
use std::f64::consts::PI;

const AXIS: &str = include_str!("../../../scenarios/machine_axis_lost.toml");

const LAWS: &str = "[bearing.moment]\nlaw = \"palmgren\"\nlubrication = \"grease\"\nviscosity_points = [[\"40 degC\", \"22 mm^2/s\"], [\"100 degC\", \"4.6 mm^2/s\"]]\ntemperature = \"25 degC\"\n[heat]\nnetwork = \"on\"\n[run]\nuntil = \"standstill\"\naccuracy = \"screening\"\noutput_interval = \"1 ms\"\n";

/// It rolls within the first second, and coasts down on bearings that warm.
fn coasting() -> String {
    STIFF
        .replace("40 g mm", "4 g mm")
        .replace("9000 rpm", "3000 rpm")
        .replace("[run]\n", LAWS)
        .replace("duration = \"15 ms\"", "duration = \"1 s\"")
}

fn brake(when: &str, torque: &str) -> String {
    format!("[[event]]\nname = \"brake\"\ndo = \"brake\"\n{when}\ntorque = \"{torque}\"\n")
}

fn lost(at: &str) -> String {
    let (before, _) = AXIS.split_once("[[event]]").unwrap();
    let text = before.replace("[run]\nduration = \"0.8 s\"\n", LAWS);
    format!("{text}[[event]]\nname = \"lost\"\ndo = \"power lost\"\n{at}\n")
}

/// Heats of the coast-down over the energy of the rotor that it takes.
fn heats(run: &Outcome) -> f64 {
    let kinds = ["speed_dependent", "load_dependent", "windage"];
    let heats = kinds.map(|kind| number(run, &format!("coast_down.{kind}_heat")));
    heats.iter().sum::<f64>() / number(run, "coast_down.rotor_energy")
}

/// A rotor that rolls comes to the speed between ball-by-ball intervals: the brake is that of the keys at the same instant.
#[test]
fn a_brake_comes_at_a_speed_of_the_coast_down() {
    let torque = 0.01;
    let by_speed = ran(
        &(coasting() + &brake("below_speed = \"1000 rpm\"", "0.01 N m")),
        &[],
    );
    let time = number(&by_speed, "event.brake.time");
    assert!(time > 10.0, "{time}");
    assert!(!by_speed.warnings.iter().any(|own| own.code == "AB2083"));
    let start = format!("rotor.brake_start={time} s");
    let keys = ["rotor.spin=braked", "rotor.brake_torque=0.01 N m", &start];
    let by_key = ran(&coasting(), &keys);
    let stop = number(&by_speed, "coast_down.stop_time");
    near(stop, number(&by_key, "coast_down.stop_time"), 1e-9);
    let plain = ran(&coasting(), &[]);
    assert!(stop < 0.7 * number(&plain, "coast_down.stop_time"));
    // the rotor keeps the energy of 1 rad/s
    near(heats(&by_speed), 1.0, 2e-5);
    assert!(number(&by_speed, "coast_down.relative_heat_residual").abs() < 1e-9);
    // its turns from 1000 rpm on, less than those at constant deceleration
    let heat = number(&by_speed, "coast_down.windage_heat");
    let turns = number(&by_speed, "coast_down.turns") - number(&by_key, "coast_down.turns");
    assert!(turns.abs() < 1e-3, "{turns}");
    let most = torque * 0.5 * (stop - time) * 1000.0 * PI / 30.0;
    assert!((0.5 * most..most).contains(&heat), "{heat} {most}");
}

/// Where unbalance keeps the rotor bouncing the motion is followed in intervals, and a leap ends where the brake comes.
#[test]
fn a_leap_ends_at_the_speed_at_which_a_brake_comes() {
    let sets = [
        "rotor.unbalance.1.amount=60 g mm",
        "rotor.speed=9000 rpm",
        "run.duration=0.3 s",
        "coast_down.stop_speed=700 rad/s",
    ];
    let by_speed = ran(
        &(coasting() + &brake("below_speed = \"8000 rpm\"", "0.05 N m")),
        &sets,
    );
    assert!(number(&by_speed, "coast_down.windows") > 5.0);
    let time = number(&by_speed, "event.brake.time");
    let start = format!("rotor.brake_start={time} s");
    let keys = ["rotor.spin=braked", "rotor.brake_torque=0.05 N m", &start];
    let by_key = ran(&coasting(), &[&sets[..], &keys].concat());
    let [stop, same] = [&by_speed, &by_key].map(|run| run.stop.time);
    // half of coast_down.tolerance
    near(stop, same, 1e-3);
}

/// The drop goes on until the last event by time, and the run is that of the keys to the bit.
#[test]
fn events_by_time_come_before_the_coast_down() {
    let keys = [
        "rotor.spin=braked",
        "rotor.brake_torque=0.01 N m",
        "rotor.brake_start=0.1 s",
    ];
    let by_key = ran(&coasting(), &keys);
    let by_event = ran(&(coasting() + &brake("at = \"0.1 s\"", "0.01 N m")), &[]);
    let sets = [
        "rotor.speed=3000 rpm",
        "run.duration=0.3 s",
        "coast_down.stop_speed=260 rad/s",
    ];
    let text = lost("at = \"20 ms\"");
    let lost = ran(&text, &sets);
    let key = "levitation.power_lost_at=20 ms";
    let (without, _) = text.split_once("[[event]]").unwrap();
    let by_its_key = ran(without, &[&sets[..], &[key]].concat());
    assert!(number(&lost, "event.lost.time") == 0.02);
    for (name, pair) in [
        ("coast_down.stop_time", [&by_key, &by_event]),
        ("drive_end.peak_contact_force", [&lost, &by_its_key]),
    ] {
        let pair = pair.map(|run| number(run, name));
        assert_eq!(pair[0].to_bits(), pair[1].to_bits(), "{name} {pair:?}");
    }
    let ends = [&lost, &by_its_key].map(|run| run.stop.time.to_bits());
    assert_eq!(ends[0], ends[1]);
}

/// A brake that stops the rotor within the first interval: the mean speed of a race over that of rolling is no mean of ratios, which are anything
/// where the rotor stands. No ball carries more than by Stribeck, 5 F/Z.
#[test]
fn an_interval_in_which_the_rotor_stops_loads_no_ball_more() {
    let keys = ["rotor.spin=braked", "rotor.brake_torque=5 N m"];
    let loads = ["0.3 s", "0.5 s"].map(|end| {
        let when = ["rotor.brake_start=0.1 s", &format!("run.duration={end}")];
        let run = ran(&coasting(), &[keys, when].concat());
        let [ball, force] = ["peak_ball_load", "peak_contact_force"]
            .map(|name| number(&run, &format!("a.coast_down.{name}")));
        // the 6005 has ten
        assert!(ball < 0.5 * force, "{end}: {ball} {force}");
        ball
    });
    near(loads[0], loads[1], 0.05);
}

/// Times at which the rotor comes to a speed, s, and at which its run ends.
fn times(run: &Outcome) -> [f64; 2] {
    [number(run, "event.mark.time"), run.stop.time]
}

/// A load that presses the rotor three times as hard at 1500 rpm: from there on the coast-down is that of a rotor which has it from the start.
#[test]
fn a_load_comes_at_a_speed_of_the_coast_down() {
    let text = coasting()
        + "[[rotor.node]]\nname = \"middle\"\nat = \"0.15 m\"\n"
        + &brake("below_speed = \"1500 rpm\"", "1e-9 N m").replace("\"brake\"\ndo", "\"mark\"\ndo");
    let load = |when: &str| {
        let event = format!(
            "[[event]]\nname = \"load\"\ndo = \"load\"\nnode = \"middle\"\nforce_y = \"-200 N\"\n{when}\n"
        );
        ran(&(text.clone() + &event), &[])
    };
    let [without, begins, comes, at_once] = [
        ran(&text, &[]),
        load("at = \"1 ms\""),
        load("below_speed = \"1500 rpm\""),
        load("below_speed = \"2900 rpm\""),
    ];
    let [from, to] = times(&comes);
    near(number(&comes, "event.load.time"), from, 1e-9);
    let rest = |run: &Outcome| times(run)[1] - times(run)[0];
    // at 1500 rpm it is a little colder than where it has carried more
    near(to - from, rest(&begins), 1e-2);
    assert!(to - from < 0.9 * rest(&without), "{}", rest(&without));
    // coast_down.tolerance
    near(times(&at_once)[1], times(&begins)[1], 2e-3);
    for run in [&comes, &at_once] {
        near(heats(run), 1.0, 2e-5);
        assert!(number(run, "coast_down.relative_heat_residual").abs() < 1e-9);
    }
    // what closes is taken of both sides of the load
    assert!(
        number(&comes, "a.coast_down.life_share")
            > 10.0 * number(&without, "a.coast_down.life_share")
    );
}

/// An unbalance that lifts the rotor again at 8000 rpm, in the drop or in the coast-down.
#[test]
fn an_unbalance_comes_at_a_speed_of_the_coast_down() {
    let sets = [
        "rotor.speed=9000 rpm",
        "run.duration=0.3 s",
        "coast_down.stop_speed=700 rad/s",
    ];
    let text = coasting().replace(
        "[[rotor.unbalance]]",
        "[[rotor.unbalance]]\nname = \"disk\"",
    ) + &brake("below_speed = \"8000 rpm\"", "1e-9 N m")
        .replace("\"brake\"\ndo", "\"mark\"\ndo");
    let blade = |when: &str| {
        let event = format!(
            "[[event]]\nname = \"blade\"\ndo = \"unbalance\"\nplane = \"disk\"\namount = \"150 g mm\"\n{when}\n"
        );
        ran(&(text.clone() + &event), &sets)
    };
    let (without, begins) = (ran(&text, &sets), blade("at = \"1 ms\""));
    let comes = blade("below_speed = \"8000 rpm\"");
    let [from, to] = times(&comes);
    // coast_down.tolerance
    near(from, times(&without)[0], 2e-3);
    let rest = |run: &Outcome| times(run)[1] - times(run)[0];
    // a motion that bounces is one sample
    near(to - from, rest(&begins), 1.5e-2);
    let force = |run: &Outcome| number(run, "a.coast_down.peak_contact_force");
    assert!(force(&comes) > 4.0 * force(&without) && force(&begins) > 4.0 * force(&without));
    near(heats(&comes), heats(&without), 1e-9);
    assert!(number(&comes, "coast_down.relative_heat_residual").abs() < 1e-9);
}

/// What another case has is no obstacle.
#[test]
fn a_coast_down_is_refused_for_what_happens_in_its_own_case() {
    let on = |case: &str, what: &str| {
        format!(
            "[[event]]\ncase = \"{case}\"\ndo = \"{what}\"\nat = \"1 ms\"\ntorque = \"1 N m\"\n"
        )
    };
    let text = coasting()
        + &on("braked", "brake")
        + &on("driven", "drive")
        + "[base]\ncase = \"shock\"\nshock_x = \"5 gn\"\nshock_duration = \"10 ms\"\n";
    let told = |case: &str| parsed(&text, &[&format!("run.case={case}")]).map(|_| ());
    assert_eq!(told("braked"), Ok(()));
    for (case, words) in [
        ("driven", "a drive that stays on"),
        ("shock", "a base that moves"),
    ] {
        let told = told(case).unwrap_err();
        assert!(told.contains(words), "{told}");
    }
}

#[test]
fn what_a_coast_down_cannot_follow_is_refused() {
    let event = |lines: &str| format!("[[event]]\n{lines}\n");
    let rotor = |lines: &str| parsed(&(coasting() + &event(lines)), &[]).unwrap_err();
    let brake = "do = \"brake\"\ntorque = \"1 N m\"\n";
    let magnets = |at: &str, more: &str| {
        parsed(&(lost(at) + &event(more)), &["rotor.speed=3000 rpm"]).unwrap_err()
    };
    let dead = "do = \"sensor dead\"\nbelow_speed = \"1000 rpm\"";
    let again = "do = \"re-levitate\"\nat = \"0.1 s\"\nbias_time = \"1 ms\"";
    for (found, told) in [
        (
            rotor("do = \"drive\"\nat = \"1 ms\"\ntorque = \"1 N m\""),
            "a drive that stays on",
        ),
        (
            rotor(&format!("{brake}at = \"2 s\"")),
            "after run.duration beside",
        ),
        (
            rotor(&format!(
                "name = \"a\"\n{brake}below_speed = \"900 rpm\"\n[[event]]\n{brake}after = \"a\"\ndelay = \"1 s\""
            )),
            "a delay after a speed",
        ),
        (magnets("at = \"20 ms\"", dead), "by a speed"),
        (magnets("at = \"20 ms\"", again), "keep power"),
    ] {
        assert!(
            found.contains(told) && found.contains("standstill") && found.contains("machine.toml:"),
            "{told}: {found}"
        );
    }
}

/// A blade that leaves 2 N of unbalance behind, within an interval of a braked rotor: axis and spin do not jump, so nothing strikes.
#[test]
fn an_unbalance_within_an_interval_does_not_strike() {
    let clearance = "{ value = \"0 um\", assumed = \"what the fits leave\" }";
    let machine = lost("at = \"20 ms\"")
        .replace(clearance, "\"10 um\"")
        .replace("\"10 g mm\"", "\"4 g mm\"");
    let blade = "[[event]]\ndo = \"unbalance\"\nplane = \"wheel\"\namount = \"20 g mm\"\nbelow_speed = \"400 rad/s\"\n";
    let text = machine + &brake("at = \"300 ms\"", "2 N m") + blade;
    let run = ran(&text, &["run.duration=0.6 s"]);
    // ball by ball 44.7 N and 30.5 N
    let force = number(&run, "drive_end.coast_down.peak_contact_force");
    let load = number(&run, "drive_end.coast_down.peak_ball_load");
    assert!(force < 50.0 && load < 36.0, "{force} {load}");
}
