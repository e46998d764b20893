use super::*;

/// Values about 1000 that scatter by 0.7, as one stretch or as two.
fn scattered(stretches: &[Range<usize>]) -> Data {
    let y: Vec<f64> = (0..100)
        .map(|k| 1000.0 + (f64::from(k * k) * 12.9898).sin())
        .collect();
    Data {
        x: vec![0.0; y.len()],
        y,
        stretches: stretches.to_vec(),
    }
}

#[test]
fn points_of_the_grid_that_are_left_out_do_not_widen_the_band() {
    let one = DMatrix::from_element(100, 1, 1.0);
    for stretches in [std::iter::once(0..100).collect(), vec![0..60, 60..100]] {
        let data = scattered(&stretches);
        let found = weighed(&data, &one, &[DMatrix::from_element(1, 1, 1e-12)]).unwrap();
        let mean = data.y.iter().sum::<f64>() / 100.0;
        let deviation = found.covariance[(0, 0)].sqrt();
        assert!((found.mean[0] - mean).abs() < 0.05, "{}", found.mean[0]);
        // 0.7/√100, and up to twice that where some correlation is possible; a part of 1e-5 of 1000² would be 3
        assert!((0.06..0.15).contains(&deviation), "{deviation}");
        assert!(found.correlation < 0.3);
    }
}

#[test]
fn a_stretch_of_two_means_is_left_out() {
    let mut data = Data::default();
    let (x, y) = ([1.0, 3.0, 5.0, 7.0, 9.0, 11.0, 13.0], [2.0; 7]);
    assert_eq!(data.add(&x[..5], &y[..5], &[1.0; 5], 2), 0);
    assert_eq!(data.add(&x, &y, &[1.0, 3.0, 1.0, 1.0, 1.0, 1.0, 1.0], 2), 6);
    assert_eq!(
        (data.x, data.stretches),
        (vec![2.5, 6.0, 10.0], std::iter::once(0..3).collect())
    );
}
