//! A measurement through its front: the made-up spin-up against the motion it was made from, and files that are wrong.

use crate::measurement_file::{TORQUE, problem, table};
use crate::outcomes::{has_declared_columns, number};
use auxbear::outcome::{Outcome, Value};
use auxbear::run::{Options, build, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;

fn computed(scenario: &Scenario) -> Outcome {
    let outcome = run(scenario, &Options::unwatched(&AtomicBool::new(false))).unwrap();
    has_declared_columns(scenario, &outcome);
    outcome
}

fn example(sets: &[&str]) -> Outcome {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/signals_spin_up.toml");
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    computed(&Scenario::read(&file, &sets, &BuiltIn).unwrap())
}

fn column<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    let column = outcome.history.iter().find(|column| column.name == name);
    &column.unwrap_or_else(|| panic!("no {name}")).values
}

/// The motion of scenarios/data/make_spin_up.py.
const ENGAGED: f64 = 0.3;
const LENGTH: f64 = 0.040;
const PEAK: f64 = 7200.0;
const RISE: f64 = 0.001;
const SLOWING: f64 = 3.0;

fn acceleration(time: f64) -> f64 {
    let fall = PEAK * (LENGTH - RISE) / (150.0 - 0.5 * PEAK * RISE) - 1.0;
    match time - ENGAGED {
        t if t <= 0.0 => 0.0,
        t if t >= LENGTH => -SLOWING,
        t if t < RISE => PEAK * t / RISE,
        t => PEAK * (1.0 - (t - RISE) / (LENGTH - RISE)).powf(fall),
    }
}

fn speed(time: f64) -> f64 {
    let fall = PEAK * (LENGTH - RISE) / (150.0 - 0.5 * PEAK * RISE);
    let rest = |t: f64| 1.0 - (1.0 - (t - RISE) / (LENGTH - RISE)).powf(fall);
    match time - ENGAGED {
        t if t <= 0.0 => 0.0,
        t if t < RISE => 0.5 * PEAK * t * t / RISE,
        t if t < LENGTH => 0.5 * PEAK * RISE + PEAK * (LENGTH - RISE) / fall * rest(t),
        t => 150.0 - SLOWING * (t - LENGTH),
    }
}

/// Share of a history, between two times, whose band of two deviations holds the truth.
fn covered(
    outcome: &Outcome,
    name: &str,
    deviation: &str,
    span: (f64, f64),
    truth: &dyn Fn(f64) -> f64,
) -> f64 {
    let rows = column(outcome, "time")
        .iter()
        .zip(column(outcome, name))
        .zip(column(outcome, deviation));
    let inside: Vec<bool> = rows
        .filter(|((time, _), _)| **time > span.0 && **time < span.1)
        .map(|((time, value), deviation)| (value - truth(*time)).abs() <= 2.0 * deviation)
        .collect();
    assert!(inside.len() > 100, "{name}: {} rows", inside.len());
    inside.iter().filter(|inside| **inside).count() as f64 / inside.len() as f64
}

#[test]
fn a_made_up_spin_up_is_found_within_its_bands() {
    let outcome = example(&[]);
    assert!(outcome.stop.complete(), "{:?}", outcome.stop);
    assert_eq!(number(&outcome, "pulses_repaired_share"), 0.0);
    // the promise of this record's kind: the peak within 3 %
    let peak = number(&outcome, "peak_acceleration");
    assert!((peak / PEAK - 1.0).abs() < 0.03, "{peak}");
    assert!((peak - PEAK).abs() < 3.0 * number(&outcome, "peak_acceleration_deviation"));
    // the acceleration begins with its rise of 1 ms
    let engaged = number(&outcome, "engagement_time");
    assert!((engaged - ENGAGED).abs() < RISE, "{engaged}");
    // One record: rows are correlated, so that the share scatters about 95 % by more than their number would explain.
    for (name, deviation, span, truth) in [
        (
            "shaft.speed",
            "shaft.speed_deviation",
            (0.3, 1.45),
            &speed as &dyn Fn(f64) -> f64,
        ),
        (
            "shaft.acceleration",
            "shaft.acceleration_deviation",
            (0.305, 0.335),
            &acceleration,
        ),
    ] {
        let share = covered(&outcome, name, deviation, span, truth);
        assert!(share > 0.8, "{name}: {share}");
    }
    // friction after the spin-up: 3 + 22 (Ω/150)^(2/3) N mm
    let torque = |time: f64| 1e-3 * (3.0 + 22.0 * (speed(time) / 150.0).powf(2.0 / 3.0));
    let share = covered(
        &outcome,
        "torque.torque",
        "torque.deviation",
        (0.5, 1.4),
        &torque,
    );
    assert!(share > 0.8, "torque: {share}");
    let disturbance = number(&outcome, "largest_synchronous_disturbance");
    assert!((disturbance - 4e-3).abs() < 0.4e-3, "{disturbance}");
    // the cage slips by 0.4 % in the end
    let slip = number(&outcome, "cage_slip_at_end");
    let deviation = number(&outcome, "cage_slip_at_end_deviation");
    assert!(
        (slip - 0.004).abs() < 4.0 * deviation && deviation < 0.002,
        "{slip} {deviation}"
    );
}

