//! A levitated rotor: what is found, and what is refused.

use super::super::request::Request;
use super::*;
use outcome::{Quantity, Value};
use problem::Code;
use scenario::{BuiltIn, Scenario};

const SMALL: &str = r#"
format = "auxbear.scenario/1"
system = "rotor"
[rotor]
speed = "9000 rpm"
damping_of_stiffness = "1 us"
[[rotor.section]]
length = "0.5 m"
outer_diameter = "40 mm"
material = "steel"
elements = 10
[[rotor.unbalance]]
at = "0.25 m"
amount = "10 g mm"
[levitation.controller]
proportional = "8000 A/m"
integral = "8e4 A/(m s)"
derivative = "22 A s/m"
derivative_time = "45 us"
delay = "50 us"
[[levitation.sensor]]
magnet = "left"
at = "0.08 m"
bandwidth = "8 kHz"
[[levitation.sensor]]
magnet = "right"
at = "0.42 m"
[[levitation.magnet]]
name = "left"
at = "0.1 m"
current_stiffness = "40 N/A"
position_stiffness = "1.6e5 N/m"
gap = "0.5 mm"
largest_current = "5 A"
amplifier_bandwidth = "2 kHz"
[[levitation.magnet]]
name = "right"
at = "0.4 m"
current_stiffness = "40 N/A"
position_stiffness = "1.6e5 N/m"
amplifier_bandwidth = "2 kHz"
"#;

/// Its PID, which matrices replace.
const PID: &str = "proportional = \"8000 A/m\"\nintegral = \"8e4 A/(m s)\"\nderivative = \"22 A s/m\"\nderivative_time = \"45 us\"\n";

/// Words of the file, and what stands in their place.
type Change = (&'static str, &'static str);

/// The analysis of a file.
fn asked(text: &str) -> Result<Request, Box<Problem>> {
    let scenario = Scenario::parse(text, "small.toml", &[], &BuiltIn)?;
    Request::of(scenario.rotor().expect("a rotor"))
}

/// Their names and values.
fn values(all: Vec<Quantity>) -> Vec<(String, Value)> {
    (all.into_iter()).map(|own| (own.name, own.value)).collect()
}

/// What is found of the closed loop of a file.
fn looped(asked: &Request) -> Vec<(String, Value)> {
    let mut list = List::default();
    name(&mut list, &asked.model, asked.levitated.as_ref());
    values(list.quantities)
}

/// What becomes of the file with some words replaced.
fn outcome(changes: &[Change]) -> Result<Vec<(String, Value)>, Box<Problem>> {
    let mut text = SMALL.to_string();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    Ok(looped(&asked(&text)?))
}

fn number(found: &[(String, Value)], name: &str) -> f64 {
    match found.iter().find(|(own, _)| own == name) {
        Some((_, Value::Number(value))) => *value,
        other => panic!("{name}: {other:?}"),
    }
}

#[test]
fn a_small_rotor_on_two_magnets() {
    let found = outcome(&[]).unwrap();
    assert!(number(&found, "levitation.slowest_eigenvalue") < -5.0);
    let peak = number(&found, "levitation.left_1.rated.sensitivity_peak");
    assert!((1.0..3.0).contains(&peak), "{peak}");
    // half the weight of 4.93 kg on each magnet, shared by both axes at 45°; sensors outboard change a little
    let current = number(&found, "levitation.right_1.static_current").abs();
    let wanted = 0.5 * 7810.0 * 0.5 * 0.04 * 0.04 * std::f64::consts::FRAC_PI_4 * 9.80665
        / 2.0_f64.sqrt()
        / 40.0;
    assert!((current / wanted - 1.0).abs() < 0.05, "{current} {wanted}");
    let stiff = found
        .iter()
        .find(|(name, _)| name == "levitation.left_2.static_stiffness");
    assert!(matches!(&stiff.unwrap().1, Value::None { why } if why.contains("integrates")));
}

