//! Coordinates of an analysis in which stiff supports do no harm.
//!
//! A support of stiffness k adds k rᵀr to a diagonal stiffness matrix, r its row: at 10¹² N/m and more the sum has no
//! digits left for what bends. Turned so that the motions across the supports are the first coordinates, stiffest first, and the others
//! are the modes of the rotor pinned there, large numbers stand in the first rows and columns alone, and round-off of an eigenvalue
//! stays at ε of the highest.

use crate::assembly::Carried;
use crate::basis::symmetric;
use crate::{Basis, Matrices, Rotor, Support};
use nalgebra::{DMatrix, DVector};

/// Coordinates with the matrices and supports of a rotor in them.
#[derive(Debug, Clone)]
pub(crate) struct Frame {
    /// The rotor's own coordinates from these.
    pub shapes: DMatrix<f64>,
    pub matrices: Matrices,
    pub carried: Carried,
}

impl Frame {
    /// Those of a basis.
    pub fn new(rotor: &Rotor, matrices: &Matrices, basis: &Basis) -> Self {
        let mut own = matrices.project(&basis.shapes);
        own.mass = DMatrix::identity(basis.len(), basis.len());
        let squares = basis.frequencies.iter().map(|omega| omega * omega);
        own.stiffness = DMatrix::from_diagonal(&DVector::from_iterator(basis.len(), squares));
        Self {
            shapes: basis.shapes.clone(),
            matrices: own,
            carried: Carried::new(rotor).project(&basis.shapes),
        }
    }

    /// The same rotor in turned coordinates; M is 1 in both.
    pub fn turned(&self) -> Self {
        let size = self.shapes.ncols();
        let mut order: Vec<usize> = (0..self.carried.rows.len()).collect();
        order.sort_by(|a, b| {
            let of = |at: &usize| stiffest(&self.carried.rows[*at].1);
            of(b).total_cmp(&of(a))
        });
        let count = order.len().min(size);
        if count == 0 {
            return self.clone();
        }
        // An orthogonal basis that begins with the rows.
        let columns = DMatrix::from_fn(size, order.len() + size, |i, j| match order.get(j) {
            Some(at) => self.carried.rows[*at].0[(0, i)],
            None => f64::from(u8::from(j - order.len() == i)),
        });
        let mut turn = columns.qr().q();
        if count < size {
            let pinned = turn.columns(count, size - count).into_owned();
            let stiffness = pinned.tr_mul(&(&self.matrices.stiffness * &pinned));
            let Ok(eigen) = symmetric(stiffness) else {
                return self.clone();
            };
            (turn.columns_mut(count, size - count)).copy_from(&(pinned * eigen.eigenvectors));
        }
        let mut out = Self {
            shapes: &self.shapes * &turn,
            matrices: self.matrices.project(&turn),
            carried: self.carried.project(&turn),
        };
        out.matrices.mass = DMatrix::identity(size, size);
        for (rank, at) in order.iter().enumerate() {
            // what is orthogonal but for round-off
            let beyond = (rank + 1).min(size);
            let mut row = out.carried.rows[*at].0.columns_mut(beyond, size - beyond);
            row.fill(0.0);
        }
        out
    }
}

/// Largest stiffness of a support, N/m.
fn stiffest(support: &Support) -> f64 {
    let rows = support.coefficients.rows().iter();
    let all = rows.flat_map(|(_, block)| block.stiffness.into_iter().flatten());
    all.fold(0.0, |most, k| k.abs().max(most))
}
