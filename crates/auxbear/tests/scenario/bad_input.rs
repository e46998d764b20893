//! Every wrong input gets its one message: file, line, key, what was found, what is needed, what was meant.

use super::files::{DROP, read_from};
use auxbear::scenario::{BearingRecord, BearingSource, Provenance, Scenario};

struct TwoBearings;

impl BearingSource for TwoBearings {
    fn find(&self, name: &str) -> Option<BearingRecord> {
        self.names()
            .contains(&name.to_string())
            .then(|| BearingRecord {
                name: name.to_string(),
                values: vec![(
                    "bore_diameter".to_string(),
                    0.025,
                    Provenance::Catalogue {
                        bearing: name.to_string(),
                        mark: "read".to_string(),
                        source: "a catalogue".to_string(),
                    },
                )],
                words: Vec::new(),
            })
    }

    fn names(&self) -> Vec<String> {
        vec!["6005".to_string(), "61807".to_string()]
    }
}

fn parse(text: &str, sets: &[&str]) -> Result<Scenario, String> {
    read_from(&TwoBearings, "drop.toml", text, sets)
}

/// The message after one line of the good file is replaced.
fn message(line: &str, by: &str) -> String {
    assert!(DROP.contains(line), "{line}");
    parse(&DROP.replacen(line, by, 1), &[]).expect_err(by)
}

fn set_message(set: &str) -> String {
    parse(DROP, &[set]).expect_err(set)
}

#[test]
fn the_good_file_is_good() {
    assert!(parse(DROP, &[]).is_ok());
    assert!(parse(&format!("\u{feff}{DROP}"), &[]).is_ok());
    assert!(parse(&DROP.replace('\n', "\r\n"), &[]).is_ok());
    assert!(parse(DROP, &["rotor.speed=0 rpm"]).is_ok());
    assert!(parse(DROP, &["rotor.speed=-12000 rpm"]).is_ok());
}

#[test]
fn an_unknown_key_names_the_near_one() {
    assert_eq!(
        message("mass = \"8 kg\"", "mas = \"8 kg\""),
        "error[AB0101]: drop.toml:5: rotor.mas: found an unknown key; a key of [rotor] is needed; auxbear new drop lists them. Did you mean \"rotor.mass\"?"
    );
    assert_eq!(
        message("[rotor]", "[rotr]"),
        "error[AB0101]: drop.toml:4: rotr: found an unknown section; the top level takes format, system, title, description, catalogue, planes, rotor, gravity, levitation, contact, mount, base, bearing, run, coast_down, heat, repeat, auxiliary_bearing, measured, vary, limit. Did you mean \"rotor\"?"
    );
    assert_eq!(
        message("bore_diameter", "bearing.bore"),
        "error[AB0101]: drop.toml:16: contact.bearing: found an unknown section; [contact] takes radial_air_clearance, bore_diameter, width, exponent, stiffness, damping, friction_coefficient, friction_over_temperature, friction_reference_speed, surface. Did you mean \"bearing\"?"
    );
    assert_eq!(
        set_message("bearing.bal_count=9"),
        "error[AB0101]: drop.toml, --set: bearing.bal_count: found an unknown key; a key of [bearing] is needed; auxbear new drop lists them. Did you mean \"bearing.ball_count\"?"
    );
    assert_eq!(
        set_message("bearing.bore_diameter=25 mm"),
        "error[AB0101]: drop.toml, --set: bearing.bore_diameter: found an unknown key; a key of [bearing] is needed; auxbear new drop lists them. Did you mean \"contact.bore_diameter\" or \"bearing.fits.bore_diameter\" or \"bearing.moment.bore_diameter\"?"
    );
}

#[test]
fn the_first_wrong_line_is_reported() {
    let text = DROP
        .replace("polar_inertia", "inertia_polar")
        .replace("cage_mass", "cagemass");
    let shown = parse(&text, &[]).unwrap_err();
    assert!(
        shown.contains("drop.toml:6: rotor.inertia_polar:"),
        "{shown}"
    );
}

#[test]
fn a_bare_number_shows_the_right_form() {
    assert_eq!(
        message("mass = \"8 kg\"", "mass = 8"),
        "error[AB0103]: drop.toml:5: rotor.mass: found a bare number 8; a quantity with a unit is needed, e.g. \"8 kg\""
    );
    assert_eq!(
        message("mass = \"8 kg\"", "mass = \"8\""),
        "error[AB0103]: drop.toml:5: rotor.mass: found the number 8 without a unit; a mass above 0 is needed, e.g. \"8 kg\""
    );
    assert_eq!(
        message("\"0.25 mm\"", "2.5e-4"),
        "error[AB0103]: drop.toml:15: contact.radial_air_clearance: found a bare number 0.00025; a quantity with a unit is needed, e.g. \"0.25 mm\""
    );
}

