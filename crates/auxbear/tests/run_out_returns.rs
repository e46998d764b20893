//! A run-out that goes back from laws to motion, and on by laws.

use crate::run_out::{SHIPPED, adds_up_by_bodies, list, number, parsed};
use auxbear::result::outcome::{Outcome, Value, Warning};
use auxbear::run::{Options, run};
use std::sync::atomic::AtomicBool;

/// A run-out that goes back from laws to windows: how many rows each return has, all of it heat, nothing lost or made at a change.
fn goes_back(found: &Outcome, reason: &str) -> Vec<usize> {
    assert!(
        found.stop.complete() && found.stop.text.contains(reason),
        "{}",
        found.stop.text
    );
    adds_up_by_bodies(found, "run_out.");
    let course = |name: &str| list(found, &format!("run_out.over_time.{name}"));
    let (times, speeds) = (course("time"), course("rotor.speed"));
    assert!(times.windows(2).all(|pair| pair[1] > pair[0]));
    assert!(speeds.windows(2).all(|pair| pair[1] < pair[0]));
    let energy = number(found, "run_out.rotor_energy");
    let heats: f64 = ["speed_dependent", "load_dependent", "windage"]
        .map(|loss| number(found, &format!("run_out.{loss}_heat")))
        .iter()
        .sum();
    let left = energy * (speeds[speeds.len() - 1] / speeds[0]).powi(2);
    assert!(
        ((heats + left) / energy - 1.0).abs() < 1e-9,
        "{heats} {left} {energy}"
    );
    assert!(number(found, "run_out.relative_heat_residual") < 1e-9);
    // what a ball carries and how a disturbance grows is known throughout
    assert!(
        course("heat.growth_rate")
            .iter()
            .all(|rate| rate.is_finite())
    );
    let loads = course("bearing.largest_ball_load");
    assert!(loads.iter().all(|load| *load > 0.0));
    let most = loads.iter().copied().fold(0.0, f64::max);
    assert_eq!(most, number(found, "run_out.peak_ball_load"));
    let (begin, end) = (
        list(found, "run_out.return_times"),
        list(found, "run_out.return_end_times"),
    );
    let changes = list(found, "run_out.return_changes_of_model");
    let each = begin
        .iter()
        .zip(end)
        .zip(changes)
        .map(|((begin, end), change)| {
            let lost =
                energy * (1.0 - (speeds[times.partition_point(|t| t < end)] / speeds[0]).powi(2));
            assert!(
                *change != 0.0 && change.abs() < 1e-3 * lost,
                "{change} {lost}"
            );
            let inside = times.partition_point(|t| t < begin)..times.partition_point(|t| t < end);
            inside.len()
        });
    each.collect()
}

#[test]
fn where_friction_hardly_carries_the_bearing_the_run_out_is_followed_ball_by_ball() {
    let never = AtomicBool::new(false);
    let with =
        |sets: &[&str]| run(&parsed(SHIPPED, sets).unwrap(), &Options::unwatched(&never)).unwrap();
    let found = with(&["contact.friction_coefficient=0.03"]);
    assert!(goes_back(&found, "hardly carries what the bearing brakes")[0] > 4);
    // it slides and stays down: a turn takes the life that laws say, under the weight
    let a_turn = |run: &Outcome| number(run, "run_out.life_share") / number(run, "run_out.turns");
    let ratio = a_turn(&found) / a_turn(&with(&[]));
    assert!((0.95..1.15).contains(&ratio), "{ratio}");
    // it slides from the beginning on, and is reported for all of that time, with the way of it: heat over μ W of both sides
    let slides = found.warnings.iter().find(|w| w.code == "AB2318").unwrap();
    assert!(
        slides.text.contains("Between 1.0 s and "),
        "{}",
        slides.text
    );
    let words: Vec<&str> = slides.text.split_whitespace().collect();
    let before = |word: &str| -> f64 {
        let at = words.iter().position(|one| *one == word).unwrap();
        words[at - 1].parse().unwrap()
    };
    let force = before("J") / before("m");
    assert!((force / (0.03 * 8.0 * 9.80665) - 1.0).abs() < 1e-3);
    // μ W r over 1.2 of each bearing, by hand: lost before the return, carried behind it
    let carried = 0.03 * 4.0 * 9.80665 * (12.5e-3 - 0.25e-3) / 1.2;
    let moments = ["speed_dependent", "load_dependent"]
        .map(|kind| list(&found, &format!("run_out.over_time.{kind}.moment")));
    let times = list(&found, "run_out.over_time.time");
    let behind = times.partition_point(|t| *t < list(&found, "run_out.return_end_times")[0]);
    let each = |row: usize| 0.5 * (moments[0][row] + moments[1][row]);
    assert!((behind..times.len()).all(|row| each(row) <= carried));
    let before = times.partition_point(|t| *t < list(&found, "run_out.return_times")[0]);
    assert!(each(before) > 0.98 * carried, "{} {carried}", each(before));
    // what friction carries easily stays with the laws
    assert!(list(&with(&[]), "run_out.return_times").is_empty());
}

