//! The part of the table of keys that describes what warms of a bearing, and what the heat passes through.

use crate::heat::{Atmosphere, CageMaterial, Feedback, Network, RotorBodies};
use crate::key::{Condition, Fallback, Key, Kind, Otherwise, Range, Section};
use crate::system::{COAST_DOWN, FALLING, WARMING, WITH_NETWORK};
use problem::words::Words;

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[Section::new("heat", "What warms and where the heat goes, of one bearing with its part of the rotor and its housing. What is not given follows from geometry and common surfaces, within a factor of two.", WITH_NETWORK)];

pub(crate) const IS_FOLLOWED: Condition = Condition {
    path: "heat.network",
    values: &["on"],
    reason: "",
};

const FOLLOWED: &[Condition] = &[IS_FOLLOWED];

const FOLLOWED_IN_AIR: &[Condition] = &[
    IS_FOLLOWED,
    Condition {
        path: "heat.atmosphere",
        values: &["air"],
        reason: "a vacuum has no gas; what is left of it takes heat as air of that pressure",
    },
];

const FOLLOWED_WITH_CAGE: &[Condition] = &[
    IS_FOLLOWED,
    Condition {
        path: "bearing.separation",
        values: &["cage"],
        reason: "",
    },
];

const POLYAMIDE: Condition = Condition {
    path: "heat.cage_material",
    values: &["PA66"],
    reason: "",
};

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("heat.network", Kind::Word(Network::WORDS), "on", "Whether the temperatures of rotor, races, balls, cage, lubricant and housing are followed; heat.feedback says what follows them.")
        .default_when(Condition { path: "run.until", values: &["standstill"], reason: "", }, Fallback::convention("on", "what brakes a rotor for minutes depends on the temperatures"), Otherwise::Fallback(Fallback::convention("off", "seconds of rolling warm nothing to speak of"))).only(WARMING),
    Key::new("heat.ambient_temperature", Kind::Quantity("K"), "25 degC", "Temperature of what stands around housing and rotor.")
        .positive().assumed("25 degC", "room temperature").when(FOLLOWED),
    Key::new("heat.start_temperature", Kind::Quantity("K"), "40 degC", "Temperature of everything at the start; the clearance is that of this temperature.")
        .positive().derived("bearing.moment.temperature").when(FOLLOWED),
    Key::new("heat.atmosphere", Kind::Word(Atmosphere::WORDS), "vacuum", "What surrounds the bearing: in vacuum heat.surroundings has no default.")
        .assumed("air", "most machines; a vacuum takes far less heat away").when(FOLLOWED),
    Key::new("heat.gas_pressure", Kind::Quantity("Pa"), "1 bar", "Pressure of the air, from free flight of its molecules to the atmosphere: with it the gas between rotor and inner race conducts, and what takes heat from the housing (unless heat.surroundings is given) and from the rotor (heat.rotor_surroundings) is computed of their surfaces.")
        .positive().derived("sea level where an emissivity is given; else no gas is computed, and heat.surroundings follows a rule of the trade").when(FOLLOWED_IN_AIR),
    Key::new("heat.emissivity", Kind::Coefficient, "0.2", "Emissivity of rotor and inner race, which radiate to each other, and the rotor to its surroundings: bright steel 0.1 to 0.3, oxidised 0.8.")
        .within(Range::FromTo(0.0, 1.0)).default("0.0", "no radiation is computed").when(FOLLOWED),
    Key::new("heat.housing_emissivity", Kind::Coefficient, "0.8", "Emissivity of the housing, which radiates to its surroundings: painted or oxidised 0.8.")
        .within(Range::FromTo(0.0, 1.0)).default("0.0", "no radiation is computed").when(FOLLOWED),
    Key::new("heat.housing_area", Kind::Quantity("m^2"), "0.03 m^2", "Surface of the housing of one bearing that gas and radiation take heat from.")
        .positive().derived("outside and faces of a ring twice as large as the bearing, of its width: assumed").when(FOLLOWED),
    Key::new("heat.rotor_diameter", Kind::Quantity("m"), "100 mm", "Diameter of the rotor as a cylinder that turns in gas.")
        .positive().derived("sqrt(8 rotor.polar_inertia / rotor.mass), where they are given").when(FOLLOWED),
    Key::new("heat.rotor_area", Kind::Quantity("m^2"), "0.1 m^2", "Surface of the part of the rotor that warms with one bearing.")
        .positive().derived("a solid steel cylinder of heat.rotor_diameter and rotor.mass, over the number of bearings: assumed").when(FOLLOWED),
    Key::new("heat.feedback", Kind::Word(Feedback::WORDS), "viscosity", "What follows the temperatures: viscosity and clearance of the bearing, viscosity alone, or nothing.")
        .default("viscosity and clearance", "a warm bearing brakes less, and one that closes brakes more").when(FOLLOWED),
    Key::new("heat.bore_diameter", Kind::Quantity("m"), "25 mm", "Bore of the bearing.").positive().catalogued().when(FOLLOWED),
    Key::new("heat.outer_diameter", Kind::Quantity("m"), "47 mm", "Outer diameter of the bearing.").positive().catalogued().when(FOLLOWED),
    Key::new("heat.width", Kind::Quantity("m"), "12 mm", "Width of the bearing.").positive().catalogued().when(FOLLOWED),
    Key::new("heat.cage_material", Kind::Word(CageMaterial::WORDS), "PA66", "Material of the cage: its heat capacity, and its limit.")
        .assumed("steel", "a pressed steel cage, the usual one of deep groove bearings").when(FOLLOWED_WITH_CAGE),
    Key::new("heat.lubricant_mass", Kind::Quantity("kg"), "2.8 g", "Mass of oil or grease in the bearing.")
        .positive().derived("0.005 g/mm² times outer diameter and width, a usual filling of grease").when(FOLLOWED),
    Key::new("heat.film_thickness", Kind::Quantity("m"), "0.3 um", "Film between balls and races, which their heat passes; 0 of a dry bearing.")
        .not_negative().assumed("0.3 um", "usual of an oiled bearing of this size; decides inner against outer race within a factor of two").when(FOLLOWED),
    Key::new("heat.rotor_capacity", Kind::Quantity("J/K"), "1840 J/K", "Heat capacity of the part of the rotor that warms with one bearing.")
        .positive().derived("rotor.mass over the number of bearings at 460 J/(kg K): all of it; in a spin-up and on a rig a steel shaft of the bore, four widths long, assumed").when(FOLLOWED),
    Key::new("heat.housing_capacity", Kind::Quantity("J/K"), "220 J/K", "Heat capacity of the housing of one bearing.")
        .positive().derived("a ring of steel around the bearing, twice as large and as wide").when(FOLLOWED),
    Key::new("heat.rotor_contact", Kind::Quantity("W/K"), "0.15 W/K", "Conductance from rotor to inner race; on a rig and in a spin-up without a sliding rotor that of the seat on the shaft, which follows bearing.fits.shaft_interference, temperatures and speed where they are given.")
        .not_negative().optional("that of two rough ground surfaces of steel along the width of the bearing, rolling on each other with heat.radial_air_clearance").when(FOLLOWED),
    Key::new("heat.radial_air_clearance", Kind::Quantity("m"), "0.25 mm", "Radial clearance of the rotor in the inner race: the race turns slower than the rotor that rolls in it, by 2 radial_air_clearance/bore_diameter, and the line that they touch along is wider the smaller it is.")
        .positive().derived("1 % of heat.bore_diameter, assumed").only(COAST_DOWN).when(FOLLOWED),
    Key::new("heat.outer_seat", Kind::Quantity("W/K"), "6 W/K", "Conductance from outer race to housing. A loose ring in vacuum has a hundredth of a pressed one; O-rings and wire mesh have what their maker says.")
        .not_negative().derived("where bearing.fits.housing_interference and what it presses are given that of ground steel under its pressure, which follows the temperatures down to the gap of a loose ring; else under 1 MPa, 3.6 kW/(m² K) of the ring's outside: assumed").when(FOLLOWED),
    Key::new("heat.surroundings", Kind::Quantity("W/K"), "0.87 W/K", "Conductance from the housing to its surroundings.")
        .not_negative().derived("gas and radiation of heat.housing_area, where heat.gas_pressure or heat.housing_emissivity is given; else in air ISO 15312: 320 W/(m² K) of π width (outer_diameter + bore_diameter), which the standard means from the rings on: they rise up to 1.4 times as far here").when(FOLLOWED),
    Key::new("heat.rotor_surroundings", Kind::Quantity("W/K"), "0.3 W/K", "Conductance from the rotor to its surroundings.")
        .not_negative().derived("gas and radiation of heat.rotor_area, where heat.gas_pressure or heat.emissivity is given; else 0 W/K, as in vacuum: the rotor gives its heat to the bearings alone").when(FOLLOWED),
    Key::new("heat.shaft_expansion", Kind::Quantity("1/K"), "16e-6 1/K", "Thermal expansion of shaft or sleeve in the inner ring: bearing.fits.shaft_interference follows the temperatures with it.")
        .not_negative().default("11.5e-6 1/K", "bearing steel, makers: 11.0e-6 to 12.5e-6 1/K").only(WARMING).when(FOLLOWED),
    Key::new("heat.housing_expansion", Kind::Quantity("1/K"), "23e-6 1/K", "Thermal expansion of the housing around the outer ring: bearing.fits.housing_interference follows the temperatures with it. Aluminium has 23e-6 1/K.")
        .not_negative().default("11.5e-6 1/K", "a steel housing").only(WARMING).when(FOLLOWED),
    Key::new("heat.rotor_bodies", Kind::Word(RotorBodies::WORDS), "layer and core", "Whether the rotor is one body of the network, or its surface layer (contact.surface.rotor_layer on contact.width) and its core, k A/(L/2) between their means.")
        .default("one", "its whole capacity, spread at once: right from a few seconds on").only(FALLING).when(FOLLOWED),
    Key::new("heat.mount_capacity", Kind::Quantity("J/K"), "30 J/K", "Heat capacity of the mount below the housing of one bearing, which its damping warms.")
        .positive().optional("the mount is no body of its own: its damping warms the housing").only(FALLING).when(FOLLOWED),
    Key::new("heat.mount_contact", Kind::Quantity("W/K"), "0.1 W/K", "Conductance from housing to mount, beside heat.mount_capacity: rings of elastomer have about 0.03 W/K, wire mesh what its maker says.")
        .not_negative().optional("0 W/K: the mount keeps what its damping makes, the hottest that it can get").only(FALLING).when(FOLLOWED),
    Key::new("heat.mount_surroundings", Kind::Quantity("W/K"), "1 W/K", "Conductance from the mount to its surroundings, beside heat.mount_capacity.")
        .not_negative().optional("0 W/K: it gives its heat to the housing alone").only(FALLING).when(FOLLOWED),
    Key::new("heat.contamination", Kind::Coefficient, "0.3", "Contamination factor e_C of the lubricant, for the life with lubricant: 1 extremely clean, 0.8 to 0.6 filtered, 0.5 to 0.3 usual, below 0.1 dirty.")
        .within(Range::FromTo(0.0, 1.0)).assumed("0.3", "a greased bearing without a filter, ISO 281 from memory").when(FOLLOWED),
    Key::new("heat.race_limit", Kind::Quantity("K"), "150 degC", "Temperature that no race may pass: above it rings grow and soften.")
        .positive().default("120 degC", "rings that are not stabilised, makers' catalogues; S0 150 degC, S1 200 degC").when(FOLLOWED),
    Key::new("heat.cage_limit", Kind::Quantity("K"), "120 degC", "Temperature that the cage may not pass.")
        .positive().default_when(POLYAMIDE, Fallback::convention("120 degC", "PA66 in continuous running, makers' catalogues"), Otherwise::Fallback(Fallback::convention("200 degC", "PEEK and metal, makers' catalogues; PEEK at high speed 150 degC"))).when(FOLLOWED),
    Key::new("heat.lubricant_limit", Kind::Quantity("K"), "130 degC", "Temperature that the lubricant may not pass.")
        .positive().default("130 degC", "lithium grease works to 130 degC, makers' catalogues; its life halves with each 10 K").when(FOLLOWED),
];