#[test]
fn the_scenario_that_ships_has_the_sensitivity_of_the_reference() {
    // the reference has linear magnets
    let text = include_str!("../../../../../scenarios/rotor_levitated.toml");
    let text = &text.replace("gap = \"0.5 mm\"\n", "");
    let asked = asked(text).unwrap_or_else(|problem| panic!("{problem}"));
    assert_eq!(asked.rotor().nodes.len(), 53);
    let found = looped(&asked);
    // machine_levitated.json at 1256.637 rad/s, peaks and slowest eigenvalue; the basis costs up to 4e-5
    for (name, wanted) in [
        (
            "levitation.drive_end_1.rated.sensitivity_peak",
            1.677_605_074,
        ),
        (
            "levitation.other_end_2.rated.sensitivity_peak",
            1.483_922_82,
        ),
        (
            "levitation.drive_end_1.standstill.sensitivity_peak",
            1.677_290_415,
        ),
        ("levitation.slowest_eigenvalue", -21.077_070_33),
    ] {
        let ours = number(&found, name);
        assert!((ours / wanted - 1.0).abs() < 4e-5, "{name}: {ours}");
    }
}

#[test]
fn matrices_and_samples_are_read_too() {
    let matrices = "a = \"-22222 0 0 0; 0 -22222 0 0; 0 0 -22222 0; 0 0 0 -22222\"\n\
        b = \"22222 0 0 0; 0 22222 0 0; 0 0 22222 0; 0 0 0 22222\"\n\
        c = \"-488884 0 0 0; 0 -488884 0 0; 0 0 -488884 0; 0 0 0 -488884\"\n\
        d = \"496884 0 0 0; 0 496884 0 0; 0 0 496884 0; 0 0 0 496884\"\n";
    let of_matrix = outcome(&[(PID, matrices)]).unwrap();
    let of_pid = outcome(&[
        ("integral = \"8e4 A/(m s)\"", ""),
        (
            "derivative_time = \"45 us\"",
            "derivative_time = \"45.0004500045 us\"",
        ),
    ])
    .unwrap();
    let name = "levitation.left_1.rated.sensitivity_peak";
    let (a, b) = (number(&of_matrix, name), number(&of_pid, name));
    assert!((a / b - 1.0).abs() < 1e-6, "{a} {b}");
    let sampled = outcome(&[(
        "delay = \"50 us\"",
        "sampling_period = \"50 us\"\ncomputing_time = \"25 us\"",
    )]);
    let (a, b) = (
        number(&sampled.unwrap(), name),
        number(&outcome(&[]).unwrap(), name),
    );
    assert!((a / b - 1.0).abs() < 1e-9);
}

