use super::super::steady::known;
use super::*;

#[test]
fn a_range_ends_at_its_quantiles() {
    let range = Range::new(0.2, 0.8);
    for (z, value) in [(-QUANTILE, 0.2), (QUANTILE, 0.8)] {
        assert!((range.positive(z) - value).abs() < 1e-12);
        assert!((range.share(z) - value).abs() < 1e-12);
    }
    // medians: geometric mean of a positive quantity, ½ of a share symmetric about it
    assert!((range.positive(0.0) - 0.4).abs() < 1e-12);
    assert!((range.share(0.0) - 0.5).abs() < 1e-12);
}
#[test]
fn the_load_part_comes_from_the_intercept_of_the_curve() {
    let curve = |load: f64| {
        let speed: Vec<f64> = (1..=15).map(|i| 10.0 * f64::from(i)).collect();
        let moment = (speed.iter())
            .map(|w| 25e-3 * (load + (1.0 - load) * (w / 150.0).powf(2.0 / 3.0)))
            .collect();
        known(speed, moment)
    };
    // Palmgren: 10 % of M at 150 rad/s is load part; up to 3 % more with another exponent
    let range = share_of(&curve(0.1), 150.0);
    assert!((1.0 - range.low - 0.13).abs() < 1e-9 && (1.0 - range.high - 0.1).abs() < 1e-9);
    // a lightly loaded bearing with 0.7 % lies within
    let light = share_of(&curve(0.007), 150.0);
    assert!(light.low < 0.993 && light.high >= 0.993 - 1e-9);
    // an error all moments share in N m is one of the intercept: 0.1 N mm of 25
    let mut shifted = curve(0.1);
    shifted.covariance = vec![vec![1e-8; 15]; 15];
    let wide = share_of(&shifted, 150.0);
    assert!((wide.high - range.high - QUANTILE * 0.1 / 25.0).abs() < 1e-6);
    // one speed alone shows nothing, and a flat curve has all of it: still ranges
    for curve in [
        known(vec![100.0], vec![20e-3]),
        known(vec![50.0, 100.0], vec![20e-3; 2]),
    ] {
        let Range { low, high } = share_of(&curve, 150.0);
        assert!(0.0 < low && low < high && high < 1.0);
    }
}
