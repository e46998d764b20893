//! Levitated rotors: closed loops (`machine_levitated.json`) and the start of a drop (`machine_drop_flexible.json`).
//!
//! A closed loop is compared in all coordinates of the rotor and in the reduced basis that runs use, each with the tolerances that
//! the files give for it. Complex numbers are compared part by part, each part with 1/√2 of the tolerance.

use super::compare::{Worst, part};
use super::report::{Row, Tolerance};
use super::rotor_file;
use levitation::response::{equilibrium, impulse, start, unbalance};
use levitation::sensitivity::{Axes, Band, Sensitivity};
use levitation::{
    Actuator, Amplifier, Axis, C64, ClosedLoop, Control, Levitation, Plant, Sensor, StateSpace,
    Timing, ZERO, weight,
};
use physics::magnet::Magnet;
use rotor::{Analysis, Basis, Matrices, Rotor, Unbalance};
use serde::Deserialize;
use serde_json::Value;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, TAU};
use std::path::Path;

const GRAVITY: [f64; 2] = [0.0, -9.81];
/// Free modes up to this, rad/s, and residual flexibility.
const CUT: f64 = 6e4;

/// Rows of a file; `None` when its keys are those of another.
pub(super) fn rows(value: &Value, path: &Path) -> Option<Vec<Row>> {
    let top = value.as_object()?;
    let has = |keys: &[&str]| keys.iter().all(|key| top.contains_key(*key));
    let found = if has(&["magnets", "results", "beta_external"]) {
        closed_loop(value, path)
    } else if has(&["magnets", "start", "beta_added", "bearings"]) {
        start_of_drop(value, path)
    } else {
        return None;
    };
    let damaged = |error| {
        let row = Row::wrong(format!("wrong: {error}"));
        vec![Row {
            damaged: true,
            ..row
        }]
    };
    Some(found.unwrap_or_else(damaged))
}

#[derive(Deserialize, Clone)]
struct Given {
    actuator_node: usize,
    sensor_node: usize,
    ki: f64,
    ks: f64,
    controller: Law,
}

#[derive(Deserialize, Clone)]
#[serde(deny_unknown_fields)]
struct Law {
    #[serde(rename = "Kp")]
    kp: f64,
    #[serde(rename = "Kd", default)]
    kd: f64,
    #[serde(rename = "Ki", default)]
    ki: f64,
    #[serde(rename = "Td", default)]
    td: f64,
    sensor_rad_s: Option<f64>,
    amplifier_rad_s: Option<f64>,
    #[serde(default)]
    delay_s: f64,
    #[serde(default)]
    biquads: Vec<Quotient>,
}

#[derive(Deserialize, Clone)]
struct Quotient {
    num: Vec<f64>,
    den: Vec<f64>,
}

#[derive(Deserialize)]
struct Plane {
    node: usize,
    kg_m: f64,
    phase_rad: f64,
}

/// A rotor with magnets, and what unbalances it.
struct Machine {
    rotor: Rotor,
    magnets: Vec<Given>,
    unbalance: Vec<Unbalance>,
}

/// The tolerances of a basis.
#[derive(Clone, Copy)]
struct Accept {
    name: &'static str,
    cut: f64,
    eigenvalues: f64,
    /// Of roots of filters far from the origin.
    filters: f64,
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
    sensitivity: 1e-6,
    peaks: 1e-5,
    unbalance: 1e-6,
    impulse: 1e-6,
    early_impulse: 1e-6,
};
const REDUCED: Accept = Accept {
    name: "free modes to 6e4 rad/s and residual flexibility",
    cut: CUT,
    eigenvalues: 1e-5,
    filters: 2e-4,
    sensitivity: 4e-5,
    peaks: 4e-5,
    unbalance: 2e-5,
    impulse: 1e-3,
    early_impulse: 5e-3,
};

impl Machine {
    fn of(value: &Value, path: &Path, beta: f64, rotating: f64) -> Result<Self, String> {
        let mut rotor = rotor_file::of(value, path)?;
        for element in &mut rotor.elements {
            element.damping_of_stiffness += beta;
            element.damping_rotating += rotating;
        }
        let planes: Vec<Plane> = part(&value["unbalance"])?;
        let magnets: Vec<Given> = part(&value["magnets"])?;
        let nodes = rotor.nodes.len();
        let of_magnets = magnets
            .iter()
            .flat_map(|m| [m.actuator_node, m.sensor_node]);
        let mut all = of_magnets.chain(planes.iter().map(|plane| plane.node));
        if let Some(node) = all.find(|node| *node >= nodes) {
            return Err(format!("node {node}, of {nodes} nodes"));
        }
        let unbalance = planes.iter().map(|plane| Unbalance {
            node: plane.node,
            amount: plane.kg_m,
            phase: plane.phase_rad,
        });
        Ok(Self {
            rotor,
            magnets,
            unbalance: unbalance.collect(),
        })
    }

