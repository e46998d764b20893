//! What must be said of the tests before their numbers are believed.
//!
//! Each doubt is a finding with its numbers; nothing is averaged away, and nothing here changes a result. A doubt that compares
//! values counts from three deviations on.
//!
//! **Does not model**: which of several causes it is (see [`explain`](crate::explain)); faults of a file or a sensor, which the
//! estimators of `measure` note.

mod finding;
mod reading;

pub use reading::reading;

use crate::dissipation::spin_up_window;
use crate::measurement::Measurement;
use crate::moment::{SteadyMoment, same_load};
use crate::series::{RunningVariance, median, trapezoid};
use physics::rolling::RollingSet;
use statistics::normal::MEDIAN_OF_SIZE;
use statistics::uncertain::Uncertain;

/// What is known beside the tests.
#[derive(Clone, Copy, Default)]
pub struct CheckSettings {
    /// Speed at which the tests are to be analysed, rad/s.
    pub wanted_speed: Option<f64>,
    /// Number of balls with which the cage signal was made.
    pub ball_count: Option<u32>,
    /// Relative change of the moment per kelvin, 1/K, where a temperature is measured: M ∝ e^(change·rise), within two deviations.
    pub moment_per_kelvin: Option<Uncertain>,
}

/// One doubt.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    /// Name of the test that it is about; none where it is about all.
    pub test: Option<String>,
    /// What is doubted.
    pub finding: Finding,
}

/// What is doubted of a test.
#[derive(Clone, Debug, PartialEq)]
pub enum Finding {
    /// A bearing that would drive: the reading has the wrong sign.
    Reversed {
        /// Mean torque along the rotation at steady speed, N m.
        moment: Uncertain,
    },
    /// A torque that no bearing of this size has: the reading has the wrong unit.
    WrongUnit {
        /// Mean torque along the rotation at steady speed, N m.
        moment: f64,
        /// What the law has there from its least to its largest, N m.
        expected: (f64, f64),
    },
    /// A test never reaches the speed at which it is to be analysed.
    NeverReaches {
        /// Its fastest speed, rad/s.
        reached: f64,
        /// The speed that is wanted, rad/s.
        wanted: f64,
    },
    /// The speed of a test leaves the curve of the steady moment.
    OutsideMoment {
        /// Part of its time while turning, 1.
        part: f64,
        /// Part of its time above the speeds of the curve by 3 % and more, 1.
        above: f64,
        /// Speeds of the curve, rad/s.
        range: (f64, f64),
    },
    /// The settled torque is not that of the slow tests: another bearing, load, temperature or state of the lubricant.
    ForeignSteadyMoment {
        /// Speed, rad/s.
        speed: f64,
        /// Settled torque minus M, N m.
        difference: Uncertain,
        /// Settled torque over M, 1.
        ratio: f64,
    },
    /// The slow tests were at another load.
    LoadOfSteadyMoment {
        /// Its load, N.
        load: f64,
        /// Load of the steady moment, N.
        steady_load: f64,
    },
    /// Tests at different loads are together.
    MixedLoads {
        /// Each test with its load, N.
        loads: Vec<(String, f64)>,
    },
    /// The cage settles at another ratio than rolling, as it would if the balls had been counted wrongly.
    WrongBallCount {
        /// Balls that the signal was made with.
        stated: u32,
        /// Count that would make it roll.
        fits: u32,
        /// Measured ω_c over that of rolling, 1.
        ratio: Uncertain,
    },
    /// The cage settles at a ratio that neither rolling nor another count explains.
    CageNeverRolls {
        /// Measured ω_c over that of rolling, 1.
        ratio: Uncertain,
    },
    /// The rise of temperature can explain the whole difference to M by viscosity.
    TemperatureExplains {
        /// Rise from the start, K.
        rise: f64,
        /// Change of the torque that is expected of it, from the least to the largest, N m.
        expected: (f64, f64),
        /// Torque minus M at the end, N m.
        difference: Uncertain,
    },
    /// The torque still changes at the end of the steady speed.
    NotSettled {
        /// Change from the last but one to the last quarter of the hold, N m.
        change: Uncertain,
        /// Between the middles of both, s.
        over: f64,
    },
    /// The record is too short.
    TooShort {
        /// Duration of the steady speed after the spin-up, s.
        lasts: f64,
        /// Duration that is needed, s.
        needed: f64,
    },
}

/// Number of deviations from which on two values count as different.
const APART: f64 = 3.0;
/// Shortest hold after a spin-up that shows whether the torque settles, s: the source paper's slow change takes 3 to 4 s.
const SHORTEST_HOLD: f64 = 4.0;

