//! What the pages that name results need to know.

use crate::scenario::{AuxiliaryBearing, Drop};
use crate::simulate::bearing::run::BearingRun;
use crate::simulate::drop::build::Built;
use crate::simulate::drop::ensemble::Finished;
use model::auxiliary_bearing::probe;
use model::system::machine::RotorMachine;
use model::system::machine::record::BearingRecord;

/// Everything the pages that name results need to know.
pub(crate) struct Context<'a> {
    pub drop: &'a Drop,
    pub built: &'a Built,
    pub machine: &'a RotorMachine,
    pub finished: &'a Finished,
    pub members: usize,
}

impl<'a> Context<'a> {
    /// The names of the bearings; one without a name where it is the only one.
    pub fn parts(&self) -> impl Iterator<Item = &'a str> {
        let parts = self.machine.constants.bearings.iter();
        parts.map(|part| part.name.as_str())
    }
    /// What the scenario says of a bearing.
    pub fn given(&self, bearing: usize) -> &'a AuxiliaryBearing {
        &self.drop.auxiliary_bearings[bearing]
    }
    pub fn record(&self, bearing: usize) -> &'a BearingRecord {
        &self.finished.record.bearings[bearing]
    }
    pub fn bearing(&self, bearing: usize) -> BearingRun<'a> {
        let at = self.machine.layout().bearings[bearing];
        BearingRun {
            bearing: &self.machine.constants.bearings[bearing].bearing,
            states: at.own(),
            detail: at.detail,
            largest_loads: [probe::LARGEST_INNER_LOAD, probe::LARGEST_OUTER_LOAD]
                .map(|kind| at.probe(kind)),
            cage_forces: [probe::LARGEST_POCKET_FORCE, probe::LAND_FORCE]
                .map(|kind| at.probe(kind)),
            pressure_factors: self.built.bearings[bearing].pressure_factors,
            motion: Box::new(move |state| at.motion(state)),
            rows: self.finished.record.rows().collect(),
        }
    }
}
