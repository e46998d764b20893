//! What the pages that name results need to know.

use crate::bearing::feedback::Renewals;
use crate::bearing::quantities::BearingSetup;
use crate::bearing::run::BearingRun;
use crate::bearing::warm::{Followed, Heated};
use crate::drop::build::Built;
use crate::drop::ensemble::Finished;
use crate::drop::feedback::Warmed;
use crate::drop::shaft::BuiltShaft;
use crate::drop::{Drop, Shaft};
use model::auxiliary_bearing::probe;
use model::system::energy::{Balance, Content, Flows};
use model::system::machine::RotorMachine;
use model::system::machine::record::BearingRecord;
use model::system::sampling::Peak;
use scenario::AuxiliaryBearing;

/// A drop before its run.
#[derive(Clone, Copy)]
pub(crate) struct Setup<'a> {
    pub built: &'a Built,
    pub machine: &'a RotorMachine,
}

impl<'a> Setup<'a> {
    /// The drop with the model of its rotor.
    pub fn drop(self) -> &'a Drop {
        &self.built.drop
    }
    /// A rotor that bends, with its coordinates.
    pub fn bent(self) -> Option<(&'a Shaft, &'a BuiltShaft)> {
        Some((self.drop().shaft.as_deref()?, self.built.shaft.as_ref()?))
    }
    /// The names of the bearings; one without a name where it is the only one.
    pub fn parts(self) -> impl Iterator<Item = &'a str> {
        let parts = self.machine.constants.bearings.iter();
        parts.map(|part| part.name.as_str())
    }
    /// What the scenario says of a bearing.
    pub fn given(self, bearing: usize) -> &'a AuxiliaryBearing {
        &self.drop().auxiliary_bearings[bearing]
    }
    /// The rotor whose magnets have controllers that act in time.
    pub fn controlled(self) -> Option<&'a Shaft> {
        let shaft = self.drop().shaft.as_deref();
        shaft.filter(|_| self.machine.controlled())
    }
    /// A bearing whose temperatures are followed.
    pub fn heated(self, k: usize) -> Option<Heated<'a>> {
        let given = self.given(k);
        let part = self.machine.constants.bearings[k].warm.as_deref();
        Heated::of(given.warm.as_deref(), given.bearing.as_ref()?, part)
    }
    /// The balls of a bearing; none of a bushing.
    pub fn balls(self, k: usize) -> Option<BearingSetup<'a>> {
        Some(BearingSetup {
            given: self.given(k).bearing.as_ref()?,
            constants: &self.machine.constants.bearings[k].bearing,
            factors: &self.built.bearings[k].pressure_factors,
        })
    }
    /// A bearing as it is before a run.
    pub fn bearing(self, k: usize) -> BearingRun<'a> {
        let at = &self.machine.layout().bearings[k];
        BearingRun {
            bearing: &self.machine.constants.bearings[k].bearing,
            states: at.own(),
            detail: at.detail,
            largest_loads: [probe::LARGEST_INNER_LOAD, probe::LARGEST_OUTER_LOAD]
                .map(|kind| at.probe(kind)),
            cage_forces: [probe::LARGEST_POCKET_FORCE, probe::LAND_FORCE]
                .map(|kind| at.probe(kind)),
            pressure_factors: self.built.bearings[k].pressure_factors,
            loads: [Peak::NONE; 2],
            cage: [Peak::NONE; 2],
            part: &self.machine.constants.bearings[k].name,
            layout: self.machine.layout(),
            end: &[],
            motion: Box::new(move |state| at.motion(state)),
            rows: Vec::new(),
            races: None,
        }
    }
}

/// Everything the pages that name results need to know.
pub(crate) struct Context<'a> {
    pub setup: Setup<'a>,
    pub finished: &'a Finished,
    pub members: usize,
}

impl<'a> Context<'a> {
    /// When the first magnet, axis or all power is lost, s; none where the magnets keep it to the end.
    pub fn release_time(&self) -> Option<f64> {
        match self.setup.controlled() {
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
        let spin = self.setup.machine.layout().rotor.spin();
        let now = self
            .setup
            .controlled()
            .map(|_| self.finished.ending.state[spin]);
        lost.or(now).unwrap_or(self.setup.drop().rotor.speed).abs()
    }
    pub fn record(&self, bearing: usize) -> &'a BearingRecord {
        &self.finished.record.bearings[bearing]
    }
    /// A bearing whose temperatures were followed.
    pub fn followed(&self, k: usize) -> Option<Followed<'a>> {
        let warmed = self.finished.warmed.as_deref();
        Some(Followed {
            heated: self.setup.heated(k)?,
            warmth: self.record(k).warmth.as_deref()?,
            state: warmed.and_then(|warmed| warmed.state(k)),
            broken: warmed.and_then(Warmed::broken),
        })
    }
    /// Energies and flows at the release.
    pub fn at_start(&self) -> (Content, Flows) {
        let start = &self.finished.start;
        (
            self.setup.machine.content(start),
            self.setup.machine.flows(start),
        )
    }
    /// The same at an instant of the run; rings that have closed on their balls have done work.
    pub fn booked(&self, time: f64, content: Content, state: &[f64]) -> (Content, Flows) {
        let found = (content, self.setup.machine.flows(state));
        match self.renewals() {
            Some(renewals) => renewals.booked(time, found),
            None => found,
        }
    }
    /// Energy and angular momentum from the release to the end.
    pub fn balance(&self) -> Balance {
        let ending = &self.finished.ending;
        let renewals = self.renewals();
        let machine = renewals.map_or(self.setup.machine, |renewals| {
            renewals.machine(self.setup.machine)
        });
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
        let record = self.record(bearing);
        BearingRun {
            loads: [record.largest_inner_load, record.largest_outer_load],
            cage: [record.largest_pocket_force, record.largest_land_force],
            end: &self.finished.ending.state,
            rows: self.finished.record.rows().collect(),
            races: record.races.as_ref(),
            ..self.setup.bearing(bearing)
        }
    }
}

/// What exists of a rotor that touched the inner race.
pub(super) fn touched<T>(value: Option<T>) -> Result<T, String> {
    value.ok_or_else(|| "rotor and inner race never touched in this run".to_string())
}
