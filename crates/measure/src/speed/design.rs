//! How many marks a wheel needs.

use std::f64::consts::TAU;

use super::plan::{Data, Knot, Knots, Noise, Plan};
use super::track::{Track, mixed};
use super::transition::Memory;
use crate::pulse::Pulses;

/// Numbers of marks that wheels and encoders have.
const OFFERED: [usize; 32] = [
    1, 2, 3, 4, 6, 8, 10, 12, 15, 18, 20, 24, 30, 36, 45, 60, 72, 90, 120, 150, 180, 240, 250, 360,
    500, 512, 720, 1000, 1024, 1440, 2000, 2048,
];

/// Fewest pulses within a quick change whose answer is given.
///
/// A change from rest has five unknowns at least: the angle at which it begins and the time, the acceleration and its slope,
/// the end. Angle and speed behind it are known. What is left of n pulses, n - 3, shows how the change goes, and with it
/// the band: of a deviation from ν degrees of freedom a band of two holds nine tenths from ν = 5 on (Student: 0.898), which
/// are eight pulses. `tests/few_marks.rs` shows that it does.
pub(super) const FEWEST_WITHIN: usize = 8;

/// Smallest number of marks offered that is not below a number.
pub(super) fn offered(least: f64) -> Option<usize> {
    OFFERED.into_iter().find(|&marks| marks as f64 >= least)
}

/// Fewest marks per revolution that give the acceleration of a spin-up from rest to the wanted uncertainty, root mean square
/// over the spin-up, as a part of its peak.
///
/// `change`: speed reached, rad/s; `duration`: time in which it is reached, s; `timing`: standard uncertainty of an instant,
/// s; `wanted`: relative uncertainty. None where not even 2048 marks are enough, or an argument is not positive.
///
/// The smoother itself is asked, for a bell-shaped acceleration `(1 - cos 2πt/T)/2` and exactly known mark angles; it
/// promises no more than that. Enough pulses for a band come within the change of an acceleration that rises evenly too, in
/// which the shaft turns by a third of what it would at the speed reached.
pub fn marks_needed(change: f64, duration: f64, timing: f64, wanted: f64) -> Option<usize> {
    let positive = [change, duration, timing, wanted]
        .iter()
        .all(|x| x.is_finite() && *x > 0.0);
    if !positive {
        return None;
    }
    OFFERED.into_iter().find(|&marks| {
        uncertainty(change, duration, timing, marks).is_some_and(|got| got <= wanted)
    })
}

/// Relative uncertainty that a number of marks gives; none where there are too few or far too many to ask.
fn uncertainty(change: f64, duration: f64, timing: f64, marks: usize) -> Option<f64> {
    let pitch = TAU / marks as f64;
    if change * duration / 3.0 < (FEWEST_WITHIN + 1) as f64 * pitch {
        return None;
    }
    let whole = 0.5 * change * duration;
    // Angle of the bell at a part x of its duration.
    let angle = |x: f64| {
        if x < 1.0 {
            2.0 * whole * (0.5 * x * x - (1.0 - (TAU * x).cos()) / (TAU * TAU))
        } else {
            whole + change * duration * (x - 1.0)
        }
    };
    let mut times = Vec::new();
    let beyond = whole + 12.0 * pitch;
    if beyond / pitch > 20_000.0 {
        return None;
    }
    let mut wanted = 0.5 * pitch;
    let mut from = 0.0;
    while wanted < beyond {
        let (mut low, mut high) = (from, 2.0 + beyond / (change * duration));
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if angle(middle) < wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
        from = low;
        times.push(duration * low);
        wanted += pitch;
    }
    let n = times.len();
    let pulses = Pulses {
        uncertainties: vec![timing; n],
        marks: (0..n as i64).collect(),
        positions: marks,
        reference: None,
        watched: (-duration, times[n - 1]),
        sample_interval: None,
        gaps: Vec::new(),
        unseen: 0.0,
        repaired: 0.0,
        notes: Vec::new(),
        times,
    };
    let data = Data::new(&pulses, None);
    let length = duration / data.unit;
    let peak = 2.0 * change * data.unit / length;
    let engage = data.units(0.0);
    let memory = Memory::of_clock(1e-3 * timing / data.unit, 1.0);
    // Knots that the pulses themselves must find: a grid of them, weighted by likelihood.
    let shifts = [-0.12, -0.06, 0.0, 0.06, 0.12];
    let mut parts = Vec::new();
    for (early, late) in shifts
        .iter()
        .flat_map(|a| shifts.iter().map(move |b| (a, b)))
    {
        let engage = engage + early * length;
        // The first mark is at the time zero of the units: the engagement comes before it.
        if engage >= 0.0 {
            continue;
        }
        let plan = Plan {
            noise: Noise {
                timing: 1.0,
                angle: 1e-9 * pitch,
                memory,
            },
            quiet: [1e-9 * change * data.unit; 3],
            transient: Some(Knots {
                engage,
                lock: data.units(duration) + late * length,
                change: change * data.unit,
                density: (3.0 * peak / length).powi(2) / length,
                head: None,
                start: Knot::Kink,
                stop: Knot::Soft,
            }),
            settled: f64::NEG_INFINITY,
            rests: true,
        };
        let (nodes, start) = plan.nodes(&data, 0..n);
        let fit = plan.likelihood(&data, 0..n);
        parts.push((fit, Track::new(&nodes, &start, plan.quiet[2], memory)));
    }
    let top = parts.iter().map(|p| p.0).fold(f64::NEG_INFINITY, f64::max);
    let total: f64 = parts.iter().map(|p| (p.0 - top).exp()).sum();
    let points = 60;
    let square: f64 = (0..points)
        .map(|k| {
            let time = engage + length * (k as f64 + 0.5) / points as f64;
            let beliefs: Vec<_> = parts
                .iter()
                .map(|p| ((p.0 - top).exp() / total, p.1.at(time)))
                .collect();
            mixed(beliefs.iter().copied()).covariance[(2, 2)] / points as f64
        })
        .sum();
    Some(square.sqrt() / peak)
}
