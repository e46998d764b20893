//! Levitated rotors: closed loops (`machine_levitated.json`) and the start of a drop (`machine_drop_flexible.json`, whose drop is in `machines`).
//!
//! A closed loop is compared in all coordinates of the rotor and in the reduced basis that runs use, each with the tolerances that
//! the files give for it: numbers in the text `accept`. Complex numbers are compared by their distance.

pub(super) mod machine;

use super::compare::{Refusal, Worst, part, rows_of, told};
use super::json::number;
use super::report::{Row, Tolerance};
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

/// The tolerances of the files for a basis.
#[derive(Clone, Copy)]
struct Accept {
    name: &'static str,
    /// Free modes up to this, rad/s.
    cut: f64,
    eigenvalues: f64,
    /// Of roots of filters, `far` from the origin, 1/s.
    filters: f64,
    far: f64,
    sensitivity: f64,
    peaks: f64,
    unbalance: f64,
    impulse: f64,
    early_impulse: f64,
}

const WHOLE: Accept = Accept {
    name: "all coordinates",
    cut: f64::INFINITY,
    eigenvalues: 1e-6,
    filters: 1e-6,
    far: 2.5e4,
    sensitivity: 1e-6,
    peaks: 1e-5,
    unbalance: 1e-6,
    impulse: 1e-6,
    early_impulse: 1e-6,
};
const REDUCED: Accept = Accept {
    name: "free modes to 6e4 rad/s and residual flexibility",
    cut: 6e4,
    eigenvalues: 1e-5,
    filters: 2e-4,
    far: 2.5e4,
    sensitivity: 4e-5,
    peaks: 4e-5,
    unbalance: 2e-5,
    impulse: 1e-3,
    early_impulse: 5e-3,
};

impl Accept {
    /// With the numbers that the text `accept` of a file gives: what it says of the reduced rotor begins at "free modes".
    fn of(self, file: &Value) -> Self {
        let text = file["accept"].as_str().unwrap_or_default();
        let (whole, reduced) = text.split_once("free modes").unwrap_or((text, ""));
        let (own, peaks) = match self.cut.is_finite() {
            true => (reduced, "(reduced"),
            false => (whole, "Peaks of |S|"),
        };
        let after = |text: &str, word: &str, usual: f64| {
            let numbers = text.split_once(word).map(|(_, rest)| numbers(rest));
            numbers.and_then(|mut all| all.next()).unwrap_or(usual)
        };
        // "2e-4 for the two filter roots", or "filter roots 2e-4"
        let near = |word: &str, usual: f64| {
            let clause = own.split_once(word).map_or("", |(text, _)| text);
            let clause = clause.rsplit([',', ';']).next().unwrap_or_default();
            let share = numbers(clause).filter(|number| *number < 1.0).last();
            share.unwrap_or_else(|| after(own, word, usual))
        };
        let eigenvalues = after(own, "eigenvalues", self.eigenvalues);
        let impulse = after(own, "impulse response", self.impulse);
        Accept {
            eigenvalues,
            filters: near("filter root", self.filters.max(eigenvalues)),
            far: after(reduced, "|lambda| <", self.far),
            sensitivity: after(own, "|S|", self.sensitivity),
            peaks: after(text, peaks, self.peaks),
            unbalance: after(own, "unbalance", self.unbalance),
            impulse,
            early_impulse: near("before", self.early_impulse.max(impulse)),
            ..self
        }
    }
}

/// The numbers of a text.
fn numbers(text: &str) -> impl Iterator<Item = f64> + '_ {
    let words = text.split(|letter: char| letter.is_whitespace() || "(),;:".contains(letter));
    let numbers = words.filter_map(|word| word.trim_end_matches('.').parse().ok());
    numbers.filter(|number: &f64| number.is_finite())
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

#[cfg(test)]
mod tests {
    use super::super::report::Verdict;
    use super::*;

