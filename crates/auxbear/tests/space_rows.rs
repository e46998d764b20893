//! What rows of bearings in space carry, and what resists in them.

use crate::machine::parsed;
use crate::machine::ran;
use crate::outcomes::number;
use auxbear::outcome::{Outcome, Value, Verdict};

const REVERSAL: &str = include_str!("../../../scenarios/thrust_reversal.toml");
const FLYWHEEL: &str = include_str!("../../../scenarios/vertical_flywheel.toml");

fn warned(run: &Outcome, code: &str) -> bool {
    run.warnings.iter().any(|own| own.code == code)
}

/// The weight of an upright rotor goes towards the start of its shaft; a single row takes thrust towards the end unless it is turned round.
#[test]
fn thrust_on_the_open_side_of_a_row_has_no_verdict() {
    let limited = format!(
        "{FLYWHEEL}\n[[limit]]\nquantity = \"lower.time_to_first_axial_contact\"\nmost = \"1 s\"\n[[limit]]\nwarning = \"AB2412\"\n"
    )
    .replacen("arrangement = \"DB\"", "arrangement = \"single\"", 1)
    .replacen("axial_preload = \"90 N\"", "", 1);
    let run = |side: &str| {
        let side = format!("auxiliary_bearing.lower.bearing.thrust_side={side}");
        ran(&limited, &[side.as_str(), "run.duration=20 ms"])
    };
    let verdicts =
        |run: &Outcome| -> Vec<Verdict> { run.limits.iter().map(|own| own.verdict).collect() };
    let (right, wrong) = (run("start"), run("end"));
    assert!(!warned(&right, "AB2420") && warned(&wrong, "AB2420"));
    // without the height of its shoulders nobody knows whether a contact leaves its groove
    assert!(warned(&right, "AB2415"));
    assert_eq!(verdicts(&right), [Verdict::Pass, Verdict::Undecided]);
    assert_eq!(verdicts(&wrong), [Verdict::Undecided, Verdict::Undecided]);
}

/// Law, heat and lubricant of a pair, and that its rotor slows down.
#[test]
fn the_drag_of_the_lubricant_brakes_a_pair_and_heats_it() {
    const GREASED: [&str; 5] = [
        "bearing.moment.law=palmgren",
        "bearing.moment.f0=2",
        "bearing.moment.f1_factor=0.001",
        "bearing.moment.f1_exponent=0.33",
        "bearing.moment.viscosity_points=[[\"40 degC\", \"40 mm^2/s\"], [\"100 degC\", \"6 mm^2/s\"]]",
    ];
    let run = |greased: &[&str], more: &[&str]| {
        let sets: Vec<String> = (greased
            .iter()
            .chain(&["bearing.moment.temperature=30 degC"]))
        .take(if greased.is_empty() { 0 } else { usize::MAX })
        .chain(&["heat.network=on", "heat.feedback=viscosity"])
        .map(|set| format!("auxiliary_bearing.lower.{set}"))
        .collect();
        let all: Vec<&str> = sets
            .iter()
            .map(String::as_str)
            .chain(more.iter().copied())
            .collect();
        ran(FLYWHEEL, &all)
    };
    let short = ["run.duration=60 ms"];
    let [dry, greased] = [run(&[], &short), run(&GREASED, &short)];
    assert!(number(&greased, "energy_residual").abs() < 1e-6);
    assert!(number(&greased, "lower.relative_heat_residual") < 1e-9);
    let heat = |run: &Outcome| {
        let by_node = run.quantity("lower.steady_moment_heat_by_node");
        by_node.map_or(0.0, |own| match &own.value {
            Value::List(list) => list.iter().sum(),
            _ => 0.0,
        })
    };
    assert!(heat(&greased) > 1.0, "{}", heat(&greased));
    assert_eq!(heat(&dry), 0.0);
    let speed = |run: &Outcome| *run.column("rotor.speed").unwrap().values.last().unwrap();
    assert!(speed(&greased) < speed(&dry));
    // the preload is no load that its law does not see
    assert!(!warned(&greased, "AB1081"));
}

