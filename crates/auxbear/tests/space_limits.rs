//! What limits of a rotor that moves along its axis hold, and what they leave open.

use crate::machine::ran;
use crate::outcomes::number;
use auxbear::outcome::{Outcome, Verdict};

const FLYWHEEL: &str = include_str!("../../../scenarios/vertical_flywheel.toml");
const EXPANDER: &str = include_str!("../../../scenarios/machine_expander_pairs.toml");

fn warned(run: &Outcome, code: &str) -> bool {
    run.warnings.iter().any(|own| own.code == code)
}

fn verdicts(run: &Outcome) -> Vec<Verdict> {
    run.limits.iter().map(|own| own.verdict).collect()
}

fn limit(name: &str, bound: &str) -> String {
    format!("\n[[limit]]\nquantity = \"{name}\"\n{bound}\n")
}

/// A thrust that the axial magnet cannot carry presses the shoulder on its face before the power is lost and after it is back: that is contact.
#[test]
fn a_shoulder_that_rubs_under_its_magnet_is_in_contact() {
    let steady = EXPANDER
        .replace("[\"20 ms\", \"21 ms\", \"120 ms\"]", "[\"1 ms\", \"2 ms\"]")
        .replace("[\"0 N\", \"1.5 kN\", \"0.3 kN\"]", "[\"0 N\", \"1.5 kN\"]");
    let again = "[[event]]\nname = \"again\"\ndo = \"re-levitate\"\nafter = \"all_lost\"\ndelay = \"40 ms\"\n\
        bias_time = \"5 ms\"\nreference_time = \"10 ms\"\nhold = \"20 ms\"\n";
    let held = limit("relevitation_held", "least = 1");
    let sets = ["rotor.speed=6000 rpm", "run.duration=160 ms"];
    let text = format!("{steady}\n{again}{held}");
    let pressed = ran(&text, &sets);
    assert_eq!(number(&pressed, "relevitation_held"), 0.0);
    assert_eq!(verdicts(&pressed), [Verdict::Fail]);
    assert!(warned(&pressed, "AB2082") && warned(&pressed, "AB2035"));
    assert!(number(&pressed, "relevitation_last_contact") > 0.159);
    // a magnet that is stiff enough holds it
    let stiff = [
        &sets[..],
        &["levitation.axial_stiffness=2e7 N/m"],
        &["levitation.axial_damping=2e4 N s/m"],
    ]
    .concat();
    let carried = ran(&text, &stiff);
    assert_eq!(number(&carried, "relevitation_held"), 1.0);
    // one that holds it within a hair of the face does not
    let soft = [
        &sets[..],
        &["levitation.axial_stiffness=8e6 N/m"],
        &["levitation.axial_damping=4e4 N s/m"],
    ]
    .concat();
    let near = ran(&text, &soft);
    assert_eq!(number(&near, "relevitation_held"), 0.0);
    assert!(warned(&near, "AB2082") && !warned(&near, "AB2035"));
    assert!(!warned(&carried, "AB2035"));
}

/// How far rotor and outer ring move along the axis is known, and judged where something stands there.
#[test]
fn the_way_along_the_axis_is_a_result() {
    let text = [
        FLYWHEEL,
        &limit("max_rotor_axial_displacement", "most = \"0.4 mm\""),
        "\n[[limit]]\nwarning = \"AB2425\"\n",
    ]
    .concat();
    let short = "run.duration=15 ms";
    let stiff = ran(&text, &[short]);
    let way = number(&stiff, "max_rotor_axial_displacement");
    // the gap, and what balls and mount give way
    assert!((0.2e-3..0.4e-3).contains(&way), "{way}");
    assert!(!warned(&stiff, "AB2425"));
    let soft = "auxiliary_bearing.lower.mount.axial_stiffness=1e5 N/m";
    let soft = ran(&text, &[soft, "run.duration=40 ms"]);
    assert!(warned(&soft, "AB2425"));
    // the weight alone presses the mount down by 6 mm
    assert!(warned(&soft, "AB1094") && !warned(&stiff, "AB1094"));
    assert_eq!(verdicts(&soft), [Verdict::Fail; 2]);
    let ring = number(&soft, "lower.max_mount_axial_displacement");
    let way = number(&soft, "max_rotor_axial_displacement");
    assert!(
        ring > 1e-3 && (way - ring - 0.2e-3).abs() < 0.1e-3,
        "{way} {ring}"
    );
    let across = number(&soft, "lower.max_mount_displacement");
    assert!(across < 0.1 * ring, "{across}");
    // nobody knows what stands there
    let unknown = text.replacen("axial_clearance = ", "# axial_clearance = ", 1);
    let unknown = ran(&unknown, &[short]);
    assert_eq!(verdicts(&unknown)[1], Verdict::Undecided);
}

