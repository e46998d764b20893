//! Bogacki-Shampine 3(2): three new stages a step, the last one shared with the next step.
//!
//! ```text
//!   k1 = f(y)                          (the last stage of the step before)
//!   k2 = f(y + ½ h k1)
//!   k3 = f(y + ¾ h k2)
//!   y⁺ = y + h (2 k1 + 3 k2 + 4 k3)/9        k4 = f(y⁺)
//!   error = h (-5 k1/72 + k2/12 + k3/9 - k4/8)
//! ```
//! Source: P. Bogacki, L. F. Shampine, A 3(2) pair of Runge-Kutta formulas, Appl. Math. Lett. 2 (1989) 321.
//! Coefficients checked in the tests against the order conditions.

use crate::scheme::Scheme;

/// The scheme.
pub const BOGACKI_SHAMPINE: Scheme = Scheme {
    chain: &[0.5, 0.75],
    step: [2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0],
    error: [-5.0 / 72.0, 1.0 / 12.0, 1.0 / 9.0, -1.0 / 8.0],
};
