//! Noises, densities and knots from the pulses themselves.

use super::Transient;
use super::matrix::Memory;
use super::plan::{Data, Head, Knot, Livelier, Lively, Noise, Passage, Plan};
use super::search::{smallest, spread};

/// Passages in one stretch of a quiet part whose likelihood is taken.
pub(super) const STRETCH: usize = 80;
/// Passages beyond the lively part that take part in its fit.
const BEYOND: usize = 40;

/// Part of the change of speed that lies before its end. What follows may settle as lively as the change itself was; without
/// this the change would end where it first calms down, and too few pulses would tell how lively it is.
const MOST: f64 = 0.85;

/// Fall of the logarithm of the likelihood at a width: that of two and a half standard deviations of a normal density.
const STEEP: f64 = 3.0;

/// A lively part as it looks at first sight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight {
    pub engage: f64,
    pub lock: f64,
    /// When most of the change has come: the end is not before.
    pub most: f64,
    /// First passage after the engagement.
    pub first: usize,
    /// First passage after the end.
    pub after: usize,
    pub rests: bool,
    /// Change of speed, in units.
    pub change: f64,
    /// Whether the end lies within the record.
    pub ends: bool,
}

/// Looks for the steepest rise of speed.
pub(super) fn sight(data: &Data, wanted: &Transient) -> Option<Sight> {
    let all = &data.passages;
    let n = all.len();
    let (from, to) = match *wanted {
        Transient::None => return None,
        Transient::Auto => (0, n),
        Transient::Within(a, b) => {
            let (a, b) = (data.units(a), data.units(b));
            (
                all.partition_point(|p| p.time < a),
                all.partition_point(|p| p.time <= b),
            )
        }
    };
    if to < from + 4 {
        return None;
    }
    let speed = |k: usize| (all[k + 1].angle - all[k].angle) / (all[k + 1].time - all[k].time);
    let interval = |k: usize| all[k + 1].time - all[k].time;
    let silence = all[0].time - data.watched.0;
    // At rest before: watched for long without a pulse, or intervals that shrink as from rest.
    let rests = from == 0
        && (silence > 2.0 * interval(0) || (silence < 1e-9 && interval(0) > 1.6 * interval(1)));
    let mut rough: Vec<f64> = (from..to - 1).map(speed).collect();
    // Over a silence of the pickup nothing is seen of the speed.
    for k in (from..to - 1).filter(|&k| data.is_fresh(all[k + 1].time)) {
        rough[k - from] = if k > from {
            rough[k - from - 1]
        } else {
            speed(k + 1)
        };
    }
    // The median of three: one odd interval is no change of speed.
    let speeds: Vec<f64> = (0..rough.len())
        .map(|k| {
            let (a, b) = (
                rough[k.saturating_sub(1)],
                rough[(k + 1).min(rough.len() - 1)],
            );
            a.min(b).max(rough[k].min(a.max(b)))
        })
        .collect();
    let (top, &high) = speeds
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(b.1))?;
    let low = if rests {
        0.0
    } else {
        speeds[..=top].iter().copied().fold(f64::INFINITY, f64::min)
    };
    let change = high - low;
    if change < 0.3 * high {
        return None;
    }
    // The first interval that reaches nearly all of the change, and the last one before it with nearly none.
    let end = (0..=top).find(|&k| speeds[k] >= low + 0.96 * change)?;
    let most = (0..=end).find(|&k| speeds[k] >= low + MOST * change)?;
    let start = if rests {
        0
    } else {
        (0..end).rfind(|&k| speeds[k] <= low + 0.04 * change)?
    };
    let lock = 0.5 * (all[from + end].time + all[from + end + 1].time);
    let engage = if rests {
        // The first mark comes after about a third of a motion that ends with the lock.
        (all[0].time - 0.5 * (lock - all[0].time).max(interval(0))).max(data.watched.0 - 1e-9)
    } else {
        0.5 * (all[from + start].time + all[from + start + 1].time)
    };
    let engage = if rests && silence < 1e-9 {
        all[0].time - (lock - all[0].time) * 0.5
    } else {
        engage
    };
    if !rests {
        // A slow ramp needs no knots: the change must be much quicker than what is around it.
        let length = lock - engage;
        let whole = all[n - 1].time - all[0].time;
        if length > 0.5 * whole {
            return None;
        }
    }
    let first = all.partition_point(|p| p.time <= engage);
    let after = all.partition_point(|p| p.time < lock);
    Some(Sight {
        engage,
        lock,
        most: all[from + most].time.min(lock),
        first,
        after,
        rests,
        change,
        ends: after + 3 < n,
    })
}

