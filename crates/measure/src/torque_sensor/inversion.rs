//! From the reading of a swinging sensor to the torque: smoothing of an unknown input.
//!
//! States: reading y, its rate over ω, torque T, its rate, the two amplitudes c and s of the order-1 disturbance, the zero of
//! the reading. The torque is an integrated random walk whose intensity is high just after the engagement and decays to a
//! lower one; at the engagement torque and rate may jump. Before it the shaft rests and the torque is zero by definition.
//! Intensities, their decay and the noise are those of the highest likelihood with wide priors.
//!
//! Source: physics of the sensor as in the module; unknown-input smoothing as by Lourens et al., Mech. Syst. Signal Process. 29
//! (2012) 446 (from memory).

use super::{Sensor, Swing};
use crate::simplex;
use crate::state_space::{
    Filter, GAUSS, Matrix, Observation, Vector, applied, exponential, gathered_noise, identity,
};
use crate::uncertain::Uncertain;

const STATES: usize = 7;
const TORQUE: usize = 2;
const RATE: usize = 3;
const COSINE: usize = 4;
const SINE: usize = 5;
const ZERO: usize = 6;

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
    /// Shaft angle at the times of the reading, rad; empty where there is no synchronous disturbance to remove.
    pub angle: &'a [f64],
    /// Shaft speed at the times of the reading, rad/s; as long as `angle`.
    pub speed: &'a [f64],
    /// Time at which the clutch engages, with its standard deviation, s; before it the shaft rests. None: it turns throughout.
    pub engagement: Option<Uncertain>,
    /// Zero of the reading, known to this standard deviation, in the unit of the reading; it is estimated where the shaft rests.
    pub zero: Uncertain,
    /// Wander of that zero, unit of the reading per √s; 0 where it does not wander.
    pub zero_wander: f64,
    /// Relative deviation of the sensor's calibration, linearity included, 1.
    pub scale_deviation: f64,
    /// Power of the speed with which the disturbance grows: 2 for unbalance, 0 for a run-out; none to let the data choose.
    pub disturbance_power: Option<f64>,
}

/// Torque as the data tell it. Every list has the length of the reading.
#[derive(Clone, Debug)]
pub struct Torque {
    /// Torque at the times of the reading, in its unit.
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
    /// Noise of one reading, rms.
    pub noise: f64,
    /// Time constant with which the torque calms down after the engagement, s.
    pub calming: f64,
    /// Logarithm of the likelihood of the reading.
    pub log_likelihood: f64,
    /// What is not trustworthy.
    pub notes: Vec<String>,
}

/// Logarithms of noise, slow intensity, fast intensity, calming time.
type Hyper = [f64; 4];

/// Everything that does not depend on the hyper-parameters.
struct Chain<'a> {
    input: &'a Inversion<'a>,
    knot: Option<f64>,
    scale: f64,
    fastest: f64,
    /// One step of the interval without disturbance, and the noise that unit intensity gathers.
    whole: (Matrix<STATES>, Matrix<STATES>),
    /// Response of reading and rate to cos θ and sin θ over the step that ends at sample k.
    forcing: Vec<[f64; 4]>,
    /// The step with the knot inside: until it, from it on, each with gathered noise.
    split: Option<(usize, Matrix<STATES>, Matrix<STATES>, Matrix<STATES>)>,
}

