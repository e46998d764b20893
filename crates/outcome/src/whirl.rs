//! What a limit of whirl asks for besides its bound: turns in either sense, angles of the unbalance, and runs that last until slip ends.

use crate::{Judged, Outcome, Quantity, Verdict};
use problem::warning::Declared;
use scenario::{Limit, Side};

/// Unbalance angles from which on a run that saw no whirl says something.
const ANGLES_FOR_WHIRL: usize = 8;
/// Turns of whirl in either sense.
pub const WHIRL: &str = "whirl_turns";
/// Those against the spin.
const BACKWARD: &str = "backward_whirl_turns";
/// The result that tells when slip of rotor and race ends.
pub const SPIN_UP: &str = "inner_race_time_to_95_percent";

/// Whether a name is that of such a result.
pub fn is_of(name: &str, result: &str) -> bool {
    name.rsplit('.').next() == Some(result)
}

/// Whether a limit is one of whirl: of its turns, or of the warning of it.
pub fn seeks_whirl(limit: &Limit, known: &[Quantity], declared: &[&'static Declared]) -> bool {
    let Some(forbids) = &limit.forbids else {
        return [WHIRL, BACKWARD].map(|own| is_of(&limit.quantity, own)) != [false; 2];
    };
    let warned = |kind: &&Declared| kind.by == WHIRL && forbids.meets(kind.code, kind.severity);
    declared.iter().copied().any(|kind| warned(&kind))
        && known.iter().any(|known| is_of(&known.name, WHIRL))
}

/// Contacts of a bearing.
pub const CONTACTS: &str = "contact_count";
/// Whether the rotor touches a bearing still at the end, and its inner race slips.
pub const SLIPS: &str = "slips_at_end";
/// Instants that a bearing has only where the rotor touches it.
const OF_TOUCHED: [&str; 3] = [
    SPIN_UP,
    "inner_race_time_to_50_percent",
    "cage_time_to_95_percent_of_rolling",
];

/// Its first contact with a face.
const ON_FACE: &str = "time_to_first_axial_contact";

/// The contacts of the bearing of an instant that comes only where the rotor touches it, with its bore and with a face; none of other results.
pub fn contacts_of(name: &str) -> Option<[String; 2]> {
    let own = OF_TOUCHED.iter().find(|own| is_of(name, own))?;
    Some([CONTACTS, ON_FACE].map(|contacts| name.replace(own, contacts)))
}

/// Whether a bearing slips when a member ends.
pub(crate) fn slips_in(outcome: &Outcome) -> bool {
    let slips = |value: f64| value > 0.0;
    slips_asked(&outcome.quantities).any(|own| match &own.spread {
        Some(spread) => slips(spread.largest),
        None => outcome.number(&own.name).is_some_and(slips),
    })
}

/// The results that say whether bearings slip when a run ends: friction of any of them drives whirl in all.
pub fn slips_asked(known: &[Quantity]) -> impl Iterator<Item = &Quantity> {
    known.iter().filter(|own| is_of(&own.name, SLIPS))
}

/// Whether friction starts whirl depends on the angle of the unbalance at the release, and on slip until the race turns: a limit of
/// whirl is not held by few angles, nor by runs that end before.
pub fn whirl_sought(judged: Judged, angles: usize, slips: bool) -> Judged {
    let lacking = match (angles < ANGLES_FOR_WHIRL, slips) {
        (true, _) => format!(
            "{angles} of at least {ANGLES_FOR_WHIRL} unbalance angles tried (--repeat {ANGLES_FOR_WHIRL})"
        ),
        (false, true) => {
            "it ends while the rotor slips on a race or bushing that is below 95 % of its speed"
                .to_string()
        }
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
