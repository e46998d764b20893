use super::super::{LossPoint, State};
use super::*;

/// At rest until 1 s, 100 rad/s from then on to 5 s; t_O - M as given over time, known while it turns.
fn made_up(excess: impl Fn(f64) -> f64) -> (Measurement, Loss) {
    let time: Vec<f64> = (0..600).map(|k| 0.01 * f64::from(k)).collect();
    let count = time.len();
    let speed: Vec<f64> = (time.iter())
        .map(|t| if (1.0..5.005).contains(t) { 100.0 } else { 0.0 })
        .collect();
    let points = (time.iter().zip(&speed))
        .map(|(&time, &speed)| LossPoint {
            time,
            speed,
            acceleration: 0.0,
            state: State::Unknown,
            excess: (speed > 0.0).then(|| Uncertain::new(excess(time), 0.4e-3)),
            friction: None,
        })
        .collect();
    let test = Measurement {
        name: "test".into(),
        load: 60.0,
        speed_deviation: vec![0.1; count],
        acceleration: vec![0.0; count],
        acceleration_deviation: vec![1.0; count],
        torque: vec![0.0; count],
        torque_deviation: vec![1e-3; count],
        zero_deviation: 0.0,
        scale_deviation: 0.0,
        correlation_time: vec![0.02; count],
        engagement: Some(1.0),
        engagement_deviation: 0.0,
        rest_before: None,
        cage: None,
        temperature: None,
        speed,
        time,
    };
    let loss = Loss {
        points,
        notes: Vec::new(),
    };
    (test, loss)
}

#[test]
fn each_part_has_its_mean_and_the_deviation_of_one_value() {
    // falls by 1 N mm a second from the engagement on
    let (test, loss) = made_up(|t| -1e-3 * (t - 1.0));
    assert_eq!((test.begin(), test.last_at_speed()), (1.0, 5.0));
    let settled = loss.settled_excess(&test).unwrap();
    assert!((settled.value + 0.3e-3).abs() < 6e-6 && (settled.deviation - 0.4e-3).abs() < 1e-12);
    let end = loss.excess_at_end(&test).unwrap();
    assert!((end.value + 3.75e-3).abs() < 6e-6);
    assert_eq!(loss.off_the_moment(&test), Some(end));
    // where nothing is known there is no mean
    assert_eq!(loss.mean_excess(0.0, 0.9), None);
    assert_eq!(loss.mean_excess(5.1, 5.9), None);
}
#[test]
fn within_three_deviations_the_moment_holds() {
    for (size, off) in [
        (1.1e-3, false),
        (-1.1e-3, false),
        (1.3e-3, true),
        (-1.3e-3, true),
    ] {
        let (test, loss) = made_up(|_| size);
        assert_eq!(loss.off_the_moment(&test).is_some(), off, "{size}");
    }
    // an end that is not known: the settled part counts
    let (test, mut loss) = made_up(|_| 2e-3);
    for point in loss.points.iter_mut().filter(|point| point.time > 2.0) {
        point.excess = None;
    }
    assert!(loss.off_the_moment(&test).is_some());
    for point in &mut loss.points {
        point.excess = None;
    }
    assert_eq!(loss.off_the_moment(&test), None);
}
