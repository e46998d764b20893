//! Angle, speed and acceleration of a shaft from a speed that an instrument shows: a drive, a converter, a tachometer.
//!
//! ```text
//! instrument   τ ė = Ω - e,  τ = 1/(2π f);   shown at t:  e(t - delay), rounded to steps, with noise
//! samples ─▶ rest, quick change at first sight ─▶ means: close in the change, wide apart else
//!         ─▶ noise and density of the snap by likelihood, more noise where it lasts longer than a mean ─▶ filter and smoother as for pulses
//! ```
//! The motion, its knots and what is averaged over are those of pulses; seen is the fifth state, what the instrument makes of the
//! speed, in place of the angle of marks. The angle is counted from the engagement, or from the first sample.
//!
//! **What it does not model**: an error of the instrument's scale or zero (a part of the speed for all instants: it is not in the
//! band), a bandwidth that is not the stated one, a mean over a time or a filter of higher order (state its delay), a shaft that
//! turns back.

mod samples;

use super::bridge::Bridge;
use super::design::FEWEST_WITHIN;
use super::fit::{self, Sight};
use super::fitted::{QUIET_BEFORE, fitted};
use super::plan::{Data, Noise, Passage, Plan};
use super::settings::{SpeedSettings, Transient};
use super::smoothed::Speed;
use super::stop::Stop;
use super::track::filtered;
use super::transition::{Memory, Vector};
use crate::pulse::Refusal;
use crate::state_space::colour;
use problem::{note, note::Note};
use samples::{Rise, Samples};
use statistics::simplex;
use std::f64::consts::TAU;

/// What shows the speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Instrument {
    /// Frequency at which its first-order low-pass leaves 0.707 of an amplitude, Hz; none where it is not known.
    pub bandwidth: Option<f64>,
    /// Time by which it shows everything late, beside that of the low-pass, s.
    pub delay: f64,
    /// Smallest step of what it shows, rad/s; as the values show it where it is not given.
    pub resolution: Option<f64>,
    /// Standard deviation of the noise of one value, rad/s; from the values where it is not given.
    pub noise: Option<f64>,
}

/// Values of a speed at equal times.
#[derive(Clone, Copy, Debug)]
pub struct Channel<'a> {
    /// Time of the first value, s.
    pub first: f64,
    /// Interval, s.
    pub interval: f64,
    /// Speeds, rad/s; not-a-number where there is none.
    pub values: &'a [f64],
    /// What shows them.
    pub instrument: Instrument,
}

/// What a speed channel shows.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The motion.
    pub speed: Speed,
    /// Standard deviation of the noise of one value, rad/s.
    pub noise: f64,
    /// Smallest step between values, rad/s; 0 where they come in none.
    pub step: f64,
    /// When a shaft that rests at the end of the record was last seen to turn, s.
    pub stop: Option<f64>,
    /// Why a quick change may be the instrument's rather than the shaft's.
    pub doubt: Option<Note>,
}

/// Smallest noise of a mean, as a part of the largest speed. Before the first values nothing is known of the speed up to three tenths
/// of that; the filter carries the variance of that to 2e-16 of itself, so that a variance of 1e-14 of the largest speed is kept
/// to some per cent. Made-up values without noise come below it, and no instrument.
const FINEST: f64 = 1e-7;
/// Means without a known value from which on the motion behind does not follow from that before.
const LONG_GAP: f64 = 4.0;
/// Fewest values that are smoothed at all.
const FEWEST: usize = 12;
/// Means in a quick change, and in the rest of a record at most.
const IN_CHANGE: usize = 120;
const ELSEWHERE: usize = 4000;

/// Rise of a first-order low-pass from a tenth to nine tenths, in time constants: ln 9.
const OWN_RISE: f64 = 2.197;
/// A change whose rise is shown in less than so many rises of the instrument is mostly the instrument's: of twice its own, the
/// true one is √(2² - 1) = 0.87 of what is shown.
const MOSTLY_ITS_OWN: f64 = 2.0;
/// Colour of the noise from which on it is allowed for.
const COLOURED: f64 = 1.2;