#[test]
fn a_wrong_dimension_is_named() {
    assert_eq!(
        message("mass = \"8 kg\"", "mass = \"8 mm\""),
        "error[AB0105]: drop.toml:5: rotor.mass: found \"8 mm\", which is a length; a mass above 0 is needed, e.g. \"8 kg\""
    );
    assert_eq!(
        message("\"12000 rpm\"", "\"200 Hz\""),
        "error[AB0105]: drop.toml:8: rotor.speed: found \"200 Hz\", which is a frequency; an angular speed is needed, e.g. \"12000 rpm\". That frequency in cycles per second is \"1256.637061 rad/s\" as an angular speed"
    );
    assert_eq!(
        set_message("contact.stiffness=1e7 N/m"),
        "error[AB0105]: drop.toml, --set: contact.stiffness: found \"1e7 N/m\", which is a stiffness; a contact stiffness above 0 in N/m^n with n = contact.exponent is needed, e.g. \"5e8 N/m^(10/9)\"; here n = 10/9"
    );
    assert_eq!(
        set_message("contact.exponent=1.5"),
        "error[AB0107]: drop.toml: contact.stiffness: found no value; a contact stiffness above 0 in N/m^n with n = contact.exponent is needed, e.g. \"5e8 N/m^(10/9)\". It has a default only with contact.exponent = \"10/9\""
    );
}

#[test]
fn an_unreadable_quantity_is_explained() {
    assert_eq!(
        message("\"12000 rpm\"", "\"12000 rmp\""),
        "error[AB0104]: drop.toml:8: rotor.speed: found the unknown unit \"rmp\"; an angular speed is needed, e.g. \"12000 rpm\". Did you mean \"rpm\"?"
    );
    assert_eq!(
        message("\"0.25 mm\"", "\"0,25 mm\""),
        "error[AB0104]: drop.toml:15: contact.radial_air_clearance: found a comma in \"0,25 mm\"; decimals are written with a point and thousands without a mark; a length above 0 is needed, e.g. \"0.25 mm\""
    );
    assert_eq!(
        message("\"8 kg\"", "\"1e400 kg\""),
        "error[AB0106]: drop.toml:5: rotor.mass: found \"1e400 kg\", which is too large or too small to compute with; a mass above 0 is needed, e.g. \"8 kg\""
    );
}

#[test]
fn values_out_of_range_are_refused() {
    assert_eq!(
        message("mass = \"8 kg\"", "mass = \"-8 kg\""),
        "error[AB0106]: drop.toml:5: rotor.mass: found \"-8 kg\"; a mass above 0 is needed, e.g. \"8 kg\""
    );
    assert_eq!(
        message("ball_count = 10", "ball_count = 0"),
        "error[AB0106]: drop.toml:24: bearing.ball_count: found 0; a whole number from 1 to 60 is needed, e.g. 10"
    );
    assert_eq!(
        message("ball_count = 10", "ball_count = 61"),
        "error[AB0106]: drop.toml:24: bearing.ball_count: found 61; a whole number from 1 to 60 is needed, e.g. 10"
    );
    assert_eq!(
        message("ball_count = 10", "ball_count = -1"),
        "error[AB0106]: drop.toml:24: bearing.ball_count: found -1; a whole number from 1 to 60 is needed, e.g. 10"
    );
    assert_eq!(
        set_message("run.tolerance=nan"),
        "error[AB0106]: drop.toml, --set: run.tolerance: found NaN; a bare number from 1e-12 to 0.1 is needed, e.g. 1e-4"
    );
    assert_eq!(
        set_message("contact.exponent=20/9"),
        "error[AB0106]: drop.toml, --set: contact.exponent: found \"20/9\"; a bare number or fraction in quotes from 1 to 2 is needed, e.g. \"10/9\""
    );
    assert_eq!(
        set_message("bearing.inner_groove_curvature=0.5"),
        "error[AB0106]: drop.toml, --set: bearing.inner_groove_curvature: found 0.5; a bare number above 0.5 is needed, e.g. 0.52"
    );
}

