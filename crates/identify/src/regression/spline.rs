//! Cubic B-splines on equal knots, their coefficients drawn to a polynomial as strongly as the data say.
//!
//! Source: Eilers and Marx, Statist. Sci. 11 (1996) 89 (from memory), with proper priors in place of their penalty.

use nalgebra::{DMatrix, DVector};

/// Number of B-splines.
pub(crate) const SPLINES: usize = 16;

/// Weights of the coefficients in the curve (`derivative` 0) or its slope (1); a place beyond the range counts as its end.
///
/// - `range`: of the places
pub(crate) fn row(x: f64, range: (f64, f64), derivative: usize) -> Vec<f64> {
    let pieces = (SPLINES - 3) as f64;
    let per_unit = pieces / (range.1 - range.0);
    let place = ((x - range.0) * per_unit).clamp(0.0, pieces);
    let first = (place as usize).min(SPLINES - 4);
    let u = place - first as f64;
    let v = 1.0 - u;
    let weights = if derivative == 0 {
        [
            v * v * v,
            3.0 * u * u * u - 6.0 * u * u + 4.0,
            3.0 * v * v * v - 6.0 * v * v + 4.0,
            u * u * u,
        ]
        .map(|weight| weight / 6.0)
    } else {
        [-v * v, 3.0 * u * u - 4.0 * u, 4.0 * v - 3.0 * v * v, u * u]
            .map(|weight| 0.5 * per_unit * weight)
    };
    let mut row = vec![0.0; SPLINES];
    row[first..first + 4].copy_from_slice(&weights);
    row
}

/// Prior precisions, one for each smoothness: a polynomial of a degree below `order` of the coefficients is as wide as the level,
/// their differences of that order are as small as the smoothness says.
///
/// - `smoothness`: standard deviations of the differences, parts of the level
pub(crate) fn precisions(level: f64, order: usize, smoothness: &[f64]) -> Vec<DMatrix<f64>> {
    let middle = 0.5 * (SPLINES - 1) as f64;
    let mut wide = DMatrix::zeros(SPLINES, SPLINES);
    let mut polynomials: Vec<DVector<f64>> = Vec::new();
    let mut difference = DMatrix::identity(SPLINES, SPLINES);
    for degree in 0..order {
        let mut polynomial =
            DVector::from_fn(SPLINES, |i, _| (i as f64 - middle).powi(degree as i32));
        for other in &polynomials {
            polynomial -= other * other.dot(&polynomial);
        }
        polynomial.normalize_mut();
        wide += &polynomial * polynomial.transpose();
        polynomials.push(polynomial);
        let count = difference.nrows() - 1;
        difference = difference.rows(1, count) - difference.rows(0, count);
    }
    let differences = difference.tr_mul(&difference);
    let width = SPLINES as f64 * level * level;
    smoothness
        .iter()
        .map(|part| &wide / width + &differences / (part * level).powi(2))
        .collect()
}

#[cfg(test)]
#[path = "../../tests/unit/regression_spline.rs"]
mod tests;
