//! Rings: pressed on a shaft or into a housing, and spinning.
//!
//! ```text
//!   c ─┐ inner tube ┌─ a ─┐ outer tube ┌─ b          radii; pressed together at a
//!   Δ  diametral interference: outside of the inner tube less bore of the outer one, both free
//! ```
//! Plane stress, axial symmetry, elastic.

use crate::materials::Material;

/// Two tubes pressed together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressFit {
    /// Material of the inner tube.
    pub inner_material: Material,
    /// Material of the outer tube.
    pub outer_material: Material,
    /// Radius of the inner tube's bore c, m; 0 for a solid shaft.
    pub bore_radius: f64,
    /// Radius of the joint a, m.
    pub joint_radius: f64,
    /// Outside radius of the outer tube b, m.
    pub outside_radius: f64,
    /// Diametral interference Δ, m; below zero the tubes are loose.
    pub interference: f64,
}

impl PressFit {
    /// Pressure in the joint, Pa; zero where the tubes are loose.
    ///
    /// Formula: p = (Δ/2)/(a [((b²+a²)/(b²-a²) + ν_o)/E_o + ((a²+c²)/(a²-c²) - ν_i)/E_i])
    ///
    /// - the fields of [`PressFit`]
    ///
    /// Source: G. Lamé's thick tube (Timoshenko and Goodier, Theory of Elasticity, from memory).
    /// Valid: c < a < b, elastic, rings as wide as each other.
    pub fn pressure(&self) -> f64 {
        let [a2, b2, c2] =
            [self.joint_radius, self.outside_radius, self.bore_radius].map(|x| x * x);
        let (inner, outer) = (&self.inner_material, &self.outer_material);
        let outer_give = ((b2 + a2) / (b2 - a2) + outer.poisson_ratio) / outer.young_modulus;
        let inner_give = ((a2 + c2) / (a2 - c2) - inner.poisson_ratio) / inner.young_modulus;
        let interference = self.interference.max(0.0);
        0.5 * interference / (self.joint_radius * (outer_give + inner_give))
    }

    /// Growth of the outer tube's outside radius, m: of an inner race's track on its shaft.
    ///
    /// Formula: u_b = 2 p a² b/(E_o (b² - a²)); both of one material and c = 0: Δ a/(2b)
    ///
    /// - the fields of [`PressFit`]
    ///
    /// Source: as [`PressFit::pressure`].
    /// Valid: as [`PressFit::pressure`].
    pub fn outside_growth(&self) -> f64 {
        let (a2, b) = (self.joint_radius.powi(2), self.outside_radius);
        2.0 * self.pressure() * a2 * b / (self.outer_material.young_modulus * (b * b - a2))
    }

    /// Shrinking of the inner tube's bore radius, m: of an outer race's track in its housing.
    ///
    /// Formula: u_c = 2 p a² c/(E_i (a² - c²))
    ///
    /// - the fields of [`PressFit`]
    ///
    /// Source: as [`PressFit::pressure`].
    /// Valid: as [`PressFit::pressure`].
    pub fn bore_shrinking(&self) -> f64 {
        let (a2, c) = (self.joint_radius.powi(2), self.bore_radius);
        2.0 * self.pressure() * a2 * c / (self.inner_material.young_modulus * (a2 - c * c))
    }

    /// Speed at which the outer tube lifts off the inner one when both spin, rad/s; zero where they are loose.
    ///
    /// Formula: Ω² = (Δ/2)/(u_bore/Ω² of the outer tube - u_outside/Ω² of the inner one), both free
    ///
    /// - the fields of [`PressFit`]
    ///
    /// Source: growths of [`outside_growth`] and [`bore_growth`].
    /// Valid: as [`outside_growth`]; infinite where the inner tube grows faster.
    pub fn lift_off_speed(&self) -> f64 {
        let apart = self.lost_by_spin();
        if apart <= 0.0 {
            return f64::INFINITY;
        }
        (self.interference.max(0.0) / apart).sqrt()
    }

    /// Diametral interference that both lose when they spin, over the square of their speed, m s².
    ///
    /// Formula: 2 (u_bore of the outer tube - u_outside of the inner one)/Ω², both free
    ///
    /// - the fields of [`PressFit`]
    ///
    /// Source: growths of [`outside_growth`] and [`bore_growth`].
    /// Valid: as [`outside_growth`].
    pub fn lost_by_spin(&self) -> f64 {
        2.0 * (bore_growth(self.outer_material, self.joint_radius, self.outside_radius)
            - outside_growth(self.inner_material, self.bore_radius, self.joint_radius))
    }
}

