//! Balls at a contact angle: both fidelities are one bearing, and its energy by the outer race closes.

use super::files::read_from;
use crate::outcomes::number;
use auxbear::run::{Options, Outcome, run};
use auxbear::scenario::BuiltIn;
use std::sync::atomic::AtomicBool;

/// A race that gains speed evenly, its balls gripped well, the pockets smooth, tight and damped so that the cage does not rattle.
const RAMP: &str = r#"
format = "auxbear.scenario/1"
system = "spin_up"

[drive]
kind = "speed"
final_speed = "200 rad/s"
acceleration = "4000 rad/s^2"
radial_load = "0 N"

[bearing]
ball_count = 12
ball_diameter = "7.938 mm"
pitch_diameter = "39 mm"
inner_race_mass = "20 g"
inner_race_inertia = "4e-6 kg m^2"
inner_race_centre_held = true
cage_mass = "1 g"

[bearing.cage]
pocket_friction_coefficient = 0
pocket_gap = "1 um"
pocket_damping = "1000 s/m"

[bearing.traction]
reference_speed = "0.02 m/s"

[run]
duration = "50 ms"
tolerance = 1e-5
"#;

fn ramp(sets: &[String]) -> Outcome {
    let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
    let scenario = read_from(&BuiltIn, "ramp.toml", RAMP, &sets).expect("it is right");
    let interrupt = AtomicBool::new(false);
    let outcome = run(&scenario, &Options::unwatched(&interrupt)).expect("it builds");
    assert!(outcome.stop.complete(), "{:?}", outcome.stop);
    outcome
}

fn at_angle(degrees: f64) -> Vec<String> {
    match degrees {
        0.0 => vec![
            "bearing.type=deep groove".to_string(),
            "bearing.operating_diametral_clearance=-6 um".to_string(),
        ],
        _ => vec![
            "bearing.type=angular contact".to_string(),
            format!("bearing.contact_angle={degrees} deg"),
            "bearing.axial_preload=200 N".to_string(),
        ],
    }
}

/// J_I and J_O of a bearing that rolls all the way: ∫t_O Ω dt = -½ J_O Ω0², ∫Ω dL = ½ (J_I + J_O) Ω0².
fn inertias(outcome: &Outcome) -> [f64; 2] {
    let last = |name: &str| {
        let column = outcome.history.iter().find(|column| column.name == name);
        *column.unwrap().values.last().unwrap()
    };
    let square = 0.5 * last("bearing.inner_race.speed").powi(2);
    let outer = -last("energy.outer_race.moment_work") / square;
    [last("energy.outer_race.path_term") / square - outer, outer]
}

#[test]
fn both_fidelities_have_the_same_inertias_at_every_angle() {
    for degrees in [0.0, 15.0, 25.0, 40.0] {
        let [planar, rolling] = ["planar", "rolling"].map(|fidelity| {
            let mut sets = at_angle(degrees);
            sets.push(format!("bearing.fidelity={fidelity}"));
            inertias(&ramp(&sets))
        });
        for (planar, rolling) in planar.into_iter().zip(rolling) {
            // the approach of the contacts is 1e-4 of the radii
            assert!(
                (planar / rolling - 1.0).abs() < 1e-3,
                "{degrees}°: {planar} {rolling}"
            );
        }
        // by hand: 12 steel balls, s = r cos α/R, and the ring of the cage
        let cosine = f64::to_radians(degrees).cos();
        let balls = 12.0 * 7850.0 * std::f64::consts::PI / 6.0 * 7.938e-3_f64.powi(3);
        let (contact, pitch) = (0.5 * 7.938e-3 * cosine, 19.5e-3);
        let track = pitch - contact;
        let s = contact / track;
        let inner = (0.35 * balls + 0.25 * 1e-3) * track * track;
        let outer = (0.15 * balls + 0.25 * 1e-3) * track * track * (1.0 + 2.0 * s);
        for (ours, wanted) in rolling.into_iter().zip([inner, outer]) {
            assert!(
                (ours / wanted - 1.0).abs() < 1e-4,
                "{degrees}°: {ours} {wanted}"
            );
        }
    }
}

#[test]
fn the_corrected_energy_is_what_balls_that_roll_dissipate_at_every_angle() {
    for degrees in [0.0, 15.0, 25.0, 40.0] {
        // a cage far from a ring at the pitch circle turns with its own inertia
        for cage in ["3.8e-7 kg m^2", "9e-7 kg m^2"] {
            let mut sets = at_angle(degrees);
            sets.push(format!("bearing.cage_inertia={cage}"));
            let outcome = ramp(&sets);
            let lost = number(&outcome, "bearing_dissipated_energy");
            let corrected = number(&outcome, "outer_race_energy_corrected");
            let path = number(&outcome, "path_term");
            let (least, largest) = (
                number(&outcome, "path_term_if_rolling"),
                number(&outcome, "path_term_largest"),
            );
            // the approach of the contacts is 1e-4 of the radii
            assert!(
                (corrected - lost).abs() < 3e-4 * path,
                "{degrees}° {cage}: {corrected} {lost} {path}"
            );
            assert!(
                path > (1.0 - 1e-3) * least && path < largest,
                "{degrees}° {cage}: {path} {least} {largest}"
            );
        }
    }
}