/// All doubts of tests against a steady moment.
///
/// - `tests`: spin-ups with what follows
/// - `steady`: M(Ω) of the slow tests; none if there is none
/// - `set`: balls and cage
/// - `settings`: what is known beside
///
/// Refused: measurements that are broken. Everything else is a doubt.
pub fn doubts(
    tests: &[&Measurement],
    steady: Option<&SteadyMoment>,
    set: &RollingSet<f64>,
    settings: &CheckSettings,
) -> Result<Vec<Doubt>, String> {
    for test in tests {
        test.sound()?;
    }
    if let Some(steady) = steady {
        steady.sound()?;
    }
    let mut found = Vec::new();
    let Some(first) = tests.first() else {
        return Ok(found);
    };
    if tests.iter().any(|test| !same_load(test.load, first.load)) {
        let loads = tests.iter().map(|t| (t.name.clone(), t.load)).collect();
        found.push(Doubt {
            test: None,
            finding: Finding::MixedLoads { loads },
        });
    }
    for test in tests {
        let mut own = Vec::new();
        let top = test.fastest();
        if let Some(wanted) = settings.wanted_speed
            && top < wanted.abs()
        {
            own.push(Finding::NeverReaches {
                reached: top,
                wanted: wanted.abs(),
            });
        }
        if let Some(steady) = steady {
            if !same_load(test.load, steady.load) {
                own.push(Finding::LoadOfSteadyMoment {
                    load: test.load,
                    steady_load: steady.load,
                });
            }
            outside(test, steady, &mut own);
        }
        cage(test, set, settings, &mut own);
        hold(test, steady, settings, &mut own);
        found.extend(own.into_iter().map(|finding| Doubt::of(test, finding)));
    }
    Ok(found)
}

fn outside(test: &Measurement, steady: &SteadyMoment, found: &mut Vec<Finding>) {
    let top = test.fastest();
    // by time: rows lie closer where the speed bends
    let turning: Vec<(f64, f64)> = (test.speed.iter().zip(trapezoid(&test.time)))
        .map(|(speed, weight)| (speed.abs(), weight))
        .filter(|(speed, _)| *speed > 0.02 * top)
        .collect();
    let (low, high) = steady.range();
    let whole: f64 = turning.iter().map(|(_, weight)| weight).sum();
    let share = |counts: &dyn Fn(f64) -> bool| {
        let part = turning.iter().filter(|(speed, _)| counts(*speed));
        part.map(|(_, weight)| weight).sum::<f64>() / whole.max(f64::MIN_POSITIVE)
    };
    let part = share(&|speed| steady.without_scale(speed).is_none());
    let above = share(&|speed| speed > ABOVE * high);
    // a spin-up through the lowest speeds is not worth a word
    if part > 0.02 {
        found.push(Finding::OutsideMoment {
            part,
            above,
            range: (low, high),
        });
    }
}

/// Where the cage settles in the hold; with another speed or load before or behind it slip is another, a count is not.
fn cage(
    test: &Measurement,
    set: &RollingSet<f64>,
    settings: &CheckSettings,
    found: &mut Vec<Finding>,
) {
    let (start, end) = held(test);
    let middle = 0.5 * (start + end);
    let Some(ratio) = cage_ratio(test, set, (middle, end)) else {
        return;
    };
    let apart = |other: f64, deviation: f64| {
        (ratio.value - other).abs() > 0.01_f64.max(APART * ratio.deviation.hypot(deviation))
    };
    if !apart(1.0, 0.0) {
        return;
    }
    let last = test.time.last().copied().unwrap_or(end);
    let changes = [(start, middle), (end, last)]
        .into_iter()
        .filter_map(|part| cage_ratio(test, set, part))
        .any(|other| apart(other.value, other.deviation));
    if let Some(stated) = settings.ball_count.filter(|count| *count > 0 && !changes) {
        let fits = (ratio.value * f64::from(stated)).round();
        let target = fits / f64::from(stated);
        if (1.0..1000.0).contains(&fits) && fits != f64::from(stated) && !apart(target, 0.0) {
            found.push(Finding::WrongBallCount {
                stated,
                fits: fits as u32,
                ratio,
            });
            return;
        }
    }
    found.push(Finding::CageNeverRolls { ratio });
}

