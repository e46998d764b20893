//! Levitated rotors: closed loops (`machine_levitated.json`) and the start of a drop (`machine_drop_flexible.json`, whose drop is in `machines`).
//!
//! A closed loop is compared in all coordinates of the rotor and in the reduced basis that runs use, each with the tolerances that
//! the files give for it: numbers in the text `accept`. Complex numbers are compared by their distance.

mod accept;
pub(super) mod machine;

use super::compare::{Refusal, Worst, part, rows_of, told};
use super::json::number;
use super::report::{Row, Tolerance};
use accept::{Accept, REDUCED, WHOLE};
use levitation::response::{equilibrium, impulse, start, unbalance};
use levitation::sensitivity::{Axes, Band, Sensitivity};
use levitation::{C64, ClosedLoop, ZERO, weight};
use machine::Machine;
use rotor::Analysis;
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::path::Path;

const GRAVITY: [f64; 2] = [0.0, -9.81];

/// Rows of a file; `None` when its keys are those of another.
pub(super) fn rows(value: &Value, path: &Path) -> Option<Vec<Row>> {
    let top = value.as_object()?;
    let has = |keys: &[&str]| keys.iter().all(|key| top.contains_key(*key));
    has(&["magnets", "results", "beta_external"]).then(|| rows_of(closed_loop(value, path)))
}

/// Adds a complex number, compared by its distance.
fn add(worst: &mut Worst, name: &str, unit: &str, pair: (C64, C64), allowed: f64, why: &str) {
    let (ours, wanted) = (pair.0.norm(), pair.1.norm());
    let row = Row::compared(name, unit, wanted, ours, Tolerance::Absolute(allowed), why);
    let scale = if wanted == 0.0 { 1.0 } else { wanted };
    worst.add(row.by((pair.0 - pair.1).norm() / scale));
}

fn complex(pair: &Value) -> C64 {
    let at = |index: usize| pair[index].as_f64().unwrap_or(f64::NAN);
    C64::new(at(0), at(1))
}
fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().map_or(&[], Vec::as_slice)
}
fn largest<'a>(all: impl Iterator<Item = &'a Value>) -> f64 {
    all.map(|pair| complex(pair).norm()).fold(0.0, f64::max)
}
/// Nodes of a list, of so many that there are.
fn nodes(value: &Value, count: usize) -> Result<Vec<usize>, String> {
    let all: Vec<usize> = part(&value["nodes"])?;
    match all.iter().find(|node| **node >= count) {
        Some(node) => Err(format!("node {node}, of {count} nodes")),
        None => Ok(all),
    }
}

fn closed_loop(value: &Value, path: &Path) -> Result<Vec<Row>, Refusal> {
    let beta = [
        number(value, "beta_external")?,
        number(value, "beta_internal")?,
    ];
    let machine = Machine::of(value, path, beta)?;
    let mut worst = Worst::default();
    for accept in [WHOLE.of(value), REDUCED.of(value)] {
        let analysis = machine.analysis(accept.cut)?;
        for (at, result) in list(value, "results").iter().enumerate() {
            worst.row(&format!("results {}", at + 1), result, |worst| {
                let speed = number(result, "speed_rad_s")?;
                let closed = machine.turning(&analysis, speed)?;
                let why = format!("{speed:.1} rad/s; {}; tolerance of the file", accept.name);
                at_speed(&closed, result, accept, &why, worst)?;
                turning_unbalance(&machine, &closed, result, accept, &why, worst)
            })?;
        }
        if let Some(struck) = value.get("impulse_response") {
            let closed = machine.turning(&analysis, number(struck, "speed_rad_s")?)?;
            after_impulse(&closed, struck, accept, &mut worst)?;
        }
    }
    let whole = machine.analysis(f64::INFINITY)?;
    if let Some(wanted) = value["open_loop_largest_real_part"].as_f64() {
        let open = machine.turning(&whole, 0.0)?.open_loop().map_err(told)?;
        let ours = open.iter().map(|value| value.re).fold(f64::MIN, f64::max);
        let why = "largest Re λ without control current, at standstill; tolerance of the file";
        let name = "open loop, largest real part";
        let mut open = worst.under(Tolerance::Relative(1e-6), why);
        open.add(name, "1/s", [wanted, ours]);
    }
    if let Some(standing) = value.get("static_values") {
        at_rest(&machine, &whole, standing, &mut worst)?;
    }
    if let Some(check) = value.get("zero_stiffness_check") {
        zero_stiffness(&machine, &whole, check, &mut worst)?;
    }
    Ok(worst.into_rows())
}

