//! Limits judged: whether a result holds its bound in one run, or in the share of runs that is asked for.
//!
//! A single run holds a bound or does not. Of a repeated run either all members must hold it (share 1), or the share of *all
//! such runs* must reach a level; the members are a sample of these, and what it shows is bounded by the binomial law:
//!
//! ```text
//!   pass        P(at least h of n hold | share) <= 5 %    the lower bound of the share is not below the level
//!   fail        P(at most  h of n hold | share) <= 5 %    the upper bound is not above it
//!   undecided   neither: n is too small
//! ```
//! These are the one-sided bounds of Clopper and Pearson, Biometrika 26 (1934) 404 (from memory); that 59 runs without an
//! exception show 95 % with 95 % confidence (Wilks, Ann. Math. Stat. 12 (1941) 91, from memory) is the case h = n.
//!
//! What is not known, of a run that ended early or a result that does not exist, neither holds nor breaks a bound: the verdict
//! is one that stands either way, or none.

use crate::forbidden;
use crate::list::NOT_GIVEN;
use crate::whirl::slips_in;
pub use crate::whirl::{
    CONTACTS, SLIPS, SPIN_UP, WHIRL, contacts_of, is_of, seeks_whirl, sized, slips_asked,
    whirl_sought,
};
use crate::withheld::warned;
pub use crate::withheld::{
    CUT_BEFORE_COASTING, NEVER, UNFINISHED, left_open, of_no_machine, stays_broken, undecided,
    withheld,
};
use crate::{Judged, Outcome, Quantity, Value, Verdict};
use problem::warning::Declared;
use problem::{Code, Problem, Result, did_you_mean, question};
use scenario::{Limit, Scenario, Side, UNBALANCE_ANGLE, present_name};
use statistics::share::{
    CONFIDENCE, MOST_MEMBERS, at_least_shown, at_most_shown, more_members, shows_missed,
    shows_reached,
};
use std::collections::BTreeSet;
use units::{Dimension, Unit};

/// Names of results that a message lists.
const MOST_NAMES: usize = 8;

