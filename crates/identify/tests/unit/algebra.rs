use super::*;

#[test]
fn a_factor_solves_and_knows_its_determinant() {
    // By hand: L = [[2,0,0],[1,3,0],[-1,½,1]], det = 36.
    let matrix = DMatrix::from_row_slice(3, 3, &[4.0, 2.0, -2.0, 2.0, 10.0, 0.5, -2.0, 0.5, 2.25]);
    let factor = Factor::of(matrix.clone()).expect("positive definite");
    assert!((factor.log_determinant - 36_f64.ln()).abs() < 1e-14);
    let right = [1.0, -2.0, 3.0];
    let mut solution = right;
    factor.solve(&mut solution);
    let back = &matrix * DVector::from_row_slice(&solution);
    assert!(back.iter().zip(right).all(|(a, b)| (a - b).abs() < 1e-13));
    // L⁻¹ (1, -2, 3) by hand: ½, -5/6, 3 + ½ + 5/12
    let mut white = right;
    factor.whiten(&mut white);
    for (found, expected) in white.iter().zip([0.5, -2.5 / 3.0, 3.5 + 1.25 / 3.0]) {
        assert!((found - expected).abs() < 1e-14, "{white:?}");
    }
    // the same of (0, -2, 3) from its second entry on, and L⁻ᵀ L⁻¹ = A⁻¹
    let (mut whole, mut part) = ([0.0, -2.0, 3.0], [0.0, -2.0, 3.0]);
    factor.whiten(&mut whole);
    factor.whiten_from(1, &mut part);
    assert_eq!(whole, part);
    factor.unwhiten_transposed(&mut white);
    assert!(
        white
            .iter()
            .zip(solution)
            .all(|(a, b)| (a - b).abs() < 1e-14)
    );
}
#[test]
fn what_is_not_positive_has_no_factor() {
    for wrong in [[1.0, 2.0, 2.0, 1.0], [f64::NAN; 4], [f64::INFINITY; 4]] {
        assert!(Factor::of(DMatrix::from_row_slice(2, 2, &wrong)).is_none());
    }
}
#[test]
fn large_exponents_do_not_overflow() {
    assert!((log_sum_exp(&[1000.0, 1000.0]) - 1000.0 - 2_f64.ln()).abs() < 1e-12);
    assert_eq!(log_sum_exp(&[]), f64::NEG_INFINITY);
}
