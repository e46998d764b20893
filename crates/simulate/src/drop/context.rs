//! What the pages that name results need to know.

use crate::bearing::quantities::BearingSetup;
use crate::bearing::run::BearingRun;
use crate::bearing::warm::{Followed, Heated};
use crate::drop::build::DropModel;
use crate::drop::shaft::BuiltShaft;
use crate::drop::{Drop, Shaft};
use crate::ensemble::Finished;
use model::system::machine::record::BearingRecord;
use model::system::machine::{MOST_SPEEDS, RotorMachine};
use scenario::AuxiliaryBearing;

/// A bounce through a clearance lasts no longer, s.
pub(super) const BOUNCE: f64 = 0.05;

/// A drop before its run.
#[derive(Clone, Copy)]
pub(crate) struct Setup<'a> {
    pub built: &'a DropModel,
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
        BearingRun::before(self.machine, k, self.built.bearings[k].pressure_factors)
    }
}

/// Everything the pages that name results need to know.
pub(crate) struct Context<'a> {
    pub setup: Setup<'a>,
    pub finished: &'a Finished,
    pub repeated: bool,
    /// When the rotor came to each of the speeds at which something happens, s; infinite where it did not.
    pub reached: [f64; MOST_SPEEDS],
    /// End of the run with the coast-down behind it, s.
    pub end: f64,
}

impl<'a> Context<'a> {
    /// When the first magnet, axis or all power is lost, s; none where the magnets keep it to the end.
    pub fn release_time(&self) -> Option<f64> {
        match self.setup.controlled() {
            Some(_) => self.finished.record.released.map(|(time, _)| time),
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
        let lost = self.finished.record.released.map(|(_, spin)| spin);
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
        self.finished.followed(self.setup.heated(k), k)
    }
    pub fn bearing(&self, k: usize) -> BearingRun<'a> {
        self.setup.bearing(k).after(self.finished, k)
    }
    /// The speed of the race over that of the rotor, where the rotor touches it at the end, or may soon again, and slips.
    pub fn slips_at_end(&self, k: usize) -> Option<f64> {
        let layout = self.setup.machine.layout();
        let state = &self.finished.ending.state;
        let speed = |channel: usize| state[channel].abs();
        let share = speed(layout.bearings[k].inner.spin()) / speed(layout.rotor.spin());
        let record = self.record(k);
        let contacts = &record.contacts;
        let pause = |from: Option<f64>, to: f64| from.map_or(0.0, |from| to - from);
        let pauses = contacts.windows(2);
        let pauses = pauses.map(|two| pause(two[0].end, two[1].start));
        let longest = pauses.fold(BOUNCE, f64::max);
        let now = contacts.last();
        let now = now.map(|last| pause(last.end, self.end));
        let in_bore = now.is_some_and(|now| now <= longest);
        let face = (record.spatial.as_deref()).and_then(|own| own.last_axial_contact);
        let on_face = face.is_some_and(|last| self.end - last <= BOUNCE);
        (share < 0.95 && (in_bore || on_face)).then_some(share)
    }
}

/// What exists of a rotor that touched the inner race.
pub(super) fn touched<T>(value: Option<T>) -> Result<T, String> {
    value.ok_or_else(|| "rotor and inner race never touched in this run".to_string())
}
