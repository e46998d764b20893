//! Friction of the bearing as a whole: laws, tables by lubrication, viscosity by temperature, acceleration loss, and a
//! user's own catalogue.

use super::files::{self, SPIN_UP, read};
use auxbear::run::{self, Options};
use auxbear::scenario::{AccelerationLoss, BuiltIn, Moment, Scenario, SpinUp, System};
use physics::palmgren_factors::FactorSource;
use std::sync::atomic::AtomicBool;

/// Ball by ball: a name that the catalogue has, and a friction law with everything it needs.
const PALMGREN: [&str; 3] = [
    "bearing.moment.law=palmgren",
    "bearing.moment.lubrication=grease",
    "bearing.moment.viscosity=100 mm^2/s",
];
const SKF: [&str; 3] = [
    "bearing.moment.law=skf",
    "bearing.moment.lubrication=grease",
    "bearing.moment.viscosity=100 mm^2/s",
];
const POINTS: &str = "bearing.moment.viscosity_points=[[\"40 degC\", \"100 mm^2/s\"], [\"100 degC\", \"11 mm^2/s\"]]";

fn scenario(sets: &[&str]) -> Result<Scenario, String> {
    read(SPIN_UP, sets)
}

fn spin_up(sets: &[&str]) -> SpinUp {
    files::spin_up(scenario(sets).unwrap_or_else(|problem| panic!("{problem}")))
}

fn message(sets: &[&str]) -> String {
    scenario(sets).expect_err("it was accepted")
}

fn with<'a>(sets: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [sets, more].concat()
}

#[test]
fn factors_come_from_the_tables() {
    let bearing = spin_up(&PALMGREN).bearing;
    // Schaeffler HR 1, series 60 with grease: f0 1.1, f1 0.0007 (P0/C0)^0.5
    assert_eq!(
        bearing.moment,
        Moment::Palmgren {
            printed: false,
            f0: 1.1,
            viscosity: 1e-4,
            f1_factor: 0.0007,
            f1_exponent: 0.5,
            preload: 0.0,
            axial_load: 0.0,
            contact_angle: None,
            equivalent_load: FactorSource::Schaeffler,
        }
    );
    let resolved = scenario(&PALMGREN).unwrap().resolved;
    let f0 = resolved.get("bearing.moment.f0").unwrap();
    assert_eq!(f0.provenance.mark(), "derived");
    assert!(f0.provenance.note().contains("Schaeffler"), "{f0:?}");
    assert_eq!(
        resolved
            .get("bearing.moment.series")
            .unwrap()
            .text
            .as_deref(),
        Some("60")
    );
    // what is given counts, what is not comes from the table
    let given = spin_up(&with(&PALMGREN, &["bearing.moment.f0=2"]))
        .bearing
        .moment;
    assert!(
        matches!(
            given,
            Moment::Palmgren {
                f0: 2.0,
                f1_factor: 0.0007,
                ..
            }
        ),
        "{given:?}"
    );
    let oil = with(&PALMGREN, &["bearing.moment.lubrication=low oil bath"]);
    assert!(matches!(
        spin_up(&oil).bearing.moment,
        Moment::Palmgren { f0: 1.7, .. }
    ));
}

#[test]
fn factors_that_no_table_has_are_refused() {
    assert_eq!(
        message(&[
            "bearing.moment.law=palmgren",
            "bearing.moment.viscosity=100 mm^2/s"
        ]),
        "error[AB0107]: a.toml: bearing.moment.f0: found no value; a bare number not below 0 is needed, e.g. 2. With bearing.moment.lubrication it is taken from the tables"
    );
    assert_eq!(
        message(&with(
            &PALMGREN,
            &["bearing.moment.lubrication=oil and air"]
        )),
        "error[AB0208]: a.toml, --set: bearing.moment.lubrication: found \"oil and air\", which Palmgren's tables do not have; one of \"grease\", \"oil mist\", \"low oil bath\", \"oil jet\" is needed, or f0 and f1 by hand"
    );
    let shown = message(&with(&PALMGREN, &["bearing.moment.series=99"]));
    assert!(shown.starts_with("error[AB0208]: a.toml, --set: bearing.moment.series: found no Palmgren factors for series \"99\""), "{shown}");
    let given = [
        "bearing.moment.f0=2",
        "bearing.moment.f1_factor=9e-4",
        "bearing.moment.f1_exponent=0.5",
    ];
    // the lubrication is kept as information
    scenario(&with(&PALMGREN, &given)).unwrap();
    assert_eq!(
        message(&with(
            &PALMGREN,
            &[
                "bearing.type=angular contact",
                "bearing.contact_angle=15 deg"
            ]
        )),
        "error[AB0107]: a.toml: bearing.moment.f0: found no value; a bare number not below 0 is needed, e.g. 2. No table has factors of a single row angular contact ball bearing of 15 deg: f0, f1_factor and f1_exponent are needed, all three"
    );
}

