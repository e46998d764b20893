//! A machine's rotor that rolls on its auxiliary bearings: closed forms, a run of it, and the unbalance that a balance grade leaves.

pub use crate::machine::{near, parsed, ran};
pub use crate::outcomes::number;
use auxbear::outcome::{Outcome, Value, Warning};
use auxbear::run::{Options, run};
use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

const WHIRLS: &str = include_str!("../../../scenarios/machine_dry_whirl.toml");
const COMPRESSOR: &str = include_str!("../../../scenarios/machine_compressor.toml");
const G: f64 = 9.81;

/// Few speeds, and no dry whirl, which would take longer than all else.
const SHORT: [&str; 2] = ["analysis.speed_count=41", "analysis.whirl_to=1 rad/s"];

fn analysed(text: &str, sets: &[&str]) -> Outcome {
    let rotor = parsed(text, &[&SHORT, sets].concat())
        .unwrap()
        .rotor_alone()
        .unwrap()
        .unwrap();
    run(&rotor, &Options::unwatched(&AtomicBool::new(false))).unwrap()
}

fn rolling(outcome: &Outcome, name: &str) -> f64 {
    number(outcome, &format!("on_auxiliary_bearings.{name}"))
}

fn numbers(outcome: &Outcome, name: &str) -> Vec<f64> {
    match &outcome
        .quantity(name)
        .unwrap_or_else(|| panic!("{name}"))
        .value
    {
        Value::List(list) => list.clone(),
        other => panic!("{name}: {other:?}"),
    }
}

fn criticals(outcome: &Outcome) -> Vec<f64> {
    numbers(outcome, "on_auxiliary_bearings.critical_speeds")
}

fn warned<'a>(outcome: &'a Outcome, code: &str) -> Vec<&'a Warning> {
    let own = outcome.warnings.iter().filter(|own| own.code == code);
    own.collect()
}

/// A rigid rotor, linear contacts, mounts that do not yield and weigh nothing.
const RIGID: [&str; 10] = [
    "rotor.section.shaft.outer_diameter=58 mm",
    "rotor.section.shaft.material=stainless_steel",
    "mount.stiffness=1e12 N/m",
    "mount.damping=0 N s/m",
    "mount.moving_mass=1e-3 kg",
    "contact.exponent=1",
    "contact.stiffness=1e6 N/m",
    "contact.damping=0 s/m",
    "rotor.damping_of_stiffness=0 s",
    "analysis.speed_to=1000 rad/s",
];

/// Bouncing on two springs, swinging in two bores, and the response between both: those of one mass.
#[test]
fn a_rigid_rotor_has_the_critical_speeds_of_a_mass_and_of_a_pendulum() {
    let at = [&RIGID[..], &["rotor.speed=280 rad/s"]].concat();
    let outcome = analysed(WHIRLS, &at);
    let mass = number(&outcome, "mass");
    let load = 0.5 * mass * G;
    let (stiff, clearance) = (1e6, 2e-4 + load / 1e6);
    for end in ["drive_end", "other_end"] {
        near(rolling(&outcome, &format!("{end}.static_load")), load, 1e-9);
        let along = rolling(&outcome, &format!("{end}.stiffness_along"));
        near(along, stiff, 2e-6);
        let across = rolling(&outcome, &format!("{end}.stiffness_across"));
        near(across, load / clearance, 1e-9);
    }
    // the shaft bends at 6 kHz: 1e-3 of its stiffness is left
    let [along, across] = [(2.0 * stiff / mass).sqrt(), (G / clearance).sqrt()];
    for expected in [along, across] {
        let near = |own: &f64| (own / expected - 1.0).abs() < 2e-3;
        assert!(
            criticals(&outcome).iter().any(near),
            "{expected}: {:?}",
            criticals(&outcome)
        );
    }
    // two unbalances of 300 g mm in one direction
    let speed: f64 = 280.0;
    let force = 2.0 * 300e-6 * speed * speed;
    let amplitude = |stiffness: f64| force / (stiffness - mass * speed * speed).abs();
    let expected = amplitude(2.0 * stiff).max(amplitude(2.0 * load / clearance));
    near(
        rolling(&outcome, "response.drive_end.rated_amplitude"),
        expected,
        5e-3,
    );
    near(number(&outcome, "rated_speed"), speed, 1e-12);
}

