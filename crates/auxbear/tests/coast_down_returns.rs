//! Coast-downs of rotors that do not go on rolling.

use crate::coast_down::{SHIPPED, adds_up_by_bodies, list, number, parsed};
use auxbear::outcome::{Outcome, Value, Verdict, Warning};
use auxbear::run::{Options, run};
use std::sync::atomic::AtomicBool;

/// A coast-down of a rotor that rolls no longer for a while: how many rows each such stretch has, all of it heat.
fn goes_back(found: &Outcome, reason: &str) -> Vec<usize> {
    assert!(
        found.stop.complete() && found.stop.text.contains(reason),
        "{}",
        found.stop.text
    );
    adds_up_by_bodies(found, "coast_down.");
    let course = |name: &str| list(found, &format!("coast_down.over_time.{name}"));
    let (times, speeds) = (course("time"), course("rotor.speed"));
    assert!(times.windows(2).all(|pair| pair[1] > pair[0]));
    assert!(speeds.windows(2).all(|pair| pair[1] < pair[0]));
    let energy = number(found, "coast_down.rotor_energy");
    let heats: f64 = ["speed_dependent", "load_dependent", "windage"]
        .map(|loss| number(found, &format!("coast_down.{loss}_heat")))
        .iter()
        .sum();
    let left = energy * (speeds[speeds.len() - 1] / speeds[0]).powi(2);
    assert!(
        ((heats + left) / energy - 1.0).abs() < 1e-9,
        "{heats} {left} {energy}"
    );
    assert!(number(found, "coast_down.relative_heat_residual") < 1e-9);
    // what a ball carries and how a disturbance grows is known throughout
    assert!(
        course("heat.growth_rate")
            .iter()
            .all(|rate| rate.is_finite())
    );
    let loads = course("bearing.largest_ball_load");
    assert!(loads.iter().all(|load| *load > 0.0));
    let most = loads.iter().copied().fold(0.0, f64::max);
    assert_eq!(most, number(found, "coast_down.peak_ball_load"));
    let (begin, end) = (
        list(found, "coast_down.return_times"),
        list(found, "coast_down.return_end_times"),
    );
    let each = begin.iter().zip(end).map(|(begin, end)| {
        let inside = times.partition_point(|t| t < begin)..times.partition_point(|t| t < end);
        inside.len()
    });
    each.collect()
}

/// Speed of a coast-down at an instant, rad/s.
fn speed_at(found: &Outcome, time: f64) -> f64 {
    let course = |name: &str| list(found, &format!("coast_down.over_time.{name}"));
    let (times, speeds) = (course("time"), course("rotor.speed"));
    let next = times.partition_point(|t| *t < time);
    let share = (time - times[next - 1]) / (times[next] - times[next - 1]);
    speeds[next - 1] + share * (speeds[next] - speeds[next - 1])
}

/// Friction that falls as the bearing warms: a rotor that rolls slides on its race after a while.
#[test]
fn where_friction_no_longer_turns_the_bearing_the_rotor_slides() {
    let never = AtomicBool::new(false);
    let with =
        |sets: &[&str]| run(&parsed(SHIPPED, sets).unwrap(), &Options::unwatched(&never)).unwrap();
    // of rough metal that rolls; through a patch that slides its race would keep at the temperature of the rotor, and slide less
    let contact = "heat.rotor_contact=0.2 W/K";
    let calm = "rotor.unbalance_eccentricity=0.5 um";
    let falls = "contact.friction_over_temperature=[[\"20 degC\", 0.15], [\"25.5 degC\", 0.15], [\"28 degC\", 0.02], [\"200 degC\", 0.02]]";
    let found = with(&[calm, falls, contact]);
    assert!(goes_back(&found, "% of what laws of rolling give")[0] > 4);
    let at = |name: &str| list(&found, &format!("coast_down.{name}"))[0];
    let (begin, end) = (at("return_times"), at("return_end_times"));
    let slides = found.warnings.iter().find(|w| w.code == "AB2318").unwrap();
    let when = format!("Between {begin:.1} s and {end:.1} s");
    assert!(slides.text.contains(&when), "{}", slides.text);
    assert!(found.warnings.iter().all(|w| w.code != "AB2317"));
    // μ W r of both bearings, by hand: asked for in vain where it slides, and not by the laws behind it
    let carried = 0.02 * 8.0 * 9.80665 * (12.5e-3 - 0.25e-3);
    let moments = ["speed_dependent", "load_dependent"]
        .map(|kind| list(&found, &format!("coast_down.over_time.{kind}.moment")));
    let times = list(&found, "coast_down.over_time.time");
    let moment = |row: usize| moments[0][row] + moments[1][row];
    let behind = times.partition_point(|t| *t < end);
    assert!((behind + 1..times.len()).all(|row| moment(row) <= carried));
    let inside =
        times.partition_point(|t| *t < 1.1 * begin)..times.partition_point(|t| *t < 0.9 * end);
    assert!(inside.len() > 10);
    for row in inside {
        let ratio = moment(row) / carried;
        assert!((0.9..1.05).contains(&ratio), "{} {ratio}", times[row]);
    }
    // what friction carries easily stays with the laws
    assert!(list(&with(&[calm]), "coast_down.return_times").is_empty());
}

