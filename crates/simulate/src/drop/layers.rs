//! The heated layers of rotor and inner race.

use model::surface_heat::Surfaces;
use scenario::{AuxiliaryBearing, Contact};
use std::f64::consts::PI;
use thermal::layer::Layer;

/// Depths that a race may have whose depth follows from its mass, m.
const DEPTHS: (f64, f64) = (1e-3, 10e-3);

/// What of the rotor its friction heat warms first.
pub(super) fn rotor_layer(contact: &Contact) -> Layer {
    Layer::new(contact.metals[0].material, contact.rotor_layer_depth())
}

/// The surfaces of an auxiliary bearing, where the width of its landing surface is given, and no face shares its friction heat.
pub(crate) fn built(part: &AuxiliaryBearing) -> Option<Surfaces> {
    let contact = &part.contact;
    let length = contact.width.filter(|_| !contact.faces.any())?;
    let race = contact.metals[1];
    let bore = 0.5 * contact.bore_diameter;
    // a ring of that mass: π ((R + h)² − R²) ρ L = m
    let of_mass = || {
        // a bushing is one ring: the mass on its mount
        let mass =
            (part.bearing.as_ref()).map_or(part.mount.moving_mass, |race| race.inner_race_mass);
        let square = mass / (PI * race.material.density * length);
        ((bore * bore + square).sqrt() - bore).clamp(DEPTHS.0, DEPTHS.1)
    };
    let race_depth = race.layer.unwrap_or_else(of_mass);
    Some(Surfaces {
        layers: [rotor_layer(contact), Layer::new(race.material, race_depth)],
        length,
        modulus: contact.modulus,
    })
}
