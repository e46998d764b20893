//! The slow state of the lubricant, as typed values in SI.

use crate::values::Values;
use physics::lubricant_state::{FilmHeating, Grease};
use problem::words;
use std::f64::consts::TAU;

words! {
    /// What of the lubricant changes, as a word.
    pub enum StateKind {
        /// Nothing.
        None = "none",
        Grease = "grease",
        /// Films that warm.
        Films = "films",
        /// Both.
        GreaseAndFilms = "grease and films",
    }
}

words! {
    /// The grease at the start, as a word.
    pub enum StateStart {
        /// Rested for long.
        Rested = "rested",
        /// Worked for long.
        Worked = "worked",
        /// After a rest of a given time.
        AfterRest = "after rest",
        /// As given.
        Given = "given",
    }
}

/// How the lubricant changes while the bearing turns and rests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LubricantState {
    /// A grease that builds up and breaks down.
    pub grease: Option<Grease<f64>>,
    /// Contact films that warm.
    pub films: Option<FilmHeating<f64>>,
    /// Build-up at the start, 0 to 1.
    pub build_up: f64,
    /// Breakdown at the start, 0 to 1.
    pub breakdown: f64,
}

impl LubricantState {
    /// None where nothing changes.
    pub fn from_values(values: &Values) -> Option<LubricantState> {
        let state = values.section("bearing.lubricant_state");
        let (greased, filmed) = match state.chosen("kind")? {
            StateKind::None => return None,
            StateKind::Grease => (true, false),
            StateKind::Films => (false, true),
            StateKind::GreaseAndFilms => (true, true),
        };
        let grease = greased.then(|| Grease {
            rested_factor: state.number("rested_factor"),
            build_up_angle: state.number("build_up_turns") * TAU,
            worked_factor: state.number("worked_factor"),
            breakdown_time: state.number("breakdown_time"),
            recovery_time: state.number("recovery_time"),
        });
        let films = filmed.then(|| FilmHeating {
            heat_capacity: state.number("film_heat_capacity"),
            conductance: state.number("film_conductance"),
            drag_coefficient: state.number("drag_temperature_coefficient"),
            // without effect where the balls roll
            traction_coefficient: (state.maybe("traction_temperature_coefficient")).unwrap_or(0.0),
        });
        let (build_up, breakdown) = match (grease, state.maybe("rest_before")) {
            (None, _) => (0.0, 0.0),
            (Some(grease), Some(time)) => (grease.rested(time), grease.rested(time)),
            (Some(_), None) => match state.choice("start") {
                StateStart::Rested | StateStart::AfterRest => (0.0, 0.0),
                StateStart::Worked => (1.0, 1.0),
                StateStart::Given => (
                    state.number("initial_build_up"),
                    state.number("initial_breakdown"),
                ),
            },
        };
        Some(LubricantState {
            grease,
            films,
            build_up,
            breakdown,
        })
    }
}
