//! Knots of a quick change and the density of its snap by their likelihood.
//!
//! ```text
//! scan       engagement × density for each interval between marks that the end may lie in
//! climb      from the best of each a little, from the best of these to the top, for each start and each end
//! weight     points about each summit, by likelihood and what was expected: what they leave open is averaged over
//! ```
//! The likelihood has many summits where marks are few: one for each interval of the end, a late engagement with a quick
//! motion beside an early one that is silent. A summit that is missed is a wrong answer with a narrow band.

use super::fit::{STRETCH, Sight};
use super::plan::{Data, Head, Knot, Knots, Passage, Plan};
use super::spread::spread;
use statistics::simplex;

/// Passages beyond the quick change that take part in its fit.
const BEYOND: usize = 40;

/// Fall of the logarithm of the likelihood at a width: that of two and a half standard deviations of a normal density.
const STEEP: f64 = 3.0;

/// Passages that show the knots and the density: all near the knots, some between where there are many.
fn thinned(data: &Data, sight: &Sight, range: std::ops::Range<usize>) -> Vec<Passage> {
    const ALL: usize = 24;
    const BETWEEN: usize = 40;
    let inner =
        (sight.first + ALL).min(sight.after)..sight.after.saturating_sub(ALL).max(sight.first);
    let step = inner.len().div_ceil(BETWEEN).max(1);
    // A channel shows long rest before a soft start.
    let early = range.start..sight.first.saturating_sub(BEYOND).max(range.start);
    let apart = early.len().div_ceil(BETWEEN).max(1);
    let kept = |k: usize, part: &std::ops::Range<usize>, step: usize| {
        !part.contains(&k) || (k - part.start).is_multiple_of(step)
    };
    range
        .filter(|&k| kept(k, &inner, step) && kept(k, &early, apart))
        .map(|k| data.passages[k])
        .collect()
}

/// Widths of a likelihood about its best along each parameter, from the widest ones: exact pulses leave much less open, and
/// points that all lie far away would show nothing.
fn widths(
    best: &[f64; 3],
    value: f64,
    widest: [f64; 3],
    cost: impl Fn(&[f64; 3]) -> f64,
) -> [f64; 3] {
    std::array::from_fn(|k| {
        let mut width = widest[k];
        for _ in 0..8 {
            let rise = |sign: f64| {
                let mut point = *best;
                point[k] += sign * width;
                cost(&point) - value
            };
            if rise(1.0).min(rise(-1.0)) < STEEP {
                break;
            }
            width *= 0.5;
        }
        width
    })
}

/// Logarithm of what is expected, before any mark came, of the density over the usual one (its logarithm) and of a start.
///
/// The density is nearly free: a torque that is even or rises evenly is silent between its knots. Of three starts that
/// explain the marks alike, the softer one is e times as likely, and a start with a lag is not expected; what the marks show is
/// seen against far longer odds.
fn expected(density: f64, start: Knot, head: f64) -> f64 {
    const NEARLY_FREE: f64 = 6.0;
    const LAG: f64 = -5.0;
    let lag = if head > 0.0 { LAG } else { 0.0 };
    let start = match start {
        Knot::Soft => 1.0,
        Knot::Kink => 0.0,
        Knot::Jump => -1.0,
    };
    start + lag - 0.5 * (density / NEARLY_FREE).powi(2)
}

/// Ends of a change, as parts of its length behind the one at first sight, at which the likelihood is looked at, valley by
/// valley.
///
/// A change is seen to end where nearly all of it has come; a torque that rises to the end has still a fiftieth of its way to
/// go there. Where marks are few, that is seen some marks late, and each interval between two of them is a valley of its own:
/// an acceleration that jumps is never likely to do so just at a mark.
fn ends(data: &Data, sight: &Sight, length: f64) -> Vec<Vec<f64>> {
    const NEAR: [f64; 3] = [0.0, 0.01, 0.02];
    const EARLIER: usize = 6;
    const INTERVALS: usize = 7;
    let from = sight.after.saturating_sub(EARLIER);
    let middles = data.passages[from..]
        .windows(2)
        .map(|pair| (0.5 * (pair[0].time + pair[1].time) - sight.lock) / length)
        .take(INTERVALS)
        .filter(|end| end.abs() > 2.0 * NEAR[1] && sight.lock + end * length > sight.most)
        .map(|end| vec![end]);
    std::iter::once(NEAR.to_vec()).chain(middles).collect()
}