#[test]
fn what_is_not_asked_for_is_not_computed() {
    let text = "format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n[signals]\nfile = \"data/spin_up.tdms\"\n";
    let name = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/a.toml");
    let scenario = Scenario::parse(text, &name.display().to_string(), &[], &BuiltIn).unwrap();
    let outcome = computed(&scenario);
    assert!(outcome.stop.complete());
    let names: Vec<&str> = outcome.quantities.iter().map(|q| q.name.as_str()).collect();
    assert_eq!(names, ["channels", "file_notes"]);
    let channels = outcome
        .quantities
        .iter()
        .find(|q| q.name == "channels")
        .unwrap();
    let Value::Text(channels) = &channels.value else {
        panic!("{channels:?}")
    };
    assert!(
        channels.contains("rig/torque (in N mm, 750 values, 500 values a second)"),
        "{channels}"
    );
}

#[test]
fn a_record_that_does_not_carry_the_answer_says_what_would() {
    // to 1 % of its peak no 60 marks sampled at 10 kHz can resolve this acceleration
    let outcome = example(&["signals.speed.wanted=0.001"]);
    assert!(!outcome.stop.complete());
    assert_eq!(outcome.stop.reason, "not answered");
    let refusal = outcome
        .warnings
        .iter()
        .find(|warning| warning.code == "AB1042")
        .unwrap();
    assert!(
        refusal
            .text
            .starts_with("No speed from channel \"rig/tacho\" of spin_up.tdms: ")
            && refusal.text.contains("0.1 % are wanted; needed:"),
        "{}",
        refusal.text
    );
}

/// Marks that are counted wrongly do not pass in silence: a wheel whose 60 marks are off shows that it has not 12.
#[test]
fn wrong_marks_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = String::from("mark,tacho [s]\n");
    for mark in 0..3000_usize {
        let m = mark % 60;
        let off = 0.02 * ((m * (7 * m * m + 5 * m + 11) % 61) as f64 / 61.0 - 0.5);
        let place = mark as f64 + off;
        // some 150 rad/s, slowly falling
        text.push_str(&format!(
            "{mark},{:.9}\n",
            7e-4 * place * (1.0 + 1e-6 * place)
        ));
    }
    fs::write(folder.path().join("run.csv"), text).unwrap();
    let file = folder.path().join("a.toml");
    let asked = "format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n[signals]\nfile = \"run.csv\"\n[signals.speed]\n\
                 channel = \"tacho\"\nkind = \"edges\"\nstamp_deviation = \"0.1 us\"\nmarks_per_revolution = 12\n";
    fs::write(&file, asked).unwrap();
    let codes = |sets: &[String]| {
        let outcome = computed(&Scenario::read(&file, sets, &BuiltIn).unwrap());
        let codes: Vec<&str> = outcome
            .warnings
            .iter()
            .map(|warning| warning.code)
            .collect();
        codes.contains(&"AB1044")
    };
    assert!(codes(&[]));
    assert!(!codes(&[
        "signals.speed.marks_per_revolution=60".to_string()
    ]));
}

/// A resolved file gives the same numbers from another folder.
#[test]
fn the_resolved_file_runs_again() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/signals_spin_up.toml");
    let scenario = Scenario::read(&file, &[], &BuiltIn).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join("scenario.toml");
    fs::write(&copy, scenario.resolved.toml()).unwrap();
    let again = Scenario::read(&copy, &[], &BuiltIn).unwrap();
    assert_eq!(computed(&scenario).quantities, computed(&again).quantities);
}

