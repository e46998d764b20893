use super::*;
use crate::CageTrace;
use crate::explain::steady::known;

#[test]
fn what_is_not_known_of_the_motion_is_not_known_of_the_torque() {
    // slope 0.1 N mm s from 10 rad/s on; below, 2 N mm over 10 rad/s
    let mut steady = known(vec![10.0, 30.0], vec![2e-3, 4e-3]);
    steady.covariance = vec![vec![0.0; 2]; 2];
    let set = RollingSet {
        inner_track_radius: 15e-3,
        ball_ratio: 0.2,
        balls_mass: 10e-3,
        cage_mass: 8e-3,
    };
    let time: Vec<f64> = (0..100).map(|k| 1e-3 * f64::from(k)).collect();
    let count = time.len();
    let test = Measurement {
        name: "test".into(),
        load: 60.0,
        speed: (0..count)
            .map(|k| if k < 50 { 5.0 } else { 20.0 })
            .collect(),
        speed_deviation: vec![2.0; count],
        acceleration: (0..count)
            .map(|k| if k == 70 { -4000.0 } else { 10.0 })
            .collect(),
        acceleration_deviation: vec![100.0; count],
        torque: vec![3e-3; count],
        torque_deviation: vec![0.5e-3; count],
        zero_deviation: 0.0,
        scale_deviation: 0.0,
        correlation_time: vec![0.01; count],
        engagement: None,
        engagement_deviation: 0.0,
        rest_before: None,
        cage: Some(CageTrace::independent(
            vec![0.0, 0.05],
            vec![0.0, 8.0],
            vec![0.3; 2],
        )),
        temperature: None,
        time,
    };
    let how = PredictionErrors {
        locking_window: 0.0055,
        rolling_ratio_deviation: 0.05,
    };
    let wide = with_prediction_errors(&test, &steady, &set, &how);
    let inertia = set.outer_inertia() * 100.0;
    let near = |k: usize, expected: f64| {
        assert!(
            (wide.torque_deviation[k] / expected - 1.0).abs() < 1e-12,
            "{k}"
        );
    };
    near(10, 0.5e-3_f64.hypot(0.4e-3).hypot(inertia));
    near(60, 0.5e-3_f64.hypot(0.2e-3).hypot(inertia));
    // a jump of the inertia's part within 5.5 ms of the peak, and not beyond
    let jump = set.outer_inertia() * 4000.0;
    for (k, inside) in [(64, false), (65, true), (75, true), (76, false)] {
        let own = 0.5e-3_f64.hypot(0.2e-3).hypot(inertia);
        near(k, if inside { own.hypot(jump) } else { own });
    }
    let cage = wide.cage.unwrap();
    assert_eq!(cage.deviation, vec![0.3, 0.3_f64.hypot(0.4)]);
    // nothing else changes
    assert_eq!((&wide.torque, &wide.speed), (&test.torque, &test.speed));
}
