//! Dry backward whirl of a Jeffcott rotor against a race that is held, by its closed forms.
//!
//! Source: Black 1968 (from memory); derived in book/src/theory/whirl.md. Tolerances: round-off of the search.

use physics::dry_whirl::WhirlContact;
use rotor::{C64, WhirlCurve};

const ZETA: f64 = 0.05;
const KAPPA: f64 = 10.0;

/// α(-jω) of a mass 1 on a spring 1.
fn receptance(omega: f64) -> C64 {
    C64::new(1.0 - omega * omega, -2.0 * ZETA * omega).inv()
}

fn on_curve<T>(to: f64, find: impl FnOnce(&WhirlCurve) -> T) -> T {
    let sampled = (1..=300).map(|k| to * f64::from(k) / 300.0);
    let sampled = sampled.map(|omega| (omega, receptance(omega))).collect();
    let contact = WhirlContact {
        clearance: 1.0,
        stiffness: KAPPA,
        exponent: 1.0,
    };
    find(&WhirlCurve::new(contact, sampled, &|omega| {
        Some(receptance(omega))
    }))
}

fn near(found: f64, wanted: f64, share: f64) {
    assert!((found / wanted - 1.0).abs() < share, "{found} for {wanted}");
}

/// The band goes from ω_n to ω_n √(1+κ) but for ζ², and its upper end needs least friction: 2ζ√(1+κ)/κ.
#[test]
fn least_friction_of_a_jeffcott_rotor_is_at_the_end_of_its_band() {
    on_curve(6.0, |curve| {
        assert_eq!(curve.bands().len(), 1);
        let least = curve.smallest(1e-9).unwrap();
        assert!(least.at_end);
        // the contact's stiffness meets |Re α| + μ_e Im α = |α|²/|Re α| = 1/(ω² - 1): no ζ in it
        near(least.point.frequency, 11f64.sqrt(), 1e-9);
        near(least.point.friction, 0.033_166_247_903_554_005, 1e-9);
    });
}

/// Whirl settles nowhere below the threshold; above it from ω_s on, which no crossing upwards follows: N grows without limit.
#[test]
fn whirl_begins_where_friction_exceeds_the_threshold() {
    let threshold = 2.0 * ZETA * 11f64.sqrt() / KAPPA;
    on_curve(6.0, |curve| {
        assert!(curve.ranges(0.95 * threshold).is_empty());
        let ranges = curve.ranges(2.0 * threshold);
        assert_eq!(ranges.len(), 1);
        near(ranges[0].from, 2.006_049_026_349_491_4, 1e-9);
        near(ranges[0].to, 11f64.sqrt(), 1e-9);
        assert_eq!(ranges[0].settles, None);
        // A_s = c0 (1 + d/c0) there
        let start = curve.between(ranges[0].from * (1.0 + 1e-12)).unwrap();
        near(1.0 + start.force / KAPPA, 1.433_534_056_452_062_4, 1e-9);
    });
}

/// Where the samples end before the band does, the minimum is the last sample and says so.
#[test]
fn minimum_at_the_last_sample_is_marked() {
    on_curve(3.0, |curve| {
        let least = curve.smallest(1e-9).unwrap();
        assert!(least.at_end);
        assert_eq!(least.point.frequency, 3.0);
        assert_eq!(curve.ranges(0.1)[0].settles, None);
    });
}
