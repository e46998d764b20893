//! What watches the steps of a machine: a record, and what of the machine follows its temperatures.

use crate::ensemble::{Finished, Member};
use crate::following::{Following, Now, Warmed};
use model::system::machine::record::Record;
use model::system::machine::{Mode, RotorMachine};
use solve::{Ending, Flow, Observer, Step};
use std::sync::Arc;

/// A record, with the machine as its temperatures have made it.
#[derive(Clone)]
pub(crate) struct Watch {
    pub record: Record,
    following: Option<Arc<Following>>,
    /// The machine as it is now, where it was another one at the start.
    now: Option<Box<RotorMachine>>,
    unbalances: u16,
    warmed: Option<Box<Warmed>>,
    /// Until when temperatures were known when they were last looked at, s.
    looked: f64,
}

impl Watch {
    pub fn of(member: &Member, record: Record) -> Self {
        Watch {
            record,
            following: member.following.clone(),
            now: None,
            unbalances: 0,
            warmed: (member.following.is_some()).then(Box::default),
            looked: 0.0,
        }
    }
    /// The same with a record of an instant alone, s.
    pub fn at(&mut self, machine: &RotorMachine, time: f64, state: &[f64]) -> Self {
        let machine = self.now.as_deref().unwrap_or(machine);
        Watch {
            record: self.record.now(machine, time, state),
            following: None,
            now: self.now.clone(),
            unbalances: self.unbalances,
            warmed: self.warmed.clone(),
            looked: self.looked,
        }
    }
    pub fn finish(self, ending: Ending, member: &Member) -> Finished {
        let mut record = self.record;
        let machine = member.machine.clone();
        let at_end = self.now.as_deref().unwrap_or(&machine);
        record.finish(at_end, ending.time, &ending.state);
        let start = member.start.clone();
        Finished {
            begun: (machine.content(&start), machine.flows(&start)),
            machine,
            start,
            record,
            now: self.now,
            warmed: self.warmed,
            ending,
        }
    }
}

impl Observer<RotorMachine> for Watch {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        let flow = self.record.step(step);
        let (Flow::Continue, Some(following), Some(warmed)) = (flow, &self.following, &self.warmed)
        else {
            return flow;
        };
        let now = |k| now(&self.record, step.machine, k);
        let known = (self.record.bearings.iter())
            .filter_map(|bearing| Some(bearing.warmth.as_ref()?.known_until()));
        let known = known.fold(0.0, f64::max);
        let is_new = known > self.looked;
        self.looked = known;
        match is_new && following.is_due(warmed, &now) || following.rubs(&now) {
            true => Flow::Renew,
            false => Flow::Continue,
        }
    }
    fn renewed(
        &mut self,
        machine: &RotorMachine,
        time: f64,
        state: &[f64],
    ) -> Option<Box<RotorMachine>> {
        let (following, warmed) = (self.following.as_ref()?, self.warmed.as_mut()?);
        let now = |k| now(&self.record, machine, k);
        let new = following.renewed(warmed, machine, (time, state), &now)?;
        self.now = Some(new.clone());
        Some(new)
    }
    fn switched(
        &mut self,
        machine: &RotorMachine,
        mode: &Mode<f64>,
        time: f64,
        state: &[f64],
    ) -> Flow {
        if mode.unbalances != self.unbalances {
            self.unbalances = mode.unbalances;
            self.now = Some(Box::new(machine.clone()));
        }
        self.record.switched(machine, mode, time, state)
    }
}

/// Temperatures of a bearing, where they are followed.
fn now<'a>(record: &'a Record, machine: &RotorMachine, bearing: usize) -> Option<Now<'a>> {
    let kept = &record.bearings[bearing];
    let warmth = kept.warmth.as_ref()?;
    Some(Now {
        nodes: &warmth.temperatures,
        spin: warmth.spin(),
        contact: kept.heat.as_ref().map_or(0.0, |heat| heat.rise),
        friction: machine.constants.bearings[bearing].contact.friction,
    })
}