#[test]
fn wrong_kinds_of_value_are_refused() {
    assert_eq!(
        message("ball_count = 10", "ball_count = 10.5"),
        "error[AB0102]: drop.toml:24: bearing.ball_count: found the number 10.5; a whole number from 1 to 60 is needed, e.g. 10"
    );
    assert_eq!(
        message("ball_count = 10", "ball_count = \"10\""),
        "error[AB0102]: drop.toml:24: bearing.ball_count: found the text \"10\"; a whole number from 1 to 60 is needed, e.g. 10"
    );
    assert_eq!(
        message("mass = \"8 kg\"", "mass = [8]"),
        "error[AB0102]: drop.toml:5: rotor.mass: found a list; a mass above 0 is needed, e.g. \"8 kg\""
    );
    assert_eq!(
        message("[mount]", "gravity = \"9.81 m/s^2\"\n[mount]"),
        "error[AB0101]: drop.toml:18: contact.gravity: found an unknown key; [contact] takes radial_air_clearance, bore_diameter, width, exponent, stiffness, damping, friction_coefficient, friction_over_temperature, friction_reference_speed, surface. Gravity is gravity.acceleration with gravity.direction"
    );
    assert_eq!(
        message(
            "system = \"drop\"",
            "system = \"drop\"\ngravity = \"9.81 m/s^2\""
        ),
        "error[AB0102]: drop.toml:3: gravity: found the text \"9.81 m/s^2\"; a section [gravity] with keys is needed"
    );
    assert_eq!(
        message("[mount]", "[mount.stiffness]"),
        "error[AB0101]: drop.toml:18: mount.stiffness.stiffness: found an unknown key; { value = \"2e7 N/m\", source = \"…\" } or { value = \"2e7 N/m\", assumed = \"why\" } is needed"
    );
    assert_eq!(
        set_message("rotor.spin=brake"),
        "error[AB0108]: drop.toml, --set: rotor.spin: found \"brake\"; one of \"free\", \"braked\", \"held\" is needed. Did you mean \"braked\"?"
    );
    assert_eq!(
        set_message("bearing.cage.pocket_contact=yes"),
        "error[AB0102]: drop.toml, --set: bearing.cage.pocket_contact: found the text \"yes\"; true or false is needed"
    );
}

#[test]
fn radial_and_diametral_are_distinguished() {
    let both = "contact.radial_air_clearance is the radial gap between rotor and inner race, half the difference of their diameters; bearing.operating_diametral_clearance is the diametral internal clearance of the bearing";
    for name in ["clearance", "air_clearance", "diametral_air_clearance"] {
        let shown = message("radial_air_clearance", name);
        assert_eq!(
            shown,
            format!(
                "error[AB0101]: drop.toml:15: contact.{name}: found an unknown key; [contact] takes radial_air_clearance, bore_diameter, width, exponent, stiffness, damping, friction_coefficient, friction_over_temperature, friction_reference_speed, surface. {both}"
            )
        );
    }
    for name in [
        "radial_internal_clearance",
        "diametral_internal_clearance",
        "preload",
    ] {
        let shown = set_message(&format!("bearing.{name}=5 um"));
        assert!(shown.ends_with(both), "{shown}");
    }
    let shown = set_message("bearing.ball_radius=3 mm");
    assert!(
        shown.ends_with("The file takes diameters: bearing.ball_diameter, bearing.pitch_diameter, contact.bore_diameter"),
        "{shown}"
    );
    // A mere slip of the pen is reported as one.
    let shown = message("radial_air_clearance", "radial_air_clearence");
    assert!(
        shown.ends_with("Did you mean \"contact.radial_air_clearance\"?"),
        "{shown}"
    );
}

#[test]
fn geometry_that_cannot_be_is_refused() {
    // 36 mm sin(π/18) = 6.2513 mm < 6.35 mm; 36 mm sin(π/17) = 6.6151 mm.
    assert_eq!(
        message("ball_count = 10", "ball_count = 18"),
        "error[AB0202]: drop.toml:24: bearing.ball_count: found 18 balls of 6.35 mm on a pitch circle of 36 mm, whose centres are only 6.251 mm apart; at most 17 balls fit"
    );
    for fits in ["bearing.ball_count=17", "bearing.ball_count=3"] {
        assert!(parse(DROP, &[fits]).is_ok(), "{fits}");
    }
    assert_eq!(
        message("\"36 mm\"", "\"6 mm\""),
        "error[AB0203]: drop.toml:26: bearing.pitch_diameter: found 6 mm; more than ball_diameter = 6.35 mm is needed"
    );
    assert_eq!(
        message("\"25 mm\"", "\"29.65 mm\""),
        "error[AB0203]: drop.toml:16: contact.bore_diameter: found 29.65 mm; less than the track of the inner race is needed: pitch_diameter - ball_diameter = 29.65 mm"
    );
    assert_eq!(
        message("\"0.25 mm\"", "\"12.5 mm\""),
        "error[AB0204]: drop.toml:15: contact.radial_air_clearance: found 12.5 mm; less than half of contact.bore_diameter = 25 mm is needed"
    );
}

