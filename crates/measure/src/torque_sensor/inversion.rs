//! From the reading of a swinging sensor to the torque: smoothing of an unknown input.
//!
//! States: reading y, its rate over ω, torque T, its rate, the two amplitudes c and s of the order-1 disturbance, the zero of
//! the reading. The torque is an integrated random walk whose intensity is high just after the engagement and decays to a
//! lower one; at the engagement torque and rate may jump. Before it the shaft rests and the torque is zero by definition. Where
//! the lock is known they may jump there too, and the intensity stays high until then.
//! Intensities, their decay and the noise are those of the highest likelihood with wide priors.
//!
//! A reading at the limit of its converter ([`Clipped`]) says only that the true one is at least there. What lies beyond is not
//! guessed, and no torque is told there. Beside it the torque is computed once more with readings beyond the limit by twice what
//! slopes and duration let expect: the band widens by what that changes; where that is more than two deviations no torque is told.
//!
//! Source: physics of the sensor as in the module; unknown-input smoothing as by Lourens et al., Mech. Syst. Signal Process. 29
//! (2012) 446 (from memory).

use super::chain::{COSINE, Chain, Knots, Pass, RATE, SINE, Samples, TORQUE, ZERO};
use super::{Sensor, Swing};
use crate::shaft::Shaft;
use crate::state_space::{colour, correlation};
use crate::uncertain::Uncertain;

/// What is known of a torque measurement.
#[derive(Clone, Copy, Debug)]
pub struct Inversion<'a> {
    /// The sensor.
    pub sensor: Sensor,
    /// Time of the first value, s.
    pub first: f64,
    /// Interval between values, s.
    pub interval: f64,
    /// Reading in any unit of torque; NaN where there is none.
    pub reading: &'a [f64],
    /// Readings at the limit of their converter; they are not used as they are.
    pub clipped: &'a [Clipped],
    /// The shaft over all the time of the reading; none where there is no synchronous disturbance to remove.
    pub shaft: Option<Shaft<'a>>,
    /// Time at which the clutch engages, with its standard deviation, s; before it the shaft rests. None: it turns throughout. An
    /// engagement that may lie before the record, within two deviations, is not used: no rest tells a zero then.
    pub engagement: Option<Uncertain>,
    /// Time at which the clutch locks, with its standard deviation, s, where it is known and not before the engagement: what
    /// the acceleration makes of the torque ends there at once. None: the torque calms down from the engagement on.
    pub lock: Option<Uncertain>,
    /// Zero of the reading, known to this standard deviation, in the unit of the reading; it is estimated where the shaft rests.
    pub zero: Uncertain,
    /// Wander of that zero, unit of the reading per √s; 0 where it does not wander.
    pub zero_wander: f64,
    /// Relative deviation of the sensor's calibration, linearity included, 1.
    pub scale_deviation: f64,
    /// Power of the speed with which the disturbance grows: 2 for unbalance, 0 for a run-out; none to let the data choose.
    pub disturbance_power: Option<f64>,
}

/// Readings that stand at the limit of what their converter can show: the true ones are there or beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clipped {
    /// Index of the first of them.
    pub first: usize,
    /// Their number.
    pub count: usize,
    /// The limit, in the unit of the reading.
    pub limit: f64,
    /// Whether it is the upper limit.
    pub above: bool,
}

impl Inversion<'_> {
    /// Whether the shaft surely rests at the start of the record: its engagement lies two deviations behind it.
    pub fn rests_at_first(&self) -> bool {
        self.engagement
            .is_some_and(|engagement| engagement.value - 2.0 * engagement.deviation > self.first)
    }
}

