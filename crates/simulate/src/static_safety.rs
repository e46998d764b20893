//! The static safety of a bearing, in every system that loads one.

use outcome::list::{NOT_GIVEN, origins};
use physics::static_load::{equivalent_static_load, static_load_factors};
use scenario::{Bearing, RatedBearing};

/// The load on a bearing whose static safety is asked for.
pub struct StaticLoad {
    /// Radial load, N.
    pub radial: f64,
    /// Axial load, N.
    pub axial: f64,
    /// Contact angle, rad; none where it is not known.
    pub contact_angle: Option<f64>,
}

/// s0 = C0/P0, or why there is none.
pub fn static_safety(rated: &RatedBearing, load: &StaticLoad) -> Result<f64, String> {
    let equivalent = equivalent(rated, load)?;
    let rating = (rated.static_load_rating)
        .ok_or_else(|| "bearing.static_load_rating is not given".to_string())?;
    match equivalent > 0.0 {
        true => Ok(rating / equivalent),
        false => Err("there is no load".to_string()),
    }
}

/// The same of a bearing under a radial load, N, and its preload.
pub fn safety_under(radial: f64, bearing: &Bearing) -> Result<f64, String> {
    let load = StaticLoad {
        radial,
        axial: bearing.axial_preload,
        contact_angle: Some(bearing.contact_angle),
    };
    static_safety(&bearing.rated(), &load)
}

/// Why there is none under any load.
pub fn no_safety(bearing: &Bearing) -> Option<String> {
    if bearing.spatial.is_some() {
        let why = "what loads a bearing in space has an axial part: see peak_hertz_pressure";
        return Some(why.to_string());
    }
    let why = safety_under(0.0, bearing).err();
    why.filter(|why| why.ends_with(NOT_GIVEN))
}

/// P0, N; without axial load F_r of every type.
fn equivalent(rated: &RatedBearing, load: &StaticLoad) -> Result<f64, String> {
    if load.axial == 0.0 {
        return Ok(load.radial.abs());
    }
    let (radial, axial) = static_load_factors(rated.kind.factor_type(), load.contact_angle)
        .map_err(|why| why.to_string())?;
    let [on_radius, on_axis] = [load.radial, load.axial].map(f64::abs);
    Ok(equivalent_static_load([radial, axial], on_radius, on_axis))
}

origins! {
    /// Of a load that is given.
    pub AT_THE_LOAD: law "s0 = C0/P0, P0 = max(F_r, X0 F_r + Y0 F_a) of the largest load that is given",
        source "ISO 76 (from memory), crates/physics/src/static_load.rs",
        valid "a single row, or the rows to which the rating belongs; dents of 1e-4 of a ball's diameter at s0 = 1";
}
