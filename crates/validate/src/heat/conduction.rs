//! Rows of heat that flows: half-space, slab, bodies that touch, walls, fits, gas, radiation.

use super::tally::{Compare, Tally};
use crate::json::{exactly, number, positive, positives, within};
use physics::heat_conduction::{
    ThermalMaterial, half_space_rise, slab_rise, touch_flux, touch_temperature,
};
use physics::heat_exchange::{
    ContactConductance, coaxial_radiation, constriction_resistance, cylinder_wall,
    free_molecular_air, pressed_joint, uniform_flux_resistance,
};
use serde_json::Value;

/// The comparison of a kind of row.
pub(super) fn of_kind(kind: &str) -> Option<Compare> {
    Some(match kind {
        "half-space, constant flux" => half_space,
        "slab, constant flux, insulated back" => slab,
        "two half-spaces touch" => touch,
        "constriction, isothermal ellipse, one half-space" => constriction,
        "uniform flux ellipse, mean temperature over power" => uniform_flux,
        "rolling contact, conductance of both sides" => rolling_contact,
        "cylinder wall" => wall,
        "fit, Cooper-Mikic-Yovanovich" => fit,
        "free-molecular gas, air, accommodation 1" => thin_gas,
        "radiation between coaxial cylinders" => radiation,
        _ => return None,
    })
}

fn material(value: &Value) -> Result<ThermalMaterial, String> {
    Ok(ThermalMaterial {
        conductivity: positive(value, "k")?,
        density: positive(value, "rho")?,
        specific_heat: positive(value, "c")?,
    })
}

/// Semi-axes of an ellipse, the larger one first.
fn ellipse(row: &Value) -> Result<[f64; 2], String> {
    match positives(row, "semi_axes")? {
        [a, b] if a >= b => Ok([a, b]),
        _ => Err("semi_axes are not a ≥ b".to_string()),
    }
}

fn half_space(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let (flux, time) = (number(row, "flux")?, positive(row, "time")?);
    let depth = within(row, "depth", 0.0, f64::INFINITY)?;
    let ours = half_space_rise(material(row)?, flux, time, depth);
    tally.add("half-space: rise", "K", number(row, "rise")?, ours)
}

fn slab(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let (flux, time) = (number(row, "flux")?, positive(row, "time")?);
    let thickness = positive(row, "thickness")?;
    let depth = within(row, "depth", 0.0, thickness)?;
    let ours = slab_rise(material(row)?, flux, thickness, time, depth);
    tally.add("slab: rise", "K", number(row, "rise")?, ours)
}

fn touch(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let (first, second) = (material(&row["first"])?, material(&row["second"])?);
    let warm = number(row, "first_temperature")?;
    let cold = number(row, "second_temperature")?;
    let ours = touch_temperature(first, second, warm, cold);
    let name = "touch: contact temperature";
    tally.add(name, "°C", number(row, "contact_temperature")?, ours)?;
    let ours = touch_flux(first, second, warm - cold, 1e-3);
    let reference = number(row, "flux_at_1ms")?;
    tally.add("touch: flux after 1 ms", "W/m²", reference, ours)
}

fn constriction(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let [a, b] = ellipse(row)?;
    let ours = constriction_resistance(a, b, positive(row, "conductivity")?);
    let name = "isothermal ellipse: resistance";
    tally.add(name, "K/W", number(row, "resistance")?, ours)
}

fn uniform_flux(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let [a, b] = ellipse(row)?;
    let ours = uniform_flux_resistance(a, b, positive(row, "conductivity")?);
    let name = "ellipse of uniform flux: resistance";
    tally.add(name, "K/W", number(row, "resistance")?, ours)
}

fn rolling_contact(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let [a, b] = ellipse(row)?;
    let speed = within(row, "speed", 0.0, f64::INFINITY)?;
    let (first, second) = (material(&row["first"])?, material(&row["second"])?);
    let ours = ContactConductance::of_ellipse(a, b, speed, first, second);
    for (key, name, value) in [
        ("static", "contact: conductance at rest", ours.at_rest),
        ("moving", "contact: conductance rolling", ours.rolling),
        ("conductance", "contact: conductance, blend", ours.blend()),
    ] {
        tally.add(name, "W/K", number(row, key)?, value)?;
    }
    Ok(())
}

fn wall(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let [inner, outer] = positives(row, "radii")?;
    if outer <= inner {
        return Err("radii do not grow".to_string());
    }
    let (conductivity, length) = (positive(row, "conductivity")?, positive(row, "length")?);
    let ours = cylinder_wall(conductivity, length, inner, outer);
    let name = "cylinder wall: conductance";
    tally.add(name, "W/K", number(row, "conductance")?, ours)
}

fn fit(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let ours = pressed_joint(
        positives(row, "conductivities")?,
        positive(row, "roughness")?,
        positive(row, "slope")?,
        positive(row, "pressure")?,
        positive(row, "hardness")?,
    );
    let reference = number(row, "conductance_per_area")?;
    tally.add("fit: conductance", "W/(m² K)", reference, ours)
}

fn thin_gas(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let (pressure, temperature) = (positive(row, "pressure")?, positive(row, "temperature")?);
    let ours = free_molecular_air(1.0, pressure, temperature);
    let reference = number(row, "conductance_per_area")?;
    tally.add("thin gas: conductance", "W/(m² K)", reference, ours)
}

fn radiation(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let temperatures = exactly(row, "temperatures", 2)?;
    let ours = coaxial_radiation(
        [temperatures[0], temperatures[1]],
        positives(row, "areas")?,
        positives(row, "emissivities")?,
    );
    tally.add("radiation: power", "W", number(row, "power")?, ours)
}
