//! A message blames the key that the user gave, with its line, and says what would put it right.

use super::files::read;
use auxbear::problem::Problem;
use auxbear::run::{self, Machine, Options};
use auxbear::scenario::Scenario;
use std::sync::atomic::AtomicBool;

/// The machine of a scenario.
fn built(scenario: &Scenario) -> Result<Machine<'_>, Box<Problem>> {
    run::build(scenario)
}

/// Complete files; overrides change them.
const SPIN_UP: &str = r#"format = "auxbear.scenario/1"
system = "spin_up"

[drive]
kind = "sliding rotor"
radial_load = "80 N"
rotor_speed = "1000 rad/s"

[bearing]
name = "6005"

[bearing.moment]
law = "palmgren"
f0 = 2
f1_factor = 0.0007
f1_exponent = 0.5
viscosity = "100 mm^2/s"

[run]
duration = "1 ms"
output_interval = "0.02 ms"
"#;
const DROP: &str = r#"format = "auxbear.scenario/1"
system = "drop"

[rotor]
mass = "8 kg"
polar_inertia = "0.01 kg m^2"
speed = "12000 rpm"

[levitation]
stiffness = "1e6 N/m"
damping = "1000 N s/m"

[contact]
radial_air_clearance = "0.25 mm"

[mount]
stiffness = "2e7 N/m"
damping = "5000 N s/m"
moving_mass = "0.15 kg"

[bearing]
name = "6005"
"#;

fn message(text: &str, sets: &[&str]) -> String {
    read(text, sets).expect_err(&format!("{sets:?}"))
}

#[test]
fn the_good_files_are_good() {
    read(SPIN_UP, &[]).unwrap();
    read(DROP, &[]).unwrap();
}

#[test]
fn what_the_machine_refuses_names_file_line_and_key() {
    // a loss by which a braked race would have no answer
    let text = SPIN_UP.replace(
        "\n[bearing.moment]",
        "fidelity = \"rolling\"\n\n[bearing.acceleration_loss]\nkind = \"proportional\"\nper_acceleration = \"1 N s^2/rad\"\n\n[bearing.moment]",
    );
    let shown = message(&text, &[]);
    assert!(
        shown.starts_with(
            "error[AB0211]: a.toml:15: bearing.acceleration_loss.per_acceleration: found 1 N s^2/rad"
        ),
        "{shown}"
    );
    let shown = message(
        &text,
        &["bearing.acceleration_loss.per_acceleration=2 N s^2/rad"],
    );
    assert!(
        shown.starts_with(
            "error[AB0211]: a.toml, --set: bearing.acceleration_loss.per_acceleration: found 2"
        ),
        "{shown}"
    );
}

#[test]
fn a_loaded_race_needs_three_balls() {
    let needed = "at least 3 balls are needed under a radial load: beside fewer the inner race falls out of the bearing. bearing.inner_race_centre_held = true would hold it";
    for text in [SPIN_UP, DROP] {
        assert_eq!(
            message(text, &["bearing.ball_count=2"]),
            format!("error[AB0211]: a.toml, --set: bearing.ball_count: found 2; {needed}")
        );
        read(text, &["bearing.ball_count=3"]).unwrap();
        let held = [
            "bearing.ball_count=2",
            "bearing.inner_race_centre_held=true",
        ];
        read(text, &held).unwrap();
    }
    // without load nothing falls
    let speed = SPIN_UP
        .replace("sliding rotor", "speed")
        .replace("rotor_speed", "final_speed");
    let unloaded = ["drive.radial_load=0 N", "bearing.ball_count=2"];
    read(&speed, &unloaded).unwrap();
}

#[test]
fn dimensions_that_contradict_the_bearing_named_are_refused() {
    let hint = "The dimensions that are not given are those of bearing.name = \"6005\"";
    for text in [SPIN_UP, DROP] {
        for (set, shown) in [
            (
                "bearing.pitch_diameter=24 mm",
                "error[AB0203]: a.toml, --set: bearing.pitch_diameter: found 24 mm; more than bore_diameter = 25 mm is needed. ",
            ),
            (
                "bearing.pitch_diameter=31 mm",
                "error[AB0203]: a.toml, --set: bearing.pitch_diameter: found 31 mm; more than 31.35 mm is needed, bore_diameter = 25 mm plus ball_diameter = 0.00635 m, or no ring is left inside the balls. ",
            ),
            (
                "bearing.pitch_diameter=45 mm",
                "error[AB0203]: a.toml, --set: bearing.pitch_diameter: found 45 mm; less than 40.65 mm is needed, outer_diameter = 47 mm less ball_diameter = 0.00635 m, or no ring is left outside the balls. ",
            ),
            (
                "bearing.ball_diameter=13 mm",
                "error[AB0203]: a.toml, --set: bearing.ball_diameter: found 13 mm; at most width = 12 mm is needed. ",
            ),
            (
                "bearing.ball_count=20",
                "error[AB0202]: a.toml, --set: bearing.ball_count: found 20 balls of 0.00635 m on a pitch circle of 0.036 m, whose centres are only 5.632 mm apart; at most 17 balls fit. ",
            ),
            (
                "bearing.ball_diameter=11.5 mm",
                "error[AB0203]: a.toml, --set: bearing.ball_diameter: found 11.5 mm; less than 11 mm is needed, pitch_diameter = 0.036 m less bore_diameter = 25 mm, or no ring is left inside the balls. ",
            ),
        ] {
            assert_eq!(message(text, &[set]), format!("{shown}{hint}"));
        }
    }
}

