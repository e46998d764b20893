//! A bearing at constant speed whose inner parts grow faster than its outer ring: does it stay open, close, run away?

use super::tally::Tally;
use super::{network, warm};
use crate::json::{list, number, numbers, text, within};
use physics::load_zone::joint_stiffness;
use serde_json::Value;
use thermal::clearance::ThermalClearance;
use thermal::steady_speed::{SteadySpeed, Warming};
use thermal::warm_bearing::{BearingLoad, WarmBearings};

/// Error of a step, K.
const STEP_ERROR: f64 = 1e-3;
/// Most steps of a run.
const MOST_STEPS: usize = 50_000;

/// Compares a file.
pub(super) fn compare(_: &Value, tally: &mut Tally) -> Result<(), String> {
    tally.cases(one)
}

fn machine(inputs: &Value, names: &[&str]) -> Result<SteadySpeed<WarmBearings>, String> {
    let node = |name: &str| network::node(names, &Value::from(name));
    let expansion = |name: &str| within(&inputs["expansion"], name, 0.0, 1e-3);
    let inner_track = within(inputs, "inner_track_diameter", 1e-4, 10.0)?;
    let ball = within(inputs, "D", 1e-5, 1.0)?;
    let clearance = ThermalClearance {
        at_reference: within(inputs, "Pd0", -1e-2, 1e-2)?,
        reference: within(inputs, "reference_temperature", -273.0, 1e4)?,
        tracks: [inner_track, inner_track + 2.0 * ball],
        ball,
        expansions: [
            expansion("inner")?,
            expansion("balls")?,
            expansion("outer")?,
        ],
    };
    let stiffness = |key: &str| within(inputs, key, 1.0, 1e20);
    Ok(SteadySpeed {
        network: warm::network(inputs, names)?,
        losses: WarmBearings {
            ratio: 1.0,
            count: 1.0,
            moment: warm::palmgren(inputs)?,
            oil: warm::oil(inputs)?,
            load: BearingLoad::Closing {
                coefficient: within(inputs, "mu1", 0.0, 1.0)?,
                radial: within(inputs, "sum_Q_radial", 0.0, 1e9)?,
                balls: within(inputs, "Z", 1.0, 1e3)?,
                stiffness: joint_stiffness(stiffness("Ki")?, stiffness("Ko")?),
                clearance,
                nodes: [node("inner")?, node("balls")?, node("outer")?],
            },
            windage: 0.0,
            lubricant: node("lubricant")?,
            shares: [
                warm::shares(inputs, "share_M0", names)?,
                warm::shares(inputs, "share_M1", names)?,
            ],
        },
        speed: within(inputs, "speed", 0.0, 1e6)?,
        tolerance: STEP_ERROR,
    })
}

/// What ends a run before its time.
struct Bounds {
    preload: f64,
    temperature: f64,
}

impl Bounds {
    /// Why a state is beyond one.
    fn passed(&self, machine: &SteadySpeed<WarmBearings>, state: &Warming) -> Option<&'static str> {
        let (_, preload) = closing(machine, state);
        let temperatures = state.temperatures.iter().copied();
        let hottest = temperatures.fold(f64::NEG_INFINITY, f64::max);
        if preload >= self.preload {
            Some("Q_limit")
        } else if hottest >= self.temperature || !hottest.is_finite() {
            Some("T_limit")
        } else {
            None
        }
    }
}

fn closing(machine: &SteadySpeed<WarmBearings>, state: &Warming) -> (f64, f64) {
    (machine.losses.closing(machine.speed, &state.temperatures)).unwrap_or((f64::NAN, f64::NAN))
}

/// The first state after a step's start at which something holds that holds at its end.
fn first(
    machine: &SteadySpeed<WarmBearings>,
    start: &Warming,
    length: f64,
    holds: impl Fn(&Warming) -> bool,
) -> Warming {
    let (mut low, mut high) = (0.0, length);
    let mut found = machine.after(start, high);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let state = machine.after(start, middle);
        match holds(&state) {
            true => (high, found) = (middle, state),
            false => low = middle,
        }
    }
    found
}

/// A run followed to its end.
struct Followed {
    end: Warming,
    reason: &'static str,
    closure: Option<f64>,
    at: Vec<Warming>,
}

