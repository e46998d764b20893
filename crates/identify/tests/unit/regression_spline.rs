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
