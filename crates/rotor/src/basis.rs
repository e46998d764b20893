//! Coordinates in which a rotor is small: free modes and what they leave out at the nodes that carry something.
//!
//! q = Φη with the rigid motions exactly at zero, the elastic modes of the free shaft at rest up to a cut, and for each node
//! that carries a support, a seal or an unbalance the residual flexibility: the deflection under a force there less what the
//! kept modes give (Rubin's basis). The same of the gyroscopic moments of the slow modes. All are made orthonormal once:
//! M → 1, K → ω². One real Φ serves both planes. Housings are coordinates of their own.
//!
//! The frequencies are Rayleigh quotients of the stiffness matrix, not what the eigen-solver returns: of a matrix with
//! entries up to ω² = 10¹⁴ it leaves an error of 10⁻² in every ω², and of rigid motions ±10⁻⁴.

use crate::{C64, Matrices, Place, Rotor, RotorError};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Coordinates of a rotor: q = Φη.
#[derive(Debug, Clone)]
pub struct Basis {
    /// Φ, one column a coordinate; M-orthonormal.
    pub shapes: DMatrix<f64>,
    /// Frequency of each coordinate, rad/s: rising; zero of rigid motions and housings.
    pub frequencies: Vec<f64>,
}

/// Two rigid motions of a shaft in a plane.
const RIGID: usize = 2;

/// Directions of residual flexibility that differ by less than this share of the largest are one.
const SAME_DIRECTION: f64 = 1e-9;

impl Basis {
    /// All modes of the free rotor at rest, and its housings.
    ///
    /// # Errors
    ///
    /// Where the mass matrix is not positive.
    pub fn full(rotor: &Rotor, matrices: &Matrices) -> Result<Self, RotorError> {
        let (shaft, size) = (2 * rotor.nodes.len(), rotor.size());
        let part = |m: &DMatrix<f64>| m.view((0, 0), (shaft, shaft)).into_owned();
        let (mass, stiffness) = (part(&matrices.mass), part(&matrices.stiffness));
        let factor = mass.clone().cholesky().ok_or(RotorError::NoMass)?.unpack();
        let solve = |m: &DMatrix<f64>| factor.solve_lower_triangular(m).ok_or(RotorError::NoMass);
        let reduced = solve(&solve(&stiffness)?.transpose())?;
        let eigen = symmetric((&reduced + reduced.transpose()) * 0.5)?;
        let mut order: Vec<usize> = (0..shaft).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        // The rigid motions are known: they replace the two of the solver, and the others are made orthogonal to them.
        let mut sorted = DMatrix::from_fn(shaft, shaft, |i, j| eigen.eigenvectors[(i, order[j])]);
        for (column, motion) in rigid(rotor).iter().enumerate() {
            sorted.set_column(column, &(factor.transpose() * motion));
        }
        for j in 0..shaft {
            let mut own = sorted.column(j).into_owned();
            for k in 0..RIGID.min(j) {
                let before = sorted.column(k);
                own -= before * before.dot(&own);
            }
            let length = own.norm();
            sorted.set_column(j, &(own / length));
        }
        let modes = factor
            .transpose()
            .solve_upper_triangular(&sorted)
            .ok_or(RotorError::NoMass)?;
        let mut frequencies = vec![0.0; rotor.housings.len()];
        let mut shapes = DMatrix::zeros(size, size);
        for (housing, part) in rotor.housings.iter().enumerate() {
            shapes[(shaft + housing, housing)] = 1.0 / part.mass.sqrt();
        }
        let first = rotor.housings.len();
        for (j, mode) in modes.column_iter().enumerate() {
            let quotient = mode.dot(&(&stiffness * mode));
            frequencies.push(if j < RIGID {
                0.0
            } else {
                quotient.max(0.0).sqrt()
            });
            shapes.view_mut((0, first + j), (shaft, 1)).copy_from(&mode);
        }
        Ok(Self {
            shapes,
            frequencies,
        })
    }

    /// The modes up to `cut` (rad/s) and the residual flexibility under each of these forces, a column each.
    ///
    /// # Errors
    ///
    /// Where numbers leave double precision.
    pub fn reduced(&self, cut: f64, forces: &DMatrix<f64>) -> Result<Self, RotorError> {
        let modes = self.frequencies.partition_point(|omega| *omega <= cut);
        let above = self.frequencies.len() - modes;
        if above <= forces.ncols() || forces.ncols() == 0 {
            return Ok(match forces.ncols() {
                0 => self.first(modes),
                _ => self.clone(),
            });
        }
        // Residual flexibility in the coordinates of the modes above the cut: φ_kᵀF/ω_k².
        let omega = |k: usize| self.frequencies[modes + k];
        let mut residual = self.shapes.columns(modes, above).tr_mul(forces);
        for (k, mut row) in residual.row_iter_mut().enumerate() {
            row /= omega(k).powi(2);
        }
        for mut column in residual.column_iter_mut() {
            let length = column.norm();
            if length > 0.0 {
                column /= length;
            }
        }
        let gram = symmetric(residual.tr_mul(&residual))?;
        let largest = gram.eigenvalues.amax();
        let directions: Vec<DVector<f64>> = (0..forces.ncols())
            .filter(|j| gram.eigenvalues[*j] > SAME_DIRECTION * largest)
            .map(|j| &residual * gram.eigenvectors.column(j) / gram.eigenvalues[j].sqrt())
            .collect();
        let mut frequencies = self.frequencies[..modes].to_vec();
        let mut shapes = self.shapes.columns(0, modes).into_owned();
        if !directions.is_empty() {
            let directions = DMatrix::from_columns(&directions);
            let squares = DMatrix::from_fn(above, directions.ncols(), |k, j| {
                omega(k).powi(2) * directions[(k, j)]
            });
            let eigen = symmetric(directions.tr_mul(&squares))?;
            let mut order: Vec<usize> = (0..directions.ncols()).collect();
            order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
            let turned = &directions * eigen.eigenvectors;
            let lifted = self.shapes.columns(modes, above) * turned;
            for j in order {
                let at = shapes.ncols();
                shapes = shapes.insert_column(at, 0.0);
                shapes.set_column(at, &lifted.column(j));
                frequencies.push(eigen.eigenvalues[j].max(0.0).sqrt());
            }
        }
        Ok(Self {
            shapes,
            frequencies,
        })
    }

