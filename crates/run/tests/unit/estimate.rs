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
fn inputs_that_act_alike_have_no_uncertainty() {
    assert_eq!(uncertainties(&[[1.0, 2.0], [2.0, 4.0]]).0, [None; 2]);
    assert_eq!(
        uncertainties(&[[4.0, 0.0], [0.0, 0.0]]).0,
        [Some(0.5), None]
    );
    let (deviations, correlation) = uncertainties(&[[4.0, 1.0], [1.0, 1.0]]);
    // inverse 1/3 [[1, -1], [-1, 4]]
    assert!((deviations[0].unwrap() - (1.0_f64 / 3.0).sqrt()).abs() < 1e-12);
    assert!((correlation[0][1] + 0.5).abs() < 1e-12);
}
