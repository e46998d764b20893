//! How finely a run is integrated, and how it ended.

use outcome::Stop;
use scenario::Run;
use solve::{Ending, Settings};

/// First step, s: shorter than any time constant; the controller takes over from there.
const FIRST_STEP: f64 = 1e-8;
/// Steps after which a machine is given up: four hundred times the reference drop, minutes of computing.
const STEP_LIMIT: u64 = 20_000_000;

/// Tolerance for design accuracy. There the reference drop keeps every reproducible result within the reference's own
/// spread, and its energy ledger closes to a millionth, by explicit and by linearly implicit steps.
pub(crate) const DESIGN: f64 = 1e-4;

/// Settings of the integration with a tolerance, where none is given.
pub(crate) fn settings_at(run: &Run, tolerance: f64) -> Settings {
    Settings {
        start: 0.0,
        end: run.duration,
        tolerance: run.tolerance.unwrap_or(tolerance),
        first_step: FIRST_STEP.min(1e-3 * run.duration),
        largest_step: run.largest_step,
        step_limit: STEP_LIMIT,
    }
}

/// An instant for people.
fn instant(time: f64) -> String {
    match time {
        0.0 => "0 s, before the first step".to_string(),
        t if t >= 1.0 => format!("{t:.4} s"),
        t if t >= 1e-3 => format!("{:.4} ms", 1e3 * t),
        t => format!("{t:.3e} s"),
    }
}

/// Why a run was given up: it came to the limit of steps, or would pass it many times over at its pace.
fn given_up(steps: u64, share: f64) -> String {
    if steps >= STEP_LIMIT {
        return format!("after the {STEP_LIMIT} steps that are the limit");
    }
    let reached = 100.0 * share;
    let pace = match share > 0.0 {
        true => format!("about {:.0e}", steps as f64 / share),
        false => "any number of".to_string(),
    };
    format!(
        "early: after {steps} steps {reached:.2} % of the duration were computed, and at this pace all of it would take {pace} steps, \
         more than the limit of {STEP_LIMIT}"
    )
}

/// How a run ended, in words.
pub(crate) fn stop(ending: &Ending) -> Stop {
    let time = ending.time;
    let (reason, text) = match &ending.stop {
        solve::Stop::Finished => ("finished", "The whole duration was computed.".to_string()),
        solve::Stop::Interrupted => return interrupted(time),
        solve::Stop::Halted(why) => (
            "left the model",
            format!("Stopped at {}: {why}.", instant(time)),
        ),
        solve::Stop::Diverged { channel, step } => (
            "diverged",
            format!(
                "Diverged at {}: the step shrank to {step:.1e} s, {channel} changes fastest. \
                 Stiff contact, friction with a very small reference speed or an unphysical input are the usual causes.",
                instant(time)
            ),
        ),
        solve::Stop::StepLimit { share } => (
            "step limit",
            format!(
                "Given up at {}, {}. Either the duration is very long, or \
                 something in the machine is very stiff: a damper or spring with too many zeros, friction with a very \
                 small reference speed.",
                instant(time),
                given_up(ending.work.accepted + ending.work.rejected, *share)
            ),
        ),
    };
    Stop { reason, time, text }
}

/// What the user ended.
pub fn interrupted(time: f64) -> Stop {
    Stop {
        reason: "interrupted",
        time,
        text: format!(
            "Interrupted at {}; everything until then is kept.",
            instant(time)
        ),
    }
}
