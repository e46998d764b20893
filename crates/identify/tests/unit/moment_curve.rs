use super::*;

fn curve() -> SteadyMoment {
    SteadyMoment {
        load: 50.0,
        speed: vec![10.0, 20.0, 40.0],
        moment: vec![1.0, 2.0, 3.0],
        covariance: vec![
            vec![0.04, 0.02, 0.01],
            vec![0.02, 0.04, 0.02],
            vec![0.01, 0.02, 0.09],
        ],
        scale_deviation: 0.1,
    }
}

#[test]
fn odd_in_speed_and_nothing_outside() {
    let curve = curve();
    assert!(curve.sound().is_ok());
    let ahead = curve.at(30.0).unwrap();
    let back = curve.at(-30.0).unwrap();
    assert_eq!((ahead.value, back.value), (2.5, -2.5));
    assert_eq!(ahead.deviation, back.deviation);
    // mean of two: (0.04 + 2·0.02 + 0.09)/4 = 0.0425, and a tenth of 2.5
    assert!((ahead.deviation - 0.0425_f64.sqrt().hypot(0.25)).abs() < 1e-15);
    assert_eq!(curve.covariance_between(10.0, -40.0), Some(-0.01));
    assert_eq!(curve.covariance_between(-10.0, -40.0), Some(0.01));
    // a moment that noise makes negative stays so, and turns with the speed
    let negative = SteadyMoment {
        moment: vec![-1.0, 2.0, 3.0],
        ..curve.clone()
    };
    assert_eq!(negative.at(10.0).unwrap().value, -1.0);
    assert_eq!(negative.at(-10.0).unwrap().value, 1.0);
    // just above: the end, its slope of 0.05 in the deviation
    let above = curve.without_scale(40.4).unwrap();
    assert_eq!(above.value, 3.0);
    assert!((above.deviation - 0.3_f64.hypot(0.05 * 0.4)).abs() < 1e-12);
    for outside in [9.99, 40.41, -41.0, 0.0, f64::NAN] {
        assert_eq!(curve.at(outside), None);
    }
}
#[test]
fn a_broken_curve_is_refused() {
    for broken in [
        SteadyMoment {
            moment: vec![1.0],
            ..curve()
        },
        SteadyMoment {
            speed: vec![1.0, 1.0, 2.0],
            ..curve()
        },
        SteadyMoment {
            speed: vec![-1.0, 1.0, 2.0],
            ..curve()
        },
        SteadyMoment {
            moment: vec![1.0, f64::NAN, 0.0],
            ..curve()
        },
        SteadyMoment {
            scale_deviation: f64::NAN,
            ..curve()
        },
    ] {
        assert!(broken.sound().is_err());
    }
}
