//! From the reading of a swinging sensor to the torque: smoothing of an unknown input.
//!
//! States: reading y, its rate over ω, torque T, its rate, the two amplitudes c and s of the order-1 disturbance, the zero of
//! the reading. The torque is an integrated random walk whose intensity is high just after the engagement and decays to a
//! lower one; at the engagement torque and rate may jump. Before it the shaft rests and the torque is zero by definition. Where
//! the lock is known they may jump there too, and the intensity stays high until then.
//! Where the shaft comes to rest or leaves it slowly, below a fiftieth of the highest speed, the intensity is high again.
//! Intensities, their decay and the noise are those of the highest likelihood with wide priors.
//!
//! A disturbance that does not depend on speed, a run-out, is there at rest too, with the sensor settled under it: zero and
//! c cos θ₀ + s sin θ₀ are one sum there, which the turning shaft takes apart. How a disturbance grows with speed is judged by the
//! likelihood of the whole record. What it leaves open is in mean and band: those of all growths, weighed by their likelihood.
//!
//! A reading at the limit of its converter ([`Clipped`]) says only that the true one is at least there. What lies beyond is not
//! guessed, and no torque is given there. Beside it the torque is computed once more with readings beyond the limit by twice what
//! slopes and duration let expect: the band widens by what that changes; beyond two deviations no torque is given.
//!
//! Source: physics of the sensor as in the module; unknown-input smoothing as by Lourens et al., Mech. Syst. Signal Process. 29
//! (2012) 446 (from memory).

use super::Swing;
use super::blocks::Thin;
use super::chain::{COSINE, Chain, Knots, Pass, RATE, SINE, Samples, TORQUE, ZERO, mixed};
use super::input::Inversion;
use super::shown;
use crate::state_space::{colour, correlation};
use problem::{note, note::Note};
use statistics::normal::below;
use statistics::uncertain::Uncertain;

/// Torque found from the data. All lists have the same length; NaN, with its deviation, is what clipped readings hide.
#[derive(Clone, Debug)]
pub struct Torque {
    /// Times, s: those of the reading, or of the middle of blocks of it where it is finer than the sensor needs.
    pub time: Vec<f64>,
    /// Torque, in the unit of the reading.
    pub torque: Vec<f64>,
    /// Standard deviation of the torque.
    pub deviation: Vec<f64>,
    /// Rate of the torque, unit of the reading per second.
    pub rate: Vec<f64>,
    /// Standard deviation of the rate.
    pub rate_deviation: Vec<f64>,
    /// Amplitude of the order-1 disturbance as the sensor feels it, before its own gain.
    pub disturbance: Vec<f64>,
    /// Standard deviation of that amplitude.
    pub disturbance_deviation: Vec<f64>,
    /// Power of the speed with which the disturbance grows, as given or the most likely one.
    pub disturbance_power: f64,
    /// Zero of the reading.
    pub zero: Uncertain,
    /// Noise of one reading, or of the mean of a block, rms.
    pub noise: f64,
    /// Frequency at which the reading rings after the engagement, Hz, where it is surely not that of the sensor as stated.
    pub shown_frequency: Option<f64>,
    /// What is not trustworthy.
    pub notes: Vec<Note>,
}

impl Torque {
    /// Widens the band by what swings in the torque: for a reading whose disturbance once a turn could not be taken out, because
    /// the speed of the shaft is not known.
    ///
    /// What is added is the rms of the torque about its mean over half a second around each time, a turn at 13 rad/s. A torque
    /// that itself changes within that time is known less well than it could be.
    pub fn hold_what_swings(&mut self) {
        let [first, second, ..] = self.time.as_slice() else {
            return;
        };
        let half = (0.5 * ROUND / (second - first)) as usize;
        // Sums up to each value, about one of them so that rounding does no harm.
        let seen = || self.torque.iter().copied().filter(|t| t.is_finite());
        let about = seen().next().unwrap_or(0.0);
        let mut sums = vec![(0.0_f64, 0.0_f64, 0.0_f64)];
        for torque in &self.torque {
            let (count, sum, squares) = sums[sums.len() - 1];
            let away = torque - about;
            sums.push(if away.is_finite() {
                (count + 1.0, sum + away, squares + away * away)
            } else {
                (count, sum, squares)
            });
        }
        for (k, deviation) in self.deviation.iter_mut().enumerate() {
            let from = sums[k.saturating_sub(half)];
            let to = sums[(k + half + 1).min(sums.len() - 1)];
            let count = (to.0 - from.0).max(1.0);
            let mean = (to.1 - from.1) / count;
            let square = (to.2 - from.2) / count - mean * mean;
            *deviation = deviation.hypot(square.max(0.0).sqrt());
        }
    }
}