#[test]
fn a_channel_that_is_not_there_is_reported_with_those_that_are() {
    let speed = "[signals.speed]\nchannel = \"torqe\"\nmarks_per_revolution = 60\n";
    assert_eq!(
        problem("run.csv", &table("N mm", &|_| None), speed),
        "error[AB0304]: a.toml:6: signals.speed.channel: found run.csv, which has no channel \"torqe\"; it has the channels \"time\", \"torque\". Did you mean \"torque\"?"
    );
}

#[test]
fn a_unit_that_is_no_torque_is_reported() {
    let shown = problem("run.csv", &table("N", &|_| None), TORQUE);
    assert!(
        shown.starts_with("error[AB0306]: a.toml:6: signals.torque.channel: found run.csv, channel \"torque\" in \"N\";"),
        "{shown}"
    );
    let both = format!("{TORQUE}scale = \"1 N m\"\n");
    let shown = problem("run.csv", &table("N mm", &|_| None), &both);
    assert!(
        shown.contains("signals.torque.scale") && shown.contains("contradict"),
        "{shown}"
    );
}

#[test]
fn times_that_fall_or_are_uneven_are_reported() {
    let back = |row| (row == 20).then_some("0.0005");
    let shown = problem("run.csv", &table("N mm", &back), TORQUE);
    assert!(
        shown.starts_with(
            "error[AB0305]: a.toml:6: signals.torque.channel: found run.csv, channel \"time\", whose time goes from 0.019 s to 0.0005 s at value 20;"
        ),
        "{shown}"
    );
    let uneven = |row| (row == 20).then_some("0.0205");
    let shown = problem("run.csv", &table("N mm", &uneven), TORQUE);
    assert!(
        shown.contains("AB0305") && shown.contains("not at equal times"),
        "{shown}"
    );
    let whole = table("N mm", &|_| None);
    let rows = whole.lines().enumerate();
    let gap: String = rows
        .filter(|(line, _)| !(22..32).contains(line))
        .map(|(_, row)| format!("{row}\n"))
        .collect();
    let shown = problem("run.csv", &gap, TORQUE);
    assert!(
        shown.contains("a gap of 0.011000 s behind 0.019000 s in channel"),
        "{shown}"
    );
}

#[test]
fn files_that_are_no_measurement_are_reported() {
    let shown = problem("run.tdms", "this is a text\n", "");
    assert!(
        shown.starts_with("error[AB0303]: a.toml:4: signals.file: found run.tdms, which is text"),
        "{shown}"
    );
    let shown = problem("run.tdms", "", "");
    assert!(
        shown.starts_with("error[AB0303]: a.toml:4: signals.file: found run.tdms, which is empty"),
        "{shown}"
    );
    let missing = problem(
        "other.csv",
        "a,b\n1,2\n",
        "from = \"1 s\"\nto = \"2 s\"\n[signals.torque]\nchannel = \"b\"\ntap_file = \"tap.csv\"\n",
    );
    assert!(missing.contains("AB0"), "{missing}");
}

/// Clipped, missing: values that are left out are reported, and the run goes on.
#[test]
fn clipped_and_missing_torque_is_reported() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = String::from("time,torque\ns,N mm\n");
    for row in 0..4000 {
        let time = row as f64 * 0.001;
        let noise = ((row * 7919) % 1000) as f64 / 1000.0 - 0.5;
        let value = (6.0 * (30.0 * time).sin() + noise).clamp(-5.0, 5.0);
        let cell = if (100..103).contains(&row) {
            String::new()
        } else {
            format!("{value:.4}")
        };
        text.push_str(&format!("{time:.3},{cell}\n"));
    }
    fs::write(folder.path().join("run.csv"), text).unwrap();
    let file = folder.path().join("a.toml");
    let asked = format!(
        "format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n[signals]\nfile = \"run.csv\"\n{TORQUE}sensor_frequency = \"30 Hz\"\ndamping_ratio = 0.2\n"
    );
    fs::write(&file, asked).unwrap();
    let outcome = computed(&Scenario::read(&file, &[], &BuiltIn).unwrap());
    assert_eq!(number(&outcome, "torque_missing_values"), 3.0);
    assert!(number(&outcome, "torque_clipped_values") > 100.0);
    let shown: Vec<&str> = outcome
        .warnings
        .iter()
        .filter(|w| w.code == "AB1041")
        .map(|w| w.text.as_str())
        .collect();
    assert!(
        shown
            .iter()
            .any(|text| text.starts_with("Channel torque:") && text.contains("clipped")),
        "{shown:?}"
    );
}