fn at_speed(
    closed: &ClosedLoop<C64>,
    result: &Value,
    accept: Accept,
    why: &str,
    worst: &mut Worst,
) -> Result<(), String> {
    let basis = accept.name;
    let poles = closed.poles().map_err(told)?;
    for wanted in list(result, "eigenvalues").iter().map(complex) {
        let distance = |pole: &&levitation::Pole| (pole.value - wanted).norm();
        let nearest = poles
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let ours = nearest.ok_or("a loop without eigenvalues")?.value;
        let share = match wanted.norm() < accept.far {
            true => accept.eigenvalues,
            false => accept.filters,
        };
        let allowed = share * wanted.norm() + 1e-5;
        let name = format!("eigenvalues, {basis}");
        add(worst, &name, "1/s", (ours, wanted), allowed, why);
    }
    let axes = Axes::new(closed).map_err(told)?;
    for sample in list(result, "sensitivity_samples") {
        if worst.lacks("sensitivity sample", sample) {
            continue;
        }
        let ours = axes.at(number(sample, "rad_s")?).map_err(told)?;
        for (ours, wanted) in ours.iter().zip(list(sample, "S")) {
            let wanted = wanted.as_f64().unwrap_or(f64::NAN);
            let mut all = worst.under(Tolerance::Relative(accept.sensitivity), why);
            all.add(&format!("sensitivity, {basis}"), "", [wanted, ours.norm()]);
        }
    }
    let band = Band {
        from: TAU,
        to: TAU * 3000.0,
    };
    let found = Sensitivity::new(closed, &poles, band).map_err(told)?;
    for wanted in list(result, "sensitivity_peak") {
        if worst.lacks("sensitivity peak", wanted) {
            continue;
        }
        let ours = found.peaks.get(number(wanted, "magnet")? as usize);
        let ours = ours.ok_or("a peak of no magnet")?;
        for (word, unit, key, ours, share) in [
            ("peak", "", "S", ours.size, accept.peaks),
            ("frequency of peak", "rad/s", "at_rad_s", ours.at, 1e-4),
        ] {
            let name = format!("sensitivity, {word}, {basis}");
            let mut peaks = worst.under(Tolerance::Relative(share), why);
            peaks.add(&name, unit, [number(wanted, key)?, ours]);
        }
    }
    Ok(())
}

fn turning_unbalance(
    machine: &Machine,
    closed: &ClosedLoop<C64>,
    result: &Value,
    accept: Accept,
    why: &str,
    worst: &mut Worst,
) -> Result<(), String> {
    let Some(wanted) = result.get("unbalance_response") else {
        return Ok(());
    };
    let ours = unbalance(closed, &machine.unbalance, number(result, "speed_rad_s")?);
    let ours = ours.map_err(told)?;
    let (w, currents) = (list(wanted, "w"), list(wanted, "current_A"));
    let allowed = accept.unbalance * largest(w.iter());
    for (node, w) in nodes(wanted, ours.forward.len())?.into_iter().zip(w) {
        let name = format!("unbalance response, {}", accept.name);
        add(
            worst,
            &name,
            "m",
            (ours.forward[node], complex(w)),
            allowed,
            why,
        );
    }
    let allowed = accept.unbalance * largest(currents.iter());
    for (ours, wanted) in ours.currents.iter().zip(currents) {
        let name = format!("unbalance current, {}", accept.name);
        add(worst, &name, "A", (*ours, complex(wanted)), allowed, why);
    }
    Ok(())
}

