//! Candidates of a selection: each judged by the limits over all its draws, and ranked by a result.
//!
//! All candidates meet the same draws, so that what differs between two of them is the candidate, not the luck. How sure the first
//! place is, is told by drawing the draws with repetition: in how many of such repetitions a candidate is the first of those that
//! hold their limits.

use super::Study;
use super::table::{LATE, Table, warned_of};
use outcome::limits::{self, CONTACTS};
use outcome::{Judged, Verdict};
use scenario::{Forbidden, Side};
use statistics::design::{Coordinate, Design};
use statistics::random::below;

/// Repetitions of the draws.
const REPETITIONS: u64 = 500;
/// Apart from the numbers of the design.
const REPEATED: u64 = 0x9e37_79b9_7f4a_7c15;
/// Share of the draws whose result is not worse than what a candidate is ranked by.
const QUANTILE: f64 = 0.95;

/// A candidate with its verdict.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// What it is: paths with their values, as an override has them.
    pub values: Vec<(String, String)>,
    /// Its first member.
    pub member: usize,
    /// Draws computed, and those without a result.
    pub draws: [usize; 2],
    /// What it is ranked by: a result that 95 % of its draws do not exceed, or do not fall below where most is best.
    pub quantile: Option<f64>,
    /// Mean of that result.
    pub mean: Option<f64>,
    /// Share of the repetitions in which it comes first.
    pub first: f64,
    /// Fail where one limit fails, pass where all pass.
    pub verdict: Verdict,
    /// Each limit of its case, judged over its draws.
    pub limits: Vec<Judged>,
    /// Of each limit, the member that comes nearest to it, or is the farthest beyond.
    pub worst: Vec<Option<usize>>,
    /// Why nothing is decided whatever its limits say.
    pub open: Option<String>,
    /// Why members failed, once.
    pub why: Option<String>,
}

impl Candidate {
    /// The limit whose bound is nearest, as a share of it, or farthest exceeded, with that share and its member.
    pub fn nearest(&self) -> Option<(&Judged, f64, usize)> {
        let all = self.limits.iter().zip(&self.worst);
        let known = all.filter(|(judged, _)| judged.limit.share >= 1.0);
        let known = known.filter_map(|(judged, worst)| Some((judged, judged.margin()?, (*worst)?)));
        known.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The limits that it does not hold.
    pub fn broken(&self) -> impl Iterator<Item = &Judged> {
        let limits = self.limits.iter();
        limits.filter(|judged| judged.verdict != Verdict::Pass)
    }
}

impl Study {
    /// Unit of a result.
    fn unit_of(&self, name: &str) -> &'static str {
        let known = self.known.iter().find(|known| known.name == name);
        known.map_or("", |known| known.unit)
    }

    /// Candidates of a selection, the best first; none of other designs.
    pub fn ranking(&self, table: &Table) -> Vec<Candidate> {
        let Design::Selection(levels, draws) = &self.file.design else {
            return Vec::new();
        };
        let rank = self.file.rank.as_ref();
        let (name, most) = rank.map_or(("", false), |(name, most, _)| (name.as_str(), *most));
        let rows = |candidate: usize| -> Vec<usize> {
            let members = table.members.iter().enumerate();
            let own = members.filter(|(_, member)| **member / draws == candidate);
            own.map(|(row, _)| row).collect()
        };
        let ranked = match rank {
            Some(_) => table.decisive(name, f64::INFINITY),
            None => vec![None; table.members.len()],
        };
        let count = self.members() / draws;
        let all: Vec<Vec<usize>> = (0..count).map(rows).collect();
        let mut found: Vec<Candidate> = (all.iter().enumerate())
            .map(|(k, rows)| self.judged(k * draws, rows, table, &ranked, most, levels))
            .collect();
        if rank.is_none() {
            // cases stand in the order of their file, those that have not run as well
            return found;
        }
        self.first_places(&mut found, &all, &ranked, most);
        let place = |one: &Candidate| match one.verdict {
            Verdict::Pass => 0,
            Verdict::Undecided => 1,
            Verdict::Fail => 2,
        };
        let worst = f64::INFINITY;
        let value = |one: &Candidate| match most {
            true => one.quantile.map_or(worst, |value| -value),
            false => one.quantile.unwrap_or(worst),
        };
        found.retain(|one| one.draws[0] > 0);
        found.sort_by(|a, b| {
            let verdict = place(a).cmp(&place(b));
            verdict.then(value(a).total_cmp(&value(b)))
        });
        found
    }