/// Each bearing carries by its lever, and the rotor lies at the depth of its own clearance, its contact and its mount.
#[test]
fn the_levers_of_the_mass_centre_share_the_weight_and_the_residual_unbalance() {
    let sets = [
        "rotor.disk.wheel_drive_end.mass=9 kg",
        "rotor.balance_grade=G2.5",
        "rotor.balance_planes=[\"left\", \"right\"]",
    ];
    let nodes = "[[rotor.node]]\nname = \"left\"\nat = \"100 mm\"\n[[rotor.node]]\nname = \"right\"\nat = \"300 mm\"\n[contact]";
    let text = WHIRLS.replacen("[contact]", nodes, 1);
    let outcome = analysed(&text, &sets);
    let [mass, centre] = ["mass", "mass_centre"].map(|name| number(&outcome, name));
    let shares = [(0.35 - centre) / 0.3, (centre - 0.05) / 0.3];
    for (end, share) in ["drive_end", "other_end"].iter().zip(shares) {
        let load = share * mass * G;
        near(rolling(&outcome, &format!("{end}.static_load")), load, 1e-9);
    }
    let rest = numbers(&outcome, "on_auxiliary_bearings.rest_displacements");
    let places = numbers(&outcome, "node_positions");
    let node = places.iter().position(|z| (z - 0.05).abs() < 1e-9).unwrap();
    let load = shares[0] * mass * G;
    near(rest[node], 2e-4 + (load / 5e8).powf(0.9) + load / 1e7, 1e-9);
    // U = G m/Ω by the levers to the planes
    let all = 2.5e-3 * mass / (12_000.0 * TAU / 60.0);
    near(
        number(&outcome, "balance.left.amount"),
        all * (0.3 - centre) / 0.2,
        1e-9,
    );
    near(
        number(&outcome, "balance.right.amount"),
        all * (centre - 0.1) / 0.2,
        1e-9,
    );
    // the same in a run, with the same angles; another seed has others
    let short = [&sets[..], &["run.duration=2 ms"]].concat();
    let drop = ran(&text, &short);
    for name in [
        "balance.left.amount",
        "balance.left.phase",
        "balance.right.phase",
    ] {
        assert_eq!(number(&drop, name), number(&outcome, name));
    }
    let other = analysed(&text, &[&sets[..], &["repeat.seed=7"]].concat());
    assert_ne!(
        number(&other, "balance.left.phase"),
        number(&drop, "balance.left.phase")
    );
    // and a run moves as with these amounts written out
    let written: String = ["left", "right"]
        .iter()
        .map(|name| {
            let [amount, phase] = ["amount", "phase"].map(|what| number(&drop, &format!("balance.{name}.{what}")));
            format!("[[rotor.unbalance]]\nat = \"{name}\"\namount = \"{amount} kg m\"\nphase = \"{phase} rad\"\n")
        })
        .collect();
    let same = ran(
        &text.replacen("[contact]", &format!("{written}[contact]"), 1),
        &[sets[0], "run.duration=2 ms"],
    );
    assert_eq!(
        drop.history.last().unwrap().values,
        same.history.last().unwrap().values
    );
}

/// The mount of the description that cures dry whirl, without friction: the run comes to rest in the bores and follows its unbalance.
#[test]
fn a_run_that_rolls_has_the_orbit_and_the_place_of_the_linear_answer() {
    for speed in ["120 rad/s", "420 rad/s"] {
        let speed = format!("rotor.speed={speed}");
        let sets = [
            &speed,
            "rotor.spin=held",
            "mount.stiffness=8e5 N/m",
            "mount.damping=2000 N s/m",
            "contact.friction_coefficient=0.0",
            "contact.damping=20 s/m",
            "contact.misalignment_y=0.18 mm",
            "rotor.unbalance.wheel_drive_end.amount=20 g mm",
            "rotor.unbalance.wheel_other_end.amount=12 g mm",
            "rotor.unbalance.wheel_other_end.phase=1.2 rad",
        ];
        let linear = analysed(WHIRLS, &sets);
        assert!(
            warned(&linear, "AB2051")
                .iter()
                .all(|own| !own.text.contains("lifts off at 420"))
        );
        let drop = ran(
            WHIRLS,
            &[
                &sets[..],
                &["run.duration=0.6 s", "run.output_interval=0.1 ms"],
            ]
            .concat(),
        );
        let column = |name: &str| {
            let own = drop.history.iter().find(|own| own.name == name);
            own.unwrap_or_else(|| panic!("{name}")).values.clone()
        };
        let places = numbers(&drop, "shape_positions");
        let (time, omega) = (column("time"), number(&linear, "rated_speed"));
        let turns = (0.25 * omega / TAU).floor() * TAU / omega;
        let last = *time.last().unwrap();
        for (end, z) in [("drive_end", 0.05), ("other_end", 0.35)] {
            let place = 1 + places
                .iter()
                .position(|own| (own - z).abs() < 1e-9)
                .unwrap();
            let [x, y] = ["x", "y"].map(|axis| column(&format!("shape.{place}.{axis}")));
            // Fourier sums over whole turns: with the spin, against it, at rest
            let mut sums = [[0.0; 2]; 3];
            let mut count = 0.0;
            for (row, t) in time.iter().enumerate().filter(|(_, t)| **t > last - turns) {
                count += 1.0;
                for (sum, sense) in sums.iter_mut().zip([1.0, -1.0, 0.0]) {
                    let (s, c) = (sense * omega * t).sin_cos();
                    sum[0] += x[row] * c + y[row] * s;
                    sum[1] += y[row] * c - x[row] * s;
                }
            }
            let [with, against, rest] = sums.map(|own| own[0].hypot(own[1]) / count);
            let expected = rolling(&linear, &format!("response.{end}.rated_amplitude"));
            near(with + against, expected, 0.03);
            let nodes = numbers(&linear, "node_positions");
            let node = nodes.iter().position(|own| (own - z).abs() < 1e-9).unwrap();
            let lies = numbers(&linear, "on_auxiliary_bearings.rest_displacements")[node];
            near(rest, lies, 0.01);
        }
    }
}

