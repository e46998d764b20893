//! Many drops of machines that differ: each a single run, in lanes and threads with those of its kind.

use crate::drop::build::{self, DropModel};
use crate::drop::context::{Context, Setup};
use crate::drop::events;
use crate::drop::method::stepping;
use crate::drop::{self, controlled, multirate};
use crate::ending::settings_at;
use crate::ensemble::{self, Member, Plan};
use crate::following::Following;
use crate::stepping::Stepping;
use model::system::machine::RotorMachine;
use number::Vec2;
use outcome::options::Options;
use outcome::{Outcome, host};
use problem::Problem;
use scenario::{Drop, Scenario};
use statistics::random::Random;
use std::ops::Deref;
use std::sync::{Arc, Mutex};

/// A drop that is ready to run.
#[derive(Clone)]
pub struct One<'a> {
    /// What was written.
    pub scenario: &'a Scenario,
    /// The drop in it, and its constants.
    pub built: Arc<DropModel>,
    pub(crate) member: Member,
    pub(crate) stepping: Stepping,
    kind: Arc<Kind>,
    /// Whether it is a member of a repetition.
    repeated: bool,
}

/// Values that are no real numbers, by their paths.
type Kind = Vec<(String, Option<String>)>;

/// The random numbers of a member: (seed, k) mixed so that neighbouring pairs share nothing.
pub fn numbers(seed: u64, k: usize) -> Random {
    // finaliser of SplitMix64, twice
    let mix = |mut x: u64| {
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    };
    Random::new(mix(
        mix(seed.wrapping_add(0x9e37_79b9_7f4a_7c15)).wrapping_add(k as u64)
    ))
}

/// Builds a drop of its scenario.
pub fn one<'a>(scenario: &'a Scenario, given: &Drop) -> Result<One<'a>, Box<Problem>> {
    Ok(One::of(scenario, Arc::new(build::drop(given)?)))
}

impl<'a> One<'a> {
    /// A drop of its scenario; its history is not kept.
    pub fn of(scenario: &'a Scenario, built: Arc<DropModel>) -> Self {
        let machine = RotorMachine::new(built.constants.clone());
        let mut start = match &built.shaft {
            Some(shaft) => machine.start_with(&shaft.position, &shaft.velocity),
            None => machine.start(),
        };
        let vector = |[x, y]: [f64; 2]| Vec2::new(x, y);
        let given = &built.drop.rotor;
        machine.displace(
            &mut start,
            vector(given.start_displacement),
            vector(given.start_velocity),
        );
        let of_kind = (scenario.resolved.values.iter()).filter(|value| value.is_of_kind());
        let kind: Kind = of_kind
            .map(|value| (value.shown(), value.text.clone()))
            .collect();
        One {
            scenario,
            stepping: stepping(&built, machine.tangents()),
            kind: kind.into(),
            member: Member {
                following: Following::of(&built.drop).map(Arc::new),
                ..Member::of(machine, start)
            },
            built,
            repeated: false,
        }
    }
    /// A single run, whose history is kept.
    #[must_use]
    pub fn single(&self) -> Self {
        let mut one = self.clone();
        one.member.keep_rows = true;
        one
    }
    /// Member k of its repetition: rotor and balls start a little elsewhere, but in the first, which is kept whole.
    #[must_use]
    pub fn repeated(mut self, k: usize) -> Self {
        self.repeated = true;
        self.member.keep_rows = k == 0;
        if k == 0 {
            return self;
        }
        let repeat = &self.built.drop.repeat;
        let mut random = numbers(repeat.seed, k);
        let mut normal = || random.normal();
        let shift = Vec2::new(normal(), normal()) * repeat.rotor_position_deviation;
        let machine = &self.member.machine;
        let angles: Vec<Vec<f64>> = (machine.constants.bearings.iter())
            .map(|part| {
                let moves = |ball: &usize| part.bearing.azimuth_state(*ball).is_some();
                let balls = (0..part.bearing.balls()).take_while(moves);
                balls
                    .map(|_| normal() * repeat.ball_angle_deviation)
                    .collect()
            })
            .collect();
        let start = &mut self.member.start;
        machine.perturb(start, shift, &|bearing, ball| angles[bearing][ball]);
        self
    }
    /// The file of the unit that commands its magnets, where one does.
    pub(super) fn unit(&self) -> Option<&str> {
        let model = self.built.drop.shaft.as_deref()?.model.deref();
        Some(&model.levitation.as_ref()?.unit.as_ref()?.file)
    }
    /// Whether it is the one member of its repetition that is kept whole, or no repetition.
    pub(crate) fn speaks(&self) -> bool {
        !self.repeated || self.member.keep_rows
    }
    /// Whether lanes may hold both: the same words, counts and switches of their files, the same laws, states and settings.
    fn shares_lanes(&self, other: &One) -> bool {
        self.kind == other.kind
            && self.stepping == other.stepping
            && self.built.drop.run == other.built.drop.run
            && (self.member.machine).shares_lanes(&other.member.machine)
    }
}

