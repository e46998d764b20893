//! The steady moment M(Ω) from slow tests.
//!
//! ```text
//!   y = (t_O + J_O Ω̇) sgn Ω  =  M(|Ω|) + zero of the test + noise          means over equal times, |Ω̇| small, balls roll
//!
//!   Palmgren   M = f0·1e-7 d_m³ max(160, (ν n)^(2/3)) + M1      two coefficients; without ν twelve viscosities for its floor
//!   SKF        M = a n^0.6 + b + c n²                            the law's form, without φ_ish, φ_rs and the change of μ_sl
//!   spline     sixteen cubic B-splines, second differences drawn to 0 as strongly as the data ask
//! ```
//! Every coefficient has a normal prior about 0, its shape scaled to the root mean square 1 over the data and its deviation the
//! root mean square of the torque; zeros have the deviation that the measurement states. Noise is a first-order autoregression
//! of unknown size and correlation, so that correlated residuals do not count as so many data. The forms' probabilities follow
//! from their marginal likelihoods, equal odds before. The curve is the mean over the forms by probability, its band holds their
//! disagreement. Coefficients of these forms correlate by 0.98 and more with each other and with the zero: the curve is the result,
//! not they.
//!
//! **Does not model**: a moment that changes with time, temperature or direction inside one call (up against down is compared,
//! not averaged away); noise slower than the test, other than its zero; F in slow tests (taken as 0).
//!
//! Measured (`tests/moment.rs`, 400 made-up coast-downs with another law, another noise and a nonlinear sensor): the band of two
//! deviations holds the true moment at 95.5 % of all speeds after one coast-down of 20 s, at 94.8 % after three of 3 s.
//! Noise alike over 0.6 s, a smoothed one and no autoregression, makes the band wider than it need be: 98.7 %.

mod blocks;
mod curve;
mod fitted;
mod forms;
mod found;
mod settings;
mod unequal;

pub use curve::SteadyMoment;
pub use found::{FormFit, Moment, Parameter, Unequal};
pub use settings::{Form, LEAST_SPEED, SLOW_ACCELERATION};

use crate::measurement::Measurement;
use fitted::{difference, fitted, speeds_up};
use physics::rolling::RollingSet;
use problem::note;

/// Deviation of M outside the speeds at which it was measured, over M at the nearest of them, where it has to be carried on: it may
/// be anything from none to twice that; assumed.
pub(crate) const CARRIED_ON: f64 = 0.5;

/// Loads that differ by less count as one, relative: dead weights are known better.
pub(crate) const SAME_LOAD: f64 = 0.02;

/// The steady moment from slow tests at one load.
///
/// - `tests`: slow tests, or tests with slow parts; quick parts and rest are left out
/// - `set`: balls and cage, for the small part of their inertia
/// - `viscosity`: kinematic, ν, m²/s: sets Palmgren's floor; none where it is not known
///
/// Refused: tests at different loads, too little slow running, a single speed.
pub fn moment(
    tests: &[&Measurement],
    set: &RollingSet<f64>,
    viscosity: Option<f64>,
) -> Result<Moment, String> {
    refuse(tests, set, viscosity)?;
    let mut notes = Vec::new();
    let mut whole = fitted(tests, set, viscosity)?;
    let (up, down): (Vec<_>, Vec<_>) = tests.iter().partition(|test| speeds_up(test));
    let mut up_against_down = None;
    if !up.is_empty() && !down.is_empty() {
        match (fitted(&up, set, viscosity), fitted(&down, set, viscosity)) {
            (Ok(up), Ok(down)) => match difference(&up.curve, &down.curve) {
                Ok(found) => {
                    if found.chance < 0.01 {
                        notes.push(note!(
                            "speeding up and slowing down differ by {} N m: their mean is no steady moment",
                            found.mean.to_string()
                        ));
                    }
                    up_against_down = Some(found);
                }
                Err(why) => notes.push(note!("up and down are not compared: {}", why)),
            },
            _ => notes.push(note!(
                "up and down are not compared: one of them alone is too short"
            )),
        }
    }
    if let Some(best) = whole.forms.first() {
        for parameter in &best.parameters {
            let found = parameter.value;
            if !parameter.name.starts_with("zero") && found.value < -2.0 * found.deviation {
                notes.push(note!(
                    "{} of the most probable form is negative ({} {}): no such law",
                    &parameter.name,
                    found.to_string(),
                    parameter.unit
                ));
            }
        }
        if best.noise_correlation > 0.9 {
            notes.push(note!(
                "errors of neighbouring means correlate by {:.2}: slow noise and the shape of the curve are hard to separate",
                best.noise_correlation
            ));
        }
    }
    if viscosity.is_none() {
        notes.push(note!(
            "the viscosity is not known: Palmgren's floor is averaged over viscosities from 5 to 450 mm²/s"
        ));
    }
    notes.push(note!(
        "no SKF law is given: its form stands without shear heating, starvation and change of sliding friction"
    ));
    whole.notes = notes;
    whole.up_against_down = up_against_down;
    whole.unequal = unequal::unequal(tests, set, viscosity);
    Ok(whole)
}

fn refuse(
    tests: &[&Measurement],
    set: &RollingSet<f64>,
    viscosity: Option<f64>,
) -> Result<(), String> {
    if tests.is_empty() {
        return Err("a steady moment needs a slow test".into());
    }
    for test in tests {
        test.sound()?;
    }
    let inertia = set.outer_inertia();
    if !(inertia.is_finite()
        && inertia >= 0.0
        && set.ball_ratio > 0.0
        && set.inner_track_radius > 0.0)
    {
        return Err("masses and radii of balls and cage must be positive and finite".into());
    }
    let viscosity = viscosity.unwrap_or(1.0);
    if !(viscosity > 0.0 && viscosity.is_finite()) {
        return Err(format!(
            "the viscosity is {viscosity}; it must be positive and finite"
        ));
    }
    if let Some(other) = tests
        .iter()
        .find(|test| !same_load(test.load, tests[0].load))
    {
        return Err(format!(
            "{} was at {} N and {} at {} N: M depends on the load, give tests at one load",
            tests[0].name, tests[0].load, other.name, other.load
        ));
    }
    Ok(())
}

/// Whether two loads count as one: they differ by less than 2 %.
///
/// - `a`, `b`: loads, N
pub fn same_load(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME_LOAD * a.max(b)
}
