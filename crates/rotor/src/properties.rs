//! Mass, centre and moments of inertia.

use crate::Rotor;

/// Properties of the rotor as one rigid body; supports and housings do not count.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Properties {
    /// Mass, kg.
    pub mass: f64,
    /// Position of the mass centre along the shaft, m.
    pub centre: f64,
    /// Moment of inertia about the axis, kg m².
    pub polar: f64,
    /// Moment of inertia about a diameter through the mass centre, kg m².
    pub transverse: f64,
}

/// Mass properties from the matrices of the parts, so that they are those of every analysis.
#[must_use]
pub fn properties(rotor: &Rotor) -> Properties {
    let (mut mass, mut first, mut second, mut polar) = (0.0, 0.0, 0.0, 0.0);
    let mut add = |m: f64, z: f64| {
        mass += m;
        first += m * z;
        second += m * z * z;
    };
    for disk in &rotor.disks {
        add(disk.mass, rotor.nodes[disk.node]);
    }
    for part in &rotor.masses {
        add(part.mass, rotor.nodes[part.node]);
    }
    for element in &rotor.elements {
        let own = element.matrices();
        let z = rotor.nodes[element.left];
        // Rigid motions of the two nodes: the same displacement, and a turn about z = 0.
        let shift = nalgebra::Vector4::new(1.0, 0.0, 1.0, 0.0);
        let turn = nalgebra::Vector4::new(z, 1.0, z + element.length, 1.0);
        mass += shift.dot(&(own.mass * shift));
        first += shift.dot(&(own.mass * turn));
        second += turn.dot(&(own.mass * turn));
        polar += turn.dot(&(own.gyroscopic * turn));
    }
    for disk in &rotor.disks {
        second += disk.diametral;
        polar += disk.polar;
    }
    let centre = first / mass;
    Properties {
        mass,
        centre,
        polar,
        transverse: second - mass * centre * centre,
    }
}
