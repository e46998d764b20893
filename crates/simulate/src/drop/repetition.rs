//! A drop, and its repetition: a study of starts that are perturbed and machines that differ, whose first member is kept whole.
//!
//! Members are run as those of any study, in parts: what is kept of one are its results, its warnings and how it ended.

use crate::bearing::races::LIFE_BY_POINT;
use crate::drop::Drop;
use crate::drop::build::{self, Built};
use crate::drop::each::{self, One};
use crate::ending;
use crate::ensemble::Member;
use number::Vec2;
use outcome::host::{self, in_pool};
use outcome::joined::Joined;
use outcome::options::Options;
use outcome::{Members, Outcome, Quantity, Spread, Stop, Value, Work};
use problem::{Place, Problem};
use scenario::{Scenario, Variations};
use statistics::random::Random;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// Members of a part, each thread: its lanes stay full, and their records stand in memory together.
const PART: usize = 256;

/// What a member draws: paths with their values.
type Drawn = Vec<(String, String)>;

/// The file and the machine of a member whose machine differs from the one given.
pub type Other = (Scenario, Arc<Built>);

/// Members that are built before a run; more of them are built as they come.
const BEFORE: usize = 512;

/// Members 1, 2, … whose machines differ, the first 512 of them.
///
/// # Errors
/// What is wrong with the first of these that cannot be built.
pub fn others(scenario: &Scenario, built: &Built) -> Result<Vec<Arc<Other>>, Box<Problem>> {
    if scenario.vary.is_empty() {
        return Ok(Vec::new());
    }
    let drop = &built.drop;
    let variations = scenario.variations();
    let first: Vec<usize> = (1..count(drop).min(BEFORE)).collect();
    let first = host::each(&first, |_, k| {
        member(&variations, &draw(scenario, drop, *k), *k)
    });
    let first = first.into_iter().collect::<Result<_, _>>()?;
    // what they draw is refused in time
    let later: Vec<usize> = (BEFORE..count(drop).max(BEFORE)).collect();
    let refused = host::each(&later, |_, k| {
        let drawn = draw(scenario, drop, *k);
        let problem = variations.with(&drawn).err()?;
        Some(member_problem(*k, &drawn, problem))
    });
    match refused.into_iter().flatten().next() {
        Some(problem) => Err(problem),
        None => Ok(first),
    }
}

fn count(drop: &Drop) -> usize {
    drop.repeat.count.max(1) as usize
}

/// What a member draws: nothing where starts alone differ, and in the first.
fn draw(scenario: &Scenario, drop: &Drop, k: usize) -> Drawn {
    if k == 0 {
        return Vec::new();
    }
    let mut random = numbers(drop.repeat.seed ^ MACHINES, k);
    let each = scenario.vary.iter();
    each.flat_map(|vary| vary.draw(&mut random)).collect()
}

/// A member of a machine of its own.
fn member(of: &Variations, drawn: &Drawn, k: usize) -> Result<Arc<Other>, Box<Problem>> {
    let blame = |problem: Box<Problem>| member_problem(k, drawn, problem);
    let member = of.with(drawn).map_err(blame)?;
    let Some(of) = member.drop() else {
        unreachable!("no value that is varied changes the system");
    };
    let built = build::drop(of).map_err(blame)?;
    Ok(Arc::new((member, built.into())))
}

/// What is wrong with a member, with what it drew.
fn member_problem(k: usize, drawn: &[(String, String)], mut problem: Box<Problem>) -> Box<Problem> {
    let draws: Vec<String> = (drawn.iter())
        .map(|(path, value)| format!("{path} = {value}"))
        .collect();
    problem.found = format!("{} in member {k} of the repetition", problem.found);
    problem.place = Place::Whole;
    problem.with_hint(format!("It drew {}", draws.join(", ")))
}

/// Runs a drop, as often as it asks; `known` are those of its [`others`] that have been read.
pub fn run(
    scenario: &Scenario,
    built: &Arc<Built>,
    known: &[Arc<Other>],
    options: &Options,
) -> Outcome {
    let made = in_pool(options.threads, || {
        let mut given = One::of(scenario, built.clone());
        given.member.keep_rows = true;
        match count(&built.drop) {
            1 => each::run(&[given], options).pop(),
            _ => repeated(&given, known, options).outcome(scenario, &built.drop),
        }
    });
    let Some(outcome) = made else {
        unreachable!("the first member has run");
    };
    outcome
}

