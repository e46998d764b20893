//! Inertia from swings and from a known torque, against a ring of which it is known.

use measure::inertia::{inertia_from_bifilar, inertia_from_known_torque, inertia_from_pendulum};
use statistics::uncertain::Uncertain;

/// A thin ring of radius 0.1 m: I = m r² about its axis; on its rim it swings with T = 2π √(2r/g); on strings 2r apart with
/// T = 2π √(l/g).
#[test]
fn a_ring_has_the_inertia_of_a_ring() {
    let (m, r, g, l) = (2.0, 0.1, 9.81, 1.0);
    let exact = Uncertain::exact;
    let period = std::f64::consts::TAU * f64::sqrt(2.0 * r / g);
    let swung = inertia_from_pendulum(exact(m), exact(r), exact(period), 0.0, g);
    assert!((swung.value - m * r * r).abs() < 1e-12);
    let turned = inertia_from_bifilar(
        exact(m),
        exact(2.0 * r),
        exact(l),
        exact(std::f64::consts::TAU * f64::sqrt(l / g)),
        g,
    );
    assert!((turned.value - m * r * r).abs() < 1e-12);
    let known = inertia_from_known_torque(exact(0.1), exact(4.0), exact(-1.0));
    assert!((known.value - 0.02).abs() < 1e-12);
    // Deviations against finite differences.
    let moved = inertia_from_pendulum(exact(m), exact(r), exact(period * 1.001), 0.0, g).value
        - swung.value;
    let stated = inertia_from_pendulum(
        exact(m),
        exact(r),
        Uncertain::new(period, 0.001 * period),
        0.0,
        g,
    )
    .deviation;
    assert!((moved - stated).abs() < 1e-3 * stated);
}