/// A bearing of another type and angle, with C0 20 kN and a pitch diameter of 46 mm.
fn other(kind: &str, angle: &str, more: &[&str]) -> Result<Scenario, String> {
    let angular = format!("bearing.contact_angle={angle}");
    let kind = format!("bearing.type={kind}");
    let common = [
        kind.as_str(),
        "bearing.static_load_rating=20 kN",
        "bearing.pitch_diameter=46 mm",
        "bearing.name=6206",
        "bearing.moment.viscosity=20 mm^2/s",
        "bearing.moment.lubrication=grease",
    ];
    let mut sets = with(&common, more);
    if !angle.is_empty() {
        sets.push(&angular);
    }
    scenario(&sets)
}

/// M1 at 100 rad/s, N mm.
fn load_moment(scenario: Result<Scenario, String>, radial: f64) -> f64 {
    let bearing = files::spin_up(scenario.unwrap_or_else(|problem| panic!("{problem}"))).bearing;
    let law = bearing.moment.law(&bearing.rated()).unwrap();
    let parts = law.parts(100.0, radial, bearing.moment.axial_load());
    1e3 * parts.load_dependent
}

#[test]
fn the_load_of_m1_belongs_to_the_source_of_its_factor() {
    let of = |kind, angle, series: &str, more: &[&str]| {
        let series = format!("bearing.moment.series={series}");
        let sets = with(&["bearing.moment.law=palmgren", &series], more);
        load_moment(other(kind, angle, &sets), 500.0)
    };
    let axial = ["bearing.moment.axial_load=1000 N"];
    // by hand, C0 20 kN, d_m 46 mm, 500 N radial and 1000 N axial load but for the first, f1 = z (P0/C0)^y:
    for (ours, newton_millimetres) in [
        // QJ2, radial alone: P1 3.6·500 N, P0 500 N
        (of("four-point contact", "", "QJ2", &[]), 24.510),
        // QJ2: P1 1.5·1000 + 3.6·500 = 3300 N, P0 500 + 0.58·1000 = 1080 N
        (of("four-point contact", "", "QJ2", &axial), 57.938),
        // 72B at 40 deg: P1 1000 - 50 = 950 N, P0 0.5·500 + 0.26·1000 = 510 N
        (of("angular contact", "40 deg", "72B", &axial), 13.021),
        // 32B at 25 deg: P1 1400 - 50 = 1350 N, P0 500 + 0.76·1000 = 1260 N
        (
            of("angular contact double row", "25 deg", "32B", &axial),
            24.939,
        ),
        // 62: P1 3300 - 50 = 3250 N, P0 0.6·500 + 0.5·1000 = 800 N, z 0.0009, y 0.5
        (of("deep groove", "", "62", &axial), 26.910),
        // Timken's 02 at 40 deg: P1 0.9·1.191754·1000 - 50 = 1022.578 N, f1 0.00025
        (of("angular contact", "40 deg", "02", &axial), 11.760),
        // 72B in the form of Timken
        (
            of(
                "angular contact",
                "40 deg",
                "72B",
                &with(&axial, &["bearing.moment.equivalent_load=timken"]),
            ),
            14.016,
        ),
    ] {
        // printed to five digits
        assert!(
            (ours / newton_millimetres - 1.0).abs() < 1e-4,
            "{ours} {newton_millimetres}"
        );
    }
    let by_hand = spin_up(&[
        "bearing.moment.law=palmgren",
        "bearing.moment.f0=2",
        "bearing.moment.f1_factor=9e-4",
        "bearing.moment.f1_exponent=0.5",
        "bearing.moment.viscosity=100 mm^2/s",
    ]);
    assert!(matches!(
        by_hand.bearing.moment,
        Moment::Palmgren {
            equivalent_load: FactorSource::Timken,
            ..
        }
    ));
}