/// Smooths a speed that an instrument shows to angle, speed and acceleration.
///
/// Refused: fewer than twelve values, a shaft at rest throughout, a quick change with fewer than eight values, one whose
/// acceleration is less certain than [`SpeedSettings::wanted`].
///
/// Forty made-up records a case, from models other than this one (`tests/speed_channel.rs`): bands of two standard deviations hold
/// the speed at 95.6 to 97.0 % of all instants, the acceleration at 96.6 to 98.6 %, the engagement in 38 to 40 of 40.
pub fn smooth_channel(channel: &Channel, settings: &SpeedSettings) -> Result<Shown, Refusal> {
    let sound = channel.interval > 0.0 && channel.interval.is_finite() && channel.first.is_finite();
    let instrument = &channel.instrument;
    let known = channel.values.iter().filter(|v| v.is_finite()).count();
    if !sound || known < FEWEST {
        return Err(Refusal::new(
            format!("{known} values of a speed"),
            format!("at least {FEWEST} at equal times"),
        ));
    }
    let mut notes = Vec::new();
    let backward = channel.values.iter().filter(|v| **v < 0.0).count();
    let sum: f64 = channel.values.iter().filter(|v| v.is_finite()).sum();
    let sign = if sum < 0.0 && 2 * backward > known {
        notes.push(note!(
            "the speed is negative nearly throughout: it is counted along the rotation"
        ));
        -1.0
    } else {
        1.0
    };
    let samples = Samples::new(
        channel.values.iter().map(|v| sign * v).collect(),
        instrument.resolution,
    );
    let n = samples.len();
    let begin = channel.first - instrument.delay;
    let place = |time: f64| {
        let place = ((time - begin) / channel.interval).ceil().max(0.0) as usize;
        place.min(n)
    };
    let rise = match settings.transient {
        Transient::None => None,
        Transient::Auto => samples.rise((0, n)),
        Transient::Within(from, to) => samples.rise((place(from), place(to))),
    };
    let largest = samples.mean(0, n).unwrap_or(0.0).max(
        (rise.map(|rise| rise.high))
            .unwrap_or_else(|| samples.values.iter().copied().fold(0.0, f64::max)),
    );
    let end = samples.turning(largest);
    if samples.mean(0, end).unwrap_or(0.0) <= 0.0 {
        return Err(Refusal::new(
            "a speed that is not above its noise".into(),
            "a shaft that turns",
        ));
    }
    let lag = instrument
        .bandwidth
        .map(|bandwidth| 1.0 / (TAU * bandwidth));
    let clock = Clock {
        begin,
        interval: channel.interval,
        lag: lag.unwrap_or(0.0),
    };
    let mut data = data(&samples, end, rise.as_ref(), &clock, largest)?;
    let sight = rise.map(|rise| sight(&data, &rise, &clock));
    if let Some(sight) = &sight {
        let within = sight.after.saturating_sub(sight.first);
        if within < FEWEST_WITHIN {
            return Err(Refusal::new(
                format!(
                    "the speed changes by {:.1} rad/s in {:.1} ms, in which {within} values came",
                    sight.change / data.unit,
                    1e3 * (sight.lock - sight.engage) * data.unit
                ),
                format!("at least {FEWEST_WITHIN} values in the change: more values a second"),
            ));
        }
    }
    let memory = match lag {
        Some(lag) => Memory::of_instrument(data.unit / lag, 1.0),
        None => Memory::of_clock(0.0, 0.0),
    };
    let quiet = quiet_range(&data, sight.as_ref());
    let usual = samples.noise * data.unit;
    let stated = instrument.noise.map(|noise| noise * data.unit);
    let (mut noise, mut density) = quieted(
        &data,
        quiet.clone(),
        memory,
        stated.unwrap_or(usual),
        stated.is_some(),
    );
    // Noise that lasts longer than a mean counts as more of the quick one.
    let lasting = lasting(&data, quiet.clone(), noise, density);
    if lasting > COLOURED && stated.is_none() {
        for passage in &mut data.passages {
            passage.left *= lasting;
        }
        noise.angle *= lasting.sqrt();
        density = quieted(&data, quiet, memory, noise.angle, true).1;
    }
    let mut speed = fitted(&mut data, sight.as_ref(), (noise, density), notes)?;
    speed.latency = settings.latency.max(0.0);
    let last = data.passages.len() - 1;
    speed.bridges = (data.fresh.iter())
        .map(|&time| {
            let behind = data.passages.partition_point(|p| p.time < time);
            let (from, to) = (data.passages[behind - 1].time, time);
            Bridge::between(data.seconds(from), data.seconds(to), |time| speed.at(time))
        })
        .collect();
    speed.notes.extend(speed.gaps().map(|gap| {
        note!(
            "no value comes between {:.6} s and {:.6} s: the speeds on both sides are smoothed each by itself",
            gap.from, gap.to
        )
    }).collect::<Vec<_>>());
    if end < n {
        let before = data.seconds(data.passages[last - 1].time);
        speed.stop = Stop::seen(before, speed.at(speed.range().1), clock.time(n as f64));
    }
    if let (Some(change), Some(sight)) = (&mut speed.change, &sight)
        && !change.from_rest
        && sight.first < QUIET_BEFORE
    {
        let length = change.end.map_or(0.0, |end| end.0 - change.engagement.0);
        change.engagement.1 = change.engagement.1.hypot(length);
        speed.notes.push(
            note!(
                "the speed changes quickly from the first values on: when the change began is unknown; needed: a record that begins before it"
            ));
    }
    let doubt = sight.and_then(|sight| {
        let shown = (sight.lock - sight.engage) * data.unit;
        own_rise(shown, instrument.bandwidth)
    });
    if let (Some(change), Some(wanted)) = (speed.change, settings.wanted) {
        let to = change.end.map_or(speed.range().1, |end| end.0);
        let got = speed.relative_uncertainty(change.engagement.0, to);
        if got.is_nan() || got > wanted {
            return Err(Refusal::new(
                format!(
                    "the quick change gives its acceleration to {:.1} % of its peak, {:.1} % are wanted",
                    100.0 * got,
                    100.0 * wanted
                ),
                "an instrument with less noise, or marks on the shaft",
            ));
        }
    }
    Ok(Shown {
        noise: noise.angle / data.unit,
        step: samples.step,
        stop: (end < n).then(|| speed.range().1),
        doubt,
        speed,
    })
}