/// Time over which what swings is judged, s.
const ROUND: f64 = 0.5;

/// Powers of the speed with which a disturbance may grow, an unbalance, a run-out and what lies between, each with its odds
/// before the data speak: a third for the run-out, which alone is there at rest, and two thirds for what grows.
const POWERS: [(f64, f64); 5] = [(2.0, 1.0), (1.5, 1.0), (1.0, 1.0), (0.5, 1.0), (0.0, 2.0)];

/// Times that another power may be found likelier, each with intensities of its own.
const ROUNDS: usize = 3;

/// Probability of a power below which it is left out: so little weight would widen a band that still does not reach it.
const NEGLIGIBLE: f64 = 0.08;

/// Deviations of the engagement before it up to which it counts.
const FARTHEST: f64 = 4.0;

/// Deviation of the lock, as a part of the interval, below which it changes nothing.
const NOTABLE: f64 = 0.05;

/// Finds the torque that a sensor felt, its order-1 disturbance and its zero, with standard deviations.
///
/// The error names what is wrong with the input. The band contains the uncertainty of frequency, damping and engagement time
/// (first order) beside that of noise and unknown torque, but not that of a wrong model of the sensor.
pub fn invert(input: &Inversion) -> Result<Torque, String> {
    refuse(input)?;
    let mut notes = Vec::new();
    let thin = Thin::new(input)?;
    let samples = thin.samples(input);
    let spread = scale_of(&thin.reading);
    if !(spread > 0.0 && spread.is_finite()) {
        return Err("the torque reading does not change, or is too large to square".into());
    }
    let swing = input.sensor.swing();
    let end = samples.first + (samples.reading.len() - 1) as f64 * samples.interval;
    let inside = |e: &Uncertain| e.value > samples.first && e.value < end;
    let engagement = input
        .engagement
        .filter(|e| inside(e) && input.rests_at_first());
    if input.engagement.is_some_and(|given| !inside(&given)) {
        notes.push(note!(
            "the engagement lies outside the record and is not used"
        ));
    }
    let knot = engagement.map(|e| e.value);
    let lock =
        (input.lock).filter(|lock| knot.is_some_and(|knot| lock.value > knot) && inside(lock));
    let knots = Knots {
        engagement: knot,
        lock: lock.map(|lock| lock.value),
    };
    // Hyper-parameters from the part of the record that shows most of them.
    let (from, to) = match knot {
        Some(knot) => {
            let place = |time: f64| ((time - samples.first) / samples.interval).max(0.0) as usize;
            let count = samples.reading.len();
            let from = place(knot - 0.5).min(count - 16);
            (from, place(knot + 1.0).clamp(from + 16, count))
        }
        None => (0, samples.reading.len().min(2000)),
    };
    let near = samples.part(from, to);
    let free = input.disturbance_power.is_none() && input.shaft.is_some();
    let mut power = input.disturbance_power.unwrap_or(2.0);
    let built = |power| Chain::new(near, swing, knots, power, spread);
    let whole = |power| Chain::new(samples, swing, knots, power, spread);
    let mut part = built(power);
    let mut hyper = part.most_likely(part.guess(), 200);
    // Growths of the disturbance and what the whole record costs with each, the most likely first.
    let mut growths = vec![(power, 0.0)];
    for _ in 0..if free { ROUNDS } else { 0 } {
        growths = (POWERS.iter())
            .map(|&(power, odds)| (power, whole(power).cost(&hyper) - odds.ln()))
            .collect();
        growths.sort_by(|a, b| a.1.total_cmp(&b.1));
        if growths[0].0 == power {
            break;
        }
        power = growths[0].0;
        part = built(power);
        hyper = part.most_likely(hyper, 80);
    }
    let lowest = part.cost(&hyper);
    let chain = whole(power);
    let likely = chain.smoothed(&hyper);
    let colour = colour(&likely.innovations);
    let stated = &input.sensor.frequency;
    let of = |swing| Chain::new(near, swing, knots, power, spread);
    let shown_frequency = knot.and_then(|_| {
        let stated = (swing, stated.deviation / stated.value);
        shown::frequency(of, stated, &hyper, colour, samples.interval)
    });
    let likelihood = |cost: f64| (-(cost - growths[0].1) / colour).exp();
    let sum: f64 = growths.iter().map(|g| likelihood(g.1)).sum();
    let others: Vec<(f64, Pass)> = (growths.iter().skip(1))
        .map(|&(power, cost)| (likelihood(cost) / sum, power))
        .filter(|(weight, _)| *weight > NEGLIGIBLE)
        .map(|(weight, power)| (weight, whole(power).smoothed(&hyper)))
        .collect();
    if !others.is_empty() && growths[..=others.len()].iter().any(|g| g.0 == 0.0) {
        notes.push(
            note!(
                "the record does not show whether the disturbance once a turn grows with speed or is there at rest too: mean and band hold both"
            ));
    }
    let base = mixed(&likely, &others);
    let mut variance: Vec<f64> = base.states.iter().map(|s| colour * s.1[TORQUE]).collect();
    let mut widen = |other: &Pass, weight: f64| {
        for ((sum, a), b) in variance.iter_mut().zip(&likely.states).zip(&other.states) {
            *sum += weight * ((b.0[TORQUE] - a.0[TORQUE]).powi(2) + b.1[TORQUE] - a.1[TORQUE]);
        }
    };
    // Hyper-parameters within one deviation of their posterior, each by itself.
    for axis in 0..hyper.len() {
        let probe = 0.5;
        let moved = |by: f64| {
            let mut other = hyper;
            other[axis] += by;
            other
        };
        let curvature =
            (part.cost(&moved(probe)) + part.cost(&moved(-probe)) - 2.0 * lowest) / (probe * probe);
        let deviation = (1.0 / curvature.max(1.0)).sqrt();
        for by in [deviation, -deviation] {
            widen(&chain.smoothed(&moved(by)), 0.5);
        }
    }
    // What is known of sensor and engagement only to a deviation: the torque with it changed by one deviation.
    let wider = |u: Uncertain| u.deviation > 0.0;
    let mut shifted = Vec::new();
    if wider(input.sensor.frequency) {
        let ratio = 1.0 + input.sensor.frequency.deviation / input.sensor.frequency.value;
        shifted.push((
            Swing {
                omega: swing.omega * ratio,
                ..swing
            },
            knots,
            1.0,
        ));
    }
    if wider(input.sensor.damping_ratio) {
        let zeta = swing.zeta + input.sensor.damping_ratio.deviation;
        shifted.push((Swing { zeta, ..swing }, knots, 1.0));
    }
    if let Some(engagement) = engagement.filter(|e| wider(*e)) {
        for by in [engagement.deviation, -engagement.deviation] {
            let engagement = Some(engagement.value + by);
            let moved = Knots {
                engagement,
                ..knots
            };
            shifted.push((swing, moved, 0.5));
        }
    }
    if let Some(lock) = lock.filter(|lock| lock.deviation > NOTABLE * samples.interval) {
        for by in [lock.deviation, -lock.deviation] {
            let lock = Some(lock.value + by);
            shifted.push((swing, Knots { lock, ..knots }, 0.5));
        }
    }
    for (swing, knots, weight) in shifted {
        widen(
            &Chain::new(samples, swing, knots, power, spread).smoothed(&hyper),
            weight,
        );
    }
    for (v, state) in variance.iter_mut().zip(&base.states) {
        *v += (input.scale_deviation * state.0[TORQUE]).powi(2);
    }
    let noise = hyper[0].exp() * spread;
    if engagement.is_none() {
        notes.push(note!(
            "no rest before the test: a jump of the torque is smeared"
        ));
    }
    doubts(input, &likely, colour, &mut notes);
    for (v, state) in variance.iter_mut().zip(&base.states) {
        *v = v.max(state.1[TORQUE]);
    }
    if let Some(engagement) = engagement.filter(|e| wider(*e)) {
        // It may have engaged before: then the torque is there that follows it.
        let behind = ((engagement.value - samples.first) / samples.interval) as usize + 1;
        let first = &base.states[behind.min(base.states.len() - 1)];
        let square = first.0[TORQUE].powi(2) + first.1[TORQUE];
        for (k, v) in variance.iter_mut().enumerate().take(behind) {
            let early = engagement.value - samples.first - k as f64 * samples.interval;
            if early < FARTHEST * engagement.deviation {
                *v = v.max(below(-early / engagement.deviation) * square);
            }
        }
    }
    let pick = |index: usize| base.states.iter().map(|s| s.0[index]).collect::<Vec<_>>();
    let mut deviation: Vec<f64> = variance.iter().map(|v| v.max(0.0).sqrt()).collect();
    let mut torque = pick(TORQUE);
    let mut rate = pick(RATE);
    let amplitude = |k: usize| base.states[k].0[COSINE].hypot(base.states[k].0[SINE]);
    let spread_of = |index: usize| {
        base.states
            .iter()
            .map(|s| (colour * s.1[index]).max(0.0).sqrt())
            .collect::<Vec<_>>()
    };
    let mut disturbance: Vec<f64> = (0..base.states.len()).map(amplitude).collect();
    let mut disturbance_deviation: Vec<f64> = (0..base.states.len())
        .map(|k| {
            let variances = &base.states[k].1;
            let mean = 0.5 * colour * (variances[COSINE] + variances[SINE]);
            mean.max(0.0).sqrt()
        })
        .collect();
    let mut zero = base.states.first().map_or(input.zero, |s| {
        Uncertain::new(s.0[ZERO], (colour * s.1[ZERO]).max(0.0).sqrt())
    });
    let mut rate_deviation = spread_of(RATE);
    if let Some(reading) = thin.beyond_limits(&likely, noise) {
        let samples = Samples {
            reading: &reading,
            ..samples
        };
        let other = Chain::new(samples, swing, knots, power, spread).smoothed(&hyper);
        let moved = |k: usize, index: usize| other.states[k].0[index] - likely.states[k].0[index];
        let lost = f64::NAN;
        for k in 0..torque.len() {
            let by = moved(k, TORQUE).abs();
            // a torque that is zero by definition stays so
            let rests = deviation[k] == 0.0;
            if !rests && (thin.limits[k].is_some() || by > MOVED * deviation[k]) {
                (torque[k], deviation[k]) = (lost, lost);
                (rate[k], rate_deviation[k]) = (lost, lost);
            } else if !rests {
                deviation[k] = deviation[k].hypot(by);
                rate_deviation[k] = rate_deviation[k].hypot(moved(k, RATE));
            }
            let by = moved(k, COSINE).hypot(moved(k, SINE));
            if by > MOVED * disturbance_deviation[k] {
                (disturbance[k], disturbance_deviation[k]) = (lost, lost);
            } else {
                disturbance_deviation[k] = disturbance_deviation[k].hypot(by);
            }
        }
        let by = if torque.is_empty() {
            0.0
        } else {
            moved(0, ZERO)
        };
        zero.deviation = zero.deviation.hypot(by);
        let count = torque.iter().filter(|value| value.is_nan()).count();
        if count > 0 {
            notes.push(note!(
                "the torque is unknown for {:.3} s of {:.3} s: readings there, or beside, are clipped, and the true ones may lie beyond by any amount",
                count as f64 * samples.interval, torque.len() as f64 * samples.interval
            ));
        }
    }
    Ok(Torque {
        time: (0..base.states.len())
            .map(|k| samples.first + k as f64 * samples.interval)
            .collect(),
        torque,
        deviation,
        rate,
        rate_deviation,
        disturbance,
        disturbance_deviation,
        disturbance_power: power,
        zero,
        noise,
        shown_frequency,
        notes,
    })
}

