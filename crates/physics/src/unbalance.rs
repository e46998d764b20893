//! Whirl of an unbalanced rotor on a linear support; the unbalance that a balance grade permits.

/// Steady whirl of the geometric centre, in the frame that turns with the rotor, m: (along the unbalance, ahead of it).
///
/// Formula: C = e mΩ²/(k + jcΩ - mΩ²) = e/(κ - 1 + jd), κ = k/(mΩ²), d = c/(mΩ); the mass centre is at C + e
///
/// - `stiffness` k, N/m; `damping` c, N s/m, of the support
/// - `mass` m, kg; `speed` Ω, rad/s; `eccentricity` e of the mass centre, m
///
/// At rest, and without eccentricity, there is no whirl. Infinite on an undamped resonance.
///
/// Source: Jeffcott rotor on a damped isotropic support, J. S. Rao, Rotor Dynamics, 1991, section 2 (from memory).
/// Valid: isotropic support that also carries the weight, rigid rotor, constant speed.
pub fn whirl(stiffness: f64, damping: f64, mass: f64, speed: f64, eccentricity: f64) -> (f64, f64) {
    if speed == 0.0 || eccentricity == 0.0 {
        return (0.0, 0.0);
    }
    // divided one by one, so that no product of large numbers overflows
    let real = stiffness / mass / speed / speed - 1.0;
    let imaginary = damping / mass / speed;
    let size = real.hypot(imaginary);
    let radius = eccentricity / size;
    if size == 0.0 {
        return (f64::INFINITY, f64::INFINITY);
    }
    (radius * real / size, -radius * imaginary / size)
}

/// Permissible residual unbalance of a rotor, kg m.
///
/// Formula: U = G m/Ω
///
/// - `grade` G, the product of eccentricity and speed, m/s (G2.5: 2.5e-3); `mass` m, kg; `speed` Ω of operation, rad/s, not 0
///
/// Source: ISO 21940-11, 6.2 (from memory).
/// Valid: rotors that are rigid at this speed; a flexible one may have more by its modal unbalances.
pub fn residual(grade: f64, mass: f64, speed: f64) -> f64 {
    grade * mass / speed.abs()
}

/// Shares of a residual unbalance in two planes; none unless the mass centre lies between them.
///
/// Formula: U₁/U = (z₂ - z)/(z₂ - z₁),  U₂/U = (z - z₁)/(z₂ - z₁)
///
/// - `planes` z₁, z₂; `centre` z of the mass: positions along the shaft, m
///
/// Source: ISO 21940-11, 7 (from memory): levers of planes that stand at the bearings.
/// Valid: planes on both sides of the mass centre.
pub fn shares([one, other]: [f64; 2], centre: f64) -> Option<[f64; 2]> {
    let share = (other - centre) / (other - one);
    (share > 0.0 && share < 1.0).then_some([share, 1.0 - share])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_of_speed() {
        // far below resonance C follows the unbalance force, e (Ω/ω)²; far above the rotor turns about its mass centre
        let (slow, _) = whirl(1e6, 0.0, 1.0, 10.0, 1e-6);
        assert!((slow / 1e-10 - 1.0).abs() < 2e-4);
        let (fast, _) = whirl(1e6, 0.0, 1.0, 1e6, 1e-6);
        assert!((fast / -1e-6 - 1.0).abs() < 1e-5);
        assert_eq!(whirl(1e6, 1e3, 8.0, 0.0, 1e-6), (0.0, 0.0));
    }
    #[test]
    fn damping_makes_the_orbit_lag_in_either_direction() {
        let (along, ahead) = whirl(1e6, 500.0, 1.0, 1000.0, 1e-6);
        assert!(along.abs() < 1e-18 && (ahead + 2e-6).abs() < 1e-18);
        // turning the other way, the lag is on the other side
        assert!((whirl(1e6, 500.0, 1.0, -1000.0, 1e-6).1 - 2e-6).abs() < 1e-18);
        assert!(whirl(1e6, 0.0, 1.0, 1000.0, 1e-6).0.is_infinite());
    }
    #[test]
    fn the_reference_drop_starts_on_its_orbit() {
        // mass centre of the reference state y0 at angle 0: x = C + e, y
        let (along, ahead) = whirl(1e6, 1e3, 8.0, 1_256.637_061_435_917_3, 5e-6);
        assert!((along + 5e-6 + 3.671_792_963_781_436_4e-7).abs() < 1e-19);
        assert!((ahead + 5.797_766_812_294_06e-7).abs() < 1e-19);
    }
}