/// Refuses limits of results that a run does not have, or of another dimension; `known` are its results, without values
/// where these are not known before the run. A `*` in the name of one stands for what the run finds.
pub fn check(limits: &[Limit], known: &[Quantity], declared: &[&'static Declared]) -> Result<()> {
    for limit in limits {
        if let Some(forbids) = &limit.forbids {
            forbidden::check(limit, forbids, declared)?;
            continue;
        }
        let named = |known: &&Quantity| {
            is_name(&known.name, &limit.quantity) || fits(&limit.quantity, known)
        };
        let meant: Vec<&Quantity> = known.iter().filter(named).collect();
        let Some(quantity) = meant.first() else {
            return Err(unknown(limit, known));
        };
        if is_of(&quantity.name, WHIRL) && limit.side == Side::Least {
            let found = "least, which turns in the other sense hide".to_string();
            let allowed = "backward_whirl_turns with most is needed".to_string();
            return Err(limit.problem(Code::Impossible, found, allowed));
        }
        let kind = match quantity.value {
            Value::Text(_) => Some("a word"),
            Value::List(_) => Some("a list"),
            Value::Number(_) | Value::None { .. } => None,
        };
        if let Some(kind) = kind {
            let found = format!("\"{}\", which is {kind}", limit.quantity);
            let allowed = "the name of a result that is a number is needed".to_string();
            let code = Code::UnknownQuantity;
            return Err(limit.problem(code, found, allowed));
        }
        if let Value::None { why } = &quantity.value
            && why.ends_with(NOT_GIVEN)
        {
            let found = format!(
                "\"{}\", which this run will not have: {why}",
                limit.quantity
            );
            let allowed = "what it is computed from, or no limit of it, is needed".to_string();
            let code = Code::UnknownQuantity;
            return Err(limit.problem(code, found, allowed));
        }
        // one bound is no bound of results of several dimensions
        let differs = |own: &&&Quantity| {
            dimension_of(own.unit).is_some_and(|wanted| wanted != limit.dimension)
        };
        if let Some(other) = meant.iter().find(differs) {
            let is = |dimension: Dimension| match dimension {
                Dimension::NONE => "a bare number".to_string(),
                dimension => dimension.to_string(),
            };
            let found = format!("{}, which is {}", limit.text, is(limit.dimension));
            let allowed = format!(
                "{} is {}",
                other.name,
                dimension_of(other.unit).map_or(other.unit.to_string(), is)
            );
            let code = Code::WrongDimension;
            return Err(limit.bound_problem(code, found, allowed));
        }
    }
    Ok(())
}

/// Each limit of a pattern as limits of all results that it stands for.
pub fn named(limits: &[Limit], known: &[Quantity]) -> Vec<Limit> {
    let each = |limit: &Limit| {
        let among = known.iter().filter(|known| fits(&limit.quantity, known));
        let own: Vec<Limit> = among.map(|known| limit.of(&known.name)).collect();
        match own.is_empty() {
            true => vec![limit.clone()],
            false => own,
        }
    };
    limits.iter().flat_map(each).collect()
}

/// Whether a pattern stands for a number among the results: `*.x` for x of each bearing, and of the only one.
pub fn fits(pattern: &str, known: &Quantity) -> bool {
    let is_number = matches!(known.value, Value::Number(_) | Value::None { .. });
    pattern.contains('*') && is_number && stands_for(pattern, &known.name)
}

/// Whether a name or pattern stands for this name of a result or column.
pub fn stands_for(pattern: &str, name: &str) -> bool {
    let pattern = &present_name(pattern)[..];
    is_name(pattern, name) || pattern.strip_prefix("*.") == Some(name)
}

/// The names that may be meant, as a question: those that end alike, as with several bearings each has its own, or are spelled alike.
pub fn meant(name: &str, known: &[&str]) -> Option<String> {
    let ends: Vec<&str> = known
        .iter()
        .filter_map(|known| known.rsplit('.').next())
        .collect();
    let end = name.rsplit('.').next().unwrap_or(name);
    let alike = known.iter().zip(&ends).filter(|(_, own)| **own == end);
    let alike: Vec<&str> = alike.map(|(known, _)| *known).take(3).collect();
    question(&alike).or_else(|| match name.starts_with('*') {
        true => {
            let ends: Vec<String> = ends.iter().map(|end| format!("*.{end}")).collect();
            did_you_mean(&format!("*.{end}"), ends.iter().map(String::as_str))
        }
        false => did_you_mean(name, known.iter().copied()),
    })
}

/// Whether a listed name stands for this one: each `*` of it is one or more characters without a point.
fn is_name(listed: &str, name: &str) -> bool {
    let Some((start, end)) = listed.split_once('*') else {
        return listed == name;
    };
    let rest = name.strip_prefix(start).unwrap_or_default();
    let mut taken = rest.char_indices().take_while(|(_, letter)| *letter != '.');
    taken.any(|(at, letter)| is_name(end, &rest[at + letter.len_utf8()..]))
}

/// The dimension of a result; none of a unit that limits cannot have.
fn dimension_of(unit: &str) -> Option<Dimension> {
    match unit {
        "" | "1" => Some(Dimension::NONE),
        unit => Unit::parse(unit).ok().map(|unit| unit.dimension()),
    }
}

/// A limit of a result that is not there, with what is.
fn unknown(limit: &Limit, known: &[Quantity]) -> Box<Problem> {
    let name = limit.quantity.as_str();
    let names: Vec<&str> = known.iter().map(|known| known.name.as_str()).collect();
    let allowed = if known.len() <= MOST_NAMES {
        format!("the results are {}", names.join(", "))
    } else {
        format!(
            "the name of one of the {} results is needed; auxbear results FILE lists them, e.g. {}",
            known.len(),
            known[0].name
        )
    };
    let found = format!("\"{name}\", which is no result of this run");
    (limit.problem(Code::UnknownQuantity, found, allowed)).with_hint(meant(name, &names))
}

/// The verdicts of a run.
pub fn of(scenario: &Scenario, outcome: &Outcome, declared: &[&'static Declared]) -> Vec<Judged> {
    // a member that draws none has that of the file
    let angle_of = |drawn: &Vec<(String, String)>| {
        let mut drawn = drawn.iter();
        drawn
            .find(|(path, _)| path == UNBALANCE_ANGLE)
            .map(|(_, angle)| angle.clone())
    };
    let angles: BTreeSet<Option<String>> = outcome.drawn.iter().map(angle_of).collect();
    let no_machine = of_no_machine(|code| outcome.warnings.iter().any(|own| own.code == code));
    let judged = |limit: &Limit| {
        let mut quantities = outcome.quantities.iter();
        let quantity = quantities.find(|quantity| quantity.name == limit.quantity);
        let (unit, values, why) = match (&limit.forbids, quantity) {
            (Some(forbids), _) => {
                let (values, why) = forbidden::values(scenario, outcome, declared, forbids);
                ("", values, why)
            }
            (None, Some(quantity)) => {
                let (values, why) = values_of(quantity, limit, outcome);
                (quantity.unit, values, why)
            }
            (None, None) => ("", vec![None], "this run has no such result".to_string()),
        };
        let mut judged = forbidden::explained(judge(limit, unit, &values, &why), outcome);
        // what it was until then
        if let ([None], Some(Value::Number(value))) = (&values[..], quantity.map(|own| &own.value))
        {
            judged.value = Some(sized(limit, *value));
        }
        let judged = match seeks_whirl(limit, &outcome.quantities, declared) {
            true => whirl_sought(judged, angles.len().max(1), slips_in(outcome)),
            false => judged,
        };
        withheld(judged, no_machine.as_deref())
    };
    let limits = named(&scenario.limits_here(), &outcome.quantities);
    limits.iter().map(judged).collect()
}

/// Why members that ended as planned have no value.
const LACKING: &str = "it does not exist in these, or they end too soon";

/// The values of a result in each member that was asked for, and why some are not known. An instant that did not come while
/// the run lasted, which is longer than the bound, is infinite: whenever it comes, the bound is passed.
fn values_of(quantity: &Quantity, limit: &Limit, outcome: &Outcome) -> (Vec<Option<f64>>, String) {
    let bound = limit.bound;
    let early = || outcome.stop.text.trim_end_matches('.').to_string();
    let from = crate::counted_from(&outcome.quantities).filter(|_| quantity.awaited);
    // nobody watches for it during a coast-down
    let from = from.filter(|_| !warned(outcome, CUT_BEFORE_COASTING, &quantity.name));
    let beyond = |end: f64| (end - from? > bound).then_some(f64::INFINITY);
    let asked = outcome.work.members;
    if asked > 1 {
        let members = &outcome.members;
        let mut values = members.limited(limit, Some(quantity));
        let why = match values.len() < asked {
            true => early(),
            false => LACKING.to_string(),
        };
        values.resize(asked, None);
        return (values, why);
    }
    let open = |is_instant: bool| {
        let mut open = left_open(&quantity.name, is_instant);
        open.find(|(code, _)| warned(outcome, code, &quantity.name))
    };
    // what has not come may come later
    let cut = open(false).filter(|_| outcome.stop.complete());
    let whole = outcome.stop.complete() && cut.is_none();
    let idle = || {
        contacts_of(&quantity.name)
            .is_some_and(|names| names.map(|name| outcome.number(&name).unwrap_or(0.0)) == [0.0; 2])
    };
    match (&quantity.value, outcome.stop.complete()) {
        (Value::None { .. }, true) if whole && quantity.of_contacts => {
            (vec![Some(0.0)], String::new())
        }
        (Value::None { .. }, true) if whole && idle() => {
            // it comes to no speed, and need not
            (vec![Some(0.0)], "the rotor does not touch it".to_string())
        }
        (Value::None { why }, _) => match (beyond(outcome.stop.time), quantity.awaited) {
            (Some(late), _) => (vec![Some(late)], format!("{why}, which is past the bound")),
            (None, true) => (vec![None], format!("{why}, which is not past the bound")),
            (None, false) => {
                let cut = cut.map(|(_, why)| why);
                (vec![None], cut.unwrap_or_else(|| why.clone()))
            }
        },
        // what is broken when a run stops stays so
        (Value::Number(value), false)
            if !outcome.stop.interrupted() && !limit.side.holds(sized(limit, *value), bound) =>
        {
            (vec![Some(*value)], early())
        }
        (_, false) => (vec![None], early()),
        (Value::Number(value), true) => match open(quantity.awaited) {
            Some((_, why))
                if limit.side.holds(sized(limit, *value), bound) || !stays_broken(limit) =>
            {
                (vec![None], why)
            }
            _ => (vec![Some(*value)], String::new()),
        },
        (Value::Text(_) | Value::List(_), true) => {
            let why = "it is no number, and a limit holds one number".to_string();
            (vec![None], why)
        }
    }
}

/// Judges the values of all members, of which those not known are none; `why` says why they are not, or of the only one why it
/// is infinite.
pub fn judge(limit: &Limit, unit: &'static str, values: &[Option<f64>], why: &str) -> Judged {
    let members = values.len();
    let holds = |value: &f64| limit.side.holds(*value, limit.bound);
    let known = values.iter().flatten();
    let known: Vec<f64> = known.map(|value| sized(limit, *value)).collect();
    let hold = known.iter().filter(|value| holds(value)).count();
    let open = members - known.len();
    let late = known.iter().filter(|value| value.is_infinite()).count();
    let (verdict, mut reason) = match (members, limit.share) {
        (0 | 1, share) if share >= 1.0 => {
            let reason = |value: f64| match value.is_finite() {
                true => room(limit, value),
                false => why.to_string(),
            };
            match known.first() {
                None => (Verdict::Undecided, why.to_string()),
                Some(value) if holds(value) => (Verdict::Pass, reason(*value)),
                Some(value) => (Verdict::Fail, reason(*value)),
            }
        }
        (0, _) => (Verdict::Undecided, why.to_string()),
        (_, share) if share >= 1.0 => of_all(members, hold, open, why),
        (_, share) => of_share(share, members, hold, open, why),
    };
    if late > 0 && members > 1 {
        reason.push_str(&format!(
            "; in {late} it did not come while the run lasted, which is past the bound"
        ));
    }
    Judged {
        limit: limit.clone(),
        unit,
        value: deciding(limit, known, members),
        members,
        hold,
        verdict,
        why: reason,
    }
}

/// The value that the share of the members holds: the worst of them for a share of 1. None where it is not known and none that is known breaks the bound.
fn deciding(limit: &Limit, mut known: Vec<f64>, members: usize) -> Option<f64> {
    known.sort_by(f64::total_cmp);
    if limit.side == Side::Least {
        known.reverse();
    }
    // one that breaks it decides, whatever the others are
    let breaks = |value: &f64| limit.share >= 1.0 && !limit.side.holds(*value, limit.bound);
    if let Some(worst) = known.last().copied().filter(breaks) {
        return Some(worst).filter(|worst| worst.is_finite());
    }
    // rounding of a share that is a whole number of members
    let place = (limit.share * members as f64 - 1e-9).ceil().max(1.0) as usize;
    known
        .get(place - 1)
        .copied()
        .filter(|value| value.is_finite())
}

/// How far a value is from its bound.
fn room(limit: &Limit, value: f64) -> String {
    let beyond = if value < limit.bound {
        "below"
    } else {
        "above"
    };
    if value == limit.bound {
        return "just at the bound".to_string();
    }
    if limit.quantity.ends_with("_temperature") {
        // a share of kelvins says nothing
        let apart = (value - limit.bound).abs();
        return format!("{apart:.1} K {beyond} the bound");
    }
    match ((value - limit.bound) / limit.bound).abs() {
        share if share.is_finite() => format!("{} {beyond} the bound", percent(share)),
        _ => format!("{beyond} the bound"),
    }
}

/// All members must hold it.
fn of_all(members: usize, hold: usize, open: usize, why: &str) -> (Verdict, String) {
    let broken = members - hold - open;
    if broken > 0 {
        let lacking = match open {
            0 => String::new(),
            _ => format!("; {open} have no value: {why}"),
        };
        return (
            Verdict::Fail,
            format!("{broken} of {members} members break it{lacking}"),
        );
    }
    if open > 0 {
        return (
            Verdict::Undecided,
            format!("{open} of {members} members have no value: {why}"),
        );
    }
    let shown = at_least_shown(hold, members);
    (
        Verdict::Pass,
        format!(
            "all {members} members hold it; that shows with {} confidence that {} or more of such runs do",
            percent(CONFIDENCE),
            percent(shown)
        ),
    )
}

/// A share of all such runs must hold it.
fn of_share(share: f64, members: usize, hold: usize, open: usize, why: &str) -> (Verdict, String) {
    let (least, most) = (hold, hold + open);
    let held = match open {
        0 => format!("{hold} of {members} members hold it"),
        _ => format!("{hold} of {members} members hold it, {open} have no value ({why})"),
    };
    let with = format!("with {} confidence", percent(CONFIDENCE));
    if shows_reached(share, least, members) {
        let shown = percent(at_least_shown(least, members));
        let reason = format!("{held}: {with} {shown} or more of such runs do");
        return (Verdict::Pass, reason);
    }
    if shows_missed(share, most, members) {
        let shown = percent(at_most_shown(most, members));
        let reason = format!("{held}: {with} {shown} or fewer of such runs do");
        return (Verdict::Fail, reason);
    }
    let from = percent(at_least_shown(least, members));
    let to = percent(at_most_shown(most, members));
    let more = match more_members(share, hold, members) {
        _ if open > 0 => String::new(),
        Some(more) if hold == members => {
            format!("; {more} more that all hold it would decide")
        }
        Some(more) => format!("; about {more} more would decide if their share stays the same"),
        None => format!("; more than {MOST_MEMBERS} would be needed if their share stays the same"),
    };
    (
        Verdict::Undecided,
        format!(
            "{held}: from {from} to {to} of such runs do (each bound {with}), and {} are asked for{more}",
            percent(share)
        ),
    )
}

/// A share to three digits.
fn percent(share: f64) -> String {
    let text = format!("{:.2e}", 1e2 * share);
    let rounded = text.parse().unwrap_or(1e2 * share);
    format!("{} %", units::number_text(rounded))
}

#[cfg(test)]
mod tests {
    use super::*;
    use problem::Place;

    fn limit(side: Side, bound: f64, share: f64) -> Limit {
        Limit {
            quantity: "force".to_string(),
            side,
            bound,
            share,
            case: None,
            source: None,
            forbids: None,
            dimension: Dimension::NONE,
            text: units::number_text(bound),
            place: Place::Whole,
            bound_place: Place::Whole,
        }
    }

    fn judged(limit: &Limit, hold: usize, broken: usize, open: usize) -> Judged {
        let mut values = vec![Some(1.0); hold];
        values.extend(vec![Some(3.0); broken]);
        values.extend(vec![None; open]);
        judge(limit, "N", &values, "it ended early")
    }

    #[test]
    fn a_star_stands_for_what_the_run_finds() {
        for (listed, name, same) in [
            ("mass", "mass", true),
            ("critical_*.speed", "critical_12.speed", true),
            ("critical_*.speed", "critical_.speed", false),
            ("critical_*.speed", "critical_1.2.speed", false),
            ("critical_*.speed", "critical_1.speeds", false),
            ("map_forward_*", "map_forward_é", true),
            ("map_forward_*", "map_backward_1", false),
            ("a_*_b_*", "a_1_b_2_b_3", true),
        ] {
            assert_eq!(is_name(listed, name), same, "{listed} {name}");
        }
    }

    #[test]
    fn at_most_so_many_turns_of_whirl_are_meant_in_either_sense() {
        let turns = |side, bound| Limit {
            quantity: "drive_end.whirl_turns".to_string(),
            ..limit(side, bound, 1.0)
        };
        let all = [Some(-49.6), Some(-0.3), Some(0.4)];
        let found = judge(&turns(Side::Most, 1.0), "", &all, "");
        assert_eq!((found.verdict, found.value), (Verdict::Fail, Some(49.6)));
        let found = judge(&turns(Side::Most, 1.0), "", &all[1..], "");
        assert_eq!((found.verdict, found.value), (Verdict::Pass, Some(0.4)));
        let found = judge(&turns(Side::Least, -1.0), "", &all, "");
        assert_eq!((found.verdict, found.value), (Verdict::Fail, Some(-49.6)));
    }

    #[test]
    fn fifty_nine_runs_without_exception_show_95_percent() {
        let limit = limit(Side::Most, 2.0, 0.95);
        assert_eq!(judged(&limit, 59, 0, 0).verdict, Verdict::Pass);
        let few = judged(&limit, 58, 0, 0);
        assert_eq!(few.verdict, Verdict::Undecided);
        assert!(few.why.contains("; 1 more that all hold it"), "{}", few.why);
        let one = judged(&limit, 1, 0, 0);
        assert!(
            one.why.contains("; 58 more that all hold it"),
            "{}",
            one.why
        );
        assert_eq!(judged(&limit, 8, 2, 0).verdict, Verdict::Undecided);
        assert_eq!(judged(&limit, 6, 4, 0).verdict, Verdict::Fail);
    }

    #[test]
    fn what_would_decide_decides() {
        let wanted = limit(Side::Most, 2.0, 0.9);
        let now = judged(&wanted, 28, 2, 0);
        assert_eq!(now.verdict, Verdict::Undecided);
        let more = more_members(0.9, 28, 30).unwrap();
        let members = 30 + more;
        let hold = (28.0 / 30.0 * members as f64).round() as usize;
        let then = judged(&wanted, hold, members - hold, 0);
        assert_eq!(then.verdict, Verdict::Pass, "{more}");
        // a share that is just the one asked for is never decided
        assert_eq!(more_members(0.9, 90, 100), None);
    }

    #[test]
    fn one_that_breaks_it_is_enough_where_all_must_hold() {
        let limit = limit(Side::Most, 2.0, 1.0);
        assert_eq!(judged(&limit, 64, 0, 0).verdict, Verdict::Pass);
        assert_eq!(judged(&limit, 63, 1, 0).verdict, Verdict::Fail);
        // what is not known cannot mend it, but can hide the next
        assert_eq!(judged(&limit, 10, 1, 50).verdict, Verdict::Fail);
        assert_eq!(judged(&limit, 63, 0, 1).verdict, Verdict::Undecided);
        assert_eq!(judged(&limit, 0, 0, 1).verdict, Verdict::Undecided);
    }

    #[test]
    fn what_is_not_known_counts_for_neither_side() {
        let limit = limit(Side::Most, 2.0, 0.5);
        assert_eq!(judged(&limit, 60, 0, 10).verdict, Verdict::Pass);
        assert_eq!(judged(&limit, 0, 60, 10).verdict, Verdict::Fail);
        assert_eq!(judged(&limit, 30, 0, 30).verdict, Verdict::Undecided);
    }

    #[test]
    fn the_value_is_the_one_that_decides() {
        let values: Vec<Option<f64>> = (1..=20).map(|k| Some(f64::from(k))).collect();
        let at = |side, share| judge(&limit(side, 10.0, share), "N", &values, "").value;
        assert_eq!(at(Side::Most, 1.0), Some(20.0));
        assert_eq!(at(Side::Most, 0.95), Some(19.0));
        assert_eq!(at(Side::Least, 1.0), Some(1.0));
        assert_eq!(at(Side::Least, 0.9), Some(3.0));
        // a member without a value: the worst is not known, but one that breaks the bound decides
        let mut some = values.clone();
        some[3] = None;
        let worst = |bound| judge(&limit(Side::Most, bound, 1.0), "N", &some, "").value;
        assert_eq!((worst(30.0), worst(10.0)), (None, Some(20.0)));
    }

    #[test]
    fn the_bound_itself_holds() {
        for side in [Side::Most, Side::Least] {
            let at = judge(&limit(side, 0.0, 1.0), "N", &[Some(0.0)], "");
            assert_eq!(
                (at.verdict, at.why.as_str()),
                (Verdict::Pass, "just at the bound")
            );
        }
        let above = judge(&limit(Side::Most, 2.0, 1.0), "N", &[Some(3.0)], "");
        assert_eq!(above.verdict, Verdict::Fail);
        assert_eq!(above.why, "50 % above the bound");
    }
}