/// Stretches of a part of the passages, at most three, spread over it.
fn stretches(range: std::ops::Range<usize>) -> Vec<std::ops::Range<usize>> {
    let n = range.len();
    if n <= 3 * STRETCH {
        return vec![range];
    }
    let step = (n - STRETCH) / 2;
    (0..3)
        .map(|k| range.start + k * step..range.start + k * step + STRETCH)
        .collect()
}

/// Noise and density of a quiet part by their likelihood, with a weak belief about the noise.
pub(super) fn quiet(data: &Data, range: std::ops::Range<usize>) -> (Noise, f64) {
    let parts = stretches(range);
    let speed = data.passages[parts[0].start + parts[0].len() / 2]
        .speed
        .abs()
        .max(1e-9);
    // What is not stated: residual mark errors, and noise of the signal that flanks carry into the angle.
    let usual = data.pitch * if data.calibrated { 3e-4 } else { 3e-3 };
    let mut spreads: Vec<f64> = parts
        .iter()
        .flat_map(|p| data.passages[p.clone()].iter().map(|p| p.spread))
        .collect();
    let stated = crate::pulse::median(&mut spreads).max(1e-12);
    let noise = |x: &[f64; 4]| Noise {
        timing: if data.calibrated { x[0].exp() } else { 1.0 },
        angle: if data.calibrated {
            usual
        } else {
            usual * x[0].exp()
        },
        memory: Memory {
            spread: stated * x[1].exp(),
            rate: (-x[2]).exp(),
        },
    };
    let cost = |x: &[f64; 4]| {
        let plan = Plan {
            noise: noise(x),
            quiet: [x[3].exp(); 3],
            lively: None,
            settled: 0.0,
            rests: false,
        };
        let fit: f64 = parts
            .iter()
            .map(|part| plan.likelihood(data, part.clone()))
            .sum();
        let belief = (x[0] / if data.calibrated { 1.0 } else { 1.5 }).powi(2)
            + ((x[1] + 1.0) / 1.5).powi(2)
            + ((x[2] - 1.5) / 1.0).powi(2)
            + ((x[3] - (1e-6 * speed).ln()) / 14.0).powi(2);
        0.5 * belief - fit
    };
    // A density that changes the speed by a thousandth over a hundred intervals, to begin with.
    let (best, _) = smallest(
        [0.0, -0.5, 1.5, (1e-12 * speed * speed).ln()],
        [0.5, 1.0, 1.0, 4.0],
        160,
        0.1,
        cost,
    );
    (noise(&best), best[3].exp())
}

/// Density of a long quiet part with noise that is known: neighbouring pulses tell quick changes, far ones slow changes.
pub(super) fn calm(data: &Data, range: std::ops::Range<usize>, noise: Noise, first: f64) -> f64 {
    let sparse = |step: usize| -> Vec<Passage> {
        let count = (range.len() / step).min(STRETCH);
        let skip = range.len() - count * step;
        data.passages[range.clone()]
            .iter()
            .skip(skip / 2)
            .step_by(step)
            .take(count)
            .copied()
            .collect()
    };
    let whole = range.len().div_ceil(STRETCH);
    let mut sets: Vec<Vec<Passage>> = stretches(range.clone())
        .into_iter()
        .map(|part| data.passages[part].to_vec())
        .collect();
    let middle = (whole as f64).sqrt().round() as usize;
    sets.extend(
        [middle, whole]
            .into_iter()
            .filter(|&step| step > 1)
            .map(sparse),
    );
    let cost = |x: &[f64; 1]| {
        let plan = Plan {
            noise,
            quiet: [x[0].exp(); 3],
            lively: None,
            settled: 0.0,
            rests: false,
        };
        -sets
            .iter()
            .map(|set| plan.likelihood_of(data, set))
            .sum::<f64>()
    };
    smallest([first.ln()], [-3.0], 25, 0.1, cost).0[0].exp()
}

/// Density of the stretch in which a lively part settles, with noise that is known.
pub(super) fn settling(
    data: &Data,
    range: std::ops::Range<usize>,
    noise: Noise,
    quiet: f64,
) -> f64 {
    let cost = |x: &[f64; 1]| {
        let plan = Plan {
            noise,
            quiet: [quiet * x[0].exp(); 3],
            lively: None,
            settled: 0.0,
            rests: false,
        };
        -plan.likelihood(data, range.clone())
    };
    let start = smallest([0.0], [4.0], 12, 0.05, cost).0;
    quiet * smallest(start, [2.0], 16, 0.05, cost).0[0].max(0.0).exp()
}

