//! The sliding friction of a dropped rotor: the drop is simulated, its race read by marks, the file identified.

use auxbear::outcome::Value;
use auxbear::report::directory;
use auxbear::run::{Options, Outcome, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// The true coefficient.
const FRICTION: f64 = 0.15;
const ROTOR_SPEED: f64 = 145.0;
/// Marks on the race's sleeve.
const MARKS: usize = 360;
/// Standard deviation of a stamp, s.
const STAMP: f64 = 1e-6;

/// A rotor of 60 N that falls by a twentieth of a millimetre onto a race with a heavy sleeve: it bounces for some hundredths of a
/// second and brings the race up within half a second.
const DROP: &str = r#"
format = "auxbear.scenario/1"
system = "drop"

[rotor]
mass = "6.118 kg"
polar_inertia = "1 kg m^2"
speed = "145 rad/s"

[levitation]
stiffness = "1e6 N/m"
damping = "1e3 N s/m"

[contact]
radial_air_clearance = "0.05 mm"
bore_diameter = "25 mm"
stiffness = "5e8 N/m^(10/9)"
exponent = "10/9"
damping = "0.5 s/m"
friction_coefficient = 0.15
friction_reference_speed = "0.02 m/s"

[mount]
stiffness = "2e7 N/m"
damping = "5000 N s/m"
moving_mass = "150 g"

[bearing]
name = "6005"
fidelity = "rolling"
operating_diametral_clearance = "-4 um"
inner_race_mass = "100 g"
inner_race_inertia = "3.5e-4 kg m^2"

[bearing.moment]
law = "palmgren"
lubrication = "grease"
f0 = 2
viscosity = "100 mm^2/s"

[run]
duration = "0.45 s"
output_interval = "0.5 ms"
"#;

fn simulated(scenario: &Scenario) -> Outcome {
    let interrupt = AtomicBool::new(false);
    let outcome = run(scenario, &Options::unwatched(&interrupt)).expect("it builds");
    assert!(outcome.stop.complete(), "{:?}", outcome.stop);
    outcome
}

fn value<'a>(outcome: &'a Outcome, name: &str) -> &'a Value {
    let quantity = outcome.quantity(name);
    &quantity.unwrap_or_else(|| panic!("no {name}")).value
}

fn list(outcome: &Outcome, name: &str) -> Vec<f64> {
    match value(outcome, name) {
        Value::List(list) => list.clone(),
        other => panic!("{name}: {other:?}"),
    }
}

/// What a counter of marks writes of the race: instants with errors of its clock.
fn stamped(drop: &Outcome) -> String {
    let column = |name: &str| {
        let column = drop.history.iter().find(|column| column.name == name);
        &column.unwrap_or_else(|| panic!("no {name}")).values
    };
    let (time, speed) = (column("time"), column("bearing.inner_race.speed"));
    let mark = TAU / MARKS as f64;
    let (mut angle, mut next, mut text) = (0.0, mark, "mark,tacho [s]\n".to_string());
    // errors of a fixed rule: uniform with the deviation of a stamp
    let mut seed = 7_u64;
    for row in 1..time.len() {
        let length = time[row] - time[row - 1];
        let (from, slope) = (speed[row - 1], (speed[row] - speed[row - 1]) / length);
        let turned = from * length + 0.5 * slope * length * length;
        while angle + turned >= next {
            // from τ + ½ slope τ² = what is left to the mark
            let left = next - angle;
            let root = (from * from + 2.0 * slope * left).max(0.0).sqrt();
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let error = ((seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * 12_f64.sqrt() * STAMP;
            let at = time[row - 1] + 2.0 * left / (from + root) + error;
            writeln!(text, "{},{at:.9}", (next / mark).round()).expect("a text");
            next += mark;
        }
        angle += turned;
    }
    text
}

fn written(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("a folder to write to");
}

fn identified(folder: &Path, more: &str) -> Outcome {
    let text = format!(
        "format = \"auxbear.scenario/1\"\nsystem = \"identify\"\n[identify]\n\
         coast_down = [\"coast_down/signals.toml\"]\nviscosity = \"100 mm^2/s\"\nexplanations.compare = false\n\
         [identify.rotor_friction]\nfile = \"drop.toml\"\nrotor_speed = \"{ROTOR_SPEED} rad/s\"\nradial_load = \"60 N\"\n\
         load_deviation = 0.02\nbore_diameter = \"25 mm\"\nradial_air_clearance = \"0.05 mm\"\ninertia = \"3.5e-4 kg m^2\"\n{more}\n\
         [bearing]\nname = \"6005\"\n"
    );
    written(folder, "identify.toml", &text);
    simulated(&Scenario::read(&folder.join("identify.toml"), &[], &BuiltIn).expect("it is right"))
}

#[test]
fn the_friction_of_a_dropped_rotor_lies_in_its_band() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/rig_coast_down.toml");
    let coast_down = Scenario::read(&shipped, &[], &BuiltIn).expect("it is shipped");
    let outcome = simulated(&coast_down);
    directory::write(&folder.join("coast_down"), &coast_down, &outcome).expect("it is written");
    let drop = simulated(&Scenario::parse(DROP, "drop.toml", &[], &BuiltIn).expect("it is right"));
    written(folder, "drop.csv", &stamped(&drop));
    written(
        folder,
        "drop.toml",
        &format!(
            "format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n[signals]\nfile = \"drop.csv\"\n\
             [signals.speed]\nchannel = \"tacho\"\nkind = \"edges\"\nstamp_deviation = \"1 us\"\n\
             marks_per_revolution = {MARKS}\nquick_change = \"none\"\n"
        ),
    );
    // once it bounces no more, and before rotor and race turn alike
    let found = identified(folder, "from = \"0.1 s\"\nto = \"0.3 s\"");
    let slips = list(&found, "rotor_friction_slips");
    let coefficients = list(&found, "rotor_friction_coefficients");
    let deviations = list(&found, "rotor_friction_deviations");
    assert!(slips.len() >= 5, "{slips:?}");
    let mut mean = 0.0;
    for ((slip, coefficient), deviation) in slips.iter().zip(&coefficients).zip(&deviations) {
        println!("{slip:.3} m/s: {coefficient:.4} ± {deviation:.4}");
        // load, inertia, M: a band of some per cent, or it says nothing
        assert!(*deviation < 0.05 * FRICTION, "{deviation}");
        assert!(
            (coefficient - FRICTION).abs() < 2.0 * deviation,
            "{slip} m/s: {coefficient} ± {deviation}"
        );
        mean += coefficient / coefficients.len() as f64;
    }
    // the rotor still swings in the bore, which makes its mean force 60.7 N, 1.2 % more than its weight; the rest is M. Without M it
    // would be 13 % less
    assert!((mean / FRICTION - 1.0).abs() < 0.03, "{mean}");
    let notes: Vec<&str> = found.warnings.iter().map(|w| w.text.as_str()).collect();
    let taken = |part: &str| notes.iter().any(|note| note.contains(part));
    assert!(taken("it is taken as 0, μ is then too small"), "{notes:?}");
    assert!(!taken("the rotor presses with"), "{notes:?}");

    // a window that the record does not have
    let late = identified(folder, "from = \"2 s\"");
    match value(&late, "rotor_friction_slips") {
        Value::None { why } => assert!(why.contains("the rotor lies on it from 2"), "{why}"),
        other => panic!("{other:?}"),
    }
}
