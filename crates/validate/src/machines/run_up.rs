//! A drive of limited torque through a critical speed: Sommerfeld's capture.
//!
//! Supports are part of the shaft's stiffness and damping here, in coordinates of the supported rotor. The auxiliary bearing that a
//! machine needs is never touched.

use super::given::{Coordinates, index, on_springs, rotor};
use super::run_to;
use crate::compare::{Refusal, Worst, told};
use crate::json::{array, list, number};
use crate::report::{Row, Tolerance};
use crate::simulation::falling_machine;
use model::bearing::rolling::RollingBall;
use model::bearing::{AccelerationLoss, BearingConstants, RollingConstants, SteadyMoment};
use model::system::machine::{MachineConstants, RotorMachine};
use nalgebra::{DMatrix, SymmetricEigen};
use number::Vec2;
use physics::rolling::RollingSet;
use rotor::{Analysis, Basis, Rotor};
use serde_json::Value;
use solve::{Flow, Observer, Step};
use std::path::Path;

/// Most coordinates that are kept.
const MOST: usize = 11;
/// Tolerance of the steps.
const TOLERANCE: f64 = 1e-6;

pub(super) fn rows(file: &Value, _: &Path) -> Result<Vec<Row>, Refusal> {
    let own = rotor(&file["rotor"], file)?;
    let mut worst = Worst::default();
    at_rest(file, &own, &mut worst)?;
    let shaft = supported(file, own)?;
    for (at, run) in list(file, "runs")?.iter().enumerate() {
        worst.row(&format!("run {}", at + 1), run, |worst| {
            run_up(file, run, &shaft, worst)
        })?;
    }
    Ok(worst.into_rows())
}

/// Frequencies of the damped rotor on its supports, by the analysis that `auxbear rotor` uses.
fn at_rest(file: &Value, rotor: &Rotor, worst: &mut Worst) -> Result<(), String> {
    let rotor = on_springs(rotor.clone(), file)?;
    let analysis = Analysis::full(&rotor).map_err(told)?;
    let found = analysis.eigenvalues(0.0).map_err(told)?;
    let mut found: Vec<f64> = found.iter().map(|value| value.im).collect();
    found.retain(|frequency| *frequency > 1.0);
    found.sort_by(f64::total_cmp);
    // both planes alike
    found.dedup_by(|a, b| (*a - *b).abs() < 1e-6 * b.abs());
    let key = "damped_frequencies_at_rest_rad_s";
    for (wanted, ours) in list(file, key)?.iter().zip(found) {
        let both = [wanted.as_f64().unwrap_or(f64::NAN), ours];
        let mut all = worst.under(Tolerance::Relative(1e-8), "1e-8");
        all.add("damped frequency at rest", "rad/s", both);
    }
    Ok(())
}

/// The rotor on its supports, in its lowest modes at rest.
fn supported(file: &Value, rotor: Rotor) -> Result<Coordinates, String> {
    let mut full = Coordinates::full(rotor)?;
    for support in list(file, "supports")? {
        let at = full.rotor.displacement(index(support, "node")?);
        if at >= full.rotor.size() {
            return Err("a support at a node that is not there".to_string());
        }
        full.matrices.stiffness[(at, at)] += number(support, "k")?;
        full.matrices.damping[(at, at)] += number(support, "c")?;
    }
    let free = full.basis.shapes.clone();
    let stiffness = free.tr_mul(&(&full.matrices.stiffness * &free));
    let eigen = SymmetricEigen::new((&stiffness + stiffness.transpose()) * 0.5);
    let mut order: Vec<usize> = (0..free.ncols()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    order.truncate(MOST);
    let own = DMatrix::from_fn(free.ncols(), order.len(), |i, j| {
        eigen.eigenvectors[(i, order[j])]
    });
    let shapes = free * own;
    let frequencies = shapes
        .column_iter()
        .map(|shape| shape.dot(&(&full.matrices.stiffness * shape)).sqrt());
    full.basis = Basis {
        frequencies: frequencies.collect(),
        shapes: shapes.clone(),
    };
    Ok(full)
}

/// Angle and spin at the asked times, and where the disk goes farthest from the axis.
struct Watch {
    times: Vec<f64>,
    samples: Vec<(f64, f64)>,
    largest: f64,
    at: f64,
    spin_then: f64,
}

impl Observer<RotorMachine> for Watch {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        let machine = step.machine;
        let rotor = machine.layout().rotor;
        while let Some(time) = self.times.get(self.samples.len()).copied() {
            if time > step.end {
                break;
            }
            let state = step.state((time - step.start) / (step.end - step.start));
            let (spin, angle) = (state[rotor.spin()], state[rotor.angle()]);
            self.samples.push((spin, angle));
        }
        let state = step.state(1.0);
        let disk = machine.place(0, state).length_squared().sqrt();
        let spin = state[rotor.spin()];
        if disk > self.largest {
            (self.largest, self.spin_then) = (disk, spin);
            self.at = step.end;
        }
        Flow::Continue
    }
}

