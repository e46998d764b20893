//! A rotor that coasts down on two warm bearings: stop time, temperatures, energies; in fine steps and in windows.

use super::tally::{Allowed, Tally};
use super::{network, warm};
use crate::json::{number, numbers, within};
use serde_json::Value;
use thermal::coast_down::{CoastDown, Coasting};
use thermal::warm_bearing::{BearingLoad, WarmBearings};

/// Tolerance of the fine steps, and of the windows that a run samples its moment in.
const FINE: f64 = 1e-6;
const WINDOWS: f64 = 1e-3;
/// Bearings of the machine, each with a network of its own.
const SIDES: f64 = 2.0;

/// Compares a file.
pub(super) fn compare(_: &Value, tally: &mut Tally) -> Result<(), String> {
    tally.cases(one)
}

fn machine(
    inputs: &Value,
    names: &[&str],
    tolerance: f64,
) -> Result<CoastDown<WarmBearings>, String> {
    Ok(CoastDown {
        network: warm::network(inputs, names)?,
        losses: WarmBearings {
            ratio: 1.0,
            count: SIDES,
            moment: warm::palmgren(inputs)?,
            oil: warm::oil(inputs)?,
            load: BearingLoad::Radial(within(inputs, "load", 0.0, 1e9)?),
            windage: within(inputs, "windage", 0.0, 1e3)?,
            lubricant: network::node(names, &Value::from("lubricant"))?,
            shares: [
                warm::shares(inputs, "share_M0", names)?,
                warm::shares(inputs, "share_M1", names)?,
            ],
        },
        inertia: within(inputs, "inertia", 1e-9, 1e9)?,
        tolerance,
    })
}

/// A coast-down followed to its stop.
struct Followed {
    end: Coasting,
    /// States at the times asked for.
    at: Vec<Coasting>,
    peaks: Vec<f64>,
}

fn follow(
    machine: &CoastDown<WarmBearings>,
    inputs: &Value,
    nodes: usize,
    times: &[f64],
) -> Result<Followed, String> {
    let start = within(inputs, "start_temperature", -273.0, 1e4)?;
    let speed = within(inputs, "speed0", 1e-3, 1e6)?;
    let stop = within(inputs, "stop_speed", 1e-3, speed)?;
    let mut state = Coasting::start(speed, vec![start; nodes], &machine.losses);
    let mut peaks = state.temperatures.clone();
    let mut at = Vec::new();
    let mut left = times.iter().copied();
    let mut next = left.next();
    while state.speed > stop {
        let until = next.unwrap_or(f64::INFINITY);
        let step = machine.step(&mut state, stop, until);
        step.map_err(|endless| format!("{endless:?}"))?;
        for (peak, now) in peaks.iter_mut().zip(&state.temperatures) {
            *peak = peak.max(*now);
        }
        while next == Some(state.time) {
            at.push(state.clone());
            next = left.next();
        }
    }
    Ok(Followed {
        end: state,
        at,
        peaks,
    })
}

fn one(case: &Value, tally: &mut Tally) -> Result<(), String> {
    let (inputs, results) = (&case["inputs"], &case["results"]);
    let names = network::names(inputs)?;
    let fine = machine(inputs, &names, FINE)?;
    let mut times = numbers(inputs, "times")?;
    times.retain(|time| *time > 0.0);
    times.sort_by(f64::total_cmp);
    times.dedup();
    let found = follow(&fine, inputs, names.len(), &times)?;

    let (time, energy) = (tally.relative("stop_time")?, tally.relative("energies")?);
    let temperature = tally.margin("temperatures_K")?;
    let start = within(inputs, "start_temperature", -273.0, 1e4)?;
    let cold = fine.network.stored(&vec![start; names.len()]);
    let energies = |end: &Coasting| {
        [
            ("kinetic_energy", end.heats.iter().sum()),
            ("bearing_heat", end.heats[0] + end.heats[1]),
            ("windage_heat", end.heats[2]),
            (
                "stored",
                SIDES * (fine.network.stored(&end.temperatures) - cold),
            ),
            ("to_ground", end.given),
        ]
    };
    let reference = number(results, "stop_time")?;
    tally.add_by("stop time", "s", reference, found.end.time, time);
    let lost = number(results, "kinetic_energy")?;
    for (key, ours) in energies(&found.end) {
        // each within the share of the energy that there is
        let allowed = Allowed {
            absolute: energy.relative * lost,
            ..energy
        };
        if !results[key].is_null() {
            let quantity = key.replace('_', " ");
            tally.add_by(&quantity, "J", number(results, key)?, ours, allowed);
        }
    }
    let windows = machine(inputs, &names, WINDOWS)?;
    let windows = follow(&windows, inputs, names.len(), &[])?;
    let slow = tally.relative("slow_scheme_stop_time")?;
    let stop = windows.end.time;
    tally.add_by("stop time in windows", "s", reference, stop, slow);
    // a case without temperatures is one of the stop time alone
    if results["peak"].is_object() {
        let slow = tally.margin("slow_scheme_peak_K")?;
        for (node, name) in names.iter().enumerate() {
            let end = number(&results["end_temperatures"], name)?;
            let ours = found.end.temperatures[node];
            tally.add_by("end temperatures", "°C", end, ours, temperature);
            let peak = results["peak"][name][0].as_f64();
            let peak = peak.ok_or_else(|| format!("no peak of {name}"))?;
            for (quantity, ours, allowed) in [
                ("largest temperatures", found.peaks[node], temperature),
                ("largest temperatures in windows", windows.peaks[node], slow),
            ] {
                tally.add_by(quantity, "°C", peak, ours, allowed);
            }
        }
    }
    let place = tally.place.clone();
    for row in results["rows"].as_array().map_or(&[][..], Vec::as_slice) {
        tally.row(&place, row, |tally| {
            let instant = number(row, "t")?;
            let Some(at) = found.at.iter().find(|at| at.time == instant) else {
                return Err(format!("row at {instant} s, which the run did not reach"));
            };
            // as sure as the stop time: a speed that falls steadily is off by that share of the first
            let allowed = Allowed::size(time.relative * number(inputs, "speed0")?);
            let speed = number(row, "speed")?;
            tally.add_by("speed over time", "rad/s", speed, at.speed, allowed);
            let moments = fine.losses.of_one(at.speed, &at.temperatures);
            for (key, ours) in [("M0", moments[0]), ("M1", moments[1])] {
                // a moment is as sure as the viscosity at a temperature: 4 % for each kelvin
                let allowed = Allowed::share(0.04 * temperature.absolute);
                tally.add_by(key, "N m", number(row, key)?, ours, allowed);
            }
            for (node, name) in names.iter().enumerate() {
                let (wanted, ours) = (number(row, name)?, at.temperatures[node]);
                tally.add_by("temperatures over time", "°C", wanted, ours, temperature);
            }
            Ok(())
        })?;
    }

    Ok(())
}
