//! A repetition: a study of starts that are perturbed and machines that differ, whose first member is kept whole.
//!
//! What is kept of the others are their results, their warnings and how they ended; a store may keep them as they end.

use super::kept::{Members, Store, is_life};
use super::parts;
use crate::each::staged;
use outcome::host::{self, in_pool};
use outcome::{Options, Outcome, Spread, Stop, Value, Work};
use problem::{Place, Problem, Result};
use scenario::{Scenario, Variations};
use simulate::drop::Drop;
use simulate::drop::build::{self, DropModel};
use simulate::drop::each::{self, One, numbers};
use simulate::ending::interrupted;
use std::collections::{BTreeMap, BTreeSet};
use std::convert::Infallible;
use std::sync::Arc;

/// Members that are built before a run; more of them are built as they come.
const BEFORE: usize = 128;
/// Keeps the numbers of machines apart from those of starts.
const MACHINES: u64 = 0x5851_f42d_4c95_7f2d;

/// What a member draws: paths with their values.
type Drawn = Vec<(String, String)>;
/// The file and the machine of a member whose machine differs from the one given.
pub(crate) type Member = (Scenario, Arc<DropModel>);

/// Members 1, 2, … whose machines differ, the first 128 of them.
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
    // what they draw is refused in time: a value beyond what a key allows is the least or the largest
    let refused = host::each(&extremes(scenario, drop, later), |_, (k, drawn)| {
        let problem = variations.with(drawn).err()?;
        Some(member_problem(*k, drawn, problem))
    });
    match refused.into_iter().flatten().next() {
        Some(problem) => Err(problem),
        None => Ok(first),
    }
}

/// Of these members those that draw the least or the largest of a value, and the first with each word.
fn extremes(scenario: &Scenario, drop: &Drop, members: &[usize]) -> Vec<(usize, Drawn)> {
    let number = |text: &str| text.split(' ').next()?.parse::<f64>().ok();
    let mut ends: BTreeMap<String, [(f64, usize); 2]> = BTreeMap::new();
    let mut chosen: BTreeSet<usize> = BTreeSet::new();
    let mut words: BTreeSet<(String, String)> = BTreeSet::new();
    for k in members.iter().copied() {
        for (path, text) in draw(scenario, drop, k) {
            match number(&text) {
                Some(value) => {
                    let [least, most] = ends.entry(path).or_insert([(value, k); 2]);
                    if value < least.0 {
                        *least = (value, k);
                    } else if value > most.0 {
                        *most = (value, k);
                    }
                }
                None if words.insert((path, text)) => _ = chosen.insert(k),
                None => {}
            }
        }
    }
    chosen.extend(ends.into_values().flatten().map(|(_, k)| k));
    let chosen = chosen.into_iter();
    chosen.map(|k| (k, draw(scenario, drop, k))).collect()
}

/// How many members a drop has.
pub(crate) fn count(drop: &Drop) -> usize {
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
    store: &dyn Store,
) -> Outcome {
    let made = in_pool(options.threads, || {
        let given = One::of(scenario, built.clone());
        match count(&built.drop) {
            1 => each::run(&[given.single()], options).pop(),
            _ => repeated(&given, known, options, store).outcome(scenario, &built.drop),
        }
    });
    let Some(outcome) = made else {
        unreachable!("the first member has run");
    };
    outcome
}