#[test]
fn constants_for_another_contact_angle_are_refused() {
    let palmgren = |kind, angle, series: &str| {
        let series = format!("bearing.moment.series={series}");
        other(kind, angle, &["bearing.moment.law=palmgren", &series])
    };
    let skf = |kind, angle| other(kind, angle, &["bearing.moment.law=skf"]);
    assert_eq!(
        palmgren("angular contact", "15 deg", "72B").unwrap_err(),
        "error[AB0208]: a.toml, --set: bearing.contact_angle: found a contact angle of 15 deg; 35 to 45 deg is needed, for which the constants of series 72B are; else Palmgren's law with f0, f1_factor and f1_exponent by hand, or a measured curve"
    );
    let shown = skf("angular contact", "15 deg").unwrap_err();
    assert!(
        shown.contains("AB0208") && shown.contains("the constants of the SKF model"),
        "{shown}"
    );
    for (accepted, scenario) in [
        (true, palmgren("angular contact", "35 deg", "72B")),
        (true, palmgren("angular contact", "45 deg", "72B")),
        (false, palmgren("angular contact", "34.9 deg", "72B")),
        (false, palmgren("angular contact", "15 deg", "02")),
        (true, palmgren("angular contact", "25 deg", "02")),
        (
            true,
            palmgren("angular contact double row", "30 deg", "33B"),
        ),
        (
            false,
            palmgren("angular contact double row", "40 deg", "33B"),
        ),
        (true, skf("angular contact", "40 deg")),
        (false, skf("angular contact", "25 deg")),
        (true, skf("angular contact double row", "30 deg")),
        (false, skf("angular contact double row", "40 deg")),
        (true, skf("four-point contact", "")),
    ] {
        assert_eq!(scenario.is_ok(), accepted, "{:?}", scenario.err());
    }
    // a given angle under load is looked at too, and the file counts before the catalogue
    let spindle = SPIN_UP.replace("6005", "SNFA EX 25");
    let sets = |more| with(&with(&PALMGREN, &["bearing.moment.series=70B"]), more);
    let shown = read(&spindle, &sets(&[])).unwrap_err();
    assert!(shown.contains("found a contact angle of 15 deg"), "{shown}");
    read(&spindle, &sets(&["bearing.contact_angle=40 deg"])).unwrap();
    let load = [
        "bearing.contact_angle=40 deg",
        "bearing.moment.contact_angle=30 deg",
    ];
    assert!(read(&spindle, &sets(&load)).unwrap_err().contains("30 deg"));
}