/// Gain of the logarithm of the likelihood from which a stretch counts as livelier than its part of the record: of a
/// hundred stretches that are not, one gains so much by chance.
const NOTABLE: f64 = 4.0;

/// Stretches behind the quick change, or anywhere where there is none, that are livelier than the part of the record they lie
/// in: a clutch that lets go, a brake, the corner at which a slow ramp ends, the last turns before a stop.
///
/// Windows of 80 marks, of every fourth, every sixteenth and so on: what is quick shows in short ones, what is weak in long
/// ones. They overlap by half, so that nothing happens between two of them; a part has the largest density of its windows.
pub(super) fn livelier(data: &Data, plan: &Plan) -> Vec<Livelier> {
    const PART: usize = STRETCH / 2;
    const LONGER: usize = 4;
    let quiet_from = plan.lively.map_or(f64::NEG_INFINITY, |lively| lively.lock);
    let first = data.passages.partition_point(|p| p.time <= quiet_from);
    let all = &data.passages[first..];
    let mut densities = vec![0.0f64; all.len().div_ceil(PART)];
    let mut step = 1;
    while step * STRETCH <= all.len() {
        let latest = all.len() - step * STRETCH;
        for begin in (0..latest).step_by(step * PART).chain([latest]) {
            let end = begin + step * STRETCH;
            let usual = plan.density(all[begin + step * PART].time).ln();
            let window: Vec<Passage> = all[begin..end].iter().step_by(step).copied().collect();
            if let Some(density) = own_density(data, plan, &window, usual) {
                for own in &mut densities[begin / PART..end.div_ceil(PART)] {
                    *own = own.max(density);
                }
            }
        }
        step *= LONGER;
    }
    let part = |k: usize| {
        let end = ((k + 1) * PART).min(all.len() - 1);
        (all[k * PART].time, all[end].time)
    };
    (densities.iter().enumerate())
        .filter(|(_, density)| **density > 0.0)
        .map(|(k, density)| Livelier {
            from: part(k).0,
            to: part(k).1,
            density: *density,
        })
        .collect()
}

/// Density of a window of its own, where it is much more likely than the usual one, which is given by its logarithm.
fn own_density(data: &Data, plan: &Plan, window: &[Passage], usual: f64) -> Option<f64> {
    let cost = |x: &[f64; 1]| {
        let alone = Plan {
            quiet: [x[0].exp(); 3],
            lively: None,
            settled: 0.0,
            rests: false,
            ..*plan
        };
        -alone.likelihood_of(data, window)
    };
    let here = cost(&[usual]);
    let best = [2.0, 4.0, 7.0, 10.0, 14.0, 20.0]
        .map(|more| (usual + more, cost(&[usual + more])))
        .into_iter()
        .fold((usual, here), |a, b| if b.1 < a.1 { b } else { a });
    let notable = here - best.1 > NOTABLE;
    notable.then(|| smallest([best.0], [1.5], 14, 0.1, cost).0[0].exp())
}

/// Passages that tell the knots and the density: all near the knots, some between where there are many.
fn thinned(data: &Data, sight: &Sight, range: std::ops::Range<usize>) -> Vec<Passage> {
    const ALL: usize = 24;
    const BETWEEN: usize = 40;
    let inner =
        (sight.first + ALL).min(sight.after)..sight.after.saturating_sub(ALL).max(sight.first);
    let step = inner.len().div_ceil(BETWEEN).max(1);
    range
        .filter(|k| !inner.contains(k) || (k - inner.start) % step == 0)
        .map(|k| data.passages[k])
        .collect()
}

/// Widths of a likelihood about its best along each parameter, from the widest ones: exact pulses leave much less open, and
/// points that all lie far away would tell nothing.
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

