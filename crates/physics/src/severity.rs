//! What a hard contact leaves behind: indentations and wear.

/// Permanent indentation of ball and race over the ball's diameter: 5.25e-19 (Q/D²)² (1 − 1/(2f))/(1 ∓ γ).
///
/// Arguments: load N, ball diameter m, groove radius over D, γ, `inner` for the inner race (−).
///
/// Source: Palmgren (from memory: check before quoting).
/// Valid: ratio 1e-5 to 1e-3, 58 HRC and more, slow loading.
pub fn permanent_indentation(
    load: f64,
    diameter: f64,
    groove: f64,
    gamma: f64,
    inner: bool,
) -> f64 {
    let side = if inner { 1.0 - gamma } else { 1.0 + gamma };
    5.25e-19 * (load / (diameter * diameter)).powi(2) * (1.0 - 0.5 / groove) / side
}

/// Safety of a ball's load: Q_lim/Q = (p_lim/p)³.
///
/// Source: H. Hertz 1881, p ~ Q^(1/3).
/// Valid: elastic contact.
pub fn ball_load_safety(limit_pressure: f64, pressure: f64) -> f64 {
    (limit_pressure / pressure).powi(3)
}

/// Static safety s0 = C0/P0.
///
/// Source: ISO 76.
/// Valid: P0 above 0.
pub fn static_safety(static_rating: f64, equivalent_load: f64) -> f64 {
    static_rating / equivalent_load
}

/// Volume that sliding removes: V = k N s, m³.
///
/// Arguments: wear coefficient k m²/N, force N, distance m.
///
/// Source: Archard (from memory: check before quoting).
/// Valid: k of the pair and its film.
pub fn wear_volume(coefficient: f64, force: f64, distance: f64) -> f64 {
    coefficient * force * distance
}

/// The same from the friction energy: V = (k/μ) E, m³.
///
/// Source: as [`wear_volume`], E = μ N s.
/// Valid: as [`wear_volume`]; μ above 0.
pub fn wear_volume_by_energy(coefficient: f64, friction: f64, energy: f64) -> f64 {
    coefficient / friction * energy
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_of_archard_agree_and_no_slip_wears_nothing() {
        let (force, distance, friction) = (100.0, 40.0, 0.15);
        let by_energy = wear_volume_by_energy(1e-13, friction, friction * force * distance);
        assert!((by_energy / wear_volume(1e-13, force, distance) - 1.0).abs() < 1e-14);
        assert_eq!(wear_volume(1e-13, force, 0.0), 0.0);
    }

    #[test]
    fn the_indentation_at_the_old_capacity_is_a_ten_thousandth() {
        let load = 64e6 * 0.00635f64.powi(2);
        let ratio = permanent_indentation(load, 0.00635, 0.52, 0.176, true);
        assert!((ratio - 1e-4).abs() < 2e-6, "{ratio}");
    }
}
