//! Whether traction can turn the balls against the steady moment.
//!
//! ```text
//!   capacity   μ_max R ΣQ_i/M: the balls roll where it is above 1.2, and must skid where it is below 1
//! ```
//! Every pressed ball shares the moment by its load, so that all of them use 1/capacity of their traction: see
//! [`steady_moment`](crate::bearing::steady_moment). Near 1 they creep, and what else they lose decides.

use crate::bearing::BearingConstants;
use physics::traction::{SlidingContact, Traction, TractionLaw};

/// Traction capacity over M below which the balls must skid.
pub const LEAST_CAPACITY: f64 = 1.2;

/// The largest coefficient of a traction law at the inner race, searched over slips of 1e-6 to 1e3 m/s.
///
/// - `load`: of a ball, N
/// - `entrainment`: m/s
pub fn largest_coefficient(traction: &Traction<f64>, load: f64, entrainment: f64) -> f64 {
    (0..=900)
        .map(|i| {
            let at = SlidingContact {
                slip: 10_f64.powf(f64::from(i) / 100.0 - 6.0),
                load,
                entrainment,
            };
            traction.at_races(&at, &at).0
        })
        .fold(0.0, f64::max)
}

/// Largest traction moment of the balls on the inner race, N m: their mean load and rolling stand for all of them.
///
/// - `speed`: of the inner race, rad/s
/// - `inner_load_sum`: of all balls, N
pub fn traction_capacity(
    traction: &Traction<f64>,
    bearing: &BearingConstants,
    speed: f64,
    inner_load_sum: f64,
) -> f64 {
    let set = bearing.set();
    let track = set.inner_track_radius;
    let load = inner_load_sum / bearing.balls() as f64;
    let entrainment = track * (speed - set.cage_speed(speed));
    largest_coefficient(traction, load, entrainment) * track * inner_load_sum
}
