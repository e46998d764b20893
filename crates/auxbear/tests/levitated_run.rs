//! Magnets whose controllers act in time: they keep what the linear analysis says, lose it with their power, and end at their limits.

use auxbear::outcome::Outcome;
use auxbear::run::warnings::rank;
use auxbear::run::{Options, run};
use std::sync::atomic::AtomicBool;

use crate::machine::{STIFF, near, number, parsed, ran};

fn rig() -> String {
    include_str!("../../../scenarios/amb_rig_drop.toml").to_string()
}

/// The controller of the rig, sampled so quickly that its delay is about that of the continuous one.
const SAMPLED: [&str; 3] = [
    "levitation.controller.sampling_period=50 us",
    "levitation.controller.computing_time=25 us",
    "levitation.controller.delay=0 s",
];

fn column<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    let found = outcome.history.iter().find(|column| column.name == name);
    &found.unwrap_or_else(|| panic!("{name}")).values
}

/// After whole turns the rotor is where it was: the closed form of the start and the run in time are of the same loop.
#[test]
fn controllers_in_time_keep_the_steady_motion() {
    let turning = [
        "run.duration=100 ms", // 20 turns at 12 000 rpm
        "rotor.spin=held",
        "levitation.power_lost_at=1 s",
    ];
    for (more, share) in [(&[][..], 1e-4), (&SAMPLED[..], 5e-3)] {
        let outcome = ran(&rig(), &[&turning[..], more].concat());
        for place in ["shape.1", "shape.9"] {
            let x = column(&outcome, &format!("{place}.x"));
            let y = column(&outcome, &format!("{place}.y"));
            let orbit = x.iter().zip(y).map(|(x, y)| x.hypot(*y));
            let orbit = orbit.fold(0.0, f64::max);
            let last = x.len() - 1;
            let moved = (x[last] - x[0]).hypot(y[last] - y[0]);
            assert!(
                orbit > 1e-6 && moved < share * orbit,
                "{place} {more:?}: {moved:e} m of {orbit:e} m"
            );
        }
        assert_eq!(number(&outcome, "drive_end.contact_count"), 0.0);
        assert!(number(&outcome, "energy_residual").abs() < 1e-6);
    }
}

/// A loss after whole turns is the loss at the start, later; balls and races have settled meanwhile.
#[test]
fn power_lost_after_whole_turns_drops_the_rotor_as_at_the_start() {
    let at_once = ran(&rig(), &["run.duration=10 ms", "rotor.spin=held"]);
    for more in [&[][..], &SAMPLED[..]] {
        let later = [
            "run.duration=30 ms",
            "rotor.spin=held",
            "levitation.power_lost_at=20 ms",
        ];
        let later = ran(&rig(), &[&later[..], more].concat());
        assert_eq!(number(&later, "power_lost_at"), 20e-3);
        assert_eq!(number(&later, "release_time"), 20e-3);
        for end in ["drive_end", "other_end"] {
            let first = format!("{end}.time_to_first_contact");
            near(number(&later, &first), number(&at_once, &first), 1e-3);
            let force = format!("{end}.first_impact_force");
            near(number(&later, &force), number(&at_once, &force), 0.03);
        }
    }
}

#[test]
fn currents_end_at_the_limit_of_the_coil_and_the_run_says_so() {
    let with = |limit: &str, event: &str| {
        let text = rig().replace(
            "current_stiffness = \"40 N/A\"",
            &format!("current_stiffness = \"40 N/A\"\n{limit}"),
        ) + event;
        // the drive adds 1 000 rad/s, and unbalance current with them
        let drive = "rotor.drive_torque=40 N m";
        let run = ["run.duration=20 ms", "levitation.power_lost_at=1 s", drive];
        ran(&text, &run)
    };
    let sets = |limit: &str| with(limit, "");
    let told = |outcome: &Outcome| outcome.warnings.iter().any(|w| w.code == "AB2034");
    let free = sets("largest_current = \"5 A\"");
    let largest = "magnet.drive_end.largest_current_1";
    assert!(number(&free, largest) > 0.655 && !told(&free));
    // 0.574 A static and 0.071 A of amplitude at the start are within the limit; commands end there and the amplifier follows them;
    // of a pair with 1.6 A of bias at what its coils leave
    let pair = "gap = \"0.4 mm\"\nlargest_current = \"2.25 A\"";
    for (limit, coil) in [
        ("largest_current = \"0.65 A\"", "(0.650 A, "),
        (pair, "(2.250 A, "),
    ] {
        let bound = sets(limit);
        // the coil that the current weakens follows on while the other is at its limit
        let most = if limit == pair { 0.68 } else { 0.6501 };
        assert!(number(&bound, largest) <= most, "{limit}");
        if limit == pair {
            let coil = number(&bound, "magnet.drive_end.largest_coil_current_1");
            assert!((2.249..=2.2501).contains(&coil), "{coil}");
        }
        let text = bound.warnings.iter().find(|w| w.code == "AB2034");
        assert!(text.is_some_and(|w| w.text.contains(coil)), "{limit}");
    }
    // the limit that it reached, not a later one
    let more = "\n[[event]]\ndo = \"amplifier limit\"\nat = \"19 ms\"\nlargest_current = \"5 A\"\n";
    let raised = with("largest_current = \"0.65 A\"", more);
    let text = raised.warnings.iter().find(|w| w.code == "AB2034");
    assert!(text.is_some_and(|w| w.text.contains("(0.650 A, ")));
}