    fn levitation(&self) -> Result<Levitation, String> {
        let (mut sensors, mut actuators, mut channels) = (Vec::new(), Vec::new(), Vec::new());
        for (number, given) in self.magnets.iter().enumerate() {
            let law = &given.controller;
            let built = || -> Result<StateSpace, levitation::Refused> {
                let mut channel = StateSpace::pid(law.kp, law.ki, law.kd, law.td)?;
                for filter in &law.biquads {
                    let next = StateSpace::rational("filter", &filter.num, &filter.den)?;
                    channel = channel.then(&next);
                }
                match law.delay_s {
                    0.0 => Ok(channel),
                    delay => Ok(channel.then(&StateSpace::pade("delay", delay)?)),
                }
            };
            let channel = built().map_err(|error| format!("magnets[{number}]: {error}"))?;
            for (letter, angle) in [("x", 0.0), ("y", FRAC_PI_2)] {
                let axis = |node| Axis {
                    name: format!("magnet {number} {letter}"),
                    node,
                    angle,
                };
                sensors.push(Sensor {
                    axis: axis(given.sensor_node),
                    corner: law.sensor_rad_s,
                    offset: 0.0,
                    reference: 0.0,
                });
                actuators.push(Actuator {
                    axis: axis(given.actuator_node),
                    magnet: Magnet::Linear {
                        current_stiffness: given.ki,
                        position_stiffness: given.ks,
                    },
                    amplifier: match law.amplifier_rad_s {
                        Some(bandwidth) => Amplifier::Current { bandwidth },
                        None => Amplifier::Direct,
                    },
                });
                channels.push(channel.clone());
            }
        }
        let timing = Timing::Continuous { delay: 0.0 };
        let nodes = self.rotor.nodes.len();
        Levitation::new(
            nodes,
            sensors,
            Control::Channels(channels),
            timing,
            actuators,
        )
        .map_err(|error| error.to_string())
    }

    fn analysis(&self, cut: f64) -> Result<Analysis, String> {
        let matrices = Matrices::new(&self.rotor);
        let mut basis = Basis::full(&self.rotor, &matrices).map_err(|error| error.to_string())?;
        if cut.is_finite() {
            let nodes = self
                .magnets
                .iter()
                .flat_map(|m| [m.actuator_node, m.sensor_node]);
            let mut kept: Vec<usize> = nodes.chain(self.unbalance.iter().map(|u| u.node)).collect();
            kept.sort_unstable();
            kept.dedup();
            let kept: Vec<usize> = kept
                .iter()
                .map(|node| self.rotor.displacement(*node))
                .collect();
            let forces = rotor::unit_forces(self.rotor.size(), &kept);
            basis = basis.reduced(cut, &forces);
        }
        Ok(Analysis::new(&self.rotor, &matrices, basis))
    }

    /// Both axes of every magnet in one plane.
    fn turning(&self, analysis: &Analysis, speed: f64) -> Result<ClosedLoop<C64>, String> {
        let nodes = self.rotor.nodes.len();
        let plant = Plant::turning(analysis, nodes, speed).ok_or("supports that do not turn")?;
        let plane = self.levitation()?.one_plane().ok_or("axes that differ")?;
        ClosedLoop::new(plant, &plane).map_err(|error| error.to_string())
    }

    fn planes(&self, analysis: &Analysis, speed: f64) -> Plant<f64> {
        Plant::planes(analysis, self.rotor.nodes.len(), speed)
    }
}

/// Adds both parts of a complex number, compared with a tolerance on its distance.
fn add(worst: &mut Worst, name: &str, unit: &str, pair: (C64, C64), allowed: f64, why: &str) {
    let (ours, wanted) = pair;
    let tolerance = Tolerance::Absolute(allowed * FRAC_1_SQRT_2);
    for (word, ours, wanted) in [
        ("real", ours.re, wanted.re),
        ("imaginary", ours.im, wanted.im),
    ] {
        let name = format!("{name}, {word} part");
        worst.add(Row::compared(name, unit, wanted, ours, tolerance, why));
    }
}

