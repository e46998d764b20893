//! Thermal reference speeds: where friction makes as much heat as a bearing may give to its surroundings.

use super::tally::Tally;
use crate::json::{list, positive};
use physics::heat_exchange::to_surroundings;
use physics::palmgren::{load_moment, printed_viscous_moment};
use serde_json::Value;
use std::f64::consts::PI;

/// Conditions of ISO 15312: bearing above its surroundings, K; viscosity of the oil, m²/s; share of C0 that loads it.
const RISE: f64 = 50.0;
const VISCOSITY: f64 = 12e-6;
const LOAD_SHARE: f64 = 0.05;

/// Compares a file.
pub(super) fn compare(file: &Value, tally: &mut Tally) -> Result<(), String> {
    for row in list(file, "rows")? {
        let name = row["bearing"].as_str().unwrap_or("a bearing without name");
        tally.row(name, row, |tally| {
            let printed = positive(row, "reference_speed_rpm")?;
            let ours = reference_speed(row)?;
            tally.add("thermal reference speed", "1/min", printed, ours)
        })?;
    }
    Ok(())
}

/// Speed at which Palmgren's moment makes the heat that leaves, 1/min.
fn reference_speed(row: &Value) -> Result<f64, String> {
    let size = |key: &str| positive(row, key).map(|mm| 1e-3 * mm);
    let (bore, outside, width) = (size("bore_mm")?, size("outside_mm")?, size("width_mm")?);
    if outside <= bore {
        return Err("outside_mm is not above bore_mm".to_string());
    }
    let pitch_diameter = 0.5 * (bore + outside);
    let heat = to_surroundings(bore, outside, width) * RISE;
    let load = LOAD_SHARE * 1e3 * positive(row, "C0_kN")?;
    let by_load = load_moment(positive(row, "f1")?, load, pitch_diameter);
    let viscous_factor = positive(row, "f0")?;
    let made = |speed: f64| {
        let viscous = printed_viscous_moment(viscous_factor, VISCOSITY, speed, pitch_diameter);
        (viscous + by_load) * speed
    };
    let (mut low, mut high) = (0.0, 1e7);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if made(middle) < heat {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(low * 30.0 / PI)
}
