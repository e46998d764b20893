//! Rows of severity: ball loads, indentation, wear.

use super::tally::{Compare, Tally};
use crate::json::{count, exactly, number, positive, within};
use physics::load_zone::{ball_load, cosines, displacement};
use physics::severity::{permanent_indentation, wear_volume, wear_volume_by_energy};
use serde_json::Value;

/// Most balls.
const MOST_BALLS: usize = 1000;

/// The comparison of a kind of row.
pub(super) fn of_kind(kind: &str) -> Option<Compare> {
    Some(match kind {
        "ball loads, quasi-static, ball 0 on the load line" => ball_loads,
        "permanent indentation over D (Palmgren)" => indentation,
        "Archard" => wear,
        _ => return None,
    })
}

fn ball_loads(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let balls = count(row, "Z", MOST_BALLS)?;
    let (load, stiffness) = (positive(row, "load")?, positive(row, "K_io")?);
    let clearance = number(row, "diametral_clearance")?;
    let cosines = cosines(balls);
    let moved = displacement(load, stiffness, clearance, &cosines, 1.0);
    let reference = number(row, "displacement")?;
    tally.add("ball loads: displacement", "m", reference, moved)?;
    let ours = cosines
        .iter()
        .map(|cosine| ball_load(stiffness, moved, clearance, *cosine));
    let ours: Vec<f64> = ours.collect();
    for (reference, ours) in exactly(row, "loads", balls)?.iter().zip(&ours) {
        tally.add("ball loads: each", "N", *reference, *ours)?;
    }
    let largest = ours.iter().copied().fold(0.0, f64::max);
    tally.add("ball loads: largest", "N", number(row, "largest")?, largest)?;
    let factor = largest * balls as f64 / load;
    let reference = number(row, "stribeck")?;
    tally.add("ball loads: largest Z over load", "", reference, factor)
}

fn indentation(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let inner = row["inner"].as_bool().ok_or("inner is not true or false")?;
    let ours = permanent_indentation(
        number(row, "load")?,
        positive(row, "D")?,
        positive(row, "groove")?,
        within(row, "gamma", 0.0, 0.999)?,
        inner,
    );
    tally.add("indentation over D", "", number(row, "ratio")?, ours)
}

fn wear(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let (force, distance) = (number(row, "normal_force")?, number(row, "distance")?);
    let (coefficient, area) = (number(row, "wear_coefficient")?, positive(row, "area")?);
    let volume = wear_volume(coefficient, force, distance);
    let reference = number(row, "volume")?;
    tally.add("wear: volume", "m³", reference, volume)?;
    tally.add("wear: depth", "m", number(row, "depth")?, volume / area)?;
    let (friction, energy) = (positive(row, "friction")?, number(row, "friction_energy")?);
    let work = friction * force * distance;
    tally.add("wear: friction energy", "J", energy, work)?;
    let by_energy = wear_volume_by_energy(coefficient, friction, energy);
    tally.add("wear: volume by energy", "m³", reference, by_energy)
}