fn complex(pair: &[f64; 2]) -> C64 {
    C64::new(pair[0], pair[1])
}
fn largest<'a>(all: impl Iterator<Item = &'a [f64; 2]>) -> f64 {
    all.map(|pair| complex(pair).norm()).fold(0.0, f64::max)
}

#[derive(Deserialize)]
struct Loop {
    beta_external: f64,
    beta_internal: f64,
    results: Vec<AtSpeed>,
    open_loop_largest_real_part: Option<f64>,
    static_values: Option<Standing>,
    impulse_response: Option<Struck>,
    zero_stiffness_check: Option<ZeroCheck>,
}

#[derive(Deserialize)]
struct AtSpeed {
    speed_rad_s: f64,
    eigenvalues: Vec<[f64; 2]>,
    #[serde(default)]
    sensitivity_samples: Vec<Sample>,
    #[serde(default)]
    sensitivity_peak: Vec<PeakOf>,
    unbalance_response: Option<Standing>,
}

#[derive(Deserialize)]
struct Sample {
    rad_s: f64,
    #[serde(rename = "S")]
    sizes: Vec<f64>,
}

#[derive(Deserialize)]
struct PeakOf {
    magnet: usize,
    #[serde(rename = "S")]
    size: f64,
    at_rad_s: f64,
}

/// Displacements of nodes and currents of magnets.
#[derive(Deserialize)]
struct Standing {
    nodes: Vec<usize>,
    w: Vec<[f64; 2]>,
    #[serde(rename = "current_A")]
    currents: Vec<[f64; 2]>,
}

#[derive(Deserialize)]
struct Struck {
    text: String,
    speed_rad_s: f64,
    nodes: Vec<usize>,
    rows: Vec<StruckRow>,
}

#[derive(Deserialize)]
struct StruckRow {
    t: f64,
    w: Vec<[f64; 2]>,
    #[serde(rename = "current_A")]
    currents: Vec<[f64; 2]>,
}

#[derive(Deserialize)]
struct ZeroCheck {
    #[serde(rename = "Kp")]
    kp: f64,
    sensors_of_this_file: Zeros,
    sensors_at_the_actuator_nodes: Zeros,
}

#[derive(Deserialize)]
struct Zeros {
    eigenvalues_at_zero: usize,
    next: [f64; 2],
    largest_other_real_part: f64,
}

fn closed_loop(value: &Value, path: &Path) -> Result<Vec<Row>, String> {
    let file: Loop = part(value)?;
    let machine = Machine::of(value, path, file.beta_external, file.beta_internal)?;
    let mut worst = Worst::default();
    for accept in [WHOLE, REDUCED] {
        let analysis = machine.analysis(accept.cut)?;
        for result in &file.results {
            let closed = machine.turning(&analysis, result.speed_rad_s)?;
            at_speed(&machine, &closed, result, accept, &mut worst)?;
        }
        if let Some(struck) = &file.impulse_response {
            let closed = machine.turning(&analysis, struck.speed_rad_s)?;
            after_impulse(&closed, struck, accept, &mut worst)?;
        }
    }
    let whole = machine.analysis(f64::INFINITY)?;
    if let Some(wanted) = file.open_loop_largest_real_part {
        let open = machine.turning(&whole, 0.0)?.open_loop();
        let open = open.map_err(|error| error.to_string())?;
        let ours = open.iter().map(|value| value.re).fold(f64::MIN, f64::max);
        let why = "largest Re λ without control current, at standstill; 1e-6 of the file";
        let tolerance = Tolerance::Relative(1e-6);
        let name = "open loop, largest real part";
        worst.add(Row::compared(name, "1/s", wanted, ours, tolerance, why));
    }
    if let Some(standing) = &file.static_values {
        at_rest(&machine, &whole, standing, &mut worst)?;
    }
    if let Some(check) = &file.zero_stiffness_check {
        zero_stiffness(&machine, &whole, check, &mut worst)?;
    }
    Ok(worst.into_rows())
}

