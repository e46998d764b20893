//! The moments of a bearing without motion: the magnitudes of the source paper, comparisons, and what is refused.

use crate::outcomes::number;
use auxbear::outcome::{Outcome, Value};
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::path::Path;
use std::sync::atomic::AtomicBool;

const PLAIN: &str = r#"format = "auxbear.scenario/1"
system = "torque"
[bearing]
name = "6005"
"#;

fn parse(text: &str, sets: &[&str]) -> Result<Scenario, String> {
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    Scenario::parse(text, "a.toml", &sets, &BuiltIn).map_err(|problem| problem.to_string())
}

fn computed(scenario: &Scenario) -> Outcome {
    let interrupt = AtomicBool::new(false);
    let options = Options::unwatched(&interrupt);
    run(scenario, &options).unwrap()
}

fn plain(sets: &[&str]) -> Outcome {
    let scenario = parse(PLAIN, sets).unwrap_or_else(|problem| panic!("{problem}"));
    computed(&scenario)
}

fn refused(sets: &[&str], parts: &[&str]) {
    let message = parse(PLAIN, sets).expect_err("it was accepted");
    for part in parts {
        assert!(message.contains(part), "{part}: {message}");
    }
}

fn value<'a>(outcome: &'a Outcome, name: &str) -> &'a Value {
    let found = outcome.quantity(name);
    &found.unwrap_or_else(|| panic!("no {name}")).value
}

fn list<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    match value(outcome, name) {
        Value::List(list) => list,
        other => panic!("{name}: {other:?}"),
    }
}

fn column<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    let found = outcome.history.iter().find(|column| column.name == name);
    &found.unwrap_or_else(|| panic!("no {name}")).values
}

fn why(outcome: &Outcome, name: &str) -> String {
    match value(outcome, name) {
        Value::None { why } => why.clone(),
        other => panic!("{name}: {other:?}"),
    }
}

fn near(value: f64, reference: f64, tolerance: f64) {
    let off = (value / reference - 1.0).abs();
    assert!(off < tolerance, "{value} is {off} off {reference}");
}

#[test]
fn the_shipped_file_shows_the_magnitudes_of_the_source_paper() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/torque_6005.toml");
    let outcome = computed(&Scenario::read(&file, &[], &BuiltIn).unwrap());
    assert_eq!(number(&outcome, "speed"), 150.0);
    // the point at 40 °C itself, to the rounding of two logarithms of logarithms
    near(number(&outcome, "viscosity"), 100e-6, 1e-9);
    // by hand: ν n = 100·1432.4 = 143 239, ^(2/3) = 2737.7; 1e-7·2·36³·2737.7 = 25.546 N mm
    near(number(&outcome, "speed_dependent_moment"), 25.546e-3, 1e-4);
    // "about 25 N mm": two digits, of the part that does not depend on load; load adds 0.2 N mm
    near(number(&outcome, "friction_moment"), 25e-3, 0.04);
    assert_eq!(
        list(&outcome, "accelerations"),
        [0.0, 1300.0, 7200.0, 11500.0]
    );
    let inertia = list(&outcome, "outer_race_inertia_moments");
    assert_eq!(inertia[0], 0.0);
    // -1.15, -6.4, -10.2 N mm: 6.4 has two digits, half of its last is 0.8 %
    for (ours, printed) in inertia[1..].iter().zip([-1.15e-3, -6.4e-3, -10.2e-3]) {
        near(*ours, printed, 8e-3);
    }
    // 7200 rad/s²: J_I = (0.35·10.524 g + 0.25·5 g)·14.825² mm² = 1.08426e-6 kg m²
    near(
        list(&outcome, "inner_race_inertia_moments")[2],
        7200.0 * 1.08426e-6,
        1e-4,
    );
    assert!(outcome.stop.complete());
    let laws = ["palmgren", "palmgren_printed", "skf"];
    for law in laws {
        assert!(number(&outcome, &format!("law_{law}_friction_moment")) > 0.0);
    }
}

