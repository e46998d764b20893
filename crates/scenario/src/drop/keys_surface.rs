//! Keys of the surfaces of rotor and inner race, whose heat a run follows where the width of the landing surface is given.

use crate::key::{Key, Kind};

/// Why steel is taken.
const STEEL: &str = "bearing steel, 40 to 50 W/(m K), 450 to 480 J/(kg K)";

const fn conductivity(path: &'static str, doc: &'static str) -> Key {
    Key::new(path, Kind::Quantity("W/(m K)"), "46 W/(m K)", doc)
        .positive()
        .default("46 W/(m K)", STEEL)
}

const fn density(path: &'static str, doc: &'static str) -> Key {
    Key::new(path, Kind::Quantity("kg/m^3"), "7850 kg/m^3", doc)
        .positive()
        .default("7850 kg/m^3", STEEL)
}

const fn specific_heat(path: &'static str, doc: &'static str) -> Key {
    Key::new(path, Kind::Quantity("J/(kg K)"), "460 J/(kg K)", doc)
        .positive()
        .default("460 J/(kg K)", STEEL)
}

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    conductivity(
        "contact.surface.rotor_conductivity",
        "Thermal conductivity of the rotor or of its landing sleeve.",
    ),
    density("contact.surface.rotor_density", "Density of the same."),
    specific_heat("contact.surface.rotor_specific_heat", "Specific heat of the same."),
    Key::new("contact.surface.rotor_layer", Kind::Quantity("m"), "5 mm", "Depth of the rotor's metal below its landing surface that its friction heat warms; what is deeper is taken as too far for the time of a run.")
        .positive().default("5 mm", "heat needs 2 s to pass 5 mm of steel"),
    conductivity(
        "contact.surface.race_conductivity",
        "Thermal conductivity of the inner race or of the sleeve in its bore.",
    ),
    density("contact.surface.race_density", "Density of the same."),
    specific_heat("contact.surface.race_specific_heat", "Specific heat of the same."),
    Key::new("contact.surface.race_layer", Kind::Quantity("m"), "3.6 mm", "Depth of the inner race's metal below its bore.")
        .positive().optional("that of bearing.inner_race_mass spread over the landing surface, 1 to 10 mm"),
    Key::new("contact.surface.modulus", Kind::Quantity("Pa"), "113 GPa", "Contact modulus E* of rotor and race, which decides how wide the patch is: 1/E* is the sum of (1 - nu^2)/E of both.")
        .positive().default("113 GPa", "steel on steel"),
    Key::new("contact.surface.wear_coefficient", Kind::Quantity("m^2/N"), "1e-13 m^2/N", "Wear coefficient k of rotor and race together: volume worn over force and sliding distance. Dry steel on steel 1e-15 mild to 1e-12 severe, steel on bronze 1e-15 to 1e-13.")
        .not_negative().optional("no wear is given: it differs by decades between pairs"),
];