#[test]
fn a_drive_that_moves_nothing_is_refused() {
    let sliding = "a force above 0 is needed at some time of the run: the rotor turns the race by its friction, so without load nothing moves";
    assert_eq!(
        message(SPIN_UP, &["drive.radial_load=0 N"]),
        format!("error[AB0211]: a.toml, --set: drive.radial_load: found 0 N; {sliding}")
    );
    let table = |rows: &str| {
        SPIN_UP.replace(
            "radial_load = \"80 N\"",
            &format!("load_history = [[\"0 s\", \"0 N\"], {rows}]"),
        )
    };
    assert_eq!(
        message(&table("[\"1 s\", \"0 N\"]"), &[]),
        format!(
            "error[AB0211]: a.toml:6: drive.load_history: found nothing but 0 until run.duration = 1 ms; {sliding}"
        )
    );
    let late = table("[\"2 ms\", \"0 N\"], [\"3 ms\", \"9 N\"]");
    assert!(message(&late, &[]).contains("nothing but 0"));
    read(&late, &["run.duration=4 ms"]).unwrap();
    assert!(message(SPIN_UP, &["drive.friction_coefficient=0"]).contains("turns nothing"));
    let torque = SPIN_UP
        .replace("sliding rotor", "torque")
        .replace("rotor_speed", "reference_speed");
    let shown = message(&torque, &["drive.torque=0 N m"]);
    assert!(
        shown.starts_with("error[AB0211]: a.toml, --set: drive.torque: found 0 N m;"),
        "{shown}"
    );
    read(&torque, &["drive.torque=-0.1 N m"]).unwrap();
}

#[test]
fn keys_of_another_choice_are_reported_with_the_lines_to_remove() {
    assert_eq!(
        message(
            SPIN_UP,
            &[
                "bearing.moment.law=skf",
                "bearing.moment.lubrication=grease"
            ]
        ),
        "error[AB0110]: a.toml:14: bearing.moment.f0: found a key that has no effect; it is used only with bearing.moment.law = \"palmgren\" or \"palmgren printed\"; here it is \"skf\". Remove lines 14 (f0), 15 (f1_factor), 16 (f1_exponent), or leave --set bearing.moment.law away"
    );
    let changed = SPIN_UP.replace(
        "law = \"palmgren\"",
        "law = \"skf\"\nlubrication = \"grease\"",
    );
    assert!(
        message(&changed, &[]).ends_with("Remove lines 15 (f0), 16 (f1_factor), 17 (f1_exponent), or change bearing.moment.law in line 13")
    );
    let traction = SPIN_UP.replace("[run]", "[bearing.traction]\nkinetic = 0.1\n\n[run]");
    assert!(
        message(&traction, &[]).ends_with("Remove line 20 (kinetic), or give bearing.traction.law")
    );
    let shown = message(SPIN_UP, &["drive.kind=speed"]);
    assert!(
        shown.ends_with("Remove line 7 (rotor_speed), or leave --set drive.kind away"),
        "{shown}"
    );
    let loss = SPIN_UP.replace(
        "\n[run]",
        "\n[bearing.acceleration_loss]\nforce = \"1 N\"\n\n[run]",
    );
    let shown = message(&loss, &["bearing.fidelity=rolling"]);
    assert!(
        shown.ends_with("Remove line 20 (force), or give bearing.acceleration_loss.kind"),
        "{shown}"
    );
}

