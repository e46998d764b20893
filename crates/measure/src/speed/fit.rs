//! Noises and densities from the pulses themselves, and a quick change at first sight.

use super::plan::{Data, Noise, Passage, Plan, Unsteady};
use super::settings::Transient;
use super::transition::Memory;
use statistics::simplex;

/// Passages in one stretch of a quiet part whose likelihood is taken.
pub(super) const STRETCH: usize = 80;

/// Part of the change of speed that lies before its end. What follows may be as unsteady as the change itself was; without
/// this the change would end where it first calms down, with too few pulses for the density of its snap.
const MOST: f64 = 0.85;

/// A quick change as it looks at first sight.
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

impl Sight {
    /// A change by `change` between two instants, most of which has come at a third.
    pub(super) fn new(
        data: &Data,
        (engage, most, lock): (f64, f64, f64),
        rests: bool,
        change: f64,
    ) -> Sight {
        let first = data.passages.partition_point(|p| p.time <= engage);
        let after = data.passages.partition_point(|p| p.time < lock);
        Sight {
            engage,
            lock,
            most: most.min(lock),
            first,
            after,
            rests,
            change,
            ends: after + 3 < data.passages.len(),
        }
    }
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
    let interval = |k: usize| all[k + 1].time - all[k].time;
    let silence = all[0].time - data.watched.0;
    // At rest before: watched for long without a pulse, or intervals that shrink as from rest.
    let rests = from == 0
        && (silence > 2.0 * interval(0) || (silence < 1e-9 && interval(0) > 1.6 * interval(1)));
    let over = intervals(data);
    let speeds = rough_speeds(data, from..to, over);
    let steady = rough_speeds(data, from..to, 4 * over - 3);
    let top_of =
        |speeds: &[f64]| (0..speeds.len()).max_by(|&a, &b| speeds[a].total_cmp(&speeds[b]));
    let top = top_of(&speeds)?;
    let high = steady[top_of(&steady)?];
    let low = if rests {
        0.0
    } else {
        steady[..=top].iter().copied().fold(f64::INFINITY, f64::min)
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
    let most = all[from + most].time;
    Some(Sight::new(data, (engage, most, lock), rests, change))
}

/// Noise of a rough speed, as a part of it, that first sight bears: a quarter of what it looks at.
const CLEAR: f64 = 0.01;
/// Most intervals that a rough speed is taken over; a quick change has hardly more.
const BLURRED: usize = 7;

/// Intervals, an odd number of them, over which a speed is taken to see it clearly.
fn intervals(data: &Data) -> usize {
    let parts = (data.passages.iter()).map(|p| p.spread * p.speed.abs() / data.pitch);
    // Some flanks are met by a sample; those that are not count.
    let noise = std::f64::consts::SQRT_2 * crate::quantile::quantile(parts, 0.9);
    let needed = (noise / CLEAR).ceil().min(BLURRED as f64) as usize;
    needed.max(1) | 1
}

/// Speed of each interval, over so many about it, with the median of three: one odd interval is no change of speed.
fn rough_speeds(data: &Data, range: std::ops::Range<usize>, over: usize) -> Vec<f64> {
    let all = &data.passages;
    let (from, to) = (range.start, range.end);
    let speed = |k: usize| {
        let about = k.saturating_sub(over / 2).max(from)..(k + 1 + over / 2).min(to - 1);
        // Nothing is seen across a silence of the pickup.
        let parted = over > 1 && (about.clone()).any(|j| data.is_fresh(all[j + 1].time));
        let (a, b) = match parted {
            true => (k, k + 1),
            false => (about.start, about.end),
        };
        (all[b].value - all[a].value) / (all[b].time - all[a].time)
    };
    let mut rough: Vec<f64> = (from..to - 1).map(speed).collect();
    // Over a silence of the pickup nothing is seen of the speed.
    for k in (from..to - 1).filter(|&k| data.is_fresh(all[k + 1].time)) {
        rough[k - from] = if k > from {
            rough[k - from - 1]
        } else {
            speed(k + 1)
        };
    }
    (0..rough.len())
        .map(|k| {
            let (a, b) = (
                rough[k.saturating_sub(1)],
                rough[(k + 1).min(rough.len() - 1)],
            );
            a.min(b).max(rough[k].min(a.max(b)))
        })
        .collect()
}

/// Stretches of a part of the passages, at most three, spread over it.
pub(super) fn stretches(range: std::ops::Range<usize>) -> Vec<std::ops::Range<usize>> {
    let n = range.len();
    if n <= 3 * STRETCH {
        return vec![range];
    }
    let step = (n - STRETCH) / 2;
    (0..3)
        .map(|k| range.start + k * step..range.start + k * step + STRETCH)
        .collect()
}

/// Density that changes a speed by a thousandth over a hundred intervals.
pub(super) fn usual_density(speed: f64) -> f64 {
    1e-12 * speed * speed
}

/// How far the logarithm of a density is from what is expected before anything is seen, as a square; a weak belief.
pub(super) fn unusual(log_density: f64, speed: f64) -> f64 {
    ((log_density - (1e-6 * speed).ln()) / 14.0).powi(2)
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
    let all = parts.iter().flat_map(|part| &data.passages[part.clone()]);
    let stated = crate::quantile::median(all.map(|p| p.spread)).max(1e-12);
    let noise = |x: &[f64; 4]| Noise {
        timing: if data.calibrated { x[0].exp() } else { 1.0 },
        angle: if data.calibrated {
            usual
        } else {
            usual * x[0].exp()
        },
        memory: Memory::of_clock(stated * x[1].exp(), (-x[2]).exp()),
    };
    let cost = |x: &[f64; 4]| {
        let plan = Plan::steady(noise(x), x[3].exp());
        let fit = plan.likelihood_in(data, &parts);
        let belief = (x[0] / if data.calibrated { 1.0 } else { 1.5 }).powi(2)
            + ((x[1] + 1.0) / 1.5).powi(2)
            + ((x[2] - 1.5) / 1.0).powi(2)
            + unusual(x[3], speed);
        0.5 * belief - fit
    };
    let (best, _) = simplex::lowest(
        [0.0, -0.5, 1.5, usual_density(speed).ln()],
        [0.5, 1.0, 1.0, 4.0],
        0.1,
        160,
        cost,
    );
    (noise(&best), best[3].exp())
}

/// Density of a long quiet part with noise that is known: neighbouring pulses show quick changes, far ones slow changes.
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
        let plan = Plan::steady(noise, x[0].exp());
        -sets
            .iter()
            .map(|set| plan.likelihood_of(data, set))
            .sum::<f64>()
    };
    simplex::lowest([first.ln()], [-3.0], 0.1, 25, cost).0[0].exp()
}

