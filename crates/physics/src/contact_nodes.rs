//! Points of a contact ellipse at which slip is taken, where it differs over the contact: spin and curved grooves.
//!
//! ```text
//!   x = ξ a_H across rolling,  weight W of the load;   Σ W = 1,  ξ in -1..1
//!   slip at x  (u_x - Δ_y h, u_y + Δ_n x + Δ_x h),   h = x²/(2R_c)
//! ```
//! u gross slip, Δ relative rotation of the bodies in the contact; Δ_n is spin. The half width along rolling is neglected but by the
//! matched rule.

use crate::groove::complete_integrals;
use number::constants;
use std::f64::consts::PI;

constants! {
    /// A point of the contact ellipse.
    pub struct ContactNode {
        /// Place across rolling over the half axis, ξ.
        place: R,
        /// Share of the load, W.
        weight: R,
    }
}

/// One node in the middle: slip is the same all over the contact, as in the planar bearing.
///
/// Formula: ξ = 0, W = 1
///
/// Source: definition.
/// Valid: where spin and Heathcote slip are small against the slip.
pub fn middle() -> Vec<ContactNode<f64>> {
    let (place, weight) = (0.0, 1.0);
    vec![ContactNode { place, weight }]
}

/// Three nodes that have the couple of pure spin.
///
/// Formula: ξ = 0, ±X; W = 1 - 2W₁, W₁; X = (8/15)(1 + k⁻²)/E(k), W₁ = (1 + k⁻²)/(10 X²), E of parameter 1 - k⁻²
///
/// - `ellipticity`: k, long over short axis
///
/// Exact for pure spin under Coulomb's law, for the spin couple of small slips with its minor axis, and for sliding without spin.
/// Elsewhere, S = |Δ_n| a_H/u0: force within 1 % of μQ at S = 1, 6 % at 3, 16 % at 10; couple 3, 8 and 25 % of ⅜ μQ a_H.
///
/// Source: derived from the integrals over the ellipse; the errors by comparison with the integral.
/// Valid: k ≥ 1; S below 1.5 for 1 % of force.
pub fn matched(ellipticity: f64) -> Vec<ContactNode<f64>> {
    let shape = 1.0 + 1.0 / (ellipticity * ellipticity);
    let place = 8.0 / 15.0 * shape / complete_integrals(ellipticity)[1];
    let weight = shape / (10.0 * place * place);
    let middle = 1.0 - 2.0 * weight;
    [(-place, weight), (0.0, middle), (place, weight)]
        .map(|(place, weight)| ContactNode { place, weight })
        .to_vec()
}

/// Nodes of the Gauss rule for the load of a strip, ¾(1 - ξ²)dξ.
///
/// Formula: ξ zeros of P′_{K+1}, W = (3/2)(1 - ξ²)/((K+1)(K+2) P_{K+1}(ξ)²)
///
/// - `count`: K ≥ 1
///
/// Exact for polynomials of the slip up to degree 2K - 1. With nine nodes force and couple are within 6 % of those of the ellipse at S = 10.
///
/// Source: C. F. Gauss; Gauss-Jacobi rule of the weight 1 - ξ² (DLMF 3.5).
/// Valid: contacts of an ellipticity above 4; below, the width along rolling is missed (11 % of the spin couple at 3).
pub fn legendre(count: usize) -> Vec<ContactNode<f64>> {
    let n = count + 1;
    let node = |k: usize| {
        // a zero of P'_n lies between two of P_n; Newton from the middle of their usual guesses
        let guess = |j: f64| (PI * (j - 0.25) / (n as f64 + 0.5)).cos();
        let mut x = 0.5 * (guess(k as f64) + guess(k as f64 + 1.0));
        for _ in 0..100 {
            let [value, slope] = polynomial(n, x);
            // (1 - x²)P'' = 2xP' - n(n+1)P
            let curvature = (2.0 * x * slope - (n * (n + 1)) as f64 * value) / (1.0 - x * x);
            let step = slope / curvature;
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        let value = polynomial(n, x)[0];
        let weight = 1.5 * (1.0 - x * x) / (((count + 1) * (count + 2)) as f64 * value * value);
        ContactNode { place: x, weight }
    };
    let mut nodes: Vec<ContactNode<f64>> = (1..n).rev().map(node).collect();
    if count % 2 == 1 {
        nodes[count / 2].place = 0.0;
    }
    nodes
}

/// Legendre's polynomial P_n and its derivative, |x| < 1.
fn polynomial(n: usize, x: f64) -> [f64; 2] {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (before, value) = (
            value,
            ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k,
        );
    }
    [value, n as f64 * (before - x * value) / (1.0 - x * x)]
}

/// Couple of pure spin in a point contact under Coulomb's law, N m.
///
/// Formula: M = ⅜ μ Q a_H E(k), E of parameter 1 - k⁻²
///
/// - `friction_force`: μQ, N; `half_axis` a_H, m; `ellipticity` k
///
/// Source: H. Poritsky, C. W. Hewlett, R. E. Coleman, J. Appl. Mech. 14 (1947) A-261 (from memory); integral of Hertz's pressure.
/// Valid: no slip but spin; k ≥ 1.
pub fn pure_spin_couple(friction_force: f64, half_axis: f64, ellipticity: f64) -> f64 {
    0.375 * friction_force * half_axis * complete_integrals(ellipticity)[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moments of ξ under the weight of a strip: 1, 0, 1/5, 0, 3/35, …
    fn moment(power: u32) -> f64 {
        let n = f64::from(power);
        if power % 2 == 1 {
            0.0
        } else {
            3.0 / ((n + 1.0) * (n + 3.0))
        }
    }
    fn sum(nodes: &[ContactNode<f64>], power: u32) -> f64 {
        let term = |node: &ContactNode<f64>| node.weight * node.place.powi(power as i32);
        nodes.iter().map(term).sum()
    }

    #[test]
    fn gauss_rules_are_exact_to_their_degree() {
        for count in [1, 2, 3, 5, 7, 9] {
            let nodes = legendre(count);
            for power in 0..2 * count as u32 {
                assert!(
                    (sum(&nodes, power) - moment(power)).abs() < 1e-15,
                    "{count} {power}"
                );
            }
        }
        assert!((legendre(2)[1].place - 0.2_f64.sqrt()).abs() < 1e-15);
        assert_eq!(middle(), legendre(1));
    }
    #[test]
    fn the_matched_rule_has_the_couples_of_the_ellipse() {
        for k in [1.0, 3.0, 8.0] {
            let nodes = matched(k);
            assert!((sum(&nodes, 0) - 1.0).abs() < 1e-15);
            // small slip: ∫(x² + y²) over the pressure = a²(1 + k⁻²)/5
            let inertia = (1.0 + 1.0 / (k * k)) / 5.0;
            assert!((sum(&nodes, 2) / inertia - 1.0).abs() < 1e-14);
            let coulomb: f64 = nodes
                .iter()
                .map(|node| node.weight * node.place.abs())
                .sum();
            assert!((coulomb / pure_spin_couple(1.0, 1.0, k) - 1.0).abs() < 1e-14);
        }
        // a circle: M = 3π/16 μQa
        assert!((pure_spin_couple(1.0, 1.0, 1.0) - 3.0 * PI / 16.0).abs() < 1e-15);
    }
}
