//! The friction F of accelerated balls, over time and as a map.
//!
//! ```text
//!   rolling known   F = [t_O - M + J_O Ω̇]/share          J_O = (1+2s)(3/20 N m_b + ¼ m_c) R², share = (1+2s) R/(2(1+s))
//!   cage measured   F = [t_O - M]/share - a(1+s) + b     (7): a = ⅖ N m_b s R ω̇_b, b = (N m_b + m_c) R (1+s)² ω̇_c
//!   else            t_O - M alone
//! ```
//! The second line holds with any slip of the cage, but the spin of the balls is not measured: a ball that grips one race and
//! slides on the other spins up with (1+s) ω̇_c/s (grips outside) or [Ω̇ - (1+s) ω̇_c]/s (grips inside). The middle is Ω̇/(2s);
//! either end counts as equally likely, so that half their distance is one deviation. M is the moment of *rolling* balls: where the cage slips, the change of M is in this F.
//!
//! The band holds noise, zero and scale of the torque, M's band, the deviations of Ω and Ω̇, and those of the masses. One sensor
//! measured t_O and M: its scale acts on their difference.
//!
//! **Does not model**: errors of Ω̇ and t_O that are alike; a state of the lubricant other than that of the slow tests, which
//! looks like F here (see [`data_checks`](crate::data_checks) and [`explain`](crate::explain)).
//!
//! Measured (`tests/loss.rs`, 400 seeds with another noise, a nonlinear sensor and M from made-up coast-downs, band of two
//! deviations): the true F lies in its band at 95.8 % of all times, the true map at 97.7 % of all places that count as known. With a
//! cage that lags and balls that grip outside throughout, one end of what the second line allows, it is 96.4 % of the slipping times.

mod excess;
mod map;

pub use map::{LossMap, MapPlace};

use crate::measurement::{Measurement, SetDeviation};
use crate::moment::{SteadyMoment, same_load};
use crate::series::rates;
use crate::slip::slip_at;
use physics::rolling::RollingSet;
use problem::{note, note::Note};
use statistics::interpolation::between;
use statistics::uncertain::Uncertain;

/// Window over which the acceleration of a slipping cage is taken, s: the time between two balls that pass at 150 rad/s.
const CAGE_WINDOW: f64 = 0.01;

/// What is known of the rolling of the balls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rolling {
    /// The user states that they roll throughout.
    Stated,
    /// As the cage signal shows; unknown without one.
    #[default]
    ByCage,
}

/// What is known beside a test.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LossSettings {
    /// Whether the balls roll.
    pub rolling: Rolling,
    /// What is not known of masses and radius.
    pub set_deviation: SetDeviation,
}

/// What is known of the balls at one time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// They roll: F by the first line.
    Rolling,
    /// The cage slips, or may: F by the second line, with its wider band.
    MaySlip,
    /// Nothing is known of the cage: no F.
    Unknown,
    /// The speed lies outside the curve of the steady moment: neither F nor t_O - M.
    OutsideMoment,
}

/// What is known at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LossPoint {
    /// Time, s.
    pub time: f64,
    /// Speed Ω, rad/s.
    pub speed: f64,
    /// Acceleration Ω̇, rad/s².
    pub acceleration: f64,
    /// What is known of the balls.
    pub state: State,
    /// t_O - M, N m.
    pub excess: Option<Uncertain>,
    /// Friction F, N, sum over the balls.
    pub friction: Option<Uncertain>,
}

/// The friction of accelerated balls over a test.
#[derive(Clone, Debug, PartialEq)]
pub struct Loss {
    /// One point a time of the test.
    pub points: Vec<LossPoint>,
    /// What is not trustworthy.
    pub notes: Vec<Note>,
}

