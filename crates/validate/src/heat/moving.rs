//! Rows of heat sources that move: bands, circles, ellipses.

use super::tally::{Compare, Tally};
use crate::json::{list, number, text, within};
use physics::flash::{
    Flux, band_maximum, band_mean, band_rise, circle_fit, circle_mean, ellipse_maximum,
};
use serde_json::Value;

/// Widest range of Λ and Pe in which integrals are taken.
const LEAST: f64 = 1e-6;
const MOST: f64 = 1e5;

/// The comparison of a kind of row.
pub(super) fn of_kind(kind: &str) -> Option<Compare> {
    Some(match kind {
        "band" => band,
        "ellipse" => ellipse,
        "circle, uniform, mean" => circle,
        _ => return None,
    })
}

fn band(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let half = within(row, "L", LEAST, MOST)?;
    let (place, largest) = band_maximum(half);
    let allowed = tally.relative("band")?;
    for (key, name, ours) in [
        ("max", "band: largest", largest),
        ("mean", "band: mean", band_mean(half)),
        ("end_leading", "band: leading end", band_rise(half, -half)),
        ("end_trailing", "band: trailing end", band_rise(half, half)),
    ] {
        tally.add_by(name, "", number(row, key)?, ours, allowed);
    }
    let allowed = tally.absolute("max_at_band")?;
    let (reference, ours) = (number(row, "max_at")?, place / half);
    tally.add_by("band: place of the largest", "", reference, ours, allowed);
    Ok(())
}

fn ellipse(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let flux = match text(row, "flux")? {
        "uniform" => Flux::Uniform,
        "hertz" => Flux::Hertz,
        other => return Err(format!("flux {other} is neither uniform nor hertz")),
    };
    let aspect = within(row, "aspect", 1e-2, 1e2)?;
    let (place, largest) = ellipse_maximum(aspect, within(row, "Pe", 0.0, 1e3)?, flux);
    let allowed = tally.relative("ellipse")?;
    let reference = number(row, "max")?;
    tally.add_by("ellipse: largest", "", reference, largest, allowed);
    let allowed = tally.absolute("max_at_ellipse")?;
    let reference = number(row, "max_at")?;
    let name = "ellipse: place of the largest";
    tally.add_by(name, "", reference, place, allowed);
    Ok(())
}

fn circle(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let peclet = within(row, "Pe", 0.0, MOST)?;
    let mean = circle_mean(peclet);
    let [largest_fit, mean_fit] = circle_fit(peclet);
    let reference = number(row, "mean")?;
    let exact = tally.relative("circle")?;
    tally.add_by("circle: mean", "", reference, mean, exact);
    let same = tally.relative("fit_values")?;
    let printed = number(row, "fit_max")?;
    tally.add_by("circle: fit of the largest", "", printed, largest_fit, same);
    let printed = number(row, "fit_mean")?;
    tally.add_by("circle: fit of the mean", "", printed, mean_fit, same);
    let near = tally.relative("fits")?;
    let name = "circle: fit of the mean beside the exact";
    tally.add_by(name, "", reference, mean_fit, near);
    if let Some(largest) = exact_largest(tally.file(), peclet)? {
        let name = "circle: fit of the largest beside the exact";
        tally.add_by(name, "", largest, largest_fit, near);
    }
    Ok(())
}

/// The largest rise of a uniform circle at the same speed, where the file has its row.
fn exact_largest(file: &Value, peclet: f64) -> Result<Option<f64>, String> {
    for row in list(file, "rows")? {
        let is_it = row["kind"] == "ellipse"
            && text(row, "flux")? == "uniform"
            && number(row, "aspect")? == 1.0
            && number(row, "Pe")? == peclet;
        if is_it {
            return number(row, "max").map(Some);
        }
    }
    Ok(None)
}
