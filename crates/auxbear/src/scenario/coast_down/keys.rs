//! The part of the table of keys that describes a run-out with heat: how long it lasts, and what the heat passes through.

use crate::scenario::coast_down::{Atmosphere, CageMaterial, Feedback};
use crate::scenario::key::{Condition, Fallback, Key, Kind, Otherwise, Presence, Range, Section};
use crate::scenario::system::SystemName;
use crate::scenario::words::Words;

/// The systems of this page.
const COAST_DOWN: &[SystemName] = &[SystemName::CoastDown];

pub(crate) const SECTIONS: &[Section] = &[
    Section {
        path: "coast_down",
        doc: "The run-out: the rotor rolls on its auxiliary bearings, which brake it until it stands. Nothing whirls or bounces.",
        systems: COAST_DOWN,
    },
    Section {
        path: "heat",
        doc: "What warms and where the heat goes, of one bearing with its part of the rotor and its housing. What is not given follows from geometry and common surfaces, within a factor of two.",
        systems: COAST_DOWN,
    },
];

const CAGE: &[Condition] = &[Condition {
    path: "bearing.separation",
    values: &["cage"],
    reason: "",
}];

const POLYAMIDE: Condition = Condition {
    path: "heat.cage_material",
    values: &["PA66"],
    reason: "",
};

