//! (s - A)⁻¹ at one complex frequency after another.
//!
//! A is balanced and brought to Hessenberg form once; each frequency then costs a sweep over its upper half.

use crate::plant::Coordinates;
use crate::{C64, Refused, eigen};
use nalgebra::{DMatrix, DVector, Hessenberg};

/// The matrix of a linear system of first order, prepared for many frequencies.
#[derive(Debug, Clone)]
pub struct Resolvent {
    /// H row by row, A = S Q H Qᴴ S⁻¹.
    rows: Vec<C64>,
    /// Q.
    turn: DMatrix<C64>,
    /// S.
    scales: DVector<f64>,
}

/// What two sets of rows and columns see of the resolvent: left (s - A)⁻¹ right.
#[derive(Debug, Clone)]
pub struct Transfer<'a> {
    resolvent: &'a Resolvent,
    left: DMatrix<C64>,
    right: DMatrix<C64>,
}

impl Resolvent {
    /// Of a matrix A.
    #[must_use]
    pub fn new<T: Coordinates>(matrix: &DMatrix<T>) -> Self {
        let mut balanced = matrix.clone();
        let scales = eigen::balance(&mut balanced);
        let (turn, form) = match balanced.nrows() {
            0 | 1 => (
                DMatrix::identity(balanced.nrows(), balanced.nrows()),
                balanced,
            ),
            _ => Hessenberg::new(balanced).unpack(),
        };
        Self {
            rows: form
                .transpose()
                .iter()
                .map(|v| v.clone().complex())
                .collect(),
            turn: turn.map(T::complex),
            scales,
        }
    }

    /// (s - A)⁻¹ times a column.
    pub fn solve(&self, s: C64, right: &DVector<C64>) -> Result<DVector<C64>, Refused> {
        let inner = self.entered(&DMatrix::from_columns(std::slice::from_ref(right)));
        let found = self.swept(s, &inner)?;
        let mut out = &self.turn * found.column(0);
        for (value, scale) in out.iter_mut().zip(self.scales.iter()) {
            *value *= *scale;
        }
        Ok(out)
    }

    /// Prepared for left (s - A)⁻¹ right.
    #[must_use]
    pub fn between(&self, left: &DMatrix<C64>, right: &DMatrix<C64>) -> Transfer<'_> {
        let mut scaled = left.clone();
        for (mut column, scale) in scaled.column_iter_mut().zip(self.scales.iter()) {
            column.scale_mut(*scale);
        }
        Transfer {
            resolvent: self,
            left: scaled * &self.turn,
            right: self.entered(right),
        }
    }

    /// Qᴴ S⁻¹ times columns.
    fn entered(&self, right: &DMatrix<C64>) -> DMatrix<C64> {
        let mut scaled = right.clone();
        for (mut row, scale) in scaled.row_iter_mut().zip(self.scales.iter()) {
            row.unscale_mut(*scale);
        }
        self.turn.ad_mul(&scaled)
    }

    /// (s - H)⁻¹ times columns, by elimination of the one diagonal below, larger rows first.
    fn swept(&self, s: C64, right: &DMatrix<C64>) -> Result<DMatrix<C64>, Refused> {
        let size = right.nrows();
        let mut left: Vec<C64> = self.rows.iter().map(|value| -value).collect();
        for row in 0..size {
            left[row * size + row] += s;
        }
        let mut out = right.clone();
        for row in 1..size {
            let (above, below) = left.split_at_mut(row * size);
            let (above, below) = (&mut above[(row - 1) * size..], &mut below[..size]);
            let column = row - 1;
            if below[column].norm_sqr() > above[column].norm_sqr() {
                above[column..].swap_with_slice(&mut below[column..]);
                out.swap_rows(row - 1, row);
            }
            if below[column] == C64::from(0.0) {
                continue;
            }
            let factor = below[column] / above[column];
            for (under, over) in below[column..].iter_mut().zip(&above[column..]) {
                *under -= factor * over;
            }
            for column in 0..out.ncols() {
                let over = out[(row - 1, column)];
                out[(row, column)] -= factor * over;
            }
        }
        for row in (0..size).rev() {
            let own = &left[row * size..(row + 1) * size];
            let inverse = own[row].inv();
            if !inverse.is_finite() {
                return Err(Refused::Singular);
            }
            for column in 0..out.ncols() {
                let mut sum = out[(row, column)];
                for after in row + 1..size {
                    sum -= own[after] * out[(after, column)];
                }
                out[(row, column)] = sum * inverse;
            }
        }
        Ok(out)
    }
}

impl Transfer<'_> {
    /// left (s - A)⁻¹ right.
    pub fn at(&self, s: C64) -> Result<DMatrix<C64>, Refused> {
        Ok(&self.left * self.resolvent.swept(s, &self.right)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sweep_equals_a_general_solution_also_where_rows_must_change_places() {
        let size = 7;
        let matrix = DMatrix::from_fn(size, size, |i, j| {
            let value = ((3 * i + 5 * j + i * j) as f64).sin();
            if i == j {
                0.0
            } else {
                value * 10.0_f64.powi(i as i32 - j as i32)
            }
        });
        let resolvent = Resolvent::new(&matrix);
        let right = DVector::from_fn(size, |i, _| C64::new(1.0, i as f64));
        for s in [C64::new(0.0, 0.3), C64::new(-2.0, 5.0)] {
            let left = DMatrix::identity(size, size).map(|v: f64| s * v) - matrix.map(C64::from);
            let expected = left.lu().solve(&right).unwrap();
            let ours = resolvent.solve(s, &right).unwrap();
            assert!((&ours - &expected).norm() < 1e-11 * expected.norm());
            let row = DMatrix::from_fn(1, size, |_, j| C64::from(j as f64));
            let column = DMatrix::from_columns(std::slice::from_ref(&right));
            let seen = resolvent.between(&row, &column).at(s).unwrap()[(0, 0)];
            let expected = (row * expected)[(0, 0)];
            assert!((seen - expected).norm() < 1e-10 * expected.norm());
        }
    }
}
