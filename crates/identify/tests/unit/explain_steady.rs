use super::*;

fn curve() -> SteadyMoment {
    SteadyMoment {
        covariance: vec![
            vec![0.04, 0.01, 0.0],
            vec![0.01, 0.04, 0.0],
            vec![0.0, 0.0, 0.09],
        ],
        ..known(vec![10.0, 20.0, 40.0], vec![1.0, 2.0, 3.0])
    }
}

#[test]
fn the_table_follows_the_curve_and_rests_at_rest() {
    let curve = curve();
    let table = Continued(&curve).table(40.0);
    for (speed, moment) in [(15.0, 1.5), (30.0, 2.5), (-30.0, -2.5), (5.0, 1.0)] {
        // linear curve in a linear table: off by at most a knot inside an interval of 0.08 rad/s
        assert!((table.at(speed).0 - moment).abs() < 2e-3, "{speed}");
    }
    assert_eq!(table.at(0.0).0, 0.0);
}
#[test]
fn covariance_between_knots_is_that_of_linear_interpolation() {
    // by hand: var of ½(M1 + M2) = ¼(0.04 + 0.04 + 2·0.01)
    let curve = curve();
    let curve = Continued(&curve);
    assert!((curve.covariance_between(15.0, 15.0) - 0.025).abs() < 1e-12);
    assert!((curve.covariance_between(10.0, 20.0) - 0.01).abs() < 1e-12);
    assert_eq!(curve.covariance_between(0.0, 20.0), 0.0);
}
