//! A drive of limited torque through a critical speed: Sommerfeld's capture.
//!
//! Source: `shared/cases/reference/machine_runup.json`, an independent implementation. Supports are springs and dampers there:
//! here they are part of the shaft's stiffness and damping, in coordinates of the supported rotor. The auxiliary bearing that a
//! machine needs is never touched.

use crate::files::{list, number, numbers, read, shaft, unbalance};
use crate::machines::bent::Shaft;
use crate::machines::{by, let_roll, reference, settings, vec2, weightless};
use model::system::machine::RotorMachine;
use model::system::machine::simulate::Steps;
use nalgebra::{DMatrix, SymmetricEigen};
use number::Vec2;
use rotor::Basis;
use serde_json::Value;
use solve::{Flow, Observer, Step, Stop};

/// Coordinates that are kept: those of the reference.
const KEPT: usize = 11;

/// The rotor on its supports, in its lowest modes at rest.
fn supported(file: &Value) -> Shaft {
    let mut rotor = shaft(&file["rotor"]);
    rotor.unbalance = unbalance(file);
    let mut full = Shaft::full(rotor);
    for support in list(file, "supports") {
        let at = full.rotor.displacement(number(support, "node") as usize);
        full.matrices.stiffness[(at, at)] += number(support, "k");
        full.matrices.damping[(at, at)] += number(support, "c");
    }
    let free = full.basis.shapes.clone();
    let stiffness = free.tr_mul(&(&full.matrices.stiffness * &free));
    let eigen = SymmetricEigen::new((&stiffness + stiffness.transpose()) * 0.5);
    let mut order: Vec<usize> = (0..free.ncols()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let own = DMatrix::from_fn(free.ncols(), KEPT, |i, j| eigen.eigenvectors[(i, order[j])]);
    let shapes = free * own;
    let frequencies = shapes
        .column_iter()
        .map(|shape| shape.dot(&(&full.matrices.stiffness * shape)).sqrt());
    full.basis = Basis {
        frequencies: frequencies.collect(),
        shapes: shapes.clone(),
    };
    full
}

/// Samples of angle and spin, and where the disk goes farthest from the axis.
struct Watch {
    disk: Vec<f64>,
    times: Vec<f64>,
    samples: Vec<(f64, f64)>,
    largest: f64,
}

impl Observer<RotorMachine> for Watch {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        let rotor = step.machine.layout().rotor;
        while self
            .times
            .get(self.samples.len())
            .is_some_and(|time| *time <= step.end)
        {
            let time = self.times[self.samples.len()];
            let state = step.state((time - step.start) / (step.end - step.start));
            self.samples
                .push((state[rotor.spin()], state[rotor.angle()]));
        }
        let machine = step.machine;
        let state = step.state(1.0);
        let (sine, cosine) = state[rotor.angle()].sin_cos();
        let own = machine.constants.rotor.coordinates.iter().enumerate();
        let disk = own
            .zip(&self.disk)
            .fold(Vec2::zero(), |sum, ((k, own), shape)| {
                let centre = vec2(
                    state[rotor.block(0).start + k],
                    state[rotor.block(1).start + k],
                );
                let offset = own.unbalance * cosine + own.unbalance.turned() * sine;
                sum + (centre - offset) * *shape
            });
        self.largest = self.largest.max(disk.length_squared().sqrt());
        Flow::Continue
    }
}

#[test]
fn a_weak_drive_is_caught_and_a_strong_one_passes() {
    let Some(file) = read("reference", "machine_runup") else {
        return;
    };
    let shaft = supported(&file);
    let disk = shaft.row(4);
    let mut caught = Vec::new();
    for run in list(&file, "runs") {
        let mut constants = reference();
        weightless(&mut constants);
        let_roll(&mut constants);
        constants.rotor = shaft.constants();
        constants.rotor.drive_torque = number(run, "tau0");
        constants.rotor.drive_slope = number(run, "d1");
        constants.bearings[0].node = disk.clone();
        // never touched, and a scale for errors
        constants.bearings[0].contact.radial_clearance = 5e-3;
        constants.speed = 600.0;
        let machine = RotorMachine::new(constants);
        let zero = vec![vec2(0.0, 0.0); KEPT];
        let start = machine.start_with(&zero, &zero);
        let mut watch = Watch {
            disk: disk.clone(),
            times: list(run, "samples")
                .iter()
                .map(|s| number(s, "t"))
                .collect(),
            samples: Vec::new(),
            largest: 0.0,
        };
        let end = number(&file, "T");
        let ending = by(
            Steps::Explicit,
            &machine,
            &start,
            &settings(end, 1e-6),
            &mut watch,
        );
        assert_eq!(ending.stop, Stop::Finished);
        println!("{:?}", ending.work);
        let mut worst = 0.0_f64;
        let mut near = |ours: f64, reference: f64| {
            worst = worst.max((ours / reference - 1.0).abs());
        };
        for (sample, ours) in list(run, "samples").iter().zip(&watch.samples) {
            near(ours.0, number(sample, "Om"));
            near(ours.1, number(sample, "phi"));
        }
        near(watch.largest, number(run, "largest_disk_displacement"));
        let layout = machine.layout();
        let drive = ending.state[layout.source(1)];
        let heat = machine.flows(&ending.state).heat;
        let works = [
            (drive, number(run, "drive_work")),
            (heat, number(run, "heat")),
        ];
        let apart = works.map(|(ours, reference)| (ours / reference - 1.0).abs());
        let residual = machine.balance(&start, &ending.state).energy_residual() / drive;
        println!(
            "tau0 {}: {worst:e}, work and heat {apart:?}, residual {residual:e}",
            number(run, "tau0")
        );
        // tolerances of the file
        assert!(
            worst < 1e-4 && apart.iter().all(|apart| *apart < 1e-3),
            "{worst} {apart:?}"
        );
        assert!(residual.abs() < 1e-6, "{residual}");
        // one is left below the critical
        let critical = numbers(&file, "damped_frequencies_at_rest_rad_s")[0];
        let below = ending.state[layout.rotor.spin()] < critical;
        assert_eq!(Some(below), run["captured"].as_bool());
        caught.push(below);
    }
    assert_eq!(caught, [true, false, false]);
}
