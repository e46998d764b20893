use super::*;

#[test]
fn squares_do_not_depend_on_the_axes() {
    // Covariance [[2, 1], [1, 2]]: inverse [[2, -1], [-1, 2]]/3; for (1, 3): (2 - 6 + 18)/3.
    let covariance = DMatrix::from_row_slice(2, 2, &[2.0, 1.0, 1.0, 2.0]);
    let none = DMatrix::zeros(2, 2);
    let (sum, directions) = squares(covariance.clone(), &none, &[1.0, 3.0]);
    assert!((directions - 2.0).abs() < 1e-12);
    assert!((sum - 14.0 / 3.0).abs() < 1e-12);
    // what is the smoothing's alone along (1, -1), of variance 1, is no direction
    let alone = DMatrix::from_row_slice(2, 2, &[0.5, -0.5, -0.5, 0.5]);
    let (sum, directions) = squares(covariance, &alone, &[3.0, 3.0]);
    assert!((directions - 1.0).abs() < 1e-12 && (sum - 6.0).abs() < 1e-12);
}
