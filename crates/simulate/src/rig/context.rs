//! What the pages that name results need to know.

use crate::bearing::run::BearingRun;
use crate::bearing::warming::Warming;
use crate::rig::build::Built;
use crate::rig::thermocouple::Bead;
use model::system::energy::{Balance, Content};
use model::system::rig::layout::{
    DETAIL, LAND_FORCE, LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE,
};
use model::system::rig::rate::race_motion;
use model::system::rig::{Record, RigMachine};
use model::system::sampling::Peak;
use scenario::Rig;
use solve::Ending;

/// Everything the pages that name results need to know.
pub(crate) struct Context<'a> {
    pub rig: &'a Rig,
    pub built: &'a Built,
    pub start: &'a [f64],
    pub record: &'a Record,
    pub ending: &'a Ending,
    /// How warm the bearing became; none where no network follows that.
    pub warming: Option<&'a Warming<'a, RigMachine>>,
    /// What the thermocouple reads of that.
    pub bead: Option<&'a Bead>,
    /// Values that the converter could not hold, with the channel's name.
    pub clipped: Vec<(&'static str, usize)>,
}

impl<'a> Context<'a> {
    /// What must close between the start and a row, or the end.
    pub fn balance(&self, time: f64, content: Content, state: &[f64]) -> Balance {
        let machine = &self.built.machine;
        let end = (content, machine.flows(state));
        Balance {
            start: (machine.content(self.start), machine.flows(self.start)),
            end: match self.warming {
                Some(warming) => warming.renewals.booked(time, end),
                None => end,
            },
        }
    }
    /// The machine as it is at the end.
    pub fn machine_at_end(&self) -> &'a RigMachine {
        let machine = &self.built.machine;
        (self.warming).map_or(machine, |warming| warming.renewals.machine(machine))
    }
    /// What must close between the start and the end.
    pub fn whole_balance(&self) -> Balance {
        let end = &self.ending.state;
        self.balance(f64::INFINITY, self.machine_at_end().content(end), end)
    }
    pub fn bearing(&self) -> BearingRun<'a> {
        let record = self.record;
        BearingRun {
            loads: [record.largest_inner_load, record.largest_outer_load],
            cage: [record.largest_pocket_force, Peak::NONE],
            end: &self.ending.state,
            rows: record.rows().collect(),
            races: Some(&record.races),
            ..bearing(self.built)
        }
    }
}

/// The bearing as it is before a run.
pub(crate) fn bearing(built: &Built) -> BearingRun<'_> {
    BearingRun {
        bearing: &built.machine.constants.bearing,
        states: built.machine.layout().bearing(),
        detail: DETAIL,
        largest_loads: [LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD],
        cage_forces: [LARGEST_POCKET_FORCE, LAND_FORCE],
        pressure_factors: built.pressure_factors,
        loads: [Peak::NONE; 2],
        cage: [Peak::NONE; 2],
        part: "",
        layout: built.machine.layout(),
        end: &[],
        motion: Box::new(race_motion),
        rows: Vec::new(),
        races: None,
    }
}
