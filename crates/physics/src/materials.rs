//! Elastic constants and densities of ring and ball materials.

use std::f64::consts::PI;

/// Constants of an isotropic elastic material at room temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Density, kg/m³.
    pub density: f64,
    /// Young's modulus, Pa.
    pub young_modulus: f64,
    /// Poisson's ratio.
    pub poisson_ratio: f64,
}

/// Bearing steel, the default for rings and steel balls: E 206 GPa, ν 0.3, 7850 kg/m³.
///
/// Source: the values of the reference cases (`hertz.json`, and the ball mass of `drop_base.json`); makers print
/// E 206 to 210 GPa and 7800 to 7850 kg/m³ for 100Cr6 (SNFA precision bearing catalogue, p. 109: 210 GPa, 7800 kg/m³).
pub const BEARING_STEEL: Material = Material {
    density: 7850.0,
    young_modulus: 206e9,
    poisson_ratio: 0.3,
};

/// Specific heat of bearing steel, J/(kg K).
///
/// Source: 450 to 480 in handbooks (from memory).
pub const BEARING_STEEL_SPECIFIC_HEAT: f64 = 460.0;

/// Silicon nitride Si₃N₄ for balls of hybrid bearings: E 315 GPa, ν 0.26, 3190 kg/m³.
///
/// Source: SNFA precision bearing catalogue, p. 109, table silicon nitride / bearing steel.
pub const SILICON_NITRIDE: Material = Material {
    density: 3190.0,
    young_modulus: 315e9,
    poisson_ratio: 0.26,
};

/// Contact modulus E* of two bodies pressed together, Pa.
///
/// Formula: 1/E* = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂
///
/// - `first`, `second`: the materials of the two bodies, moduli in Pa; their order does not matter
///
/// The "effective modulus" E' of lubrication papers is 2 E*.
///
/// Source: K. L. Johnson, Contact Mechanics, 1985, section 4.2 (from memory).
/// Valid: isotropic, linear elastic bodies.
pub fn contact_modulus(first: Material, second: Material) -> f64 {
    let compliance = |m: Material| (1.0 - m.poisson_ratio * m.poisson_ratio) / m.young_modulus;
    1.0 / (compliance(first) + compliance(second))
}

/// Mass of a solid ball, kg.
///
/// Formula: m_b = π/6 ρ D³
///
/// - `diameter`: ball diameter D, m
/// - `density`: ρ, kg/m³
///
/// Source: geometry.
/// Valid: solid balls.
pub fn ball_mass(diameter: f64, density: f64) -> f64 {
    PI / 6.0 * density * diameter.powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reference_ball_has_the_reference_mass() {
        // drop_base.json, m_b: written with all digits, so rounding alone separates the two.
        let mass = ball_mass(6.35e-3, BEARING_STEEL.density);
        assert!((mass / 0.0010524208776796881 - 1.0).abs() < 1e-15);
    }
    #[test]
    fn equal_bodies_have_half_the_plane_strain_modulus() {
        let plane_strain = 206e9 / (1.0 - 0.09);
        let modulus = contact_modulus(BEARING_STEEL, BEARING_STEEL);
        assert!((modulus / (plane_strain / 2.0) - 1.0).abs() < 1e-15);
    }
    #[test]
    fn a_ceramic_ball_stiffens_the_contact_whichever_side_it_is_named() {
        let hybrid = contact_modulus(SILICON_NITRIDE, BEARING_STEEL);
        assert_eq!(hybrid, contact_modulus(BEARING_STEEL, SILICON_NITRIDE));
        // By hand: 1/(0.9324/315e9 + 0.91/206e9) = 135.548 GPa, 6 digits.
        assert!((hybrid / 135.548e9 - 1.0).abs() < 1e-5);
        assert!(hybrid > contact_modulus(BEARING_STEEL, BEARING_STEEL));
    }
    #[test]
    fn a_rigid_body_leaves_the_modulus_of_the_other() {
        let rigid = Material {
            young_modulus: f64::INFINITY,
            ..BEARING_STEEL
        };
        assert_eq!(contact_modulus(rigid, BEARING_STEEL), 1.0 / (0.91 / 206e9));
    }
}