pub(crate) const KEYS: &[Key] = &[
    Key::new(
        "coast_down.radial_load",
        Kind::Quantity("N"),
        "39 N",
        "Radial force of the rotor on each bearing.",
    )
    .positive()
    .derived("weight of rotor.mass over rotor.planes, 9.80665 m/s²"),
    Key::new(
        "coast_down.stop_speed",
        Kind::Quantity("rad/s"),
        "1 rad/s",
        "Speed at which the run-out ends. Below about 1 rad/s the friction laws fade.",
    )
    .positive()
    .default("1 rad/s", "what is left there stops within seconds"),
    Key::new(
        "coast_down.longest",
        Kind::Quantity("s"),
        "10 h",
        "Time after which the run is ended, standing or not.",
    )
    .positive()
    .default("1000 h", "a rotor that coasts for six weeks has other worries"),
    Key::new(
        "coast_down.tolerance",
        Kind::Coefficient,
        "1e-3",
        "Allowed error of a step, in time over the run-out and in temperature over 50 K.",
    )
    .within(Range::FromTo(1e-8, 0.1))
    .default("5e-4", "stop time within 0.05 %, temperatures within 0.1 K"),
    Key::new(
        "heat.ambient_temperature",
        Kind::Quantity("K"),
        "25 degC",
        "Temperature of what stands around housing and rotor.",
    )
    .positive()
    .assumed("25 degC", "room temperature"),
    Key::new(
        "heat.start_temperature",
        Kind::Quantity("K"),
        "40 degC",
        "Temperature of everything at the start; the clearance is that of this temperature.",
    )
    .positive()
    .derived("bearing.moment.temperature"),
    Key::new(
        "heat.atmosphere",
        Kind::Word(Atmosphere::WORDS),
        "vacuum",
        "What surrounds the bearing: in vacuum heat.surroundings has no default.",
    )
    .assumed("air", "most machines; a vacuum takes far less heat away"),
    Key::new(
        "heat.feedback",
        Kind::Word(Feedback::WORDS),
        "viscosity",
        "What follows the temperatures: viscosity and clearance of the bearing, viscosity alone, or nothing.",
    )
    .default("viscosity and clearance", "a warm bearing brakes less, and one that closes brakes more"),
    Key::new(
        "heat.bore_diameter",
        Kind::Quantity("m"),
        "25 mm",
        "Bore of the bearing.",
    )
    .positive()
    .catalogued(),
    Key::new(
        "heat.outer_diameter",
        Kind::Quantity("m"),
        "47 mm",
        "Outer diameter of the bearing.",
    )
    .positive()
    .catalogued(),
    Key::new("heat.width", Kind::Quantity("m"), "12 mm", "Width of the bearing.")
        .positive()
        .catalogued(),
    Key::new(
        "heat.cage_material",
        Kind::Word(CageMaterial::WORDS),
        "PA66",
        "Material of the cage: its heat capacity, and its limit.",
    )
    .assumed("steel", "a pressed steel cage, the usual one of deep groove bearings")
    .when(CAGE),
    Key::new(
        "heat.lubricant_mass",
        Kind::Quantity("kg"),
        "2.8 g",
        "Mass of oil or grease in the bearing.",
    )
    .positive()
    .derived("0.005 g/mm² times outer diameter and width, a usual filling of grease"),
    Key::new(
        "heat.film_thickness",
        Kind::Quantity("m"),
        "0.3 um",
        "Film between balls and races, which their heat passes; 0 of a dry bearing.",
    )
    .not_negative()
    .assumed("0.3 um", "usual of an oiled bearing of this size; decides inner against outer race within a factor of two"),
    Key::new(
        "heat.rotor_capacity",
        Kind::Quantity("J/K"),
        "1840 J/K",
        "Heat capacity of the part of the rotor that warms with one bearing.",
    )
    .positive()
    .derived("rotor.mass over rotor.planes at 460 J/(kg K): all of it"),
    Key::new(
        "heat.housing_capacity",
        Kind::Quantity("J/K"),
        "220 J/K",
        "Heat capacity of the housing of one bearing.",
    )
    .positive()
    .derived("a ring of steel around the bearing, twice as large and as wide"),
    Key::new(
        "heat.rotor_contact",
        Kind::Quantity("W/K"),
        "0.15 W/K",
        "Conductance from rotor to inner race.",
    )
    .not_negative()
    .optional("that of two rough ground surfaces of steel along the width of the bearing, rolling on each other with heat.radial_air_clearance"),
    Key::new(
        "heat.radial_air_clearance",
        Kind::Quantity("m"),
        "0.25 mm",
        "Radial clearance of the rotor in the inner race: how wide the line is that they touch along.",
    )
    .positive()
    .derived("1 % of heat.bore_diameter, assumed")
    .excludes("heat.rotor_contact"),
    Key::new(
        "heat.outer_seat",
        Kind::Quantity("W/K"),
        "6 W/K",
        "Conductance from outer race to housing. A loose ring in vacuum has a thousandth of a pressed one; O-rings and wire mesh have what their maker says.",
    )
    .not_negative()
    .derived("ground steel pressed with 1 MPa, 3.6 kW/(m² K) of the ring's outside: assumed"),
    Key::new(
        "heat.surroundings",
        Kind::Quantity("W/K"),
        "0.87 W/K",
        "Conductance from the housing to its surroundings.",
    )
    .not_negative()
    .derived("ISO 15312: 320 W/(m² K) of π width (outer_diameter + bore_diameter), in air"),
    Key::new(
        "heat.rotor_surroundings",
        Kind::Quantity("W/K"),
        "0.3 W/K",
        "Conductance from the rotor to its surroundings.",
    )
    .not_negative()
    .assumed("0 W/K", "the rotor gives its heat to the bearings alone, as in vacuum"),
    Key::new(
        "heat.race_limit",
        Kind::Quantity("K"),
        "150 degC",
        "Temperature that no race may pass: above it rings grow and soften.",
    )
    .positive()
    .default("120 degC", "rings that are not stabilised, makers' catalogues; S0 150 degC, S1 200 degC"),
    Key::new(
        "heat.cage_limit",
        Kind::Quantity("K"),
        "120 degC",
        "Temperature that the cage may not pass.",
    )
    .positive()
    .default_when(
        POLYAMIDE,
        Fallback {
            text: "120 degC",
            reason: "PA66 in continuous running, makers' catalogues",
            assumed: false,
        },
        Otherwise::Fallback(Fallback {
            text: "200 degC",
            reason: "PEEK and metal, makers' catalogues; PEEK at high speed 150 degC",
            assumed: false,
        }),
    ),
    Key::new(
        "heat.lubricant_limit",
        Kind::Quantity("K"),
        "130 degC",
        "Temperature that the lubricant may not pass.",
    )
    .positive()
    .default("130 degC", "lithium grease works to 130 degC, makers' catalogues; its life halves with each 10 K"),
];

/// What this system does without a key that others have too.
pub(crate) const PRESENCES: &[(&str, Presence)] = &[
    (
        "bearing.moment.law",
        Presence::Default(Fallback {
            text: "palmgren",
            reason: "the one law whose parts warmth and clearance act on",
            assumed: false,
        }),
    ),
    (
        "bearing.moment.lubrication",
        Presence::Default(Fallback {
            text: "grease",
            reason: "the usual lubrication of an auxiliary bearing",
            assumed: true,
        }),
    ),
    (
        "bearing.moment.temperature",
        Presence::Default(Fallback {
            text: "25 degC",
            reason: "room temperature",
            assumed: true,
        }),
    ),
    ("bearing.moment.viscosity_points", Presence::Required),
    (
        "bearing.moment.viscosity",
        Presence::Derived("viscosity_points at temperature"),
    ),
];
