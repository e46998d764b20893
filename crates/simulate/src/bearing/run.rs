//! The bearing of a run: what it is made of, and where it stands in the rows.

use crate::bearing::pressure::{PressureFactors, Pressures};
use crate::ensemble::Finished;
use model::auxiliary_bearing::BearingAt;
use model::bearing::BearingConstants;
use model::motion::Motion;
use model::system::machine::RotorMachine;
use model::system::machine::record::BearingRecord;
use model::system::sampling::{Peak, Row};

/// The bearing of a run.
pub(crate) struct BearingRun<'a> {
    pub bearing: &'a BearingConstants,
    machine: &'a RotorMachine,
    /// Where it stands in the machine.
    pub at: &'a BearingAt,
    /// Name of its part.
    part: &'a str,
    pub pressure_factors: PressureFactors,
    /// What was kept of it; none before a run.
    pub record: Option<&'a BearingRecord>,
    /// The state at the end.
    pub end: &'a [f64],
    pub rows: Vec<Row<'a>>,
}

impl<'a> BearingRun<'a> {
    /// A bearing of a machine before a run.
    pub fn before(machine: &'a RotorMachine, k: usize, pressure_factors: PressureFactors) -> Self {
        let part = &machine.constants.bearings[k];
        BearingRun {
            bearing: &part.bearing,
            machine,
            at: &machine.layout().bearings[k],
            part: &part.name,
            pressure_factors,
            record: None,
            end: &[],
            rows: Vec::new(),
        }
    }
    /// The same after it.
    pub fn after(self, finished: &'a Finished, k: usize) -> Self {
        BearingRun {
            record: Some(&finished.record.bearings[k]),
            end: &finished.ending.state,
            rows: finished.record.rows().collect(),
            ..self
        }
    }
    /// Largest loads of a ball at the inner and the outer race; largest forces of pockets, or between balls without a cage, and at the land.
    pub fn peaks(&self) -> [Peak; 4] {
        self.record.map_or([Peak::NONE; 4], |record| {
            [
                record.largest_inner_load,
                record.largest_outer_load,
                record.largest_pocket_force,
                record.largest_land_force,
            ]
        })
    }
    /// Motion of the races in a state.
    pub fn motion(&self, state: &[f64]) -> Motion<f64> {
        self.at.motion(state)
    }
    /// What a kind of heat has summed up at the end, J.
    pub fn heat(&self, kind: &str) -> f64 {
        let layout = self.machine.layout();
        (layout.heat_of(self.end, self.part, kind)).unwrap_or(0.0)
    }
    /// What the balls lost sliding on the inner and on the outer race, J.
    pub fn slips(&self) -> [f64; 2] {
        ["inner_ball_slip", "outer_ball_slip"].map(|kind| self.heat(kind))
    }
    /// Largest Hertz pressures.
    pub fn pressures(&self) -> Pressures {
        let [inner, outer, pocket, _] = self.peaks();
        (self.pressure_factors).pressures([inner, outer], pocket)
    }
    /// The bearing's own states in a state of the system.
    pub fn own<'s>(&self, state: &'s [f64]) -> &'s [f64] {
        &state[self.at.own()]
    }
    /// Largest speed of the inner race in the rows, rad/s.
    pub fn fastest(&self) -> f64 {
        (self.rows.iter())
            .map(|row| self.speed(row))
            .fold(0.0, f64::max)
    }
    /// Speed of the inner race in a row, rad/s.
    pub fn speed(&self, row: &Row) -> f64 {
        self.motion(row.state).inner.spin.abs()
    }
    /// Largest rise of the films' temperature in the rows, K; 0 where the lubricant has no state.
    pub fn largest_film_rise(&self) -> f64 {
        (self.rows.iter())
            .filter_map(|row| self.bearing.lubricant_at(self.own(row.state)))
            .map(|at| at.film_temperature_rise)
            .fold(0.0, f64::max)
    }
}
