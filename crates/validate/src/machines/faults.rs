//! A rotor on magnets to which something happens (`faults_runs.json`): axes lost, sensors and controllers that fail, limits, samples,
//! a rotor that is levitated again. The spin is held, the stops are without friction: auxiliary bearings whose races do not move.

use super::faults_given::{changes, levitation};
use super::faults_watch::Watch;
use super::given::{Coordinates, index};
use super::run_to;
use super::run_up::idle;
use crate::compare::{Refusal, Worst};
use crate::json::{array, list, number, pairs};
use crate::levitated::machine::rotor_beside;
use crate::report::{Row, Tolerance};
use crate::simulation::falling_machine;
use levitation::response::{equilibrium, start};
use levitation::{C64, ClosedLoop, Levitation, Plant, weight};
use model::base::{BaseConstants, HalfSine};
use model::magnets::conditions::{Change, What};
use model::magnets::{
    AxisConstants, ControlConstants, ControlEvent, MagnetConstants, MagnetsConstants,
    SupplyConstants,
};
use model::schedule::Schedule;
use model::system::machine::{Event, RotorMachine};
use model::table::Table;
use nalgebra::{DMatrix, DVector};
use number::Vec2;
use rotor::{Analysis, Unbalance};
use serde_json::Value;
use std::path::Path;

/// Free modes up to this are kept, rad/s.
const CUT: f64 = 6e4;
/// Tolerance of the steps.
const TOLERANCE: f64 = 4e-9;
/// Share of the clearance of stops that are not there, m.
const FAR: f64 = 0.1;

pub(super) fn rows(file: &Value, path: &Path) -> Result<Vec<Row>, Refusal> {
    let mut worst = Worst::default();
    for case in list(file, "cases")? {
        let name = case["inputs"]["name"].as_str().unwrap_or("unnamed");
        let run = Run::of(&case["inputs"], path)?;
        run.compare(name, case, &mut worst)?;
    }
    Ok(worst.into_rows())
}

/// The motion of the base of a run.
fn base(shock: &Value) -> Result<Option<BaseConstants>, String> {
    if shock.is_null() {
        return Ok(None);
    }
    let [x, y] = array(shock, "acceleration")?;
    let half_sine = HalfSine {
        start: number(shock, "t")?,
        duration: number(shock, "duration_s")?,
        acceleration: Vec2::new(x, y),
    };
    Ok(Some(BaseConstants {
        record: [0, 1].map(|_| Table::constant(0.0)),
        shocks: vec![half_sine],
    }))
}

/// Coordinates, their rates and the states of the levitation.
type Start = (Vec<Vec2<f64>>, Vec<Vec2<f64>>, Vec<f64>);

/// A run of the file.
struct Run<'a> {
    given: &'a Value,
    shaft: Coordinates,
    levitation: Levitation,
    changes: Vec<(f64, Change)>,
    speed: f64,
    gravity: Vec2<f64>,
}

impl<'a> Run<'a> {
    fn of(given: &'a Value, path: &Path) -> Result<Self, Refusal> {
        let mut rotor = rotor_beside("ross_amb_rotor_freefree.json", path)?;
        for element in &mut rotor.elements {
            element.damping_of_mass = 2.5;
            element.damping_of_stiffness = 1e-6;
        }
        for plane in list(given, "unbalance")? {
            rotor.unbalance.push(Unbalance {
                node: index(plane, "node")?,
                amount: number(plane, "kg_m")?,
                phase: number(plane, "phase_rad")?,
            });
        }
        let mut kept: Vec<usize> = rotor.unbalance.iter().map(|plane| plane.node).collect();
        for magnet in list(given, "magnets")? {
            kept.extend([
                index(magnet, "actuator_node")?,
                index(magnet, "sensor_node")?,
            ]);
        }
        for node in list(given, "stop_nodes")? {
            kept.push(node.as_u64().ok_or("a node that is no number")? as usize);
        }
        let nodes = rotor.nodes.len();
        let levitation = levitation(given, nodes)?;
        let [x, y] = array(given, "gravity")?;
        Ok(Run {
            given,
            changes: changes(given)?,
            levitation,
            shaft: Coordinates::reduced(rotor, CUT, kept)?,
            speed: number(given, "speed_rad_s")?,
            gravity: Vec2::new(x, y),
        })
    }