#[test]
fn contact_at_the_start_is_refused_with_both_numbers() {
    assert_eq!(
        set_message("levitation.offset_y=-0.25 mm"),
        "error[AB0205]: drop.toml:15: contact.radial_air_clearance: found a levitated rotor that reaches 0.2554 mm from the bearing centre (offset 0.25 mm, whirl by unbalance 0.005398 mm); less than the radial air clearance 0.25 mm is needed, so that nothing touches before the drop"
    );
    // The reference start state of the same machine has its mass centre at G = (-0.36718, -0.57978) µm with e = 5 µm along
    // x, so the geometric centre is |G - e| = 5.398403 µm from the centre of levitation.
    assert!(set_message("contact.radial_air_clearance=5.3984 um").contains("AB0205"));
    assert!(parse(DROP, &["contact.radial_air_clearance=5.3985 um"]).is_ok());
    // Two planes share twice the mass.
    let two = |clearance: &str| {
        let clearance = format!("contact.radial_air_clearance={clearance}");
        parse(DROP, &["rotor.mass=16 kg", "rotor.planes=2", &clearance])
    };
    assert!(two("5.3984 um").is_err() && two("5.3985 um").is_ok());
    // At rest the unbalance does not whirl.
    assert!(
        parse(
            DROP,
            &["rotor.speed=0 rpm", "contact.radial_air_clearance=1 nm"]
        )
        .is_ok()
    );
    // Far above resonance the rotor turns about its centre of mass: the whirl is the eccentricity, 5 µm.
    let fast = |clearance: &str| {
        let clearance = format!("contact.radial_air_clearance={clearance}");
        parse(DROP, &["rotor.speed=1e6 rpm", &clearance])
    };
    assert!(fast("4.99 um").is_err() && fast("5.01 um").is_ok());
    // no rotor holds together at 1e200 rpm
    let told = parse(DROP, &["rotor.speed=1e200 rpm"]).unwrap_err();
    assert!(told.to_string().contains("at most 2000 m/s"));
    // Without damping the whirl at resonance has no bound.
    let resonant = parse(
        DROP,
        &[
            "rotor.mass=1 kg",
            "rotor.speed=1000 rad/s",
            "levitation.damping=0 N s/m",
        ],
    )
    .unwrap_err();
    assert!(
        resonant.ends_with("The levitation is near resonance: its natural frequency is 1.0000e3 rad/s and the speed 1.0000e3 rad/s"),
        "{resonant}"
    );
}

#[test]
fn a_traction_law_that_would_make_energy_is_refused() {
    let law = |a: &str, b: &str, d: &str| {
        let sets = [
            "bearing.traction.law=four parameter".to_string(),
            format!("bearing.traction.a={a}"),
            format!("bearing.traction.b={b}"),
            "bearing.traction.c=5 s/m".to_string(),
            format!("bearing.traction.d={d}"),
        ];
        parse(DROP, &sets.each_ref().map(String::as_str))
    };
    assert!(law("-0.07", "0.35 s/m", "0.07").is_ok());
    for (a, b, d) in [("0.07", "0 s/m", "-0.07"), ("-0.07", "-0.9 s/m", "0.07")] {
        let message = law(a, b, d).unwrap_err();
        assert!(
            message.starts_with("error[AB0109]") && message.contains("which would make energy"),
            "{message}"
        );
    }
}

#[test]
fn a_clearance_of_the_size_of_a_ball_is_refused() {
    for clearance in ["-0.3 mm", "2 mm", "1 m"] {
        let message = set_message(&format!(
            "bearing.operating_diametral_clearance={clearance}"
        ));
        assert!(
            message.starts_with("error[AB0204]") && message.contains("a few um"),
            "{message}"
        );
    }
}