fn at_speed(
    machine: &Machine,
    closed: &ClosedLoop<C64>,
    result: &AtSpeed,
    accept: Accept,
    worst: &mut Worst,
) -> Result<(), String> {
    let told = |error: levitation::Refused| error.to_string();
    let (speed, basis) = (result.speed_rad_s, accept.name);
    let why = format!("{speed:.1} rad/s; {basis}; tolerance of the file");
    let poles = closed.poles().map_err(told)?;
    for wanted in result.eigenvalues.iter().map(complex) {
        let distance = |pole: &&levitation::Pole| (pole.value - wanted).norm();
        let nearest = poles
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let ours = nearest.ok_or("a loop without eigenvalues")?.value;
        let share = if wanted.re < -2.5e4 {
            accept.filters
        } else {
            accept.eigenvalues
        };
        let allowed = share * wanted.norm() + 1e-5;
        let name = format!("eigenvalues, {basis}");
        add(worst, &name, "1/s", (ours, wanted), allowed, &why);
    }
    let axes = Axes::new(closed).map_err(told)?;
    for sample in &result.sensitivity_samples {
        let ours = axes.at(sample.rad_s).map_err(told)?;
        for (ours, wanted) in ours.iter().zip(&sample.sizes) {
            let why = format!("at {} rad/s, {why}", sample.rad_s);
            let tolerance = Tolerance::Relative(accept.sensitivity);
            let name = format!("sensitivity, {basis}");
            worst.add(Row::compared(
                name,
                "",
                *wanted,
                ours.norm(),
                tolerance,
                why,
            ));
        }
    }
    let band = Band {
        from: TAU,
        to: TAU * 3000.0,
    };
    if !result.sensitivity_peak.is_empty() {
        let found = Sensitivity::new(closed, &poles, band).map_err(told)?;
        for wanted in &result.sensitivity_peak {
            let ours = found
                .peaks
                .get(wanted.magnet)
                .ok_or("a peak of no magnet")?;
            for (word, unit, wanted, ours, share) in [
                ("peak", "", wanted.size, ours.size, accept.peaks),
                ("frequency of peak", "rad/s", wanted.at_rad_s, ours.at, 1e-4),
            ] {
                let name = format!("sensitivity, {word}, {basis}");
                let tolerance = Tolerance::Relative(share);
                worst.add(Row::compared(
                    name,
                    unit,
                    wanted,
                    ours,
                    tolerance,
                    why.as_str(),
                ));
            }
        }
    }
    if let Some(wanted) = &result.unbalance_response {
        let ours = unbalance(closed, &machine.unbalance, speed).map_err(told)?;
        let allowed = accept.unbalance * largest(wanted.w.iter());
        for (node, w) in wanted.nodes.iter().zip(&wanted.w) {
            let ours = *ours.forward.get(*node).ok_or("a node that is not there")?;
            let name = format!("unbalance response, {basis}");
            add(worst, &name, "m", (ours, complex(w)), allowed, &why);
        }
        let allowed = accept.unbalance * largest(wanted.currents.iter());
        for (ours, wanted) in ours.currents.iter().zip(&wanted.currents) {
            let name = format!("unbalance current, {basis}");
            add(worst, &name, "A", (*ours, complex(wanted)), allowed, &why);
        }
    }
    Ok(())
}

