//! A record fitted to its end: what it is before, in and behind a quick change, and the tracks of all of it.

use super::fit::{self, Sight};
use super::motion::Change;
use super::node::moving;
use super::plan::{Data, Knots, Noise, Plan};
use super::smoothed::Speed;
use super::smoothness::{self, Smoothness};
use super::track::Track;
use super::transient;
use crate::pulse::Refusal;
use problem::note::Note;

/// Passages before a quick change that show how the shaft turned before it.
pub(super) const QUIET_BEFORE: usize = 12;

/// Fits a record whose noise and usual density are known, with its quick change where one is in sight.
///
/// What an instrument hides beside (a delay, a wheel's errors, a stop) is added by the caller, who knows it.
pub(super) fn fitted(
    data: &mut Data,
    sight: Option<&Sight>,
    (noise, density): (Noise, f64),
    notes: Vec<Note>,
) -> Result<Speed, Refusal> {
    let n = data.passages.len();
    let mut base = Plan::steady(noise, density);
    if let Some(sight) = sight
        && !sight.rests
        && sight.first >= QUIET_BEFORE
    {
        base.quiet[0] = match data.channel {
            true => fit::calm(data, 0..sight.first, noise, density),
            false => fit::quiet(data, 0..sight.first).1,
        };
    }
    // From here on nothing of a quick change is left.
    let mut calm_from = 0;
    if let Some(sight) = sight {
        base.settled = sight.lock + 2.0 * (sight.lock - sight.engage);
        calm_from = data.passages.partition_point(|p| p.time <= base.settled);
        if calm_from >= sight.after + 8 {
            let range = sight.after..calm_from.min(sight.after + 200);
            base.quiet[1] = fit::settling(data, range, noise, density);
        }
    }
    if n - calm_from >= 3 * fit::STRETCH {
        base.quiet[2] = fit::calm(data, calm_from..n, noise, density);
        // A change that settles is no calmer than what comes after it.
        base.quiet[1] = base.quiet[1].max(base.quiet[2]);
    }
    let mut speed = Speed {
        base: Track::new(
            &[],
            &moving(0.0, 0.0, 0.0, &noise.memory),
            0.0,
            noise.memory,
        ),
        parts: Vec::new(),
        window: (f64::INFINITY, f64::NEG_INFINITY),
        smoothness: None,
        origin: data.origin,
        unit: data.unit,
        latency: 0.0,
        stop: None,
        breakaway: None,
        bridges: Vec::new(),
        eccentricity: 0.0,
        change: None,
        timing_factor: noise.timing,
        notes,
    };
    if let Some(sight) = sight {
        let (plans, range) = transient::plans(data, sight, &base);
        let Some((best, _)) = plans.first() else {
            return Err(Refusal::new(
                "the start and the end of the quick change cannot be found".into(),
                "the window of one change of speed, with even running after it",
            ));
        };
        base = *best;
        let track = |plan: &Plan| {
            let (nodes, start) = plan.nodes(data, range.clone());
            Track::new(&nodes, &start, plan.quiet[2], noise.memory)
        };
        speed.parts = plans
            .iter()
            .map(|(plan, weight)| (*weight, track(plan)))
            .collect();
        let stiffer: Vec<(f64, Track)> = plans
            .iter()
            .map(|(plan, weight)| (*weight, track(&smoothness::stiffer(plan))))
            .collect();
        let begin = if sight.rests {
            f64::NEG_INFINITY
        } else {
            data.passages[range.start].time
        };
        let margin = if range.end < n { 5 } else { 1 };
        speed.window = (begin, data.passages[range.end - margin].time);
        speed.smoothness = best.transient.map(|knots| {
            let to = knots.lock.min(speed.window.1);
            Smoothness::of(&speed.parts, &stiffer, (knots.engage, to))
        });
        speed.change = Some(summary(data, sight, &plans));
    }
    data.unsteady = fit::unsteady(data, &base);
    let (nodes, start) = base.nodes(data, 0..n);
    speed.base = Track::new(&nodes, &start, base.quiet[2], noise.memory);
    if !(speed.base.is_finite() && speed.parts.iter().all(|(_, track)| track.is_finite())) {
        let (what, needed) = match data.channel {
            true => ("speeds", "the speed of one shaft"),
            false => (
                "intervals of the pulses",
                "pulses of one wheel that turns forward",
            ),
        };
        return Err(Refusal::new(
            format!("the {what} differ so much that they cannot be smoothed"),
            format!("{needed}; look at the signal"),
        ));
    }
    Ok(speed)
}

/// Instants of the knots from the plans that are left.
fn summary(data: &Data, sight: &Sight, plans: &[(Plan, f64)]) -> Change {
    let moments = |value: &dyn Fn(&Knots) -> f64| {
        let known = || {
            plans
                .iter()
                .filter_map(|(plan, weight)| plan.transient.as_ref().map(|l| (value(l), *weight)))
        };
        let mean: f64 = known().map(|(x, w)| w * x).sum();
        let variance: f64 = known().map(|(x, w)| w * (x - mean).powi(2)).sum();
        (mean, variance.sqrt())
    };
    let (engage, engage_spread) = moments(&|l| l.engage);
    let (lock, lock_spread) = moments(&|l| l.lock);
    // Where a start has a lag, what came before the first marks follows from nothing that came after them.
    let next = data.passages.partition_point(|p| p.time <= engage);
    let hidden = match data.passages.get(next + 1) {
        Some(second) if sight.rests => 0.5 * (second.time - engage),
        _ => 0.0,
    } * moments(&|l| f64::from(u8::from(l.head.is_some()))).0;
    let engage_spread = engage_spread.hypot(hidden);
    Change {
        engagement: (data.seconds(engage), engage_spread * data.unit),
        end: sight
            .ends
            .then_some((data.seconds(lock), lock_spread * data.unit)),
        from_rest: sight.rests,
        pulses: data
            .passages
            .iter()
            .filter(|p| p.time > engage && p.time < lock)
            .count(),
    }
}