#[test]
fn a_resonance_that_lifts_the_rotor_is_passed_ball_by_ball() {
    let with = |sets: &[&str]| {
        let soft = ["mount.stiffness=5e5 N/m", "mount.damping=30 N s/m"];
        let never = AtomicBool::new(false);
        let sets = [&soft, sets].concat();
        run(
            &parsed(SHIPPED, &sets).unwrap(),
            &Options::unwatched(&never),
        )
        .unwrap()
    };
    let found = with(&[
        "rotor.unbalance_eccentricity=5 um",
        "rotor.speed=4000 rpm",
        "coast_down.stop_speed=240 rad/s",
    ]);
    let told = "it did not roll: contact force up to";
    assert!(found.stop.text.contains(told), "{}", found.stop.text);
    assert!(number(&found, "coast_down.relative_heat_residual") < 1e-9);
    assert!(found.warnings.iter().any(|w| w.code == "AB2317"));
    // 8 kg with 0.5 kg on 2 · 5e5 N/m: √(k/(m/2 + m_m)) = 333 rad/s, less the farther it swings; laws before it
    let speed = list(&found, "coast_down.return_speeds")[0];
    assert!(
        (0.8..1.0).contains(&(speed / (5e5f64 / 4.5).sqrt())),
        "{speed}"
    );
    assert!(number(&found, "coast_down.start_speed") > 1.2 * speed);
    // ball by ball it leaves its race from 276 to 243 rad/s, with up to 214 N, and has 243.8 rad/s after 80 s
    let force = number(&found, "coast_down.peak_contact_force");
    assert!((180.0..250.0).contains(&force), "{force}");
    let speed = speed_at(&found, 80.0);
    assert!((speed / 243.8 - 1.0).abs() < 3e-3, "{speed}");
    // much more unbalance and less damping, and it whirls out of the model there: no law goes on
    let lost = with(&[
        "mount.damping=10 N s/m",
        "levitation.stiffness=1e7 N/m",
        "rotor.unbalance_eccentricity=200 um",
        "rotor.speed=3600 rpm",
        "coast_down.stop_speed=280 rad/s",
    ]);
    assert_eq!(lost.stop.reason, "left the model");
    // its course goes on to where it ends
    let times = list(&lost, "coast_down.over_time.time");
    assert_eq!(*times.last().unwrap(), lost.stop.time);
    assert!(times.windows(2).all(|pair| pair[1] > pair[0]));
    assert!(
        lost.stop.text.contains("a displacement exceeded"),
        "{}",
        lost.stop.text
    );
}