#[test]
fn a_resonance_that_lifts_the_rotor_is_passed_ball_by_ball() {
    let with = |unbalance: &str, damping: &str| {
        let unbalance = format!("rotor.unbalance_eccentricity={unbalance}");
        let damping = format!("mount.damping={damping}");
        let sets = [
            "mount.stiffness=5e5 N/m",
            &damping,
            &unbalance,
            "coast_down.stop_speed=320 rad/s",
        ];
        let never = AtomicBool::new(false);
        run(
            &parsed(SHIPPED, &sets).unwrap(),
            &Options::unwatched(&never),
        )
        .unwrap()
    };
    // what bounces is chaotic: whether it rolled before, and how far it is lifted, turns on little
    let told = "ball by ball again, near the natural frequency of 331 rad/s";
    let unbalances = ["80 um", "90 um", "85 um", "70 um"];
    let found = (unbalances.into_iter())
        .map(|unbalance| with(unbalance, "30 N s/m"))
        .find(|found| found.stop.complete() && found.stop.text.contains(told))
        .expect("one of them is lifted");
    // in steps of 1.5 % from 1.05 of it to where the run stops, at 0.97
    let in_steps = list(&found, "run_out.over_time.time").iter();
    let again = list(&found, "run_out.return_times")[0];
    assert!(in_steps.filter(|time| **time >= again).count() > 5);
    assert!(number(&found, "run_out.relative_heat_residual") < 1e-9);
    let frequency = list(&found, "run_out.passed_frequencies")[0];
    let speed = list(&found, "run_out.return_speeds")[0];
    // from where windows lose more on the way there
    let ratio = speed / frequency;
    assert!((1.04..2.01).contains(&ratio), "{ratio}");
    assert!(list(&found, "run_out.resonance_excess")[0] > 0.1);
    // laws before it: the windows of the beginning had ended
    assert!(number(&found, "run_out.start_speed") > speed);
    assert!(found.warnings.iter().any(|w| w.code == "AB2317"));
    // lifted off the balls: more than unbalance and half the weight at rest, and told where it is more than the drop before it had
    let force = number(&found, "run_out.peak_contact_force");
    assert!(
        force > 4.0 * (9.81 + 1e-4 * frequency * frequency),
        "{force}"
    );
    let harder = force > number(&found, "peak_contact_force");
    let told = found.warnings.iter().any(|w| w.code == "AB2323");
    assert_eq!(told, harder, "{force}");
    // 8 kg with 0.5 kg on 2 · 5e5 N/m, softer by balls and landing: below √(k/(m/2 + m_m)) = 333 rad/s
    assert!((0.97..1.0).contains(&(frequency / (5e5f64 / 4.5).sqrt())));
    // more unbalance, and it whirls out of the model there: no law goes on
    let lost = with("200 um", "30 N s/m");
    assert_eq!(lost.stop.reason, "left the model");
    // its course goes on to where it ends
    let times = list(&lost, "run_out.over_time.time");
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
    ];
    let never = AtomicBool::new(false);
    let found = run(&parsed(&text, &sets).unwrap(), &Options::unwatched(&never)).unwrap();
    assert_eq!(found.stop.reason, "left the model");
    let away = found.warnings.iter().find(|w| w.code == "AB2311").unwrap();
    assert!(away.text.contains("runs away: from 2"), "{}", away.text);
    let course = |name: &str| list(&found, &format!("run_out.over_time.{name}"));
    let at = |name: &str, time: f64| {
        let after = course("time").partition_point(|t| *t < time);
        course(name)[after]
    };
    let dents = |w: &&Warning| w.code == "AB1002" && w.text.contains("While it runs out");
    assert!(found.warnings.iter().find(dents).is_some());
    // the patch that rubs is hotter than the bodies, and no hotter than ball by ball, 598 K
    let race = number(&found, "run_out.peak_inner_race_temperature") - 298.15;
    let patch = number(&found, "run_out.contact_temperature_rise");
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
        let scenario = parsed(SHIPPED, &sets).unwrap();
        run(&scenario, &Options::unwatched(&never)).unwrap()
    };
    let early = |found: &Outcome| -> Option<String> {
        let each = found.warnings.iter();
        each.clone()
            .find(|w| w.code == "AB2324")
            .map(|w| w.text.clone())
    };
    let whole = with("3 s");
    assert_eq!(early(&whole), None);
    for (duration, says) in [("10 ms", "still come to their speed"), ("1 ms", "landed")] {
        let found = with(duration);
        assert!(early(&found).unwrap().contains(says));
        for name in ["stop_time", "peak_inner_race_temperature"] {
            let name = format!("run_out.{name}");
            let ratio = number(&found, &name) / number(&whole, &name);
            assert!((ratio - 1.0).abs() < 2e-3, "{duration} {name} {ratio}");
        }
        // no window at the natural frequency slides for a race that had not come up
        assert!(list(&found, "run_out.resonance_excess")[0].abs() < 0.02);
        assert!(list(&found, "run_out.return_times").is_empty());
    }
}

