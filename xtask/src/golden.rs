//! Golden values: what some shipped scenarios gave last time, in `xtask/golden.json`. Compared with 1e-9, the work exactly; a
//! change that is meant is written by `cargo xtask golden`, and its difference is reviewed.
//!
//! Only what is reproducible is kept: first impacts, times of the spin-up, energies of smooth runs. The program compared with
//! itself is a regression test, no validation.

use crate::repository::Repository;
use crate::shipped;
use serde_json::{Map, Value, json};
use std::path::Path;

/// Where the values stand.
pub const FILE: &str = "xtask/golden.json";

/// Largest relative difference: the last digits that another compiler may round in another way.
const TOLERANCE: f64 = 1e-9;

/// Quantities of a drop that tiny changes of the start do not change much.
const DROP: &[&str] = &[
    "time_to_first_contact",
    "first_impact_force",
    "inner_race_time_to_50_percent",
    "inner_race_time_to_95_percent",
];
/// Quantities of a spin-up.
const SPIN_UP: &[&str] = &[
    "inner_race_time_to_95_percent",
    "inner_race_mean_moment",
    "outer_race_mean_moment",
    "dissipated_energy",
];

/// The scenarios, and what is compared of each.
const SCENARIOS: [(&str, &[&str]); 17] = [
    ("reference_drop", DROP),
    ("oil_lubricated_drop", DROP),
    ("full_complement_drop", DROP),
    ("spin_up_6005", SPIN_UP),
    ("spin_up_rolling", SPIN_UP),
    (
        "rig_test_2",
        &["peak_acceleration", "clutch_heat", "dissipated_energy"],
    ),
    (
        "spin_up_warming",
        &[
            "heat_made",
            "peak_lubricant_temperature",
            "smallest_clearance",
        ],
    ),
    (
        "rig_test_3_warming",
        &[
            "heat_made",
            "peak_lubricant_temperature",
            "work_of_warm_rings",
        ],
    ),
    (
        "coast_down_closing",
        &[
            "stop_time",
            "closing_time",
            "peak_growth_rate",
            "life_share",
        ],
    ),
    (
        "machine_run_up",
        &[
            "thrust_end.time_to_first_contact",
            "thrust_end.first_impact_force",
        ],
    ),
    (
        "machine_compressor",
        &[
            "drive_end.time_to_first_contact",
            "drive_end.first_impact_force",
        ],
    ),
    (
        "rotor_levitated",
        &[
            "critical_1.speed",
            "critical_5.damping_ratio",
            "mode_6.frequency",
            "largest_sag",
        ],
    ),
    (
        "rotor_overhung",
        &[
            "critical_7.speed",
            "mode_6.damping_ratio",
            "response.wheel.peak_amplitude",
        ],
    ),
    (
        "signals_spin_up",
        &["peak_acceleration", "peak_torque", "median_cage_slip"],
    ),
    (
        "identify_with_ramp",
        &["test_1.dissipated_energy", "test_2.peak_acceleration"],
    ),
    (
        "study_reference_drop",
        &["first_impact_force", "time_to_first_contact"],
    ),
    (
        "study_selection",
        &["first_impact_force", "time_to_first_contact"],
    ),
];

/// Counts of work that must be the same.
const WORK: [&str; 3] = ["steps", "rejected", "rate_calls"];

/// What a summary holds of a scenario's golden values; none where the scenario has none.
fn kept(scenario: &str, summary: &Value) -> Option<Value> {
    let (_, names) = SCENARIOS.iter().find(|(name, _)| *name == scenario)?;
    let quantities: Map<String, Value> = names
        .iter()
        .map(|name| {
            (
                name.to_string(),
                summary["quantities"][name]["value"].clone(),
            )
        })
        .filter(|(_, value)| !value.is_null())
        .collect();
    let work: Map<String, Value> = WORK
        .iter()
        .map(|count| (count.to_string(), summary["work"][count].clone()))
        .filter(|(_, value)| !value.is_null())
        .collect();
    Some(json!({ "quantities": quantities, "work": work }))
}

/// Differences of a scenario's run from its golden values.
pub fn differences(repository: &Repository, scenario: &str, summary: &Value) -> Vec<String> {
    let Some(found) = kept(scenario, summary) else {
        return Vec::new();
    };
    let golden = repository.text(FILE).unwrap_or_default();
    let Ok(golden) = serde_json::from_str::<Value>(&golden) else {
        return vec![format!("{FILE} is no JSON: cargo xtask golden writes it")];
    };
    compare(&golden[scenario], &found)
}

fn compare(golden: &Value, found: &Value) -> Vec<String> {
    let mut differences = Vec::new();
    for (group, tolerance) in [("quantities", TOLERANCE), ("work", 0.0)] {
        let (was, is) = (golden[group].as_object(), found[group].as_object());
        let (Some(was), Some(is)) = (was, is) else {
            return vec![format!(
                "no golden values in {FILE}: cargo xtask golden writes them"
            )];
        };
        let names = was
            .keys()
            .chain(is.keys().filter(|name| !was.contains_key(*name)));
        for name in names {
            let number = |map: &Map<String, Value>| map.get(name).and_then(Value::as_f64);
            let same = match (number(was), number(is)) {
                (Some(was), Some(is)) => (was - is).abs() <= tolerance * was.abs(),
                _ => false,
            };
            if !same {
                let text = |map: &Map<String, Value>| {
                    map.get(name).map_or("nothing".to_owned(), Value::to_string)
                };
                differences.push(format!(
                    "{name} was {} and is {}; where that is meant, cargo xtask golden writes it",
                    text(was),
                    text(is)
                ));
            }
        }
    }
    differences
}

/// Golden values of runs in a folder, as the file has them.
pub fn of_runs(runs: &Path) -> Result<String, String> {
    let mut golden = Map::new();
    for (name, names) in SCENARIOS {
        let summary = shipped::summary_in(&runs.join(name))?;
        let kept = kept(name, &summary).unwrap_or_default();
        if kept["quantities"].as_object().is_none_or(Map::is_empty) {
            return Err(format!("{name} has none of {}", names.join(", ")));
        }
        golden.insert(name.to_owned(), kept);
    }
    let text = serde_json::to_string_pretty(&golden).map_err(|error| error.to_string())?;
    Ok(text + "\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_value_and_a_changed_count_are_found() {
        let golden = json!({ "quantities": { "a": 1.0 }, "work": { "steps": 10 } });
        assert!(compare(&golden, &golden).is_empty());
        let other = json!({ "quantities": { "a": 1.0 + 1e-8 }, "work": { "steps": 11 } });
        assert_eq!(compare(&golden, &other).len(), 2);
        let missing = json!({ "quantities": {}, "work": { "steps": 10 } });
        assert_eq!(compare(&golden, &missing).len(), 1);
        assert_eq!(compare(&Value::Null, &golden).len(), 1);
    }
}
