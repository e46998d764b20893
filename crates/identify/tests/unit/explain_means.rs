use super::*;

#[test]
fn rows_that_lie_closer_weigh_no_more() {
    // 2 ms apart, and a hundred rows within the fourth millisecond: the torque rises evenly by 1 N mm a ms
    let mut time: Vec<f64> = (0..10).map(|k| 2e-3 * f64::from(k)).collect();
    time.extend((1..100).map(|k| 4e-3 + 1e-5 * f64::from(k)));
    time.sort_by(f64::total_cmp);
    let torque: Vec<f64> = time.iter().map(|t| 1.0 * t).collect();
    let age = vec![0.0; time.len()];
    let found = mean(&time, &torque, &|_| 0.5, &age, (1e-3, 9e-3));
    let (_, value, variance) = found.expect("it covers that time");
    // by hand: the middle, and errors that are all one
    assert!((value - 5e-3).abs() < 1e-15 && (variance - 0.25).abs() < 1e-12);
    assert!(mean(&time, &torque, &|_| 0.5, &age, (0.1, 0.2)).is_none());
}
