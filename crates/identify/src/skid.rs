//! Spin of the balls, as far as the torque on the outer race shows it.
//!
//! ```text
//!   (7)   ⅖ N m_b s R (1+s) ω̇_b = 2(1+s) T_O + b - F,      T_O = (t_O - M)/((1+2s) R),  ∫b dt = (N m_b + m_c) R (1+s)² ω_c
//!   x = 2s ω_b/Ω        1 where the balls roll on both races;   skid K = 1 - x
//! ```
//! ω_b is integrated from rest at the engagement. F ≥ 0 is not known: an exponential prior about a stated mean. Two cases, even
//! odds before: each ball grips at least one race (x evenly between 1+|S| and 1-|S|), or it skids on both (x evenly below). The
//! torque's error grows with time in the integral: within some 20 ms the torque shows little, later nothing, and this page says so.
//!
//! **Does not model**: balls with different spins (this is their mean); a moment M that falls while balls skid, which looks like
//! less F; memory from one time to the next beyond the integral.

use crate::measurement::Measurement;
use crate::moment::{CARRIED_ON, SteadyMoment};
use crate::series::{RunningVariance, trapezoid};
use crate::slip::{LIMIT, slip_at};
use physics::rolling::RollingSet;
use statistics::interpolation::between;
use statistics::normal::{below, density};
use statistics::uncertain::Uncertain;

/// Bayes factor, or its inverse, from which on the data count as evidence, 1: worth a mention by the usual scale (Kass and Raftery
/// 1995, from memory).
const BAYES_FACTOR: f64 = 3.0;

/// Spin of the balls at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkidPoint {
    /// Time, s.
    pub time: f64,
    /// x = 2s ω_b/Ω by the integral alone, without bounds, 1.
    pub spin_ratio: Uncertain,
    /// Probability of K above the limit; none where the data do not decide.
    pub skidding: Option<f64>,
}

/// Spin of the balls after the engagement.
#[derive(Clone, Debug, PartialEq)]
pub struct Skid {
    /// Points from the engagement on, where the shaft turns.
    pub points: Vec<SkidPoint>,
    /// Last time at which the data decide, s; none if they never do.
    pub known_until: Option<f64>,
    /// Largest probability of a skid at any one time at which the data decide; none if they never do.
    pub skidded: Option<f64>,
}