/// Density of the stretch in which a quick change settles, with noise that is known.
pub(super) fn settling(
    data: &Data,
    range: std::ops::Range<usize>,
    noise: Noise,
    quiet: f64,
) -> f64 {
    let cost = |x: &[f64; 1]| {
        let plan = Plan::steady(noise, quiet * x[0].exp());
        -plan.likelihood(data, range.clone())
    };
    let start = simplex::lowest([0.0], [4.0], 0.05, 12, cost).0;
    quiet
        * simplex::lowest(start, [2.0], 0.05, 16, cost).0[0]
            .max(0.0)
            .exp()
}

/// Gain of the logarithm of the likelihood from which a stretch counts as less steady than its part of the record: of a
/// hundred stretches that are not, one gains so much by chance.
const NOTABLE: f64 = 4.0;

/// Stretches behind the quick change, or anywhere where there is none, that are less steady than the part of the record they lie
/// in: a clutch that lets go, a brake, the corner at which a slow ramp ends, the last turns before a stop.
///
/// Windows of 80 marks, of every fourth, every sixteenth and so on: what is quick shows in short ones, what is weak in long
/// ones. They overlap by half, so that nothing happens between two of them; a part has the largest density of its windows.
pub(super) fn unsteady(data: &Data, plan: &Plan) -> Vec<Unsteady> {
    const PART: usize = STRETCH / 2;
    const LONGER: usize = 4;
    let quiet_from = plan.transient.map_or(f64::NEG_INFINITY, |knots| knots.lock);
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
        .map(|(k, density)| Unsteady {
            from: part(k).0,
            to: part(k).1,
            density: *density,
        })
        .collect()
}

/// Density of a window of its own, where it is much more likely than the usual one, which is given by its logarithm.
fn own_density(data: &Data, plan: &Plan, window: &[Passage], usual: f64) -> Option<f64> {
    let cost = |x: &[f64; 1]| -Plan::steady(plan.noise, x[0].exp()).likelihood_of(data, window);
    let here = cost(&[usual]);
    let best = [2.0, 4.0, 7.0, 10.0, 14.0, 20.0]
        .map(|more| (usual + more, cost(&[usual + more])))
        .into_iter()
        .fold((usual, here), |a, b| if b.1 < a.1 { b } else { a });
    let notable = here - best.1 > NOTABLE;
    notable.then(|| simplex::lowest([best.0], [1.5], 0.1, 14, cost).0[0].exp())
}