/// Why a change shown in a time, s, may be the instrument's.
fn own_rise(shown: f64, bandwidth: Option<f64>) -> Option<Note> {
    match bandwidth {
        None => Some(note!(
            "the speed changes within {:.3} ms and the bandwidth of the instrument is not given: it counts as unlimited, and the change may be the rise of the instrument; one of {:.2} Hz rises as long",
            1e3 * shown,
            OWN_RISE / (TAU * shown)
        )),
        Some(bandwidth) => {
            let own = OWN_RISE / (TAU * bandwidth);
            (shown < MOSTLY_ITS_OWN * own).then(|| {
                note!(
                    "the speed changes within {:.3} ms, and an instrument of {:.6} Hz alone rises in {:.3} ms: the rise is mostly the instrument's, and how the shaft moved meanwhile follows from its stated bandwidth; needed: {:.3} Hz",
                    1e3 * shown,
                    bandwidth,
                    1e3 * own,
                    2.0 * bandwidth * own * MOSTLY_ITS_OWN / shown
                )
            })
        }
    }
}

/// Instants of samples on the clock of the shaft.
struct Clock {
    begin: f64,
    interval: f64,
    /// Time constant of the instrument, s.
    lag: f64,
}

impl Clock {
    fn time(&self, sample: f64) -> f64 {
        self.begin + sample * self.interval
    }
}

