//! Motion of the base: from a record, a file, a response spectrum and a shock to what the model takes.
//!
//! A record of a spectrum is a sum of sines, evenly spaced on a logarithmic axis, under an envelope E:
//!
//! ```text
//!   b̈ = E(t) [Σ A_k sin(ω_k t + φ_k) - c_1 - c_2 t/T],   |b̈| ≤ 0.95 S(ω_n)       φ_k from the seed
//!   A_k ← A_k S(ω_k)/S_b(ω_k)                              until |S_b/S - 1| ≤ 0.1 at each ω_k and between
//! ```
//! c_1 and c_2 leave neither velocity nor displacement at its end. The limit is that of a stiff oscillator, which follows its base: sines
//! of random phase alone exceed it. Phases that do not lead there are drawn again.

use crate::drop::Drop;
use crate::drop::record_file::{self, sum};
use crate::drop::warning_table::ShaftWarning;
use model::base::{BaseConstants, HalfSine};
use model::system::machine::MachineConstants;
use model::table::Table;
use number::Vec2;
use outcome::Warning;
use physics::response_spectrum::{Oscillator, spectrum_at};
use problem::{Code, Problem, Result};
use scenario::{Spectrum, problem_at};
use statistics::random::uniform;
use std::f64::consts::TAU;
use units::number_text;

/// How far the spectrum of a record may be from the one asked for.
const WITHIN: f64 = 0.1;
/// Step from sine to sine over the damping ratio, as a share of the frequency.
const SPACING: f64 = 0.8;
/// Intervals in a period of the highest frequency.
const INTERVALS: f64 = 16.0;
/// Largest acceleration of a record over the spectrum at its highest frequency.
const LIMIT: f64 = 0.95;
/// Limiting and taking out what is left at the end disturb each other: so often in turn.
const TURNS: usize = 4;
/// Corrections of amplitudes with one draw of phases.
const CORRECTIONS: usize = 25;
/// Draws of phases.
const DRAWS: u64 = 16;
/// Sines times instants of a record that is made in seconds.
const MOST_WORK: f64 = 4e6;
/// How the base of a drop moves.
///
/// # Errors
/// A file that holds no such record, and a spectrum that no record is found for.
pub(super) fn base(drop: &Drop) -> Result<Option<BaseConstants>> {
    let Some(given) = &drop.base else {
        return Ok(None);
    };
    let mut records: [Vec<Vec<[f64; 2]>>; 2] = [0, 1].map(|axis: usize| {
        let rows = given.record[axis].clone();
        vec![rows]
    });
    if let Some(file) = &given.file {
        let [x, y] = &file.channels;
        let channels = [(x, "x", "m/s^2"), (y, "y", "m/s^2")];
        let read = record_file::read(&file.path, "base", channels)?;
        for (record, rows) in records.iter_mut().zip(read) {
            record.push(rows);
        }
    }
    if let Some(spectrum) = &given.spectrum {
        affordable(spectrum)?;
        for (axis, share) in spectrum.shares.iter().enumerate() {
            if *share > 0.0 {
                let mut rows = record(spectrum, axis as u64).map_err(out_of_reach)?;
                rows.iter_mut().for_each(|row| row[1] *= share);
                records[axis].push(rows);
            }
        }
    }
    let placed = |rows: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let rows = rows.iter();
        rows.map(|[time, value]| [time + given.start, value * given.scale])
            .collect()
    };
    let first = records.iter().flatten().filter_map(|rows| rows.first());
    let first = first.map(|row| row[0]).fold(0.0, f64::min);
    if given.start + first < 0.0 {
        let found = format!(
            "a record that begins {} s before the run",
            number_text(-first - given.start)
        );
        let needed = format!("at least {} s is needed", number_text(-first));
        return Err(problem_at(Code::OutOfRange, "base.start", found, needed));
    }
    let record = records.map(|list| {
        let list: Vec<_> = (list.iter())
            .filter(|rows| !rows.is_empty())
            .map(|rows| placed(rows))
            .collect();
        sum(&list)
    });
    Ok(Some(BaseConstants {
        record,
        shocks: (given.shock.iter())
            .map(|shock| HalfSine {
                start: shock.start,
                duration: shock.duration,
                acceleration: Vec2::new(shock.acceleration[0], shock.acceleration[1]),
            })
            .collect(),
    }))
}

