//! What happens to a machine during a run: `[[event]]`.

use crate::machine::{STIFF, parsed, ran};
use crate::outcomes::number;
use auxbear::outcome::{Outcome, Value};

const AGAIN: &str = include_str!("../../../scenarios/machine_relevitation.toml");
const AXIS: &str = include_str!("../../../scenarios/machine_axis_lost.toml");

fn codes(outcome: &Outcome) -> Vec<&str> {
    outcome.warnings.iter().map(|own| own.code).collect()
}

/// The file without its events, with others.
fn with_events(text: &str, events: &str) -> String {
    let (before, _) = text.split_once("[[event]]").unwrap();
    format!("{before}{events}")
}

#[test]
fn a_rotor_is_levitated_again_where_its_coils_have_the_current() {
    let held = ran(AGAIN, &[]);
    assert!(held.stop.complete(), "{:?}", held.stop);
    assert_eq!(number(&held, "relevitation_held"), 1.0);
    assert!((number(&held, "event.again.time") - 0.3).abs() < 1e-12);
    assert!((number(&held, "power_lost_at") - 0.02).abs() < 1e-12);
    let last = number(&held, "relevitation_last_contact");
    assert!((0.3..0.5).contains(&last), "{last}");
    assert!(!codes(&held).contains(&"AB2082"));
    let weak = ran(AGAIN, &["event.amplifiers.largest_current=2.5 A"]);
    assert_eq!(number(&weak, "relevitation_held"), 0.0);
    assert!(codes(&weak).contains(&"AB2082"), "{:?}", codes(&weak));
    let coil = number(&weak, "magnet.drive_end.largest_coil_current_1");
    // 2.575 A at the loss, before the new limit
    assert!(coil > 2.57 && coil < 2.58, "{coil}");
}

/// Each of two re-levitations is judged until the next loss of power; names without an event are those of the last.
#[test]
fn each_re_levitation_has_a_verdict() {
    let event = |name: &str, what: &str, at: &str| {
        format!("[[event]]\nname = \"{name}\"\ndo = \"{what}\"\nat = \"{at}\"\n")
    };
    let again = |name: &str, at: &str| {
        event(name, "re-levitate", at) + "bias_time = \"20 ms\"\nreference_time = \"50 ms\"\n"
    };
    let limit = |name: &str, at: &str, most: &str| {
        event(name, "amplifier limit", at) + &format!("largest_current = \"{most}\"\n")
    };
    let events = event("lost", "power lost", "20 ms")
        + &limit("strong", "20 ms", "5 A")
        + &again("first", "0.3 s")
        + &event("lost_again", "power lost", "0.6 s")
        + &limit("weak", "0.6 s", "2.5 A")
        + &again("second", "0.88 s");
    let run = ran(&with_events(AGAIN, &events), &["run.duration=1.2 s"]);
    let of = |name: &str| {
        ["first", "second"].map(|event| number(&run, &format!("event.{event}.{name}")))
    };
    assert_eq!(of("held"), [1.0, 0.0]);
    assert_eq!(number(&run, "relevitation_held"), 0.0);
    let [strong, weak] = of("largest_current");
    assert!(
        strong > 2.5 && strong <= 5.001 && weak > 2.4 && weak < 2.501,
        "{strong} {weak}"
    );
    let [first, second] = of("last_contact");
    assert!(
        (0.3..0.5).contains(&first) && second > 1.0,
        "{first} {second}"
    );
    assert_eq!(number(&run, "relevitation_last_contact"), second);
    let after = number(&run, "event.first.held_after");
    assert!((0.0..0.2).contains(&after), "{after}");
    let told = |code: &str| -> Vec<String> {
        let all = run.warnings.iter().filter(|own| own.code == code);
        all.map(|own| own.text.clone()).collect()
    };
    let [not_held] = &told("AB2082")[..] else {
        panic!("{:?}", told("AB2082"));
    };
    assert!(
        not_held.contains("0.1 s without are asked before the end of the run at 1.2000 s"),
        "{not_held}"
    );
}