    /// The first coordinates alone.
    fn first(&self, count: usize) -> Self {
        Self {
            shapes: self.shapes.columns(0, count).into_owned(),
            frequencies: self.frequencies[..count].to_vec(),
        }
    }

    /// The modes up to `cut` (rad/s) with the residual flexibility that an analysis of frequencies up to `limit` (rad/s)
    /// needs: at the nodes that carry something, and under the gyroscopic moments of the modes up to `limit`.
    ///
    /// Without the moments the lowest modes of a fast rotor with disks are wrong by 10⁻⁵ and more.
    ///
    /// # Errors
    ///
    /// Where numbers leave double precision.
    pub fn for_analysis(
        &self,
        rotor: &Rotor,
        matrices: &Matrices,
        cut: f64,
        limit: f64,
    ) -> Result<Self, RotorError> {
        let kept = unit_forces(rotor.size(), &rotor.kept());
        let slow = self.frequencies.partition_point(|omega| *omega <= limit);
        let moments = &matrices.gyroscopic * self.shapes.columns(0, slow);
        let mut forces = DMatrix::zeros(rotor.size(), kept.ncols() + slow);
        forces.columns_mut(0, kept.ncols()).copy_from(&kept);
        forces.columns_mut(kept.ncols(), slow).copy_from(&moments);
        self.reduced(cut, &forces)
    }

    /// Number of coordinates.
    #[must_use]
    pub fn len(&self) -> usize {
        self.frequencies.len()
    }

    /// Whether there is no coordinate.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.frequencies.is_empty()
    }

    /// Deflection at coordinate `a` under a unit force at `b` that goes as e^{st}, undamped and at rest, m/N.
    #[must_use]
    pub fn receptance(&self, a: usize, b: usize, s: C64) -> C64 {
        let terms = self.frequencies.iter().enumerate().map(|(k, omega)| {
            C64::from(self.shapes[(a, k)] * self.shapes[(b, k)]) / (s * s + omega * omega)
        });
        terms.sum()
    }

    /// Largest error of the receptances between the coordinates `kept` for frequencies `from` to `to` (rad/s), against the
    /// full basis: relative to Σφ²/|ω² + s²| of the first coordinate, with s = ω(0.02 + j).
    #[must_use]
    pub fn receptance_error(&self, full: &Self, kept: &[usize], from: f64, to: f64) -> f64 {
        const POINTS: usize = 40;
        let mut worst = 0.0_f64;
        for point in 0..POINTS {
            let omega = from * (to / from).powf(point as f64 / (POINTS - 1) as f64);
            let s = C64::new(0.02, 1.0) * omega;
            for a in kept {
                let scale: f64 = (full.frequencies.iter().enumerate())
                    .map(|(k, own)| full.shapes[(*a, k)].powi(2) / (s * s + own * own).norm())
                    .sum();
                for b in kept {
                    let error = self.receptance(*a, *b, s) - full.receptance(*a, *b, s);
                    worst = worst.max(error.norm() / scale);
                }
            }
        }
        worst
    }
}

impl Rotor {
    /// The coordinates that a reduction keeps: displacements where supports, seals and unbalances act.
    #[must_use]
    pub fn kept(&self) -> Vec<usize> {
        let supports = self.supports.iter().filter_map(|support| match support.at {
            Place::Node(node) => Some(node),
            Place::Housing(_) => None,
        });
        let mut nodes: Vec<usize> = supports
            .chain(self.unbalance.iter().map(|u| u.node))
            .collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes.into_iter().map(|n| self.displacement(n)).collect()
    }
}

/// A unit force at each of these coordinates.
#[must_use]
pub fn unit_forces(size: usize, coordinates: &[usize]) -> DMatrix<f64> {
    let mut out = DMatrix::zeros(size, coordinates.len());
    for (j, i) in coordinates.iter().enumerate() {
        out[(*i, j)] = 1.0;
    }
    out
}

/// Eigenvalues and vectors of a symmetric matrix.
pub(crate) fn symmetric(
    matrix: DMatrix<f64>,
) -> Result<SymmetricEigen<f64, nalgebra::Dyn>, RotorError> {
    if !matrix.iter().all(|value| value.is_finite()) {
        return Err(RotorError::NotConverged);
    }
    let most = 200 * matrix.nrows();
    SymmetricEigen::try_new(matrix, f64::EPSILON, most).ok_or(RotorError::NotConverged)
}

/// Rigid motions of the shaft: the same displacement everywhere, and a turn about the middle.
fn rigid(rotor: &Rotor) -> [DVector<f64>; RIGID] {
    let middle = rotor.nodes.iter().sum::<f64>() / rotor.nodes.len() as f64;
    let shaft = 2 * rotor.nodes.len();
    let shift = DVector::from_fn(shaft, |i, _| if i % 2 == 0 { 1.0 } else { 0.0 });
    let turn = DVector::from_fn(shaft, |i, _| match i % 2 {
        0 => rotor.nodes[i / 2] - middle,
        _ => 1.0,
    });
    [shift, turn]
}
