//! Slip of the cage, and the time until the bearing rolls.
//!
//! ```text
//!   S = 1 - 2(1+s) ω_c/Ω          0 where the balls roll, 1 where the cage rests
//!   σ_S² = (1-S)² [(σ_c/ω_c)² + (σ_Ω/Ω)²]          the rolling ratio 1/(2(1+s)) is exact, as in a radial bearing
//! ```
//! Rolling is *known* where |S| < limit has a probability of 0.95 or more; it is *established* from the time on after which
//! |S| > limit is less likely than not for the rest of the record.
//!
//! **Does not model**: errors of cage and shaft that are alike (a common clock cancels in S); spin of the balls (see
//! [`skid`](crate::skid)); a cage signal made with a wrong ball count (see [`data_checks`](crate::data_checks)).
//!
//! Measured (`tests/cage.rs`, 400 seeds, band of two deviations): the true slip lies in its band at 95.5 % of all times;
//! the true time from which on it stays below the limit lies between earliest and latest in 98 % of the seeds.

use crate::measurement::Measurement;
use physics::rolling::RollingSet;
use statistics::interpolation::between;
use statistics::normal::beyond;
use statistics::uncertain::Uncertain;

/// Deviations from 0 beyond which a slip is one, however wide its band.
const CERTAIN: f64 = 3.0;

/// Largest |S| that counts as rolling, 1: the limit below which F is read from the rolling formula.
pub const LIMIT: f64 = 0.01;
/// Slip is reported only above this part of the fastest speed of the test, 1: balls that have just begun to turn have no slip worth
/// the name.
const LEAST_PART: f64 = 0.05;

/// Slip at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipPoint {
    /// Time, s.
    pub time: f64,
    /// Slip S, 1.
    pub slip: Uncertain,
    /// Probability of |S| above the limit.
    pub slipping: f64,
}

/// Slip of the cage over a test.
#[derive(Clone, Debug, PartialEq)]
pub struct CageSlip {
    /// Slip at the times of the cage signal at which the shaft turns.
    pub points: Vec<SlipPoint>,
    /// Largest probability of |S| above the limit at any one time after the engagement at which the signal shows it: its band is
    /// narrower than the limit, or S is far from 0. At least as probable it is that the cage slipped in this test; none where the
    /// signal never shows it.
    pub slipped: Option<f64>,
    /// When rolling is established, with the earliest and the latest time that the band allows.
    pub established: Established,
}

/// When rolling is established.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Established {
    /// It never slipped, as far as the signal shows.
    Throughout,
    /// At a time, s of the record.
    At {
        /// |S| > limit stays less likely than not from here on, s.
        time: f64,
        /// |S| > limit stays less likely than 0.9999 from here on, s: so sure that chance in a long record does not delay it.
        earliest: f64,
        /// |S| > limit stays less likely than 0.025 from here on, s; none if that is not reached.
        latest: Option<f64>,
    },
    /// Not before the record ends.
    Never,
}

/// Slip of the cage of a test.
///
/// Formula: S = 1 - 2(1+s) ω_c/Ω
///
/// - `test`: a test with a cage signal
/// - `set`: for s
///
/// Refused: a test without a cage signal, or whose shaft never turns under it.
pub fn cage_slip(test: &Measurement, set: &RollingSet<f64>) -> Result<CageSlip, String> {
    test.sound()?;
    let Some(cage) = &test.cage else {
        return Err(format!(
            "{}: without a cage signal its slip is not known",
            test.name
        ));
    };
    let points: Vec<SlipPoint> = cage
        .time
        .iter()
        .filter_map(|&time| slip_at(test, set, time))
        .collect();
    if points.is_empty() {
        return Err(format!(
            "{}: the shaft does not turn while the cage was measured",
            test.name
        ));
    }
    let after: Vec<&SlipPoint> = points
        .iter()
        .filter(|point| test.engagement.is_none_or(|start| point.time >= start))
        .collect();
    // a band wider than the limit around no slip says nothing of it
    let shown = |p: &&&SlipPoint| {
        p.slip.deviation <= LIMIT || p.slip.value.abs() > CERTAIN * p.slip.deviation
    };
    let seen = after.iter().filter(shown).map(|p| p.slipping);
    let slipped = seen.reduce(f64::max);
    Ok(CageSlip {
        slipped,
        established: established(&after),
        points,
    })
}

/// Slip at a time, where shaft and cage are known and the shaft turns.
pub(crate) fn slip_at(test: &Measurement, set: &RollingSet<f64>, time: f64) -> Option<SlipPoint> {
    let cage = test.cage.as_ref()?;
    let speed = between(&test.time, &test.speed, time)?;
    if speed.abs() <= LEAST_PART * test.fastest() || speed == 0.0 {
        return None;
    }
    let speed_deviation = between(&test.time, &test.speed_deviation, time)?;
    let own = between(&cage.time, &cage.speed, time)?;
    let deviation = between(&cage.time, &cage.deviation, time)?;
    let rolling = set.cage_speed(speed);
    let ratio = own / rolling;
    let slip = Uncertain::new(
        1.0 - ratio,
        (deviation / rolling).hypot(ratio * speed_deviation / speed),
    );
    Some(SlipPoint {
        time,
        slip,
        slipping: beyond(slip.value, slip.deviation, LIMIT),
    })
}

fn established(after: &[&SlipPoint]) -> Established {
    // first time from which on the probability stays below a bound
    let from = |bound: f64| match after.iter().rposition(|p| p.slipping >= bound) {
        None => after.first().map(|p| p.time),
        Some(last) => after.get(last + 1).map(|p| p.time),
    };
    match (from(0.5), after.first()) {
        (Some(time), Some(first)) if time <= first.time => Established::Throughout,
        (Some(time), _) => Established::At {
            time,
            earliest: from(0.9999).unwrap_or(time),
            latest: from(0.025),
        },
        _ => Established::Never,
    }
}