/// Its brake takes 2 N m off the spin, and the bearing a little more once the rotor lies in it.
#[test]
fn an_event_waits_for_its_speed_and_others_for_it() {
    let run = ran(AXIS, &[]);
    assert!(run.stop.complete(), "{:?}", run.stop);
    assert!((number(&run, "event.axis_lost.time") - 0.02).abs() < 1e-12);
    assert!((number(&run, "event.braking.time") - 0.07).abs() < 1e-12);
    let lost = number(&run, "event.all_lost.time");
    assert!((number(&run, "power_lost_at") - lost).abs() < 1e-12);
    let speed = number(&run, "speed_at_power_loss");
    assert!(
        (speed / (4000.0 * std::f64::consts::PI / 30.0) - 1.0).abs() < 1e-8,
        "{speed}"
    );
    // with k_s gone the axis falls freely, and a dead sensor leaves it k_s
    assert!(number(&run, "event.axis_lost.growth").abs() < 1e-2);
    let dead = with_events(
        AXIS,
        "[[event]]\ndo = \"sensor dead\"\nat = \"5 ms\"\nmagnet = \"drive_end\"\naxis = 1\n",
    );
    let dead = ran(&dead, &["run.duration=20 ms"]);
    let growth = number(&dead, "event.1.growth");
    assert!((50.0..400.0).contains(&growth), "{growth}");
    assert!(codes(&dead).contains(&"AB2084"));
    let never = ran(AXIS, &["run.duration=30 ms"]);
    assert!(codes(&never).contains(&"AB2083"));
}

/// Landed and by a speed, an event of the same instant does the same; so does the key of a brake.
#[test]
fn the_same_event_by_instant_and_by_key_is_the_same_run() {
    let keys = [
        "run.duration=60 ms",
        "rotor.spin=braked",
        "rotor.brake_torque=2 N m",
        "rotor.brake_start=5 ms",
        "levitation.power_lost_at=10 ms",
    ];
    let by_keys = ran(&with_events(AXIS, ""), &keys);
    let events = "[[event]]\ndo = \"power lost\"\nat = \"10 ms\"\n[[event]]\ndo = \"brake\"\nat = \"15 ms\"\ntorque = \"2 N m\"\n";
    let by_events = ran(&with_events(AXIS, events), &["run.duration=60 ms"]);
    for name in [
        "drive_end.peak_contact_force",
        "rotor_final_speed",
        "power_lost_at",
    ] {
        let pair = [number(&by_keys, name), number(&by_events, name)];
        assert_eq!(pair[0].to_bits(), pair[1].to_bits(), "{name}: {pair:?}");
    }
}

/// A drive that comes on and goes off again turns a rotor that touches nothing by T t/I.
#[test]
fn a_drive_comes_on_and_goes_off() {
    let event = |at: &str, torque: &str| {
        format!("[[event]]\ndo = \"drive\"\nat = \"{at}\"\ntorque = \"{torque}\"\n")
    };
    let events = event("1 ms", "2 N m") + &event("3 ms", "0 N m");
    let sets = ["run.duration=4 ms", "contact.radial_air_clearance=5 mm"];
    let run = ran(&format!("{STIFF}\n{events}"), &sets);
    let faster = number(&run, "rotor_final_speed") - 300.0 * std::f64::consts::PI;
    // disk and shaft
    let inertia = 0.01 + 100.0 * 0.3 * std::f64::consts::PI * 0.04_f64.powi(4) / 32.0;
    let expected = 2.0 * 2e-3 / inertia;
    assert!(
        (faster / expected - 1.0).abs() < 1e-5,
        "{faster} {expected}"
    );
    assert!(number(&run, "energy_residual").abs() < 1e-6);
    let held = parsed(&format!("{STIFF}\n{events}"), &["rotor.spin=held"]);
    assert!(held.unwrap_err().contains("held"));
}

