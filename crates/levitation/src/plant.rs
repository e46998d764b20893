//! What the magnets hold: M q̈ + D q̇ + K q = F at one speed.

use crate::{Axis, C64, Refused, eigen};
use nalgebra::{ComplexField, DMatrix, DVector, RowDVector};
use rotor::{Analysis, Dynamics, Matrices, Place, Rotor};

/// Coordinates of a rotor: complex w = x + jy, one list for both planes, or real, the x-plane first and then the y-plane.
pub trait Coordinates: ComplexField<RealField = f64> {
    /// Whether one number stands for both planes.
    const COMPLEX: bool;
    /// The row that gives the displacement along a direction (rad from +x) of a place whose displacement in one plane is `shape`.
    /// Complex: along and across the direction in one number, in the direction's own frame.
    fn row(shape: &RowDVector<f64>, angle: f64) -> RowDVector<Self>;
    /// Forces of two planes that push with Re(F e^{st}) along x and Im(F e^{st}) along y, F = shapeᵀ `amount`.
    fn turning(shape: &RowDVector<f64>, amount: C64) -> Vec<C64>;
    /// Eigenvalues of a general matrix.
    fn eigenvalues(matrix: DMatrix<Self>) -> Result<Vec<C64>, Refused>;
    /// As a complex number.
    fn complex(self) -> C64;
    /// From a complex number; over real coordinates it has no imaginary part.
    fn of(value: C64) -> Self;
}

impl Coordinates for f64 {
    const COMPLEX: bool = false;
    fn row(shape: &RowDVector<f64>, angle: f64) -> RowDVector<f64> {
        let size = shape.len();
        let (sin, cos) = angle.sin_cos();
        let mut row = RowDVector::zeros(2 * size);
        row.columns_mut(0, size).copy_from(&(shape * cos));
        row.columns_mut(size, size).copy_from(&(shape * sin));
        row
    }
    fn turning(shape: &RowDVector<f64>, amount: C64) -> Vec<C64> {
        let x = shape.iter().map(|value| amount * value);
        let y = shape.iter().map(|value| amount * C64::new(0.0, -value));
        x.chain(y).collect()
    }
    fn eigenvalues(matrix: DMatrix<f64>) -> Result<Vec<C64>, Refused> {
        eigen::real(matrix)
    }
    fn complex(self) -> C64 {
        C64::from(self)
    }
    fn of(value: C64) -> f64 {
        value.re
    }
}

impl Coordinates for C64 {
    const COMPLEX: bool = true;
    fn row(shape: &RowDVector<f64>, _: f64) -> RowDVector<C64> {
        shape.map(C64::from)
    }
    fn turning(shape: &RowDVector<f64>, amount: C64) -> Vec<C64> {
        shape.iter().map(|value| amount * value).collect()
    }
    fn eigenvalues(matrix: DMatrix<C64>) -> Result<Vec<C64>, Refused> {
        eigen::complex(matrix)
    }
    fn complex(self) -> C64 {
        self
    }
    fn of(value: C64) -> C64 {
        value
    }
}

/// M q̈ + D q̇ + K q = F at one speed, with the displacement of every node.
#[derive(Debug, Clone)]
pub struct Plant<T: Coordinates> {
    /// Mass M.
    pub mass: DMatrix<T>,
    /// What multiplies q̇, gyroscopic terms included.
    pub damping: DMatrix<T>,
    /// What multiplies q.
    pub stiffness: DMatrix<T>,
    /// Displacement of each node in one plane, a row over the coordinates of one plane.
    pub nodes: DMatrix<f64>,
    /// That of each housing.
    pub housings: DMatrix<f64>,
}

impl Plant<C64> {
    /// A rotor in the coordinates of its analysis at a speed, rad/s; `None` where a support treats x and y differently.
    #[must_use]
    pub fn turning(analysis: &Analysis, nodes: usize, speed: f64) -> Option<Self> {
        let dynamics = analysis.complex_dynamics(speed)?;
        Some(Self::of(dynamics, analysis, nodes))
    }
}

impl Plant<f64> {
    /// A rotor in the coordinates of its analysis at a speed, rad/s, both planes.
    #[must_use]
    pub fn planes(analysis: &Analysis, nodes: usize, speed: f64) -> Self {
        Self::of(analysis.real_dynamics(speed), analysis, nodes)
    }
}

/// Forces of weight on the coordinates of both planes, N: gravity (x, y) in m/s² times the mass that each coordinate of a plane
/// carries, Φᵀ M 1 over displacements of nodes and housings.
#[must_use]
pub fn weight(rotor: &Rotor, analysis: &Analysis, gravity: [f64; 2]) -> DVector<f64> {
    let mut shift = DVector::zeros(rotor.size());
    for node in 0..rotor.nodes.len() {
        shift[rotor.displacement(node)] = 1.0;
    }
    for housing in 0..rotor.housings.len() {
        shift[rotor.coordinate(Place::Housing(housing))] = 1.0;
    }
    let carried = analysis
        .basis
        .shapes
        .tr_mul(&(Matrices::new(rotor).mass * shift));
    let size = carried.len();
    DVector::from_fn(2 * size, |at, _| carried[at % size] * gravity[at / size])
}

impl<T: Coordinates> Plant<T> {
    fn of(dynamics: Dynamics<T>, analysis: &Analysis, nodes: usize) -> Self {
        let shapes = &analysis.basis.shapes;
        Self {
            mass: dynamics.mass,
            damping: dynamics.damping,
            stiffness: dynamics.stiffness,
            // displacement and slope of each node stand in turn
            nodes: DMatrix::from_fn(nodes, shapes.ncols(), |node, k| shapes[(2 * node, k)]),
            housings: shapes
                .rows(2 * nodes, shapes.nrows() - 2 * nodes)
                .into_owned(),
        }
    }

    /// Number of coordinates.
    #[must_use]
    pub fn size(&self) -> usize {
        self.mass.nrows()
    }
    /// Row of a node in one plane.
    #[must_use]
    pub fn shape(&self, node: usize) -> RowDVector<f64> {
        self.nodes.row(node).into()
    }
    /// Row of an axis of a magnet or a sensor: of its node, less that of the housing that carries it.
    #[must_use]
    pub fn axis(&self, axis: &Axis) -> RowDVector<T> {
        let node = self.shape(axis.node);
        let shape = match axis.on {
            None => node,
            Some(housing) => node - self.housings.row(housing),
        };
        T::row(&shape, axis.angle)
    }
    /// Row of a direction at a node.
    #[must_use]
    pub fn row(&self, node: usize, angle: f64) -> RowDVector<T> {
        T::row(&self.shape(node), angle)
    }
}
