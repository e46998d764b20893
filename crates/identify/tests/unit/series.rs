use super::*;

#[test]
fn the_running_variance_is_the_double_sum() {
    let time = [0.0, 0.3, 0.35, 1.0, 1.2];
    let factor = [1.0, -0.5, 2.0, 0.7, 0.1];
    let mut running = RunningVariance::default();
    let mut last = 0.0;
    for (t, a) in time.iter().zip(factor) {
        last = running.add(*t / 0.8, a);
    }
    let mut sum = 0.0;
    for i in 0..5 {
        for j in 0..5 {
            sum += factor[i] * factor[j] * (-2.0_f64 * (time[i] - time[j]).abs() / 0.8).exp();
        }
    }
    assert!((last / sum - 1.0).abs() < 1e-13);
}
#[test]
fn a_straight_line_is_found_with_its_rate() {
    let time: Vec<f64> = (0..50).map(|k| 0.01 * f64::from(k)).collect();
    let values: Vec<f64> = time.iter().map(|t| 3.0 - 40.0 * t).collect();
    for (rate, deviation) in rates(&time, &values, &[0.1; 50], 0.1) {
        assert!((rate + 40.0).abs() < 1e-10 && deviation > 2.4);
    }
}
