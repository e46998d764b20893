//! Spin-up files: what they become, and the one message of each wrong one.

use super::files::{self, SPIN_UP, read_from};
use auxbear::scenario::{
    BuiltIn, Course, Drive, NoBearings, Scenario, SpeedCourse, SpinUp, template,
};

const SPEED: &str = "kind = \"speed\"";
const SLIDING: &str = "kind = \"sliding rotor\"";
const ROTOR: &str = "rotor_speed = \"1000 rad/s\"\n";

fn parse(text: &str, sets: &[&str]) -> Result<SpinUp, String> {
    read_from(&BuiltIn, "spin_up.toml", text, sets).map(files::spin_up)
}

/// The message after one line of the good file is replaced.
fn message(line: &str, by: &str) -> String {
    assert!(SPIN_UP.contains(line), "{line}");
    parse(&SPIN_UP.replacen(line, by, 1), &[]).expect_err(by)
}

fn set_message(set: &str) -> String {
    parse(SPIN_UP, &[set]).expect_err(set)
}

#[test]
fn a_sliding_rotor_is_read() {
    let read = parse(SPIN_UP, &[]).unwrap();
    assert_eq!(read.radial_load, Course::Constant(80.0));
    assert_eq!(read.load_direction, -std::f64::consts::FRAC_PI_2);
    assert_eq!(read.target_speed(), 1000.0);
    let Drive::SlidingRotor {
        rotor_speed,
        rotor_polar_inertia,
        bore_diameter,
        ..
    } = read.drive
    else {
        panic!("{read:?}");
    };
    assert_eq!(rotor_speed, 1000.0);
    assert_eq!(rotor_polar_inertia, None);
    assert_eq!(bore_diameter, 0.025);
    let free = [
        "drive.rotor_spin=free",
        "drive.rotor_polar_inertia=2e-3 kg m^2",
    ];
    let Drive::SlidingRotor {
        rotor_polar_inertia,
        ..
    } = parse(SPIN_UP, &free).unwrap().drive
    else {
        panic!();
    };
    assert_eq!(rotor_polar_inertia, Some(2e-3));
}

#[test]
fn tables_are_read_in_the_file_and_as_overrides() {
    let rows = "[[\"0 s\", \"200 N\"], [\"10 ms\", \"80 N\"]]";
    let table = Course::Table(vec![[0.0, 200.0], [0.01, 80.0]]);
    let by = format!("load_history = {{ value = {rows}, source = \"measured\" }}");
    let read = parse(&SPIN_UP.replace("radial_load = \"80 N\"", &by), &[]).unwrap();
    assert_eq!(read.radial_load, table);
    let without = SPIN_UP.replace("radial_load = \"80 N\"\n", "");
    let set = format!("drive.load_history={rows}");
    assert_eq!(parse(&without, &[&set]).unwrap().radial_load, table);
    // the resolved file holds the rows as they were written
    let scenario = Scenario::parse(&without, "a", &[set], &BuiltIn).unwrap();
    let toml = scenario.resolved.toml();
    assert!(toml.contains(&format!("load_history = {rows}\n")), "{toml}");
    let again = Scenario::parse(&toml, "a", &[], &NoBearings);
    assert!(again.is_err(), "the catalogue is asked for 6005");
    let again = Scenario::parse(&toml, "a", &[], &BuiltIn).unwrap();
    assert_eq!(again.system, scenario.system);
}

#[test]
fn speeds_and_torques_are_read() {
    let text = SPIN_UP.replace(ROTOR, "");
    let text = |kind: &str| text.replace(SLIDING, &format!("kind = \"{kind}\""));
    let speed = |sets: &[&str]| parse(&text("speed"), sets).unwrap().drive;
    assert_eq!(
        speed(&["drive.final_speed=150 rad/s"]),
        Drive::Speed(SpeedCourse::Step { final_speed: 150.0 })
    );
    assert_eq!(
        speed(&[
            "drive.final_speed=150 rad/s",
            "drive.acceleration=7200 rad/s^2"
        ]),
        Drive::Speed(SpeedCourse::Ramp {
            final_speed: 150.0,
            acceleration: 7200.0
        })
    );
    assert_eq!(
        speed(&["drive.speed_history=[[\"0 s\", \"0 rad/s\"], [\"1 s\", \"60 rad/s\"]]"]),
        Drive::Speed(SpeedCourse::Table(vec![[0.0, 0.0], [1.0, 60.0]]))
    );
    assert_eq!(
        parse(
            &text("torque"),
            &["drive.torque=0.1 N m", "drive.reference_speed=90 rad/s"]
        )
        .unwrap()
        .drive,
        Drive::Torque {
            torque: Course::Constant(0.1),
            reference_speed: 90.0
        }
    );
}

