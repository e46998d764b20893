//! Half a second of a drop (`drop_*.json`): mean and spread of an ensemble.
//!
//! Accepted is |x - mean| ≤ 5 sd + 1e-4 |mean|, for the two displacements also 3e-4 |mean|, since the reference takes
//! them on a grid of 50 µs. `null` in the reference means that the event must not happen.

use super::compare::{never, part};
use super::report::{Row, Tolerance};
use super::simulator::{DropAnswer, DropReference, Simulator};
use serde_json::Value;

/// Key of the files, our name, unit.
const QUANTITIES: [(&str, &str, &str); 14] = [
    ("peak1", "first_impact_force", "N"),
    ("peak_all", "peak_contact_force", "N"),
    ("n_contacts", "contact_count", ""),
    ("t_inner_50%", "inner_race_time_to_50_percent", "s"),
    ("t_inner_95%", "inner_race_time_to_95_percent", "s"),
    ("t_cage_95%roll", "cage_time_to_95_percent_of_rolling", "s"),
    ("fric", "rotor_race_friction_energy", "J"),
    ("slip", "ball_slip_energy", "J"),
    ("dissipated", "dissipated_energy", "J"),
    ("wi_end", "inner_race_final_speed", "rad/s"),
    ("wc_end", "cage_final_speed", "rad/s"),
    ("rotor_end", "rotor_final_speed", "rad/s"),
    ("maxrel", "max_rotor_race_displacement", "m"),
    ("maxouter", "max_mount_displacement", "m"),
];

/// Rows of a file.
pub(super) fn rows(value: &Value, simulator: &dyn Simulator) -> Result<Vec<Row>, String> {
    let reference: DropReference = part(value)?;
    if reference.y0.len() < reference.params.states()? {
        return Err("y0 is shorter than the state".into());
    }
    if reference.t_on_sd.len() != reference.t_on_mean.len() {
        return Err("t_on_mean and t_on_sd differ in length".into());
    }
    Ok(match simulator.drop(&reference) {
        Err(why) => vec![Row::not_run(why)],
        Ok(answer) => compare(&reference, &answer),
    })
}

fn compare(reference: &DropReference, answer: &DropAnswer) -> Vec<Row> {
    let mut rows = Vec::new();
    for (key, quantity, unit) in QUANTITIES {
        let Some(&mean) = reference.mean.get(key) else {
            continue;
        };
        let sd = reference.sd.get(key).copied().flatten().unwrap_or(0.0);
        let share = if key.starts_with("max") { 3e-4 } else { 1e-4 };
        let ours = answer.values.get(key).copied().flatten();
        rows.push(match (mean, ours) {
            (Some(mean), Some(ours)) => accept(quantity, unit, mean, sd, share, ours),
            (mean, ours) => never(quantity, unit, mean, ours),
        });
    }
    let times = reference.t_on_mean.iter().zip(&reference.t_on_sd);
    for (index, (&mean, &sd)) in times.enumerate() {
        let quantity = format!("contact_start_times[{index:02}]");
        rows.push(match answer.contact_start_times.get(index) {
            Some(&ours) => accept(&quantity, "s", mean, sd, 1e-4, ours),
            None => never(quantity, "s", Some(mean), None),
        });
    }
    rows
}

fn accept(quantity: &str, unit: &str, mean: f64, sd: f64, share: f64, ours: f64) -> Row {
    let tolerance = Tolerance::Absolute(5.0 * sd + share * mean.abs());
    let why = format!("5 standard deviations of the reference ensemble and {share:e} of its mean");
    Row::compared(quantity, unit, mean, ours, tolerance, why)
}
