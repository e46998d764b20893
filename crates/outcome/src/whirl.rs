//! What a limit of whirl asks for besides its bound: turns in either sense, angles of the unbalance, and runs that last until slip ends.

use crate::{Judged, Outcome, Quantity, Value, Verdict};
use problem::warning::Declared;
use scenario::{Limit, Side};

/// Unbalance angles from which on a run that saw no whirl says something.
const ANGLES_FOR_WHIRL: usize = 8;
const WHIRL: &str = "whirl_turns";
/// The result that tells when slip of rotor and race ends.
pub const SPIN_UP: &str = "inner_race_time_to_95_percent";

/// Whether a name is that of such a result.
pub fn is_of(name: &str, result: &str) -> bool {
    name.rsplit('.').next() == Some(result)
}

/// Whether a limit is one of whirl: of its turns, or of the warning of it.
pub fn seeks_whirl(limit: &Limit, known: &[Quantity], declared: &[&'static Declared]) -> bool {
    let Some(forbids) = &limit.forbids else {
        return is_of(&limit.quantity, WHIRL);
    };
    let warned = |kind: &&Declared| kind.by == WHIRL && forbids.meets(kind.code, kind.severity);
    declared.iter().copied().any(|kind| warned(&kind))
        && known.iter().any(|known| is_of(&known.name, WHIRL))
}

/// Whether the inner race of the bearing of a limit, of all of a limit of warnings, reaches 95 % of the speed in every member; so it is
/// where it has none.
pub(crate) fn spins_up(limit: &Limit, outcome: &Outcome) -> bool {
    spin_up_times(limit, &outcome.quantities).all(|time| match &time.spread {
        Some(spread) => spread.members == outcome.work.members,
        None => matches!(time.value, Value::Number(_)),
    })
}

/// Spin-up times that a limit of whirl asks for.
pub fn spin_up_times<'a>(
    limit: &Limit,
    known: &'a [Quantity],
) -> impl Iterator<Item = &'a Quantity> {
    let name = limit.quantity.replace(WHIRL, SPIN_UP);
    let all = limit.forbids.is_some();
    let asked = move |own: &&Quantity| own.name == name || all && is_of(&own.name, SPIN_UP);
    known.iter().filter(asked)
}

/// Whether friction starts whirl depends on the angle of the unbalance at the release, and on slip until the race turns: a limit of
/// whirl is not held by few angles, nor by runs that end before.
pub fn whirl_sought(judged: Judged, angles: usize, slips: bool) -> Judged {
    let lacking = match (angles < ANGLES_FOR_WHIRL, slips) {
        (true, _) => format!(
            "{angles} of at least {ANGLES_FOR_WHIRL} unbalance angles tried (--repeat {ANGLES_FOR_WHIRL})"
        ),
        (false, true) => "it ends before the inner race reaches 95 % of the speed".to_string(),
        (false, false) => return judged,
    };
    match judged.verdict == Verdict::Pass {
        true => Judged {
            verdict: Verdict::Undecided,
            why: format!("{}; {lacking}", judged.why),
            ..judged
        },
        false => judged,
    }
}

/// What a limit bounds of a value: turns of whirl have a sense, and at most so many is meant of either.
pub fn sized(limit: &Limit, value: f64) -> f64 {
    match limit.side == Side::Most && limit.bound >= 0.0 && is_of(&limit.quantity, WHIRL) {
        true => value.abs(),
        false => value,
    }
}
