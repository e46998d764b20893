//! The drop of a flexible rotor from its magnets onto its bearings: one run against an ensemble, within its spread and the floors that
//! the file states.

use super::given::{Coordinates, index, machine};
use super::run_to;
use crate::compare::{Refusal, never};
use crate::json::{list, number, pairs};
use crate::levitated;
use crate::report::{Row, Tolerance};
use model::auxiliary_bearing::probe::NORMAL_FORCE;
use model::system::machine::RotorMachine;
use model::system::machine::record::Record;
use serde_json::Value;
use solve::{Flow, Observer, Step};
use std::path::Path;

/// Free modes up to this are kept, rad/s.
const CUT: f64 = 6e4;
/// Tolerance of the steps.
const TOLERANCE: f64 = 1e-5;
/// The first part of a drop, s.
const FIRST: f64 = 0.05;
/// Grid on which the file takes the largest displacements, s.
const GRID: f64 = 5e-5;

pub(super) fn rows(file: &Value, path: &Path) -> Result<Vec<Row>, Refusal> {
    let mut rows = levitated::start_of_drop(file, path)?;
    if number(file, "tau_m")? > 0.0 && file["start"]["control_current_A"].is_null() {
        let why = "currents that decay need start.control_current_A, which the file does not have";
        rows.push(Row::not_run(why).of("quantities of the drop", ""));
        return Ok(rows);
    }
    let beta = [number(file, "beta_added")?, 0.0];
    let given = levitated::machine::Machine::of(file, path, beta)?;
    let mut kept: Vec<usize> = given.loaded().collect();
    for bearing in list(file, "bearings")? {
        kept.push(index(bearing, "node")?);
    }
    let mut rotor = given.rotor.clone();
    rotor.unbalance = given.unbalance.clone();
    let nodes = rotor.nodes.len();
    if let Some(node) = kept.iter().find(|node| **node >= nodes) {
        return Err(format!("node {node}, of {nodes} nodes").into());
    }
    let size = rotor.size();
    let shaft = Coordinates::reduced(rotor, CUT, kept)?;
    let mut constants = machine(file, &shaft, number(file, "Om")?)?;
    let middle = midspan(file, nodes)?;
    constants.rotor.places = vec![shaft.row(middle)];
    let machine = RotorMachine::new(constants);
    let position = shaft.of(&pairs(&file["start"], "q", size)?);
    let velocity = shaft.of(&pairs(&file["start"], "qd", size)?);
    let start = machine.start_with(&position, &velocity);
    rows.extend(run(file, &machine, start)?);
    Ok(rows)
}

/// The node whose largest displacement the file counts.
fn midspan(file: &Value, nodes: usize) -> Result<usize, String> {
    let text = file["quantities"]["largest"].as_str().unwrap_or_default();
    let named = text.rsplit("node ").find_map(|rest| {
        let digits = rest.split(|c: char| !c.is_ascii_digit()).next()?;
        digits.parse::<usize>().ok()
    });
    let named = named.ok_or("quantities.largest names no node")?;
    match named < nodes {
        true => Ok(named),
        false => Err(format!("node {named}, of {nodes} nodes")),
    }
}

/// What is counted besides what a run keeps: of each bearing.
#[derive(Clone, Default)]
struct Counted {
    impulse: f64,
    first_impulse: f64,
    contact_time: f64,
    backward_time: f64,
    ninety: Option<f64>,
    node: f64,
    outer: f64,
}

struct Watch {
    record: Record,
    speed: f64,
    bearings: Vec<Counted>,
    middle: f64,
    /// Points of the grid so far.
    points: f64,
}

impl Observer<RotorMachine> for Watch {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        let machine = step.machine;
        let length = step.end - step.start;
        let share = ((FIRST - step.start) / length).clamp(0.0, 1.0);
        for (k, own) in self.bearings.iter_mut().enumerate() {
            let at = machine.layout().bearings[k];
            let force =
                |step: &mut Step<RotorMachine>, theta| step.probe(theta, at.probe(NORMAL_FORCE));
            let ends = [
                step.start_probe(at.probe(NORMAL_FORCE)),
                step.end_probe(at.probe(NORMAL_FORCE)),
            ];
            if ends[0] > 0.0 || ends[1] > 0.0 {
                let middle = force(step, 0.5);
                let impulse = length * (ends[0] + 4.0 * middle + ends[1]) / 6.0;
                own.impulse += impulse;
                own.first_impulse += share * impulse;
                if middle > 0.0 {
                    let state = step.state(0.5);
                    let inner = at.motion(state).inner;
                    let node = machine.node(k, state);
                    let apart = node.position - inner.position;
                    let turning = apart.cross(node.velocity - inner.velocity);
                    own.contact_time += share * length;
                    if turning * self.speed < 0.0 {
                        own.backward_time += share * length;
                    }
                }
            }
            let spins = [
                step.start_state(at.inner.spin()),
                step.end_state(at.inner.spin()),
            ];
            let limit = 0.9 * self.speed;
            let part = (limit - spins[0]) / (spins[1] - spins[0]);
            if own.ninety.is_none() && (0.0..=1.0).contains(&part) {
                own.ninety = Some(step.start + part * length);
            }
        }
        while self.points * GRID <= step.end {
            let state = step.state((self.points * GRID - step.start) / length);
            for (k, own) in self.bearings.iter_mut().enumerate() {
                let node = machine.node(k, state).position;
                let outer = machine.layout().bearings[k].motion(state).outer.position;
                own.node = own.node.max(node.length_squared().sqrt());
                own.outer = own.outer.max(outer.length_squared().sqrt());
            }
            let middle = machine.place(0, state);
            self.middle = self.middle.max(middle.length_squared().sqrt());
            self.points += 1.0;
        }
        self.record.step(step)
    }
}

