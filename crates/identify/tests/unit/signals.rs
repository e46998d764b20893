use super::*;

/// Ten seconds of torque at 100 Hz.
fn times() -> Vec<f64> {
    (0..=1000).map(|k| 0.01 * f64::from(k)).collect()
}

fn torque(deviation: f64, rate_deviation: f64) -> Torque {
    let time = times();
    let all = |value: f64| vec![value; time.len()];
    Torque {
        torque: all(0.02),
        deviation: all(deviation),
        rate: all(0.0),
        rate_deviation: all(rate_deviation),
        disturbance: all(0.0),
        disturbance_deviation: all(0.0),
        disturbance_power: 0.0,
        zero: Uncertain::new(0.0, 3e-4),
        noise: 1e-3,
        shown_frequency: None,
        notes: Vec::new(),
        time,
    }
}

#[test]
fn the_zero_is_the_mean_at_rest_and_as_uncertain_as_its_parts_scatter() {
    let time = times();
    // 20 N mm until 6 s, then a swing that has settled at 7 s; at rest 0.4 N mm in four parts and 0.6 in the others
    let reading: Vec<f64> = (time.iter())
        .map(|t| match *t {
            t if t < 6.0 => 20e-3,
            t if t < 7.0 => 5e-3,
            t => [0.4e-3, 0.6e-3][(8.0 * (t - 7.0) / 3.01) as usize % 2],
        })
        .collect();
    let zero = zero_at_rest(&time, &reading, 7.0).unwrap();
    // by hand: mean 0.5, scatter √(8·0.1²/7) N mm; a sample at a border changes a part by 0.2/38
    assert!((zero.value - 0.5e-3).abs() < 3e-6, "{}", zero.value);
    assert!((zero.deviation / 0.1e-3 - (8.0_f64 / 7.0).sqrt()).abs() < 0.06);
    // half a second is the least, and a rest behind the record is none
    assert!(zero_at_rest(&time, &reading, 9.6).is_none());
    assert!(zero_at_rest(&time, &reading, 11.0).is_none());
    assert!(zero_at_rest(&[], &[], 0.0).is_none());
}
#[test]
fn errors_are_independent_after_twice_the_ratio_to_their_rate() {
    // noise of 1 N mm beside a zero of 0.3: √(1 + 0.09); its rate 25 N mm/s: 2/25 s
    let mut wide = torque((1.0_f64 + 0.09).sqrt() * 1e-3, 25e-3);
    // a time at which it is smoothed over a fifth of that
    wide.rate_deviation[300] = 125e-3;
    let times = correlation_time(&wide);
    for (time, expected) in [(0, 0.08), (299, 0.08), (300, 0.02), (1000, 0.08)] {
        assert!((times[time] - expected).abs() < 1e-12);
    }
    // no noise at all, or a quick one: the interval, twice
    for torque in [&torque(3e-4, 25e-3), &torque(1e-3, 1e3)] {
        assert!((correlation_time(torque)[500] - 0.02).abs() < 1e-12);
    }
}
#[test]
fn a_slow_test_is_cut_before_its_stop_alone() {
    let time = times();
    let count = time.len();
    let coasting = |until: f64| Measurement {
        name: "coast-down".into(),
        load: 60.0,
        speed: (time.iter())
            .map(|t| (15.0 * (until - t)).max(0.0))
            .collect(),
        speed_deviation: vec![0.1; count],
        acceleration: vec![-15.0; count],
        acceleration_deviation: vec![1.0; count],
        torque: vec![0.02; count],
        torque_deviation: vec![1e-3; count],
        time: time.clone(),
        zero_deviation: 0.0,
        scale_deviation: 0.0,
        correlation_time: vec![0.02; count],
        engagement: None,
        engagement_deviation: 0.0,
        rest_before: None,
        cage: None,
        temperature: None,
    };
    let cut = before_the_stop(&coasting(8.0), 0.5);
    // the last time that turns is 7.99 s
    assert!((cut.time.last().unwrap() - 7.49).abs() < 1e-9);
    assert_eq!(cut.time[0], 0.0);
    assert_eq!(
        before_the_stop(&coasting(20.0), 0.5).time.len(),
        count,
        "it turns to its end"
    );
}
#[test]
fn a_cage_rises_from_rest_before_its_first_ball() {
    let found = CageSpeed {
        time: vec![1.2, 1.3],
        speed: vec![40.0, 60.0],
        deviation: vec![3.0, 1.0],
        correlation_time: vec![0.02, 0.15],
        slip: vec![0.0; 2],
        slip_deviation: vec![0.1; 2],
        noise: 0.0,
        notes: Vec::new(),
    };
    let trace = cage(&found, Some(1.1));
    assert_eq!((trace.time[0], trace.speed[0]), (1.1, 0.0));
    // a quarter of 40 rad/s beside 3
    assert_eq!(trace.deviation, vec![109_f64.sqrt(), 109_f64.sqrt(), 1.0]);
    // between two balls errors are alike
    assert!((trace.correlation_time[1] - 0.1).abs() < 1e-9);
    assert_eq!(trace.correlation_time[2], 0.15);
    for without in [None, Some(1.25)] {
        assert_eq!(cage(&found, without).time, found.time);
    }
}
