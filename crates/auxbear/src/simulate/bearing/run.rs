//! The bearing of a run: what it is made of, and where it stands in the rows.

use crate::simulate::bearing::pressure::PressureFactors;
use model::bearing::BearingConstants;
use model::motion::Motion;
use model::system::race_record::RaceRecord;
use model::system::sampling::Row;
use std::ops::Range;

/// Motion of the races in a state of a system.
pub(crate) type MotionAt<'a> = Box<dyn Fn(&[f64]) -> Motion<f64> + 'a>;

/// The bearing of a run.
pub(crate) struct BearingRun<'a> {
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
    pub motion: MotionAt<'a>,
    pub rows: Vec<Row<'a>>,
    /// What the races have seen of their balls; none of a bushing.
    pub races: Option<&'a RaceRecord>,
}

impl<'a> BearingRun<'a> {
    /// The bearing's own states in a state of the system.
    pub fn own<'s>(&self, state: &'s [f64]) -> &'s [f64] {
        &state[self.states.clone()]
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