fn follow(
    machine: &SteadySpeed<WarmBearings>,
    start: Warming,
    bounds: &Bounds,
    times: &[f64],
    last: f64,
) -> Result<Followed, String> {
    let mut state = start;
    let is_closed = |state: &Warming| closing(machine, state).0 <= 0.0;
    let mut closure = is_closed(&state).then_some(0.0);
    let mut at = Vec::new();
    let mut left = times.iter().copied().chain([last]);
    let mut next = left.next().unwrap_or(last);
    for _ in 0..MOST_STEPS {
        let before = state.clone();
        machine.step(&mut state, next);
        let length = state.time - before.time;
        if closure.is_none() && is_closed(&state) {
            closure = Some(first(machine, &before, length, is_closed).time);
        }
        if bounds.passed(machine, &state).is_some() {
            let end = first(machine, &before, length, |state| {
                bounds.passed(machine, state).is_some()
            });
            let reason = bounds.passed(machine, &end).unwrap_or("T_limit");
            return Ok(Followed {
                end,
                reason,
                closure,
                at,
            });
        }
        if state.time == next {
            at.push(state.clone());
            if next >= last {
                return Ok(Followed {
                    end: state,
                    reason: "t_end",
                    closure,
                    at,
                });
            }
            next = left.next().unwrap_or(last);
        }
    }
    Err("more steps than a run may have".to_string())
}

fn one(case: &Value, tally: &mut Tally) -> Result<(), String> {
    let (inputs, results) = (&case["inputs"], &case["results"]);
    let names = network::names(inputs)?;
    let machine = machine(inputs, &names)?;
    let ambient = within(inputs, "ambient", -273.0, 1e4)?;
    let last = within(inputs, "t_end", 1e-3, 1e8)?;
    let bounds = Bounds {
        preload: within(inputs, "Q_limit", 1e-9, 1e12)?,
        temperature: within(inputs, "T_limit", ambient, 1e4)?,
    };
    let mut times = numbers(inputs, "times")?;
    times.retain(|time| *time > 0.0 && *time < last);
    times.sort_by(f64::total_cmp);
    times.dedup();
    let start = Warming::start(vec![ambient; names.len()]);
    let found = follow(&machine, start, &bounds, &times, last)?;

    let (time, moment) = (tally.relative("times")?, tally.relative("moments")?);
    let temperature = tally.margin("temperatures_K")?;
    let clearance = tally.margin("clearance_m")?;
    let preload = tally.both("preload")?;
    let hot = tally.relative("end_M0")?;
    let (wanted, reason) = (text(results, "end_reason")?, found.reason);
    if wanted != reason {
        return Err(format!("the run ends by {reason}, not by {wanted}"));
    }
    tally.add_number((results, "end_time"), "s", found.end.time, time)?;
    match (results["time_of_closure"].as_f64(), found.closure) {
        (Some(reference), Some(ours)) => {
            tally.add_by("time of closure", "s", reference, ours, time);
        }
        (None, None) => {}
        (reference, ours) => {
            return Err(format!("closure at {ours:?} s, not at {reference:?}"));
        }
    }
    let state = |tally: &mut Tally, row: &Value, at: &Warming, end: bool| -> Result<(), String> {
        let (open, load) = closing(&machine, at);
        let moments = machine.losses.of_one(machine.speed, &at.temperatures);
        let [named_open, named_load, named_first, named_second] = match end {
            true => ["end_clearance", "end_preload_per_ball", "end_M0", "end_M1"],
            false => ["clearance", "preload_per_ball", "M0", "M1"],
        };
        // the floor of the viscosity is seen in M0 of a hot end alone
        let viscous = match end {
            true => hot,
            false => moment,
        };
        for (key, unit, ours, allowed) in [
            (named_open, "m", open, clearance),
            (named_load, "N", load, preload),
            (named_first, "N m", moments[0], viscous),
            (named_second, "N m", moments[1], moment),
        ] {
            tally.add_number((row, key), unit, ours, allowed)?;
        }
        let temperatures = match end {
            true => &row["end_temperatures"],
            false => row,
        };
        for (node, name) in names.iter().enumerate() {
            let ours = at.temperatures[node];
            let reference = number(temperatures, name)?;
            tally.add_by("temperatures", "°C", reference, ours, temperature);
        }
        Ok(())
    };
    state(tally, results, &found.end, true)?;
    let place = tally.place.clone();
    for row in list(results, "rows")? {
        tally.row(&place, row, |tally| {
            let instant = number(row, "t")?;
            let at = found.at.iter().find(|at| at.time == instant);
            let at =
                at.ok_or_else(|| format!("row at {instant} s, which the run did not reach"))?;
            state(tally, row, at, false)
        })?;
    }
    let growth = machine.growth(&found.end.temperatures);
    let reference = number(results, "fastest_eigenvalue")?;
    let allowed = tally.relative("fastest_eigenvalue")?;
    tally.add_by("growth rate at the end", "1/s", reference, growth, allowed);
    Ok(())
}