/// Noise moves a rotor that would stand still, by values of its seed, and a sampled controller sees one a sample.
#[test]
fn a_sensor_with_noise_moves_the_rotor() {
    let noise = |more: &str| {
        let own = "[[event]]\ndo = \"sensor noise\"\nat = \"1 ms\"\nmagnet = \"drive_end\"\ndeviation = \"1 um\"\n";
        with_events(AXIS, &format!("{own}{more}\n"))
    };
    let sets = ["run.duration=10 ms", "rotor.unbalance.wheel.amount=0 g mm"];
    let scatter = |text: &str| {
        let run = ran(text, &sets);
        assert!(codes(&run).contains(&"AB2084"), "{:?}", codes(&run));
        let values = &run.column("drive_end.rotor.x").expect("a column").values;
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares = values.iter().map(|value| (value - mean).powi(2));
        (squares.sum::<f64>() / values.len() as f64).sqrt()
    };
    let quick = scatter(&noise("period = \"50 us\"\nseed = 3"));
    // far less than the noise, which the rotor follows slowly; and no less than a hundredth
    assert!((1e-8..1e-6).contains(&quick), "{quick}");
    let again = scatter(&noise("period = \"50 us\"\nseed = 3"));
    assert_eq!(quick.to_bits(), again.to_bits());
    let other = scatter(&noise("period = \"50 us\"\nseed = 4"));
    assert_ne!(quick.to_bits(), other.to_bits());
    let refused = |text: &str| parsed(text, &[]).unwrap_err();
    assert!(refused(&noise("")).contains("period is needed"));
    assert!(refused(&noise("period = \"1 ns\"")).contains("values in the run"));
}

/// A constant force moves the mass centre of a free rotor by F t²/(2m), its work is in the ledger, and a force that is none changes no bit.
#[test]
fn a_force_from_outside_accelerates_the_rotor() {
    let text = STIFF.replace("40 g mm", "0 g mm");
    let with = |x: &str| {
        format!(
            "{text}\n[[rotor.force]]\nname = \"shaker\"\nat = \"0.15 m\"\ntimes = [\"0 s\", \"1 s\"]\nx = [\"{x}\", \"{x}\"]\n"
        )
    };
    let sets = ["run.duration=2 ms"];
    let free = ran(&text, &sets);
    let pushed = ran(&with("60 N"), &sets);
    let last = |run: &Outcome| {
        let column = run.column("a.rotor.x").expect("a column of the place");
        column.values.last().copied().unwrap()
    };
    let expected = 0.5 * 60.0 / number(&free, "rotor_mass") * 4e-6;
    let moved = last(&pushed) - last(&free);
    assert!((moved / expected - 1.0).abs() < 1e-4, "{moved} {expected}");
    assert!(number(&pushed, "energy_residual").abs() < 1e-6);
    let refused = |lines: &str| {
        parsed(
            &format!("{text}\n[[rotor.force]]\nat = \"0.15 m\"\n{lines}\n"),
            &[],
        )
        .unwrap_err()
    };
    assert!(refused("times = [\"1 s\", \"0 s\"]").contains("rise"));
    assert!(
        refused("times = [\"0 s\", \"1 s\"]\nx = [\"1 N\", \"1 N\", \"1 N\"]").contains("2 times")
    );
    assert!(refused("times = [\"0\", \"1\"]").contains("unit"));
}

/// One axis lost at the start leaves the others their power; a re-levitation of a rotor that has its power is none.
#[test]
fn what_happens_at_the_start_and_what_cannot_happen_does_not_comfort() {
    let lost = "[[event]]\nname = \"lost\"\ndo = \"axis lost\"\nat = \"0 s\"\nmagnet = \"drive_end\"\naxis = 1\n";
    let run = ran(&with_events(AXIS, lost), &["run.duration=15 ms"]);
    assert!(number(&run, "drive_end.contact_count") > 0.0);
    assert_eq!(number(&run, "other_end.contact_count"), 0.0);
    assert_eq!(number(&run, "release_time"), 0.0);
    let kept = "[[event]]\ndo = \"power lost\"\nbelow_speed = \"1000 rpm\"\n[[event]]\ndo = \"re-levitate\"\nat = \"5 ms\"\nbias_time = \"1 ms\"\nhold = \"1 ms\"\n";
    let run = ran(&with_events(AXIS, kept), &["run.duration=15 ms"]);
    let held = run.quantity("relevitation_held").expect("a result");
    assert!(matches!(held.value, Value::None { .. }), "{held:?}");
    assert!(codes(&run).contains(&"AB2083"));
    assert_eq!(number(&run, "drive_end.contact_count"), 0.0);
}