    fn nodes(&self, key: &str) -> Result<Vec<usize>, String> {
        let nodes = list(self.given, key)?.iter();
        let nodes = nodes.map(|node| node.as_u64().map(|node| node as usize));
        nodes
            .collect::<Option<_>>()
            .ok_or(format!("{key} is no list of nodes"))
    }

    /// The rotor and its levitation, both planes.
    fn plant(&self) -> (Analysis, Plant<f64>) {
        let analysis = Analysis::new(
            &self.shaft.rotor,
            &self.shaft.matrices,
            self.shaft.basis.clone(),
        );
        let plant = Plant::planes(&analysis, self.shaft.rotor.nodes.len(), self.speed);
        (analysis, plant)
    }

    fn machine(&self) -> Result<(RotorMachine, Vec<f64>), String> {
        let (analysis, plant) = self.plant();
        let loads = weight(
            &self.shaft.rotor,
            &analysis,
            [self.gravity.x, self.gravity.y],
        );
        let size = self.shaft.basis.len();
        let on_stops = self.given["start"] == "rest_on_stops";
        let (position, velocity, states) = match on_stops {
            true => self.on_stops(&loads)?,
            false => {
                let found = start(
                    &plant,
                    &self.levitation,
                    &loads,
                    &self.shaft.rotor.unbalance,
                    self.speed,
                    0.0,
                );
                let found = found.map_err(|error| error.to_string())?;
                let planes = |list: &DVector<f64>| -> Vec<Vec2<f64>> {
                    (0..size)
                        .map(|k| Vec2::new(list[k], list[size + k]))
                        .collect()
                };
                (
                    planes(&found.coordinates),
                    planes(&found.rates),
                    found.states,
                )
            }
        };
        let magnets: Vec<_> = list(self.given, "magnets")?.iter().enumerate().collect();
        let along = |angle: f64| Vec2::new(angle.cos(), angle.sin());
        let magnet = |(k, given): &(usize, &Value)| {
            let axis = |axis: usize| AxisConstants {
                direction: along(self.levitation.actuators()[axis].axis.angle),
                law: self.levitation.actuators()[axis].magnet,
                current: 0.0,
            };
            Ok(MagnetConstants {
                node: self.shaft.row(index(given, "actuator_node")?),
                axes: vec![axis(2 * k), axis(2 * k + 1)],
            })
        };
        let sensor = |(k, given): &(usize, &Value)| {
            let along = |axis: usize| along(self.levitation.sensors()[axis].axis.angle);
            let directions = vec![along(2 * k), along(2 * k + 1)];
            Ok((self.shaft.row(index(given, "sensor_node")?), directions))
        };
        let mut changes: Vec<(f64, Change)> = self.changes.clone();
        if on_stops {
            let (_, first) = magnets[0];
            let all = || (0..2 * magnets.len()).collect::<Vec<_>>();
            let lost = What::Lost {
                decay_rate: f64::INFINITY,
            };
            let again = What::Levitated {
                bias_rate: 1.0 / number(first, "tau_b")?,
                reference_rate: f64::INFINITY,
            };
            for what in [lost, again] {
                changes.push((0.0, Change { what, axes: all() }));
            }
        }
        let sensors = magnets.iter().map(sensor).collect::<Result<_, String>>()?;
        let own = changes.iter().map(|(_, change)| change.clone()).collect();
        let control = ControlConstants::new(self.levitation.clone(), sensors, states, own);
        let end = number(self.given, "t_end")?;
        let event = |(k, (time, _)): (usize, &(f64, Change))| {
            (*time, Event::Control(ControlEvent::Change(k)))
        };
        let samples = control.samples(0.0, end).into_iter();
        let samples = samples.map(|(time, event)| (time, Event::Control(event)));
        let times = list(self.given, "times")?.iter().filter_map(Value::as_f64);
        let knots = times.map(|time| (time, Event::Knot));
        let mut constants = falling_machine(1.0, 1e7, 5e-3, 0.0)?.constants;
        constants.base = base(&self.given["base_shock"])?;
        let shaken = constants.base.iter().flat_map(BaseConstants::knots);
        let knots = knots.chain(shaken.map(|time| (time, Event::Knot)));
        let events = changes.iter().enumerate().map(event);
        constants.schedule = Schedule::of(events.chain(samples).chain(knots));
        constants.magnets = Some(MagnetsConstants {
            magnets: magnets.iter().map(magnet).collect::<Result<_, String>>()?,
            supply: SupplyConstants::Control(control),
        });
        constants.rotor = self.shaft.constants();
        constants.rotor.spin_held = true;
        constants.rotor.places = (self.nodes("nodes")?.iter())
            .map(|node| self.shaft.row(*node))
            .collect();
        constants.gravity = self.gravity;
        constants.speed = self.speed;
        let stop = &self.given["stop"];
        let part = constants.bearings[0].clone();
        constants.bearings = (self.nodes("stop_nodes")?.iter())
            .map(|node| {
                let mut part = part.clone();
                part.node = self.shaft.row(*node);
                part.name = format!("at_{node}");
                part.bearing = idle();
                part.inner_race.centre_held = true;
                let contact = &mut part.contact;
                let given = |key: &str, or: f64| stop[key].as_f64().unwrap_or(or);
                contact.radial_clearance = given("gap", FAR);
                contact.stiffness = given("k", 1e7);
                (contact.exponent, contact.damping, contact.friction) = (1.0, given("a", 0.0), 0.0);
                part
            })
            .collect();
        let machine = RotorMachine::new(constants);
        let start = machine.start_with(&position, &velocity);
        Ok((machine, start))
    }