/// A rotor that bounces on a bearing whose warmth closes it: it runs away, as ball by ball it does after 18.6 s, until friction of rotor and
/// race turns the bearing no longer.
#[test]
fn a_bearing_that_runs_away_while_the_rotor_bounces_seizes_on_its_friction() {
    let text = SHIPPED
        .replace("22 mm^2/s", "100 mm^2/s")
        .replace("4.6 mm^2/s", "11 mm^2/s");
    let sets = [
        "rotor.mass=12 kg",
        "rotor.planes=1",
        "rotor.polar_inertia=0.5 kg m^2",
        "rotor.speed=20000 rpm",
        "rotor.first_bending_frequency=9000 rad/s",
        "rotor.unbalance_eccentricity=4 um",
        "mount.stiffness=1e8 N/m",
        "mount.damping=20000 N s/m",
        "bearing.operating_diametral_clearance=2 um",
        "heat.surroundings=20 W/K",
        "heat.rotor_contact=0 W/K",
        "heat.rotor_capacity=100 J/K",
        "heat.film_thickness=1 um",
        // the bounces of a whole second would take most of the time of the test, and heat no more than the intervals after them
        "run.duration=0.2 s",
    ];
    let never = AtomicBool::new(false);
    let found = run(&parsed(&text, &sets).unwrap(), &Options::unwatched(&never)).unwrap();
    assert_eq!(found.stop.reason, "left the model");
    let away = found.warnings.iter().find(|w| w.code == "AB2311").unwrap();
    assert!(away.text.contains("runs away: from 2"), "{}", away.text);
    let course = |name: &str| list(&found, &format!("coast_down.over_time.{name}"));
    let at = |name: &str, time: f64| {
        let after = course("time").partition_point(|t| *t < time);
        course(name)[after]
    };
    let dents = |w: &&Warning| w.code == "AB1002" && w.text.contains("While it coasts down");
    assert!(found.warnings.iter().find(dents).is_some());
    // the patch that rubs is hotter than the bodies, and no hotter than ball by ball, 598 K
    let race = number(&found, "coast_down.peak_inner_race_temperature") - 298.15;
    let patch = number(&found, "coast_down.contact_temperature_rise");
    assert!(race + 20.0 < patch && patch < 598.0, "{race} {patch}");
    // 84 and 109 W ball by ball
    let [early, late] = [20.0, 30.0].map(|time| at("heat.power", time));
    assert!(
        (80.0..90.0).contains(&early) && late > 1.15 * early,
        "{early} {late}"
    );
    assert!(at("heat.growth_rate", 10.0) < 0.0 && at("heat.growth_rate", 30.0) > 0.0);
    // μ W r: no more reaches the bearing, of M0 and M1 together
    let carried = 0.15 * 12.0 * 9.80665 * (12.5e-3 - 0.25e-3);
    let moments = course("load_dependent.moment")
        .iter()
        .zip(course("speed_dependent.moment"));
    let most = moments.map(|(one, other)| one + other).fold(0.0, f64::max);
    assert!((0.9..1.25).contains(&(most / carried)), "{most} {carried}");
}

/// What is cut off by `run.duration` is said, and the rest goes on as if it had not been.
#[test]
fn a_drop_that_ends_before_its_spin_up_says_so_and_rolls_all_the_same() {
    let never = AtomicBool::new(false);
    let with = |duration: &str| {
        let duration = format!("run.duration={duration}");
        let sets = ["rotor.unbalance_eccentricity=0.5 um", &duration];
        let limits = "[[limit]]\nquantity = \"inner_race_time_to_95_percent\"\nmost = \"1 s\"\n\
            [[limit]]\nquantity = \"peak_contact_force\"\nmost = \"50 kN\"\n";
        let scenario = parsed(&format!("{SHIPPED}\n{limits}"), &sets).unwrap();
        run(&scenario, &Options::unwatched(&never)).unwrap()
    };
    let verdicts = |found: &Outcome, wanted: Verdict| {
        assert!(
            found.limits.iter().all(|own| own.verdict == wanted),
            "{:?}",
            found.limits
        );
    };
    let early = |found: &Outcome| -> Option<String> {
        let each = found.warnings.iter();
        each.clone()
            .find(|w| w.code == "AB2324")
            .map(|w| w.to_string())
    };
    let whole = with("3 s");
    assert_eq!(early(&whole), None);
    verdicts(&whole, Verdict::Pass);
    for (duration, says) in [("10 ms", "still come to their speed"), ("1 ms", "landed")] {
        let found = with(duration);
        assert!(early(&found).unwrap().contains(says));
        // it lasted for longer than the bound, and nobody watched for it
        verdicts(&found, Verdict::Undecided);
        for name in ["stop_time", "peak_inner_race_temperature"] {
            let name = format!("coast_down.{name}");
            let ratio = number(&found, &name) / number(&whole, &name);
            assert!((ratio - 1.0).abs() < 2e-3, "{duration} {name} {ratio}");
        }
        // nothing on the way slides for a race that had not come up
        assert!(list(&found, "coast_down.return_times").is_empty());
    }
}

/// A swing in the air clearance far from any natural frequency of bearings and mounts, which begins after the rotor has rolled.
#[test]
fn an_unbalance_that_swings_the_rotor_in_its_bore_is_followed_ball_by_ball() {
    let sets = [
        "rotor.mass=20 kg",
        "mount.stiffness=1e6 N/m",
        "mount.damping=300 N s/m",
        "rotor.speed=3400 rpm",
        "rotor.unbalance_eccentricity=15 um",
        "run.duration=3 s",
    ];
    let never = AtomicBool::new(false);
    let found = run(
        &parsed(SHIPPED, &sets).unwrap(),
        &Options::unwatched(&never),
    )
    .unwrap();
    assert!(found.stop.complete(), "{}", found.stop.text);
    adds_up_by_bodies(&found, "coast_down.");
    // it swings with √(g/c0) = 198 rad/s, less the farther, from a higher speed on
    let begin = list(&found, "coast_down.return_speeds")[0];
    assert!((170.0..310.0).contains(&begin), "{begin}");
    let force = number(&found, "coast_down.peak_contact_force");
    assert!((1.9..4.0).contains(&(force / (10.0 * 9.80665))), "{force}");
    assert!(found.warnings.iter().any(|w| w.code == "AB2317"));
    // 158.6 rad/s after 100 s ball by ball
    let speed = speed_at(&found, 100.0);
    assert!((speed / 158.6 - 1.0).abs() < 0.01, "{speed}");
}