#[test]
fn history_and_tables_are_the_sums_of_their_parts() {
    let outcome = plain(&[
        "torque.speed_to=200 rad/s",
        "torque.speed=200 rad/s",
        "torque.accelerations=[\"-900 rad/s^2\", \"7200 rad/s^2\"]",
        "torque.loads=[\"80 N\", \"400 N\"]",
        "bearing.acceleration_loss.kind=proportional",
        "bearing.acceleration_loss.per_acceleration=1e-5 N s^2/rad",
    ]);
    let first = &outcome.history[0];
    assert_eq!((first.name.as_str(), first.unit), ("speed", "rad/s"));
    assert_eq!((first.values[0], first.values[199]), (1.0, 200.0));
    for (number, acceleration) in [(1, -900.0), (2, 7200.0_f64)] {
        let part = |name: &str| column(&outcome, &format!("acceleration_{number}.{name}"));
        for row in [0, 50, 199] {
            let friction = column(&outcome, "friction.moment")[row];
            let loss = part("loss")[row];
            // F resists whatever the sign of the acceleration: arm = 14.825·21.175/36 mm
            near(loss, 8.71998e-3 * 1e-5 * acceleration.abs(), 1e-4);
            let inner = friction + part("inner_race.inertia")[row] + loss;
            let outer = friction + part("outer_race.inertia")[row] + loss;
            assert_eq!(part("inner_race.moment")[row], inner);
            assert_eq!(part("outer_race.moment")[row], outer);
        }
        assert_eq!(part("inner_race.inertia")[0] > 0.0, acceleration > 0.0);
        let at_end = list(&outcome, "outer_race_moments")[number - 1];
        assert_eq!(part("outer_race.moment")[199], at_end);
    }
    // series 60: f1 = 0.0007 (P0/C0)^0.5, so five times the load makes 5^1.5 times the moment
    let m1 = list(&outcome, "load_dependent_moments_over_load");
    near(m1[1] / m1[0], 5_f64.powf(1.5), 1e-12);
    assert_eq!(
        column(&outcome, "load_2.friction.moment")[199],
        list(&outcome, "friction_moments_over_load")[1]
    );
}

#[test]
fn a_name_alone_is_enough_and_every_assumption_is_marked() {
    let scenario = parse(PLAIN, &[]).unwrap();
    let resolved = |path: &str| scenario.resolved.get(path).unwrap();
    for path in [
        "torque.loads",
        "bearing.moment.viscosity",
        "bearing.moment.lubrication",
        "bearing.cage_mass",
    ] {
        assert_eq!(resolved(path).provenance.mark(), "assumed", "{path}");
    }
    assert_eq!(
        resolved("bearing.moment.law").text.as_deref(),
        Some("palmgren")
    );
    assert_eq!(
        resolved("torque.loads").text.as_deref(),
        Some("[\"65.5 N\"]")
    );
    // 20 000 rpm, the limiting speed of the catalogue
    near(
        resolved("torque.speed_to").value_si.unwrap(),
        2094.395,
        1e-6,
    );
    let outcome = computed(&scenario);
    let assumed = outcome
        .warnings
        .iter()
        .find(|w| w.code == "AB1013")
        .unwrap();
    assert!(assumed.text.contains("torque.loads"), "{}", assumed.text);
    // at that speed ν n is above what the law was made for
    assert!(outcome.warnings.iter().any(|w| w.code == "AB1018"));
}

#[test]
fn the_resolved_file_gives_the_same_numbers() {
    let scenario = parse(
        PLAIN,
        &[
            "torque.laws=[\"palmgren\", \"skf\"]",
            "torque.lubricants=[\"oil: 100 mm^2/s at 40 degC, 11 mm^2/s at 100 degC\"]",
            "torque.temperatures=[\"40 degC\", \"60 degC\"]",
            "bearing.moment.temperature=60 degC",
            "bearing.moment.seal_moment=1 N mm",
        ],
    )
    .unwrap();
    let again = parse(&scenario.resolved.toml(), &[]).unwrap();
    let (one, other) = (computed(&scenario), computed(&again));
    assert_eq!(one.history, other.history);
    assert_eq!(one.quantities, other.quantities);
    assert_eq!(one.warnings, other.warnings);
}

