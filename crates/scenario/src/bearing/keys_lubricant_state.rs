//! The part of the table of keys that describes how the lubricant changes while the bearing turns and rests.

use crate::bearing::lubricant_state::StateKind;
use crate::bearing::lubricant_state::StateStart;
use crate::key::{Condition, Key, Kind, Range, Section};
use crate::system::MOVING;
use problem::words::Words;

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[Section::new("bearing.lubricant_state", "Slow state of the lubricant: a grease that is drawn into the contacts and worked, contact films that warm. It multiplies the speed-dependent part of the friction moment (a measured curve as a whole) and the traction coefficient.", MOVING)];

const fn kind(values: &'static [&'static str]) -> Condition {
    Condition::new("bearing.lubricant_state.kind", values)
}

const GREASE: &[Condition] = &[kind(&["grease", "grease and films"])];
const FILMS: &[Condition] = &[kind(&["films", "grease and films"])];
/// Films between balls that may slide.
const SLIDING_FILMS: &[Condition] = &[
    kind(&["films", "grease and films"]),
    Condition::new("bearing.fidelity", &["planar"])
        .because("where the balls roll no traction is computed"),
];

const fn start(values: &'static [&'static str]) -> Condition {
    Condition::new("bearing.lubricant_state.start", values)
}

const AFTER_REST: &[Condition] = &[start(&["after rest"])];
const GIVEN: &[Condition] = &[start(&["given"])];

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("bearing.lubricant_state.kind", Kind::Word(StateKind::WORDS), "grease", "What changes: none; grease, which builds up over the angle the cage turns and breaks down over time; films, which warm by their own friction; or both.")
        .default("none", "friction and traction are those of their laws at all times unless asked for"),
    Key::new("bearing.lubricant_state.rested_factor", Kind::Coefficient, "0.3", "Drag of a rested or fresh grease over that of the law: below 1 where it lies beside the contacts, above 1 where it is churned.")
        .positive().when(GREASE),
    Key::new("bearing.lubricant_state.build_up_turns", Kind::Coefficient, "0.7", "Turns of the cage over which the grease comes to 63 % of the drag of the law; 0.1 to 3 explain what is measured.")
        .within(Range::FromTo(0.001, 1e6)).when(GREASE),
    Key::new("bearing.lubricant_state.worked_factor", Kind::Coefficient, "0.7", "Drag of a grease worked for long over that of the law.")
        .positive().when(GREASE),
    Key::new("bearing.lubricant_state.breakdown_time", Kind::Quantity("s"), "3.5 s", "Time of turning over which the grease is worked to 63 %; 0.8 s to 4 s explain what is measured.")
        .positive().when(GREASE),
    Key::new("bearing.lubricant_state.recovery_time", Kind::Quantity("s"), "600 s", "Time at rest over which build-up and breakdown fall to 37 %.")
        .positive().when(GREASE),
    Key::new("bearing.lubricant_state.start", Kind::Word(StateStart::WORDS), "rested", "Grease at time 0: rested, fresh or long at rest; worked, built up and broken down; after rest, worked before a rest of rest_before; given, by initial_build_up and initial_breakdown.")
        .default("rested", "an auxiliary bearing stands still until it is needed").when(GREASE),
    Key::new("bearing.lubricant_state.rest_before", Kind::Quantity("s"), "300 s", "Time at rest before time 0, after long work.")
        .not_negative().when(AFTER_REST),
    Key::new("bearing.lubricant_state.initial_build_up", Kind::Coefficient, "0.5", "Build-up at time 0: 0 rested, 1 at the level of the law.")
        .within(Range::FromTo(0.0, 1.0)).when(GIVEN),
    Key::new("bearing.lubricant_state.initial_breakdown", Kind::Coefficient, "0.5", "Breakdown at time 0: 0 rested, 1 worked for long.")
        .within(Range::FromTo(0.0, 1.0)).when(GIVEN),
    Key::new("bearing.lubricant_state.film_heat_capacity", Kind::Quantity("J/K"), "0.5 J/K", "Heat capacity of what warms with the films: they and the skin of the steel.")
        .positive().when(FILMS),
    Key::new("bearing.lubricant_state.film_conductance", Kind::Quantity("W/K"), "0.25 W/K", "Heat that flows from the films to the bulk of the bearing per kelvin; film_heat_capacity over it is the time constant.")
        .positive().when(FILMS),
    Key::new("bearing.lubricant_state.drag_temperature_coefficient", Kind::Quantity("1/K"), "0.03 1/K", "Relative fall of the drag per kelvin of the films: two thirds of that of the viscosity, 0.02 to 0.04 per kelvin for oils near 60 degC.")
        .not_negative().when(FILMS),
    Key::new("bearing.lubricant_state.traction_temperature_coefficient", Kind::Quantity("1/K"), "0.005 1/K", "Relative fall of the traction coefficient per kelvin of the films.")
        .not_negative().default("0 1/K", "traction stays that of its law unless its fall is known").when(SLIDING_FILMS),
];
