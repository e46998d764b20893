//! Rows of fatigue: factors of life, rating loads, damage of a drop.

use super::tally::{Compare, Tally};
use crate::json::{count, list, number, positive, within};
use physics::life::{
    RatedBearing, bearing_damage, iso_life_factor, passages_per_turn, reliability_factor,
    reliability_factor_iso, repetitions, ring_damage,
};
use physics::load_zone::{ball_load, displacement, joint_stiffness};
use serde_json::Value;

/// Most balls.
const MOST_BALLS: usize = 1000;
/// Points of the outer ring at which passages are summed.
const POINTS: usize = 360;

/// The comparison of a kind of row.
pub(super) fn of_kind(kind: &str) -> Option<Compare> {
    Some(match kind {
        "a_ISO radial ball bearing" => life_factor,
        "reliability factor" => reliability,
        "ball loads of the basic rating" => rating,
        "damage of one drop, rolling, zero clearance, continuous load zone, 360 points" => drop,
        _ => return None,
    })
}

fn life_factor(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let load_ratio = within(row, "load_ratio", 0.0, f64::INFINITY)?;
    let ours = iso_life_factor(positive(row, "kappa")?, load_ratio);
    tally.add("a_ISO", "", number(row, "a_ISO")?, ours)
}

fn reliability(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let survival = within(row, "survival", 1e-12, 1.0)?;
    let reference = number(row, "a1_two_parameter")?;
    tally.add(
        "a1, two parameters",
        "",
        reference,
        reliability_factor(survival),
    )?;
    let ours = reliability_factor_iso(survival);
    tally.add("a1 of ISO 281:2007", "", number(row, "a1_iso_2007")?, ours)
}

fn rating(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let ours = RatedBearing {
        rating: positive(row, "C")?,
        ball_count: count(row, "Z", MOST_BALLS)? as f64,
        gamma: within(row, "gamma", 0.0, 0.999)?,
        grooves: [
            within(row, "groove_inner", 0.5001, 10.0)?,
            within(row, "groove_outer", 0.5001, 10.0)?,
        ],
        contact_angle: 0.0,
    }
    .ball_rating_loads();
    for (key, name, ours) in [
        ("Q_ci", "rating load of a ball, inner", ours[0]),
        ("Q_ce", "rating load of a ball, outer", ours[1]),
    ] {
        tally.add(name, "N", number(row, key)?, ours)?;
    }
    Ok(())
}

fn drop(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let balls = count(row, "Z", MOST_BALLS)? as f64;
    let stiffness = joint_stiffness(positive(row, "K_i")?, positive(row, "K_o")?);
    let passages = passages_per_turn(balls, within(row, "gamma", 0.0, 0.999)?);
    let mut outer = vec![0.0; POINTS];
    let mut inner = 0.0;
    for phase in list(row, "phases")? {
        let (load, turns) = (positive(phase, "load")?, positive(phase, "turns")?);
        let direction = within(phase, "direction_deg", -1e6, 1e6)?;
        let cosines: Vec<f64> = (0..POINTS)
            .map(|point| (point as f64 - direction).to_radians().cos())
            .collect();
        let weight = balls / POINTS as f64;
        let moved = displacement(load, stiffness, 0.0, &cosines, weight);
        let reference = number(phase, "displacement")?;
        tally.add("drop: displacement", "m", reference, moved)?;
        let largest = ball_load(stiffness, moved, 0.0, 1.0);
        let reference = number(phase, "largest")?;
        tally.add("drop: largest ball load", "N", reference, largest)?;
        let mut mean = 0.0;
        for (sum, cosine) in outer.iter_mut().zip(&cosines) {
            let cube = ball_load(stiffness, moved, 0.0, *cosine).powi(3);
            *sum += turns * passages[1] * cube;
            mean += cube / POINTS as f64;
        }
        inner += turns * passages[0] * mean;
    }
    let inner = ring_damage(&[inner], passages[0], positive(row, "Q_ci")?);
    let outer = ring_damage(&outer, passages[1], positive(row, "Q_ce")?);
    let both = bearing_damage(inner, outer);
    for (key, name, ours) in [
        ("inner_damage", "drop: damage of the inner ring", inner),
        ("outer_damage", "drop: damage of the outer ring", outer),
        ("bearing_damage", "drop: damage of the bearing", both),
        (
            "drops_at_90_percent",
            "drops, 90 % survive",
            repetitions(both, 0.9),
        ),
        (
            "drops_at_50_percent",
            "drops, 50 % survive",
            repetitions(both, 0.5),
        ),
        (
            "drops_at_99_percent",
            "drops, 99 % survive",
            repetitions(both, 0.99),
        ),
    ] {
        tally.add(name, "", number(row, key)?, ours)?;
    }
    Ok(())
}