/// The same for a channel, whose samples are many and follow each other evenly: one valley.
const ENDS_OF_CHANNEL: [f64; 7] = [-0.15, -0.08, -0.04, 0.0, 0.02, 0.05, 0.1];

/// Points from which the likelihood is climbed, two for each valley of the end: the best of a scan over the engagement and the
/// density, and the best one far from it. A clutch that engages softly and one that grips late may both explain the same
/// marks.
fn valleys(
    places: &[f64],
    density: f64,
    ends: &[Vec<f64>],
    cost: impl Fn(&[f64; 3]) -> f64,
) -> Vec<[f64; 3]> {
    const DENSITY: [f64; 4] = [1.0, -2.0, -5.0, -9.0];
    let mut points = Vec::new();
    for ends in ends {
        let at = |place: f64| {
            DENSITY
                .iter()
                .flat_map(|q| ends.iter().map(move |&end| [density.ln() + q, place, end]))
                .map(|point| (point, cost(&point)))
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .expect("a density")
        };
        let best: Vec<_> = places.iter().map(|&place| at(place)).collect();
        let least = |of: &dyn Fn(usize) -> bool| {
            let some = (0..best.len()).filter(|&k| of(k));
            some.min_by(|&a, &b| best[a].1.total_cmp(&best[b].1))
        };
        let top = least(&|_| true);
        let far = least(&|k| top.is_some_and(|top| k.abs_diff(top) > 2));
        points.extend([top, far].into_iter().flatten().map(|k| best[k].0));
    }
    points
}

/// Most looks at the likelihood on one climb.
const CLIMB: usize = 300;
/// Fall of the logarithm of the likelihood from which a point has no weight.
const UNLIKELY: f64 = 5.0;
/// Distance between two summits along the logarithm of the time from engagement to first mark, or along the engagement of a
/// turning shaft; along the end a tenth of it.
const APART: f64 = 0.2;
/// Plans that are kept.
const KEPT: usize = 24;

/// The foot of a valley: a climb that is begun anew, with a quieter motion, until that gains nothing. A quiet motion that its
/// knots explain lies at the end of a valley that is long and narrow, in which one climb comes to a stop.
fn climbed(
    point: [f64; 3],
    steps: [f64; 3],
    calls: usize,
    cost: impl Fn(&[f64; 3]) -> f64,
) -> ([f64; 3], f64) {
    const AGAIN: usize = 4;
    let mut best = simplex::lowest(point, steps, 0.1, calls, &cost);
    for _ in 0..AGAIN {
        let closer = [-1.5 * steps[0], 0.1 * steps[1], 0.1 * steps[2]];
        let next = simplex::lowest(best.0, closer, 0.1, calls / 2, &cost);
        let gain = best.1 - next.1;
        if next.1 < best.1 {
            best = next;
        }
        // From a point that is impossible nothing is gained by trying again.
        if gain.is_nan() || gain < 0.5 {
            break;
        }
    }
    best
}

/// The best of some climbs, and those that are nearly as likely and lie apart from all better ones.
fn summits(mut climbs: Vec<([f64; 3], f64)>) -> Vec<([f64; 3], f64)> {
    const MOST_SUMMITS: usize = 3;
    climbs.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut kept: Vec<([f64; 3], f64)> = Vec::new();
    for climb in climbs {
        let apart = kept.iter().all(|better| {
            let away = |k: usize| (climb.0[k] - better.0[k]).abs();
            away(1) > APART || away(2) > 0.1 * APART
        });
        let likely = kept.first().is_none_or(|best| climb.1 < best.1 + UNLIKELY);
        if apart && likely && kept.len() < MOST_SUMMITS {
            kept.push(climb);
        }
    }
    kept
}