/// Volts and amperes are limits of one kind: both are reported, as gravely.
#[test]
fn amplifiers_end_at_their_largest_voltage_and_the_run_says_so() {
    let sets = |volts: &str| {
        let amplifier =
            "inductance = \"15 mH\"\nresistance = \"1 ohm\"\namplifier_gain = \"300 ohm\"";
        let text = rig()
            .replace("amplifier_bandwidth = \"2 kHz\"\n", "")
            .replace(
                "current_stiffness = \"40 N/A\"",
                &format!("current_stiffness = \"40 N/A\"\n{amplifier}\n{volts}"),
            );
        let drive = "rotor.drive_torque=40 N m";
        let lost = [
            "run.duration=20 ms",
            "levitation.power_lost_at=15 ms",
            drive,
        ];
        ran(&text, &lost)
    };
    let told = |outcome: &Outcome| {
        let all = outcome.warnings.iter();
        all.filter(|w| w.code == "AB2036")
            .map(|w| w.to_string())
            .collect::<Vec<_>>()
    };
    assert!(told(&sets("")).is_empty() && told(&sets("largest_voltage = \"150 V\"")).is_empty());
    let text = told(&sets("largest_voltage = \"1.9 V\"")).concat(); // 1.88 V at the start
    for words in [
        "voltage_",
        "(1.9 V, ",
        "% of the time with power",
        "first at ",
    ] {
        assert!(text.contains(words), "{text}");
    }
    assert_eq!(rank("AB2036"), rank("AB2034"));
}

/// A mount too soft for the magnets' negative stiffness lets the rotor come to a pole: the run keeps what it has and names it.
#[test]
fn a_rotor_that_comes_to_a_pole_ends_there() {
    let pair = "current_stiffness = \"40 N/A\"\ngap = \"0.4 mm\"\nlargest_current = \"3 A\"";
    let text = rig()
        .replace("current_stiffness = \"40 N/A\"", pair)
        .replace("{ value = \"2e7 N/m\"", "{ value = \"2e4 N/m\"")
        .replace("{ value = \"6e6 N/m\"", "{ value = \"2e4 N/m\"");
    let outcome = ran(
        &text,
        &["levitation.decay_time=20 ms", "run.duration=0.2 s"],
    );
    assert_eq!(outcome.stop.reason, "diverged");
    let told = &outcome.stop.text;
    assert!(
        told.contains("pole") && told.contains("magnet.other_end.axis_"),
        "{told}"
    );
    assert!(!column(&outcome, "rotor.speed").is_empty());
}

/// Members in lanes are what they are alone, also those of a sampled controller, whose states jump.
#[test]
fn controllers_in_lanes_have_the_bits_of_a_single_run() {
    for more in [&[][..], &SAMPLED[..]] {
        let run = ["run.duration=8 ms", "levitation.power_lost_at=3 ms"];
        let alone = ran(&rig(), &[&run[..], more].concat());
        let beside = ran(&rig(), &[&run[..], &["repeat.count=3"], more].concat());
        for name in [
            "drive_end.time_to_first_contact",
            "drive_end.first_impact_force",
            "magnet.other_end.largest_current_2",
        ] {
            assert_eq!(number(&alone, name), number(&beside, name), "{name}");
        }
    }
}

/// A command that takes effect with the next sample, and one a little earlier.
#[test]
fn a_computing_time_of_a_whole_period_is_no_jump() {
    let largest = |computing: &str| {
        let computing = format!("levitation.controller.computing_time={computing}");
        let sets = [
            "run.duration=10 ms",
            "levitation.power_lost_at=1 s",
            SAMPLED[0],
            SAMPLED[2],
            &computing,
        ];
        number(&ran(&rig(), &sets), "magnet.drive_end.largest_current_1")
    };
    near(largest("50 us"), largest("49.9999 us"), 1e-6);
}

#[test]
fn a_loss_without_magnets_or_before_standstill_is_refused() {
    let refused = |text: &str, sets: &[&str]| {
        let scenario = parsed(text, sets).unwrap();
        let never = AtomicBool::new(false);
        let run = run(&scenario, &Options::unwatched(&never)).map(|_| ());
        run.unwrap_err().to_string()
    };
    let many = [
        "levitation.power_lost_at=1 s",
        "levitation.controller.sampling_period=1e-6 us",
        "levitation.controller.delay=0 s",
    ];
    assert!(refused(&rig(), &many).contains("samples in this run"));
    let error = refused(STIFF, &["levitation.decay_time=1 ms"]);
    assert!(
        error.contains("AB0110") && error.contains("decay_time"),
        "{error}"
    );
    let error = refused(STIFF, &["levitation.power_lost_at=1 ms"]);
    assert!(
        error.contains("power_lost_at") && error.contains("no magnets"),
        "{error}"
    );
    let mut sets = vec!["levitation.power_lost_at=9 s", "run.until=standstill"];
    // laws that a coast-down knows
    let laws = ["drive_end", "other_end"].map(|end| {
        let law = format!("auxiliary_bearing.{end}.bearing.moment");
        [
            format!("{law}.law=palmgren"),
            format!("{law}.lubrication=grease"),
            format!(
                "{law}.viscosity_points=[[\"40 degC\", \"22 mm^2/s\"], [\"100 degC\", \"5 mm^2/s\"]]"
            ),
            format!("{law}.temperature=25 degC"),
        ]
    });
    let laws = laws.concat();
    sets.extend(laws.iter().map(String::as_str));
    assert!(refused(&rig(), &sets).contains("standstill"));
}
