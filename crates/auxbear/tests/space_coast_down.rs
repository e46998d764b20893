//! Coast-downs on bearings in space, beside the same machines ball by ball.

use crate::coast_down::list;
use crate::machine::{parsed, ran};
use crate::outcomes::number;
use auxbear::outcome::Outcome;

const FLYWHEEL: &str = include_str!("../../../scenarios/vertical_flywheel.toml");
const EXPANDER: &str = include_str!("../../../scenarios/machine_expander_pairs.toml");

/// Of both machines: seconds of it cost what a test may.
const SHORT: [&str; 4] = [
    "heat.network=on",
    "run.until=standstill",
    "run.accuracy=screening",
    "run.output_interval=10 ms",
];

/// A column of the course at an instant, s.
fn course(run: &Outcome, name: &str, time: f64) -> f64 {
    let times = list(run, "coast_down.over_time.time");
    let (part, rest) = match name.split_once('.') {
        Some((part, rest)) if part != "rotor" => (format!("{part}."), rest),
        _ => (String::new(), name),
    };
    let values = list(run, &format!("{part}coast_down.over_time.{rest}"));
    let next = times.partition_point(|own| *own < time).max(1);
    let share = (time - times[next - 1]) / (times[next] - times[next - 1]);
    values[next - 1] + share * (values[next] - values[next - 1])
}

/// What a coast-down from a speed, rad/s, has at an instant, s, beside speed and temperatures ball by ball: the speed lost within a share.
fn as_ball_by_ball(
    run: &Outcome,
    time: f64,
    (from, speed, within): (f64, f64, f64),
    temperatures: &[(&str, f64)],
) {
    let lost = (from - course(run, "rotor.speed", time)) / (from - speed);
    assert!((lost - 1.0).abs() < within, "{lost}");
    for (name, expected) in temperatures {
        let found = course(run, &format!("{name}.temperature"), time);
        assert!((found - expected).abs() < 0.5, "{name}: {found} {expected}");
    }
    assert!(number(run, "coast_down.relative_heat_residual") < 1e-9);
    for part in run.quantities.iter().filter_map(|own| {
        let name = own.name.strip_suffix("coast_down.life_share")?;
        Some(name.to_string())
    }) {
        assert!(number(run, &format!("{part}coast_down.life_share")) > 0.0);
    }
    let codes: Vec<&str> = run.warnings.iter().map(|own| own.code).collect();
    assert!(codes.contains(&"AB2315"), "{codes:?}");
}

#[test]
fn a_horizontal_rotor_coasts_down_on_pairs_as_ball_by_ball() {
    let expander = EXPANDER.split("[[rotor.force]]").next().unwrap();
    let sets = ["run.duration=0.5 s", "coast_down.longest=8 s"];
    let run = ran(expander, &[&SHORT[..], &sets].concat());
    // the same for 8 s ball by ball: pairs that heat press their balls, and the moment rises by a tenth
    let temperatures = [
        ("expander_end.inner_race", 306.25),
        ("expander_end.balls", 306.12),
        ("expander_end.lubricant", 302.95),
        ("compressor_end.inner_race", 306.34),
        ("compressor_end.balls", 306.20),
    ];
    as_ball_by_ball(&run, 8.0, (2612.680, 2606.581, 0.02), &temperatures);
    let moments = list(&run, "coast_down.over_time.load_dependent.moment");
    let rises = moments.last().unwrap() / moments[0];
    assert!((1.05..1.2).contains(&rises), "{rises}");
    // ball by ball its preload ends at 503.5 N
    let preload = |name: &str| number(&run, &format!("expander_end.coast_down.{name}_preload"));
    assert!(
        (preload("largest") / 503.5 - 1.0).abs() < 0.02,
        "{}",
        preload("largest")
    );
    assert!(preload("smallest") > number(&run, "expander_end.smallest_preload"));
    assert_eq!(
        run.warnings
            .iter()
            .filter(|own| own.code == "AB2345")
            .count(),
        4
    );
    // no law parts the moment of these bearings
    let parted = run.quantity("coast_down.speed_dependent_heat").unwrap();
    assert!((parted.value.why_absent()).is_some_and(|why| why.contains("as a whole")));
    for name in ["expander_end", "compressor_end"] {
        let used = number(
            &run,
            &format!("{name}.coast_down.life_share_with_lubricant"),
        );
        assert!(used > 0.0, "{name}: {used}");
    }
}

#[test]
fn a_vertical_rotor_coasts_down_on_the_face_of_its_pair_as_ball_by_ball() {
    let upright = [
        "auxiliary_bearing.upper.bearing.fidelity=spatial",
        "auxiliary_bearing.upper.bearing.arrangement=DB",
        "run.duration=0.3 s",
        "coast_down.longest=3 s",
    ];
    let run = ran(FLYWHEEL, &[&SHORT[..], &upright].concat());
    // the same for 3 s ball by ball: it goes round in the bore with its spin, which heats cages and balls
    let temperatures = [
        ("lower.inner_race", 305.57),
        ("lower.balls", 308.20),
        ("lower.cage", 312.00),
        ("lower.outer_race", 300.23),
        ("upper.balls", 308.08),
        ("upper.cage", 314.89),
    ];
    as_ball_by_ball(&run, 3.0, (3769.6612, 3769.2075, 0.02), &temperatures);
    // thrust alone presses its balls, and takes of their life
    for name in ["lower", "upper"] {
        let of = |what: &str| number(&run, &format!("{name}.coast_down.{what}"));
        assert!(of("life_share") > 0.0 && of("life_share_with_lubricant") > 0.0);
    }
    // its weight rests on one face, and friction in the bore makes too much of the losses for one that rolls
    let thrust = number(&run, "lower.coast_down.peak_axial_force") / (60.0 * 9.81);
    assert!((1.0..1.2).contains(&thrust), "{thrust}");
    assert!(run.quantity("upper.coast_down.peak_axial_force").is_none());
    assert!(
        run.stop.text.contains("It never rolled."),
        "{}",
        run.stop.text
    );
    let left_out = run.warnings.iter().filter(|own| own.code == "AB2414");
    assert!(left_out.count() == 2);
}

#[test]
fn a_rotor_without_weight_has_no_coast_down() {
    let sets = [&SHORT[..], &["gravity.axial=0 m/s^2"]].concat();
    let refused = parsed(FLYWHEEL, &sets).err().unwrap().to_string();
    assert!(refused.contains("gravity.acceleration"), "{refused}");
    assert!(refused.contains("gravity.axial"), "{refused}");
}
