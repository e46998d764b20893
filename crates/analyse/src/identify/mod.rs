//! What measured tests say of a bearing: from the signals files of several tests to named results.
//!
//! ```text
//! signals files ─signals─▶ speed, torque, cage ─measurement─▶ one Measurement a test
//!   coast-downs ─▶ M(Ω)      tests ─▶ F, dissipation, slip, skid      all ─▶ doubts, explanations, next test
//! ```
//! | page | subject |
//! |---|---|
//! | `read` | the signals files and their channels |
//! | `found` | the estimators of the crate `identify`, each with its own reason where it refuses |
//! | `coast_down` | M of slow tests without a torque |
//! | `consequence` | what follows from a verdict for the other results |
//! | `notes` | what to know of the tests, each line once |
//! | `answer`, `per_test` | named results |
//! | `history` | the tests over time since their engagement |

mod answer;
mod coast_down;
mod consequence;
mod estimate;
mod history;
pub mod notes;
mod per_test;
mod read;

use estimate::Estimate;
use outcome::options::Options;
use outcome::{Column, Outcome, Picture, Quantity, Stop, Warning};
pub use read::Request;
use scenario::Scenario;
use simulate::assumptions::assumptions;

/// The columns of its history, without values.
pub fn columns(asked: &Request) -> Vec<Column> {
    history::columns(asked, None)
}

/// The results of such an identification, without values.
pub fn results(asked: &Request) -> Vec<Quantity> {
    answer::name(asked, None)
}

/// Computes what is asked for and names it.
pub fn run(scenario: &Scenario, asked: &Request, options: &Options) -> Outcome {
    let found = Estimate::of(asked, options);
    let mut warnings = found.warnings.clone();
    warnings.extend(assumed(scenario, asked));
    let history = history::columns(asked, Some(&found));
    let end = history.first().and_then(|time| time.values.last().copied());
    let end = end.unwrap_or(0.0);
    let stop = match (&found.moment, found.interrupted) {
        (Ok(_), false) if found.unused.is_some() => Stop::new(
            "not answered",
            0.0,
            found.unused.clone().unwrap_or_default(),
        ),
        (_, true) => Stop::new(
            "interrupted",
            end,
            "Interrupted; what was found until then is kept.",
        ),
        (Ok(_), false) => Stop::new("finished", end, "Everything asked for was computed."),
        (Err(why), false) => Stop::new(
            "not answered",
            0.0,
            format!("the slow tests do not give the steady moment: {why}"),
        ),
    };
    Outcome {
        system: "identify",
        title: (scenario.title.clone())
            .unwrap_or_else(|| "What the tests show of the bearing".to_string()),
        quantities: answer::name(asked, Some(&found)),
        history,
        stop,
        warnings,
        pictures: vec![Picture::without_rotor(
            found.set.cage_speed(1.0),
            asked.identify.ball_count,
        )],
        ..Outcome::default()
    }
}

/// What is assumed of the bearing and the tests, as far as it counts.
fn assumed(scenario: &Scenario, asked: &Request) -> Option<Warning> {
    let wish = asked.identify;
    let counts = |path: &str| {
        !(path.starts_with("identify.rotor_friction.") && wish.rotor_friction.is_none()
            || path.starts_with("identify.explanations.") && wish.explanations.is_none())
    };
    let values = scenario.resolved.values.iter();
    let values = values.filter(|value| value.provenance.mark() == "assumed" && counts(value.path));
    assumptions(&values.map(|value| value.path).collect::<Vec<_>>())
}
