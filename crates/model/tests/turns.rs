//! Turns of whirl, counted in succession.

use model::system::sampling::Turns;

/// Turns in both senses cancel in the net number, not in the most in succession; what is against the spin follows its sign.
#[test]
fn turns_in_one_sense_do_not_hide_those_in_the_other() {
    let mut turns = Turns::default();
    for part in [2.0, -11.0, 22.0, -0.5] {
        for _ in 0..100 {
            turns.add(part / 100.0);
        }
    }
    let near = |value: f64, wanted: f64| assert!((value - wanted).abs() < 1e-9, "{value} {wanted}");
    near(turns.net, 12.5);
    // 22 from the lowest place on, 11 from the highest before it
    for (spin, [with, against]) in [(300.0, [22.0, 11.0]), (-300.0, [11.0, 22.0])] {
        near(turns.about(spin)[0], with);
        near(turns.about(spin)[1], against);
    }
    assert_eq!(Turns::default().about(1.0), [0.0; 2]);
    // a swing to and fro adds nothing up
    let mut swing = Turns::default();
    for k in 0..1000 {
        swing.add(0.2 * f64::from(k).cos());
    }
    assert!(swing.about(1.0).iter().all(|most| *most < 0.5), "{swing:?}");
}