/// Growth of the outside radius of a spinning ring with the square of its speed, m s².
///
/// Formula: u_b/Ω² = ρ b/(4E) [(1-ν) b² + (3+ν) a²]
///
/// - `material`: density ρ, E, ν; `bore_radius` a, m, 0 for a disc; `outside_radius` b, m
///
/// Source: rotating annular disc in plane stress (Timoshenko and Goodier, Theory of Elasticity, from memory).
/// Valid: elastic; ring as a flat disc.
pub fn outside_growth(material: Material, bore_radius: f64, outside_radius: f64) -> f64 {
    let nu = material.poisson_ratio;
    let squares = (1.0 - nu) * outside_radius.powi(2) + (3.0 + nu) * bore_radius.powi(2);
    material.density * outside_radius / (4.0 * material.young_modulus) * squares
}

/// Growth of the bore radius of a spinning ring with the square of its speed, m s².
///
/// Formula: u_a/Ω² = ρ a/(4E) [(3+ν) b² + (1-ν) a²]
///
/// - `material`: density ρ, E, ν; `bore_radius` a, m; `outside_radius` b, m
///
/// Source: as [`outside_growth`].
/// Valid: as [`outside_growth`].
pub fn bore_growth(material: Material, bore_radius: f64, outside_radius: f64) -> f64 {
    let nu = material.poisson_ratio;
    let squares = (3.0 + nu) * outside_radius.powi(2) + (1.0 - nu) * bore_radius.powi(2);
    material.density * bore_radius / (4.0 * material.young_modulus) * squares
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::materials::BEARING_STEEL;

    fn on_shaft(bore_radius: f64) -> PressFit {
        PressFit {
            inner_material: BEARING_STEEL,
            outer_material: BEARING_STEEL,
            bore_radius,
            joint_radius: 12.5e-3,
            outside_radius: 14.825e-3,
            interference: 12e-6,
        }
    }

    #[test]
    fn a_ring_on_a_solid_shaft_of_its_material_grows_by_the_ratio_of_the_diameters() {
        // Δ a/b on the diameter
        let grown = 2.0 * on_shaft(0.0).outside_growth();
        assert!(
            (grown / (12e-6 * 12.5 / 14.825) - 1.0).abs() < 1e-12,
            "{grown}"
        );
        // a hollow shaft gives way
        assert!(on_shaft(8e-3).outside_growth() < 0.9 * on_shaft(0.0).outside_growth());
        let loose = PressFit {
            interference: -1e-6,
            ..on_shaft(0.0)
        };
        assert_eq!((loose.pressure(), loose.lift_off_speed()), (0.0, 0.0));
    }

    #[test]
    fn an_outer_ring_in_a_thick_housing_of_its_material_shrinks_by_the_ratio_of_the_diameters() {
        // Lamé in an infinite body of one material: Δ c/a on the diameter
        let fit = PressFit {
            bore_radius: 21e-3,
            joint_radius: 23.5e-3,
            outside_radius: 1e3,
            ..on_shaft(0.0)
        };
        let shrunk = 2.0 * fit.bore_shrinking();
        // the finite housing differs by (a/b)²
        assert!(
            (shrunk / (12e-6 * 21.0 / 23.5) - 1.0).abs() < 1e-8,
            "{shrunk}"
        );
    }

    #[test]
    fn a_spinning_disc_is_the_limit_of_a_ring_and_a_thin_ring_of_a_hoop() {
        let m = BEARING_STEEL;
        let b: f64 = 15e-3;
        let disc = m.density * b.powi(3) * (1.0 - m.poisson_ratio) / (4.0 * m.young_modulus);
        assert!((outside_growth(m, 0.0, b) / disc - 1.0).abs() < 1e-14);
        // hoop: ρ r³/E
        let hoop = m.density * b.powi(3) / m.young_modulus;
        assert!((outside_growth(m, b, b) / hoop - 1.0).abs() < 1e-14);
        assert!((bore_growth(m, b, b) / hoop - 1.0).abs() < 1e-14);
    }

    #[test]
    fn at_the_lift_off_speed_the_free_gap_equals_the_interference() {
        let fit = on_shaft(0.0);
        let square = fit.lift_off_speed().powi(2);
        let ring = bore_growth(BEARING_STEEL, 12.5e-3, 14.825e-3) * square;
        let shaft = outside_growth(BEARING_STEEL, 0.0, 12.5e-3) * square;
        assert!(((ring - shaft) / 6e-6 - 1.0).abs() < 1e-12);
    }
}