/// Largest acceleration of a base until an instant, m/s².
pub(super) fn largest(constants: &MachineConstants, until: f64) -> f64 {
    let bases = constants.base.iter();
    let largest = bases.map(|base| {
        let within = base.shocks.iter().flat_map(|shock| {
            (0..=1000).map(|k| shock.start + shock.duration * f64::from(k) / 1000.0)
        });
        let instants = base.knots().chain(within).filter(|time| *time <= until);
        let sizes = instants.map(|time| base.acceleration(time).length_squared());
        sizes.fold(0.0, f64::max).sqrt()
    });
    largest.fold(0.0, f64::max)
}

/// Whether a table is larger after an instant than it ever was before.
fn rises_after(table: &Table, end: f64) -> bool {
    let (before, after): (Vec<_>, Vec<_>) = table.points().iter().partition(|own| own.0 <= end);
    let largest = |points: &[(f64, f64)]| points.iter().fold(0.0, |m: f64, own| m.max(own.1.abs()));
    largest(&after) > largest(&before).max(table.value(end).abs())
}

/// Motions of the base, and forces from outside, that are largest after the end of a run.
pub(super) fn cut_off(constants: &MachineConstants, end: f64) -> Vec<Warning> {
    // the last instant of those that are larger after the end than ever before
    let until = |tables: &mut dyn Iterator<Item = &Table>| {
        let rising = tables.filter(|table| rises_after(table, end));
        let last = rising.filter_map(|table| Some(table.points().last()?.0));
        last.reduce(f64::max)
    };
    let bases = constants.base.iter();
    let record = until(&mut bases.clone().flat_map(|base| &base.record));
    let shocks = bases.flat_map(|base| &base.shocks);
    let shock = shocks.map(|own| own.start + own.duration).reduce(f64::max);
    let force = until(&mut constants.forces.iter().flat_map(|own| &own.over_time));
    let all = [
        ("the record of the base", record),
        ("the shock of the base", shock),
        ("a force or torque from outside", force),
    ];
    all.into_iter()
        .filter_map(|(what, until)| {
            let until = until.filter(|until| *until > end * (1.0 + 1e-9))?;
            let what = what.to_string();
            Some(ShaftWarning::CutOff { what, until, end }.into())
        })
        .collect()
}

/// Refuses a spectrum whose record would take minutes.
fn affordable(spectrum: &Spectrum) -> Result<()> {
    let (lines, steps) = Maker::size(spectrum);
    if lines * steps <= MOST_WORK {
        return Ok(());
    }
    let found = format!(
        "{} sines at {} instants",
        number_text(lines),
        number_text(steps)
    );
    let needed = "fewer are needed: a lower highest frequency, a higher lowest one, more damping or a shorter envelope";
    Err(problem_at(Code::OutOfRange, "base.spectrum", found, needed))
}

fn out_of_reach(best: f64) -> Box<Problem> {
    let found = format!(
        "no record within 10 % of it; the best of {DRAWS} is {} % away",
        number_text((100.0 * best).round())
    );
    let needed = "a spectrum that falls less steeply at its ends, or a longer envelope, is needed";
    problem_at(Code::OutOfRange, "base.spectrum", found, needed)
}

/// A record of a spectrum, rows of time and acceleration; else how near the best one came.
fn record(spectrum: &Spectrum, axis: u64) -> std::result::Result<Vec<[f64; 2]>, f64> {
    let maker = Maker::of(spectrum);
    let mut best = f64::INFINITY;
    for draw in 0..DRAWS {
        let phase = |k: usize| TAU * uniform(spectrum.seed, 2 * draw + axis, k as u64);
        let (values, apart) = maker.make(&phase);
        if apart <= WITHIN {
            let rows = values.into_iter().enumerate();
            return Ok(rows
                .map(|(k, value)| [k as f64 * maker.interval, value])
                .collect());
        }
        best = best.min(apart);
    }
    Err(best)
}

/// What makes records of a spectrum.
struct Maker {
    interval: f64,
    envelope: Vec<f64>,
    /// Frequencies of the sines, rad/s.
    frequencies: Vec<f64>,
    /// Oscillators at these and between them, each with its largest acceleration as asked for, m/s².
    oscillators: Vec<(Oscillator, f64)>,
    limit: f64,
}