fn after_impulse(
    closed: &ClosedLoop<C64>,
    struck: &Value,
    accept: Accept,
    worst: &mut Worst,
) -> Result<(), String> {
    let text = struck["text"].as_str().unwrap_or_default();
    let count = closed.plant().nodes.nrows();
    let node = number_after(text, "node").filter(|node| (*node as usize) < count);
    let (Some(size), Some(node)) = (number_after(text, "impulse"), node) else {
        return Err("an impulse_response whose text has no \"impulse … node …\"".into());
    };
    let rows = list(struck, "rows").iter();
    let rows: Vec<&Value> = rows
        .filter(|row| !worst.lacks("row of the impulse response", row))
        .collect();
    let times: Result<Vec<f64>, String> = rows.iter().map(|row| number(row, "t")).collect();
    let times = times?;
    let states = impulse(closed, node as usize, size, &times).map_err(told)?;
    let moved = largest(rows.iter().flat_map(|row| list(row, "w")));
    let current = largest(rows.iter().flat_map(|row| list(row, "current_A")));
    let nodes = nodes(struck, count)?;
    for ((row, state), time) in rows.iter().zip(&states).zip(times) {
        let share = if time < 1e-3 {
            accept.early_impulse
        } else {
            accept.impulse
        };
        let why = format!(
            "{time} s after {size} N s at node {node}; {}; tolerance of the file",
            accept.name
        );
        let w = closed.displacements(state);
        for (node, wanted) in nodes.iter().zip(list(row, "w")) {
            let name = format!("impulse response, {}", accept.name);
            add(
                worst,
                &name,
                "m",
                (w[*node], complex(wanted)),
                share * moved,
                &why,
            );
        }
        for (ours, wanted) in closed
            .currents(state)
            .into_iter()
            .zip(list(row, "current_A"))
        {
            let name = format!("impulse current, {}", accept.name);
            add(
                worst,
                &name,
                "A",
                (ours, complex(wanted)),
                share * current,
                &why,
            );
        }
    }
    Ok(())
}

/// The first number behind a word: "impulse 0.02 N s".
fn number_after(text: &str, word: &str) -> Option<f64> {
    let mut words = text.split(|letter: char| letter.is_whitespace() || letter == ',');
    words.by_ref().find(|own| *own == word)?;
    words
        .next()?
        .parse()
        .ok()
        .filter(|value: &f64| *value >= 0.0)
}

fn at_rest(
    machine: &Machine,
    analysis: &Analysis,
    standing: &Value,
    worst: &mut Worst,
) -> Result<(), String> {
    let loads = weight(&machine.rotor, analysis, GRAVITY);
    let plant = machine.planes(analysis, 0.0);
    let ours = equilibrium(&plant, &machine.levitation()?, &loads).map_err(told)?;
    let why = "under gravity with integrators; tolerance of the file";
    let (w, currents) = (list(standing, "w"), list(standing, "current_A"));
    let allowed = 1e-6 * largest(w.iter()) + 1e-13;
    for (node, wanted) in nodes(standing, machine.rotor.nodes.len())?
        .into_iter()
        .zip(w)
    {
        let along = |angle: f64| (plant.row(node, angle) * &ours.coordinates)[0];
        let pair = (C64::new(along(0.0), along(FRAC_PI_2)), complex(wanted));
        add(worst, "static position", "m", pair, allowed, why);
    }
    let allowed = 1e-6 * largest(currents.iter());
    for (pair, wanted) in ours.currents.chunks(2).zip(currents) {
        let pair = (C64::new(pair[0], pair[1]), complex(wanted));
        add(worst, "static current", "A", pair, allowed, why);
    }
    Ok(())
}