    /// Coordinates of a rotor that lies on both stops, along gravity.
    fn on_stops(&self, loads: &DVector<f64>) -> Result<Start, String> {
        let size = self.shaft.basis.len();
        let (gap, k) = (
            number(&self.given["stop"], "gap")?,
            number(&self.given["stop"], "k")?,
        );
        let nodes = self.nodes("stop_nodes")?;
        let whole = size + nodes.len();
        let (mut left, mut right) = (DMatrix::zeros(whole, whole), DVector::zeros(whole));
        for (k, frequency) in self.shaft.basis.frequencies.iter().enumerate() {
            left[(k, k)] = frequency * frequency;
            right[k] = loads[size + k];
        }
        for (s, node) in nodes.iter().enumerate() {
            for (j, shape) in self.shaft.row(*node).into_iter().enumerate() {
                left[(size + s, j)] = shape;
                left[(j, size + s)] = -shape;
            }
            left[(size + s, size + s)] = 1.0 / k;
            right[size + s] = -gap;
        }
        let found = left.lu().solve(&right).ok_or("no rest on the stops")?;
        let position: Vec<_> = (0..size).map(|k| Vec2::new(0.0, found[k])).collect();
        let still = vec![Vec2::zero(); size];
        Ok((position, still, vec![0.0; self.levitation.states()]))
    }