/// Runs the members, part by part.
fn repeated(given: &One, known: &[Arc<Other>], options: &Options) -> Repetition {
    let (scenario, drop) = (given.scenario, &given.built.drop);
    let count = count(drop);
    let variations = scenario.variations();
    let mut given = given.clone();
    given.members = count;
    let mut all = Repetition::default();
    let part = PART * host::threads();
    for begin in (0..count).step_by(part) {
        let part = begin..(begin + part).min(count);
        let drawn: Vec<Drawn> = part.clone().map(|k| draw(scenario, drop, k)).collect();
        let read = host::each(&drawn, |place, drawn| {
            let k = begin + place;
            match known.get(k.wrapping_sub(1)) {
                Some(other) => Ok(Some(other.clone())),
                None if drawn.is_empty() => Ok(None),
                None => member(&variations, drawn, k).map(Some),
            }
        });
        let whole = part.clone().zip(&read);
        let whole: Vec<_> = whole
            .filter_map(|(k, other)| Some((k, other.as_ref().ok()?.as_deref())))
            .collect();
        let ones = host::each(&whole, |_, (k, other)| perturbed(&given, *k, *other));
        let progress = |fraction: f64| {
            let done = begin as f64 + fraction * ones.len() as f64;
            (options.progress)(done / count as f64);
        };
        let plan = Options {
            progress: &progress,
            ..*options
        };
        let mut made = each::run(&ones, &plan).into_iter();
        host::discard(ones);
        for ((k, other), drawn) in part.zip(&read).zip(drawn) {
            let stop = match other {
                Ok(_) => made.next().and_then(|made| all.add(k, made, drawn)),
                Err(problem) => Some(not_built(problem)),
            };
            if let Some(stop) = stop {
                all.broken.get_or_insert((k, stop));
            }
        }
        host::discard(read);
        if options.interrupt.load(Ordering::Relaxed) {
            break;
        }
    }
    all
}

/// A member at its own start: of the machine given, or of another.
fn perturbed<'a>(given: &One<'a>, k: usize, other: Option<&'a Other>) -> One<'a> {
    let mut one = match other {
        Some((scenario, built)) => One::of(scenario, built.clone()),
        None => given.clone(),
    };
    one.members = given.members;
    if k > 0 {
        one.member.keep_rows = false;
        perturb(&one.built.drop, &mut one.member, k);
    }
    one
}

fn not_built(problem: &Problem) -> Stop {
    Stop {
        reason: "not built",
        time: 0.0,
        text: problem.to_string(),
    }
}

/// What members have made so far.
#[derive(Default)]
struct Repetition {
    /// The first member.
    first: Option<Outcome>,
    /// Those that ended as planned: another would pull every mean.
    table: Members,
    drawn: Vec<Drawn>,
    /// Sums of lives by point over these, and how many have one.
    lives: BTreeMap<String, (Vec<f64>, f64)>,
    warnings: Joined,
    /// The first that did not, and how.
    broken: Option<(usize, Stop)>,
    work: Work,
    /// Members that ran.
    ran: usize,
}

impl Repetition {
    /// Adds a member; how it ended where that was not as planned.
    fn add(&mut self, k: usize, mut made: Outcome, drawn: Drawn) -> Option<Stop> {
        self.ran += 1;
        self.work.steps += made.work.steps;
        self.work.rejected += made.work.rejected;
        self.work.rate_calls += made.work.rate_calls;
        self.warnings.add(k, std::mem::take(&mut made.warnings));
        let stop = made.stop.clone();
        if stop.complete() {
            for result in &made.quantities {
                if let (Value::List(values), true) = (&result.value, is_life(result)) {
                    let (sum, count) = self.lives.entry(result.name.clone()).or_default();
                    sum.resize(values.len(), 0.0);
                    sum.iter_mut()
                        .zip(values)
                        .for_each(|(sum, value)| *sum += value);
                    *count += 1.0;
                }
            }
            self.drawn.push(drawn);
            self.table.push(&made.quantities);
        }
        self.first.get_or_insert(made);
        (!stop.complete()).then_some(stop)
    }