/// The friction of accelerated balls over a test.
///
/// Formula: F = 2(1+s)/((1+2s) R)·[t_O - M + (1+2s)(3/20 N m_b + ¼ m_c) R² Ω̇] where they roll; else as on this page
///
/// - `test`: speed, acceleration, torque, and the cage where it was measured
/// - `steady`: M(Ω) at the load of the test
/// - `set`: balls and cage
/// - `settings`: what is known beside
pub fn loss(
    test: &Measurement,
    steady: &SteadyMoment,
    set: &RollingSet<f64>,
    settings: &LossSettings,
) -> Result<Loss, String> {
    test.sound()?;
    steady.sound()?;
    settings.set_deviation.sound()?;
    let arm = set.pocket_friction_arm();
    let inertia = set.outer_inertia();
    if !(arm > 0.0 && arm.is_finite() && inertia >= 0.0 && inertia.is_finite()) {
        return Err("masses and radii of balls and cage must be positive and finite".into());
    }
    let mut notes = Vec::new();
    if !same_load(test.load, steady.load) {
        notes.push(note!(
            "the test was at {} N, the steady moment at {} N: their difference is in F",
            test.load,
            steady.load
        ));
    }
    if settings.rolling == Rolling::ByCage && test.cage.is_none() {
        notes.push(note!(
            "no cage signal, and rolling is not stated: t_O - M is reported, F is not"
        ));
    }
    let cage_rates = test.cage.as_ref().map(|cage| {
        let near = rates(&cage.time, &cage.speed, &cage.deviation, CAGE_WINDOW);
        let wide = rates(&cage.time, &cage.speed, &cage.deviation, 2.0 * CAGE_WINDOW);
        // a straight line over twice the window is wrong by four times as much where the rate bends
        near.iter()
            .zip(&wide)
            .map(|((rate, deviation), (other, _))| (*rate, deviation.hypot((other - rate) / 3.0)))
            .unzip::<f64, f64, Vec<f64>, Vec<f64>>()
    });
    let points: Vec<LossPoint> = (0..test.time.len())
        .map(|k| {
            let time = test.time[k];
            let slip = slip_at(test, set, time);
            let cage_rate = cage_rates.as_ref().and_then(|(rate, deviation)| {
                let times = &test.cage.as_ref()?.time;
                Some(Uncertain::new(
                    between(times, rate, time)?,
                    between(times, deviation, time)?,
                ))
            });
            let excess = excess(test, steady, k);
            let state = match (excess, settings.rolling, slip) {
                (None, ..) => State::OutsideMoment,
                (_, Rolling::Stated, _) => State::Rolling,
                (_, _, Some(slip)) if slip.slipping <= 0.05 => State::Rolling,
                (_, _, Some(_)) if cage_rate.is_some() => State::MaySlip,
                _ => State::Unknown,
            };
            let friction = match (state, excess, cage_rate) {
                (State::Rolling, Some(excess), _) => {
                    Some(rolling_friction(test, set, settings, k, excess))
                }
                (State::MaySlip, Some(excess), Some(rate)) => {
                    Some(slipping_friction(test, set, settings, k, excess, rate))
                }
                _ => None,
            };
            LossPoint {
                time,
                speed: test.speed[k],
                acceleration: test.acceleration[k],
                state,
                excess,
                friction,
            }
        })
        .collect();
    let outside = points
        .iter()
        .filter(|p| p.state == State::OutsideMoment)
        .count();
    if outside > 0 {
        let (low, high) = steady.range();
        notes.push(note!(
            "{} of {} times lie outside the speeds of the steady moment, {:.4} to {:.4} rad/s: nothing is reported there",
            outside, points.len(), low, high
        ));
    }
    Ok(Loss { points, notes })
}

/// Deviation of t_O - M by the scale of the sensor that measured both.
fn scale_part(test: &Measurement, torque: f64, moment: f64) -> f64 {
    test.scale_deviation * (torque - moment)
}

/// t_O - M.
fn excess(test: &Measurement, steady: &SteadyMoment, k: usize) -> Option<Uncertain> {
    let speed = test.speed[k];
    let own = steady.without_scale(speed)?;
    let torque = test.torque[k];
    let deviation = test
        .torque_noise(k)
        .hypot(test.zero_deviation)
        .hypot(own.deviation)
        .hypot(scale_part(test, torque, own.value))
        .hypot(steady.slope(speed)? * test.speed_deviation[k]);
    Some(Uncertain::new(torque - own.value, deviation))
}

fn rolling_friction(
    test: &Measurement,
    set: &RollingSet<f64>,
    settings: &LossSettings,
    k: usize,
    excess: Uncertain,
) -> Uncertain {
    let (arm, inertia) = (set.pocket_friction_arm(), set.outer_inertia());
    let rate = test.acceleration[k];
    let value = (excess.value + inertia * rate) / arm;
    let deviation = excess
        .deviation
        .hypot(inertia * test.acceleration_deviation[k])
        .hypot(settings.set_deviation.outer_inertia(set) * rate)
        / arm;
    Uncertain::new(
        value,
        deviation.hypot(settings.set_deviation.inner_track_radius * value),
    )
}

/// (7), with the spin of the balls between its two bounds.
fn slipping_friction(
    test: &Measurement,
    set: &RollingSet<f64>,
    settings: &LossSettings,
    k: usize,
    excess: Uncertain,
    cage_rate: Uncertain,
) -> Uncertain {
    let (s, radius) = (set.ball_ratio, set.inner_track_radius);
    let (arm, rate) = (set.pocket_friction_arm(), test.acceleration[k]);
    let spin = 0.4 * set.balls_mass * s * radius * (1.0 + s);
    let orbit = (set.balls_mass + set.cage_mass) * radius * (1.0 + s).powi(2);
    let middle = set.ball_spin(rate);
    let half_range = (rate - 2.0 * (1.0 + s) * cage_rate.value).abs() / (2.0 * s);
    let value = excess.value / arm - spin * middle + orbit * cage_rate.value;
    let own = &settings.set_deviation;
    let masses = (own.balls_mass
        * (set.balls_mass * radius * (1.0 + s).powi(2) * cage_rate.value - spin * middle))
        .hypot(own.cage_mass * set.cage_mass * radius * (1.0 + s).powi(2) * cage_rate.value);
    let deviation = (excess.deviation / arm)
        .hypot(spin * half_range)
        .hypot(spin * test.acceleration_deviation[k] / (2.0 * s))
        .hypot(orbit * cage_rate.deviation)
        .hypot(masses)
        .hypot(own.inner_track_radius * value);
    Uncertain::new(value, deviation)
}