/// Of an unbalance that swings the rotor in its bore the run-out by laws warns, and of a small one not.
#[test]
fn a_swing_that_laws_do_not_see_is_warned_of() {
    let never = AtomicBool::new(false);
    let says = |unbalance: &str| {
        let unbalance = format!("rotor.unbalance_eccentricity={unbalance}");
        let sets = ["rotor.speed=3400 rpm", "run.duration=2 s", &unbalance];
        let scenario = parsed(SHIPPED, &sets).unwrap();
        let found = run(&scenario, &Options::unwatched(&never)).unwrap();
        let each = found.warnings.into_iter();
        each.filter(|w| w.code == "AB2325")
            .map(|w| w.text)
            .collect::<Vec<_>>()
    };
    assert_eq!(says("5 um"), Vec::<String>::new());
    // √(g/c0), and no more than where laws begin
    let [text] = says("8 um").try_into().unwrap();
    assert!(text.contains("swings with 198 rad/s"), "{text}");
}

/// A rotor that whirls rolls on its race too, but not under its weight: windows follow it, and the heat of its whirl, until its bearing seizes.
#[test]
fn a_rotor_that_whirls_is_followed_in_windows_until_its_bearing_seizes() {
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
    assert!(says("AB1014", "runs out: from 2.0 s"));
    // ball by ball from 11.9 s on
    assert!(says("AB2311", "runs away: from 12."));
    // nobody counts on a second drop
    let count = found
        .quantities
        .iter()
        .find(|q| q.name == "drops_until_one_percent_fail");
    assert!(matches!(count.unwrap().value, Value::None { .. }));
    // held at its limits it brakes less, and is followed to the same speed, no farther
    let held = *list(&found, "run_out.held_times").last().unwrap();
    assert!(held > found.stop.time && held < 60.0, "{held}");
    let course = |name: &str| list(&found, &format!("run_out.over_time.{name}"));
    let at = |node: &str, time: f64| {
        let (times, values) = (course("time"), course(&format!("{node}.temperature")));
        let after = times.partition_point(|t| *t < time);
        let way = (time - times[after - 1]) / (times[after] - times[after - 1]);
        values[after - 1] + way * (values[after] - values[after - 1]) - 273.15
    };
    // the same file ball by ball for 40 s
    for (time, by_balls) in [
        (5.0, [38.9, 54.1, 71.7]),
        (10.0, [52.3, 70.2, 78.6]),
        (20.0, [77.1, 94.3, 89.1]),
        (30.0, [111.8, 139.2, 107.8]),
        (35.0, [150.9, 198.3, 132.3]),
    ] {
        for (node, expected) in ["inner_race", "balls", "lubricant"].iter().zip(by_balls) {
            let found = at(node, time);
            assert!((found - expected).abs() < 2.0, "{node} {time} {found}");
        }
    }
}
