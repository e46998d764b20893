//! Needed friction of dry whirl by closed forms.

use physics::dry_whirl::{WhirlContact, needed_friction, rolling_limit};

/// A mass on a spring and damper against a race that is held: α(-jω) = 1/(k - mω² - jωc).
fn jeffcott(omega: f64, damping_ratio: f64) -> (f64, f64) {
    let (re, im) = (1.0 - omega * omega, -2.0 * damping_ratio * omega);
    let square = re * re + im * im;
    (re / square, -im / square)
}

/// At the end of the band, ω_n √(1+κ), the needed friction of a Jeffcott rotor is smallest: 2ζ√(1+κ)/κ but for ζ².
#[test]
fn jeffcott_threshold_and_its_orbit() {
    let (zeta, kappa) = (0.05, 10.0);
    let contact = WhirlContact {
        clearance: 1.0,
        stiffness: kappa,
        exponent: 1.0,
    };
    let edge = (1.0_f64 + kappa).sqrt();
    let (re, im) = jeffcott(edge, zeta);
    let smallest = 2.0 * zeta * edge / kappa;
    // rounding of the quotients alone
    assert!((needed_friction(re, im).unwrap() / smallest - 1.0).abs() < 1e-12);
    // ω_s and A_s at 2 μ*: machine_whirl.json
    let friction = 2.0 * smallest;
    let ratio = zeta / friction;
    let settled = ratio + (1.0 + ratio * ratio).sqrt();
    assert!((settled - 2.006_049_026_349_491_4).abs() < 1e-12);
    let (re, im) = jeffcott(settled, zeta);
    assert!((needed_friction(re, im).unwrap() / friction - 1.0).abs() < 1e-12);
    let orbit = 1.0 + contact.normal_force(re, im).unwrap() / kappa;
    assert!((orbit - 1.433_534_056_452_062_4).abs() < 1e-12);
    let (re, im) = jeffcott(1.001 * edge, zeta);
    assert_eq!(contact.normal_force(re, im), None);
    assert_eq!(needed_friction(1.0, 0.1), None);
}

/// The power law is the linear one at its own secant stiffness.
#[test]
fn force_of_a_power_law_is_that_at_its_secant() {
    let hertz = WhirlContact {
        clearance: 2e-4,
        stiffness: 5e8,
        exponent: 10.0 / 9.0,
    };
    let force = hertz.normal_force(-6e-7, 1e-7).unwrap();
    let depth = (force / hertz.stiffness).powf(0.9);
    let secant = WhirlContact {
        stiffness: force / depth,
        exponent: 1.0,
        ..hertz
    };
    let linear = secant.normal_force(-6e-7, 1e-7).unwrap();
    assert!((force / linear - 1.0).abs() < 1e-12);
    // a hard contact: c0/(|Re α| + μ_e Im α) from above
    let stiff = WhirlContact {
        stiffness: 1e20,
        ..hertz
    };
    let rigid = 2e-4 / (6e-7 + 1e-14 / 6e-7);
    assert!((stiff.normal_force(-6e-7, 1e-7).unwrap() / rigid - 1.0).abs() < 1e-6);
}

#[test]
fn rolling_ends_whirl_and_a_race_at_speed_has_no_drive() {
    assert!((rolling_limit(0.02, 2e-4, [1000.0, 0.0]) - 99_000.0).abs() < 1e-6);
    assert_eq!(rolling_limit(0.02, 2e-4, [1000.0, 990.0]), 0.0);
}
