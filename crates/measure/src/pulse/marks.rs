//! The marks per revolution that were stated, compared with what the wheel shows.
//!
//! ```text
//! stated N, found P:   mean correlation over the lags that only P repeats at  against  that over the lags that only N repeats at
//! ```
//! The larger one is believed, where they differ by more than chance makes.

use super::period::{ALIKE, Correlated, less};
use super::{Pulses, Refusal};
use problem::{note, note::Note};

/// What the pulses of a wheel say of the marks that were stated.
#[derive(Clone, Debug, PartialEq)]
pub enum Marks {
    /// The pattern of intervals repeats with the stated revolution.
    Shown,
    /// It repeats, but with something else.
    Contradicted(Refusal),
    /// It does not show, and why.
    Unclear(Note),
}

/// Chance from which on a wheel of independent marks looks like one of equal parts as one in a hundred does: sampling moves
/// correlations too, and a wheel that shows the stated number at every turn has it.
const ORDINARY: f64 = 1e-2;

/// Independent values within a period, below which it may be a ripple of the speed: a sine has two.
const RIPPLE: f64 = 2.2;

/// Mean correlation below which most of a pattern is noise: few samples a mark, whose errors repeat with the sampling.
const WEAK: f64 = 0.3;
/// Deviations of the mean correlation over the lags of the stated number alone, from which on it shows by itself.
const ITSELF: f64 = 6.0;

/// Compares the marks per revolution that were stated with those that the wheel itself shows, where it does.
///
/// Contradicted only where another number explains the pattern better than the stated one beyond chance. A wheel whose revolution
/// has equal parts looks like one with fewer marks: the text names both. Unclear where no period stands out: marks
/// too even for the noise of their instants, or speeds in step with the sampling.
///
/// Source: derived here.
///
/// Valid: errors of the marks that do not change. Of 1800 synthetic records of true wheels with 12, 60 and 360 marks none was
/// contradicted (`crates/measure/tests/marks.rs`).
pub fn check_marks(pulses: &Pulses) -> Marks {
    let stated = pulses.positions;
    // A gap of left-out marks that comes back at its place shows the number by itself.
    if pulses.reference.is_some() {
        return Marks::Shown;
    }
    let Some(seen) = Correlated::of(pulses) else {
        return unclear(pulses, None);
    };
    let Some(found) = seen.period() else {
        return unclear(pulses, Some(&seen));
    };
    let contradicted = if found == stated || seen.independent(found) < RIPPLE {
        false
    } else if stated.is_multiple_of(found) {
        match seen.chance_of_parts(found, stated) {
            Some(chance) => chance < ALIKE && seen.stands_out(stated),
            None => false,
        }
    } else {
        // A record too short to see the stated number twice shows nothing for it.
        let own = seen.mean(stated, Some(found));
        let others = seen.mean(found, Some(stated)).or(seen.mean(found, None));
        // Marks and sampling together repeat where both do: a multiple in step with the sampling says less.
        let usual = if seen.in_step(found) { 0.5 } else { ORDINARY };
        let shown = seen
            .chance_of_parts(stated, found)
            .is_some_and(|chance| chance < usual);
        // In a weak pattern chance makes parts unlike as it makes them alike: a number that stands out by itself is no wrong one.
        let weak = others.is_some_and(|others| others.value < WEAK) && seen.stands_out(stated);
        let itself = own.is_some_and(|own| own.value > ITSELF * own.deviation);
        own.is_none() || less(own, others) && !shown && !(weak && itself)
    };
    if !contradicted {
        return match seen.stands_out(stated) {
            true => Marks::Shown,
            false => unclear(pulses, Some(&seen)),
        };
    }
    let parts = stated / found;
    Marks::Contradicted(if stated.is_multiple_of(found) {
        Refusal::new(
            format!(
                "the pattern of intervals repeats after {found} pulses, {parts} times within the {stated} per revolution that are stated"
            ),
            format!(
                "the number of marks of this wheel; a wheel of {parts} equal parts shows the same"
            ),
        )
    } else {
        Refusal::new(
            format!(
                "the pattern of intervals repeats after {found} pulses, {stated} per revolution are stated"
            ),
            "the number of marks of this wheel; both flanks of a pulse count as two",
        )
    })
}

/// Why nothing is clear.
fn unclear(pulses: &Pulses, seen: Option<&Correlated>) -> Marks {
    let Some(seen) = seen else {
        return Marks::Unclear(note!("too few pulses follow each other without a fault"));
    };
    let turns = seen.count as f64 / pulses.positions as f64;
    Marks::Unclear(match pulses.sample_interval {
        _ if turns < 3.0 => note!(
            "{:.1} revolutions are too few to see a pattern repeat",
            turns
        ),
        Some(interval) => note!(
            "at {:.1} samples a mark no errors of the marks stand out of those of their instants, or they are in step with the sampling",
            seen.gap / interval
        ),
        None => note!("no errors of the marks stand out of the noise of their instants"),
    })
}