#[test]
fn lubricants_are_compared_where_they_are_known() {
    let outcome = plain(&[
        "torque.lubricants=[\"thin: 32 mm^2/s at 40 degC, 5.4 mm^2/s at 100 degC\", \"ISO VG 68\", \"50 mm^2/s\"]",
        "torque.temperatures=[\"40 degC\", \"100 degC\", \"150 degC\"]",
        "bearing.moment.temperature=40 degC",
        "torque.speed=150 rad/s",
    ]);
    near(number(&outcome, "viscosity"), 32e-6, 1e-9);
    assert_eq!(
        number(&outcome, "lubricant_1_friction_moment"),
        number(&outcome, "friction_moment")
    );
    // M0 goes with ν^(2/3); M1 does not see ν
    let m1 = number(&outcome, "load_dependent_moment");
    let m0 = list(&outcome, "lubricant_1_friction_moments");
    near(
        (m0[0] - m1) / (m0[1] - m1),
        (32.0_f64 / 5.4).powf(2.0 / 3.0),
        1e-9,
    );
    // 150 °C is more than 30 K beyond the points, where the line is drawn on; a grade alone holds at 40 °C
    assert_eq!(list(&outcome, "lubricant_1_temperatures").len(), 3);
    assert_eq!(list(&outcome, "lubricant_2_temperatures").len(), 1);
    assert_eq!(list(&outcome, "lubricant_3_temperatures").len(), 3);
    let shown = |code: &str| -> Vec<String> {
        let found = outcome.warnings.iter().filter(|w| w.code == code);
        found.map(|w| w.to_string()).collect()
    };
    assert_eq!(shown("AB1023").len(), 1);
    let drawn_on = shown("AB2313");
    assert_eq!(drawn_on.len(), 1);
    // by hand, 10^10^(A - B lg T) - 0.7: 2.392 mm²/s
    for part in [
        "thin",
        "150 °C is 20 K beyond",
        "(10 to 130 °C)",
        "2.39 mm²/s",
        "1 % at the data",
    ] {
        assert!(drawn_on[0].contains(part), "{part}: {}", drawn_on[0]);
    }
}

#[test]
fn a_law_that_is_refused_in_a_comparison_says_why() {
    // the SKF model has no oil mist
    let outcome = plain(&[
        "torque.laws=[\"palmgren\", \"skf\", \"measured\"]",
        "bearing.moment.lubrication=oil mist",
    ]);
    assert!(number(&outcome, "law_palmgren_friction_moment") > 0.0);
    assert!(why(&outcome, "law_skf_friction_moment").contains("oil mist"));
    assert!(why(&outcome, "law_measured_friction_moment").contains("bearing.moment.curve"));
    let shown = outcome.warnings.iter().filter(|w| w.code == "AB1022");
    assert_eq!(shown.count(), 2);
    // a key of a law that is compared belongs to the file
    let outcome = plain(&[
        "torque.laws=[\"palmgren\", \"measured\"]",
        "bearing.moment.curve=[[\"1 rad/s\", \"20 N mm\"], [\"150 rad/s\", \"30 N mm\"]]",
        "torque.speed=150 rad/s",
    ]);
    near(
        number(&outcome, "law_measured_friction_moment"),
        30e-3,
        1e-9,
    );
}

#[test]
fn a_law_that_is_refused_for_the_bearing_itself_is_an_error() {
    refused(
        &[
            "bearing.moment.law=skf",
            "bearing.moment.lubrication=oil mist",
        ],
        &["AB0208", "bearing.moment.lubrication", "SKF"],
    );
}

#[test]
fn a_load_without_static_load_rating_is_an_error() {
    let text = r#"format = "auxbear.scenario/1"
system = "torque"
[torque]
loads = ["80 N"]
[bearing]
ball_count = 10
ball_diameter = "6.35 mm"
pitch_diameter = "36 mm"
cage_mass = "5 g"
[bearing.moment]
series = "60"
"#;
    let message = parse(text, &[]).unwrap_err();
    for part in ["AB0107", "bearing.static_load_rating", "palmgren"] {
        assert!(message.contains(part), "{part}: {message}");
    }
}

#[test]
fn a_temperature_at_which_an_oil_has_no_viscosity_is_an_error() {
    let points = "bearing.moment.viscosity_points=[[\"40 degC\", \"100 mm^2/s\"], [\"100 degC\", \"11 mm^2/s\"]]";
    refused(
        &[points, "bearing.moment.temperature=600 degC"],
        &["AB0208", "bearing.moment.temperature"],
    );
    refused(
        &[
            "torque.lubricants=ISO VG 68",
            "bearing.moment.temperature=60 degC",
        ],
        &["AB0208", "bearing.moment.temperature", "ISO VG 68"],
    );
}