    fn outcome(mut self, scenario: &Scenario, drop: &Drop) -> Option<Outcome> {
        let count = count(drop);
        let mut first = self.first?;
        let least = chaotic_from(scenario, drop);
        for quantity in &mut first.quantities {
            if is_life(quantity) {
                let (sum, count) = self.lives.remove(&quantity.name).unwrap_or_default();
                quantity.value = Value::List(sum.iter().map(|sum| sum / count).collect());
            }
            let values = self.table.values(&quantity.name);
            quantity.spread = Spread::of(values.into_iter().flatten().collect());
            let deviation = quantity.spread.map_or(0.0, |of| of.relative_deviation());
            quantity.chaotic = least.is_some_and(|least| deviation > least)
                // what a ledger misses is an error of the integration, and has no size of its own
                && !quantity.name.ends_with("residual");
        }
        if self.ran < count {
            let next = self.ran;
            self.broken
                .get_or_insert_with(|| (next, ending::interrupted(0.0)));
        }
        first.warnings = self.warnings.list(scenario.vary.is_empty());
        if let Some((k, stop)) = self.broken.filter(|_| first.stop.complete()) {
            let whole = self.table.len();
            first.stop = Stop {
                text: format!(
                    "Member {k} of the repetition: {}. {whole} of {count} members are whole; only these enter the spread.",
                    stop.text.trim_end_matches('.')
                ),
                ..stop
            };
        }
        self.table.end = drop.run.duration;
        Some(Outcome {
            work: Work {
                members: count,
                method: first.work.method,
                ..self.work
            },
            members: self.table,
            drawn: if scenario.vary.is_empty() {
                Vec::new()
            } else {
                self.drawn
            },
            ..first
        })
    }
}

fn is_life(quantity: &Quantity) -> bool {
    quantity.name.ends_with(LIFE_BY_POINT)
}

/// Relative deviation of members that starts make chaotic: below it no reader sees it.
const SEEN: f64 = 1e-3;
/// How much larger than that of the starts it must be at least.
const AMPLIFIED: f64 = 1e3;

/// Relative deviation of the members from which a result is chaotic: far above that of their starts. None where their machines
/// differ, which is another reason to differ.
fn chaotic_from(scenario: &Scenario, drop: &Drop) -> Option<f64> {
    if !scenario.vary.is_empty() {
        return None;
    }
    let clearances = drop.auxiliary_bearings.iter();
    let smallest = clearances
        .map(|part| part.contact.radial_air_clearance)
        .fold(f64::INFINITY, f64::min);
    let repeat = &drop.repeat;
    let of_starts = (repeat.rotor_position_deviation / smallest).max(repeat.ball_angle_deviation);
    Some(SEEN.max(AMPLIFIED * of_starts))
}

/// Moves the rotor and every ball a little.
fn perturb(drop: &Drop, member: &mut Member, k: usize) {
    let machine = &member.machine;
    let mut random = numbers(drop.repeat.seed, k);
    let mut normal = || random.normal();
    let shift = Vec2::new(normal(), normal()) * drop.repeat.rotor_position_deviation;
    let angles: Vec<Vec<f64>> = (machine.constants.bearings.iter())
        .map(|part| {
            let moves = |ball: &usize| part.bearing.azimuth_state(*ball).is_some();
            let balls = (0..part.bearing.balls()).take_while(moves).count();
            (0..balls)
                .map(|_| normal() * drop.repeat.ball_angle_deviation)
                .collect()
        })
        .collect();
    machine.perturb(&mut member.start, shift, &|bearing, ball| {
        angles[bearing][ball]
    });
}

/// Keeps the numbers of machines apart from those of starts.
const MACHINES: u64 = 0x5851_f42d_4c95_7f2d;

/// The random numbers of a member: (seed, k) mixed so that neighbouring pairs share nothing.
fn numbers(seed: u64, k: usize) -> Random {
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