impl Maker {
    /// Number of steps from sine to sine, and of intervals.
    fn size(spectrum: &Spectrum) -> (f64, f64) {
        let rows = &spectrum.rows;
        let [first, last] = [rows[0][0], rows[rows.len() - 1][0]];
        let length: f64 = spectrum.envelope.iter().sum();
        let lines = (last / first).ln() / (1.0 + SPACING * spectrum.damping).ln();
        (lines.ceil(), (length * last * INTERVALS / TAU).ceil())
    }
    fn of(spectrum: &Spectrum) -> Self {
        let rows = &spectrum.rows;
        let [first, last] = [rows[0], rows[rows.len() - 1]];
        let [rise, hold, decay] = spectrum.envelope;
        let length = rise + hold + decay;
        let (lines, steps) = Self::size(spectrum);
        let (interval, count) = (length / steps, lines as usize);
        let ratio = last[0] / first[0];
        let at = |k: f64| first[0] * ratio.powf(k / count as f64);
        let oscillators = (0..=2 * count).map(|k| {
            let frequency = at(0.5 * k as f64);
            let asked = spectrum_at(rows, frequency);
            (
                Oscillator::new(frequency, spectrum.damping, interval),
                asked,
            )
        });
        let envelope = (0..=steps as usize).map(|k| {
            let time = k as f64 * interval;
            let least = (time / rise).min((length - time) / decay);
            least.clamp(0.0, 1.0)
        });
        Maker {
            interval,
            envelope: envelope.collect(),
            frequencies: (0..=count).map(|k| at(k as f64)).collect(),
            oscillators: oscillators.collect(),
            limit: LIMIT * last[1],
        }
    }

    /// A record with these phases, and how far its spectrum is from the one asked for.
    fn make(&self, phase: &dyn Fn(usize) -> f64) -> (Vec<f64>, f64) {
        let lines = self.oscillators.iter().step_by(2);
        let mut amplitudes: Vec<f64> = lines.map(|(_, asked)| 0.1 * asked).collect();
        let mut best = (Vec::new(), f64::INFINITY);
        for _ in 0..CORRECTIONS {
            let values = self.sines(&amplitudes, phase);
            let shares: Vec<f64> = (self.oscillators.iter())
                .map(|(own, asked)| own.largest(&values) / asked)
                .collect();
            let apart = (shares.iter()).fold(0.0_f64, |most, share| most.max((share - 1.0).abs()));
            if apart < best.1 {
                best = (values, apart);
            }
            if apart <= WITHIN {
                break;
            }
            for (amplitude, share) in amplitudes.iter_mut().zip(shares.iter().step_by(2)) {
                *amplitude /= share;
            }
        }
        best
    }

    /// Sines under the envelope, limited, with nothing left at the end.
    fn sines(&self, amplitudes: &[f64], phase: &dyn Fn(usize) -> f64) -> Vec<f64> {
        let mut sum = vec![0.0; self.envelope.len()];
        for (k, (frequency, amplitude)) in self.frequencies.iter().zip(amplitudes).enumerate() {
            let (mut sine, mut cosine) = phase(k).sin_cos();
            let (turn_sine, turn_cosine) = (frequency * self.interval).sin_cos();
            for own in &mut sum {
                *own += amplitude * sine;
                (sine, cosine) = (
                    sine * turn_cosine + cosine * turn_sine,
                    cosine * turn_cosine - sine * turn_sine,
                );
            }
        }
        for (own, envelope) in sum.iter_mut().zip(&self.envelope) {
            *own *= envelope;
        }
        for _ in 0..TURNS {
            for own in &mut sum {
                *own = own.clamp(-self.limit, self.limit);
            }
            self.bring_to_rest(&mut sum);
        }
        sum
    }

    /// Takes c_1 and c_2 out of a record.
    fn bring_to_rest(&self, values: &mut [f64]) {
        let last = (self.envelope.len() - 1) as f64;
        let rising = |k: usize| self.envelope[k] * k as f64 / last;
        let (v, d) = self.left(&|k| values[k]);
        let (v_1, d_1) = self.left(&|k| self.envelope[k]);
        let (v_2, d_2) = self.left(&rising);
        let determinant = v_1 * d_2 - v_2 * d_1;
        let c_1 = (v * d_2 - v_2 * d) / determinant;
        let c_2 = (v_1 * d - v * d_1) / determinant;
        for (k, value) in values.iter_mut().enumerate() {
            *value -= c_1 * self.envelope[k] + c_2 * rising(k);
        }
    }

    /// Velocity and displacement that an acceleration leaves at its end.
    fn left(&self, of: &dyn Fn(usize) -> f64) -> (f64, f64) {
        let h = self.interval;
        let (mut velocity, mut displacement) = (0.0, 0.0);
        for k in 1..self.envelope.len() {
            let (before, after) = (of(k - 1), of(k));
            displacement += velocity * h + h * h * (2.0 * before + after) / 6.0;
            velocity += 0.5 * h * (before + after);
        }
        (velocity, displacement)
    }
}
