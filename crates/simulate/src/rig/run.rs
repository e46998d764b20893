//! A run of a bearing on a rig, of a spin-up or of a test: what it is built of, how it went, and what its pages of results need.

use crate::bearing::pressure::PressureFactors;
use crate::bearing::run::BearingRun;
use crate::bearing::steady::SteadyFinding;
use crate::bearing::warm::{self, Followed, Heated};
use crate::ending::{settings_at, stop};
use crate::ensemble::{self, Finished, Member, Plan};
use crate::following::Following;
use crate::stepping::Stepping;
use model::system::machine::RotorMachine;
use model::system::outer_race::OuterRaceEnergy;
use model::system::rig::Tap;
use model::system::rig::layout::CAGE_SLIP;
use model::system::rig::record::RigRecord;
use outcome::list::List;
use outcome::options::Options;
use outcome::{Outcome, Picture, Work};
use scenario::{Bearing, Run, Warm};
use std::ops::Deref;

/// A rig ready to be simulated.
#[derive(Clone, Debug)]
pub struct RigModel {
    /// The machine.
    pub machine: RotorMachine,
    /// Rate of a clutch's torque, N m/s: as given, or found; none where none engages.
    pub torque_rate: Option<f64>,
    /// Hertz pressure in the contacts of a ball.
    pub pressure_factors: PressureFactors,
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

impl<'a> RunInput<'a> {
    /// The bearing, where its temperatures are followed.
    pub fn heated(self, built: &'a RigModel) -> Option<Heated<'a>> {
        let part = built.machine.constants.bearings[0].warm.as_deref();
        Heated::of(self.warm, self.bearing, part)
    }
}

/// A run.
pub(crate) struct RigRun<'a> {
    pub built: &'a RigModel,
    given: RunInput<'a>,
    finished: Finished,
    stepping: Stepping,
}

impl Deref for RigRun<'_> {
    type Target = Finished;
    fn deref(&self) -> &Finished {
        &self.finished
    }
}

impl<'a> RigRun<'a> {
    /// Runs a rig.
    pub fn of(
        built: &'a RigModel,
        given: RunInput<'a>,
        stepping: Stepping,
        taps: &[Tap],
        options: &Options<'a>,
    ) -> Self {
        let plan = Plan {
            settings: settings_at(given.run, stepping.tolerance),
            steps: stepping.steps,
            interval: given.run.output_interval,
            taps,
            until_rolling: None,
            within: Vec::new(),
            interrupt: options.interrupt,
            progress: options.progress,
            rows: options.rows,
        };
        let member = Member {
            following: Following::on_rig(given.warm, given.bearing).map(Into::into),
            keep_rows: true,
            ..Member::of(built.machine.clone(), built.machine.start())
        };
        RigRun {
            built,
            given,
            finished: ensemble::run(&[member], &plan).remove(0),
            stepping,
        }
    }
    /// What is kept of it besides its bearing.
    pub fn rig(&self) -> &RigRecord {
        self.record.rig()
    }
    /// Temperatures of the bearing; none where no network follows them.
    pub fn followed(&self) -> Option<Followed<'_>> {
        self.finished.followed(self.given.heated(self.built), 0)
    }
    /// What the bearing dissipated, J, true and by the forms of (21). Where rings closed on loaded balls, what is stored counts by the
    /// bearing as it was at either end, and the work of the rings is not heat.
    pub fn outer_race_energy(&self) -> OuterRaceEnergy {
        let (before, now) = (&self.machine, self.at_end());
        let mut forms = now.outer_race_energy(&self.start, &self.ending.state);
        let stored = |machine: &RotorMachine| machine.bearing_content(0, &self.start).sum();
        forms.exact += stored(before) - stored(now) + self.work_of_rings();
        forms
    }
    /// A probe at the end.
    pub fn probe(&self, index: usize) -> f64 {
        let (time, state) = (self.ending.time, &self.ending.state);
        (self.at_end()).last_probes(&self.rig().mode, time, state)[index]
    }
    /// Cage slip at the end: of the last turn of the cage, or of the last instant where there was none.
    pub fn late_slip(&self) -> f64 {
        (self.rig().turns.last_cage_slip()).unwrap_or_else(|| self.probe(CAGE_SLIP))
    }
    /// A heat of the ledger at the end, J.
    pub fn heat(&self, kind: usize) -> f64 {
        self.ending.state[self.built.machine.layout().heat(kind)]
    }
    /// The bearing in the run.
    pub fn bearing(&self) -> BearingRun<'_> {
        bearing(self.built).after(&self.finished, 0)
    }
    /// How it ended, what it took, and the picture of its bearing.
    pub fn outcome(&self) -> Outcome {
        let (work, bearing) = (&self.ending.work, self.given.bearing);
        let constants = &self.built.machine.constants.bearings[0].bearing;
        Outcome {
            stop: stop(&self.ending),
            work: Work {
                steps: work.accepted,
                rejected: work.rejected,
                rate_calls: work.rate_calls,
                method: Some(self.stepping.name()),
                ..Work::default()
            },
            pictures: vec![Picture {
                bearing: String::new(),
                clearance: None,
                pressure_limit: Some(bearing.hertz_pressure_limit),
                rolling_cage_ratio: constants.rolling_cage_ratio(),
                balls: bearing.ball_count,
            }],
            ..Outcome::default()
        }
    }
}

/// The bearing as it is before a run.
pub(crate) fn bearing(built: &RigModel) -> BearingRun<'_> {
    BearingRun::before(&built.machine, 0, built.pressure_factors)
}

/// Names what the bearing became, and the work of its rings; before a run what these are.
pub(crate) fn name_temperatures(list: &mut List, heated: Option<Heated>, run: Option<&RigRun>) {
    let Some(heated) = heated else {
        return;
    };
    warm::name(list, &heated, run.and_then(RigRun::followed).as_ref());
    let work = run.map(|run| run.work_of_rings());
    warm::work_of_rings(list, &(), work.as_ref());
}