    fn compare(&self, name: &str, case: &Value, worst: &mut Worst) -> Result<(), String> {
        let (machine, start) = self.machine()?;
        let results = &case["results"];
        let times = list(self.given, "times")?.iter().filter_map(Value::as_f64);
        let mut watch = Watch::new(&machine, times.collect(), self.given)?;
        watch.look(&machine, 0.0, &start);
        let end = number(self.given, "t_end")?;
        let ending = run_to(end, &machine, &start, (TOLERANCE, 1e-8), &mut watch);
        let ending = ending.map_err(|why| format!("{name}: {why}"))?;
        let tolerances = &case["tolerances"];
        let why = "tolerance of the file";
        let mut add = |what: &str, unit: &str, pair: [f64; 2], allowed: &Value| {
            let Some(allowed) = allowed.as_f64() else {
                return;
            };
            let [wanted, ours] = pair;
            let allowed = Tolerance::Absolute(allowed);
            worst.add(Row::compared(
                format!("{name}: {what}"),
                unit,
                wanted,
                ours,
                allowed,
                why,
            ));
        };
        for (k, row) in list(results, "rows")?.iter().enumerate() {
            let seen = watch
                .rows
                .get(k)
                .ok_or("a row that the run did not come to")?;
            let wanted = pairs(row, "w", seen.places.len())?;
            for (wanted, ours) in wanted.iter().zip(&seen.places) {
                for pair in [[wanted.x, ours.x], [wanted.y, ours.y]] {
                    add("displacements", "m", pair, &tolerances["w_m"][k]);
                }
            }
            for (wanted, ours) in list(row, "current_A")?.iter().zip(&seen.currents) {
                for pair in currents(wanted, ours) {
                    add("currents", "A", pair, &tolerances["current_A"][k]);
                }
            }
        }
        for (k, ours) in watch.peaks.iter().enumerate() {
            let wanted = results["peak_w"][k].as_f64().unwrap_or(f64::NAN);
            add(
                "largest displacements",
                "m",
                [wanted, *ours],
                &tolerances["peak_w_m"][k],
            );
        }
        for (k, ours) in watch.largest.iter().enumerate() {
            let tolerance = one_of(&tolerances["peak_current_A"], k);
            for pair in currents(&results["peak_current_A"][k], ours) {
                add("largest currents", "A", pair, tolerance);
            }
        }
        for (k, ours) in watch.crossed.iter().enumerate() {
            let wanted = &results["first_crossing"][k];
            let tolerance = one_of(&tolerances["first_crossing_s"], k);
            // what is never there must not be
            let never = |value: Option<f64>| value.unwrap_or(-1.0);
            let pair = [never(wanted.as_f64()), never(*ours)];
            add("first crossing", "s", pair, tolerance);
        }
        for (of, ours) in watch.outside.iter().enumerate() {
            for (k, ours) in ours.iter().enumerate() {
                let key = ["last_outside", "last_outside_2"][of];
                let wanted = results[key][k].as_f64().unwrap_or(-1.0);
                let tolerance = &tolerances["last_outside_s"][of][k];
                add(
                    "last outside",
                    "s",
                    [wanted, ours.unwrap_or(-1.0)],
                    tolerance,
                );
            }
        }
        let layout = machine.layout();
        let ledger = layout.of_rotor;
        let channel = |at: Option<usize>, heat: bool| {
            at.map_or(0.0, |at| {
                ending.state[if heat {
                    layout.heat(at)
                } else {
                    layout.source(at)
                }]
            })
        };
        let stop: f64 = (machine.constants.bearings.iter())
            .filter_map(|part| layout.heat_of(&ending.state, &part.name, "rotor_race_damping"))
            .sum();
        for (what, key, ours) in [
            (
                "work of the magnets",
                "magnets",
                channel(ledger.magnets, false),
            ),
            (
                "work of the base",
                "base",
                channel(ledger.base, false) - self.base_on_unbalance(&machine, end),
            ),
            (
                "heat of damping",
                "heat_damping",
                channel(ledger.damping, true),
            ),
            ("heat of the stops", "heat_stop", stop),
        ] {
            let wanted = number(&results["ledger"], key)?;
            add(what, "J", [wanted, ours], &tolerances["ledger_J"]);
        }
        let balance = machine.balance(&start, &ending.state);
        let ((before, _), (after, _)) = (balance.start, balance.end);
        let stored = (after.translation - before.translation).abs()
            + (after.spin - before.spin).abs()
            + (after.potential - before.potential).abs();
        worst.add(Row::compared(
            format!("{name}: energy that does not close"),
            "J",
            0.0,
            balance.energy_residual(),
            Tolerance::Absolute(1e-6 * (balance.work_size() + balance.heat() + stored)),
            "1e-6 of what flows and of what is stored elsewhere",
        ));
        self.verdict(name, results, &watch, end, worst)?;
        self.eigenvalues(name, case, worst)
    }

    /// Work of the base on the unbalances, J, as their masses go round the axis: the file counts the rotor as if all its mass lay on
    /// its axis.
    fn base_on_unbalance(&self, machine: &RotorMachine, end: f64) -> f64 {
        const PIECES: usize = 20_000;
        let Some(base) = &machine.constants.base else {
            return 0.0;
        };
        let length = end / PIECES as f64;
        let power = |piece: usize| {
            let time = (piece as f64 + 0.5) * length;
            let planes = self.shaft.rotor.unbalance.iter().map(|plane| {
                let (sine, cosine) = (self.speed * time + plane.phase).sin_cos();
                Vec2::new(-sine, cosine) * (plane.amount * self.speed)
            });
            -base
                .acceleration(time)
                .dot(planes.fold(Vec2::zero(), |sum, own| sum + own))
        };
        (0..PIECES).map(power).sum::<f64>() * length
    }

