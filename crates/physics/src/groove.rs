//! A ball in the grooves of two rings, in space: the races are tori, the contact angle is a result.
//!
//! ```text
//!   groove: radius r_g = f D, its centres on a circle of radius R_g in the ring's plane, at z_g along the ring's axis
//!   inner R_g = R_i + r_g     outer R_g = R_o - r_g                    R_i, R_o groove bottoms
//!   B = (f_i + f_o - 1) D     distance of both centres where a ball touches both races
//!   cos α₀ = (R_g,i - R_g,o)/B                                          α₀ free contact angle
//! ```
//! Assumes: grooves with a circular section. Does not model: shoulders, which cut the ellipse off ([`reaches_shoulder`]).

use crate::hertz::{PointContact, carlson_rd, carlson_rf};
use number::Real;

/// Distance B of the centres of both grooves with a ball between them, m.
///
/// Formula: B = (f_i + f_o - 1) D
///
/// - `curvatures`: f_i and f_o, groove radius over ball diameter; `ball_diameter` D, m
///
/// Source: T. A. Harris, Rolling Bearing Analysis, 4th ed. 2001, section 2 (from memory); geometry.
/// Valid: circular grooves, undeformed.
pub fn centre_distance(curvatures: [f64; 2], ball_diameter: f64) -> f64 {
    (curvatures[0] + curvatures[1] - 1.0) * ball_diameter
}

/// Free contact angle α₀ of a bearing with a clearance, rad.
///
/// Formula: cos α₀ = 1 - s/(2B); 0 without clearance
///
/// - `clearance`: diametral s, m; `distance` B, m
///
/// Source: geometry; ISO/TS 16281:2008 (from memory).
/// Valid: s ≤ 2B.
pub fn free_contact_angle(clearance: f64, distance: f64) -> f64 {
    (1.0 - clearance.max(0.0) / (2.0 * distance)).acos()
}

/// Half axis a_H of the contact ellipse across rolling over the root of the approach, √m.
///
/// Formula: a_H = A_a √δ, A_a = a* (3 K/(2 Σρ E*))^(1/3)
///
/// - `contact`: the contact, whose long axis lies across the groove
///
/// Source: H. Hertz 1881.
/// Valid: as [`PointContact`].
pub fn axis_over_root_approach(contact: &PointContact) -> f64 {
    contact.semi_major_factor * contact.stiffness.cbrt()
}

/// Radius of the surface in which ball and groove touch, across rolling, m.
///
/// Formula: R_c = 2 r r_g/(r + r_g)
///
/// - `ball_radius` r, m; `groove_radius` r_g, m
///
/// Source: T. A. Harris, Rolling Bearing Analysis, 4th ed. 2001, section 8 (from memory); mean of both curvatures.
/// Valid: equal moduli.
pub fn contact_surface_radius(ball_radius: f64, groove_radius: f64) -> f64 {
    2.0 * ball_radius * groove_radius / (ball_radius + groove_radius)
}

/// Whether the contact ellipse reaches the shoulder of a groove.
///
/// Formula: |α| + a_H/r > acos(1 - h/r_g)
///
/// - `angle` α, rad; `reach` a_H/r; `height_ratio` h/r_g, of the shoulder above the groove's bottom
///
/// Source: geometry; a_H/r errs to the safe side by 4 %.
/// Valid: circular groove.
pub fn reaches_shoulder(angle: f64, reach: f64, height_ratio: f64) -> bool {
    angle.abs() + reach > (1.0 - height_ratio).acos()
}

/// Where the centre of a ball lies against the groove of a ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InGroove<R> {
    /// Approach δ, m.
    pub approach: R,
    /// Part of the normal n, from the ball into the race, away from the ring's axis.
    pub radial: R,
    /// Part of n along the ring's axis: the sine of the contact angle.
    pub axial: R,
}