/// The whirl of an upright rotor grows for seconds: what holds a limit until then holds it for that long, in each member of a repeated run.
#[test]
fn what_still_grows_holds_no_limit() {
    let text = [
        FLYWHEEL,
        &limit("lower.peak_contact_force", "most = \"1 kN\""),
        &limit("max_rotor_axial_displacement", "most = \"1 mm\""),
        &limit("lower.max_rotor_displacement", "most = \"1 mm\""),
        &limit("lower.hertz_pressure_share_of_limit", "most = 0.99"),
        &limit("lower.ball_load_safety", "least = 1"),
        &limit("lower.rotor_race_friction_energy", "most = \"1 kJ\""),
        "\n[[limit]]\nwarning = \"AB1002\"\n",
        &limit("lower.peak_contact_force", "most = \"1 N\""),
        &limit("lower.time_to_first_axial_contact", "most = \"50 ms\""),
    ]
    .concat();
    let decided = [Verdict::Fail, Verdict::Pass];
    let expected = [[Verdict::Undecided; 7].as_slice(), &decided].concat();
    for sets in [
        &["run.duration=110 ms"][..],
        &["run.duration=110 ms", "repeat.count=2"],
    ] {
        let run = ran(&text, sets);
        assert!(warned(&run, "AB2423"));
        assert_eq!(verdicts(&run), expected, "{sets:?}");
    }
}

/// On its face an upright rotor moves across for a while before it comes to the bore: until then nothing is known of force and whirl there.
#[test]
fn a_bore_that_the_rotor_has_yet_to_come_to_holds_no_limit() {
    let text = [
        FLYWHEEL,
        &limit("lower.peak_contact_force", "most = \"300 N\""),
        &limit("lower.whirl_turns", "most = 5"),
        "\n[[limit]]\nwarning = \"AB1014\"\n",
    ]
    .concat();
    for sets in [
        &["run.duration=60 ms"][..],
        &["run.duration=60 ms", "repeat.count=8"],
    ] {
        let run = ran(&text, sets);
        let mut told = run.warnings.iter().filter(|own| own.code == "AB2424");
        assert!(
            told.any(|own| own.part == "lower" && own.text.contains("the bore of this bearing"))
        );
        assert_eq!(verdicts(&run), [Verdict::Undecided; 3], "{sets:?}");
    }
}

/// What the file asks for after the end of the run, a loss of power or a larger thrust, is not in what holds until then.
#[test]
fn what_comes_after_the_end_leaves_limits_open() {
    let text = [
        EXPANDER,
        &limit("compressor_end.peak_contact_force", "most = \"50 kN\""),
        "\n[[limit]]\nwarning = \"AB2425\"\n",
    ]
    .concat();
    let early = ran(&text, &["run.duration=17 ms"]);
    assert!(warned(&early, "AB2083"));
    assert_eq!(verdicts(&early), [Verdict::Undecided; 2]);
    let thrust = |forces: &str| {
        let (times, given) = (
            "[\"20 ms\", \"21 ms\", \"120 ms\"]",
            "[\"0 N\", \"1.5 kN\", \"0.3 kN\"]",
        );
        assert!(text.contains(given));
        let text = text
            .replace(given, forces)
            .replace(times, "[\"2 ms\", \"3 ms\", \"200 ms\"]");
        ran(&text, &["run.duration=75 ms"])
    };
    assert!(!warned(
        &thrust("[\"0 N\", \"1.5 kN\", \"0.3 kN\"]"),
        "AB2085"
    ));
    let rising = thrust("[\"0 N\", \"0.5 kN\", \"30 kN\"]");
    assert!(warned(&rising, "AB2085"));
    assert_eq!(verdicts(&rising)[0], Verdict::Undecided);
}
