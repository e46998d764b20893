use super::*;

const LAW: Windage = Windage::Law {
    coefficients: [1e-3, 2e-5, 1e-7],
    deviation: 0.1,
};

#[test]
fn a_windage_is_taken_out_with_its_error_and_that_of_the_inertia() {
    // by hand at 100 rad/s: 1 + 2 + 1 N mm
    assert!((LAW.at(100.0).unwrap() - 4e-3).abs() < 1e-15);
    let mut curve = SteadyCurve {
        speed: vec![100.0],
        torque: vec![10e-3],
        covariance: vec![vec![0.0]],
        scale_deviation: 0.02,
        ..SteadyCurve::default()
    };
    LAW.taken_out(&mut curve);
    assert!((curve.torque[0] - 6e-3).abs() < 1e-15);
    // the inertia's 2 % of the whole 10 N mm, the windage's 10 % of 4
    let wanted = (0.02_f64 * 10e-3).hypot(0.1 * 4e-3);
    assert!((curve.whole_deviation()[0] / wanted - 1.0).abs() < 1e-12);
}

#[test]
fn a_curve_reaches_a_little_beyond_its_ends() {
    let curve = Windage::Curve(SteadyCurve {
        speed: vec![0.0, 20.0, 60.0, 120.0],
        torque: vec![f64::NAN, 1e-3, 3e-3, 5e-3],
        covariance: vec![vec![1e-8; 4]; 4],
        ..SteadyCurve::default()
    });
    assert!((curve.at(40.0).unwrap() - 2e-3).abs() < 1e-15);
    assert!((curve.at(124.0).unwrap() - 5e-3).abs() < 1e-15);
    assert!(curve.at(130.0).is_none() && curve.at(10.0).is_none());
    assert!((curve.covariance(40.0, 90.0).unwrap() - 1e-8).abs() < 1e-20);
}

#[test]
fn the_torque_of_a_coast_down_is_the_inertia_times_its_slope() {
    let set = RollingSet {
        inner_track_radius: 15e-3,
        ball_ratio: 0.2,
        balls_mass: 0.01,
        cage_mass: 5e-3,
    };
    // M = 8 N mm + the windage, I = 4e-4: Euler's steps of 10 ms
    let inertia = 4e-4;
    let mut speed = vec![150.0];
    while speed.len() < 400 {
        let last: f64 = speed[speed.len() - 1];
        speed.push(last - 0.01 * (8e-3 + LAW.at(last).unwrap()) / inertia);
    }
    let run = Coasting {
        name: "coast",
        load: 60.0,
        clock: (0.0, 0.01),
        speed: &speed,
        inertia: Uncertain::new(inertia, 0.01 * inertia),
        windage: Some(&LAW),
        set: &set,
    };
    let found = coasting(&run).unwrap();
    assert_eq!(found.time.len(), 399);
    assert!(found.sound().is_ok());
    for k in [0, 200, 398] {
        let moment = found.torque[k] + set.outer_inertia() * found.acceleration[k];
        // the windage at the middle of a step beside that at its begin: 0.005 of it
        assert!((moment / 8e-3 - 1.0).abs() < 5e-3, "{moment}");
    }
    let short = Coasting {
        speed: &speed[..10],
        ..run
    };
    assert!(coasting(&short).unwrap_err().contains("24 are needed"));
}
