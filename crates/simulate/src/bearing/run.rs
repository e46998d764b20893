//! The bearing of a run: what it is made of, and where it stands in the rows.

use crate::bearing::pressure::{PressureFactors, Pressures};
use model::bearing::BearingConstants;
use model::motion::Motion;
use model::system::layout::Layout;
use model::system::race_record::RaceRecord;
use model::system::sampling::{Peak, Row};
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
    /// Largest loads of a ball at the inner and the outer race.
    pub loads: [Peak; 2],
    /// Largest forces of pockets, or between balls without a cage, and at the land.
    pub cage: [Peak; 2],
    /// Name of its part.
    pub part: &'a str,
    /// Where everything stands in a state of the system.
    pub layout: &'a Layout,
    /// The state at the end.
    pub end: &'a [f64],
    /// Motion of the races in a state of the system.
    pub motion: MotionAt<'a>,
    pub rows: Vec<Row<'a>>,
    /// What the races have seen of their balls; none of a bushing.
    pub races: Option<&'a RaceRecord>,
}

impl BearingRun<'_> {
    /// What a kind of heat has summed up at the end, J.
    pub fn heat(&self, kind: &str) -> f64 {
        (self.layout.heat_of(self.end, self.part, kind)).unwrap_or(0.0)
    }
    /// What the balls lost sliding on the inner and on the outer race, J.
    pub fn slips(&self) -> [f64; 2] {
        ["inner_ball_slip", "outer_ball_slip"].map(|kind| self.heat(kind))
    }
    /// Largest Hertz pressures.
    pub fn pressures(&self) -> Pressures {
        (self.pressure_factors).pressures(self.loads, self.cage[0])
    }
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
