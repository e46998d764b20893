//! Limits of warnings: whether one came that must not.

use crate::limits::{UNFINISHED, is_of};
use crate::{Judged, Outcome, Quantity, Scope, Value, Verdict, Warning};
use problem::warning::{Declared, Evaluation};
use problem::{Code, Result, did_you_mean};
use scenario::{Forbidden, Limit, Scenario, UNBALANCE_ANGLE};

/// Refuses a code that no warning of such a run has.
pub(super) fn check(
    limit: &Limit,
    forbids: &Forbidden,
    declared: &[&'static Declared],
) -> Result<()> {
    let Forbidden::Code(code) = forbids else {
        return Ok(());
    };
    if declared.iter().any(|kind| kind.code == code) {
        return Ok(());
    }
    let found = format!("\"{code}\", which is no warning of such a run");
    let allowed = "the code of a warning is needed, e.g. AB2030".to_string();
    let problem = limit.problem(Code::UnknownQuantity, found, allowed);
    let hint = did_you_mean(code, declared.iter().map(|kind| kind.code));
    Err(problem.with_hint(hint))
}

/// Warnings of a run that must not come.
fn forbidden<'a>(forbids: &Forbidden, outcome: &'a Outcome) -> Vec<&'a Warning> {
    let all = outcome.warnings.iter();
    all.filter(|own| forbids.meets(own.code, own.severity))
        .collect()
}

/// A result that every coast-down has.
const STOP_TIME: &str = "stop_time";