    fn judged(
        &self,
        member: usize,
        rows: &[usize],
        table: &Table,
        ranked: &[Option<f64>],
        most: bool,
        levels: &[usize],
    ) -> Candidate {
        let failed: Vec<&String> = (rows.iter())
            .filter_map(|row| table.failed.get(&table.members[*row]))
            .collect();
        let lacking = match failed.len() {
            0 => "some draws have no such result".to_string(),
            count => format!("{count} of {} draws failed", rows.len()),
        };
        let mut values = Vec::new();
        let coordinates = self.file.design.member(self.file.seed, member);
        for ((input, coordinate), count) in self.file.inputs.iter().zip(coordinates).zip(levels) {
            if *count > 0 && matches!(coordinate, Coordinate::Level(..)) {
                values.extend(input.vary.at(coordinate).0);
            }
        }
        let of = |values: &[Option<f64>]| -> Vec<Option<f64>> {
            rows.iter().map(|row| values[*row]).collect()
        };
        let case = self.case_of(member);
        let no_machine = limits::of_no_machine(|code| table.warns(code));
        let own = self.file.limits.iter();
        let own = own.filter(|limit| limit.case.is_none() || limit.case == case);
        let judged = own.map(|limit| {
            let values = of(&self.limited(table, limit));
            let judged = limits::judge(limit, self.unit_of(&limit.quantity), &values, &lacking);
            let judged = self.whirl_sought(judged, table, rows);
            let judged = limits::withheld(judged, no_machine.as_deref());
            let size = |value: f64| {
                if limit.side == Side::Most {
                    value
                } else {
                    -value
                }
            };
            let known = rows
                .iter()
                .zip(&values)
                .filter_map(|(row, value)| Some((*row, (*value)?)));
            // of equal ones the first
            let worst = known.rev().max_by(|a, b| size(a.1).total_cmp(&size(b.1)));
            (judged, worst.map(|(row, _)| table.members[row]))
        });
        let (limits, worst): (Vec<Judged>, Vec<Option<usize>>) = judged.unzip();
        let own: Vec<f64> = of(ranked).into_iter().flatten().collect();
        let any = |verdict: Verdict| limits.iter().any(|judged| judged.verdict == verdict);
        let open = self.open(rows, table, limits.is_empty());
        let undecided = any(Verdict::Undecided) || !failed.is_empty() || open.is_some();
        let verdict = match (any(Verdict::Fail), undecided) {
            (true, _) => Verdict::Fail,
            (false, true) => Verdict::Undecided,
            (false, false) => Verdict::Pass,
        };
        Candidate {
            values,
            member,
            draws: [rows.len(), failed.len()],
            quantile: quantile(own.clone(), most),
            mean: (!own.is_empty()).then(|| own.iter().sum::<f64>() / own.len() as f64),
            first: 0.0,
            verdict,
            limits,
            worst,
            open,
            why: failed.first().map(|why| why.to_string()),
        }
    }

    /// Why a case of a qualification is not decided: draws that have not run, nothing that is judged, or what should happen and did not.
    fn open(&self, rows: &[usize], table: &Table, unlimited: bool) -> Option<String> {
        let Design::Selection(_, draws) = self.file.design else {
            return None;
        };
        if self.file.rank.is_some() {
            return None;
        }
        if rows.len() < draws {
            return Some(format!("{} of {draws} draws have run", rows.len()));
        }
        if unlimited {
            return Some("no limit is of this case".to_string());
        }
        // what failed has reasons of its own
        let ended = |row: &&usize| !table.failed.contains_key(&table.members[**row]);
        let rows: Vec<usize> = rows.iter().filter(ended).copied().collect();
        if let Some(why) = self.cut_short(&rows, table) {
            return Some(why);
        }
        let mut never = limits::NEVER.iter().filter_map(|(code, why)| {
            let warned = warned_of(table, &Forbidden::Code(code.to_string()), &[]);
            let some = rows.iter().filter(|row| warned[**row] == Some(1.0)).count();
            (some > 0).then(|| format!("{why} in {some} of {draws} draws ({code})"))
        });
        never.next()
    }