fn after_impulse(
    closed: &ClosedLoop<C64>,
    struck: &Struck,
    accept: Accept,
    worst: &mut Worst,
) -> Result<(), String> {
    let times: Vec<f64> = struck.rows.iter().map(|row| row.t).collect();
    let said = |word: &str| number_after(&struck.text, word);
    let node = said("node").filter(|node| (*node as usize) < closed.plant().nodes.nrows());
    let (Some(size), Some(node)) = (said("impulse"), node) else {
        return Err("an impulse_response whose text says no \"impulse … node …\"".into());
    };
    let states = impulse(closed, node as usize, size, &times).map_err(|error| error.to_string())?;
    let moved = largest(struck.rows.iter().flat_map(|row| &row.w));
    let current = largest(struck.rows.iter().flat_map(|row| &row.currents));
    for (row, state) in struck.rows.iter().zip(&states) {
        let share = if row.t < 1e-3 {
            accept.early_impulse
        } else {
            accept.impulse
        };
        let why = format!(
            "{} s after {size} N s at node {node}; {}; tolerance of the file",
            row.t, accept.name
        );
        let w = closed.displacements(state);
        for (node, wanted) in struck.nodes.iter().zip(&row.w) {
            let ours = *w.get(*node).ok_or("a node that is not there")?;
            let name = format!("impulse response, {}", accept.name);
            add(
                worst,
                &name,
                "m",
                (ours, complex(wanted)),
                share * moved,
                &why,
            );
        }
        for (ours, wanted) in closed.currents(state).into_iter().zip(&row.currents) {
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
    standing: &Standing,
    worst: &mut Worst,
) -> Result<(), String> {
    let loads = weight(&machine.rotor, analysis, GRAVITY);
    let plant = machine.planes(analysis, 0.0);
    let ours = equilibrium(&plant, &machine.levitation()?, &loads);
    let ours = ours.map_err(|error| error.to_string())?;
    let why =
        "under gravity with integrators; 1e-6 of the largest and 1e-13 m, tolerance of the file";
    let allowed = 1e-6 * largest(standing.w.iter()) + 1e-13;
    for (node, wanted) in standing.nodes.iter().zip(&standing.w) {
        if *node >= machine.rotor.nodes.len() {
            return Err(format!("no node {node}"));
        }
        let along = |angle: f64| (plant.row(*node, angle) * &ours.coordinates)[0];
        let w = C64::new(along(0.0), along(FRAC_PI_2));
        add(
            worst,
            "static position",
            "m",
            (w, complex(wanted)),
            allowed,
            why,
        );
    }
    let allowed = 1e-6 * largest(standing.currents.iter());
    for (pair, wanted) in ours.currents.chunks(2).zip(&standing.currents) {
        let i = C64::new(pair[0], pair[1]);
        add(
            worst,
            "static current",
            "A",
            (i, complex(wanted)),
            allowed,
            why,
        );
    }
    Ok(())
}

fn zero_stiffness(
    machine: &Machine,
    analysis: &Analysis,
    check: &ZeroCheck,
    worst: &mut Worst,
) -> Result<(), String> {
    for (collocated, wanted) in [
        (false, &check.sensors_of_this_file),
        (true, &check.sensors_at_the_actuator_nodes),
    ] {
        let mut magnets = machine.magnets.clone();
        for magnet in &mut magnets {
            (magnet.controller.kp, magnet.controller.ki) = (check.kp, 0.0);
            if collocated {
                magnet.sensor_node = magnet.actuator_node;
            }
        }
        let changed = Machine {
            rotor: machine.rotor.clone(),
            magnets,
            unbalance: Vec::new(),
        };
        let closed = changed.turning(analysis, 0.0)?;
        let poles = closed.poles().map_err(|error| error.to_string())?;
        let (zeros, others): (Vec<C64>, Vec<C64>) =
            (poles.iter().map(|pole| pole.value)).partition(|value| value.norm() < ZERO);
        let place = if collocated {
            "at the magnets"
        } else {
            "of the file"
        };
        let why = format!(
            "sensors {place}, K_p = k_s/k_i without integrator, standstill; tolerance of the file"
        );
        let count = (wanted.eigenvalues_at_zero as f64, zeros.len() as f64);
        let exact = Tolerance::Absolute(0.0);
        let name = "eigenvalues at zero without static stiffness";
        worst.add(Row::compared(
            name,
            "",
            count.0,
            count.1,
            exact,
            why.as_str(),
        ));
        let next = *others.first().ok_or("nothing but zeros")?;
        let reference = complex(&wanted.next);
        let name = "next eigenvalue without static stiffness";
        let pair = (next, reference);
        add(worst, name, "1/s", pair, 1e-6 * reference.norm(), &why);
        let ours = others.iter().map(|value| value.re).fold(f64::MIN, f64::max);
        let name = "largest other real part without static stiffness";
        let tolerance = Tolerance::Relative(1e-6);
        worst.add(Row::compared(
            name,
            "1/s",
            wanted.largest_other_real_part,
            ours,
            tolerance,
            why,
        ));
    }
    Ok(())
}

#[derive(Deserialize)]
struct Drop {
    beta_added: f64,
    #[serde(rename = "Om")]
    speed: f64,
    gravity: [f64; 2],
    start: DropStart,
}

#[derive(Deserialize)]
struct DropStart {
    q: Vec<[f64; 2]>,
    qd: Vec<[f64; 2]>,
    #[serde(rename = "control_current_A")]
    currents: Vec<[f64; 2]>,
}

/// The start of a drop in closed form; the drop itself is not run.
fn start_of_drop(value: &Value, path: &Path) -> Result<Vec<Row>, String> {
    let file: Drop = part(value)?;
    let machine = Machine::of(value, path, file.beta_added, 0.0)?;
    let analysis = machine.analysis(f64::INFINITY)?;
    let loads = weight(&machine.rotor, &analysis, file.gravity);
    let plant = machine.planes(&analysis, file.speed);
    let levitation = machine.levitation()?;
    let ours = start(
        &plant,
        &levitation,
        &loads,
        &machine.unbalance,
        file.speed,
        0.0,
    );
    let ours = ours.map_err(|error| error.to_string())?;
    let (size, shapes) = (analysis.basis.len(), &analysis.basis.shapes);
    if [&file.start.q, &file.start.qd]
        .iter()
        .any(|list| list.len() != shapes.nrows())
    {
        return Err(format!("a start of another size than {}", shapes.nrows()));
    }
    let why = "static position and synchronous motion in closed form; 1e-6 of the largest of its kind: the reference is of double precision";
    let mut worst = Worst::default();
    for (name, units, values, wanted) in [
        (
            "position at the start",
            ["m", "rad"],
            &ours.coordinates,
            &file.start.q,
        ),
        (
            "velocity at the start",
            ["m/s", "rad/s"],
            &ours.rates,
            &file.start.qd,
        ),
    ] {
        let (x, y) = (
            shapes * values.rows(0, size),
            shapes * values.rows(size, size),
        );
        for (kind, word) in ["displacement", "slope"].into_iter().enumerate() {
            let allowed = 1e-6 * largest(wanted.iter().skip(kind).step_by(2));
            for (k, wanted) in wanted.iter().enumerate().skip(kind).step_by(2) {
                let name = format!("{name}, {word}");
                let pair = (C64::new(x[k], y[k]), complex(wanted));
                add(&mut worst, &name, units[kind], pair, allowed, why);
            }
        }
    }
    let allowed = 1e-6 * largest(file.start.currents.iter());
    for (pair, wanted) in ours.currents.chunks(2).zip(&file.start.currents) {
        let i = C64::new(pair[0], pair[1]);
        add(
            &mut worst,
            "current at the start",
            "A",
            (i, complex(wanted)),
            allowed,
            why,
        );
    }
    let mut rows = worst.into_rows();
    rows.push(
        Row::not_run("the drop of a bent rotor onto its bearings is not modelled yet")
            .of("quantities of the drop", ""),
    );
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::super::report::Verdict;
    use super::*;

    fn reference(name: &str) -> Option<(Value, std::path::PathBuf)> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/cases/reference");
        let path = folder.join(format!("{name}.json"));
        let Ok(text) = std::fs::read_to_string(&path) else {
            println!("DID NOT RUN: the reference files are not beside this repository");
            return None;
        };
        Some((serde_json::from_str(&text).unwrap(), path))
    }
    fn failed(rows: &[Row]) -> Vec<&str> {
        let failed = rows.iter().filter(|row| row.verdict == Verdict::Fail);
        failed.map(|row| row.quantity.as_str()).collect()
    }

    #[test]
    fn the_levitated_rotor_passes_and_a_changed_gain_does_not() {
        let Some((mut file, path)) = reference("machine_levitated") else {
            return;
        };
        // one speed: the others are compared by `auxbear validate`
        file["results"].as_array_mut().unwrap().drain(..2);
        let found = rows(&file, &path).unwrap();
        assert_eq!(failed(&found), Vec::<&str>::new());
        assert!(found.len() > 30, "{}", found.len());
        file["magnets"][0]["ks"] = 1.6001e5.into();
        file.as_object_mut().unwrap().remove("impulse_response");
        let failed_now = rows(&file, &path).unwrap();
        assert!(failed(&failed_now).len() > 10);
    }

    #[test]
    fn the_start_of_a_drop_passes_and_what_is_wrong_with_a_file_is_told() {
        let Some((mut file, path)) = reference("machine_drop_flexible") else {
            return;
        };
        let found = rows(&file, &path).unwrap();
        assert_eq!(failed(&found), Vec::<&str>::new());
        file["magnets"][0]["sensor_node"] = 53.into();
        let wrong = rows(&file, &path).unwrap();
        assert!(wrong[0].damaged && wrong[0].why.contains("node 53, of 53 nodes"));
        let lost = rows(&file, Path::new("/nowhere/case.json")).unwrap();
        assert!(
            lost[0]
                .why
                .contains("ross_amb_rotor_freefree.json is neither beside")
        );
    }
}