    #[test]
    fn the_text_of_a_file_gives_its_tolerances() {
        let text = "unreduced rotor: eigenvalues |dlambda| <= 3e-6 |lambda| + 1e-5 1/s, |S| samples 2e-6 relative, unbalance and \
                    impulse response 4e-6 of the largest; free modes to 6e4 rad/s (18 coordinates): eigenvalues 2e-5 for |lambda| < 2e4 \
                    and 1e-3 for the two nearly double filter roots near -26 200, |S| 5e-5, unbalance response 6e-5, impulse response \
                    7e-3 from t = 1 ms on, 8e-3 before. Peaks of |S| 9e-5 (reduced 1e-4), their frequency 1e-4";
        let file = serde_json::json!({ "accept": text });
        let shown = |of: Accept| {
            let (modes, peaks) = (
                [of.eigenvalues, of.filters, of.far],
                [of.sensitivity, of.peaks],
            );
            (modes, peaks, [of.unbalance, of.impulse, of.early_impulse])
        };
        let whole = ([3e-6, 3e-6, 2e4], [2e-6, 9e-5], [4e-6; 3]);
        assert_eq!(shown(WHOLE.of(&file)), whole);
        let reduced = ([2e-5, 1e-3, 2e4], [5e-5, 1e-4], [6e-5, 7e-3, 8e-3]);
        assert_eq!(shown(REDUCED.of(&file)), reduced);
        let after = serde_json::json!({"accept": "; free modes: eigenvalues 1e-5, filter roots 1e-3 |lambda|"});
        assert_eq!(REDUCED.of(&after).filters, 1e-3);
        // what a file does not say is as usual
        assert_eq!(shown(REDUCED.of(&Value::Null)), shown(REDUCED));
    }
    #[test]
    fn both_parts_of_a_complex_number_count_alike() {
        let wanted = C64::new(-2.6e4, 3.0);
        for (off, passes) in [
            (C64::new(0.0, 9.9), true),
            (C64::new(9.9, 0.0), true),
            (C64::new(8.0, 8.0), false),
        ] {
            let mut worst = Worst::default();
            add(&mut worst, "root", "1/s", (wanted + off, wanted), 10.0, "");
            let row = worst.into_rows().remove(0);
            assert_eq!(row.verdict == Verdict::Pass, passes, "{off}");
        }
    }

    fn reference(name: &str) -> (Value, std::path::PathBuf) {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/cases/reference");
        let path = folder.join(format!("{name}.json"));
        let text = std::fs::read_to_string(&path).unwrap();
        (serde_json::from_str(&text).unwrap(), path)
    }
    fn failed(rows: &[Row]) -> Vec<&str> {
        let failed = rows.iter().filter(|row| row.verdict == Verdict::Fail);
        failed.map(|row| row.quantity.as_str()).collect()
    }

    #[test]
    fn the_levitated_rotor_passes_and_a_changed_gain_does_not() {
        let (mut file, path) = reference("machine_levitated");
        // one speed: the others are compared by `auxbear validate`
        file["results"].as_array_mut().unwrap().drain(..2);
        let found = rows(&file, &path).unwrap();
        assert_eq!(failed(&found), Vec::<&str>::new());
        assert!(found.len() > 20, "{}", found.len());
        file["magnets"][0]["ks"] = 1.6001e5.into();
        file.as_object_mut().unwrap().remove("impulse_response");
        let failed_now = rows(&file, &path).unwrap();
        assert!(failed(&failed_now).len() > 5);
    }

    #[test]
    fn the_start_of_a_drop_passes_and_what_is_wrong_with_a_file_is_told() {
        let (mut file, path) = reference("machine_drop_flexible");
        let found = start_of_drop(&file, &path).unwrap();
        assert_eq!(failed(&found), Vec::<&str>::new());
        file["magnets"][0]["sensor_node"] = 53.into();
        let refused = |path: &Path| match start_of_drop(&file, path) {
            Err(Refusal::Wrong(why)) => why,
            other => panic!("{other:?}"),
        };
        let wrong = refused(&path);
        assert!(wrong.contains("node 53, of 53 nodes"), "{wrong}");
        let lost = refused(Path::new("/nowhere/case.json"));
        assert!(
            lost.contains("ross_amb_rotor_freefree.json is neither beside"),
            "{lost}"
        );
    }
}
