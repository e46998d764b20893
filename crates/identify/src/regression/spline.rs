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
mod tests {
    use super::*;

    #[test]
    fn splines_sum_to_one_and_follow_a_straight_line() {
        let range = (10.0, 110.0);
        for x in [10.0, 17.3, 60.0, 99.9, 110.0] {
            let (values, slopes) = (row(x, range, 0), row(x, range, 1));
            assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-14);
            assert!(slopes.iter().sum::<f64>().abs() < 1e-14);
            // Coefficients on the line of the knots' averages give the line: width 100/13 a piece, first average one before.
            let width = 100.0 / 13.0;
            let line = |row: &[f64]| -> f64 {
                row.iter()
                    .enumerate()
                    .map(|(i, w)| w * (10.0 + width * (i as f64 - 1.0)))
                    .sum()
            };
            assert!((line(&values) - x).abs() < 1e-12);
            assert!((line(&slopes) - 1.0).abs() < 1e-12);
        }
        let h = 1e-5;
        let (up, down) = (row(50.0 + h, range, 0), row(50.0 - h, range, 0));
        for ((up, down), slope) in up.iter().zip(&down).zip(row(50.0, range, 1)) {
            assert!((up - down - 2.0 * h * slope).abs() < 1e-13);
        }
    }

    #[test]
    fn a_polynomial_is_as_wide_as_the_level_and_costs_nothing_else() {
        for order in [2, 3] {
            let [wide, narrow] = &precisions(4.0, order, &[8.0, 0.125])[..] else {
                unreachable!("two");
            };
            let of = |precision: &DMatrix<f64>, c: &DVector<f64>| c.dot(&(precision * c));
            // a constant of the level: (c/level)² = 1; the differences, whose precisions are 0.02 at most, leave 1e-14 of rounding
            assert!((of(wide, &DVector::repeat(SPLINES, 4.0)) - 1.0).abs() < 1e-12);
            let cost = |c: &DVector<f64>| of(narrow, c);
            // i^order has differences of order!: all but `order` of them, over 1/8 of the level, and what a polynomial of lower
            // degree has of it, at most (15^order/4)²
            let power = DVector::from_fn(SPLINES, |i, _| (i as f64).powi(order as i32));
            let factorial = if order == 2 { 2.0 } else { 6.0 };
            let rough = (SPLINES - order) as f64 * (factorial / 0.5_f64).powi(2);
            let smooth = cost(&power) - rough;
            assert!(smooth > 0.0 && smooth < (15_f64.powi(order as i32) / 4.0).powi(2));
        }
    }
}
