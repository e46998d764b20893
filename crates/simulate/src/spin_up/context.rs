//! What the pages that name results need to know.

use crate::bearing::run::BearingRun;
use crate::bearing::warming::Warming;
use crate::spin_up::build::Built;
use crate::stepping::Asked;
use model::system::energy::{Balance, Content};
use model::system::sampling::Peak;
use model::system::spin_up::SpinUpMachine;
use model::system::spin_up::layout::{
    DETAIL, LAND_FORCE, LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE,
};
use model::system::spin_up::rate::race_motion;
use model::system::spin_up::record::Record;
use scenario::SpinUp;
use solve::Ending;

/// Everything the pages that name results need to know.
pub(crate) struct Context<'a> {
    pub spin_up: &'a SpinUp,
    pub built: &'a Built,
    pub start: &'a [f64],
    pub record: &'a Record,
    pub ending: &'a Ending,
    /// How warm the bearing became; none where that is not followed.
    pub warming: Option<&'a Warming<'a, SpinUpMachine>>,
}

impl<'a> Context<'a> {
    pub fn machine(&self) -> &'a SpinUpMachine {
        &self.built.machine
    }
    /// What must close between the start and a row, or the end.
    pub fn balance(&self, time: f64, content: Content, state: &[f64]) -> Balance {
        let machine = self.machine();
        let end = (content, machine.flows(state));
        Balance {
            start: (machine.content(self.start), machine.flows(self.start)),
            end: match self.warming {
                Some(warming) => warming.renewals.booked(time, end),
                None => end,
            },
        }
    }
    /// The same until the end.
    pub fn whole_balance(&self) -> Balance {
        let (machine, state) = (self.machine(), &self.ending.state);
        let renewals = self.warming.map(|warming| &warming.renewals);
        let machine = renewals.map_or(machine, |renewals| renewals.machine(machine));
        self.balance(f64::INFINITY, machine.content(state), state)
    }
    pub fn bearing(&self) -> BearingRun<'a> {
        let record = self.record;
        BearingRun {
            loads: [record.largest_inner_load, record.largest_outer_load],
            cage: [record.largest_pocket_force, record.largest_land_force],
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

/// Tolerance of design accuracy: the energies of the shipped spin-ups close to a millionth of what is turned over.
const DESIGN: f64 = 5e-5;
/// Tolerance of linearly implicit steps at screening accuracy: what friction takes is as small as the creep of the balls.
const SCREENING: f64 = 2e-3;

/// What decides the steps of a spin-up.
pub(crate) fn asked<'a>(spin_up: &'a SpinUp, built: &Built) -> Asked<'a> {
    Asked {
        run: &spin_up.run,
        known: built.machine.tangents(),
        bends: false,
        design: [DESIGN; 2],
        screening: SCREENING,
    }
}