/// Runs the members that are not in the store, some at a time; the first in any case, since it is kept whole.
fn repeated(
    given: &One,
    known: &[Arc<Member>],
    options: &Options,
    store: &dyn Store,
) -> Repetition {
    let (scenario, drop) = (given.scenario, &given.built.drop);
    let count = count(drop);
    let variations = scenario.variations();
    let mut all = Repetition::default();
    for part in 0..parts::count(count) {
        all.whole.append(store.there(part));
    }
    let mut is_there = vec![false; count];
    for member in &all.whole.table.members {
        is_there[*member] = true;
    }
    let lacking: Vec<usize> = (0..count).filter(|k| *k == 0 || !is_there[*k]).collect();
    let mut done = count - lacking.len();
    let mut turn = |some: &[usize]| {
        let drawn: Vec<Drawn> = some.iter().map(|k| draw(scenario, drop, *k)).collect();
        let read = host::each(&drawn, |place, drawn| {
            let k = some[place];
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
            Ok(one.repeated(some[place]))
        };
        let plan = Options {
            progress: &|fraction| {
                let done = done as f64 + fraction * some.len() as f64;
                (options.progress)(done / count as f64);
            },
            ..*options
        };
        let made = staged(some.len(), stage, |_, made| made, &plan);
        let mut part = parts::part_of(some[0]);
        let mut fresh = Members::default();
        for ((k, mut made), read) in some.iter().copied().zip(made).zip(&read) {
            if part != parts::part_of(k) {
                all.keep(store, part, std::mem::take(&mut fresh));
                part = parts::part_of(k);
            }
            if made.stop.complete() {
                if !is_there[k] {
                    fresh.add(k, &mut made);
                }
            } else {
                all.broken.get_or_insert((k, made.stop.clone()));
                // what the user ended was not too short; the first is shown as far as it came
                if read.is_ok() && (k == 0 || !made.stop.interrupted()) {
                    all.others.add(k, &mut made);
                }
            }
            if k == 0 {
                all.first = Some(made);
            }
        }
        all.keep(store, part, fresh);
        host::discard(read);
        done += some.len();
        Ok::<(), Infallible>(())
    };
    let Ok(()) = parts::in_turns(&lacking, options, drop.coast_down.is_some(), &mut turn);
    all
}

/// What members have made so far.
#[derive(Default)]
struct Repetition {
    /// The first member.
    first: Option<Outcome>,
    /// Those that ended as planned: another would pull every mean.
    whole: Members,
    /// Warnings and work of the others, of which one was built.
    others: Members,
    /// The first of them, and how it ended.
    broken: Option<(usize, Stop)>,
}

impl Repetition {
    /// Takes fresh members of a part into the store, and with the others.
    fn keep(&mut self, store: &dyn Store, part: usize, fresh: Members) {
        if !fresh.table.is_empty() {
            store.keep(part, &fresh);
            self.whole.append(fresh);
        }
    }

    fn outcome(mut self, scenario: &Scenario, drop: &Drop) -> Option<Outcome> {
        let count = count(drop);
        let mut first = self.first?;
        let names = first.quantities.iter().map(|own| own.name.as_str());
        let table = std::mem::take(&mut self.whole.table).sorted();
        let table = table.ordered(&names.collect::<Vec<_>>());
        let least = chaotic_from(scenario, drop);
        for quantity in &mut first.quantities {
            if is_life(quantity) {
                quantity.value = Value::List(self.whole.mean_life(&quantity.name));
            }
            let values = table.values(&quantity.name);
            quantity.spread = Spread::of(values.into_iter().flatten().collect());
            let deviation = quantity.spread.map_or(0.0, |of| of.relative_deviation());
            quantity.chaotic = least.is_some_and(|least| deviation > least)
                // what a ledger misses is an error of the integration, and has no size of its own
                && !quantity.name.ends_with("residual");
        }
        let whole = table.len();
        // in the order of the members, what is not there comes first
        let next = (table.members.iter().enumerate()).find(|(row, member)| row != *member);
        let next = next.map_or(whole, |(row, _)| row);
        let rest = || (next, interrupted(0.0));
        let broken = self.broken.or_else(|| (next < count).then(rest));
        if let Some((k, stop)) = broken.filter(|_| first.stop.complete()) {
            // of the members nothing but what is whole is kept
            let begin = match stop.interrupted() {
                true => "Interrupted.".to_string(),
                false => format!("Member {k} of the repetition: {}", stop.text),
            };
            first.stop = Stop {
                text: format!(
                    "{} {whole} of {count} members are whole; only these enter the spread.",
                    begin.trim_end()
                ),
                ..stop
            };
        }
        let varied = !scenario.vary.is_empty();
        let draws = table.members.iter().filter(|_| varied);
        let drawn = draws.map(|k| draw(scenario, drop, *k)).collect();
        self.whole.append(self.others);
        let (warnings, work) = self.whole.without_table();
        Some(Outcome {
            warnings: warnings.list(!varied),
            work: Work {
                members: count,
                method: first.work.method,
                ..work
            },
            members: table,
            drawn,
            ..first
        })
    }
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
