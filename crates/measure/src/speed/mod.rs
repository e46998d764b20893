//! Angle, speed and acceleration of a shaft from the pulses of its wheel, or from a speed that an instrument shows.
//!
//! ```text
//! pulses ─▶ quiet parts: noise and density of the snap by likelihood ─▶ knots: engagement and end, by likelihood
//!        ─▶ filter and smoother, averaged over what the likelihood leaves open ─▶ state and covariance at any instant
//! ```
//! The motion is a cubic of time whose snap is white noise: a spline of the seventh degree through the pulses, as stiff as
//! the pulses themselves ask for. A quick change of speed (a clutch that engages) has its own density of the snap between two knots,
//! at which acceleration and jerk may jump. From rest the speed is zero until the engagement, the angle is anywhere
//! between two marks, and what jumps first drives the shaft forward. How softly a clutch began before its first marks is
//! open: starts without a jump, with one of the jerk and with one of the acceleration are all carried along, and the
//! engagement has the band that they leave. The deviations within the change follow how smooth it turns out to be, and a
//! shaft that stops after its last mark comes to rest.
//!
//! **What it does not model**: a shaft that turns back; a speed ripple quicker than two marks can show; noise of the instants with a memory longer
//! than a few pulses; more than one quick change in a record (give the window of the one that is wanted).

mod breakaway;
mod bridge;
mod channel;
mod design;
mod fit;
mod fitted;

mod motion;
mod node;
mod plan;
mod settings;
mod smoothed;
mod smoothness;
mod spread;
mod stop;
mod too_few;
mod track;
mod transient;
mod transition;

use crate::pulse::{Pitch, Pulses, Refusal};
use breakaway::Breakaway;
use bridge::Bridge;
pub use channel::{Channel, Instrument, Shown, smooth_channel};
pub use design::marks_needed;
use fitted::{QUIET_BEFORE, fitted};
pub use motion::{Change, Motion};
use plan::Data;
use problem::{note, note::Note};
pub use settings::{SpeedSettings, Transient};
pub use smoothed::Speed;
use stop::Stop;
use too_few::{carried, enough, needed, seen, stated};

/// Part of the pulses that are in step with the sampling from which on it is reported.
const IN_STEP: f64 = 0.4;

/// Fewest pulses that are smoothed at all.
const FEWEST: usize = 6;