/// Speed of the cage over that of a rolling one between two times, s: the median where the shaft turns fast and without quick
/// changes; none where that is fewer than three values.
fn cage_ratio(
    test: &Measurement,
    set: &RollingSet<f64>,
    (from, to): (f64, f64),
) -> Option<Uncertain> {
    let cage = test.cage.as_ref()?;
    let top = test.fastest();
    let (mut ratios, mut deviations) = (Vec::new(), Vec::new());
    for ((&time, &own), &deviation) in cage.time.iter().zip(&cage.speed).zip(&cage.deviation) {
        let of = |list: &[f64]| statistics::interpolation::between(&test.time, list, time);
        let (Some(speed), Some(rate)) = (of(&test.speed), of(&test.acceleration)) else {
            continue;
        };
        let inside = time >= from && time <= to;
        if inside && speed.abs() > 0.5 * top && rate.abs() < top / 0.1 {
            let rolling = set.cage_speed(speed);
            ratios.push(own / rolling);
            deviations.push(deviation / rolling.abs());
        }
    }
    if ratios.len() < 3 {
        return None;
    }
    let middle = median(&ratios);
    let away: Vec<f64> = ratios.iter().map(|r| (r - middle).abs()).collect();
    let spread = median(&away) / MEDIAN_OF_SIZE;
    Some(Uncertain::new(middle, spread.max(median(&deviations))))
}

/// Begin and end of the hold, s: from the end of the spin-up, or where there is none from the begin, for as long as the shaft turns
/// within a twentieth of its largest speed.
fn held(test: &Measurement) -> (f64, f64) {
    let start = spin_up_window(test).map_or_else(|_| test.begin(), |(_, end)| end);
    let top = test.fastest();
    let end = (test.time.iter().zip(&test.speed))
        .filter(|(time, speed)| **time >= start && speed.abs() >= 0.95 * top)
        .map(|(time, _)| *time)
        .fold(start, f64::max);
    (start, end)
}

/// The steady speed after a spin-up: its duration, and what the torque does there.
fn hold(
    test: &Measurement,
    steady: Option<&SteadyMoment>,
    settings: &CheckSettings,
    found: &mut Vec<Finding>,
) {
    if spin_up_window(test).is_err() {
        return;
    }
    let (start, end) = held(test);
    let lasts = end - start;
    if lasts < SHORTEST_HOLD {
        found.push(Finding::TooShort {
            lasts,
            needed: SHORTEST_HOLD,
        });
    }
    let quarter = 0.25 * lasts;
    let inertia = set_free_mean(test, end - 2.0 * quarter, end - quarter);
    let (Some(before), Some(last)) = (inertia, set_free_mean(test, end - quarter, end)) else {
        return;
    };
    let change = Uncertain::new(last.0 - before.0, last.1.hypot(before.1));
    if change.value.abs() > APART * change.deviation {
        found.push(Finding::NotSettled {
            change,
            over: quarter,
        });
    }
    let Some(steady) = steady else { return };
    let late = test.between(end - quarter, end);
    let speed = median(&late.speed);
    let Some(moment) = steady.without_scale(speed) else {
        return;
    };
    let sign = speed.signum();
    let apart = sign * (last.0 - moment.value);
    let difference = Uncertain::new(
        apart,
        last.1
            .hypot(test.zero_deviation)
            .hypot(moment.deviation)
            .hypot(test.scale_deviation * apart),
    );
    if difference.value.abs() <= APART * difference.deviation {
        return;
    }
    found.push(Finding::ForeignSteadyMoment {
        speed,
        difference,
        ratio: last.0 / moment.value,
    });
    let Some(temperature) = &late.temperature else {
        return;
    };
    let rise = median(temperature);
    let Some(change) = settings.moment_per_kelvin else {
        return;
    };
    let bounds = [-2.0, 2.0].map(|off| change.value + off * change.deviation);
    let effects = bounds.map(|change| moment.value.abs() * ((change * rise).exp() - 1.0));
    if !effects.iter().all(|effect| effect.is_finite()) {
        return;
    }
    let expected = (effects[0].min(effects[1]), effects[0].max(effects[1]));
    let same_way = difference.value * (expected.0 + expected.1) > 0.0;
    let most = expected.0.abs().max(expected.1.abs());
    if same_way && most >= difference.value.abs() - 2.0 * difference.deviation {
        found.push(Finding::TemperatureExplains {
            rise,
            expected,
            difference,
        });
    }
}

/// Mean torque between two times and its deviation by noise alone.
fn set_free_mean(test: &Measurement, from: f64, to: f64) -> Option<(f64, f64)> {
    let part = test.between(from, to);
    if part.time.len() < 2 {
        return None;
    }
    let weights = trapezoid(&part.time);
    let whole: f64 = weights.iter().sum();
    let age = part.noise_age();
    let mut noise = RunningVariance::default();
    let (mut sum, mut variance) = (0.0, 0.0);
    for (k, weight) in weights.iter().enumerate() {
        sum += weight / whole * part.torque[k];
        variance = noise.add(age[k], weight / whole * part.torque_noise(k));
    }
    Some((sum, variance.max(0.0).sqrt()))
}

/// Speed over the highest one at which M was measured, from which on M is not known.
const ABOVE: f64 = 1.03;
