//! What the pages that name results need to know.

use crate::scenario::{AuxiliaryBearing, Drop, Shaft};
use crate::simulate::bearing::feedback::Renewals;
use crate::simulate::bearing::run::BearingRun;
use crate::simulate::bearing::warm::Followed;
use crate::simulate::drop::build::Built;
use crate::simulate::drop::ensemble::Finished;
use crate::simulate::drop::feedback::Warmed;
use model::auxiliary_bearing::probe;
use model::system::energy::{Balance, Content, Flows};
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
    /// The rotor whose magnets have controllers that act in time.
    pub fn controlled(&self) -> Option<&'a Shaft> {
        let shaft = self.drop.shaft.as_deref();
        shaft.filter(|_| self.machine.controlled())
    }
    /// When the first magnet, axis or all power is lost, s; none where the magnets keep it to the end.
    pub fn release_time(&self) -> Option<f64> {
        match self.controlled() {
            Some(given) => self.finished.record.released.map(|_| given.power_lost),
            None => Some(0.0),
        }
    }
    /// Where instants after the release count from, s: without one from the start.
    pub fn counted_from(&self) -> f64 {
        self.release_time().unwrap_or(0.0)
    }
    /// Size of the spin at which the rotor is released, rad/s: at the start, or when its magnets lose their power; at the end where they
    /// have it still.
    pub fn release_speed(&self) -> f64 {
        let lost = self.finished.record.released;
        let spin = self.machine.layout().rotor.spin();
        let now = self.controlled().map(|_| self.finished.ending.state[spin]);
        lost.or(now).unwrap_or(self.drop.rotor.speed).abs()
    }
    pub fn record(&self, bearing: usize) -> &'a BearingRecord {
        &self.finished.record.bearings[bearing]
    }
    /// A bearing whose temperatures were followed.
    pub fn followed(&self, k: usize) -> Option<Followed<'a>> {
        let given = self.given(k);
        let warmed = self.finished.warmed.as_deref();
        Some(Followed {
            given: given.warm.as_deref()?,
            bearing: given.bearing.as_ref()?,
            part: self.machine.constants.bearings[k].warm.as_deref()?,
            warmth: self.record(k).warmth.as_deref()?,
            state: warmed.and_then(|warmed| warmed.state(k)),
            broken: warmed.and_then(Warmed::broken),
        })
    }
    /// Energies and flows at the release.
    pub fn at_start(&self) -> (Content, Flows) {
        let start = &self.finished.start;
        (self.machine.content(start), self.machine.flows(start))
    }
    /// The same at an instant of the run; rings that have closed on their balls have done work.
    pub fn booked(&self, time: f64, content: Content, state: &[f64]) -> (Content, Flows) {
        let found = (content, self.machine.flows(state));
        match self.renewals() {
            Some(renewals) => renewals.booked(time, found),
            None => found,
        }
    }
    /// Energy and angular momentum from the release to the end.
    pub fn balance(&self) -> Balance {
        let ending = &self.finished.ending;
        let renewals = self.renewals();
        let machine = renewals.map_or(self.machine, |renewals| renewals.machine(self.machine));
        let content = machine.content(&ending.state);
        Balance {
            start: self.at_start(),
            end: self.booked(f64::INFINITY, content, &ending.state),
        }
    }
    /// The machines that it has been; none where nothing follows.
    pub fn renewals(&self) -> Option<&'a Renewals<RotorMachine>> {
        let warmed = self.finished.warmed.as_deref();
        warmed.map(|warmed| &warmed.renewals)
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
            races: self.record(bearing).races.as_ref(),
        }
    }
}
