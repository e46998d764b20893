//! A requirement with its verdict: over the runs of all its cases, and over drops in a row.

use super::{Document, of_values};
use crate::page::escape_text as plain;
use outcome::{Judged, Verdict};
use run::study::selection::Candidate;
use scenario::{Limit, Side};

/// A requirement with its verdict.
pub(super) struct Requirement<'a> {
    pub limit: &'a Limit,
    /// The case at its level that is nearest to it or the farthest beyond.
    pub worst: Option<(&'a Candidate, &'a Judged, Option<usize>)>,
    /// The value that drops in a row come to, and where, if that is worse.
    pub in_a_row: Option<(f64, String)>,
    /// Met, not met or not shown.
    pub verdict: Verdict,
    /// Why it is not shown.
    pub why: String,
}

impl Requirement<'_> {
    /// How the worst case is judged, with the worst value, be it that of drops in a row.
    pub fn judged(&self) -> Option<Judged> {
        let (_, judged, _) = self.worst?;
        let mut judged = judged.clone();
        if let Some((value, _)) = &self.in_a_row {
            judged.value = Some(*value);
        }
        Some(judged)
    }
}

impl Document<'_> {
    /// The requirements in the order of their files.
    pub(super) fn requirements(&self) -> Vec<Requirement<'_>> {
        let limits = self.study.file.limits.iter();
        limits.map(|limit| self.requirement(limit)).collect()
    }

    fn requirement<'a>(&'a self, limit: &'a Limit) -> Requirement<'a> {
        let judged = self.answer.ranking.iter().flat_map(|one| {
            let own = one.limits.iter().zip(&one.worst);
            let own = own.filter(|(judged, _)| judged.limit == *limit);
            own.map(move |(judged, worst)| (one, judged, *worst))
        });
        let all: Vec<_> = judged.collect();
        let any = |verdict| all.iter().find(|(_, judged, _)| judged.verdict == verdict);
        // what is missing says more than what is not known for lack of it
        let open = all
            .iter()
            .find_map(|(one, ..)| Some((one, one.open.clone()?)));
        // what no run can have is not for more or longer runs to decide
        let known = self.study.known.iter();
        let mut never = known.filter(|own| own.name == limit.quantity);
        let never = never.find_map(|own| {
            let never = self.table.reached(&own.name).iter().all(Option::is_none);
            own.why_never().filter(|_| never)
        });
        let failed = all.iter().find(|(one, ..)| one.draws[1] > 0);
        let failed = failed.map(|(one, ..)| {
            let why = one.why.as_deref().unwrap_or_default();
            let [draws, failed] = one.draws;
            (one, format!("{failed} of {draws} draws failed: {why}"))
        });
        // of several that the one farthest from a verdict
        let undecided = all
            .iter()
            .filter(|(_, judged, _)| judged.verdict == Verdict::Undecided);
        let undecided = undecided.min_by_key(|(_, judged, _)| judged.hold);
        let undecided = undecided.map(|(one, judged, _)| (one, judged.why.clone()));
        let named = |(one, why): (&&Candidate, String)| {
            format!("{}: {}", of_values(&one.values), plain(&why))
        };
        let rows = self.rows.iter().enumerate();
        let rows = rows.filter(|(_, row)| {
            limit.case.is_none() || limit.case == self.study.case_of(row.member)
        });
        let size = |value: f64| match limit.side {
            Side::Most => value,
            Side::Least => -value,
        };
        let in_a_row = rows.flat_map(|(k, row)| {
            let after = self.after_each(self.of_row(k, row, limit), limit);
            let known = after.into_iter().enumerate();
            known.filter_map(move |(drop, value)| Some((row, drop + 1, value?)))
        });
        let in_a_row = in_a_row.max_by(|a, b| size(a.2).total_cmp(&size(b.2)));
        let in_a_row = in_a_row.map(|(row, drop, value)| {
            let values = of_values(&row.values);
            let place = match (self.adds_up(limit), drop) {
                (true, 2..) => format!("{values}: sum of {drop} drops in a row"),
                _ => format!("{values}: drop {drop} in a row"),
            };
            (value, place)
        });
        let broken = in_a_row
            .as_ref()
            .filter(|(value, _)| !limit.side.holds(*value, limit.bound));
        let (verdict, why) = match (any(Verdict::Fail), failed.or(open).or(undecided)) {
            _ if all.is_empty() => (Verdict::Undecided, "no case was judged by it".to_string()),
            (Some((one, judged, _)), _) => (Verdict::Fail, named((one, judged.why.clone()))),
            (None, _) if broken.is_some() => {
                let place = broken.map_or_else(String::new, |(_, place)| place.clone());
                (Verdict::Fail, place)
            }
            (None, _) if never.is_some() => (Verdict::Undecided, plain(never.unwrap_or_default())),
            (None, Some(lacking)) => (Verdict::Undecided, named(lacking)),
            (None, None) => (Verdict::Pass, String::new()),
        };
        let side = |judged: &Judged| judged.value.map_or(f64::INFINITY, |value| -size(value));
        // one that breaks it first, also by what never came and has no value
        let holds = |judged: &Judged| judged.verdict != Verdict::Fail;
        let worst = (all.into_iter()).min_by(|a, b| {
            let order = holds(a.1).cmp(&holds(b.1));
            order.then(side(a.1).total_cmp(&side(b.1)))
        });
        let value = worst.and_then(|(_, judged, _)| judged.value);
        let in_a_row = in_a_row.filter(|(own, _)| value.is_none_or(|of| size(*own) > size(of)));
        Requirement {
            limit,
            worst,
            in_a_row,
            verdict,
            why,
        }
    }
}
