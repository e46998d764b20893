//! The rotor as a list of parts.

use crate::{Element, Place, Support};

/// A disk: rigid, thin, at a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disk {
    /// Its node.
    pub node: usize,
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia about the axis, kg m².
    pub polar: f64,
    /// Moment of inertia about a diameter, kg m².
    pub diametral: f64,
}

/// A mass without inertia at a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointMass {
    /// Its node.
    pub node: usize,
    /// Mass, kg.
    pub mass: f64,
}

/// A housing or pedestal: a mass that does not turn, between supports.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Housing {
    /// Mass, kg; above zero.
    pub mass: f64,
}

/// An unbalance: mass times distance from the axis at a node, at an angle of the rotor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unbalance {
    /// Its node.
    pub node: usize,
    /// Amount, kg m.
    pub amount: f64,
    /// Angle on the rotor, rad.
    pub phase: f64,
}

/// A rotor with what carries it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rotor {
    /// Positions of the nodes along the shaft, m, rising.
    pub nodes: Vec<f64>,
    /// Pieces of shaft; several may lie between the same two nodes.
    pub elements: Vec<Element>,
    /// Disks.
    pub disks: Vec<Disk>,
    /// Point masses.
    pub masses: Vec<PointMass>,
    /// Supports and seals.
    pub supports: Vec<Support>,
    /// Housings under supports.
    pub housings: Vec<Housing>,
    /// Unbalance planes.
    pub unbalance: Vec<Unbalance>,
}

impl Rotor {
    /// Number of complex coordinates: two for each node, one for each housing.
    #[must_use]
    pub fn size(&self) -> usize {
        2 * self.nodes.len() + self.housings.len()
    }

    /// The coordinate of a node's displacement; the next is its slope.
    #[must_use]
    pub fn displacement(&self, node: usize) -> usize {
        2 * node
    }

    /// The coordinate that a support acts on.
    #[must_use]
    pub fn coordinate(&self, place: Place) -> usize {
        match place {
            Place::Node(node) => self.displacement(node),
            Place::Housing(housing) => 2 * self.nodes.len() + housing,
        }
    }

    /// Whether all supports treat every direction alike, so that the complex equation holds.
    #[must_use]
    pub fn turns(&self) -> bool {
        self.supports
            .iter()
            .all(|support| support.coefficients.turns())
    }

    /// What carries a static load of the shaft.
    pub fn bearings(&self) -> impl Iterator<Item = &Support> {
        let of_shaft = |support: &&Support| matches!(support.at, Place::Node(_));
        self.supports
            .iter()
            .filter(|support| !support.seal)
            .filter(of_shaft)
    }

    /// The same rotor with nothing around it: no supports, seals and housings.
    #[must_use]
    pub fn free(&self) -> Self {
        Self {
            supports: Vec::new(),
            housings: Vec::new(),
            ..self.clone()
        }
    }
}