/// Points from which the likelihood is climbed: the best of a scan over the engagement, the density and the end, and the best
/// one far from it. A clutch that engages softly and one that grips late may both explain the same marks. A change is seen to
/// end where nearly all of it has come; a torque that rises to the end has still a fiftieth of its way to go there.
fn valleys(sight: &Sight, density: f64, cost: impl Fn(&[f64; 3]) -> f64) -> Vec<[f64; 3]> {
    const DENSITY: [f64; 4] = [1.0, -2.0, -5.0, -9.0];
    const END: [f64; 3] = [0.0, 0.01, 0.02];
    let places: &[f64] = if sight.rests {
        &[
            -4.5, -3.5, -2.75, -2.25, -1.75, -1.25, -0.75, -0.25, 0.4, 1.1,
        ]
    } else {
        &[-0.15, -0.1, -0.05, 0.0, 0.05, 0.1, 0.15]
    };
    let mut best: Vec<([f64; 3], f64)> = places
        .iter()
        .map(|&place| {
            DENSITY
                .iter()
                .flat_map(|q| END.map(|end| [density.ln() + q, place, end]))
                .map(|point| (point, cost(&point)))
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .expect("a density")
        })
        .collect();
    let top = (0..best.len())
        .min_by(|&a, &b| best[a].1.total_cmp(&best[b].1))
        .expect("a point");
    let far = (0..best.len())
        .filter(|&k| k.abs_diff(top) > 2)
        .min_by(|&a, &b| best[a].1.total_cmp(&best[b].1))
        .expect("a point");
    vec![
        best.swap_remove(top.max(far)).0,
        best.swap_remove(top.min(far)).0,
    ]
}

/// Most looks at the likelihood on one climb.
const CLIMB: usize = 300;
/// Plans that are kept.
const KEPT: usize = 24;

/// Some plans that stand for many, given the heaviest first: that one, and others at equal steps of the summed weight along
/// the engagement. To keep only the heaviest would cut off what is less likely on both sides, and the band with it.
fn thinner(mut parts: Vec<(Plan, f64)>) -> Vec<(Plan, f64)> {
    let Some(&(best, _)) = parts.first() else {
        return parts;
    };
    let sum: f64 = parts.iter().map(|p| p.1).sum();
    let engage = |plan: &Plan| plan.lively.map_or(0.0, |lively| lively.engage);
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

/// Whether a change has so many marks that its start may be livelier than the whole: a motor that follows an even ramp with
/// a lag.
pub(super) fn is_long(sight: &Sight) -> bool {
    sight.after.saturating_sub(sight.first) > 3 * STRETCH
}

/// Plans for the lively part with their weights, the best one first.
pub(super) fn lively(
    data: &Data,
    sight: &Sight,
    base: &Plan,
) -> (Vec<(Plan, f64)>, std::ops::Range<usize>) {
    let from = if sight.rests {
        0
    } else {
        sight.first.saturating_sub(BEYOND)
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
    let plan = |x: &[f64; 3], (start, stop, head): (Knot, Knot, f64)| -> Option<Plan> {
        let engage = if sight.rests {
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
            lively: Some(Lively {
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
                let stretched = if sight.rests { x[1] } else { 0.0 };
                -plan.likelihood_of(data, some) - belief - stretched
            }
            None => f64::INFINITY,
        }
    };
    let stops: &[Knot] = if sight.ends {
        &[Knot::Jump, Knot::Kink, Knot::Soft]
    } else {
        &[Knot::Soft]
    };
    let heads: &[f64] = if is_long(sight) {
        &[0.0, 1e-3, 1e-2, 1e-1]
    } else {
        &[0.0]
    };
    let mut bests = Vec::new();
    for (start, head) in [Knot::Soft, Knot::Kink, Knot::Jump]
        .into_iter()
        .flat_map(|start| heads.iter().map(move |&head| (start, head)))
    {
        let mut warm: Option<[f64; 3]> = None;
        for &stop in stops {
            let cost = cost((start, stop, head));
            let steps = [2.0, if sight.rests { 0.2 } else { 0.05 }, 0.05];
            let from = |point, calls| smallest(point, steps, calls, 0.1, &cost);
            let best = match warm {
                Some(warm) => from(warm, CLIMB / 2),
                None => valleys(sight, density, cost)
                    .into_iter()
                    .map(|point| from(point, CLIMB))
                    .min_by(|a, b| a.1.total_cmp(&b.1))
                    .expect("the scan names a point"),
            };
            warm = Some(best.0);
            bests.push(((start, stop, head), best));
        }
    }
    let top = bests
        .iter()
        .map(|b| -b.1.1)
        .fold(f64::NEG_INFINITY, f64::max);
    for (jumps, (best, value)) in bests {
        // What is less likely by e^-5 at its best has no weight.
        if -value < top - 5.0 {
            continue;
        }
        let cost = cost(jumps);
        let widest = [2.0, if sight.rests { 0.6 } else { 0.05 }, 0.08];
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
