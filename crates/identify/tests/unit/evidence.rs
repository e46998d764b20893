use super::*;
use nalgebra::DVector;

#[test]
fn correlated_residuals_count_as_fewer() {
    // ±1 in turn is not positively correlated: all count
    let turns: Vec<f64> = (0..40).map(|k| f64::from(1 - 2 * (k % 2))).collect();
    assert_eq!(effective_number(std::iter::once(&turns[..])), 40.0);
    // pairs of equal values: by hand r_1 = (20 - 19)/40 of + + - - …, positive, r_2 < 0
    let pairs: Vec<f64> = (0..40).map(|k| f64::from(1 - 2 * (k / 2 % 2))).collect();
    let found = effective_number(std::iter::once(&pairs[..]));
    assert!((found - 40.0 / (1.0 + 2.0 / 40.0)).abs() < 1e-12, "{found}");
    // a slow wave of two periods counts as few, and across two records nothing is shared
    let wave: Vec<f64> = (0..200).map(|k| (f64::from(k) * 0.0628).sin()).collect();
    let slow = effective_number(std::iter::once(&wave[..]));
    assert!((2.0..7.0).contains(&slow), "{slow}");
    let two = effective_number([&wave[..], &wave[..]].into_iter());
    assert!((two / slow - 2.0).abs() < 1e-9, "{two} {slow}");
    assert_eq!(effective_number(std::iter::empty()), 0.0);
    assert_eq!(effective_number(std::iter::once(&[0.0; 5][..])), 5.0);
}

#[test]
fn no_odds_lie_beyond_the_number_of_data() {
    let logs = limited(&[-3.0, -100.0, f64::NEG_INFINITY], 2.0);
    assert_eq!(logs, [-3.0, -5.0, f64::NEG_INFINITY]);
    let shares = shares(&logs);
    assert!((shares[0] / shares[1] - 2_f64.exp()).abs() < 1e-12 && shares[2] == 0.0);
}

#[test]
fn a_linear_form_has_the_evidence_of_its_integral() {
    // y = θ x + e of two data, by the trapezoidal rule over θ
    let (x, y, noise, prior, weight) = ([1.0, 2.0], [1.5, 2.5], 0.4, 0.7, 0.5);
    let density = |theta: f64| {
        let likelihood: f64 = (x.iter().zip(&y))
            .map(|(x, y): (&f64, &f64)| {
                -0.5 * ((y - theta * x) / noise).powi(2) - 0.5 * (TAU * noise * noise).ln()
            })
            .sum();
        let before = -0.5 * prior * theta * theta + 0.5 * (prior / TAU).ln();
        (weight * likelihood + before).exp()
    };
    let step = 1e-3;
    let integral: f64 = (-8000..8000)
        .map(|k| step * density(step * f64::from(k)))
        .sum();
    let columns = DMatrix::from_columns(&[DVector::from_column_slice(&x)]);
    let precision = DMatrix::from_element(1, 1, prior);
    let found = linear(&y, &columns, &[precision], &[noise], weight);
    assert!((found - integral.ln()).abs() < 1e-9, "{found} {integral}");
}
