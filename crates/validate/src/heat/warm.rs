//! What the files of warm bearings have in common: nodes by name, capacities, links, grounds, oil, shares.

use super::network;
use crate::json::{list, number, positive, within};
use physics::viscosity::ICE_POINT;
use serde_json::Value;
use thermal::network::Network;

/// A number of each node, by its name; what is not there is `otherwise`, where that is allowed.
fn by_name(
    value: &Value,
    key: &str,
    names: &[&str],
    otherwise: Option<f64>,
) -> Result<Vec<f64>, String> {
    let of = &value[key];
    let one = |name: &&str| match (&of[*name], otherwise) {
        (Value::Null, Some(other)) => Ok(other),
        _ => number(of, name).map_err(|error| format!("{key}: {error}")),
    };
    names.iter().map(one).collect()
}

/// The network of a case; its grounds are all at the ambient temperature.
pub(super) fn network(inputs: &Value, names: &[&str]) -> Result<Network, String> {
    let ambient = within(inputs, "ambient", -273.0, 1e4)?;
    let capacities = by_name(inputs, "capacity", names, None)?;
    network::network(inputs, names, &capacities, Some(ambient))
}

/// Shares of a loss over the nodes, which must add to one.
pub(super) fn shares(inputs: &Value, key: &str, names: &[&str]) -> Result<Vec<f64>, String> {
    let shares = by_name(inputs, key, names, Some(0.0))?;
    let sum: f64 = shares.iter().sum();
    if shares.iter().any(|share| *share < 0.0) || (sum - 1.0).abs() > 1e-9 {
        return Err(format!(
            "{key} adds to {sum}, not to 1, or has a negative share"
        ));
    }
    Ok(shares)
}

/// The line of an oil through two points in °C and mm²/s.
pub(super) fn oil(inputs: &Value) -> Result<physics::viscosity::Viscosity, String> {
    let points = list(inputs, "oil")?;
    let point = |at: usize| -> Result<(f64, f64), String> {
        let pair = points.get(at).and_then(Value::as_array);
        let values = pair.map(|pair| pair.iter().filter_map(Value::as_f64).collect::<Vec<_>>());
        match values.as_deref() {
            Some([celsius, viscosity]) => Ok((celsius + ICE_POINT, viscosity * 1e-6)),
            _ => Err("oil needs two points of temperature and viscosity".to_string()),
        }
    };
    physics::viscosity::Viscosity::through(point(0)?, point(1)?)
        .map_err(|error| format!("oil: {error:?}"))
}

/// f0, pitch diameter and the rest of Palmgren's moment; without the load's part where the file has none.
pub(super) fn palmgren(inputs: &Value) -> Result<physics::palmgren::Palmgren<f64>, String> {
    let loaded = inputs["z"].is_number();
    let of = |key: &str, otherwise: f64| match loaded {
        true => positive(inputs, key),
        false => Ok(otherwise),
    };
    Ok(physics::palmgren::Palmgren {
        viscous_factor: within(inputs, "f0", 1e-6, 1e3)?,
        viscosity: 0.0,
        pitch_diameter: within(inputs, "dm", 1e-4, 10.0)?,
        load_factor: of("z", 0.0)?,
        load_exponent: of("y", 1.0)?,
        static_load_rating: of("C0", 1.0)?,
        preload: 0.0,
    })
}
