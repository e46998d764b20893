//! Limits, signs, scaling and published examples. The rows of the reference file stand in `tests/hertz_reference.rs`.

use super::*;
use crate::materials::{BEARING_STEEL, Material, SILICON_NITRIDE, contact_modulus};

fn steel() -> f64 {
    contact_modulus(BEARING_STEEL, BEARING_STEEL)
}
fn bearing_6005(race: Race, groove_curvature: f64) -> BallRace {
    BallRace {
        ball_diameter: 6.35e-3,
        pitch_diameter: 36e-3,
        groove_curvature,
        contact_angle: 0.0,
        race,
    }
}
fn relative(value: f64, reference: f64) -> f64 {
    (value / reference - 1.0).abs()
}

#[test]
fn a_ball_on_a_flat_has_hertz_closed_form() {
    // K = 4/3 E* √r and p_max = (6 Q E*²/(π³ r²))^(1/3) (K. L. Johnson 1985, section 4.2).
    let (r, q) = (3e-3_f64, 40.0_f64);
    let curvature = Curvature {
        axial: 1.0 / r,
        rolling: 1.0 / r,
    };
    let contact = PointContact::new(curvature, steel()).unwrap();
    let pressure = (6.0 * q * steel() * steel() / (PI.powi(3) * r * r)).cbrt();
    // closed forms: rounding only
    assert!(relative(contact.stiffness, 4.0 / 3.0 * steel() * r.sqrt()) < 1e-13);
    assert!(relative(maximum_pressure(contact.pressure_factor, q), pressure) < 1e-13);
    assert!(relative(contact.semi_major(q), contact.semi_minor(q)) < 1e-13);
}
#[test]
fn near_a_circle_nothing_is_lost() {
    // To first order in F: ln κ = F·4/3 (x dD/B slope 3/4 in logarithms), the factors stay 1 to first order.
    for difference in [1e-9, 1e-6, 1e-4] {
        let factors = EllipseFactors::exact(difference).unwrap();
        // second-order terms of the expansion, or rounding of 1 - F
        let error = (factors.ellipticity.ln() - 4.0 / 3.0 * difference).abs();
        assert!(error < 2e-15 + difference * difference);
        assert!((factors.approach - 1.0).abs() < 1e-15 + difference * difference);
    }
}
#[test]
fn tabulated_factors_of_bearing_books() {
    // T. A. Harris, Rolling Bearing Analysis, table of dimensionless contact parameters (from memory): F(ρ), a*, b*, δ*.
    // Four printed digits, made with tabulated integrals: 1e-3.
    for (difference, a, b, d) in [
        (0.1075, 1.0760, 0.9318, 0.9974),
        (0.3204, 1.2623, 0.8114, 0.9761),
        (0.4795, 1.4556, 0.7278, 0.9429),
    ] {
        let factors = EllipseFactors::exact(difference).unwrap();
        assert!(relative(factors.semi_major, a) < 1e-3);
        assert!(relative(factors.semi_minor, b) < 1e-3);
        assert!(relative(factors.approach, d) < 1e-3);
    }
}
#[test]
fn the_legendre_form_of_the_textbook_gives_the_same_ellipse() {
    // F(ρ) = [(κ²+1)E - 2K]/[(κ²-1)E] with m = 1 - 1/κ², K and E by the arithmetic-geometric mean.
    for difference in [0.2, 0.7, 0.9, 0.97, 0.99] {
        let factors = EllipseFactors::exact(difference).unwrap();
        let square = factors.ellipticity.powi(2);
        let (mut a, mut g, mut sum, mut power) = (1.0, 1.0 / factors.ellipticity, 0.0, 0.5);
        let mut c: f64 = (1.0 - 1.0 / square).sqrt();
        for _ in 0..8 {
            sum += power * c * c;
            power *= 2.0;
            c = 0.5 * (a - g);
            (a, g) = (0.5 * (a + g), (a * g).sqrt());
        }
        let first = PI / (2.0 * a);
        let second = first * (1.0 - sum);
        let back = ((square + 1.0) * second - 2.0 * first) / ((square - 1.0) * second);
        // cancellation in the textbook form costs two to three digits
        assert!((back - difference).abs() < 1e-13);
        let semi_major = (2.0 * square * second / PI).cbrt();
        assert!(relative(factors.semi_major, semi_major) < 1e-13);
        let approach = 2.0 * first / PI * (PI / (2.0 * square * second)).cbrt();
        assert!(relative(factors.approach, approach) < 1e-13);
    }
}
#[test]
fn stiffness_of_the_6005_of_the_physics_page() {
    // f 0.515 / 0.525: seven printed digits.
    let inner = PointContact::new(bearing_6005(Race::Inner, 0.515).curvature(), steel()).unwrap();
    let outer = PointContact::new(bearing_6005(Race::Outer, 0.525).curvature(), steel()).unwrap();
    assert!(relative(inner.stiffness, 2.518829e10) < 2e-7);
    assert!(relative(outer.stiffness, 2.218512e10) < 2e-7);
}
#[test]
fn the_fast_form_stays_within_its_bound() {
    for step in 0..=150 {
        let difference = 0.175 + 0.797 * f64::from(step) / 150.0;
        let exact = EllipseFactors::exact(difference).unwrap();
        let fast = EllipseFactors::hamrock_brewe(difference).unwrap();
        assert!((1.25..15.0).contains(&exact.ellipticity));
        assert!(
            relative(fast.approach, exact.approach) < 0.03,
            "{difference}"
        );
        assert!(relative(fast.approach.powf(-1.5), exact.approach.powf(-1.5)) < 0.045);
    }
}
#[test]
fn a_slender_ellipse_approaches_a_line() {
    let contact = PointContact::new(
        Curvature {
            axial: 1e-4,
            rolling: 300.0,
        },
        steel(),
    )
    .unwrap();
    assert!(contact.ellipticity > 1000.0 && contact.stiffness.is_finite());
    // Middle of the ellipse as a line of load q = 3Q/(4a): b² = 4q/(π E* ρ) (Johnson 1985, section 4.2).
    let q = 50.0;
    let line = 3.0 * q / (4.0 * contact.semi_major(q));
    let b = (4.0 * line / (PI * steel() * 300.0)).sqrt();
    // corrections of order (b/a)² ln(a/b)
    assert!(relative(contact.semi_minor(q), b) < 1e-4);
}
#[test]
fn the_root_holds_for_the_thinnest_ellipse() {
    // For b << a the ratio of the curvature sums is x (ln(4/√x) - 1), x = (b/a)²; the next term is x smaller.
    for exponent in [-6, -9, -12] {
        let ratio = 10_f64.powi(exponent);
        let factors = EllipseFactors::of_ratio(ratio);
        let x = factors.ellipticity.powi(-2);
        let asymptote = x * ((4.0 / x.sqrt()).ln() - 1.0);
        assert!(
            relative(asymptote, ratio) < 1e-13 + 3.0 * ratio,
            "{exponent}"
        );
    }
}
#[test]
fn powers_of_the_load() {
    let contact = PointContact::new(bearing_6005(Race::Inner, 0.52).curvature(), steel()).unwrap();
    let p = |q: f64| maximum_pressure(contact.pressure_factor, q);
    assert!(relative(p(800.0), 2.0 * p(100.0)) < 1e-14);
    assert!(relative(contact.approach(800.0), 4.0 * contact.approach(100.0)) < 1e-14);
    assert!(relative(contact.load_at_pressure(p(123.0)), 123.0) < 1e-14);
    assert_eq!(p(0.0), 0.0);
    assert_eq!(p(-5.0), 0.0);
    // p = 3Q/(2πab), and the approach gives the load back
    let area = PI * contact.semi_major(9.0) * contact.semi_minor(9.0);
    assert!(relative(p(9.0), 1.5 * 9.0 / area) < 1e-14);
    assert!(relative(contact.stiffness * contact.approach(9.0).powf(1.5), 9.0) < 1e-14);
}
#[test]
fn scaling_by_dimension() {
    // Twice the size at the same modulus: K ∝ √length, p_max ∝ length^(-2/3) at equal load.
    let big = BallRace {
        ball_diameter: 12.7e-3,
        pitch_diameter: 72e-3,
        ..bearing_6005(Race::Outer, 0.53)
    };
    let small = bearing_6005(Race::Outer, 0.53);
    let big = PointContact::new(big.curvature(), steel()).unwrap();
    let small = PointContact::new(small.curvature(), steel()).unwrap();
    assert!(relative(big.stiffness, small.stiffness * 2_f64.sqrt()) < 1e-13);
    assert!(
        relative(
            big.pressure_factor,
            small.pressure_factor * 2_f64.powf(-2.0 / 3.0)
        ) < 1e-13
    );
}
#[test]
fn the_order_of_the_curvatures_only_turns_the_ellipse() {
    let curvature = bearing_6005(Race::Inner, 0.52).curvature();
    let turned = Curvature {
        axial: curvature.rolling,
        rolling: curvature.axial,
    };
    assert_eq!(
        PointContact::new(curvature, steel()),
        PointContact::new(turned, steel())
    );
    assert_eq!(curvature.difference(), -turned.difference());
}
#[test]
fn a_tighter_groove_and_a_concave_race_lower_the_pressure() {
    let pressure = |race, f| {
        PointContact::new(bearing_6005(race, f).curvature(), steel())
            .unwrap()
            .pressure_factor
    };
    assert!(pressure(Race::Inner, 0.51) < pressure(Race::Inner, 0.53));
    assert!(pressure(Race::Outer, 0.52) < pressure(Race::Inner, 0.52));
}
#[test]
fn a_contact_angle_moves_both_races_towards_the_flat() {
    let straight = bearing_6005(Race::Inner, 0.52);
    let angular = BallRace {
        contact_angle: 0.4,
        ..straight
    };
    assert!(angular.curvature().rolling < straight.curvature().rolling);
    let axial = BallRace {
        contact_angle: PI / 2.0,
        ..straight
    };
    // a thrust bearing's washer is flat along the rolling direction
    assert!(relative(axial.curvature().rolling, 2.0 / 6.35e-3) < 1e-15);
}
#[test]
fn a_hybrid_contact_is_stiffer_and_more_stressed() {
    let curvature = bearing_6005(Race::Inner, 0.52).curvature();
    let all_steel = PointContact::new(curvature, steel()).unwrap();
    let hybrid =
        PointContact::new(curvature, contact_modulus(SILICON_NITRIDE, BEARING_STEEL)).unwrap();
    let ratio = contact_modulus(SILICON_NITRIDE, BEARING_STEEL) / steel();
    assert!(relative(hybrid.stiffness, all_steel.stiffness * ratio) < 1e-13);
    assert!(
        relative(
            hybrid.pressure_factor,
            all_steel.pressure_factor * ratio.powf(2.0 / 3.0)
        ) < 1e-13
    );
}
#[test]
fn what_is_no_point_contact_is_refused() {
    for f in [0.5, 0.4, f64::NAN] {
        let curvature = bearing_6005(Race::Inner, f).curvature();
        assert!(PointContact::new(curvature, steel()).is_err());
        assert!(PointContact::hamrock_brewe(curvature, steel()).is_err());
    }
    assert!(EllipseFactors::exact(1.0).is_none() && EllipseFactors::exact(f64::NAN).is_none());
    let message = NotAPoint(bearing_6005(Race::Inner, 0.5).curvature()).to_string();
    assert!(message.contains("groove curvature above 0.5"), "{message}");
}
#[test]
fn shear_under_a_circle_and_under_a_line() {
    let load = 100.0;
    let circle = Curvature {
        axial: 300.0,
        rolling: 300.0,
    };
    let line = Curvature {
        axial: 1e-3,
        rolling: 300.0,
    };
    // K. L. Johnson 1985, ν 0.3: three printed digits.
    for (curvature, share, depth) in [(circle, 0.310, 0.48), (line, 0.300, 0.786)] {
        let contact = PointContact::new(curvature, steel()).unwrap();
        let found = contact.maximum_shear(load, 0.3);
        let pressure = maximum_pressure(contact.pressure_factor, load);
        assert!((found.shear / pressure - share).abs() < 6e-4);
        assert!((found.depth / contact.semi_minor(load) - depth).abs() < 6e-3);
    }
}
#[test]
fn the_shear_found_is_the_largest_at_any_depth() {
    for (f, nu) in [(0.51, 0.3), (0.53, 0.26), (0.7, 0.3), (5.0, 0.35)] {
        let contact = PointContact::new(bearing_6005(Race::Inner, f).curvature(), steel()).unwrap();
        let found = contact.maximum_shear(70.0, nu);
        for step in 0..2000 {
            let depth = 5.0 * contact.semi_minor(70.0) * f64::from(step) / 2000.0;
            let shear = contact.axis_stress(70.0, depth, nu).maximum_shear();
            assert!(shear <= found.shear * (1.0 + 1e-12));
        }
    }
}
#[test]
fn axis_stresses_equal_a_sum_of_point_loads() {
    // Boussinesq's point load (K. L. Johnson 1985, eq. 3.19) summed over the Hertz pressure.
    let contact = PointContact::new(bearing_6005(Race::Outer, 0.53).curvature(), steel()).unwrap();
    let (load, nu) = (100.0, 0.3);
    let (a, b) = (contact.semi_major(load), contact.semi_minor(load));
    let pressure = maximum_pressure(contact.pressure_factor, load);
    for z in [0.4 * b, 0.8 * b, 2.0 * b, 10.0 * b] {
        let (mut normal, mut major, mut minor) = (0.0, 0.0, 0.0);
        let (rings, spokes) = (1600, 800);
        for ring in 0..rings {
            let u = PI / 2.0 * (f64::from(ring) + 0.5) / f64::from(rings);
            let (s, c) = u.sin_cos();
            for spoke in 0..spokes {
                let turn = 2.0 * PI * (f64::from(spoke) + 0.5) / f64::from(spokes);
                let (x, y) = (a * s * turn.cos(), b * s * turn.sin());
                let area =
                    a * b * s * c * (PI / 2.0 / f64::from(rings)) * (2.0 * PI / f64::from(spokes));
                let force = pressure * c * area / (2.0 * PI);
                let flat = x * x + y * y;
                let far = (flat + z * z).sqrt();
                let spread = |x2: f64, y2: f64| {
                    (1.0 - 2.0 * nu) / flat
                        * ((1.0 - z / far) * (x2 - y2) / flat + z * y2 / far.powi(3))
                        - 3.0 * z * x2 / far.powi(5)
                };
                normal -= 3.0 * force * z.powi(3) / far.powi(5);
                major += force * spread(x * x, y * y);
                minor += force * spread(y * y, x * x);
            }
        }
        let stress = contact.axis_stress(load, z, nu);
        // midpoint rule: the ring next to the middle leaves (a π/3200)²/24 over z²
        for (sum, exact) in [
            (normal, stress.normal),
            (major, stress.along_major),
            (minor, stress.along_minor),
        ] {
            assert!((sum - exact).abs() < 2e-5 * pressure, "{z} {sum} {exact}");
        }
    }
}
#[test]
fn published_example_ball_in_the_race_of_ugural() {
    // amesweb.info after Ugural: approximate ellipse factors, so pressure 2e-3 and axes 5e-3 (the source's own error).
    let material = Material {
        young_modulus: 210e9,
        poisson_ratio: 0.29,
        ..BEARING_STEEL
    };
    let curvature = Curvature {
        axial: 1.0 / 4.9e-3 - 1.0 / 5e-3,
        rolling: 1.0 / 4.9e-3 + 1.0 / 25e-3,
    };
    let contact = PointContact::new(curvature, contact_modulus(material, material)).unwrap();
    assert!(relative(maximum_pressure(contact.pressure_factor, 1500.0), 2193.6e6) < 2e-3);
    assert!(relative(contact.semi_major(1500.0), 2.101e-3) < 5e-3);
    assert!(relative(contact.semi_minor(1500.0), 0.156e-3) < 5e-3);
}

#[test]
fn the_tension_at_the_rim_is_that_of_point_loads() {
    // Boussinesq on the surface: a point load P stresses by ±(1 - 2ν) P/(2πR²) along and across R. Summed over Hertz's pressure
    // √(1 - ρ²) at 1.5 radii, where the tension is 1/1.5² of that at the rim.
    let (nu, n, at) = (0.26, 400, 1.5);
    let mut sum = 0.0;
    for i in 0..n {
        let rho = (f64::from(i) + 0.5) / f64::from(n);
        for j in 0..n {
            let (sine, cosine) = (2.0 * PI * (f64::from(j) + 0.5) / f64::from(n)).sin_cos();
            let (x, y) = (at - rho * cosine, rho * sine);
            let square = x * x + y * y;
            let along = (x * x - y * y) / square;
            let load = (1.0 - rho * rho).sqrt() * rho * 2.0 * PI / f64::from(n * n);
            sum += (1.0 - 2.0 * nu) * load * along / (2.0 * PI * square);
        }
    }
    // midpoint rule with a root at the edge of the disc: n^-1.5
    assert!(
        relative(sum * at * at, rim_tension(1.0, nu)) < 1e-4,
        "{sum}"
    );
}