/// A branch that never relaxes is a spring, a housing that does not yield is ground.
#[test]
fn branches_and_housings_are_in_the_mount() {
    let plain = criticals(&analysed(WHIRLS, &["mount.stiffness=2e7 N/m"]));
    let slow = ["mount.branch_stiffness=1e7 N/m", "mount.branch_time=1000 s"];
    let branched = criticals(&analysed(WHIRLS, &slow));
    let housing = [
        "mount.stiffness=2e7 N/m",
        "mount.housing_mass=1 kg",
        "mount.housing_stiffness=1e13 N/m",
        "mount.housing_damping=0 N s/m",
    ];
    let housed = criticals(&analysed(WHIRLS, &housing));
    for (k, expected) in plain.iter().enumerate() {
        near(branched[k], *expected, 1e-3);
        near(housed[k], *expected, 1e-5);
    }
    assert_eq!([branched.len(), housed.len()], [plain.len(); 2]);
}

/// Both models of the bearing have the same balls; more of them yield less, and a held race has none.
#[test]
fn balls_yield_alike_in_both_models_of_a_bearing() {
    let of = |sets: &[&str]| analysed(COMPRESSOR, sets);
    let planar = of(&[]);
    let name = "drive_end.ball_stiffness";
    let stiffness = rolling(&planar, name);
    assert!((1e7..1e9).contains(&stiffness), "{stiffness}");
    near(
        rolling(&of(&["bearing.fidelity=rolling"]), name),
        stiffness,
        1e-6,
    );
    let parts = ["contact", "ball"]
        .map(|part| 1.0 / rolling(&planar, &format!("drive_end.{part}_stiffness")));
    let all = 1.0 / rolling(&planar, "drive_end.stiffness_along");
    assert!(all > parts.iter().sum::<f64>());
}