#[test]
fn perturbed_starts_that_touch_are_refused() {
    let perturbed = |deviation: &str| parse(DROP, &["repeat.count=8", deviation]);
    let rotor = perturbed("repeat.rotor_position_deviation=1 mm").unwrap_err();
    assert!(
        rotor.contains("repeat.rotor_position_deviation") && rotor.contains("no perturbed start"),
        "{rotor}"
    );
    let balls = perturbed("repeat.ball_angle_deviation=1 rad").unwrap_err();
    assert!(balls.contains("bearing.cage.pocket_gap"), "{balls}");
    assert!(perturbed("repeat.rotor_position_deviation=1 um").is_ok());
}

#[test]
fn output_that_makes_no_sense_is_refused() {
    assert_eq!(
        set_message("run.output_interval=1 s"),
        "error[AB0206]: drop.toml, --set: run.output_interval: found 1 s; at most run.duration = 0.5 s is needed"
    );
    assert_eq!(
        set_message("run.output_interval=1 ns"),
        "error[AB0207]: drop.toml, --set: run.output_interval: found 1 ns, which gives 5.000e8 rows in 0.5 s; at most 6.67e5 rows are kept with 10 balls"
    );
}

#[test]
fn bearings_are_looked_up() {
    assert_eq!(
        message("[bearing]", "[bearing]\nname = \"6055\""),
        "error[AB0201]: drop.toml:24: bearing.name: found \"6055\", which is not in the catalogue; a bearing of the catalogue is needed (6005, 61807), or its dimensions instead of its name. Did you mean \"6005\"?"
    );
    assert_eq!(
        message("[bearing]", "[bearing]\nname = 6005"),
        "error[AB0102]: drop.toml:24: bearing.name: found the number 6005; a text in quotes is needed, e.g. \"6005\""
    );
    // On the command line the name needs no quotes.
    assert!(parse(DROP, &["bearing.name=6005"]).is_ok());
    let nameless = DROP.replace("bore_diameter = \"25 mm\"\n", "");
    assert_eq!(
        parse(&nameless, &[]).unwrap_err(),
        "error[AB0107]: drop.toml: contact.bore_diameter: found no value; a length above 0 is needed, e.g. \"25 mm\". bearing.name takes it from the catalogue"
    );
    assert!(parse(&nameless, &["bearing.name=6005"]).is_ok());
    let incomplete = DROP.replace("cage_mass = \"5 g\"\n", "");
    assert_eq!(
        parse(&incomplete, &["bearing.name=6005"]).unwrap_err(),
        "error[AB0107]: drop.toml: bearing.cage_mass: found no value; a mass above 0 is needed, e.g. \"5 g\". The catalogue does not know it of \"6005\""
    );
}

#[test]
fn keys_without_effect_are_refused() {
    assert_eq!(
        set_message("rotor.brake_torque=1 N m"),
        "error[AB0110]: drop.toml, --set: rotor.brake_torque: found a key that has no effect; it is used only with rotor.spin = \"braked\"; here it is \"free\""
    );
    assert_eq!(
        set_message("bearing.traction.a=0.1"),
        "error[AB0110]: drop.toml, --set: bearing.traction.a: found a key that has no effect; it is used only with bearing.traction.law = \"four parameter\"; here it is \"tanh\""
    );
    // The root of a chain of conditions is reported.
    let shown = set_message("bearing.moment.orbit_share=0.3");
    assert!(
        shown.contains("bearing.moment.law = \"palmgren\" or"),
        "{shown}"
    );
    assert_eq!(
        set_message("rotor.spin=braked"),
        "error[AB0107]: drop.toml: rotor.brake_torque: found no value; a torque not below 0 is needed, e.g. \"2 N m\""
    );
}