#[test]
fn a_duration_that_was_given_is_blamed_for_too_few_and_too_many_rows() {
    assert_eq!(
        message(SPIN_UP, &["run.duration=1 us"]),
        "error[AB0206]: a.toml, --set: run.duration: found 1 us; at least run.output_interval = 0.02 ms is needed"
    );
    assert_eq!(
        message(SPIN_UP, &["run.duration=1000 s"]),
        "error[AB0207]: a.toml, --set: run.duration: found 1000 s, which gives 5.000e7 rows at run.output_interval = 0.02 ms; at most 6.67e5 rows are kept with 10 balls"
    );
    let file = DROP.to_string() + "[run]\nduration = \"10 us\"\n";
    assert_eq!(
        message(&file, &[]),
        "error[AB0206]: a.toml:24: run.duration: found 10 us; at least run.output_interval = 0.1 ms is needed"
    );
    assert!(message(SPIN_UP, &["run.duration=0 s"]).contains("--set: run.duration: found \"0 s\""));
}

#[test]
fn only_drops_are_repeated_and_the_message_says_what_to_do() {
    let shown = message(SPIN_UP, &["repeat.count=4"]);
    assert!(
        shown.contains("repeat.count") && shown.contains("Only drops are repeated so far"),
        "{shown}"
    );
    assert!(shown.contains("--set PATH=VALUE"), "{shown}");
}

#[test]
fn an_axial_load_reaches_palmgrens_law() {
    let law = |text: &str, sets: &[&str]| {
        let scenario = read(text, sets).unwrap();
        let auxbear::scenario::System::SpinUp(spin_up) = scenario.system else {
            panic!("a spin-up was read");
        };
        let bearing = spin_up.bearing;
        let law = bearing.moment.law(&bearing.rated()).unwrap();
        law.parts(150.0, 80.0, bearing.moment.axial_load())
    };
    let radial = law(SPIN_UP, &[]);
    let combined = law(SPIN_UP, &["bearing.moment.axial_load=-400 N"]);
    assert_eq!(combined.speed_dependent, radial.speed_dependent);
    // by hand: P1 = 3·400 - 8 = 1192 N, P0 = 0.6·80 + 0.5·400 = 248 N,
    // M1 = 0.0007·√(248/6550)·1192·0.036 = 5.845e-3 N m; 0.9 cot 16.7° is 3 within 1e-4
    assert!(
        (combined.load_dependent / 5.845e-3 - 1.0).abs() < 1e-3,
        "{combined:?}"
    );
    let steep = law(
        SPIN_UP,
        &[
            "bearing.moment.axial_load=400 N",
            "bearing.moment.contact_angle=30 deg",
        ],
    );
    assert!(steep.load_dependent < combined.load_dependent);
    // a spindle bearing of the catalogue brings its angle
    let spindle = SPIN_UP.replace("6005", "SNFA EX 25");
    let scenario = read(&spindle, &["bearing.moment.axial_load=400 N"]).unwrap();
    let angle = scenario
        .resolved
        .get("bearing.moment.contact_angle")
        .unwrap();
    assert_eq!(angle.provenance.mark(), "catalogue");
    let shown = message(
        SPIN_UP,
        &[
            "bearing.moment.axial_load=9 N",
            "bearing.moment.contact_angle=60 deg",
        ],
    );
    assert!(
        shown.starts_with(
            "error[AB0208]: a.toml, --set: bearing.moment.contact_angle: found a deep groove"
        ),
        "{shown}"
    );
    let shown = message(
        SPIN_UP,
        &[
            "bearing.moment.axial_load=9 N",
            "bearing.type=four-point contact",
        ],
    );
    assert!(
        shown.contains("AB0208") && shown.contains("bearing.moment.axial_load"),
        "{shown}"
    );
    let printed = SPIN_UP.replace("\"palmgren\"", "\"palmgren printed\"");
    assert!(message(&printed, &["bearing.moment.axial_load=9 N"]).contains("AB0110"));
}

#[test]
fn an_axial_load_reaches_the_torque_of_a_bearing() {
    let text = "format = \"auxbear.scenario/1\"\nsystem = \"torque\"\n[bearing]\nname = \"6005\"\n[torque]\nloads = \"80 N\"\nspeed_to = \"150 rad/s\"\n";
    let moment = |sets: &[&str]| {
        let scenario = read(text, sets).unwrap();
        let interrupt = AtomicBool::new(false);
        let options = Options::unwatched(&interrupt);
        let outcome = run::run(&scenario, &options).unwrap();
        let column = outcome
            .history
            .iter()
            .find(|column| column.name == "friction.load_dependent");
        *column.unwrap().values.last().unwrap()
    };
    let radial = moment(&[]);
    // as in the test before, but f1 is of Schaeffler's table: P1 = 3.3·400 - 8 = 1312 N,
    // M1 = 0.0007·√(248/6550)·1312·0.036 = 6.433 N mm against 0.0007·√(80/6550)·80·0.036 = 0.2228 N mm
    let combined = moment(&["bearing.moment.axial_load=400 N"]);
    assert!(
        (combined / radial / (6.433 / 0.2228) - 1.0).abs() < 1e-3,
        "{combined} {radial}"
    );
}