/// At twice the frequency of the swing unbalance excites it at half its own; it grows from nothing, and is followed on the branch that softens.
#[test]
fn a_swing_of_half_the_speed_is_found_and_followed() {
    let never = AtomicBool::new(false);
    let sets = ["rotor.speed=4000 rpm"];
    let found = run(
        &parsed(SHIPPED, &sets).unwrap(),
        &Options::unwatched(&never),
    )
    .unwrap();
    assert!(found.stop.complete(), "{}", found.stop.text);
    let begin = list(&found, "coast_down.return_speeds")[0];
    let swing = (9.80665f64 / 0.25e-3).sqrt();
    assert!((1.5..2.0).contains(&(begin / swing)), "{begin}");
    // ball by ball 107 N, and 281.0 rad/s after 60 s
    let force = number(&found, "coast_down.peak_contact_force");
    assert!((95.0..120.0).contains(&force), "{force}");
    let speed = speed_at(&found, 60.0);
    assert!((speed / 281.0 - 1.0).abs() < 2e-3, "{speed}");
}

/// Balls of a race that stands under a sliding rotor pass nothing: 8.1e-9 of the life in 40 s ball by ball, not that of the rotor's turns.
#[test]
fn a_race_that_stands_uses_no_life() {
    let never = AtomicBool::new(false);
    let sets = [
        "rotor.speed=5000 rpm",
        "bearing.operating_diametral_clearance=-25 um",
        "contact.friction_coefficient=0.05",
        "coast_down.longest=40 s",
    ];
    let found = run(
        &parsed(SHIPPED, &sets).unwrap(),
        &Options::unwatched(&never),
    )
    .unwrap();
    let share = number(&found, "coast_down.life_share") + number(&found, "life_share");
    // it creeps by chance
    assert!((0.5..2.0).contains(&(share / 8.1e-9)), "{share}");
}

/// A rotor that whirls rolls on its race too, but not under its weight: it is followed, with the heat of its whirl, until its bearing seizes.
#[test]
fn a_rotor_that_whirls_is_followed_until_its_bearing_seizes() {
    let never = AtomicBool::new(false);
    let text = include_str!("../../../scenarios/drop_whirl_seizing.toml");
    let found = run(&parsed(text, &[]).unwrap(), &Options::unwatched(&never)).unwrap();
    assert_eq!(found.stop.reason, "left the model");
    let stop = &found.stop.text;
    assert!(
        stop.contains("It never rolled") && stop.contains("above 350 °C"),
        "{stop}"
    );
    let says = |code: &str, text: &str| {
        let each = found.warnings.iter();
        each.filter(|w| w.code == code)
            .any(|w| w.text.contains(text))
    };
    assert!(says("AB1014", "coast-down, from 2.0 s"));
    assert!(says("AB2311", "runs away: from "));
    // nobody counts on a second drop
    let count = found
        .quantities
        .iter()
        .find(|q| q.name == "drops_until_one_percent_fail");
    assert!(matches!(count.unwrap().value, Value::None { .. }));
    // held at its limits it brakes less, and is followed to the same speed, no farther
    let held = *list(&found, "coast_down.held_times").last().unwrap();
    assert!(held > found.stop.time && held < 60.0, "{held}");
    let course = |name: &str| list(&found, &format!("coast_down.over_time.{name}"));
    let at = |node: &str, time: f64| {
        let (times, values) = (course("time"), course(&format!("{node}.temperature")));
        let after = times.partition_point(|t| *t < time);
        let way = (time - times[after - 1]) / (times[after] - times[after - 1]);
        values[after - 1] + way * (values[after] - values[after - 1]) - 273.15
    };
    // the same file ball by ball for 28 s
    for (time, by_balls) in [
        (5.0, [39.6, 54.8, 71.8]),
        (10.0, [54.2, 75.0, 79.5]),
        (20.0, [88.8, 122.1, 96.6]),
        (25.0, [122.0, 182.1, 117.4]),
        (27.0, [147.8, 235.2, 135.4]),
    ] {
        for (node, expected) in ["inner_race", "balls", "lubricant"].iter().zip(by_balls) {
            let found = at(node, time);
            assert!(
                (found - expected).abs() < 0.5 + 0.01 * (expected - 25.0),
                "{node} {time} {found}"
            );
        }
    }
}