#[test]
fn two_values_for_one_thing_are_refused() {
    assert_eq!(
        message("speed = ", "unbalance = \"40 g mm\"\nspeed = "),
        "error[AB0109]: drop.toml:8: rotor.unbalance: found this and rotor.unbalance_eccentricity, which give the same thing; one of the two is needed"
    );
    let four = [
        "bearing.traction.law=four parameter",
        "bearing.traction.a=-0.07",
        "bearing.traction.b=0.35 s/m",
        "bearing.traction.c=5 s/m",
        "bearing.traction.d=0.08",
    ];
    assert_eq!(
        parse(DROP, &four).unwrap_err(),
        "error[AB0109]: drop.toml, --set: bearing.traction.d: found 0.08; d = -a = 0.07 is needed, so that there is no traction without slip"
    );
    assert!(parse(DROP, &[&four[..4], &["bearing.traction.d=0.07"]].concat()).is_ok());
    assert_eq!(
        message(
            "mass = \"8 kg\"",
            "mass = { value = \"8 kg\", source = \"a\", assumed = \"b\" }"
        ),
        "error[AB0109]: drop.toml:5: rotor.mass: found both source and assumed; { value = \"8 kg\", source = \"…\" } or { value = \"8 kg\", assumed = \"why\" } is needed"
    );
    assert_eq!(
        message("mass = \"8 kg\"", "mass = { source = \"a\" }"),
        "error[AB0107]: drop.toml:5: rotor.mass: found a table without value; { value = \"8 kg\", source = \"…\" } or { value = \"8 kg\", assumed = \"why\" } is needed"
    );
    assert_eq!(
        message(
            "mass = \"8 kg\"",
            "mass = { value = \"8 kg\", sorce = \"a\" }"
        ),
        "error[AB0101]: drop.toml:5: rotor.mass.sorce: found an unknown key; { value = \"8 kg\", source = \"…\" } or { value = \"8 kg\", assumed = \"why\" } is needed. Did you mean \"source\"?"
    );
}

#[test]
fn other_formats_and_systems_are_named() {
    assert_eq!(
        message("format = \"auxbear.scenario/1\"", ""),
        "error[AB0111]: drop.toml: format: found nothing; format = \"auxbear.scenario/1\" is needed"
    );
    assert_eq!(
        message("scenario/1", "scenario/2"),
        "error[AB0111]: drop.toml:1: format: found \"auxbear.scenario/2\"; format = \"auxbear.scenario/1\" is needed. A file of a newer format needs a newer program"
    );
    assert_eq!(
        message("\"auxbear.scenario/1\"", "1"),
        "error[AB0111]: drop.toml:1: format: found the number 1; format = \"auxbear.scenario/1\" is needed"
    );
    assert_eq!(
        message("system = \"drop\"", "system = \"mount\""),
        "error[AB0112]: drop.toml:2: system: found \"mount\", which is planned but not built yet; one of \"drop\", \"spin_up\", \"torque\", \"signals\", \"rig\", \"identify\", \"rotor\", \"machine\", \"coast_down\" is needed"
    );
    assert_eq!(
        set_message("system=dorp"),
        "error[AB0108]: drop.toml, --set: system: found \"dorp\"; one of \"drop\", \"spin_up\", \"torque\", \"signals\", \"rig\", \"identify\", \"rotor\", \"machine\", \"coast_down\" is needed. Did you mean \"drop\"?"
    );
    assert_eq!(
        message("system = \"drop\"", ""),
        "error[AB0107]: drop.toml: system: found no value; one of \"drop\", \"spin_up\", \"torque\", \"signals\", \"rig\", \"identify\", \"rotor\", \"machine\", \"coast_down\" is needed"
    );
    assert_eq!(
        message("system = \"drop\"", "system = 3"),
        "error[AB0102]: drop.toml:2: system: found the number 3; one of \"drop\", \"spin_up\", \"torque\", \"signals\", \"rig\", \"identify\", \"rotor\", \"machine\", \"coast_down\" is needed"
    );
}

#[test]
fn broken_toml_names_its_line() {
    let shown = message("\"0.25 mm\"", "0.25 mm");
    assert!(
        shown.starts_with("error[AB0100]: drop.toml:15: found what is not valid TOML ("),
        "{shown}"
    );
    let twice = message("[mount]", "bore_diameter = \"2 mm\"\n[mount]");
    assert!(
        twice.starts_with("error[AB0100]: drop.toml:18: found what is not valid TOML ("),
        "{twice}"
    );
    assert!(!twice.contains('\n'));
}

#[test]
fn unreadable_overrides_are_reported() {
    for set in ["rotor.mass", "=3", "rotor..mass=3", "rotor.mass=", ""] {
        assert_eq!(
            set_message(set),
            format!(
                "error[AB0113]: drop.toml, --set: found \"{set}\"; path=value is needed, e.g. --set \"rotor.speed=9000 rpm\""
            )
        );
    }
    // The value of an override cannot bring further keys with it.
    let smuggled = set_message("rotor.mass=1\nrotor.planes=2");
    assert!(smuggled.contains("AB0104"), "{smuggled}");
}
