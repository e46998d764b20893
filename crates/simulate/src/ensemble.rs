//! Many machines: in lanes of the vector unit, and in threads.
//!
//! A member's result depends on its constants and its start alone, bit for bit: not on the lane, the company, the
//! vector unit or the number of threads.

use crate::bearing::warm::{Followed, Heated};
use crate::following::{Following, Warmed};
use crate::watch::Watch;
use model::auxiliary_bearing::BearingAt;
use model::auxiliary_bearing::probe::NORMAL_FORCE;
use model::system::energy::{Balance, Content, Flows};
use model::system::machine::record::Record;
use model::system::machine::simulate::{Runs, Steps, simulate};
use model::system::machine::{Mode, RotorMachine};
use model::system::rig::Tap;
use model::system::sampling::Row;
use number::Level;
use outcome::host;
use outcome::options::{InterimBearing, InterimRow};
use solve::{Ending, Flow, Observer, Settings, Step};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// One machine with its start.
#[derive(Clone, Debug)]
pub struct Member {
    /// The machine, which members that differ in their start alone share.
    pub machine: Arc<RotorMachine>,
    /// What of it follows its temperatures.
    pub(crate) following: Option<Arc<Following>>,
    /// Its state at the start.
    pub start: Vec<f64>,
    /// Whether its history is kept.
    pub keep_rows: bool,
}

impl Member {
    /// A machine whose constants stay; its history is not kept.
    pub fn of(machine: RotorMachine, start: Vec<f64>) -> Member {
        Member {
            machine: machine.into(),
            following: None,
            start,
            keep_rows: false,
        }
    }
}

/// What came out of one member.
#[derive(Clone, Debug)]
pub struct Finished {
    /// The machine at the start.
    pub machine: Arc<RotorMachine>,
    /// The state at the start.
    pub start: Vec<f64>,
    /// Energies and flows at the start.
    pub(crate) begun: (Content, Flows),
    /// What was watched and kept.
    pub record: Record,
    /// The machine as it was at the end, where it was another one at the start.
    pub(crate) now: Option<Box<RotorMachine>>,
    /// What has followed its temperatures.
    pub(crate) warmed: Option<Box<Warmed>>,
    /// How it ended.
    pub ending: Ending,
}

impl Finished {
    /// The machine as it is at the end.
    pub(crate) fn at_end(&self) -> &RotorMachine {
        self.now.as_deref().unwrap_or(&self.machine)
    }
    /// Temperatures of a bearing, where they were followed.
    pub(crate) fn followed<'a>(
        &'a self,
        heated: Option<Heated<'a>>,
        k: usize,
    ) -> Option<Followed<'a>> {
        let warmed = self.warmed.as_deref();
        Some(Followed {
            heated: heated?,
            warmth: self.record.bearings[k].warmth.as_deref()?,
            state: warmed.and_then(|warmed| warmed.state(k)),
            broken: warmed.and_then(Warmed::broken),
        })
    }
    /// What must close between the start and an instant; rings that have closed on their balls have done work.
    pub(crate) fn balance(&self, time: f64, content: Content, state: &[f64]) -> Balance {
        let found = (content, self.machine.flows(state));
        let warmed = self.warmed.as_deref();
        Balance {
            start: self.begun,
            end: warmed.map_or(found, |warmed| warmed.renewals.booked(time, found)),
        }
    }
    /// What must close between the start and the end.
    pub(crate) fn whole_balance(&self) -> Balance {
        let end = &self.ending.state;
        self.balance(f64::INFINITY, self.at_end().content(end), end)
    }
    /// Work of rings that have closed on loaded balls, J.
    pub(crate) fn work_of_rings(&self) -> f64 {
        let warmed = self.warmed.as_deref();
        warmed.map_or(0.0, |warmed| warmed.renewals.work_until(f64::INFINITY))
    }
}

/// How to run the members.
pub struct Plan<'a> {
    /// Of the integration.
    pub settings: Settings,
    /// Explicit or linearly implicit.
    pub steps: Steps,
    /// Time between rows, s.
    pub interval: f64,
    /// What a converter samples on a rig.
    pub taps: &'a [Tap],
    /// From when on a run ends once its rotor rolls, s.
    pub until_rolling: Option<f64>,
    /// Shares of the clearance within which a rotor that is levitated again must stay, each time.
    pub within: Vec<f64>,
    /// Stops everything when true.
    pub interrupt: &'a AtomicBool,
    /// Called with the fraction done.
    pub progress: &'a (dyn Fn(f64) + Sync),
    /// Called with sampled rows of the member that keeps them.
    pub rows: Option<&'a (dyn Fn(Vec<InterimRow>) + Sync)>,
}

/// Runs members that lanes may share, those of one layout and the same laws, on the threads of the pool in which this is called; the
/// results stand in their order.
pub fn run(members: &[Member], plan: &Plan) -> Vec<Finished> {
    let done = AtomicU64::new(0);
    let report = Report {
        done: &done,
        members: members.len(),
        progress: plan.progress,
        rows: plan.rows,
    };
    let chunk = |members: &[Member]| side_by_side(members, plan, &report);
    let threads = host::threads();
    let together = together(members.len(), Level::detect().lanes(), threads);
    if members.len() <= together {
        return chunk(members);
    }
    let chunks: Vec<&[Member]> = members.chunks(together).collect();
    let made = host::each(&chunks, |_, members| chunk(members));
    made.into_iter().flatten().collect()
}

