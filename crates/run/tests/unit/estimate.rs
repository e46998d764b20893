//! Uncertainties of estimates.

use super::*;

#[test]
fn what_repeats_itself_counts_once() {
    let mut random = statistics::random::Random::new(7);
    let noise: Vec<f64> = (0..4000).map(|_| random.normal()).collect();
    assert!((repetition(&noise) - 1.0).abs() < 0.2);
    let thrice: Vec<f64> = noise.iter().flat_map(|own| [*own; 3]).collect();
    // ρ = 2/3, 1/3 of three equal neighbours: 1 + 2 (2/3 + 1/3)
    assert!((repetition(&thrice) - 3.0).abs() < 0.4);
}

#[test]
fn bounds_leave_what_the_curves_do_not_determine() {
    let (deviations, correlation) = uncertainties(&[[1e8, 1e8], [1e8, 1e8]]);
    // the sum is known, the difference has the variance of both bounds: 1/12 + 1/12, over four for each
    let known = |own: Option<f64>| (own.unwrap() - (1.0_f64 / 24.0).sqrt()).abs() < 1e-6;
    assert!(deviations.into_iter().all(known) && (correlation[0][1] + 1.0).abs() < 1e-6);
    // an input that nothing depends on has none; of little information the bounds are left
    let deviations = uncertainties(&[[1e-6, 0.0], [0.0, 0.0]]).0;
    assert!((deviations[0].unwrap() - (1.0_f64 / 12.0).sqrt()).abs() < 1e-6);
    assert_eq!(deviations[1], None);
    let (deviations, correlation) = uncertainties(&[[4e8, 1e8], [1e8, 1e8]]);
    // inverse 1/3 [[1, -1], [-1, 4]] e-8 of the curves alone
    assert!((1e4 * deviations[0].unwrap() - (1.0_f64 / 3.0).sqrt()).abs() < 1e-6);
    assert!((correlation[0][1] + 0.5).abs() < 1e-6);
}

/// Many residuals go through the means of blocks.
#[test]
fn blocks_of_residuals_repeat_as_these_do() {
    let mut random = statistics::random::Random::new(3);
    let noise: Vec<f64> = (0..20_000).flat_map(|_| [random.normal(); 4]).collect();
    // 1 + 2 (3/4 + 2/4 + 1/4)
    assert!((repetition(&noise) - 4.0).abs() < 0.4);
}
