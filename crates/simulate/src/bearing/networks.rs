//! The networks of bearings that warm.

use crate::coast_down::build::{ICE_POINT, losses, network};
use crate::coast_down::passages::limits;
use model::bearing_heat::{WarmBearing, shares};
use problem::Problem;
use scenario::{Bearing, Guidance, Moment, Separation, Warm};
use thermal::bearing_network::{HOUSING, INNER_RACE, MOUNT, OUTER_RACE};
use thermal::warm_bearing::BearingLoad;

/// Viscosity of a lubricant of which nothing is given, m²/s: grease or oil of 50 mm²/s.
const ASSUMED_VISCOSITY: f64 = 50e-6;

/// A bearing that warms; none where its temperatures are not followed.
pub(crate) fn built(
    warm: Option<&Warm>,
    bearing: &Bearing,
) -> Result<Option<Box<WarmBearing>>, Box<Problem>> {
    let Some(warm) = warm else {
        return Ok(None);
    };
    let (network, zone) = network(warm)?;
    let land = match &bearing.separation {
        Separation::Cage(cage) if matches!(cage.guidance, Guidance::InnerLand(_)) => INNER_RACE,
        _ => OUTER_RACE,
    };
    let oil = warm.viscosity();
    let at_start = match &warm.moment {
        Moment::Palmgren { viscosity, .. } | Moment::Skf { viscosity, .. } => *viscosity,
        Moment::None | Moment::Measured { .. } => ASSUMED_VISCOSITY,
    };
    let mut losses = match &warm.moment {
        Moment::Palmgren { .. } => Some(losses(warm, &zone, oil, 1.0)?),
        _ => None,
    };
    // at an angle nothing closes
    if let (Some(losses), true) = (&mut losses, bearing.contact_angle != 0.0) {
        losses.load = BearingLoad::Radial(warm.radial_load);
    }
    Ok(Some(Box::new(WarmBearing {
        start: warm.heat.start_temperature - ICE_POINT,
        zone,
        oil,
        viscosity: at_start,
        losses,
        shares: shares(
            warm.ball_material.heat(),
            warm.heat.cage_material.heat(),
            land,
            if network.has(MOUNT) { MOUNT } else { HOUSING },
        ),
        limits: limits(warm),
        network,
    })))
}
