//! Explicit schemes of order three, by what tells one from another.
//!
//! ```text
//!   k1 = f(y)                            (the last stage of the step before)
//!   k_s+1 = f(y + c_s h k_s)             s = 1 .. the chain's length, at t + c_s h: each stage starts from the one before it
//!   y⁺ = y + h (b1 k1 + b2 k2 + b3 k_e)  e the end of the chain;  k_l = f(y⁺)
//!   error = h (e1 k1 + e2 k2 + e3 k_e + e4 k_l)
//! ```
//! Dense output is the cubic through both states with both rates (Hermite).

/// Order of the steps; the embedded ones are one lower.
pub const ORDER: usize = 3;

/// An explicit scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scheme {
    /// c: instants of the stages behind the first, and their weights of the rate before; two at least.
    pub chain: &'static [f64],
    /// b: weights of the first, the second and the last rate of the chain in the step.
    pub step: [f64; 3],
    /// e: the same, and that at the end, in the step less the embedded one.
    pub error: [f64; 4],
}

impl Scheme {
    /// Evaluations of the right-hand side in a step.
    pub fn evaluations(&self) -> u64 {
        self.chain.len() as u64 + 1
    }
}

/// Weights of dense output at a fraction θ of a step:
/// y(θ) = y + change·(y⁺ - y) + h (first·k1 + last·k_l).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DenseWeights {
    /// Of the change of the state over the step.
    pub change: f64,
    /// Of the rate at the start.
    pub first: f64,
    /// Of the rate at the end.
    pub last: f64,
}

/// The weights at the fraction `theta` of a step: the Hermite cubic.
#[inline(always)]
pub fn dense_weights(theta: f64) -> DenseWeights {
    let square = theta * theta;
    DenseWeights {
        change: square * (3.0 - 2.0 * theta),
        first: theta * (1.0 - theta) * (1.0 - theta),
        last: square * (theta - 1.0),
    }
}