#[test]
fn keys_and_sections_of_another_system_are_refused() {
    assert_eq!(
        set_message("rotor.mass=8 kg"),
        "error[AB0110]: spin_up.toml, --set: rotor.mass: found a key that has no effect; it is used only with system = \"drop\" or \"coast_down\"; here it is \"spin_up\""
    );
    assert_eq!(
        message("[drive]", "[rotor]"),
        "error[AB0110]: spin_up.toml:4: rotor: found a section that has no effect; it is used only with system = \"drop\" or \"rotor\" or \"machine\" or \"coast_down\"; here it is \"spin_up\""
    );
    assert_eq!(
        set_message("contact.friction_coefficient=0.2"),
        "error[AB0110]: spin_up.toml, --set: contact.friction_coefficient: found a key that has no effect; it is used only with system = \"drop\" or \"machine\"; here it is \"spin_up\". Did you mean \"drive.friction_coefficient\" or \"bearing.full_complement.friction_coefficient\"?"
    );
    assert_eq!(
        set_message("rotor.speed=800 rad/s"),
        "error[AB0110]: spin_up.toml, --set: rotor.speed: found a key that has no effect; it is used only with system = \"drop\" or \"rotor\" or \"machine\" or \"coast_down\"; here it is \"spin_up\". Did you mean \"drive.rotor_speed\"?"
    );
    let shown = set_message("repeat.count=8");
    assert!(shown.starts_with("error[AB0110]: spin_up.toml, --set: repeat.count: found a key that has no effect; it is used only with system = \"drop\" or \"machine\"; here it is \"spin_up\". Only drops are repeated"), "{shown}");
    let torque = template("torque").unwrap();
    let sets = ["bearing.fidelity=rolling".to_string()];
    let problem = Scenario::parse(&torque, "torque.toml", &sets, &BuiltIn).unwrap_err();
    assert_eq!(
        problem.to_string(),
        "error[AB0110]: torque.toml, --set: bearing.fidelity: found a key that has no effect; it is used only with system = \"drop\" or \"spin_up\" or \"rig\" or \"machine\"; here it is \"torque\""
    );
}

#[test]
fn names_are_near_only_within_the_system() {
    let shown = set_message("drive.rotor_sped=3 rad/s");
    assert!(
        shown.contains("Did you mean \"drive.rotor_speed\"?"),
        "{shown}"
    );
    assert!(shown.contains("auxbear new spin_up lists them"), "{shown}");
    assert_eq!(
        message("[drive]", "[drvie]"),
        "error[AB0101]: spin_up.toml:4: drvie: found an unknown section; the top level takes format, system, title, description, catalogue, drive, bearing, run, heat, limit. Did you mean \"drive\"?"
    );
}

#[test]
fn each_kind_of_drive_has_its_own_keys() {
    assert_eq!(
        message(SLIDING, SPEED),
        "error[AB0110]: spin_up.toml:7: drive.rotor_speed: found a key that has no effect; it is used only with drive.kind = \"sliding rotor\"; here it is \"speed\". Remove line 7 (rotor_speed), or change drive.kind in line 5"
    );
    assert_eq!(
        message(ROTOR, ""),
        "error[AB0107]: spin_up.toml: drive.rotor_speed: found no value; an angular speed is needed, e.g. \"12000 rpm\""
    );
    let text = SPIN_UP.replace(ROTOR, "").replace(SLIDING, SPEED);
    assert_eq!(
        parse(&text, &[]).unwrap_err(),
        "error[AB0107]: spin_up.toml: drive.final_speed: found no value; an angular speed is needed, e.g. \"12000 rpm\""
    );
    let both = [
        "drive.speed_history=[[\"0 s\", \"0 rad/s\"], [\"1 s\", \"60 rad/s\"]]",
        "drive.acceleration=1 rad/s^2",
    ];
    assert_eq!(
        parse(&text, &both).unwrap_err(),
        "error[AB0109]: spin_up.toml, --set: drive.acceleration: found this and drive.speed_history, which give the same thing; one of the two is needed"
    );
    assert_eq!(
        set_message("drive.load_history=[[\"0 s\", \"1 N\"], [\"1 s\", \"2 N\"]]"),
        "error[AB0109]: spin_up.toml, --set: drive.load_history: found this and drive.radial_load, which give the same thing; one of the two is needed"
    );
}