#[test]
fn events_that_cannot_be_are_refused_where_they_stand() {
    let event = |lines: &str| with_events(AXIS, &format!("[[event]]\n{lines}\n"));
    for (lines, told) in [
        ("do = \"power lost\"", "exactly one of at, below_speed"),
        (
            "do = \"power lost\"\nat = \"1 ms\"\nabove_speed = \"7000 rpm\"",
            "exactly one of at",
        ),
        (
            "do = \"power lost\"\nbelow_speed = \"7000 rpm\"",
            "from the start on",
        ),
        (
            "do = \"power lost\"\nafter = \"nothing\"",
            "the name of another event",
        ),
        (
            "do = \"axis lost\"\nat = \"1 ms\"\nmagnet = \"drive_end\"",
            "axis is needed",
        ),
        (
            "do = \"axis lost\"\nat = \"1 ms\"\nmagnet = \"drive\"\naxis = 1",
            "one of the magnets drive_end, other_end",
        ),
        (
            "do = \"axis lost\"\nat = \"1 ms\"\nmagnet = \"drive_end\"\naxis = 3",
            "from 1 to 2",
        ),
        (
            "do = \"sensor dead\"\nat = \"1 ms\"\noffset = \"1 um\"",
            "takes no offset",
        ),
        ("do = \"sensor offset\"\nat = \"1 ms\"", "offset is needed"),
        (
            "do = \"amplifier limit\"\nat = \"1 ms\"",
            "largest_current or slew_rate",
        ),
        (
            "do = \"re-levitate\"\nat = \"1 ms\"\nbias_time = \"1 ms\"",
            "before the loss of all power",
        ),
        (
            "name = \"power_lost\"\ndo = \"brake\"\ntorque = \"1 N m\"\nat = \"1 ms\"",
            "as that of levitation.power_lost_at is called",
        ),
        ("do = \"sensor lost\"\nat = \"1 ms\"", "sensor dead"),
        (
            "do = \"sensor dead\"\nat = \"1 ms\"\nwhen = \"2 ms\"",
            "[[event]] takes",
        ),
        (
            "do = \"sensor dead\"\nat = \"1 ms\"\n[[event]]\ndo = \"sensor stuck\"\nmagnet = \"drive_end\"\nat = \"1 ms\"",
            "contradicts the event",
        ),
        (
            "name = \"a\"\ndo = \"sensor dead\"\nafter = \"b\"\n[[event]]\nname = \"b\"\ndo = \"power lost\"\nafter = \"a\"",
            "wait for each other",
        ),
        (
            "name = \"a\"\ndo = \"sensor dead\"\nat = \"1 ms\"\n[[event]]\nname = \"a\"\ndo = \"power lost\"\nat = \"2 ms\"",
            "twice",
        ),
    ] {
        let found = parsed(&event(lines), &[]).expect_err(lines);
        assert!(
            found.contains(told) && found.contains("machine.toml:"),
            "{lines}: {found}"
        );
    }
    let both = parsed(AXIS, &["levitation.power_lost_at=0.1 s"]).unwrap_err();
    assert!(
        both.contains("levitation.power_lost_at") && both.contains("one of the two"),
        "{both}"
    );
    let long = parsed(AGAIN, &["event.again.hold=1 s"]).unwrap_err();
    assert!(
        long.contains("event.again.hold") && long.contains("run.duration"),
        "{long}"
    );
    let direct = AGAIN.replace(
        "amplifier_bandwidth = \"2 kHz\"\nslew_rate = \"3000 A/s\"\n",
        "",
    );
    let useless = parsed(&direct, &[]).unwrap_err();
    assert!(
        useless.contains("AB0110") && useless.contains("amplifier_bandwidth"),
        "{useless}"
    );
    let unknown = parsed(AXIS, &["event.nothing.at=1 ms"]).unwrap_err();
    assert!(unknown.contains("axis_lost"), "{unknown}");
    parsed(AXIS, &["event.axis_lost.at=30 ms"]).unwrap();
    let drop = "format = \"auxbear.scenario/1\"\nsystem = \"drop\"\n[[event]]\ndo = \"power lost\"\nat = \"1 ms\"\n";
    assert!(
        parsed(drop, &[])
            .unwrap_err()
            .contains("system = \"machine\"")
    );
    let resolved = parsed(AXIS, &[]).unwrap().resolved.toml();
    let again = parsed(&resolved, &[]).unwrap();
    assert_eq!(again.system, parsed(AXIS, &[]).unwrap().system);
    assert!(resolved.contains("[[event]]"));
}
