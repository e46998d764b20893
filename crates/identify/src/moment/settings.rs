//! What is known of a steady moment beside the tests.

use physics::skf::SkfMoment;

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

/// What is known beside the tests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentSettings {
    /// Kinematic viscosity ν, m²/s: sets Palmgren's floor; none where it is not known.
    pub viscosity: Option<f64>,
    /// The SKF law of this bearing with its lubricant; none where it is not known.
    pub skf: Option<SkfMoment<f64>>,
    /// Largest |Ω̇| of slow running, rad/s².
    pub slow_acceleration: f64,
    /// Least |Ω| that counts as turning, rad/s.
    pub least_speed: f64,
}

impl Default for MomentSettings {
    /// Slow is below 300 rad/s²: the part of inertia, which is taken out, is then 1 % of the moment of a greased 6005.
    /// Turning is above 1 rad/s: all laws fade below.
    fn default() -> Self {
        Self {
            viscosity: None,
            skf: None,
            slow_acceleration: 300.0,
            least_speed: 1.0,
        }
    }
}