/// Smooths pulses to angle, speed and acceleration.
///
/// `pitch` are the errors of the wheel, where they are known. Refused: fewer than six pulses, a quick change with fewer than
/// eight, one whose acceleration is less certain than [`SpeedSettings::wanted`].
///
/// Four hundred made-up spin-ups a case, from models other than this one (`tests/speed_coverage.rs`), to 150 rad/s: bands of
/// two standard deviations hold the truth in 93 to 97.7 % of all instants; medians of the error of the peak acceleration and
/// of the root mean square error, as parts of the peak:
///
/// | spin-up | marks | peak | rms |
/// |---|---|---|---|
/// | 25 ms, 11 500 rad/s², smooth | 60, sampled at 10 kHz, rising flanks | 0.5 % | 1.4 % |
/// | | 60, both flanks | 0.4 % | 1.1 % |
/// | | 360, stamped | 0.2 % | 0.5 % |
/// | 40 ms, 7200 rad/s², smooth | 60, sampled | 0.4 % | 1.0 % |
/// | 223 ms, 1300 rad/s², smooth | 12, sampled | 0.2 % | 0.8 % |
/// | | 60, sampled | 0.1 % | 0.4 % |
///
/// Torques with a jump at the lock (`tests/soft_clutch.rs`, a hundred a case; 12, 60 and 360 stamped marks, 26 to 228 ms); the engagement as
/// a part of the slip:
///
/// | torque | speed and acceleration inside | engagement inside | engagement off (median) | peak |
/// |---|---|---|---|---|
/// | rises evenly | 98 to 99 % | 100 % | below 0.1 % | 0.1 to 0.2 % |
/// | the same on a turning shaft | 97 to 99 % | 100 % | 0.1 to 0.4 % | 0.2 to 0.3 % |
/// | even | 98 to 100 % | 100 % | 0 to 0.1 % | 0.0 to 0.5 % |
/// | breaks away, then rises | 92 to 100 % | 100 % | 0 to 14 % | 0.1 to 0.7 % |
/// | begins with the square of time | 92 to 99 % | 67 to 100 % | 5 to 13 % | 0.7 to 3.2 % |
/// | is doubled halfway | 89 to 98 % | 100 % | 8 to 14 % | 3.5 to 4.3 % |
pub fn smooth(
    pulses: &Pulses,
    pitch: Option<&Pitch>,
    settings: &SpeedSettings,
) -> Result<Speed, Refusal> {
    let all = pulses.times.len();
    if all < FEWEST || pulses.marks.len() != all || pulses.uncertainties.len() != all {
        return Err(Refusal::new(
            format!("{all} pulses"),
            format!("at least {FEWEST} pulses"),
        ));
    }
    let forward = pulses
        .times
        .windows(2)
        .all(|pair| pair[1] > pair[0] && pair[1].is_finite());
    if pulses.positions == 0 || !forward || !pulses.times[0].is_finite() {
        return Err(Refusal::new(
            "pulses that were not numbered".into(),
            "pulses as `number` gives them",
        ));
    }
    let thinned = pulses.out_of_step();
    let (pulses, shared) = match &thinned {
        Some((left, shared)) => (left, shared.as_slice()),
        None => (pulses, [].as_slice()),
    };
    let n = pulses.times.len();
    let mut data = Data::new(pulses, pitch);
    data.share(shared);
    let sight = fit::sight(&data, &settings.transient);
    if let Some(sight) = &sight {
        seen(pulses, &data, sight)?;
        enough(&data, sight, settings)?;
    }
    let mut notes = pulses.notes.clone();
    if (all - n) as f64 > IN_STEP * all as f64 {
        notes.push(note!(
            "{} of {} pulses are left out: a mark takes a whole number of samples there, so that their errors are one error; another sampling rate, or another number of marks, would show more",
            all - n, all
        ));
    }
    let quiet_from = sight.map_or(0, |s| s.after.min(n));
    let (noise, density) = if n - quiet_from >= 12 {
        fit::quiet(&data, (quiet_from + (n - quiet_from) / 20).min(n)..n)
    } else {
        notes.push(note!(
            "fewer than 12 pulses at steady speed: the noise of the pulses is assumed"
        ));
        fit::quiet(&data, n.saturating_sub(12)..n)
    };
    let mut speed = fitted(&mut data, sight.as_ref(), (noise, density), notes)?;
    speed.latency = settings.latency.max(0.0);
    speed.eccentricity = pitch.map_or(0.0, |p| {
        settings.ripple.max(0.0) / (p.speed * p.speed).max(1e-12)
    });
    speed.bridges = Bridge::all(pulses, |time| speed.at(time));
    speed.stop = Stop::of(pulses, |time| speed.at(time));
    if let (Some(change), Some(stop)) = (speed.change.filter(|c| c.from_rest), &speed.stop) {
        speed.breakaway = Breakaway::of(pulses, &change, stop, |time| speed.at(time));
    }
    if speed.stop.is_none() {
        speed.notes.extend(fell_silent(pulses, &speed));
    }
    if let (Some(change), Some(breakaway)) = (&mut speed.change, &speed.breakaway) {
        change.engagement.1 = change.engagement.1.hypot(breakaway.deviation);
    }
    let open = speed.change.map(|change| since_rest(&speed, &change));
    if let (Some(change), Some(sight), Some(open)) = (&mut speed.change, &sight, open)
        && !change.from_rest
        && sight.first < QUIET_BEFORE
    {
        change.engagement.1 = change.engagement.1.hypot(open);
        speed.notes.push(note!(
            "the speed changes quickly from mark {} of the record on: the change may have begun before, and when it began is unknown; needed: a record that begins at rest, or some turns earlier",
            sight.first + 1
        ));
    }
    if let Some(change) = speed.change {
        let (from, to) = (
            change.engagement.0,
            change.end.map_or(speed.range().1, |end| end.0),
        );
        carried(&speed, &change, (from, to), pulses, settings)?;
        let Some(wanted) = settings.wanted else {
            return Ok(speed);
        };
        let got = speed.relative_uncertainty(from, to);
        // Written so that a value that is not a number is refused.
        if got.is_nan() || got > wanted {
            let timing = stated(pulses) * noise.timing;
            let jump = (speed.at(to).speed - speed.at(from).speed).abs();
            return Err(Refusal::new(
                format!(
                    "the {} pulses of the quick change give its acceleration to {:.1} % of its peak, {:.1} % are wanted",
                    change.pulses,
                    100.0 * got,
                    100.0 * wanted
                ),
                needed(
                    marks_needed(jump, to - from, timing, wanted),
                    pulses,
                    wanted,
                ),
            ));
        }
    }
    Ok(speed)
}

/// Usual intervals without a mark, at the speed of the last ones, after which a pickup is taken for stuck.
const STUCK: f64 = 8.0;

/// Time from rest to the end of a change whose beginning is not in the record, s, were its torque one that rises evenly: the
/// speed goes with the square of time.
fn since_rest(speed: &Speed, change: &Change) -> f64 {
    const MOST: f64 = 0.9;
    let end = change.end.map_or(speed.range().1, |end| end.0);
    let begun = speed.at(change.engagement.0).speed / speed.at(end).speed;
    (end - change.engagement.0) / (1.0 - begun.clamp(0.0, MOST).sqrt())
}

/// Says that marks end at a speed from which a shaft does not stop at once.
fn fell_silent(pulses: &Pulses, speed: &Speed) -> Option<Note> {
    let last = *pulses.times.last()?;
    let rate = speed.at(last).speed / pulses.pitch();
    let silent = pulses.watched.1 - last;
    (silent * rate > STUCK).then(|| {
        note!(
            "no mark came after {:.4} s, for {:.4} s, though the shaft turned at {:.1} rad/s: the pickup is stuck, its pulses sank into the noise, or the shaft stopped at once; what is given behind does not follow from the pulses",
            last, silent, rate * pulses.pitch()
        )
    })
}