fn refuse(input: &Inversion) -> Result<(), String> {
    let seen = input.reading.iter().filter(|v| v.is_finite()).count();
    let sensor = &input.sensor;
    if !(sensor.frequency.is_sound() && sensor.frequency.value > 0.0) {
        return Err("the frequency of the torque sensor must be positive and finite".into());
    }
    if !(sensor.damping_ratio.is_sound()
        && sensor.damping_ratio.value >= 0.0
        && sensor.damping_ratio.value <= 10.0)
    {
        return Err("the damping ratio of the torque sensor must be from 0 to 10".into());
    }
    if !(input.interval > 0.0 && input.interval.is_finite() && input.first.is_finite()) {
        return Err("the interval of the torque reading must be positive and finite".into());
    }
    if input.interval * sensor.frequency.value > 0.5 {
        return Err(format!(
            "the torque reading has {:.3} values in a period of its sensor; at least 2 are needed",
            1.0 / (input.interval * sensor.frequency.value)
        ));
    }
    if seen < 16 {
        return Err(format!(
            "the torque reading has {seen} values; at least 16 are needed"
        ));
    }
    if let Some(shaft) = &input.shaft {
        shaft.check()?;
        let end = input.first + (input.reading.len() - 1) as f64 * input.interval;
        // Half an interval more does no harm.
        if input.first < shaft.first - 0.5 * shaft.interval
            || end > shaft.last() + 0.5 * shaft.interval
        {
            return Err(format!(
                "the torque reading runs from {} to {end} s, the shaft from {} to {} s: the shaft must cover the reading",
                input.first,
                shaft.first,
                shaft.last()
            ));
        }
    }
    if !(input.scale_deviation >= 0.0 && input.scale_deviation.is_finite()) {
        return Err("the deviation of the scale must not be negative".into());
    }
    if !input.zero.is_sound() || input.engagement.is_some_and(|e| !e.is_sound()) {
        return Err("zero and engagement need finite values and deviations".into());
    }
    let steady = input.reading.iter().filter(|v| v.is_finite());
    let (low, high) = steady.fold((f64::MAX, f64::MIN), |(l, h), &v| (l.min(v), h.max(v)));
    if high <= low || !(high - low).is_finite() {
        return Err("the torque reading does not change".into());
    }
    Ok(())
}