/// Finds the torque that a sensor felt, its order-1 disturbance and its zero, with standard deviations.
///
/// The error names what is wrong with the input. The band contains the uncertainty of frequency, damping and engagement time
/// (first order) beside that of noise and unknown torque, but not that of a wrong model of the sensor.
pub fn invert(input: &Inversion) -> Result<Torque, String> {
    refuse(input)?;
    let spread = scale_of(input.reading);
    let mut notes = Vec::new();
    let swing = input.sensor.swing();
    let knot = input.engagement.map(|e| e.value);
    let built = |power| Chain::new(input, swing, knot, power, spread);
    let free =
        input.disturbance_power.is_none() && !input.angle.is_empty() && input.engagement.is_some();
    let mut power = input.disturbance_power.unwrap_or(2.0);
    let mut chain = built(power);
    let mut hyper = chain.most_likely(chain.guess(), 200);
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
            (power, chain) = (best, likely);
            hyper = chain.most_likely(hyper, 80);
        }
    }
    let base = chain.smoothed(&hyper);
    let lowest = chain.cost(&hyper);
    let mut variance: Vec<f64> = base.states.iter().map(|s| s.1[TORQUE]).collect();
    let colour = base.colour();
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
        let curvature = (chain.cost(&moved(probe)) + chain.cost(&moved(-probe)) - 2.0 * lowest)
            / (probe * probe);
        let deviation = (1.0 / curvature.max(0.25)).sqrt();
        for by in [deviation, -deviation] {
            widen(&chain.smoothed(&moved(by)), 0.5);
        }
    }
    // Other growths of the disturbance, by their likelihood.
    for (_, cost, rival) in &rivals {
        let weight = 1.0 / (1.0 + (cost - lowest).clamp(-20.0, 20.0).exp());
        if weight > 0.01 {
            widen(&rival.smoothed(&hyper), weight);
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
            knot,
            1.0,
        ));
    }
    if wider(input.sensor.damping_ratio) {
        let zeta = swing.zeta + input.sensor.damping_ratio.deviation;
        shifted.push((Swing { zeta, ..swing }, knot, 1.0));
    }
    if let Some(engagement) = input.engagement.filter(|e| wider(*e)) {
        for by in [engagement.deviation, -engagement.deviation] {
            shifted.push((swing, Some(engagement.value + by), 0.5));
        }
    }
    for (swing, knot, weight) in shifted {
        widen(
            &Chain::new(input, swing, knot, power, spread).smoothed(&hyper),
            weight,
        );
    }
    for (v, state) in variance.iter_mut().zip(&base.states) {
        *v += (input.scale_deviation * state.0[TORQUE]).powi(2);
    }
    let noise = hyper[0].exp() * spread;
    tell(input, &base, colour, &mut notes);
    for (v, state) in variance.iter_mut().zip(&base.states) {
        *v = v.max(state.1[TORQUE]);
    }
    let pick = |index: usize| base.states.iter().map(|s| s.0[index]).collect::<Vec<_>>();
    let growth = |k: usize| chain.growth(k, power);
    let amplitude = |k: usize| base.states[k].0[COSINE].hypot(base.states[k].0[SINE]);
    let spread_of = |index: usize| {
        base.states
            .iter()
            .map(|s| (colour * s.1[index]).max(0.0).sqrt())
            .collect::<Vec<_>>()
    };
    Ok(Torque {
        torque: pick(TORQUE),
        deviation: variance.iter().map(|v| v.max(0.0).sqrt()).collect(),
        rate: pick(RATE),
        rate_deviation: spread_of(RATE),
        disturbance: (0..base.states.len())
            .map(|k| growth(k) * amplitude(k))
            .collect(),
        disturbance_deviation: (0..base.states.len())
            .map(|k| {
                let variances = &base.states[k].1;
                growth(k)
                    * (0.5 * colour * (variances[COSINE] + variances[SINE]))
                        .max(0.0)
                        .sqrt()
            })
            .collect(),
        disturbance_power: power,
        zero: base.states.first().map_or(input.zero, |s| {
            Uncertain::new(s.0[ZERO], (colour * s.1[ZERO]).max(0.0).sqrt())
        }),
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
    if !input.angle.is_empty()
        && (input.angle.len() != input.reading.len() || input.speed.len() != input.reading.len())
    {
        return Err(format!(
            "the torque reading has {} values, angle {} and speed {}; they must be at the same times",
            input.reading.len(),
            input.angle.len(),
            input.speed.len()
        ));
    }
    if input
        .angle
        .iter()
        .chain(input.speed)
        .any(|v| !v.is_finite())
    {
        return Err("angle and speed must be known at every time of the torque reading".into());
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
    if !(high > low) || !(high - low).is_finite() {
        return Err("the torque reading does not change".into());
    }
    Ok(())
}

/// Standard deviation of the reading; the unit in which the filter works.
fn scale_of(reading: &[f64]) -> f64 {
    let seen = || reading.iter().filter(|v| v.is_finite());
    let count = seen().count() as f64;
    let mean = seen().sum::<f64>() / count;
    (seen().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt()
}

fn tell(input: &Inversion, base: &Pass, colour: f64, notes: &mut Vec<String>) {
    let missing = input.reading.iter().filter(|v| !v.is_finite()).count();
    if missing > 0 {
        notes.push(format!(
            "{missing} torque readings are missing and were bridged"
        ));
    }
    let count = base.innovations.len() as f64;
    let correlation = base.correlation(1);
    // Three standard deviations of a correlation of white noise.
    if correlation.abs() > 3.0 / count.sqrt() {
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
    if input.angle.is_empty() {
        notes.push(
            "no shaft angle was given: the synchronous disturbance is inside the torque".into(),
        );
    }
    if input.engagement.is_none() {
        notes.push("no rest before the test: the zero of the reading is as given, and a jump of the torque is smeared".into());
    }
}

/// Means and variances of the smoothed states, in the unit of the reading.
struct Pass {
    states: Vec<(Vector<STATES>, Vector<STATES>)>,
    innovations: Vec<f64>,
    log_likelihood: f64,
}

impl Pass {
    /// Correlation of innovations that are `lag` apart.
    fn correlation(&self, lag: usize) -> f64 {
        let pairs = self
            .innovations
            .iter()
            .zip(self.innovations.iter().skip(lag));
        let power: f64 = self.innovations.iter().map(|e| e * e).sum();
        pairs.map(|(a, b)| a * b).sum::<f64>() / power.max(f64::MIN_POSITIVE)
    }

    /// How much more slow noise there is than the model's white one: the innovations' spectrum at nothing, at least 1.
    fn colour(&self) -> f64 {
        let lags = 12;
        let taper = |lag: usize| 1.0 - lag as f64 / (lags + 1) as f64;
        let sum: f64 = (1..=lags)
            .map(|lag| 2.0 * taper(lag) * self.correlation(lag))
            .sum();
        (1.0 + sum).max(1.0)
    }
}

impl<'a> Chain<'a> {
    fn new(input: &'a Inversion, swing: Swing, knot: Option<f64>, power: f64, scale: f64) -> Self {
        let h = input.interval;
        let fastest = input.speed.iter().fold(0.0_f64, |top, v| top.max(v.abs()));
        let mut chain = Self {
            input,
            knot,
            scale,
            fastest,
            whole: stepped(swing, h),
            forcing: Vec::with_capacity(input.reading.len()),
            split: None,
        };
        let nodes = force_response(swing, h);
        for k in 0..input.reading.len() {
            chain.forcing.push(if k == 0 || input.angle.is_empty() {
                [0.0; 4]
            } else {
                chain.forced(k, power, &nodes)
            });
        }
        if let Some(knot) = knot {
            let place = (knot - input.first) / h;
            if place > 0.0 && place < (input.reading.len() - 1) as f64 {
                let before = place.floor();
                let (until, _) = stepped(swing, (place - before) * h);
                let (after, noise) = stepped(swing, (before + 1.0 - place) * h);
                chain.split = Some((before as usize + 1, until, after, noise));
            }
        }
        chain
    }

    fn growth(&self, k: usize, power: f64) -> f64 {
        match self.input.speed.get(k) {
            Some(speed) if self.fastest > 0.0 && power != 0.0 => {
                (speed.abs() / self.fastest).powf(power)
            }
            Some(_) => 1.0,
            None => 0.0,
        }
    }

    /// Integral of the response to cos θ and sin θ over the step that ends at sample k; angle by a cubic through angle and speed.
    fn forced(&self, k: usize, power: f64, nodes: &[(f64, f64, [f64; 2])]) -> [f64; 4] {
        let (angle, speed, h) = (self.input.angle, self.input.speed, self.input.interval);
        let (a0, a1, s0, s1) = (angle[k - 1], angle[k], speed[k - 1] * h, speed[k] * h);
        let mut sum = [0.0; 4];
        for &(u, weight, [to_reading, to_rate]) in nodes {
            let v = 1.0 - u;
            let theta =
                a0 * v * v * (1.0 + 2.0 * u) + a1 * u * u * (3.0 - 2.0 * u) + s0 * u * v * v
                    - s1 * u * u * v;
            let growth = if power == 0.0 || self.fastest <= 0.0 {
                1.0
            } else {
                ((s0 * v + s1 * u) / (h * self.fastest)).abs().powf(power)
            };
            let (sine, cosine) = theta.sin_cos();
            sum[0] += weight * growth * cosine * to_reading;
            sum[1] += weight * growth * cosine * to_rate;
            sum[2] += weight * growth * sine * to_reading;
            sum[3] += weight * growth * sine * to_rate;
        }
        sum
    }

    /// A start for the search, and the centre of the wide priors.
    fn guess(&self) -> Hyper {
        let reading = self.input.reading;
        // Second differences of white noise have 6 times its variance; the median ignores the fast part.
        let mut seconds: Vec<f64> = reading
            .windows(3)
            .map(|w| (w[2] - 2.0 * w[1] + w[0]).abs() / self.scale)
            .filter(|v| v.is_finite())
            .collect();
        seconds.sort_by(f64::total_cmp);
        let middle = seconds.get(seconds.len() / 2).copied().unwrap_or(1.0);
        let noise = (middle / 0.6745 / 6.0_f64.sqrt()).max(1e-6);
        // A change of one spread in 0.5 s in the slow part, in 20 ms in the fast part: T = √(q t³/3).
        let slow = 3.0 / 0.5_f64.powi(3);
        let fast = 3.0 / 0.02_f64.powi(3);
        [noise.ln(), slow.ln(), fast.ln(), 0.03_f64.ln()]
    }

    /// Minus the logarithm of likelihood times prior.
    fn cost(&self, hyper: &Hyper) -> f64 {
        let guess = self.guess();
        // Deviations of the priors in natural logarithms: a factor of 3 in noise, of 50 in intensities, of 2 in the time.
        let widths = [1.1, 4.0, 4.0, 0.7];
        let mut prior = 0.0;
        for ((value, centre), width) in hyper.iter().zip(&guess).zip(&widths) {
            prior += 0.5 * ((value - centre) / width).powi(2);
        }
        prior - self.filtered(hyper, false).log_likelihood()
    }

    fn most_likely(&self, start: Hyper, calls: usize) -> Hyper {
        simplex::lowest(start, [0.3, 1.5, 1.5, 0.4], 0.02, calls, |hyper| {
            self.cost(hyper)
        })
        .0
    }

    fn filtered(&self, hyper: &Hyper, keep: bool) -> Filter<STATES> {
        let input = self.input;
        let [noise, slow, fast, calming] = hyper.map(|v| v.clamp(-40.0, 40.0).exp());
        let rests = self.split.is_some();
        let zero = input.zero.deviation / self.scale;
        // Amplitudes of the disturbance may drift by 3 % of the reading's spread in a second, the zero as told.
        let drift = if input.angle.is_empty() {
            0.0
        } else {
            0.03 * 0.03 * input.interval
        };
        let wander = (input.zero_wander / self.scale).powi(2) * input.interval;
        let with_drift = |gathered: &Matrix<STATES>, intensity: f64| {
            let mut noise = scaled(gathered, intensity);
            noise[COSINE][COSINE] += drift;
            noise[SINE][SINE] += drift;
            noise[ZERO][ZERO] += wander;
            noise
        };
        let mut mean = [0.0; STATES];
        mean[ZERO] = input.zero.value / self.scale;
        let mut prior = [[0.0; STATES]; STATES];
        // Wide: four times the spread of the reading, in amplitude.
        let wide = 16.0;
        prior[ZERO][ZERO] = zero * zero;
        if !input.angle.is_empty() {
            prior[COSINE][COSINE] = wide;
            prior[SINE][SINE] = wide;
        }
        if !rests {
            // Reading and torque agree up to what a swing of the size of the record does.
            prior[TORQUE][TORQUE] = wide;
            prior[RATE][RATE] = wide / 0.05_f64.powi(2);
            prior[0][0] = 2.0 * wide;
            prior[0][TORQUE] = wide;
            prior[TORQUE][0] = wide;
            prior[1][1] = wide;
        }
        let mut filter = Filter::new(mean, prior, keep);
        let mut turning = !rests;
        for (k, &value) in input.reading.iter().enumerate() {
            let time = input.first + k as f64 * input.interval;
            if k > 0 {
                match &self.split {
                    Some((at, until, after, gathered)) if *at == k => {
                        filter.predict(until, &[[0.0; STATES]; STATES]);
                        let mut jump = [[0.0; STATES]; STATES];
                        jump[TORQUE][TORQUE] = wide;
                        jump[RATE][RATE] = wide / 0.05_f64.powi(2);
                        filter.predict(&identity(), &jump);
                        let mut transition = *after;
                        self.put_forcing(k, &mut transition);
                        filter.predict(&transition, &with_drift(gathered, slow + fast));
                        turning = true;
                    }
                    _ => {
                        let mut transition = self.whole.0;
                        self.put_forcing(k, &mut transition);
                        let intensity = match self.knot {
                            Some(knot) if turning => {
                                slow + fast
                                    * (-(time - knot - 0.5 * input.interval).max(0.0) / calming)
                                        .exp()
                            }
                            _ if turning => slow,
                            _ => 0.0,
                        };
                        filter.predict(&transition, &with_drift(&self.whole.1, intensity));
                    }
                }
            }
            let mut row = [0.0; STATES];
            row[0] = 1.0;
            row[ZERO] = 1.0;
            let seen = Observation {
                row,
                value: value / self.scale,
                variance: noise * noise,
            };
            filter.observe(value.is_finite().then_some(&seen));
        }
        filter
    }

    fn put_forcing(&self, k: usize, transition: &mut Matrix<STATES>) {
        let [cosine_reading, cosine_rate, sine_reading, sine_rate] = self.forcing[k];
        transition[0][COSINE] = cosine_reading;
        transition[1][COSINE] = cosine_rate;
        transition[0][SINE] = sine_reading;
        transition[1][SINE] = sine_rate;
    }

    fn smoothed(&self, hyper: &Hyper) -> Pass {
        let filter = self.filtered(hyper, true);
        let scale = self.scale;
        let states = filter
            .smoothed()
            .iter()
            .map(|s| {
                let mut variances = [0.0; STATES];
                for (i, v) in variances.iter_mut().enumerate() {
                    *v = s.covariance[i][i] * scale * scale;
                }
                (s.mean.map(|m| m * scale), variances)
            })
            .collect();
        Pass {
            states,
            innovations: filter.innovations().to_vec(),
            log_likelihood: filter.log_likelihood()
                - filter.innovations().len() as f64 * scale.ln(),
        }
    }
}

/// Sensor and torque without disturbance: rates of the states.
fn rates(swing: Swing) -> Matrix<STATES> {
    let Swing { omega, zeta } = swing;
    let mut a = [[0.0; STATES]; STATES];
    a[0][1] = omega;
    a[1][0] = -omega;
    a[1][1] = -2.0 * zeta * omega;
    a[1][TORQUE] = omega;
    a[TORQUE][RATE] = 1.0;
    a
}

/// Transition over a step, and the covariance gathered by unit intensity of the torque's rate.
fn stepped(swing: Swing, step: f64) -> (Matrix<STATES>, Matrix<STATES>) {
    let a = rates(swing);
    let mut push = [0.0; STATES];
    push[RATE] = 1.0;
    let mut reach = a;
    for value in reach.iter_mut().flatten() {
        *value *= step;
    }
    (exponential(&reach), gathered_noise(&a, &push, step, 2))
}

/// Places in the step, weights, and what a unit torque there does to reading and rate at the step's end.
fn force_response(swing: Swing, step: f64) -> Vec<(f64, f64, [f64; 2])> {
    let a = rates(swing);
    let mut nodes = Vec::new();
    for piece in 0..2 {
        for (node, weight) in GAUSS {
            let place = 0.5 * (f64::from(piece) + node);
            let mut left = a;
            for value in left.iter_mut().flatten() {
                *value *= (1.0 - place) * step;
            }
            let reach = exponential(&left);
            nodes.push((
                place,
                0.5 * weight * step,
                [reach[0][1] * swing.omega, reach[1][1] * swing.omega],
            ));
        }
    }
    nodes
}

fn scaled(matrix: &Matrix<STATES>, factor: f64) -> Matrix<STATES> {
    let mut result = *matrix;
    for value in result.iter_mut().flatten() {
        *value *= factor;
    }
    result
}

/// Reading of a sensor at rest at the first value that then feels a torque, linear between its values, and a disturbance given
/// over the place in the list; one value each.
pub(crate) fn reading_of(
    swing: Swing,
    interval: f64,
    torque: &[f64],
    disturbance: impl Fn(f64) -> f64,
) -> Vec<f64> {
    let (transition, _) = stepped(swing, interval);
    let nodes = force_response(swing, interval);
    let (mut reading, mut rate) = (0.0, 0.0);
    let mut readings = Vec::with_capacity(torque.len());
    for (k, &now) in torque.iter().enumerate() {
        readings.push(reading);
        let next = torque.get(k + 1).copied().unwrap_or(now);
        let mut state = [0.0; STATES];
        state[0] = reading;
        state[1] = rate;
        state[TORQUE] = now;
        state[RATE] = (next - now) / interval;
        let moved = applied(&transition, &state);
        (reading, rate) = (moved[0], moved[1]);
        for &(place, weight, [to_reading, to_rate]) in &nodes {
            let force = weight * disturbance(k as f64 + place);
            reading += force * to_reading;
            rate += force * to_rate;
        }
    }
    readings
}