    fn verdict(
        &self,
        name: &str,
        results: &Value,
        watch: &Watch,
        end: f64,
        worst: &mut Worst,
    ) -> Result<(), String> {
        let stayed = watch
            .outside
            .iter()
            .flatten()
            .all(|last| last.is_none_or(|last| last < end - watch.hold));
        let crossed = watch.crossed.iter().any(Option::is_some);
        let word = match (
            self.given["start"] == "rest_on_stops",
            self.given["stop"].is_null(),
        ) {
            (true, _) => ["failed", "success"][usize::from(stayed)],
            (_, true) => ["held", "lost"][usize::from(crossed)],
            (_, false) if !crossed => "no contact",
            (_, false) => ["lost", "recovered"][usize::from(stayed)],
        };
        let same = f64::from(u8::from(results["verdict"] == word));
        let exact = Tolerance::Absolute(0.0);
        let row = Row::compared(format!("{name}: verdict"), "", 1.0, same, exact, word);
        worst.add(row);
        Ok(())
    }

    /// The largest eigenvalues after the faults: of a lost axis neither k_i nor k_s is left, of a cut loop k_s alone.
    fn eigenvalues(&self, name: &str, case: &Value, worst: &mut Worst) -> Result<(), String> {
        let Some(wanted) = case["closed_form"]["largest_eigenvalues_after_the_fault"].as_array()
        else {
            return Ok(());
        };
        let (analysis, plant) = self.plant();
        let loads = weight(
            &self.shaft.rotor,
            &analysis,
            [self.gravity.x, self.gravity.y],
        );
        let told = |error: levitation::Refused| error.to_string();
        let mut slopes = equilibrium(&plant, &self.levitation, &loads)
            .map_err(told)?
            .slopes;
        for (_, change) in &self.changes {
            for axis in &change.axes {
                slopes[*axis] = match change.what {
                    What::Lost { .. } => (0.0, 0.0),
                    What::Stuck | What::Dead | What::Frozen => (0.0, slopes[*axis].1),
                    _ => slopes[*axis],
                };
            }
        }
        let closed = ClosedLoop::about(plant, &self.levitation, slopes).map_err(told)?;
        let ours = closed.poles().map_err(told)?;
        for wanted in wanted {
            let [re, im] =
                [wanted[0].as_f64(), wanted[1].as_f64()].map(|part| part.unwrap_or(f64::NAN));
            let wanted = C64::new(re, im);
            let allowed = match wanted.norm() < 1e-2 {
                true => 1e-2,
                false => 1e-4 * wanted.norm() + 1e-3,
            };
            let apart = ours.iter().map(|own| {
                (own.value - wanted)
                    .norm()
                    .min((own.value.conj() - wanted).norm())
            });
            let nearest = apart.fold(f64::INFINITY, f64::min);
            let row = Row::compared(
                format!("{name}: eigenvalues after the fault"),
                "1/s",
                0.0,
                nearest,
                Tolerance::Absolute(allowed),
                "distance to the nearest of ours; tolerance of the file",
            );
            worst.add(row);
        }
        Ok(())
    }
}

/// A value for all, or that of one.
fn one_of(tolerance: &Value, k: usize) -> &Value {
    tolerance.get(k).unwrap_or(tolerance)
}

/// Of a linear magnet its control current, of a pair both coils: wanted and ours.
fn currents(wanted: &Value, (control, coils): &(f64, [f64; 2])) -> Vec<[f64; 2]> {
    match wanted.as_array() {
        Some(pair) => {
            let pair = pair.iter().map(|value| value.as_f64().unwrap_or(f64::NAN));
            pair.zip(coils)
                .map(|(wanted, ours)| [wanted, *ours])
                .collect()
        }
        None => vec![[wanted.as_f64().unwrap_or(f64::NAN), *control]],
    }
}
