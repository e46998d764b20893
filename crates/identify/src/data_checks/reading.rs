//! Whether a reading can be the torque of a bearing: its sign by the power, its size by Palmgren's law.
//!
//! ```text
//!   ∫t_O sgn Ω dt > 0                       at steady speed a bearing brakes; J_O Ω̇ is 1 % of it, and has the reading's unit
//!   M_min/30 < M < 30 M_max                 M of Palmgren's law with f0 from 0.7 to 12, and M1 of 0 to 0.003 F d_m
//! ```

use super::{APART, Doubt, Finding, set_free_mean};
use crate::Measurement;
use crate::moment::{LEAST_SPEED, SLOW_ACCELERATION};
use crate::series::trapezoid;
use physics::palmgren::viscous_moment;
use physics::rolling::RollingSet;
use statistics::uncertain::Uncertain;

/// f0 of ball bearings, from oil mist to a flooded one; makers print 0.7 to 6, and twice that for a vertical shaft (from memory).
const FACTORS: (f64, f64) = (0.7, 12.0);
/// Viscosities of lubricants from hot to cold where none is given, m²/s.
const VISCOSITIES: (f64, f64) = (5e-6, 450e-6);
/// Largest M1 over load and pitch diameter.
const LOAD_PART: f64 = 0.003;
/// Factor beyond the law's own range from which on a unit is wrong: those of torque differ by a thousand.
const BEYOND: f64 = 30.0;
/// Part of the largest speed above which the shaft turns.
const TURNING: f64 = 0.05;

/// What speaks against a reading as such; none where nothing does, or the test never turns steadily.
///
/// - `test`: with its slow parts; the others are left out
/// - `set`: balls and cage
/// - `viscosity`: m²/s, where it is known
pub fn reading(test: &Measurement, set: &RollingSet<f64>, viscosity: Option<f64>) -> Option<Doubt> {
    test.sound().ok()?;
    let least = LEAST_SPEED.max(TURNING * test.fastest());
    let pitch_diameter = 2.0 * set.inner_track_radius * (1.0 + set.ball_ratio);
    let law = |viscosity: f64, speed: f64| viscous_moment(1.0, viscosity, speed, pitch_diameter);
    let (few, much) = viscosity.map_or(VISCOSITIES, |known| (known, known));
    let [mut time, mut moment, mut low, mut high] = [0.0; 4];
    for (k, weight) in trapezoid(&test.time).into_iter().enumerate() {
        let (speed, rate) = (test.speed[k], test.acceleration[k]);
        if speed.abs() >= least && rate.abs() <= SLOW_ACCELERATION {
            time += weight;
            moment += weight * speed.signum() * test.torque[k];
            low += weight * law(few, speed.abs());
            high += weight * law(much, speed.abs());
        }
    }
    let (_, noise) = set_free_mean(test, test.begin(), *test.time.last()?)?;
    let moment = Uncertain::new(moment / time, noise.hypot(test.zero_deviation));
    let (low, high) = (FACTORS.0 * low / time, FACTORS.1 * high / time);
    let load = LOAD_PART * test.load * pitch_diameter;
    // of no slow part nothing compares
    let wrong = moment.value > BEYOND * (high + load) || moment.value < low / BEYOND;
    let finding = if moment.value < -APART * moment.deviation {
        Finding::Reversed { moment }
    } else if wrong && moment.value > APART * moment.deviation {
        Finding::WrongUnit {
            moment: moment.value,
            expected: (low, high + load),
        }
    } else {
        return None;
    };
    Some(Doubt::of(test, finding))
}
