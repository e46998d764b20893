//! Balls that touch their races at an angle, seen in the plane of the bearing.
//!
//! ```text
//!   α contact angle from the radial plane, held by an axial preload F_a
//!   contacts stand at r cos α from the ball's centre; a radial approach δ_r closes them by δ_r cos α, and only the part
//!   Q cos α of the contact load Q acts in the plane
//!
//!   a rolling ball turns by ω_b about an axis across its line of contact; its surface runs with ω_b r = σ r cos α at the
//!   contacts, σ its spin as the plane sees it, so ω_b = σ cos α
//!   energy ½·⅖ m r² ω_b², its share of the bearing's angular momentum ⅖ m r² ω_b cos α: both those of ⅖ m (r cos α)² at σ
//!
//!   a wall across the track, of a pocket or of the next ball, is rubbed along the line of contact with ω_b r = σ r cos α.
//!   Of the friction F there the plane sees F cos α, across the wall; its couple r F about the ball's axis is r F cos α on σ:
//!   the plane's force on the full arm r. Its slip u, taken with the arm r, rubs with u cos α: power F cos α · u = F · u cos α
//! ```
//! So in the plane every friction coefficient and every slip of such a wall counts cos α of itself, force and couple are a pair
//! as without an angle, and energy and angular momentum close. Left out is what rubs across the line of contact: it would turn the ball
//! about that line.

/// Radial stiffness of a contact at an angle, N/m^1.5.
///
/// Formula: Q cos α = K cos^2.5 α · δ_r^1.5
///
/// - `stiffness` K, N/m^1.5; `contact_angle` α, rad
///
/// Source: geometry (T. A. Harris, Rolling Bearing Analysis, from memory).
/// Valid: an axial preload keeps α; below 90°.
pub fn radial_stiffness(stiffness: f64, contact_angle: f64) -> f64 {
    stiffness * contact_angle.cos().powf(2.5)
}

/// Inertia of a ball's spin as the plane sees it, kg m².
///
/// Formula: I_b = ⅖ m (r cos α)²
///
/// - `mass` m of the ball, kg; `contact_radius` r cos α, m
///
/// Source: derived on this module's page.
/// Valid: no spin about the contact normal, no gyroscopic moment.
pub fn spin_inertia(mass: f64, contact_radius: f64) -> f64 {
    0.4 * mass * contact_radius * contact_radius
}

/// Radial interference that stands for an axial preload, m.
///
/// Formula: δ_r = (F_a/(N sin α K))^(2/3)/cos α
///
/// - `axial_preload` F_a, N; `balls` N; `stiffness` of both contacts in series K, N/m^1.5; `contact_angle` α, rad
///
/// Each ball then carries Q = F_a/(N sin α) without radial load.
///
/// Source: statics.
/// Valid: 0 < α; races concentric; α does not change with load.
pub fn preload_interference(
    axial_preload: f64,
    balls: usize,
    stiffness: f64,
    contact_angle: f64,
) -> f64 {
    let load = axial_preload / (balls as f64 * contact_angle.sin());
    (load / stiffness).powf(2.0 / 3.0) / contact_angle.cos()
}

/// Radial load above which a locked axial preload no longer keeps all balls loaded, N.
///
/// Formula: F_r = 8√2/(5π) F_a/tan α
///
/// - `axial_preload` F_a of the bearing without radial load, N; `contact_angle` α, rad
///
/// Races at a fixed axial distance: Q ∝ (1 + x cos ψ)^1.5 over the circumference, and the least loaded ball carries nothing at
/// x = 1. F_r tan α/F_a is then the mean of (1 + cos ψ)^1.5 cos ψ. A preload by springs, which keeps F_a, holds less: 3/5.
///
/// Source: statics; the integral is H. Sjövall's at ε = 1 (A. Palmgren, 1959, from memory).
/// Valid: rigid rings, many balls, α unchanged.
pub fn radial_load_that_unloads_a_ball(axial_preload: f64, contact_angle: f64) -> f64 {
    LOCKED * axial_preload / contact_angle.tan()
}

/// 8√2/(5π).
const LOCKED: f64 = 1.6 * std::f64::consts::SQRT_2 / std::f64::consts::PI;

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_preload_is_carried_by_its_interference() {
        let (k, alpha, balls) = (8e9, 0.4363_f64, 12);
        let delta = preload_interference(300.0, balls, k, alpha);
        let contact_load = k * (delta * alpha.cos()).powf(1.5);
        assert!((balls as f64 * contact_load * alpha.sin() / 300.0 - 1.0).abs() < 1e-12);
        // seen in the plane the same: its radial part
        let radial = radial_stiffness(k, alpha) * delta.powf(1.5);
        assert!((radial / (contact_load * alpha.cos()) - 1.0).abs() < 1e-12);
        assert_eq!(radial_stiffness(k, 0.0), k);
    }

    #[test]
    fn the_radial_load_is_that_of_the_distribution_whose_least_ball_is_free() {
        // midpoint rule: smooth and periodic but for a root's corner at π
        let n = 20_000;
        let mean = (0..n)
            .map(|i| {
                let psi = PI * (f64::from(i) + 0.5) / f64::from(n);
                (1.0 + psi.cos()).powf(1.5) * psi.cos()
            })
            .sum::<f64>()
            / f64::from(n);
        let ratio = radial_load_that_unloads_a_ball(1.0, PI / 4.0);
        assert!((mean / ratio - 1.0).abs() < 1e-9, "{mean}");
    }
}