fn zero_stiffness(
    machine: &Machine,
    analysis: &Analysis,
    check: &Value,
    worst: &mut Worst,
) -> Result<(), String> {
    for (collocated, key) in [
        (false, "sensors_of_this_file"),
        (true, "sensors_at_the_actuator_nodes"),
    ] {
        let mut magnets = machine.magnets.clone();
        for magnet in &mut magnets {
            (magnet.controller.Kp, magnet.controller.Ki) = (number(check, "Kp")?, 0.0);
            if collocated {
                magnet.sensor_node = magnet.actuator_node;
            }
        }
        let changed = Machine {
            rotor: machine.rotor.clone(),
            magnets,
            unbalance: Vec::new(),
        };
        let poles = changed.turning(analysis, 0.0)?.poles().map_err(told)?;
        let (zeros, others): (Vec<C64>, Vec<C64>) =
            (poles.iter().map(|pole| pole.value)).partition(|value| value.norm() < ZERO);
        let wanted = &check[key];
        let why = format!(
            "{}: K_p = k_s/k_i, K_i = 0 at standstill; tolerance of the file",
            key.replace('_', " ")
        );
        let next = complex(&wanted["next"]);
        let pair = (*others.first().ok_or("nothing but zeros")?, next);
        let name = "next eigenvalue without static stiffness";
        add(worst, name, "1/s", pair, 1e-6 * next.norm(), &why);
        let largest = others.iter().map(|value| value.re).fold(f64::MIN, f64::max);
        let mut exact = worst.under(Tolerance::Absolute(0.0), why.as_str());
        let zeros = [number(wanted, "eigenvalues_at_zero")?, zeros.len() as f64];
        exact.add("eigenvalues at zero without static stiffness", "", zeros);
        let mut close = worst.under(Tolerance::Relative(1e-6), why);
        let others = [number(wanted, "largest_other_real_part")?, largest];
        let name = "largest other real part without static stiffness";
        close.add(name, "1/s", others);
    }
    Ok(())
}

/// Rows of the start of a drop, in closed form.
pub(super) fn start_of_drop(value: &Value, path: &Path) -> Result<Vec<Row>, Refusal> {
    let machine = Machine::of(value, path, [number(value, "beta_added")?, 0.0])?;
    let (speed, gravity) = (number(value, "Om")?, part(&value["gravity"])?);
    let analysis = machine.analysis(f64::INFINITY)?;
    let loads = weight(&machine.rotor, &analysis, gravity);
    let plant = machine.planes(&analysis, speed);
    let levitation = machine.levitation()?;
    let ours = start(&plant, &levitation, &loads, &machine.unbalance, speed, 0.0).map_err(told)?;
    let (size, shapes) = (analysis.basis.len(), &analysis.basis.shapes);
    let why = "static position and synchronous motion in closed form; 1e-6 of the largest of its kind: the reference is of double precision";
    let mut worst = Worst::default();
    for (name, key, units, values) in [
        ("position", "q", ["m", "rad"], &ours.coordinates),
        ("velocity", "qd", ["m/s", "rad/s"], &ours.rates),
    ] {
        let wanted = list(&value["start"], key);
        if wanted.len() != shapes.nrows() {
            return Err(format!("a start of another size than {}", shapes.nrows()).into());
        }
        let plane = |from: usize| shapes * values.rows(from, size);
        let (x, y) = (plane(0), plane(size));
        for (kind, word) in ["displacement", "slope"].into_iter().enumerate() {
            let allowed = 1e-6 * largest(wanted.iter().skip(kind).step_by(2));
            for (k, wanted) in wanted.iter().enumerate().skip(kind).step_by(2) {
                let name = format!("{name} at the start, {word}");
                let pair = (C64::new(x[k], y[k]), complex(wanted));
                add(&mut worst, &name, units[kind], pair, allowed, why);
            }
        }
    }
    let currents = list(&value["start"], "control_current_A");
    let allowed = 1e-6 * largest(currents.iter());
    for (pair, wanted) in ours.currents.chunks(2).zip(currents) {
        let pair = (C64::new(pair[0], pair[1]), complex(wanted));
        add(&mut worst, "current at the start", "A", pair, allowed, why);
    }
    Ok(worst.into_rows())
}