#[test]
fn a_resolved_file_keeps_the_origin_of_every_value_as_long_as_it_is_that_value() {
    for text in [SPIN_UP, DROP] {
        let first = read(text, &["bearing.cage_mass=4 g"]).unwrap();
        let toml = first.resolved.toml();
        let again = read(&toml, &[]).unwrap();
        for (one, other) in first.resolved.values.iter().zip(&again.resolved.values) {
            assert_eq!((one.path, &one.provenance), (other.path, &other.provenance));
        }
        assert_eq!(again.resolved.toml(), toml);
        let line = "largest_step = { value = ";
        let (before, after) = toml.split_once(line).unwrap();
        let rest = after.split_once(',').unwrap().1;
        let changed = read(
            &format!("{before}{line}\"0.2 ms\",{rest}"),
            &["run.output_interval=0.5 ms"],
        )
        .unwrap();
        for path in ["run.largest_step", "run.output_interval"] {
            assert_eq!(
                changed.resolved.get(path).unwrap().provenance.mark(),
                "given",
                "{path}"
            );
        }
    }
    let shown = message(SPIN_UP, &["run.tolerance={ value = 1e-4, from = \"me\" }"]);
    assert!(
        shown.contains("run.tolerance.from") && shown.contains("\"default\" or \"catalogue\""),
        "{shown}"
    );
}

#[test]
fn what_is_derived_shows_its_number() {
    let scenario = read(DROP, &[]).unwrap();
    let number = |path: &str| scenario.resolved.get(path).unwrap().value_si.unwrap();
    // π/6 (6.35 mm)³ 7850 kg/m³ = 1.0524 g
    let ball = std::f64::consts::PI / 6.0 * 6.35e-3_f64.powi(3);
    let density = number("bearing.ball_mass") / ball;
    assert!((7700.0..7900.0).contains(&density), "{density}");
    // a flat of a ball on steel, K = 4/3 E* √r = 8.6e9 N/m^1.5, is softer, a groove some three times stiffer
    for path in [
        "bearing.inner_contact_stiffness",
        "bearing.outer_contact_stiffness",
    ] {
        assert!(
            (1.2e10..5e10).contains(&number(path)),
            "{path}: {}",
            number(path)
        );
    }
    let lacking = scenario
        .resolved
        .values
        .iter()
        .filter(|value| value.text.is_none() && value.provenance.mark() == "derived");
    assert_eq!(lacking.count(), 0);
}

#[test]
fn a_load_above_the_static_rating_is_reported_before_the_run() {
    let codes = |text: &str, sets: &[&str]| {
        let scenario = read(text, sets).unwrap();
        let machine = built(&scenario).unwrap();
        let codes: Vec<&str> = machine
            .warnings()
            .iter()
            .map(|warning| warning.code)
            // such masses are implausible for the inertia of the file
            .filter(|code| *code != "AB1094")
            .collect();
        codes
    };
    // C0 of a 6005 is 6.55 kN
    assert!(codes(SPIN_UP, &["drive.radial_load=6.5 kN"]).is_empty());
    assert_eq!(codes(SPIN_UP, &["drive.radial_load=6.6 kN"]), ["AB1029"]);
    assert!(codes(DROP, &["rotor.mass=660 kg"]).is_empty());
    assert_eq!(codes(DROP, &["rotor.mass=680 kg"]), ["AB1029"]);
    assert!(codes(DROP, &["rotor.mass=680 kg", "rotor.planes=2"]).is_empty());
}

#[test]
fn a_signals_file_that_is_missing_is_reported_where_it_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("identify.toml");
    let text = "format = \"auxbear.scenario/1\"\nsystem = \"identify\"\n[identify]\n\
                coast_down = [\"slow.toml\"]\n[bearing]\nname = \"6005\"\n";
    std::fs::write(&path, text).expect("a folder to write to");
    let scenario = auxbear::scenario::Scenario::read(&path, &[], &auxbear::scenario::BuiltIn)
        .expect("it is right");
    let problem = auxbear::run::build(&scenario).err();
    let shown = problem.expect("a file is missing").to_string();
    for part in [
        "error[AB0001]",
        "identify.toml:4: identify.coast_down",
        "slow.toml",
    ] {
        assert!(shown.contains(part), "{shown}");
    }
}