#[test]
fn the_preload_of_a_bearing_reaches_its_friction_law() {
    let by_hand = [
        "bearing.moment.law=palmgren",
        "bearing.moment.f0=1.3",
        "bearing.moment.f1_factor=1e-3",
        "bearing.moment.f1_exponent=0.33",
        "bearing.moment.viscosity=20 mm^2/s",
        "bearing.moment.scale=1",
        "run.duration=0.1 ms",
    ];
    let spindle = SPIN_UP.replace("6005", "SNFA EX 25");
    let run = |more: &[&str]| {
        let scenario = read(&spindle, &with(&by_hand, more)).unwrap();
        let interrupt = AtomicBool::new(false);
        let outcome = run::run(&scenario, &Options::unwatched(&interrupt)).unwrap();
        let warned = outcome
            .warnings
            .iter()
            .find(|warning| warning.code == "AB1081");
        let bearing = files::spin_up(scenario).bearing;
        (
            bearing.moment.axial_load(),
            warned.map(|warning| warning.text.clone()),
        )
    };
    assert_eq!(run(&[]), (0.0, None));
    assert_eq!(run(&["bearing.axial_preload=200 N"]), (200.0, None));
    // what is given wins; a difference is said
    let (counted, warned) = run(&[
        "bearing.axial_preload=200 N",
        "bearing.moment.axial_load=50 N",
    ]);
    assert_eq!(counted, 50.0);
    let warned = warned.unwrap();
    assert!(
        warned.contains("50 N") && warned.contains("200 N"),
        "{warned}"
    );
    let same = run(&[
        "bearing.axial_preload=200 N",
        "bearing.moment.axial_load=-200 N",
    ]);
    assert_eq!(same, (-200.0, None));
    // by hand: P1 = 0.9 cot 15°·200 - 8 = 663.8 N, P0 = 0.5·80 + 0.46·200 = 132 N
    let scenario = read(&spindle, &with(&by_hand, &["bearing.axial_preload=200 N"])).unwrap();
    let bearing = files::spin_up(scenario.clone()).bearing;
    let rating = bearing.static_load_rating.unwrap();
    let expected = 1e-3 * (132.0 / rating).powf(0.33) * 663.77 * bearing.pitch_diameter * 1e3;
    let ours = load_moment(Ok(scenario), 80.0);
    assert!((ours / expected - 1.0).abs() < 1e-4, "{ours} {expected}");
    // the printed form has no axial load
    let printed = with(
        &by_hand[1..],
        &[
            "bearing.moment.law=palmgren printed",
            "bearing.axial_preload=200 N",
        ],
    );
    let scenario = read(&spindle, &printed).unwrap();
    let interrupt = AtomicBool::new(false);
    let outcome = run::run(&scenario, &Options::unwatched(&interrupt)).unwrap();
    let warned = outcome
        .warnings
        .iter()
        .find(|warning| warning.code == "AB1081");
    assert!(warned.unwrap().text.contains("whose printed form has none"));
}

#[test]
fn viscosity_follows_the_temperature() {
    let sets = [
        "bearing.moment.law=palmgren",
        "bearing.moment.lubrication=grease",
        POINTS,
        "bearing.moment.temperature=40 degC",
    ];
    let Moment::Palmgren { viscosity, .. } = spin_up(&sets).bearing.moment else {
        panic!();
    };
    // at one of its points the line gives the point
    assert!((viscosity / 1e-4 - 1.0).abs() < 1e-9, "{viscosity}");
    let again = scenario(&sets).unwrap().resolved.toml();
    let again = Scenario::parse(&again, "b.toml", &[], &BuiltIn).unwrap();
    assert_eq!(again.system, scenario(&sets).unwrap().system);
}

#[test]
fn temperatures_and_points_that_show_nothing_are_refused() {
    let law = [
        "bearing.moment.law=palmgren",
        "bearing.moment.lubrication=grease",
    ];
    let shown = |more: &[&str]| message(&with(&law, more));
    assert_eq!(
        shown(&[POINTS, "bearing.moment.temperature=600 degC"]),
        "error[AB0208]: a.toml, --set: bearing.moment.temperature: found 600.0 °C, where this oil has no viscosity: its line of ASTM D341 goes from -54.8 °C, 2e7 mm²/s, to 350.0 °C, 0.21 mm²/s or where oils crack; a temperature between those is needed, or the viscosity itself"
    );
    assert_eq!(
        shown(&[POINTS]),
        "error[AB0107]: a.toml: bearing.moment.temperature: found no value; a temperature above 0 is needed with viscosity_points, e.g. \"60 degC\""
    );
    assert_eq!(
        shown(&[
            "bearing.moment.viscosity=1e-4 m^2/s",
            "bearing.moment.temperature=60 degC"
        ]),
        "error[AB0110]: a.toml, --set: bearing.moment.temperature: found \"60 degC\", which has no effect; it is used only with bearing.moment.viscosity_points; a given viscosity holds as it is"
    );
    let rising = "bearing.moment.viscosity_points=[[\"40 degC\", \"10 mm^2/s\"], [\"100 degC\", \"11 mm^2/s\"]]";
    assert_eq!(
        shown(&[rising, "bearing.moment.temperature=60 degC"]),
        "error[AB0208]: a.toml, --set: bearing.moment.viscosity_points: found the viscosity of an oil falls with temperature; two points of one oil are needed"
    );
    let three = "bearing.moment.viscosity_points=[[\"20 degC\", \"400 mm^2/s\"], [\"40 degC\", \"100 mm^2/s\"], [\"100 degC\", \"11 mm^2/s\"]]";
    assert_eq!(
        shown(&[three, "bearing.moment.temperature=60 degC"]),
        "error[AB0102]: a.toml, --set: bearing.moment.viscosity_points: found 3 rows; two rows are needed, e.g. at 40 degC and 100 degC"
    );
    let shown = shown(&[POINTS, "bearing.moment.viscosity=1e-4 m^2/s"]);
    assert!(shown.starts_with("error[AB0109]"), "{shown}");
}