fn run(file: &Value, machine: &RotorMachine, start: Vec<f64>) -> Result<Vec<Row>, String> {
    let end = number(file, "T")?;
    let layout = machine.layout();
    let mut watch = Watch {
        record: Record::new(machine, end, end, false),
        speed: machine.constants.speed,
        bearings: vec![Counted::default(); layout.bearings.len()],
        middle: 0.0,
        points: 0.0,
    };
    let ending = run_to(end, machine, &start, (TOLERANCE, 1e-8), &mut watch)?;
    let state = &ending.state;
    let mut found: Vec<(String, &str, Option<f64>)> = Vec::new();
    let mut contacts = 0;
    for (k, (record, own)) in watch
        .record
        .bearings
        .iter()
        .zip(&watch.bearings)
        .enumerate()
    {
        let (at, name) = (layout.bearings[k], &machine.constants.bearings[k].name);
        contacts += record.contacts.len();
        let heat = |kind| layout.heat_of(state, name, kind);
        let contact = |i: usize| record.contacts.get(i);
        let first = number(file, "T")? >= FIRST;
        let within = |value: f64| first.then_some(value);
        for (key, unit, value) in [
            ("t_on_1", "s", contact(0).map(|c| c.start)),
            ("t_on_2", "s", contact(1).map(|c| c.start)),
            ("peak_1", "N", contact(0).map(|c| c.peak_force)),
            ("peak_2", "N", contact(1).map(|c| c.peak_force)),
            (
                "peak_all",
                "N",
                record.peak_contact_force().map(|p| p.value),
            ),
            ("impulse_50ms", "N s", within(own.first_impulse)),
            ("contact_time_50ms", "s", within(own.contact_time)),
            ("backward_time_50ms", "s", within(own.backward_time)),
            ("impulse", "N s", Some(own.impulse)),
            ("t_inner_50%", "s", record.inner_race_time_to_50_percent()),
            ("t_inner_90%", "s", own.ninety),
            ("friction_heat", "J", heat("rotor_race_friction")),
            ("inner_speed_end", "rad/s", Some(state[at.inner.spin()])),
            (
                "cage_speed_end",
                "rad/s",
                Some(machine.cage_speed(k, state)),
            ),
            ("mount_heat", "J", heat("mount_damping")),
            ("largest_node_displacement", "m", Some(own.node)),
            ("largest_outer_displacement", "m", Some(own.outer)),
        ] {
            found.push((format!("b{}_{key}", k + 1), unit, value));
        }
    }
    let heat = machine.flows(state).heat;
    found.extend([
        (
            "rotor_speed_end".to_string(),
            "rad/s",
            Some(state[layout.rotor.spin()]),
        ),
        ("heat".to_string(), "J", Some(heat)),
        ("n_contacts".to_string(), "", Some(contacts as f64)),
        (
            "largest_midspan_displacement".to_string(),
            "m",
            Some(watch.middle),
        ),
    ]);
    Ok(found
        .into_iter()
        .filter_map(|(key, unit, ours)| judged(file, &key, unit, ours))
        .collect())
}

/// A quantity against the ensemble; none where the file has none, or calls it no criterion.
fn judged(file: &Value, key: &str, unit: &str, ours: Option<f64>) -> Option<Row> {
    let mean = &file["mean"][key];
    if mean.is_null() && !file["mean"].as_object()?.contains_key(key) {
        return None;
    }
    let (Some(mean), Some(ours)) = (mean.as_f64(), ours) else {
        return Some(never(key, unit, mean.as_f64(), ours));
    };
    let spread = file["sd"][key].as_f64().unwrap_or(0.0);
    let kind = key.split_once('_').map_or(key, |(bearing, kind)| {
        match bearing
            .strip_prefix('b')
            .is_some_and(|n| n.parse::<u32>().is_ok())
        {
            true => kind,
            false => key,
        }
    });
    // a contact that splits
    let split = matches!(kind, "t_on_2" | "peak_2") && spread > 0.01 * mean.abs();
    if split {
        let why = "no criterion: it spreads by more than 1 %, a contact that splits";
        return Some(Row::not_run(why).of(key, unit));
    }
    let floor = match kind {
        "contact_time_50ms" | "backward_time_50ms" => 2e-4,
        "n_contacts" => 2.0,
        "peak_1" | "peak_2" | "peak_all" | "t_on_2" | "mount_heat" | "heat" => 1e-2 * mean.abs(),
        _ => 1e-3 * mean.abs(),
    };
    let allowed = Tolerance::Absolute(5.0 * spread + floor);
    let why = "5 standard deviations of the ensemble and the floor that the file states";
    Some(Row::compared(key, unit, mean, ours, allowed, why))
}
