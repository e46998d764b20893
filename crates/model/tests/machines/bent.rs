//! Rotors of elements as constants of the model, and the machine of the tests whose rotor bends.

use super::{reference, vec2};
use model::rotor::{Coordinate, RotorConstants, Unbalance};
use model::system::machine::{MachineConstants, RotorMachine};
use nalgebra::{DMatrix, DVector};
use rotor::{Annulus, Basis, Disk, Element, Material, Matrices, Rotor, unit_forces};

/// A rotor of elements in some coordinates.
pub struct Shaft {
    pub rotor: Rotor,
    pub matrices: Matrices,
    pub basis: Basis,
}

impl Shaft {
    /// In all its coordinates.
    pub fn full(rotor: Rotor) -> Self {
        let matrices = Matrices::new(&rotor);
        let basis = Basis::full(&rotor, &matrices).expect("a rotor");
        Shaft {
            rotor,
            matrices,
            basis,
        }
    }
    /// In free modes up to a frequency (rad/s) and the residual flexibility of some nodes.
    pub fn reduced(rotor: Rotor, cut: f64, nodes: &[usize]) -> Self {
        let full = Shaft::full(rotor);
        let kept: Vec<usize> = nodes.iter().map(|n| full.rotor.displacement(*n)).collect();
        let forces = unit_forces(full.rotor.size(), &kept);
        let basis = full.basis.reduced(cut, &forces).expect("numbers");
        Shaft { basis, ..full }
    }
    /// Row of a node.
    pub fn row(&self, node: usize) -> Vec<f64> {
        let at = self.rotor.displacement(node);
        self.basis.shapes.row(at).iter().copied().collect()
    }
    /// Constants of the rotor, its unbalances with it.
    pub fn constants(&self) -> RotorConstants {
        let own = self.matrices.project(&self.basis.shapes);
        let one = DVector::from_fn(self.rotor.size(), |i, _| f64::from(u8::from(i % 2 == 0)));
        let weight = self.basis.shapes.tr_mul(&(&self.matrices.mass * one));
        let rows = |matrix: &DMatrix<f64>| -> Vec<f64> {
            let there = matrix.iter().any(|entry| *entry != 0.0);
            let symmetric = (matrix + matrix.transpose()) * 0.5;
            symmetric.iter().copied().filter(|_| there).collect()
        };
        let coordinates = self.basis.frequencies.iter().zip(weight.iter());
        let planes = self.rotor.unbalance.iter().map(|plane| Unbalance {
            node: self.row(plane.node),
            product: plane.amount,
            phase: plane.phase,
        });
        RotorConstants {
            coordinates: coordinates
                .map(|(frequency, weight)| Coordinate {
                    frequency: *frequency,
                    mass: 1.0,
                    weight: *weight,
                    unbalance: vec2(0.0, 0.0),
                })
                .collect(),
            gyroscopic: rows(&own.gyroscopic),
            damping: rows(&own.damping),
            damping_rotating: rows(&own.damping_rotating),
            ..RotorConstants::point(1.0, rotor::properties(&self.rotor).polar, 0.0)
        }
        .with_unbalance(&planes.collect::<Vec<_>>())
    }
}

/// Nodes of the bearings of [`bent`].
pub const NODES: [usize; 2] = [1, 7];

/// A shaft of 30 mm with two disks, damped, unbalanced: nine nodes.
pub fn shaft() -> Rotor {
    let round = |outer: f64| Annulus { outer, inner: 0.0 };
    let element = |left: usize| Element {
        left,
        length: 0.06,
        start: round(0.03),
        end: round(if left == 3 { 0.04 } else { 0.03 }),
        material: Material::new(206e9, 0.3, 7850.0),
        carries: true,
        damping_of_mass: 2.0,
        damping_of_stiffness: 1e-6,
        damping_rotating: 4e-7,
    };
    let disk = |node: usize, mass: f64| Disk {
        node,
        mass,
        polar: 2.2e-3 * mass,
        diametral: 1.3e-3 * mass,
    };
    let unbalance = |node: usize, amount: f64, phase: f64| rotor::Unbalance {
        node,
        amount,
        phase,
    };
    Rotor {
        nodes: (0..9).map(|k| 0.06 * f64::from(k)).collect(),
        elements: (0..8).map(element).collect(),
        disks: vec![disk(4, 3.0), disk(6, 1.0)],
        unbalance: vec![unbalance(4, 3e-5, 0.4), unbalance(6, 1e-5, 2.0)],
        ..Rotor::default()
    }
}

/// A rotor in modes up to a cut (rad/s) above two different planar bearings, and its state at release: on an orbit, a little bent.
/// Below the first bending mode it is rigid, but tilts.
pub fn bent(cut: f64) -> (MachineConstants, Vec<f64>) {
    let nodes = [NODES[0], NODES[1], 4, 6];
    let nodes = if cut > 100.0 { &nodes[..] } else { &[] };
    let shaft = Shaft::reduced(shaft(), cut, nodes);
    let mut constants = reference();
    constants.rotor = shaft.constants();
    let first = constants.bearings.remove(0);
    for (name, node) in ["drive_end", "other_end"].into_iter().zip(NODES) {
        let mut part = first.clone();
        part.name = name.to_string();
        part.node = shaft.row(node);
        constants.bearings.push(part);
    }
    let other = &mut constants.bearings[1];
    other.contact.radial_clearance *= 0.9;
    other.contact.friction = 0.2;
    other.mount.stiffness *= 0.4;
    other.datum = vec2(8e-6, -5e-6);
    constants.balance_mounts();
    let machine = RotorMachine::new(constants.clone());
    let orbit: Vec<_> = (constants.rotor.coordinates.iter().enumerate())
        .map(|(k, own)| vec2(3e-6 * own.weight, 1e-6 / (1 + k) as f64))
        .collect();
    let moving: Vec<_> = orbit
        .iter()
        .map(|at| at.turned() * constants.speed)
        .collect();
    let start = machine.start_with(&orbit, &moving);
    (constants, start)
}
