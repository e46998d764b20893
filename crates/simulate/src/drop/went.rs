//! How a run went between its fidelities: from ball by ball into slow time and back.

use crate::coast_down::build::{Built, Part};
use crate::drop::context::Context;
use crate::drop::returns::Returned;
use crate::drop::windows::Bounced;

/// The first change from motion to laws.
pub(super) struct Change {
    pub time: f64,
    pub speed: f64,
    /// Whether there was one.
    pub never: bool,
    /// Kinetic energy after it less that before, J.
    pub energy: f64,
}

impl Change {
    pub fn at(built: &Built, bounced: &Bounced) -> Self {
        let start = &built.start;
        let after = 0.5 * built.inertia * start.speed * start.speed;
        let sides = f64::from(built.sides);
        Change {
            time: start.time,
            speed: start.speed,
            never: start.ended.is_some(),
            energy: (bounced.kinetic).map_or(0.0, |before| after - sides * before),
        }
    }
}

/// How the run went between its fidelities.
pub(super) struct Went {
    /// Whether the drop ended because the rotor rolled.
    pub rolled: bool,
    pub bounced: Bounced,
    pub first: Change,
    pub returned: Returned,
}

impl Went {
    /// Windows of all stretches.
    fn windows(&self) -> impl Iterator<Item = &Bounced> {
        let again = self.returned.list.iter().map(|again| &again.windows);
        std::iter::once(&self.bounced).chain(again)
    }
    /// These, and what was seen on the way by laws.
    fn seen(&self) -> impl Iterator<Item = &Bounced> {
        self.windows().chain([&self.returned.glanced])
    }
    pub fn steps(&self) -> u64 {
        self.seen().map(|windows| windows.steps).sum()
    }
    /// The largest contact force of a bearing in all windows, N, and when, s, and at which speed, rad/s.
    pub fn peak(&self, bearing: usize) -> Option<[f64; 3]> {
        largest(self.seen().filter_map(|windows| windows.peaks.get(bearing)))
    }
    /// The largest rise of the patch of rotor and race of a bearing in all windows, K, and when, s.
    pub fn hottest(&self, bearing: usize) -> Option<[f64; 2]> {
        largest(
            self.seen()
                .filter_map(|windows| windows.hottest.get(bearing)),
        )
    }
    /// The first and the last instant at which windows saw the rotor whirl against (0) or with (1) its spin, s.
    pub fn whirled(&self, way: usize) -> Option<[f64; 2]> {
        let each = self.windows().filter_map(|windows| windows.whirled[way]);
        each.reduce(|first, last| [first[0], last[1]])
    }
    /// Relative standard errors of the powers of all windows.
    pub fn scatter(&self) -> Vec<f64> {
        let each = self.windows().flat_map(|windows| &windows.scatter);
        each.copied().collect()
    }
}

/// The one whose first number is the largest.
fn largest<'a, const N: usize>(each: impl Iterator<Item = &'a [f64; N]>) -> Option<[f64; N]> {
    each.copied().reduce(|a, b| if b[0] > a[0] { b } else { a })
}

/// How the run went from ball by ball into slow time and back, in words.
pub(super) fn way(context: &Context, parts: &[Part], went: &Went) -> String {
    let first = &went.first;
    let at_once = (went.returned.list.first()).is_some_and(|again| again.from[0] <= first.time);
    let rolled = match at_once {
        true => String::new(),
        false => format!(
            "From {:.4} s on the rotor rolled, losing what laws say, and ran out by them, from {:.1} rad/s.",
            first.time, first.speed
        ),
    };
    let mut list = match (went.bounced.scatter.len(), first.never) {
        (0, false) => vec![rolled],
        (count, never) => {
            let last = match never {
                false => rolled,
                true if went.rolled => "It did so to the end.".to_string(),
                true => "It never rolled.".to_string(),
            };
            let but = match went.rolled {
                false => "did not roll",
                true => "rolled, but lost more than laws say",
            };
            let windows = format!(
                "After {:.4} s the rotor {but}: {count} windows ball by ball followed, in slow time between them.",
                context.finished.ending.time
            );
            vec![windows, last]
        }
    };
    list.extend(went.returned.list.iter().map(|again| again.words(parts)));
    list.retain(|sentence| !sentence.is_empty());
    list.join(" ")
}