#[test]
fn a_wrong_row_is_named() {
    let needed = "rows of a time, rising from row to row, and a force not below 0 are needed, e.g. [[\"0 s\", \"200 N\"], [\"10 ms\", \"80 N\"]]";
    let shown = |rows: &str| message("radial_load = \"80 N\"", &format!("load_history = {rows}"));
    for (rows, code, found) in [
        ("\"80 N\"", "AB0102", "the text \"80 N\""),
        ("[]", "AB0102", "an empty list"),
        ("[[\"0 s\", \"1 N\"]]", "AB0102", "a single row"),
        ("[[\"0 s\", \"1 N\"], 3]", "AB0102", "the number 3 as row 2"),
        (
            "[[\"0 s\", \"1 N\"], [\"1 s\"]]",
            "AB0102",
            "1 values in row 2",
        ),
        (
            "[[\"0 s\", \"1 N\"], [\"1 s\", 3]]",
            "AB0103",
            "the number 3 as second value of row 2",
        ),
        (
            "[[\"0 s\", \"1 N\"], [\"1 s\", \"3 mm\"]]",
            "AB0105",
            "\"3 mm\", a length, as second value of row 2",
        ),
        (
            "[[\"0 s\", \"1 N\"], [\"1 N\", \"3 N\"]]",
            "AB0105",
            "\"1 N\", a force, as first value of row 2",
        ),
        (
            "[[\"0 s\", \"1 N\"], [\"1 s\", \"3 Nn\"]]",
            "AB0104",
            "the unknown unit \"Nn\" as second value of row 2",
        ),
        (
            "[[\"0 s\", \"1 N\"], [\"1 s\", \"-3 N\"]]",
            "AB0106",
            "\"-3 N\" in row 2",
        ),
        (
            "[[\"-1 s\", \"1 N\"], [\"1 s\", \"3 N\"]]",
            "AB0106",
            "\"-1 s\", below 0, in row 1",
        ),
        (
            "[[\"0 s\", \"1 N\"], [\"10 ms\", \"3 N\"], [\"0.01 s\", \"4 N\"]]",
            "AB0114",
            "\"0.01 s\" in row 3, which is not above \"10 ms\" in row 2",
        ),
    ] {
        let whole =
            format!("error[{code}]: spin_up.toml:6: drive.load_history: found {found}; {needed}");
        let shown = shown(rows);
        assert!(shown.starts_with(&whole), "{shown}\n{whole}");
    }
}

#[test]
fn the_bore_is_smaller_than_the_track() {
    assert_eq!(
        set_message("drive.bore_diameter=30 mm"),
        "error[AB0203]: spin_up.toml, --set: drive.bore_diameter: found 30 mm; less than the track of the inner race is needed: pitch_diameter - ball_diameter = 29.65 mm"
    );
}

#[test]
fn the_speed_is_that_of_the_largest_row() {
    let text = SPIN_UP.replace(ROTOR, "").replace(SLIDING, SPEED);
    let rows = "drive.speed_history=[[\"0 s\", \"0 rad/s\"], [\"1 s\", \"-60 rad/s\"], [\"2 s\", \"0 rad/s\"]]";
    assert_eq!(parse(&text, &[rows]).unwrap().target_speed(), -60.0);
}

#[test]
fn a_speed_of_zero_is_no_spin_up() {
    assert_eq!(
        set_message("drive.rotor_speed=0 rpm"),
        "error[AB0106]: spin_up.toml, --set: drive.rotor_speed: found 0 rpm; an angular speed other than 0 is needed"
    );
}

#[test]
fn balls_that_always_roll_follow_no_step() {
    let text = SPIN_UP.replace(ROTOR, "").replace(SLIDING, SPEED);
    let rolling =
        |set: &str| parse(&text, &["bearing.fidelity=rolling", set]).expect_err("a step was taken");
    assert_eq!(
        rolling("drive.final_speed=100 rad/s"),
        "error[AB0211]: spin_up.toml: drive.acceleration: found no value, so a step of speed; an angular acceleration above 0 is needed with bearing.fidelity = \"rolling\", e.g. \"7200 rad/s^2\": balls that always roll cannot follow a step"
    );
    let rows = "[[\"0 s\", \"50 rad/s\"], [\"1 s\", \"60 rad/s\"]]";
    assert_eq!(
        rolling(&format!("drive.speed_history={rows}")),
        "error[AB0211]: spin_up.toml, --set: drive.speed_history: found a speed other than 0 at time 0, so a step; a first row with speed 0 is needed with bearing.fidelity = \"rolling\": balls that always roll cannot follow a step"
    );
}