/// Means of the samples in units of the close ones.
fn data(
    samples: &Samples,
    end: usize,
    rise: Option<&Rise>,
    clock: &Clock,
    largest: f64,
) -> Result<Data, Refusal> {
    let far = end.div_ceil(ELSEWHERE).max(1);
    // Closer than half the instrument's time constant its noise may be alike from mean to mean.
    let apart = (0.5 * clock.lag / clock.interval) as usize;
    let (close, part) = match rise {
        Some(rise) => {
            let length = (rise.to - rise.from).max(1);
            let least = length.div_ceil(IN_CHANGE);
            let close = least.max(apart.min(length / (IN_CHANGE / 3)));
            (
                close.min(far),
                (rise.from.saturating_sub(2 * length), rise.to + 3 * length),
            )
        }
        None => (far.max(apart.min(end / 100)).max(1), (0, 0)),
    };
    let far = far.max(close);
    let unit = close as f64 * clock.interval;
    let (mut passages, mut fresh): (Vec<Passage>, Vec<f64>) = (Vec::new(), Vec::new());
    let mut from = 0;
    let mut origin = None;
    let finest = (FINEST * largest).powi(2);
    while from < end {
        let inside = from + far > part.0 && from < part.1;
        let size = if inside { close } else { far };
        let to = (from + size).min(end);
        let count = samples.known(from, to);
        if 2 * count >= to - from
            && let Some(mean) = samples.mean(from, to)
        {
            // From the first mean on: what the clock counts from would only round it.
            let middle = 0.5 * (from + to - 1) as f64;
            let time = (middle - *origin.get_or_insert(middle)) / close as f64;
            let silent = |last: &Passage| (time - last.time) * close as f64 > LONG_GAP * far as f64;
            if passages.last().is_some_and(silent) {
                fresh.push(time);
            }
            passages.push(Passage {
                time,
                value: mean * unit,
                speed: mean * unit,
                spread: 0.0,
                kept: 1.0 / (count as f64).sqrt(),
                left: samples.rounding(from, to).max(finest) * unit * unit,
            });
        }
        from = to;
    }
    let (Some(origin), true) = (origin, passages.len() >= FEWEST) else {
        return Err(Refusal::new(
            "values of a speed with too many missing".into(),
            "a speed that is known at most of its times",
        ));
    };
    let watched = (passages[0].time, passages[passages.len() - 1].time);
    Ok(Data {
        passages,
        origin: clock.time(origin),
        unit,
        watched,
        before: 0.0,
        pitch: largest * unit,
        calibrated: false,
        channel: true,
        fresh,
        unsteady: Vec::new(),
    })
}

/// A rise among the samples as the fit takes it: the instrument shows it late by its time constant.
fn sight(data: &Data, rise: &Rise, clock: &Clock) -> Sight {
    let at =
        |sample: usize, lags: f64| data.units(clock.time(sample as f64 - 0.5) - lags * clock.lag);
    let times = (at(rise.from, 1.0), at(rise.most, 3.0), at(rise.to, 1.0));
    let change = (rise.high - rise.low) * data.unit;
    Sight::new(data, times, rise.rests, change)
}

/// The part of the means that is quiet: behind the change and what settles, or before it where that is longer.
fn quiet_range(data: &Data, sight: Option<&Sight>) -> std::ops::Range<usize> {
    let n = data.passages.len();
    let Some(sight) = sight else {
        return 0..n;
    };
    let settled = sight.lock + 0.5 * (sight.lock - sight.engage);
    let behind = data.passages.partition_point(|p| p.time <= settled)..n;
    if behind.len() >= FEWEST || behind.len() >= sight.first {
        return behind;
    }
    0..sight.first
}

/// Noise of one sample and density of a quiet part by their likelihood; the noise as stated where it is.
fn quieted(
    data: &Data,
    range: std::ops::Range<usize>,
    memory: Memory,
    usual: f64,
    stated: bool,
) -> (Noise, f64) {
    let noise = |x: f64| Noise {
        timing: 1.0,
        angle: usual * x.exp(),
        memory,
    };
    let speed = data.pitch;
    // What is stated is not fitted.
    let width = if stated { 1e-3 } else { 1.5 };
    if range.len() < FEWEST {
        return (noise(0.0), fit::usual_density(speed));
    }
    let parts = fit::stretches(range);
    let cost = |x: &[f64; 2]| {
        let plan = Plan::steady(noise(x[0]), x[1].exp());
        let fit = plan.likelihood_in(data, &parts);
        let belief = (x[0] / width).powi(2) + fit::unusual(x[1], speed);
        0.5 * belief - fit
    };
    let start = [0.0, fit::usual_density(speed).ln()];
    let (best, _) = simplex::lowest(start, [0.5 * width.min(1.0), 4.0], 0.05, 120, cost);
    (noise(best[0]), best[1].exp())
}

/// How much more slow noise there is in a quiet part than its white one would have, as a variance; 1 where it is white.
fn lasting(data: &Data, range: std::ops::Range<usize>, noise: Noise, density: f64) -> f64 {
    let plan = Plan::steady(noise, density);
    let most = 2000.min(range.len());
    let (nodes, start) = plan.nodes(data, range.end - most..range.end);
    let filter = filtered(&nodes, &start, Vector::zeros(), &noise.memory, true, |_| ());
    let innovations = filter.innovations();
    let settled = 8.min(innovations.len());
    colour(&innovations[settled..])
}
