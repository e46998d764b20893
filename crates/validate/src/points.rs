//! Whole states with their derivative (`derivative_points*.json`).
//!
//! State of the files, n = 18 + 5N: rotor x y vx vy φ ω (mass centre), inner race likewise, outer race x y vx vy,
//! cage φ ω, then per ball ρ ρ̇ θ θ̇ σ; 12 energy accounts follow. The files accept
//! |dy - ref| ≤ 1e-9 max(|ref|, 1e-3 max |dy| of the same variable class): the deviation of a row is that quotient.

use super::compare::{Worst, part};
use super::report::{Row, Tolerance};
use super::simulator::{DerivativeAnswer, DerivativePoint, Simulator};
use serde::Deserialize;
use serde_json::Value;

const SHARE: f64 = 1e-9;

#[derive(Deserialize)]
struct File {
    points: Vec<Value>,
    per_ball_cols: Vec<String>,
    #[serde(default)]
    global_cols: Vec<String>,
    quadratures: Vec<String>,
}

/// Rows of a file: per quantity the worst of all points.
pub(super) fn rows(value: &Value, simulator: &dyn Simulator) -> Result<Vec<Row>, String> {
    let file: File = part(value)?;
    let mut worst = Worst::default();
    for (index, given) in file.points.iter().enumerate() {
        let mut cannot = None;
        worst.row(&format!("points[{index}]"), given, |worst| {
            let point: DerivativePoint = part(given)?;
            check(&point, &file)?;
            match simulator.derivative(&point) {
                Err(why) => cannot = Some(why),
                Ok(answer) => compare(&file, index, &point, &answer, worst)?,
            }
            Ok(())
        })?;
        if let Some(why) = cannot {
            return Ok(vec![Row::not_run(why)]);
        }
    }
    Ok(worst.into_rows())
}

fn check(point: &DerivativePoint, file: &File) -> Result<(), String> {
    let balls = point.params.ball_count;
    let states = point.params.states()? + file.quadratures.len();
    let shape = point.y.len() == states
        && point.dy.len() == states
        && point.per_ball.len() == balls
        && point
            .per_ball
            .iter()
            .all(|ball| ball.len() == file.per_ball_cols.len());
    if shape {
        Ok(())
    } else {
        Err(format!(
            "not the {states} states and columns of {balls} balls"
        ))
    }
}

/// Name and unit of the class of a rate: the same letter of the state over all bodies.
fn class(state: usize, balls: usize) -> (&'static str, &'static str) {
    const BODY: [(&str, &str); 6] = [
        ("rate_of_positions", "m/s"),
        ("rate_of_positions", "m/s"),
        ("rate_of_velocities", "m/s^2"),
        ("rate_of_velocities", "m/s^2"),
        ("rate_of_angles", "rad/s"),
        ("rate_of_angular_speeds", "rad/s^2"),
    ];
    const BALL: [(&str, &str); 5] = [
        ("rate_of_ball_radius", "m/s"),
        ("rate_of_ball_radial_speed", "m/s^2"),
        ("rate_of_ball_azimuth", "rad/s"),
        ("rate_of_ball_orbit_speed", "rad/s^2"),
        ("rate_of_ball_spin", "rad/s^2"),
    ];
    match state {
        0..12 => BODY[state % 6],
        12..16 => BODY[state - 12],
        16 => BODY[4],
        17 => BODY[5],
        _ if state < 18 + 5 * balls => BALL[(state - 18) % 5],
        _ => ("power_of_energy_accounts", "W"),
    }
}

/// Unit of a column of the files.
fn unit_of(column: &str) -> &'static str {
    if column.contains("torque") {
        "N m"
    } else if column.starts_with("u_") || column.starts_with("slip") {
        "m/s"
    } else if ["delta", "pen", "arm"]
        .iter()
        .any(|part| column.starts_with(part))
        || column.ends_with("penetration")
    {
        "m"
    } else if column == "side" {
        ""
    } else {
        "N"
    }
}

fn compare(
    file: &File,
    index: usize,
    point: &DerivativePoint,
    answer: &DerivativeAnswer,
    worst: &mut Worst,
) -> Result<(), String> {
    let lengths = [
        (point.dy.len(), answer.rates.len()),
        (point.per_ball.len(), answer.per_ball.len()),
        (point.globals.len(), answer.globals.len()),
    ];
    if lengths.iter().any(|(reference, ours)| reference != ours) {
        return Err(format!(
            "points[{index}]: the simulation gave another number of values"
        ));
    }
    let balls = point.params.ball_count;
    let largest = |name: &str| {
        let of_class = |(state, _): &(usize, &f64)| class(*state, balls).0 == name;
        point
            .dy
            .iter()
            .enumerate()
            .filter(of_class)
            .fold(0.0_f64, |most, (_, rate)| most.max(rate.abs()))
    };
    for (state, (reference, ours)) in point.dy.iter().zip(&answer.rates).enumerate() {
        let (name, unit) = class(state, balls);
        let why = format!("point {index}, state {state}");
        worst.add(scaled(name, unit, *reference, *ours, largest(name), why));
    }
    for (column, name) in file.per_ball_cols.iter().enumerate() {
        let largest = point
            .per_ball
            .iter()
            .fold(0.0_f64, |most, ball| most.max(ball[column].abs()));
        for (ball, (reference, ours)) in point.per_ball.iter().zip(&answer.per_ball).enumerate() {
            let ours = ours.get(column).copied().unwrap_or(f64::NAN);
            let why = format!("point {index}, ball {ball}");
            let quantity = format!("ball {name}");
            worst.add(scaled(
                &quantity,
                unit_of(name),
                reference[column],
                ours,
                largest,
                why,
            ));
        }
    }
    for (name, (&reference, &ours)) in file
        .global_cols
        .iter()
        .zip(point.globals.iter().zip(&answer.globals))
    {
        // a force or torque near zero is measured by the largest of its unit
        let largest = file
            .global_cols
            .iter()
            .zip(&point.globals)
            .filter(|(other, _)| unit_of(other) == unit_of(name))
            .fold(0.0_f64, |most, (_, value)| most.max(value.abs()));
        worst.add(scaled(
            name,
            unit_of(name),
            reference,
            ours,
            largest,
            format!("point {index}"),
        ));
    }
    for (name, reference, ours) in [
        ("kinetic_energy", point.kinetic, answer.kinetic),
        ("potential_energy", point.potential, answer.potential),
    ] {
        worst.add(scaled(
            name,
            "J",
            reference,
            ours,
            reference.abs(),
            format!("point {index}"),
        ));
    }
    Ok(())
}

/// The criterion of the files: relative to the value, or to 1e-3 of the largest of its class.
fn scaled(name: &str, unit: &str, reference: f64, ours: f64, largest: f64, why: String) -> Row {
    let allowed = SHARE * reference.abs().max(1e-3 * largest);
    let why = format!("{why}; 1e-9 of the value or of 1e-3 of the largest of its class");
    Row::compared(
        name,
        unit,
        reference,
        ours,
        Tolerance::Absolute(allowed),
        why,
    )
}