/// The same controller with texts of bare numbers, as earlier files have them, and with quantities.
const SPELLINGS: [[&str; 2]; 2] = [
    [
        "a = \"-22222 0 0 0; 0 -22222 0 0; 0 0 -22222 0; 0 0 0 -22222\"
b = { value = \"22222 0 0 0; 0 22222 0 0; 0 0 22222 0; 0 0 0 22222\", source = \"drawing\" }
c = \"-488884 0 0 0; 0 -488884 0 0; 0 0 -488884 0; 0 0 0 -488884\"
d = \"496884 0 0 0; 0 496884 0 0; 0 0 496884 0; 0 0 0 496884\"
",
        "a = [[\"-22222 1/s\", 0, 0, 0], [0, \"-22.222 1/ms\", 0, 0], [0, 0, \"-22222 1/s\", 0], [0, 0, 0, \"-22222 1/s\"]]
b = [[\"22222 1/(m s)\", 0, 0, 0], [0, \"22222 1/(m s)\", 0, 0], [0, 0.0, \"22222 1/(m s)\", 0], [0, 0, 0, \"22222 1/(m s)\"]]
c = [[\"-488884 A\", 0, 0, 0], [0, \"-488884 A\", 0, 0], [\"0 A\", 0, \"-488884 A\", 0], [0, 0, 0, \"-488884 A\"]]
d = [[\"496884 A/m\", 0, 0, 0], [0, \"496.884 A/mm\", 0, 0], [0, 0, \"496884 A/m\", 0], [0, 0, 0, \"496884 A/m\"]]
",
    ],
    [
        "filters = [\"1 30 6.3e6 / 1 900 6.3e6\", \"1 / 1e-5 1\"]\n",
        "filters = [{ numerator = [1, \"30 1/s\", \"6.3e6 1/s^2\"], denominator = [1, \"900 1/s\", \"6.3e6 1/s^2\"] }, \
         { denominator = [\"10 us\", 1], numerator = [1.0] }]\n",
    ],
];

#[test]
fn both_spellings_of_matrices_and_filters_are_one_controller_to_the_bit() {
    for (number, spellings) in SPELLINGS.into_iter().enumerate() {
        let own = match number {
            0 => String::new(),
            _ => PID.to_string(),
        };
        let read = |spelling: &str| {
            let text = SMALL.replace(PID, &format!("{own}{spelling}"));
            Scenario::parse(&text, "small.toml", &[], &BuiltIn).unwrap()
        };
        let [before, now] = spellings.map(read);
        let controller = |scenario: &Scenario| {
            let resolved = scenario.resolved.toml();
            let (_, own) = resolved.split_once("[[levitation.controller]]").unwrap();
            own.to_string()
        };
        let found = |scenario: &Scenario| {
            let asked = Request::of(scenario.rotor().unwrap()).unwrap();
            format!("{:?}", asked.model.levitation.as_ref().unwrap().levitation)
        };
        assert_eq!(found(&before), found(&now));
        for scenario in [&before, &now] {
            let again = Scenario::parse(&scenario.resolved.toml(), "resolved.toml", &[], &BuiltIn);
            let again = again.unwrap();
            assert_eq!(found(&again), found(&before));
            assert_eq!(controller(&again), controller(scenario));
        }
        let resolved = controller(&before);
        let arrays = [
            "d = [[\"496884 A/m\", \"0 A/m\", \"0 A/m\", \"0 A/m\"], [\"0 A/m\", \"496884 A/m\",",
            "filters = [{ numerator = [1.0, \"30 1/s\", \"6300000 1/s^2\"], denominator = [1.0, \"900 1/s\",",
        ];
        assert!(resolved.contains(arrays[number]), "{resolved}");
    }
}

#[test]
fn commands_of_magnets_that_take_volts_are_in_volts() {
    let coil = "inductance = \"20 mH\"\nresistance = \"1.5 ohm\"\n";
    let volts = SMALL.replace("amplifier_bandwidth = \"2 kHz\"\n", coil);
    let last = volts.rfind(coil).unwrap();
    let mixed = format!("{}amplifier_bandwidth = \"2 kHz\"\n", &volts[..last]);
    let read = |text: &str, d: &str| {
        let text = text.replace(PID, &format!("d = {d}\n"));
        Scenario::parse(&text, "small.toml", &[], &BuiltIn).map_err(|problem| problem.to_string())
    };
    let texts = "\"1 0 0 0; 0 2 0 0; 0 0 3 0; 0 0 0 4\"";
    let resolved = read(&mixed, texts).unwrap().resolved.toml();
    for entry in ["\"2 V/m\"", "\"3 A/m\""] {
        assert!(resolved.contains(entry), "{resolved}");
    }
    let array = "[[\"1 V/m\", 0, 0, 0], [0, 0, 0, 0], [0, 0, \"3 V/m\", 0], [0, 0, 0, 0]]";
    assert!(read(&volts, array).is_ok());
    let told = read(&mixed, array).unwrap_err();
    let wanted =
        "levitation.controller.1.d: found V/m in row 3; commands of magnet \"right\" are in A";
    assert!(told.contains("AB0105") && told.contains(wanted), "{told}");
}

const NO_INTEGRAL: Change = ("integral = \"8e4 A/(m s)\"", "");

/// What is changed, and what is told of it.
#[rustfmt::skip]
const REFUSED: [(&[Change], Code, &str); 26] = [
    (&[("8000 A/m", "3000 A/m"), NO_INTEGRAL], Code::UnstableLevitation, "eigenvalue"),
    (&[("8000 A/m", "4000 A/m"), NO_INTEGRAL], Code::ZeroStaticStiffness, "left 1"),
    (&[("\"5 A\"", "\"2.2 A\"")], Code::CurrentLimit, "A of control current on axis left 1"),
    (&[("\"5 A\"", "\"1 A\"")], Code::MagnetValues, "2.0000 A follow"),
    (&[("gap = \"0.5 mm\"", "gap = \"0.5 mm\"\nbias_current = \"3 A\"")], Code::MagnetValues, "2.0000 A is needed"),
    (&[("at = \"0.08 m\"", "at = \"0.8 m\"")], Code::NoSuchNode, "beside the shaft"),
    (&[("magnet = \"left\"", "magnet = \"lift\"")], Code::LevitationParts, "left, right"),
    (&[("magnet = \"right\"", "magnet = \"left\"")], Code::LevitationParts, "a second sensor of \"left\"; one sensor for each"),
    (&[("[[levitation.sensor]]\nmagnet = \"right\"", "[[levitation.sensor]]\nat = \"0.1 m\"\n[[levitation.sensor]]\nmagnet = \"right\"")],
        Code::LevitationParts, "of every magnet without its own, and each has its own"),
    (&[("[levitation.controller]", "[[levitation.controller]]\ndelay = \"50 us\"\n[[levitation.controller]]")],
        Code::LevitationParts, "a second controller of every magnet without its own"),
    (&[(PID, "d = \"1 0; 0 1\"\n")], Code::ControllerSize, "2 signals to 2 commands"),
    (&[("delay = \"50 us\"", "filters = [\"1 0 0 / 1 2\"]")], Code::ControllerFilter, "3 coefficients over 2"),
    (&[(PID, "d = \"1 0; 0\"\n")], Code::WrongType, "1 values in row 2, 2 in row 1; rows of equally many quantities in A/m or V/m are needed"),
    (&[(PID, "d = [[\"1 A/m\", 0], [0]]\n")], Code::WrongType, "1 values in row 2, 2 in row 1"),
    (&[(PID, "d = \"1 0; 0 x\"\n")], Code::WrongType, "the text \"1 0; 0 x\""),
    (&[(PID, "d = [[\"1 A/m\", 0], [0, \"8000 N/m\"]]\n")], Code::WrongDimension, "\"8000 N/m\", a stiffness, in place of A/m as value 2 of row 2"),
    (&[(PID, "d = [[\"1 A/m\", \"1 V/m\"]]\n")], Code::WrongDimension, "in place of A/m as value 2 of row 1"),
    (&[(PID, "d = [[8000, 0]]\n")], Code::BareNumber, "the number 8000 in place of A/m as value 1 of row 1"),
    (&[(PID, "d = [[\"x A/m\", 0]]\n")], Code::UnreadableQuantity, "as value 1 of row 1"),
    (&[(PID, "d = [5]\n")], Code::WrongType, "the number 5 of row 1"),
    (&[("delay = \"50 us\"", "filters = [\"1 0\"]")], Code::WrongType, "the text \"1 0\""),
    (&[("delay = \"50 us\"", "filters = [{ numerator = [1], denominator = [1, \"900 1/m\"] }]")], Code::WrongDimension, "in place of 1/s as value 2 of the denominator of filter 1"),
    (&[("delay = \"50 us\"", "filters = { numerator = [\"1 s\", 0, 0], denominator = [1, 0] }")], Code::ControllerFilter, "3 coefficients over 2"),
    (&[("delay = \"50 us\"", "filters = [{ numerator = [1], over = [1] }]")], Code::UnknownKey, "the unknown key over of filter 1"),
    (&[("delay = \"50 us\"", "sampling_period = \"50 us\"\ncomputing_time = \"1 ms\"")], Code::ControllerTime, "time to compute"),
    (&[("50 us", "-50 us")], Code::OutOfRange, "not below 0"),
];

#[test]
fn what_cannot_hold_the_rotor_is_told_with_its_code() {
    for (changes, code, words) in REFUSED {
        let problem = outcome(changes).unwrap_err();
        let text = format!("{}; {}", problem.found, problem.allowed);
        assert_eq!(problem.code, code, "{changes:?}: {text}");
        assert!(text.contains(words), "{changes:?}: {text}");
    }
}

#[test]
fn a_part_that_would_not_act_is_named_with_its_line() {
    let second = "[[levitation.magnet]]\nname = \"right\"";
    let part = "[[levitation.controller]]\nmagnet = \"left\"\nproportional = \"1 A/m\"\ndelay = \"50 us\"\n";
    let twice = format!("{part}{part}{second}");
    let list = ("[levitation.controller]", "[[levitation.controller]]");
    let text = SMALL.replace(list.0, list.1).replace(second, &twice);
    let line = text
        .lines()
        .rev()
        .position(|line| line == "magnet = \"left\"");
    let line = text.lines().count() - line.unwrap();
    let problem = Scenario::parse(&text, "small.toml", &[], &BuiltIn);
    let told = problem.unwrap_err().to_string();
    let at = format!(
        "small.toml:{line}: levitation.controller.left.magnet: found a second controller of \"left\""
    );
    assert!(told.contains(&at), "{told}");
}

/// On two springs of k_i K_p - k_s = 160 kN/m a rotor of 4.9 kg has a rigid motion at 255 rad/s without damping.
#[test]
fn diagrams_have_the_magnets_in_them() {
    let asked = asked(SMALL).unwrap();
    let quantities = super::super::quantities::name(&asked, Some(&asked.find().unwrap()));
    let found = values(quantities);
    let first = number(&found, "first_critical_speed");
    assert!(first > 100.0 && first < 255.0, "{first}");
    // integrators hold the sensors where they are: the weight bends the shaft about them
    let sag = number(&found, "largest_sag");
    assert!(sag > 1e-7 && sag < 1e-4, "{sag}");
    assert!(number(&found, "response.magnet_left.peak_amplitude") > 0.0);
    assert!(number(&found, "response.sensor_right.rated_amplitude") > 0.0);
    assert!(found.iter().any(|(name, _)| name == "map_forward_1"));
}

/// The drawing names what stands along the shaft, sensors where they are and not where their magnets are.
#[test]
fn a_drawing_has_every_magnet_sensor_and_unbalance_with_its_name() {
    let mut list = List::default();
    simulate::drawing::name(&mut list, &asked(SMALL).unwrap().model, &[]);
    let found = values(list.quantities);
    let of = |name: &str| {
        let found = found.iter().find(|own| own.0 == name);
        found.unwrap_or_else(|| panic!("{name}")).1.clone()
    };
    assert_eq!(of("magnet_names"), Value::Text("left\nright".to_string()));
    assert_eq!(of("magnet_positions"), Value::List(vec![0.1, 0.4]));
    assert_eq!(of("sensor_positions"), Value::List(vec![0.08, 0.42]));
    assert_eq!(of("unbalance_names"), Value::Text("1".to_string()));
    assert_eq!(of("piece_names"), Value::Text("1".to_string()));
}

#[test]
fn an_interrupted_analysis_is_left_at_once() {
    let scenario = Scenario::parse(SMALL, "small.toml", &[], &BuiltIn).unwrap();
    let asked = std::sync::Arc::new(asked(SMALL).unwrap());
    let interrupt = std::sync::atomic::AtomicBool::new(true);
    let options = outcome::options::Options::unwatched(&interrupt);
    let outcome = super::super::run(&scenario, &asked, &options);
    assert!(outcome.stop.interrupted() && outcome.quantities.is_empty());
}
