//! A repetition: a study of starts that are perturbed and machines that differ, whose first member is kept whole.
//!
//! What is kept of the others are their results, their warnings and how they ended.

use super::table::Table;
use crate::each::staged;
use outcome::host::{self, in_pool};
use outcome::joined::Joined;
use outcome::{Options, Outcome, Quantity, Spread, Stop, Value, Work};
use problem::{Place, Problem, Result};
use scenario::{Scenario, Variations};
use simulate::bearing::LIFE_BY_POINT;
use simulate::drop::Drop;
use simulate::drop::build::{self, DropModel};
use simulate::drop::each::{self, One, numbers};
use simulate::ending::interrupted;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// Members of a part, each thread: its lanes stay full, and their records stand in memory together.
const PART: usize = 256;
/// Members that are built before a run; more of them are built as they come.
const BEFORE: usize = 512;
/// Keeps the numbers of machines apart from those of starts.
const MACHINES: u64 = 0x5851_f42d_4c95_7f2d;

/// What a member draws: paths with their values.
type Drawn = Vec<(String, String)>;
/// The file and the machine of a member whose machine differs from the one given.
pub(crate) type Member = (Scenario, Arc<DropModel>);

/// Members 1, 2, … whose machines differ, the first 512 of them.
///
/// # Errors
/// What is wrong with the first of these that cannot be built.
pub(crate) fn others(scenario: &Scenario, drop: &Drop) -> Result<Vec<Arc<Member>>> {
    if scenario.vary.is_empty() {
        return Ok(Vec::new());
    }
    let variations = scenario.variations();
    let all: Vec<usize> = (1..count(drop)).collect();
    let (first, later) = all.split_at(all.len().min(BEFORE - 1));
    let first = host::each(first, |_, k| {
        member(&variations, &draw(scenario, drop, *k), *k)
    });
    let first = first.into_iter().collect::<Result<_>>()?;
    // what they draw is refused in time
    let refused = host::each(later, |_, k| {
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
fn member(of: &Variations, drawn: &Drawn, k: usize) -> Result<Arc<Member>> {
    let blame = |problem| member_problem(k, drawn, problem);
    let member = of.with(drawn).map_err(blame)?;
    let Some(of) = member.drop() else {
        unreachable!("no value that is varied changes the system");
    };
    let built = build::drop(of).map_err(blame)?;
    Ok(Arc::new((member, built.into())))
}

/// What is wrong with a member, with what it drew.
fn member_problem(k: usize, drawn: &Drawn, mut problem: Box<Problem>) -> Box<Problem> {
    let draws = drawn
        .iter()
        .map(|(path, value)| format!("{path} = {value}"));
    let draws: Vec<String> = draws.collect();
    problem.found = format!("{} in member {k} of the repetition", problem.found);
    problem.place = Place::Whole;
    problem.with_hint(format!("It drew {}", draws.join(", ")))
}

/// Runs a drop, as often as it asks; `known` are those of its [`others`] that have been read.
pub(crate) fn run(
    scenario: &Scenario,
    built: &Arc<DropModel>,
    known: &[Arc<Member>],
    options: &Options,
) -> Outcome {
    let made = in_pool(options.threads, || {
        let given = One::of(scenario, built.clone());
        match count(&built.drop) {
            1 => each::run(&[given.single()], options).pop(),
            _ => repeated(&given, known, options).outcome(scenario, &built.drop),
        }
    });
    let Some(outcome) = made else {
        unreachable!("the first member has run");
    };
    outcome
}

/// Runs the members, part by part.
fn repeated(given: &One, known: &[Arc<Member>], options: &Options) -> Repetition {
    let (scenario, drop) = (given.scenario, &given.built.drop);
    let count = count(drop);
    let variations = scenario.variations();
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
        let stage = |place: usize| {
            let one = match &read[place] {
                Ok(Some(other)) => One::of(&other.0, other.1.clone()),
                Ok(None) => given.clone(),
                Err(problem) => return Err(Outcome::not_built(problem).into()),
            };
            Ok(one.repeated(begin + place))
        };
        let done = |fraction: f64| {
            let done = begin as f64 + fraction * read.len() as f64;
            (options.progress)(done / count as f64);
        };
        let plan = Options {
            progress: &done,
            ..*options
        };
        let made = staged(read.len(), stage, |_, made| made, &plan);
        for (((k, made), drawn), read) in part.zip(made).zip(drawn).zip(&read) {
            match read {
                Ok(_) => all.add(k, made, drawn),
                Err(_) => _ = all.broken.get_or_insert((k, made.stop)),
            }
        }
        host::discard(read);
        if options.interrupt.load(Ordering::Relaxed) {
            break;
        }
    }
    all
}

/// What members have made so far.
#[derive(Default)]
struct Repetition {
    /// The first member.
    first: Option<Outcome>,
    /// Those that ended as planned: another would pull every mean.
    table: Table,
    drawn: Vec<Drawn>,
    /// Sums of lives by point over these, and how many have one.
    lives: BTreeMap<String, (Vec<f64>, f64)>,
    warnings: Joined,
    /// The first that did not, and how.
    broken: Option<(usize, Stop)>,
    work: Work,
}

impl Repetition {
    fn add(&mut self, k: usize, mut made: Outcome, drawn: Drawn) {
        if !made.stop.complete() {
            self.broken.get_or_insert((k, made.stop.clone()));
        }
        self.work.members += 1;
        self.work.steps += made.work.steps;
        self.work.rejected += made.work.rejected;
        self.work.rate_calls += made.work.rate_calls;
        if made.stop.complete() {
            for result in made.quantities.iter().filter(|own| is_life(own)) {
                if let Value::List(values) = &result.value {
                    let (sum, count) = self.lives.entry(result.name.clone()).or_default();
                    sum.resize(values.len(), 0.0);
                    sum.iter_mut()
                        .zip(values)
                        .for_each(|(sum, value)| *sum += value);
                    *count += 1.0;
                }
            }
            self.drawn.push(drawn);
            self.table.push(k, Vec::new(), &made);
        }
        self.warnings.add(k, std::mem::take(&mut made.warnings));
        self.first.get_or_insert(made);
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
        first.warnings = self.warnings.list(scenario.vary.is_empty());
        let next = self.work.members;
        let rest = || (next, interrupted(0.0));
        let broken = self.broken.or_else(|| (next < count).then(rest));
        if let Some((k, stop)) = broken.filter(|_| first.stop.complete()) {
            let whole = self.table.len();
            first.stop = Stop {
                text: format!(
                    "Member {k} of the repetition: {}. {whole} of {count} members are whole; only these enter the spread.",
                    stop.text.trim_end_matches('.')
                ),
                ..stop
            };
        }
        if scenario.vary.is_empty() {
            self.drawn.clear();
        }
        Some(Outcome {
            work: Work {
                members: count,
                method: first.work.method,
                ..self.work
            },
            members: self.table,
            drawn: self.drawn,
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
