//! The bearing of a run: what it is made of, and where it stands in the rows.

use super::film::{self, Films};
use super::skid::{Skidding, Skids};
use crate::scenario::Bearing;
use model::bearing::BearingConstants;
use model::motion::Motion;
use model::system::sampling::{Peak, Row};
use physics::hertz::maximum_pressure;
use std::ops::Range;

/// Hertz pressure in the contacts of a ball per cube root of their load, Pa/N^(1/3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressureFactors {
    /// At the inner and at the outer race.
    pub races: [f64; 2],
    /// Between neighbouring balls; none where a cage keeps them apart.
    pub neighbours: Option<f64>,
}

impl PressureFactors {
    /// The pressures under the largest loads at the inner and the outer race and between balls, N.
    pub fn pressures(&self, races: [Peak; 2], neighbours: Peak) -> Pressures {
        let [inner, outer] = self.races;
        let of = |factor: f64, load: Peak| maximum_pressure(factor, load.value);
        Pressures {
            races: of(inner, races[0]).max(of(outer, races[1])),
            neighbours: self.neighbours.map(|factor| of(factor, neighbours)),
        }
    }
}

/// Largest Hertz pressures by what touches the balls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressures {
    /// Of balls and races, Pa.
    pub races: f64,
    /// Of neighbouring balls, Pa; none where a cage keeps them apart.
    pub neighbours: Option<f64>,
}

impl Pressures {
    /// The larger of each.
    pub fn or(self, other: Pressures) -> Pressures {
        Pressures {
            races: self.races.max(other.races),
            neighbours: (self.neighbours.zip(other.neighbours)).map(|(own, other)| own.max(other)),
        }
    }
    /// Between neighbouring balls, with its limit, Pa.
    pub fn of_neighbours(&self, bearing: &Bearing) -> Option<(f64, f64)> {
        self.neighbours.zip(bearing.neighbour_pressure_limit())
    }
    /// The largest share of a limit: each pressure by the limit of what touches there.
    pub fn share_of_limit(&self, bearing: &Bearing) -> f64 {
        let neighbours = self
            .of_neighbours(bearing)
            .map_or(0.0, |(p, limit)| p / limit);
        (self.races / bearing.hertz_pressure_limit).max(neighbours)
    }
}

/// The bearing of a run.
pub(super) struct BearingRun<'a> {
    pub bearing: &'a BearingConstants,
    /// The bearing's own channels.
    pub states: Range<usize>,
    /// First probe of the detail of the balls.
    pub detail: usize,
    /// Probes of the largest ball loads at the inner and the outer race.
    pub largest_loads: [usize; 2],
    /// Probes of the largest pocket force and of the force at the land.
    pub cage_forces: [usize; 2],
    pub pressure_factors: PressureFactors,
    /// Motion of the races in a state of the system.
    pub motion: fn(&[f64]) -> Motion<f64>,
    pub rows: Vec<Row<'a>>,
}

impl<'a> BearingRun<'a> {
    /// The bearing's own states in a state of the system.
    pub fn own<'s>(&self, state: &'s [f64]) -> &'s [f64] {
        &state[self.states.clone()]
    }
    /// The films between balls and races, where traction is theirs.
    pub fn films(&self) -> Option<film::Summary> {
        Films::of(self).map(|films| films.summary())
    }
    /// Where the balls slide, where they may.
    pub fn skids(&self) -> Option<Skidding> {
        Skids::of(self).map(|skids| skids.summary())
    }
    /// Largest speed of the inner race in the rows, rad/s.
    pub fn fastest(&self) -> f64 {
        (self.rows.iter())
            .map(|row| self.speed(row))
            .fold(0.0, f64::max)
    }
    /// Speed of the inner race in a row, rad/s.
    pub fn speed(&self, row: &Row) -> f64 {
        (self.motion)(row.state).inner.spin.abs()
    }
    /// Largest rise of the films' temperature in the rows, K; 0 where the lubricant has no state.
    pub fn largest_film_rise(&self) -> f64 {
        (self.rows.iter())
            .filter_map(|row| self.bearing.lubricant_at(self.own(row.state)))
            .map(|at| at.film_temperature_rise)
            .fold(0.0, f64::max)
    }
}