fn run_up(file: &Value, run: &Value, shaft: &Coordinates, worst: &mut Worst) -> Result<(), String> {
    let words = file["definition"].as_str().unwrap_or_default();
    let speed = words
        .split_once("Om(0) = ")
        .and_then(|(_, rest)| rest.split_whitespace().next()?.parse::<f64>().ok())
        .ok_or("a definition without Om(0)")?;
    let disk = (shaft.rotor.unbalance.first()).ok_or("a rotor without unbalance")?;
    let [x, y] = array(file, "gravity")?;
    let constants = of_run(run, shaft, (disk.node, Vec2::new(x, y)), speed)?;
    let machine = RotorMachine::new(constants);
    let still = vec![Vec2::zero(); shaft.basis.len()];
    let start = machine.start_with(&still, &still);
    let samples = list(run, "samples")?.iter();
    let samples: Vec<&Value> = samples
        .filter(|sample| !worst.lacks("sample", sample))
        .collect();
    let times: Result<Vec<f64>, String> = samples.iter().map(|s| number(s, "t")).collect();
    let mut watch = Watch {
        times: times?,
        samples: Vec::new(),
        largest: 0.0,
        at: 0.0,
        spin_then: 0.0,
    };
    let end = number(file, "T")?;
    let ending = run_to(end, &machine, &start, (TOLERANCE, 1e-7), &mut watch)?;
    let layout = machine.layout();
    let why = "that of the file";
    let mut close = worst.under(Tolerance::Relative(1e-4), why);
    for (sample, (spin, angle)) in samples.iter().zip(&watch.samples) {
        close.add("spin", "rad/s", [number(sample, "Om")?, *spin]);
        close.add("angle", "rad", [number(sample, "phi")?, *angle]);
    }
    let largest = [number(run, "largest_disk_displacement")?, watch.largest];
    close.add("largest displacement", "m", largest);
    let then = [number(run, "Om_then")?, watch.spin_then];
    close.add("spin at the largest displacement", "rad/s", then);
    let spin = ending.state[layout.rotor.spin()];
    close.add("spin at the end", "rad/s", [number(run, "Om_end")?, spin]);
    let mut when = worst.under(Tolerance::Absolute(1e-3), why);
    let at = [number(run, "at_t")?, watch.at];
    when.add("time of the largest displacement", "s", at);
    let work = ending.state[layout.source(1)];
    let heat = machine.flows(&ending.state).heat;
    let mut share = worst.under(Tolerance::Relative(1e-3), why);
    share.add("work of the drive", "J", [number(run, "drive_work")?, work]);
    share.add("heat", "J", [number(run, "heat")?, heat]);
    Ok(())
}

/// A machine that never touches its bearing.
fn of_run(
    run: &Value,
    shaft: &Coordinates,
    (disk, gravity): (usize, Vec2<f64>),
    speed: f64,
) -> Result<MachineConstants, String> {
    let mut constants = falling_machine(1.0, 1e7, 5e-3, 0.0)?.constants;
    constants.rotor = shaft.constants();
    constants.rotor.places = vec![shaft.row(disk)];
    constants.rotor.drive_torque = number(run, "tau0")?;
    constants.rotor.drive_slope = number(run, "d1")?;
    constants.gravity = gravity;
    constants.speed = speed;
    let part = &mut constants.bearings[0];
    part.node = shaft.row(disk);
    // beyond anything that the rotor does
    part.contact.radial_clearance = 0.1;
    part.bearing = idle();
    constants.balance_mounts();
    Ok(constants)
}

/// Balls without states of their own that carry nothing.
pub(super) fn idle() -> BearingConstants {
    let radius = 3e-3;
    BearingConstants::Rolling(RollingConstants {
        balls: 8,
        ball: RollingBall {
            series_stiffness: 1e10,
            load_per_radial_force: 1.0,
            damping_time: 0.0,
            interference: 0.0,
            inner_track_growth: 0.0,
            mass_radius: 0.0,
        },
        set: RollingSet {
            inner_track_radius: 5.0 * radius,
            ball_ratio: 0.2,
            balls_mass: 8e-3,
            cage_mass: 5e-3,
        },
        cage_mass: 5e-3,
        first_ball_angle: 0.0,
        moment: SteadyMoment::None,
        axial_load: 0.0,
        loss: AccelerationLoss::None,
        lubricant: None,
    })
}