/// Most members a lane takes one after the other: their records stand in memory together.
const MOST_TURNS: usize = 8;

/// Members that a thread takes at a time: so many that lanes which are free early find another one, so few that all threads
/// have something to do.
fn together(members: usize, lanes: usize, threads: usize) -> usize {
    let turns = members / (lanes * threads.max(1));
    lanes * turns.clamp(1, MOST_TURNS)
}

/// Runs members that share the lanes of a vector register: each lane takes the next one when it is free.
fn side_by_side(members: &[Member], plan: &Plan, report: &Report) -> Vec<Finished> {
    let machines: Vec<&RotorMachine> = members.iter().map(|m| &*m.machine).collect();
    let starts: Vec<Vec<f64>> = members.iter().map(|m| m.start.clone()).collect();
    let mut watched: Vec<Watched> = (members.iter())
        .map(|member| Watched::of(member, plan, report))
        .collect();
    let runs = Runs {
        machines: &machines,
        starts: &starts,
        settings: plan.settings,
        steps: plan.steps,
        interrupt: plan.interrupt,
    };
    let mut observers: Vec<&mut dyn Observer<RotorMachine>> = (watched.iter_mut())
        .map(|watched| watched as &mut dyn Observer<RotorMachine>)
        .collect();
    let endings = simulate(runs, &mut observers);
    let parts = watched.into_iter().zip(endings).zip(members);
    parts
        .map(|((watched, ending), member)| watched.finish(ending, member))
        .collect()
}

/// Adds up the thousandths of all members.
struct Report<'a> {
    done: &'a AtomicU64,
    members: usize,
    progress: &'a (dyn Fn(f64) + Sync),
    rows: Option<&'a (dyn Fn(Vec<InterimRow>) + Sync)>,
}

/// A watch that also reports progress.
struct Watched<'a> {
    watch: Watch,
    report: &'a Report<'a>,
    reported: u64,
    /// Rows that were shown while the run goes on.
    shown: usize,
    end: f64,
}

impl<'a> Watched<'a> {
    fn of(member: &'a Member, plan: &Plan, report: &'a Report<'a>) -> Self {
        let end = plan.settings.end;
        let interval = member.keep_rows.then_some(plan.interval);
        let record = Record::with_taps(&member.machine, end, interval, plan.taps);
        let record = record.staying_within(plan.within.clone());
        let record = match plan.until_rolling {
            Some(from) => record.until_rolling(from),
            None => record,
        };
        Watched {
            watch: Watch::of(member, record),
            report,
            reported: 0,
            shown: 0,
            end,
        }
    }
    fn finish(self, ending: Ending, member: &Member) -> Finished {
        if ending.stop == solve::Stop::Finished {
            self.advance(1000);
        }
        self.watch.finish(ending, member)
    }
    /// Reports that this member stands at so many thousandths.
    fn advance(&self, thousandths: u64) {
        let more = thousandths.saturating_sub(self.reported);
        let done = self.report.done.fetch_add(more, Ordering::Relaxed) + more;
        (self.report.progress)(done as f64 / (1000 * self.report.members) as f64);
    }
}

impl Watched<'_> {
    /// Shows the rows since the last time.
    fn show(&mut self, machine: &RotorMachine) {
        let Some(show) = self.report.rows else { return };
        let fresh = self.watch.record.rows().skip(self.shown);
        let rows: Vec<InterimRow> = fresh.map(|row| interim(machine, &row)).collect();
        self.shown += rows.len();
        if !rows.is_empty() {
            show(rows);
        }
    }
}

/// A row as pictures of a run in progress show it.
fn interim(machine: &RotorMachine, row: &Row) -> InterimRow {
    let layout = machine.layout();
    let of_bearing = |(k, at): (usize, &BearingAt)| {
        let bearing = &machine.constants.bearings[k].bearing;
        let rotor = machine.node(k, row.state).position;
        let race = at.inner.centre().map(|channel| row.state[channel]);
        let own = &row.state[at.own()];
        let ball = |ball| [bearing.azimuth(own, ball), row.probe[at.detail + ball]];
        InterimBearing {
            rotor: [rotor.x - race[0], rotor.y - race[1]],
            force: row.probe[at.probe(NORMAL_FORCE)],
            balls: (0..bearing.balls()).map(ball).collect(),
        }
    };
    InterimRow {
        time: row.time,
        speed: row.state[layout.rotor.spin()],
        bearings: layout.bearings.iter().enumerate().map(of_bearing).collect(),
    }
}

impl Observer<RotorMachine> for Watched<'_> {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        let thousandths = (1000.0 * step.end / self.end) as u64;
        if thousandths > self.reported {
            self.advance(thousandths);
            self.reported = thousandths;
            self.show(step.machine);
        }
        self.watch.step(step)
    }
    fn renewed(
        &mut self,
        machine: &RotorMachine,
        time: f64,
        state: &[f64],
    ) -> Option<Box<RotorMachine>> {
        self.watch.renewed(machine, time, state)
    }
    fn switched(
        &mut self,
        machine: &RotorMachine,
        mode: &Mode<f64>,
        time: f64,
        state: &[f64],
    ) -> Flow {
        self.watch.switched(machine, mode, time, state)
    }
}