    /// Why what follows is not in these runs: of a loss of all power the rotor has not landed when they end, or a race slips on it still.
    fn cut_short(&self, rows: &[usize], table: &Table) -> Option<String> {
        let named = |last: &str| -> Vec<&str> {
            let known = self.known.iter().map(|known| known.name.as_str());
            known.filter(|name| limits::is_of(name, last)).collect()
        };
        let first = |last: &str| {
            named(last)
                .first()
                .map_or(vec![None; table.members.len()], |name| table.values(name))
        };
        let (lost, held) = (first("power_lost_at"), first("relevitation_held"));
        let of = named(CONTACTS).into_iter();
        let all: Vec<_> = of
            .map(|name| {
                let late = format!("{LATE}{}", name.replace(CONTACTS, limits::SPIN_UP));
                (table.values(name), table.values(&late))
            })
            .collect();
        let released = |row: &&usize| lost[**row].is_some() && held[**row].is_none();
        let touched = |row: usize| {
            all.iter()
                .filter(move |(contacts, _)| contacts[row] > Some(0.0))
        };
        let slipping: Vec<_> = (named(limits::SLIPS).into_iter())
            .map(|name| table.values(name))
            .collect();
        let slips_on = |row: &usize| slipping.iter().any(|slips| slips[*row] > Some(0.0));
        let lands_late = |row: &usize| touched(*row).any(|(_, late)| late[*row].is_some());
        let falls = rows.iter().filter(released);
        let falls = falls.filter(|row| touched(**row).count() == 0).count();
        let slips = rows
            .iter()
            .filter(|row| slips_on(row) || released(row) && lands_late(row));
        let slips = slips.count();
        let of = rows.len();
        match (falls, slips) {
            (0, 0) => None,
            (0, _) => Some(format!(
                "{slips} of {of} runs end while the rotor slips on a race or bushing that is below 95 % of its speed"
            )),
            _ => Some(format!(
                "the rotor has not landed when {falls} of {of} runs end"
            )),
        }
    }

    /// How often each candidate that holds its limits comes first when the draws are drawn with repetition.
    fn first_places(
        &self,
        found: &mut [Candidate],
        all: &[Vec<usize>],
        ranked: &[Option<f64>],
        most: bool,
    ) {
        let Design::Selection(_, draws) = self.file.design else {
            return;
        };
        let passing = |one: &Candidate| one.verdict == Verdict::Pass && one.draws[0] == draws;
        let able: Vec<usize> = (0..found.len()).filter(|k| passing(&found[*k])).collect();
        for repetition in 0..REPETITIONS {
            let drawn: Vec<usize> = (0..draws as u64)
                .map(|at| below(draws, self.file.seed ^ REPEATED, repetition, at))
                .collect();
            let value = |k: &usize| {
                let rows = drawn.iter().map(|at| all[*k][*at]);
                let own: Vec<f64> = rows.filter_map(|row| ranked[row]).collect();
                let value = quantile(own, most).unwrap_or(f64::INFINITY);
                if most { -value } else { value }
            };
            let best = able.iter().min_by(|a, b| value(a).total_cmp(&value(b)));
            if let Some(best) = best {
                found[*best].first += 1.0 / REPETITIONS as f64;
            }
        }
    }
}

/// What 95 % of the values do not exceed, or do not fall below where most is best; between the sorted values on straight lines.
fn quantile(mut values: Vec<f64>, most: bool) -> Option<f64> {
    values.retain(|value| value.is_finite());
    values.sort_by(f64::total_cmp);
    if most {
        values.reverse();
    }
    let last = values.len().checked_sub(1)?;
    let place = QUANTILE * last as f64;
    let below = place as usize;
    let above = (below + 1).min(last);
    Some(values[below] + (place - below as f64) * (values[above] - values[below]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantile_lies_between_the_sorted_values() {
        let values: Vec<f64> = (0..21).rev().map(f64::from).collect();
        assert_eq!(quantile(values.clone(), false), Some(19.0));
        assert_eq!(quantile(values, true), Some(1.0));
        assert_eq!(quantile(vec![f64::NAN], false), None);
    }
}