/// A ball in the groove of a ring, both races alike.
///
/// Formula: l = √((ρ - R_g)² + (ζ - z_g)²), δ = l + r - r_g, n = ((ρ - R_g) e + (ζ - z_g) a)/l
///
/// - `radial`: ρ - R_g, m; `axial`: ζ - z_g, m; `slack`: r_g - r, m
///
/// Source: geometry of a sphere in a torus.
/// Valid: r < r_g; without length l there is no contact, and no normal.
#[inline(always)]
pub fn in_groove<R: Real>(radial: R, axial: R, slack: R) -> InGroove<R> {
    let length = (radial.square() + axial.square())
        .max(R::splat(1e-60))
        .sqrt();
    let inverse = length.recip();
    InGroove {
        approach: length - slack,
        radial: radial * inverse,
        axial: axial * inverse,
    }
}

/// Axial load and axial displacement of a bearing at rest whose contacts have an angle under a pure axial load, N and m.
///
/// Formula: F = N c_p (B cos α₀/cos α - B)^1.5 sin α, u = B (cos α₀ tan α - sin α₀)
///
/// - `balls` N; `stiffness` c_p of both contacts in series, N/m^1.5; `distance` B, m
/// - `free_angle` α₀, rad; `angle` α, rad
///
/// Source: T. A. Harris, Rolling Bearing Analysis, 4th ed. 2001, section 7 (from memory).
/// Valid: no speed, α ≥ α₀.
pub fn pure_axial_load(
    balls: usize,
    stiffness: f64,
    distance: f64,
    free_angle: f64,
    angle: f64,
) -> [f64; 2] {
    let approach = distance * (free_angle.cos() / angle.cos() - 1.0);
    let load = balls as f64 * stiffness * approach.max(0.0).powf(1.5) * angle.sin();
    let displacement = distance * (free_angle.cos() * angle.tan() - free_angle.sin());
    [load, displacement]
}

/// Complete elliptic integrals K and E of the parameter 1 - k⁻².
pub(crate) fn complete_integrals(ellipticity: f64) -> [f64; 2] {
    let complement = 1.0 / (ellipticity * ellipticity);
    let first = carlson_rf(0.0, complement, 1.0);
    let second = first - (1.0 - complement) / 3.0 * carlson_rd(0.0, complement, 1.0);
    [first, second]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clearance_gives_a_free_angle() {
        let distance = centre_distance([0.52, 0.53], 11.5e-3);
        let angle = free_contact_angle(10e-6, distance);
        assert!((2.0 * distance * (1.0 - angle.cos()) / 10e-6 - 1.0).abs() < 1e-9);
        assert_eq!(free_contact_angle(-1e-6, distance), 0.0);
    }
    #[test]
    fn a_ball_in_the_middle_of_its_groove_touches_nothing() {
        let at = in_groove(0.0, 0.0, 1e-4);
        assert_eq!((at.approach, at.radial), (-1e-4, 0.0));
        let at = in_groove(-3e-4, 4e-4, 1e-4);
        assert!((at.approach - 4e-4).abs() < 1e-18 && (at.axial - 0.8).abs() < 1e-15);
    }
    #[test]
    fn the_integrals_are_those_of_a_circle_and_of_a_long_ellipse() {
        let half_turn = std::f64::consts::FRAC_PI_2;
        assert!(
            complete_integrals(1.0)
                .iter()
                .all(|i| (i / half_turn - 1.0).abs() < 1e-15)
        );
        // E → 1 with (ln 4k - ½)/(2k²)
        let k = 1e3_f64;
        let expected = 1.0 + ((4.0 * k).ln() - 0.5) / (2.0 * k * k);
        assert!((complete_integrals(k)[1] - expected).abs() < 1e-10);
    }
    #[test]
    fn the_ellipse_reaches_a_low_shoulder() {
        assert!(reaches_shoulder(0.5, 0.1, 0.15) && !reaches_shoulder(0.5, 0.04, 0.2));
    }
    #[test]
    fn without_load_the_angle_is_the_free_one() {
        assert_eq!(pure_axial_load(14, 1e10, 3e-4, 0.4, 0.4)[0], 0.0);
        let [load, moved] = pure_axial_load(14, 1e10, 3e-4, 0.4, 0.45);
        assert!(load > 0.0 && moved > 0.0);
    }
}
