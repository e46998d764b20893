use super::super::steady::{Continued, known};
use super::*;

fn table() -> Table {
    Continued(&known(vec![1.0, 150.0], vec![20e-3, 20e-3])).table(150.0)
}

/// Up in 0.1 s, held for 5 s, down in 1.5 s, a second of rest.
fn course(t: f64) -> f64 {
    150.0 * (t / 0.1).clamp(0.0, 1.0) * (1.0 - (t - 5.1) / 1.5).clamp(0.0, 1.0)
}

#[test]
fn means_lie_side_by_side_and_none_spans_much_change() {
    let test = Trial::planned(&course, 7.6, &LeastWidth::even(0.02), &table(), 0.0);
    let mut from = 0.0;
    for bin in &test.bins {
        assert_eq!(bin.from, from);
        from = bin.to;
        let change = (course(bin.to) - course(bin.from)).abs();
        // a mean of the least width may span more; a remnant at a border at most doubles the last one
        let allowed = 0.35 * 150.0_f64;
        assert!(change < allowed, "{bin:?}");
    }
    assert!((from - 7.6).abs() < 0.011);
    // few enough to count as independent, and closer where more happens
    assert!((25..60).contains(&test.bins.len()), "{}", test.bins.len());
    // one border is the standstill: no mean mixes turning and rest
    let stop = 6.6 - 1.5 * REST;
    assert!(test.bins.iter().any(|bin| (bin.from - stop).abs() < 0.01));
    assert!((test.steps.iter().map(|s| s.duration).sum::<f64>() - from).abs() < 1e-9);
}
#[test]
fn the_mean_of_a_constant_is_the_constant() {
    let test = Trial::planned(&course, 7.6, &LeastWidth::even(0.02), &table(), 0.0);
    for mean in test.means(test.steps.iter().map(|_| 3.0)) {
        assert!((mean - 3.0).abs() < 1e-9);
    }
}
/// A spin-up of 13 s whose torque is smoothed over 20 ms until half a second after it, over 0.2 s later.
fn smoothed_more_in_the_hold() -> Measurement {
    let time: Vec<f64> = (0..6500).map(|i| f64::from(i) * 2e-3).collect();
    let count = time.len();
    let cage_speed = |t: f64| 0.4 * course(t - 0.4);
    // balls pass every 0.6 rad of the cage
    let (mut angle, mut passed) = (0.0, Vec::new());
    for pair in time.windows(2) {
        let before = (angle / 0.6_f64).floor();
        angle += cage_speed(pair[1]) * (pair[1] - pair[0]);
        if (angle / 0.6).floor() > before {
            passed.push(pair[1]);
        }
    }
    Measurement {
        name: "long".into(),
        load: 50.0,
        speed: time.iter().map(|t| course(t - 0.4)).collect(),
        speed_deviation: vec![0.1; count],
        acceleration: vec![0.0; count],
        acceleration_deviation: vec![1.0; count],
        torque: vec![0.0; count],
        torque_deviation: vec![0.5e-3; count],
        correlation_time: (time.iter())
            .map(|t| if *t < 0.9 { 0.02 } else { 0.2 })
            .collect(),
        time,
        zero_deviation: 0.0,
        scale_deviation: 0.0,
        engagement: Some(0.4),
        engagement_deviation: 0.0,
        rest_before: None,
        cage: Some({
            let (speed, deviation) = (
                passed.iter().map(|t| cage_speed(*t)).collect(),
                vec![0.1; passed.len()],
            );
            CageTrace::independent(passed, speed, deviation)
        }),
        temperature: None,
    }
}

#[test]
fn a_long_hold_leaves_the_means_of_the_spin_up_as_they_are() {
    let long = smoothed_more_in_the_hold();
    let whole = Trial::measured(&long, &table(), 0.0);
    let cut = Trial::measured(&long.between(0.0, 1.2), &table(), 0.0);
    let early = |test: &Trial| -> Vec<(f64, f64)> {
        let bins = test.bins.iter().filter(|bin| bin.to < 0.4 && !bin.before);
        bins.map(|bin| (bin.from, bin.to)).collect()
    };
    let parts = early(&whole);
    assert_eq!(parts, early(&cut));
    // two correlation times each at first; one time for all would be 0.4 s
    assert!(
        parts.len() > 5 && (parts[0].1 - 0.04).abs() < 1e-9,
        "{parts:?}"
    );
    for bin in &whole.bins {
        assert!(bin.from < 0.4 || bin.to - bin.from > 0.19, "{bin:?}");
    }
}
#[test]
fn a_mean_of_the_cage_is_one_over_time() {
    let long = smoothed_more_in_the_hold();
    let test = Trial::measured(&long, &table(), 0.0);
    let predicted = test.cage_means(test.steps.iter().map(|s| 0.4 * s.middle_speed));
    for (bin, predicted) in test.bins.iter().zip(predicted) {
        let Some(mean) = bin.cage else { continue };
        // straight between balls 10 ms apart at full speed, and steps of some ms: a few tenths of a per cent of 60 rad/s;
        // a mean over balls would be 2 rad/s too high while the cage is braked
        assert!((mean.speed - predicted).abs() < 0.2, "{bin:?} {predicted}");
    }
}
#[test]
fn a_torque_that_is_zero_by_definition_is_no_value() {
    let mut long = smoothed_more_in_the_hold();
    let before = |test: &Measurement| {
        let test = Trial::measured(test, &table(), 0.0);
        test.bins.iter().any(|bin| bin.before)
    };
    assert!(before(&long));
    long.zero_deviation = 1e-3;
    assert!(!before(&long));
}
#[test]
fn noise_counts_by_its_correlation_time_and_zero_and_scale_apart() {
    let time: Vec<f64> = (0..4000).map(|i| f64::from(i) * 2e-3).collect();
    let count = time.len();
    let measurement = Measurement {
        name: "constant".into(),
        load: 50.0,
        speed: time.iter().map(|t| course(t - 0.4)).collect(),
        speed_deviation: vec![0.1; count],
        acceleration: vec![0.0; count],
        acceleration_deviation: vec![1.0; count],
        torque: vec![10e-3; count],
        // 0.3 noise, 0.4 zero, no scale: √(0.3² + 0.4²)
        torque_deviation: vec![0.5e-3; count],
        time,
        zero_deviation: 0.4e-3,
        scale_deviation: 0.0,
        correlation_time: vec![0.02; count],
        engagement: Some(0.4),
        engagement_deviation: 0.0,
        rest_before: None,
        cage: None,
        temperature: None,
    };
    let test = Trial::measured(&measurement, &table(), 0.0);
    for bin in &test.bins {
        let width = bin.to - bin.from;
        // errors alike by e^(-|Δt|/10 ms): of a long mean σ √(20 ms/T), of a short one less than that
        let part = 0.02 / width;
        let expected = 0.3e-3 * (part * (1.0 - 0.5 * part * (1.0 - (-2.0 / part).exp()))).sqrt();
        assert!((bin.torque - 10e-3).abs() < 1e-12);
        // values 2 ms apart instead of an integral, and up to one of 20 more or less in a mean
        assert!(
            (bin.variance.sqrt() / expected - 1.0).abs() < 0.03,
            "{width}"
        );
    }
    let before = test
        .bins
        .iter()
        .find(|bin| bin.before)
        .expect("rest before");
    assert!((before.to - before.from - 0.38).abs() < 1e-9 && before.speed == 0.0);
}