/// Spin of the balls after an engagement from rest.
///
/// Formula: as on this page
///
/// - `test`: a spin-up from rest with a cage signal
/// - `steady`: M(Ω) at its load; outside its speeds M is taken from the next of them, with half of it as deviation
/// - `set`: balls and cage
/// - `mean_friction`: mean of the prior of F, N; none for a tenth of M over the arm of F, which is assumed
///
/// Refused: no cage signal, no engagement.
pub fn skid(
    test: &Measurement,
    steady: &SteadyMoment,
    set: &RollingSet<f64>,
    mean_friction: Option<f64>,
) -> Result<Skid, String> {
    test.sound()?;
    steady.sound()?;
    let (Some(cage), Some(start)) = (&test.cage, test.engagement) else {
        return Err(format!(
            "{}: the spin of the balls needs a cage signal and the time of engagement",
            test.name
        ));
    };
    let (s, radius) = (set.ball_ratio, set.inner_track_radius);
    let inertia = 0.4 * set.balls_mass * s * radius * (1.0 + s);
    if !(inertia > 0.0 && inertia.is_finite()) {
        return Err("masses and radii must be positive, and the Bayes factor at least 1".into());
    }
    let orbit = (set.balls_mass + set.cage_mass) * radius * (1.0 + s).powi(2);
    let arm = set.pocket_friction_arm();
    let first = test.time.partition_point(|&t| t < start);
    let weights = trapezoid(&test.time[first..]);
    let (low, high) = steady.range();
    // near rest the sign of a measured speed is noise: the rotation has that of the whole test
    let turned: f64 = weights
        .iter()
        .zip(&test.speed[first..])
        .map(|(w, s)| w * s)
        .sum();
    let way = turned.signum();
    let age = test.noise_age();
    let mut noise = RunningVariance::default();
    let (mut push, mut shared, mut friction) = (0.0, 0.0, 0.0);
    let mut points = Vec::new();
    for (k, weight) in (first..test.time.len()).zip(weights) {
        let speed = test.speed[k];
        let time = test.time[k];
        let clamped = speed.abs().clamp(low, high).copysign(way);
        let mut moment = steady.at(clamped).unwrap_or(Uncertain::exact(0.0));
        if steady.without_scale(speed).is_none() {
            moment.deviation = moment.deviation.hypot(CARRIED_ON * moment.value);
        }
        // 2(1+s) T_O = (t_O - M)/arm
        push += weight * (test.torque[k] - moment.value) / arm;
        shared += weight
            * test
                .zero_deviation
                .hypot(moment.deviation)
                .hypot(test.scale_deviation * (test.torque[k] - moment.value))
            / arm;
        friction += weight * mean_friction.unwrap_or(0.1 * moment.value.abs() / arm);
        if k == first {
            // the jump at the engagement lies somewhere within a step of the record, or within its deviation
            shared += weight.max(test.engagement_deviation) * moment.value.abs() / arm;
        }
        let variance = noise.add(age[k], weight * test.torque_noise(k) / arm);
        let Some(own) = between(&cage.time, &cage.speed, time) else {
            continue;
        };
        let Some(deviation) = between(&cage.time, &cage.deviation, time) else {
            continue;
        };
        let Some(slip) = slip_at(test, set, time) else {
            continue;
        };
        let rolling = set.ball_spin(speed);
        let unit = inertia * rolling;
        let ratio = Uncertain::new(
            (push + orbit * own - way * friction) / unit,
            (variance
                .max(0.0)
                .sqrt()
                .hypot(shared)
                .hypot(orbit * deviation)
                .hypot(friction)
                / unit)
                .abs(),
        );
        points.push(SkidPoint {
            time,
            spin_ratio: ratio,
            skidding: probability(ratio, slip.slip.value.abs()),
        });
    }
    if points.is_empty() {
        return Err(format!(
            "{}: shaft and cage are not measured together after the engagement",
            test.name
        ));
    }
    let known = |p: &&SkidPoint| p.skidding.is_some();
    Ok(Skid {
        known_until: points.iter().rfind(known).map(|p| p.time),
        skidded: points.iter().filter_map(|p| p.skidding).reduce(f64::max),
        points,
    })
}

/// Probability of a skid beyond the limit; none where neither case is favoured enough.
fn probability(ratio: Uncertain, slip: f64) -> Option<f64> {
    let deviation = ratio.deviation.max(1e-9);
    let place = |x: f64| (x - ratio.value) / deviation;
    // mean of the likelihood over an interval
    let mean = |from: f64, to: f64| {
        if to - from < 1e-6 * deviation {
            density(place(from)) / deviation
        } else {
            (below(place(to)) - below(place(from))) / (to - from)
        }
    };
    let (least, most) = ((1.0 - slip).max(0.0), 1.0 + slip);
    let grips = mean(least, most);
    let skids = mean(0.0, least);
    let limit = 1.0 - LIMIT;
    // far outside both, the nearer end counts
    let (grips, skids) = if grips + skids > 1e-300 {
        (grips, skids)
    } else if ratio.value > 0.5 {
        (1.0, 0.0)
    } else {
        (0.0, 1.0)
    };
    if grips > 0.0 && skids > 0.0 {
        let factor = skids / grips;
        if factor < BAYES_FACTOR && factor > 1.0 / BAYES_FACTOR {
            return None;
        }
    }
    let part = |from: f64, to: f64, whole: f64| {
        let upper = to.min(limit).max(from);
        if whole <= 0.0 || to <= from {
            0.0
        } else {
            mean(from, upper) * (upper - from) / (whole * (to - from))
        }
    };
    let beyond = grips * part(least, most, grips) + skids * part(0.0, least, skids);
    Some((beyond / (grips + skids)).clamp(0.0, 1.0))
}

#[cfg(test)]
#[path = "../tests/unit/skid.rs"]
mod tests;