/// Why some of these warnings cannot come: the result that they come from has no value, or a list of it no entry; or, of a single
/// code, there is no such result.
pub fn not_evaluated(
    forbids: &Forbidden,
    declared: &[&'static Declared],
    quantities: &[Quantity],
) -> Option<String> {
    let kinds = (declared.iter())
        .filter(|kind| !kind.by.is_empty() && forbids.meets(kind.code, kind.severity));
    let named = matches!(forbids, Forbidden::Code(_));
    let mut meant = declared
        .iter()
        .filter(|kind| forbids.meets(kind.code, kind.severity));
    let coasts = quantities.iter().any(|own| is_of(&own.name, STOP_TIME));
    if named && !coasts && meant.all(|kind| kind.evaluation == Evaluation::CoastDown) {
        return Some("it comes of a coast-down, and this run has none".to_string());
    }
    if let Some(kind) = kinds.clone().find(|kind| {
        let there = quantities.iter().any(|own| is_of(&own.name, kind.by));
        named && !there
    }) {
        let (code, by) = (kind.code, kind.by);
        return Some(format!("{code} is not evaluated: this run has no {by}"));
    }
    let mut pairs = kinds.flat_map(|kind| {
        let own = quantities.iter().filter(|own| is_of(&own.name, kind.by));
        own.map(move |own| (kind, own))
    });
    pairs.find_map(|(kind, own)| {
        let why = match &own.value {
            // what is never touched stays cold
            Value::None { .. } if own.of_contacts => return None,
            Value::None { why } => why.as_str(),
            Value::List(list) if list.is_empty() => "none is given",
            _ => return None,
        };
        Some(format!(
            "{} is not evaluated: {}: {why}",
            kind.code, own.name
        ))
    })
}

/// Warnings that a run cannot give which says of itself that it does not judge this: code of one, and of what says so.
const UNJUDGED: [(&str, &str); 1] = [("AB2412", "AB2415")];

/// Why some of these warnings cannot come in a run with these others; none where all may.
pub fn unjudged(
    forbids: &Forbidden,
    declared: &[&'static Declared],
    warned: impl Fn(&str) -> bool,
) -> Option<String> {
    let meets = |code: &str| {
        let mut kinds = declared.iter().filter(|kind| kind.code == code);
        kinds.any(|kind| forbids.meets(kind.code, kind.severity))
    };
    let found = UNJUDGED
        .iter()
        .find(|(code, says)| meets(code) && warned(says));
    found.map(|(code, says)| format!("{code} is not evaluated ({says})"))
}

/// Warnings of runs that end too soon for some of these warnings, and why: had they gone on, others of these may have come.
pub fn may_come_later(
    forbids: &Forbidden,
    declared: &[&'static Declared],
) -> impl Iterator<Item = &'static (&'static str, &'static str)> {
    UNFINISHED.iter().filter(|(code, _)| {
        declared.iter().any(|kind| {
            let of_run = kind.evaluation == Evaluation::Each && kind.code != *code;
            of_run && forbids.meets(kind.code, kind.severity)
        })
    })
}

/// Their number in each member, 0 or 1, and why some are not known: the run ended early, or only the unperturbed member is evaluated.
pub(super) fn values(
    scenario: &Scenario,
    outcome: &Outcome,
    declared: &[&'static Declared],
    forbids: &Forbidden,
) -> (Vec<Option<f64>>, String) {
    let all = outcome.work.members.max(1);
    // of the unbalance angle nothing that follows from the file depends
    let differ = (scenario.vary.iter()).any(|vary| vary.path != UNBALANCE_ANGLE);
    let in_coast_down = (scenario.drop()).is_some_and(|drop| drop.coast_down.is_some());
    let mut kinds = declared.iter();
    let unseen = kinds.find(|kind| {
        forbids.meets(kind.code, kind.severity)
            && match kind.evaluation {
                Evaluation::File => differ,
                Evaluation::Each => false,
                Evaluation::Unperturbed => true,
                Evaluation::CoastDown => in_coast_down,
            }
    });
    // members that have one of them for certain, and those that may
    let (mut least, mut most) = (0, 0);
    for warning in forbidden(forbids, outcome) {
        let (certain, possible) = match warning.scope {
            Scope::Each { count, .. } => (count, count),
            Scope::Alike if !differ => (all, all),
            Scope::Alike | Scope::Unperturbed => (1, all),
        };
        (least, most) = (least.max(certain), most + possible);
    }
    let unknown = not_evaluated(forbids, declared, &outcome.quantities).or_else(|| {
        let warned = |code: &str| outcome.warnings.iter().any(|own| own.code == code);
        unjudged(forbids, declared, warned)
    });
    let unfinished = may_come_later(forbids, declared).flat_map(|(code, why)| {
        let own = outcome.warnings.iter().filter(move |own| own.code == *code);
        own.map(move |own| {
            let count = match own.scope {
                Scope::Each { count, .. } => count.min(all),
                Scope::Alike | Scope::Unperturbed => all,
            };
            (count, format!("{why} ({code})"))
        })
    });
    let unfinished = unfinished.max_by_key(|(count, _)| *count);
    let (known, why) = match unseen {
        _ if !outcome.stop.complete() => (0, outcome.stop.text.trim_end_matches('.').to_string()),
        _ if unknown.is_some() => (0, unknown.unwrap_or_default()),
        Some(kind) if all > 1 => (
            1,
            format!("{} is evaluated in the unperturbed member alone", kind.code),
        ),
        _ => match unfinished {
            Some((count, why)) => (all - count, why),
            None => (all, "which of them it is in is not known".to_string()),
        },
    };
    let mut values = vec![Some(1.0); least.min(all)];
    values.resize(values.len() + known.saturating_sub(most), Some(0.0));
    values.resize(all, None);
    (values, why)
}

/// A verdict on warnings with their text.
pub(super) fn explained(mut judged: Judged, outcome: &Outcome) -> Judged {
    let Some(forbids) = &judged.limit.forbids else {
        return judged;
    };
    match (judged.verdict, forbidden(forbids, outcome).first()) {
        (Verdict::Fail, Some(first)) if judged.members > 1 => {
            judged.why = format!("{}: {} {first}", judged.why, first.code);
        }
        (Verdict::Fail, Some(first)) => judged.why = format!("{} {first}", first.code),
        (Verdict::Pass, None) if judged.members == 1 => {
            judged.why = "no such warning".to_string();
        }
        _ => {}
    }
    judged
}