/// Thrust to a side without a shoulder: the rotor flies out, and nothing that its bearings bear is a verdict.
#[test]
fn a_rotor_that_leaves_its_bearings_has_no_verdict() {
    let without = |gap: &str| {
        let kept = REVERSAL.lines().filter(|line| !line.starts_with(gap));
        let text = kept.collect::<Vec<_>>().join("\n");
        format!(
            "{text}\n[[limit]]\nquantity = \"locating.time_to_first_contact\"\nmost = \"1 s\"\n"
        )
    };
    let limits = |run: &Outcome| run.limits.last().map(|own| own.verdict);
    let open = ran(&without("gap_to_start"), &["run.duration=60 ms"]);
    assert!(warned(&open, "AB2421") && !warned(&open, "AB2413"));
    assert_eq!(limits(&open), Some(Verdict::Undecided));
    let shut = ran(&without("none"), &["run.duration=60 ms"]);
    assert!(!warned(&shut, "AB2421"));
    assert_eq!(limits(&shut), Some(Verdict::Pass));
    let far = "auxiliary_bearing.locating.contact.gap_to_end=0.2 m";
    let refused = parsed(REVERSAL, &[far]).err().unwrap().to_string();
    assert!(refused.contains("diameter of a ball"), "{refused}");
}

/// A row that carries nothing takes nothing from the life of the other, over a coast-down either.
#[test]
fn an_idle_row_lengthens_no_life() {
    let sets = [
        "heat.network=on",
        "heat.feedback=none",
        "run.until=standstill",
        "run.accuracy=screening",
        "run.output_interval=10 ms",
        "rotor.speed=1500 rpm",
        "run.duration=0.3 s",
        "coast_down.longest=2 s",
        "auxiliary_bearing.upper.bearing.fidelity=spatial",
        "auxiliary_bearing.upper.bearing.arrangement=DB",
    ];
    let alone = FLYWHEEL
        .replacen("arrangement = \"DB\"", "arrangement = \"single\"", 1)
        .replacen("axial_preload = \"90 N\"", "thrust_side = \"start\"", 1);
    let each_turn = [FLYWHEEL, &alone].map(|text| {
        let run = ran(text, &sets);
        assert!(warned(&run, "AB2422") && warned(&run, "AB2315"));
        let counted = run.quantity("lower.drops_until_ten_percent_fail").unwrap();
        assert!(counted.value.why_absent().is_some());
        number(&run, "lower.coast_down.life_share") / number(&run, "coast_down.turns")
    });
    let ratio = each_turn[0] / each_turn[1];
    assert!((0.95..1.1).contains(&ratio), "{ratio}");
}

/// A race that spins up on a face has been touched, a bearing that the rotor has not come to decides nothing, and neither does a force that
/// rises at the end, nor a warning of coast-downs in a drop.
#[test]
fn a_run_that_ends_too_early_has_no_verdict() {
    let limit =
        |name: &str, most: &str| format!("[[limit]]\nquantity = \"{name}\"\nmost = \"{most}\"\n");
    let limited = [
        FLYWHEEL.to_string(),
        limit("lower.inner_race_time_to_95_percent", "30 ms"),
        limit("lower.inner_race_time_to_95_percent", "1 s"),
        limit("upper.inner_race_time_to_95_percent", "1 s"),
        limit("upper.peak_contact_force", "9 kN"),
        "[[limit]]\nwarning = \"AB2325\"\n".to_string(),
    ];
    let run = ran(&limited.join("\n"), &["run.duration=40 ms"]);
    assert!(warned(&run, "AB2424"));
    let verdicts: Vec<Verdict> = run.limits.iter().map(|own| own.verdict).collect();
    let (fail, open) = (Verdict::Fail, Verdict::Undecided);
    assert_eq!(verdicts, [fail, open, open, open, open]);
    // it comes to the upper bearing at 99 ms, and presses it harder and harder
    let limited = [FLYWHEEL, &limit("upper.peak_contact_force", "9 kN")];
    let run = ran(&limited.join("\n"), &["run.duration=100 ms"]);
    assert!(warned(&run, "AB2423") && !warned(&run, "AB2424"));
    assert_eq!(run.limits[0].verdict, open);
}