#[test]
fn the_skf_model_takes_what_its_catalogue_has() {
    let Moment::Skf {
        series,
        outer_diameter,
        ..
    } = spin_up(&SKF).bearing.moment
    else {
        panic!();
    };
    assert_eq!((series.as_str(), outer_diameter), ("60", 0.047));
    assert_eq!(
        message(&[
            "bearing.moment.law=skf",
            "bearing.moment.viscosity=1e-4 m^2/s"
        ]),
        "error[AB0107]: a.toml: bearing.moment.lubrication: found no value; one of \"grease\", \"oil and air\", \"oil bath\", \"low oil bath\", \"oil jet\" is needed for the SKF model"
    );
    let shown = message(&with(&SKF, &["bearing.moment.lubrication=oil mist"]));
    assert!(
        shown.starts_with(
            "error[AB0208]: a.toml, --set: bearing.moment.lubrication: found \"oil mist\""
        ),
        "{shown}"
    );
    let shown = message(&with(&SKF, &["bearing.moment.series=99"]));
    assert!(
        shown.starts_with("error[AB0208]") && shown.contains("99"),
        "{shown}"
    );
    assert_eq!(
        message(&with(&SKF, &["bearing.moment.outer_diameter=20 mm"])),
        "error[AB0203]: a.toml, --set: bearing.moment.outer_diameter: found 20 mm; more than bore_diameter = 0.025 m is needed. The dimensions that are not given are those of bearing.name = \"6005\""
    );
}

#[test]
fn load_friction_without_a_load_rating_is_refused() {
    let text = template_without_rating();
    let sets: Vec<String> = [
        "bearing.moment.law=palmgren",
        "bearing.moment.f0=2",
        "bearing.moment.f1_factor=9e-4",
        "bearing.moment.f1_exponent=0.5",
        "bearing.moment.viscosity=100 mm^2/s",
    ]
    .map(String::from)
    .to_vec();
    let problem = Scenario::parse(&text, "a.toml", &sets, &BuiltIn).unwrap_err();
    assert_eq!(
        problem.to_string(),
        "error[AB0107]: a.toml: bearing.static_load_rating: found no value; bearing.moment.law = \"palmgren\" needs it, e.g. \"6.55 kN\""
    );
}

/// The starting file with the dimensions of its examples instead of a name, and without a load rating.
fn template_without_rating() -> String {
    let text = auxbear::scenario::template("spin_up").unwrap();
    let unnamed = text.replacen("\nname = ", "\n# name = ", 1);
    let dimensions = [
        "bore_diameter",
        "ball_count",
        "ball_diameter",
        "pitch_diameter",
        "inner_race_mass",
        "inner_race_inertia",
        "cage_mass",
    ];
    dimensions.iter().fold(unnamed, |text, name| {
        text.replacen(&format!("\n# {name} = "), &format!("\n{name} = "), 1)
    })
}

