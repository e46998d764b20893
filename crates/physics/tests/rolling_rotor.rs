//! The rotor that rolls in a bore under its weight, and the unbalance that it has.

use physics::rolling_rotor::{contact_stiffness, pendulum_stiffness, penetration};
use physics::support::weight_share;
use physics::unbalance::{residual, shares};

#[test]
fn contact_follows_its_law() {
    let (k, n, load) = (5e8, 10.0 / 9.0, 120.0);
    let depth = penetration(k, n, load);
    assert!((k * depth.powf(n) / load - 1.0).abs() < 1e-12);
    let force = |d: f64| k * d.powf(n);
    let slope = (force(1.001 * depth) - force(0.999 * depth)) / (0.002 * depth);
    assert!((contact_stiffness(k, n, load) / slope - 1.0).abs() < 1e-6);
    // a linear contact has its stiffness at every load
    assert!((contact_stiffness(k, 1.0, load) / k - 1.0).abs() < 1e-12);
}

/// The potential of a weight on a circle of radius ε is that of a spring N/ε, to the second order.
#[test]
fn pendulum_has_the_frequency_of_its_length() {
    let (mass, g, distance) = (7.0_f64, 9.81, 2.5e-4);
    let omega = (pendulum_stiffness(mass * g, distance) / mass).sqrt();
    assert!((omega / (g / distance).sqrt() - 1.0).abs() < 1e-14);
    let aside = 1e-3 * distance;
    let lifted = distance - (distance * distance - aside * aside).sqrt();
    let spring = 0.5 * pendulum_stiffness(mass * g, distance) * aside * aside;
    assert!((mass * g * lifted / spring - 1.0).abs() < 1e-6);
}

/// G 2.5 at 3000 rpm permits 8 µm of eccentricity, the example of the standard's chart (from memory: 7.96 g mm/kg).
#[test]
fn grade_of_the_standard() {
    let speed = 3000.0 * std::f64::consts::PI / 30.0;
    let unbalance = residual(2.5e-3, 100.0, speed);
    assert!((unbalance / 795.775e-6 - 1.0).abs() < 1e-6);
    assert_eq!(residual(2.5e-3, 100.0, -speed), unbalance);
    // the nearer plane takes more; a centre beyond both has no levers
    assert_eq!(shares([0.0, 1.0], 0.25), Some([0.75, 0.25]));
    assert_eq!(shares([1.0, 0.0], 0.25), Some([0.25, 0.75]));
    assert_eq!(shares([0.0, 1.0], 1.5), None);
}

/// Of two rows the weight is shared by levers; of three, one with two rows, forces and moments balance, and rows at one place share alike.
#[test]
fn rows_share_the_weight_by_levers() {
    let two = weight_share([(0.0, 1.0), (0.4, 1.0)].into_iter(), 0.1);
    assert!((two(0.0) - 0.75).abs() < 1e-15 && (two(0.4) - 0.25).abs() < 1e-15);
    let (rows, centre) = ([(-0.1, 1.0), (0.2, 2.0), (0.7, 1.0)], 0.3);
    let share = weight_share(rows.into_iter(), centre);
    let sum: f64 = rows.iter().map(|(z, rows)| rows * share(*z)).sum();
    let moment: f64 = rows
        .iter()
        .map(|(z, rows)| rows * share(*z) * (z - centre))
        .sum();
    assert!(
        (sum - 1.0).abs() < 1e-15 && moment.abs() < 1e-15,
        "{sum} {moment}"
    );
    let one = weight_share([(0.5, 2.0), (0.5, 2.0)].into_iter(), 0.1);
    assert_eq!(one(0.5), 0.25);
}
