//! Verdicts that are withheld: of runs that qualify no machine, and of values that are not whole.

use crate::{Judged, Outcome, Verdict};
use scenario::notes::NO_QUALIFICATION;

/// Warnings of runs that qualify no machine, and what is said of them instead of a verdict.
const OF_NO_MACHINE: [(&str, &str); 6] = [
    (
        NO_QUALIFICATION.code,
        "no verdict where weight acts along the shaft: that motion and its force are not in this run",
    ),
    (
        "AB2420",
        "no verdict where a row carries thrust on its open side: no such bearing holds together",
    ),
    (
        "AB2412",
        "no verdict where a contact reaches over the shoulder of its groove: the stress at that edge is not computed",
    ),
    (
        "AB2421",
        "no verdict where the rotor leaves its bearings along the axis",
    ),
    (
        "AB2315",
        "no verdict where the rotor still turns at the end of its coast-down: what comes then is not in this run",
    ),
    (
        "AB2422",
        "no verdict of a coast-down without the friction moment of its bearings: too long, and too cool",
    ),
];
/// Says that the force on a bearing still grows when the run ends.
pub const RISING: &str = "AB2423";

/// Whether a result of a name is meant.
type IsMeant = fn(&str) -> bool;

/// Warnings with which a value that holds a limit says nothing, which results, and why.
const OPEN: [(&str, IsMeant, &str); 3] = [
    (RISING, grows, "the force still grows when the run ends"),
    (
        "AB1002",
        counts_drops,
        "of fatigue alone: balls dent the races",
    ),
    (
        "AB2416",
        counts_drops,
        "of fatigue alone: the faces are too hot",
    ),
];

/// Whether a result is a largest value, or a sum, of what grows with the force.
fn grows(name: &str) -> bool {
    let own = name.rsplit('.').next().unwrap_or(name);
    let begins = ["peak_", "max_", "largest_"].iter();
    begins.clone().any(|begin| own.starts_with(begin))
        || [
            "travel_index",
            "whirl_turns",
            "least_distance",
            "contact_temperature_rise",
        ]
        .contains(&own)
}

fn counts_drops(name: &str) -> bool {
    let own = name.rsplit('.').next();
    own.is_some_and(|own| own.starts_with("drops_until"))
}

/// Warnings with which a value of a result that holds a limit says nothing, and why.
pub fn left_open(name: &str) -> impl Iterator<Item = (&'static str, String)> {
    let found = OPEN.iter().filter(move |(_, is_of, _)| is_of(name));
    found.map(|(code, _, why)| (*code, format!("{why} ({code})")))
}

/// Whether a warning came of the bearing of a result, or of any bearing where the result is of the rotor.
pub(crate) fn warned(outcome: &Outcome, code: &str, name: &str) -> bool {
    let of_its_part = |part: &str| {
        part.is_empty()
            || !name.contains('.')
            || name.starts_with("node.")
            || name
                .strip_prefix(part)
                .is_some_and(|rest| rest.starts_with('.'))
    };
    let mut all = outcome.warnings.iter();
    all.any(|own| own.code == code && of_its_part(&own.part))
}

/// Why runs with these warnings qualify no machine; none where they may.
pub fn of_no_machine(warned: impl Fn(&str) -> bool) -> Option<String> {
    let found = OF_NO_MACHINE.iter().find(|(code, _)| warned(code));
    found.map(|(code, why)| format!("{why} ({code})"))
}

/// A verdict of runs that qualify no machine for this reason.
pub fn withheld(judged: Judged, of_no_machine: Option<&str>) -> Judged {
    match of_no_machine {
        Some(why) => undecided(judged, why.to_string()),
        None => judged,
    }
}

/// A verdict that something speaks against: what is broken stays so.
pub fn undecided(judged: Judged, why: String) -> Judged {
    match judged.verdict {
        Verdict::Fail => judged,
        Verdict::Pass | Verdict::Undecided => Judged {
            verdict: Verdict::Undecided,
            why,
            ..judged
        },
    }
}