#[test]
fn measured_curves_are_checked() {
    let curve = |rows: &str| {
        scenario(&[
            "bearing.moment.law=measured",
            &format!("bearing.moment.curve={rows}"),
        ])
    };
    let good = curve("[[\"10 rad/s\", \"14 N mm\"], [\"150 rad/s\", \"25 N mm\"]]").unwrap();
    let System::SpinUp(good) = good.system else {
        panic!();
    };
    assert_eq!(
        good.bearing.moment,
        Moment::Measured {
            curve: vec![[10.0, 0.014], [150.0, 0.025]]
        }
    );
    let shown = curve("[[\"10 rad/s\", \"14 N mm\"], [\"5 rad/s\", \"25 N mm\"]]").unwrap_err();
    assert!(shown.starts_with("error[AB0114]: a.toml, --set: bearing.moment.curve: found \"5 rad/s\" in row 2, which is not above \"10 rad/s\" in row 1"), "{shown}");
    let shown = curve("[[\"10 rad/s\", \"14 N mm\"], [\"50 rad/s\", \"-1 N mm\"]]").unwrap_err();
    assert_eq!(
        shown,
        "error[AB0209]: a.toml, --set: bearing.moment.curve: found a moment below 0 in row 2, which would create energy; moments not below 0 are needed: the curve holds for both directions"
    );
}

#[test]
fn a_loss_that_would_create_energy_is_refused() {
    let rolling = "bearing.fidelity=rolling";
    let tail = "; a value not below 0 is needed: F has the sign of the rotation, and resists it while the race speeds up and while it slows down";
    for (kind, key, value, found) in [
        (
            "constant",
            "force",
            "-1 N",
            "-1 N, which would create energy",
        ),
        (
            "proportional",
            "per_acceleration",
            "-1e-5 N s^2/rad",
            "-1e-5 N s^2/rad, which would create energy",
        ),
        (
            "over speed",
            "force_over_speed",
            "[[\"0 rad/s\", \"1 N\"], [\"9 rad/s\", \"-1 N\"]]",
            "a value below 0 in row 2, which would create energy",
        ),
    ] {
        assert_eq!(
            message(&[
                rolling,
                &format!("bearing.acceleration_loss.kind={kind}"),
                &format!("bearing.acceleration_loss.{key}={value}"),
            ]),
            format!(
                "error[AB0209]: a.toml, --set: bearing.acceleration_loss.{key}: found {found}{tail}"
            )
        );
    }
    assert_eq!(
        spin_up(&[
            rolling,
            "bearing.acceleration_loss.kind=constant",
            "bearing.acceleration_loss.force=0.5 N"
        ])
        .bearing
        .acceleration_loss,
        AccelerationLoss::Constant { force: 0.5 }
    );
    assert_eq!(
        message(&["bearing.acceleration_loss.kind=constant"]),
        "error[AB0110]: a.toml, --set: bearing.acceleration_loss.kind: found a key that has no effect; it is used only with bearing.fidelity = \"rolling\" (in the planar fidelity the pockets are computed, not given); here it is \"planar\""
    );
}

#[test]
fn a_loss_beyond_the_inertia_leaves_braking_without_an_answer() {
    let shown = message(&[
        "bearing.fidelity=rolling",
        "bearing.acceleration_loss.kind=proportional",
        "bearing.acceleration_loss.per_acceleration=1 N s^2/rad",
    ]);
    assert!(
        shown.starts_with(
            "error[AB0211]: a.toml, --set: bearing.acceleration_loss.per_acceleration: found 1 N s^2/rad; less than"
        ),
        "{shown}"
    );
}

#[test]
fn drag_to_the_ground_and_a_moment_exclude_each_other() {
    let text = auxbear::scenario::template("drop").unwrap();
    let sets: Vec<String> = [
        "bearing.moment.law=measured",
        "bearing.moment.curve=[[\"10 rad/s\", \"14 N mm\"], [\"150 rad/s\", \"25 N mm\"]]",
        "bearing.drag.orbit=2e-4 N s/m",
    ]
    .map(String::from)
    .to_vec();
    let problem = Scenario::parse(&text, "a.toml", &sets, &BuiltIn).unwrap_err();
    assert_eq!(
        problem.to_string(),
        "error[AB0109]: a.toml, --set: bearing.drag.orbit: found 2e-4 N s/m; no drag to the ground is possible together with bearing.moment.law = \"measured\", which holds it already"
    );
}
