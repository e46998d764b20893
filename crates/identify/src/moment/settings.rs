//! The forms of a steady moment, and what counts as slow.

/// A form of the steady moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// A power 2/3 of speed with a floor, and a constant.
    Palmgren,
    /// A power 0.6 of speed with its two factors, sliding, drag.
    Skf,
    /// Any smooth curve.
    Spline,
}

/// Largest |Ω̇| of slow running, rad/s²: the part of inertia, which is taken out, is then 1 % of the moment of a greased 6005.
pub const SLOW_ACCELERATION: f64 = 300.0;
/// Least |Ω| that counts as turning, rad/s: all laws fade below.
pub const LEAST_SPEED: f64 = 1.0;