/// What the linear answer does not hold for is said, with its speeds, and left out of distances; a clearance that is used up is said too.
#[test]
fn lifting_off_and_rubbing_are_warned_of() {
    let clearances = |largest: &str| {
        WHIRLS.replace(
            "at = \"350 mm\"",
            &format!("at = \"350 mm\"\nclearance = \"{largest}\""),
        )
    };
    let outcome = analysed(&clearances("0.5 mm"), &[]);
    let told = warned(&outcome, "AB2051");
    assert!(
        told.iter().any(|own| own.text.contains("lifts off")),
        "{told:?}"
    );
    assert!(
        told.iter().any(|own| own.text.contains("half a clearance")),
        "{told:?}"
    );
    let [from, to] = ["from", "to"]
        .map(|end| numbers(&outcome, &format!("on_auxiliary_bearings.left_out_{end}")));
    assert!(from.len() == 2 && to.len() == 2, "{from:?} {to:?}");
    // the pendulum is passed at 216 rad/s, and the rated speed is beyond
    assert!(from[0] < 216.0 && 216.0 < to[0] && to[0] < from[1]);
    near(to[1], 12_000.0 * TAU / 60.0, 1e-12);
    let distance = rolling(&outcome, "node.other_end.least_distance");
    assert!((0.0..2.9e-4).contains(&distance), "{distance}");
    let speed = rolling(&outcome, "node.other_end.least_distance_speed");
    let inside = |k: usize| (from[k]..=to[k]).contains(&speed);
    assert!(!inside(0) && !inside(1), "{speed}");
    assert_eq!(rolling(&outcome, "least_distance"), distance);
    assert!(warned(&outcome, "AB2052").is_empty());
    let rubs = analysed(&clearances("0.205 mm"), &[]);
    assert_eq!(warned(&rubs, "AB2052")[0].part, "other_end");
    // a little unbalance leaves nothing out but what passes the pendulum
    let balanced = analysed(WHIRLS, &["rotor.balance_grade=G0.4"]);
    let lifts = warned(&balanced, "AB2051");
    assert!(
        lifts.iter().all(|own| !own.text.contains("lifts off")),
        "{lifts:?}"
    );
    // a seal that drives whirl makes a rotor on soft mounts grow
    let seal = "[[rotor.seal]]\nat = \"200 mm\"\nstiffness_xy = \"4e4 N/m\"\nstiffness_yx = \"-4e4 N/m\"\n[contact]";
    let sealed = WHIRLS.replacen("[contact]", seal, 1);
    let soft = ["mount.stiffness=1e5 N/m", "mount.damping=20 N s/m"];
    assert_eq!(warned(&analysed(&sealed, &soft), "AB2053").len(), 1);
    assert!(warned(&analysed(WHIRLS, &soft), "AB2053").is_empty());
}

/// Without weight on them no rotor rolls; the note says it, and nothing else is missing.
#[test]
fn a_rotor_without_weight_across_it_does_not_roll() {
    let vertical = analysed(WHIRLS, &["gravity.acceleration=0 m/s^2"]);
    let told = warned(&vertical, "AB2050");
    assert!(
        told[0].text.contains("no weight acts across the shaft"),
        "{told:?}"
    );
    let own = |outcome: &Outcome| {
        outcome
            .quantities
            .iter()
            .any(|own| own.name.starts_with("on_auxiliary"))
    };
    assert!(!own(&vertical) && own(&analysed(WHIRLS, &[])));
    let stays = analysed(
        WHIRLS,
        &["rotor.support.magnet_drive_end.after_release=stays"],
    );
    assert!(warned(&stays, "AB2050")[0].text.contains("a support stays"));
    // a mass centre beyond both bearings lifts the rotor out of the farther one
    let overhung = analysed(WHIRLS, &["rotor.node.drive_end.at=300 mm"]);
    let told = warned(&overhung, "AB2050");
    assert!(told[0].text.contains("other_end carries none"), "{told:?}");
}

/// Planes and grades that make no balance are refused with one message each.
#[test]
fn planes_that_cannot_be_balanced_are_refused() {
    let planes = |names: &str| format!("rotor.balance_planes={names}");
    let nodes = "[[rotor.node]]\nname = \"far\"\nat = \"380 mm\"\n[[rotor.node]]\nname = \"tip\"\nat = \"395 mm\"\n[[rotor.node]]\nname = \"near\"\nat = \"20 mm\"\n[contact]";
    let text = WHIRLS.replacen("[contact]", nodes, 1);
    let grade = "rotor.balance_grade=G 2.5";
    let of = |names: &str| vec![grade.to_string(), planes(names)];
    let needed = "two of the names of [[rotor.node]]";
    for (sets, words) in [
        (
            vec![planes("[\"near\", \"far\"]")],
            "planes without a grade",
        ),
        (of("[\"near\"]"), needed),
        (of("[\"near\", \"neer\"]"), needed),
        (of("[\"near\", \"near\"]"), "all different"),
        (of("[\"near\", \"drive_end\"]"), "stands"),
        (
            vec!["rotor.balance_grade=G".to_string()],
            "no number at the start of \"G\"",
        ),
    ] {
        let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
        let error = parsed(&text, &sets).unwrap_err();
        assert!(
            error.contains("rotor.balance_") && error.contains(words),
            "{error}"
        );
    }
    // where the mass centre lies is known with the rotor
    let planes = planes("[\"far\", \"tip\"]");
    let one_side = parsed(&text, &[grade, &planes]).unwrap();
    let error = run(&one_side, &Options::unwatched(&AtomicBool::new(false))).unwrap_err();
    assert!(
        error.to_string().contains("both sides of the mass centre"),
        "{error}"
    );
}