/// A reading at its limit says that the torque is there or beyond: no torque is given there, and the peak not at all.
#[test]
fn a_torque_that_was_clipped_has_no_peak() {
    let whole = example(&[]);
    assert!(number(&whole, "peak_torque") > 20e-3);
    let outcome = example(&[
        "signals.converter.channels=[\"rig/torque\"]",
        "signals.converter.highest=35",
        "signals.converter.lowest=-29",
        "signals.converter.bits=14",
    ]);
    assert!(outcome.stop.complete(), "{:?}", outcome.stop);
    assert!(number(&outcome, "torque_clipped_values") > 10.0);
    for name in [
        "peak_torque",
        "peak_torque_deviation",
        "time_of_peak_torque",
    ] {
        let quantity = outcome.quantity(name);
        match &quantity.unwrap().value {
            Value::None { why } => assert!(why.contains("clipped at"), "{why}"),
            other => panic!("{name}: {other:?}"),
        }
    }
    let torque = |time: f64| 1e-3 * (3.0 + 22.0 * (speed(time) / 150.0).powf(2.0 / 3.0));
    let rows = column(&outcome, "time")
        .iter()
        .zip(column(&outcome, "torque.torque"))
        .zip(column(&outcome, "torque.deviation"))
        .filter(|((time, _), _)| **time > 0.35 && **time < 1.4);
    let (mut shown, mut inside, mut hidden) = (0.0, 0.0, 0.0);
    for ((time, value), deviation) in rows {
        if value.is_nan() {
            assert!(deviation.is_nan());
            hidden += 1.0;
            continue;
        }
        shown += 1.0;
        inside += f64::from((value - torque(*time)).abs() <= 2.0 * deviation);
    }
    println!("given {shown}, inside {inside}, hidden {hidden}");
    assert!(hidden > 100.0, "{hidden}");
    assert!(shown > 500.0, "{shown}");
    // one record, whose rows are correlated
    assert!(inside >= 0.8 * shown, "{inside} of {shown}");
    assert!(
        outcome
            .warnings
            .iter()
            .any(|w| w.code == "AB1043" && w.text.contains("the torque is unknown for")),
        "{:?}",
        outcome.warnings
    );
}