/// Some plans that stand for many, given the heaviest first: that one, and others at equal steps of the summed weight along
/// the engagement. To keep only the heaviest would cut off what is less likely on both sides, and the band with it.
fn thinner(mut parts: Vec<(Plan, f64)>) -> Vec<(Plan, f64)> {
    let Some(&(best, _)) = parts.first() else {
        return parts;
    };
    let sum: f64 = parts.iter().map(|p| p.1).sum();
    let engage = |plan: &Plan| plan.transient.map_or(0.0, |knots| knots.engage);
    parts.sort_by(|a, b| engage(&a.0).total_cmp(&engage(&b.0)));
    let mut kept = vec![(best, 0.0)];
    let mut reached = 0.0;
    for (plan, weight) in parts {
        let steps = |sum: f64| (sum * KEPT as f64 + 0.5) as usize;
        let before = steps(reached / sum);
        reached += weight;
        let times = steps(reached / sum) - before;
        if times > 0 {
            kept.push((plan, times as f64 / KEPT as f64));
        }
    }
    kept
}

/// Whether a change has so many marks that its start may be less steady than the whole: a motor that follows an even ramp with
/// a lag.
fn is_long(sight: &Sight) -> bool {
    sight.after.saturating_sub(sight.first) > 3 * STRETCH
}

