//! What the members of a study say: spread of each result, limits with their verdicts, which input matters.

use super::Study;
use super::estimate::{Estimate, MISFIT};
use super::selection::Candidate;
use super::table::Table;
use outcome::limits::{self, UNFINISHED};
use outcome::{Judged, Spread, Value, Verdict};
use scenario::{Limit, UNBALANCE_ANGLE};
use statistics::design::Design;
use statistics::elementary::{Effect, effects};
use statistics::indices::{Index, indices};
use statistics::share;
use std::collections::BTreeSet;

/// Draws of the bands of indices, apart from those of the design.
const BANDS: u64 = 0xd1b5_4a32_d192_ed03;

/// What the members of a study say.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Members computed.
    pub members: usize,
    /// Members of the design.
    pub asked: usize,
    /// Each result with its spread over the members that are a sample, or over all of a design that is none.
    pub spreads: Vec<(String, &'static str, Option<Spread>)>,
    /// Limits with their verdicts.
    pub limits: Vec<StudyLimit>,
    /// Candidates of a selection, the best first.
    pub ranking: Vec<Candidate>,
    /// What each result that is shown owes to each input.
    pub sensitivity: Vec<(String, &'static str, Sensitivity)>,
    /// What measured curves say of the inputs, or why they say nothing; of an estimate whose members are all there.
    pub estimate: Option<Result<Estimate, String>>,
}

/// A limit with its verdict.
#[derive(Clone, Debug)]
pub struct StudyLimit {
    /// The verdict.
    pub judged: Judged,
    /// Share of members beyond the bound with both ends of its 95 % interval; none where members are no sample or lack values.
    pub beyond: Option<(f64, [f64; 2])>,
}

/// What a result owes to each input, in their order.
#[derive(Clone, Debug, PartialEq)]
pub enum Sensitivity {
    /// The result at the values given, and its smallest and largest value over the levels of each input alone.
    Sweep(Option<f64>, Vec<Option<[f64; 2]>>),
    /// Elementary effects.
    Effects(Vec<Option<Effect>>),
    /// Sobol indices.
    Indices(Vec<Index>),
}

impl Study {
    /// Names of the results that the page shows: those asked for, else those of limits, else the first ones.
    pub fn shown(&self) -> Vec<String> {
        const FEW: usize = 4;
        let mut names: Vec<String> = match self.file.results.is_empty() {
            false => self
                .file
                .results
                .iter()
                .map(|(name, _)| name.clone())
                .collect(),
            true => self
                .file
                .limits
                .iter()
                .filter(|limit| limit.forbids.is_none())
                .map(|limit| limit.quantity.clone())
                .collect(),
        };
        let mut seen = Vec::new();
        names.retain(|name| !seen.contains(name) && (seen.push(name.clone()), true).1);
        if names.is_empty() && self.file.estimates() {
            names.push(MISFIT.to_string());
        }
        if names.is_empty() {
            let numbers = |value: &Value| matches!(value, Value::Number(_) | Value::None { .. });
            let all = self.known.iter().filter(|known| numbers(&known.value));
            names.extend(all.take(FEW).map(|known| known.name.clone()));
        }
        names
    }

    /// What these members say.
    pub fn answer(&self, table: &Table) -> Answer {
        let design = &self.file.design;
        let is_sample = (0..table.members.len()).any(|at| design.is_sample(table.members[at]));
        let asked = |at: &usize| !is_sample || design.is_sample(table.members[*at]);
        let some: Vec<usize> = (0..table.members.len()).filter(asked).collect();
        let of = |name: &str| {
            let values = table.values(name);
            some.iter().map(|at| values[*at]).collect::<Vec<_>>()
        };
        let numbers = |value: &Value| matches!(value, Value::Number(_) | Value::None { .. });
        let named = self.known.iter().filter(|known| numbers(&known.value));
        let spreads = named.clone().map(|known| {
            let values = of(&known.name).into_iter().flatten().collect();
            (known.name.clone(), known.unit, Spread::of(values))
        });
        // those of a selection are judged candidate by candidate
        let judged = match design {
            Design::Selection(..) => &[],
            _ => self.file.limits.as_slice(),
        };
        let why = lacking(table);
        let no_machine = limits::of_no_machine(|code| table.warns(code));
        let limits = judged.iter().map(|limit| {
            let unit = named.clone().find(|known| known.name == limit.quantity);
            let decisive = self.limited(table, limit);
            let here = |at: &&usize| {
                limit.case.is_none() || limit.case == self.case_of(table.members[**at])
            };
            let own: Vec<usize> = some.iter().filter(here).copied().collect();
            let values: Vec<Option<f64>> = own.iter().map(|at| decisive[*at]).collect();
            let unit = unit.map_or("", |known| known.unit);
            let mut found = match design {
                Design::Widened(..) => {
                    let members = own.iter().map(|at| table.members[*at]);
                    let weights = members.map(|k| design.weight(self.file.seed, k));
                    rare(limit, unit, &values, &why, &weights.collect::<Vec<_>>())
                }
                _ => limit_of(limit, unit, &values, &why, is_sample),
            };
            if own.is_empty() && !some.is_empty() {
                found.judged.verdict = Verdict::Undecided;
                found.judged.why = "no member is of its case".to_string();
            }
            found.judged = self.whirl_sought(found.judged, table, &own);
            found.judged = limits::withheld(found.judged, no_machine.as_deref());
            let (ran, asked) = (table.members.len(), self.members());
            if 0 < ran && ran < asked {
                let why = format!("{ran} of {asked} members have run");
                found.judged = limits::undecided(found.judged, why);
            }
            found
        });
        let sensitivity = self.shown().into_iter().filter_map(|name| {
            let unit = named.clone().find(|known| known.name == name)?.unit;
            // a design knows its members by their numbers, and some may not be there yet
            let mut values = vec![None; self.members()];
            for (member, value) in table.members.iter().zip(table.values(&name)) {
                if let Some(place) = values.get_mut(*member) {
                    *place = value;
                }
            }
            let of_it = self.sensitivity(&values)?;
            Some((name, unit, of_it))
        });
        Answer {
            members: table.members.len(),
            asked: self.members(),
            spreads: spreads.collect(),
            limits: limits.collect(),
            ranking: self.ranking(table),
            sensitivity: sensitivity.collect(),
            estimate: None,
        }
    }

    /// A verdict over some rows; of a limit of whirl by the unbalance angles that members try, and whether races that were touched come to
    /// their speed.
    pub(super) fn whirl_sought(&self, judged: Judged, table: &Table, rows: &[usize]) -> Judged {
        let declared = crate::warnings::of(&self.file.scenario);
        if !limits::seeks_whirl(&judged.limit, &self.known, &declared) {
            return judged;
        }
        let slips = limits::slips_asked(&self.known).any(|own| {
            let slips = table.values(&own.name);
            rows.iter().any(|row| slips[*row] > Some(0.0))
        });
        limits::whirl_sought(judged, self.unbalance_angles(table), slips)
    }

    /// How many unbalance angles at the release its members try.
    fn unbalance_angles(&self, table: &Table) -> usize {
        let column = table.column(&format!("input.{UNBALANCE_ANGLE}"));
        let angles = column.map_or(&[][..], |column| &column.values);
        let angles: BTreeSet<u64> = angles.iter().map(|angle| angle.to_bits()).collect();
        angles.len().max(1)
    }

    fn sensitivity(&self, values: &[Option<f64>]) -> Option<Sensitivity> {
        let seed = self.file.seed;
        match &self.file.design {
            Design::Morris(inputs, _) => Some(Sensitivity::Effects(effects(seed, *inputs, values))),
            Design::Saltelli(inputs, _) => {
                indices(seed ^ BANDS, *inputs, values).map(Sensitivity::Indices)
            }
            Design::Sweep(levels) => {
                let mut next = 1;
                let range = |count: &usize| {
                    let own = values.get(next..next + count).unwrap_or_default();
                    next += count;
                    let found: Vec<f64> = own.iter().flatten().copied().collect();
                    let low = found.iter().copied().fold(f64::INFINITY, f64::min);
                    let high = found.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                    (low <= high).then_some([low, high])
                };
                let ranges = levels.iter().map(range).collect();
                Some(Sensitivity::Sweep(
                    values.first().copied().flatten(),
                    ranges,
                ))
            }
            Design::Factorial(_)
            | Design::MonteCarlo(..)
            | Design::Widened(..)
            | Design::LatinHypercube(..)
            | Design::Sobol(..)
            | Design::Selection(..) => None,
        }
    }
}

/// A limit judged by members that were drawn from wider distributions: each that breaks it counts for its weight.
fn rare(
    limit: &Limit,
    unit: &'static str,
    values: &[Option<f64>],
    why: &str,
    weights: &[f64],
) -> StudyLimit {
    let mut judged = limits::judge(limit, unit, values, why);
    let breaks = |value: &f64| !limit.side.holds(*value, limit.bound);
    let shown: Vec<f64> = (values.iter().zip(weights))
        .map(|(value, weight)| match value.filter(breaks) {
            Some(_) => *weight,
            None => 0.0,
        })
        .collect();
    let open = values.iter().filter(|value| value.is_none()).count();
    let beyond = share::weighted(&shown).filter(|_| open == 0);
    let broken = shown.iter().filter(|weight| **weight > 0.0).count();
    let allowed = 1.0 - limit.share;
    // by what the members count for, not by their number
    judged.value = None;
    (judged.verdict, judged.why) = match beyond {
        None if open > 0 => (
            Verdict::Undecided,
            format!("{open} members have no value: {why}"),
        ),
        None => (
            Verdict::Undecided,
            format!(
                "{broken} of {} members of the widened design break it, and {} are needed for a probability: more members or a larger \
                 design.widen",
                values.len(),
                share::FEWEST
            ),
        ),
        Some((p, [low, high])) => {
            let verdict = match () {
                () if high <= allowed => Verdict::Pass,
                () if low >= allowed => Verdict::Fail,
                () => Verdict::Undecided,
            };
            let why = format!(
                "{broken} members of the widened design break it: a probability of {p:.2e}, from {low:.2e} to {high:.2e} with 95 %; \
                 {allowed:.2e} is allowed"
            );
            (verdict, why)
        }
    };
    StudyLimit { judged, beyond }
}

/// Why members of a table have no value.
fn lacking(table: &Table) -> String {
    let early = UNFINISHED.iter().filter(|(code, _)| table.warns(code));
    let early: String = early
        .map(|(code, why)| format!(", or {why} ({code})"))
        .collect();
    format!("they failed or have no such result{early}")
}

/// A limit judged: by the bounds of a share where members are a sample, else by counting.
fn limit_of(
    limit: &Limit,
    unit: &'static str,
    values: &[Option<f64>],
    why: &str,
    is_sample: bool,
) -> StudyLimit {
    let mut judged = limits::judge(limit, unit, values, why);
    let known = values.iter().flatten().count();
    if values.is_empty() {
        judged.why = "no member has run yet".to_string();
    } else if !is_sample {
        let broken = known - judged.hold;
        judged.verdict = match (broken, values.len() - known) {
            (0, 0) => Verdict::Pass,
            (0, _) => Verdict::Undecided,
            _ => Verdict::Fail,
        };
        judged.why = format!(
            "{broken} of {known} members with a value break it; members of this design are no sample, so no probability follows"
        );
    }
    let whole = is_sample && known == values.len() && known > 0;
    let beyond = known - judged.hold;
    StudyLimit {
        beyond: whole.then(|| (beyond as f64 / known as f64, share::wilson(beyond, known))),
        judged,
    }
}