/// A slip that no cage has at speed names the counts that would explain it.
#[test]
fn wrong_counts_of_balls_and_marks_are_reported() {
    let shown = |sets: &[&str]| {
        let outcome = example(sets);
        let doubts = outcome.warnings.iter().filter(|w| w.code == "AB1045");
        doubts.map(|w| w.to_string()).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(shown(&[]), "");
    for (set, right) in [
        (
            "signals.cage.ball_count=5",
            "10 balls instead of 5 (signals.cage.ball_count)",
        ),
        ("signals.cage.ball_count=9", "10 balls instead of 9"),
        ("signals.cage.ball_count=20", "10 balls instead of 20"),
        (
            "signals.speed.marks_per_revolution=30",
            "60 marks per revolution instead of 30 (signals.speed.marks_per_revolution)",
        ),
    ] {
        let shown = shown(&[set]);
        assert!(
            shown.starts_with(
                "Channel \"rig/ball_pass\" of spin_up.tdms: the cage rests at a slip of"
            ) && shown.contains(right),
            "{set}: {shown}"
        );
    }
}

#[test]
fn a_spectrum_of_the_torque_ends_where_it_holds_something() {
    let end = |sets: &[&str]| {
        let outcome = example(sets);
        let quantity = outcome.quantities.iter();
        let quantity = quantity.filter(|q| q.name == "torque_spectrum_frequencies");
        match quantity.map(|q| &q.value).next() {
            Some(Value::List(list)) => list.last().copied().unwrap(),
            other => panic!("{other:?}"),
        }
    };
    // the sensor swings at 30 Hz, order 1 is at 24 Hz, half of the rate at 250 Hz
    let own = end(&[]);
    assert!((85.0..130.0).contains(&own), "{own}");
    let asked = end(&["signals.torque.highest_frequency=60 Hz"]);
    assert!(asked <= 60.0 && asked > 55.0, "{asked}");
    let all = end(&["signals.torque.highest_frequency=250 Hz"]);
    assert!(all > 245.0, "{all}");
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/signals_spin_up.toml");
    for asked in ["0.01 Hz", "251 Hz"] {
        let set = format!("signals.torque.highest_frequency={asked}");
        let scenario = Scenario::read(&file, &[set], &BuiltIn).unwrap();
        let shown = match build(&scenario) {
            Ok(_) => panic!("{asked} is taken"),
            Err(problem) => problem.to_string(),
        };
        // 1.5 s in four: lines 2.7 Hz apart
        assert!(
            shown.contains("signals.torque.highest_frequency")
                && shown.contains("from 10.6")
                && shown.contains("to 250 Hz is needed"),
            "{shown}"
        );
    }
}

#[test]
fn a_temperature_is_no_signal_of_a_sensor() {
    for (section, more) in [
        ("speed", ""),
        (
            "cage",
            "[signals.speed]\nchannel = \"time\"\nkind = \"edges\"\nstamp_deviation = \"1 us\"\nmarks_per_revolution = 60\n",
        ),
    ] {
        let keys = match section {
            "speed" => "marks_per_revolution = 60\n",
            _ => "ball_count = 10\nrolling_ratio = 0.4\n",
        };
        let text = format!("{more}[signals.{section}]\nchannel = \"torque\"\n{keys}");
        let shown = problem("run.csv", &table("K", &|_| None), &text);
        assert!(
            shown.contains("AB0306")
                && shown.contains(&format!("signals.{section}.channel"))
                && shown.contains("channel \"torque\" in \"K\", a temperature"),
            "{shown}"
        );
    }
}

#[test]
fn keys_without_their_channel_are_refused() {
    let shown = |more: &str| {
        let text = format!(
            "format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n[signals]\nfile = \"a.tdms\"\n{more}"
        );
        Scenario::parse(&text, "a.toml", &[], &BuiltIn)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        shown("[signals.speed]\nmarks_per_revolution = 60\n"),
        "error[AB0110]: a.toml:6: signals.speed.marks_per_revolution: found a key that has no effect; signals.speed.channel is needed with it"
    );
    assert_eq!(
        shown("[signals.speed]\nchannel = \"tacho\"\n"),
        "error[AB0107]: a.toml: signals.speed.marks_per_revolution: found no value; with signals.speed.channel a whole number from 1 to 100000 is needed, e.g. 60"
    );
    let cage = shown("[signals.cage]\nchannel = \"balls\"\nball_count = 10\nrolling_ratio = 0.4\n");
    assert!(
        cage.contains("signals.speed.channel: found no value"),
        "{cage}"
    );
}

/// A sensor near the turning frequency is worse than its neighbours; the inversion is better than the reading at every
/// frequency.
#[test]
fn the_choice_of_a_sensor_is_shown() {
    let outcome = example(&["signals.torque.design_until=0.3 s"]);
    let list = |name: &str| {
        let quantity = outcome.quantity(name);
        match quantity.map(|quantity| &quantity.value) {
            Some(Value::List(list)) => list.clone(),
            other => panic!("{name}: {other:?}"),
        }
    };
    let (frequencies, raw, inverted) = (
        list("sensor_design_frequencies"),
        list("sensor_design_raw_errors"),
        list("sensor_design_inverted_errors"),
    );
    assert!(frequencies.len() >= 6);
    assert!(
        raw.iter()
            .zip(&inverted)
            .all(|(raw, inverted)| inverted < raw)
    );
    let at = |wanted: f64| {
        let place = frequencies.iter().position(|f| *f == wanted);
        raw[place.expect("it is compared")]
    };
    // 150 rad/s are 23.9 turns a second: an arm of 25 Hz swings with them, a softer and a stiffer one less
    assert!(at(25.0) > at(18.0) && at(25.0) > at(50.0), "{raw:?}");
}

/// A damping ratio that is wrong by ten changes the torque by half: one that stops every swing does not pass in silence.
#[test]
fn a_damping_ratio_without_swing_is_reported() {
    let shown = |ratio: &str| {
        let outcome = example(&[&format!("signals.torque.damping_ratio={ratio}")]);
        let mut notes = outcome.warnings.iter().filter(|w| w.code == "AB1043");
        notes.any(|w| {
            w.text
                .starts_with(&format!("Torque: a damping ratio of {ratio} is that"))
        })
    };
    assert!(!shown("0.2"));
    assert!(shown("2"));
}
