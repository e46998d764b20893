//! Quick changes of which the pulses show too little, and what would show more.

use super::design::{FEWEST_WITHIN, marks_needed, offered};
use super::fit::Sight;
use super::motion::Change;
use super::plan::Data;
use super::settings::SpeedSettings;
use super::smoothed::Speed;
use crate::pulse::{Gap, Pulses, Refusal};
use crate::quantile::median;

/// Fewest pulses within a quick change that are looked at.
const FEWEST_LOOKED_AT: usize = 4;

/// Refuses a quick change in which the pickup was silent.
pub(super) fn seen(pulses: &Pulses, data: &Data, sight: &Sight) -> Result<(), Refusal> {
    let (from, to) = (data.seconds(sight.engage), data.seconds(sight.lock));
    let within = |gap: &&Gap| gap.from < to && gap.to > from;
    match pulses.gaps.iter().find(within) {
        Some(gap) => Err(Refusal::new(
            format!(
                "the pickup is silent from {:.4} s to {:.4} s, within the quick change of speed from about {from:.4} s to {to:.4} s",
                gap.from, gap.to
            ),
            "a record that shows the change, or a part of this one without it (from, to)",
        )),
        None => Ok(()),
    }
}

/// Refuses a quick change with too few pulses to see anything of it.
pub(super) fn enough(data: &Data, sight: &Sight, settings: &SpeedSettings) -> Result<(), Refusal> {
    let within = sight.after.saturating_sub(sight.first);
    if within >= FEWEST_LOOKED_AT {
        return Ok(());
    }
    let change = sight.change / data.unit;
    // The change is over before the angle between two marks has passed at the new speed twice.
    let longest = (2.0 * data.pitch / change).max((sight.lock - sight.engage) * data.unit);
    let wanted = settings.wanted.unwrap_or(0.1);
    let timing = median(data.passages.iter().map(|p| p.spread * data.unit));
    let marks = marks_needed(change, longest, timing, wanted);
    Err(Refusal::new(
        format!(
            "the speed changes by {change:.1} rad/s in {:.1} ms or less, in which {within} pulses came",
            1e3 * longest
        ),
        match marks {
            Some(marks) => format!(
                "at least {marks} marks per revolution for an acceleration within {:.0} % of its peak (there are {:.0})",
                100.0 * wanted,
                std::f64::consts::TAU / data.pitch
            ),
            None => "more exact instants: no number of marks is enough with these".into(),
        },
    ))
}

/// Refuses a quick change with too few pulses to know its band.
pub(super) fn carried(
    speed: &Speed,
    change: &Change,
    (from, to): (f64, f64),
    pulses: &Pulses,
    settings: &SpeedSettings,
) -> Result<(), Refusal> {
    if change.pulses >= FEWEST_WITHIN {
        return Ok(());
    }
    let (begin, end) = (speed.at(from), speed.at(to));
    let jump = (end.speed - begin.speed).abs();
    // Pulses that came are at most one fewer than pitches that passed; one more is for what is not known of the end.
    let turned = (end.angle - begin.angle).abs();
    let enough = offered((FEWEST_WITHIN + 1) as f64 * std::f64::consts::TAU / turned);
    let timing = stated(pulses) * speed.timing_factor;
    let exact = settings
        .wanted
        .map(|wanted| marks_needed(jump, to - from, timing, wanted));
    let marks = match exact {
        Some(exact) => exact.and_then(|exact| Some(exact.max(enough?))),
        None => enough,
    };
    Err(Refusal::new(
        format!(
            "the speed changes by {jump:.1} rad/s in {:.1} ms, in which {} pulses came: too few to show how it changes, and how \
             well that is known",
            1e3 * (to - from),
            change.pulses
        ),
        match marks {
            Some(marks) => format!(
                "{marks} marks per revolution (there are {}): {FEWEST_WITHIN} pulses in the change at least",
                pulses.positions
            ),
            None => "more exact instants: no number of marks is enough with these".into(),
        },
    ))
}

pub(super) fn needed(marks: Option<usize>, pulses: &Pulses, wanted: f64) -> String {
    match marks {
        Some(marks) if marks > pulses.positions => {
            format!(
                "about {marks} marks per revolution for {:.1} % (there are {})",
                100.0 * wanted,
                pulses.positions
            )
        }
        _ => format!(
            "more exact instants: {} marks per revolution would do for {:.1} % if their angles were known",
            pulses.positions,
            100.0 * wanted
        ),
    }
}

/// Usual stated uncertainty of an instant, s.
pub(super) fn stated(pulses: &Pulses) -> f64 {
    median(pulses.uncertainties.iter().copied())
}
