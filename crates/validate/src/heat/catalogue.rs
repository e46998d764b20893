//! Worked examples of catalogues: life, loads, factors, each with the tolerance of its digits.

use super::tally::{Allowed, Tally, tolerance};
use crate::json::{list, number, numbers, positive, text, within};
use physics::life::{
    basic_life, interval_life, life_hours, mean_load, reference_viscosity, reliability_factor,
    temperature_factor,
};
use physics::severity::static_safety;
use serde_json::Value;

/// Results that an example prints as what its other results start from.
const GIVEN: [&str; 3] = ["hours_each", "C0", "P0"];
/// Hours of a life factor of 1, and the speed of a speed factor of 1, 1/min.
const LIFE_HOURS: f64 = 500.0;
const UNIT_SPEED: f64 = 100.0 / 3.0;

/// Whether a row is a worked example.
pub(super) fn is_example(row: &Value) -> bool {
    let has = |key: &str| row[key].is_object();
    row["name"].is_string() && has("results") && has("tolerance")
}

/// Compares a file.
pub(super) fn compare(file: &Value, tally: &mut Tally) -> Result<(), String> {
    for row in list(file, "rows")? {
        let name = text(row, "name")?;
        tally.row(name, row, |tally| example(name, row, tally))?;
    }
    Ok(())
}

fn example(name: &str, row: &Value, tally: &mut Tally) -> Result<(), String> {
    let results = row["results"].as_object().ok_or("results is no table")?;
    let reason = row["reason"].as_str().unwrap_or_default();
    for (key, printed) in results {
        let quantity = format!("{name}: {key}");
        let share = &row["tolerance"][key];
        if GIVEN.contains(&key.as_str()) && share.is_null() {
            continue;
        }
        if share.is_null() {
            tally.leave_out(&quantity, &format!("given without a tolerance: {reason}"));
            continue;
        }
        let allowed = Allowed::share(tolerance(&row["tolerance"], key)?);
        let Some(ours) = result(key, row)? else {
            tally.leave_out(&quantity, "a result that is not known");
            continue;
        };
        let printed = match printed {
            Value::Array(_) => numbers(&row["results"], key)?,
            _ => vec![number(&row["results"], key)?],
        };
        if printed.len() != ours.len() {
            let (wanted, found) = (ours.len(), printed.len());
            return Err(format!("{key} has {found} numbers, not {wanted}"));
        }
        tally.place = reason.to_string();
        for (printed, ours) in printed.iter().zip(&ours) {
            tally.add_by(&quantity, "", *printed, *ours, allowed);
        }
    }
    Ok(())
}

/// Our values of a result of an example.
fn result(key: &str, row: &Value) -> Result<Option<Vec<f64>>, String> {
    let exponent = || within(row, "exponent", 1.0, 10.0);
    let speed = || positive(row, "speed_rpm");
    // A speed whose hours are LIFE_HOURS at P = C has the factor 1.
    let speed_factor = || Ok::<f64, String>((UNIT_SPEED / speed()?).powf(1.0 / exponent()?));
    let millions = || Ok::<f64, String>(basic_life(positive(row, "C")?, load(row)?, exponent()?));
    Ok(Some(match key {
        "speed_factor" => vec![speed_factor()?],
        "life_factor" => match row.get("hours_wanted") {
            Some(_) => vec![wanted_factor(row)?],
            None => vec![speed_factor()? * positive(row, "C")? / load(row)?],
        },
        "C_needed" => vec![wanted_factor(row)? * load(row)? / speed_factor()?],
        "millions" => vec![millions()?],
        "hours" if row.get("shares").is_some() => {
            let each = list_of(&row["results"], "hours_each")?;
            let shares = list_of(row, "shares")?;
            if each.len() != shares.len() {
                return Err("hours_each and shares differ in length".to_string());
            }
            vec![interval_life(&each, &shares)]
        }
        "hours" => vec![life_hours(millions()?, speed()?)],
        "hours_basic" => {
            let (rating, exponent) = (positive(row, "C")?, exponent()?);
            let (loads, speeds) = (list_of(row, "loads")?, list_of(row, "speeds_rpm")?);
            if loads.len() != speeds.len() {
                return Err("loads and speeds_rpm differ in length".to_string());
            }
            let each = loads.iter().zip(&speeds);
            each.map(|(load, speed)| life_hours(basic_life(rating, *load, exponent), *speed))
                .collect()
        }
        "mean_load" => {
            let (loads, shares) = (list_of(row, "loads")?, list_of(row, "shares")?);
            let speeds = list_of(row, "speeds_rpm")?;
            if loads.len() != shares.len() || loads.len() != speeds.len() {
                return Err("loads, shares and speeds_rpm differ in length".to_string());
            }
            let turns: Vec<f64> = shares.iter().zip(&speeds).map(|(s, n)| s * n).collect();
            vec![mean_load(&loads, &turns, exponent()?)]
        }
        "ratio" => vec![positive(row, "f0")? * number(row, "Fa")? / positive(row, "C0")?],
        "P" => vec![load(row)?],
        "limit_ratio" => vec![positive(row, "fatigue_limit_load")? / load(row)?],
        "kappa" => {
            let needed = reference_viscosity(speed()?, positive(row, "dm_mm")?);
            vec![positive(row, "viscosity_mm2_s")? / needed]
        }
        "s0" => {
            let given = &row["results"];
            vec![static_safety(
                positive(given, "C0")?,
                positive(given, "P0")?,
            )]
        }
        "a1" => list_of(row, "survival")?
            .into_iter()
            .map(reliability_factor)
            .collect(),
        "factor" => numbers(row, "temperature_C")?
            .into_iter()
            .map(temperature_factor)
            .collect(),
        _ => return Ok(None),
    }))
}

fn wanted_factor(row: &Value) -> Result<f64, String> {
    let exponent = within(row, "exponent", 1.0, 10.0)?;
    Ok((positive(row, "hours_wanted")? / LIFE_HOURS).powf(1.0 / exponent))
}

/// The equivalent load of an example: given, or X Fr + Y Fa.
fn load(row: &Value) -> Result<f64, String> {
    if row.get("P").is_some() {
        return positive(row, "P");
    }
    let part =
        |factor: &str, force: &str| Ok::<f64, String>(number(row, factor)? * number(row, force)?);
    let load = part("X", "Fr")? + part("Y", "Fa")?;
    if load > 0.0 {
        Ok(load)
    } else {
        Err("X Fr + Y Fa is not above 0".to_string())
    }
}

/// A list of positive numbers, at least one.
fn list_of(value: &Value, key: &str) -> Result<Vec<f64>, String> {
    let found = numbers(value, key)?;
    if found.is_empty() || found.iter().any(|number| *number <= 0.0) {
        return Err(format!("{key} is no list of numbers above 0"));
    }
    Ok(found)
}
