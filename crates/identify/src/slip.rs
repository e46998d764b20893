//! Slip of the cage, and the time until the bearing rolls.
//!
//! ```text
//!   S = 1 - 2(1+s) ω_c/Ω          0 where the balls roll, 1 where the cage rests
//!   σ_S² = (1-S)² [(σ_c/ω_c)² + (σ_Ω/Ω)² + σ_ratio²]
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

/// What counts as rolling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipSettings {
    /// Largest |S| that counts as rolling, 1.
    pub limit: f64,
    /// Relative standard deviation of the rolling ratio 1/(2(1+s)), 1: of track radii and contact angle.
    pub ratio_deviation: f64,
    /// Slip is reported only above this part of the fastest speed of the test, 1.
    pub least_part: f64,
}

impl Default for SlipSettings {
    /// 1 %: the limit below which F is read from the rolling formula. The ratio is exact, as in a radial bearing. Below 5 % of
    /// the fastest speed nothing is reported: balls that have just begun to turn have no slip worth the name.
    fn default() -> Self {
        Self {
            limit: 0.01,
            ratio_deviation: 0.0,
            least_part: 0.05,
        }
    }
}

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
    /// The limit, 1.
    pub limit: f64,
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
/// - `settings`: what counts as rolling
///
/// Refused: a test without a cage signal, or whose shaft never turns under it.
pub fn cage_slip(
    test: &Measurement,
    set: &RollingSet<f64>,
    settings: &SlipSettings,
) -> Result<CageSlip, String> {
    test.sound()?;
    sound(settings)?;
    let Some(cage) = &test.cage else {
        return Err(format!(
            "{}: without a cage signal its slip is not known",
            test.name
        ));
    };
    let points: Vec<SlipPoint> = cage
        .time
        .iter()
        .filter_map(|&time| slip_at(test, set, settings, time))
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
        p.slip.deviation <= settings.limit || p.slip.value.abs() > CERTAIN * p.slip.deviation
    };
    let seen = after.iter().filter(shown).map(|p| p.slipping);
    let slipped = seen.reduce(f64::max);
    Ok(CageSlip {
        limit: settings.limit,
        slipped,
        established: established(&after),
        points,
    })
}

/// Slip at a time, where shaft and cage are known and the shaft turns.
pub(crate) fn slip_at(
    test: &Measurement,
    set: &RollingSet<f64>,
    settings: &SlipSettings,
    time: f64,
) -> Option<SlipPoint> {
    let cage = test.cage.as_ref()?;
    let speed = between(&test.time, &test.speed, time)?;
    if speed.abs() <= settings.least_part * test.fastest() || speed == 0.0 {
        return None;
    }
    let speed_deviation = between(&test.time, &test.speed_deviation, time)?;
    let own = between(&cage.time, &cage.speed, time)?;
    let deviation = between(&cage.time, &cage.deviation, time)?;
    let rolling = set.cage_speed(speed);
    let ratio = own / rolling;
    let slip = Uncertain::new(
        1.0 - ratio,
        (deviation / rolling)
            .hypot(ratio * speed_deviation / speed)
            .hypot(ratio * settings.ratio_deviation),
    );
    Some(SlipPoint {
        time,
        slip,
        slipping: beyond(slip.value, slip.deviation, settings.limit),
    })
}

pub(crate) fn sound(settings: &SlipSettings) -> Result<(), String> {
    for (what, value, least) in [
        ("limit of slip", settings.limit, f64::MIN_POSITIVE),
        (
            "deviation of the rolling ratio",
            settings.ratio_deviation,
            0.0,
        ),
        ("least part of the speed", settings.least_part, 0.0),
    ] {
        if !(value >= least && value < 1.0) {
            return Err(format!("the {what} is {value}; it must be from 0 to 1"));
        }
    }
    Ok(())
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