/// Torque as the data tell it. All lists have the same length; NaN, with its deviation, is what clipped readings do not tell.
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
    /// Power of the speed with which the disturbance grows, as given or chosen.
    pub disturbance_power: f64,
    /// Zero of the reading.
    pub zero: Uncertain,
    /// Noise of one reading, or of the mean of a block, rms.
    pub noise: f64,
    /// Time constant with which the torque calms down after the engagement, s.
    pub calming: f64,
    /// Logarithm of the likelihood of the reading.
    pub log_likelihood: f64,
    /// What is not trustworthy.
    pub notes: Vec<String>,
}

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
        notes.push("the engagement lies outside the record and is not used".into());
    }
    let knot = engagement.map(|e| e.value);
    let lock =
        (input.lock).filter(|lock| knot.is_some_and(|knot| lock.value > knot) && inside(lock));
    let knots = Knots {
        engagement: knot,
        lock: lock.map(|lock| lock.value),
    };
    // Hyper-parameters from the part of the record that tells most of them.
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
    let free = input.disturbance_power.is_none() && input.shaft.is_some() && engagement.is_some();
    let mut power = input.disturbance_power.unwrap_or(2.0);
    let built = |power| Chain::new(near, swing, knots, power, spread);
    let mut part = built(power);
    let mut hyper = part.most_likely(part.guess(), 200);
    let mut rivals = Vec::new();
    if free {
        rivals = [2.0, 1.0, 0.0]
            .map(|power| (power, built(power)))
            .into_iter()
            .map(|(p, c)| (p, c.cost(&hyper), c))
            .collect();
        rivals.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (best, _, likely) = rivals.remove(0);
        if best != power {
            (power, part) = (best, likely);
            hyper = part.most_likely(hyper, 80);
        }
    }
    let lowest = part.cost(&hyper);
    let chain = Chain::new(samples, swing, knots, power, spread);
    let base = chain.smoothed(&hyper);
    let mut variance: Vec<f64> = base.states.iter().map(|s| s.1[TORQUE]).collect();
    let colour = colour(&base.innovations);
    for v in &mut variance {
        *v *= colour;
    }
    let mut widen = |other: &Pass, weight: f64| {
        for ((sum, a), b) in variance.iter_mut().zip(&base.states).zip(&other.states) {
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
    // Other growths of the disturbance, by their likelihood.
    for (other, cost, _) in &rivals {
        let weight = 1.0 / (1.0 + (cost - lowest).clamp(-20.0, 20.0).exp());
        if weight > 0.01 {
            widen(
                &Chain::new(samples, swing, knots, *other, spread).smoothed(&hyper),
                weight,
            );
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
    tell(input, &base, colour, engagement.is_some(), &mut notes);
    for (v, state) in variance.iter_mut().zip(&base.states) {
        *v = v.max(state.1[TORQUE]);
    }
    let pick = |index: usize| base.states.iter().map(|s| s.0[index]).collect::<Vec<_>>();
    let mut deviation: Vec<f64> = variance.iter().map(|v| v.max(0.0).sqrt()).collect();
    let mut told = pick(TORQUE);
    let mut told_rate = pick(RATE);
    let growth = |k: usize| chain.growth(k, power);
    let amplitude = |k: usize| base.states[k].0[COSINE].hypot(base.states[k].0[SINE]);
    let spread_of = |index: usize| {
        base.states
            .iter()
            .map(|s| (colour * s.1[index]).max(0.0).sqrt())
            .collect::<Vec<_>>()
    };
    let mut disturbance: Vec<f64> = (0..base.states.len())
        .map(|k| growth(k) * amplitude(k))
        .collect();
    let mut disturbance_deviation: Vec<f64> = (0..base.states.len())
        .map(|k| {
            let variances = &base.states[k].1;
            let mean = 0.5 * colour * (variances[COSINE] + variances[SINE]);
            growth(k) * mean.max(0.0).sqrt()
        })
        .collect();
    let mut zero = base.states.first().map_or(input.zero, |s| {
        Uncertain::new(s.0[ZERO], (colour * s.1[ZERO]).max(0.0).sqrt())
    });
    let mut rate_deviation = spread_of(RATE);
    if let Some(reading) = thin.beyond_limits(&base, noise) {
        let samples = Samples {
            reading: &reading,
            ..samples
        };
        let other = Chain::new(samples, swing, knots, power, spread).smoothed(&hyper);
        let moved = |k: usize, index: usize| other.states[k].0[index] - base.states[k].0[index];
        let lost = f64::NAN;
        for k in 0..told.len() {
            let by = moved(k, TORQUE).abs();
            // a torque that is zero by definition stays so
            let rests = deviation[k] == 0.0;
            if !rests && (thin.limits[k].is_some() || by > UNTOLD * deviation[k]) {
                (told[k], deviation[k]) = (lost, lost);
                (told_rate[k], rate_deviation[k]) = (lost, lost);
            } else if !rests {
                deviation[k] = deviation[k].hypot(by);
                rate_deviation[k] = rate_deviation[k].hypot(moved(k, RATE));
            }
            let by = growth(k) * moved(k, COSINE).hypot(moved(k, SINE));
            if by > UNTOLD * disturbance_deviation[k] {
                (disturbance[k], disturbance_deviation[k]) = (lost, lost);
            } else {
                disturbance_deviation[k] = disturbance_deviation[k].hypot(by);
            }
        }
        let by = if told.is_empty() { 0.0 } else { moved(0, ZERO) };
        zero.deviation = zero.deviation.hypot(by);
        let count = told.iter().filter(|value| value.is_nan()).count();
        if count > 0 {
            notes.push(format!(
                "the torque is not told for {:.3} s of {:.3} s: readings there, or beside, are clipped, and the true ones may lie beyond by any amount",
                count as f64 * samples.interval,
                told.len() as f64 * samples.interval
            ));
        }
    }
    Ok(Torque {
        time: (0..base.states.len())
            .map(|k| samples.first + k as f64 * samples.interval)
            .collect(),
        torque: told,
        deviation,
        rate: told_rate,
        rate_deviation,
        disturbance,
        disturbance_deviation,
        disturbance_power: power,
        zero,
        noise,
        calming: hyper[3].exp(),
        log_likelihood: base.log_likelihood,
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
    let not_negative = |v: f64| v >= 0.0 && v.is_finite();
    if !(not_negative(input.zero_wander) && not_negative(input.scale_deviation)) {
        return Err("wander of the zero and deviation of the scale must not be negative".into());
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

/// The reading in blocks that are short for the sensor and for a spin-up, and the shaft at their middles.
struct Thin {
    first: f64,
    interval: f64,
    reading: Vec<f64>,
    /// The limit at which a block holds a reading, and its side: 1 above, -1 below.
    limits: Vec<Option<(f64, f64)>>,
    angle: Vec<f64>,
    speed: Vec<f64>,
}

/// Longest block, s: a twelfth of a spin-up of 25 ms.
const BLOCK: f64 = 0.002;

/// Blocks in a period of the sensor: means of blocks this short lose 0.4 % of a swing at its frequency.
const IN_A_PERIOD: f64 = 20.0;

/// Most blocks that are inverted at once.
const MOST: usize = 100_000;

impl Thin {
    fn new(input: &Inversion) -> Result<Self, String> {
        let longest = BLOCK.min(1.0 / (IN_A_PERIOD * input.sensor.frequency.value));
        let block = ((longest / input.interval + 1e-6) as usize).max(1);
        let count = input.reading.len() / block;
        if count > MOST {
            return Err(format!(
                "the torque reading is too long to be inverted at once: {count} blocks, at most {MOST}"
            ));
        }
        if count < 16 {
            return Err(format!(
                "the torque reading lasts for {count} blocks; at least 16 are needed"
            ));
        }
        let interval = block as f64 * input.interval;
        let first = input.first + 0.5 * (block - 1) as f64 * input.interval;
        let mut reading: Vec<f64> = input
            .reading
            .chunks_exact(block)
            .map(|part| part.iter().sum::<f64>() / block as f64)
            .collect();
        let mut limits = vec![None; count];
        for part in input.clipped.iter().filter(|part| part.count > 0) {
            let blocks = part.first / block..=(part.first + part.count - 1) / block;
            for k in blocks.take_while(|k| *k < count) {
                reading[k] = f64::NAN;
                limits[k] = Some((part.limit, if part.above { 1.0 } else { -1.0 }));
            }
        }
        let times = (0..count).map(|k| first + k as f64 * interval);
        let (angle, speed) = match &input.shaft {
            Some(shaft) => times
                .map(|t| (shaft.angle_at(t), shaft.speed_at(t)))
                .unzip(),
            None => (Vec::new(), Vec::new()),
        };
        Ok(Self {
            first,
            interval,
            reading,
            limits,
            angle,
            speed,
        })
    }

    /// The reading with what may lie beyond its limits; none where nothing is clipped.
    ///
    /// The true reading enters a stretch with a slope and leaves it with one: a parabola rises by a quarter of slope times
    /// duration between them. Twice that, and three deviations of the noise, lie beyond the limit here; the whole span of the
    /// record where that is less, or no slope is known.
    fn beyond_limits(&self, expected: &Pass, noise: f64) -> Option<Vec<f64>> {
        let known = self.reading.iter().filter(|v| v.is_finite());
        let (low, high) = known.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| {
            (l.min(v), h.max(v))
        });
        let mut moved = self.reading.clone();
        let mut next = 0;
        while let Some(first) = (next..moved.len()).find(|k| self.limits[*k].is_some()) {
            let end = (first..moved.len())
                .find(|k| self.limits[*k].is_none())
                .unwrap_or(moved.len());
            let step = |one: Option<usize>, other: Option<usize>| {
                let at = |k: Option<usize>| self.reading.get(k?).copied();
                (at(one)? - at(other)?).abs().into()
            };
            let slopes: [Option<f64>; 2] = [
                step(first.checked_sub(1), first.checked_sub(2)),
                step(Some(end), Some(end + 1)),
            ];
            let steepest = (slopes.iter().flatten().copied()).filter(|slope| slope.is_finite());
            let excess = (steepest.reduce(f64::max))
                .map_or(f64::INFINITY, |slope| 0.5 * slope * (end - first) as f64);
            let excess = (excess + 3.0 * noise).min(high - low);
            let stretch =
                (self.limits[first..end].iter().flatten()).zip(&expected.states[first..end]);
            for (value, (&(limit, side), (state, _))) in moved[first..end].iter_mut().zip(stretch) {
                let bridge = state[0] + state[ZERO];
                *value = side * (side * limit).max(side * bridge) + side * excess;
            }
            next = end;
        }
        (next > 0).then_some(moved)
    }

    fn samples<'a>(&'a self, input: &Inversion) -> Samples<'a> {
        Samples {
            first: self.first,
            interval: self.interval,
            reading: &self.reading,
            angle: &self.angle,
            speed: &self.speed,
            fastest: self.speed.iter().fold(0.0, |top, v| top.max(v.abs())),
            zero: input.zero,
            zero_wander: input.zero_wander,
        }
    }
}

/// Deviations by which what clipped readings hide may move what is told.
const UNTOLD: f64 = 2.0;

/// Standard deviation of the reading; the unit in which the filter works.
fn scale_of(reading: &[f64]) -> f64 {
    let seen = || reading.iter().filter(|v| v.is_finite());
    let count = seen().count() as f64;
    let mean = seen().sum::<f64>() / count;
    (seen().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt()
}

/// Factor on the bands from which on it is told.
const TOLD: f64 = 1.05;

fn tell(input: &Inversion, base: &Pass, colour: f64, rests: bool, notes: &mut Vec<String>) {
    let unknown = |part: &[f64]| part.iter().filter(|v| !v.is_finite()).count();
    let clipped = input.clipped.iter().map(|part| {
        let end = (part.first + part.count).min(input.reading.len());
        unknown(input.reading.get(part.first..end).unwrap_or(&[]))
    });
    let missing = unknown(input.reading) - clipped.sum::<usize>().min(unknown(input.reading));
    if missing > 0 {
        notes.push(format!(
            "{missing} torque readings are missing and were bridged"
        ));
    }
    let count = base.innovations.len() as f64;
    let correlation = correlation(&base.innovations, 1);
    // Three standard deviations of a correlation of white noise; one that leaves the bands as they are tells nothing.
    if correlation.abs() > 3.0 / count.sqrt() && colour.sqrt() >= TOLD {
        notes.push(format!(
            "successive innovations of the torque sensor correlate by {correlation:.2}: noise or sensor differ from their model; bands are wider by {:.2}",
            colour.sqrt()
        ));
    }
    let large = base.innovations.iter().filter(|e| e.abs() > 5.0).count();
    if large > 0 {
        notes.push(format!(
            "{large} torque readings lie more than 5 deviations from what the model expects"
        ));
    }
    if input.shaft.is_none() {
        notes.push(
            "no shaft angle was given: the synchronous disturbance is inside the torque".into(),
        );
    }
    if !rests {
        notes.push("no rest before the test: the zero of the reading is as given, and a jump of the torque is smeared".into());
    }
}