/// Plans for the quick change with their weights, the best one first.
pub(super) fn plans(
    data: &Data,
    sight: &Sight,
    base: &Plan,
) -> (Vec<(Plan, f64)>, std::ops::Range<usize>) {
    let from = match (sight.rests, data.channel) {
        // A soft start is seen late, by up to half the change.
        (_, true) => sight
            .first
            .saturating_sub((sight.after - sight.first) / 2 + BEYOND),
        (true, false) => 0,
        (false, false) => sight.first.saturating_sub(BEYOND),
    };
    let to = (sight.after + BEYOND).min(data.passages.len());
    let range = from..to;
    let length = (sight.lock - sight.engage).max(1.0);
    let first = data.passages[sight.first.min(data.passages.len() - 1)].time;
    let last = data.passages[data.passages.len() - 1].time;
    // Where nobody watched before the first pulse, the engagement may be some time before it.
    let earliest = if first - data.watched.0 > 1e-9 {
        data.watched.0
    } else {
        first - 4.0 * length
    };
    let latest = (sight.lock + length).min(data.passages[to - 1].time);
    // Of a shaft at rest no mark shows when it began to turn, only that it did before its first one; a channel shows the rest.
    let unseen = sight.rests && !data.channel;
    let plan = |x: &[f64; 3], (start, stop, head): (Knot, Knot, f64)| -> Option<Plan> {
        let engage = if unseen {
            first - length * x[1].exp()
        } else {
            sight.engage + length * x[1]
        };
        let lock = sight.lock + length * x[2];
        let inside = engage >= earliest
            && lock > first.max(sight.most).max(engage)
            && (lock < latest || !sight.ends)
            && x[0].abs() < 200.0;
        (inside && x[1].abs() < 20.0 && x[2].abs() < 5.0).then(|| Plan {
            transient: Some(Knots {
                engage,
                lock: if sight.ends { lock } else { last + length },
                change: sight.change,
                density: x[0].exp(),
                head: (head > 0.0).then_some(Head {
                    share: head,
                    first: first - engage,
                }),
                start,
                stop,
            }),
            rests: sight.rests,
            ..*base
        })
    };
    let some = thinned(data, sight, range.clone());
    let mut parts: Vec<(Plan, f64)> = Vec::new();
    let peak = 2.0 * sight.change / length;
    // A bell of this height and length has about this jerk, gathered over its length.
    let density = (3.0 * peak / length).powi(2) / length;
    let cost = |jumps| {
        let (plan, some) = (&plan, &some);
        move |x: &[f64; 3]| match plan(x, jumps) {
            Some(plan) => {
                let belief = expected(x[0] - density.ln(), jumps.0, jumps.2);
                // Any time of the engagement is as likely as any other, not any logarithm of it.
                let stretched = if unseen { x[1] } else { 0.0 };
                -plan.likelihood_of(data, some) - belief - stretched
            }
            None => f64::INFINITY,
        }
    };
    let places: &[f64] = match (unseen, data.channel) {
        (true, _) => &[
            -4.5, -3.5, -2.75, -2.25, -1.75, -1.25, -0.75, -0.25, 0.4, 1.1,
        ],
        (false, true) => &[-0.5, -0.35, -0.25, -0.15, -0.1, -0.05, 0.0, 0.05, 0.1],
        (false, false) => &[-0.15, -0.1, -0.05, 0.0, 0.05, 0.1, 0.15],
    };
    let stops: &[Knot] = if sight.ends {
        &[Knot::Jump, Knot::Kink, Knot::Soft]
    } else {
        &[Knot::Soft]
    };
    // A channel shows the start itself.
    let heads: &[f64] = if is_long(sight) && !data.channel {
        &[0.0, 1e-3, 1e-2, 1e-1]
    } else {
        &[0.0]
    };
    let ends = match sight.ends {
        true if data.channel => vec![ENDS_OF_CHANNEL.to_vec()],
        true => ends(data, sight, length),
        false => vec![vec![0.0]],
    };
    let steps = [2.0, if unseen { 0.2 } else { 0.05 }, 0.05];
    let mut bests = Vec::new();
    for (start, head) in [Knot::Soft, Knot::Kink, Knot::Jump]
        .into_iter()
        .flat_map(|start| heads.iter().map(move |&head| (start, head)))
    {
        let mut warm: Vec<[f64; 3]> = Vec::new();
        for &stop in stops {
            let cost = cost((start, stop, head));
            let from = |point: &[f64; 3], calls| climbed(*point, steps, calls, cost);
            let tops: Vec<_> = if warm.is_empty() {
                let points = valleys(places, density, &ends, cost);
                let short: Vec<_> = points
                    .iter()
                    .map(|point| simplex::lowest(*point, steps, 0.1, CLIMB / 4, &cost))
                    .collect();
                let tops = summits(short);
                tops.iter().map(|top| from(&top.0, CLIMB)).collect()
            } else {
                warm.iter().map(|point| from(point, CLIMB / 2)).collect()
            };
            let tops = summits(tops);
            if warm.is_empty() {
                warm = tops.iter().map(|top| top.0).collect();
            }
            bests.extend(tops.into_iter().map(|top| ((start, stop, head), top)));
        }
    }
    let top = bests
        .iter()
        .map(|b| -b.1.1)
        .fold(f64::NEG_INFINITY, f64::max);
    for (jumps, (best, value)) in bests {
        if -value < top - UNLIKELY {
            continue;
        }
        let cost = cost(jumps);
        let widest = [2.0, if unseen { 0.6 } else { 0.05 }, 0.08];
        let guess = widths(&best, value, widest, cost);
        let (points, evidence) = spread(best, guess, 28, cost);
        for (x, weight) in points {
            if let Some(plan) = plan(&x, jumps)
                && weight > 0.0
            {
                parts.push((plan, weight.ln() + evidence));
            }
        }
    }
    parts.retain(|p| p.1.is_finite());
    let top = parts.iter().map(|p| p.1).fold(f64::NEG_INFINITY, f64::max);
    parts.iter_mut().for_each(|p| p.1 = (p.1 - top).exp());
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    (thinner(parts), range)
}