#[test]
fn what_has_no_effect_or_no_meaning_is_an_error() {
    for (sets, parts) in [
        (
            &["torque.temperatures=60 degC"][..],
            &["AB0110", "torque.temperatures", "torque.lubricants"][..],
        ),
        (
            &["bearing.moment.law=none", "torque.lubricants=100 mm^2/s"],
            &["AB0110", "torque.lubricants"],
        ),
        (
            &["bearing.moment.curve=[[\"1 rad/s\", \"1 N m\"], [\"2 rad/s\", \"1 N m\"]]"],
            &["AB0110", "bearing.moment.curve"],
        ),
        (
            &["torque.speed_to=0.5 rad/s"],
            &["AB0106", "torque.speed_to", "torque.speed_from"],
        ),
        (
            &["torque.loads=[\"-1 N\"]"],
            &["AB0106", "entry 1", "not below 0"],
        ),
        (
            &["torque.loads=[\"1 N\", \"2 m\"]"],
            &["AB0105", "entry 2", "a length"],
        ),
        (&["torque.loads=[80]"], &["AB0103", "80"]),
        (&["torque.loads=[]"], &["AB0102", "empty list"]),
        (&["torque.laws=skff"], &["AB0108", "skff", "\"skf\""]),
        (&["torque.laws=[\"skf\", \"skf\"]"], &["AB0109", "1 and 2"]),
        (&["torque.lubricants=ISO VG 99"], &["AB0208", "99"]),
        (
            &[
                "torque.lubricants=100 mm^2/s",
                "bearing.moment.viscosity=90 mm^2/s",
            ],
            &["AB0109", "bearing.moment.viscosity"],
        ),
    ] {
        refused(sets, parts);
    }
}

#[test]
fn an_unknown_contact_angle_and_a_bath_without_drag_are_said() {
    const ANGULAR: [&str; 5] = [
        "bearing.type=angular contact",
        "bearing.moment.law=skf",
        "bearing.moment.lubrication=oil bath",
        "bearing.moment.viscosity=20 mm^2/s",
        "torque.speed_to=100 rad/s",
    ];
    let warned = |more: &[&str]| {
        let outcome = plain(&[&ANGULAR[..], more].concat());
        let found = outcome.warnings.iter();
        let found = found.filter(|w| ["AB1080", "AB1082"].contains(&w.code));
        found.map(|w| w.to_string()).collect::<Vec<_>>()
    };
    let [angle, bath] = &warned(&[])[..] else {
        panic!("two warnings were expected");
    };
    assert!(angle.contains("35 to 45 deg; 40 deg is taken"), "{angle}");
    // by hand: V_M 4.4 (25 + 47)/(47 - 25) 1e-12·36⁵·10 000² = 1e-4·8.7071e4 = 8.7071 N mm
    assert!(bath.contains("1e-4 of it is 8.707 N mm"), "{bath}");
    let known = [
        "bearing.moment.contact_angle=40 deg",
        "bearing.moment.drag_variable=1e-4",
    ];
    assert_eq!(warned(&known), [""; 0]);
    let grease = ["bearing.moment.lubrication=grease"];
    assert_eq!(warned(&[&known[..1], &grease].concat()), [""; 0]);
    // also of a law that is compared
    let outcome = plain(&[
        "torque.laws=[\"palmgren\", \"skf\"]",
        "bearing.moment.lubrication=low oil bath",
    ]);
    assert!(outcome.warnings.iter().any(|w| w.code == "AB1082"));
    // a table of Palmgren's factors, whose bearings are of 40 degrees
    let outcome = plain(&[
        "bearing.type=angular contact",
        "bearing.moment.series=72B",
        "bearing.moment.axial_load=100 N",
    ]);
    assert!(outcome.warnings.iter().any(|w| w.code == "AB1080"));
}

#[test]
fn the_moment_that_starts_a_bearing_is_reported() {
    let skf = [
        "bearing.moment.law=skf",
        "bearing.moment.seal_moment=2 N mm",
        "torque.loads=[\"500 N\"]",
    ];
    // by hand: G_sl = 3.73e-3·36^-0.26·500^(5/3) = 46.276, times 0.15, and the seals
    near(number(&plain(&skf), "starting_moment"), 8.9414e-3, 1e-4);
    assert!(why(&plain(&[]), "starting_moment").contains("SKF"));
}