/// Runs all of them; they stand in their order.
pub fn run(all: &[One], options: &Options) -> Vec<Outcome> {
    if all.iter().any(|one| one.unit().is_some()) {
        // a controller that is not of the file has one machine: each alone on its lane
        return host::each(all, |_, one| match one.unit() {
            Some(file) => Some(controlled::run(one, file, options)),
            None => run(std::slice::from_ref(one), options).pop(),
        })
        .into_iter()
        .flatten()
        .collect();
    }
    // those that can share lanes and settings
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (k, one) in all.iter().enumerate() {
        let fits = |group: &&mut Vec<usize>| all[group[0]].shares_lanes(one);
        match groups.iter_mut().find(fits) {
            Some(group) => group.push(k),
            None => groups.push(vec![k]),
        }
    }
    let done = Mutex::new(vec![0.0; groups.len()]);
    let of_group = |at: usize, group: &Vec<usize>| {
        let progress = |fraction: f64| {
            if let Ok(mut done) = done.lock() {
                done[at] = fraction * group.len() as f64;
                (options.progress)(done.iter().sum::<f64>() / all.len() as f64);
            }
        };
        together(all, group, options, &progress)
    };
    let made = host::each(&groups, of_group);
    let mut list: Vec<_> = (groups.into_iter().flatten())
        .zip(made.into_iter().flatten())
        .collect();
    list.sort_by_key(|(place, _)| *place);
    list.into_iter().map(|(_, made)| made).collect()
}

/// Part of the progress of a drop that goes on until the standstill.
const DROP_SHARE: f64 = 0.1;

/// Drops that share lanes.
fn together(
    all: &[One],
    group: &[usize],
    options: &Options,
    progress: &(dyn Fn(f64) + Sync),
) -> Vec<Outcome> {
    let coasts = all[group[0]].built.drop.coast_down.is_some();
    let part = if coasts { DROP_SHARE } else { 1.0 };
    let of_drop = |fraction: f64| progress(part * fraction);
    let members: Vec<Member> = group.iter().map(|k| all[*k].member.clone()).collect();
    let One {
        built, stepping, ..
    } = &all[group[0]];
    let plan = Plan {
        settings: settings_at(&built.drop.run, stepping.tolerance),
        steps: stepping.steps,
        interval: built.drop.run.output_interval,
        taps: &[],
        until_rolling: (built.drop.coast_down.is_some()).then(|| events::last(&built.drop)),
        within: events::within(&built.drop),
        interrupt: options.interrupt,
        progress: &of_drop,
        rows: options.rows,
    };
    let finished = ensemble::run(&members, &plan);
    let done = Mutex::new(vec![0.0; group.len()]);
    host::each(&finished, |place, finished| {
        let of_coast_down = |fraction: f64| {
            if let Ok(mut done) = done.lock() {
                done[place] = fraction;
                let mean = done.iter().sum::<f64>() / done.len() as f64;
                progress(DROP_SHARE + (1.0 - DROP_SHARE) * mean);
            }
        };
        let one = &all[group[place]];
        let mut context = Context {
            setup: Setup {
                built: &one.built,
                machine: &one.member.machine,
            },
            finished,
            repeated: one.repeated,
            reached: finished.record.reached,
            end: finished.ending.time,
        };
        let after = multirate::results::after(&context, options.interrupt, &of_coast_down);
        if let Some(after) = &after {
            (context.reached, context.end) = after.reached;
        }
        drop::outcome(one, &context, after.as_ref())
    })
}
