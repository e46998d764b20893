//! A bearing of which no law knows the losses: ball-by-ball intervals measure them.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::coast_down::build::{Part, network, of_losses};
use physics::palmgren::Palmgren;
use physics::viscosity::Viscosity;
use problem::Problem;
use scenario::Warm;
use thermal::bearing_network::{LUBRICANT, NODES};
use thermal::warm_bearing::{BearingLoad, WarmBearings};

/// A bearing of a coast-down, of which there are so many, whose losses intervals measure.
pub(crate) fn measured(
    warm: &Warm,
    name: String,
    planes: f64,
    viscosity: Viscosity,
) -> Result<Part, Box<Problem>> {
    let (network, zone) = network(warm)?;
    let mut lubricant = vec![0.0; NODES.len()];
    lubricant[LUBRICANT] = 1.0;
    let losses = WarmBearings {
        count: planes,
        ratio: 1.0,
        moment: Palmgren {
            viscous_factor: 0.0,
            viscosity: 0.0,
            pitch_diameter: warm.pitch_diameter,
            load_factor: 0.0,
            load_exponent: 1.0,
            static_load_rating: 1.0,
            preload: 0.0,
        },
        oil: viscosity,
        load: BearingLoad::Moment(0.0),
        windage: 0.0,
        lubricant: LUBRICANT,
        shares: [lubricant.clone(), lubricant],
    };
    Ok(Part {
        by_laws: false,
        ..of_losses(warm, name, (network, zone), (losses, viscosity))
    })
}
