//! A run of a bearing on a rig, of a spin-up or of a test: what it is built of, how it went, and what its pages of results need.

use crate::bearing::pressure::PressureFactors;
use crate::bearing::run::BearingRun;
use crate::bearing::steady::SteadyFinding;
use crate::ending::{settings_at, stop};
use crate::rig::warming::{Warming, Watched};
use crate::stepping::Stepping;
use model::bearing_heat::WarmBearing;
use model::system::energy::{Balance, Content};
use model::system::outer_race::OuterRaceEnergy;
use model::system::rig::layout::{
    DETAIL, LAND_FORCE, LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE,
};
use model::system::rig::simulate::Run as Simulation;
use model::system::rig::{Keep, Record, RigMachine, Tap, simulate};
use model::system::sampling::Peak;
use outcome::options::Options;
use outcome::{Outcome, Picture, Work};
use scenario::{Bearing, Run, Warm};
use solve::Ending;

/// A rig ready to be simulated.
#[derive(Clone, Debug)]
pub struct Built {
    /// The machine.
    pub machine: RigMachine,
    /// Rate of a clutch's torque, N m/s: as given, or found; none where none engages.
    pub torque_rate: Option<f64>,
    /// Hertz pressure in the contacts of a ball.
    pub pressure_factors: PressureFactors,
    /// The network of its temperatures, where that is followed.
    pub warm: Option<Box<WarmBearing>>,
    /// What traction can carry at full speed under the last load; none where the bearing has no steady moment.
    pub steady: Option<SteadyFinding>,
}

/// What a file gives of the bearing and of the run.
#[derive(Clone, Copy)]
pub(crate) struct RunInput<'a> {
    pub bearing: &'a Bearing,
    pub warm: Option<&'a Warm>,
    pub run: &'a Run,
}

/// A run.
pub(crate) struct RigRun<'a> {
    pub built: &'a Built,
    pub start: Vec<f64>,
    pub record: Record,
    pub ending: Ending,
    /// How warm the bearing became; none where no network follows that.
    pub warming: Option<Warming<'a>>,
    stepping: Stepping,
    /// The machine as it is at the end.
    at_end: RigMachine,
}

impl<'a> RigRun<'a> {
    /// Runs a rig.
    pub fn of(
        built: &'a Built,
        given: RunInput<'a>,
        stepping: Stepping,
        taps: &[Tap],
        options: &Options<'a>,
    ) -> Self {
        let machine = &built.machine;
        let settings = settings_at(given.run, stepping.tolerance);
        let keep = Keep {
            end: settings.end,
            interval: Some(given.run.output_interval),
            taps,
        };
        let record = Record::new(machine, &keep);
        let warming = Warming::of(given.warm, given.bearing, built.warm.as_deref());
        let mut watched = Watched::new(record, warming, settings.end, options);
        let start = machine.start();
        let ending = simulate(Simulation {
            machine,
            start: start.clone(),
            settings: &settings,
            steps: stepping.steps,
            observer: &mut watched,
            interrupt: options.interrupt,
        });
        let (mut record, warming, at_end) = watched.finish(machine, &ending);
        record.finish(&at_end, ending.time, &ending.state);
        RigRun {
            built,
            start,
            record,
            ending,
            warming,
            stepping,
            at_end,
        }
    }
    /// What must close between the start and a row, or the end.
    pub fn balance(&self, time: f64, content: Content, state: &[f64]) -> Balance {
        let machine = &self.built.machine;
        let end = (content, machine.flows(state));
        Balance {
            start: (machine.content(&self.start), machine.flows(&self.start)),
            end: match &self.warming {
                Some(warming) => warming.renewals.booked(time, end),
                None => end,
            },
        }
    }
    /// What must close between the start and the end.
    pub fn whole_balance(&self) -> Balance {
        let end = &self.ending.state;
        self.balance(f64::INFINITY, self.at_end.content(end), end)
    }
    /// What the bearing dissipated, J, true and by the forms of (21). Where rings closed on loaded balls, what is stored counts by the
    /// bearing as it was at either end, and the work of the rings is not heat.
    pub fn outer_race_energy(&self) -> OuterRaceEnergy {
        let (before, now) = (&self.built.machine, &self.at_end);
        let mut forms = now.outer_race_energy(&self.start, &self.ending.state);
        let stored = |machine: &RigMachine| machine.bearing_content(&self.start).sum();
        let work = |warming: &Warming| warming.renewals.work_until(f64::INFINITY);
        forms.exact += stored(before) - stored(now) + self.warming.as_ref().map_or(0.0, work);
        forms
    }
    /// A probe at the end.
    pub fn probe(&self, index: usize) -> f64 {
        let (time, state) = (self.ending.time, &self.ending.state);
        self.at_end.last_probes(&self.record.mode, time, state)[index]
    }
    /// A heat of the ledger at the end, J.
    pub fn heat(&self, kind: usize) -> f64 {
        self.ending.state[self.built.machine.layout().heat(kind)]
    }
    /// The bearing in the run.
    pub fn bearing(&self) -> BearingRun<'_> {
        let record = &self.record;
        BearingRun {
            loads: [record.largest_inner_load, record.largest_outer_load],
            cage: [record.largest_pocket_force, record.largest_land_force],
            end: &self.ending.state,
            rows: record.rows().collect(),
            races: Some(&record.races),
            ..bearing(self.built)
        }
    }
    /// How it ended, what it took, and the picture of its bearing.
    pub fn outcome(&self, given: RunInput) -> Outcome {
        Outcome {
            stop: stop(&self.ending),
            work: Work {
                steps: self.ending.work.accepted,
                rejected: self.ending.work.rejected,
                rate_calls: self.ending.work.rate_calls,
                method: Some(self.stepping.name()),
                ..Work::default()
            },
            pictures: vec![Picture {
                bearing: String::new(),
                clearance: None,
                pressure_limit: Some(given.bearing.hertz_pressure_limit),
                rolling_cage_ratio: self.built.machine.constants.bearing.rolling_cage_ratio(),
                balls: given.bearing.ball_count,
            }],
            ..Outcome::default()
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
        motion: Box::new(|state| built.machine.layout().motion(state)),
        rows: Vec::new(),
        races: None,
    }
}