/// Deviations by which what clipped readings hide may move what is given.
const MOVED: f64 = 2.0;

/// Standard deviation of the reading; the unit in which the filter works.
fn scale_of(reading: &[f64]) -> f64 {
    let seen = || reading.iter().filter(|v| v.is_finite());
    let count = seen().count() as f64;
    let mean = seen().sum::<f64>() / count;
    (seen().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt()
}

/// Factor on the bands from which on it is reported.
const REPORTED: f64 = 1.05;

fn doubts(input: &Inversion, base: &Pass, colour: f64, notes: &mut Vec<Note>) {
    let unknown = |part: &[f64]| part.iter().filter(|v| !v.is_finite()).count();
    let clipped = input.clipped.iter().map(|part| {
        let end = (part.first + part.count).min(input.reading.len());
        unknown(input.reading.get(part.first..end).unwrap_or(&[]))
    });
    let missing = unknown(input.reading) - clipped.sum::<usize>().min(unknown(input.reading));
    if missing > 0 {
        notes.push(note!(
            "{} torque readings are missing and were bridged",
            missing
        ));
    }
    let count = base.innovations.len() as f64;
    let correlation = correlation(&base.innovations, 1);
    // Three standard deviations of a correlation of white noise; one that leaves the bands as they are shows nothing.
    if correlation.abs() > 3.0 / count.sqrt() && colour.sqrt() >= REPORTED {
        notes.push(note!(
            "successive innovations of the torque sensor correlate by {:.2}: noise or sensor differ from their model; bands are wider by {:.2}",
            correlation, colour.sqrt()
        ));
    }
    let large = base.innovations.iter().filter(|e| e.abs() > 5.0).count();
    if large > 0 {
        notes.push(note!(
            "{} torque readings lie more than 5 deviations from what the model expects",
            large
        ));
    }
    if input.shaft.is_none() {
        notes.push(note!(
            "no shaft angle was given: the synchronous disturbance is inside the torque"
        ));
    }
}
