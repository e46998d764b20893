//! Verdicts that are withheld: of runs that qualify no machine, and of values that are not whole.

use crate::{Judged, Outcome, Verdict};
use scenario::notes::NO_QUALIFICATION;
use scenario::{Limit, Side};

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
/// Warnings of what a file asks for and its run does not come to, and why.
pub const NEVER: [(&str, &str); 2] = [
    ("AB2083", "what should happen did not"),
    (
        "AB2085",
        "the run ends too soon after an event or load, or before its largest value",
    ),
];
/// Says that a drop ends before its coast-down may begin.
pub const CUT_BEFORE_COASTING: &str = "AB2324";
/// Warnings of runs that end too soon: what holds a limit until then may break it later, and warnings may come.
pub const UNFINISHED: [(&str, &str); 6] = [
    (
        "AB2424",
        "the rotor has not come to the bearing when the run ends",
    ),
    ("AB2423", "the force still grows when the run ends"),
    (
        "AB2426",
        "the rotor still slips on its race when the run ends",
    ),
    (
        CUT_BEFORE_COASTING,
        "the drop ends before its landings and spin-up do",
    ),
    NEVER[0],
    NEVER[1],
];
/// The same of what counts drops by fatigue.
const OF_FATIGUE: [(&str, &str); 2] = [
    ("AB1002", "of fatigue alone: balls dent the races"),
    ("AB2416", "of fatigue alone: the faces are too hot"),
];

/// A result that no later motion changes once the first blow is over, by its last name; and the warning that leaves it decided.
const SETTLED: &str = "first_impact_force";
const AFTER_SETTLED: &str = "AB2426";

/// Warnings with which a value of a result that holds a limit says nothing, and why. An instant that has come stays.
pub fn left_open(name: &str, is_instant: bool) -> impl Iterator<Item = (&'static str, String)> {
    let own = name.rsplit('.').next().unwrap_or(name);
    let unfinished = UNFINISHED.iter();
    let unfinished = unfinished
        .filter(move |(code, _)| !is_instant && (own != SETTLED || *code != AFTER_SETTLED));
    let of_fatigue = OF_FATIGUE.iter();
    let of_fatigue = of_fatigue.filter(move |_| own.starts_with("drops_until"));
    let found = unfinished.chain(of_fatigue);
    found.map(|(code, why)| (*code, format!("{why} ({code})")))
}

/// Whether a value that has not whole come breaks a limit for good: a largest one that is too small may still grow.
pub fn stays_broken(limit: &Limit) -> bool {
    let own = limit.quantity.rsplit('.').next().unwrap_or_default();
    let mut largest = ["peak_", "largest_", SETTLED].into_iter();
    limit.side == Side::Most || !largest.any(|begin| own.starts_with(begin))
}

/// Warnings of what moves the whole rotor, and so every bearing.
const OF_MOTION: [&str; 2] = ["AB2423", "AB2426"];

/// Whether a warning came of the bearing of a result, or of any bearing where the result is of the rotor or the motion grows.
pub(crate) fn warned(outcome: &Outcome, code: &str, name: &str) -> bool {
    let of_its_part = |part: &str| {
        part.is_empty()
            || OF_MOTION.contains(&code)
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
