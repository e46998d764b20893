//! Linear least squares whose coefficients are known as weights on the values, so that noise of any correlation goes through exactly.

use crate::linear;

/// A straight-line model v = Σ c_k f_k, by its functions at the places of the values.
pub struct LeastSquares<const N: usize> {
    rows: Vec<[f64; N]>,
    inverse: [[f64; N]; N],
}

impl<const N: usize> LeastSquares<N> {
    /// Of the functions at each value, all of one size; none where the values do not tell them apart.
    pub fn new(rows: Vec<[f64; N]>) -> Option<Self> {
        let mut normal = [[0.0; N]; N];
        for row in &rows {
            for (i, k) in (0..N).flat_map(|i| (0..N).map(move |k| (i, k))) {
                normal[i][k] += row[i] * row[k];
            }
        }
        let inverse = linear::inverse(normal, 1e-9)?;
        (rows.len() >= N).then_some(LeastSquares { rows, inverse })
    }

    /// Weights of the values in each coefficient.
    pub fn weights(&self) -> [Vec<f64>; N] {
        self.inverse.map(|own| {
            let weight = |row: &[f64; N]| row.iter().zip(own).map(|(f, g)| f * g).sum();
            self.rows.iter().map(weight).collect()
        })
    }

    /// Values less those of coefficients.
    pub fn residuals(&self, coefficients: &[f64; N], values: &[f64]) -> Vec<f64> {
        let model =
            |row: &[f64; N]| -> f64 { row.iter().zip(coefficients).map(|(f, c)| f * c).sum() };
        let both = self.rows.iter().zip(values);
        both.map(|(row, value)| value - model(row)).collect()
    }
}
